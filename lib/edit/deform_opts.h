/* deform_opts.h -- options of a deformation: how a surface gives way, and where its constraints go. */
#ifndef MR_EDIT_DEFORM_OPTS_H
#define MR_EDIT_DEFORM_OPTS_H

#include "mesh/mesh.h"
#include "solve/solver.h"

typedef struct mr_deform_opts {
	size_t order;          /* k: 1 membrane, 2 thin plate, 3 minimal variation of curvature */
	int areas;             /* mr_areas */
	bool unsymmetric;      /* the paper's own system; else a row scaling of it, which is symmetric */
	mr_solver_opts solver; /* an unsymmetric system wants MR_LU */
	bool choose;           /* multigrid where the factor of the kind asked for exceeds the memory */
	int rotations;         /* mr_rotations_choice, of poses by maps */
	size_t rounds;         /* of as-rigid-as-possible steps, on top of a pose */
	bool apart;            /* components neither hold to those that they touch, nor follow those near */
} mr_deform_opts;

#define MR_DEFORM_DEFAULTS                                                                                   \
	{                                                                                                    \
		.order = 2, .areas = MR_AREAS_VORONOI, .solver = MR_SOLVER_DEFAULTS,                         \
		.rotations = MR_ROTATIONS_LINEAR                                                             \
	}

/* Parts that touch though they are apart at rest: a vertex holds to a face of another component. */
typedef struct mr_tie {
	uint32_t vertex, face;
} mr_tie;

typedef struct mr_ties {
	size_t n;
	mr_tie *tie;
	bool known; /* all that touch are among them */
} mr_ties;

/* The handles' motions: `count` maps; missing ones are the identity. */
typedef struct mr_deform_maps {
	const mr_affine *t;
	const mr_v3 *turn; /* the logarithm of each one's rotation (handles.h); NULL: the smallest one */
	size_t count;
} mr_deform_maps;

/* The map of a region: fixed and free are at rest, absent handles too. */
static inline mr_affine
mr_deform_map(const mr_deform_maps *maps, uint32_t region)
{
	return region >= MR_REGION_HANDLE && region - MR_REGION_HANDLE < maps->count
	           ? maps->t[region - MR_REGION_HANDLE]
	           : mr_identity();
}

#endif
