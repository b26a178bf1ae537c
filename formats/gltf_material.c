/* Materials of a glTF document: how their pictures lie on texture coordinates, and what a model does not
 * keep. */
#include "formats/gltf.h"
#include "formats/materials.h"

/* An extension of a thing; NULL where it has none of that name. */
static json_t *
extension(const json_t *thing, const char *name)
{
	return json_object_get(json_object_get(thing, "extensions"), name);
}

static json_t *
base_texture(const json_t *material)
{
	return json_object_get(json_object_get(material, "pbrMetallicRoughness"), "baseColorTexture");
}

/* uv' = T R S uv; a rotation goes from v to u, which is against the clock where v runs down. */
static mr_status
texture_map(const mr_gltf *g, const json_t *transform, double map[6])
{
	double offset[2] = { 0, 0 }, scale[2] = { 1, 1 }, s, c;
	const json_t *rotation = json_object_get(transform, "rotation");
	bool there;

	MR_TRY(mr_gltf_numbers(g, transform, "offset", 2, offset, &there));
	MR_TRY(mr_gltf_numbers(g, transform, "scale", 2, scale, &there));
	if (rotation && !json_is_number(rotation))
		return mr_fail(g->ctx, MR_EFORMAT, "rotation is no number");
	s = sin(json_number_value(rotation));
	c = cos(json_number_value(rotation));
	map[0] = c * scale[0], map[1] = s * scale[1], map[2] = offset[0];
	map[3] = -s * scale[0], map[4] = c * scale[1], map[5] = offset[1];
	return MR_OK;
}

mr_status
mr_gltf_texture_of(const mr_gltf *g, size_t material, mr_gltf_texture *t)
{
	const json_t *base = material == MR_UNKNOWN ? NULL
	                                            : base_texture(mr_gltf_at(g, "materials", material));
	const json_t *transform = extension(base, "KHR_texture_transform");
	mr_gltf_texture made = { .moves = transform != NULL };

	MR_TRY(mr_gltf_count(g, base, "texCoord", 0, MR_NONE, &made.set));
	MR_TRY(mr_gltf_count(g, transform, "texCoord", made.set, MR_NONE, &made.set));
	MR_TRY(mr_prefix(g->ctx, texture_map(g, transform, made.map), "material %zu", material));
	*t = made;
	return MR_OK;
}

/* Whether a list of factors has another one than `plain`. */
static bool
is_colored(const json_t *object, const char *key, double plain)
{
	const json_t *list = json_object_get(object, key);

	for (size_t i = 0; i < json_array_size(list); i++)
		if (json_number_value(json_array_get(list, i)) != plain)
			return true;
	return false;
}

/* Whether a factor is there, and another one than `plain`. */
static bool
is_other(const json_t *object, const char *key, double plain)
{
	const json_t *factor = json_object_get(object, key);

	return factor && json_number_value(factor) != plain;
}

/* Whether more than a colour says how the surface looks; pictures are told of elsewhere. */
static bool
has_surface(const json_t *material)
{
	const json_t *surface = json_object_get(material, "pbrMetallicRoughness");
	const char *alpha = json_string_value(json_object_get(material, "alphaMode"));

	return is_other(surface, "metallicFactor", mr_material_plain.metal) ||
	       is_other(surface, "roughnessFactor", mr_material_plain.roughness) ||
	       (alpha && strcmp(alpha, "OPAQUE")) ||
	       json_object_size(json_object_get(material, "extensions")) > 0;
}

/* Whether another picture of the material lies otherwise on its coordinates than that of the colour. */
static bool
lies_otherwise(const json_t *material)
{
	static const char *const names[] = { "normalTexture", "occlusionTexture", "emissiveTexture" };
	const json_t *transform = extension(base_texture(material), "KHR_texture_transform"),
		     *surface = json_object_get(material, "pbrMetallicRoughness"),
		     *texture = json_object_get(surface, "metallicRoughnessTexture");

	for (size_t i = 0;; i++) {
		const json_t *other = extension(texture, "KHR_texture_transform");
		if (texture && other != transform && !json_equal(other, transform))
			return true;
		if (i == sizeof names / sizeof *names)
			return false;
		texture = json_object_get(material, names[i]);
	}
}

mr_gltf_looks
mr_gltf_count_looks(const mr_gltf *g)
{
	mr_gltf_looks looks = { 0 };

	for (size_t i = 0; i < mr_gltf_size(g, "materials"); i++) {
		const json_t *material = mr_gltf_at(g, "materials", i);
		const json_t *gloss = extension(material, "KHR_materials_pbrSpecularGlossiness");
		looks.colors += is_colored(json_object_get(material, "pbrMetallicRoughness"),
				    "baseColorFactor", 1) ||
		                is_colored(material, "emissiveFactor", 0) ||
		                is_colored(gloss, "diffuseFactor", 1);
		looks.surfaces += has_surface(material);
		looks.transforms += lies_otherwise(material);
	}
	return looks;
}
