/* A manifold of any set of triangles (Gueziec, Taubin, Lazarus, Horn 2001: Cutting and stitching): half-edges
 * are paired where the surface goes on; the corners that pairs connect are one vertex. */
#include "mesh/repair.h"

#include "base/disjoint_sets.h"
#include "mesh/edges.h"

typedef struct surface {
	mr_ctx *ctx;
	const mr_mesh *m;
	mr_tri *t;         /* faces that are kept, turned as the result has them */
	uint32_t *face_of; /* and where they come from */
	size_t nf;
	uint32_t *pair; /* 3 nf: the half-edge across, in either direction; MR_NONE at a border */
	mr_edges edges;
	uint32_t *root; /* 3 nf: union-find of corners */
	mr_repair_report r;
} surface;

static uint32_t
from(const surface *s, uint32_t h)
{
	return s->t[h / 3].v[h % 3];
}

static uint32_t
to(const surface *s, uint32_t h)
{
	return s->t[h / 3].v[(h + 1) % 3];
}

/* ---- faces to keep ---- */

static bool
degenerate(const mr_mesh *m, size_t f)
{
	return mr_face_repeats(m, f) || mr_norm2(mr_face_cross(m, f)) == 0;
}

static void
keep_faces(surface *s)
{
	mr_incidence around;

	s->t = MR_NEW(s->ctx, s->m->nf, mr_tri);
	s->face_of = MR_NEW(s->ctx, s->m->nf, uint32_t);
	MR_SCOPE(s->ctx);
	mr_incidence_build(s->ctx, s->m, &around);
	for (uint32_t f = 0; f < s->m->nf; f++) {
		if (degenerate(s->m, f)) {
			s->r.degenerate++;
		} else if (mr_face_is_repeated(s->m, &around, f)) {
			s->r.duplicate++;
		} else {
			s->t[s->nf] = s->m->t[f];
			s->face_of[s->nf++] = f;
		}
	}
}

/* ---- edges ---- */

static void
find_edges(surface *s)
{
	mr_mesh m = { .p = s->m->p, .t = s->t, .nv = s->m->nv, .nf = s->nf };

	mr_edges_build(s->ctx, &m, &s->edges);
}

static void
join(surface *s, uint32_t h, uint32_t g)
{
	s->pair[h] = g;
	s->pair[g] = h;
}

typedef struct leaf {
	double angle;
	uint32_t h;
} leaf;

static int
by_angle(const void *a, const void *b)
{
	const leaf *x = a, *y = b;

	if (x->angle != y->angle)
		return x->angle < y->angle ? -1 : 1;
	return x->h < y->h ? -1 : x->h > y->h;
}

/* Faces around an edge by angle: the solid lies between a face that runs along the edge and, going round
 * against it, the next, if that runs the other way; these are joined.  The others get a border. */
static void
join_wedges(surface *s, const uint32_t *he, size_t n)
{
	MR_SCOPE(s->ctx);
	leaf *l = MR_NEW(s->ctx, n, leaf);
	uint32_t f = from(s, he[0]), t = to(s, he[0]), a = f < t ? f : t, b = f < t ? t : f;
	mr_v3 o = s->m->p[a], axis = mr_unit(mr_sub(s->m->p[b], o)), x = { 0, 0, 0 }, y;

	for (size_t k = 0; k < n; k++) {
		uint32_t h = he[k];
		mr_v3 d = mr_sub(s->m->p[s->t[h / 3].v[(h + 2) % 3]], o);
		d = mr_axpy(-mr_dot(d, axis), axis, d);
		if (k == 0) {
			x = mr_unit(d);
			y = mr_cross(axis, x);
		}
		l[k] = (leaf){ k == 0 ? 0 : atan2(mr_dot(d, y), mr_dot(d, x)), h };
		if (l[k].angle < 0)
			l[k].angle += 2 * MR_PI;
	}
	qsort(l, n, sizeof *l, by_angle);
	/* A face a -> b has its outside towards greater angles: the solid is on the side of the next smaller.
	 */
	for (size_t k = 0; k < n; k++) {
		leaf before = l[(k + n - 1) % n];
		if (from(s, l[k].h) == a && from(s, before.h) != a && before.angle != l[k].angle)
			join(s, l[k].h, before.h);
	}
}

static void
pair_edges(surface *s)
{
	for (size_t i = 0; i < 3 * s->nf; i++)
		s->pair[i] = MR_NONE;
	for (size_t e = 0; e < s->edges.count; e++) {
		const uint32_t *he = s->edges.he + s->edges.start[e];
		size_t n = mr_edge_faces(&s->edges, e);
		if (n == 2)
			join(s, he[0], he[1]);
		else if (n > 2) {
			s->r.split_edges++;
			join_wedges(s, he, n);
		}
	}
}

