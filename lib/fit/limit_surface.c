/* The limit surface by a quadratic triangle on each of level 1, and feet on it by walks and Newton's method.
 */
#include "fit/limit_surface.h"

#include "base/parallel.h"
#include "solve/sparse.h"
#include "space/surface_walk.h"

enum { GRAIN = 512, CORRECTIONS = 2 };

mr_status
mr_fit_surface_build(mr_ctx *ctx, const mr_mesh *control, const uint8_t *crease, mr_fit_surface *s)
{
	mr_fit_surface r;
	const mr_loop *fine = &r.level[MR_FIT_LEVEL];

	MR_TRY(mr_loop_levels(ctx, control, 180, crease, MR_FIT_LEVEL, r.level));
	MR_TRY(mr_loop_limit_matrix(ctx, r.level, MR_FIT_LEVEL, &r.s));
	r.node = MR_NEW(ctx, fine->nv, mr_v3);
	r.m = (mr_mesh){ control->name, r.node, fine->t, fine->nv, fine->nf };
	mr_fit_surface_move(ctx, &r, control->p, NULL);
	*s = r;
	return MR_OK;
}

typedef struct motion {
	const mr_fit_surface *s;
	const mr_v3 *x;
	bool *moves; /* nodes */
} motion;

static void
move_nodes(void *arg, size_t begin, size_t end)
{
	const motion *j = arg;
	const mr_sparse *a = &j->s->s;

	for (size_t i = begin; i < end; i++) {
		mr_v3 sum = { 0, 0, 0 };
		if (!j->moves[i])
			continue;
		for (int e = a->start[i]; e < a->start[i + 1]; e++)
			sum = mr_axpy(a->value[e], j->x[a->index[e]], sum);
		j->s->node[i] = sum;
	}
}

void
mr_fit_surface_move(mr_ctx *ctx, mr_fit_surface *s, const mr_v3 *x, const bool *which)
{
	mr_mark mark = mr_mark_take(ctx);
	motion j = { s, x, MR_NEW(ctx, s->m.nv, bool) };

	memset(j.moves, which == NULL, s->m.nv * sizeof *j.moves);
	for (size_t f = 0; which && f < s->m.nf; f++)
		for (int k = 0; k < 3 && which[f / MR_FIT_CHILDREN]; k++)
			j.moves[s->m.t[f].v[k]] = true;
	mr_parallel(ctx, s->m.nv, GRAIN, move_nodes, &j);
	mr_mark_release(ctx, mark);
}

void
mr_fit_nodes(const mr_fit_surface *s, uint32_t patch, uint32_t node[MR_FIT_PATCH])
{
	const mr_tri *child = s->m.t + 4 * (size_t)patch;

	for (int k = 0; k < 3; k++) {
		node[k] = child[k].v[k];
		node[3 + k] = child[3].v[k];
	}
}

void
mr_fit_weights(mr_v3 b, double w[MR_FIT_PATCH])
{
	w[0] = b.x * (2 * b.x - 1);
	w[1] = b.y * (2 * b.y - 1);
	w[2] = b.z * (2 * b.z - 1);
	w[3] = 4 * b.x * b.y;
	w[4] = 4 * b.y * b.z;
	w[5] = 4 * b.z * b.x;
}

void
mr_fit_slots(const mr_fit_surface *s, size_t face, uint32_t slot[MR_FIT_SLOTS])
{
	for (uint32_t k = 0; k < MR_FIT_PATCHES; k++)
		mr_fit_nodes(s, (uint32_t)(MR_FIT_PATCHES * face) + k, slot + MR_FIT_PATCH * k);
}

/* The six nodes' positions. */
static void
load(const mr_fit_surface *s, uint32_t patch, mr_v3 p[MR_FIT_PATCH])
{
	uint32_t node[MR_FIT_PATCH];

	mr_fit_nodes(s, patch, node);
	for (int k = 0; k < MR_FIT_PATCH; k++)
		p[k] = s->node[node[k]];
}

static mr_v3
combine(const double w[MR_FIT_PATCH], const mr_v3 p[MR_FIT_PATCH])
{
	mr_v3 sum = { 0, 0, 0 };

	for (int k = 0; k < MR_FIT_PATCH; k++)
		sum = mr_axpy(w[k], p[k], sum);
	return sum;
}

/* The coordinates in a patch of a place in its child k: the children are (a, ab, ca), (ab, b, bc), (ca, bc,
 * c), (ab, bc, ca). */
static mr_v3
in_patch(uint32_t k, mr_v3 w)
{
	if (k == 3)
		return mr_mul(0.5, mr_vec(w.z + w.x, w.x + w.y, w.y + w.z));
	w = mr_mul(0.5, w);
	return mr_vec(w.x + (k == 0 ? 0.5 : 0), w.y + (k == 1 ? 0.5 : 0), w.z + (k == 2 ? 0.5 : 0));
}

