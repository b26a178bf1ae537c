/* Bakes the colours and normals of a surface or cloud into pictures for another surface. */
#include "render/bake.h"

#include "base/options.h"
#include "base/parallel.h"
#include "base/text.h"
#include "formats/bytes.h"
#include "formats/filename.h"
#include "formats/image.h"
#include "formats/map.h"
#include "formats/materials.h"
#include "formats/paint.h"
#include "render/charts.h"

/* ---- the source ---- */

static mr_v3 *
unit_normals(mr_ctx *ctx, const mr_v3 *n, size_t count)
{
	mr_v3 *unit = MR_NEW(ctx, count, mr_v3);

	for (size_t i = 0; i < count; i++)
		unit[i] = mr_unit(n[i]);
	return unit;
}

static mr_rgb *
colors_of(mr_ctx *ctx, const mr_model *m)
{
	mr_rgb *color = MR_NEW(ctx, m->nv, mr_rgb);

	for (size_t i = 0; i < m->nv; i++)
		color[i] = (mr_rgb){ m->color[4 * i], m->color[4 * i + 1], m->color[4 * i + 2] };
	return color;
}

static bool
is_painted(const mr_subject *s)
{
	for (size_t f = 0; s->paint.of && s->paint.uv && f < s->mesh.nf; f++)
		if (s->paint.of[f] != MR_NONE)
			return true;
	return false;
}

/* Pictures go before colours of vertices, and those before colours of materials. */
static mr_status
find_source(mr_ctx *ctx, mr_frame *f, const mr_bake_opts *o, mr_bake_source *s)
{
	const char *layer;
	mr_model m;

	MR_TRY(mr_layer_result(ctx, f, NULL, &layer));
	MR_TRY(mr_layer_surface_or_points(ctx, f, layer, &s->look.mesh));
	MR_TRY(mr_model_get(ctx, f, layer, &m));
	s->look.normal = m.normal ? unit_normals(ctx, m.normal, m.nv) : NULL;
	s->corner_normal = m.corner_normal ? unit_normals(ctx, m.corner_normal, 3 * m.nf) : NULL;
	if (o->texture && !m.texcoord && !m.corner_texcoord)
		return mr_fail(ctx, MR_EMISSING, "%s has no texture coordinates for %s", layer, o->texture);
	if (m.nf && (o->texture || m.material))
		MR_TRY(mr_paint_model(ctx, ctx, &m, o->texture, o->materials, &s->look));
	if (m.color) {
		s->look.color = colors_of(ctx, &m);
		s->look.per_face = false;
	}
	s->colored = s->look.color || is_painted(&s->look);
	if (!s->colored && m.nf && (m.texcoord || m.corner_texcoord || m.mtllib.bytes))
		return mr_fail(ctx, MR_EMISSING,
		    "the source's %s has texture coordinates or materials, but neither a picture nor colours",
		    layer);
	return MR_OK;
}

/* ---- the target ---- */

static const double *
own_texcoords(mr_ctx *ctx, const mr_model *m)
{
	double *uv = MR_NEW(ctx, 6 * m->nf, double);

	if (!m->texcoord && !m->corner_texcoord)
		return NULL;
	for (size_t c = 0; c < 3 * m->nf; c++) {
		memcpy(uv + 2 * c, mr_corner_texcoord(m, c), 2 * sizeof *uv);
		if (!(uv[2 * c] >= 0 && uv[2 * c] <= 1 && uv[2 * c + 1] >= 0 && uv[2 * c + 1] <= 1))
			return NULL;
	}
	return uv;
}

/* Texture coordinates of its own that serve, or charts. */
static mr_status
find_texture(mr_ctx *ctx, const mr_model *m, const mr_bake_opts *o, mr_bake_target *t, mr_map_result *r)
{
	const double some = 1e-3; /* of the texels: what rounding leaves of a seam */
	const double *uv = own_texcoords(ctx, m);
	double *made;

	t->width = t->height = o->side;
	r->charts = 0;
	if (uv && mr_texture_overlap(ctx, t->m.nf, uv, o->side, NULL, NULL) < some) {
		t->uv = uv;
	} else {
		MR_TRY(mr_charts(ctx, &t->m, o->side, o->gutter, &made, &r->charts));
		t->uv = made;
	}
	return MR_OK;
}

/* The displaced surface, and control's limit normals, which it gets. */
static mr_status
find_displaced(mr_ctx *ctx, mr_frame *f, mr_bake_target *t)
{
	const double *height;
	mr_domain d;
	size_t level;

	MR_TRY(mr_displacement_get(ctx, f, &t->m, &level, &height));
	MR_TRY(mr_domain_of(ctx, f, &t->m, level, &d));
	t->grid = (mr_atlas){ .faces = t->m.nf, .level = level, .segments = (size_t)1 << level };
	mr_atlas_fill(ctx, d.m.t, &t->grid);
	mr_map_displace(ctx, &d, height, t);
	mr_frame_drop(f, "control", "corner_normal", 0);
	return mr_layer_put(ctx, f, "control", "normal", d.normal, t->m.nv);
}