/* ---- orientation ---- */

static void
cut(surface *s, uint32_t h)
{
	s->pair[s->pair[h]] = MR_NONE;
	s->pair[h] = MR_NONE;
	s->r.cut_edges++;
}

/* A face's part of six times the volume, seen from o. */
static double
below(const surface *s, uint32_t f, mr_v3 o)
{
	const uint32_t *v = s->t[f].v;
	const mr_v3 *p = s->m->p;

	return mr_dot(mr_sub(p[v[0]], o), mr_cross(mr_sub(p[v[1]], o), mr_sub(p[v[2]], o)));
}

/* Six times the volume below the faces, as turned: its sign separates inside from outside. */
static double
volume(const surface *s, const uint32_t *face, size_t n, const bool *turned)
{
	mr_v3 o = s->m->p[s->t[face[0]].v[0]];
	double sum = 0;

	for (size_t i = 0; i < n; i++)
		sum += turned[face[i]] ? -below(s, face[i], o) : below(s, face[i], o);
	return sum;
}

/* Visits the component of queue[0]; turned[] is decided against that face, what cannot agree is cut. */
static size_t
spread(surface *s, uint32_t *queue, uint32_t number, uint32_t *part, bool *turned, bool *closed)
{
	size_t n = 1;

	*closed = true;
	part[queue[0]] = number;
	for (size_t i = 0; i < n; i++)
		for (uint32_t h = 3 * queue[i]; h < 3 * queue[i] + 3; h++) {
			uint32_t g = s->pair[h], f;
			bool same;
			if (g == MR_NONE) {
				*closed = false;
				continue;
			}
			f = g / 3;
			same = from(s, h) == from(s, g); /* both run the same way: one must turn */
			if (part[f] == MR_NONE) {
				part[f] = number;
				turned[f] = turned[queue[i]] != same;
				queue[n++] = f;
			} else if ((turned[f] != turned[queue[i]]) != same) {
				cut(s, h);
				*closed = false;
			}
		}
	return n;
}

/* Turns a face over, keeping its first vertex; half-edges 3 f and 3 f + 2 change places. */
static void
turn(surface *s, uint32_t f)
{
	uint32_t *v = s->t[f].v, a = v[1], h = s->pair[3 * f], g = s->pair[3 * f + 2];

	v[1] = v[2];
	v[2] = a;
	s->pair[3 * f] = g;
	s->pair[3 * f + 2] = h;
	if (g != MR_NONE)
		s->pair[g] = 3 * f;
	if (h != MR_NONE)
		s->pair[h] = 3 * f + 2;
	s->r.flipped++;
}

/* The faces of a part agree: they are as most of them are, so that a hollow stays one; of a closed part where
 * that is less than three quarters they come outside out. */
static void
orient_part(const surface *s, const uint32_t *face, size_t n, bool closed, bool *turned)
{
	size_t count = 0;

	for (size_t k = 0; k < n; k++)
		count += turned[face[k]];
	if (closed && 4 * count >= n && 4 * count <= 3 * n ? volume(s, face, n, turned) >= 0 : 2 * count <= n)
		return;
	for (size_t k = 0; k < n; k++)
		turned[face[k]] = !turned[face[k]];
}

/* Counts the closed parts of negative volume; in the order of faces, which is faster than a walk. */
static void
count_inward(surface *s, const uint32_t *part, const uint32_t *closed, size_t parts)
{
	double *six = MR_NEW_ZERO(s->ctx, parts, double);

	for (uint32_t f = 0; f < s->nf; f++)
		if (closed[part[f]] != MR_NONE)
			six[part[f]] += below(s, f, s->m->p[s->t[closed[part[f]]].v[0]]);
	for (size_t i = 0; i < parts; i++)
		s->r.inward += six[i] < 0;
}

static void
orient(surface *s)
{
	MR_SCOPE(s->ctx);
	uint32_t *part = MR_NEW(s->ctx, s->nf, uint32_t), *face = MR_NEW(s->ctx, s->nf, uint32_t),
		 *first = NULL;
	bool *turned = MR_NEW_ZERO(s->ctx, s->nf, bool), closed;
	size_t parts = 0, room = 0;

	memset(part, 0xff, s->nf * sizeof *part);
	for (uint32_t f = 0; f < s->nf; f++)
		if (part[f] == MR_NONE) {
			size_t n;
			face[0] = f;
			n = spread(s, face, (uint32_t)parts, part, turned, &closed);
			orient_part(s, face, n, closed, turned);
			MR_RESERVE(s->ctx, first, parts, 1, &room);
			first[parts++] = closed ? f : MR_NONE; /* of an open one no inside is known */
		}
	for (uint32_t f = 0; f < s->nf; f++)
		if (turned[f])
			turn(s, f);
	count_inward(s, part, first, parts);
}

