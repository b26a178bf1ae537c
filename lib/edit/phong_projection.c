/*
 * The foot of a point by a walk over faces, and where that fails by a search of the sheet (Kobbelt, Vorsatz,
 * Seidel 1999: Multiresolution hierarchies on unstructured triangle meshes).
 *
 * Over one face, with N = n0 + u m1 + v m2 not normalised and h = t |N|, the
 * equation is
 *
 *	p0 + u e1 + v e2 + t (n0 + u m1 + v m2) = p,
 *
 * linear in each of u, v, t: Newton's method in all three needs one 3x3
 * determinant a step, and eliminating u, v leaves a cubic in t.
 */
#include "edit/phong_projection.h"

#include "base/priority_queue.h"
#include "space/bvh.h"

typedef struct field {
	mr_v3 p0, e1, e2, n0, m1, m2;
} field;

typedef struct place {
	double u, v, t;
} place;

static const double SLACK = 1e-9; /* of barycentric coordinates: how far out a foot still counts as inside */

static field
field_of(const mr_phong *s, uint32_t face)
{
	const uint32_t *c = s->m->t[face].v;
	mr_v3 p0 = s->m->p[c[0]], n0 = s->normal[c[0]];

	return (field){ p0, mr_sub(s->m->p[c[1]], p0), mr_sub(s->m->p[c[2]], p0), n0,
		mr_sub(s->normal[c[1]], n0), mr_sub(s->normal[c[2]], n0) };
}

static mr_v3
normal_at(const field *f, place at)
{
	return mr_axpy(at.u, f->m1, mr_axpy(at.v, f->m2, f->n0));
}

/* r = p - b - t N */
static mr_v3
residual(const field *f, mr_v3 p, place at)
{
	mr_v3 b = mr_axpy(at.u, f->e1, mr_axpy(at.v, f->e2, f->p0));

	return mr_sub(p, mr_axpy(at.t, normal_at(f, at), b));
}

/* Solves A du + B dv + C dt = r by Cramer's rule; returns det(A, B, C), positive this side of the centres. */
static double
newton_step(const field *f, mr_v3 r, place *at)
{
	mr_v3 a = mr_axpy(at->t, f->m1, f->e1), b = mr_axpy(at->t, f->m2, f->e2), c = normal_at(f, *at);
	mr_v3 bc = mr_cross(b, c);
	double det = mr_dot(a, bc);

	at->u += mr_dot(r, bc) / det;
	at->v += mr_dot(r, mr_cross(c, a)) / det;
	at->t += mr_dot(r, mr_cross(a, b)) / det;
	return det;
}

static mr_v3
bary_of(place at)
{
	return mr_vec(1 - at.u - at.v, at.u, at.v);
}

static bool
inside(place at, double slack)
{
	return at.u >= -slack && at.v >= -slack && at.u + at.v <= 1 + slack;
}

/* Writes the foot where what the decoder will compute from it is p, to the tolerance, and it is not beside
 * the face: a last step on one that is all but a line goes anywhere. */
static bool
settle(const mr_ground *g, mr_v3 p, uint32_t face, const field *f, place at, double limit, mr_foot *foot)
{
	const double beside = 1e-6;
	mr_foot r = { { face, bary_of(at) }, at.t * mr_norm(normal_at(f, at)) };
	mr_v3 b = mr_phong_point(&g->surface, r.at);
	mr_v3 n = mr_phong_normal(&g->surface, r.at);

	if (!inside(at, beside) || !(fabs(r.height) <= limit) ||
	    !(mr_dist(mr_axpy(r.height, n, b), p) <= g->tolerance))
		return false;
	*foot = r;
	return true;
}

/* Of the faces at the edge a-b the one of lowest index that is not `face`; MR_NONE on the boundary. */
static uint32_t
neighbour(const mr_ground *g, uint32_t face, uint32_t a, uint32_t b)
{
	for (size_t i = g->inc->start[a]; i < g->inc->start[a + 1]; i++) {
		uint32_t f = g->inc->face[i];
		const uint32_t *c = g->surface.m->t[f].v;
		if (f != face && (c[0] == b || c[1] == b || c[2] == b))
			return f;
	}
	return MR_NONE;
}