/* The normals that the target is shaded with: its own, else the means of its faces' normals, which it
 * gets. */
static mr_status
find_normals(mr_ctx *ctx, mr_frame *f, const char *layer, const mr_model *m, mr_bake_target *t)
{
	const mr_v3 *vertex = m->normal;
	mr_v3 *unit = MR_NEW(ctx, 3 * t->m.nf, mr_v3), *made = NULL;

	if (!vertex) {
		made = MR_NEW(ctx, t->m.nv, mr_v3);
		mr_vertex_normals(&t->m, made);
		vertex = made;
	}
	for (size_t c = 0; c < 3 * t->m.nf; c++) {
		const mr_v3 *own = m->corner_normal ? &m->corner_normal[c] : NULL;
		unit[c] = mr_unit(own && mr_norm2(*own) > 0 ? *own : vertex[t->m.t[c / 3].v[c % 3]]);
	}
	t->normal = unit;
	return made && !m->corner_normal ? mr_layer_put(ctx, f, layer, "normal", made, t->m.nv) : MR_OK;
}

/* ---- all ---- */

static mr_status
write_picture(mr_ctx *ctx, const mr_image *image, const char *name, const char *what)
{
	return image->pixel ? mr_png_write(ctx, mr_format(ctx, "%s-%s.png", name, what), image) : MR_OK;
}

static mr_status
write_files(mr_ctx *ctx, const mr_baked *b, const char *name)
{
	const char *file = mr_file_name(name);

	MR_TRY(mr_library_check(ctx, name, NULL));
	MR_TRY(write_picture(ctx, &b->color, name, "color"));
	MR_TRY(write_picture(ctx, &b->normal, name, "normal"));
	return mr_library_write(ctx, name,
	    mr_format(ctx, "newmtl %s\nKd 1 1 1\n%s%s", file,
		b->color.pixel ? mr_format(ctx, "map_Kd %s-color.png\n", file) : "",
		b->normal.pixel ? mr_format(ctx, "norm %s-normal.png\n", file) : ""));
}

static mr_status
bake(mr_ctx *ctx, mr_frame *f, mr_frame *from, const char *name, const mr_bake_opts *o, mr_map_result *r)
{
	const char *layer = o->layer;
	mr_bake_source source = { 0 };
	mr_bake_target target = { .gutter = o->gutter };
	mr_baked baked;
	mr_model m;
	bool displaced;

	mr_unmeasured(r, sizeof *r);
	MR_TRY(mr_check_number(ctx, "side", (double)o->side, 1, 32767));
	MR_TRY(mr_check_number(ctx, "gutter", (double)o->gutter, 1, 256));
	MR_TRY(mr_map_check_name(ctx, name));
	displaced = mr_layer_has(f, "displacement", "height") && (!layer || !strcmp(layer, "control"));
	MR_TRY(mr_layer_result(ctx, f, displaced ? "control" : layer, &layer));
	MR_TRY(mr_layer_mesh(ctx, f, layer, &target.m));
	MR_TRY(mr_model_get(ctx, f, layer, &m));
	MR_TRY(find_source(ctx, from, o, &source));
	MR_TRY(find_texture(ctx, &m, o, &target, r));
	MR_TRY(displaced ? find_displaced(ctx, f, &target) : find_normals(ctx, f, layer, &m, &target));
	if (!source.colored && !source.look.mesh.nf && !source.look.normal && !target.fine.nf)
		return mr_fail(ctx, MR_EMISSING, "the source has neither colours nor normals");
	MR_TRY(mr_bake_draw(ctx, &source, &target, &baked));
	MR_TRY(write_files(ctx, &baked, name));
	if (baked.color.pixel) /* viewers multiply the two */
		mr_frame_drop(f, layer, "color", 0);
	MR_TRY(mr_map_put_material(ctx, f, layer, target.m.nf, r->charts ? target.uv : NULL, name));
	r->width = target.width;
	r->height = target.height;
	r->texels = baked.texels;
	r->turned = baked.turned;
	return MR_OK;
}

mr_status
mr_bake(mr_ctx *ctx, mr_frame *f, mr_frame *from, const char *name, const mr_bake_opts *opts,
    mr_map_result *result)
{
	mr_map_result r;

	MR_ON_COPY(ctx, f, done, result, r,
	    bake(ctx, &done, from, name, opts ? opts : &(mr_bake_opts)MR_BAKE_DEFAULTS, &r));
}
