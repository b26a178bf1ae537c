/* Colours of visible points: three lights and a bright sky over a matte surface, in linear values. */
#include "render/raster_parts.h"

#include "base/parallel.h"
#include "mesh/creases.h"

static const mr_rgb INSIDE = { 126, 150, 190 }, LINE = { 38, 42, 50 };

enum { LEVELS = 4096 };

/* The sums of a pixel's samples. */
typedef struct gathered {
	float r, g, b; /* light, summed over the samples that see something */
	float share;   /* of the samples that do */
} gathered;

typedef struct shading {
	const mr_raster_view *v;
	mr_creases creases;
	double linear[256];   /* of an sRGB value */
	uint8_t srgb[LEVELS]; /* of a linear value, in LEVELS steps */
} shading;

static void
prepare_tables(shading *s)
{
	for (int i = 0; i < 256; i++) {
		double c = i / 255.0;
		s->linear[i] = c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4);
	}
	for (int i = 0; i < LEVELS; i++) {
		double c = (i + 0.5) / LEVELS;
		c = c <= 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1 / 2.4) - 0.055;
		s->srgb[i] = (uint8_t)(255 * c + 0.5);
	}
}

static mr_v3
to_linear(const shading *s, mr_rgb c)
{
	return mr_vec(s->linear[c.r], s->linear[c.g], s->linear[c.b]);
}

static uint8_t
to_srgb(const shading *s, double c)
{
	return s->srgb[c > 0 ? c < 1 ? (size_t)(c * LEVELS) : LEVELS - 1 : 0];
}

/* A face set up for shading: kept while a row stays on it. */
typedef struct facet {
	uint32_t face;
	bool back;
	mr_placed p[3];
	mr_v3 normal[3], color[3];
	double area, length[3];    /* of edges, in steps */
	double fade;               /* of edges, on faces of few pixels */
	const mr_texture *texture; /* NULL: none */
	const double *uv;          /* of the corners */
	int level;                 /* of the texture */
} facet;

static mr_v3
item_color(const shading *s, size_t vertex, size_t face)
{
	const mr_subject *o = s->v->subject;

	return to_linear(s, o->color ? o->color[o->per_face ? face : vertex] : MR_PLAIN);
}

/* The picture of a face, as large as it is seen. */
static void
set_up_texture(const shading *s, uint32_t face, facet *f)
{
	const mr_paint *p = &s->v->subject->paint;
	const double *uv = p->uv ? p->uv + 6 * (size_t)face : NULL;
	const mr_image *image;
	double twice;

	f->texture = NULL;
	if (!uv || p->of[face] == MR_NONE || isnan(uv[0] + uv[1] + uv[2] + uv[3] + uv[4] + uv[5]))
		return;
	f->texture = p->texture + p->of[face];
	f->uv = uv;
	image = f->texture->level;
	twice = (uv[2] - uv[0]) * (uv[5] - uv[1]) - (uv[3] - uv[1]) * (uv[4] - uv[0]);
	f->level = mr_texture_level(
	    f->texture, fabs(twice) * (double)(image->width * image->height), fabs(f->area) / (STEP * STEP));
}

static mr_v3
texture_color(const shading *s, const facet *f, const double w[3], double sum)
{
	mr_v3 color = mr_vec(0, 0, 0);
	double u = 0, v = 0;
	mr_texels t;

	for (int i = 0; i < 3; i++) {
		u += w[i] / sum * f->uv[2 * i];
		v += w[i] / sum * f->uv[2 * i + 1];
	}
	t = mr_texture_at(f->texture, f->level, u, v);
	for (int i = 0; i < 4; i++)
		color = mr_axpy(t.weight[i], to_linear(s, t.color[i]), color);
	return color;
}

