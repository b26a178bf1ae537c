/* What the tools keep from frame to frame.  Nothing here knows a solver, which a tool that needs none shall
 * not load. */
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
	if (cache->drop_deform)
		cache->drop_deform(cache);
	mr_ctx_free(&cache->deform_keep);
	mr_ctx_free(&cache->level_keep);
	mr_ctx_free(&cache->base_keep);
	free(cache);
}

mr_ctx *
mr_cache_arena(const mr_ctx *ctx, mr_ctx *keep)
{
	keep->threads = ctx->threads;
	keep->listener = ctx->listener;
	return keep;
}
