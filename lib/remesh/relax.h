/*
 * relax.h -- tangential relaxation of a mesh over a source surface: step 4 of the remeshing and its area
 * passes.
 *
 * Contract: no face of positive area turns over: vertices that would turn one stay.
 */
#ifndef MR_REMESH_RELAX_H
#define MR_REMESH_RELAX_H

#include "mesh/dynmesh.h"
#include "space/bvh.h"

/* The surface that is remeshed; vertices of the mr_dyn lie on it at their `at`. */
typedef struct mr_remesh_source {
	const mr_mesh *m;
	const mr_topology *topo;
	const uint32_t *curve; /* as in mr_dyn, of the half-edges of the source */
	const double *length;  /* target edge length at each vertex; NULL: uniform */
	const double *mean;    /* of its corners' at each face, where there are lengths */
	double uniform;
} mr_remesh_source;

typedef struct mr_relax_opts {
	double damping; /* lambda, 0 to 1 */
	double gravity; /* exponent of the vertex area; 0: the plain centroid */
	size_t passes;
	bool project; /* back onto the source in the last pass */
} mr_relax_opts;

/* From the surface, in edge lengths: there may be a nearer place. */
static const double MR_FAR = 0.05;

/* Target edge length at vertex v. */
double mr_remesh_length(const mr_remesh_source *s, const mr_dyn *d, uint32_t v);

/*
 * The place of vertex v, were it at q, by a walk from its own place; where that ends far away or faces
 * against the normal of the mesh there, the best of those from the neighbours' places too.
 */
mr_closest mr_remesh_place(const mr_remesh_source *s, const mr_dyn *d, uint32_t v, mr_v3 q, mr_v3 normal);

/* True where a triangle of vertices v, placed at `at`, with that cross product points against the source at
 * all three. */
bool mr_remesh_against(
    const mr_remesh_source *s, const mr_dyn *d, const uint32_t *at, const uint32_t v[3], mr_v3 cross);

/* Passes of relaxation over all vertices. */
mr_status mr_relax(mr_ctx *ctx, mr_dyn *d, const mr_remesh_source *s, const mr_relax_opts *o);

/* Mixed Voronoi areas (Meyer et al. 2003) of the vertices in squares of `unit`, a length like the edges', as
 * precise as floats; 0 for dead ones.  area: d->nv values, the caller's. */
void mr_dyn_areas(mr_ctx *ctx, const mr_dyn *d, double unit, double *area);

#endif
