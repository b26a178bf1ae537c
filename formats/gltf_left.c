/* What a glTF document has and a model has not: counted, and said in one line. */
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

/* What is said, and "2 images"; NULL where memory cannot be had. */
static const char *
add_count(mr_ctx *ctx, const char *said, size_t count, const char *what)
{
	if (!said || count == 0)
		return said;
	return mr_format(ctx, "%s%s%zu %s%s", said, *said ? ", " : "", count, what, count > 1 ? "s" : "");
}

static int
by_text(const void *a, const void *b)
{
	return strcmp(*(const char *const *)a, *(const char *const *)b);
}

/* The attributes, each name with its number; the names of many are no help. */
static const char *
add_attributes(mr_ctx *ctx, const char *said, const mr_gltf_left *left)
{
	enum { NAMES = 8 };
	size_t names = 0, i = 0;

	if (left->attributes)
		qsort(left->attribute, left->attributes, sizeof *left->attribute, by_text);
	for (size_t first = 0; first < left->attributes && names < NAMES; first = i, names++) {
		const char *name = left->attribute[first], *what = mr_format(ctx, "%.60s attribute", name);
		while (i < left->attributes && !strcmp(name, left->attribute[i]))
			i++;
		said = what ? add_count(ctx, said, i - first, what) : NULL;
		if (!said)
			return NULL;
	}
	return add_count(ctx, said, left->attributes - i, "other attribute");
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

static mr_status
say(const mr_gltf *g, mr_gltf_left *left, size_t unused)
{
	const mr_gltf_looks looks = mr_gltf_count_looks(g);
	const char *said = "";
	const struct {
		size_t count;
		const char *what;
	} lines[] = { { mr_gltf_size(g, "images"), "image" }, { looks.colors, "material colour" },
		{ looks.surfaces, "material surface" }, { looks.transforms, "other texture transform" },
		{ unused, "unused material" },
		{ listed(g, "KHR_materials_variants", "variants"), "material variant" },
		{ mr_gltf_size(g, "skins"), "skin" }, { mr_gltf_size(g, "animations"), "animation" },
		{ mr_gltf_size(g, "cameras"), "camera" },
		{ listed(g, "KHR_lights_punctual", "lights"), "light" }, { left->targets, "morph target" },
		{ left->lines, "line primitive" }, { left->unseen.scenes, "other scene" },
		{ left->unseen.nodes, "unshown mesh node" },
		{ left->unseen.meshes, "unreferenced mesh object" }, { parents(g), "parent node" },
		{ left->unseen.several, "EXT_mesh_gpu_instancing node" },
		{ all_other_extensions(g), "other extension" },
		{ with_extras(g, "nodes") + with_extras(g, "meshes") + with_extras(g, "materials"),
		    "extra" } };

	for (size_t i = 0; i < sizeof lines / sizeof *lines; i++)
		said = add_count(g->ctx, said, lines[i].count, lines[i].what);
	said = add_attributes(g->ctx, said, left);
	if (!said)
		return MR_EMEM;
	if (*said)
		mr_warn(g->ctx, "not kept of the file: %s", said);
	return MR_OK;
}

mr_status
mr_gltf_say_left(const mr_gltf *g, mr_gltf_left *left)
{
	size_t unused;

	MR_TRY(unused_materials(g, &unused));
	return say(g, left, unused);
}
