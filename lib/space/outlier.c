/* Outliers of a sampling that are also far from the surface. */
#include "space/outlier.h"

#include "base/sort.h"

/* In deviations; in spacings, that the surface is away at least. */
static const double LIMIT = 2.5, AWAY = 1;

void
mr_find_outliers(
    mr_ctx *ctx, const mr_sampling *s, const double *off, double least, bool *outlier, size_t *count)
{
	double median, most;

	mr_median(ctx, off, s->n, &median);
	most = fmax(LIMIT * 1.4826 * median, least);
	*count = 0;
	for (size_t i = 0; i < s->n; i++) {
		outlier[i] = s->outlier[i] && off[i] > fmax(most, AWAY * s->spacing[i]);
		*count += outlier[i];
	}
	if (*count > 0)
		mr_note(ctx,
		    "outliers, no nearer to the surface than to others, are left out: %zu of %zu points",
		    *count, s->n);
}
