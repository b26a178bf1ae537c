/* The place of least quadric error (Garland, Heckbert 1997), and the merges that a surface allows. */
#include "simplify/edge_collapse.h"

/*
 * Relative to the trace of A: directions in which the quadric changes less than that are left nearly free,
 * and the vertex stays near the middle of the edge in them.
 */
static const double FLAT = 1e-5;
/*
 * The cost of length: the merge of an edge of length l over area A costs LENGTH A l^2 beyond its error.  It
 * orders flat regions and evens the triangles, with no effect on the mean distance beyond 1 %.
 */
static const double LENGTH = 2e-3;
enum { STEPS = 3 }; /* of minimization: enough for a corner of a cube to come out to rounding */
/*
 * A control mesh pays for valences far from 6: a share of the cost for the squares of the merged vertex's
 * faces beyond 7 and of missing edges, below 5, of the vertices across.  At 0.05 nearly all valences are 4 to
 * 9, and the mean distance grows by 1 to 3 %.
 */
static const double VALENCE = 0.05;
/* Shapes, squared, that count as one: side by side on a rod slivers are as thin as each other, but for that.
 */
static const double ALIKE = 1 - 1e-4;
static const double TURN = 0.2;  /* cosine of 78 degrees */
static const double HAIR = 1e-6; /* of a face so thin that its normal is rounding */

static bool
ring_push(mr_merge_ring *r, uint32_t e)
{
	if (r->n == MR_RING_MAX)
		return false;
	r->he[r->n++] = e;
	return true;
}

/* Appends the faces from half-edge e counter-clockwise, up to but without `stop`'s face or a boundary. */
static bool
ring_add(const mr_dyn *d, uint32_t e, uint32_t stop, mr_merge_ring *r)
{
	for (; e != MR_NONE && e != stop; e = mr_dyn_ccw(d, e))
		if (!ring_push(r, e))
			return false;
	return true;
}

/* Appends the faces at the start of h, except the faces of h and of its twin. */
static bool
ring_add_start(const mr_dyn *d, uint32_t h, mr_merge_ring *r)
{
	uint32_t g = d->twin[h], stop = g == MR_NONE ? MR_NONE : mr_he_next(g), v = d->v[h];

	/* A boundary vertex's fan has a part on either side of the edge. */
	return ring_add(d, mr_dyn_ccw(d, h), stop, r) &&
	       (g == MR_NONE || !mr_dyn_on_boundary(d, v) || ring_add(d, d->out[v], stop, r));
}

static bool
ring_of(const mr_dyn *d, uint32_t h, mr_merge_ring *r)
{
	uint32_t g = d->twin[h];

	r->n = 0;
	if (!ring_add_start(d, h, r))
		return false;
	return g != MR_NONE ? ring_add_start(d, g, r)
	                    : ring_add(d, d->out[mr_dyn_to(d, h)], mr_he_next(h), r);
}

/*
 * Draws x to the plane g x = r on which the volume below the faces is unchanged (Lindstrom, Turk 1998), in
 * the metric of the quadric.  If that is farther than the edge is long, as on a blade, x stays.
 */
static mr_v3
keep_volume(const mr_dyn *d, const mr_merge_ring *r, uint32_t h, const mr_quadric_factor *factor, mr_v3 x)
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
 * The offset that minimizes q, from x: steps of x <- argmin q(y) + s |y - x|^2.  Three lead, where q is well
 * conditioned, to its minimum to rounding, on an edge or a plane to the point of it nearest to x.
 */
static mr_v3
minimize(const mr_quadric *q, const mr_quadric_factor *factor, mr_v3 x, int steps)
{
	while (steps-- > 0)
		x = mr_sub(x, mr_quadric_solve(factor, mr_add(mr_quadric_apply(q, x), q->b)));
	return x;
}

