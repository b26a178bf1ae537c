/* Harm by a motion of a surface. */
#include "judge/judge.h"

#include "base/vectors.h"
#include "space/contact.h"

enum { LANES = 8 };

/* The diagonal of some faces, nearly the diagonal of all. */
static double
diagonal_of(const mr_mesh *m)
{
	enum { LOOKS = 1 << 14 };
	mr_box box = mr_box_empty();

	for (size_t f = 0; f < m->nf; f += 1 + m->nf / LOOKS)
		for (int k = 0; k < 3; k++)
			mr_box_add(&box, m->p[m->t[f].v[k]]);
	return mr_box_diagonal(box);
}

/* Some faces side by side, in cells: their first two sides, what each adds to a ring, and whether edges have
 * changed or it is wide. */
typedef struct lanes {
	float then[6][LANES], now[6][LANES];
	float normal[6][LANES];
	float longest2[LANES];
	float odd[LANES];
} lanes;

static MR_INLINED float
most(float a, float b)
{
	return a > b ? a : b;
}

/* The squared lengths of the sides, and the unit normal, or 0. */
static MR_INLINED void
measure_sides(float s[6][LANES], float normal[3][LANES], float length2[3], int i)
{
	float ax = s[0][i], ay = s[1][i], az = s[2][i], bx = s[3][i], by = s[4][i], bz = s[5][i];
	float cx = ax + bx, cy = ay + by, cz = az + bz;
	float nx = ay * bz - az * by, ny = az * bx - ax * bz, nz = ax * by - ay * bx;
	float size2 = nx * nx + ny * ny + nz * nz, scale = size2 > 0 ? 1 / sqrtf(size2) : 0;

	normal[0][i] = scale * nx;
	normal[1][i] = scale * ny;
	normal[2][i] = scale * nz;
	length2[0] = ax * ax + ay * ay + az * az;
	length2[1] = bx * bx + by * by + bz * bz;
	length2[2] = cx * cx + cy * cy + cz * cz;
}

/* Whether a length, of which this is the square, is more than twice or less than half of another. */
static bool
changes(double was, double is)
{
	const double much2 = 4;

	return is > much2 * was || was > much2 * is;
}

static MR_INLINED float
may_change(float was, float is)
{
	const float much2 = 3.9999f;

	return (is > much2 * was ? 1.0f : 0.0f) + (was > much2 * is ? 1.0f : 0.0f);
}

static MR_INLINED void
measure_lanes(lanes *s)
{
	for (int i = 0; i < LANES; i++) {
		float was[3], is[3];
		measure_sides(s->then, s->normal, was, i);
		measure_sides(s->now, s->normal + 3, is, i);
		s->longest2[i] = most(s->longest2[i], most(was[0], most(was[1], was[2])));
		s->odd[i] = may_change(was[0], is[0]) + may_change(was[1], is[1]) +
		            may_change(was[2], is[2]) +
		            (most(is[0], most(is[1], is[2])) > 0.9999f ? 1.0f : 0.0f);
	}
}

static MR_INLINED void
get_sides(const mr_v3 *p, const uint32_t v[3], double scale, float x[6][LANES], size_t lane)
{
	for (int k = 0; k < 2; k++) {
		mr_v3 side = mr_sub(p[v[k + 1]], p[v[k]]);
		x[3 * k][lane] = (float)(scale * side.x);
		x[3 * k + 1][lane] = (float)(scale * side.y);
		x[3 * k + 2][lane] = (float)(scale * side.z);
	}
}

/* Few faces are odd. */
static void
keep_odd(mr_motion *m, size_t f)
{
	const uint32_t *v = m->then->t[f].v;
	double widest2 = 0;

	for (uint32_t k = 0; k < 3; k++) {
		uint32_t a = v[k], b = v[(k + 1) % 3];
		double was = mr_norm2(mr_sub(m->then->p[b], m->then->p[a])),
		       is = mr_norm2(mr_sub(m->now[b], m->now[a]));
		if (changes(was, is) && a < b)
			m->changed[m->changes++] = 3 * (uint32_t)f + k;
		widest2 = fmax(widest2, is);
	}
	if (widest2 > m->cell * m->cell)
		m->wide[m->wides++] = (uint32_t)f;
}

