/*
 * cache.h -- what the tools keep from frame to frame.
 *
 * Private to this room.
 */
#ifndef MR_TOOL_CACHE_H
#define MR_TOOL_CACHE_H

#include "edit/deform.h"
#include "subdivide/displaced.h"

/* The faces around the vertices of base, and its normals where it was encoded: a delta mostly keeps them. */
typedef struct mr_connectivity_cache {
	mr_ctx keep;
	mr_incidence base;
	mr_v3 *rest_normal;
	uint64_t base_serial; /* of its triangles; 0: none */
	uint64_t rest_serial; /* of base.encoded; 0: none */
} mr_connectivity_cache;

struct mr_cache {
	mr_deform_cache deform;
	mr_level_cache level;
	mr_connectivity_cache connectivity;
};

/* The cache, or an empty one for this frame alone where it is NULL. */
mr_cache *mr_cache_for(mr_ctx *ctx, mr_cache *cache);

#endif
