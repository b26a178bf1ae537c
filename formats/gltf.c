/* glTF documents: the chunks of a GLB, JSON, buffers, and accessors. */
#include "formats/gltf.h"

#include "base/memory.h"
#include "formats/gltf_meshopt.h"
#include "formats/materials.h"

/* ---- chunks and JSON ---- */

enum { HEADER = 12, CHUNK = 8 };

/* Finds the JSON of a GLB, and its bytes. */
static mr_status
open_chunks(
    mr_gltf *g, const unsigned char *data, size_t size, const unsigned char **json, size_t *json_bytes)
{
	size_t all = size < HEADER ? HEADER : mr_load32(data + 8, false);

	if (all > size || all < HEADER)
		return mr_fail(
		    g->ctx, MR_EFORMAT, "byte 8: the file should have %zu bytes, and has %zu", all, size);
	if (mr_load32(data + 4, false) != 2)
		return mr_fail(g->ctx, MR_EFORMAT, "byte 4: version %u of glTF is not read, 2 is",
		    (unsigned)mr_load32(data + 4, false));
	*json = NULL;
	for (size_t at = HEADER, bytes; all - at >= CHUNK; at += bytes) {
		uint32_t kind = mr_load32(data + at + 4, false);
		bytes = mr_load32(data + at, false);
		at += CHUNK;
		if (bytes > all - at)
			return mr_fail(g->ctx, MR_EFORMAT, "byte %zu: no whole chunk", at - CHUNK);
		if (kind == MR_GLTF_JSON && !*json) {
			*json = data + at;
			*json_bytes = bytes;
		} else if (kind == MR_GLTF_BIN && !g->bin) {
			g->bin = data + at;
			g->bin_bytes = bytes;
		}
	}
	return *json ? MR_OK : mr_fail(g->ctx, MR_EFORMAT, "byte %d: no chunk of JSON", (int)HEADER);
}

static mr_status
parse(mr_gltf *g, const unsigned char *json, size_t bytes)
{
	json_error_t error;

	g->root = json_loadb((const char *)json, bytes, 0, &error);
	mr_gltf_own(g->ctx, g->root);
	if (!g->root && (json_error_code(&error) == json_error_out_of_memory || !*error.text))
		return mr_fail(g->ctx, MR_EMEM, "no memory for %zu bytes of JSON", bytes);
	if (!g->root)
		return mr_fail(g->ctx, MR_EFORMAT, "JSON, line %d: %s", error.line, error.text);
	if (!json_is_object(g->root))
		return mr_fail(g->ctx, MR_EFORMAT, "JSON: no object");
	return MR_OK;
}

static mr_status
check_version(const mr_gltf *g)
{
	const char *version = json_string_value(
	    json_object_get(json_object_get(g->root, "asset"), "version"));

	if (!version || strncmp(version, "2.", 2) != 0)
		return mr_fail(g->ctx, MR_EFORMAT, "version %.20s of glTF is not read, 2.0 is",
		    version ? version : "none");
	return MR_OK;
}

static mr_status
needs(const mr_gltf *g, const char *extension)
{
	return mr_fail(
	    g->ctx, MR_EFORMAT, "the file needs the extension %.60s, which is not read", extension);
}

/* Extensions a file may require: those that are read here, and those that move no vertex. */
static mr_status
check_extensions(const mr_gltf *g)
{
	static const char *const known[] = { "KHR_mesh_quantization", "KHR_materials_", "KHR_texture_",
		"EXT_texture_", "KHR_lights_", MR_MESHOPT, MR_DRACO, NULL };
	json_t *list = json_object_get(g->root, "extensionsRequired");

	for (size_t i = 0; i < json_array_size(list); i++) {
		const char *name = json_string_value(json_array_get(list, i));
		const char *const *h = known;
		while (name && *h && strncmp(name, *h, strlen(*h)))
			h++;
		if (!name || !*h)
			return needs(g, name ? name : "without a name");
	}
	return MR_OK;
}

static void
drop_json(void *json)
{
	json_decref(json);
}

void
mr_gltf_own(mr_ctx *ctx, json_t *json)
{
	if (json)
		mr_own(ctx, drop_json, json);
}

