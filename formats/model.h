/* model.h -- models made better, and models as layers of a frame.  Layer rule: formats. */
#ifndef MR_MODEL_H
#define MR_MODEL_H

#include "formats/formats.h"
#include "mesh/layers.h"

/* Puts the model as this layer, or, where `layer` is NULL, as `mesh`, without faces as `points`; the frame
 * borrows its arrays. */
mr_status mr_model_put(mr_ctx *ctx, mr_frame *f, const char *layer, const mr_model *m) MR_WARN_UNUSED;

/* The layer as a model, with all that it has; columns of a number that are none by convention as properties.
 */
mr_status mr_model_get(mr_ctx *ctx, mr_frame *f, const char *layer, mr_model *m) MR_WARN_UNUSED;

/* The same, ready to be written: columns of the frame's mesh with the same triangles are added where the
 * layer lacks them; columns of a mesh with other triangles, and creases, are reported as lost with a key
 * frame. */
mr_status mr_model_complete(mr_ctx *ctx, mr_frame *f, const char *layer, mr_model *m) MR_WARN_UNUSED;

/* The texture coordinates of a corner, whose v runs upwards; NULL: none. */
const double *mr_corner_texcoord(const mr_model *m, size_t corner);

/* mr_export where the format is checked, and the file is the caller's to keep where `held` is not NULL. */
mr_status mr_export_held(mr_ctx *ctx, mr_frame *f, const char *layer, const char *path, const char *format,
    mr_outfile *held) MR_WARN_UNUSED;

/* ---- scenes ---- */

/* Several frames and layers of one file.  A key frame begins nodes, one for each layer; a delta of
 * the same triangles gives them another pose, another begins nodes of its own. */

/* Another pose of a surface or a cloud; normals where it has some. */
typedef struct mr_target {
	const mr_v3 *p, *normal, *corner_normal; /* as of mr_model */
} mr_target;

typedef struct mr_scene_node {
	const char *frame, *layer;
	size_t take; /* number of the frame that began it */
	mr_model model;
	mr_target *target;
	size_t targets, target_room;
} mr_scene_node;

/* How a glTF is written. */
typedef struct mr_gltf_opts {
	bool no_normals;
	bool quantize; /* places, texture coordinates and normals in few bits */
	bool compress; /* by meshoptimizer */
	bool lods;     /* frames after the first are levels of its detail */
} mr_gltf_opts;

/* Starts zeroed but for the folder. */
typedef struct mr_scene {
	mr_scene_node *node;
	size_t nodes, room, takes;
	size_t open;        /* the nodes from here on are those that a delta poses */
	const char *folder; /* of files of materials */
	mr_gltf_opts gltf;
} mr_scene;

/* Adds a frame.  layers: with commas between, or NULL: the one that mr_layer_result chooses.  keep: the arena
 * of what outlives the frame. */
mr_status
mr_scene_add(mr_ctx *ctx, mr_ctx *keep, mr_scene *scene, mr_frame *f, const char *layers) MR_WARN_UNUSED;

/* Whether that format can hold several frames and layers. */
bool mr_scene_suits(const char *path, const char *format);

/* As mr_model_write, where mr_scene_suits. */
mr_status mr_scene_write(mr_ctx *ctx, const char *path, const char *format, const mr_scene *scene,
    mr_outfile *held) MR_WARN_UNUSED;

#endif
