/* cache.h -- what the tools keep from frame to frame.  Private to this room. */
#ifndef MR_TOOL_CACHE_H
#define MR_TOOL_CACHE_H

#include "edit/deform.h"
#include "edit/detail.h"
#include "subdivide/displaced.h"

/* Base where it was encoded, prepared: a delta mostly keeps it. */
typedef struct mr_rest_cache {
	mr_ctx keep;
	const mr_prepared *prepared;
	uint64_t triangles, encoded; /* the serials of these columns of base; 0: none */
} mr_rest_cache;

struct mr_cache {
	mr_deform_cache deform;
	mr_level_cache level;
	mr_rest_cache rest;
};

/* The cache, or an empty one for this frame alone where it is NULL. */
mr_cache *mr_cache_for(mr_ctx *ctx, mr_cache *cache);

#endif
