/*
 * Limit points and normals from the eigenvectors of the local subdivision matrix (Loop 1987; Hoppe et al.
 * 1994; Biermann, Levin, Zorin 2000), which at a sector between sharp edges are sines of the number of the
 * neighbour: their formulas stand beside the lines that compute them.
 */
#include "base/parallel.h"
#include "subdivide/loop_ring.h"

enum { GRAIN = 2048 };

typedef struct limiting {
	const mr_loop *l;
	const mr_v3 *p;
	mr_v3 *limit, *normal;
} limiting;

static mr_v3
limit_point(const limiting *s, uint32_t v, mr_loop_kind kind)
{
	mr_loop_mask mask = mr_loop_limit_mask(kind);
	mr_v3 sum;

	sum = mr_mul(mask.self, s->p[v]);
	if (mask.self == 1)
		return sum;
	for (mr_loop_ring r = mr_loop_ring_begin(s->l, v); r.more; mr_loop_ring_step(&r)) {
		double w = r.sharp ? mask.sharp : mask.ring;
		if (w != 0)
			sum = mr_axpy(w, s->p[r.to], sum);
	}
	return sum;
}

/* The unit normal of two tangents; zero where they are parallel, but for rounding. */
static mr_v3
normal_of(mr_v3 a, mr_v3 b)
{
	mr_v3 n = mr_cross(a, b);

	return mr_norm(n) > 1e-12 * mr_norm(a) * mr_norm(b) ? mr_unit(n) : mr_vec(0, 0, 0);
}

/* Tangents sum_j cos(2 pi j / n) w_j and sum_j sin(2 pi j / n) w_j. */
static mr_v3
smooth_normal(const limiting *s, uint32_t v, unsigned n)
{
	double angle = 2 * MR_PI / n, c = 1, d = 0;
	double c1 = cos(angle), d1 = sin(angle);
	mr_v3 a = { 0, 0, 0 }, b = a, at = s->p[v];

	for (mr_loop_ring r = mr_loop_ring_begin(s->l, v); r.more; mr_loop_ring_step(&r)) {
		mr_v3 w = mr_sub(s->p[r.to], at);
		double turned = c * c1 - d * d1;
		a = mr_axpy(c, w, a);
		b = mr_axpy(d, w, b);
		d = c * d1 + d * c1;
		c = turned;
	}
	return normal_of(a, b);
}

/* A sector's neighbours w_0 to w_k relative to the vertex, in the sums that its tangents need. */
typedef struct sector {
	unsigned k;        /* faces */
	mr_v3 first, last; /* w_0, w_k */
	mr_v3 first_sine;  /* sum over the others of sin(i pi / k) w_i */
	mr_v3 second_sine; /* sum of sin(2 i pi / k) w_i */
} sector;

static unsigned
sector_faces(const mr_loop *l, uint32_t spoke)
{
	mr_loop_ring r = mr_loop_ring_from(l, spoke);
	unsigned k = 0;

	do {
		mr_loop_ring_step(&r);
		k++;
	} while (r.more && !r.sharp);
	return k;
}

/* The sector that begins at *spoke, which moves on to the next one; MR_NONE at the boundary. */
static sector
sector_read(const limiting *s, uint32_t v, uint32_t *spoke)
{
	sector c = { .k = sector_faces(s->l, *spoke) };
	mr_loop_ring r = mr_loop_ring_from(s->l, *spoke);
	mr_v3 at = s->p[v];

	c.first = mr_sub(s->p[r.to], at);
	for (unsigned i = 1; i < c.k; i++) {
		double x = MR_PI * i / c.k;
		mr_loop_ring_step(&r);
		mr_v3 w = mr_sub(s->p[r.to], at);
		c.first_sine = mr_axpy(sin(x), w, c.first_sine);
		c.second_sine = mr_axpy(sin(2 * x), w, c.second_sine);
	}
	mr_loop_ring_step(&r);
	c.last = mr_sub(s->p[r.to], at); /* once around that is the first again */
	*spoke = r.h;
	return c;
}

/*
 * The antisymmetric tangent: along the curve, of eigenvalue 1/2; where more than six faces meet the second
 * sine, of 3/8 + cos(2 pi / k) / 4, is larger.
 */
static mr_v3
tangent_along(const sector *c)
{
	mr_v3 chord = mr_sub(c->first, c->last);
	double x = 2 * MR_PI / c->k;

	return c->k <= 6 ? chord : mr_axpy(sin(x) / (2 * cos(x) - 1), chord, c->second_sine);
}

/* The symmetric tangent at a vertex of a smooth curve, of eigenvalue 3/8 + cos(x) / 4, x = pi / k; with one
 * face the curve's own second difference, of 1/4. */
