/*
 * A vertex goes to where the planes of the points around it meet: Kobbelt, Botsch, Schwanecke, Seidel 2001
 * (Feature sensitive surface extraction), Ju, Losasso, Schaefer, Warren 2002 (Dual contouring).
 */
#include "mesh/guarded_move.h"
#include "simplify/creases.h"
#include "space/local_planes.h"

/*
 * Points within REACH of a vertex count, if those around them lie in a plane: a sharp edge among them gives
 * them a greater variation than FLAT.  On fandisk and an anchor less reach, or more, leaves up to a half more
 * distance at sharp edges.
 */
enum { AROUND = 10, NEAREST = 32, LEAST = 8 };
static const double REACH = 3, FLAT = 0.002;

/* Vertices that are looked at first, and the share of them that must be sharp. */
enum { SOME = 512 };
static const double SHARP = 0.04;

/* Of the normals' second moment, an eigenvalue in the largest: less is no plane of its own.  Two planes have
 * tan^2 of half the angle: so 35 degrees. */
static const double OWN = 0.1;

/* How far a vertex of a wrap goes: further on it is one of the next row. */
static const double FARTHEST = 2;

/* Planes met from a place: A = sum n n^T, b = sum n (n . to the point). */
typedef struct meeting {
	double a[6];
	mr_v3 b;
	size_t count;
} meeting;

static void
meet(meeting *s, mr_v3 n, mr_v3 r)
{
	s->a[0] += n.x * n.x;
	s->a[1] += n.x * n.y;
	s->a[2] += n.x * n.z;
	s->a[3] += n.y * n.y;
	s->a[4] += n.y * n.z;
	s->a[5] += n.z * n.z;
	s->b = mr_axpy(mr_dot(r, n), n, s->b);
	s->count++;
}

/* x = A^+ b, without the eigenvalues that are small: the nearest place on all planes.  False where they are
 * one plane. */
static bool
solve(const meeting *s, mr_v3 *x)
{
	double value[3];
	mr_v3 vector[3];

	mr_eigen_sym3(s->a, value, vector);
	*x = mr_vec(0, 0, 0);
	for (int k = 0; k < 3; k++)
		if (value[k] > OWN * value[2])
			*x = mr_axpy(mr_dot(vector[k], s->b) / value[k], vector[k], *x);
	return s->count >= LEAST && value[1] > OWN * value[2];
}

static mr_v3
sharp_place(const mr_planes *planes, const mr_v3 *point, const uint32_t *near, double width, mr_v3 at)
{
	meeting s = { .count = 0 };
	mr_v3 x;

	for (int i = 0; i < NEAREST && near[i] != UINT32_MAX; i++) {
		mr_v3 r = mr_sub(point[near[i]], at);
		if (planes->variation[near[i]] < FLAT && mr_norm(r) < REACH * width &&
		    fabs(mr_dot(r, planes->normal[near[i]])) < FARTHEST * width)
			meet(&s, planes->normal[near[i]], r);
	}
	return solve(&s, &x) && mr_norm(x) < FARTHEST * width ? mr_add(at, x) : at;
}

/* Whether enough of some vertices, at equal strides, are near a sharp edge: up to 2.5 % are of smooth
 * surfaces. */
static mr_status
look_for_edges(mr_ctx *ctx, const mr_mesh *m, const mr_simplify_cloud *c, bool *any)
{
	size_t some = m->nv < SOME ? m->nv : SOME, all = some * NEAREST, sharp = 0;
	mr_v3 *at = MR_NEW(ctx, some, mr_v3), *q = MR_NEW(ctx, all, mr_v3), p[AROUND];
	uint32_t *near = MR_NEW(ctx, all, uint32_t), *around = MR_NEW(ctx, all * AROUND, uint32_t);
	mr_planes planes = { .normal = MR_NEW(ctx, all, mr_v3), .variation = MR_NEW(ctx, all, double) };

	mr_at_strides(m->p, m->nv, some, at);
	MR_TRY(mr_near_query(ctx, c->near, at, some, NEAREST, near, NULL));
	for (size_t i = 0; i < all; i++)
		q[i] = near[i] == UINT32_MAX ? mr_vec(0, 0, 0) : c->p[near[i]];
	MR_TRY(mr_near_query(ctx, c->near, q, all, AROUND, around, NULL));
	for (size_t i = 0; i < all; i++) {
		size_t k = 0;
		for (; k < AROUND && around[i * AROUND + k] != UINT32_MAX; k++)
			p[k] = c->p[around[i * AROUND + k]];
		planes.normal[i] = mr_plane_fit(p, k, &planes.variation[i]);
		near[i] = near[i] == UINT32_MAX ? UINT32_MAX : (uint32_t)i;
	}
	for (size_t v = 0; v < some; v++)
		sharp += mr_dist(sharp_place(&planes, q, near + NEAREST * v, c->sampling.usual, at[v]),
			     at[v]) > 0;
	*any = (double)sharp > SHARP * (double)some;
	return MR_OK;
}

mr_status
mr_sharpen(mr_ctx *ctx, const mr_mesh *m, const mr_simplify_cloud *c, mr_v3 *to, bool *any)
{
	mr_mark mark = mr_mark_take(ctx);
	uint32_t *near = mr_alloc(ctx, m->nv, NEAREST * sizeof *near);
	mr_topology topo;
	mr_planes planes;

	MR_TRY(look_for_edges(ctx, m, c, any));
	if (*any) {
		MR_TRY(mr_cloud_planes(ctx, c->p, c->n, AROUND, 1, false, &planes));
		MR_TRY(mr_near_query(ctx, c->near, m->p, m->nv, NEAREST, near, NULL));
		for (size_t v = 0; v < m->nv; v++)
			to[v] = sharp_place(&planes, c->p, near + NEAREST * v, c->sampling.usual, m->p[v]);
		MR_TRY(mr_topology_build(ctx, m, &topo));
		MR_TRY(mr_move_unfolded(ctx, m, &topo, 0, to));
	}
	mr_mark_release(ctx, mark);
	return MR_OK;
}
