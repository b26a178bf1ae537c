/*
 * Each edge is divided into as few equal pieces as are short enough; each triangle then by itself, since its
 * neighbours share only its edges: into rows between its two edges of more pieces, from the corner where they
 * meet to the third edge, each row divided as an edge is, and strips of triangles between the rows.  Halving
 * edges instead would part a sliver of 2^k pieces in 3^k triangles, not in 2^k.  The diagonals of strips
 * exceed the length by at most some 40 %, which is left to another pass.
 */
#include "subdivide/longest.h"

#include "mesh/edges.h"

/* Pieces exceed the length by rounding. */
static const double SLACK = 1e-9;

/* The edges of a mesh, each once; and what a pass makes of it. */
typedef struct pass {
	mr_ctx *ctx;
	double length;
	mr_mesh m;            /* as it is before the pass */
	const uint32_t *face; /* the first mesh's face of each of its triangles */
	const mr_v3 *bary;    /* and of their corners there */
	uint32_t *edge;       /* of each half-edge */
	uint32_t *pieces;     /* of each edge */
	uint32_t *first;      /* the first of its new vertices, from the end of the lower number on */
	mr_edges edges;
	double most; /* triangles, no fewer than there will be */
	mr_v3 *p;    /* the result */
	mr_tri *t;
	uint32_t *out_face;
	mr_v3 *out_bary;
	size_t nv, nf, p_room, t_room, face_room, bary_room;
	struct point *row[2], *chain; /* of the triangle at hand */
	size_t row_room[2], chain_room;
} pass;

/* A vertex of a triangle that is divided: its number, and where it is in it. */
typedef struct point {
	uint32_t v;
	mr_v3 at;
} point;

static double
pieces_of(const pass *s, double length)
{
	double n = ceil(length / s->length - SLACK);

	return n > 1 ? n : 1;
}

/* ---- edges ---- */

/* Faces that have a vertex twice are none of an edge: they stay as they are. */
static void
find_edges(pass *s)
{
	mr_edges edges;

	mr_edges_build(s->ctx, &s->m, &edges);
	s->edge = MR_NEW(s->ctx, 3 * s->m.nf, uint32_t);
	s->pieces = MR_NEW(s->ctx, edges.count + 1, uint32_t);
	s->first = MR_NEW(s->ctx, edges.count + 1, uint32_t);
	s->edges = edges;
	for (size_t h = 0; h < 3 * s->m.nf; h++)
		s->edge[h] = (uint32_t)edges.count;
	s->pieces[edges.count] = 1;
	for (uint32_t e = 0; e < edges.count; e++)
		for (uint32_t i = edges.start[e]; i < edges.start[e + 1]; i++)
			s->edge[edges.he[i]] = e;
}

static double
length_of(const pass *s, uint32_t h)
{
	return mr_dist(s->m.p[mr_he_from(&s->m, h)], s->m.p[mr_he_to(&s->m, h)]);
}

/*
 * Triangles that the face can become at most: rows as many as its middle edge has pieces, each of no more
 * than the shortest and two, and what the longest edge has more.
 */
static double
most_of(const pass *s, uint32_t f)
{
	double a = pieces_of(s, length_of(s, 3 * f)), b = pieces_of(s, length_of(s, 3 * f + 1)),
	       c = pieces_of(s, length_of(s, 3 * f + 2));
	double low = fmin(a, fmin(b, c)), high = fmax(a, fmax(b, c)), middle = a + b + c - low - high;

	return high == 1 ? 1 : middle * (2 * low + 3) + high;
}

static double
most_triangles(const pass *s)
{
	double sum = 0;

	for (uint32_t f = 0; f < s->m.nf; f++)
		sum += most_of(s, f);
	return sum;
}

