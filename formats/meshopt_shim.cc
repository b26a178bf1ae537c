#include "formats/meshopt_shim.h"

#include <meshoptimizer.h>

bool
mr_meshopt_cache(unsigned *corner, size_t count, size_t vertices)
{
	try {
		meshopt_optimizeVertexCache(corner, corner, count, vertices);
		return true;
	} catch (...) {
		return false;
	}
}
