/* GLB, written: a node with a mesh for each object of each layer, a primitive for each of its materials, and
 * poses as morph targets that an animation shows one after the other. */
#include "base/text.h"
#include "formats/gltf.h"
#include "formats/gltf_sets.h"
#include "formats/image.h"
#include "formats/materials.h"
#include "formats/names.h"

#include <stdlib.h>

enum { POINTS = 0, FRAMES_A_SECOND = 24 };

/* The document on its way.  What jansson has no memory for is noted, and told of in the end. */
typedef struct glb {
	mr_sink *s;
	mr_ctx *ctx;
	const mr_scene *scene;
	json_t *root;
	json_t *nodes, *meshes, *views, *accessors, *materials, *images, *textures; /* of the root */
	json_t *samplers, *channels;                                                /* of the animation */
	bool failed;
	unsigned char *bin; /* the second chunk */
	size_t bytes, room;
	const char **image; /* files of the images so far */
	size_t image_room;
	size_t numbers; /* of vertices so far, over all layers */
	bool numbered;  /* those of the layer at hand are, from there on */
	size_t unnamed; /* the material of faces without one; MR_UNKNOWN: not there yet */
	unsigned lost;  /* what materials have and the document has not, see materials.h */
} glb;

/* A layer on its way. */
typedef struct layer {
	const mr_scene_node *node;
	const char *name; /* of its nodes, before that of an object */
	mr_sets sets;
	size_t *material; /* of each of its names, the material of the document */
	bool relief;      /* one of them has a picture of normals */
} layer;

/* ---- pieces of JSON and bytes ---- */

/* Appends to an array; its number there. */
static size_t
push(glb *w, json_t *array, json_t *thing)
{
	if (json_array_append_new(array, thing)) {
		w->failed = true;
		return 0;
	}
	return json_array_size(array) - 1;
}

static void
set(glb *w, json_t *object, const char *key, json_t *value)
{
	w->failed |= json_object_set_new(object, key, value) != 0;
}

static json_t *
number(size_t n)
{
	return json_integer((json_int_t)n);
}

/* Sets an array where it is not empty, which the format forbids. */
static void
set_array(glb *w, json_t *object, const char *key, json_t *array)
{
	if (json_array_size(array))
		set(w, object, key, json_incref(array));
}

/* Room for bytes of the second chunk, up to a multiple of four, and a view of it. */
static mr_status
new_view(glb *w, size_t bytes, size_t target, size_t *view, char **to)
{
	size_t padded = (bytes + 3) / 4 * 4;
	json_t *json = json_object();

	set(w, json, "buffer", number(0));
	set(w, json, "byteOffset", number(w->bytes));
	set(w, json, "byteLength", number(bytes));
	if (target)
		set(w, json, "target", number(target));
	*view = push(w, w->views, json);
	MR_TRY(MR_RESERVE(w->ctx, w->bin, w->bytes, padded, &w->room));
	*to = (char *)w->bin + w->bytes;
	memset(*to + bytes, 0, padded - bytes);
	w->bytes += padded;
	return MR_OK;
}

/* An accessor over a whole view. */
static size_t
new_accessor(glb *w, size_t view, size_t kind, size_t count, const char *type)
{
	json_t *json = json_object();

	set(w, json, "bufferView", number(view));
	set(w, json, "componentType", number(kind));
	set(w, json, "count", number(count));
	set(w, json, "type", json_string(type));
	return push(w, w->accessors, json);
}

/* A view of values of vertices, `size` bytes each, to be filled from `to` on, and the accessor over it. */
static mr_status
new_values(glb *w, size_t count, size_t size, size_t kind, const char *type, char **to, size_t *accessor)
{
	size_t view = 0;

	MR_TRY(new_view(w, size * count, MR_GLTF_ARRAY, &view, to));
	*accessor = new_accessor(w, view, kind, count, type);
	return MR_OK;
}

/* The least and the greatest of its values. */
static void
set_bounds(glb *w, size_t accessor, const double *low, const double *high, size_t n)
{
	json_t *json = json_array_get(w->accessors, accessor), *min = json_array(), *max = json_array();

	for (size_t k = 0; k < n; k++) {
		push(w, min, json_real(low[k]));
		push(w, max, json_real(high[k]));
	}
	set(w, json, "min", min);
	set(w, json, "max", max);
}

