/* Collecting frames: what gallery.h draws later is copied out of them here. */
#include "render/gallery.h"

#include "mesh/layers.h"

/* A copy in the arena that is kept. */
static void *
copy_of(mr_ctx *keep, const void *data, size_t count, size_t size)
{
	return memcpy(mr_alloc(keep, count, size), data, count * size);
}

/* The surface, or points where the layer has no faces. */
static mr_status
take_mesh(mr_ctx *ctx, mr_ctx *keep, mr_frame *frame, mr_panel *p)
{
	mr_mesh *m = &p->subject.mesh;

	MR_TRY(mr_layer_surface_or_points(ctx, frame, p->layer, m));
	if (m->nv == 0)
		return mr_fail(ctx, MR_EMESH, "%s: the layer has no vertices to draw", p->layer);
	m->name = p->layer;
	m->p = copy_of(keep, m->p, m->nv, sizeof *m->p);
	if (m->nf)
		m->t = copy_of(keep, m->t, m->nf, sizeof *m->t);
	return MR_OK;
}

/* Normals of points: a surface makes its own. */
static mr_status
take_normals(mr_ctx *ctx, mr_ctx *keep, mr_frame *frame, mr_panel *p)
{
	size_t nv = p->subject.mesh.nv;
	const void *data;
	mr_v3 *normal;

	if (p->subject.mesh.nf || !mr_layer_has(frame, p->layer, "normal"))
		return MR_OK;
	MR_TRY(mr_layer_get_rows(ctx, frame, p->layer, "normal", nv, &data));
	normal = copy_of(keep, data, nv, sizeof *normal);
	for (size_t i = 0; i < nv; i++)
		normal[i] = mr_finite(normal[i]) ? mr_unit(normal[i]) : mr_vec(0, 0, 0);
	p->subject.normal = normal;
	return MR_OK;
}

/* Colours, or numbers of kinds, which need no range to become colours. */
static void
take_colors(mr_ctx *keep, const mr_column *c, mr_panel *p)
{
	mr_rgb *color = MR_NEW(keep, c->rows, mr_rgb);
	bool own = c->shape.type == 'b', regions = !strcmp(c->name, "region");

	for (size_t i = 0; i < c->rows; i++) {
		const unsigned char *b = (const unsigned char *)c->data + i * c->shape.components;
		uint32_t kind = own ? 0 : ((const uint32_t *)c->data)[i];
		color[i] = own       ? (mr_rgb){ b[0], b[1], b[2] }
		           : regions ? mr_color_region(kind)
		                     : mr_color_kind(kind);
	}
	p->subject.color = color;
	p->subject.nearest = !own;
}

/* Colours the panel by the column, if its layer has it. */
static mr_status
take_column(mr_ctx *ctx, mr_ctx *keep, mr_frame *frame, const char *name, mr_panel *p, bool *found)
{
	const mr_column *c = mr_frame_find(frame, p->layer, name);
	size_t rows = p->subject.mesh.nv;
	const void *data;
	size_t n;

	if (!c)
		return MR_OK;
	if (c->shape.element == 'f')
		rows = p->subject.mesh.nf;
	if ((c->shape.element != 'v' && c->shape.element != 'f') || c->shape.type == 't')
		return mr_fail(
		    ctx, MR_EMISSING, "%s: column %s has no value per vertex or face", p->layer, name);
	MR_TRY(mr_frame_get(ctx, frame, p->layer, name, c->shape, &data, &n));
	if (n != rows)
		return mr_fail(
		    ctx, MR_ERANGE, "%s: column %s has %zu rows, not %zu", p->layer, name, n, rows);
	*found = true;
	p->subject.per_face = c->shape.element == 'f';
	c = mr_frame_find(frame, p->layer, name); /* decoded */
	if ((c->shape.type == 'b' && c->shape.components >= 3) ||
	    (c->shape.type == 'u' && c->shape.components == 1)) {
		take_colors(keep, c, p);
		return MR_OK;
	}
	p->value = MR_NEW(keep, c->rows, double);
	for (size_t i = 0; i < c->rows; i++)
		p->value[i] = mr_column_number(c, i);
	return MR_OK;
}

static mr_status
add_layer(mr_ctx *ctx, mr_ctx *keep, mr_gallery *g, mr_frame *frame, const char *layer,
    const mr_render_opts *opts, bool *colored)
{
	mr_panel p = { .layer = mr_format(keep, "%s", layer), .frame = mr_format(keep, "%s", frame->name) };

	MR_TRY(take_mesh(ctx, keep, frame, &p));
	MR_TRY(take_normals(ctx, keep, frame, &p));
	if (opts->color)
		MR_TRY(take_column(ctx, keep, frame, opts->color, &p, colored));
	MR_RESERVE(keep, g->panel, g->panels, 1, &g->panel_room);
	g->panel[g->panels++] = p;
	return MR_OK;
}

/* Adds the layers named in the list, or all that have positions. */
static mr_status
add_layers(
    mr_ctx *ctx, mr_ctx *keep, mr_gallery *g, mr_frame *frame, const mr_render_opts *opts, bool *colored)
{
	const char *list = opts->layers;

	if (!list)
		MR_TRY(mr_layer_finished_or_warn(ctx, frame));
	for (size_t i = 0; !list && i < frame->count; i++)
		if (frame->columns[i].layer[0] && !strcmp(frame->columns[i].name, "position"))
			MR_TRY(add_layer(ctx, keep, g, frame, frame->columns[i].layer, opts, colored));
	while (list) {
		const char *comma = strchr(list, ',');
		char *layer = mr_format(ctx, "%.*s", comma ? (int)(comma - list) : (int)strlen(list), list);
		MR_TRY(add_layer(ctx, keep, g, frame, layer, opts, colored));
		list = comma ? comma + 1 : NULL;
	}
	return MR_OK;
}

mr_status
mr_gallery_add(mr_ctx *ctx, mr_ctx *keep, mr_gallery *g, mr_frame *frame, const mr_render_opts *opts)
{
	mr_shown shown = { .name = mr_format(keep, "%s", frame->name),
		.number = frame->number,
		.key = frame->key,
		.first = g->panels };
	bool colored = false;
	mr_status status;

	status = add_layers(ctx, keep, g, frame, opts, &colored);
	if (status == MR_OK && g->panels == shown.first)
		status = mr_fail(ctx, MR_EMISSING, "the frame has no layer with positions: nothing to draw");
	if (status == MR_OK && opts->color && !colored)
		status = mr_fail(ctx, MR_EMISSING, "no layer that is drawn has a column %s", opts->color);
	shown.count = g->panels - shown.first;
	if (status != MR_OK) {
		g->panels = shown.first;
		return status;
	}
	MR_RESERVE(keep, g->frame, g->frames, 1, &g->frame_room);
	g->frame[g->frames++] = shown;
	return MR_OK;
}
