/*
 * displaced.h -- displaced subdivision surfaces: a control mesh and one scalar a vertex (Lee et al. 2000;
 * Jeong, Kim 2001, section 5).
 *
 * The domain of level n has the limit points v and unit limit normals n of the vertices on level n of Loop's
 * subdivision of the control mesh; the surface is v + h n.  A vertex has the same v and n on every level, so
 * the heights of level j are the first ones of any finer level.
 */
#ifndef MR_SUBDIVIDE_DISPLACED_H
#define MR_SUBDIVIDE_DISPLACED_H

#include "mesh/layers.h"
#include "subdivide/loop.h"

typedef struct mr_domain {
	size_t n;             /* its level */
	const mr_loop *level; /* 0 to n */
	mr_mesh m;            /* limit points, and the triangles of level n */
	const mr_v3 *normal;  /* unit; zero where the limit surface has none */
} mr_domain;

/* The domain of level n <= MR_LEVEL_MAX of the frame's control mesh, with the creases that are marked in it;
 * in the arena.  MR_EMESH where it is not an oriented manifold. */
mr_status mr_domain_of(mr_ctx *ctx, mr_frame *f, const mr_mesh *control, size_t n, mr_domain *d);

/* The domain on levels that stand, 0 to n, for the control mesh's positions: points and normals in the arena.
 */
void mr_domain_on(mr_ctx *ctx, const mr_mesh *control, const mr_loop *level, size_t n, mr_domain *d);

/*
 * Levels that serve frame after frame: they are used again where a delta frame has left the triangles as they
 * were, so they never change a byte of a result.  Zeroed, the cache is empty.
 */
typedef struct mr_level_cache {
	mr_ctx keep;
	mr_loop *level; /* NULL: empty */
	size_t n;
	double crease;
	uint64_t serial, mark_serial; /* of the layer's triangles, of its creases (0: none) */
} mr_level_cache;

/* Levels 0 to n of the frame's layer, which is m. */
mr_status mr_level_cache_get(mr_level_cache *cache, mr_ctx *ctx, mr_frame *f, const mr_mesh *m, double crease,
    size_t n, const mr_loop **level);

/* The level whose vertex count is nearest to `count`, in logarithm. */
mr_status mr_domain_level(mr_ctx *ctx, const mr_mesh *control, size_t count, size_t *n);

/* The displaced surface p = v + gain h n: d->m.nv positions, the caller's.  height: as many at least. */
void mr_domain_displace(const mr_ctx *ctx, const mr_domain *d, const double *height, double gain, mr_v3 *p);

/* The frame's heights over its control mesh: their level and all of them, checked to be finite and as many as
 * level n has. */
mr_status
mr_displacement_get(mr_ctx *ctx, mr_frame *f, const mr_mesh *control, size_t *n, const double **height);

/* Whether the frame's heights, if it has some, can stand on its control mesh: by number, not by value. */
mr_status mr_displacement_check(mr_ctx *ctx, mr_frame *f);

mr_status mr_displacement_put(mr_ctx *ctx, mr_frame *f, const mr_domain *d, const double *height);

#endif