/* The nearest coordinates inside the triangle, near enough for a step that is taken only where it helps. */
static mr_v3
clamp(mr_v3 b)
{
	double sum;

	b = mr_vec(fmax(b.x, 0), fmax(b.y, 0), fmax(b.z, 0));
	sum = b.x + b.y + b.z;
	return mr_mul(1 / sum, b);
}

/* The derivatives by the coordinates of b and c. */
static void
tangents(const mr_v3 p[MR_FIT_PATCH], mr_v3 b, mr_v3 *s, mr_v3 *t)
{
	const double du[MR_FIT_PATCH] = { 1 - 4 * b.x, 4 * b.y - 1, 0, 4 * (b.x - b.y), 4 * b.z, -4 * b.z };
	const double dv[MR_FIT_PATCH] = { 1 - 4 * b.x, 0, 4 * b.z - 1, -4 * b.y, 4 * b.y, 4 * (b.x - b.z) };

	*s = combine(du, p);
	*t = combine(dv, p);
}

mr_v3
mr_fit_place(const mr_fit_surface *s, const mr_fit_foot *foot, mr_v3 *normal)
{
	double w[MR_FIT_PATCH];
	mr_v3 p[MR_FIT_PATCH], a, b;

	load(s, foot->patch, p);
	mr_fit_weights(foot->bary, w);
	tangents(p, foot->bary, &a, &b);
	*normal = mr_unit(mr_cross(a, b));
	return combine(w, p);
}

/* A step of Gauss and Newton towards the foot of q: (u, v) are the coordinates of b and c. */
static mr_v3
corrected(const mr_v3 p[MR_FIT_PATCH], mr_v3 b, mr_v3 r)
{
	mr_v3 s, t;

	tangents(p, b, &s, &t);
	double ss = mr_norm2(s), st = mr_dot(s, t), tt = mr_norm2(t), det = ss * tt - st * st;
	double rs = mr_dot(r, s), rt = mr_dot(r, t), u, v;

	if (!(det > 1e-12 * ss * tt))
		return b;
	u = (tt * rs - st * rt) / det;
	v = (ss * rt - st * rs) / det;
	return clamp(mr_vec(b.x - u - v, b.y + u, b.z + v));
}

/* From the nearest point of the triangles to the patch's nearest point. */
static void
settle(const mr_fit_surface *s, mr_v3 q, mr_closest near, mr_fit_foot *foot)
{
	mr_v3 p[MR_FIT_PATCH], b = in_patch(near.at.face % 4, near.at.bary), r;
	double w[MR_FIT_PATCH], d2;

	load(s, near.at.face / 4, p);
	mr_fit_weights(b, w);
	r = mr_sub(q, combine(w, p));
	d2 = mr_norm2(r);
	for (int i = 0; i < CORRECTIONS; i++) {
		mr_v3 next = corrected(p, b, r), e;
		mr_fit_weights(next, w);
		e = mr_sub(q, combine(w, p));
		if (!(mr_norm2(e) < d2))
			break;
		b = next;
		r = e;
		d2 = mr_norm2(e);
	}
	*foot = (mr_fit_foot){ near.at.face, near.at.face / 4, b, sqrt(d2) };
}

typedef struct attach_job {
	const mr_fit_surface *s;
	const mr_bvh *bvh; /* NULL: walk */
	const mr_v3 *point;
	mr_fit_foot *foot;
} attach_job;

static mr_closest
nearest(const attach_job *j, mr_v3 q, uint32_t face)
{
	return j->bvh ? mr_bvh_closest(j->bvh, q)
	              : mr_project_walk(&j->s->m, &j->s->level[MR_FIT_LEVEL].topo, face, q);
}

static void
attach(void *arg, size_t begin, size_t end)
{
	attach_job *j = arg;

	for (size_t i = begin; i < end; i++)
		settle(j->s, j->point[i], nearest(j, j->point[i], j->foot[i].face), &j->foot[i]);
}

void
mr_fit_attach(
    mr_ctx *ctx, const mr_fit_surface *s, const mr_v3 *point, size_t n, bool anew, mr_fit_foot *foot)
{
	mr_mark mark = mr_mark_take(ctx);
	mr_bvh *bvh = NULL;

	if (anew)
		mr_bvh_build(ctx, &s->m, &bvh);
	mr_parallel(ctx, n, GRAIN, attach, &(attach_job){ s, bvh, point, foot });
	mr_mark_release(ctx, mark);
}

static double
distance_of(void *arg, size_t i)
{
	return ((const mr_fit_foot *)arg)[i].dist;
}

static double
square_of(void *arg, size_t i)
{
	double d = ((const mr_fit_foot *)arg)[i].dist;

	return d * d;
}

mr_fit_gap
mr_fit_measure(const mr_ctx *ctx, const mr_fit_foot *foot, size_t n)
{
	void *arg = (void *)(uintptr_t)foot;
	mr_fit_gap gap = { mr_parallel_sum(ctx, n, distance_of, arg) / (double)n,
		sqrt(mr_parallel_sum(ctx, n, square_of, arg) / (double)n), 0 };

	for (size_t i = 0; i < n; i++)
		gap.max = fmax(gap.max, foot[i].dist);
	return gap;
}
