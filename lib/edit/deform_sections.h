/*
 * deform_sections.h -- sections through what turns: the level sets of weights, piece by piece, as a handle
 * may hold several limbs and limbs may branch.  Private to this room.
 */
#ifndef MR_EDIT_DEFORM_SECTIONS_H
#define MR_EDIT_DEFORM_SECTIONS_H

#include "mesh/mesh.h"

/* Of each face and weight, the sections at the levels below and above its mean weight. */
typedef struct mr_sections {
	mr_v3 *center; /* of each section */
	uint32_t (*of)[2];
} mr_sections;

/* weight: `count` for each vertex; cot: of the corners of each face. */
void mr_sections_find(mr_ctx *ctx, const mr_mesh *m, const double *weight, size_t count,
    const double (*cot)[3], mr_sections *s);

/* The centroid of the section through a face, of which `weight` is the mean of weight j. */
mr_v3 mr_section_at(const mr_sections *s, size_t count, size_t f, size_t j, double weight);

#endif
