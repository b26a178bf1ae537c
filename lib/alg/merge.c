#include "alg/merge.h"

/*
 * Of the trace of A: directions in which the quadric changes less than that are left nearly free, and the
 * vertex stays near the middle of the edge in them.
 */
static const double FLAT = 1e-5;
/*
 * The cost of length: the merge of an edge of length l over area A costs LENGTH A l^2 beyond its error.  It
 * orders what is flat and evens the triangles; on scanned models the mean distance grows by 1 %.
 */
static const double LENGTH = 1e-3;
static const double TURN = 0.2;    /* cosine of 78 degrees */
static const double NEEDLE = 0.05; /* least height over longest side */
static const double HAIR = 1e-6;   /* of a face so thin that its normal is rounding */

static bool
ring_push(mr_ring *r, uint32_t e)
{
	if (r->n == MR_RING_MAX)
		return false;
	r->he[r->n++] = e;
	return true;
}

/* Appends the faces from half-edge e counter-clockwise, up to but without that of `stop` or a boundary. */
static bool
ring_add(const mr_dyn *d, uint32_t e, uint32_t stop, mr_ring *r)
{
	for (; e != MR_NONE && e != stop; e = mr_dyn_ccw(d, e))
		if (!ring_push(r, e))
			return false;
	return true;
}

/* Appends the faces at the start of h, but for those of h and of its twin. */
static bool
ring_add_start(const mr_dyn *d, uint32_t h, mr_ring *r)
{
	uint32_t g = d->twin[h], stop = g == MR_NONE ? MR_NONE : mr_he_next(g), v = d->v[h];

	/* A boundary vertex's fan has a part on either side of the edge. */
	return ring_add(d, mr_dyn_ccw(d, h), stop, r) &&
	       (g == MR_NONE || !mr_dyn_on_boundary(d, v) || ring_add(d, d->out[v], stop, r));
}

static bool
ring_of(const mr_dyn *d, uint32_t h, mr_ring *r)
{
	uint32_t g = d->twin[h];

	r->n = 0;
	if (!ring_add_start(d, h, r))
		return false;
	return g != MR_NONE ? ring_add_start(d, g, r)
	                    : ring_add(d, d->out[mr_dyn_to(d, h)], mr_he_next(h), r);
}

/*
 * Draws x to the plane g x = r on which the volume below the faces stays what it was (Lindstrom, Turk 1998),
 * in the metric of the quadric.  Where that is farther than the edge is long, as on a blade, x stays.
 */
static mr_v3
keep_volume(const mr_dyn *d, const mr_ring *r, uint32_t h, const mr_quadric_factor *factor, mr_v3 x)
{
	mr_v3 a = d->p[d->v[h]], g = { 0, 0, 0 }, y;
	double rest = 0, gy;

	for (unsigned i = 0; i < r->n; i++) {
		mr_v3 n = mr_dyn_cross(d, d->p, r->he[i] / 3);
		g = mr_add(g, n);
		rest += mr_dot(n, mr_sub(d->p[d->v[r->he[i]]], a));
	}
	g = mr_add(g, mr_dyn_cross(d, d->p, h / 3));
	g = mr_add(g, mr_dyn_cross(d, d->p, d->twin[h] / 3));
	y = mr_quadric_solve(factor, g);
	gy = mr_dot(g, y);
	rest -= mr_dot(g, x);
	if (!(gy > 0) || rest * rest * mr_norm2(y) > gy * gy * mr_norm2(mr_sub(d->p[mr_dyn_to(d, h)], a)))
		return x;
	return mr_axpy(rest / gy, y, x);
}

/*
 * The offset that minimizes q, from x: three steps of x <- argmin q(y) + s |y - x|^2.  Where q is well
 * conditioned that is its minimum to rounding, on an edge or a plane the point of it nearest to x.
 */
static mr_v3
minimize(const mr_quadric *q, const mr_quadric_factor *factor, mr_v3 x)
{
	for (int i = 0; i < 3; i++)
		x = mr_sub(x, mr_quadric_solve(factor, mr_add(mr_quadric_apply(q, x), q->b)));
	return x;
}

