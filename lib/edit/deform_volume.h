/*
 * deform_volume.h -- the volume that a patch encloses, and the pressure that keeps it.
 *
 * Private to this room.
 */
#ifndef MR_EDIT_DEFORM_VOLUME_H
#define MR_EDIT_DEFORM_VOLUME_H

#include "edit/deform_parts.h"

#include <math.h>

/* An edge where the patch ends: the way back is missing `sides` times. */
typedef struct mr_rim {
	uint32_t from, to;
	int sides;
	uint32_t cap; /* of its loop */
} mr_rim;

/* Cones over the loops of the rim close the surface. */
typedef struct mr_volume {
	bool encloses; /* else there is none: the surface has a boundary that is free */
	const mr_tri *t;
	const mr_rim *rim;
	size_t nf, rims, caps;
	/* Workspace, for each cap. */
	mr_v3 *center;
	double *sides;
} mr_volume;

/* Of the patch. */
mr_status mr_volume_make(mr_ctx *ctx, const mr_deform *d, mr_volume *v);

/*
 * Whether `now` is at least that share of `rest`, which a body keeps of its volume without pressure.  Sheets
 * and dents enclose next to nothing, or the reverse.
 */
static inline bool
mr_volume_is_kept(double now, double rest, double share)
{
	return now / rest >= share && isfinite(now / rest);
}

/* Where the vertices are at p. */
double mr_volume_of(const mr_ctx *ctx, const mr_volume *v, const mr_v3 *p);

/*
 * Moves the free vertices by as much pressure as makes the volume `least`.  source: its derivative by each
 * vertex of the patch.  q: where those are, destroyed; p: the same, of the mesh.
 */
mr_status mr_volume_keep(mr_ctx *ctx, mr_deform *system, const mr_volume *v, double least,
    const double *source, mr_v3 *q, mr_v3 *p);

#endif
