/*
 * cache.h -- what the tools keep from frame to frame.
 *
 * Each thing has an arena of its own, so that one can be given up without the others.
 * Private to this room.
 */
#ifndef MR_TOOL_CACHE_H
#define MR_TOOL_CACHE_H

#include "edit/deform_cache.h"
#include "subdivide/displaced.h"

/* The faces around the vertices of base, and its normals where it was encoded: a delta mostly keeps them. */
typedef struct mr_connectivity_cache {
	mr_incidence base;
	mr_v3 *rest_normal;
	uint64_t base_serial; /* of its triangles; 0: none */
	uint64_t rest_serial; /* of base.encoded; 0: none */
} mr_connectivity_cache;

struct mr_cache {
	mr_ctx deform_keep, level_keep, base_keep;
	mr_deform_cache deform;
	void (*drop_deform)(struct mr_cache *cache); /* by who made it; NULL: there is none */
	mr_level_cache level;
	mr_connectivity_cache connectivity;
};

/* The arena `keep` of a cache, with the threads and the listener of the frame's. */
mr_ctx *mr_cache_arena(const mr_ctx *ctx, mr_ctx *keep);

/* Levels 0 to n of the frame's layer m: those of the cache, if there is one and it still has them. */
mr_status mr_cache_levels(mr_ctx *ctx, mr_cache *cache, mr_frame *f, const mr_mesh *m, double crease,
    size_t n, const mr_loop **level);

#endif
