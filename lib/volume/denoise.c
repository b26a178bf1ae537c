/* Noisy points onto their planes: one step of moving least squares (Alexa et al. 2003). */
#include "volume/parts.h"

#include "base/parallel.h"
#include "space/near.h"

enum { NEAREST = 16, CHUNK = 1 << 16, GRAIN = 1024 };

typedef struct work {
	const mr_volume_cloud *s;
	const uint32_t *index; /* NEAREST of each of a chunk's points */
	size_t first;          /* the chunk's first point */
	mr_v3 *to;
} work;

/* The point's foot on the plane of its nearest points. */
static mr_v3
foot(const work *w, size_t i)
{
	const uint32_t *index = w->index + i * NEAREST;
	mr_v3 p = w->s->p[w->first + i], q[NEAREST], mean = mr_vec(0, 0, 0), normal;
	double variation;
	size_t n = 0;

	for (; n < NEAREST && index[n] != UINT32_MAX; n++) {
		q[n] = w->s->p[index[n]];
		mean = mr_add(mean, q[n]);
	}
	mean = mr_mul(1 / (double)n, mean);
	normal = mr_plane_fit(q, n, &variation);
	return mr_axpy(mr_dot(mr_sub(mean, p), normal), normal, p);
}

static void
project_body(void *arg, size_t begin, size_t end)
{
	const work *w = arg;

	for (size_t i = begin; i < end; i++)
		w->to[w->first + i] = foot(w, i);
}

static mr_status
project_all(mr_ctx *ctx, const mr_near *near, const mr_volume_cloud *s, mr_v3 *to)
{
	size_t chunk = s->n < CHUNK ? s->n : CHUNK;
	uint32_t *index = MR_NEW(ctx, chunk * NEAREST, uint32_t);

	if (!index)
		return MR_EMEM;
	for (size_t first = 0; first < s->n; first += chunk) {
		size_t m = s->n - first < chunk ? s->n - first : chunk;
		MR_TRY(mr_near_query(ctx, near, s->p + first, m, NEAREST, index, NULL));
		mr_parallel(ctx, m, GRAIN, project_body, &(work){ s, index, first, to });
	}
	return MR_OK;
}

mr_status
mr_volume_project(mr_ctx *ctx, mr_volume_cloud *s)
{
	mr_mark mark = mr_mark_take(ctx);
	mr_v3 *to = MR_NEW(ctx, s->n, mr_v3);
	mr_near *near = NULL;
	mr_status status;

	if (!to)
		return MR_EMEM;
	MR_TRY(mr_near_build(ctx, s->p, s->n, &near));
	status = project_all(ctx, near, s, to);
	mr_near_free(near);
	if (status == MR_OK)
		memcpy(s->p, to, s->n * sizeof *to);
	mr_mark_release(ctx, mark);
	return status;
}
