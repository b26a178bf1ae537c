/*
 * extremities.h -- keeps the tips of thin limbs when remeshing.
 *
 * Tangential relaxation draws vertices back from tips that are thinner than an edge: the vertices stay on
 * the surface, but the surface's tip is left outside.  A tip shows in its Gaussian curvature: a hemisphere's,
 * 2 pi, lies within an edge length.
 */
#ifndef MR_REMESH_EXTREMITIES_H
#define MR_REMESH_EXTREMITIES_H

#include "remesh/relax.h"

/* Pins the vertices at the tips of the source, of which d is still a copy: they become corners. */
void mr_pin_tips(mr_ctx *ctx, mr_dyn *d, const mr_remesh_source *s);

#endif
