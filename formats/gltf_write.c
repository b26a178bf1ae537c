/* GLB, written: a node with a mesh for each object of each layer, a primitive for each of its materials.
 * Poses are morph targets of an animation.  All of a layer share its vertices. */
#include "base/text.h"
#include "formats/filename.h"
#include "formats/gltf_meshopt.h"
#include "formats/gltf_writer.h"
#include "formats/image.h"
#include "formats/materials.h"
#include "mesh/name_lists.h"

#include <ctype.h>

enum { POINTS = 0 };

/* ---- vertices and faces as the format has them ---- */

/* Sorts `order` by key[order[i]], stably; keys are at most `most`. */
static void
sort_by(mr_ctx *ctx, const uint32_t *key, size_t most, uint32_t *order, size_t n)
{
	MR_SCOPE(ctx);
	size_t *start = MR_NEW_ZERO(ctx, most + 2, size_t);
	uint32_t *to = MR_NEW(ctx, n, uint32_t);

	for (size_t i = 0; i < n; i++)
		start[key[order[i]] + 1]++;
	for (size_t k = 0; k <= most; k++)
		start[k + 1] += start[k];
	for (size_t i = 0; i < n; i++)
		to[start[key[order[i]]]++] = order[i];
	memcpy(order, to, n * sizeof *to);
}

static void
face_names_find(mr_ctx *ctx, const uint32_t *column, mr_lines lines, size_t nf, face_names *names)
{
	*names = (face_names){ .of = MR_NEW_ZERO(ctx, nf, uint32_t) };
	if (!column || !lines.text)
		return;
	mr_line_starts(ctx, lines.text, lines.bytes, &names->start, &names->count);
	for (size_t f = 0; f < nf; f++) {
		uint32_t i = column[f];
		bool named = i < names->count && names->start[i + 1] > names->start[i] + 1;
		names->of[f] = named ? i : (uint32_t)names->count;
	}
}

/* ---- pieces of JSON and bytes ---- */

static json_t *
owned(glb *w, json_t *json)
{
	mr_gltf_own(w->ctx, json);
	return json;
}

size_t
mr_glb_append(glb *w, json_t *array, json_t *thing)
{
	size_t n = json_array_size(array);

	w->failed |= json_array_append_new(array, thing) != 0;
	return n;
}

size_t
mr_glb_push(glb *w, const char *array, json_t *thing)
{
	json_t *list = json_object_get(w->root, array);

	if (!list) {
		list = json_array();
		w->failed |= json_object_set_new(w->root, array, list) != 0;
	}
	return mr_glb_append(w, list, thing);
}

/* An array where it is not empty, which the format forbids, for "o*". */
static json_t *
filled(json_t *array)
{
	return json_array_size(array) ? json_incref(array) : NULL;
}

/* Every view begins at a multiple of four bytes.  Rows of vertices name their stride if it does not follow
 * from their type. */
size_t
mr_glb_new_view(glb *w, size_t count, size_t stride, size_t target, mr_view_kind kind, char **to)
{
	size_t bytes = count * stride, padded = (bytes + 3) / 4 * 4;
	bool rows = kind == MR_VIEW_ROWS && target != MR_UNKNOWN;

	MR_RESERVE(w->ctx, w->view, w->views, 1, &w->view_room);
	w->view[w->views++] = (mr_gltf_view){ w->bytes, count, stride, kind };
	MR_RESERVE(w->ctx, w->bin, w->bytes, padded, &w->room);
	*to = (char *)w->bin + w->bytes;
	memset(*to, 0, padded);
	w->bytes += padded;
	return mr_glb_push(w, "bufferViews",
	    json_pack("{s:i, s:I, s:I, s:o*, s:o*}", "buffer", 0, "byteOffset", number(w->bytes - padded),
		"byteLength", number(bytes), "byteStride", index_of(w, rows ? stride : MR_UNKNOWN), "target",
		index_of(w, target)));
}

