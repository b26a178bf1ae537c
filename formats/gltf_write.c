/* GLB, written: a node with a mesh for each object of each layer, a primitive for each of its materials, and
 * poses as morph targets that an animation shows one after the other.  All of a layer share its vertices. */
#include "base/text.h"
#include "formats/filename.h"
#include "formats/gltf.h"
#include "formats/image.h"
#include "formats/materials.h"
#include "formats/model.h"
#include "mesh/name_lists.h"

enum { POINTS = 0, FRAMES_A_SECOND = 24 };

/* The document on its way.  What jansson has no memory for is noted, and told of in the end. */
typedef struct glb {
	mr_sink *s;
	mr_ctx *ctx;
	const mr_scene *scene;
	json_t *root, *samplers, *channels; /* of the animation */
	bool failed, large;                 /* large: texture coordinates are, for floats */
	unsigned char *bin;                 /* the second chunk */
	size_t bytes, room;
	const char **image; /* files of the images so far */
	size_t image_room;
	size_t unnamed; /* the material of faces without one; MR_UNKNOWN: not there yet */
} glb;

/* The vertices of a model in their order, behind them those that a seam of corners repeats. */
typedef struct vertices {
	size_t count;
	uint32_t *vertex,
	    *corner;     /* of each, the model's, and a corner that it stands for; MR_NONE: of no face */
	uint32_t *index; /* 3 nf: the vertex of each corner */
} vertices;

/* Names of objects or materials, and which each face has: `count` for one without. */
typedef struct face_names {
	const char **start; /* count + 1 */
	size_t count;
	uint32_t *of; /* nf */
} face_names;

/* A layer on its way: accessors of its vertices, MR_UNKNOWN of what they have not. */
typedef struct layer {
	const mr_scene_node *node;
	const char *name; /* of its nodes, before that of an object */
	vertices v;
	face_names object, material;
	uint32_t *face;    /* nf, by object and material */
	size_t *materials; /* of each of its names, the material of the document */
	size_t position, normal, texcoord, color;
	json_t *targets; /* poses */
	size_t sampler;  /* of the poses' weights */
} layer;

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

/* Numbers the corners by vertex, texture coordinates and normal: `key` of each three numbers. */
static void
make_keys(mr_ctx *ctx, const mr_model *m, double **key)
{
	size_t corners = 3 * m->nf, count;
	uint32_t *uv = MR_NEW_ZERO(ctx, corners, uint32_t), *vn = MR_NEW_ZERO(ctx, corners, uint32_t),
		 *first = MR_NEW(ctx, corners, uint32_t);

	*key = MR_NEW(ctx, 3 * corners, double);
	if (m->corner_texcoord)
		mr_number_rows(ctx, m->corner_texcoord, 2, corners, uv, first, &count);
	if (m->corner_normal)
		mr_number_rows(ctx, &m->corner_normal->x, 3, corners, vn, first, &count);
	for (size_t c = 0; c < corners; c++) {
		(*key)[3 * c] = m->t[c / 3].v[c % 3];
		(*key)[3 * c + 1] = uv[c];
		(*key)[3 * c + 2] = vn[c] + 1.0; /* never all zero, which is none */
	}
}

/* The first distinct corner of a vertex is that vertex, the others come behind all. */
static void
number_vertices(const mr_model *m, const uint32_t *first, size_t distinct, uint32_t *place, vertices *v)
{
	for (size_t i = 0; i < m->nv; i++) {
		v->vertex[i] = (uint32_t)i;
		v->corner[i] = MR_NONE;
	}
	v->count = m->nv;
	for (size_t k = 0; k < distinct; k++) {
		uint32_t vertex = m->t[first[k] / 3].v[first[k] % 3];
		size_t at = v->corner[vertex] == MR_NONE ? vertex : v->count++;
		v->vertex[at] = vertex;
		v->corner[at] = first[k];
		place[k] = (uint32_t)at;
	}
}

