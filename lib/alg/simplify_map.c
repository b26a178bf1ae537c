/* Where the vertices of a mesh lie on what it was simplified to, and the reverse. */
#include "alg/project.h"
#include "alg/simplify.h"
#include "base/parallel.h"

typedef struct walk_job {
	const mr_mesh *m; /* the surface walked on */
	const mr_topology *topo;
	const mr_v3 *p;       /* what is placed on it */
	const uint32_t *from; /* vertex of m that each starts at; MR_NONE: not known */
	const mr_bvh *bvh;    /* where some are not known */
	uint32_t *face;
	mr_v3 *bary;
} walk_job;

static void
walk_body(void *arg, size_t begin, size_t end)
{
	walk_job *j = arg;

	for (size_t i = begin; i < end; i++) {
		mr_closest c = j->from[i] == MR_NONE
		                   ? mr_bvh_closest(j->bvh, j->p[i])
		                   : mr_project_walk(j->m, j->topo, j->topo->out[j->from[i]] / 3, j->p[i]);
		j->face[i] = c.face;
		j->bary[i] = c.bary;
	}
}

/* Places n points on m by walks from vertices of it. */
static mr_status
walk(mr_ctx *ctx, const mr_mesh *m, const mr_v3 *p, const uint32_t *from, size_t n, mr_source_map *map)
{
	uint32_t *face = MR_NEW(ctx, n, uint32_t);
	mr_v3 *bary = MR_NEW(ctx, n, mr_v3);
	mr_mark mark = mr_mark_take(ctx);
	mr_bvh *bvh = NULL;
	mr_topology topo;

	if (!face || !bary)
		return MR_EMEM;
	MR_TRY(mr_topology_build(ctx, m, &topo));
	for (size_t i = 0; i < n && !bvh; i++)
		if (from[i] == MR_NONE)
			MR_TRY(mr_bvh_build(ctx, m, &bvh));
	mr_parallel(ctx, n, 1024, walk_body, &(walk_job){ m, &topo, p, from, bvh, face, bary });
	mr_mark_release(ctx, mark);
	*map = (mr_source_map){ face, bary };
	return MR_OK;
}

mr_status
mr_simplify_map(mr_ctx *ctx, const mr_mesh *m, const mr_mesh *out, const uint32_t *onto, mr_source_map *map)
{
	return walk(ctx, out, m->p, onto, m->nv, map);
}

mr_status
mr_simplify_source(
    mr_ctx *ctx, const mr_mesh *m, const mr_mesh *out, const uint32_t *onto, mr_source_map *map)
{
	uint32_t *nearest = MR_NEW(ctx, out->nv, uint32_t);

	if (!nearest)
		return MR_EMEM;
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
	return walk(ctx, m, out->p, nearest, out->nv, map);
}
