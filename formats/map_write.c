/* Heights over a control mesh as a picture (Lee, Moreton, Hoppe 2000), and normals of the surface as another.
 */
#include "base/options.h"
#include "base/parallel.h"
#include "base/text.h"
#include "formats/build.h"
#include "formats/bytes.h"
#include "formats/filename.h"
#include "formats/map.h"
#include "formats/materials.h"
#include "formats/scan.h"
#include "render/bake.h"

enum { GRAIN = 16 };

/* Control at work, its heights, and where they go. */
typedef struct mapping {
	mr_mesh control;
	const double *height;
	mr_domain domain;
	mr_atlas atlas;
	double low, high;
	size_t *count; /* of each row: heights out of the range */
	mr_gray gray;
} mapping;

/* ---- heights ---- */

static double
height_of(const mapping *m, const mr_texel *t)
{
	return m->height[t->v[0]] + m->height[t->v[1]] - m->height[t->v[2]];
}

/* The texels of the gutter, too. */
static void
find_range(mapping *m)
{
	m->low = INFINITY;
	m->high = -INFINITY;
	for (size_t y = 0; y < m->atlas.height; y++)
		for (size_t x = 0; x < m->atlas.width; x++) {
			mr_texel t = mr_atlas_texel(&m->atlas, x, y);
			if (t.face == MR_NONE)
				continue;
			m->low = fmin(m->low, height_of(m, &t));
			m->high = fmax(m->high, height_of(m, &t));
		}
}

static double
quantised(const mapping *m, uint32_t v)
{
	double q = m->high > m->low ? floor((m->height[v] - m->low) / (m->high - m->low) * MR_MAP_WHITE + 0.5)
	                            : 0;

	return q > 0 ? q < MR_MAP_WHITE ? q : MR_MAP_WHITE : 0;
}

/* Extrapolates the gutter from the written texels: then samples are linear to the bit. */
static uint16_t
gray_of(const mapping *m, const mr_texel *t)
{
	double q = quantised(m, t->v[0]);

	if (t->v[1] != t->v[2])
		q += quantised(m, t->v[1]) - quantised(m, t->v[2]);
	return (uint16_t)(q > 0 ? q < MR_MAP_WHITE ? q : MR_MAP_WHITE : 0);
}

static void
draw_heights(void *arg, size_t begin, size_t end)
{
	mapping *m = arg;

	for (size_t y = begin; y < end; y++) {
		m->count[y] = 0;
		for (size_t x = 0; x < m->atlas.width; x++) {
			mr_texel t = mr_atlas_texel(&m->atlas, x, y);
			bool drawn = t.face != MR_NONE;
			double h = drawn ? height_of(m, &t) : 0;
			m->gray.pixel[y * m->gray.width + x] = drawn ? gray_of(m, &t) : 0;
			m->count[y] += drawn && t.v[1] == t.v[2] && (h < m->low || h > m->high);
		}
	}
}

static size_t
count_rows(const mapping *m)
{
	size_t n = 0;

	for (size_t y = 0; y < m->atlas.height; y++)
		n += m->count[y];
	return n;
}

/* Numbers with a blank between them, as a text. */
static const char *
numbers(mr_ctx *ctx, double a, double b)
{
	char text[2 * MR_REAL_MAX + 2], *end = mr_real_write(text, a);

	*end++ = ' ';
	end = mr_real_write(end, b);
	return mr_format(ctx, "%.*s", (int)(end - text), text);
}

static mr_status
write_heights(mr_ctx *ctx, mapping *m, const char *path)
{
	mr_png_text text[] = { { MR_MAP_LEVEL, mr_format(ctx, "%zu", m->atlas.level) },
		{ MR_MAP_RANGE, numbers(ctx, m->low, m->high) },
		{ MR_MAP_SIZE, numbers(ctx, (double)m->atlas.width, (double)m->atlas.height) } };
	MR_SCOPE(ctx);

	m->gray = (mr_gray){ .width = m->atlas.width, .height = m->atlas.height, .text = text, .texts = 3 };
	m->gray.pixel = MR_NEW(ctx, m->gray.width * m->gray.height, uint16_t);
	mr_parallel(ctx, m->atlas.height, GRAIN, draw_heights, m);
	return mr_png_write_gray(ctx, path, &m->gray);
}

