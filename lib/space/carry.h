/*
 * carry.h -- what a surface knows goes along to the one that takes its place: columns by their kinds
 * (mesh/attributes.h), across no seam.
 */
#ifndef MR_SPACE_CARRY_H
#define MR_SPACE_CARRY_H

#include "mesh/layers.h"

/* A surface, and one made of it. */
typedef struct mr_successor {
	const mr_mesh *before, *after;
	const uint8_t *seam, *seam_after; /* of each half-edge: see mr_layer_seams; NULL: none is one */
	const uint32_t
	    *face; /* of each face of after: one of before that is on the same side of all seams; NULL: */
	const uint32_t
	    *along;      /* of each half-edge of after on a seam, one of before on the same side of it */
	mr_places place; /* of each vertex of after on before */
} mr_successor;

/*
 * Marks the edges across which texture coordinates of corners jump, or that part materials, groups or
 * objects: curves that stay curves.  seam: 3 m->nf, in the arena; NULL where there are none.  m: that layer
 * of f.
 */
mr_status mr_layer_seams(mr_ctx *ctx, mr_frame *f, const mr_mesh *m, uint8_t **seam) MR_WARN_UNUSED;

/* Joins vertices of layer m at the same place, as files have them along seams, where m is a manifold and
 * stays one: edges there would part otherwise. */
mr_status mr_layer_join_seams(mr_ctx *ctx, mr_frame *f, mr_mesh *m) MR_WARN_UNUSED;

/* Whether the layer has columns that go along. */
bool mr_layer_carries(const mr_frame *f, const char *layer);

/*
 * The columns of layer before->name for after: of vertices from their places, of faces from theirs, of
 * corners from the places nearest to them on their side of the seams.  Not normals, which are found anew, nor
 * polygons. In the arena; mr_carried_put puts them.
 */
mr_status mr_carry_columns(
    mr_ctx *ctx, mr_frame *f, const mr_successor *s, mr_carried **list, size_t *count) MR_WARN_UNUSED;

/* The same, each vertex and face of after from the place of before that is nearest to it or to its middle. */
mr_status mr_carry_nearest(mr_ctx *ctx, mr_frame *f, const mr_mesh *before, const mr_mesh *after,
    mr_carried **list, size_t *count) MR_WARN_UNUSED;

#endif
