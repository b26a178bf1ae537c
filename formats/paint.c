/* Texture coordinates and pictures of the layers that are drawn. */
#include "formats/paint.h"

#include "formats/image.h"
#include "formats/materials.h"

/* The coordinates of the corners, kept. */
static void
keep_corners(mr_ctx *keep, const mr_model *m, const double **corners)
{
	double *uv = MR_NEW(keep, 6 * m->nf, double);

	for (size_t c = 0; c < 3 * m->nf; c++)
		memcpy(uv + 2 * c, mr_corner_texcoord(m, c), 2 * sizeof *uv);
	for (size_t i = 0; i < 6 * m->nf; i++)
		if (!isfinite(uv[i]))
			uv[i] = NAN;
	*corners = uv;
}

static mr_status
read_texture(mr_ctx *ctx, mr_ctx *keep, const mr_file *file, mr_texture *texture)
{
	mr_image image;
	mr_status status = mr_image_read(keep, file, &image);

	if (status == MR_OK)
		status = mr_texture_make(keep, &image, texture);
	return mr_fail_as(ctx, keep, status);
}

/* One picture for all faces. */
static mr_status
wear_one(mr_ctx *ctx, mr_ctx *keep, const char *file, size_t nf, mr_paint *paint)
{
	mr_texture *texture = MR_NEW(keep, 1, mr_texture);
	uint32_t *of = MR_NEW_ZERO(keep, nf, uint32_t);

	MR_TRY(read_texture(ctx, keep, &(mr_file){ .name = file }, texture));
	paint->texture = texture;
	paint->of = of;
	return MR_OK;
}

/* The pictures of materials, each file read once; number: of each material's, or MR_NONE. */
static mr_status
read_pictures(
    mr_ctx *ctx, mr_ctx *keep, const mr_material *look, size_t count, mr_texture *texture, uint32_t *number)
{
	mr_status status;
	uint32_t n = 0;

	for (size_t i = 0; i < count; i++) {
		const char *name = look[i].file.name;
		number[i] = MR_NONE;
		for (size_t k = 0; k < i && name && number[i] == MR_NONE; k++)
			if (look[k].file.name && !strcmp(look[k].file.name, name))
				number[i] = number[k];
		if (!name || number[i] != MR_NONE)
			continue;
		status = read_texture(ctx, keep, &look[i].file, &texture[n]);
		if (status == MR_EMEM)
			return status;
		mr_tell(ctx, MR_MISSING, status < 0, "%s, a picture", ctx->error);
		if (status == MR_OK)
			number[i] = n++;
	}
	return MR_OK;
}

static mr_rgb
to_rgb(const double c[3])
{
	return (
	    mr_rgb){ (uint8_t)(255 * c[0] + 0.5), (uint8_t)(255 * c[1] + 0.5), (uint8_t)(255 * c[2] + 0.5) };
}

/* The picture of each face's material, or its colour. */
static mr_status
wear_materials(
    mr_ctx *ctx, mr_ctx *keep, const mr_model *m, const mr_material *look, size_t count, mr_subject *s)
{
	mr_texture *texture = MR_NEW(keep, count, mr_texture);
	uint32_t *number = MR_NEW(ctx, count, uint32_t), *of = MR_NEW(keep, m->nf, uint32_t);
	mr_rgb *color = MR_NEW(keep, m->nf, mr_rgb);
	bool colored = false;

	MR_TRY(read_pictures(ctx, keep, look, count, texture, number));
	for (size_t f = 0; f < m->nf; f++) {
		const mr_material *l = m->material[f] < count ? &look[m->material[f]] : NULL;
		of[f] = l ? number[m->material[f]] : MR_NONE;
		color[f] = l && l->colored ? to_rgb(l->color) : MR_PLAIN;
		colored |= l && l->colored;
	}
	s->paint.texture = texture;
	s->paint.of = of;
	s->color = colored ? color : NULL;
	s->per_face = colored;
	return MR_OK;
}

/* The sources of a layer's paint. */
static void
take_serials(const mr_frame *f, const char *layer, uint64_t worn[4])
{
	static const char *const names[] = { "triangles", "texcoord", "corner_texcoord", "material" };

	for (int i = 0; i < 4; i++) {
		const mr_column *c = mr_frame_find(f, layer, names[i]);
		worn[i] = c ? c->serial : 0;
	}
}

/* The panel of the same layer in the frame before, if it wears what this one is to wear; or NULL. */
static const mr_panel *
dressed_before(const mr_gallery *g, const mr_panel *p)
{
	const mr_shown *f = g->frames > 1 ? &g->frame[g->frames - 2] : NULL;

	for (size_t i = 0; f && i < f->count; i++) {
		const mr_panel *q = &g->panel[f->first + i];
		if (!strcmp(q->layer, p->layer) && q->worn[0] && !memcmp(q->worn, p->worn, sizeof q->worn))
			return q;
	}
	return NULL;
}

mr_status
mr_paint_model(
    mr_ctx *ctx, mr_ctx *keep, const mr_model *m, const char *picture, const char *materials, mr_subject *s)
{
	mr_material *look;
	size_t count;

	if (m->texcoord || m->corner_texcoord)
		keep_corners(keep, m, &s->paint.uv);
	if (picture)
		return wear_one(ctx, keep, picture, m->nf, &s->paint);
	MR_TRY(mr_materials_find(ctx, m, materials, &look, &count));
	return wear_materials(ctx, keep, m, look, count, s);
}

static mr_status
paint_panel(mr_ctx *ctx, mr_ctx *keep, const mr_gallery *g, mr_frame *f, const mr_render_opts *opts,
    mr_panel *p, bool *painted)
{
	const mr_panel *before;
	mr_model m;

	*painted |= p->value || p->subject.color;
	if (p->subject.mesh.nf == 0 || p->value || p->subject.color)
		return MR_OK;
	MR_TRY(mr_model_get(ctx, f, p->layer, &m));
	if (opts->texture ? !m.texcoord && !m.corner_texcoord : !m.material)
		return MR_OK;
	*painted = true;
	take_serials(f, p->layer, p->worn);
	before = dressed_before(g, p);
	if (!before)
		return mr_paint_model(ctx, keep, &m, opts->texture, opts->materials, &p->subject);
	p->subject.paint = before->subject.paint;
	p->subject.color = before->subject.color;
	p->subject.per_face = before->subject.per_face;
	return MR_OK;
}

/* The panels of the frame that the gallery has got last. */
static mr_status
paint_frame(mr_ctx *ctx, mr_ctx *keep, mr_gallery *g, mr_frame *frame, const mr_render_opts *opts)
{
	const mr_shown *shown = &g->frame[g->frames - 1];
	bool painted = false;

	for (size_t i = shown->first; i < shown->first + shown->count; i++)
		MR_TRY(paint_panel(ctx, keep, g, frame, opts, &g->panel[i], &painted));
	return painted || !(opts->texture || opts->materials)
	           ? MR_OK
	           : mr_fail(ctx, MR_EMISSING, "no layer that is drawn has %s",
			 opts->texture ? "texture coordinates" : "materials");
}

mr_status
mr_gallery_add_painted(mr_ctx *ctx, mr_ctx *keep, mr_gallery *g, mr_frame *frame, const mr_render_opts *opts)
{
	mr_status status;

	MR_TRY(mr_gallery_add(ctx, keep, g, frame, opts));
	if (!opts->texture && !opts->materials && !mr_frame_has_files(frame))
		return MR_OK;
	status = paint_frame(ctx, keep, g, frame, opts);
	if (status < 0)
		g->panels = g->frame[--g->frames].first;
	return status;
}