/* Refuses what would be too many triangles, and says which length would not be. */
static mr_status
check_size(pass *s)
{
	double asked = s->length, most, now, longest = 0;

	for (uint32_t h = 0; h < 3 * s->m.nf; h++)
		longest = fmax(longest, length_of(s, h));
	s->length = fmax(s->length, 1e-12 * longest); /* which is too many, and can be counted */
	for (most = now = most_triangles(s); !(now <= MR_LONGEST_MOST); now = most_triangles(s))
		s->length *= 1.25;
	if (s->length != asked)
		return mr_fail(s->ctx, MR_ERANGE,
		    "edges of %g at most may take %.3g triangles, more than %d: a length of %.3g does not",
		    asked, most, (int)MR_LONGEST_MOST, 3 * s->length); /* nor do the diagonals of strips */
	return MR_OK;
}

/* The new vertices of the edge from low to high, which are apart: else no pass would make it shorter. */
static mr_status
divide_edge(pass *s, mr_v3 low, mr_v3 high, uint32_t pieces)
{
	mr_v3 last = low, at = low;

	MR_RESERVE(s->ctx, s->p, s->nv, pieces, &s->p_room);
	for (uint32_t k = 1; k <= pieces; k++) {
		mr_v3 next = k < pieces ? mr_lerp((double)k / pieces, low, high) : high;
		if (k > 1 && !mr_divides(at, last, next))
			return mr_fail(s->ctx, MR_ERANGE,
			    "edges of %g at most cannot be made near (%.4g, %.4g, %.4g): positions there are "
			    "no "
			    "finer",
			    s->length, at.x, at.y, at.z);
		if (k < pieces)
			s->p[s->nv++] = next;
		last = at;
		at = next;
	}
	return MR_OK;
}

/* The new vertices of edges; false in *more where there is none. */
static mr_status
divide_edges(pass *s, bool *more)
{
	*more = false;
	for (size_t e = 0; e < s->edges.count; e++) {
		uint32_t h = s->edges.he[s->edges.start[e]], a = mr_he_from(&s->m, h), b = mr_he_to(&s->m, h);
		uint32_t low = a < b ? a : b, high = a < b ? b : a;
		s->pieces[e] = (uint32_t)pieces_of(s, length_of(s, h));
		s->first[e] = (uint32_t)s->nv;
		MR_TRY(divide_edge(s, s->m.p[low], s->m.p[high], s->pieces[e]));
		*more |= s->pieces[e] > 1;
	}
	return MR_OK;
}

/* ---- a triangle ---- */

static mr_v3
unit(int k)
{
	return mr_vec(k == 0, k == 1, k == 2);
}

/* Point k of n along half-edge 3 f + i, from its end `from` of the triangle (i, or the next corner). */
static point
on_edge(const pass *s, uint32_t f, int i, int from, uint32_t k)
{
	uint32_t h = 3 * f + (uint32_t)i, e = s->edge[h], n = s->pieces[e], a, b;
	int to = from == i ? (i + 1) % 3 : i;
	point x;

	a = s->m.t[f].v[from];
	b = s->m.t[f].v[to];
	x.v = k == 0 ? a : k == n ? b : s->first[e] + (a < b ? k : n - k) - 1;
	x.at = k == n ? unit(to) : mr_lerp((double)k / n, unit(from), unit(to));
	return x;
}

static mr_v3
place(const pass *s, uint32_t f, mr_v3 at)
{
	const uint32_t *v = s->m.t[f].v;

	return mr_bary_point(at, s->m.p[v[0]], s->m.p[v[1]], s->m.p[v[2]]);
}

static void
emit(pass *s, uint32_t f, const point *a, const point *b, const point *c)
{
	const mr_v3 *whole = s->bary + 3 * (size_t)f;
	const point *x[] = { a, b, c };

	MR_RESERVE(s->ctx, s->t, s->nf, 1, &s->t_room);
	MR_RESERVE(s->ctx, s->out_face, s->nf, 1, &s->face_room);
	MR_RESERVE(s->ctx, s->out_bary, 3 * s->nf, 3, &s->bary_room);
	s->t[s->nf] = (mr_tri){ { a->v, b->v, c->v } };
	s->out_face[s->nf] = s->face[f];
	for (size_t k = 0; k < 3; k++)
		s->out_bary[3 * s->nf + k] = mr_bary_point(x[k]->at, whole[0], whole[1], whole[2]);
	s->nf++;
}

