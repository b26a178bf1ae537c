/*
 * simplify.h -- simplification by quadric error metrics (Garland, Heckbert 1997).
 *
 * Layer rule: alg.
 */
#ifndef MR_SIMPLIFY_H
#define MR_SIMPLIFY_H

#include "mesh/mesh.h"

typedef struct mr_simplify_opts {
	size_t faces; /* stop at so many; 0: no such limit */
	double
	    error; /* stop where the next collapse would cost a distance of more; infinite: no such limit */
	double boundary; /* weight of the planes that hold boundary edges */
} mr_simplify_opts;

#define MR_SIMPLIFY_DEFAULTS                                                                                 \
	{                                                                                                    \
		.error = INFINITY, .boundary = 100                                                           \
	}

/*
 * Simplifies an oriented manifold m, boundary allowed; its topology stays (link condition) and no triangle is
 * flipped.  Where nothing more can be collapsed the result has more faces than asked for: the figure `faces`
 * tells.  onto: NULL, or m->nv: the vertex of the result that each was merged into (MR_NONE for an isolated
 * one).  out: in the arena.
 */
mr_status
mr_simplify(mr_ctx *ctx, const mr_mesh *m, const mr_simplify_opts *opts, mr_mesh *out, uint32_t *onto);

#endif