static mr_merge_sum
sum_of(const mr_dyn *d, const mr_site *site, uint32_t h)
{
	const mr_site *a = &site[d->v[h]], *b = &site[mr_dyn_to(d, h)];
	int kind_a = d->kind[d->v[h]], kind_b = d->kind[mr_dyn_to(d, h)];
	mr_merge_sum s = { .ab = mr_sub(d->p[mr_dyn_to(d, h)], d->p[d->v[h]]),
		.rim = a->rim || b->rim || kind_a != MR_SMOOTH || kind_b != MR_SMOOTH };
	mr_quadric qb = mr_quadric_moved(&b->q, mr_mul(-1, s.ab));
	double trace;

	s.q = mr_quadric_sum(&a->q, &qb);
	if (a->field) {
		mr_field fb = mr_field_moved(b->field, mr_mul(-1, s.ab)), f = mr_field_sum(a->field, &fb);
		mr_field_rest(&f, &s.q);
	}
	kind_a += a->rim;
	kind_b += b->rim;
	s.x = mr_mul(kind_a == kind_b ? 0.5 : kind_a > kind_b ? 0 : 1, s.ab);
	trace = s.q.xx + s.q.yy + s.q.zz;
	if (trace > 0 && d->kind[d->v[h]] != MR_CORNER && d->kind[mr_dyn_to(d, h)] != MR_CORNER)
		s.factor = mr_quadric_factor_of(&s.q, FLAT * trace);
	return s;
}

/* The square of what the vertex across from h will lack of 5 edges, where it is inside. */
static double
lack(const mr_dyn *d, const mr_site *site, uint32_t h)
{
	uint32_t v = mr_dyn_apex(d, h);
	unsigned left = site[v].rim ? 5 : mr_dyn_valence(d, v, 6) - 1;

	return mr_square(5.0 - left);
}

/* The factor of the cost by valences. */
static double
uneven(const mr_dyn *d, const mr_site *site, uint32_t h, unsigned faces)
{
	double total = lack(d, site, h);

	if (d->twin[h] != MR_NONE)
		total += lack(d, site, d->twin[h]);
	if (faces > 7)
		total += mr_square(faces - 7.0);
	return 1 + VALENCE * total;
}

static double
cost_of(const mr_merge_sum *s, double error)
{
	return error + LENGTH * s->q.area * mr_norm2(s->ab);
}

/* Further towards the minimum, where there is one. */
static void
descend(mr_merge_sum *s, int steps)
{
	if (s->factor.shift > 0)
		s->x = minimize(&s->q, &s->factor, s->x, steps);
}

void
mr_merge_begin(const mr_dyn *d, const mr_site *site, uint32_t h, mr_merge *m)
{
	m->edge = h;
	m->sum = sum_of(d, site, h);
	descend(&m->sum, 1);
	m->cost = cost_of(&m->sum, mr_quadric_at(&m->sum.q, m->sum.x));
}

/* The squared distances of the merged vertices to the planes, by area. */
static double
distance2(const mr_dyn *d, const mr_site *site, const mr_merge *m)
{
	uint32_t a = d->v[m->edge], b = mr_dyn_to(d, m->edge);

	return mr_quadric_at(&site[a].q, m->sum.x) + mr_quadric_at(&site[b].q, mr_sub(m->sum.x, m->sum.ab));
}

/* The minimum, no farther from the middle of the edge than this is long: where the quadric is nearly flat,
 * and where values of several charts agree, is far from the surface. */
static mr_v3
draw_near(const mr_merge_sum *s)
{
	mr_v3 middle = mr_mul(0.5, s->ab), off = mr_sub(s->x, middle);
	double far2 = mr_norm2(off), most2 = mr_norm2(s->ab);

	return far2 > most2 ? mr_axpy(sqrt(most2 / far2), off, middle) : s->x;
}

bool
mr_merge_finish(const mr_dyn *d, const mr_site *site, mr_merge *m)
{
	mr_merge_sum *s = &m->sum;
	double error;

	if (!ring_of(d, m->edge, &m->ring))
		return false;
	descend(s, STEPS - 1);
	s->x = draw_near(s);
	if (!s->rim && s->factor.shift > 0)
		s->x = keep_volume(d, &m->ring, m->edge, &s->factor, s->x);
	error = mr_quadric_at(&s->q, s->x);
	m->p = mr_add(d->p[d->v[m->edge]], s->x);
	for (int k = 0; k < 2; k++) { /* to the bit */
		uint32_t v = k ? mr_dyn_to(d, m->edge) : d->v[m->edge];
		m->p = d->kind[v] == MR_CORNER ? d->p[v] : m->p;
	}
	m->error2 = s->q.area > 0 ? (site[d->v[m->edge]].field ? distance2(d, site, m) : error) / s->q.area
	                          : 0;
	m->cost = cost_of(s, error) * uneven(d, site, m->edge, m->ring.n);
	return true;
}

