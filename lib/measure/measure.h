/*
 * measure.h -- what a mesh is: counts of its connectivity, sizes, shapes of its triangles; what a cloud is.
 *
 * Contract: any mesh with valid indices and finite positions, manifold or not.  A
 * figure that is not defined (an angle where no face has area) is NaN.
 */
#ifndef MR_MEASURE_H
#define MR_MEASURE_H

#include "mesh/edges.h"
#include "space/sampling.h"

/*
 * Counts.  Faces that have a vertex twice count as degenerate and nowhere else.
 *
 *	euler       vertices that a face uses, less edges, plus faces
 *	genus       summed over components, boundary loops capped; oriented manifolds only
 *	boundary    edges of one face; loops of them, two that touch at a vertex are two
 *	non-manifold edges of three faces or more; vertices whose faces form more than one fan
 *	inconsistent edges of two faces that run along it in the same direction
 *	degenerate  faces with a vertex twice or of zero area (exactly)
 *	duplicate   faces with the corners of an earlier one, in any order
 *	isolated    vertices that no face uses
 *	folded      edges of two faces whose normals, consistently oriented, are more than 170 degrees apart
 */
typedef struct mr_census {
	size_t edges, components;
	int64_t euler, genus;
	bool oriented, manifold; /* no inconsistent edge; no non-manifold edge nor vertex */
	size_t boundary_edges, boundary_loops;
	size_t nonmanifold_edges, nonmanifold_vertices, inconsistent_edges;
	size_t degenerate_faces, duplicate_faces, isolated_vertices, folded_edges;
} mr_census;

mr_status mr_take_census(mr_ctx *ctx, const mr_mesh *m, const mr_edges *edges, mr_census *census);

/* Over some set of numbers; deviation is the standard deviation.  NaN of none. */
typedef struct mr_spread {
	double min, mean, max, deviation;
} mr_spread;

mr_spread mr_spread_of(const double *x, size_t n);

/* Sizes in units of the positions, angles in degrees. */
typedef struct mr_geometry {
	mr_box box;
	double diagonal, area;
	double volume;  /* enclosed, positive where normals point outward; only of a closed, oriented mesh */
	mr_spread edge; /* lengths */
	double angle_min, angle_max;
	double angle_error; /* mean |angle - 60| */
	double valence6;    /* share of the vertices in faces with 6 neighbours, 4 on the boundary */
} mr_geometry;

mr_status mr_measure_geometry(mr_ctx *ctx, const mr_mesh *m, const mr_edges *edges, mr_geometry *geometry);

/* Marks the ends of boundary edges.  boundary: nv, the caller's. */
void mr_mark_boundary(const mr_mesh *m, const mr_edges *edges, bool *boundary);

/* Of points, finite or not; all but these counts are of the finite ones.  NaN of one place, what has no
 * number. */
typedef struct mr_cloud_figures {
	size_t points, not_finite;
	size_t duplicates; /* points at the place of an earlier one */
	mr_box box;
	double diagonal;
	size_t places, outliers; /* of mr_sampling, as all that follows */
	mr_spread spacing;       /* of the places that are no outliers */
	double usual, area, evenness;
	double noise, noise_spacing, noise_diagonal; /* the same in median spacings, and in diagonals */
} mr_cloud_figures;

/* sampling: of the points, where it is known; NULL: found.  Fails as mr_sampling_find does. */
mr_status
mr_measure_cloud(mr_ctx *ctx, const mr_v3 *p, size_t n, const mr_sampling *sampling, mr_cloud_figures *cloud);

#endif
