/* Drawing what gallery.c collected: cameras, panels, labels, legends, sheets. */
#include "render/gallery.h"

#include "mesh/layers.h"

static const mr_rgb PAPER = { 252, 252, 250 }, INK = { 58, 60, 66 }, PALE = { 140, 142, 148 };

/* Pixels per unit of text, in a panel of this size. */
static double
text_unit(const mr_render_opts *o)
{
	size_t side = o->width < o->height ? o->width : o->height;

	return side < 510 ? 1 : side < 1020 ? 2 : 3;
}

/* Height of the strip of labels under a panel. */
static double
label_height(const mr_render_opts *o)
{
	return o->labels ? 15 * text_unit(o) : 0;
}

/* Aims a camera at panels of the gallery. */
static mr_status
aim(mr_ctx *ctx, const mr_gallery *g, size_t first, size_t count, const mr_render_opts *o, mr_camera *camera)
{
	double w = (double)o->width, h = (double)o->height, label = label_height(o);
	double margin = 0.04 * (w < h ? w : h);
	mr_box box = mr_box_empty(), covered = mr_box_empty();
	mr_camera c;

	MR_TRY(mr_camera_look(ctx, o->from, o->up, &c));
	for (size_t i = first; i < first + count; i++)
		mr_camera_box(&c, &g->panel[i].subject.mesh, &box);
	mr_camera_aim(&c, box);
	if (o->at)
		mr_camera_turn_to(&c, mr_vec(o->at[0], o->at[1], o->at[2]));
	for (size_t i = first; i < first + count; i++)
		mr_camera_cover(&c, &g->panel[i].subject.mesh, &covered);
	mr_camera_fit(&c, covered, margin, margin, w - 2 * margin, h - label - 2 * margin);
	if (o->at && o->at[3] > 0)
		c.scale = fmin(w, h - label) / 2 / o->at[3];
	if (o->at)
		c.x = w / 2, c.y = (h - label) / 2;
	*camera = c;
	return MR_OK;
}

static size_t
value_count(const mr_panel *p)
{
	return p->subject.per_face ? p->subject.mesh.nf : p->subject.mesh.nv;
}

/* The range that colours span: symmetric where numbers of both signs are there. */
static void
find_range(const mr_gallery *g, size_t first, size_t count, const mr_render_opts *o, mr_shot *s)
{
	double low = INFINITY, high = -INFINITY;

	for (size_t i = first; i < first + count; i++) {
		const mr_panel *p = &g->panel[i];
		for (size_t k = 0; p->value && k < value_count(p); k++) {
			if (!isfinite(p->value[k]))
				continue;
			low = fmin(low, p->value[k]);
			high = fmax(high, p->value[k]);
		}
	}
	if (low < 0 && high > 0)
		low = -(high = fmax(-low, high));
	s->low = o->ranged ? o->low : low <= high ? low : 0;
	s->high = o->ranged ? o->high : low <= high ? high : 0;
}

mr_status
mr_shot_aim(
    mr_ctx *ctx, const mr_gallery *g, size_t first, size_t count, const mr_render_opts *o, mr_shot *shot)
{
	mr_shot s = { .first = first, .count = count };
	const mr_shown *a = &g->frame[first], *b = &g->frame[first + count - 1];
	size_t panels = b->first + b->count - a->first;

	MR_TRY(aim(ctx, g, a->first, panels, o, &s.camera));
	find_range(g, a->first, panels, o, &s);
	*shot = s;
	return MR_OK;
}

static mr_rgb
number_color(const mr_shot *s, double x)
{
	if (!isfinite(x))
		return mr_color_kind(MR_NONE);
	if (s->low < 0 && s->high > 0)
		return mr_color_diverging(x / fmax(-s->low, s->high));
	return mr_color_sequential(s->high > s->low ? (x - s->low) / (s->high - s->low) : 0.5);
}

/* The subject with its numbers made colours. */
static void
color_subject(mr_ctx *ctx, const mr_shot *s, const mr_panel *p, mr_subject *m)
{
	mr_rgb *color;

	*m = p->subject;
	if (!p->value)
		return;
	color = MR_NEW(ctx, value_count(p), mr_rgb);
	for (size_t i = 0; i < value_count(p); i++)
		color[i] = number_color(s, p->value[i]);
	m->color = color;
}

/* A line of text that grows to one side, with the room that is left to it. */
typedef struct strip {
	mr_image *image;
	double left, right, y, unit;
} strip;

static double
text_width(const strip *s, const char *text)
{
	return s->unit * (double)(MR_TEXT_ADVANCE * strlen(text));
}

/* Writes at the left end if it fits, cut short with dots where `cut`. */
static void
write_left(strip *s, const char *text, mr_rgb color, bool cut)
{
	size_t fits = s->right > s->left ? (size_t)((s->right - s->left) / (s->unit * MR_TEXT_ADVANCE)) : 0;
	char line[256];

	if (strlen(text) > fits && (!cut || fits < 3))
		return;
	snprintf(line, sizeof line, "%s", text);
	if (strlen(line) > fits)
		snprintf(line + fits - 2, sizeof line - fits + 2, "..");
	mr_image_text(s->image, s->left, s->y, s->unit, color, line);
	s->left += text_width(s, line) + 2 * MR_TEXT_ADVANCE * s->unit;
}

static void
write_right(strip *s, const char *text, mr_rgb color)
{
	s->right -= text_width(s, text);
	mr_image_text(s->image, s->right, s->y, s->unit, color, text);
	s->right -= MR_TEXT_ADVANCE * s->unit;
}