/* Where the way from one place to another first leaves the face: the corner opposite the edge, the share of
 * the way. */
static int
first_exit(place from, place to, double *share)
{
	mr_v3 x = bary_of(from), y = bary_of(to);
	double before[3] = { x.x, x.y, x.z }, after[3] = { y.x, y.y, y.z };
	int corner = -1;

	*share = 1;
	for (int i = 0; i < 3; i++) {
		double s;
		if (after[i] >= -SLACK)
			continue;
		s = before[i] > 0 ? before[i] / (before[i] - after[i]) : 0;
		if (corner < 0 || s < *share || (s == *share && after[i] < after[corner])) {
			corner = i;
			*share = s;
		}
	}
	return corner;
}

/* Cuts the way at the edge opposite `corner` and continues in the face behind it; false on the boundary. */
static bool
cross_edge(const mr_ground *g, uint32_t *face, int corner, double share, place from, place *at)
{
	const uint32_t *c = g->surface.m->t[*face].v;
	uint32_t a = c[(corner + 1) % 3], b = c[(corner + 2) % 3], next = neighbour(g, *face, a, b);
	mr_v3 x = bary_of(from), y = bary_of(*at);
	double w[3], weight_a, weight_b, sum;
	place r = { 0, 0, from.t + share * (at->t - from.t) };

	w[0] = x.x + share * (y.x - x.x), w[1] = x.y + share * (y.y - x.y), w[2] = x.z + share * (y.z - x.z);
	weight_a = fmax(w[(corner + 1) % 3], 0), weight_b = fmax(w[(corner + 2) % 3], 0);
	sum = weight_a + weight_b;
	if (next != MR_NONE)
		c = g->surface.m->t[next].v;
	r.u = (c[1] == a ? weight_a : c[1] == b ? weight_b : 0) / sum;
	r.v = (c[2] == a ? weight_a : c[2] == b ? weight_b : 0) / sum;
	*at = r;
	if (next == MR_NONE)
		return false;
	*face = next;
	return true;
}

bool
mr_foot_walk(const mr_ground *g, mr_v3 p, mr_place start, double limit, mr_foot *foot)
{
	/* of seven models walks end within 64 steps, all but a few; with a patience of 4 up to 1 % more
	 * vertices are searched for, with 64 walks take up to twice the steps; stuck once up to 5 % more are
	 * searched for, ten times is as good as three */
	enum { STEPS = 256, STUCK = 3, PATIENCE = 16 };
	const double less = 0.99; /* by so much the squared residual is to fall within PATIENCE steps */
	uint32_t face = start.face;
	field f = field_of(&g->surface, face);
	place at = { start.bary.y, start.bary.z, 0 };
	mr_v3 r = residual(&f, p, at), n = normal_at(&f, at);
	int stuck = 0, last = 0;
	double least = INFINITY, r2;

	at.t = mr_dot(r, n) / mr_norm2(n);
	for (int step = 0; step < STEPS && isfinite(at.t); step++) {
		place from = at;
		double det, share;
		int corner;

		r = residual(&f, p, at);
		r2 = mr_norm2(r);
		if (r2 < less * least) {
			least = r2;
			last = step;
		} else if (step - last > PATIENCE) { /* to and fro over a crease */
			return false;
		}
		det = newton_step(&f, r, &at);
		corner = first_exit(from, at, &share);
		if (corner >= 0) {
			if (cross_edge(g, &face, corner, share, from, &at))
				f = field_of(&g->surface, face);
			else if (++stuck == STUCK)
				return false;
		} else if (mr_norm(residual(&f, p, at)) <= g->tolerance) {
			newton_step(&f, residual(&f, p, at), &at); /* to what rounding leaves */
			return det > 0 && settle(g, p, face, &f, at, limit, foot);
		}
	}
	return false;
}

/* The part of the surface that a search has met: a queue of faces to be looked at, the nearest first. */
enum { PATCH = 4096 }; /* 512 and 32768 find the same feet on seven models */

typedef struct near_face {
	double dist2; /* squared distance from the point */
	uint32_t face;
} near_face;

typedef struct patch {
	size_t waiting, met;
	near_face queue[PATCH];
	uint32_t slot[2 * PATCH]; /* hash table of the faces met: no more than half full */
} patch;

