/* How the pictures of a glTF document lie on texture coordinates. */
#include "formats/gltf.h"

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