static void
set_up_face(const shading *s, uint32_t face, facet *f)
{
	const mr_mesh *m = &s->v->subject->mesh;
	const uint32_t *t = m->t[face].v;
	double longest = 0;

	f->face = face;
	for (int i = 0; i < 3; i++) {
		f->p[i] = s->v->at[t[i]];
		f->color[i] = item_color(s, t[i], face);
		f->normal[i] = mr_corner_normal(&s->creases, face, i);
	}
	f->area = (double)(f->p[1].x - f->p[0].x) * (double)(f->p[2].y - f->p[0].y) -
	          (double)(f->p[1].y - f->p[0].y) * (double)(f->p[2].x - f->p[0].x);
	f->back = f->area > 0; /* y points down */
	set_up_texture(s, face, f);
	for (int i = 0; i < 3; i++) {
		const mr_placed *a = &f->p[(i + 1) % 3], *b = &f->p[(i + 2) % 3];
		f->length[i] = sqrt(
		    (double)(b->x - a->x) * (b->x - a->x) + (double)(b->y - a->y) * (b->y - a->y));
		longest = fmax(longest, f->length[i]);
		if (f->back && !s->v->subject->color)
			f->color[i] = to_linear(s, INSIDE);
	}
	f->fade = fabs(f->area) / longest / (double)(STEP * SAMPLES) / 7; /* the height in pixels */
	f->fade = f->fade < 1 ? f->fade : 1;
}

/* The light from all directions on a normal, given along the camera's axes. */
static double
light_on(mr_v3 n)
{
	static const mr_v3 key = { -0.478, 0.640, 0.602 }, fill = { 0.800, 0.100, 0.592 },
			   rim = { 0.350, 0.550, -0.758 };
	double sky = 0.27 + 0.10 * n.y;
	double a = (mr_dot(n, key) + 0.12) / 1.12, b = mr_dot(n, fill), c = mr_dot(n, rim);

	return sky + 0.80 * (a > 0 ? a : 0) + 0.16 * (b > 0 ? b : 0) + 0.22 * (c > 0 ? c : 0);
}

/* A soft gleam of the key light (Blinn 1977). */
static double
gleam_on(mr_v3 n)
{
	static const mr_v3 half = { -0.267, 0.358, 0.895 };
	double h = mr_dot(n, half), h4;

	if (h <= 0)
		return 0;
	h4 = h * h * h * h;
	return 0.07 * h4 * h4 * h4 * h4 * h4 * h4;
}

/* Adds what one sample sees, with normal n (any length) along the camera's axes. */
static void
gather(gathered *g, mr_v3 color, mr_v3 n, double line, mr_v3 line_color)
{
	double light, gleam;

	n = mr_unit(n);
	if (n.z < 0.02) /* an interpolated normal may point away from the eye: bring it to the rim */
		n = mr_unit(mr_vec(n.x, n.y, 0.02));
	light = light_on(n);
	gleam = gleam_on(n);
	color = mr_add(mr_mul(light, color), mr_vec(gleam, gleam, gleam));
	color = mr_lerp(line, color, line_color);
	g->r += (float)color.x;
	g->g += (float)color.y;
	g->b += (float)color.z;
	g->share += 1;
}

/* How dark an edge is at the distances e over length from the edges, in steps. */
static double
line_at(const facet *f, const int64_t e[3])
{
	const double half = 0.55, pixel = (double)(STEP * SAMPLES);
	double d = INFINITY, share;

	for (int i = 0; i < 3; i++)
		d = fmin(d, fabs((double)e[i]) / (f->length[i] * pixel));
	share = half + 0.5 - d;
	return share > 0 ? 0.8 * f->fade * (share < 1 ? share : 1) : 0;
}

