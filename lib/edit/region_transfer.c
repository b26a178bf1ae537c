/* Each base vertex takes the region of the corner of the mesh that it lies nearest to. */
#include "edit/region_transfer.h"

#include "base/parallel.h"
#include "space/bvh.h"

typedef struct transfer_job {
	const mr_mesh *mesh, *base;
	const uint32_t *region;
	const mr_places *map; /* or */
	const mr_bvh *bvh;
	uint32_t *out;
} transfer_job;

static uint32_t
nearest_corner(const mr_mesh *m, mr_place at)
{
	const double w[3] = { at.bary.x, at.bary.y, at.bary.z };
	const mr_tri *t = &m->t[at.face];
	int best = 0;

	for (int k = 1; k < 3; k++)
		if (w[k] > w[best] || (w[k] == w[best] && t->v[k] < t->v[best]))
			best = k;
	return t->v[best];
}

static void
transfer(void *arg, size_t begin, size_t end)
{
	transfer_job *j = arg;

	for (size_t v = begin; v < end; v++) {
		mr_place at = j->map ? mr_places_at(j->map, v) : mr_bvh_closest(j->bvh, j->base->p[v]).at;
		j->out[v] = j->region[nearest_corner(j->mesh, at)];
	}
}

static bool
any_face_has(const mr_mesh *m, const uint32_t *region, uint32_t which)
{
	for (size_t f = 0; f < m->nf; f++)
		for (int k = 0; k < 3; k++)
			if (region[m->t[f].v[k]] == which)
				return true;
	return false;
}

/* Every handle of the mesh must have a vertex of the base. */
static mr_status
check_handles(
    mr_ctx *ctx, const mr_mesh *mesh, const uint32_t *region, const uint32_t *out, const mr_mesh *base)
{
	enum { FIRST = MR_REGION_HANDLE };
	mr_mark mark = mr_mark_take(ctx);
	size_t handles = 0;
	bool *reached;

	for (size_t v = 0; v < mesh->nv; v++)
		if (region[v] >= FIRST && region[v] - FIRST >= handles)
			handles = region[v] - FIRST + 1;
	reached = MR_NEW_ZERO(ctx, handles, bool);
	for (size_t v = 0; v < base->nv; v++)
		if (out[v] >= FIRST)
			reached[out[v] - FIRST] = true;
	for (size_t v = 0; v < mesh->nv; v++)
		if (region[v] >= FIRST && !reached[region[v] - FIRST])
			return mr_fail(ctx, MR_EMESH, "%s: handle %u reaches no vertex: %s", base->name,
			    region[v] - FIRST,
			    any_face_has(mesh, region, region[v])
				? "it is smaller than a triangle, or farther from it than from others; "
				  "select more, or remesh finer"
				: "none of its vertices has a face");
	mr_mark_release(ctx, mark);
	return MR_OK;
}

static mr_status
transfer_regions(mr_ctx *ctx, const mr_mesh *mesh, const uint32_t *region, const mr_places *map,
    const mr_mesh *base, uint32_t *out)
{
	transfer_job j = { .mesh = mesh, .base = base, .region = region, .map = map, .out = out };
	mr_mark mark = mr_mark_take(ctx);
	mr_bvh *bvh;

	if (!map) {
		mr_note(ctx, "%s has no source map: regions are those of the closest points", base->name);
		mr_bvh_build(ctx, mesh, &bvh);
		j.bvh = bvh;
	}
	mr_parallel(ctx, base->nv, 1024, transfer, &j);
	mr_mark_release(ctx, mark);
	return check_handles(ctx, mesh, region, out, base);
}

bool
mr_transfer_applies(const mr_frame *f, const char *layer)
{
	return !strcmp(layer, "base") && mr_frame_find(f, "mesh", "region");
}

mr_status
mr_transfer_missing(mr_ctx *ctx, const mr_frame *f, const char *layer)
{
	if (strcmp(layer, "base") && mr_layer_has(f, "mesh", "region"))
		return mr_fail(ctx, MR_EMISSING,
		    "%s has no regions, though mesh has: mr-select -l %s selects those of %s", layer, layer,
		    layer);
	return mr_fail(ctx, MR_EMISSING, "%s has no regions: select some by mr-select", layer);
}

mr_status
mr_transfer_get(mr_ctx *ctx, mr_frame *f, const mr_mesh *base, const uint32_t **region)
{
	const uint32_t *on_mesh;
	mr_places map;
	mr_mesh mesh;
	uint32_t *r;
	bool mapped = mr_layer_has(f, "base", "source_face");

	if (!mr_transfer_applies(f, base->name)) {
		if (!mr_layer_has(f, base->name, "region"))
			return mr_transfer_missing(ctx, f, base->name);
		return mr_layer_region(ctx, f, base->name, base->nv, region);
	}
	MR_TRY(mr_layer_mesh(ctx, f, "mesh", &mesh));
	MR_TRY(mr_layer_region(ctx, f, "mesh", mesh.nv, &on_mesh));
	if (mapped)
		MR_TRY(mr_source_map_get(ctx, f, &mesh, base->nv, &map));
	r = MR_NEW(ctx, base->nv, uint32_t);
	*region = r;
	return transfer_regions(ctx, &mesh, on_mesh, mapped ? &map : NULL, base, r);
}
