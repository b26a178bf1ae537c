/* draco_shim.h -- Draco's decoder of meshes, seen from C; without the library it opens nothing.
 * Layer rule: formats. */
#ifndef MR_DRACO_SHIM_H
#define MR_DRACO_SHIM_H

#ifdef __cplusplus
extern "C" {
#endif

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { MR_DRACO_WHY = 160 };

typedef struct mr_draco mr_draco;

/* Decodes a mesh; NULL, and a reason, where that fails. */
mr_draco *mr_draco_open(const void *data, size_t bytes, char why[MR_DRACO_WHY]);
void mr_draco_free(void *draco);

size_t mr_draco_points(const mr_draco *d);
size_t mr_draco_faces(const mr_draco *d);

/* index: 3 a face. */
void mr_draco_indices(const mr_draco *d, uint32_t *index);

/* Values of the attribute of that id, `width` a point; *normalized: they are shares of their type's range.
 * False where there is none so wide. */
bool mr_draco_values(const mr_draco *d, uint32_t id, size_t width, float *x, bool *normalized);

#ifdef __cplusplus
}
#endif

#endif