static void
shade_face_sample(const shading *s, facet *f, size_t at, size_t x, size_t y, gathered *g)
{
	const mr_camera *c = s->v->camera;
	double w[3], sum = 0, line = 0;
	mr_v3 n, color;
	int64_t e[3];
	int top;

	if (f->face != s->v->item[at])
		set_up_face(s, s->v->item[at], f);
	edge_functions(f->p, (int64_t)x * STEP + STEP / 2, (int64_t)y * STEP + STEP / 2, e);
	for (int i = 0; i < 3; i++) { /* weights linear in space, not in the picture */
		w[i] = fabs((double)e[i]) * (double)f->p[i].near;
		sum += w[i];
	}
	top = w[0] >= w[1] ? (w[0] >= w[2] ? 0 : 2) : (w[1] >= w[2] ? 1 : 2);
	n = mr_add(
	    mr_mul(w[0], f->normal[0]), mr_add(mr_mul(w[1], f->normal[1]), mr_mul(w[2], f->normal[2])));
	if (f->texture)
		color = texture_color(s, f, w, sum);
	else if (s->v->subject->nearest)
		color = f->color[top];
	else
		color = mr_mul(1 / sum, mr_add(mr_mul(w[0], f->color[0]),
					    mr_add(mr_mul(w[1], f->color[1]), mr_mul(w[2], f->color[2]))));
	if (f->back)
		n = mr_mul(-1, n);
	if (f->back && (s->v->subject->color || f->texture)) /* the inside keeps its colour, bluish */
		color = mr_lerp(0.5, color, to_linear(s, INSIDE));
	if (s->v->wire)
		line = line_at(f, e);
	gather(g, color, mr_vec(mr_dot(n, c->right), mr_dot(n, c->up), mr_dot(n, c->toward)), line,
	    to_linear(s, LINE));
}

/* A ball; where the surface's normal is known, mostly lit as the surface is. */
static void
shade_point_sample(const shading *s, size_t at, size_t x, size_t y, gathered *g)
{
	const mr_camera *c = s->v->camera;
	uint32_t point = s->v->item[at];
	const mr_placed *p = &s->v->at[point];
	double r = s->v->radius * p->near;
	double a = ((double)x + 0.5 - (double)p->x / STEP) / r,
	       b = ((double)y + 0.5 - (double)p->y / STEP) / r;
	double rest = 1 - a * a - b * b;
	mr_v3 n = mr_vec(a, -b, sqrt(rest > 0 ? rest : 0)), color = item_color(s, point, 0);

	if (s->v->subject->normal) {
		mr_v3 known = s->v->subject->normal[point];
		known = mr_vec(mr_dot(known, c->right), mr_dot(known, c->up), mr_dot(known, c->toward));
		if (known.z < -0.25) { /* the inside of the far surface, seen through a gap */
			known = mr_mul(-1, known);
			color = mr_lerp(s->v->subject->color ? 0.5 : 1, color, to_linear(s, INSIDE));
		}
		n = mr_lerp(0.3, known, n);
	}
	gather(g, color, n, 0, mr_vec(0, 0, 0));
}

/* The pixel, over its background. */
static void
put_pixel(const shading *s, const gathered *g, mr_rgb *pixel)
{
	const double all = SAMPLES * SAMPLES;
	mr_v3 behind = to_linear(s, *pixel);
	double rest = 1 - g->share / all;

	if (g->share > 0)
		*pixel = (mr_rgb){ to_srgb(s, g->r / all + rest * behind.x),
			to_srgb(s, g->g / all + rest * behind.y), to_srgb(s, g->b / all + rest * behind.z) };
}

static void
shade_rows(void *arg, size_t begin, size_t end)
{
	const shading *s = arg;
	const mr_raster_view *v = s->v;
	const size_t n = SAMPLES, width = v->image->width;
	facet f = { .face = MR_NONE };

	for (size_t y = begin; y < end; y++) {
		for (size_t x = 0; x < width; x++) {
			gathered g = { 0 };
			for (size_t k = 0; k < n * n; k++) {
				size_t sx = x * n + k % n, sy = y * n + k / n, at = sy * v->w + sx;
				if (v->item[at] == MR_NONE)
					continue;
				if (v->subject->mesh.nf)
					shade_face_sample(s, &f, at, sx, sy, &g);
				else
					shade_point_sample(s, at, sx, sy, &g);
			}
			put_pixel(s, &g, &v->image->pixel[y * width + x]);
		}
	}
}

void
mr_shade(mr_ctx *ctx, const mr_raster_view *v)
{
	enum { ROWS = 8 };
	shading s = { .v = v };
	mr_incidence around;

	prepare_tables(&s);
	if (v->subject->mesh.nf) {
		mr_incidence_build(ctx, &v->subject->mesh, &around);
		mr_creases_find(ctx, &v->subject->mesh, &around, &s.creases);
	}
	mr_parallel(ctx, v->image->height, ROWS, shade_rows, &s);
}