/* ---- vertices ---- */

/* Corners that pairs connect get the same root, the least of them. */
static void
connect(surface *s)
{
	mr_sets_begin(s->root, 3 * s->nf);
	for (uint32_t h = 0; h < 3 * s->nf; h++)
		if (s->pair[h] != MR_NONE) {
			uint32_t g = s->pair[h];
			mr_sets_join(s->root, h, mr_he_next(g));
			mr_sets_join(s->root, mr_he_next(h), g);
		}
	for (uint32_t h = 0; h < 3 * s->nf; h++)
		s->root[h] = mr_sets_root(s->root, h);
}

static bool
same_edge(const surface *s, uint32_t h, uint32_t g)
{
	uint32_t a = s->root[h], b = s->root[mr_he_next(h)], c = s->root[g], d = s->root[mr_he_next(g)];

	return (a == c && b == d) || (a == d && b == c);
}

static void
cut_loose(surface *s, uint32_t f)
{
	for (uint32_t h = 3 * f; h < 3 * f + 3; h++)
		if (s->pair[h] != MR_NONE)
			cut(s, h);
}

/* Half-edges that would be copies of one edge, both ends being connected around it: the face of the one
 * without a pair, or else of the later, is cut loose.  Returns how many were. */
static size_t
part_copies(surface *s)
{
	size_t loose = 0;

	for (size_t e = 0; e < s->edges.count; e++)
		for (uint32_t k = s->edges.start[e] + 1; k < s->edges.start[e + 1]; k++)
			for (uint32_t l = s->edges.start[e]; l < k; l++) {
				uint32_t g = s->edges.he[k], h = s->edges.he[l];
				if (s->pair[g] == h || !same_edge(s, g, h))
					continue;
				cut_loose(s, s->pair[g] != MR_NONE && s->pair[h] == MR_NONE ? h / 3 : g / 3);
				loose++;
				break;
			}
	return loose;
}

/* Numbers the roots in order of the vertices they come from, then of corners. */
static void
number(surface *s, mr_mesh *out, const uint32_t **vertex_of)
{
	size_t nv = 0, n = 3 * s->nf, used = 0;
	uint32_t *count = MR_NEW_ZERO(s->ctx, s->m->nv + 1, uint32_t), *name = MR_NEW(s->ctx, n, uint32_t),
		 *of;
	mr_v3 *p;

	for (uint32_t h = 0; h < n; h++)
		if (s->root[h] == h) {
			count[from(s, h) + 1]++;
			nv++;
		}
	for (size_t i = 0; i < s->m->nv; i++) {
		used += count[i + 1] > 0;
		count[i + 1] += count[i];
	}
	p = MR_NEW(s->ctx, nv, mr_v3);
	of = MR_NEW(s->ctx, nv, uint32_t);
	for (uint32_t h = 0; h < n; h++)
		if (s->root[h] == h) {
			name[h] = count[from(s, h)]++;
			of[name[h]] = from(s, h);
			p[name[h]] = s->m->p[from(s, h)];
		}
	for (uint32_t h = 0; h < n; h++)
		s->t[h / 3].v[h % 3] = name[s->root[h]];
	for (uint32_t h = 0; h < n; h++)
		s->r.open += s->pair[h] == MR_NONE;
	s->r.isolated = s->m->nv - used;
	s->r.split_vertices = nv - used;
	*out = (mr_mesh){ .name = s->m->name, .p = p, .t = s->t, .nv = nv, .nf = s->nf };
	*vertex_of = of;
}

static mr_status
repair(surface *s, mr_mesh *out, const uint32_t **vertex_of)
{
	mr_mark mark;

	s->pair = MR_NEW(s->ctx, 3 * s->nf, uint32_t);
	mark = mr_mark_take(s->ctx);
	find_edges(s);
	pair_edges(s);
	orient(s);
	mr_mark_release(s->ctx, mark);
	s->root = MR_NEW(s->ctx, 3 * s->nf, uint32_t);
	mark = mr_mark_take(s->ctx);
	find_edges(s); /* turning moved half-edges */
	do
		connect(s);
	while (part_copies(s));
	mr_mark_release(s->ctx, mark);
	number(s, out, vertex_of);
	return MR_OK;
}

mr_status
mr_repair(mr_ctx *ctx, const mr_mesh *m, mr_mesh *out, const uint32_t **vertex_of, const uint32_t **face_of,
    mr_repair_report *report)
{
	surface s = { .ctx = ctx, .m = m };

	keep_faces(&s);
	if (s.nf == 0)
		return mr_fail(
		    ctx, MR_EMESH, "%s: none of %zu faces is left: all are degenerate", m->name, m->nf);
	MR_TRY(repair(&s, out, vertex_of));
	*face_of = s.face_of;
	*report = s.r;
	return MR_OK;
}
