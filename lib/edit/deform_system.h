/* deform_system.h -- the k-th power of the Laplacian on a patch.  With L the cotangent Laplacian, M the
 * areas, D = -M^-1 L and free rows f, (D^k)_ff = (-1)^k M_f^-1 [L (M^-1 L)^(k-1)]_ff: a row scaling of a
 * symmetric matrix, K, which reaches k rings into the constraints.  Private to this room. */
#ifndef MR_EDIT_DEFORM_SYSTEM_H
#define MR_EDIT_DEFORM_SYSTEM_H

#include "edit/deform_opts.h"

/* A patch: chosen vertices and k rings around them as a mesh of its own, numbered ring by ring, so that what
 * an operator over r rings needs is a prefix.  In the arena. */
enum { MR_PATCH_RINGS = 3 };

/* The faces of the patch are those with a corner in ring `rings` - 1 or nearer. */
typedef struct mr_patch {
	mr_mesh mesh;
	uint32_t *vertex; /* the patch's numbers to the mesh's; ascending in each ring */
	size_t own;       /* its first faces, that are among the first `own` of the mesh */
	size_t end[MR_PATCH_RINGS +
		   1]; /* end[r]: how many vertices are at most r rings away; end[0] the chosen */
} mr_patch;

/* level[v] becomes the distance of v from the nearest chosen vertex, in edges; `most` + 1 beyond `most`.
 * level: nv, the caller's. */
void mr_patch_levels(const mr_mesh *m, const bool *chosen, uint8_t most, uint8_t *level);

/* The chosen vertices of m, whose first `own` faces count as such, and 1 to MR_PATCH_RINGS rings. */
void
mr_patch_build(mr_ctx *ctx, const mr_mesh *m, size_t own, const bool *chosen, size_t rings, mr_patch *patch);

enum { MR_FIELD_WIDTH = 4 }; /* right-hand sides solved together, at most */

/* A field over the patch: `width` values per vertex, next to each other. */
typedef struct mr_field {
	double *u;        /* on the constraints given, on the free vertices solved for */
	double *stage[2]; /* workspace of as many rows */
	double *r;        /* of the free vertices, one column after another */
	size_t width;
	const double
	    *source; /* K u = L (W L)^(k-2) W source instead of 0, its rows ordered as in u; NULL: 0 */
} mr_field;

typedef struct mr_deform_system {
	mr_deform_opts opts;
	mr_patch patch; /* the free vertices that are solved for, and k rings */
	mr_sparse l;    /* of the patch */
	double *w;      /* mean area by area, per vertex of the patch: W = M^-1 */
	mr_sparse l_ff; /* L of the free vertices alone, for multigrid */
	mr_sparse a;    /* K, which iterative solvers borrow */
	mr_hierarchy hierarchy;
	mr_solver *solver; /* NULL where nothing is to be solved */
	mr_field work;     /* kept from solve to solve: fresh pages cost as much as the arithmetic */
	double negative;   /* share of the edges at free vertices whose weight is negative */
	bool measures;     /* the residual of each solve, which takes a tenth of its time */
	double seconds_assemble, residual;
} mr_deform_system;

/* Assembles the system of the patch, which is of the mesh `rest`, and sets up its solver.  started: when. */
mr_status mr_system_make(mr_ctx *ctx, const mr_mesh *rest, const mr_patch *patch, const mr_deform_opts *opts,
    double started, mr_deform_system *s);

/* The system of order 1 on the same patch.  m borrows s's. */
mr_status mr_system_membrane(mr_ctx *ctx, const mr_deform_system *s, mr_deform_system *m);

/* The workspace as a field of this width, all 0. */
mr_field mr_system_field(const mr_deform_system *s, size_t width);

/* The columns of u on the free vertices, 0 at first, from those on the constraints. */
mr_status mr_system_solve(mr_ctx *ctx, mr_deform_system *s, mr_field *f);

/* p has the constraints where they go; the free vertices follow from p0, where the whole has them.  source:
 * of the differentials minus the whole's, or NULL. */
mr_status mr_system_follow(mr_ctx *ctx, mr_deform_system *s, const mr_affine *whole, const mr_v3 *p0,
    const double *source, mr_v3 *p);

/* Coarser levels of the mesh, an oriented manifold (else MR_EMESH).  number: of each vertex its unknown below
 * n, or MR_NONE.  level, count: as in mr_hierarchy, in the arena. */
mr_status mr_hierarchy_build(
    mr_ctx *ctx, const mr_mesh *m, const uint32_t *number, size_t n, mr_coarser **level, size_t *count);

#endif
