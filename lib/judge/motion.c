/* What a motion did to a surface. */
#include "judge/judge.h"

#include "base/vectors.h"
#include "space/contact.h"

enum { LANES = 8 };

/* The diagonal of some faces, nearly that of all. */
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

/* Some faces side by side: the coordinates of their corners, what each adds to a ring, and whether edges have
 * changed (bits 1, 2, 4) or it is wide (8). */
typedef struct lanes {
	double then[9][LANES], now[9][LANES];
	double normal[6][LANES];
	double longest2[LANES];
	double odd[LANES];
} lanes;

static MR_INLINED mr_v3
side(double p[9][LANES], int a, int b, int lane)
{
	return mr_vec(p[3 * b][lane] - p[3 * a][lane], p[3 * b + 1][lane] - p[3 * a + 1][lane],
	    p[3 * b + 2][lane] - p[3 * a + 2][lane]);
}

/* The unit normal between two sides, or 0. */
static MR_INLINED void
put_normal(mr_v3 a, mr_v3 b, double normal[3][LANES], int lane)
{
	mr_v3 n = mr_cross(a, b);
	double size2 = mr_norm2(n), scale = size2 > 0 ? 1 / sqrt(size2) : 0;

	normal[0][lane] = scale * n.x;
	normal[1][lane] = scale * n.y;
	normal[2][lane] = scale * n.z;
}

static MR_INLINED double
most(double a, double b)
{
	return a > b ? a : b;
}

/* Whether a length, of which this is the square, is more than twice or less than half of another. */
static MR_INLINED double
changes(double was, double is)
{
	const double much2 = 4;

	return (is > much2 * was ? 1 : 0) + (was > much2 * is ? 1 : 0);
}

static MR_INLINED void
measure_lanes(lanes *s, double cell2)
{
	for (int i = 0; i < LANES; i++) {
		mr_v3 a = side(s->then, 0, 1, i), b = side(s->then, 1, 2, i), c = side(s->then, 2, 0, i);
		mr_v3 d = side(s->now, 0, 1, i), e = side(s->now, 1, 2, i), f = side(s->now, 2, 0, i);
		double a2 = mr_norm2(a), b2 = mr_norm2(b), c2 = mr_norm2(c);
		double d2 = mr_norm2(d), e2 = mr_norm2(e), f2 = mr_norm2(f);
		put_normal(a, b, s->normal, i);
		put_normal(d, e, s->normal + 3, i);
		s->longest2[i] = most(s->longest2[i], most(a2, most(b2, c2)));
		s->odd[i] = changes(a2, d2) + changes(b2, e2) + changes(c2, f2) +
		            (most(d2, most(e2, f2)) > cell2 ? 1 : 0);
	}
}

static MR_INLINED void
get_corners(const mr_v3 *p, const uint32_t v[3], double x[9][LANES], size_t lane)
{
	for (int k = 0; k < 3; k++) {
		mr_v3 at = p[v[k]];
		x[3 * k][lane] = at.x;
		x[3 * k + 1][lane] = at.y;
		x[3 * k + 2][lane] = at.z;
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
		if (changes(was, is) > 0 && a < b)
			m->changed[m->changes++] = 3 * (uint32_t)f + k;
		widest2 = fmax(widest2, is);
	}
	if (widest2 > m->cell * m->cell)
		m->wide[m->wides++] = (uint32_t)f;
}

static MR_INLINED mr_float4
one_normal(double n[3][LANES], size_t lane)
{
	return (mr_float4){ (float)n[0][lane], (float)n[1][lane], (float)n[2][lane], 1 };
}

MR_VECTORS static void
look_at_faces(mr_motion *m)
{
	lanes s = { .longest2 = { 0 } };
	double longest2 = 0;

	for (size_t first = 0; first < m->then->nf; first += LANES) {
		size_t n = m->then->nf - first < LANES ? m->then->nf - first : LANES;
		for (size_t i = 0; i < LANES; i++) {
			const uint32_t *v = m->then->t[first + (i < n ? i : 0)].v;
			get_corners(m->then->p, v, s.then, i);
			get_corners(m->now, v, s.now, i);
		}
		measure_lanes(&s, m->cell * m->cell);
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
		longest2 = fmax(longest2, s.longest2[i]);
	m->longest = sqrt(longest2);
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

static size_t
at_most(size_t a, size_t b)
{
	return a < b ? a : b;
}

void
mr_judge_harm(mr_ctx *ctx, const mr_motion *m)
{
	enum { FOLDS = 5, PAIRS = 20 }; /* fewer say nothing, but of few faces */
	size_t nf = m->then->nf;
	mr_harm h;

	mr_harm_find(ctx, m, &h);
	if (h.folds > at_most(FOLDS, nf / 12))
		mr_motion_found(
		    ctx, m, (mr_finding){ .kind = MR_FOLDED, .count = h.folds, .of = 3 * nf / 2 }, h.vertex);
	if (h.pairs > at_most(PAIRS, nf / 5))
		mr_motion_found(
		    ctx, m, (mr_finding){ .kind = MR_CROSSING, .count = h.pairs, .of = nf }, h.vertex);
	if (h.far > PAIRS)
		mr_motion_found(
		    ctx, m, (mr_finding){ .kind = MR_COLLIDED, .count = h.far, .of = nf }, h.far_vertex);
}

void
mr_judge_contacts(mr_ctx *ctx, const mr_motion *m, bool *closed)
{
	const double touch = 0.003, apart = 0.005; /* of the diagonal */
	mr_contacts contacts;
	uint32_t widest;
	size_t n;

	mr_contacts_find(ctx, m->then, touch * m->diagonal, &contacts);
	*closed = contacts.closed;
	if (!contacts.vertices)
		return;
	n = mr_contacts_open(&contacts, m->then, m->now, apart * m->diagonal, &widest);
	if (n)
		mr_motion_found(
		    ctx, m, (mr_finding){ .kind = MR_APART, .count = n, .of = contacts.vertices }, widest);
}
