/*
 * unfold.h -- takes folds out of a mesh.
 */
#ifndef MR_REMESH_UNFOLD_H
#define MR_REMESH_UNFOLD_H

#include "remesh/relax.h"

/*
 * Draws the vertices at edges that are near a fold (mesh/fold.h) towards the middle of their neighbours,
 * until none is left or it has been done 10 times.  Curves stay, and so do moves that would make a needle.  A
 * limb thinner than an edge may make the mesh fold: there the surface gives way.
 */
void mr_unfold(mr_dyn *d);

#endif
