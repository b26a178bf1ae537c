/* Whether there is a surface that points lie along, by the planes of wider and wider neighbourhoods. */
#include "space/scatter.h"

#include "base/parallel.h"
#include "base/sort.h"
#include "space/local_planes.h"

enum { FEWEST = 256, WIDEST = 512, LOOKS = 512, GRAIN = 16 };

typedef struct look {
	const mr_v3 *p;
	size_t k;
	const uint32_t *index; /* WIDEST of each, nearest first */
	double *variation;
} look;

static void
look_around(void *arg, size_t begin, size_t end)
{
	const look *l = arg;
	mr_v3 q[WIDEST];

	for (size_t i = begin; i < end; i++) {
		for (size_t j = 0; j < l->k; j++)
			q[j] = l->p[l->index[i * WIDEST + j]];
		mr_plane_fit(q, l->k, &l->variation[i]);
	}
}

mr_status
mr_cloud_scatter(mr_ctx *ctx, const mr_v3 *p, size_t n, const mr_near *near, double *scatter)
{
	static const size_t nearest[] = { 32, 128, WIDEST };
	mr_mark mark = mr_mark_take(ctx);
	size_t looks = n < LOOKS ? n : LOOKS;
	mr_v3 *q = MR_NEW(ctx, looks, mr_v3);
	uint32_t *index = MR_NEW(ctx, looks * WIDEST, uint32_t);
	double *variation = MR_NEW(ctx, looks, double), least = 1;

	*scatter = 0;
	if (!q || !index || !variation)
		return MR_EMEM;
	if (n < FEWEST)
		return MR_OK;
	mr_at_strides(p, n, looks, q);
	MR_TRY(mr_near_query(ctx, near, q, looks, WIDEST, index, NULL));
	for (size_t i = 0; i < 3 && (i < 2 || n >= 16 * nearest[i]); i++) {
		look l = { p, nearest[i], index, variation };
		mr_parallel(ctx, looks, GRAIN, look_around, &l);
		least = fmin(least, mr_kth(variation, looks, looks / 2));
	}
	mr_mark_release(ctx, mark);
	*scatter = least;
	return MR_OK;
}
