/*
 * relax.h -- tangential relaxation of a mesh over a source surface: step 4 of the remeshing and its area
 * passes.
 *
 * Contract: no face of positive area turns over: vertices that would turn one stay.
 * Layer rule: alg.
 */
#ifndef MR_RELAX_H
#define MR_RELAX_H

#include "alg/dynmesh.h"

/* The surface that is remeshed; vertices of the mr_dyn lie on it at their `at`. */
typedef struct mr_surface {
	const mr_mesh *m;
	const mr_topology *topo;
	const uint32_t *curve; /* as in mr_dyn, as the source was */
	const double *length;  /* target edge length at each vertex; NULL: uniform */
	double uniform;
} mr_surface;

typedef struct mr_relax_opts {
	double damping; /* lambda, 0 to 1 */
	double gravity; /* exponent of the vertex area; 0: the plain centroid */
	bool project;   /* back onto the source afterwards */
} mr_relax_opts;

/* Target edge length at vertex v. */
double mr_surface_length(const mr_surface *s, const mr_dyn *d, uint32_t v);

/* One pass of relaxation over all vertices. */
mr_status mr_relax(mr_ctx *ctx, mr_dyn *d, const mr_surface *s, const mr_relax_opts *o);

/* Mixed Voronoi areas (Meyer et al. 2003) of the vertices; 0 for dead ones.  area: d->nv values, the
 * caller's. */
void mr_dyn_areas(const mr_ctx *ctx, const mr_dyn *d, double *area);

#endif