size_t
mr_glb_put_indices(glb *w, const uint32_t *index, size_t count, size_t n, size_t target)
{
	size_t bytes = mr_index_bytes(n), view;
	char *to = NULL;

	view = mr_glb_new_view(
	    w, count, bytes, target, target == MR_UNKNOWN ? MR_VIEW_INDICES : MR_VIEW_TRIANGLES, &to);
	for (size_t i = 0; i < count; i++, to += bytes)
		memcpy(to, &index[i], bytes); /* little-endian */
	return view;
}

void
mr_glb_set(glb *w, size_t accessor, const char *key, json_t *value)
{
	json_t *json = json_array_get(json_object_get(w->root, "accessors"), accessor);

	w->failed |= json_object_set_new(json, key, value) != 0;
}

void
mr_glb_set_bounds(glb *w, size_t accessor, json_t *min, json_t *max)
{
	mr_glb_set(w, accessor, "min", min);
	mr_glb_set(w, accessor, "max", max);
}

/* ---- materials ---- */

static const char *
image_type(const mr_file_bytes *b)
{
	if (mr_is_png(b->data, b->size))
		return "image/png";
	return mr_is_jpeg(b->data, b->size) ? "image/jpeg" : NULL;
}

/* A file beside the document, called as that is up to `end`, and the URI of it. */
static mr_status
put_file(glb *w, const char *end, const void *data, size_t bytes, json_t **uri)
{
	mr_text text = { .ctx = w->ctx };
	const char *name;

	MR_TRY(mr_put_beside(w->ctx, w->s->path, end, data, bytes, &name));
	for (; *name; name++)
		if (isalnum((unsigned char)*name) || strchr("-._~", *name))
			mr_text_bytes(&text, name, 1);
		else
			mr_text_add(&text, "%%%02X", (unsigned)(unsigned char)*name);
	*uri = mr_glb_made(w, true, json_string(text.s));
	return MR_OK;
}

/* The bytes of a picture as they are, and the texture that shows it. */
static mr_status
put_image(glb *w, const char *file, const mr_file_bytes *b, size_t *texture)
{
	const char *type = image_type(b);
	size_t view = MR_UNKNOWN, image;
	json_t *uri = NULL;
	char *to = NULL, end[32];

	MR_ENTER(w->ctx);
	if (w->beside) {
		snprintf(end, sizeof end, "-%zu.%s", json_array_size(json_object_get(w->root, "images")) + 1,
		    mr_is_png(b->data, b->size) ? "png" : "jpg");
		MR_TRY(put_file(w, end, b->data, b->size, &uri));
	} else {
		view = mr_glb_new_view(w, b->size, 1, MR_UNKNOWN, MR_VIEW_BYTES, &to);
		memcpy(to, b->data, b->size);
	}
	image = mr_glb_push(w, "images",
	    json_pack("{s:o*, s:o*, s:s, s:s}", "uri", uri, "bufferView", index_of(w, view), "mimeType", type,
		"name", mr_file_name(file)));
	*texture = mr_glb_push(w, "textures", json_pack("{s:I}", "source", number(image)));
	return MR_OK;
}

/* The texture of a picture; MR_UNKNOWN where there is none, or of a kind that glTF does not have. */
static mr_status
embed(glb *w, const mr_file *file, size_t *texture)
{
	size_t known = json_array_size(json_object_get(w->root, "textures"));
	mr_file_bytes b = { 0 };
	mr_status status = MR_OK;

	*texture = MR_UNKNOWN;
	for (size_t i = 0; file->name && i < known; i++)
		if (!strcmp(w->image[i], file->name))
			*texture = i;
	if (!file->name || *texture != MR_UNKNOWN)
		return MR_OK;
	MR_RESERVE(w->ctx, w->image, known, 1, &w->image_room);
	w->image[known] = file->name;
	MR_TRY(mr_file_read(w->ctx, file, &b));
	if (image_type(&b))
		status = put_image(w, file->name, &b, texture);
	else
		mr_tell(w->ctx, MR_LOST, 1, "picture %s, which is neither PNG nor JPEG", file->name);
	return mr_prefix(w->ctx, mr_file_bytes_end(&b, status), "%s", file->name);
}

