/*
 * sharp_edges.h -- sharp edges of a mesh as curves, by the angles between its faces.
 */
#ifndef MR_SIMPLIFY_SHARP_EDGES_H
#define MR_SIMPLIFY_SHARP_EDGES_H

#include "mesh/dynmesh.h"

/*
 * Makes curves of the edges of d, that are sharp, or of those that it has, and of its boundary: its curve and
 * kind; false where none is sharp, and d as it was.  Corners are where other than two of them meet, and,
 * where `reach` is not 0, where one turns sharply and the most within that distance.  Pieces shorter than
 * `length`, or hardly sharper than the edges around, are dropped; where that is 0, none.
 */
bool mr_sharp_edges(mr_ctx *ctx, mr_dyn *d, double length, double reach);

/*
 * Marks the half-edges of the sharp edges that d has as curves, and where one turns sharply at a vertex
 * another edge there, by which it is a corner (Hoppe et al. 1994).  sharp: 3 d->nf, the caller's.
 */
void mr_mark_sharp_edges(const mr_dyn *d, uint8_t *sharp);

#endif
