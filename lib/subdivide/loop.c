/* Loop 1987: Smooth subdivision surfaces based on triangles; Hoppe et al. 1994: Piecewise smooth surface
 * reconstruction, for creases and corners. */
#include "subdivide/loop.h"

#include "base/parallel.h"
#include "subdivide/loop_ring.h"

enum { GRAIN = 2048 };

/* Marks the half-edges on both sides of edges that bend by more than `crease` degrees, or are marked; NULL:
 * there is none. */
static void
find_creases(mr_ctx *ctx, const mr_mesh *m, const mr_topology *topo, double crease, const uint8_t *marked,
    const bool **out)
{
	mr_mark mark = mr_mark_take(ctx);
	bool *sharp = MR_NEW_ZERO(ctx, 3 * m->nf, bool), any = false;

	*out = NULL;
	for (uint32_t h = 0; h < 3 * m->nf; h++) {
		uint32_t g = topo->twin[h];
		if (g == MR_NONE || g < h)
			continue;
		double angle = mr_angle(mr_face_cross(m, h / 3), mr_face_cross(m, g / 3));
		sharp[h] = sharp[g] = angle * 180 / MR_PI > crease || (marked && (marked[h] || marked[g]));
		any |= sharp[h];
	}
	if (any)
		*out = sharp;
	else
		mr_mark_release(ctx, mark);
}

mr_status
mr_loop_control(mr_ctx *ctx, const mr_mesh *m, double crease, const uint8_t *mark, mr_loop *l)
{
	mr_loop r = { .nv = m->nv, .nf = m->nf, .t = m->t, .coarse_nv = m->nv };

	MR_TRY(mr_topology_build(ctx, m, &r.topo));
	if (crease < 180 || mark)
		find_creases(ctx, m, &r.topo, crease, mark, &r.crease);
	*l = r;
	return MR_OK;
}

/*
 * The four children of face f have the half-edges 12 f to 12 f + 11; the corners of the last, the one in the
 * middle, are the odd vertices of the face's edges.
 */
enum { PIECES = 1024 };

typedef struct refining {
	const mr_loop *coarse;
	mr_tri *t;
	mr_topology topo;
	bool *crease;
	uint32_t *edge;
	size_t piece;           /* half-edges in each */
	uint32_t first[PIECES]; /* edges in each piece, then its first edge */
} refining;

/* The half-edges on the fine level that half-edge h is cut into. */
static uint32_t
first_half(uint32_t h)
{
	return 12 * (h / 3) + 4 * (h % 3);
}

static uint32_t
second_half(uint32_t h)
{
	static const uint32_t second[3] = { 3, 7, 2 };

	return 12 * (h / 3) + second[h % 3];
}

/* Whether h is the half-edge by which its edge is counted. */
static bool
is_lower(const mr_loop *l, size_t h)
{
	return l->topo.twin[h] > h; /* MR_NONE too */
}

static void
count_edges(void *arg, size_t begin, size_t end)
{
	refining *r = arg;
	uint32_t n = 0;

	for (size_t h = begin; h < end; h++)
		n += is_lower(r->coarse, h);
	r->first[begin / r->piece] = n;
}

/* Counts the edges of each piece and of all. */
static size_t
scan_edges(const mr_ctx *ctx, refining *r)
{
	size_t half = 3 * r->coarse->nf, n = 0;

	r->piece = half / PIECES + 1 > GRAIN ? half / PIECES + 1 : GRAIN;
	mr_parallel(ctx, half, r->piece, count_edges, r);
	for (size_t i = 0; i * r->piece < half; i++) {
		uint32_t count = r->first[i];
		r->first[i] = (uint32_t)n;
		n += count;
	}
	return n;
}

/* Gives each edge its odd vertex, on the side of its lower half-edge. */
static void
number_edges(void *arg, size_t begin, size_t end)
{
	refining *r = arg;
	size_t n = r->first[begin / r->piece], nv = r->coarse->nv;

	for (size_t h = begin; h < end; h++) {
		if (!is_lower(r->coarse, h))
			continue;
		r->edge[n] = (uint32_t)h;
		r->t[4 * (h / 3) + 3].v[h % 3] = (uint32_t)(nv + n);
		r->topo.out[nv + n] = second_half((uint32_t)h);
		n++;
	}
}

/* Splits half-edge h, whose twin and odd vertex are known. */
static void
cut_edge(const refining *r, uint32_t h)
{
	uint32_t g = r->coarse->topo.twin[h], a = first_half(h), b = second_half(h);

	r->topo.twin[a] = g == MR_NONE ? g : second_half(g);
	r->topo.twin[b] = g == MR_NONE ? g : first_half(g);
	if (!is_lower(r->coarse, h)) /* the twin's, which number_edges has written */
		r->t[4 * (size_t)(h / 3) + 3].v[h % 3] = r->t[4 * (size_t)(g / 3) + 3].v[g % 3];
	if (r->crease)
		r->crease[a] = r->crease[b] = r->coarse->crease[h];
}