static char *
put_floats(char *to, mr_v3 a)
{
	to = mr_store_float(to, (float)a.x);
	to = mr_store_float(to, (float)a.y);
	return mr_store_float(to, (float)a.z);
}

static mr_v3
as_floats(mr_v3 a)
{
	return mr_vec(mr_as_float(a.x), mr_as_float(a.y), mr_as_float(a.z));
}

/* ---- materials ---- */

static const char *
image_type(const mr_file_bytes *b)
{
	if (mr_is_png(b->data, b->size))
		return "image/png";
	return mr_is_jpeg(b->data, b->size) ? "image/jpeg" : NULL;
}

/* The bytes of a picture as they are, and the texture that shows it. */
static mr_status
put_image(glb *w, const char *file, const mr_file_bytes *b, size_t *texture)
{
	const char *slash = strrchr(file, '/'), *type = image_type(b);
	json_t *image, *shows;
	size_t view = 0;
	char *to = NULL;

	MR_TRY(new_view(w, b->size, 0, &view, &to));
	memcpy(to, b->data, b->size);
	image = json_object();
	shows = json_object();
	set(w, image, "bufferView", number(view));
	set(w, image, "mimeType", json_string(type));
	set(w, image, "name", json_string(slash ? slash + 1 : file));
	set(w, shows, "source", number(push(w, w->images, image)));
	*texture = push(w, w->textures, shows);
	return MR_OK;
}

/* MR_UNKNOWN where the picture is of a kind that glTF does not have. */
static mr_status
embed(glb *w, const char *file, size_t *texture)
{
	size_t known = json_array_size(w->textures);
	mr_file_bytes b = { 0 };
	mr_status status = MR_OK;

	for (size_t i = 0; i < known; i++)
		if (!strcmp(w->image[i], file)) {
			*texture = i;
			return MR_OK;
		}
	MR_TRY(MR_RESERVE(w->ctx, w->image, known, 1, &w->image_room));
	w->image[known] = file;
	*texture = MR_UNKNOWN;
	MR_TRY(mr_file_bytes_read(w->ctx, file, &b));
	if (image_type(&b))
		status = put_image(w, file, &b, texture);
	else
		mr_tell(w->ctx, MR_LOST, 1, "picture %s, which is neither PNG nor JPEG", file);
	return mr_prefix(w->ctx, mr_file_bytes_end(w->ctx, &b, status), "%s", file);
}

/* A reference to a texture. */
static json_t *
texture_info(glb *w, size_t texture)
{
	json_t *json = json_object();

	set(w, json, "index", number(texture));
	return json;
}

static json_t *
linear_color(glb *w, const double color[3])
{
	json_t *json = json_array();

	for (int k = 0; k < 3; k++)
		push(w, json, json_real(mr_srgb_to_linear(color[k])));
	return json;
}

/* What says nothing else is of metal to the format, and seen from one side. */
static json_t *
new_material(glb *w, const mr_material *look, size_t texture)
{
	static const double white[3] = { 1, 1, 1 };
	const double *light = look->emission;
	json_t *json = json_object(), *surface = json_object(), *color;

	color = linear_color(w, look->colored && texture == MR_UNKNOWN ? look->color : white);
	push(w, color, json_real(look->opacity));
	set(w, surface, "baseColorFactor", color);
	set(w, surface, "metallicFactor", json_real(look->metal));
	set(w, surface, "roughnessFactor", json_real(look->roughness));
	if (texture != MR_UNKNOWN)
		set(w, surface, "baseColorTexture", texture_info(w, texture));
	set(w, json, "pbrMetallicRoughness", surface);
	set(w, json, "doubleSided", json_true());
	if (look->opacity < 1)
		set(w, json, "alphaMode", json_string("BLEND"));
	if (light[0] > 0 || light[1] > 0 || light[2] > 0)
		set(w, json, "emissiveFactor", linear_color(w, light));
	return json;
}