/* A reference to a texture, for "o*". */
static json_t *
shows(glb *w, size_t texture)
{
	bool is = texture != MR_UNKNOWN;

	return mr_glb_made(w, is, is ? json_pack("{s:I}", "index", number(texture)) : NULL);
}

/* The format's default is metal, seen from one side. */
static json_t *
new_material(glb *w, const mr_material *look, const char *name, size_t bytes, size_t texture, size_t normals)
{
	const double *light = look->emission;
	bool shines = light[0] > 0 || light[1] > 0 || light[2] > 0;
	double c[3], e[3];

	for (int k = 0; k < 3; k++) {
		c[k] = look->colored && texture == MR_UNKNOWN ? mr_srgb_to_linear(look->color[k]) : 1;
		e[k] = mr_srgb_to_linear(light[k]);
	}
	return json_pack("{s:{s:[f, f, f, f], s:f, s:f, s:o*}, s:b, s:s*, s:o*, s:o*, s:o*}",
	    "pbrMetallicRoughness", "baseColorFactor", c[0], c[1], c[2], look->opacity, "metallicFactor",
	    look->metal, "roughnessFactor", look->roughness, "baseColorTexture", shows(w, texture),
	    "doubleSided", 1, "alphaMode", look->opacity < 1 ? "BLEND" : NULL, "emissiveFactor",
	    mr_glb_made(w, shines, shines ? json_pack("[f, f, f]", e[0], e[1], e[2]) : NULL), "normalTexture",
	    shows(w, normals), "name", mr_glb_made(w, bytes > 0, bytes ? json_stringn(name, bytes) : NULL));
}

static mr_status
put_materials(glb *w, layer *l)
{
	const char **name = l->material.start;
	mr_material *look = NULL;
	size_t count = 0;

	l->materials = MR_NEW(w->ctx, l->material.count, size_t);
	MR_TRY(mr_materials_find(w->ctx, &l->model, w->scene->folder, &look, &count));
	for (size_t i = 0; i < l->material.count; i++) {
		size_t bytes = (size_t)(name[i + 1] - name[i]) - 1, texture, normals;
		if (bytes == 0) /* no face has it */
			continue;
		MR_TRY(embed(w, &look[i].file, &texture));
		MR_TRY(embed(w, &look[i].normals, &normals));
		l->materials[i] = mr_glb_push(
		    w, "materials", new_material(w, &look[i], name[i], bytes, texture, normals));
	}
	return MR_OK;
}

/* The material of a face; one without has a neutral one without a name. */
static size_t
material_of(glb *w, const layer *l, size_t f)
{
	if (l->material.of[f] < l->material.count)
		return l->materials[l->material.of[f]];
	if (w->unnamed == MR_UNKNOWN)
		w->unnamed = mr_glb_push(
		    w, "materials", new_material(w, &mr_material_plain, NULL, 0, MR_UNKNOWN, MR_UNKNOWN));
	return w->unnamed;
}

/* ---- primitives, meshes, nodes ---- */

/* A primitive of the layer's vertices. */
static json_t *
new_primitive(glb *w, const layer *l, bool texcoords, size_t indices, size_t material, size_t mode)
{
	return json_pack("{s:{s:I, s:o*, s:o*, s:o*}, s:o*, s:o*, s:o*, s:o*}", "attributes", "POSITION",
	    number(l->position), "NORMAL", index_of(w, l->normal), "TEXCOORD_0",
	    index_of(w, texcoords ? l->texcoord : MR_UNKNOWN), "COLOR_0", index_of(w, l->color), "targets",
	    filled(l->targets), "indices", index_of(w, indices), "material", index_of(w, material), "mode",
	    index_of(w, mode));
}

/* The primitive of faces `first` to `last` in the order; it has texture coordinates where a corner has some.
 */
