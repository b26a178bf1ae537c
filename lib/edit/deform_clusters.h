/*
 * deform_clusters.h -- rotations of a pose, fitted in a model of few of them.
 *
 * The free surface falls into clusters, and each takes one map M = R S instead of one a vertex; those of the
 * constraints are given.  Then the vertices, which are where the membrane of the turned gradients has them,
 * and all that is linear in them, are linear in the maps: of the covariance of each cluster's edges with
 * those at rest, and of its mean place, the responses to every column of a map are solved for once.  A round
 * of an as-rigid-as-possible deformation is then a product with a matrix of at most 384 by 512 and a polar
 * decomposition a cluster, whatever the size of the surface (Jacobson, Baran, Kavan, Popovic, Sorkine 2012:
 * Fast automatic skinning transformations, where handles' weights take the place of our responses).
 *
 * Pressure is that on the normals of the rest, turned as the clusters are, so it is linear in the maps too.
 * It is as high as the volume of the complex that remains of the surface, with a place for each cluster, asks
 * for.
 *
 * Private to this room.
 */
#ifndef MR_EDIT_DEFORM_CLUSTERS_H
#define MR_EDIT_DEFORM_CLUSTERS_H

#include "edit/deform_rotations.h"

/* `outs` for each coordinate: three of a covariance for each cluster, then a place for each. */
struct mr_clusters {
	size_t count, outs;
	uint32_t *of;            /* of each vertex of the patch */
	uint32_t *region, *size; /* of each */
	double *weight;          /* mean of its vertices', as many as the rotations have */
	double *turned,
	    *pressed;     /* 3 count rows: of the columns of maps, and of pressure on what they turn */
	double *held;     /* 4 rows for each handle, and for what is fixed */
	mr_volume volume; /* of the complex */
	/* Workspace, of coordinates one after another. */
	double *base, *by_map, *by_pressure, *last;
	mr_v3 *place;
	mr_mat3 *map;
};

/* Makes d->rotations->clusters by six solutions a cluster, of the membrane that is there; none, and says so,
 * where the surface falls into more parts than there may be clusters. */
mr_status mr_clusters_make(mr_ctx *ctx, mr_deform *d);

/*
 * Fits the rotations, one a cluster, those of constraints as they are; in: where to start.  stretch: S of
 * each. keep: how much of its volume shall be left, where it has one to keep: *body.  Returns the pressure
 * for that.
 */
double mr_clusters_fit(const mr_ctx *ctx, const mr_deform *d, const mr_deform_maps *maps, double keep,
    const mr_mat3 *stretch, mr_mat3 *rotation, bool *body);

#endif
