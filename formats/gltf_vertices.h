/*
 * gltf_vertices.h -- a surface as glTF has it: vertices that carry all their attributes, and faces in the
 * order of primitives.  Layer rule: formats.
 */
#ifndef MR_GLTF_VERTICES_H
#define MR_GLTF_VERTICES_H

#include "formats/model.h"

/* The vertices of a model in their order, behind them those that a seam of corners repeats. */
typedef struct mr_gltf_vertices {
	size_t count;
	uint32_t *vertex,
	    *corner;     /* of each, the model's, and a corner that it stands for; MR_NONE: of no face */
	uint32_t *index; /* 3 nf: the vertex of each corner */
} mr_gltf_vertices;

void mr_gltf_vertices_find(mr_ctx *ctx, const mr_model *m, mr_gltf_vertices *v);

/* Names of objects or materials, and which each face has: `count` for one without. */
typedef struct mr_face_names {
	const char **start; /* count + 1 */
	size_t count;
	uint32_t *of; /* nf */
} mr_face_names;

void mr_face_names_find(mr_ctx *ctx, const uint32_t *column, mr_lines lines, size_t nf, mr_face_names *names);

/* Sorts `order` by key[order[i]], stably; keys are at most `most`. */
void mr_sort_by(mr_ctx *ctx, const uint32_t *key, size_t most, uint32_t *order, size_t n);

#endif
