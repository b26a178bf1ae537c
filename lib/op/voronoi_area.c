/* Meyer, Desbrun, Schroeder, Barr 2003: Discrete differential-geometry operators. */
#include "op/voronoi_area.h"

#include "base/parallel.h"

typedef struct corners_job {
	const mr_mesh *m;
	size_t first; /* face of part[0] */
	double (*part)[3];
} corners_job;

static void
corners_of(void *arg, size_t begin, size_t end)
{
	corners_job *j = arg;

	for (size_t i = begin; i < end; i++) {
		const uint32_t *v = j->m->t[j->first + i].v;
		mr_voronoi_corners(j->m->p[v[0]], j->m->p[v[1]], j->m->p[v[2]], j->part[i]);
	}
}

void
mr_voronoi_areas(mr_ctx *ctx, const mr_mesh *m, double *area)
{
	enum { BATCH = 1 << 17 };
	MR_SCOPE(ctx);
	size_t room = m->nf < BATCH ? m->nf : BATCH;
	corners_job j = { m, 0, mr_alloc(ctx, room, sizeof *j.part) };

	memset(area, 0, m->nv * sizeof *area);
	for (; j.first < m->nf; j.first += room) { /* added in the order of the faces */
		size_t n = m->nf - j.first < room ? m->nf - j.first : room;
		mr_parallel(ctx, n, 4096, corners_of, &j);
		for (size_t i = 0; i < n; i++)
			for (int k = 0; k < 3; k++)
				area[m->t[j.first + i].v[k]] += j.part[i][k];
	}
}
