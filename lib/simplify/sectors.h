/*
 * sectors.h -- the sectors between the curves that meet in a corner.
 *
 * Private to this room.
 */
#ifndef MR_SIMPLIFY_SECTORS_H
#define MR_SIMPLIFY_SECTORS_H

#include "mesh/dynmesh.h"

/* Splits edges across from corners until the limit surface does not turn over there: Biermann, Levin, Zorin
 * 2000 (Piecewise smooth subdivision surfaces with normal control).  *sharp, the marks of curves at
 * half-edges, goes along.  Vertices keep their numbers. */
mr_status mr_fill_sectors(mr_ctx *ctx, mr_mesh *m, uint8_t **sharp);

#endif
