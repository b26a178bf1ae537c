/* What the tools keep from frame to frame.  Without a cache it is built in the frame's own arena. */
#include "tool/cache.h"

mr_cache *
mr_cache_new(void)
{
	return calloc(1, sizeof(mr_cache));
}

void
mr_cache_delete(mr_cache *cache)
{
	if (!cache)
		return;
	mr_deform_cache_free(&cache->deform, &cache->deform_keep);
	mr_ctx_free(&cache->deform_keep);
	mr_ctx_free(&cache->level_keep);
	mr_ctx_free(&cache->incidence_keep);
	free(cache);
}

mr_ctx *
mr_cache_arena(const mr_ctx *ctx, mr_ctx *keep)
{
	keep->threads = ctx->threads;
	keep->listener = ctx->listener;
	return keep;
}

/* What failed in the arena that outlives frames is said in the frame's. */
static mr_status
say_in(mr_ctx *ctx, const mr_ctx *keep, mr_status status)
{
	return status < 0 && keep != ctx ? mr_fail(ctx, status, "%s", keep->error) : status;
}

mr_status
mr_cache_levels(mr_ctx *ctx, mr_cache *cache, const mr_frame *f, const mr_mesh *m, double crease, size_t n,
    const mr_loop **level)
{
	mr_level_cache own = { 0 };
	mr_ctx *keep = cache ? mr_cache_arena(ctx, &cache->level_keep) : ctx;

	return say_in(
	    ctx, keep, mr_level_cache_get(cache ? &cache->level : &own, keep, f, m, crease, n, level));
}

mr_status
mr_cache_incidence(mr_ctx *ctx, mr_cache *cache, const mr_frame *f, const mr_mesh *base, mr_incidence *inc)
{
	uint64_t serial = mr_frame_find(f, base->name, "triangles")->serial;
	mr_incidence_cache *kept = cache ? &cache->incidence : NULL;
	mr_ctx *keep;

	if (!cache)
		return mr_incidence_build(ctx, base, inc);
	if (f->key || !serial || serial != kept->serial) {
		keep = mr_cache_arena(ctx, &cache->incidence_keep);
		mr_ctx_free(keep);
		kept->serial = 0;
		MR_TRY(say_in(ctx, keep, mr_incidence_build(keep, base, &kept->inc)));
		kept->serial = serial;
	}
	*inc = kept->inc;
	return MR_OK;
}
