/*
 * surface_walk.h -- the closest point of a surface by walking on it from a nearby place.
 *
 * Contract: unlike a search of the whole surface, a walk stays on the sheet it
 * starts on: the other side of a finger or a fold is never taken.  Each step
 * comes strictly nearer, so it ends at a local minimum of the distance.
 */
#ifndef MR_SPACE_SURFACE_WALK_H
#define MR_SPACE_SURFACE_WALK_H

#include "mesh/mesh.h"
#include "space/bvh.h"

/* The nearest point met by walking from face f over edges and vertices. */
mr_closest mr_project_walk(const mr_mesh *m, const mr_topology *topo, uint32_t f, mr_v3 q);

/* The same from the nearest place of the faces that meet f: a point just beyond an acute edge is near the
 * inside of f as well, from where no step comes nearer. */
mr_closest mr_project_walk_around(const mr_mesh *m, const mr_topology *topo, uint32_t f, mr_v3 q);

/*
 * The nearest point on the curve that half-edge h lies on: walks along half-edges
 * whose `curve` is not MR_NONE and stops at vertices where other than two meet.
 * *on is the half-edge reached; it keeps h's direction only where the marks do.
 */
mr_closest mr_project_curve(
    const mr_mesh *m, const mr_topology *topo, const uint32_t *curve, uint32_t h, mr_v3 q, uint32_t *on);

#endif
