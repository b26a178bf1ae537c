/* Splits, collapses and flips of half-edges, and what they need to know of their surroundings. */
#include "mesh/dynmesh.h"

unsigned
mr_dyn_valence(const mr_dyn *d, uint32_t v, unsigned most)
{
	uint32_t h = d->out[v];
	unsigned n = 0;

	do {
		n++;
		h = mr_dyn_ccw(d, h);
	} while (h != MR_NONE && h != d->out[v] && n < most);
	return n < most ? n + (h == MR_NONE) : most;
}

unsigned
mr_dyn_along(const mr_dyn *d, uint32_t v, uint32_t end[2])
{
	uint32_t h = d->out[v];
	unsigned n = 0, most = d->kind[v] == MR_CURVE ? 2 : MR_NONE; /* a curve vertex has two */

	do {
		uint32_t p = mr_he_prev(h);
		if (mr_dyn_on_curve(d, h) && n++ < 2)
			end[n - 1] = mr_dyn_to(d, h);
		if (d->twin[p] == MR_NONE && n++ < 2)
			end[n - 1] = d->v[p];
		h = d->twin[p];
	} while (n < most && h != MR_NONE && h != d->out[v]);
	return n;
}

mr_v3
mr_dyn_normal_around(const mr_dyn *d, uint32_t v)
{
	uint32_t h = d->out[v];
	mr_v3 sum = { 0, 0, 0 };

	do {
		sum = mr_add(sum, mr_dyn_cross(d, d->p, h / 3));
		h = mr_dyn_ccw(d, h);
	} while (h != MR_NONE && h != d->out[v]);
	return sum;
}

mr_v3
mr_dyn_middle_around(const mr_dyn *d, uint32_t v)
{
	uint32_t h = d->out[v];
	mr_v3 sum = { 0, 0, 0 };
	double n = 0;

	do {
		sum = mr_add(sum, d->p[mr_dyn_to(d, h)]);
		n++;
		h = mr_dyn_ccw(d, h);
	} while (h != MR_NONE && h != d->out[v]);
	return mr_mul(1 / n, sum);
}

static void
link_twins(mr_dyn *d, uint32_t h, uint32_t g)
{
	if (h != MR_NONE)
		d->twin[h] = g;
	if (g != MR_NONE)
		d->twin[g] = h;
}

static void
add_vertex(mr_ctx *ctx, mr_dyn *d, uint32_t *v)
{
	if (d->free_v != MR_NONE) {
		*v = d->free_v;
		d->free_v = d->out[*v];
		return;
	}
	if (d->nv == d->room_v)
		mr_dyn_room_v(ctx, d, d->room_v + d->room_v / 2);
	*v = (uint32_t)d->nv++;
}

static mr_status
add_face(mr_ctx *ctx, mr_dyn *d, uint32_t *f)
{
	if (d->free_f != MR_NONE) {
		*f = d->free_f;
		d->free_f = d->twin[3 * *f];
		return MR_OK;
	}
	if (d->nf == d->room_f)
		MR_TRY(mr_dyn_room_f(ctx, d, d->room_f + d->room_f / 2));
	*f = (uint32_t)d->nf++;
	for (uint32_t h = 3 * *f; h < 3 * *f + 3 && d->curve; h++)
		d->curve[h] = MR_NONE;
	return MR_OK;
}

/* Puts h on a curve, or with MR_NONE on none. */
static void
set_curve(mr_dyn *d, uint32_t h, uint32_t curve)
{
	if (d->curve)
		d->curve[h] = curve;
}

/* Takes the curve of h, where it has one, on to k. */
static void
move_curve(mr_dyn *d, uint32_t h, uint32_t k)
{
	set_curve(d, k, mr_dyn_curve(d, h));
	set_curve(d, h, MR_NONE);
}

static void
remove_face(mr_dyn *d, uint32_t f)
{
	for (uint32_t k = 3 * f; k < 3 * f + 3; k++)
		set_curve(d, k, MR_NONE);
	d->v[3 * f] = MR_NONE;
	d->twin[3 * f] = d->free_f;
	d->free_f = f;
}

/* Cuts the face of h = a -> b at m: it becomes (a, m, c), and face f (m, b, c).  The caller links the halves
 * of h. */
