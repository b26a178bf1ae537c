/* The system of the last frame serves as long as nothing that it was made of has changed. */
#include "edit/deform.h"

#include "edit/region_transfer.h"

/* The columns that the system depends on, by their serials: in a key frame and its deltas the same column has
 * the same. */
static void
identify(const mr_frame *f, const char *layer, const char *rest, uint64_t part[MR_DEFORM_PARTS])
{
	const char *const columns[MR_DEFORM_PARTS][2] = { { layer, rest }, { layer, "triangles" },
		{ layer, "region" }, { "mesh", "region" }, { "mesh", "triangles" }, { "mesh", "position" },
		{ "base", "source_face" }, { "base", "source_bary" }, { "mesh", "detail_face" },
		{ "mesh", "detail_bary" } };

	for (int i = 0; i < MR_DEFORM_PARTS; i++) {
		const mr_column *column = mr_frame_find(f, columns[i][0], columns[i][1]);
		part[i] = column ? column->serial : 0;
	}
}

mr_status
mr_deform_cache_get(mr_deform_cache *cache, mr_ctx *ctx, mr_frame *f, const mr_mesh *rest, const char *column,
    const mr_deform_opts *opts, mr_deform **deform)
{
	mr_ctx *keep = mr_keep(ctx, &cache->keep);
	uint64_t part[MR_DEFORM_PARTS];
	const uint32_t *region;
	mr_deform *made;
	mr_ties ties;

	identify(f, rest->name, column, part);
	if (f->key || !cache->deform || memcmp(part, cache->part, sizeof part)) {
		cache->deform = NULL;
		mr_ctx_free(keep);
		MR_TRY(mr_transfer_get(ctx, f, rest, &region));
		MR_TRY(mr_transfer_ties(ctx, f, rest, &ties));
		MR_TRY(mr_fail_as(ctx, keep, mr_deform_new(keep, rest, &ties, region, opts, &made)));
		cache->deform = made;
		memcpy(cache->part, part, sizeof part);
	}
	*deform = cache->deform;
	if (!mr_transfer_applies(f, rest->name))
		return MR_OK;
	return mr_layer_put(ctx, f, rest->name, "region", mr_deform_region(cache->deform), rest->nv);
}

mr_status
mr_deform_put_basis(mr_ctx *ctx, mr_frame *f, const mr_mesh *m, mr_deform *d, const mr_v3 *p0)
{
	enum { MOST = 63 }; /* a row has at most 255 components */
	size_t handles = mr_deform_handles(d);
	double *response;

	if (handles == 0)
		return mr_advise(
		    ctx, MR_SELECT_HANDLE, mr_fail(ctx, MR_EMESH, "%s: no handle to respond to", m->name));
	if (handles > MOST)
		return mr_fail(ctx, MR_ERANGE, "%s: %zu handles are more than a response holds, %d", m->name,
		    handles, MOST);
	response = MR_NEW(ctx, 4 * handles * m->nv, double);
	MR_TRY(mr_deform_basis(ctx, d, p0, response));
	return mr_frame_put(
	    ctx, f, m->name, "response", (mr_shape){ 'v', 'd', (uint8_t)(4 * handles) }, response, m->nv);
}
