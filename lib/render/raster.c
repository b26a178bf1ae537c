/* Which face or point each sample sees: edge functions (Pineda 1988), a depth buffer, bands of rows. */
#include "render/raster_parts.h"

#include "base/parallel.h"

enum { BAND = 32 }; /* rows of samples */

static int32_t
to_steps(double x)
{
	const double most = 1 << 28; /* far outside any picture, and no product overflows */

	return (int32_t)lrint(fmin(fmax(x, -most), most));
}

static void
place_vertices(void *arg, size_t begin, size_t end)
{
	const mr_raster_view *v = arg;
	const double steps = (double)(STEP * SAMPLES);

	for (size_t i = begin; i < end; i++) {
		mr_seen s = mr_camera_see(v->camera, v->subject->mesh.p[i]);
		v->at[i] = (mr_placed){ to_steps(steps * s.x), to_steps(steps * s.y),
			(float)near_of(v->camera, s.z) };
	}
}

/* The range of samples whose middles lie in [low, high] steps, inside [0, count). */
typedef struct range {
	size_t begin, end;
} range;

static range
samples_in(int64_t low, int64_t high, size_t count)
{
	int64_t begin = (low + STEP / 2 - 1) >> STEP_BITS, end = ((high - STEP / 2) >> STEP_BITS) + 1;
	int64_t most = (int64_t)count;

	begin = begin > 0 ? begin : 0;
	end = end < most ? end : most;
	return begin < end ? (range){ (size_t)begin, (size_t)end } : (range){ 0, 0 };
}

static int32_t
least(int32_t a, int32_t b, int32_t c)
{
	return a < b ? (a < c ? a : c) : (b < c ? b : c);
}

static int32_t
most(int32_t a, int32_t b, int32_t c)
{
	return a > b ? (a > c ? a : c) : (b > c ? b : c);
}

/* The columns and rows that an item may cover; false where there are none. */
static bool
item_extent(const mr_raster_view *v, size_t item, range *x, range *y)
{
	if (v->subject->mesh.nf == 0) {
		const mr_placed *p = &v->at[item];
		int64_t r = (int64_t)(v->radius * p->near * STEP) + 1;
		*x = samples_in(p->x - r, p->x + r, v->w);
		*y = samples_in(p->y - r, p->y + r, v->h);
	} else {
		const uint32_t *t = v->subject->mesh.t[item].v;
		const mr_placed *a = &v->at[t[0]], *b = &v->at[t[1]], *c = &v->at[t[2]];
		*x = samples_in(least(a->x, b->x, c->x), most(a->x, b->x, c->x), v->w);
		if (x->begin == x->end)
			return false;
		*y = samples_in(least(a->y, b->y, c->y), most(a->y, b->y, c->y), v->h);
	}
	return x->begin < x->end && y->begin < y->end;
}

/* Lists, for each band, the items that may touch it, by index. */
static void
fill_bands(mr_ctx *ctx, mr_raster_view *v)
{
	const mr_mesh *m = &v->subject->mesh;
	size_t bands = (v->h + BAND - 1) / BAND, items = m->nf ? m->nf : m->nv;
	range x, y;

	v->start = MR_NEW_ZERO(ctx, bands + 2, size_t);
	for (size_t i = 0; i < items; i++)
		if (item_extent(v, i, &x, &y))
			for (size_t b = y.begin / BAND; b <= (y.end - 1) / BAND; b++)
				v->start[b + 2]++;
	for (size_t b = 1; b <= bands; b++)
		v->start[b + 1] += v->start[b];
	v->list = MR_NEW(ctx, v->start[bands + 1], uint32_t);
	for (size_t i = 0; i < items; i++)
		if (item_extent(v, i, &x, &y))
			for (size_t b = y.begin / BAND; b <= (y.end - 1) / BAND; b++)
				v->list[v->start[b + 1]++] = (uint32_t)i;
}

static void
see(const mr_raster_view *v, size_t at, float near, size_t item)
{
	if (near > v->near[at]) { /* of equally near items the first stays */
		v->near[at] = near;
		v->item[at] = (uint32_t)item;
	}
}