static void
cut_face(mr_dyn *d, uint32_t h, uint32_t m, uint32_t f)
{
	uint32_t n = mr_he_next(h), b = d->v[n], c = d->v[mr_he_next(n)];
	uint32_t mb = 3 * f, bc = 3 * f + 1, cm = 3 * f + 2;

	set_curve(d, mb, mr_dyn_curve(d, h));
	move_curve(d, n, bc);
	d->v[mb] = m;
	d->v[bc] = b;
	d->v[cm] = c;
	link_twins(d, bc, d->twin[n]);
	d->v[n] = m;
	link_twins(d, n, cm);
	if (d->out[b] == n)
		d->out[b] = bc;
}

bool
mr_dyn_can_split(const mr_dyn *d, uint32_t h)
{
	uint32_t g = d->twin[h];

	return g == MR_NONE || mr_dyn_apex(d, g) != mr_dyn_apex(d, h);
}

mr_status
mr_dyn_split(mr_ctx *ctx, mr_dyn *d, uint32_t h, mr_v3 p, uint32_t *middle)
{
	uint32_t g = d->twin[h], a = d->v[h], m, f, e = MR_NONE;

	add_vertex(ctx, d, &m);
	MR_TRY(add_face(ctx, d, &f));
	if (g != MR_NONE)
		MR_TRY(add_face(ctx, d, &e));
	d->p[m] = p;
	d->kind[m] = mr_dyn_on_curve(d, h) ? MR_CURVE : MR_SMOOTH;
	d->at[m] = mr_dyn_on_curve(d, h) ? mr_dyn_curve(d, h) : mr_dyn_place(d, a);
	cut_face(d, h, m, f);
	d->out[m] = 3 * f;
	if (g == MR_NONE) {
		d->twin[3 * f] = MR_NONE;
	} else {
		cut_face(d, g, m, e); /* g = b -> a becomes b -> m, and 3 e is m -> a */
		link_twins(d, 3 * f, g);
		link_twins(d, h, 3 * e);
	}
	*middle = m;
	return MR_OK;
}

/* Marks the neighbours of v, or with 0 takes the marks back. */
static void
mark_ring(const mr_dyn *d, uint32_t v, uint8_t *mark, uint8_t as)
{
	uint32_t h = d->out[v];

	do {
		mark[mr_dyn_to(d, h)] = as;
		mark[mr_dyn_apex(d, h)] = as;
		h = mr_dyn_ccw(d, h);
	} while (h != MR_NONE && h != d->out[v]);
}

static unsigned
count_marked(const mr_dyn *d, uint32_t v, const uint8_t *mark)
{
	uint32_t h = d->out[v];
	unsigned n = 0;

	do {
		n += mark[mr_dyn_to(d, h)];
		if (mr_dyn_ccw(d, h) == MR_NONE)
			n += mark[mr_dyn_apex(d, h)];
		h = mr_dyn_ccw(d, h);
	} while (h != MR_NONE && h != d->out[v]);
	return n;
}

/* True where inner vertex v has more than three edges. */
static bool
has_four(const mr_dyn *d, uint32_t v)
{
	uint32_t h = d->out[v];

	for (int i = 0; i < 3; i++) {
		h = mr_dyn_ccw(d, h);
		if (h == d->out[v])
			return false;
	}
	return true;
}

/* True where removing the face of h leaves its apex with enough faces. */
static bool
apex_can_lose(const mr_dyn *d, uint32_t h)
{
	uint32_t c = mr_dyn_apex(d, h);
	bool left = d->twin[mr_he_next(h)] != MR_NONE, right = d->twin[mr_he_prev(h)] != MR_NONE;

	return (left || right) && (mr_dyn_on_boundary(d, c) || has_four(d, c));
}

/* True where both other sides of h's face are on curves. */
static bool
between_curves(const mr_dyn *d, uint32_t h)
{
	return mr_dyn_on_curve(d, mr_he_next(h)) && mr_dyn_on_curve(d, mr_he_prev(h));
}

