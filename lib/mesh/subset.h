/* subset.h -- some of the vertices and faces of a layer, with all that it knows of them. */
#ifndef MR_MESH_SUBSET_H
#define MR_MESH_SUBSET_H

#include "mesh/layers.h"

/* The kept rows, in ascending order. */
typedef struct mr_subset {
	const uint32_t *vertex, *face; /* nv, nf */
	size_t nv, nf;
	const uint32_t *number; /* of each kept vertex of the whole: its place in `vertex` */
} mr_subset;

/* The vertices marked in keep (m->nv), and the faces that have these for corners; polygons whole or not at
 * all, and no vertex that has lost all its faces.  m: that layer of f, or its points alone.  In the arena. */
mr_status
mr_subset_find(mr_ctx *ctx, mr_frame *f, const mr_mesh *m, const bool *keep, mr_subset *s) MR_WARN_UNUSED;

/* The layer becomes its subset: columns keep the rows that are left.  Its sampling is dropped, and what
 * refers to its rows from elsewhere. */
mr_status mr_layer_keep(mr_ctx *ctx, mr_frame *f, const char *layer, const mr_subset *s) MR_WARN_UNUSED;

/* Every column of the layer's vertices (element v) or faces (f) gets the rows of[0 .. n), as they are. */
mr_status mr_layer_gather(
    mr_ctx *ctx, mr_frame *f, const char *layer, char element, const uint32_t *of, size_t n) MR_WARN_UNUSED;

#endif