/* Normals, and heights, for which the format has no place of its own: in what is left to programs. */
static mr_status
put_relief(glb *w, layer *l, const mr_material *look, json_t *json)
{
	size_t texture = MR_UNKNOWN;
	json_t *extras;

	if (look->normals)
		MR_TRY(embed(w, look->normals, &texture));
	if (texture != MR_UNKNOWN) {
		l->relief = true;
		set(w, json, "normalTexture", texture_info(w, texture));
	}
	texture = MR_UNKNOWN;
	if (look->heights)
		MR_TRY(embed(w, look->heights, &texture));
	if (texture == MR_UNKNOWN)
		return MR_OK;
	extras = json_object();
	set(w, extras, "displacementTexture", texture_info(w, texture));
	set(w, extras, "displacementBias", json_real(look->base));
	set(w, extras, "displacementScale", json_real(look->gain));
	set(w, json, "extras", extras);
	return MR_OK;
}

/* A text of JSON: any that is not UTF-8 as a stream has it. */
static json_t *
text_of(glb *w, const char *name, size_t bytes)
{
	json_t *json = json_stringn(name, bytes);
	mr_lines text;

	if (json || mr_names_escape(w->ctx, (mr_lines){ name, bytes }, &text) < 0)
		return json;
	return json_stringn(text.text, text.bytes);
}

static mr_status
put_materials(glb *w, layer *l)
{
	const char **name = l->sets.material_name;
	mr_material *look = NULL;
	size_t count = 0;

	l->material = MR_NEW(w->ctx, l->sets.materials, size_t);
	if (!l->material)
		return MR_EMEM;
	MR_TRY(mr_materials_find(w->ctx, &l->node->model, w->scene->folder, &look, &count));
	for (size_t i = 0; i < l->sets.materials; i++) {
		size_t bytes = (size_t)(name[i + 1] - name[i]) - 1, texture = MR_UNKNOWN;
		json_t *json;
		if (bytes == 0) /* no face has it */
			continue;
		w->lost |= look[i].lost;
		if (look[i].file)
			MR_TRY(embed(w, look[i].file, &texture));
		json = new_material(w, &look[i], texture);
		set(w, json, "name", text_of(w, name[i], bytes));
		l->material[i] = push(w, w->materials, json);
		MR_TRY(put_relief(w, l, &look[i], json));
	}
	return MR_OK;
}

/* The material of a face; one without has a neutral one without a name. */
static size_t
material_of(glb *w, const layer *l, size_t f)
{
	if (l->sets.material[f] < l->sets.materials)
		return l->material[l->sets.material[f]];
	if (w->unnamed == MR_UNKNOWN)
		w->unnamed = push(w, w->materials, new_material(w, &mr_material_plain, MR_UNKNOWN));
	return w->unnamed;
}

/* ---- attributes ---- */

/* Positions, or how far a pose moves them: the difference of floats, so that nothing is rounded twice. */
static mr_status
put_positions(glb *w, const mr_v3 *p, const mr_v3 *from, const mr_vertex_set *v, size_t *accessor)
{
	mr_box box = mr_box_empty();
	char *to = NULL;

	MR_TRY(new_values(w, v->count, 12, MR_GLTF_FLOAT, "VEC3", &to, accessor));
	for (size_t i = 0; i < v->count; i++) {
		mr_v3 x = as_floats(p[v->vertex[i]]);
		if (from)
			x = as_floats(mr_sub(x, as_floats(from[v->vertex[i]])));
		to = put_floats(to, x);
		mr_box_add(&box, x);
	}
	set_bounds(w, *accessor, &box.min.x, &box.max.x, 3);
	return MR_OK;
}

/* A normal that is a unit vector to the four digits of most files stays as it is; the format asks for three.
 */
static mr_v3
as_unit(mr_v3 n)
{
	mr_v3 f = as_floats(n);

	return fabs(mr_norm2(f) - 1) < 5e-4 ? f : as_floats(mr_unit(n));
}

