/* KHR_draco_mesh_compression, read: accessors of a primitive whose values Draco has packed. */
#include "formats/draco_shim.h"
#include "formats/gltf.h"

/* The accessor of this number is made of these rows. */
static mr_status
make_accessor(
    mr_gltf *g, size_t number, size_t count, size_t width, size_t kind, bool normalized, const void *data)
{
	const json_t *json = mr_gltf_at(g, "accessors", number);
	size_t rows = 0;

	MR_TRY(mr_gltf_count(g, json, "count", 0, MR_NONE - 1, &rows));
	if (rows != count)
		return mr_fail(g->ctx, MR_EFORMAT, "accessor %zu should have %zu rows, and Draco's has %zu",
		    number, rows, count);
	g->made[number] = (mr_accessor){ .number = number,
		.count = count,
		.components = width,
		.kind = kind,
		.normalized = normalized,
		.data = data,
		.stride = 4 * width };
	return MR_OK;
}

/* Scales integers of a normalized accessor to [-1, 1] or [0, 1]: Draco has not marked them as normalized. */
static void
share(const json_t *accessor, size_t n, float *x)
{
	static const float most[] = { 127, 255, 32767, 65535 };
	json_int_t kind = json_integer_value(json_object_get(accessor, "componentType"));

	for (size_t i = 0; i < n && kind >= MR_GLTF_BYTE && kind <= MR_GLTF_UNSIGNED_SHORT; i++)
		x[i] /= most[kind - MR_GLTF_BYTE];
}

static mr_status
make_values(mr_gltf *g, const mr_draco *d, const char *key, const json_t *id, const json_t *attributes)
{
	size_t number = 0, width, n = mr_draco_points(d);
	const json_t *json;
	bool normalized = false;
	float *x;

	MR_TRY(mr_gltf_index(g, attributes, key, "accessors", &number));
	if (number == MR_UNKNOWN)
		return MR_OK;
	json = mr_gltf_at(g, "accessors", number);
	width = mr_gltf_components(json);
	x = MR_NEW(g->ctx, n * (width + 1), float);
	if (width == 0 || !json_is_integer(id) || json_integer_value(id) < 0 ||
	    !mr_draco_values(d, (uint32_t)json_integer_value(id), width, x, &normalized))
		return mr_fail(g->ctx, MR_EFORMAT, "Draco's mesh has no %.40s of %zu numbers", key, width);
	if (json_is_true(json_object_get(json, "normalized")) && !normalized)
		share(json, n * width, x);
	return make_accessor(g, number, n, width, MR_GLTF_FLOAT, false, x);
}

static mr_status
make_indices(mr_gltf *g, const mr_draco *d, const json_t *primitive)
{
	size_t number = 0, count = 3 * mr_draco_faces(d);
	uint32_t *index = MR_NEW(g->ctx, count + 1, uint32_t);

	MR_TRY(mr_gltf_index(g, primitive, "indices", "accessors", &number));
	if (number == MR_UNKNOWN)
		return mr_fail(g->ctx, MR_EFORMAT, "a primitive that Draco has packed names no indices");
	mr_draco_indices(d, index);
	return make_accessor(g, number, count, 1, MR_GLTF_UNSIGNED_INT, false, index);
}

mr_status
mr_gltf_draco(mr_gltf *g, json_t *primitive)
{
	json_t *extension = json_object_get(json_object_get(primitive, "extensions"), MR_DRACO), *id;
	mr_gltf_buffer b = { 0 };
	size_t position = 0;
	char why[MR_DRACO_WHY];
	const char *key;
	mr_draco *d;

	MR_TRY(
	    mr_gltf_index(g, json_object_get(primitive, "attributes"), "POSITION", "accessors", &position));
	if (!extension || position == MR_UNKNOWN ||
	    json_object_get(mr_gltf_at(g, "accessors", position), "bufferView"))
		return MR_OK; /* or the file has the values unpacked, too */
	MR_TRY(mr_gltf_view_of(g, extension, &b));
	d = mr_draco_open(b.data, b.bytes, why);
	if (!d)
		return mr_fail(g->ctx, MR_EFORMAT, MR_DRACO ": %s", why);
	mr_own(g->ctx, mr_draco_free, d);
	json_object_foreach(json_object_get(extension, "attributes"), key, id)
	    MR_TRY(make_values(g, d, key, id, json_object_get(primitive, "attributes")));
	return make_indices(g, d, primitive);
}