static void
put_primitive(glb *w, const layer *l, size_t first, size_t last, json_t *primitives)
{
	size_t count = 3 * (last - first), view, accessor;
	bool texcoords = false;

	for (size_t i = 3 * first; i < 3 * last; i++)
		texcoords |= has_texcoord(mr_corner_texcoord(&l->model, 3 * (size_t)l->face[i / 3] + i % 3));
	view = mr_glb_put_indices(w, l->order + 3 * first, count, l->v.count, MR_GLTF_ELEMENTS);
	accessor = mr_glb_push(w, "accessors",
	    json_pack("{s:I, s:I, s:I, s:s}", "bufferView", number(view), "componentType",
		number(mr_index_kind(l->v.count)), "count", number(count), "type", "SCALAR"));
	mr_glb_append(w, primitives,
	    new_primitive(w, l, texcoords, accessor, material_of(w, l, l->face[first]), MR_UNKNOWN));
}

/* Gives the node the origin and step of the grid of quantized positions. */
static void
place_node(glb *w, const layer *l, json_t *node)
{
	if (l->step > 0)
		w->failed |= json_object_set_new(node, "translation",
				 json_pack("[f, f, f]", l->origin.x, l->origin.y, l->origin.z)) ||
		             json_object_set_new(
				 node, "scale", json_pack("[f, f, f]", l->step, l->step, l->step));
}

/* A node and its mesh; takes the primitives. */
static void
put_node(glb *w, const layer *l, const char *name, json_t *primitives)
{
	const char *own = *name ? name : NULL;
	size_t mesh = mr_glb_push(
	    w, "meshes", json_pack("{s:o, s:s*}", "primitives", primitives, "name", own));
	json_t *json = json_pack("{s:I, s:s*}", "mesh", number(mesh), "name", own);
	size_t node;

	place_node(w, l, json);
	node = mr_glb_push(w, "nodes", json);
	MR_RESERVE(w->ctx, w->take, node, 1, &w->takes);
	w->take[node] = l->node->take;
	if (l->node->targets)
		mr_glb_append(w, w->channels,
		    json_pack("{s:I, s:{s:I, s:s}}", "sampler", number(l->sampler), "target", "node",
			number(node), "path", "weights"));
}

/* The layer's name, followed by the object's. */
static char *
object_name(glb *w, const layer *l, uint32_t object)
{
	const char **name = l->object.start;

	if (object >= l->object.count)
		return mr_format(w->ctx, "%s", l->name);
	return mr_format(w->ctx, "%s%s%.*s", l->name, *l->name ? ": " : "",
	    (int)(name[object + 1] - name[object]) - 1, name[object]);
}

/* Whether two faces can be of one primitive. */
static bool
is_alike(const layer *l, uint32_t f, uint32_t g)
{
	return l->object.of[f] == l->object.of[g] && l->material.of[f] == l->material.of[g];
}

size_t
mr_glb_run(const layer *l, size_t first)
{
	size_t end = first + 1;

	while (end < l->model.nf && is_alike(l, l->face[first], l->face[end]))
		end++;
	return end;
}

/* The primitives of one object, from face *at in the order on; *at moves past them. */
static void
put_object(glb *w, const layer *l, size_t *at)
{
	uint32_t object = l->object.of[l->face[*at]];
	json_t *primitives = json_array();

	while (*at < l->model.nf && l->object.of[l->face[*at]] == object) {
		size_t end = mr_glb_run(l, *at);
		put_primitive(w, l, *at, end, primitives);
		*at = end;
	}
	put_node(w, l, object_name(w, l, object), primitives);
}

/* Faces by object and material. */
static void
order_faces(glb *w, layer *l)
{
	const mr_model *m = &l->model;

	face_names_find(w->ctx, m->object, m->objects, m->nf, &l->object);
	face_names_find(w->ctx, m->material, m->materials, m->nf, &l->material);
	l->face = MR_NEW(w->ctx, m->nf, uint32_t);
	for (size_t f = 0; f < m->nf; f++)
		l->face[f] = (uint32_t)f;
	sort_by(w->ctx, l->material.of, l->material.count, l->face, m->nf);
	sort_by(w->ctx, l->object.of, l->object.count, l->face, m->nf);
	l->order = MR_NEW(w->ctx, 3 * m->nf, uint32_t);
	for (size_t i = 0; i < 3 * m->nf; i++)
		l->order[i] = l->v.index[3 * (size_t)l->face[i / 3] + i % 3];
}