bool
mr_merge_of(const mr_dyn *d, const mr_quadric *quadrics, uint32_t h, mr_merge *m)
{
	uint32_t a = d->v[h], b = mr_dyn_to(d, h);
	bool rim_a = mr_dyn_on_boundary(d, a), rim_b = mr_dyn_on_boundary(d, b);
	mr_v3 ab = mr_sub(d->p[b], d->p[a]), x = mr_mul(rim_a == rim_b ? 0.5 : rim_a ? 0 : 1, ab);
	mr_quadric qb = mr_quadric_moved(&quadrics[b], mr_mul(-1, ab)), q = mr_quadric_sum(&quadrics[a], &qb);
	double trace = q.xx + q.yy + q.zz, error;

	if (!ring_of(d, h, &m->ring))
		return false;
	if (trace > 0) {
		mr_quadric_factor factor = mr_quadric_factor_of(&q, FLAT * trace);
		x = minimize(&q, &factor, x);
		if (!rim_a && !rim_b)
			x = keep_volume(d, &m->ring, h, &factor, x);
	}
	error = mr_quadric_at(&q, x);
	m->p = mr_add(d->p[a], x);
	m->error2 = q.area > 0 ? error / q.area : 0;
	m->cost = error + LENGTH * q.area * mr_norm2(ab);
	return true;
}

/* Whether the face that leaves a ring's vertex by e may have that vertex at p; *after is its normal then. */
static bool
face_may_move(const mr_dyn *d, uint32_t e, mr_v3 p, mr_v3 *after)
{
	mr_v3 old = d->p[d->v[e]], q = d->p[mr_dyn_to(d, e)], r = d->p[mr_dyn_apex(d, e)];
	mr_v3 before = mr_cross(mr_sub(q, old), mr_sub(r, old));
	double side = mr_dyn_longest2(p, q, r), old_side = mr_dyn_longest2(old, q, r);
	double bb = mr_norm2(before), ba, aa;

	*after = mr_cross(mr_sub(q, p), mr_sub(r, p));
	aa = mr_norm2(*after);
	if (aa <= HAIR * HAIR * side * side)
		return false;
	if (aa < NEEDLE * NEEDLE * side * side && aa * old_side * old_side < bb * side * side)
		return false;
	ba = mr_dot(before, *after);
	return bb <= HAIR * HAIR * old_side * old_side || (ba > 0 && ba * ba > TURN * TURN * aa * bb);
}

/* The normal of the face across half-edge h, of any length; zero on the boundary. */
static mr_v3
across(const mr_dyn *d, uint32_t h)
{
	return d->twin[h] == MR_NONE ? mr_vec(0, 0, 0) : mr_dyn_cross(d, d->p, d->twin[h] / 3);
}

/* Folds at the outer edges of a ring and at its spokes, as they are. */
static unsigned
folds_before(const mr_dyn *d, const mr_ring *r)
{
	unsigned n = 0;

	for (unsigned i = 0; i < r->n; i++) {
		uint32_t e = r->he[i];
		mr_v3 normal = mr_dyn_cross(d, d->p, e / 3);
		n += mr_dyn_folds(normal, across(d, mr_he_next(e)));
		n += mr_dyn_folds(normal, across(d, e));
	}
	return n;
}

/* The same where the faces have the normals `after` around one vertex. */
static unsigned
folds_after(const mr_dyn *d, const mr_ring *r, const mr_v3 *after)
{
	unsigned n = 0;

	for (unsigned i = 0; i < r->n; i++) {
		unsigned next = i + 1 == r->n ? 0 : i + 1;
		n += mr_dyn_folds(after[i], across(d, mr_he_next(r->he[i])));
		if (mr_dyn_apex(d, r->he[i]) == mr_dyn_to(d, r->he[next]))
			n += mr_dyn_folds(after[i], after[next]);
	}
	return n;
}

bool
mr_merge_is_sound(const mr_dyn *d, const mr_merge *m)
{
	mr_v3 after[MR_RING_MAX];
	unsigned folds;

	for (unsigned i = 0; i < m->ring.n; i++)
		if (!face_may_move(d, m->ring.he[i], m->p, &after[i]))
			return false;
	folds = folds_after(d, &m->ring, after);
	return folds == 0 || folds <= folds_before(d, &m->ring);
}