mr_status
mr_gltf_open(mr_ctx *ctx, const char *path, const unsigned char *data, size_t size, mr_gltf *g)
{
	const unsigned char *json = data;
	size_t bytes = size;

	*g = (mr_gltf){ .ctx = ctx, .path = path };
	if (size >= 4 && mr_load32(data, false) == MR_GLTF_MAGIC)
		MR_TRY(open_chunks(g, data, size, &json, &bytes));
	MR_TRY(parse(g, json, bytes));
	MR_TRY(check_version(g));
	MR_TRY(check_extensions(g));
	g->buffer = MR_NEW_ZERO(ctx, mr_gltf_size(g, "buffers"), mr_gltf_buffer);
	g->view = MR_NEW_ZERO(ctx, mr_gltf_size(g, "bufferViews"), mr_gltf_buffer);
	g->made = MR_NEW_ZERO(ctx, mr_gltf_size(g, "accessors"), mr_accessor);
	return MR_OK;
}

/* ---- values of the document ---- */

size_t
mr_gltf_size(const mr_gltf *g, const char *array)
{
	return json_array_size(json_object_get(g->root, array));
}

json_t *
mr_gltf_at(const mr_gltf *g, const char *array, size_t i)
{
	json_t *thing = json_array_get(json_object_get(g->root, array), i);

	return json_is_object(thing) ? thing : NULL;
}

mr_status
mr_gltf_count(const mr_gltf *g, const json_t *object, const char *key, size_t absent, size_t most, size_t *n)
{
	const json_t *value = json_object_get(object, key);
	json_int_t x = json_integer_value(value);

	if (!value) {
		*n = absent;
		return MR_OK;
	}
	if (!json_is_integer(value) || x < 0 || (uint64_t)x > most)
		return mr_fail(g->ctx, MR_EFORMAT, "%s is no whole number of 0 to %zu", key, most);
	*n = (size_t)x;
	return MR_OK;
}

mr_status
mr_gltf_index(const mr_gltf *g, const json_t *object, const char *key, const char *array, size_t *index)
{
	size_t size = mr_gltf_size(g, array), n = MR_UNKNOWN;

	MR_TRY(mr_gltf_count(g, object, key, MR_UNKNOWN, MR_UNKNOWN - 1, &n));
	if (n != MR_UNKNOWN && n >= size)
		return mr_fail(g->ctx, MR_EFORMAT, "%s names number %zu of %zu %s", key, n, size, array);
	if (n != MR_UNKNOWN && !mr_gltf_at(g, array, n))
		return mr_fail(g->ctx, MR_EFORMAT, "%s: number %zu is no object", array, n);
	*index = n;
	return MR_OK;
}

mr_status
mr_gltf_numbers(const mr_gltf *g, const json_t *object, const char *key, size_t count, double *x, bool *there)
{
	json_t *list = json_object_get(object, key);

	*there = list != NULL;
	if (list && json_array_size(list) != count)
		return mr_fail(
		    g->ctx, MR_EFORMAT, "%s has %zu numbers, not %zu", key, json_array_size(list), count);
	for (size_t i = 0; list && i < count; i++) {
		json_t *value = json_array_get(list, i);
		if (!json_is_number(value))
			return mr_fail(g->ctx, MR_EFORMAT, "%s: value %zu is no number", key, i);
		x[i] = json_number_value(value);
	}
	return MR_OK;
}

const char *
mr_gltf_name(const json_t *thing)
{
	const char *name = json_string_value(json_object_get(thing, "name"));

	return name && *name ? name : NULL;
}

/* ---- buffers ---- */

/* The six bits of a digit of base 64 (RFC 4648); 64 for other characters. */
static unsigned
digit64(char c)
{
	if (c >= 'A' && c <= 'Z')
		return (unsigned)(c - 'A');
	if (c >= 'a' && c <= 'z')
		return (unsigned)(c - 'a') + 26;
	if (mr_is_digit(c))
		return (unsigned)(c - '0') + 52;
	return c == '+' ? 62 : c == '/' ? 63 : 64;
}

static mr_status
decode64(mr_gltf *g, const char *text, mr_gltf_buffer *b)
{
	size_t n = strlen(text), bytes = 0;
	unsigned char *data = mr_alloc(g->ctx, n / 4 * 3 + 3, 1);
	unsigned bits = 0, held = 0;

	while (n > 0 && text[n - 1] == '=')
		n--;
	for (size_t i = 0; i < n; i++) {
		unsigned d = digit64(text[i]);
		if (d == 64)
			return mr_fail(g->ctx, MR_EFORMAT, "no base 64 in its URI");
		held = (held << 6 | d) & 0xffff;
		bits += 6;
		if (bits >= 8) {
			bits -= 8;
			data[bytes++] = (unsigned char)(held >> bits);
		}
	}
	*b = (mr_gltf_buffer){ data, bytes };
	return MR_OK;
}