static void
cut_faces(void *arg, size_t begin, size_t end)
{
	static const uint32_t inner[3] = { 1, 5, 6 }, middle[3] = { 11, 9, 10 };
	refining *r = arg;

	for (size_t f = begin; f < end; f++) {
		const uint32_t *v = r->coarse->t[f].v;
		mr_tri *t = r->t + 4 * f;
		const uint32_t *odd = t[3].v; /* ab, bc, ca */
		uint32_t h = (uint32_t)(12 * f);

		for (uint32_t i = 0; i < 3; i++) {
			cut_edge(r, (uint32_t)(3 * f) + i);
			r->topo.twin[h + inner[i]] = h + middle[i];
			r->topo.twin[h + middle[i]] = h + inner[i];
			if (r->crease)
				r->crease[h + inner[i]] = r->crease[h + middle[i]] = false;
		}
		t[0] = (mr_tri){ { v[0], odd[0], odd[2] } };
		t[1] = (mr_tri){ { odd[0], v[1], odd[1] } };
		t[2] = (mr_tri){ { odd[2], odd[1], v[2] } };
	}
}

static void
leave_even(void *arg, size_t begin, size_t end)
{
	refining *r = arg;

	for (size_t v = begin; v < end; v++) {
		uint32_t h = r->coarse->topo.out[v];
		r->topo.out[v] = h == MR_NONE ? h : first_half(h);
	}
}

static void
number_odd(const mr_loop *coarse, uint32_t *edge, uint32_t *odd)
{
	uint32_t v = (uint32_t)coarse->nv;

	for (uint32_t h = 0; h < 3 * coarse->nf; h++) {
		if (is_lower(coarse, h)) {
			*edge++ = h;
			odd[h] = v++;
		} else {
			odd[h] = odd[coarse->topo.twin[h]];
		}
	}
}

void
mr_loop_refine_vertices(mr_ctx *ctx, const mr_loop *coarse, mr_loop *fine)
{
	size_t half = 3 * coarse->nf, nv = coarse->nv + (half + mr_loop_boundary(coarse)) / 2;
	uint32_t *edge = MR_NEW(ctx, nv - coarse->nv, uint32_t), *odd = MR_NEW(ctx, half, uint32_t);

	number_odd(coarse, edge, odd);
	*fine = (mr_loop){
		.nv = nv, .nf = 4 * coarse->nf, .coarse_nv = coarse->nv, .edge = edge, .odd = odd
	};
}

mr_status
mr_loop_refine(mr_ctx *ctx, const mr_loop *coarse, mr_loop *fine)
{
	refining r = { .coarse = coarse };
	size_t half = 3 * coarse->nf, nf = 4 * coarse->nf;
	size_t odd = scan_edges(ctx, &r), nv = coarse->nv + odd;

	if (3 * nf >= MR_NONE || nv >= MR_NONE)
		return mr_fail(ctx, MR_ERANGE, "%zu faces are too many to subdivide", coarse->nf);
	r.t = MR_NEW(ctx, nf, mr_tri);
	r.topo = (mr_topology){ MR_NEW(ctx, 3 * nf, uint32_t), MR_NEW(ctx, nv, uint32_t) };
	r.edge = MR_NEW(ctx, odd, uint32_t);
	r.crease = coarse->crease ? MR_NEW(ctx, 3 * nf, bool) : NULL;
	mr_parallel(ctx, half, r.piece, number_edges, &r);
	mr_parallel(ctx, coarse->nf, GRAIN, cut_faces, &r);
	mr_parallel(ctx, coarse->nv, GRAIN, leave_even, &r);
	*fine = (mr_loop){ nv, nf, r.t, r.topo, r.crease, coarse->nv, r.edge, NULL };
	return MR_OK;
}

size_t
mr_loop_boundary(const mr_loop *l)
{
	size_t n = 0;

	for (size_t h = 0; h < 3 * l->nf; h++)
		n += l->topo.twin[h] == MR_NONE;
	return n;
}

mr_status
mr_loop_levels(mr_ctx *ctx, const mr_mesh *m, double crease, const uint8_t *mark, size_t n, mr_loop *level)
{
	MR_TRY(mr_loop_control(ctx, m, crease, mark, &level[0]));
	if (mr_loop_count(m->nv, m->nf, mr_loop_boundary(&level[0]), n) == SIZE_MAX)
		return mr_fail(ctx, MR_ERANGE, "%s: level %zu of %zu faces is too large", m->name, n, m->nf);
	for (size_t i = 0; i < n; i++)
		MR_TRY(mr_loop_refine(ctx, &level[i], &level[i + 1]));
	return MR_OK;
}

