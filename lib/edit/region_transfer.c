/* Each base vertex takes the region of the corner of the mesh that it lies nearest to; contacts of the mesh
 * follow from the base vertices it stands on. */
#include "edit/region_transfer.h"

#include "base/parallel.h"
#include "edit/detail.h"
#include "space/bvh.h"
#include "space/contact.h"

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

/* Every handle of the mesh must have a vertex of the base. */
static mr_status
check_handles(
    mr_ctx *ctx, const mr_mesh *mesh, const uint32_t *region, const uint32_t *out, const mr_mesh *base)
{
	MR_SCOPE(ctx);
	mr_regions want = mr_regions_of(ctx, region, mesh->nv), reached = mr_regions_of(ctx, out, base->nv);

	for (size_t r = MR_REGION_HANDLE; r < want.n; r++)
		if (want.count[r] && (r >= reached.n || !reached.count[r]))
			return mr_fail(ctx, MR_EMESH,
			    "%s: handle %zu reaches no vertex: it has no face, or is smaller than a "
			    "triangle, or farther from it than from others",
			    base->name, r - MR_REGION_HANDLE);
	return MR_OK;
}

static mr_status
transfer_regions(mr_ctx *ctx, const mr_mesh *mesh, const uint32_t *region, const mr_places *map,
    const mr_mesh *base, uint32_t *out)
{
	transfer_job j = { .mesh = mesh, .base = base, .region = region, .map = map, .out = out };
	MR_SCOPE(ctx);
	mr_bvh *bvh;

	if (!map) {
		mr_note(ctx, "%s has no source map: regions are those of the closest points", base->name);
		mr_bvh_build(ctx, mesh, &bvh);
		j.bvh = bvh;
	}
	mr_parallel(ctx, base->nv, 1024, transfer, &j);
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
	bool mesh_has = strcmp(layer, "base") && mr_layer_has(f, "mesh", "region");

	return mr_advise(ctx, MR_SELECT,
	    mr_fail(ctx, MR_EMISSING, "%s has no regions%s", layer, mesh_has ? ", though mesh has" : ""));
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

/* Ties */

/* The contacts of the mesh, of parts that are parts of the base too; of a vertex of the base one for each
 * other part, but where these take turns. */
static void
find_ties(mr_ctx *ctx, const mr_mesh *mesh, const mr_mesh *base, const mr_detail *d, mr_ties *ties)
{
	const double touch = 0.001; /* of the diagonal */
	mr_contacts contacts;
	uint32_t *component, *last;
	bool several;

	mr_components_label(ctx, base, &component, &several);
	if (!several)
		return;
	mr_contacts_find(ctx, mesh, touch * mr_mesh_diagonal(mesh), &contacts);
	ties->tie = MR_NEW(ctx, contacts.start[mesh->nv], mr_tie);
	ties->known = true;
	last = MR_NEW(ctx, base->nv, uint32_t);
	memset(last, 0xff, base->nv * sizeof *last);
	for (uint32_t v = 0; v < mesh->nv; v++)
		for (size_t i = contacts.start[v]; i < contacts.start[v + 1]; i++) {
			uint32_t on = nearest_corner(base, mr_places_at(&d->at, v)),
				 face = d->at.face[nearest_corner(mesh, contacts.at[i])],
				 other = component[base->t[face].v[0]];
			if (component[on] != other && last[on] != other)
				ties->tie[ties->n++] = (mr_tie){ on, face };
			last[on] = other;
		}
}

mr_status
mr_transfer_ties(mr_ctx *ctx, mr_frame *f, const mr_mesh *base, mr_ties *ties)
{
	mr_ties found = { 0 };
	mr_detail detail;
	mr_mesh mesh;

	*ties = found;
	if (strcmp(base->name, "base") || !mr_layer_has(f, "mesh", "detail_height") ||
	    !mr_layer_has(f, "mesh", "triangles"))
		return MR_OK;
	MR_TRY(mr_layer_mesh(ctx, f, "mesh", &mesh));
	MR_TRY(mr_detail_get(ctx, f, base, &detail));
	find_ties(ctx, &mesh, base, &detail, &found);
	*ties = found;
	return MR_OK;
}
