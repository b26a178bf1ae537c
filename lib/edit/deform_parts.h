/*
 * deform_parts.h -- what deform.c and deform_system.c set up and deform_solve.c solves with.
 *
 * With L the cotangent Laplacian and M the areas, D = -M^-1 L and, for free rows f, (D^k)_ff =
 * (-1)^k M_f^-1 [L (M^-1 L)^(k-1)]_ff: a row scaling of a symmetric matrix, called K.  Multiplying
 * comes before restricting, so K reaches k rings into the constraints.
 * Private to this room.
 */
#ifndef MR_EDIT_DEFORM_PARTS_H
#define MR_EDIT_DEFORM_PARTS_H

#include "base/rotation.h"
#include "edit/deform.h"
#include "edit/k_ring.h"
#include "mesh/layers.h"

enum { WIDTH = 4 }; /* right-hand sides solved together, at most */

/* A field over the patch: `width` values per vertex, next to each other. */
typedef struct mr_patch_field {
	double *u;        /* on the constraints given, on the free vertices to be solved for */
	double *stage[2]; /* workspace of as many rows */
	double *r;        /* of the free vertices, one column after another */
	size_t width;
	const double *source; /* K u = L (W L)^(k-2) W source instead of 0, its rows as those of u; NULL: 0 */
} mr_patch_field;

typedef struct mr_rotations mr_rotations; /* deform_rotations.h */
typedef struct mr_loose mr_loose;         /* deform_loose.h */

struct mr_deform {
	mr_deform_opts opts;
	size_t nv;
	uint32_t *region; /* nv */
	mr_patch patch;   /* the free vertices that are solved for, and k rings */
	mr_sparse l;      /* of the patch */
	double mean_area; /* of the patch's vertices */
	double *w;        /* mean area by area, per vertex of the patch: W = M^-1 */
	mr_sparse l_ff;   /* L of the free vertices alone, for multigrid */
	mr_sparse a;      /* K, which iterative solvers borrow */
	mr_hierarchy hierarchy;
	mr_solver *solver;   /* NULL where nothing is to be solved */
	mr_patch_field work; /* kept from solve to solve: fresh pages cost as much as the arithmetic */
	uint32_t lowest;     /* region that moves the whole: fixed, or the lowest handle's */
	size_t handles;
	size_t free, fixed, handled;  /* vertices */
	size_t loose, loose_vertices; /* free components without a constraint, their vertices */
	size_t narrow;                /* constrained vertices with less than k rings behind them */
	size_t nnz;
	double negative; /* share of the edges at free vertices whose weight is negative */
	double seconds_assemble, seconds_solve, residual;
	size_t refinements;
	double rounding;         /* of a solution of size 1, before it is refined */
	bool rough;              /* rounding is of no account */
	mr_ctx *keep;            /* of the arena that it lives in */
	mr_rotations *rotations; /* NULL until a pose asks for them */
	mr_loose *followers;     /* NULL: none */
};

/* Assembles the system and sets up its solver, on the mesh `rest` of which the patch is a part.  started:
 * when. */
mr_status mr_deform_assemble(mr_ctx *ctx, mr_deform *d, const mr_mesh *rest, double started);

/* The workspace as a field of this width, all 0. */
mr_patch_field mr_deform_field(const mr_deform *d, size_t width);

/* r = -(K u)_f, and what the source asks for. */
void mr_deform_residual(const mr_ctx *ctx, const mr_deform *d, mr_patch_field *f);

/* The system of order 1 on the same patch.  m: to be freed by mr_solver_free(m->solver); borrows d's. */
mr_status mr_deform_membrane(mr_ctx *ctx, mr_deform *d, mr_deform *m);

/* Finds d->rounding, by the workspace. */
mr_status mr_deform_rounding(mr_ctx *ctx, mr_deform *d);

/* The width columns of u on the free vertices from those on the constraints, by f's workspace. */
mr_status mr_deform_solve_field(mr_ctx *ctx, mr_deform *d, mr_patch_field *f);

/* p has the constraints where they go; the free vertices follow.  source: of p's differentials, or NULL. */
mr_status mr_deform_follow(
    mr_ctx *ctx, mr_deform *d, const mr_affine *whole, const mr_v3 *p0, const double *source, mr_v3 *p);

/* The map of a region: fixed and free are at rest, absent handles too. */
mr_affine mr_deform_map(const mr_deform_maps *maps, uint32_t region);

#endif
