/* mr-export -- write a layer of each frame to a file.  See man/mr-export.1. */
#include "cmd.h"
#include "formats/filename.h"
#include "formats/model.h"

#include <strings.h>
#include <unistd.h>

static const char *format;
static bool floats;
static mr_string_set given;
static mr_scene scene = { .folder = "." };

static const cmd_opt table[] = {
	{ 'f', "format", CMD_TEXT, &format, 0, 0, "FORMAT",
	    "write this format (default: by the suffix of OUT)", NULL },
	{ 0, "materials", CMD_TEXT, &scene.folder, 0, 0, "DIR",
	    "folder of the files of materials, whose pictures a glb holds", NULL },
	{ 0, "compress", CMD_FLAG, &scene.gltf.compress, 0, 0, NULL, "a glb is packed by meshoptimizer",
	    NULL },
	{ 0, "float", CMD_FLAG, &floats, 0, 0, NULL, "a ply has floats in place of doubles", NULL },
	{ 0, "lods", CMD_FLAG, &scene.gltf.lods, 0, 0, NULL,
	    "a glb has the frames after the first as its coarser levels", NULL },
	{ 0, "no-normals", CMD_FLAG, &scene.gltf.no_normals, 0, 0, NULL, "a glb has no normals", NULL },
	{ 0, "quantize", CMD_FLAG, &scene.gltf.quantize, 0, 0, NULL,
	    "a glb has positions and texture coordinates of 16 bits, normals of 8", NULL },
	{ 0 },
};

static bool
is_ply(const char *out)
{
	const char *name = format ? format : mr_suffix_format(out);

	return name && !strcmp(name, "ply");
}

static mr_status
check(cmd *c)
{
	const char *out, *end;
	bool binary;
	char *name;

	MR_TRY(cmd_output_name(c, "OUT", NULL));
	out = c->operands[0];
	if (!strcmp(out, "-") && !format)
		return mr_fail(&c->ctx, MR_EUSAGE, "OUT is stdout: -f FORMAT is needed");
	MR_TRY(mr_format_check(&c->ctx, out, format, true, &binary));
	if ((end = strrchr(out, '.')) && !strcasecmp(end, ".mtl"))
		return mr_fail(&c->ctx, MR_EUSAGE, "%s: a model under the name of a file of materials", out);
	MR_TRY(cmd_idle(
	    c, "materials", !mr_scene_suits(out, format), "on this format, which holds no pictures"));
	MR_TRY(cmd_idle(c, "compress lods no-normals quantize", !mr_scene_suits(out, format),
	    "on this format, but on glb"));
	MR_TRY(cmd_idle(c, "lods", mr_outname_varies(out), "where each frame has a file of its own"));
	MR_TRY(cmd_idle(c, "float", !is_ply(out), "on this format, but on ply"));
	if (floats)
		format = "ply-float";
	if (!strcmp(out, "-") && binary && isatty(STDOUT_FILENO))
		return mr_fail(&c->ctx, MR_EUSAGE, "%s is binary and stdout is a terminal", format);
	return mr_outname(&c->ctx, out, "", 1, &name);
}

/* A file that holds several frames waits for the last of them; where names vary, each frame has one. */
static mr_status
add_to_scene(cmd *c, mr_frame *f)
{
	const char *out = c->operands[0];
	mr_scene own = { .folder = scene.folder, .gltf = scene.gltf };
	bool varies = mr_outname_varies(out);
	char *path;

	MR_TRY(mr_scene_add(&c->ctx, varies ? &c->ctx : &c->keep, varies ? &own : &scene, f, c->layer));
	if (!varies)
		return MR_OK;
	MR_TRY(mr_outname_once(&c->ctx, &given, out, f->name, f->number, &path));
	return mr_scene_write(&c->ctx, path, format, &own, NULL);
}

static mr_status
export_frame(cmd *c, mr_frame *f)
{
	const char *out = c->operands[0];
	bool varies = mr_outname_varies(out); /* else another frame may come, or the stream break off */
	char *path;

	if (mr_scene_suits(out, format))
		return add_to_scene(c, f);
	MR_TRY(mr_outname_once(&c->ctx, &given, out, f->name, f->number, &path));
	return mr_export_held(&c->ctx, f, c->layer, path, format, varies ? NULL : &c->held);
}

static mr_status
finish(cmd *c)
{
	const char *out = c->operands[0];
	char *path;

	if (scene.nodes == 0)
		return MR_OK;
	MR_TRY(mr_outname(&c->ctx, out, "", 0, &path));
	return mr_scene_write(&c->ctx, path, format, &scene, &c->held);
}

const cmd_tool cmd_this = {
	.summary = "write a layer of each frame to a file",
	.operands = "[FILE...] OUT",
	.options = table,
	.prepare = check,
	.frame = export_frame,
	.finish = finish,
	.sink = true,
	.names_output = true,
};
