/* What a glTF document has and a model has not. */
#include "formats/gltf.h"
#include "formats/materials.h"

mr_status
mr_gltf_note_attributes(const mr_gltf *g, json_t *attributes, const char *texcoord, mr_gltf_left *left)
{
	const char *const read[] = { "POSITION", "NORMAL", texcoord, "COLOR_0", MR_GLTF_NUMBER }, *name;
	size_t count = sizeof read / sizeof *read, number;
	json_t *value;

	MR_TRY(mr_gltf_vertex_numbers(g, attributes, &number));
	count -= number == MR_UNKNOWN;
	json_object_foreach(attributes, name, value)
	{
		size_t i = 0;
		while (i < count && strcmp(name, read[i]))
			i++;
		left->attributes += i == count;
	}
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

/* Whether a material has more than a name and pictures. */
static bool
has_look(const json_t *material)
{
	const json_t *surface = json_object_get(material, "pbrMetallicRoughness");
	const char *alpha = json_string_value(json_object_get(material, "alphaMode"));

	return is_colored(surface, "baseColorFactor", 1) || is_colored(material, "emissiveFactor", 0) ||
	       is_other(surface, "metallicFactor", mr_material_plain.metal) ||
	       is_other(surface, "roughnessFactor", mr_material_plain.roughness) ||
	       (alpha && strcmp(alpha, "OPAQUE")) ||
	       json_object_size(json_object_get(material, "extensions")) > 0;
}

void
mr_gltf_say_left(const mr_gltf *g, const mr_gltf_left *left)
{
	static const char *const arrays[] = { "images", "skins", "animations", "cameras" };
	size_t looks = 0;

	for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++)
		mr_lost(g->ctx, NULL, mr_gltf_size(g, arrays[i]), arrays[i]);
	for (size_t i = 0; i < mr_gltf_size(g, "materials"); i++)
		looks += has_look(mr_gltf_at(g, "materials", i));
	mr_lost(g->ctx, NULL, looks, "looks of materials");
	mr_lost(g->ctx, NULL, left->targets, "morph targets");
	mr_lost(g->ctx, NULL, left->lines, "lines");
	mr_lost(g->ctx, NULL, left->unseen, "meshes that the scene does not show");
	mr_lost(g->ctx, NULL, left->several, "instances of meshes");
	mr_lost(g->ctx, NULL, left->attributes, "other attributes");
}
