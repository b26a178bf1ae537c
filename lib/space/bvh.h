/*
 * bvh.h -- a bounding volume hierarchy over the triangles of a mesh: nearest point, first hit of a ray.
 *
 * Contract: exact, in doubles, without tolerance, and deterministic. Of several nearest triangles the one
 * with the lowest index is returned, for any number of threads that built the tree.  The tree lives in the
 * arena; the mesh must outlive it.  Queries only read: any number of threads may ask at once.  From farther
 * off than 2^36 sizes of the mesh a nearest point is farther than the nearest by 2^-35 of its distance at
 * most.
 */
#ifndef MR_SPACE_BVH_H
#define MR_SPACE_BVH_H

#include "mesh/mesh.h"

typedef struct mr_bvh mr_bvh;

/* The point of a surface nearest to a query. */
typedef struct mr_closest {
	mr_place at; /* its face MR_NONE: nothing found */
	mr_v3 point;
	double dist2; /* squared distance; infinite where nothing was found */
} mr_closest;

/* The hit of a ray origin + t dir on a face; t in units of |dir|. */
typedef struct mr_ray_hit {
	mr_place at;
	double t;
} mr_ray_hit;

/* Builds the tree over all faces of m (finite positions, valid indices; degenerate faces allowed). */
void mr_bvh_build(mr_ctx *ctx, const mr_mesh *m, mr_bvh **bvh);

/* The nearest point of the surface; face MR_NONE where the mesh has no face.  Ties: the lowest face. */
mr_closest mr_bvh_closest(const mr_bvh *bvh, mr_v3 q);

/* The distances from n points, the caller's. */
void mr_bvh_distances(const mr_ctx *ctx, const mr_bvh *bvh, const mr_v3 *q, size_t n, double *distance);

/* The same, where it is nearer than sqrt(dist2); else face MR_NONE. */
mr_closest mr_bvh_closest_within(const mr_bvh *bvh, mr_v3 q, double dist2);

/*
 * The first hit with tmin <= t <= tmax, from either side of a face; ties: the lowest face.  dir need not have
 * unit length.  The intersection is watertight over shared edges and vertices: a ray that meets an edge hits
 * one of its faces. True where there is one; *hit is written only then.
 */
bool mr_bvh_ray(const mr_bvh *bvh, mr_v3 origin, mr_v3 dir, double tmin, double tmax, mr_ray_hit *hit);

/* The hit with the least |t| <= tmax, on either side of the origin. */
bool mr_bvh_ray_both(const mr_bvh *bvh, mr_v3 origin, mr_v3 dir, double tmax, mr_ray_hit *hit);

/* The distance of the nearest hit on either side of the origin that is no nearer than tmin; tmax if none is
 * nearer than that. */
double mr_bvh_across(const mr_bvh *bvh, mr_v3 origin, mr_v3 dir, double tmin, double tmax);

/* All faces, those that are near each other side by side: work in this order finds its data in the cache. */
const uint32_t *mr_bvh_order(const mr_bvh *bvh);

/*
 * Calls visit(arg, face) for every face whose bounding box meets the box, in an order fixed by the tree,
 * until visit returns false.  False where it did.
 */
bool mr_bvh_overlap(const mr_bvh *bvh, mr_box box, bool (*visit)(void *arg, uint32_t face), void *arg);

/*
 * The nearest point of a triangle, which may be degenerate (a segment, a point); face is 0.  On a side, the
 * barycentric coordinate of the corner opposite is exactly 0.
 */
mr_closest mr_triangle_closest(mr_v3 q, mr_v3 a, mr_v3 b, mr_v3 c);

/* The nearest point of face f. */
static inline mr_closest
mr_face_closest(const mr_mesh *m, uint32_t f, mr_v3 q)
{
	const uint32_t *v = m->t[f].v;
	mr_closest c = mr_triangle_closest(q, m->p[v[0]], m->p[v[1]], m->p[v[2]]);

	c.at.face = f;
	return c;
}

/* The nearest point of the side that half-edge h is, on its face. */
mr_closest mr_side_closest(const mr_mesh *m, uint32_t h, mr_v3 q);

#endif