static void
number_text(char *text, size_t size, double x)
{
	snprintf(text, size, "%.3g", x);
}

/* The bar of colours between its least and its greatest number. */
static void
draw_scale(strip *s, const mr_shot *shot)
{
	double width = floor(fmin(64 * s->unit, (s->right - s->left) / 4)), height = 7 * s->unit;
	char text[32];

	number_text(text, sizeof text, shot->high);
	write_right(s, text, INK);
	s->right = floor(s->right - width);
	for (double x = 0; x < width; x++)
		mr_image_fill(s->image, s->right + x, s->y, 1, height,
		    number_color(shot, shot->low + (shot->high - shot->low) * (x + 0.5) / width));
	s->right -= MR_TEXT_ADVANCE * s->unit;
	number_text(text, sizeof text, shot->low);
	write_right(s, text, INK);
}

/* The strip under a panel: its name, its size, the legend of its colours. */
static void
draw_label(mr_image *image, const mr_shot *shot, const mr_panel *p, bool several, const mr_render_opts *o)
{
	double unit = text_unit(o), edge = 8 * unit;
	strip s = { image, edge, (double)o->width - edge, (double)o->height - 12 * unit, unit };
	char name[256], size[64];

	mr_image_fill(
	    image, 0, (double)o->height - label_height(o), (double)o->width, label_height(o), PAPER);
	snprintf(name, sizeof name, several ? "%s: %s" : "%s", p->frame, p->layer);
	snprintf(size, sizeof size, "%zu %s", p->subject.mesh.nf ? p->subject.mesh.nf : p->subject.mesh.nv,
	    p->subject.mesh.nf ? "triangles" : "points");
	if (p->value)
		draw_scale(&s, shot);
	write_left(&s, name, INK, true);
	if (p->value && text_width(&s, o->color) < s.right - s.left)
		write_right(&s, o->color, PALE);
	write_left(&s, size, PALE, false);
}

static void
draw_panel(mr_ctx *ctx, const mr_gallery *g, const mr_shot *shot, size_t i, bool several,
    const mr_render_opts *o, mr_image *image)
{
	const mr_panel *p = &g->panel[i];
	mr_subject subject;

	color_subject(ctx, shot, p, &subject);
	mr_raster(ctx, &subject, &shot->camera, o->wire, image);
	if (o->labels)
		draw_label(image, shot, p, several, o);
}

/* Draws a frame's panels side by side into the image at (x, y). */
static mr_status
draw_frame(mr_ctx *ctx, const mr_gallery *g, const mr_shot *shot, const mr_shown *f, size_t x, size_t y,
    const mr_render_opts *o, mr_image *image)
{
	for (size_t i = 0; i < f->count; i++) {
		MR_SCOPE(ctx);
		mr_image panel;
		MR_TRY(mr_image_new(ctx, o->width, o->height, PAPER, &panel));
		draw_panel(ctx, g, shot, f->first + i, f->count > 1, o, &panel);
		mr_image_copy(image, x + i * o->width, y, &panel);
	}
	return MR_OK;
}

mr_status
mr_shot_draw(
    mr_ctx *ctx, const mr_gallery *g, const mr_shot *shot, size_t i, const mr_render_opts *o, mr_image *image)
{
	const mr_shown *f = &g->frame[i];
	mr_image r;

	MR_TRY(mr_image_new(ctx, f->count * o->width, o->height, PAPER, &r));
	MR_TRY(draw_frame(ctx, g, shot, f, 0, 0, o, &r));
	*image = r;
	return MR_OK;
}

/* Frames in a row of a sheet: for one of about 3 by 2, unless they are given. */
static size_t
sheet_columns(const mr_gallery *g, const mr_render_opts *o)
{
	double frames = (double)g->frames, width = (double)(g->panels * o->width) / frames;
	double columns = o->columns ? (double)o->columns
	                            : rint(sqrt(1.5 * frames * (double)o->height / width));

	return (size_t)fmin(fmax(1, columns), frames);
}

/* Panels of the widest row. */
static size_t
sheet_width(const mr_gallery *g, size_t columns)
{
	size_t widest = 0, row = 0;

	for (size_t i = 0; i < g->frames; i++) {
		row = (i % columns ? row : 0) + g->frame[i].count;
		widest = row > widest ? row : widest;
	}
	return widest;
}

/* Aims at the frames from `first` to the next shot. */
static mr_status
next_shot(mr_ctx *ctx, const mr_gallery *g, size_t first, const mr_render_opts *o, mr_shot *shot)
{
	size_t end = first + 1;

	while (end < g->frames && (o->same || !g->frame[end].key))
		end++;
	return mr_shot_aim(ctx, g, first, end - first, o, shot);
}

mr_status
mr_sheet_draw(mr_ctx *ctx, const mr_gallery *g, const mr_render_opts *o, mr_image *image)
{
	size_t columns = sheet_columns(g, o), rows = (g->frames + columns - 1) / columns, x = 0;
	mr_shot shot = { 0 };
	mr_image r;

	MR_TRY(mr_image_new(ctx, sheet_width(g, columns) * o->width, rows * o->height, PAPER, &r));
	for (size_t i = 0; i < g->frames; x += g->frame[i++].count * o->width) {
		x = i % columns ? x : 0;
		if (i == shot.first + shot.count)
			MR_TRY(next_shot(ctx, g, i, o, &shot));
		mr_progress(ctx, "drawing", (double)i / (double)g->frames);
		MR_TRY(draw_frame(ctx, g, &shot, &g->frame[i], x, i / columns * o->height, o, &r));
	}
	*image = r;
	return MR_OK;
}
