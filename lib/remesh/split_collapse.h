/*
 * split_collapse.h -- steps 1 and 2 of the remeshing: splits and merges bring edges to the target length.
 *
 * Contract: topology, curves and corners stay; no merge folds or flips a face.
 */
#ifndef MR_REMESH_SPLIT_COLLAPSE_H
#define MR_REMESH_SPLIT_COLLAPSE_H

#include "remesh/blocks.h"
#include "remesh/relax.h"

/* Counts of the changes, and their options. */
typedef struct mr_resampled {
	size_t splits, collapses;
	size_t strung; /* collapses of vertices that edges which are too long hold on to */
	size_t most;   /* faces that there may be */
	mr_edge_queue queue;
} mr_resampled;

/* How many faces the surface may take, by area where its own are wider than an edge, and by length where they
 * are thinner; and how many equilateral ones have its area. */
typedef struct mr_demand {
	double flat, thin;
	double area;
} mr_demand;

/* MR_ERANGE with a sentence that names the length to take instead. */
mr_status mr_too_fine(mr_ctx *ctx, const mr_remesh_source *s, double faces, double most, double length);

mr_demand mr_remesh_demand(const mr_dyn *d, const mr_remesh_source *s);

/* The least power of two by which the targets are to be multiplied so that no edge is longer than 8/3 of
 * them. */
double mr_coarsest(const mr_dyn *d, const mr_remesh_source *s);

/* Splits the edges that are longer than 4/3 of their target times `coarser`, or stretched, at their middle.
 * MR_ERANGE where that takes more than done->most faces. */
mr_status
mr_split_long(mr_ctx *ctx, mr_dyn *d, const mr_remesh_source *s, double coarser, mr_resampled *done);

/* Merges the ends of edges that are shorter than 4/5 of their target, or squeezed.  Edges that are too long
 * already may stay at a merged vertex, once each: else it would be drawn along far. */
void mr_collapse_short(mr_ctx *ctx, mr_dyn *d, const mr_remesh_source *s, mr_resampled *done);

#endif
