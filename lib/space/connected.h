/*
 * connected.h -- the parts that a surface, or a cloud of points, consists of.
 *
 * Contract: parts are numbered by size, the largest first, equal ones by their lowest vertex; neither depends
 * on the number of threads, nor for points on their order.
 */
#ifndef MR_SPACE_CONNECTED_H
#define MR_SPACE_CONNECTED_H

#include "space/sampling.h"

typedef struct mr_connected {
	uint32_t *part; /* nv: the number of each vertex's part, from 0 */
	size_t *size;   /* vertices of each part */
	size_t parts;
} mr_connected;

/* Parts that are connected by faces; a vertex without a face is one.  In the arena. */
void mr_connected_by_faces(mr_ctx *ctx, const mr_mesh *m, mr_connected *c);

/*
 * Parts of n finite points: two points are connected that are no farther from each other than each of them
 * reaches.  reach: n.  In the arena.
 */
void mr_connected_by_reach(mr_ctx *ctx, const mr_v3 *p, size_t n, const double *reach, mr_connected *c);

/*
 * The parts of a layer: by its faces, or where it has none at a distance; 0: by the points' spacing, for
 * which the layer's sampling is put into the frame.  f: NULL: m is of none.
 */
mr_status
mr_connected_of(mr_ctx *ctx, mr_frame *f, const mr_mesh *m, double distance, mr_connected *c) MR_WARN_UNUSED;

#endif
