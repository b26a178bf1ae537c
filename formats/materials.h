/* materials.h -- what materials look like, by the files that an OBJ named.  Only regular files below the
 * caller's folder are opened, by a path's last name if it leads elsewhere.  Layer rule: formats. */
#ifndef MR_MATERIALS_H
#define MR_MATERIALS_H

#include "formats/formats.h"

typedef struct mr_material {
	bool colored;
	double color[3];         /* Kd, from 0 to 1, as pictures have it */
	double emission[3];      /* Ke, likewise */
	double opacity;          /* d, or 1 - Tr, from 0 to 1 */
	double roughness, metal; /* Pr and Pm, from 0 to 1 */
	const char *file;        /* the picture of map_Kd, which is there; NULL: none */
	const char *normals;     /* likewise of norm or map_Kn */
} mr_material;

/* What nothing is said of: opaque, of no metal, and rough as most things are. */
extern const mr_material mr_material_plain;

/* The file that a path of the model's author leads to, as it stands where that is below the folder, or by its
 * last name; NULL where neither is there. */
const char *mr_file_in(mr_ctx *ctx, const char *folder, const char *name, size_t bytes);

/* The same in the folder of the model; NULL also of one that has no folder, "-" or "". */
const char *mr_file_beside(mr_ctx *ctx, const char *model, const char *name, size_t bytes);

/* What the files of the model's mtllib in `folder` say of each line of its materials.  A file that is not
 * there is reported, no failure.  list: *count, in the arena; none of a model without materials. */
mr_status mr_materials_find(
    mr_ctx *ctx, const mr_model *m, const char *folder, mr_material **list, size_t *count) MR_WARN_UNUSED;

/* Reports files of materials that are not where the model at `path` ("-": nowhere) names them. */
void mr_libraries_missing(mr_ctx *ctx, const char *path, mr_lines files);

#endif