/* The points from a to b, which are on edges, in row[i]: with new ones between them. */
static void
fill_row(pass *s, uint32_t f, int i, point a, point b, size_t *n)
{
	mr_v3 p = place(s, f, a.at), q = place(s, f, b.at);
	uint32_t pieces = (uint32_t)pieces_of(s, mr_dist(p, q));

	MR_RESERVE(s->ctx, s->row[i], 0, pieces + 1, &s->row_room[i]);
	MR_RESERVE(s->ctx, s->p, s->nv, pieces, &s->p_room);
	s->row[i][0] = a;
	for (uint32_t k = 1; k < pieces; k++) {
		mr_v3 at = mr_lerp((double)k / pieces, a.at, b.at);
		s->row[i][k] = (point){ (uint32_t)s->nv, at };
		s->p[s->nv++] = place(s, f, at);
	}
	s->row[i][pieces] = b;
	*n = pieces + 1;
}

/*
 * The strip between two chains that run side by side, a nearer to the corner that the rows begin at.  The
 * first `head` and the last `tail` steps of a are along the edges on which b begins and ends: no triangle of
 * such a step may have that end.
 */
static void
zip(pass *s, uint32_t f, const point *a, size_t na, size_t head, size_t tail, const point *b, size_t nb)
{
	size_t i = 0, k = 0;

	while (i + 1 < na || k + 1 < nb) {
		bool can_a = i + 1 < na && !(i < head && k == 0),
		     can_b = k + 1 < nb && !(tail && k + 2 == nb && i + 1 < na);
		bool take_a = can_a;
		if (can_a && can_b)
			take_a = mr_dist(place(s, f, a[i + 1].at), place(s, f, b[k].at)) <
			         mr_dist(place(s, f, a[i].at), place(s, f, b[k + 1].at));
		emit(s, f, &a[i], &b[k], take_a ? &a[i + 1] : &b[k + 1]);
		i += take_a;
		k += !take_a;
	}
}

/* The two edges at the corner `top`, and how many pieces they have. */
typedef struct sides {
	int top, left, right; /* edges: from top to the next corner; from the one before to top */
	uint32_t n_left, n_right, rows;
} sides;

/* The corner opposite the edge of fewest pieces, of equal ones the shortest. */
static sides
choose_sides(const pass *s, uint32_t f)
{
	int least = 0;
	sides d;

	for (int i = 1; i < 3; i++) {
		uint32_t n = s->pieces[s->edge[3 * f + (uint32_t)i]],
			 m = s->pieces[s->edge[3 * f + (uint32_t)least]];
		if (n < m ||
		    (n == m && length_of(s, 3 * f + (uint32_t)i) < length_of(s, 3 * f + (uint32_t)least)))
			least = i;
	}
	d.top = (least + 2) % 3;
	d.left = d.top;
	d.right = (d.top + 2) % 3;
	d.n_left = s->pieces[s->edge[3 * f + (uint32_t)d.left]];
	d.n_right = s->pieces[s->edge[3 * f + (uint32_t)d.right]];
	d.rows = d.n_left < d.n_right ? d.n_left : d.n_right;
	return d;
}

/* How many pieces of a side of n lie before row j. */
static uint32_t
pieces_before(uint32_t j, uint32_t n, uint32_t rows)
{
	return (uint32_t)(((uint64_t)j * n * 2 + rows) / (2 * (uint64_t)rows));
}

/* The third edge as the last row. */
static void
last_row(pass *s, uint32_t f, const sides *d, int i, size_t *n)
{
	int edge = (d->top + 1) % 3;
	uint32_t pieces = s->pieces[s->edge[3 * f + (uint32_t)edge]];

	MR_RESERVE(s->ctx, s->row[i], 0, pieces + 1, &s->row_room[i]);
	for (uint32_t k = 0; k <= pieces; k++)
		s->row[i][k] = on_edge(s, f, edge, edge, k);
	*n = pieces + 1;
}

