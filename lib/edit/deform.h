/* deform.h -- boundary-constraint modelling: D^k p = 0 on free vertices, fixed and handle vertices given.
 * The system is factored once, on the rest positions; solves change right-hand sides only. */
#ifndef MR_EDIT_DEFORM_H
#define MR_EDIT_DEFORM_H

#include "edit/deform_opts.h"
#include "mesh/layers.h"

typedef struct mr_deform mr_deform;

/* Assembles and factors the system on the mesh `rest` with one region per vertex.  MR_EMESH without a free or
 * a constrained vertex, MR_ENUMERIC if not positive definite.  ties: or NULL.  *deform borrows nothing. */
mr_status mr_deform_new(mr_ctx *ctx, const mr_mesh *rest, const mr_ties *ties, const uint32_t *region,
    const mr_deform_opts *opts, mr_deform **deform) MR_WARN_UNUSED;

/* The figures of the set-up and of the last solve; remarks on what the user should know.  The residual is 0
 * but after mr_deform_measures(d, true). */
mr_solve_result mr_deform_report(mr_ctx *ctx, const mr_deform *d);
void mr_deform_measures(mr_deform *d, bool residual);

/* The highest handle that some vertex has, plus one. */
size_t mr_deform_handles(const mr_deform *d);

/* Poses the surface p0 by maps of the handles, p = T p0 + z, D^k z = 0 on the free vertices, or as an energy
 * has it (deform_energy.h); maps NULL: constrained vertices stay, and D^k p = 0.  MR_ERANGE where a map has
 * no vertex to move.  out: nv, the caller's, not p0. */
mr_status mr_deform_solve(mr_ctx *ctx, mr_deform *d, const mr_v3 *p0, const mr_deform_maps *maps, mr_v3 *out);

/* The response of every vertex to the handles' maps, for mr_pose_by_response: nv rows of 4 mr_deform_handles
 * values, the caller's. */
mr_status mr_deform_basis(mr_ctx *ctx, mr_deform *d, const mr_v3 *p0, double *response);

/* A factored system, used again as long as deltas leave all that it depends on.  Zeroed, it is empty. */
enum { MR_DEFORM_PARTS = 10 };

typedef struct mr_deform_cache {
	mr_ctx keep;                    /* of the system */
	mr_deform *deform;              /* NULL: empty */
	uint64_t part[MR_DEFORM_PARTS]; /* serials of the columns that it depends on */
} mr_deform_cache;

/* The system on `rest`, the frame's layer with the positions of `column`, under the regions that
 * mr_transfer_get finds; regions of the mesh become columns of the layer. */
mr_status mr_deform_cache_get(mr_deform_cache *cache, mr_ctx *ctx, mr_frame *f, const mr_mesh *rest,
    const char *column, const mr_deform_opts *opts, mr_deform **deform);

/* Puts the responses to the handles of the layer m, by mr_deform_basis.  MR_EMESH without a handle. */
mr_status mr_deform_put_basis(mr_ctx *ctx, mr_frame *f, const mr_mesh *m, mr_deform *d, const mr_v3 *p0);

#endif