static void
vertices_find(mr_ctx *ctx, const mr_model *m, vertices *v)
{
	size_t corners = 3 * m->nf, distinct = 0;
	uint32_t *number = MR_NEW(ctx, corners, uint32_t), *first = MR_NEW(ctx, corners, uint32_t), *place;
	double *key;

	make_keys(ctx, m, &key);
	mr_number_rows(ctx, key, 3, corners, number, first, &distinct);
	*v = (vertices){ .vertex = MR_NEW(ctx, m->nv + distinct, uint32_t),
		.corner = MR_NEW(ctx, m->nv + distinct, uint32_t),
		.index = number };
	place = MR_NEW(ctx, distinct, uint32_t);
	number_vertices(m, first, distinct, place, v);
	for (size_t c = 0; c < corners; c++)
		v->index[c] = place[number[c]];
}

/* ---- pieces of JSON and bytes ---- */

static json_t *
owned(glb *w, json_t *json)
{
	mr_gltf_own(w->ctx, json);
	return json;
}

/* Appends to an array; its number there. */
static size_t
append(glb *w, json_t *array, json_t *thing)
{
	size_t n = json_array_size(array);

	w->failed |= json_array_append_new(array, thing) != 0;
	return n;
}

/* Appends to an array of the root, which comes with its first thing: the format forbids empty ones. */
static size_t
push(glb *w, const char *array, json_t *thing)
{
	json_t *list = json_object_get(w->root, array);

	if (!list) {
		list = json_array();
		w->failed |= json_object_set_new(w->root, array, list) != 0;
	}
	return append(w, list, thing);
}

static json_int_t
number(size_t n)
{
	return (json_int_t)n;
}

/* An array where it is not empty, which the format forbids, for "o*". */
static json_t *
filled(json_t *array)
{
	return json_array_size(array) ? json_incref(array) : NULL;
}

/* An index for "o*": NULL where there is none. */
static json_t *
index_of(size_t n)
{
	return n != MR_UNKNOWN ? json_integer(number(n)) : NULL;
}

/* Room for bytes of the second chunk, up to a multiple of four, and a view of it. */
static void
new_view(glb *w, size_t bytes, size_t target, size_t *view, char **to)
{
	size_t padded = (bytes + 3) / 4 * 4;

	*view = push(w, "bufferViews",
	    json_pack("{s:i, s:I, s:I, s:o*}", "buffer", 0, "byteOffset", number(w->bytes), "byteLength",
		number(bytes), "target", index_of(target)));
	MR_RESERVE(w->ctx, w->bin, w->bytes, padded, &w->room);
	*to = (char *)w->bin + w->bytes;
	memset(*to + bytes, 0, padded - bytes);
	w->bytes += padded;
}

/* A view of `count` values, `size` bytes each, to be filled from `to` on, and the accessor over it. */
static void
new_values(glb *w, size_t count, size_t size, size_t target, size_t kind, const char *type, char **to,
    size_t *accessor)
{
	size_t view = 0;

	new_view(w, size * count, target, &view, to);
	*accessor = push(w, "accessors",
	    json_pack("{s:I, s:I, s:I, s:s}", "bufferView", number(view), "componentType", number(kind),
		"count", number(count), "type", type));
}

/* The least and the greatest of its values. */
static void
set_bounds(glb *w, size_t accessor, json_t *min, json_t *max)
{
	json_t *json = json_array_get(json_object_get(w->root, "accessors"), accessor);

	w->failed |= json_object_set_new(json, "min", min) || json_object_set_new(json, "max", max);
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
	size_t view = 0, image;
	char *to = NULL;

	MR_ENTER(w->ctx);
	new_view(w, b->size, MR_UNKNOWN, &view, &to);
	memcpy(to, b->data, b->size);
	image = push(w, "images",
	    json_pack("{s:I, s:s, s:s}", "bufferView", number(view), "mimeType", image_type(b), "name",
		mr_file_name(file)));
	*texture = push(w, "textures", json_pack("{s:I}", "source", number(image)));
	return MR_OK;
}

/* The texture of a picture; MR_UNKNOWN where there is none, or of a kind that glTF does not have. */
static mr_status
embed(glb *w, const char *file, size_t *texture)
{
	size_t known = json_array_size(json_object_get(w->root, "textures"));
	mr_file_bytes b = { 0 };
	mr_status status = MR_OK;

	*texture = MR_UNKNOWN;
	for (size_t i = 0; file && i < known; i++)
		if (!strcmp(w->image[i], file))
			*texture = i;
	if (!file || *texture != MR_UNKNOWN)
		return MR_OK;
	MR_RESERVE(w->ctx, w->image, known, 1, &w->image_room);
	w->image[known] = file;
	MR_TRY(mr_file_bytes_read(w->ctx, file, &b));
	if (image_type(&b))
		status = put_image(w, file, &b, texture);
	else
		mr_tell(w->ctx, MR_LOST, 1, "picture %s, which is neither PNG nor JPEG", file);
	return mr_prefix(w->ctx, mr_file_bytes_end(&b, status), "%s", file);
}