/* The file that a URI names. */
static mr_status
read_file(mr_gltf *g, const char *uri, mr_gltf_buffer *b)
{
	char *name = mr_format(g->ctx, "%s", uri);
	mr_file_bytes file = { 0 };
	const char *path;
	size_t n = 0;

	for (const char *c = uri; *c; c++) {
		char two[] = { c[1], c[1] ? c[2] : '\0', '\0' }, *end;
		unsigned long escaped = strtoul(two, &end, 16);
		bool is = *c == '%' && end == two + 2;
		name[n++] = is ? (char)escaped : *c;
		c += is ? 2 : 0;
	}
	path = mr_file_beside(g->ctx, g->path, name, n);
	if (!path)
		return mr_fail(g->ctx, MR_EFORMAT, "the file %.100s is missing", uri);
	MR_TRY(mr_file_bytes_read(g->ctx, path, &file));
	mr_own(g->ctx, mr_memory_free, file.memory);
	*b = (mr_gltf_buffer){ file.data, file.size };
	return MR_OK;
}

mr_status
mr_gltf_uri(mr_gltf *g, const char *uri, mr_gltf_buffer *b)
{
	const char *data = strstr(uri, ";base64,");

	if (strncmp(uri, "data:", 5) != 0)
		return read_file(g, uri, b);
	if (!data)
		return mr_fail(g->ctx, MR_EFORMAT, "a URI without base 64 is not read");
	return decode64(g, data + strlen(";base64,"), b);
}

/* The bytes of a buffer: of the GLB, or by its URI; what only an extension fills has none. */
static mr_status
find_buffer(mr_gltf *g, size_t number, mr_gltf_buffer *b)
{
	json_t *json = mr_gltf_at(g, "buffers", number), *uri = json_object_get(json, "uri"),
	       *extensions = json_object_get(json, "extensions");

	if (json_is_string(uri))
		return mr_prefix(g->ctx, mr_gltf_uri(g, json_string_value(uri), b), "buffer %zu", number);
	if (json_object_size(extensions))
		return needs(g, json_object_iter_key(json_object_iter(extensions)));
	if (number > 0 || !g->bin)
		return mr_fail(g->ctx, MR_EFORMAT, "buffer %zu is not in the file", number);
	*b = (mr_gltf_buffer){ g->bin, g->bin_bytes };
	return MR_OK;
}

static mr_status
open_buffer(mr_gltf *g, size_t number, mr_gltf_buffer *b)
{
	mr_gltf_buffer *known = &g->buffer[number];
	size_t bytes = 0;

	if (!known->data) {
		mr_gltf_buffer found = { 0 };
		MR_TRY(mr_gltf_count(
		    g, mr_gltf_at(g, "buffers", number), "byteLength", 0, MR_UNKNOWN - 1, &bytes));
		MR_TRY(find_buffer(g, number, &found));
		if (bytes > found.bytes)
			return mr_fail(g->ctx, MR_EFORMAT, "buffer %zu should have %zu bytes, and has %zu",
			    number, bytes, found.bytes);
		*known = (mr_gltf_buffer){ found.data, bytes };
	}
	*b = *known;
	return MR_OK;
}

/* The bytes of view `number`, or of what packs it: of an object that names them. */
static mr_status
open_range(mr_gltf *g, size_t number, const json_t *object, mr_gltf_buffer *b)
{
	mr_gltf_buffer of = { 0 };
	size_t buffer = 0, begin = 0, bytes = 0;

	MR_TRY(mr_gltf_index(g, object, "buffer", "buffers", &buffer));
	MR_TRY(mr_gltf_count(g, object, "byteOffset", 0, MR_UNKNOWN - 1, &begin));
	MR_TRY(mr_gltf_count(g, object, "byteLength", 0, MR_UNKNOWN - 1, &bytes));
	if (buffer == MR_UNKNOWN)
		return mr_fail(g->ctx, MR_EFORMAT, "buffer view %zu names no buffer", number);
	MR_TRY(open_buffer(g, buffer, &of));
	if (begin > of.bytes || bytes > of.bytes - begin)
		return mr_fail(g->ctx, MR_EFORMAT, "buffer view %zu is outside its buffer of %zu bytes",
		    number, of.bytes);
	*b = (mr_gltf_buffer){ of.data + begin, bytes };
	return MR_OK;
}