static MR_INLINED mr_float4
one_normal(float n[3][LANES], size_t lane)
{
	return (mr_float4){ n[0][lane], n[1][lane], n[2][lane], 1 };
}

MR_VECTORS static void
look_at_faces(mr_motion *m)
{
	lanes s = { .longest2 = { 0 } };
	float longest2 = 0;
	double scale = m->cell > 0 ? 1 / m->cell : 0;

	for (size_t first = 0; first < m->then->nf; first += LANES) {
		size_t n = m->then->nf - first < LANES ? m->then->nf - first : LANES;
		for (size_t i = 0; i < LANES; i++) {
			const uint32_t *v = m->then->t[first + (i < n ? i : 0)].v;
			get_sides(m->then->p, v, scale, s.then, i);
			get_sides(m->now, v, scale, s.now, i);
		}
		measure_lanes(&s);
		for (size_t i = 0; i < n; i++) {
			const uint32_t *v = m->then->t[first + i].v;
			mr_float4 then = one_normal(s.normal, i), now = one_normal(s.normal + 3, i);
			for (int k = 0; k < 3; k++) {
				m->ring[v[k]].then += then;
				m->ring[v[k]].now += now;
			}
			if (s.odd[i] > 0)
				keep_odd(m, first + i);
		}
	}
	for (int i = 0; i < LANES; i++)
		longest2 = most(longest2, s.longest2[i]);
	m->longest = m->cell * sqrt((double)longest2);
}

mr_motion
mr_motion_of(mr_ctx *ctx, const mr_mesh *then, const mr_v3 *now)
{
	const double share = 0.005, vertices = 8;
	mr_motion m = { .then = then,
		.now = now,
		.diagonal = diagonal_of(then),
		.ring = MR_NEW_ZERO(ctx, then->nv, mr_ring),
		.changed = MR_NEW(ctx, 3 * then->nf, uint32_t),
		.wide = MR_NEW(ctx, then->nf, uint32_t) };

	m.cell = m.diagonal * fmax(share, sqrt(vertices / (double)then->nv));
	look_at_faces(&m);
	return m;
}

void
mr_motion_found(mr_ctx *ctx, const mr_motion *m, mr_finding f, uint32_t vertex)
{
	f.layer = m->then->name;
	f.placed = vertex != MR_NONE;
	f.vertex = vertex;
	if (f.placed)
		f.at = m->now[vertex];
	mr_found(ctx, &f);
}

/* Less says nothing, but of few faces. */
enum { FOLDS = 5, PAIRS = 20 };

static size_t
at_most(size_t a, size_t b)
{
	return a < b ? a : b;
}

bool
mr_harm_folds(const mr_harm *h, size_t nf)
{
	return h->folds > at_most(FOLDS, nf / 12);
}

bool
mr_harm_crosses(const mr_harm *h, size_t nf)
{
	return h->pairs > at_most(PAIRS, nf / 5);
}

void
mr_judge_harm(mr_ctx *ctx, const mr_motion *m)
{
	size_t nf = m->then->nf;
	mr_harm h;

	mr_harm_find(ctx, m, NULL, &h);
	if (mr_harm_folds(&h, nf))
		mr_motion_found(
		    ctx, m, (mr_finding){ .kind = MR_FOLDED, .count = h.folds, .of = 3 * nf / 2 }, h.vertex);
	if (mr_harm_crosses(&h, nf))
		mr_motion_found(
		    ctx, m, (mr_finding){ .kind = MR_CROSSING, .count = h.pairs, .of = nf }, h.vertex);
	if (h.far > PAIRS)
		mr_motion_found(
		    ctx, m, (mr_finding){ .kind = MR_COLLIDED, .count = h.far, .of = nf }, h.far_vertex);
}

void
mr_judge_contacts(mr_ctx *ctx, const mr_motion *m, bool *closed)
{
	mr_contacts contacts;
	uint32_t widest;
	size_t n;

	mr_contacts_find(ctx, m->then, MR_TOUCH * m->diagonal, &contacts);
	*closed = contacts.closed;
	if (!contacts.vertices)
		return;
	n = mr_contacts_open(&contacts, m->then, m->now, MR_APART_BY * m->diagonal, &widest);
	if (n)
		mr_motion_found(
		    ctx, m, (mr_finding){ .kind = MR_APART, .count = n, .of = contacts.vertices }, widest);
}
