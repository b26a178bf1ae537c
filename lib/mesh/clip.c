/* A mesh cut along a line through its faces. */
#include "mesh/clip.h"

#include "mesh/edges.h"

/* Of an edge, at least, from the line to its ends: no face becomes a needle for that. */
static const double LEAST = 0.05;

typedef struct clip {
	const mr_mesh *m;
	const double *value;
	uint32_t *vertex;   /* nv: the new number of those that stay; MR_NONE: of the others */
	uint32_t *crossing; /* 3 nf: of each half-edge: the vertex on the line; MR_NONE: none */
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
	return stays(c, mr_he_from(c->m, h)) != stays(c, mr_he_to(c->m, h));
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

/* Where the line crosses h, the same from both sides. */
static mr_v3
place(const clip *c, uint32_t h)
{
	uint32_t a = mr_he_from(c->m, h), b = mr_he_to(c->m, h);
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

/* Of a face whose corner at the start of h is on the other side than both others. */
static void
cut_face(clip *c, uint32_t h)
{
	uint32_t next = mr_he_next(h), last = mr_he_prev(h);
	uint32_t a = c->crossing[h], b = c->crossing[last], from, to;

	if (stays(c, mr_he_from(c->m, h))) {
		add(c, c->vertex[mr_he_from(c->m, h)], a, b);
		return;
	}
	from = c->vertex[mr_he_from(c->m, next)];
	to = c->vertex[mr_he_to(c->m, next)];
	if (mr_dist(c->p[a], c->p[to]) < mr_dist(c->p[from], c->p[b])) {
		add(c, a, from, to);
		add(c, a, to, b);
	} else {
		add(c, a, from, b);
		add(c, from, to, b);
	}
}

static void
take_face(clip *c, uint32_t f)
{
	const uint32_t *v = c->m->t[f].v;
	bool in[3] = { stays(c, v[0]), stays(c, v[1]), stays(c, v[2]) };

	if (in[0] && in[1] && in[2])
		add(c, c->vertex[v[0]], c->vertex[v[1]], c->vertex[v[2]]);
	else if (in[0] || in[1] || in[2])
		for (uint32_t k = 0; k < 3; k++)
			if (in[k] != in[(k + 1) % 3] && in[k] != in[(k + 2) % 3])
				cut_face(c, 3 * f + k);
}

void
mr_mesh_clip(mr_ctx *ctx, const mr_mesh *m, const double *value, mr_mesh *out)
{
	clip c = { .m = m, .value = value };
	mr_edges edges;

	mr_edges_build(ctx, m, &edges);
	c.p = MR_NEW(ctx, m->nv + edges.count, mr_v3);
	c.t = MR_NEW(ctx, 2 * m->nf, mr_tri);
	c.vertex = MR_NEW(ctx, m->nv, uint32_t);
	c.crossing = MR_NEW(ctx, 3 * m->nf, uint32_t);
	memset(c.vertex, 0xff, m->nv * sizeof *c.vertex);
	memset(c.crossing, 0xff, 3 * m->nf * sizeof *c.crossing);
	keep_vertices(&c);
	find_crossings(&c, &edges);
	for (size_t f = 0; f < m->nf; f++)
		if (!mr_face_repeats(m, f))
			take_face(&c, (uint32_t)f);
	c.out.name = m->name;
	c.out.p = c.p;
	c.out.t = c.t;
	*out = c.out;
}