/* The normal of a vertex of a set; along z where none is known, as of isolated vertices. */
static mr_v3
set_normal(const mr_v3 *of_vertices, const mr_v3 *of_corners, const mr_vertex_set *v, size_t i)
{
	const mr_v3 *n = of_vertices ? of_vertices + v->vertex[i] : NULL;

	if (of_corners)
		n = v->corner[i] != MR_NONE ? of_corners + v->corner[i] : NULL;
	return n && mr_is_direction(*n) ? as_unit(*n) : mr_vec(0, 0, 1);
}

/* pose: NULL, or the one that turns them. */
static mr_status
put_normals(glb *w, const mr_model *m, const mr_target *pose, const mr_vertex_set *v, size_t *accessor)
{
	char *to = NULL;

	MR_TRY(new_values(w, v->count, 12, MR_GLTF_FLOAT, "VEC3", &to, accessor));
	for (size_t i = 0; i < v->count; i++) {
		mr_v3 n = set_normal(m->normal, m->corner_normal, v, i);
		if (pose)
			n = mr_sub(set_normal(pose->normal, pose->corner_normal, v, i), n);
		to = put_floats(to, n);
	}
	return MR_OK;
}

/* v runs down the picture in glTF. */
static mr_status
put_texcoords(glb *w, const mr_model *m, const mr_vertex_set *v, size_t *accessor)
{
	char *to = NULL;

	MR_TRY(new_values(w, v->count, 8, MR_GLTF_FLOAT, "VEC2", &to, accessor));
	for (size_t i = 0; i < v->count; i++) {
		const double *uv = m->texcoord ? m->texcoord + 2 * (size_t)v->vertex[i] : NULL;
		if (v->corner[i] != MR_NONE)
			uv = mr_corner_texcoord(m, v->corner[i]);
		to = mr_store_float(to, uv ? (float)uv[0] : 0);
		to = mr_store_float(to, uv ? (float)(1 - uv[1]) : 0);
	}
	return MR_OK;
}

/* Where u increases on a corner's triangle, and 1 where v then increases to the left of it, else -1. */
static mr_v3
tangent_of(const mr_model *m, size_t corner, double *side)
{
	size_t f = corner / 3;
	const double *a = mr_corner_texcoord(m, 3 * f), *b = mr_corner_texcoord(m, 3 * f + 1),
		     *c = mr_corner_texcoord(m, 3 * f + 2);
	mr_v3 ab = mr_sub(m->p[m->t[f].v[1]], m->p[m->t[f].v[0]]);
	mr_v3 ac = mr_sub(m->p[m->t[f].v[2]], m->p[m->t[f].v[0]]);
	double area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);

	*side = area < 0 ? -1 : 1;
	return mr_mul(*side, mr_sub(mr_mul(c[1] - a[1], ab), mr_mul(b[1] - a[1], ac)));
}

/*
 * The frames of a picture of normals where no two triangles have a vertex of the set together, as in an
 * atlas: what Mikkelsen's rule gives there, which the format asks viewers for where a file has none; some
 * take another one.
 */
static mr_status
put_tangents(glb *w, const mr_model *m, const mr_vertex_set *v, size_t *accessor)
{
	char *to = NULL;

	MR_TRY(new_values(w, v->count, 16, MR_GLTF_FLOAT, "VEC4", &to, accessor));
	for (size_t i = 0; i < v->count; i++) {
		mr_v3 n = set_normal(m->normal, m->corner_normal, v, i), t;
		double side = 1;
		t = tangent_of(m, v->corner[i], &side);
		t = mr_sub(t, mr_mul(mr_dot(t, n) / mr_norm2(n), n));
		if (!mr_is_direction(t)) /* a triangle without area: any */
			t = mr_cross(n, fabs(n.x) < 0.5 ? mr_vec(1, 0, 0) : mr_vec(0, 1, 0));
		to = put_floats(to, mr_unit(t));
		to = mr_store_float(to, (float)side);
	}
	return MR_OK;
}

