/* turning.h -- how a surface that is dragged turns around each of its vertices. */
#ifndef MR_PAGE_TURNING_H
#define MR_PAGE_TURNING_H

#include "base/rotation.h"
#include "mesh/mesh.h"

typedef float v4 __attribute__((vector_size(16)));
typedef int m4 __attribute__((vector_size(16)));
typedef double d4 __attribute__((vector_size(32)));

typedef struct mat {
	v4 x, y, z; /* columns; the fourth row is of no meaning */
} mat;

/* Four at a time: the k-th of each vector is of the k-th. */
typedef struct quat {
	v4 w, x, y, z;
} quat;

typedef struct mr_turning {
	size_t nv, nf;
	const mr_tri *t;
	const float (*rest)[9]; /* of the faces */
	mr_adjacency around;    /* with itself */
	float *weight;
	const v4 *normal; /* at rest */
	mat *sum, *other;
	quat *q;
	v4 *turned; /* the normals */
} mr_turning;

/* Of the surface at rest, with its normals; in the arena. */
mr_status mr_turning_begin(mr_ctx *ctx, const mr_mesh *m, const mr_v3 *normal, mr_turning *t) MR_WARN_UNUSED;

/* Finds the turns, and the normals turned, where its vertices are at p. */
void mr_turning_find(mr_turning *t, const d4 *p);

/* The rotation nearest to the mean of those of three vertices. */
mr_mat3 mr_turning_mean(const mr_turning *t, const uint32_t corner[3], const float weight[3]);

#endif
