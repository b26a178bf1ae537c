/*
 * build.h -- what readers gather a model in: faces of any size, groups, attributes of corners.
 *
 * Contract: the reader checks indices, since it knows the line or the byte; the
 * builder triangulates and makes the arrays of the model, in the arena.
 * Layer rule: formats.
 */
#ifndef MR_BUILD_H
#define MR_BUILD_H

#include "formats/formats.h"

/* Names, each once, numbered as they come. */
typedef struct mr_names {
	char *text; /* each followed by a newline */
	size_t bytes, room;
	size_t *start;  /* of each in text */
	uint32_t *slot; /* a hash table of number + 1 */
	size_t count, start_room, slots;
} mr_names;

typedef struct mr_builder {
	mr_ctx *ctx;
	mr_v3 *p, *normal;
	unsigned char *color;
	double *texcoord;
	unsigned char *corner_seen; /* per vertex, of texture coordinates: 1 given, 2 given differently by
	                               another corner */
	size_t nv;
	uint32_t *corner; /* of all faces */
	uint32_t *size;   /* corners of each face; NULL as long as all are triangles */
	uint32_t *group;  /* of each face; NULL without groups */
	size_t corners, corner_room, faces, face_room, group_room;
	size_t skipped;           /* faces of fewer than three corners */
	size_t polygons;          /* faces of more */
	mr_import_result *counts; /* of the model to be */
	bool has_groups;
	uint32_t current; /* group of the faces to come */
	mr_names names;
} mr_builder;

/* Positions for nv vertices, not set; MR_ERANGE beyond what indices can name. */
mr_status mr_build_vertices(mr_builder *b, uint64_t nv) MR_WARN_UNUSED;

/* Room for so many triangles, to spare growing. */
mr_status mr_build_reserve(mr_builder *b, size_t faces) MR_WARN_UNUSED;

/* A face of n corners, whose indices are below nv; fewer than three are counted and left out. */
mr_status mr_build_face(mr_builder *b, const uint32_t *corner, size_t n) MR_WARN_UNUSED;

/* The faces to come belong to this group; blanks around the name do not count. */
mr_status mr_build_group(mr_builder *b, const char *name, size_t bytes) MR_WARN_UNUSED;

/* A corner's texture coordinates: the vertex keeps the first it is given, and is a seam where they differ. */
mr_status mr_build_texcoord(mr_builder *b, uint32_t vertex, double u, double v) MR_WARN_UNUSED;

/* A column that is dropped: says so and counts it. */
void mr_dropped(mr_ctx *ctx, size_t *count, const char *what, const char *why);

/* The model; says and counts what it could not keep. */
mr_status mr_build_finish(mr_builder *b, mr_model *m) MR_WARN_UNUSED;

/* True where a triangle was added without looking further: the usual case, kept short. */
static inline bool
mr_build_triangle(mr_builder *b, uint32_t i, uint32_t j, uint32_t k)
{
	uint32_t *c = b->corner + b->corners;

	if (b->size || b->has_groups || b->corner_room - b->corners < 3)
		return false;
	c[0] = i, c[1] = j, c[2] = k;
	b->corners += 3;
	b->faces++;
	return true;
}

/* Copies text without control characters, '/' where `no_slash`, and broken UTF-8, for which '_' stands;
 * NUL-terminated. */
size_t mr_clean_name(char *to, const char *from, size_t bytes, bool no_slash);

#endif