/* Linear there, where sixteen bits give every byte back. */
static mr_status
put_colors(glb *w, const mr_model *m, const mr_vertex_set *v, size_t *accessor)
{
	char *to = NULL;

	MR_TRY(new_values(w, v->count, 8, MR_GLTF_UNSIGNED_SHORT, "VEC4", &to, accessor));
	for (size_t i = 0; i < 4 * v->count; i++) {
		double c = m->color[4 * (size_t)v->vertex[i / 4] + i % 4] / 255.0;
		unsigned x = (unsigned)(65535 * (i % 4 == 3 ? c : mr_srgb_to_linear(c)) + 0.5);
		*to++ = (char)(x & 255);
		*to++ = (char)(x >> 8);
	}
	set(w, json_array_get(w->accessors, *accessor), "normalized", json_true());
	return MR_OK;
}

/* What tells vertices at one place apart. */
static mr_status
put_numbers(glb *w, const mr_vertex_set *v, size_t *accessor)
{
	char *to = NULL;

	MR_TRY(new_values(w, v->count, 4, MR_GLTF_UNSIGNED_SHORT, "VEC2", &to, accessor));
	for (size_t i = 0; i < v->count; i++)
		to = mr_store32(to, (uint32_t)(w->numbers + v->vertex[i]));
	return MR_OK;
}

static mr_status
put_attributes(glb *w, const mr_model *m, const mr_vertex_set *v, bool tangents, json_t *attributes)
{
	size_t accessor = 0;

	MR_TRY(put_positions(w, m->p, NULL, v, &accessor));
	set(w, attributes, "POSITION", number(accessor));
	if (v->kind & MR_SET_NORMALS) {
		MR_TRY(put_normals(w, m, NULL, v, &accessor));
		set(w, attributes, "NORMAL", number(accessor));
	}
	if (v->kind & MR_SET_TEXCOORDS) {
		MR_TRY(put_texcoords(w, m, v, &accessor));
		set(w, attributes, "TEXCOORD_0", number(accessor));
	}
	if (tangents) {
		MR_TRY(put_tangents(w, m, v, &accessor));
		set(w, attributes, "TANGENT", number(accessor));
	}
	if (m->color) {
		MR_TRY(put_colors(w, m, v, &accessor));
		set(w, attributes, "COLOR_0", number(accessor));
	}
	if (w->numbered) {
		MR_TRY(put_numbers(w, v, &accessor));
		set(w, attributes, MR_GLTF_NUMBER, number(accessor));
	}
	return MR_OK;
}

/* What the poses do to the vertices; to normals only where every pose has some. */
static mr_status
put_targets(glb *w, const mr_scene_node *node, const mr_vertex_set *v, json_t *targets)
{
	bool normals = (v->kind & MR_SET_NORMALS) != 0;
	size_t accessor = 0;

	for (size_t i = 0; i < node->targets; i++)
		normals = normals && (node->target[i].normal || node->target[i].corner_normal);
	for (size_t i = 0; i < node->targets; i++) {
		json_t *target = json_object();
		push(w, targets, target);
		MR_TRY(put_positions(w, node->target[i].p, node->model.p, v, &accessor));
		set(w, target, "POSITION", number(accessor));
		if (normals) {
			MR_TRY(put_normals(w, &node->model, &node->target[i], v, &accessor));
			set(w, target, "NORMAL", number(accessor));
		}
	}
	return MR_OK;
}

/* ---- primitives, meshes, nodes ---- */

static mr_status
put_indices(glb *w, const mr_sets *s, size_t first, size_t last, size_t *accessor)
{
	size_t view = 0;
	char *to = NULL;

	MR_TRY(new_view(w, 12 * (last - first), MR_GLTF_ELEMENTS, &view, &to));
	for (size_t i = first; i < last; i++)
		for (size_t k = 0; k < 3; k++)
			to = mr_store32(to, s->index[3 * (size_t)s->face[i] + k]);
	*accessor = new_accessor(w, view, MR_GLTF_UNSIGNED_INT, 3 * (last - first), "SCALAR");
	return MR_OK;
}

/* A primitive on these attributes, which it shares with others. */
static json_t *
new_primitive(glb *w, json_t *primitives, json_t *attributes, json_t *targets)
{
	json_t *primitive = json_object();

	set(w, primitive, "attributes", json_incref(attributes));
	set_array(w, primitive, "targets", targets);
	push(w, primitives, primitive);
	return primitive;
}