/* A face of a ring: twice its area as a vector, and the square of its longest side. */
typedef struct face {
	mr_v3 cross;
	double side2;
} face;

/* The face that leaves the ring's vertex by e, with that vertex at p. */
static face
face_at(const mr_dyn *d, uint32_t e, mr_v3 p)
{
	mr_v3 q = d->p[mr_dyn_to(d, e)], r = d->p[mr_dyn_apex(d, e)];

	return (face){ mr_cross(mr_sub(q, p), mr_sub(r, p)), mr_dyn_longest2(p, q, r) };
}

/* The square of height over longest side. */
static double
shape2(const face *f)
{
	return f->side2 > 0 ? mr_norm2(f->cross) / (f->side2 * f->side2) : 0;
}

/* Whether a face may become another: that has area if it had, and is not turned. */
static bool
may_become(const face *before, double shape_before, const face *after, double shape_after)
{
	double ba = mr_dot(before->cross, after->cross);

	if (shape_before <= HAIR * HAIR)
		return true;
	return shape_after > HAIR * HAIR && ba > 0 &&
	       ba * ba > TURN * TURN * mr_norm2(before->cross) * mr_norm2(after->cross);
}

/* The lower of `least` and the shape of the face of h. */
static double
least_shape2(const mr_dyn *d, uint32_t h, double least)
{
	face f = face_at(d, h, d->p[d->v[h]]);

	return fmin(least, shape2(&f));
}

/* Whether all faces may have the vertex at p: no needle worse than the worst around.  after: their normals.
 */
static bool
faces_may_move(const mr_dyn *d, const mr_merge *m, double needle, mr_v3 *after)
{
	double worst = 1, least = needle * needle;

	for (unsigned i = 0; i < m->ring.n; i++) {
		uint32_t e = m->ring.he[i];
		face from = face_at(d, e, d->p[d->v[e]]), to = face_at(d, e, m->p);
		double shape_from = shape2(&from), shape_to = shape2(&to);
		if (!may_become(&from, shape_from, &to, shape_to))
			return false;
		least = fmin(least, shape_from);
		worst = fmin(worst, shape_to);
		after[i] = to.cross;
	}
	least = least_shape2(d, m->edge, least);
	if (d->twin[m->edge] != MR_NONE)
		least = least_shape2(d, d->twin[m->edge], least);
	return worst >= ALIKE * least;
}

/* The normal of the face across half-edge h, of any length; zero on the boundary. */
static mr_v3
across(const mr_dyn *d, uint32_t h)
{
	return d->twin[h] == MR_NONE ? mr_vec(0, 0, 0) : mr_dyn_cross(d, d->p, d->twin[h] / 3);
}

/* Folds at the outer edges of a ring and at its spokes, as they are. */
static unsigned
folds_before(const mr_dyn *d, const mr_merge_ring *r)
{
	unsigned n = 0;

	for (unsigned i = 0; i < r->n; i++) {
		uint32_t e = r->he[i];
		mr_v3 normal = mr_dyn_cross(d, d->p, e / 3);
		n += mr_folds(normal, across(d, mr_he_next(e)), MR_NEAR_FOLD);
		n += mr_folds(normal, across(d, e), MR_NEAR_FOLD);
	}
	return n;
}

/* The same where the faces have the normals `after` around one vertex. */
static unsigned
folds_after(const mr_dyn *d, const mr_merge_ring *r, const mr_v3 *after)
{
	unsigned n = 0;

	for (unsigned i = 0; i < r->n; i++) {
		unsigned next = i + 1 == r->n ? 0 : i + 1;
		n += mr_folds(after[i], across(d, mr_he_next(r->he[i])), MR_NEAR_FOLD);
		if (mr_dyn_apex(d, r->he[i]) == mr_dyn_to(d, r->he[next]))
			n += mr_folds(after[i], after[next], MR_NEAR_FOLD);
	}
	return n;
}

bool
mr_merge_is_sound(const mr_dyn *d, const mr_merge *m, double needle)
{
	mr_v3 after[MR_RING_MAX];
	unsigned folds;

	if (!faces_may_move(d, m, needle, after))
		return false;
	folds = folds_after(d, &m->ring, after);
	return folds == 0 || folds <= folds_before(d, &m->ring);
}