static mr_status
put_layer(glb *w, layer *l)
{
	const mr_model *m = &l->model;
	size_t at = 0;

	if (m->nv == 0)
		return mr_fail(w->ctx, MR_EMESH, "a layer without a vertex cannot be written as glb");
	mr_glb_find_vertices(w, l);
	order_faces(w, l);
	if (w->scene->gltf.compress && m->nf)
		MR_TRY(mr_glb_order(w, l));
	mr_glb_put_vertices(w, l);
	mr_glb_put_poses(w, l);
	if (m->nf == 0) {
		put_node(w, l, l->name,
		    json_pack("[o]", new_primitive(w, l, true, MR_UNKNOWN, MR_UNKNOWN, POINTS)));
		return MR_OK;
	}
	MR_TRY(put_materials(w, l));
	while (at < m->nf)
		put_object(w, l, &at);
	return MR_OK;
}

/* ---- the file ---- */

/* The name of a node, by frame, layer or both, whichever distinguish it. */
static const char *
node_name(mr_ctx *ctx, const mr_scene *scene, const mr_scene_node *n)
{
	bool frames = false, layers = false;

	for (size_t i = 0; i < scene->nodes; i++) {
		frames |= scene->node[i].take != n->take;
		layers |= scene->node[i].take == n->take && &scene->node[i] != n;
	}
	return mr_format(
	    ctx, "%s%s%s", frames ? n->frame : "", frames && layers ? ": " : "", layers ? n->layer : "");
}

/* Names an extension that readers must support. */
static void
need_extension(glb *w, const char *name)
{
	mr_glb_push(w, "extensionsUsed", json_string(name));
	mr_glb_push(w, "extensionsRequired", json_string(name));
}

/* Levels of detail (MSFT_lod): nodes of later frames are coarser levels of the first frame's nodes, in
 * order. */
static mr_status
put_levels(glb *w, size_t nodes, size_t first)
{
	json_t *all = json_object_get(w->root, "nodes");
	bool fit = nodes % first == 0;

	for (size_t i = 0; i < nodes; i++)
		fit = fit && w->take[i] == w->take[i / first * first] &&
		      (i < first || w->take[i] != w->take[i - first]);
	if (!fit)
		return mr_fail(w->ctx, MR_EMESH, "levels of detail with different numbers of objects");
	for (size_t i = 0; i < first; i++) {
		json_t *ids = json_array();
		for (size_t k = i + first; k < nodes; k += first)
			mr_glb_append(w, ids, json_integer(number(k)));
		w->failed |= json_object_set_new(json_array_get(all, i), "extensions",
				 json_pack("{s:{s:o}}", "MSFT_lod", "ids", ids)) != 0;
	}
	mr_glb_push(w, "extensionsUsed", json_string("MSFT_lod"));
	return MR_OK;
}

/* One scene with all nodes side by side, or with the first frame's nodes, of which the others are levels. */
static mr_status
put_scene(glb *w)
{
	size_t nodes = json_array_size(json_object_get(w->root, "nodes")), shown = nodes;
	json_t *list = json_array();

	while (w->scene->gltf.lods && w->take && shown > 1 && w->take[shown - 1] != w->take[0])
		shown--;
	for (size_t i = 0; i < shown; i++)
		mr_glb_append(w, list, json_integer(number(i)));
	mr_glb_push(w, "scenes", json_pack("{s:o}", "nodes", list));
	return shown < nodes ? put_levels(w, nodes, shown) : MR_OK;
}

/* The bytes; packed ones are followed by a place for the unpacked ones. */
static mr_status
put_buffers(glb *w)
{
	json_t *uri = NULL;
	size_t all = 0;

	if (w->scene->gltf.compress)
		mr_glb_compress(w, &all);
	if (w->beside)
		MR_TRY(put_file(w, ".bin", w->bin, w->bytes, &uri));
	mr_glb_push(w, "buffers", json_pack("{s:I, s:o*}", "byteLength", number(w->bytes), "uri", uri));
	if (all)
		mr_glb_push(w, "buffers",
		    json_pack("{s:I, s:{s:{s:b}}}", "byteLength", number(all), "extensions", MR_MESHOPT,
			"fallback", 1));
	if (all)
		need_extension(w, MR_MESHOPT);
	if (w->scene->gltf.quantize)
		need_extension(w, "KHR_mesh_quantization");
	return MR_OK;
}