/* The bytes of a view that meshoptimizer has packed. */
static mr_status
unpack_view(mr_gltf *g, size_t number, const json_t *json, const json_t *view, mr_gltf_buffer *b)
{
	static const char *const modes[] = { "ATTRIBUTES", "TRIANGLES", "INDICES" };
	const char *mode = json_string_value(json_object_get(json, "mode"));
	mr_meshopt_rows rows = { 0 };
	mr_gltf_buffer packed = { 0 };
	unsigned char *data = NULL;
	size_t whole = 0, k = 0;

	MR_TRY(mr_gltf_count(g, view, "byteLength", 0, MR_UNKNOWN - 1, &whole));
	MR_TRY(mr_gltf_count(g, json, "count", 0, MR_NONE - 1, &rows.count));
	MR_TRY(mr_gltf_count(g, json, "byteStride", 0, 256, &rows.stride));
	while (k < 3 && (!mode || strcmp(modes[k], mode)))
		k++;
	rows.mode = k < 3 ? (mr_meshopt_mode)k : MR_MESHOPT_ATTRIBUTES;
	if (k == 3 || !mr_meshopt_suits(&rows) || rows.count * rows.stride != whole)
		return mr_fail(g->ctx, MR_EFORMAT,
		    MR_MESHOPT " of %zu rows of %zu bytes, %.20s, for %zu bytes", rows.count, rows.stride,
		    mode ? mode : "of no mode", whole);
	MR_TRY(open_range(g, number, json, &packed));
	MR_TRY(mr_prefix(g->ctx,
	    mr_meshopt_unpack(g->ctx, &rows, json_string_value(json_object_get(json, "filter")), packed.data,
		packed.bytes, &data),
	    MR_MESHOPT));
	*b = (mr_gltf_buffer){ data, whole };
	return MR_OK;
}

/* The bytes of a buffer view, which are unpacked once. */
static mr_status
open_view(mr_gltf *g, size_t number, mr_gltf_buffer *b)
{
	const json_t *view = mr_gltf_at(g, "bufferViews", number);
	const json_t *packed = json_object_get(json_object_get(view, "extensions"), MR_MESHOPT);

	if (!packed)
		return open_range(g, number, view, b);
	if (!g->view[number].data)
		MR_TRY(mr_prefix(g->ctx, unpack_view(g, number, packed, view, &g->view[number]),
		    "buffer view %zu", number));
	*b = g->view[number];
	return MR_OK;
}

mr_status
mr_gltf_view_of(mr_gltf *g, const json_t *object, mr_gltf_buffer *b)
{
	size_t view = 0;

	MR_TRY(mr_gltf_index(g, object, "bufferView", "bufferViews", &view));
	if (view == MR_UNKNOWN)
		return mr_fail(g->ctx, MR_EFORMAT, "no buffer view is named");
	return open_view(g, view, b);
}

/* ---- accessors ---- */

/* Bytes of a component; 0 for a kind that there is not. */
static size_t
kind_bytes(size_t kind)
{
	static const unsigned char bytes[] = { 1, 1, 2, 2, 0, 4, 4 };

	return kind >= 5120 && kind <= 5126 ? bytes[kind - 5120] : 0;
}

size_t
mr_gltf_components(const json_t *accessor)
{
	const char *type = json_string_value(json_object_get(accessor, "type"));
	const char *of = type && strlen(type) == 4 && !strncmp(type, "VEC", 3) ? strchr("234", type[3])
	                                                                       : NULL;

	return of ? (size_t)(*of - '0') : type && !strcmp(type, "SCALAR");
}

