/* Rows of vertices and indices, packed and unpacked (Kapoulkine, EXT_meshopt_compression, 2022). */
#include "formats/gltf_meshopt.h"

#include "formats/meshopt_shim.h"

#include <meshoptimizer.h>

bool
mr_meshopt_suits(const mr_meshopt_rows *rows)
{
	if (rows->mode == MR_MESHOPT_ATTRIBUTES)
		return rows->stride >= 4 && rows->stride <= 256 && rows->stride % 4 == 0;
	return (rows->stride == 2 || rows->stride == 4) &&
	       (rows->mode == MR_MESHOPT_INDICES || rows->count % 3 == 0);
}

/* Indices as words. */
static const unsigned *
words_of(mr_ctx *ctx, const mr_meshopt_rows *rows, const void *data)
{
	unsigned *word = MR_NEW_ZERO(ctx, rows->count, unsigned);

	for (size_t i = 0; i < rows->count; i++)
		memcpy(&word[i], (const char *)data + i * rows->stride, rows->stride); /* little-endian */
	return word;
}

size_t
mr_meshopt_pack(mr_ctx *ctx, const mr_meshopt_rows *rows, const void *data, unsigned char **packed)
{
	size_t n = rows->count, most;

	if (rows->mode == MR_MESHOPT_ATTRIBUTES) {
		most = meshopt_encodeVertexBufferBound(n, rows->stride);
		*packed = mr_alloc(ctx, most, 1);
		return meshopt_encodeVertexBuffer(*packed, most, data, n, rows->stride);
	}
	meshopt_encodeIndexVersion(1); /* the extension uses version 1 */
	if (rows->mode == MR_MESHOPT_TRIANGLES) {
		most = meshopt_encodeIndexBufferBound(n, UINT32_MAX);
		*packed = mr_alloc(ctx, most, 1);
		return meshopt_encodeIndexBuffer(*packed, most, words_of(ctx, rows, data), n);
	}
	most = meshopt_encodeIndexSequenceBound(n, UINT32_MAX);
	*packed = mr_alloc(ctx, most, 1);
	return meshopt_encodeIndexSequence(*packed, most, words_of(ctx, rows, data), n);
}

static bool
decode(const mr_meshopt_rows *rows, const unsigned char *packed, size_t bytes, void *data)
{
	if (rows->mode == MR_MESHOPT_ATTRIBUTES)
		return !meshopt_decodeVertexBuffer(data, rows->count, rows->stride, packed, bytes);
	if (rows->mode == MR_MESHOPT_TRIANGLES)
		return !meshopt_decodeIndexBuffer(data, rows->count, rows->stride, packed, bytes);
	return !meshopt_decodeIndexSequence(data, rows->count, rows->stride, packed, bytes);
}

/* False where there is no such filter of such rows. */
static bool
undo_filter(const mr_meshopt_rows *rows, const char *filter, void *data)
{
	if (!filter || !strcmp(filter, "NONE"))
		return true;
	if (rows->mode != MR_MESHOPT_ATTRIBUTES)
		return false;
	if (!strcmp(filter, "OCTAHEDRAL") && (rows->stride == 4 || rows->stride == 8))
		meshopt_decodeFilterOct(data, rows->count, rows->stride);
	else if (!strcmp(filter, "QUATERNION") && rows->stride == 8)
		meshopt_decodeFilterQuat(data, rows->count, rows->stride);
	else if (!strcmp(filter, "EXPONENTIAL"))
		meshopt_decodeFilterExp(data, rows->count, rows->stride);
	else
		return false;
	return true;
}

mr_status
mr_meshopt_unpack(mr_ctx *ctx, const mr_meshopt_rows *rows, const char *filter, const unsigned char *packed,
    size_t bytes, unsigned char **data)
{
	const size_t most = 64; /* a block of 256 equal rows takes 4 bytes for each of theirs */
	unsigned char *to;

	if (rows->count > most * bytes / rows->stride)
		return mr_fail(ctx, MR_EFORMAT, "%zu rows of %zu bytes cannot be packed in %zu", rows->count,
		    rows->stride, bytes);
	to = mr_alloc(ctx, (rows->count + 4) * rows->stride, 1);
	if (!decode(rows, packed, bytes, to))
		return mr_fail(ctx, MR_EFORMAT, "%zu packed bytes are damaged", bytes);
	if (!undo_filter(rows, filter, to))
		return mr_fail(
		    ctx, MR_EFORMAT, "filter %.20s of rows of %zu bytes is not read", filter, rows->stride);
	*data = to;
	return MR_OK;
}

mr_status
mr_meshopt_order(mr_ctx *ctx, uint32_t *corner, size_t count, size_t vertices)
{
	if (!mr_meshopt_cache(corner, count, vertices))
		return mr_fail(ctx, MR_EMEM, "no memory for the order of %zu triangles", count / 3);
	return MR_OK;
}

void
mr_meshopt_renumber(mr_ctx *ctx, uint32_t *corner, size_t count, size_t vertices, uint32_t **number)
{
	uint32_t *to = MR_NEW(ctx, vertices, uint32_t);
	size_t next = meshopt_optimizeVertexFetchRemap(to, corner, count, vertices);

	for (size_t i = 0; i < vertices; i++)
		if (to[i] == UINT32_MAX)
			to[i] = (uint32_t)next++;
	for (size_t i = 0; i < count; i++)
		corner[i] = to[corner[i]];
	*number = to;
}
