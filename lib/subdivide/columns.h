/*
 * columns.h -- the columns of a layer on a finer level of its subdivision.
 */
#ifndef MR_SUBDIVIDE_COLUMNS_H
#define MR_SUBDIVIDE_COLUMNS_H

#include "mesh/layers.h"
#include "subdivide/loop.h"

enum { MR_CARRIED = 4 };

/* Columns on level n; data NULL: the layer does not have it. */
typedef struct mr_carried {
	const char *name;
	const void *data;
	size_t rows;
} mr_carried;

/*
 * Colours and texture coordinates are subdivided as positions are.  A new vertex has the lesser region of
 * the two vertices of its edge, a triangle the group of the one it is a part of.  out: in the arena.
 */
mr_status mr_subdivide_columns(
    mr_ctx *ctx, mr_frame *f, const char *layer, const mr_loop *level, size_t n, mr_carried out[MR_CARRIED]);

#endif
