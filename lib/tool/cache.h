/*
 * cache.h -- what the tools keep from frame to frame.
 *
 * Each thing has an arena of its own, so that one can be given up without the others.
 * Private to this room.
 */
#ifndef MR_TOOL_CACHE_H
#define MR_TOOL_CACHE_H

#include "edit/deform_cache.h"
#include "mesh/edges.h"
#include "space/contact.h"
#include "subdivide/displaced.h"

/* Where the vertices of mesh stood once. */
typedef struct mr_stood {
	mr_v3 *p;
	uint64_t serial[2]; /* of the column of base, and of mesh.detail_height */
	double gain;
	size_t rows;
} mr_stood;

/* The faces around the vertices of base, its normals where it was encoded, mesh as it was then, the edges and
 * contacts of mesh, and what stood on control as it was encoded: a delta mostly keeps them. */
typedef struct mr_connectivity_cache {
	mr_incidence base;
	mr_v3 *rest_normal;
	mr_stood at_rest, before; /* as mesh was encoded, and when the pose began */
	mr_edges mesh;
	uint64_t base_serial, mesh_serial; /* of their triangles; 0: none */
	uint64_t rest_serial;              /* of base.encoded; 0: none */
	mr_contacts contacts;              /* of mesh */
	uint64_t place_serial;             /* of mesh.position */
	mr_mesh displaced;                 /* the displaced surface on control.encoded */
	mr_edges displaced_edges;
	const mr_v3 *displaced_foot;              /* the limit points that it is displaced from */
	uint64_t displaced_serial, height_serial; /* of control.encoded and displacement.height; 0: none */
	/* Since the last key: harm, what is far, what strayed, what came apart, what was not held, long
	 * edges, percent of the volume. */
	size_t told, told_far, told_strayed, told_apart, told_held, told_chords, told_volume;
	size_t looked_folds; /* of the last look for intersections since then */
	size_t frames;       /* since then */
} mr_connectivity_cache;

struct mr_cache {
	mr_ctx deform_keep, level_keep, base_keep, mesh_keep, displaced_keep;
	mr_deform_cache deform;
	void (*drop_deform)(struct mr_cache *cache); /* by who made it; NULL: there is none */
	mr_level_cache level;
	mr_connectivity_cache connectivity;
	bool turned_far;    /* since the key, by a response: said once */
	bool told_few;      /* since the key, of handles: said once */
	size_t told_folded; /* since the key, by mr-subdivide */
};

/* Whether to tell of n: of a sequence, that was told of *told, again where it has doubled.  told: NULL, no
 * sequence. */
static inline bool
mr_is_news(size_t n, size_t *told)
{
	if (n == 0 || (told && n < 2 * *told))
		return false;
	if (told)
		*told = n;
	return true;
}

/* The arena `keep` of a cache, with the threads and the listener of the frame's. */
mr_ctx *mr_cache_arena(const mr_ctx *ctx, mr_ctx *keep);

/* Levels 0 to n of the frame's layer m: those of the cache, if there is one and it still has them. */
mr_status mr_cache_levels(mr_ctx *ctx, mr_cache *cache, mr_frame *f, const mr_mesh *m, double crease,
    size_t n, const mr_loop **level);

#endif