/* A reference to a texture, for "o*". */
static json_t *
shows(size_t texture)
{
	return texture != MR_UNKNOWN ? json_pack("{s:I}", "index", number(texture)) : NULL;
}

/* What says nothing else is of metal to the format, and seen from one side. */
static json_t *
new_material(const mr_material *look, const char *name, size_t bytes, size_t texture, size_t normals)
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
	    look->metal, "roughnessFactor", look->roughness, "baseColorTexture", shows(texture),
	    "doubleSided", 1, "alphaMode", look->opacity < 1 ? "BLEND" : NULL, "emissiveFactor",
	    shines ? json_pack("[f, f, f]", e[0], e[1], e[2]) : NULL, "normalTexture", shows(normals), "name",
	    bytes ? json_stringn(name, bytes) : NULL);
}

static mr_status
put_materials(glb *w, layer *l)
{
	const char **name = l->material.start;
	mr_material *look = NULL;
	size_t count = 0;

	l->materials = MR_NEW(w->ctx, l->material.count, size_t);
	MR_TRY(mr_materials_find(w->ctx, &l->node->model, w->scene->folder, &look, &count));
	for (size_t i = 0; i < l->material.count; i++) {
		size_t bytes = (size_t)(name[i + 1] - name[i]) - 1, texture, normals;
		if (bytes == 0) /* no face has it */
			continue;
		MR_TRY(embed(w, look[i].file, &texture));
		MR_TRY(embed(w, look[i].normals, &normals));
		l->materials[i] = push(
		    w, "materials", new_material(&look[i], name[i], bytes, texture, normals));
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
		w->unnamed = push(
		    w, "materials", new_material(&mr_material_plain, NULL, 0, MR_UNKNOWN, MR_UNKNOWN));
	return w->unnamed;
}

/* ---- vertices ---- */

/* Positions, or how far a pose moves them: the difference of floats, so that nothing is rounded twice. */
static void
put_positions(glb *w, const mr_v3 *p, const mr_v3 *from, const vertices *v, size_t *accessor)
{
	mr_box box = mr_box_empty();
	char *to = NULL;

	new_values(w, v->count, 12, MR_GLTF_ARRAY, MR_GLTF_FLOAT, "VEC3", &to, accessor);
	for (size_t i = 0; i < v->count; i++) {
		mr_v3 x = as_floats(p[v->vertex[i]]);
		if (from)
			x = as_floats(mr_sub(x, as_floats(from[v->vertex[i]])));
		to = mr_store_floats(to, x);
		mr_box_add(&box, x);
	}
	set_bounds(w, *accessor, json_pack("[f, f, f]", box.min.x, box.min.y, box.min.z),
	    json_pack("[f, f, f]", box.max.x, box.max.y, box.max.z));
}

/* Whether it can be made unit. */
static bool
is_direction(mr_v3 n)
{
	return isfinite(mr_norm2(n)) && mr_norm2(n) > 0;
}

/* A normal that is a unit vector to the four digits of most files stays as it is; the format asks for three.
 */
static mr_v3
as_unit(mr_v3 n)
{
	mr_v3 f = as_floats(n);

	return fabs(mr_norm2(f) - 1) < 5e-4 ? f : as_floats(mr_unit(n));
}

/* The normal of a vertex.  Without one it takes its triangle's; without a triangle, the z axis. */
static mr_v3
normal_of(const mr_model *m, const mr_target *pose, const vertices *v, size_t i)
{
	uint32_t c = v->corner[i];
	mr_v3 n = mr_vec(0, 0, 0);

	if (pose->corner_normal && c != MR_NONE)
		n = pose->corner_normal[c];
	else if (pose->normal)
		n = pose->normal[v->vertex[i]];
	if (!is_direction(n) && c != MR_NONE) {
		const uint32_t *t = m->t[c / 3].v;
		n = mr_cross(mr_sub(pose->p[t[1]], pose->p[t[0]]), mr_sub(pose->p[t[2]], pose->p[t[0]]));
	}
	return is_direction(n) ? as_unit(n) : mr_vec(0, 0, 1);
}

/* pose: NULL, or the one that turns them. */
static void
put_normals(glb *w, const mr_model *m, const mr_target *pose, const vertices *v, size_t *accessor)
{
	const mr_target rest = { m->p, m->normal, m->corner_normal };
	char *to = NULL;

	new_values(w, v->count, 12, MR_GLTF_ARRAY, MR_GLTF_FLOAT, "VEC3", &to, accessor);
	for (size_t i = 0; i < v->count; i++) {
		mr_v3 n = normal_of(m, &rest, v, i);
		if (pose)
			n = mr_sub(normal_of(m, pose, v, i), n);
		to = mr_store_floats(to, n);
	}
}

static bool
has_texcoord(const double *uv)
{
	return uv && isfinite(mr_as_float(uv[0]) + mr_as_float(uv[1]));
}

/* v runs down the picture in glTF. */
static void
put_texcoords(glb *w, const mr_model *m, const vertices *v, size_t *accessor)
{
	static const double none[2] = { 0, 1 };
	char *to = NULL;

	new_values(w, v->count, 8, MR_GLTF_ARRAY, MR_GLTF_FLOAT, "VEC2", &to, accessor);
	for (size_t i = 0; i < v->count; i++) {
		const double *uv = m->texcoord ? m->texcoord + 2 * (size_t)v->vertex[i] : none;
		if (m->corner_texcoord && v->corner[i] != MR_NONE)
			uv = m->corner_texcoord + 2 * (size_t)v->corner[i];
		w->large |= isfinite(uv[0] + uv[1]) && !has_texcoord(uv);
		uv = has_texcoord(uv) ? uv : none;
		to = mr_store_float(to, (float)uv[0]);
		to = mr_store_float(to, (float)(1 - uv[1]));
	}
}

/* Linear there, where sixteen bits give every byte back. */
static void
put_colors(glb *w, const mr_model *m, const vertices *v, size_t *accessor)
{
	char *to = NULL;

	new_values(w, v->count, 8, MR_GLTF_ARRAY, MR_GLTF_UNSIGNED_SHORT, "VEC4", &to, accessor);
	for (size_t i = 0; i < 4 * v->count; i++) {
		double c = m->color[4 * (size_t)v->vertex[i / 4] + i % 4] / 255.0;
		unsigned x = (unsigned)(65535 * (i % 4 == 3 ? c : mr_srgb_to_linear(c)) + 0.5);
		*to++ = (char)(x & 255);
		*to++ = (char)(x >> 8);
	}
	w->failed |= json_object_set_new(json_array_get(json_object_get(w->root, "accessors"), *accessor),
			 "normalized", json_true()) != 0;
}

/* Points have normals where all of them have some. */
static bool
has_normals(glb *w, const mr_model *m)
{
	size_t normals = 0;

	if (m->nf)
		return m->normal || m->corner_normal;
	for (size_t i = 0; m->normal && i < m->nv; i++)
		normals += is_direction(m->normal[i]);
	mr_lost(w->ctx, NULL, normals < m->nv ? normals : 0, "normals beside points without");
	return normals == m->nv;
}

static void
put_vertices(glb *w, layer *l)
{
	const mr_model *m = &l->node->model;

	l->normal = l->texcoord = l->color = MR_UNKNOWN;
	put_positions(w, m->p, NULL, &l->v, &l->position);
	if (has_normals(w, m))
		put_normals(w, m, NULL, &l->v, &l->normal);
	if (m->texcoord || m->corner_texcoord)
		put_texcoords(w, m, &l->v, &l->texcoord);
	if (m->color)
		put_colors(w, m, &l->v, &l->color);
}

/* ---- poses ---- */

/* Frame 0 is the key, at frame i target i - 1 alone weighs 1: when, and how much. */
static void
put_weights(glb *w, size_t targets, size_t *sampler)
{
	size_t frames = targets + 1, input = 0, output = 0;
	char *to = NULL;

	new_values(w, frames, 4, MR_UNKNOWN, MR_GLTF_FLOAT, "SCALAR", &to, &input);
	for (size_t i = 0; i < frames; i++)
		to = mr_store_float(to, (float)((double)i / FRAMES_A_SECOND));
	set_bounds(
	    w, input, json_pack("[f]", 0.), json_pack("[f]", mr_as_float((double)targets / FRAMES_A_SECOND)));
	new_values(w, frames * targets, 4, MR_UNKNOWN, MR_GLTF_FLOAT, "SCALAR", &to, &output);
	for (size_t i = 0; i < frames; i++)
		for (size_t k = 0; k < targets; k++)
			to = mr_store_float(to, i == k + 1 ? 1 : 0);
	*sampler = append(
	    w, w->samplers, json_pack("{s:I, s:I}", "input", number(input), "output", number(output)));
}

/* What the poses do to the vertices; to normals only where every pose has some. */
static void
put_poses(glb *w, layer *l)
{
	const mr_scene_node *node = l->node;
	bool turned = l->normal != MR_UNKNOWN;
	size_t position = 0, normal = MR_UNKNOWN;

	for (size_t i = 0; i < node->targets; i++)
		turned = turned && (node->target[i].normal || node->target[i].corner_normal);
	for (size_t i = 0; i < node->targets; i++) {
		put_positions(w, node->target[i].p, node->model.p, &l->v, &position);
		if (turned)
			put_normals(w, &node->model, &node->target[i], &l->v, &normal);
		append(w, l->targets,
		    json_pack("{s:I, s:o*}", "POSITION", number(position), "NORMAL", index_of(normal)));
	}
	if (node->targets)
		put_weights(w, node->targets, &l->sampler);
}

/* ---- primitives, meshes, nodes ---- */

/* A primitive of the layer's vertices. */
static json_t *
new_primitive(const layer *l, bool texcoords, size_t indices, size_t material, size_t mode)
{
	return json_pack("{s:{s:I, s:o*, s:o*, s:o*}, s:o*, s:o*, s:o*, s:o*}", "attributes", "POSITION",
	    number(l->position), "NORMAL", index_of(l->normal), "TEXCOORD_0",
	    index_of(texcoords ? l->texcoord : MR_UNKNOWN), "COLOR_0", index_of(l->color), "targets",
	    filled(l->targets), "indices", index_of(indices), "material", index_of(material), "mode",
	    index_of(mode));
}

/* The primitive of faces `first` to `last` in the order; it has texture coordinates where a corner has some.
 */
static void
put_primitive(glb *w, const layer *l, size_t first, size_t last, json_t *primitives)
{
	size_t accessor = 0;
	bool texcoords = false;
	char *to = NULL;

	new_values(
	    w, 3 * (last - first), 4, MR_GLTF_ELEMENTS, MR_GLTF_UNSIGNED_INT, "SCALAR", &to, &accessor);
	for (size_t i = first; i < last; i++)
		for (size_t c = 3 * (size_t)l->face[i]; c < 3 * (size_t)l->face[i] + 3; c++) {
			to = mr_store32(to, l->v.index[c]);
			texcoords |= has_texcoord(mr_corner_texcoord(&l->node->model, c));
		}
	append(w, primitives,
	    new_primitive(l, texcoords, accessor, material_of(w, l, l->face[first]), MR_UNKNOWN));
}

/* A node and its mesh; takes the primitives. */
static void
put_node(glb *w, const layer *l, const char *name, json_t *primitives)
{
	const char *own = *name ? name : NULL;
	size_t mesh = push(w, "meshes", json_pack("{s:o, s:s*}", "primitives", primitives, "name", own));
	size_t node = push(w, "nodes", json_pack("{s:I, s:s*}", "mesh", number(mesh), "name", own));

	if (l->node->targets)
		append(w, w->channels,
		    json_pack("{s:I, s:{s:I, s:s}}", "sampler", number(l->sampler), "target", "node",
			number(node), "path", "weights"));
}

/* The layer's name, and behind it the object's. */
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

/* The primitives of one object, from face *at in the order on, which goes behind them. */
static void
put_object(glb *w, const layer *l, size_t *at)
{
	uint32_t object = l->object.of[l->face[*at]];
	json_t *primitives = json_array();

	while (*at < l->node->model.nf && l->object.of[l->face[*at]] == object) {
		size_t end = *at + 1;
		while (end < l->node->model.nf && is_alike(l, l->face[*at], l->face[end]))
			end++;
		put_primitive(w, l, *at, end, primitives);
		*at = end;
	}
	put_node(w, l, object_name(w, l, object), primitives);
}

/* Faces by object and material. */
static void
order_faces(glb *w, layer *l)
{
	const mr_model *m = &l->node->model;

	face_names_find(w->ctx, m->object, m->objects, m->nf, &l->object);
	face_names_find(w->ctx, m->material, m->materials, m->nf, &l->material);
	l->face = MR_NEW(w->ctx, m->nf, uint32_t);
	for (size_t f = 0; f < m->nf; f++)
		l->face[f] = (uint32_t)f;
	sort_by(w->ctx, l->material.of, l->material.count, l->face, m->nf);
	sort_by(w->ctx, l->object.of, l->object.count, l->face, m->nf);
}

static mr_status
put_layer(glb *w, layer *l)
{
	const mr_model *m = &l->node->model;
	size_t at = 0;

	if (m->nv == 0)
		return mr_fail(w->ctx, MR_EMESH, "a layer without a vertex cannot be written as glb");
	vertices_find(w->ctx, m, &l->v);
	put_vertices(w, l);
	put_poses(w, l);
	if (m->nf == 0) {
		put_node(
		    w, l, l->name, json_pack("[o]", new_primitive(l, true, MR_UNKNOWN, MR_UNKNOWN, POINTS)));
		return MR_OK;
	}
	order_faces(w, l);
	MR_TRY(put_materials(w, l));
	while (at < m->nf)
		put_object(w, l, &at);
	return MR_OK;
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

/* All nodes stand beside each other in one scene. */
static void
end_root(glb *w)
{
	size_t nodes = json_array_size(json_object_get(w->root, "nodes"));
	json_t *list = json_array();

	for (size_t i = 0; i < nodes; i++)
		append(w, list, json_integer(number(i)));
	push(w, "scenes", json_pack("{s:o}", "nodes", list));
	push(w, "buffers", json_pack("{s:I}", "byteLength", number(w->bytes)));
	if (json_array_size(w->channels))
		push(w, "animations",
		    json_pack("{s:O, s:O}", "samplers", w->samplers, "channels", w->channels));
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
mr_status
mr_glb_write_scene(mr_sink *s, const mr_scene *scene)
{
	glb w = { .s = s, .ctx = s->ctx, .scene = scene, .unnamed = MR_UNKNOWN };
	mr_text json = { .ctx = w.ctx };

	w.root = owned(&w, json_pack("{s:{s:s, s:s}, s:i}", "asset", "version", "2.0", "generator",
			       "mr " MR_VERSION, "scene", 0));
	w.samplers = owned(&w, json_array());
	w.channels = owned(&w, json_array());
	for (size_t i = 0; i < scene->nodes; i++) {
		layer l = { .node = &scene->node[i],
			.name = node_name(w.ctx, scene, &scene->node[i]),
			.targets = owned(&w, json_array()) };
		MR_TRY(put_layer(&w, &l));
	}
	end_root(&w);
	w.failed |= json_dump_callback(w.root, add_text, &json, JSON_COMPACT) != 0;
	if (w.large)
		return mr_fail(w.ctx, MR_ERANGE, "texture coordinates are too large for float32");
	if (w.failed)
		return mr_fail(w.ctx, MR_EMEM, "no memory for the JSON of a glb");
	return put_chunks(&w, json.s);
}

mr_status
mr_glb_note_lost(mr_sink *s, const mr_model *m)
{
	mr_note_lost(s, m, "normal corner_normal color alpha texcoord corner_texcoord object material faces");
	return mr_note_rounded(s, m);
}

mr_status
mr_glb_write(mr_sink *s, const mr_model *m)
{
	mr_scene_node node = { .frame = "", .layer = "", .model = *m };

	MR_TRY(mr_glb_note_lost(s, m));
	return mr_glb_write_scene(s, &(mr_scene){ .node = &node, .nodes = 1, .folder = "." });
}