/* The primitives of faces `first` to `last` in the order, which are a set: one for each material. */
static mr_status
put_materials_of_set(
    glb *w, layer *l, size_t first, size_t last, json_t *primitives, json_t *attributes, json_t *targets)
{
	const mr_sets *s = &l->sets;
	size_t indices = 0;

	for (size_t i = first, end; i < last; i = end) {
		json_t *primitive;
		for (end = i + 1; end < last && s->material[s->face[end]] == s->material[s->face[i]];)
			end++;
		MR_TRY(put_indices(w, s, i, end, &indices));
		primitive = new_primitive(w, primitives, attributes, targets);
		set(w, primitive, "indices", number(indices));
		set(w, primitive, "material", number(material_of(w, l, s->face[i])));
	}
	return MR_OK;
}

/* Whether each corner of the faces of a set is a vertex of its own, with all that a frame needs. */
static bool
has_frames(const mr_vertex_set *v, size_t faces)
{
	if (v->count != 3 * faces || !(v->kind & MR_SET_TEXCOORDS) || !(v->kind & MR_SET_NORMALS))
		return false;
	for (size_t i = 0; i < v->count; i++)
		if (v->corner[i] == MR_NONE)
			return false;
	return true;
}

static mr_status
put_set(glb *w, layer *l, size_t first, size_t last, json_t *primitives)
{
	json_t *attributes = json_object(), *targets = json_array();
	mr_vertex_set v;
	mr_status status = mr_set_make(w->ctx, &l->sets, first, last, &v);

	if (status == MR_OK)
		status = put_attributes(
		    w, &l->node->model, &v, l->relief && has_frames(&v, last - first), attributes);
	if (status == MR_OK)
		status = put_targets(w, l->node, &v, targets);
	if (status == MR_OK)
		status = put_materials_of_set(w, l, first, last, primitives, attributes, targets);
	json_decref(attributes);
	json_decref(targets);
	return status;
}

/* Frame 0 is the key, at frame i target i - 1 alone weighs 1: when, and how much. */
static mr_status
put_frames(glb *w, size_t targets, size_t *input, size_t *output)
{
	const double low = 0, high = mr_as_float((double)targets / FRAMES_A_SECOND);
	size_t frames = targets + 1, view = 0;
	char *to = NULL;

	MR_TRY(new_view(w, 4 * frames, 0, &view, &to));
	for (size_t i = 0; i < frames; i++)
		to = mr_store_float(to, (float)((double)i / FRAMES_A_SECOND));
	*input = new_accessor(w, view, MR_GLTF_FLOAT, frames, "SCALAR");
	set_bounds(w, *input, &low, &high, 1);
	MR_TRY(new_view(w, 4 * frames * targets, 0, &view, &to));
	for (size_t i = 0; i < frames; i++)
		for (size_t k = 0; k < targets; k++)
			to = mr_store_float(to, i == k + 1 ? 1 : 0);
	*output = new_accessor(w, view, MR_GLTF_FLOAT, frames * targets, "SCALAR");
	return MR_OK;
}

static mr_status
animate(glb *w, size_t node, size_t targets)
{
	json_t *sampler, *channel, *target;
	size_t input = 0, output = 0;

	MR_TRY(put_frames(w, targets, &input, &output));
	sampler = json_object();
	set(w, sampler, "input", number(input));
	set(w, sampler, "output", number(output));
	target = json_object();
	set(w, target, "node", number(node));
	set(w, target, "path", json_string("weights"));
	channel = json_object();
	set(w, channel, "sampler", number(push(w, w->samplers, sampler)));
	set(w, channel, "target", target);
	push(w, w->channels, channel);
	return MR_OK;
}

/* A node and its mesh. */
static mr_status
put_node(glb *w, const mr_scene_node *from, const char *name, json_t *primitives)
{
	json_t *node = json_object(), *mesh = json_object();
	size_t at;

	set(w, mesh, "primitives", json_incref(primitives));
	if (*name) {
		set(w, mesh, "name", text_of(w, name, strlen(name)));
		set(w, node, "name", text_of(w, name, strlen(name)));
	}
	set(w, node, "mesh", number(push(w, w->meshes, mesh)));
	at = push(w, w->nodes, node);
	return from->targets ? animate(w, at, from->targets) : MR_OK;
}

