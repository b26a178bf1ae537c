/*
 * simplify.h -- simplification by quadric error metrics (Garland, Heckbert 1997).
 */
#ifndef MR_SIMPLIFY_H
#define MR_SIMPLIFY_H

#include "op/field.h"
#include "space/near.h"
#include "space/sampling.h"
#include "space/source_map.h"

/* The points that a control mesh is for. */
typedef struct mr_simplify_cloud {
	const mr_v3 *p;
	size_t n;
	mr_near *near; /* alike */
	mr_sampling sampling;
} mr_simplify_cloud;

/* The parts of a mesh that stay.  All NULL: nothing. */
typedef struct mr_simplify_ties {
	uint8_t **sharp; /* its edges that *sharp marks (3 nf; *sharp NULL: sharp by the angles of its faces);
	                  * set to the marks of the result, in the arena, NULL if it has none */
	const bool *fixed; /* of each vertex: it stays */
	uint32_t **face;   /* out: of each face of the result one of before on its side of the curves */
	const double
	    *value;    /* `values` of each corner, as lengths by which the surface seems moved; NaN: none */
	size_t values; /* at most MR_VALUES */
	bool needles;  /* whether faces may be such */
} mr_simplify_ties;

/*
 * Simplifies an oriented manifold m, boundary allowed; its topology stays (link condition) and no triangle is
 * flipped.  If nothing more can be merged, more faces than asked for remain: see the result.  onto: m->nv,
 * the caller's: the vertex of the result that each was merged into (MR_NONE for an isolated one).  out: in
 * the arena.  ties, result: or NULL.
 */
mr_status mr_simplify(mr_ctx *ctx, const mr_mesh *m, const mr_simplify_opts *opts,
    const mr_simplify_ties *ties, mr_mesh *out, uint32_t *onto, mr_simplify_result *result);

/* The faces of a control mesh for n points; says where that is more than one for so many points as usual. */
size_t mr_simplify_faces_for(size_t n);

/* The most that it may have for the sake of its distance from them. */
size_t mr_simplify_most_faces_for(size_t n);

/* Fallback values if these are too few. */
size_t mr_simplify_fine_faces_for(size_t n);

/*
 * Weights that make a control mesh dense where points are dense: areas of the surface m count by the density
 * of points near them, so that all points count alike.  weight: m->nv, the caller's.
 */
mr_status mr_simplify_weigh(mr_ctx *ctx, const mr_mesh *m, const mr_simplify_cloud *c, double *weight);

/*
 * The places of the result's vertices on m: the nearest point if its face looks to the same side as the
 * vertex, else the end of a walk from the nearest of the vertices merged into it.  map: out->nv rows, in the
 * arena.
 */
mr_status
mr_simplify_map(mr_ctx *ctx, const mr_mesh *m, const mr_mesh *out, const uint32_t *onto, mr_places *map);

#endif
