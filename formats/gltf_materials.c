/* glTF's materials, read: a file of materials that says the same, and their pictures as they are. */
#include "formats/gltf.h"
#include "formats/image.h"
#include "formats/materials.h"

/* ---- pictures ---- */

static mr_status
open_image(mr_gltf *g, size_t number, mr_gltf_buffer *b)
{
	const json_t *image = mr_gltf_at(g, "images", number);
	const char *uri = json_string_value(json_object_get(image, "uri"));

	return mr_prefix(
	    g->ctx, uri ? mr_gltf_uri(g, uri, b) : mr_gltf_view_of(g, image, b), "image %zu", number);
}

/* Pictures of other kinds are left out. */
static mr_status
read_image(mr_gltf *g, mr_gltf_looks *l, size_t number)
{
	mr_gltf_buffer b = { 0 };
	const char *suffix;

	if (l->seen[number])
		return MR_OK;
	l->seen[number] = true;
	l->left--;
	MR_TRY(open_image(g, number, &b));
	suffix = mr_is_png(b.data, b.bytes) ? ".png" : mr_is_jpeg(b.data, b.bytes) ? ".jpg" : NULL;
	if (suffix)
		l->file[number] = mr_file_copy(g->ctx, b.data, b.bytes, suffix);
	else
		l->left++;
	return MR_OK;
}

static mr_status
find_picture(mr_gltf *g, mr_gltf_looks *l, const json_t *info, mr_file *file)
{
	size_t texture, image;

	MR_TRY(mr_gltf_index(g, info, "index", "textures", &texture));
	MR_TRY(mr_gltf_index(g, mr_gltf_at(g, "textures", texture), "source", "images", &image));
	if (image == MR_UNKNOWN)
		return MR_OK;
	MR_TRY(read_image(g, l, image));
	*file = l->file[image];
	return MR_OK;
}

/* The picture that a material names; one that cannot be had is reported. */
static mr_status
read_picture(mr_gltf *g, mr_gltf_looks *l, const json_t *info, mr_file *file)
{
	mr_status status = info ? find_picture(g, l, info, file) : MR_OK;

	if (status == MR_EMEM)
		return status;
	mr_tell(g->ctx, MR_MISSING, status < 0, "%s, a picture", g->ctx->error);
	return MR_OK;
}

/* ---- looks ---- */

static double
share(const json_t *x, double absent)
{
	return fmin(fmax(json_is_number(x) ? json_number_value(x) : absent, 0), 1);
}

/* Reads up to n numbers of the list; x keeps its values for missing ones. */
static void
numbers(const json_t *list, size_t n, double *x)
{
	for (size_t i = 0; i < n; i++)
		if (json_is_number(json_array_get(list, i)))
			x[i] = json_number_value(json_array_get(list, i));
}

static mr_gltf_placing
placing_of(const json_t *info)
{
	const json_t *change = json_object_get(json_object_get(info, "extensions"), "KHR_texture_transform");
	const json_t *other = json_object_get(change, "texCoord");
	mr_gltf_placing p = { .scale = { 1, 1 } };

	p.set = (size_t)json_integer_value(other ? other : json_object_get(info, "texCoord"));
	p.turn = json_number_value(json_object_get(change, "rotation"));
	numbers(json_object_get(change, "offset"), 2, p.offset);
	numbers(json_object_get(change, "scale"), 2, p.scale);
	return p;
}

static bool
is_white(const double c[3])
{
	return c[0] == 1 && c[1] == 1 && c[2] == 1;
}

/* The numbers of a material; of metal and roughness in a picture, which is left out, none is known. */
static void
read_numbers(const json_t *json, double color[4], mr_material *look)
{
	const json_t *surface = json_object_get(json, "pbrMetallicRoughness");
	const char *mode = json_string_value(json_object_get(json, "alphaMode"));
	bool rough = surface && !json_object_get(surface, "metallicRoughnessTexture");

	numbers(json_object_get(surface, "baseColorFactor"), 4, color);
	numbers(json_object_get(json, "emissiveFactor"), 3, look->emission);
	for (int k = 0; k < 3; k++) {
		look->color[k] = mr_linear_to_srgb(fmin(fmax(color[k], 0), 1));
		look->emission[k] = mr_linear_to_srgb(fmin(fmax(look->emission[k], 0), 1));
	}
	if (mode && !strcmp(mode, "BLEND"))
		look->opacity = fmin(fmax(color[3], 0), 1);
	if (rough) {
		look->metal = share(json_object_get(surface, "metallicFactor"), 1);
		look->roughness = share(json_object_get(surface, "roughnessFactor"), 1);
	}
}

/* A picture goes without a factor, opaque where the material is; of two pictures both lie alike. */
static mr_status
read_look(mr_gltf *g, mr_gltf_looks *l, size_t i)
{
	const json_t *json = mr_gltf_at(g, "materials", i), *normals = json_object_get(json, "normalTexture");
	const json_t *picture = json_object_get(
	    json_object_get(json, "pbrMetallicRoughness"), "baseColorTexture");
	const mr_gltf_placing own = placing_of(picture ? picture : normals), other = placing_of(normals);
	const char *mode = json_string_value(json_object_get(json, "alphaMode"));
	mr_material *look = &l->look[i];
	double color[4] = { 1, 1, 1, 1 };

	*look = mr_material_plain;
	l->placing[i] = own;
	read_numbers(json, color, look);
	MR_TRY(read_picture(g, l, picture, &look->file));
	if (!memcmp(&own, &other, sizeof own))
		MR_TRY(read_picture(g, l, normals, &look->normals));
	l->said |= look->file.name || look->normals.name || !is_white(color) || look->emission[0] > 0 ||
	           look->emission[1] > 0 || look->emission[2] > 0 || look->opacity < 1 || look->metal > 0 ||
	           look->roughness != mr_material_plain.roughness;
	l->plain += look->file.name &&
	            (!is_white(color) || (mode && strcmp(mode, "OPAQUE") && look->opacity == 1));
	return MR_OK;
}

mr_status
mr_gltf_looks_read(mr_gltf *g, mr_gltf_looks *l)
{
	size_t count = mr_gltf_size(g, "materials"), images = mr_gltf_size(g, "images");

	*l = (mr_gltf_looks){ .look = MR_NEW(g->ctx, count, mr_material),
		.placing = MR_NEW(g->ctx, count, mr_gltf_placing),
		.file = MR_NEW_ZERO(g->ctx, images + 1, mr_file),
		.seen = MR_NEW_ZERO(g->ctx, images, bool),
		.files = images,
		.left = images };
	for (size_t i = 0; i < count; i++)
		MR_TRY(read_look(g, l, i));
	return MR_OK;
}

void
mr_gltf_looks_put(mr_gltf_looks *l, const char *const *name, size_t count, mr_builder *b)
{
	mr_text text = { .ctx = b->ctx };
	size_t n = 0;

	for (size_t i = 0; i < count; i++) {
		l->look[i].colored = !l->look[i].file.name;
		mr_material_put(&text, name[i], &l->look[i]);
	}
	for (size_t i = 0; i < l->files; i++)
		if (l->file[i].name)
			l->file[n++] = l->file[i];
	l->file[n] = mr_file_copy(b->ctx, text.s, text.n, ".mtl");
	mr_build_library(b, l->file[n].name, strlen(l->file[n].name));
	b->m.file = l->file;
	b->m.files = n + 1;
}
