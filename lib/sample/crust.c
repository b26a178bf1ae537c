/*
 * Whether heights follow noise, by two signs.  Where they do the surface is rough everywhere, where a body
 * has edges along lines alone.  And what a smooth surface leaves of the points is then without order: a point
 * tells nothing of the next, as it does where that surface has lost a shape (Durbin, Watson 1950, of a
 * series).
 */
#include "sample/parts.h"

#include "base/parallel.h"
#include "base/sort.h"
#include "mesh/normals.h"

enum { GRAIN = 256 };

/* Normals, of the means of the vertices around. */
static void
smooth_normals(const mr_adjacency *adj, size_t n, const mr_v3 *from, mr_v3 *to)
{
	for (size_t i = 0; i < n; i++) {
		to[i] = from[i];
		for (size_t k = adj->start[i]; k < adj->start[i + 1]; k++)
			to[i] = mr_add(to[i], from[adj->adj[k]]);
	}
}

/* The share of the area around each vertex whose faces are turned from the normals around.  rough: one a
 * vertex, the caller's. */
static mr_status
find_rough(mr_ctx *ctx, const mr_mesh *m, const mr_adjacency *adj, double *rough)
{
	static const double TURNED = 0.9063; /* cosine of 25 degrees */
	mr_mark mark = mr_mark_take(ctx);
	mr_v3 *normal = MR_NEW(ctx, m->nv, mr_v3), *around = MR_NEW(ctx, m->nv, mr_v3);
	double *all = MR_NEW_ZERO(ctx, m->nv, double);

	MR_TRY(mr_vertex_normals(ctx, m, NULL, normal));
	smooth_normals(adj, m->nv, normal, around);
	memset(rough, 0, m->nv * sizeof *rough);
	for (size_t f = 0; f < m->nf; f++) {
		const uint32_t *v = m->t[f].v;
		mr_v3 n = mr_face_cross(m, f),
		      mean = mr_add(around[v[0]], mr_add(around[v[1]], around[v[2]]));
		double area = mr_norm(n);
		bool turned = mr_dot(n, mean) < TURNED * area * mr_norm(mean);
		for (int k = 0; k < 3; k++) {
			all[v[k]] += area;
			rough[v[k]] += turned ? area : 0;
		}
	}
	for (size_t v = 0; v < m->nv; v++)
		rough[v] = all[v] > 0 ? rough[v] / all[v] : 0;
	mr_mark_release(ctx, mark);
	return MR_OK;
}

mr_status
mr_find_crust(mr_ctx *ctx, const mr_mesh *surface, const mr_heights *e, double *share)
{
	enum { ROUNDS = 8 };
	static const double MUCH = 0.4;
	mr_mark mark = mr_mark_take(ctx);
	double *rough = MR_NEW(ctx, e->n, double), all = 0, crust = 0;

	MR_TRY(find_rough(ctx, surface, &e->adj, rough));
	mr_heights_spread(ctx, e, ROUNDS, rough);
	for (size_t f = 0; f < surface->nf; f++) {
		const uint32_t *v = surface->t[f].v;
		double area = mr_norm(mr_face_cross(surface, f));
		all += area;
		crust += rough[v[0]] + rough[v[1]] + rough[v[2]] > 3 * MUCH ? area : 0;
	}
	*share = all > 0 ? crust / all : 0;
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* Of some points, at equal strides. */
typedef struct order {
	const mr_mesh *surface;
	const mr_sample_cloud *c;
	const mr_wish *wish;
	size_t k, some;
	const uint32_t *index; /* k of each, itself the first */
	double most;           /* what is more counts as this */
	double *same, *square; /* products with the next one's, and with itself */
} order;

static size_t
point_of(const order *o, size_t i)
{
	return i * o->c->n / o->some;
}

static double
gap_of(const order *o, uint32_t i)
{
	return fmax(-o->most, fmin(o->wish[i].gap, o->most));
}

/* The next point along the surface, which of a thick layer need not be the nearest; itself where there is
 * none.
 */
static uint32_t
next_along(const order *o, uint32_t p, const uint32_t *near)
{
	mr_v3 n = mr_unit(mr_face_cross(o->surface, o->wish[p].face));
	double least = INFINITY;
	uint32_t next = p;

	for (size_t j = 0; j < o->k && near[j] != UINT32_MAX; j++) {
		mr_v3 d = mr_sub(o->c->p[near[j]], o->c->p[p]);
		double far = mr_norm2(mr_axpy(-mr_dot(d, n), n, d));
		if (near[j] != p && far < least && mr_same_side(o->c, near[j], n)) {
			least = far;
			next = near[j];
		}
	}
	return next;
}

static void
compare(void *arg, size_t begin, size_t end)
{
	const order *o = arg;

	for (size_t i = begin; i < end; i++) {
		uint32_t p = (uint32_t)point_of(o, i), next = next_along(o, p, o->index + i * o->k);
		o->same[i] = next == p ? 0 : gap_of(o, p) * gap_of(o, next);
		o->square[i] = next == p ? 0 : gap_of(o, p) * gap_of(o, p);
	}
}

/* Three deviations. */
static double
most_of(const order *o, double *x)
{
	for (size_t i = 0; i < o->some; i++)
		x[i] = fabs(o->wish[point_of(o, i)].gap);
	return 3 * 1.4826 * mr_kth(x, o->some, o->some / 2);
}

mr_status
mr_find_order(
    mr_ctx *ctx, const mr_mesh *surface, const mr_sample_cloud *c, const mr_wish *wish, double *found)
{
	enum { SOME = 10007, NEAREST = 16 };
	mr_mark mark = mr_mark_take(ctx);
	size_t n = c->n < SOME ? c->n : SOME, k = c->n < NEAREST ? c->n : NEAREST;
	mr_v3 *q = MR_NEW(ctx, n, mr_v3);
	uint32_t *index = MR_NEW(ctx, n * k, uint32_t);
	order o = { surface, c, wish, k, n, index, 0, MR_NEW(ctx, n, double), MR_NEW(ctx, n, double) };
	double same = 0, square = 0;

	for (size_t i = 0; i < n; i++)
		q[i] = c->p[point_of(&o, i)];
	o.most = most_of(&o, o.same);
	MR_TRY(mr_near_query(ctx, c->near, q, n, k, index, NULL));
	mr_parallel(ctx, n, GRAIN, compare, &o);
	for (size_t i = 0; i < n; i++) {
		same += o.same[i];
		square += o.square[i];
	}
	*found = square > 0 ? same / square : 1;
	mr_mark_release(ctx, mark);
	return MR_OK;
}
