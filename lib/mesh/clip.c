/* A mesh cut along a line through its faces. */
#include "mesh/clip.h"

#include "mesh/edges.h"

/* The least share of an edge from the line to its ends: no face becomes a needle for that. */
static const double LEAST = 0.05;

typedef struct clip {
	const mr_mesh *m;
	const double *value;
	mr_mesh cut;        /* the faces through which the line goes */
	uint32_t *vertex;   /* nv: the new number of those that stay; MR_NONE: of the others */
	uint32_t *crossing; /* of each half-edge of cut: the vertex on the line; MR_NONE: none */
	mr_mesh out;
	mr_v3 *p;
	mr_tri *t;
} clip;

static bool
stays(const clip *c, uint32_t v)
{
	return c->value[v] < 0;
}

static bool
crosses(const clip *c, uint32_t h)
{
	return stays(c, mr_he_from(&c->cut, h)) != stays(c, mr_he_to(&c->cut, h));
}

/* Numbers the vertices that stay and have a face. */
static void
keep_vertices(clip *c)
{
	for (size_t f = 0; f < c->m->nf; f++)
		for (int k = 0; k < 3; k++)
			if (stays(c, c->m->t[f].v[k]))
				c->vertex[c->m->t[f].v[k]] = 0;
	for (uint32_t v = 0; v < c->m->nv; v++)
		if (c->vertex[v] != MR_NONE) {
			c->vertex[v] = (uint32_t)c->out.nv;
			c->p[c->out.nv++] = c->m->p[v];
		}
}

/* The crossing of the line and h, the same from both sides. */
static mr_v3
place(const clip *c, uint32_t h)
{
	uint32_t a = mr_he_from(&c->cut, h), b = mr_he_to(&c->cut, h);
	uint32_t in = stays(c, a) ? a : b, off = stays(c, a) ? b : a;
	double t = c->value[in] / (c->value[in] - c->value[off]);

	return mr_lerp(fmin(fmax(t, LEAST), 1 - LEAST), c->m->p[in], c->m->p[off]);
}

static void
find_crossings(clip *c, const mr_edges *edges)
{
	for (size_t e = 0; e < edges->count; e++) {
		const uint32_t *h = edges->he + edges->start[e];
		if (!crosses(c, h[0]))
			continue;
		for (uint32_t k = 0; k < mr_edge_faces(edges, e); k++)
			c->crossing[h[k]] = (uint32_t)c->out.nv;
		c->p[c->out.nv++] = place(c, h[0]);
	}
}

static void
add(clip *c, uint32_t a, uint32_t b, uint32_t d)
{
	c->t[c->out.nf++] = (mr_tri){ { a, b, d } };
}

/* Cuts a face whose corner at the start of h is on the other side than both others. */
static void
cut_face(clip *c, uint32_t h)
{
	uint32_t next = mr_he_next(h), last = mr_he_prev(h);
	uint32_t a = c->crossing[h], b = c->crossing[last], from, to;

	if (stays(c, mr_he_from(&c->cut, h))) {
		add(c, c->vertex[mr_he_from(&c->cut, h)], a, b);
		return;
	}
	from = c->vertex[mr_he_from(&c->cut, next)];
	to = c->vertex[mr_he_to(&c->cut, next)];
	if (mr_dist(c->p[a], c->p[to]) < mr_dist(c->p[from], c->p[b])) {
		add(c, a, from, to);
		add(c, a, to, b);
	} else {
		add(c, a, from, b);
		add(c, from, to, b);
	}
}

/* How many of a face's corners stay; of one with a corner twice none. */
static int
count_staying(const clip *c, size_t f)
{
	const uint32_t *v = c->m->t[f].v;

	return mr_face_repeats(c->m, f) ? 0 : stays(c, v[0]) + stays(c, v[1]) + stays(c, v[2]);
}

static void
find_cut(mr_ctx *ctx, clip *c)
{
	mr_tri *t = MR_NEW(ctx, c->m->nf, mr_tri);

	c->cut = *c->m;
	c->cut.nf = 0;
	for (size_t f = 0; f < c->m->nf; f++)
		if (count_staying(c, f) % 3 != 0)
			t[c->cut.nf++] = c->m->t[f];
	c->cut.t = t;
}

static void
take_faces(clip *c)
{
	uint32_t h = 0; /* of cut */

	for (size_t f = 0; f < c->m->nf; f++) {
		const uint32_t *v = c->m->t[f].v;
		int staying = count_staying(c, f);
		if (staying == 3)
			add(c, c->vertex[v[0]], c->vertex[v[1]], c->vertex[v[2]]);
		if (staying % 3 == 0)
			continue;
		for (int k = 0; k < 3; k++, h++)
			if (stays(c, v[k]) == (staying == 1))
				cut_face(c, h);
	}
}

void
mr_mesh_clip(mr_ctx *ctx, const mr_mesh *m, const double *value, mr_mesh *out)
{
	clip c = { .m = m, .value = value };
	mr_edges edges;

	find_cut(ctx, &c);
	mr_edges_build(ctx, &c.cut, &edges);
	c.p = MR_NEW(ctx, m->nv + edges.count, mr_v3);
	c.t = MR_NEW(ctx, 2 * m->nf, mr_tri);
	c.vertex = MR_NEW(ctx, m->nv, uint32_t);
	c.crossing = MR_NEW(ctx, 3 * c.cut.nf, uint32_t);
	memset(c.vertex, 0xff, m->nv * sizeof *c.vertex);
	memset(c.crossing, 0xff, 3 * c.cut.nf * sizeof *c.crossing);
	keep_vertices(&c);
	find_crossings(&c, &edges);
	take_faces(&c);
	c.out.name = m->name;
	c.out.p = c.p;
	c.out.t = c.t;
	*out = c.out;
}
