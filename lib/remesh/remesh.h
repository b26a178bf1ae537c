/*
 * remesh.h -- area-equalizing isotropic remeshing (Botsch, Kobbelt 2004, section 4).
 */
#ifndef MR_REMESH_H
#define MR_REMESH_H

#include "space/source_map.h"

typedef struct mr_remesh_opts {
	double length; /* target edge length; 0: ratio times mr_mesh_edge_scale */
	double ratio;
	size_t rounds;      /* of split, collapse, flip, relocate */
	size_t area_passes; /* of area-based smoothing at most */
	double gravity;     /* exponent of the area in the centroid; 1 is the paper's */
	double feature;     /* dihedral angle in degrees from which an edge is kept; 180: none */
	double adaptive;    /* distance of an edge to the surface that sets the lengths; 0: uniform */
	bool project;       /* keep the vertices on the input surface */
} mr_remesh_opts;

#define MR_REMESH_DEFAULTS                                                                                   \
	{                                                                                                    \
		.ratio = 0.95, .rounds = 5, .area_passes = 20, .gravity = 1.5, .feature = 180,               \
		.project = true                                                                              \
	}

/*
 * Remeshes an oriented manifold m, boundary allowed; isolated vertices are left out.  MR_EMESH where
 * it is not manifold.  map: where its vertices lie on m.  out, map: in the
 * arena.  Figures: see man/mr-remesh.1.
 */
mr_status mr_remesh(mr_ctx *ctx, const mr_mesh *m, const mr_remesh_opts *o, mr_mesh *out, mr_source_map *map);

#endif
