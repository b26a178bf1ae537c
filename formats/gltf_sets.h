/*
 * gltf_sets.h -- a surface as glTF has it: vertices that carry all their attributes, in sets that primitives
 * share.
 *
 * A vertex is repeated where a seam of normals or texture coordinates runs through it, and nowhere else.
 * Faces of one object that have the same attributes share a set of vertices, which are in the order of the
 * model. Layer rule: formats.
 */
#ifndef MR_GLTF_SETS_H
#define MR_GLTF_SETS_H

#include "formats/bytes.h"
#include "formats/model.h"

/* What all corners of the faces of a set have. */
enum { MR_SET_TEXCOORDS = 1, MR_SET_NORMALS = 2, MR_SET_KINDS = 4 };

/* The faces of a surface in the order of its sets. */
typedef struct mr_sets {
	const mr_model *m;
	uint32_t *object, *material, *kind; /* nf; what names none is one behind the last name */
	const char **object_name, **material_name;
	size_t objects, materials; /* names */
	uint32_t *face;            /* nf, by object, kind and material */
	uint32_t *set;             /* nf: the set that the face belongs to */
	uint32_t *corner;          /* 3 nf, by set, vertex and index */
	uint32_t *index;           /* 3 nf: the number of a corner's vertex in its set, once that is made */
	size_t partial_normals, partial_texcoords; /* of corners of faces that have some and not all */
	const bool *used;                          /* nv: whether a face has the vertex; NULL: all are used */
	struct mr_distinct *group;                 /* workspace */
	size_t group_room;
} mr_sets;

/* The vertices of a set, each with the corner that stands for it, MR_NONE for an isolated one. */
typedef struct mr_vertex_set {
	uint32_t *vertex, *corner;
	size_t count;
	unsigned kind; /* MR_SET_... */
} mr_vertex_set;

/* Orders the faces of a model that has some. */
mr_status mr_sets_begin(mr_ctx *ctx, const mr_model *m, mr_sets *s) MR_WARN_UNUSED;

/* One behind the last face, in the order, of the set that face `first` in the order begins. */
size_t mr_set_end(const mr_sets *s, size_t first);

/* The set of faces `first` to `last` in the order.  Isolated vertices are in the first set of all. */
mr_status mr_set_make(mr_ctx *ctx, mr_sets *s, size_t first, size_t last, mr_vertex_set *v) MR_WARN_UNUSED;

/* All points as a set, with normals where all of them have some. */
mr_status mr_set_cloud(mr_sink *s, const mr_model *m, mr_vertex_set *v) MR_WARN_UNUSED;

/*
 * Whether a reader that joins the vertices of an object that are at one place, in floats, would join others
 * than those that the sets repeat, or leave a vertex apart that two objects share.
 */
mr_status mr_sets_ambiguous(mr_ctx *ctx, const mr_sets *s, bool *ambiguous) MR_WARN_UNUSED;

/* Whether it can be made unit. */
static inline bool
mr_is_direction(mr_v3 n)
{
	return isfinite(mr_norm2(n)) && mr_norm2(n) > 0;
}

#endif
