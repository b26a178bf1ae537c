/* A GLB by EXT_meshopt_compression: order of faces and vertices before they are written, and packed views
 * after. */
#include "formats/gltf_meshopt.h"
#include "formats/gltf_writer.h"

/* ---- order ---- */

mr_status
mr_glb_order(glb *w, layer *l)
{
	size_t n = l->v.count;
	uint32_t *number, *vertex = MR_NEW(w->ctx, n, uint32_t), *corner = MR_NEW(w->ctx, n, uint32_t);

	for (size_t at = 0, end; at < l->model.nf; at = end) {
		end = mr_glb_run(l, at);
		MR_TRY(mr_meshopt_order(w->ctx, l->order + 3 * at, 3 * (end - at), n));
	}
	mr_meshopt_renumber(w->ctx, l->order, 3 * l->model.nf, n, &number);
	for (size_t i = 0; i < n; i++) {
		vertex[number[i]] = l->v.vertex[i];
		corner[number[i]] = l->v.corner[i];
	}
	l->v.vertex = vertex;
	l->v.corner = corner;
	return MR_OK;
}

/* ---- views ---- */

/* The bytes as they are to be. */
typedef struct packed {
	unsigned char *bin;
	size_t bytes, room;
	size_t all; /* of the views that are packed, unpacked */
} packed;

/* Appends the bytes, padded to 4; returns their offset. */
static size_t
add_bytes(glb *w, packed *p, const unsigned char *data, size_t bytes)
{
	size_t at = p->bytes, padded = (bytes + 3) / 4 * 4;

	MR_RESERVE(w->ctx, p->bin, p->bytes, padded, &p->room);
	memcpy(p->bin + at, data, bytes);
	memset(p->bin + at + bytes, 0, padded - bytes);
	p->bytes += padded;
	return at;
}

static json_t *
new_extension(const mr_meshopt_rows *rows, size_t at, size_t bytes)
{
	static const char *const modes[] = { "ATTRIBUTES", "TRIANGLES", "INDICES" };

	return json_pack("{s:{s:i, s:I, s:I, s:I, s:I, s:s}}", MR_MESHOPT, "buffer", 0, "byteOffset",
	    number(at), "byteLength", number(bytes), "byteStride", number(rows->stride), "count",
	    number(rows->count), "mode", modes[rows->mode]);
}

/* Packs a view, where that makes it smaller; then it is one of the second buffer, which has no bytes. */
static void
pack_view(glb *w, packed *p, const mr_gltf_view *v, json_t *json)
{
	static const mr_meshopt_mode modes[] = { [MR_VIEW_ROWS] = MR_MESHOPT_ATTRIBUTES,
		[MR_VIEW_INDICES] = MR_MESHOPT_INDICES,
		[MR_VIEW_TRIANGLES] = MR_MESHOPT_TRIANGLES };
	mr_meshopt_rows rows = { modes[v->kind], v->count, v->stride };
	size_t whole = v->count * v->stride, bytes = whole, at;
	unsigned char *data = w->bin + v->begin;

	if (v->kind != MR_VIEW_BYTES && mr_meshopt_suits(&rows))
		bytes = mr_meshopt_pack(w->ctx, &rows, w->bin + v->begin, &data);
	if (bytes >= whole) {
		at = add_bytes(w, p, w->bin + v->begin, whole);
	} else {
		json_t *extension = new_extension(&rows, add_bytes(w, p, data, bytes), bytes);
		w->failed |= json_object_set_new(json, "extensions", extension) != 0;
		at = p->all;
		p->all += (whole + 3) / 4 * 4;
		w->failed |= json_object_set_new(json, "buffer", json_integer(1)) != 0;
	}
	w->failed |= json_object_set_new(json, "byteOffset", json_integer(number(at))) != 0;
}

void
mr_glb_compress(glb *w, size_t *all)
{
	json_t *views = json_object_get(w->root, "bufferViews");
	packed p = { 0 };

	for (size_t i = 0; i < w->views; i++)
		pack_view(w, &p, &w->view[i], json_array_get(views, i));
	w->bin = p.bin;
	w->bytes = p.bytes;
	*all = p.all;
}
