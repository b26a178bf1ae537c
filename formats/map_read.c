/* The heights in a picture over a control mesh, by its texture coordinates. */
#include "formats/map.h"
#include "formats/model.h"
#include "formats/scan.h"

/* The numbers of the picture's text under a key: so many, and nothing else. */
static bool
says(const mr_gray *g, const char *key, size_t n, double *x)
{
	const char *p = NULL, *end;

	for (size_t i = 0; i < g->texts && !p; i++)
		if (!strcmp(g->text[i].key, key))
			p = g->text[i].text;
	end = p ? p + strlen(p) : NULL;
	for (size_t i = 0; p && i < n; i++) {
		p += *p == ' ';
		p = mr_real_read(p, end, &x[i]);
	}
	return p && p == end;
}

static mr_status
unsaid(mr_ctx *ctx, const char *key, const char *option)
{
	return mr_fail(ctx, MR_EFORMAT, "no text \"%s\" that mr-map wrote: give %s", key, option);
}

/* The picture's meaning, by the options, else by its texts. */
static mr_status
understand(mr_ctx *ctx, const mr_gray *g, const mr_map_opts *o, double range[2], size_t *level)
{
	bool told = o->level != MR_UNKNOWN && o->ranged;
	double n = (double)o->level, size[2];

	if (o->level == MR_UNKNOWN && !says(g, MR_MAP_LEVEL, 1, &n))
		return unsaid(ctx, MR_MAP_LEVEL, "--level");
	if (!(n >= 0 && n <= MR_LEVEL_MAX && n == floor(n)))
		return mr_fail(ctx, MR_ERANGE, "level %g of at most %d", n, MR_LEVEL_MAX);
	range[0] = o->low;
	range[1] = o->high;
	if (!o->ranged && !says(g, MR_MAP_RANGE, 2, range))
		return unsaid(ctx, MR_MAP_RANGE, "--range");
	if (!isfinite(range[0]) || !isfinite(range[1]) || range[0] > range[1])
		return mr_fail(ctx, MR_ERANGE, "the range %g to %g is none", range[0], range[1]);
	if (!told && says(g, MR_MAP_SIZE, 2, size) &&
	    (size[0] != (double)g->width || size[1] != (double)g->height))
		return mr_fail(ctx, MR_EFORMAT,
		    "the picture has %zux%zu texels and was written with %gx%g: its heights have been "
		    "resampled",
		    g->width, g->height, size[0], size[1]);
	*level = (size_t)n;
	return MR_OK;
}

mr_status
mr_map_put_range(mr_ctx *ctx, mr_frame *f, double low, double high)
{
	double *range = MR_NEW(ctx, 2, double);

	range[0] = low;
	range[1] = high;
	return mr_layer_put(ctx, f, "displacement", "range", range, 1);
}

/* A place in texels, 0 the centre of the first; the centre of one where it is so near that floats put it
 * there: 1 / 32767 of a picture is 2^-15, and they keep 24 bits. */
static double
to_texels(double share, size_t texels, bool *between)
{
	const double near = 1.0 / 64;
	double x = share * (double)texels - 0.5, whole = round(x);

	*between |= fabs(x - whole) > near;
	x = fabs(x - whole) > near ? x : whole;
	return x > 0 ? x < (double)(texels - 1) ? x : (double)(texels - 1) : 0;
}

/* Bilinear: at the centre of a texel, its value. */
static double
sample(const mr_gray *g, double u, double v, bool *between)
{
	double x = to_texels(u, g->width, between), y = to_texels(1 - v, g->height, between);
	size_t i = (size_t)x, j = (size_t)y, right = i + (i + 1 < g->width), below = j + (j + 1 < g->height);
	double s = x - (double)i, t = y - (double)j;
	const uint16_t *top = g->pixel + j * g->width, *bottom = g->pixel + below * g->width;

	return (1 - t) * ((1 - s) * top[i] + s * top[right]) + t * ((1 - s) * bottom[i] + s * bottom[right]);
}

/* The values of a vertex's texels, one in each control triangle that it is on. */
typedef struct gathered {
	double sum, least, greatest;
	uint32_t count;
	bool between;
} gathered;

static void
gather(gathered *v, double value, bool between)
{
	v->least = v->count && v->least < value ? v->least : value;
	v->greatest = v->count && v->greatest > value ? v->greatest : value;
	v->sum += value;
	v->count++;
	v->between |= between;
}