/* The link condition (Dey et al. 1999): the ends share just the apexes of the edge's faces. */
bool
mr_dyn_can_collapse(const mr_dyn *d, uint32_t h, uint8_t *mark)
{
	uint32_t g = d->twin[h], a = d->v[h], b = mr_dyn_to(d, h);
	unsigned shared;

	if (d->kind[a] >= MR_CORNER || (d->kind[a] == MR_CURVE && !mr_dyn_on_curve(d, h)))
		return false;
	if (g != MR_NONE && mr_dyn_on_boundary(d, a) && mr_dyn_on_boundary(d, b))
		return false;
	if (!apex_can_lose(d, h) || (g != MR_NONE && !apex_can_lose(d, g)))
		return false;
	/* Two curve edges would fall into one. */
	if (between_curves(d, h) || (g != MR_NONE && between_curves(d, g)))
		return false;
	mark_ring(d, a, mark, 1);
	shared = count_marked(d, b, mark);
	mark_ring(d, a, mark, 0);
	return shared == (g == MR_NONE ? 1 : 2);
}

static void
keep_out(mr_dyn *d, uint32_t v, uint32_t h)
{
	uint32_t g = h;

	while (d->twin[g] != MR_NONE) {
		g = mr_he_next(d->twin[g]);
		if (g == h)
			break;
	}
	d->out[v] = g;
}

/* Takes out the face of h = a -> b, closing it: b-c and c-a become one edge. */
static void
close_face(mr_dyn *d, uint32_t h)
{
	uint32_t n = mr_he_next(h), p = mr_he_prev(h), f = h / 3, c = d->v[p];
	uint32_t cb = d->twin[n], ac = d->twin[p];

	link_twins(d, cb, ac);
	if (cb != MR_NONE && mr_dyn_on_curve(d, p))
		set_curve(d, cb, mr_dyn_curve(d, p));
	if (ac != MR_NONE && mr_dyn_on_curve(d, n))
		set_curve(d, ac, mr_dyn_curve(d, n));
	if (d->out[c] == p)
		d->out[c] = cb;
	remove_face(d, f);
}

void
mr_dyn_collapse(mr_dyn *d, uint32_t h, mr_v3 p)
{
	uint32_t g = d->twin[h], a = d->v[h], b = mr_dyn_to(d, h);
	uint32_t cb = d->twin[mr_he_next(h)], ac = d->twin[mr_he_prev(h)];
	uint32_t e = d->out[a];

	do {
		d->v[e] = b;
		e = mr_dyn_ccw(d, e);
	} while (e != MR_NONE && e != d->out[a]);
	close_face(d, h);
	if (g != MR_NONE)
		close_face(d, g);
	keep_out(d, b, ac != MR_NONE ? ac : mr_he_next(cb));
	d->p[b] = p;
	d->kind[a] = MR_DEAD;
	d->out[a] = d->free_v;
	d->free_v = a;
}

bool
mr_dyn_can_flip(const mr_dyn *d, uint32_t h)
{
	uint32_t g = d->twin[h], c, other, e;

	if (g == MR_NONE || mr_dyn_on_curve(d, h))
		return false;
	c = mr_dyn_apex(d, h);
	other = mr_dyn_apex(d, g);
	if (c == other)
		return false;
	e = d->out[c];
	do {
		if (mr_dyn_to(d, e) == other || mr_dyn_apex(d, e) == other)
			return false;
		e = mr_dyn_ccw(d, e);
	} while (e != MR_NONE && e != d->out[c]);
	return true;
}

void
mr_dyn_flip(mr_dyn *d, uint32_t h)
{
	/* Faces (a b c) and (b a e) become (a e c) and (b c e). */
	uint32_t g = d->twin[h], hn = mr_he_next(h), gn = mr_he_next(g);
	uint32_t a = d->v[h], b = d->v[g], c = mr_dyn_apex(d, h), e = mr_dyn_apex(d, g);

	move_curve(d, gn, h);
	move_curve(d, hn, g);
	d->v[hn] = e;
	d->v[gn] = c;
	link_twins(d, h, d->twin[gn]);
	link_twins(d, g, d->twin[hn]);
	link_twins(d, hn, gn);
	if (d->out[b] == hn)
		d->out[b] = g;
	if (d->out[a] == gn)
		d->out[a] = h;
}
