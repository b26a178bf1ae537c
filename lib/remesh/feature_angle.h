/*
 * feature_angle.h -- from what angle on the edges of a model are sharp, if it has such edges.
 */
#ifndef MR_REMESH_FEATURE_ANGLE_H
#define MR_REMESH_FEATURE_ANGLE_H

#include "mesh/mesh.h"

/*
 * The angle in degrees between the normals of two faces, from 20 to 90, that tells m's sharp edges from the
 * others; 180 where it has none.
 */
void mr_feature_angle(mr_ctx *ctx, const mr_mesh *m, const mr_topology *topo, double *degrees);

#endif
