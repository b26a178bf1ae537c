/* Whether there is a surface that points lie along, by the planes of wider and wider neighbourhoods. */
#include "space/scatter.h"

#include "base/parallel.h"
#include "base/sort.h"
#include "space/local_planes.h"

enum { FEWEST = 256, WIDEST = 512, LOOKS = 128, GRAIN = 16 };

typedef struct look {
	const mr_v3 *p;
	size_t k;
	const uint32_t *index; /* `wide` of each, nearest first */
	size_t wide;
	double *variation;
} look;

static void
look_around(void *arg, size_t begin, size_t end)
{
	const look *l = arg;
	mr_v3 q[WIDEST];

	for (size_t i = begin; i < end; i++) {
		for (size_t j = 0; j < l->k; j++)
			q[j] = l->p[l->index[i * l->wide + j]];
		mr_plane_fit(q, l->k, &l->variation[i]);
	}
}

mr_status
mr_cloud_scatter(mr_ctx *ctx, const mr_v3 *p, size_t n, const mr_near *near, double *scatter)
{
	static const size_t nearest[] = { 32, 128, WIDEST };
	const size_t sizes = n < 16 * WIDEST ? 2 : 3, wide = nearest[sizes - 1],
		     looks = n < LOOKS ? n : LOOKS;
	double *variation, least = 1;
	uint32_t *index;
	mr_mark mark;
	mr_v3 *q;

	if (n < FEWEST) {
		*scatter = 0;
		return MR_OK;
	}
	mark = mr_mark_take(ctx);
	q = MR_NEW(ctx, looks, mr_v3);
	index = MR_NEW(ctx, looks * wide, uint32_t);
	variation = MR_NEW(ctx, looks, double);
	mr_at_strides(p, n, looks, q);
	MR_TRY(mr_near_query(ctx, near, q, looks, wide, index, NULL));
	for (size_t i = 0; i < sizes; i++) {
		look l = { p, nearest[i], index, wide, variation };
		mr_parallel(ctx, looks, GRAIN, look_around, &l);
		least = fmin(least, mr_kth(variation, looks, looks / 2));
	}
	mr_mark_release(ctx, mark);
	*scatter = least;
	return MR_OK;
}