/* The row above, between the points below it on the left and on the right edge. */
static void
build_chain(pass *s, uint32_t f, const sides *d, uint32_t j, int above, size_t n, size_t *head, size_t *tail)
{
	uint32_t l0 = pieces_before(j - 1, d->n_left, d->rows), l1 = pieces_before(j, d->n_left, d->rows),
		 r0 = pieces_before(j - 1, d->n_right, d->rows), r1 = pieces_before(j, d->n_right, d->rows);
	size_t at = 0;

	*head = l1 - l0 - 1;
	*tail = r1 - r0 - 1;
	MR_RESERVE(s->ctx, s->chain, 0, *head + n + *tail, &s->chain_room);
	for (uint32_t k = l1 - 1; k > l0; k--)
		s->chain[at++] = on_edge(s, f, d->left, d->top, k);
	memcpy(s->chain + at, s->row[above], n * sizeof *s->chain);
	at += n;
	for (uint32_t k = r0 + 1; k < r1; k++)
		s->chain[at++] = on_edge(s, f, d->right, d->top, k);
}

static void
divide_face(pass *s, uint32_t f)
{
	sides d = choose_sides(s, f);
	size_t above = 1, below, head, tail;

	MR_RESERVE(s->ctx, s->row[0], 0, 1, &s->row_room[0]);
	s->row[0][0] = (point){ s->m.t[f].v[d.top], unit(d.top) };
	for (uint32_t j = 1; j <= d.rows; j++) {
		int i = (int)(j & 1);
		uint32_t l = pieces_before(j, d.n_left, d.rows), r = pieces_before(j, d.n_right, d.rows);
		if (j == d.rows)
			last_row(s, f, &d, i, &below);
		else
			fill_row(s, f, i, on_edge(s, f, d.left, d.top, l), on_edge(s, f, d.right, d.top, r),
			    &below);
		build_chain(s, f, &d, j, 1 - i, above, &head, &tail);
		zip(s, f, s->chain, head + above + tail, head, tail, s->row[i], below);
		above = below;
	}
}

/* ---- the mesh ---- */

/* One pass over all; false in *more where no edge was too long, and then nothing is made. */
static mr_status
divide(pass *s, bool *more)
{
	s->p = NULL;
	MR_TRY(check_size(s));
	find_edges(s);
	MR_RESERVE(s->ctx, s->p, 0, s->m.nv, &s->p_room);
	memcpy(s->p, s->m.p, s->m.nv * sizeof *s->p);
	s->nv = s->m.nv;
	MR_TRY(divide_edges(s, more));
	for (uint32_t f = 0; *more && f < s->m.nf; f++)
		divide_face(s, f);
	return MR_OK;
}

/* The mesh as it is. */
static void
start(mr_ctx *ctx, const mr_mesh *m, mr_refined *r)
{
	uint32_t *face = MR_NEW(ctx, m->nf, uint32_t);
	mr_v3 *bary = MR_NEW(ctx, 3 * m->nf, mr_v3);

	for (size_t f = 0; f < m->nf; f++) {
		face[f] = (uint32_t)f;
		for (int k = 0; k < 3; k++)
			bary[3 * f + (size_t)k] = unit(k);
	}
	*r = (mr_refined){ .m = *m, .fine = *m, .face = face, .bary = bary };
}

mr_status
mr_divide_longest(mr_ctx *ctx, const mr_mesh *m, double length, mr_refined *r)
{
	enum { PASSES = 64 };
	bool more = true;

	start(ctx, m, r);
	for (int i = 0; i < PASSES && more; i++) {
		pass s = { .ctx = ctx, .length = length, .m = r->fine, .face = r->face, .bary = r->bary };
		MR_TRY(divide(&s, &more));
		if (!more)
			break;
		if (s.nv >= MR_NONE)
			return mr_fail(ctx, MR_ERANGE, "%zu vertices are more than indices can name", s.nv);
		r->fine = (mr_mesh){ m->name, s.p, s.t, s.nv, s.nf };
		r->face = s.out_face;
		r->bary = s.out_bary;
	}
	return MR_OK;
}
