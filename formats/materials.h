/* materials.h -- what materials look like, by the files that an OBJ named or that are in the stream.  Only
 * regular files below the caller's folder are opened, by a path's last name if it leads elsewhere.  Layer
 * rule: formats. */
#ifndef MR_MATERIALS_H
#define MR_MATERIALS_H

#include "base/text.h"
#include "formats/formats.h"

typedef struct mr_material {
	bool colored;
	double color[3];         /* Kd, from 0 to 1, as pictures have it */
	double emission[3];      /* Ke, likewise */
	double opacity;          /* d, or 1 - Tr, from 0 to 1 */
	double roughness, metal; /* Pr and Pm, from 0 to 1 */
	mr_file file;            /* the picture of map_Kd, which is there, or none */
	mr_file normals;         /* likewise of norm or map_Kn */
} mr_material;

/* The default: opaque, not metal, and rough as most things are. */
extern const mr_material mr_material_plain;

/* The file that a path of the model's author leads to, as it stands where that is below the folder, or by its
 * last name; NULL where neither is there. */
const char *mr_file_in(mr_ctx *ctx, const char *folder, const char *name, size_t bytes);

/* The same in the folder of the model; NULL also of one that has no folder, "-" or "". */
const char *mr_file_beside(mr_ctx *ctx, const char *model, const char *name, size_t bytes);

/* The file of that name that came with the model in the stream, or none. */
mr_file mr_file_attached(const mr_model *m, const char *name, size_t bytes);

/* Reads the MTL files that the model names, from `folder`, else from the stream; folder NULL: from the stream
 * alone.  Reports a missing file, and goes on.  list: one entry a line of materials, *count in all, in the
 * arena. */
mr_status mr_materials_find(
    mr_ctx *ctx, const mr_model *m, const char *folder, mr_material **list, size_t *count) MR_WARN_UNUSED;

/* Adds the statements that say the same of a material of that name. */
void mr_material_put(mr_text *t, const char *name, const mr_material *m);

/* Whether a file of these bytes may go there: there is none, or one that is empty or begins with them. */
bool mr_may_replace(const char *path, const void *data, size_t size);

/* Refuses NAME.mtl where it is a file that mr_library_write has not written.  *own, if not NULL: it has. */
mr_status mr_library_check(mr_ctx *ctx, const char *name, bool *own) MR_WARN_UNUSED;

/* Writes NAME.mtl, with these statements. */
mr_status mr_library_write(mr_ctx *ctx, const char *name, const char *statements) MR_WARN_UNUSED;

/* Reports files of materials that are not where the model at `path` ("-": nowhere) names them. */
void mr_libraries_missing(mr_ctx *ctx, const char *path, mr_lines files);

#endif
