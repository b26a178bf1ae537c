/*
 * deform.h -- boundary-constraint modelling: D^k p = 0 on free vertices, fixed and handle vertices given.
 *
 * Contract: the system is assembled and factored once, on the rest positions; every
 * solve after that changes right-hand sides only.  Regions are those of
 * mesh/layers.h.  A free component without a constrained vertex follows the
 * surface near it.
 */
#ifndef MR_EDIT_DEFORM_H
#define MR_EDIT_DEFORM_H

#include "mesh/mesh.h"
#include "solve/solver.h"

typedef struct mr_deform_opts {
	size_t order;          /* k: 1 membrane, 2 thin plate, 3 minimal variation of curvature */
	int areas;             /* mr_areas */
	bool unsymmetric;      /* the paper's own system; else a row scaling of it, which is symmetric */
	mr_solver_opts solver; /* an unsymmetric system wants MR_LU or MR_BICGSTAB */
	bool choose;           /* multigrid where the factor of the kind asked for exceeds the memory */
	double tol;            /* a direct solution of a larger relative residual is refined */
	bool turned;           /* poses by interpolated rotations; else linearly, as a basis always does */
	bool fitted;           /* and fitted ones: what is turned is as rigid as possible */
	size_t rounds;         /* of as-rigid-as-possible steps, on top of a pose */
	int loose;             /* mr_loose_choice: what free components without a constraint do */
	bool apart;            /* components that touch are not stitched to each other */
} mr_deform_opts;

#define MR_DEFORM_DEFAULTS                                                                                   \
	{                                                                                                    \
		.order = 2, .areas = MR_AREAS_VORONOI, .solver = MR_SOLVER_DEFAULTS, .tol = 1e-12            \
	}

typedef struct mr_deform mr_deform;

/* Parts that touch though they are apart at rest: a vertex holds to a face of another component. */
typedef struct mr_tie {
	uint32_t vertex, face;
} mr_tie;

typedef struct mr_ties {
	size_t n;
	mr_tie *tie;
	bool known; /* all that touch are among them */
} mr_ties;

/*
 * Assembles and factors the system on the mesh `rest` with one region per vertex.  MR_EMESH where
 * there is no free or no constrained vertex, MR_ENUMERIC where the matrix is not positive definite.  ties: or
 * NULL.
 * *deform borrows nothing; its memory is the arena's and the solver's: free it before the arena goes.
 */
mr_status mr_deform_new(mr_ctx *ctx, const mr_mesh *rest, const mr_ties *ties, const uint32_t *region,
    const mr_deform_opts *opts, mr_deform **deform) MR_WARN_UNUSED;

/* Accepts NULL. */
void mr_deform_free(mr_deform *d);

/* The figures of the set-up and of the last solve; remarks on what the user should know. */
mr_solve_result mr_deform_report(mr_ctx *ctx, const mr_deform *d);

/* The regions: one per vertex, d's. */
const uint32_t *mr_deform_region(const mr_deform *d);

/* The highest handle that some vertex has, plus one. */
size_t mr_deform_handles(const mr_deform *d);

/* The undeformed solve: constrained vertices stay at p, free ones go to the solution.  out: nv, the caller's,
 * may be p. */
mr_status mr_deform_relax(mr_ctx *ctx, mr_deform *d, const mr_v3 *p, mr_v3 *out);

/* Where handles go: as many maps as `count`, those missing are the identity. */
typedef struct mr_deform_maps {
	const mr_affine *t;
	const mr_v3 *turn; /* the logarithm of each one's rotation (handles.h); NULL: the smallest one */
	size_t count;
} mr_deform_maps;

/*
 * Poses p0 by the handles' maps: p = T p0 + z, D^k z = 0 on the free vertices, or where they turn or stretch
 * the differentials of p0 so (deform_rotations.h).  MR_ERANGE where a map has no vertex to move.
 * out: nv, the caller's, may be p0.
 */
mr_status mr_deform_pose(mr_ctx *ctx, mr_deform *d, const mr_v3 *p0, const mr_deform_maps *maps, mr_v3 *out);

/*
 * The same where each constrained vertex goes to a place of its own: p = p0 + z, D^k z = 0 on the free
 * vertices. target: nv, of which those of free vertices are not looked at.  out: nv, the caller's, may be p0.
 */
mr_status mr_deform_reach(mr_ctx *ctx, mr_deform *d, const mr_v3 *p0, const mr_v3 *target, mr_v3 *out);

/* A surface p0 and what poses it: handles' maps, or places, or (both NULL) nothing: the undeformed solve. */
typedef struct mr_deform_task {
	const mr_v3 *p0;
	const mr_deform_maps *maps;
	const mr_v3 *target;
} mr_deform_task;

/* The one of the three above that the task asks for. */
mr_status mr_deform_solve(mr_ctx *ctx, mr_deform *d, const mr_deform_task *task, mr_v3 *out);

/*
 * Solves the task by Cholesky too.  *error: the largest distance of a vertex of p from where that puts it, of
 * the diagonal; *condition: an estimate from below of the condition number of the system that is solved.
 * rest, ties: what d was made on.
 */
mr_status mr_deform_verify(mr_ctx *ctx, const mr_mesh *rest, const mr_ties *ties, const mr_deform *d,
    const mr_deform_task *task, const mr_v3 *p, double *error, double *condition);

/*
 * The response of every vertex to the handles' affine maps, for mr_pose_by_response.
 * response: nv rows of 4 mr_deform_handles values, the caller's.
 */
mr_status mr_deform_basis(mr_ctx *ctx, mr_deform *d, const mr_v3 *p0, double *response);

/*
 * p = p0 + sum over handles h of W_h (T_h - I), W_h the n x 4 block of the response; equal to
 * mr_deform_pose with the same maps where that is linear.  The identity gives p0 bit for bit.  response: n
 * rows of 4 handles values.  out: n, the caller's, may be p0.
 */
mr_status mr_pose_by_response(mr_ctx *ctx, const mr_v3 *p0, size_t n, const double *response, size_t handles,
    const mr_affine *t, mr_v3 *out);

#endif
