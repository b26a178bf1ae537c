/* gltf_meshopt.h -- EXT_meshopt_compression, which meshoptimizer packs and unpacks.  Layer rule: formats;
 * only this file includes meshoptimizer. */
#ifndef MR_GLTF_MESHOPT_H
#define MR_GLTF_MESHOPT_H

#include "base/ctx.h"

#define MR_MESHOPT "EXT_meshopt_compression"

/* As the extension names them. */
typedef enum mr_meshopt_mode {
	MR_MESHOPT_ATTRIBUTES,
	MR_MESHOPT_TRIANGLES,
	MR_MESHOPT_INDICES
} mr_meshopt_mode;

/* Rows of `stride` bytes. */
typedef struct mr_meshopt_rows {
	mr_meshopt_mode mode;
	size_t count, stride;
} mr_meshopt_rows;

/* Whether rows of that size can be packed. */
bool mr_meshopt_suits(const mr_meshopt_rows *rows);

/* Packs them; returns the bytes of *packed, in the arena. */
size_t mr_meshopt_pack(mr_ctx *ctx, const mr_meshopt_rows *rows, const void *data, unsigned char **packed);

/* Unpacks rows that suit, and applies the filter: NULL or a name of the extension.  *data: in the arena. */
mr_status mr_meshopt_unpack(mr_ctx *ctx, const mr_meshopt_rows *rows, const char *filter,
    const unsigned char *packed, size_t bytes, unsigned char **data) MR_WARN_UNUSED;

/* Orders triangles so that they pack well: `count` corners, of so many vertices. */
mr_status mr_meshopt_order(mr_ctx *ctx, uint32_t *corner, size_t count, size_t vertices) MR_WARN_UNUSED;

/* Numbers vertices in the order of their first corner; those without come last. */
void mr_meshopt_renumber(mr_ctx *ctx, uint32_t *corner, size_t count, size_t vertices, uint32_t **number);

#endif
