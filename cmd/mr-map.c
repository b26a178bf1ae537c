/* mr-map -- heights over a control mesh to a picture, and back.  See man/mr-map.1. */
#include "cmd.h"
#include "formats/outname.h"

static mr_map_opts opts = MR_MAP_DEFAULTS;
static const char *to, *from;
static mr_string_set given;

static const cmd_opt table[] = {
	{ 'w', "write", CMD_TEXT, &to, 0, 0, "NAME", "write NAME-height.png, NAME-normal.png and NAME.mtl",
	    NULL },
	{ 'r', "read", CMD_TEXT, &from, 0, 0, "PICTURE", "read the heights in this picture", NULL },
	{ 'n', "level", CMD_COUNT, &opts.level, 0, MR_LEVEL_MAX, "LEVEL",
	    "subdivisions of the control mesh (default: as many as have heights, or as the picture says)",
	    NULL },
	{ 0, "range", CMD_RANGE, &opts.low, 0, 0, "LOW,HIGH",
	    "heights of black and white (default: the least and the greatest, or as the picture says)",
	    NULL },
	{ 0, "size", CMD_COUNT, &opts.side, 1, 32767, "N", "texels that a side of a picture may have", NULL },
	{ 0, "gutter", CMD_COUNT, &opts.gutter, 1, 256, "N", "texels around each triangle", NULL },
	{ 0 },
};

static mr_status
check(cmd *c)
{
	char *name;

	if (!to == !from)
		return mr_fail(&c->ctx, MR_EUSAGE, "give one of --write NAME and --read PICTURE");
	MR_TRY(cmd_idle(c, "size", from != NULL, "with --read"));
	MR_TRY(cmd_idle(c, "gutter", from != NULL, "with --read"));
	opts.ranged = cmd_given(c, "range");
	return mr_outname(&c->ctx, to ? to : from, "", 1, &name);
}

static const cmd_field figures[] = {
	CMD_COUNTED(mr_map_result, level),
	CMD_COUNTED(mr_map_result, width),
	CMD_COUNTED(mr_map_result, height),
	CMD_MEASURED(mr_map_result, low),
	CMD_MEASURED(mr_map_result, high),
	CMD_COUNTED(mr_map_result, clipped),
	CMD_COUNTED(mr_map_result, turned),
	CMD_COUNTED(mr_map_result, between),
	CMD_COUNTED(mr_map_result, seams),
	{ 0 },
};

static mr_status
map_frame(cmd *c, mr_frame *f)
{
	char *name;

	MR_TRY(to ? mr_outname_once(&c->ctx, &given, to, f->name, f->number, &name)
		  : mr_outname(&c->ctx, from, f->name, f->number, &name));
	return to ? mr_map_write(&c->ctx, f, name, &opts, c->result)
	          : mr_map_read(&c->ctx, f, name, &opts, c->result);
}

const cmd_tool cmd_this = {
	.summary = "write heights over a control mesh as pictures, and read them",
	.options = table,
	.prepare = check,
	.frame = map_frame,
	.figures = figures,
	.fixed_layers = true,
};