static bool
nearer(const void *a, const void *b)
{
	const near_face *x = a, *y = b;

	return x->dist2 != y->dist2 ? x->dist2 < y->dist2 : x->face < y->face;
}

/* Enters the face into the table; false where it is there already, or the table has its fill. */
static bool
enter(patch *s, uint32_t face)
{
	size_t i = face * 2654435761u % (2 * PATCH);

	while (s->slot[i] != MR_NONE) {
		if (s->slot[i] == face)
			return false;
		i = (i + 1) % (2 * PATCH);
	}
	if (s->met == PATCH)
		return false;
	s->met++;
	s->slot[i] = face;
	return true;
}

static void
meet(const mr_ground *g, mr_v3 p, uint32_t face, patch *s)
{
	near_face x = { 0, face };

	if (!enter(s, face))
		return;
	x.dist2 = mr_face_closest(g->surface.m, face, p).dist2;
	mr_queue_push(s->queue, s->waiting++, sizeof x, &x, nearer);
}

static void
meet_neighbours(const mr_ground *g, mr_v3 p, uint32_t face, patch *s)
{
	for (int k = 0; k < 3; k++) {
		uint32_t v = g->surface.m->t[face].v[k];
		for (size_t i = g->inc->start[v]; i < g->inc->start[v + 1] && s->met < PATCH; i++)
			meet(g, p, g->inc->face[i], s);
	}
}

static double
cubic_at(const double c[4], double t)
{
	return c[0] + t * (c[1] + t * (c[2] + t * c[3]));
}

/* The root in [a, b], where the cubic is monotonic, by Newton's method inside of it; false where it has none.
 */
static bool
root_between(const double c[4], double a, double b, double *root)
{
	enum { STEPS = 50 };
	const double enough = 1e-12;
	double fa = cubic_at(c, a), fb = cubic_at(c, b), width = b - a, t = 0.5 * (a + b);

	if ((fa > 0) == (fb > 0) && fa != 0 && fb != 0)
		return false;
	for (int i = 0; i < STEPS; i++) {
		double ft = cubic_at(c, t), slope = c[1] + t * (2 * c[2] + t * 3 * c[3]),
		       next = t - ft / slope;
		if ((ft > 0) == (fa > 0))
			a = t;
		else
			b = t;
		if (!(next > a && next < b))
			next = 0.5 * (a + b);
		if (fabs(next - t) <= enough * width)
			break;
		t = next;
	}
	*root = t;
	return true;
}

/* The roots in the range, at most three. */
static int
cubic_roots(const double c[4], const double range[2], double root[3])
{
	double cut[4] = { range[0], range[1], range[1], range[1] };
	double half = c[2], disc = half * half - 3 * c[3] * c[1]; /* of 3 c3 t^2 + 2 c2 t + c1 */
	int n = 0;

	if (disc > 0) {
		double q = -(half + copysign(sqrt(disc), half)), t1 = q / (3 * c[3]), t2 = c[1] / q;
		cut[1] = fmax(range[0], fmin(range[1], fmin(t1, t2)));
		cut[2] = fmax(range[0], fmin(range[1], fmax(t1, t2)));
	}
	for (int i = 0; i < 3; i++)
		if (cut[i] < cut[i + 1] && root_between(c, cut[i], cut[i + 1], &root[n]))
			n++;
	return n;
}

/* u, v of the point q = u a + v b in the plane of a and b. */
static place
place_in_plane(const field *f, mr_v3 p, double t)
{
	mr_v3 a = mr_axpy(t, f->m1, f->e1), b = mr_axpy(t, f->m2, f->e2);
	mr_v3 q = mr_sub(p, mr_axpy(t, f->n0, f->p0)), n = mr_cross(a, b);
	double n2 = mr_norm2(n);

	return (place){ mr_dot(mr_cross(q, b), n) / n2, mr_dot(mr_cross(a, q), n) / n2, t };
}

/*
 * Where t may lie for a foot of p on the face, not higher than limit; false: nowhere.  With c the
 * centre, r the farthest that a corner is from it, a the mean of the normals and s the farthest that
 * one is from it, p - b = t N says
 *
 *	p - c = t a + e,	|e| <= r + |t| s.
 */
