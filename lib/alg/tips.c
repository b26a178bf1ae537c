#include "alg/tips.h"

#include "alg/project.h"
#include "base/parallel.h"

static const double FAR = 0.5, TOO_FAR = 3; /* of the target length */

typedef struct tip {
	double dist2;
	uint32_t source, vertex; /* of the source; of the mesh, the nearest */
} tip;

typedef struct search {
	const mr_dyn *d;
	const mr_surface *s;
	mr_mesh view; /* of d */
	mr_topology topo;
	uint32_t *start; /* of each source vertex: a vertex of d that is near it on the surface, or MR_NONE */
	tip *tip;        /* of each source vertex */
} search;

/*
 * A vertex of d for each source vertex: those that lie on its faces, then by sweeps those of its
 * neighbours.  What is left without one is isolated.
 */
static void
find_starts(search *w)
{
	const mr_mesh *m = w->s->m;
	bool spread = true;

	memset(w->start, 0xff, m->nv * sizeof *w->start);
	for (uint32_t v = 0; v < w->d->nv; v++) {
		uint32_t f = w->d->kind[v] == MR_SMOOTH ? w->d->at[v] : w->d->at[v] / 3;
		for (int k = 0; k < 3; k++)
			w->start[m->t[f].v[k]] = v;
	}
	while (spread) {
		spread = false;
		for (size_t f = 0; f < m->nf; f++)
			for (int k = 0; k < 3; k++) {
				uint32_t a = m->t[f].v[k], b = m->t[f].v[(k + 1) % 3];
				if (w->start[a] != MR_NONE && w->start[b] == MR_NONE) {
					w->start[b] = w->start[a];
					spread = true;
				}
			}
	}
}

/* The corner of face f that is nearest to the point. */
static uint32_t
nearest_corner(const mr_dyn *d, uint32_t f, mr_v3 p)
{
	uint32_t best = d->v[3 * f];

	for (uint32_t i = 1; i < 3; i++) {
		uint32_t v = d->v[3 * f + i];
		if (mr_norm2(mr_sub(d->p[v], p)) < mr_norm2(mr_sub(d->p[best], p)))
			best = v;
	}
	return best;
}

static void
search_body(void *arg, size_t begin, size_t end)
{
	search *w = arg;

	for (uint32_t i = (uint32_t)begin; i < end; i++) {
		mr_v3 p = w->s->m->p[i];
		w->tip[i] = (tip){ 0, i, 0 };
		if (w->start[i] == MR_NONE)
			continue;
		mr_closest c = mr_project_walk(&w->view, &w->topo, w->d->out[w->start[i]] / 3, p);
		w->tip[i] = (tip){ c.dist2, i, nearest_corner(w->d, c.face, p) };
	}
}

static int
farthest_first(const void *a, const void *b)
{
	const tip *x = a, *y = b;

	if (x->dist2 != y->dist2)
		return x->dist2 < y->dist2 ? 1 : -1;
	return x->source < y->source ? -1 : x->source > y->source;
}

/* True where moving v to p turns a face around it by more than 60 degrees or makes it a needle. */
static bool
turns_a_face(const mr_dyn *d, uint32_t v, mr_v3 p)
{
	uint32_t h = d->out[v];

	do {
		mr_v3 b = d->p[mr_dyn_to(d, h)], c = d->p[mr_dyn_apex(d, h)];
		mr_v3 before = mr_cross(mr_sub(b, d->p[v]), mr_sub(c, d->p[v])),
		      after = mr_cross(mr_sub(b, p), mr_sub(c, p));
		if (mr_dyn_shape(p, b, c) < MR_NEEDLE ||
		    mr_dot(before, after) < 0.5 * sqrt(mr_norm2(before) * mr_norm2(after)))
			return true;
		h = mr_dyn_ccw(d, h);
	} while (h != MR_NONE && h != d->out[v]);
	return false;
}

mr_status
mr_pin_tips(mr_ctx *ctx, mr_dyn *d, const mr_surface *s, size_t *pinned)
{
	mr_mark mark = mr_mark_take(ctx);
	size_t n = 0, nv = s->m->nv;
	search w = { d, s, mr_dyn_view(d, s->m->name), { d->twin, d->out }, MR_NEW(ctx, nv, uint32_t),
		MR_NEW(ctx, nv, tip) };

	if (!w.start || !w.tip)
		return MR_EMEM;
	find_starts(&w);
	mr_parallel(ctx, nv, 1024, search_body, &w);
	*pinned = 0;
	for (size_t i = 0; i < nv; i++) {
		double l = mr_surface_length(s, d, w.tip[i].vertex);
		if (w.tip[i].dist2 > FAR * FAR * l * l && w.tip[i].dist2 < TOO_FAR * TOO_FAR * l * l)
			w.tip[n++] = w.tip[i];
	}
	qsort(w.tip, n, sizeof *w.tip, farthest_first);
	for (size_t i = 0; i < n; i++) {
		uint32_t v = w.tip[i].vertex;
		mr_v3 p = s->m->p[w.tip[i].source];
		if (d->kind[v] != MR_SMOOTH || turns_a_face(d, v, p))
			continue;
		d->p[v] = p;
		d->at[v] = s->topo->out[w.tip[i].source];
		d->kind[v] = MR_CORNER;
		++*pinned;
	}
	mr_mark_release(ctx, mark);
	return MR_OK;
}
