/* gltf_writer.h -- what gltf_write.c, which makes the document, and gltf_vertices.c, which fills it with
 * vertices, share.  Private to glTF. */
#ifndef MR_GLTF_WRITER_H
#define MR_GLTF_WRITER_H

#include "formats/gltf.h"
#include "formats/model.h"
#include "mesh/creases.h"

/* The content of a range of the binary chunk. */
typedef enum mr_view_kind { MR_VIEW_BYTES, MR_VIEW_ROWS, MR_VIEW_INDICES, MR_VIEW_TRIANGLES } mr_view_kind;

typedef struct mr_gltf_view {
	size_t begin, count, stride; /* bytes: count strides */
	mr_view_kind kind;
} mr_gltf_view;

/* The document on its way.  A failed allocation of jansson's is noted and reported at the end. */
typedef struct glb {
	mr_sink *s;
	mr_ctx *ctx;
	const mr_scene *scene;
	json_t *root, *samplers, *channels; /* of the animation */
	bool failed, large;                 /* large: texture coordinates are, for floats */
	unsigned char *bin;                 /* the second chunk */
	size_t bytes, room;
	const char **image; /* files of the images so far */
	size_t image_room;
	size_t unnamed; /* the material of faces without one; MR_UNKNOWN: not there yet */
	bool beside;    /* bytes and pictures are files beside the document */
	size_t *take;   /* of each node, the frame that began it */
	size_t takes;
	mr_gltf_view *view;
	size_t views, view_room;
} glb;

/* The vertices of a model in their order, followed by those that a seam repeats. */
typedef struct vertices {
	size_t count;
	uint32_t *vertex,
	    *corner;     /* of each, the model's, and a corner that it stands for; MR_NONE: of no face */
	uint32_t *index; /* 3 nf: the vertex of each corner */
} vertices;

/* Names of objects or materials, and which each face has: `count` for one without. */
typedef struct face_names {
	const char **start; /* count + 1 */
	size_t count;
	uint32_t *of; /* nf */
} face_names;

/* A layer on its way: accessors of its vertices, MR_UNKNOWN: missing. */
typedef struct layer {
	const mr_scene_node *node;
	mr_model model;   /* the node's, with the normals that are written */
	mr_creases *made; /* where its normals are made; else NULL */
	const char *name; /* prefix of its nodes' names, before an object's */
	vertices v;
	face_names object, material;
	uint32_t *face;    /* nf, by object and material */
	uint32_t *order;   /* 3 nf: the vertices of their corners, as they are written */
	size_t *materials; /* of each of its names, the material of the document */
	size_t position, normal, texcoord, color;
	json_t *targets; /* poses */
	size_t sampler;  /* of the poses' weights */
	mr_v3 origin;
	double step;   /* of the grid of places; 0: they are floats */
	mr_v3 *x;      /* v.count, to fill */
	uint32_t *row; /* the same */
	mr_v3 *unit;   /* the same: normals, where there are some */
} layer;

/* Gives the layer its normals, where it has none and the scene wants some, and its vertices. */
void mr_glb_find_vertices(glb *w, layer *l);

/* Writes what the vertices have, and what the poses do to them, as accessors. */
void mr_glb_put_vertices(glb *w, layer *l);
void mr_glb_put_poses(glb *w, layer *l);

/* The end of the run of faces, in l->order, that can share a primitive. */
size_t mr_glb_run(const layer *l, size_t first);

/* Orders vertices, and faces within primitives, so that they pack well. */
mr_status mr_glb_order(glb *w, layer *l) MR_WARN_UNUSED;

/* Packs the views.  *all: their bytes in the second buffer, which is none but by unpacking. */
void mr_glb_compress(glb *w, size_t *all);

/* Appends to an array; its number there. */
size_t mr_glb_append(glb *w, json_t *array, json_t *thing);

/* Appends to an array of the root, which comes with its first thing: the format forbids empty ones. */
size_t mr_glb_push(glb *w, const char *array, json_t *thing);

/* A view of `count` rows of `stride` bytes, zero, to be filled from `to` on; its number.  target: MR_UNKNOWN
 * for other data than vertices or elements. */
size_t mr_glb_new_view(glb *w, size_t count, size_t stride, size_t target, mr_view_kind kind, char **to);

/* A view of `count` indices of n things. */
size_t mr_glb_put_indices(glb *w, const uint32_t *index, size_t count, size_t n, size_t target);

/* Sets a member of an accessor; takes it. */
void mr_glb_set(glb *w, size_t accessor, const char *key, json_t *value);
void mr_glb_set_bounds(glb *w, size_t accessor, json_t *min, json_t *max);

/* Indices of n things: the largest number of a type is none. */
static inline size_t
mr_index_bytes(size_t n)
{
	return n <= UINT16_MAX ? 2 : 4;
}

static inline size_t
mr_index_kind(size_t n)
{
	return n <= UINT16_MAX ? MR_GLTF_UNSIGNED_SHORT : MR_GLTF_UNSIGNED_INT;
}

/* Passes json on to "o*", which skips NULL; notes a failure if NULL came of a lack of memory. */
static inline json_t *
mr_glb_made(glb *w, bool wanted, json_t *json)
{
	w->failed |= wanted && !json;
	return json;
}

/* An index for "o*": NULL where there is none. */
static inline json_t *
index_of(glb *w, size_t n)
{
	return mr_glb_made(w, n != MR_UNKNOWN, n != MR_UNKNOWN ? json_integer((json_int_t)n) : NULL);
}

/* A number for "I". */
static inline json_int_t
number(size_t n)
{
	return (json_int_t)n;
}

/* Whether texture coordinates are there, and finite as floats. */
static inline bool
has_texcoord(const double *uv)
{
	return uv && isfinite(mr_as_float(uv[0]) + mr_as_float(uv[1]));
}

#endif
