/* Meyer, Desbrun, Schroeder, Barr 2003: Discrete differential-geometry operators for triangulated
 * 2-manifolds. */
#include "op/voronoi_area.h"

#include "base/parallel.h"

void
mr_voronoi_corners(mr_v3 a, mr_v3 b, mr_v3 c, double part[3])
{
	mr_v3 ab = mr_sub(b, a), bc = mr_sub(c, b), ca = mr_sub(a, c);
	double twice = mr_norm(mr_cross(ab, ca));
	double dot[3] = { -mr_dot(ab, ca), -mr_dot(bc, ab), -mr_dot(ca, bc) };
	double eighth = twice > 0 ? 1 / (8 * twice) : 0;
	bool obtuse = false;

	/* |e|^2 cot / 8 of the angle opposite, for both edges e at a corner; |e|^2 is the sum of the dots at
	 * its ends */
	for (int i = 0; i < 3; i++) {
		double at = dot[i], next = dot[(i + 1) % 3], last = dot[(i + 2) % 3];
		part[i] = ((at + next) * last + (at + last) * next) * eighth;
		obtuse |= at <= 0;
	}
	for (int i = 0; i < 3 && obtuse; i++)
		part[i] = dot[i] <= 0 ? twice / 4 : twice / 8;
}

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

mr_status
mr_voronoi_areas(mr_ctx *ctx, const mr_mesh *m, double *area)
{
	enum { BATCH = 1 << 17 };
	mr_mark mark = mr_mark_take(ctx);
	size_t room = m->nf < BATCH ? m->nf : BATCH;
	corners_job j = { m, 0, mr_alloc(ctx, room, sizeof *j.part) };

	if (!j.part)
		return MR_EMEM;
	memset(area, 0, m->nv * sizeof *area);
	for (; j.first < m->nf; j.first += room) { /* added in the order of the faces */
		size_t n = m->nf - j.first < room ? m->nf - j.first : room;
		mr_parallel(ctx, n, 4096, corners_of, &j);
		for (size_t i = 0; i < n; i++)
			for (int k = 0; k < 3; k++)
				area[m->t[j.first + i].v[k]] += j.part[i][k];
	}
	mr_mark_release(ctx, mark);
	return MR_OK;
}
