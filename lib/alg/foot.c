#include "alg/foot.h"

#include "mesh/bvh.h"

/*
 * Over one face, with N = n0 + u m1 + v m2 not normalised and h = t |N|, the
 * equation is
 *
 *	p0 + u e1 + v e2 + t (n0 + u m1 + v m2) = p,
 *
 * linear in each of u, v, t: Newton's method in all three needs one 3x3
 * determinant a step, and eliminating u, v leaves a cubic in t.
 */
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

/* Writes the foot where what the decoder will compute from it is p, to the tolerance. */
static bool
settle(const mr_ground *g, mr_v3 p, uint32_t face, const field *f, place at, double limit, mr_foot *foot)
{
	mr_foot r = { face, bary_of(at), at.t * mr_norm(normal_at(f, at)) };
	mr_v3 b = mr_phong_point(&g->surface, face, r.bary);
	mr_v3 n = mr_phong_normal(&g->surface, face, r.bary);

	if (!(fabs(r.height) <= limit) || !(mr_dist(mr_axpy(r.height, n, b), p) <= g->tolerance))
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
mr_foot_walk(
    const mr_ground *g, mr_v3 p, uint32_t face, mr_v3 bary, double limit, mr_foot *foot, mr_walk *walk)
{
	enum { STEPS = 64, STUCK = 3 };
	field f = field_of(&g->surface, face);
	place at = { bary.y, bary.z, 0 };
	mr_v3 r = residual(&f, p, at), n = normal_at(&f, at);
	int stuck = 0;

	at.t = mr_dot(r, n) / mr_norm2(n);
	for (int step = 0; step < STEPS && isfinite(at.t); step++) {
		place from = at;
		double det, share;
		int corner;

		r = residual(&f, p, at);
		det = newton_step(&f, r, &at);
		walk->steps++;
		corner = first_exit(from, at, &share);
		if (corner >= 0) {
			walk->crossed++;
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

/* A part of the surface: faces in the order in which they were reached, until they are sorted. */
enum { PATCH = 4096 };

typedef struct near_face {
	double dist2; /* squared distance from the point */
	uint32_t face;
} near_face;

typedef struct patch {
	size_t n, met;
	near_face face[PATCH];
	uint32_t slot[2 * PATCH]; /* hash table of the faces met, kept or not: no more than half full */
} patch;

/* Enters the face into the table; false where it is there already, or the table has its fill. */
static bool
meet(patch *s, uint32_t face)
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

static mr_closest
closest_on(const mr_ground *g, uint32_t face, mr_v3 p)
{
	const uint32_t *v = g->surface.m->t[face].v;
	const mr_v3 *x = g->surface.m->p;

	return mr_triangle_closest(p, x[v[0]], x[v[1]], x[v[2]]);
}

static void
take(const mr_ground *g, mr_v3 p, uint32_t face, double radius, patch *s)
{
	double dist2;

	if (!meet(s, face))
		return;
	dist2 = closest_on(g, face, p).dist2;
	if (s->n > 0 && !(dist2 <= radius * radius))
		return;
	s->face[s->n++] = (near_face){ dist2, face };
}

static int
nearer(const void *a, const void *b)
{
	const near_face *x = a, *y = b;

	return x->dist2 != y->dist2 ? (x->dist2 > y->dist2) - (x->dist2 < y->dist2)
	                            : (x->face > y->face) - (x->face < y->face);
}

/* The faces that hang together with `face` inside the ball of `radius` around p, nearest first. */
static void
flood(const mr_ground *g, mr_v3 p, uint32_t face, double radius, patch *s)
{
	s->n = s->met = 0;
	memset(s->slot, 0xff, sizeof s->slot);
	take(g, p, face, radius, s);
	for (size_t next = 0; next < s->n; next++)
		for (int k = 0; k < 3; k++) {
			uint32_t v = g->surface.m->t[s->face[next].face].v[k];
			for (size_t i = g->inc->start[v]; i < g->inc->start[v + 1]; i++)
				take(g, p, g->inc->face[i], radius, s);
		}
	qsort(s->face, s->n, sizeof *s->face, nearer);
}

static double
cubic_at(const double c[4], double t)
{
	return c[0] + t * (c[1] + t * (c[2] + t * c[3]));
}

/* The root in [a, b], where the cubic is monotonic; false where it has none. */
static bool
root_between(const double c[4], double a, double b, double *root)
{
	double fa = cubic_at(c, a), fb = cubic_at(c, b);

	if ((fa > 0) == (fb > 0) && fa != 0 && fb != 0)
		return false;
	for (int i = 0; i < 50; i++) {
		double t = 0.5 * (a + b), ft = cubic_at(c, t);
		if ((ft > 0) == (fa > 0))
			a = t;
		else
			b = t;
	}
	*root = 0.5 * (a + b);
	return true;
}

/* The roots in [-reach, reach], at most three. */
static int
cubic_roots(const double c[4], double reach, double root[3])
{
	double cut[4] = { -reach, reach, reach, reach };
	double half = c[2], disc = half * half - 3 * c[3] * c[1]; /* of 3 c3 t^2 + 2 c2 t + c1 */
	int n = 0;

	if (disc > 0) {
		double q = -(half + copysign(sqrt(disc), half)), t1 = q / (3 * c[3]), t2 = c[1] / q;
		cut[1] = fmax(-reach, fmin(reach, fmin(t1, t2)));
		cut[2] = fmax(-reach, fmin(reach, fmax(t1, t2)));
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

/* The lowest foot of p on one face, not higher than limit. */
static bool
foot_on_face(const mr_ground *g, mr_v3 p, uint32_t face, double limit, mr_foot *foot)
{
	enum { POLISH = 4 };
	const double rough = 1e-3, shortest = 0.25; /* shortest |N| that is looked at: t = h / |N| */
	field f = field_of(&g->surface, face);
	mr_v3 q = mr_sub(p, f.p0), c0 = mr_cross(f.e1, f.e2), c2 = mr_cross(f.m1, f.m2);
	mr_v3 c1 = mr_add(mr_cross(f.e1, f.m2), mr_cross(f.m1, f.e2));
	/* det(e1 + t m1, e2 + t m2, q - t n0) = 0 */
	double cubic[4] = { mr_dot(c0, q), mr_dot(c1, q) - mr_dot(c0, f.n0), mr_dot(c2, q) - mr_dot(c1, f.n0),
		-mr_dot(c2, f.n0) };
	double root[3];
	int n = cubic_roots(cubic, limit / shortest, root);
	bool found = false;

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

bool
mr_foot_search(const mr_ground *g, mr_v3 p, uint32_t face, mr_foot *foot)
{
	const double reach = 2; /* highest foot, in distances from the sheet */
	mr_closest near;
	double limit;
	bool found = false;
	patch s;

	flood(g, p, face, sqrt(closest_on(g, face, p).dist2), &s);
	face = s.face[0].face;
	near = closest_on(g, face, p);
	*foot = (mr_foot){ face, near.bary, 0 };
	limit = reach * sqrt(near.dist2) + g->tolerance;
	flood(g, p, face, limit, &s);
	for (size_t i = 0; i < s.n && s.face[i].dist2 <= limit * limit; i++)
		if (foot_on_face(g, p, s.face[i].face, limit, foot)) {
			limit = fabs(foot->height);
			found = true;
		}
	return found;
}
