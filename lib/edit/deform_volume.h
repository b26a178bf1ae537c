/*
 * deform_volume.h -- the volume that a patch encloses, and the pressure that keeps it.
 *
 * With g the derivative of the volume by the vertices, p moves along K^-1 g, the way of least energy, until
 * the volume is right, which is a cubic of how far.  Private to this room.
 */
#ifndef MR_EDIT_DEFORM_VOLUME_H
#define MR_EDIT_DEFORM_VOLUME_H

#include "edit/deform_system.h"

/* The patch's own faces, and behind them those that close it over its rim, which go with the constraints. */
typedef struct mr_inside {
	mr_tri *t; /* NULL: the patch ends at a boundary that is free, and encloses nothing */
	size_t nf;
} mr_inside;

/* region: of each vertex of the mesh. */
void mr_inside_make(mr_ctx *ctx, const mr_patch *patch, const uint32_t *region, mr_inside *v);

/* Where the mesh has its vertices at p. */
double mr_inside_volume(const mr_ctx *ctx, const mr_inside *v, const mr_patch *patch, const mr_v3 *p);

/* Moves the free vertices by as much pressure as makes the volume `least`. */
mr_status
mr_inside_keep(mr_ctx *ctx, mr_deform_system *s, const mr_inside *v, double least, mr_v3 *p) MR_WARN_UNUSED;

#endif