/* ---- normals ---- */

void
mr_map_displace(mr_ctx *ctx, const mr_domain *d, const double *height, mr_bake_target *t)
{
	mr_v3 *p = MR_NEW(ctx, d->m.nv, mr_v3), *n = MR_NEW(ctx, d->m.nv, mr_v3);
	mr_v3 *corner = MR_NEW(ctx, 3 * t->m.nf, mr_v3);

	mr_domain_displace(ctx, d, height, 1, p);
	t->fine = d->m;
	t->fine.p = p;
	mr_vertex_normals(&t->fine, n);
	t->fine_normal = n;
	for (size_t c = 0; c < 3 * t->m.nf; c++)
		corner[c] = d->normal[t->m.t[c / 3].v[c % 3]];
	t->normal = corner;
}

static mr_status
write_normals(mr_ctx *ctx, const mapping *m, const char *path, size_t *turned)
{
	mr_bake_source none = { 0 };
	mr_bake_target t = { .m = m->control,
		.uv = mr_map_texcoords(ctx, &m->atlas),
		.grid = m->atlas,
		.width = m->atlas.width,
		.height = m->atlas.height,
		.gutter = m->atlas.gutter };
	mr_baked baked;
	MR_SCOPE(ctx);

	mr_map_displace(ctx, &m->domain, m->height, &t);
	MR_TRY(mr_bake_draw(ctx, &none, &t, &baked));
	*turned = baked.turned;
	return mr_png_write(ctx, path, &baked.normal);
}

/* ---- what names the pictures ---- */

double *
mr_map_texcoords(mr_ctx *ctx, const mr_atlas *a)
{
	double *uv = MR_NEW(ctx, 6 * a->faces, double);

	for (size_t face = 0; face < a->faces; face++)
		mr_atlas_texcoords(a, face, uv + 6 * face);
	return uv;
}

mr_status
mr_map_put_material(
    mr_ctx *ctx, mr_frame *f, const char *layer, size_t nf, const double *uv, const char *name)
{
	static const char *const columns[] = { "material", "texcoord", "corner_texcoord" };
	uint32_t *material = MR_NEW_ZERO(ctx, nf, uint32_t);
	char *file = mr_format(ctx, "%s.mtl", mr_file_name(name));
	size_t bytes = mr_clean_name(file, file, strlen(file), false);

	for (size_t i = 0; i < (uv ? 3 : 1); i++)
		mr_lost(ctx, layer, mr_layer_has(f, layer, columns[i]), columns[i]);
	if (uv) {
		mr_frame_drop(f, layer, "texcoord", 0);
		mr_frame_drop(f, layer, "polygon", 0); /* whose corners might have several */
		MR_TRY(mr_layer_put(ctx, f, layer, "corner_texcoord", uv, nf));
	}
	MR_TRY(mr_layer_put(ctx, f, layer, "material", material, nf));
	MR_TRY(mr_layer_put(ctx, f, layer, "materials", file, bytes - strlen(".mtl")));
	return mr_layer_put(ctx, f, layer, "mtllib", file, bytes);
}

/* ---- writing ---- */

mr_status
mr_map_check_name(mr_ctx *ctx, const char *name)
{
	for (const char *c = name; *c; c++)
		if ((unsigned char)*c < ' ')
			return mr_fail(ctx, MR_EUSAGE, "the name of a map has byte %d", *c);
	return *mr_file_name(name) ? MR_OK : mr_fail(ctx, MR_EUSAGE, "%s names no file", *name ? name : "''");
}

