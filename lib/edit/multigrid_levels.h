/*
 * multigrid_levels.h -- coarser and coarser remeshings of a surface as the levels of a multigrid solver
 * (Botsch, Kobbelt 2004, section 4.4).
 *
 * The levels are not nested: an unknown has the value that barycentric interpolation gives at its place on
 * the next coarser mesh.
 */
#ifndef MR_EDIT_MULTIGRID_LEVELS_H
#define MR_EDIT_MULTIGRID_LEVELS_H

#include "mesh/mesh.h"
#include "solve/solver.h"

/*
 * Coarser levels of the mesh, an oriented manifold (else MR_EMESH).  number: of each vertex its unknown,
 * below n, or MR_NONE where it is constrained.  level, count: as in mr_hierarchy, in the arena, and so is all
 * that they hold; count is 0 where nothing can be coarsened.
 */
mr_status mr_hierarchy_build(
    mr_ctx *ctx, const mr_mesh *m, const uint32_t *number, size_t n, mr_coarser **level, size_t *count);

#endif
