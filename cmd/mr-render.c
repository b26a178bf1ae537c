/* mr-render -- a shaded picture of each frame.  See man/mr-render.1. */
#include "cmd.h"
#include "formats/filename.h"
#include "formats/image.h"
#include "formats/paint.h"
#include "render/gallery.h"

static mr_render_opts opts = MR_RENDER_DEFAULTS;
static const char *view = "quarter", *at;
static double middle[4];
static int up = 1;
static bool sheet;
static size_t written;
static mr_string_set given;
static mr_gallery gallery;
static mr_mark kept; /* of the arena that holds the gallery */

static const cmd_opt table[] = {
	{ 's', "size", CMD_SIZE, &opts.width, 16, 16384, "WxH", "pixels of a panel", NULL },
	{ 0, "view", CMD_TEXT, &view, 0, 0, "DIR",
	    "front, back, left, right, top, bottom, iso, quarter, or where the eye stands as x,y,z", NULL },
	{ 0, "at", CMD_TEXT, &at, 0, 0, "X,Y,Z[,R]", "point looked at, and radius around it that is seen",
	    NULL },
	{ 0, "up", CMD_CHOICE, &up, 0, 0, "x|y|z", "axis that is upwards", NULL },
	{ 0, "same", CMD_FLAG, &opts.same, 0, 0, NULL, "one camera and range for all frames", NULL },
	{ 'c', "color", CMD_TEXT, &opts.color, 0, 0, "COLUMN", "colour by a column's values", NULL },
	{ 0, "texture", CMD_TEXT, &opts.texture, 0, 0, "FILE", "picture on surfaces", NULL },
	{ 0, "materials", CMD_TEXT, &opts.materials, 0, 0, "DIR", "folder of files of materials", NULL },
	{ 0, "range", CMD_RANGE, &opts.low, 0, 0, "LOW,HIGH", "values that the colours span", NULL },
	{ 'w', "wire", CMD_FLAG, &opts.wire, 0, 0, NULL, "draw edges", NULL },
	{ 0, "sheet", CMD_FLAG, &sheet, 0, 0, NULL, "all frames in one picture", NULL },
	{ 0, "columns", CMD_COUNT, &opts.columns, 0, 10000, "N", "of the sheet; 0: for 3 by 2", NULL },
	{ 0, "no-labels", CMD_OFF, &opts.labels, 0, 0, NULL, "neither names nor legends", NULL },
	{ 0 },
};

static mr_status
parse_view(mr_ctx *ctx)
{
	double v[3];

	if (mr_camera_view(view, opts.up, &opts.from))
		return MR_OK;
	MR_TRY(cmd_parse_reals(ctx, "--view", view, 3, v));
	opts.from = mr_vec(v[0], v[1], v[2]);
	if (!(mr_norm2(opts.from) > 0))
		return mr_fail(ctx, MR_EUSAGE, "--view: %s is no direction", view);
	return MR_OK;
}

static mr_status
parse_at(mr_ctx *ctx)
{
	size_t numbers = 1;

	if (!at)
		return MR_OK;
	for (const char *s = at; *s; s++)
		numbers += *s == ',';
	MR_TRY(cmd_parse_reals(ctx, "--at", at, numbers == 4 ? 4 : 3, middle));
	if (middle[3] < 0)
		return mr_fail(ctx, MR_EUSAGE, "--at: %g is no radius", middle[3]);
	opts.at = middle;
	return MR_OK;
}

static mr_status
prepare(cmd *c)
{
	char *path;

	MR_TRY(cmd_output_name(c, "OUT.png", ".png"));
	MR_TRY(cmd_idle(c, "columns", !sheet, "without --sheet"));
	MR_TRY(cmd_idle(c, "materials", opts.texture != NULL, "with --texture"));
	MR_TRY(cmd_idle(c, "range", !opts.color, "without --color"));
	opts.layers = c->layer;
	opts.up = mr_vec(up == 0, up == 1, up == 2);
	opts.ranged = cmd_given(c, "range");
	kept = mr_mark_take(&c->keep);
	MR_TRY(mr_outname(&c->ctx, c->operands[0], "", 0, &path));
	MR_TRY(parse_at(&c->ctx));
	return parse_view(&c->ctx);
}

static mr_status
write_picture(cmd *c, const mr_shown *frame, const mr_image *image)
{
	char *path;

	MR_TRY(mr_outname_once(&c->ctx, &given, c->operands[0], frame->name, frame->number, &path));
	return mr_png_write(&c->ctx, path, image);
}

/* Draws the frames that were collected, one picture each, and forgets them. */
static mr_status
write_frames(cmd *c)
{
	mr_image image;
	mr_shot shot;

	if (gallery.frames == 0)
		return MR_OK;
	if (written + gallery.frames > 1 && !mr_outname_varies(c->operands[0]))
		return mr_fail(&c->ctx, MR_EUSAGE,
		    "%s is one picture, of several frames: put %%d or %%s into its name, or use --sheet",
		    c->operands[0]);
	MR_TRY(mr_shot_aim(&c->ctx, &gallery, 0, gallery.frames, &opts, &shot));
	for (size_t i = 0; i < gallery.frames; i++) {
		MR_SCOPE(&c->ctx);
		mr_progress(&c->ctx, "drawing", (double)i / (double)gallery.frames);
		MR_TRY(mr_shot_draw(&c->ctx, &gallery, &shot, i, &opts, &image));
		MR_TRY(write_picture(c, &gallery.frame[i], &image));
	}
	written += gallery.frames;
	gallery = (mr_gallery){ 0 };
	mr_mark_release(&c->keep, kept);
	return MR_OK;
}

static mr_status
render_frame(cmd *c, mr_frame *f)
{
	if (f->key && !sheet && !opts.same && mr_outname_varies(c->operands[0]))
		MR_TRY(write_frames(c));
	return mr_gallery_add_painted(&c->ctx, &c->keep, &gallery, f, &opts);
}

static mr_status
finish(cmd *c)
{
	mr_image image;

	if (!sheet)
		return write_frames(c);
	MR_TRY(mr_sheet_draw(&c->ctx, &gallery, &opts, &image));
	return write_picture(c, &gallery.frame[0], &image);
}

const cmd_tool cmd_this = {
	.summary = "draw a shaded picture of each frame",
	.operands = "[FILE...] OUT.png",
	.options = table,
	.prepare = prepare,
	.frame = render_frame,
	.finish = finish,
	.sink = true,
	.names_output = true,
};
