/* Places of a simplified mesh's vertices on the original. */
#include "base/parallel.h"
#include "simplify/simplify.h"
#include "space/contact.h"
#include "space/surface_walk.h"

typedef struct place_job {
	const mr_mesh *m; /* the surface placed on */
	const mr_topology *topo;
	const mr_bvh *bvh;
	const mr_mesh *from;       /* whose vertices are placed */
	const mr_v3 *normal;       /* of these */
	const uint32_t *start;     /* vertex of m that each walk starts at; MR_NONE: not known */
	const uint32_t *component; /* of each vertex of m */
	uint32_t *face;
	mr_v3 *bary;
} place_job;

/* Whether a place that is nearer than the walked one is on the same sheet. */
static bool
counts(const place_job *j, size_t i, uint32_t face)
{
	return face != MR_NONE && j->component[j->m->t[face].v[0]] == j->component[j->start[i]] &&
	       mr_dot(mr_face_cross(j->m, face), j->normal[i]) > 0;
}

/*
 * A walk stays on its sheet but may end at a local minimum.  A nearer place counts if it is on the same part
 * and its face looks to the same side as the vertex; else it lies on another sheet.
 */
static mr_closest
place(const place_job *j, size_t i)
{
	static const double rounding = 1e-12;
	mr_v3 q = j->from->p[i];
	mr_closest walked, near;

	if (j->start[i] == MR_NONE)
		return mr_bvh_closest(j->bvh, q);
	walked = mr_project_walk(j->m, j->topo, j->topo->out[j->start[i]] / 3, q);
	near = mr_bvh_closest_within(j->bvh, q, (1 - rounding) * walked.dist2);
	return counts(j, i, near.at.face) ? near : walked;
}

static void
place_body(void *arg, size_t begin, size_t end)
{
	place_job *j = arg;

	for (size_t i = begin; i < end; i++) {
		mr_closest c = place(j, i);
		j->face[i] = c.at.face;
		j->bary[i] = c.at.bary;
	}
}

mr_status
mr_simplify_map(mr_ctx *ctx, const mr_mesh *m, const mr_mesh *out, const uint32_t *onto, mr_places *map)
{
	uint32_t *face = MR_NEW(ctx, out->nv, uint32_t);
	mr_v3 *bary = MR_NEW(ctx, out->nv, mr_v3);
	MR_SCOPE(ctx);
	mr_v3 *normal = MR_NEW(ctx, out->nv, mr_v3);
	uint32_t *nearest = MR_NEW(ctx, out->nv, uint32_t), *component;
	bool several;
	mr_topology topo;
	mr_bvh *bvh;

	for (size_t v = 0; v < out->nv; v++)
		nearest[v] = MR_NONE;
	for (uint32_t v = 0; v < m->nv; v++) {
		uint32_t w = onto[v];
		if (w == MR_NONE)
			continue;
		if (nearest[w] == MR_NONE ||
		    mr_dist(m->p[v], out->p[w]) < mr_dist(m->p[nearest[w]], out->p[w]))
			nearest[w] = v;
	}
	mr_vertex_normals(out, normal);
	MR_TRY(mr_topology_build(ctx, m, &topo));
	mr_bvh_build(ctx, m, &bvh);
	mr_components_label(ctx, m, &component, &several);
	mr_parallel(ctx, out->nv, 1024, place_body,
	    &(place_job){ m, &topo, bvh, out, normal, nearest, component, face, bary });
	*map = (mr_places){ face, bary };
	return MR_OK;
}
