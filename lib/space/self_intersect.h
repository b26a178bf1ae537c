/*
 * self_intersect.h -- which faces of a surface pass through one another.
 *
 * Contract: exact: every decision is the sign of a determinant (predicates.h), so
 * the count has no tolerance.  Two faces of positive area intersect when they
 * have more in common than the corner or the edge that they share; corners are
 * the same where their positions are equal, whatever their numbers.  Faces that
 * share all three corners overlap.
 */
#ifndef MR_SPACE_SELF_INTERSECT_H
#define MR_SPACE_SELF_INTERSECT_H

#include "space/bvh.h"

/* True where the triangles p and q, of positive area, have more in common than a shared corner or edge. */
bool mr_triangles_intersect(const mr_v3 p[3], const mr_v3 q[3]);

/* True where the corners lie on a line or coincide: the area is exactly zero. */
bool mr_triangle_degenerate(mr_v3 a, mr_v3 b, mr_v3 c);

/* Calls visit(arg, f, g) once for each pair of faces that intersect, from several threads at once.  bvh: of
 * m, where the caller has one, or NULL.  Faces without area are left out. */
void mr_intersections_visit(mr_ctx *ctx, const mr_bvh *bvh, const mr_mesh *m,
    void (*visit)(void *arg, uint32_t f, uint32_t g), void *arg);

/* How many pairs of faces intersect; faces without area are left out.  bvh: of m, where the caller has one,
 * or NULL.  crosses: m->nf, the caller's: which faces they are; or NULL, which is cheaper.  *count: pairs. */
void mr_self_intersections(mr_ctx *ctx, const mr_bvh *bvh, const mr_mesh *m, bool *crosses, size_t *count);

#endif