size_t
mr_loop_count(size_t nv, size_t nf, size_t boundary, size_t n)
{
	for (; n; n--) {
		nv += (3 * nf + boundary) / 2;
		nf *= 4;
		boundary *= 2;
		if (nv >= MR_NONE || 3 * nf >= MR_NONE)
			return SIZE_MAX;
	}
	return nv;
}

void
mr_loop_corners(size_t n, size_t f, mr_v3 at[3])
{
	mr_v3 a = { 1, 0, 0 }, b = { 0, 1, 0 }, c = { 0, 0, 1 };

	while (n-- > 0) {
		mr_v3 ab = mr_lerp(0.5, a, b), bc = mr_lerp(0.5, b, c), ca = mr_lerp(0.5, c, a);
		size_t part = f >> 2 * n & 3;
		a = part == 0 ? a : part == 2 ? ca : ab;
		c = part == 1 ? bc : part == 2 ? c : ca;
		b = part == 1 ? b : part == 0 ? ab : bc;
	}
	at[0] = a, at[1] = b, at[2] = c;
}

typedef struct subdividing {
	const mr_loop *coarse, *fine;
	size_t width;
	const double *in;
	double *even, *odd;
} subdividing;

/* out = self in[v] + ring (the neighbours) + sharp (those over creases), the sums in the order of the ring.
 */
static inline void
even_row(const subdividing *s, uint32_t v, size_t width)
{
	const mr_loop *l = s->coarse;
	const double *x = s->in + width * v;
	mr_loop_mask mask = mr_loop_even_mask(mr_loop_kind_of(l, v));
	double *out = s->even + width * v;

	for (size_t k = 0; k < width; k++)
		out[k] = mask.self * x[k];
	if (mask.self == 1)
		return;
	for (mr_loop_ring r = mr_loop_ring_begin(l, v); r.more; mr_loop_ring_step(&r)) {
		double w = r.sharp ? mask.sharp : mask.ring;
		for (size_t k = 0; k < width && w != 0; k++)
			out[k] += w * s->in[width * r.to + k];
	}
}

static inline void
odd_row(const subdividing *s, size_t i, size_t width)
{
	const mr_loop *l = s->coarse;
	uint32_t h = s->fine->edge[i], g = l->topo.twin[h];
	const double *a = s->in + width * mr_loop_from(l, h), *b = s->in + width * mr_loop_to(l, h);
	double *out = s->odd + width * i;

	if (mr_loop_sharp(l, h)) {
		for (size_t k = 0; k < width; k++)
			out[k] = 0.5 * (a[k] + b[k]);
		return;
	}
	const double *c = s->in + width * mr_loop_opposite(l, h);
	const double *d = s->in + width * mr_loop_opposite(l, g);
	for (size_t k = 0; k < width; k++)
		out[k] = 0.375 * (a[k] + b[k]) + 0.125 * (c[k] + d[k]);
}

static void
even_rows(void *arg, size_t begin, size_t end)
{
	const subdividing *s = arg;

	for (size_t v = begin; v < end; v++)
		if (s->width == 3) /* known to the compiler, which unrolls */
			even_row(s, (uint32_t)v, 3);
		else
			even_row(s, (uint32_t)v, s->width);
}

static void
odd_rows(void *arg, size_t begin, size_t end)
{
	const subdividing *s = arg;

	for (size_t i = begin; i < end; i++)
		if (s->width == 3)
			odd_row(s, i, 3);
		else
			odd_row(s, i, s->width);
}

void
mr_loop_subdivide(const mr_ctx *ctx, const mr_loop *coarse, const mr_loop *fine, size_t width,
    const double *in, double *out)
{
	subdividing s = { coarse, fine, width, in, out, out + width * coarse->nv };

	mr_parallel(ctx, coarse->nv, GRAIN, even_rows, &s);
	mr_parallel(ctx, fine->nv - coarse->nv, GRAIN, odd_rows, &s);
}

/* To and fro between `out` and a workspace, so that the last level is in `out`. */
void
mr_loop_values(mr_ctx *ctx, const mr_loop *level, size_t n, size_t width, const double *in, double *out)
{
	MR_SCOPE(ctx);
	double *work = n > 1 ? mr_alloc(ctx, level[n - 1].nv, width * sizeof *work) : NULL;

	if (n == 0)
		memcpy(out, in, level[0].nv * width * sizeof *out);
	for (size_t i = 0; i < n; i++) {
		double *next = (n - i) % 2 ? out : work;
		mr_loop_subdivide(ctx, &level[i], &level[i + 1], width, in, next);
		in = next;
	}
}

void
mr_loop_predict(const mr_ctx *ctx, const mr_loop *coarse, const mr_loop *fine, size_t width, const double *in,
    double *out)
{
	subdividing s = { coarse, fine, width, in, NULL, out };

	mr_parallel(ctx, fine->nv - coarse->nv, GRAIN, odd_rows, &s);
}
