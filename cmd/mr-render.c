/* mr-render -- a shaded picture of each frame.  See man/mr-render.1. */
#include "alg/gallery.h"
#include "cmd.h"
#include "formats/outname.h"
#include "formats/png.h"

#include <unistd.h>

enum { UP_X, UP_Y, UP_Z };

static mr_gallery_opts opts = MR_GALLERY_DEFAULTS;
static const char *size = "800x600", *view = "quarter", *range;
static int up = UP_Y;
static bool flat, plain, no_labels, sheet, same;
static size_t columns;

static mr_gallery gallery;
static mr_mark kept; /* of the arena that holds the gallery */
static size_t written;

static const cmd_opt table[] = {
	{ 's', "size", CMD_TEXT, &size, 0, 0, "WxH", "pixels of a panel", NULL },
	{ 0, "view", CMD_TEXT, &view, 0, 0, "DIR",
	    "front, back, left, right, top, bottom, iso, quarter, or where the eye stands as x,y,z", NULL },
	{ 0, "up", CMD_CHOICE, &up, 0, 0, "x|y|z", "axis that is upwards", NULL },
	{ 0, "zoom", CMD_REAL, &opts.zoom, 1e-3, 1e3, "Z", "enlargement; at 1 all fits", NULL },
	{ 0, "parallel", CMD_FLAG, &opts.parallel, 0, 0, NULL, "parallel projection, not perspective", NULL },
	{ 0, "fit", CMD_FLAG, &opts.fit, 0, 0, NULL, "a camera for each panel", NULL },
	{ 0, "same", CMD_FLAG, &same, 0, 0, NULL, "one camera and range for all frames", NULL },
	{ 'c', "color", CMD_TEXT, &opts.color, 0, 0, "COLUMN", "colour by a column's values", NULL },
	{ 0, "range", CMD_TEXT, &range, 0, 0, "LOW,HIGH", "values that the colours span", NULL },
	{ 0, "flat", CMD_FLAG, &flat, 0, 0, NULL, "shade each triangle on its own", NULL },
	{ 0, "crease", CMD_REAL, &opts.raster.crease, 0, 180, "DEG",
	    "triangles that meet at a larger angle are not shaded as one", NULL },
	{ 'w', "wire", CMD_FLAG, &opts.raster.wire, 0, 0, NULL, "draw edges", NULL },
	{ 0, "plain", CMD_FLAG, &plain, 0, 0, NULL, "do not darken hollows", NULL },
	{ 0, "point-size", CMD_REAL, &opts.raster.point_radius, 0, 1000, "R",
	    "radius of points in pixels; 0: about to cover the surface", NULL },
	{ 0, "samples", CMD_COUNT, &opts.raster.samples, 1, 8, "N", "N by N samples a pixel", NULL },
	{ 0, "sheet", CMD_FLAG, &sheet, 0, 0, NULL, "all frames in one picture", NULL },
	{ 0, "columns", CMD_COUNT, &columns, 0, 10000, "N", "of the sheet; 0: about 3 by 2 in all", NULL },
	{ 0, "title", CMD_TEXT, &opts.title, 0, 0, "TEXT", "over the picture", NULL },
	{ 0, "no-labels", CMD_FLAG, &no_labels, 0, 0, NULL, "neither names nor legends", NULL },
	{ 0 },
};

static mr_status
parse_size(mr_ctx *ctx)
{
	const char *x = strchr(size, 'x');
	char width[16];

	if (!x || x - size >= (int)sizeof width)
		return mr_fail(ctx, MR_EUSAGE, "--size: %s is not of the form WxH", size);
	snprintf(width, sizeof width, "%.*s", (int)(x - size), size);
	MR_TRY(cmd_parse_count(ctx, "--size", width, 16, 16384, &opts.width));
	return cmd_parse_count(ctx, "--size", x + 1, 16, 16384, &opts.height);
}

/* Directions of view are named for a model that stands upright on y and looks along z. */
static mr_status
parse_view(mr_ctx *ctx)
{
	static const struct {
		const char *name;
		mr_v3 from;
	} views[] = { { "front", { 0, 0, 1 } }, { "back", { 0, 0, -1 } }, { "left", { -1, 0, 0 } },
		{ "right", { 1, 0, 0 } }, { "top", { 0, 1, 0 } }, { "bottom", { 0, -1, 0 } },
		{ "iso", { 1, 1, 1 } }, { "quarter", { 0.5, 0.35, 1 } } };
	double v[3];

	opts.up = mr_vec(up == UP_X, up == UP_Y, up == UP_Z);
	for (size_t i = 0; i < sizeof views / sizeof *views; i++) {
		mr_v3 f = views[i].from;
		if (strcmp(view, views[i].name))
			continue;
		opts.from = up == UP_Y ? f : up == UP_Z ? mr_vec(f.x, -f.z, f.y) : mr_vec(f.y, f.z, f.x);
		return MR_OK;
	}
	MR_TRY(cmd_parse_reals(ctx, "--view", view, 3, v));
	opts.from = mr_vec(v[0], v[1], v[2]);
	if (!(mr_norm2(opts.from) > 0))
		return mr_fail(ctx, MR_EUSAGE, "--view: %s is no direction", view);
	return MR_OK;
}