/* The texture coordinates of control's corners, all in the picture. */
static mr_status
get_texcoords(mr_ctx *ctx, mr_frame *f, mr_model *m)
{
	MR_TRY(mr_model_get(ctx, f, "control", m));
	if (!m->texcoord && !m->corner_texcoord)
		return mr_fail(ctx, MR_EMISSING, "control has no texture coordinates");
	for (size_t c = 0; c < 3 * m->nf; c++) {
		const double *uv = mr_corner_texcoord(m, c);
		if (!uv || !(uv[0] >= 0 && uv[0] <= 1 && uv[1] >= 0 && uv[1] <= 1))
			return mr_fail(ctx, MR_ERANGE,
			    "control: corner %zu of face %zu has texture coordinates outside of 0 to 1, or "
			    "none",
			    c % 3, c / 3);
	}
	return MR_OK;
}

static void
sample_all(const mr_gray *g, const mr_model *m, const mr_loop *l, size_t n, gathered *of)
{
	for (size_t f = 0; f < l->nf; f++) {
		const double *uv[3];
		mr_v3 at[3];
		mr_loop_corners(n, f, at);
		for (size_t k = 0; k < 3; k++)
			uv[k] = mr_corner_texcoord(m, 3 * (f >> 2 * n) + k);
		for (int k = 0; k < 3; k++) {
			double u = at[k].x * uv[0][0] + at[k].y * uv[1][0] + at[k].z * uv[2][0];
			double v = at[k].x * uv[0][1] + at[k].y * uv[1][1] + at[k].z * uv[2][1];
			bool between = false;
			double value = sample(g, u, v, &between);
			gather(&of[l->t[f].v[k]], value, between);
		}
	}
}

/* Vertices have the mean of their texels; black and white are the ends of the range to the bit. */
static void
take_heights(const gathered *of, size_t nv, const double range[2], double *height, mr_map_result *found)
{
	found->seams = found->between = 0;
	for (size_t i = 0; i < nv; i++) {
		double share = of[i].count ? of[i].sum / of[i].count / MR_MAP_WHITE : 0;
		height[i] = of[i].count ? (1 - share) * range[0] + share * range[1] : 0;
		found->seams += of[i].greatest - of[i].least > 1;
		found->between += of[i].between;
	}
}

static mr_status
read_heights(mr_ctx *ctx, const mr_gray *g, const mr_mesh *control, const mr_model *m, const double range[2],
    mr_domain *d, double **height, mr_map_result *found)
{
	mr_loop *level = MR_NEW(ctx, found->level + 1, mr_loop);
	gathered *of;

	MR_TRY(mr_loop_levels(ctx, control, 180, NULL, found->level, level));
	d->n = found->level;
	d->m.nv = level[d->n].nv;
	*height = MR_NEW(ctx, d->m.nv, double);
	of = MR_NEW_ZERO(ctx, d->m.nv, gathered);
	sample_all(g, m, &level[d->n], d->n, of);
	take_heights(of, d->m.nv, range, *height, found);
	mr_tell(ctx, MR_ROUNDED, found->between, "vertices beside the centre of a texel");
	mr_tell(ctx, MR_ROUNDED, found->seams, "vertices with several heights at a seam");
	return MR_OK;
}

static mr_status
read_map(mr_ctx *ctx, mr_frame *f, const char *path, const mr_map_opts *o, mr_map_result *r)
{
	double range[2] = { 0, 0 }, *height;
	mr_mesh control;
	mr_domain d;
	mr_model m;
	mr_gray g;

	mr_unmeasured(r, sizeof *r);
	MR_TRY(mr_layer_mesh(ctx, f, "control", &control));
	MR_TRY(get_texcoords(ctx, f, &m));
	MR_TRY(mr_png_read_gray(ctx, path, &g));
	MR_TRY(mr_prefix(ctx, understand(ctx, &g, o, range, &r->level), "%s", path));
	MR_TRY(read_heights(ctx, &g, &control, &m, range, &d, &height, r));
	MR_TRY(mr_displacement_put(ctx, f, &d, height));
	MR_TRY(mr_map_put_range(ctx, f, range[0], range[1]));
	r->width = g.width;
	r->height = g.height;
	r->low = range[0];
	r->high = range[1];
	return MR_OK;
}

mr_status
mr_map_read(mr_ctx *ctx, mr_frame *f, const char *path, const mr_map_opts *opts, mr_map_result *result)
{
	mr_map_result r;

	MR_ON_COPY(ctx, f, done, result, r,
	    read_map(ctx, &done, path, opts ? opts : &(mr_map_opts)MR_MAP_DEFAULTS, &r));
}
