/* Data that tools keep from frame to frame. */
#include "tool/cache.h"

mr_cache *
mr_cache_new(void)
{
	return calloc(1, sizeof(mr_cache));
}

static void
empty(void *what)
{
	mr_cache *cache = what;

	mr_ctx_free(&cache->deform.keep);
	mr_ctx_free(&cache->level.keep);
	mr_ctx_free(&cache->rest.keep);
}

void
mr_cache_delete(mr_cache *cache)
{
	if (!cache)
		return;
	empty(cache);
	free(cache);
}

mr_cache *
mr_cache_for(mr_ctx *ctx, mr_cache *cache)
{
	if (cache)
		return cache;
	cache = MR_NEW_ZERO(ctx, 1, mr_cache);
	mr_own(ctx, empty, cache);
	return cache;
}
