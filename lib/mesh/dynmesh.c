/* Splits, collapses and flips of half-edges, and their tests of the surroundings. */
#include "mesh/dynmesh.h"

#include "base/parallel.h"
#include "mesh/zorder.h"

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
room_for_vertices(mr_ctx *ctx, mr_dyn *d, size_t room)
{
	mr_v3 *p = mr_grow(ctx, d->p, d->nv, room, sizeof *p);
	uint32_t *out = mr_grow(ctx, d->out, d->nv, room, sizeof *out);
	uint32_t *at = mr_grow(ctx, d->at, d->nv, room, sizeof *at);
	uint8_t *kind = mr_grow(ctx, d->kind, d->nv, room, sizeof *kind);

	d->p = p;
	d->out = out;
	d->at = at;
	d->kind = kind;
	if (d->block)
		d->block = mr_grow(ctx, d->block, d->nv, room, sizeof *d->block);
	d->room_v = room;
}

static mr_status
room_for_faces(mr_ctx *ctx, mr_dyn *d, size_t room)
{
	uint32_t *v = mr_grow(ctx, d->v, 3 * d->nf, 3 * room, sizeof *v);
	uint32_t *twin = mr_grow(ctx, d->twin, 3 * d->nf, 3 * room, sizeof *twin);

	if (room > (MR_NONE - 1) / 3)
		return mr_fail(
		    ctx, MR_ERANGE, "remeshing would take more than %zu faces", (size_t)(MR_NONE - 1) / 6);
	d->v = v;
	d->twin = twin;
	if (d->curve)
		d->curve = mr_grow(ctx, d->curve, 3 * d->nf, 3 * room, sizeof *d->curve);
	d->room_f = room;
	return MR_OK;
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
		room_for_vertices(ctx, d, d->room_v + d->room_v / 2);
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
		MR_TRY(room_for_faces(ctx, d, d->room_f + d->room_f / 2));
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

static void
remove_vertex(mr_dyn *d, uint32_t v)
{
	d->kind[v] = MR_DEAD;
	d->out[v] = d->free_v;
	d->free_v = v;
}

/* Cuts the face of h = a -> b at m to (a, m, c) and face f = (m, b, c); the caller links the halves of h. */
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
	if (d->block)
		d->block[m] = d->block[a];
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

mr_status
mr_dyn_reserve(mr_ctx *ctx, mr_dyn *d, size_t splits)
{
	if (d->room_v - d->nv < splits)
		room_for_vertices(ctx, d, d->nv + splits);
	return d->room_f - d->nf < 2 * splits ? room_for_faces(ctx, d, d->nf + 2 * splits) : MR_OK;
}

void
mr_dyn_lend(mr_dyn *d, size_t splits, mr_dyn *part)
{
	*part = *d;
	part->free_v = part->free_f = MR_NONE;
	part->room_v = d->nv += splits;
	part->room_f = d->nf += 2 * splits;
}

void
mr_dyn_take_back(mr_dyn *d, mr_dyn *part)
{
	for (uint32_t v = part->free_v, next; v != MR_NONE; v = next) {
		next = d->out[v];
		remove_vertex(d, v);
	}
	for (uint32_t f = part->free_f, next; f != MR_NONE; f = next) {
		next = d->twin[3 * f];
		remove_face(d, f);
	}
	while (part->room_v > part->nv) {
		d->block[--part->room_v] = 0;
		remove_vertex(d, (uint32_t)part->room_v);
	}
	while (part->room_f > part->nf)
		remove_face(d, (uint32_t)--part->room_f);
	part->free_v = part->free_f = MR_NONE;
}

void
mr_dyn_share(const mr_dyn *d, mr_dyn *part)
{
	mr_dyn shared = *d;

	shared.nv = part->nv;
	shared.nf = part->nf;
	shared.room_v = part->room_v;
	shared.room_f = part->room_f;
	shared.free_v = part->free_v;
	shared.free_f = part->free_f;
	*part = shared;
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
	remove_vertex(d, a);
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

/* ---- from a mesh, with its curves of sharp edges ---- */

/* Unit direction from a to b. */
static mr_v3
direction(const mr_dyn *d, uint32_t a, uint32_t b)
{
	return mr_unit(mr_sub(d->p[b], d->p[a]));
}

/* Boundaries, seams, and edges sharper than `feature` degrees. */
static void
mark_curves(mr_ctx *ctx, mr_dyn *d, const uint8_t *seam, double feature)
{
	double cosine = cos(feature * MR_PI / 180);

	for (uint32_t h = 0; h < 3 * d->nf; h++) {
		uint32_t g = d->twin[h];
		if (g != MR_NONE && !(seam && seam[h]) &&
		    !(feature < 180 && mr_dot(mr_unit(mr_dyn_cross(d, d->p, h / 3)),
					   mr_unit(mr_dyn_cross(d, d->p, g / 3))) < cosine))
			continue;
		if (!d->curve) {
			d->curve = MR_NEW(ctx, 3 * d->room_f, uint32_t);
			memset(d->curve, 0xff, 3 * d->nf * sizeof *d->curve);
		}
		d->curve[h] = h;
	}
}

/* The kind of v by the curve edges that meet there. */
static mr_kind
kind_of(const mr_dyn *d, uint32_t v)
{
	uint32_t end[2];
	unsigned curves = mr_dyn_along(d, v, end);

	if (curves == 0)
		return MR_SMOOTH;
	return curves == 2 && mr_dot(direction(d, end[0], v), direction(d, v, end[1])) > MR_CORNER_COSINE
	           ? MR_CURVE
	           : MR_CORNER;
}

/* A place on the source for a vertex to begin with: a face at it, or a curve half-edge. */
static uint32_t
first_place(const mr_dyn *d, uint32_t v)
{
	uint32_t h = d->out[v];

	if (d->kind[v] == MR_SMOOTH)
		return h / 3;
	do {
		if (mr_dyn_on_curve(d, h))
			return h;
		h = mr_dyn_ccw(d, h);
	} while (h != MR_NONE && h != d->out[v]);
	return d->out[v];
}

/* Room for splits, nearly always enough: unused pages cost no memory. */
static size_t
ample(size_t n)
{
	return n < MR_NONE / 16 ? 4 * n + 32 : n + n / 4 + 32;
}

mr_status
mr_dyn_build(
    mr_ctx *ctx, const mr_mesh *m, const mr_topology *topo, const uint8_t *seam, double feature, mr_dyn *out)
{
	mr_dyn d = { .free_v = MR_NONE, .free_f = MR_NONE };

	room_for_vertices(ctx, &d, ample(m->nv));
	MR_TRY(room_for_faces(ctx, &d, ample(m->nf)));
	d.nv = m->nv;
	d.nf = m->nf;
	memcpy(d.p, m->p, m->nv * sizeof *d.p);
	memcpy(d.out, topo->out, m->nv * sizeof *d.out);
	memcpy(d.v, m->t, 3 * m->nf * sizeof *d.v);
	memcpy(d.twin, topo->twin, 3 * m->nf * sizeof *d.twin);
	mark_curves(ctx, &d, seam, feature);
	memset(d.kind, MR_SMOOTH, m->nv);
	for (uint32_t v = 0; v < m->nv; v++) {
		if (d.out[v] == MR_NONE) {
			d.kind[v] = MR_DEAD; /* an isolated vertex: not part of the surface */
			continue;
		}
		d.kind[v] = (uint8_t)kind_of(&d, v);
		d.at[v] = first_place(&d, v);
	}
	*out = d;
	return MR_OK;
}

mr_mesh
mr_dyn_view(const mr_dyn *d, const char *name)
{
	return (mr_mesh){ name, d->p, (const mr_tri *)(const void *)d->v, d->nv, d->nf };
}

/* ---- numbers without holes, and along the Z curve (Morton 1966) ---- */

enum { GRAIN = 1 << 14 };

typedef struct permutation {
	char *array, *copy;
	size_t size;
	const uint32_t *number;
} permutation;

static void
copy_body(void *arg, size_t begin, size_t end)
{
	const permutation *j = arg;

	memcpy(j->copy + begin * j->size, j->array + begin * j->size, (end - begin) * j->size);
}

static void
permute_body(void *arg, size_t begin, size_t end)
{
	const permutation *j = arg;

	for (size_t i = begin; i < end; i++)
		if (j->number[i] != MR_NONE)
			memcpy(j->array + j->number[i] * j->size, j->copy + i * j->size, j->size);
}

/* Applies new numbers to an array of n objects, but to those without: new[number[i]] = old[i]. */
static void
permute(mr_ctx *ctx, void *array, size_t n, size_t size, const uint32_t *number)
{
	MR_SCOPE(ctx);
	permutation j = { array, NULL, size, number };

	if (!array)
		return;
	j.copy = mr_alloc(ctx, n, size);
	mr_parallel(ctx, n, GRAIN, copy_body, &j);
	mr_parallel(ctx, n, GRAIN, permute_body, &j);
}

typedef struct renumbering {
	mr_dyn *d;
	const uint32_t *number;
} renumbering;

static void
corners_body(void *arg, size_t begin, size_t end)
{
	const renumbering *j = arg;

	for (size_t f = begin; f < end; f++)
		for (size_t h = 3 * f; h < 3 * f + 3 && !mr_dyn_face_dead(j->d, f); h++)
			j->d->v[h] = j->number[j->d->v[h]];
}

static void
permute_vertices(mr_ctx *ctx, mr_dyn *d, const uint32_t *number)
{
	permute(ctx, d->p, d->nv, sizeof *d->p, number);
	permute(ctx, d->out, d->nv, sizeof *d->out, number);
	permute(ctx, d->at, d->nv, sizeof *d->at, number);
	permute(ctx, d->kind, d->nv, sizeof *d->kind, number);
	permute(ctx, d->block, d->nv, sizeof *d->block, number);
	mr_parallel(ctx, d->nf, GRAIN, corners_body, &(renumbering){ d, number });
}

static uint32_t
renumbered(const uint32_t *number, uint32_t h)
{
	return h == MR_NONE ? MR_NONE : 3 * number[h / 3] + h % 3;
}

static void
twins_body(void *arg, size_t begin, size_t end)
{
	const renumbering *j = arg;

	for (size_t f = begin; f < end; f++)
		for (size_t h = 3 * f; h < 3 * f + 3 && !mr_dyn_face_dead(j->d, f); h++)
			j->d->twin[h] = renumbered(j->number, j->d->twin[h]);
}

static void
out_body(void *arg, size_t begin, size_t end)
{
	const renumbering *j = arg;

	for (size_t v = begin; v < end; v++)
		j->d->out[v] = renumbered(j->number, j->d->out[v]);
}

/* nv: of the vertices that live. */
static void
permute_faces(mr_ctx *ctx, mr_dyn *d, size_t nv, const uint32_t *number)
{
	renumbering j = { d, number };

	mr_parallel(ctx, d->nf, GRAIN, twins_body, &j);
	mr_parallel(ctx, nv, GRAIN, out_body, &j);
	permute(ctx, d->v, d->nf, 3 * sizeof *d->v, number);
	permute(ctx, d->twin, d->nf, 3 * sizeof *d->twin, number);
	permute(ctx, d->curve, d->nf, 3 * sizeof *d->curve, number);
}

mr_status
mr_dyn_compact(mr_ctx *ctx, mr_dyn *d)
{
	mr_mark mark = mr_mark_take(ctx);
	uint32_t *number = MR_NEW(ctx, d->nv > d->nf ? d->nv : d->nf, uint32_t), nv = 0, nf = 0;

	for (size_t v = 0; v < d->nv; v++)
		number[v] = d->kind[v] == MR_DEAD ? MR_NONE : nv++;
	permute_vertices(ctx, d, number);
	d->nv = nv;
	for (size_t f = 0; f < d->nf; f++)
		number[f] = mr_dyn_face_dead(d, f) ? MR_NONE : nf++;
	permute_faces(ctx, d, nv, number);
	d->nf = nf;
	d->free_v = d->free_f = MR_NONE;
	mr_mark_release(ctx, mark);
	if (d->room_v > d->nv + d->nv / 3)
		room_for_vertices(ctx, d, d->nv + d->nv / 8 + 16);
	return d->room_f > d->nf + d->nf / 3 ? room_for_faces(ctx, d, d->nf + d->nf / 8 + 32) : MR_OK;
}

static uint32_t
lowest(const mr_dyn *d, size_t f)
{
	const uint32_t *v = d->v + 3 * f;
	uint32_t low = v[0] < v[1] ? v[0] : v[1];

	return low < v[2] ? low : v[2];
}

/* By their lowest vertex: a counting sort. */
static void
number_faces(mr_ctx *ctx, const mr_dyn *d, uint32_t *number)
{
	MR_SCOPE(ctx);
	uint32_t *next = MR_NEW_ZERO(ctx, d->nv + 1, uint32_t);

	for (size_t f = 0; f < d->nf; f++)
		next[lowest(d, f) + 1]++;
	for (size_t v = 0; v < d->nv; v++)
		next[v + 1] += next[v];
	for (size_t f = 0; f < d->nf; f++)
		number[f] = next[lowest(d, f)]++;
}

void
mr_dyn_order(mr_ctx *ctx, mr_dyn *d)
{
	MR_SCOPE(ctx);
	uint32_t *number = MR_NEW(ctx, d->nv > d->nf ? d->nv : d->nf, uint32_t),
		 *order = MR_NEW(ctx, d->nv, uint32_t);

	mr_zorder(ctx, d->p, d->nv, MR_ZORDER_CELLS, order);
	for (uint32_t i = 0; i < d->nv; i++)
		number[order[i]] = i;
	permute_vertices(ctx, d, number);
	number_faces(ctx, d, number);
	permute_faces(ctx, d, d->nv, number);
}
