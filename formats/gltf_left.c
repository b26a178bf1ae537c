/* What a glTF document has and a model has not. */
#include "formats/gltf.h"

#include "base/text.h"

#include <stdlib.h>

/* Joints and weights go with skins, which are said. */
static bool
is_of_skin(const char *name)
{
	return !strncmp(name, "JOINTS_", 7) || !strncmp(name, "WEIGHTS_", 8);
}

mr_status
mr_gltf_note_attributes(const mr_gltf *g, json_t *attributes, const char *texcoord, mr_gltf_left *left)
{
	const char *read[] = { "POSITION", "NORMAL", texcoord, "COLOR_0", MR_GLTF_NUMBER }, *name;
	bool skins = mr_gltf_size(g, "skins") > 0;
	size_t count = sizeof read / sizeof *read, number;
	json_t *value;

	MR_TRY(mr_gltf_vertex_numbers(g, attributes, &number));
	count -= number == MR_UNKNOWN;
	json_object_foreach(attributes, name, value)
	{
		size_t i = 0;
		while (i < count && strcmp(name, read[i]))
			i++;
		if (i < count || (skins && is_of_skin(name)))
			continue;
		MR_TRY(MR_RESERVE(g->ctx, left->attribute, left->attributes, 1, &left->attribute_room));
		left->attribute[left->attributes++] = name;
	}
	return MR_OK;
}

static int
by_text(const void *a, const void *b)
{
	return strcmp(*(const char *const *)a, *(const char *const *)b);
}

/* Each name with its number; the names of many are no help. */
static void
say_attributes(mr_ctx *ctx, const mr_gltf_left *left)
{
	enum { NAMES = 8 };
	size_t i = 0, names = 0;

	if (left->attributes)
		qsort(left->attribute, left->attributes, sizeof *left->attribute, by_text);
	for (size_t first = 0; first < left->attributes && names < NAMES; first = i, names++) {
		while (i < left->attributes && !strcmp(left->attribute[first], left->attribute[i]))
			i++;
		mr_tell(ctx, MR_LOST, i - first, "attribute %s", left->attribute[first]);
	}
	mr_lost(ctx, NULL, left->attributes - i, "other attributes");
}

/* How many things an extension of the document lists. */
static size_t
listed(const mr_gltf *g, const char *extension, const char *list)
{
	const json_t *extensions = json_object_get(g->root, "extensions");

	return json_array_size(json_object_get(json_object_get(extensions, extension), list));
}

/* How many of an array have what an application has added. */
static size_t
with_extras(const mr_gltf *g, const char *array)
{
	size_t count = 0;

	for (size_t i = 0; i < mr_gltf_size(g, array); i++)
		count += json_object_get(mr_gltf_at(g, array, i), "extras") != NULL;
	return count;
}

/* Extensions of a thing that are neither read nor counted by what they are. */
static size_t
other_extensions(const json_t *thing)
{
	static const char *const known[] = { "EXT_mesh_gpu_instancing", "KHR_draco_mesh_compression",
		"KHR_lights_punctual", "KHR_materials_variants", NULL };
	size_t count = 0;
	const char *name;
	json_t *value;

	json_object_foreach(json_object_get(thing, "extensions"), name, value)
	    count += !mr_is_one_of(name, known);
	return count;
}

/* The same of all but materials, whose surfaces are counted. */
static size_t
all_other_extensions(const mr_gltf *g)
{
	static const char *const arrays[] = { "scenes", "nodes", "meshes" };
	size_t count = other_extensions(g->root), k;
	json_t *primitive;

	for (size_t a = 0; a < sizeof arrays / sizeof *arrays; a++)
		for (size_t i = 0; i < mr_gltf_size(g, arrays[a]); i++)
			count += other_extensions(mr_gltf_at(g, arrays[a], i));
	for (size_t i = 0; i < mr_gltf_size(g, "meshes"); i++)
		json_array_foreach(json_object_get(mr_gltf_at(g, "meshes", i), "primitives"), k, primitive)
		    count += other_extensions(primitive);
	return count;
}

/* Nodes that others hang from: how, and what such a node without a mesh is called, goes. */
static size_t
parents(const mr_gltf *g)
{
	size_t count = 0;

	for (size_t i = 0; i < mr_gltf_size(g, "nodes"); i++)
		count += json_array_size(json_object_get(mr_gltf_at(g, "nodes", i), "children")) > 0;
	return count;
}

static mr_status
unused_materials(const mr_gltf *g, size_t *unused)
{
	size_t count = mr_gltf_size(g, "materials"), k;
	bool *used = MR_NEW_ZERO(g->ctx, count, bool);
	json_t *primitive;

	if (!used)
		return MR_EMEM;
	for (size_t i = 0; i < mr_gltf_size(g, "meshes"); i++)
		json_array_foreach(json_object_get(mr_gltf_at(g, "meshes", i), "primitives"), k, primitive)
		{
			json_t *material = json_object_get(primitive, "material");
			json_int_t number = json_is_integer(material) ? json_integer_value(material) : -1;
			if (number >= 0 && (size_t)number < count)
				used[number] = true;
		}
	*unused = count;
	for (size_t i = 0; i < count; i++)
		*unused -= used[i];
	return MR_OK;
}

mr_status
mr_gltf_say_left(const mr_gltf *g, mr_gltf_left *left)
{
	const mr_gltf_looks looks = mr_gltf_count_looks(g);
	size_t unused = 0;
	mr_status status = unused_materials(g, &unused);
	const struct {
		size_t count;
		const char *what;
	} lines[] = { { mr_gltf_size(g, "images"), "images" }, { looks.colors, "material colours" },
		{ looks.surfaces, "material surfaces" }, { looks.transforms, "other texture transforms" },
		{ unused, "unused materials" },
		{ listed(g, "KHR_materials_variants", "variants"), "material variants" },
		{ mr_gltf_size(g, "skins"), "skins" }, { mr_gltf_size(g, "animations"), "animations" },
		{ mr_gltf_size(g, "cameras"), "cameras" },
		{ listed(g, "KHR_lights_punctual", "lights"), "lights" }, { left->targets, "morph targets" },
		{ left->lines, "line primitives" }, { left->unseen.scenes, "other scenes" },
		{ left->unseen.nodes, "unshown mesh nodes" },
		{ left->unseen.meshes, "unreferenced mesh objects" }, { parents(g), "parent nodes" },
		{ left->unseen.several, "EXT_mesh_gpu_instancing nodes" },
		{ all_other_extensions(g), "other extensions" },
		{ with_extras(g, "nodes") + with_extras(g, "meshes") + with_extras(g, "materials"),
		    "extras" } };

	MR_TRY(status);
	for (size_t i = 0; i < sizeof lines / sizeof *lines; i++)
		mr_lost(g->ctx, NULL, lines[i].count, lines[i].what);
	say_attributes(g->ctx, left);
	return MR_OK;
}