/* The layer's name, and behind it the object's. */
static char *
object_name(glb *w, const layer *l, uint32_t object)
{
	const char **name = l->sets.object_name;

	if (object >= l->sets.objects)
		return mr_format(w->ctx, "%s", l->name);
	return mr_format(w->ctx, "%s%s%.*s", l->name, *l->name ? ": " : "",
	    (int)(name[object + 1] - name[object]) - 1, name[object]);
}

/* The sets of one object, from face *at in the order on, which goes behind them. */
static mr_status
put_object(glb *w, layer *l, size_t *at)
{
	const mr_sets *s = &l->sets;
	uint32_t object = s->object[s->face[*at]];
	char *name = object_name(w, l, object);
	json_t *primitives = json_array();
	mr_status status = name ? MR_OK : MR_EMEM;

	while (*at < s->m->nf && s->object[s->face[*at]] == object && status == MR_OK) {
		size_t end = mr_set_end(s, *at);
		status = put_set(w, l, *at, end, primitives);
		*at = end;
	}
	if (status == MR_OK)
		status = put_node(w, l->node, name, primitives);
	json_decref(primitives);
	return status;
}

static mr_status
put_surface(glb *w, layer *l)
{
	size_t at = 0;

	MR_TRY(mr_sets_begin(w->ctx, &l->node->model, &l->sets));
	mr_lost(w->ctx, NULL, l->sets.partial_normals, "normals of triangles that lack others");
	mr_lost(w->ctx, NULL, l->sets.partial_texcoords, "texture coordinates of triangles that lack others");
	MR_TRY(put_materials(w, l));
	MR_TRY(mr_sets_ambiguous(w->ctx, &l->sets, &w->numbered));
	while (at < l->node->model.nf)
		MR_TRY(put_object(w, l, &at));
	return MR_OK;
}

static mr_status
put_cloud(glb *w, const layer *l)
{
	json_t *primitives = json_array(), *attributes = json_object(), *targets = json_array();
	mr_vertex_set v;
	mr_status status = mr_set_cloud(w->s, &l->node->model, &v);

	if (status == MR_OK)
		status = put_attributes(w, &l->node->model, &v, false, attributes);
	if (status == MR_OK)
		status = put_targets(w, l->node, &v, targets);
	set(w, new_primitive(w, primitives, attributes, targets), "mode", number(POINTS));
	if (status == MR_OK)
		status = put_node(w, l->node, l->name, primitives);
	json_decref(primitives);
	json_decref(attributes);
	json_decref(targets);
	return status;
}

/* ---- the file ---- */

/* The name of a node where there are several to be told apart: of the frame, of the layer, or of both. */
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

static mr_status
put_scene(glb *w)
{
	for (size_t i = 0; i < w->scene->nodes; i++) {
		const mr_scene_node *n = &w->scene->node[i];
		layer l = { .node = n, .name = node_name(w->ctx, w->scene, n) };
		if (!l.name)
			return MR_EMEM;
		if (n->model.nv == 0)
			return mr_fail(w->ctx, MR_EMESH, "a layer without a vertex cannot be written as glb");
		w->numbered = false;
		MR_TRY(n->model.nf ? put_surface(w, &l) : put_cloud(w, &l));
		w->numbers += n->model.nv;
	}
	return MR_OK;
}