static void
draw_face(const mr_raster_view *v, size_t f, range x, range y)
{
	const uint32_t *t = v->subject->mesh.t[f].v;
	const mr_placed p[3] = { v->at[t[0]], v->at[t[1]], v->at[t[2]] };
	int64_t row[3], dx[3], dy[3], area;
	double low, high, slope, inverse;

	edge_functions(p, (int64_t)x.begin * STEP + STEP / 2, (int64_t)y.begin * STEP + STEP / 2, row);
	area = row[0] + row[1] + row[2];
	if (area == 0)
		return;
	for (int i = 0; i < 3; i++) {
		const mr_placed *a = &p[(i + 1) % 3], *b = &p[(i + 2) % 3];
		int64_t sign = area > 0 ? 1 : -1;
		row[i] *= sign;
		dx[i] = sign * -(int64_t)(b->y - a->y) * STEP;
		dy[i] = sign * (int64_t)(b->x - a->x) * STEP;
	}
	inverse = 1 / fabs((double)area);
	slope = inverse * ((double)dx[0] * p[0].near + (double)dx[1] * p[1].near + (double)dx[2] * p[2].near);
	low = fminf(p[0].near, fminf(p[1].near, p[2].near));
	high = fmaxf(p[0].near, fmaxf(p[1].near, p[2].near));
	for (size_t j = y.begin; j < y.end; j++) {
		int64_t e0 = row[0], e1 = row[1], e2 = row[2];
		double near = inverse *
		              ((double)e0 * p[0].near + (double)e1 * p[1].near + (double)e2 * p[2].near);
		for (size_t i = x.begin; i < x.end; i++) {
			if ((e0 | e1 | e2) >= 0) {
				double n = near + slope * (double)(i - x.begin);
				n = n < low ? low : n > high ? high : n; /* a sliver's slope is steep */
				see(v, j * v->w + i, (float)n, f);
			}
			e0 += dx[0];
			e1 += dx[1];
			e2 += dx[2];
		}
		for (int k = 0; k < 3; k++)
			row[k] += dy[k];
	}
}

/* A ball, of which the half towards the eye is seen. */
static void
draw_point(const mr_raster_view *v, size_t point, range x, range y)
{
	const mr_placed *p = &v->at[point];
	double r = v->radius * p->near;
	double z = height_of(v->camera, p->near);
	double unit = v->radius / (v->camera->scale * SAMPLES); /* the radius in space */

	for (size_t j = y.begin; j < y.end; j++) {
		for (size_t i = x.begin; i < x.end; i++) {
			double a = ((double)i + 0.5 - (double)p->x / STEP) / r;
			double b = ((double)j + 0.5 - (double)p->y / STEP) / r, rest = 1 - a * a - b * b;
			if (rest >= 0)
				see(v, j * v->w + i, (float)near_of(v->camera, z + unit * sqrt(rest)), point);
		}
	}
}

static void
draw_band(const mr_raster_view *v, size_t band)
{
	size_t first = band * BAND, last = first + BAND < v->h ? first + BAND : v->h;

	for (size_t i = first * v->w; i < last * v->w; i++) {
		v->near[i] = -INFINITY;
		v->item[i] = MR_NONE;
	}
	for (size_t i = v->start[band]; i < v->start[band + 1]; i++) {
		size_t item = v->list[i];
		range x, y;
		if (!item_extent(v, item, &x, &y))
			continue;
		y.begin = y.begin > first ? y.begin : first;
		y.end = y.end < last ? y.end : last;
		if (v->subject->mesh.nf)
			draw_face(v, item, x, y);
		else
			draw_point(v, item, x, y);
	}
}

static void
draw_bands(void *arg, size_t begin, size_t end)
{
	for (size_t b = begin; b < end; b++)
		draw_band(arg, b);
}

/* Radius at which the balls of a closed surface, half of which is seen, about cover it. */
static double
covering_radius(const mr_raster_view *v)
{
	mr_box covered = mr_box_empty();
	double area;

	mr_camera_cover(v->camera, &v->subject->mesh, &covered);
	area = (covered.max.x - covered.min.x) * (covered.max.y - covered.min.y);
	area *= v->camera->scale * v->camera->scale;
	return fmin(fmax(1.1 * sqrt(area / (double)v->subject->mesh.nv), 1), 8);
}

void
mr_raster(mr_ctx *ctx, const mr_subject *subject, const mr_camera *camera, bool wire, mr_image *image)
{
	MR_SCOPE(ctx);
	mr_raster_view v = { .subject = subject, .camera = camera, .wire = wire, .image = image };

	v.w = image->width * SAMPLES;
	v.h = image->height * SAMPLES;
	v.at = MR_NEW(ctx, subject->mesh.nv, mr_placed);
	v.near = MR_NEW(ctx, v.w * v.h, float);
	v.item = MR_NEW(ctx, v.w * v.h, uint32_t);
	if (subject->mesh.nf == 0)
		v.radius = covering_radius(&v) * SAMPLES;
	mr_parallel(ctx, subject->mesh.nv, 4096, place_vertices, &v);
	fill_bands(ctx, &v);
	mr_parallel(ctx, (v.h + BAND - 1) / BAND, 1, draw_bands, &v);
	mr_shade(ctx, &v);
}