static mr_status
prepare(mr_ctx *ctx, mr_frame *f, const mr_map_opts *o, mapping *m)
{
	size_t n;

	MR_TRY(mr_check_number(ctx, "side", (double)o->side, 1, 32767));
	MR_TRY(mr_check_number(ctx, "gutter", (double)o->gutter, 1, 256));
	if (o->ranged && !(o->low < o->high))
		return mr_fail(ctx, MR_EUSAGE, "the range %g to %g is none", o->low, o->high);
	MR_TRY(mr_layer_mesh(ctx, f, "control", &m->control));
	MR_TRY(mr_displacement_get(ctx, f, &m->control, &n, &m->height));
	if (o->level != MR_UNKNOWN && o->level > n)
		return mr_fail(
		    ctx, MR_ERANGE, "--level %zu, but displacement ends with level %zu", o->level, n);
	n = o->level == MR_UNKNOWN ? n : o->level;
	MR_TRY(mr_prefix(
	    ctx, mr_atlas_plan(ctx, m->control.nf, n, o->gutter, o->side, &m->atlas), "displacement"));
	MR_TRY(mr_domain_of(ctx, f, &m->control, n, &m->domain));
	mr_atlas_fill(ctx, m->domain.m.t, &m->atlas);
	m->count = MR_NEW(ctx, m->atlas.height, size_t);
	m->low = o->low;
	m->high = o->high;
	if (!o->ranged)
		find_range(m);
	return isfinite(m->high - m->low)
	           ? MR_OK
	           : mr_fail(ctx, MR_ERANGE, "displacement: no picture holds heights from %g to %g", m->low,
			 m->high);
}

static mr_status
write_files(mr_ctx *ctx, mapping *m, const char *name, mr_map_result *found)
{
	const char *heights = mr_format(ctx, "%s-height.png", name);
	const char *normals = mr_format(ctx, "%s-normal.png", name), *file = mr_file_name(name);

	MR_TRY(mr_library_check(ctx, name, NULL));
	MR_TRY(write_heights(ctx, m, heights));
	found->clipped = count_rows(m);
	MR_TRY(write_normals(ctx, m, normals, &found->turned));
	/* disp and its option -mm (Wavefront, "Advanced Visualizer", appendix B2): a texel's value is times
	 * the gain and plus the base.  norm is what programs of today add. */
	MR_TRY(mr_library_write(ctx, name,
	    mr_format(ctx, "newmtl %s\nKd 0.8 0.8 0.8\nnorm %s-normal.png\ndisp -mm %s %s-height.png\n", file,
		file, numbers(ctx, m->low, m->high - m->low), file)));
	mr_tell(ctx, MR_ROUNDED, found->clipped, "heights of texels");
	return MR_OK;
}

static mr_status
write_map(mr_ctx *ctx, mr_frame *f, const char *name, const mr_map_opts *o, mr_map_result *r)
{
	mapping m;

	mr_unmeasured(r, sizeof *r);
	MR_TRY(mr_map_check_name(ctx, name));
	MR_TRY(prepare(ctx, f, o, &m));
	if (f->key && mr_layer_has(f, "mesh", "detail_face"))
		mr_lost(ctx, "base", 1, "the pose");
	MR_TRY(write_files(ctx, &m, name, r));
	MR_TRY(mr_map_put_material(ctx, f, "control", m.control.nf, mr_map_texcoords(ctx, &m.atlas), name));
	/* Control's limit normals, between which the texels' normals are interpolated. */
	mr_frame_drop(f, "control", "corner_normal", 0);
	MR_TRY(mr_layer_put(ctx, f, "control", "normal", m.domain.normal, m.control.nv));
	MR_TRY(mr_map_put_range(ctx, f, m.low, m.high));
	r->level = m.atlas.level;
	r->width = m.atlas.width;
	r->height = m.atlas.height;
	r->low = m.low;
	r->high = m.high;
	return MR_OK;
}

mr_status
mr_map_write(mr_ctx *ctx, mr_frame *f, const char *name, const mr_map_opts *opts, mr_map_result *result)
{
	mr_map_result r;

	MR_ON_COPY(ctx, f, done, result, r,
	    write_map(ctx, &done, name, opts ? opts : &(mr_map_opts)MR_MAP_DEFAULTS, &r));
}
