/*
 * Muja, Lowe 2009: Fast approximate nearest neighbors with automatic algorithm configuration: FLANN.  The
 * only file that knows it.  Its C functions let std::bad_alloc through to their callers, which cannot catch
 * it, and the pool of its nodes goes on with a null pointer: here its templates get a malloc that throws, and
 * nothing leaves these functions.
 */
#include "space/near_shim.h"

#include <algorithm>
#include <map>
#include <new>
#include <stdlib.h>
#include <vector>

static void *
malloc_or_throw(std::size_t bytes)
{
	void *p = malloc(bytes);

	if (!p)
		throw std::bad_alloc();
	return p;
}

#include <flann/algorithms/dist.h>
#define malloc malloc_or_throw
#include <flann/algorithms/kdtree_single_index.h>
#undef malloc

namespace {

typedef flann::KDTreeSingleIndex<flann::L2_3D<double>> tree_type;

flann::Matrix<double>
matrix_of(const double (*p)[3], size_t rows)
{
	return flann::Matrix<double>(const_cast<double *>(p[0]), rows, 3);
}

} // namespace

void *
mr_tree_build(const double (*point)[3], size_t rows, int leaf)
{
	tree_type *tree = nullptr;

	try {
		tree = new tree_type(matrix_of(point, rows), flann::KDTreeSingleIndexParams(leaf));
		tree->buildIndex();
		return tree;
	} catch (...) {
		delete tree;
		return nullptr;
	}
}

bool
mr_tree_query(const void *tree, const double (*query)[3], size_t n, size_t k, size_t *row, double *distance)
{
	try {
		flann::SearchParams exact(flann::FLANN_CHECKS_UNLIMITED, 0, true);
		flann::Matrix<size_t> rows(row, n, k);
		flann::Matrix<double> distances(distance, n, k);
		exact.cores = 1;
		static_cast<const tree_type *>(tree)->knnSearch(
		    matrix_of(query, n), rows, distances, k, exact);
		return true;
	} catch (...) {
		return false;
	}
}

void
mr_tree_free(void *tree)
{
	delete static_cast<tree_type *>(tree);
}