static mr_v3
tangent_across(const sector *c)
{
	mr_v3 sum = mr_add(c->first, c->last);
	double x = MR_PI / c->k;

	if (c->k == 1)
		return sum;
	return mr_axpy(-sin(x) * cos(x) / ((1 - cos(x)) * (1 + 2 * cos(x))), sum, c->first_sine);
}

/* The same at a corner, where the two edges have eigenvalue 1/2, which up to three faces is the largest. */
static mr_v3
tangent_into(const sector *c)
{
	mr_v3 sum = mr_add(c->first, c->last);
	double x = MR_PI / c->k;

	if (c->k <= 3)
		return sum;
	return mr_axpy(sin(x) / (2 * cos(x) - 1), sum, c->first_sine);
}

static mr_v3
sector_normal(const sector *c, mr_loop_shape shape)
{
	mr_v3 along = tangent_along(c), n;

	if (shape == MR_LOOP_CREASE)
		return normal_of(along, tangent_across(c));
	n = normal_of(along, tangent_into(c));
	return mr_norm2(n) > 0 ? n : normal_of(along, c->first_sine); /* the two edges are in line */
}

/* On a crease and at a corner the unit sum of the normals of the sectors. */
static mr_v3
sharp_normal(const limiting *s, uint32_t v, mr_loop_shape shape)
{
	uint32_t start = mr_loop_sharp_spoke(s->l, v), spoke = start;
	mr_v3 sum = { 0, 0, 0 };

	do {
		sector c = sector_read(s, v, &spoke);
		sum = mr_add(sum, sector_normal(&c, shape));
	} while (spoke != MR_NONE && spoke != start);
	return mr_unit(sum);
}

static mr_v3
limit_normal(const limiting *s, uint32_t v, mr_loop_kind kind)
{
	switch (kind.shape) {
	case MR_LOOP_SMOOTH:
		return smooth_normal(s, v, kind.valence);
	case MR_LOOP_CREASE:
	case MR_LOOP_CORNER:
		return sharp_normal(s, v, kind.shape);
	default:
		return mr_vec(0, 0, 0);
	}
}

/* Six neighbours and no sharp edge, as most vertices have. */
static bool
regular_ring(const mr_loop *l, uint32_t v, uint32_t to[6])
{
	uint32_t start = l->topo.out[v], h = start;
	unsigned n = 0;

	if (l->crease || start == MR_NONE)
		return false;
	do {
		uint32_t before = mr_he_prev(h);
		to[n++] = mr_loop_to(l, h);
		h = l->topo.twin[before];
	} while (n < 6 && h != start && h != MR_NONE);
	return n == 6 && h == start;
}

/* The masks of valence 6 in numbers: chi = 1 / 12, cosines +-1 and +-1/2, sines 0 and +-sqrt(3) / 2. */
static void
regular_limit(const limiting *s, uint32_t v, const uint32_t to[6])
{
	mr_v3 at = s->p[v], w[6], sum, a, b;

	for (int j = 0; j < 6; j++)
		w[j] = mr_sub(s->p[to[j]], at);
	if (s->limit) {
		sum = mr_add(mr_add(mr_add(w[0], w[1]), mr_add(w[2], w[3])), mr_add(w[4], w[5]));
		s->limit[v] = mr_axpy(1.0 / 12, sum, at);
	}
	if (s->normal) {
		a = mr_axpy(0.5, mr_sub(mr_add(w[1], w[5]), mr_add(w[2], w[4])), mr_sub(w[0], w[3]));
		b = mr_sub(mr_add(w[1], w[2]), mr_add(w[4], w[5])); /* its factor only scales the normal */
		s->normal[v] = normal_of(a, b);
	}
}

static void
limit_rows(void *arg, size_t begin, size_t end)
{
	const limiting *s = arg;
	uint32_t to[6];

	for (size_t i = begin; i < end; i++) {
		uint32_t v = (uint32_t)i;
		if (regular_ring(s->l, v, to)) {
			regular_limit(s, v, to);
			continue;
		}
		mr_loop_kind kind = mr_loop_kind_of(s->l, v);
		if (s->limit)
			s->limit[v] = limit_point(s, v, kind);
		if (s->normal)
			s->normal[v] = limit_normal(s, v, kind);
	}
}

void
mr_loop_limit(const mr_ctx *ctx, const mr_loop *l, const mr_v3 *p, mr_v3 *limit, mr_v3 *normal)
{
	mr_parallel(ctx, l->nv, GRAIN, limit_rows, &(limiting){ l, p, limit, normal });
}