static mr_status
parse_range(mr_ctx *ctx)
{
	double v[2];

	if (!range)
		return MR_OK;
	MR_TRY(cmd_parse_reals(ctx, "--range", range, 2, v));
	if (!(v[0] < v[1]))
		return mr_fail(ctx, MR_EUSAGE, "--range: %g is not below %g", v[0], v[1]);
	opts.ranged = true;
	opts.low = v[0];
	opts.high = v[1];
	return MR_OK;
}

static mr_status
prepare(cmd *c)
{
	char *path;

	if (c->operand_count != 1)
		return mr_fail(&c->ctx, MR_EUSAGE, "one OUT.png is expected, not %zu", c->operand_count);
	opts.layers = c->layer;
	opts.labels = !no_labels;
	opts.raster.flat = flat;
	opts.raster.occlusion = !plain;
	kept = mr_mark_take(&c->keep);
	if (!strcmp(c->operands[0], "-") && isatty(STDOUT_FILENO))
		return mr_fail(&c->ctx, MR_EUSAGE, "a picture is not written to a terminal");
	MR_TRY(mr_outname(&c->ctx, c->operands[0], "", 0, &path));
	MR_TRY(parse_size(&c->ctx));
	MR_TRY(parse_view(&c->ctx));
	return parse_range(&c->ctx);
}

/* Writes the picture of frame i. */
static mr_status
write_frame(cmd *c, const mr_shot *shot, size_t i)
{
	mr_mark mark = mr_mark_take(&c->ctx);
	mr_image image;
	char *path;

	mr_progress(&c->ctx, "drawing", (double)i / (double)gallery.frames);
	MR_TRY(mr_outname(&c->ctx, c->operands[0], gallery.frame[i].name, gallery.frame[i].number, &path));
	MR_TRY(mr_shot_draw(&c->ctx, &gallery, shot, i, &opts, &image));
	MR_TRY(mr_png_write(&c->ctx, path, &image));
	mr_mark_release(&c->ctx, mark);
	return MR_OK;
}

/* Draws the frames that were collected, one picture each, and forgets them. */
static mr_status
write_frames(cmd *c)
{
	mr_shot shot;

	if (gallery.frames == 0)
		return MR_OK;
	if (written + gallery.frames > 1 && !mr_outname_varies(c->operands[0]))
		return mr_fail(&c->ctx, MR_EUSAGE,
		    "%s is one picture, and there are several frames: put %%d or %%s into its name, or use "
		    "--sheet",
		    c->operands[0]);
	MR_TRY(mr_shot_aim(&c->ctx, &gallery, 0, gallery.frames, &opts, &shot));
	for (size_t i = 0; i < gallery.frames; i++)
		MR_TRY(write_frame(c, &shot, i));
	written += gallery.frames;
	gallery = (mr_gallery){ 0 };
	mr_mark_release(&c->keep, kept);
	return MR_OK;
}

static mr_status
render_frame(cmd *c, mr_frame *f)
{
	bool apart = f->key && !sheet && !same && mr_outname_varies(c->operands[0]);

	if (apart)
		MR_TRY(write_frames(c));
	return mr_gallery_add(&c->ctx, &c->keep, &gallery, f, &opts);
}

/* Cuts the frames into shots at key frames, and draws them all into one picture. */
static mr_status
write_sheet(cmd *c)
{
	mr_shot *shot = MR_NEW(&c->ctx, gallery.frames, mr_shot);
	size_t shots = 0;
	mr_image image;
	char *path;

	if (!shot)
		return MR_EMEM;
	for (size_t first = 0, end; first < gallery.frames; first = end) {
		for (end = first + 1; end < gallery.frames && (same || !gallery.frame[end].key);)
			end++;
		MR_TRY(mr_shot_aim(&c->ctx, &gallery, first, end - first, &opts, &shot[shots++]));
	}
	MR_TRY(mr_outname(&c->ctx, c->operands[0], gallery.frame[0].name, gallery.frame[0].number, &path));
	MR_TRY(mr_sheet_draw(&c->ctx, &gallery, shot, shots, columns, &opts, &image));
	return mr_png_write(&c->ctx, path, &image);
}

static mr_status
finish(cmd *c)
{
	if (gallery.frames == 0 && (sheet || !mr_outname_varies(c->operands[0])) && written == 0)
		return mr_fail(&c->ctx, MR_EMISSING, "the stream has no frame to draw");
	return sheet ? write_sheet(c) : write_frames(c);
}

int
main(int argc, char **argv)
{
	return cmd_main(argc, argv,
	    &(cmd_tool){ .summary = "draw a shaded picture of each frame",
		.operands = "OUT.png",
		.options = table,
		.prepare = prepare,
		.frame = render_frame,
		.finish = finish,
		.sink = true });
}
