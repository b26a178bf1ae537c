/* Turns a source map round: the parameterization of Botsch, Kobbelt 2004, section 4, from the other side. */
#include "edit/correspondence.h"

#include "base/parallel.h"
#include "space/bvh.h"

/* Gives each unlabelled vertex that hangs together with labelled ones the label that reaches it first. */
static mr_status
spread_labels(mr_ctx *ctx, const mr_mesh *m, uint32_t *label)
{
	uint32_t *queue = MR_NEW(ctx, m->nv, uint32_t);
	mr_incidence inc;
	size_t n = 0;

	if (!queue)
		return MR_EMEM;
	MR_TRY(mr_incidence_build(ctx, m, &inc));
	for (uint32_t v = 0; v < m->nv; v++)
		if (label[v] != MR_NONE)
			queue[n++] = v;
	for (size_t next = 0; next < n; next++)
		for (size_t i = inc.start[queue[next]]; i < inc.start[queue[next] + 1]; i++)
			for (int k = 0; k < 3; k++) {
				uint32_t w = m->t[inc.face[i]].v[k];
				if (label[w] != MR_NONE)
					continue;
				label[w] = label[queue[next]];
				queue[n++] = w;
			}
	return MR_OK;
}

/* Labels each vertex of the mesh with the nearest of the base vertices that lie on its faces, or, where none
 * does, with that of the neighbours nearest in connectivity.  lifted: the base on the mesh. */
static mr_status
label_vertices(mr_ctx *ctx, const mr_mesh *mesh, const mr_mesh *lifted, const mr_incidence *inc,
    const mr_places *source, uint32_t *label)
{
	double *dist2 = MR_NEW(ctx, mesh->nv, double);

	if (!dist2)
		return MR_EMEM;
	for (size_t i = 0; i < mesh->nv; i++) {
		label[i] = MR_NONE;
		dist2[i] = INFINITY;
	}
	for (uint32_t j = 0; j < lifted->nv; j++) {
		const uint32_t *c = mesh->t[source->face[j]].v;
		if (inc->start[j] == inc->start[j + 1])
			continue;
		for (int k = 0; k < 3; k++) {
			double d = mr_norm2(mr_sub(mesh->p[c[k]], lifted->p[j]));
			if (d < dist2[c[k]]) {
				label[c[k]] = j;
				dist2[c[k]] = d;
			}
		}
	}
	return spread_labels(ctx, mesh, label);
}

typedef struct walker {
	const mr_mesh *mesh, *lifted;
	const mr_incidence *inc;
	const uint32_t *label;
	uint32_t *face;
	mr_v3 *bary;
} walker;

/* The nearest place of the faces around a vertex. */
static mr_closest
nearest_around(const walker *w, uint32_t vertex, mr_v3 q)
{
	mr_closest best = { .at.face = MR_NONE, .dist2 = INFINITY };

	for (size_t i = w->inc->start[vertex]; i < w->inc->start[vertex + 1]; i++) {
		mr_closest c = mr_face_closest(w->lifted, w->inc->face[i], q);
		if (c.dist2 < best.dist2)
			best = c;
	}
	return best;
}

/* From vertex to vertex while that comes nearer. */
static mr_closest
walk(const walker *w, uint32_t vertex, mr_v3 q)
{
	mr_closest near = nearest_around(w, vertex, q);

	for (;;) {
		mr_closest best = near;
		for (int k = 0; k < 3; k++) {
			uint32_t v = w->lifted->t[near.at.face].v[k];
			mr_closest c = v == vertex ? near : nearest_around(w, v, q);
			if (c.dist2 < best.dist2) {
				best = c;
				vertex = v;
			}
		}
		if (!(best.dist2 < near.dist2))
			return near;
		near = best;
	}
}

static void
walk_piece(void *arg, size_t begin, size_t end)
{
	const walker *w = arg;

	for (size_t i = begin; i < end; i++) {
		w->face[i] = MR_NONE;
		if (w->label[i] != MR_NONE) {
			mr_closest c = walk(w, w->label[i], w->mesh->p[i]);
			w->face[i] = c.at.face;
			w->bary[i] = c.at.bary;
		}
	}
}

mr_status
mr_correspond(mr_ctx *ctx, const mr_mesh *mesh, const mr_mesh *base, const mr_incidence *inc,
    const mr_places *source, uint32_t *face, mr_v3 *bary)
{
	mr_mark mark = mr_mark_take(ctx);
	uint32_t *label = MR_NEW(ctx, mesh->nv, uint32_t);
	mr_v3 *on_mesh = MR_NEW(ctx, base->nv, mr_v3);
	mr_mesh lifted = *base;

	if (!label || !on_mesh)
		return MR_EMEM;
	for (size_t j = 0; j < base->nv; j++)
		on_mesh[j] = mr_place_point(mesh, mr_places_at(source, j));
	lifted.p = on_mesh;
	MR_TRY(label_vertices(ctx, mesh, &lifted, inc, source, label));
	mr_parallel(ctx, mesh->nv, 1024, walk_piece, &(walker){ mesh, &lifted, inc, label, face, bary });
	mr_mark_release(ctx, mark);
	return MR_OK;
}
