/* The normal field of Phong shading (Phong 1975) and its frames. */
#include "edit/phong.h"

mr_v3
mr_phong_face_normal(const mr_phong *s, uint32_t face)
{
	mr_v3 n = mr_unit(mr_face_cross(s->m, face));

	return mr_norm2(n) > 0 ? n : mr_vec(0, 0, 1);
}

/* a without its part along the unit vector n, at unit length, zero where nothing is left. */
static mr_v3
tangent(mr_v3 a, mr_v3 n)
{
	mr_v3 unit = mr_unit(a), t = mr_axpy(-mr_dot(unit, n), n, unit);

	if (!(mr_norm2(t) > 1e-20))
		return mr_vec(0, 0, 0);
	t = mr_unit(t);
	return mr_unit(mr_axpy(-mr_dot(t, n), n, t));
}

mr_tangent_frame
mr_phong_frame(const mr_phong *s, mr_place at)
{
	const uint32_t *v = s->m->t[at.face].v;
	mr_v3 n = mr_phong_normal(s, at);
	mr_v3 t1 = tangent(mr_sub(s->m->p[v[1]], s->m->p[v[0]]), n);

	if (mr_norm2(t1) == 0) /* an edge of no length, or one along n: any tangent serves */
		t1 = tangent(fabs(n.x) < 0.7 ? mr_vec(1, 0, 0) : mr_vec(0, 1, 0), n);
	return (mr_tangent_frame){ n, t1, mr_cross(n, t1) };
}

/* a without its part along the unit vector n. */
static mr_v3
across(mr_v3 a, mr_v3 n)
{
	return mr_axpy(-mr_dot(a, n), n, a);
}

/* With a, b the edges across the normal, W a = c and W b = d what becomes of it along them: the eigenvalues
 * of W's symmetric part. */
double
mr_phong_curvature(const mr_phong *s, mr_place at)
{
	const uint32_t *v = s->m->t[at.face].v;
	mr_v3 raw = mr_bary_point(at.bary, s->normal[v[0]], s->normal[v[1]], s->normal[v[2]]),
	      n = mr_unit(raw);
	mr_v3 a = across(mr_sub(s->m->p[v[1]], s->m->p[v[0]]), n);
	mr_v3 b = across(mr_sub(s->m->p[v[2]], s->m->p[v[0]]), n);
	mr_v3 c = across(mr_sub(s->normal[v[1]], s->normal[v[0]]), n);
	mr_v3 d = across(mr_sub(s->normal[v[2]], s->normal[v[0]]), n);
	double length = mr_norm(raw), area = length * mr_dot(n, mr_cross(a, b));
	double half = (mr_dot(n, mr_cross(c, b)) + mr_dot(n, mr_cross(a, d))) / (2 * area);
	double skew = (mr_dot(a, d) - mr_dot(b, c)) / (2 * area);
	double det = mr_dot(n, mr_cross(c, d)) / (length * area);

	return area > 0 || area < 0 ? fabs(half) + sqrt(fmax(0, half * half + skew * skew - det)) : INFINITY;
}

/* ---- feet ---- */

/* The foot of a point by a walk over faces (Kobbelt, Vorsatz, Seidel 1999: Multiresolution hierarchies on
 * unstructured triangle meshes).  Over one face, with N = n0 + u m1 + v m2 not normalised and h = t |N|, p0 +
 * u e1 + v e2 + t (n0 + u m1 + v m2) = p is solved by Newton's method, with one 3x3 determinant a step. */
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

/* Writes the foot if the decoder will compute p from it, to the tolerance, and it is on the face: the last
 * step on a needle goes anywhere. */
static bool
settle(const mr_foot_ground *g, mr_v3 p, uint32_t face, const field *f, place at, double limit, mr_foot *foot)
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

/* The face at edge a-b with the lowest index, other than `face`; MR_NONE on the boundary. */
static uint32_t
neighbour(const mr_foot_ground *g, uint32_t face, uint32_t a, uint32_t b)
{
	for (size_t i = g->inc->start[a]; i < g->inc->start[a + 1]; i++) {
		uint32_t f = g->inc->face[i];
		const uint32_t *c = g->surface.m->t[f].v;
		if (f != face && (c[0] == b || c[1] == b || c[2] == b))
			return f;
	}
	return MR_NONE;
}

/* The way's first exit from the face: the corner opposite the edge, the share of the way. */
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

/* Cuts the way at the edge opposite `corner` and continues in the next face; false on the boundary. */
static bool
cross_edge(const mr_foot_ground *g, uint32_t *face, int corner, double share, place from, place *at)
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
mr_foot_walk(const mr_foot_ground *g, mr_v3 p, mr_place start, double limit, mr_foot *foot)
{
	enum { STEPS = 64, STUCK = 3 };
	uint32_t face = start.face;
	field f = field_of(&g->surface, face);
	place at = { start.bary.y, start.bary.z, 0 };
	mr_v3 r = residual(&f, p, at), n = normal_at(&f, at);
	int stuck = 0;

	at.t = mr_dot(r, n) / mr_norm2(n);
	for (int step = 0; step < STEPS && isfinite(at.t); step++) {
		place from = at;
		double det, share;
		int corner;

		det = newton_step(&f, residual(&f, p, at), &at);
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
