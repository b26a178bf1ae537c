/* Levels of subdivision, from frame to frame. */
#include "tool/cache.h"

mr_status
mr_cache_levels(mr_ctx *ctx, mr_cache *cache, mr_frame *f, const mr_mesh *m, double crease, size_t n,
    const mr_loop **level)
{
	mr_level_cache own = { 0 };
	mr_ctx *keep = cache ? mr_cache_arena(ctx, &cache->level_keep) : ctx;

	return mr_fail_as(
	    ctx, keep, mr_level_cache_get(cache ? &cache->level : &own, keep, f, m, crease, n, level));
}
