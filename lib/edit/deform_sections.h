/*
 * deform_sections.h -- sections through what turns: the level sets of weights, piece by piece, as a handle
 * may hold several limbs and limbs may branch.  Private to this room.
 */
#ifndef MR_EDIT_DEFORM_SECTIONS_H
#define MR_EDIT_DEFORM_SECTIONS_H

#include "mesh/mesh.h"

/* Of a face and a weight: the centroid of the section through it, and by how much the weight differs across
 * the face, squared. */
typedef struct mr_section {
	mr_v3 center;
	double spread2;
} mr_section;

/* weight: `count` for each vertex; cot: of the corners of each face.  Returns `count` for each face. */
mr_section *
mr_sections_find(mr_ctx *ctx, const mr_mesh *m, const double *weight, size_t count, const double (*cot)[3]);

#endif