static bool
range_of_foot(const field *f, mr_v3 p, double limit, double range[2])
{
	const double third = 1. / 3, safe = 1 + 1e-6, shortest = 0.25; /* |N| that is looked at */
	mr_v3 e = mr_mul(third, mr_add(f->e1, f->e2)), m = mr_mul(third, mr_add(f->m1, f->m2));
	mr_v3 q = mr_sub(p, mr_add(f->p0, e)), a = mr_add(f->n0, m);
	double r2 = fmax(mr_norm2(e), fmax(mr_norm2(mr_sub(f->e1, e)), mr_norm2(mr_sub(f->e2, e))));
	double s2 = fmax(mr_norm2(m), fmax(mr_norm2(mr_sub(f->m1, m)), mr_norm2(mr_sub(f->m2, m))));
	double r = safe * sqrt(r2), s = safe * sqrt(s2), length = mr_norm(a);
	double along = length > 0 ? mr_dot(q, a) / length : 0, most = limit / fmax(length - s, shortest);

	range[0] = -most, range[1] = most;
	if (mr_norm2(q) - along * along > (r + most * s) * (r + most * s))
		return false;
	if (s < length && fabs(along) > r) { /* t has the sign of along */
		double low = (fabs(along) - r) / (length + s),
		       high = fmin(most, (fabs(along) + r) / (length - s));
		range[0] = along > 0 ? low : -high;
		range[1] = along > 0 ? high : -low;
	}
	return range[0] <= range[1];
}

/* The lowest foot of p on one face, not higher than limit. */
static bool
foot_on_face(const mr_ground *g, mr_v3 p, uint32_t face, double limit, mr_foot *foot)
{
	enum { POLISH = 4 };
	const double rough = 1e-3;
	field f = field_of(&g->surface, face);
	mr_v3 q = mr_sub(p, f.p0), c0 = mr_cross(f.e1, f.e2), c2 = mr_cross(f.m1, f.m2);
	mr_v3 c1 = mr_add(mr_cross(f.e1, f.m2), mr_cross(f.m1, f.e2));
	/* det(e1 + t m1, e2 + t m2, q - t n0) = 0 */
	double cubic[4] = { mr_dot(c0, q), mr_dot(c1, q) - mr_dot(c0, f.n0), mr_dot(c2, q) - mr_dot(c1, f.n0),
		-mr_dot(c2, f.n0) };
	double range[2], root[3];
	bool found = false;
	int n;

	if (!range_of_foot(&f, p, limit, range))
		return false;
	n = cubic_roots(cubic, range, root);
	for (int i = 0; i < n; i++) {
		place at = place_in_plane(&f, p, root[i]);
		if (!inside(at, rough))
			continue;
		for (int k = 0; k < POLISH; k++)
			newton_step(&f, residual(&f, p, at), &at);
		if (inside(at, SLACK) && settle(g, p, face, &f, at, limit, foot)) {
			limit = fabs(foot->height);
			found = true;
		}
	}
	return found;
}

/* Of the faces met the nearest is looked at next, until it is farther than the lowest foot may be. */
bool
mr_foot_search(const mr_ground *g, mr_v3 p, uint32_t face, mr_foot *foot)
{
	const double reach = 2; /* highest foot, in distances from the sheet */
	double near2 = INFINITY, limit = INFINITY;
	bool found = false;
	patch s;

	s.waiting = s.met = 0;
	memset(s.slot, 0xff, sizeof s.slot);
	meet(g, p, face, &s);
	while (s.waiting > 0 && s.queue[0].dist2 <= limit * limit) {
		near_face next;
		mr_queue_pop(s.queue, s.waiting--, sizeof next, &next, nearer);
		if (next.dist2 < near2) {
			near2 = next.dist2;
			face = next.face;
			limit = fmin(limit, reach * sqrt(near2) + g->tolerance);
		}
		if (foot_on_face(g, p, next.face, limit, foot)) {
			limit = fabs(foot->height);
			found = true;
		}
		meet_neighbours(g, p, next.face, &s);
	}
	if (found && fabs(foot->height) <= reach * sqrt(near2) + g->tolerance)
		return true;
	*foot = (mr_foot){ mr_face_closest(g->surface.m, face, p).at, 0 };
	return false;
}
