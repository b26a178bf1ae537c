/* fold.h -- a fold is an edge at which the normals of two faces are more than 170 degrees apart: MR_FOLD.
 * Moves of vertices stop short of it, at MR_NEAR_FOLD: an edge folded by 150 degrees would fold over in the
 * next steps. */
#ifndef MR_MESH_FOLD_H
#define MR_MESH_FOLD_H

#include "mesh/mesh.h"

static const double MR_FOLD = -0.984807753012208;      /* cosine of 170 degrees */
static const double MR_NEAR_FOLD = -0.866025403784439; /* of 150 */

/* True where faces with these normals, of any length, meet at more than the angle of that negative cosine;
 * one without a normal does not. */
static inline bool
mr_folds(mr_v3 m, mr_v3 n, double cosine)
{
	double mn = mr_dot(m, n);
	return mn < 0 && mn * mn > cosine * cosine * mr_norm2(m) * mr_norm2(n);
}

/* The folds of m; twin as in mr_topology. */
size_t mr_count_folds(const mr_ctx *ctx, const mr_mesh *m, const uint32_t *twin);

/* True where face f meets a neighbour at more than the angle of that cosine in `to`, and at more than in
 * `from`, the same mesh elsewhere. */
bool mr_folds_more(const mr_mesh *from, const mr_mesh *to, const uint32_t *twin, uint32_t f, double cosine);

#endif
