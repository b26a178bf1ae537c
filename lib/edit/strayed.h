/*
 * strayed.h -- edges of a mesh that its base does not account for: detail that is torn or crushed.
 */
#ifndef MR_EDIT_STRAYED_H
#define MR_EDIT_STRAYED_H

#include "edit/detail.h"
#include "mesh/edges.h"

typedef struct mr_strayed {
	size_t edges; /* over twice as long as they were, or under half as long, where no edge of base is */
	uint32_t vertex; /* of the one that changed most; MR_NONE without any */
} mr_strayed;

/* Of mesh, with its edges, after its vertices have gone to p: base is where it is now, d->rest where it was.
 */
mr_strayed mr_strayed_find(
    const mr_mesh *mesh, const mr_edges *edges, const mr_v3 *p, const mr_mesh *base, const mr_detail *d);

#endif