/* The place of `count` rows in a view that the object names with its offset; NULL where it names none. */
static mr_status
find_rows(
    mr_gltf *g, const json_t *object, size_t row, size_t count, const unsigned char **data, size_t *stride)
{
	mr_gltf_buffer b = { 0 };
	size_t view = 0, offset = 0, step = 0;

	MR_TRY(mr_gltf_index(g, object, "bufferView", "bufferViews", &view));
	MR_TRY(mr_gltf_count(g, object, "byteOffset", 0, MR_UNKNOWN - 1, &offset));
	*data = NULL;
	if (view == MR_UNKNOWN)
		return MR_OK;
	MR_TRY(mr_gltf_count(g, mr_gltf_at(g, "bufferViews", view), "byteStride", 0, 65535, &step));
	MR_TRY(open_view(g, view, &b));
	if (step == 0)
		step = row;
	if (step < row || step == 0)
		return mr_fail(
		    g->ctx, MR_EFORMAT, "rows of %zu bytes follow each other after %zu", row, step);
	if (offset > b.bytes ||
	    (count && (b.bytes - offset < row || count - 1 > (b.bytes - offset - row) / step)))
		return mr_fail(g->ctx, MR_EFORMAT, "%zu rows cannot be in %zu bytes from %zu on", count,
		    b.bytes, offset);
	*data = b.data + offset;
	*stride = step;
	return MR_OK;
}

static mr_status
open_accessor(mr_gltf *g, const json_t *json, mr_accessor *a)
{
	const char *type = json_string_value(json_object_get(json, "type"));

	MR_TRY(mr_gltf_count(g, json, "componentType", 0, MR_GLTF_FLOAT, &a->kind));
	MR_TRY(mr_gltf_count(g, json, "count", 0, MR_NONE - 1, &a->count));
	if (json_object_get(json, "sparse"))
		return mr_fail(g->ctx, MR_EFORMAT, "sparse values are not read");
	a->components = mr_gltf_components(json);
	a->normalized = json_is_true(json_object_get(json, "normalized"));
	if (a->components == 0 || kind_bytes(a->kind) == 0)
		return mr_fail(g->ctx, MR_EFORMAT, "type %.20s of components %zu is not read",
		    type ? type : "none", a->kind);
	MR_TRY(find_rows(g, json, a->components * kind_bytes(a->kind), a->count, &a->data, &a->stride));
	return MR_OK;
}

mr_status
mr_accessor_open(mr_gltf *g, size_t number, mr_accessor *a)
{
	mr_accessor made = { .number = number };

	if (g->made[number].data) {
		*a = g->made[number];
		return MR_OK;
	}
	MR_TRY(mr_prefix(
	    g->ctx, open_accessor(g, mr_gltf_at(g, "accessors", number), &made), "accessor %zu", number));
	*a = made;
	return MR_OK;
}

/* A component as it is. */
static double
component(const unsigned char *p, size_t kind)
{
	return mr_load_number(p, "IUIU?UF"[kind - 5120], kind_bytes(kind), false);
}

/* The number that stores a normalised component of 1. */
static double
whole_of(const mr_accessor *a)
{
	static const double largest[] = { 127, 255, 32767, 65535 };

	return a->normalized && a->kind <= MR_GLTF_UNSIGNED_SHORT ? largest[a->kind - 5120] : 1;
}

static void
row_reals(const mr_accessor *a, const unsigned char *p, size_t width, double *x)
{
	size_t step = kind_bytes(a->kind);
	double whole = whole_of(a);

	for (size_t k = 0; k < a->components && k < width; k++) {
		x[k] = component(p + k * step, a->kind) / whole;
		if (whole > 1 && x[k] < -1)
			x[k] = -1; /* the most negative number of its type */
	}
}

void
mr_accessor_reals(const mr_accessor *a, size_t width, double *x)
{
	for (size_t i = 0; i < a->count; i++)
		row_reals(a, a->data + i * a->stride, width, x + i * width);
}

mr_status
mr_accessor_indices(mr_gltf *g, const mr_accessor *a, size_t limit, uint32_t *index)
{
	if (a->components != 1 || a->kind % 2 == 0)
		return mr_fail(g->ctx, MR_EFORMAT, "accessor %zu holds no indices", a->number);
	for (size_t i = 0; i < a->count; i++)
		index[i] = (uint32_t)component(a->data + i * a->stride, a->kind);
	for (size_t i = 0; i < a->count; i++)
		if (index[i] >= limit)
			return mr_fail(g->ctx, MR_ERANGE, "accessor %zu: index %zu is vertex %u of %zu",
			    a->number, i, (unsigned)index[i], limit);
	return MR_OK;
}