/* All nodes stand beside each other in one scene. */
static void
put_root(glb *w)
{
	json_t *asset = json_object(), *scene = json_object(), *scenes = json_array(), *list = json_array(),
	       *buffer = json_object(), *buffers = json_array(), *animation = json_object(),
	       *animations = json_array();

	set(w, asset, "version", json_string("2.0"));
	set(w, asset, "generator", json_string("mr " MR_VERSION));
	set(w, w->root, "asset", asset);
	for (size_t i = 0; i < json_array_size(w->nodes); i++)
		push(w, list, number(i));
	set(w, scene, "nodes", list);
	push(w, scenes, scene);
	set(w, w->root, "scene", number(0));
	set(w, w->root, "scenes", scenes);
	set(w, buffer, "byteLength", number(w->bytes));
	push(w, buffers, buffer);
	set(w, w->root, "buffers", buffers);
	set_array(w, animation, "samplers", w->samplers);
	set_array(w, animation, "channels", w->channels);
	push(w, animations, animation);
	if (json_array_size(w->channels))
		set(w, w->root, "animations", json_incref(animations));
	json_decref(animations);
}

static void
put_lists(glb *w)
{
	set_array(w, w->root, "nodes", w->nodes);
	set_array(w, w->root, "meshes", w->meshes);
	set_array(w, w->root, "materials", w->materials);
	set_array(w, w->root, "textures", w->textures);
	set_array(w, w->root, "images", w->images);
	set_array(w, w->root, "accessors", w->accessors);
	set_array(w, w->root, "bufferViews", w->views);
}

static void
put_word(mr_sink *s, size_t n)
{
	mr_sink_fill(s, mr_store32(mr_sink_room(s), (uint32_t)n));
}

/* Header, JSON filled up with blanks, bytes. */
static mr_status
put_chunks(glb *w, const char *json)
{
	size_t text = strlen(json), padded = (text + 3) / 4 * 4, all = 12 + 8 + padded + 8 + w->bytes;

	if (all > UINT32_MAX)
		return mr_fail(w->ctx, MR_ERANGE, "%zu bytes are more than a glb can have", all);
	put_word(w->s, MR_GLTF_MAGIC);
	put_word(w->s, 2);
	put_word(w->s, all);
	put_word(w->s, padded);
	put_word(w->s, MR_GLTF_JSON);
	mr_put(w->s, json, text);
	mr_put(w->s, "   ", padded - text);
	put_word(w->s, w->bytes);
	put_word(w->s, MR_GLTF_BIN);
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
put_document(glb *w)
{
	mr_text json = { .ctx = w->ctx };

	MR_TRY(put_scene(w));
	mr_materials_lost(w->ctx, w->lost);
	put_root(w);
	put_lists(w);
	if (w->failed || json_dump_callback(w->root, add_text, &json, JSON_COMPACT))
		return mr_fail(w->ctx, MR_EMEM, "no memory for the JSON of a glb");
	MR_TRY(mr_text_done(&json));
	return put_chunks(w, json.s);
}

mr_status
mr_glb_write_scene(mr_sink *s, const mr_scene *scene)
{
	glb w = { .s = s, .ctx = s->ctx, .scene = scene, .root = json_object(), .unnamed = MR_UNKNOWN };
	json_t **const lists[] = { &w.nodes, &w.meshes, &w.views, &w.accessors, &w.materials, &w.images,
		&w.textures, &w.samplers, &w.channels };
	mr_status status;

	for (size_t i = 0; i < sizeof lists / sizeof *lists; i++)
		*lists[i] = json_array();
	status = put_document(&w);
	for (size_t i = 0; i < sizeof lists / sizeof *lists; i++)
		json_decref(*lists[i]);
	json_decref(w.root);
	return status;
}

mr_status
mr_glb_note_lost(mr_sink *s, const mr_model *m)
{
	mr_note_lost(s, m,
	    MR_KEEPS_NORMAL | MR_KEEPS_COLOR | MR_KEEPS_ALPHA | MR_KEEPS_TEXCOORD | MR_KEEPS_FACES |
		MR_KEEPS_CORNERS | MR_KEEPS_OBJECT | MR_KEEPS_MATERIAL);
	MR_TRY(mr_check_floats(s, m));
	return mr_note_rounded(s, m);
}

mr_status
mr_glb_write(mr_sink *s, const mr_model *m)
{
	mr_scene_node node = { .frame = "", .layer = "", .model = *m };

	MR_TRY(mr_glb_note_lost(s, m));
	return mr_glb_write_scene(s, &(mr_scene){ .node = &node, .nodes = 1, .folder = "." });
}
