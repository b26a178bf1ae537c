/* mr-map -- heights over a control mesh to a picture, and back; a surface baked for another.  See
 * man/mr-map.1. */
#include "cmd.h"
#include "formats/filename.h"

static mr_map_opts opts = MR_MAP_DEFAULTS;
static mr_bake_opts baking = MR_BAKE_DEFAULTS;
static const char *to, *from, *baked;
static mr_side source; /* the stream or model that is baked */
static mr_string_set given;

static const cmd_opt table[] = {
	{ 'w', "write", CMD_TEXT, &to, 0, 0, "NAME", "write NAME-height.png, NAME-normal.png and NAME.mtl",
	    NULL },
	{ 'r', "read", CMD_TEXT, &from, 0, 0, "PICTURE", "read the heights in this picture", NULL },
	{ 'b', "bake", CMD_TEXT, &baked, 0, 0, "SOURCE",
	    "with -w: bake colours and normals of this stream or model into NAME-color.png and "
	    "NAME-normal.png",
	    NULL },
	{ 0, "texture", CMD_TEXT, &baking.texture, 0, 0, "FILE", "picture on SOURCE", NULL },
	{ 0, "materials", CMD_TEXT, &baking.materials, 0, 0, "DIR",
	    "folder of the files of SOURCE's materials (default: SOURCE's folder)", NULL },
	{ 'n', "level", CMD_COUNT, &opts.level, 0, MR_LEVEL_MAX, "LEVEL",
	    "subdivisions of the control mesh (default: as many as have heights, or as the picture says)",
	    NULL },
	{ 0, "range", CMD_RANGE, &opts.low, 0, 0, "LOW,HIGH",
	    "heights of black and white (default: the least and the greatest, or as the picture says)",
	    NULL },
	{ 0, "size", CMD_COUNT, &opts.side, 1, 32767, "N",
	    "largest side of a picture in texels; with --bake its size (default: 2048)", NULL },
	{ 0, "gutter", CMD_COUNT, &opts.gutter, 1, 256, "N",
	    "texels around each triangle (with --bake 4, around each chart)", NULL },
	{ 0 },
};

/* Options of the one thing are idle with the other. */
static mr_status
check_bake(cmd *c)
{
	MR_TRY(cmd_idle(c, "texture materials", !baked, "without --bake"));
	MR_TRY(cmd_idle(c, "level range", baked != NULL, "with --bake"));
	MR_TRY(cmd_idle(c, "materials", baking.texture != NULL, "with --texture"));
	if (!baked)
		return c->layer ? mr_fail(&c->ctx, MR_EUSAGE, "--layer has no effect without --bake") : MR_OK;
	if (from)
		return mr_fail(&c->ctx, MR_EUSAGE, "--bake writes: give --write NAME");
	if (!strcmp(baked, "-"))
		return mr_fail(&c->ctx, MR_EUSAGE, "SOURCE must be a file: stdin is the first stream");
	baking.layer = c->layer;
	baking.side = cmd_given(c, "size") ? opts.side : baking.side;
	baking.gutter = cmd_given(c, "gutter") ? opts.gutter : baking.gutter;
	if (!cmd_given(c, "materials") && strrchr(baked, '/'))
		baking.materials = mr_format(&c->keep, "%.*s", (int)(strrchr(baked, '/') - baked), baked);
	return cmd_side(c, baked, &source);
}

static mr_status
check(cmd *c)
{
	char *name;

	if (!to == !from)
		return mr_fail(&c->ctx, MR_EUSAGE, "give one of --write NAME and --read PICTURE");
	MR_TRY(cmd_idle(c, "size gutter", from != NULL, "with --read"));
	MR_TRY(check_bake(c));
	opts.ranged = cmd_given(c, "range");
	return mr_outname(&c->ctx, to ? to : from, "", 1, &name);
}

#define FIGURE(field) CMD_FIGURE(mr_map_result, field)
static const cmd_field figures[] = { FIGURE(level), FIGURE(width), FIGURE(height), FIGURE(low), FIGURE(high),
	FIGURE(clipped), FIGURE(turned), FIGURE(between), FIGURE(seams), FIGURE(texels), FIGURE(charts),
	{ 0 } };

static mr_status
map_frame(cmd *c, mr_frame *f)
{
	char *name;

	MR_TRY(to ? mr_outname_once(&c->ctx, &given, to, f->name, f->number, &name)
		  : mr_outname(&c->ctx, from, f->name, f->number, &name));
	if (baked) {
		MR_TRY(mr_side_take(&c->ctx, &source, f->number));
		return mr_bake(&c->ctx, f, source.frame, name, &baking, c->result);
	}
	return to ? mr_map_write(&c->ctx, f, name, &opts, c->result)
	          : mr_map_read(&c->ctx, f, name, &opts, c->result);
}

const cmd_tool cmd_this = {
	.summary = "write and read maps of heights, and bake surfaces into textures",
	.options = table,
	.prepare = check,
	.frame = map_frame,
	.figures = figures,
};
