/* What a glTF document has and a model has not: counted, and said in one line. */
#include "formats/gltf.h"

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
	const size_t count = sizeof read / sizeof *read;
	bool skins = mr_gltf_size(g, "skins") > 0;
	json_t *value;

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

mr_status
mr_gltf_say_left(const mr_gltf *g, mr_gltf_left *left)
{
	const mr_gltf_looks looks = mr_gltf_count_looks(g);
	const char *said = "";
	const struct {
		size_t count;
		const char *what;
	} lines[] = { { mr_gltf_size(g, "images"), "image" }, { looks.colors, "material colour" },
		{ looks.transforms, "other texture transform" }, { mr_gltf_size(g, "skins"), "skin" },
		{ mr_gltf_size(g, "animations"), "animation" }, { mr_gltf_size(g, "cameras"), "camera" },
		{ left->targets, "morph target" }, { left->lines, "line primitive" },
		{ left->unseen.scenes, "other scene" }, { left->unseen.nodes, "unshown mesh node" },
		{ left->unseen.several, "EXT_mesh_gpu_instancing node" } };

	for (size_t i = 0; i < sizeof lines / sizeof *lines; i++)
		said = add_count(g->ctx, said, lines[i].count, lines[i].what);
	said = add_attributes(g->ctx, said, left);
	if (!said)
		return MR_EMEM;
	if (*said)
		mr_warn(g->ctx, "not kept of the file: %s", said);
	return MR_OK;
}