static mr_status
end_root(glb *w)
{
	MR_TRY(put_scene(w));
	MR_TRY(put_buffers(w));
	if (json_array_size(w->channels))
		mr_glb_push(w, "animations",
		    json_pack("{s:O, s:O}", "samplers", w->samplers, "channels", w->channels));
	return MR_OK;
}

/* Header, JSON filled up with blanks, bytes. */
static mr_status
put_chunks(glb *w, const char *json)
{
	size_t text = strlen(json), padded = (text + 3) / 4 * 4, all = 12 + 8 + padded + 8 + w->bytes;

	if (all > UINT32_MAX)
		return mr_fail(w->ctx, MR_ERANGE, "%zu bytes are more than a glb can have", all);
	mr_put(w->s, (uint32_t[]){ MR_GLTF_MAGIC, 2, (uint32_t)all, (uint32_t)padded, MR_GLTF_JSON }, 20);
	mr_put(w->s, json, text);
	mr_put(w->s, "   ", padded - text);
	mr_put(w->s, (uint32_t[]){ (uint32_t)w->bytes, MR_GLTF_BIN }, 8);
	mr_put(w->s, w->bin, w->bytes);
	return MR_OK;
}

static int
add_text(const char *s, size_t n, void *text)
{
	mr_text_add(text, "%.*s", (int)n, s);
	return 0;
}

/* Into a text of ours: json_dumps leaves out a key for which it has no memory, and says that all is well. */
static mr_status
write_document(mr_sink *s, const mr_scene *scene, bool beside)
{
	glb w = { .s = s, .ctx = s->ctx, .scene = scene, .unnamed = MR_UNKNOWN, .beside = beside };
	mr_text json = { .ctx = w.ctx };

	w.root = owned(&w, json_pack("{s:{s:s, s:s}, s:i}", "asset", "version", "2.0", "generator",
			       "mr " MR_VERSION, "scene", 0));
	w.samplers = owned(&w, json_array());
	w.channels = owned(&w, json_array());
	for (size_t i = 0; i < scene->nodes; i++) {
		layer l = { .node = &scene->node[i],
			.model = scene->node[i].model,
			.name = node_name(w.ctx, scene, &scene->node[i]),
			.targets = owned(&w, json_array()) };
		MR_TRY(put_layer(&w, &l));
	}
	MR_TRY(end_root(&w));
	w.failed |= json_dump_callback(w.root, add_text, &json, JSON_COMPACT) != 0;
	if (w.large)
		return mr_fail(w.ctx, MR_ERANGE, "texture coordinates are too large for float32");
	if (w.failed)
		return mr_fail(w.ctx, MR_EMEM, "no memory for the JSON of a glb");
	if (!beside)
		return put_chunks(&w, json.s);
	mr_put(s, json.s, json.n);
	mr_put(s, "\n", 1);
	return MR_OK;
}

mr_status
mr_glb_write_scene(mr_sink *s, const mr_scene *scene)
{
	return write_document(s, scene, false);
}

mr_status
mr_gltf_write_scene(mr_sink *s, const mr_scene *scene)
{
	return write_document(s, scene, true);
}

mr_status
mr_glb_note_lost(mr_sink *s, const mr_model *m)
{
	mr_note_lost(s, m, "normal corner_normal color alpha texcoord corner_texcoord object material faces");
	return mr_note_rounded(s, m);
}

static mr_status
write_model(mr_sink *s, const mr_model *m, bool beside)
{
	mr_scene_node node = { .frame = "", .layer = "", .model = *m };

	MR_TRY(mr_glb_note_lost(s, m));
	return write_document(s, &(mr_scene){ .node = &node, .nodes = 1, .folder = "." }, beside);
}

mr_status
mr_glb_write(mr_sink *s, const mr_model *m)
{
	return write_model(s, m, false);
}

mr_status
mr_gltf_write(mr_sink *s, const mr_model *m)
{
	return write_model(s, m, true);
}
