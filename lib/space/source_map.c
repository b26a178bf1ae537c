/* Places on a mesh: its own vertices', and their composition over another surface. */
#include "space/source_map.h"

#include "base/parallel.h"
#include "space/surface_walk.h"

/* The unit vector of corner k. */
static mr_v3
at_corner(int k)
{
	return mr_vec(k == 0, k == 1, k == 2);
}

void
mr_source_map_identity(mr_ctx *ctx, const mr_mesh *m, mr_places *map)
{
	uint32_t *face = MR_NEW_ZERO(ctx, m->nv, uint32_t);
	mr_v3 *bary = MR_NEW(ctx, m->nv, mr_v3);

	for (size_t v = 0; v < m->nv; v++)
		bary[v] = at_corner(0);
	for (uint32_t f = (uint32_t)m->nf; f-- > 0;)
		for (int k = 3; k-- > 0;) {
			uint32_t v = m->t[f].v[k];
			face[v] = f;
			bary[v] = at_corner(k);
		}
	*map = (mr_places){ face, bary };
}

/* True where each corner of the base is the same corner of the mesh: vertices without a face do not count. */
static bool
is_identity(const mr_mesh *mesh, const mr_mesh *base, const mr_places *map)
{
	if (!mr_same_triangles(mesh, base))
		return false;
	for (size_t f = 0; f < base->nf; f++)
		for (int k = 0; k < 3; k++) {
			uint32_t v = base->t[f].v[k];
			mr_v3 w = map->bary[v];
			const uint32_t *t = mesh->t[map->face[v]].v;
			if (!((w.x == 1 && t[0] == v) || (w.y == 1 && t[1] == v) || (w.z == 1 && t[2] == v)))
				return false;
		}
	return true;
}

/* The point of the mesh that vertex v of the base stands for. */
static mr_v3
source_point(const mr_mesh *mesh, const mr_places *map, uint32_t v)
{
	return mr_place_point(mesh, mr_places_at(map, v));
}

typedef struct compose_job {
	const mr_mesh *mesh, *base;
	const mr_topology *topo;
	const mr_places *base_map, *over;
	uint32_t *face;
	mr_v3 *bary;
} compose_job;

static void
compose_body(void *arg, size_t begin, size_t end)
{
	compose_job *j = arg;

	for (size_t i = begin; i < end; i++) {
		const uint32_t *t = j->base->t[j->over->face[i]].v;
		mr_v3 w = j->over->bary[i];
		int nearest = mr_largest(w);
		mr_v3 q = mr_bary_point(w, source_point(j->mesh, j->base_map, t[0]),
		    source_point(j->mesh, j->base_map, t[1]), source_point(j->mesh, j->base_map, t[2]));
		mr_closest c = mr_project_walk(j->mesh, j->topo, j->base_map->face[t[nearest]], q);
		j->face[i] = c.at.face;
		j->bary[i] = c.at.bary;
	}
}

/*
 * Composes maps: `over` places n vertices on the base, `base_map` the base's vertices on the mesh; *map
 * places the n vertices on the mesh.  If base and mesh have the same triangles and base_map is the identity,
 * so is the composition; else the point between the corners' points, drawn to the mesh by a walk from the
 * nearest corner.  map: in the arena.
 */
static mr_status
compose(mr_ctx *ctx, const mr_mesh *mesh, const mr_mesh *base, const mr_places *base_map,
    const mr_places *over, size_t n, mr_places *map)
{
	uint32_t *face;
	mr_v3 *bary;
	mr_topology topo;
	mr_mark mark;

	if (is_identity(mesh, base, base_map)) {
		*map = *over;
		return MR_OK;
	}
	face = MR_NEW(ctx, n, uint32_t);
	bary = MR_NEW(ctx, n, mr_v3);
	mark = mr_mark_take(ctx);
	MR_TRY(mr_topology_build(ctx, mesh, &topo));
	compose_job j = { mesh, base, &topo, base_map, over, face, bary };
	mr_parallel(ctx, n, 1024, compose_body, &j);
	mr_mark_release(ctx, mark);
	*map = (mr_places){ face, bary };
	return mr_source_map_check(ctx, mesh, n, map); /* distances may overflow */
}

mr_status
mr_source_map_check(mr_ctx *ctx, const mr_mesh *mesh, size_t base_nv, const mr_places *map)
{
	for (size_t v = 0; v < base_nv; v++) {
		mr_v3 w = map->bary[v];
		if (map->face[v] >= mesh->nf)
			return mr_fail(ctx, MR_ERANGE,
			    "base: vertex %zu lies on face %u of %s, which has %zu", v, map->face[v],
			    mesh->name, mesh->nf);
		if (!mr_bary_within(w))
			return mr_fail(ctx, MR_ERANGE,
			    "base: source_bary %zu (%g %g %g) is no place within a face of %s", v, w.x, w.y,
			    w.z, mesh->name);
	}
	return MR_OK;
}

mr_status
mr_source_map_get(mr_ctx *ctx, mr_frame *f, const mr_mesh *mesh, size_t base_nv, mr_places *map)
{
	const void *face, *bary;
	mr_places r;

	MR_TRY(mr_layer_get_rows(ctx, f, "base", "source_face", base_nv, &face));
	MR_TRY(mr_layer_get_rows(ctx, f, "base", "source_bary", base_nv, &bary));
	r = (mr_places){ face, bary };
	MR_TRY(mr_source_map_check(ctx, mesh, base_nv, &r));
	*map = r;
	return MR_OK;
}

mr_status
mr_source_map_follow(
    mr_ctx *ctx, mr_frame *f, const mr_mesh *m, const mr_places *over, size_t n, mr_places *map, bool *mapped)
{
	mr_places base_map;
	mr_mesh mesh;

	*map = *over;
	*mapped = true;
	if (!strcmp(m->name, "mesh"))
		return MR_OK;
	*mapped = !strcmp(m->name, "base") && mr_layer_has(f, "base", "source_face") &&
	          mr_layer_has(f, "mesh", "position");
	if (!*mapped)
		return MR_OK;
	MR_TRY(mr_layer_mesh(ctx, f, "mesh", &mesh));
	MR_TRY(mr_source_map_get(ctx, f, &mesh, m->nv, &base_map));
	return compose(ctx, &mesh, m, &base_map, over, n, map);
}

mr_status
mr_source_map_put(mr_ctx *ctx, mr_frame *f, const mr_places *map, size_t base_nv)
{
	MR_TRY(mr_layer_put(ctx, f, "base", "source_face", map->face, base_nv));
	return mr_layer_put(ctx, f, "base", "source_bary", map->bary, base_nv);
}
