/* Insertion, and Hoare's selection. */
#include "base/sort.h"

#include <stdlib.h>

enum { SHORT = 32, MEDIAN_OF = 10007 };

static int
compare_indices(const void *a, const void *b)
{
	const uint32_t *x = a, *y = b;

	return (*x > *y) - (*x < *y);
}

static void
sort_indices(uint32_t *x, size_t n)
{
	if (n > SHORT) {
		qsort(x, n, sizeof *x, compare_indices);
		return;
	}
	for (size_t i = 1; i < n; i++) {
		uint32_t moved = x[i];
		size_t j = i;
		for (; j > 0 && x[j - 1] > moved; j--)
			x[j] = x[j - 1];
		x[j] = moved;
	}
}

size_t
mr_sort_unique(uint32_t *x, size_t n)
{
	size_t kept = 0;

	sort_indices(x, n);
	for (size_t i = 0; i < n; i++)
		if (i == 0 || x[i] != x[kept - 1])
			x[kept++] = x[i];
	return kept;
}

/* Hoare 1961: Algorithm 65. */
double
mr_kth(double *x, size_t n, size_t k)
{
	size_t low = 0, high = n - 1;

	while (low < high) {
		double pivot = x[low + (high - low) / 2];
		size_t i = low, j = high;
		for (;;) {
			while (x[i] < pivot)
				i++;
			while (x[j] > pivot)
				j--;
			if (i >= j)
				break;
			double t = x[i];
			x[i++] = x[j];
			x[j--] = t;
		}
		if (k <= j)
			high = j;
		else
			low = j + 1;
	}
	return x[k];
}

void
mr_median(mr_ctx *ctx, const double *x, size_t n, double *median)
{
	MR_SCOPE(ctx);
	size_t m = n < MEDIAN_OF ? n : MEDIAN_OF;
	double *some = MR_NEW(ctx, m, double);

	for (size_t i = 0; i < m; i++)
		some[i] = x[i * n / m];
	*median = mr_kth(some, m, m / 2);
}
