/* gltf.h -- a glTF 2.0 document: JSON, buffers, which are looked at when they are needed, and accessors.
 * Indices and ranges are checked, and failures name the thing.  Layer rule: formats; jansson only here. */
#ifndef MR_GLTF_H
#define MR_GLTF_H

#include "formats/format.h"

#include <jansson.h>

/* The numbers that the format gives to kinds. */
enum {
	MR_GLTF_MAGIC = 0x46546c67, /* "glTF" */
	MR_GLTF_JSON = 0x4e4f534a,
	MR_GLTF_BIN = 0x004e4942,
	MR_GLTF_BYTE = 5120,
	MR_GLTF_SHORT = 5122,
	MR_GLTF_UNSIGNED_SHORT = 5123,
	MR_GLTF_UNSIGNED_INT = 5125,
	MR_GLTF_FLOAT = 5126,
	MR_GLTF_ARRAY = 34962,
	MR_GLTF_ELEMENTS = 34963
};

typedef struct mr_gltf_buffer {
	const unsigned char *data; /* NULL: not looked at yet */
	size_t bytes;
} mr_gltf_buffer;

typedef struct mr_gltf {
	mr_ctx *ctx;
	const char *path; /* of the document */
	json_t *root;
	const unsigned char *bin; /* the chunk of bytes of a GLB; NULL: there is none */
	size_t bin_bytes;
	mr_gltf_buffer *buffer;   /* as many as the document has */
	mr_gltf_buffer *view;     /* the same: views that were unpacked */
	struct mr_accessor *made; /* the same: accessors that an extension gave values */
} mr_gltf;

#define MR_DRACO "KHR_draco_mesh_compression"

/* Parses the file, a GLB or JSON, which must stay; path: beside which its buffers are. */
mr_status mr_gltf_open(
    mr_ctx *ctx, const char *path, const unsigned char *data, size_t size, mr_gltf *g) MR_WARN_UNUSED;

/* Leaves it to the arena to drop the JSON; NULL is nothing. */
void mr_gltf_own(mr_ctx *ctx, json_t *json);

/* How many things the document has in an array of its root: "nodes". */
size_t mr_gltf_size(const mr_gltf *g, const char *array);

/* Thing i of an array of the root: an object; NULL where it is something else. */
json_t *mr_gltf_at(const mr_gltf *g, const char *array, size_t i);

/* The number under a key of an object: a whole one of at most `most`, or `absent` where the key is not there.
 */
mr_status mr_gltf_count(const mr_gltf *g, const json_t *object, const char *key, size_t absent, size_t most,
    size_t *n) MR_WARN_UNUSED;

/* The number under a key, MR_UNKNOWN where it is not there, of a thing in an array of the root. */
mr_status mr_gltf_index(
    const mr_gltf *g, const json_t *object, const char *key, const char *array, size_t *index) MR_WARN_UNUSED;

/* `count` numbers under a key, if it is there. */
mr_status mr_gltf_numbers(const mr_gltf *g, const json_t *object, const char *key, size_t count, double *x,
    bool *there) MR_WARN_UNUSED;

/* The name of a thing; NULL where it has none, or an empty one. */
const char *mr_gltf_name(const json_t *thing);

/* The bytes in a URI, or in the file beside the document that it names. */
mr_status mr_gltf_uri(mr_gltf *g, const char *uri, mr_gltf_buffer *b) MR_WARN_UNUSED;

/* The bytes of the buffer view that an object names. */
mr_status mr_gltf_view_of(mr_gltf *g, const json_t *object, mr_gltf_buffer *b) MR_WARN_UNUSED;

/* How the pictures of a material lie on its primitives: by which texture coordinates, TEXCOORD_0 and on, and
 * what these become first (KHR_texture_transform). */
typedef struct mr_gltf_placing {
	size_t set;
	double offset[2], turn, scale[2]; /* turn: radians */
} mr_gltf_placing;

/* Looks of the materials of a document, and their pictures. */
typedef struct mr_gltf_looks {
	struct mr_material *look; /* of each material */
	mr_gltf_placing *placing;
	bool said;     /* of one more is said than a name */
	mr_file *file; /* PNG and JPEG, as many as the document has images, and one more */
	size_t files;
	bool *seen;         /* of each image */
	size_t left, plain; /* images, and looks of materials, that are left out */
} mr_gltf_looks;

/* A picture that cannot be read is reported. */
mr_status mr_gltf_looks_read(mr_gltf *g, mr_gltf_looks *l) MR_WARN_UNUSED;

/* Gives the model the files that say it of materials of these names. */
void mr_gltf_looks_put(mr_gltf_looks *l, const char *const *name, size_t count, mr_builder *b);

/* The numbers of a row of an accessor by its type; 0 for one that is not read. */
size_t mr_gltf_components(const json_t *accessor);

/* Gives values to the accessors of a primitive that Draco has packed; nothing of another. */
mr_status mr_gltf_draco(mr_gltf *g, json_t *primitive) MR_WARN_UNUSED;

/* Values in a buffer. */
typedef struct mr_accessor {
	size_t number; /* of it in the document */
	size_t count, components;
	size_t kind; /* of a component, as the format numbers them: 5120 to 5126 */
	bool normalized;
	const unsigned char *data;
	size_t stride;
} mr_accessor;

/* Accessor `number`, which the caller has from mr_gltf_index. */
mr_status mr_accessor_open(mr_gltf *g, size_t number, mr_accessor *a) MR_WARN_UNUSED;

/* The values as reals, normalised ones from -1 or 0 to 1.  x: a->count rows of `width`; what the accessor has
 * no component for is as it was. */
void mr_accessor_reals(const mr_accessor *a, size_t width, double *x);

/* Whole numbers, each below `limit`.  index: a->count. */
mr_status mr_accessor_indices(mr_gltf *g, const mr_accessor *a, size_t limit, uint32_t *index) MR_WARN_UNUSED;

/* ---- written ---- */

/* A component of a colour as the format has it, linear, and as pictures have it (sRGB, IEC 61966-2-1). */
static inline double
mr_srgb_to_linear(double c)
{
	return c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4);
}

static inline double
mr_linear_to_srgb(double c)
{
	return c <= 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1 / 2.4) - 0.055;
}

#endif
