/*
 * edge_collapse.h -- merging the ends of an edge: where to, at what cost, and whether the surface allows it.
 *
 * Private to this room.
 */
#ifndef MR_SIMPLIFY_EDGE_COLLAPSE_H
#define MR_SIMPLIFY_EDGE_COLLAPSE_H

#include "mesh/dynmesh.h"
#include "op/field.h"

enum { MR_RING_MAX = 32 }; /* most faces that a merged vertex may have */

/* The faces at one end of an edge alone: the half-edges by which they leave it, counter-clockwise but for
 * the gaps of a boundary. */
typedef struct mr_merge_ring {
	uint32_t he[MR_RING_MAX];
	unsigned n;
} mr_merge_ring;

/* The data of a vertex. */
typedef struct mr_site {
	mr_quadric q;    /* about its position */
	double room;     /* error that it may have */
	bool rim;        /* on the boundary */
	mr_field *field; /* about its position; NULL: none */
} mr_site;

/* The sum of the quadrics of the ends of an edge about its start. */
typedef struct mr_merge_sum {
	mr_quadric q;
	mr_quadric_factor factor;
	mr_v3 ab, x; /* the edge; the offset that about minimizes it */
	bool rim;    /* an end is on the boundary, or a curve */
} mr_merge_sum;

typedef struct mr_merge {
	uint32_t edge; /* one of its half-edges */
	mr_merge_sum sum;
	mr_merge_ring ring;
	mr_v3 p;       /* where the merged vertex goes */
	double cost;   /* by which merges are put in order */
	double error2; /* mean squared distance of p to the planes of the faces merged into it, by area */
} mr_merge;

/* Begins the cost of merging the ends of h: about a lower bound.  site: of every vertex. */
void mr_merge_begin(const mr_dyn *d, const mr_site *site, uint32_t h, mr_merge *m);

/* The rest of it.  False where the merged vertex would have more than MR_RING_MAX faces. */
bool mr_merge_finish(const mr_dyn *d, const mr_site *site, mr_merge *m);

/*
 * True where the merge turns no face by 78 degrees or more, makes no new fold, and leaves no face whose shape
 * (mr_dyn_shape) is below `needle` and below the worst before.
 */
bool mr_merge_is_sound(const mr_dyn *d, const mr_merge *m, double needle);

#endif
