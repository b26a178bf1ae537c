/* The points of a volume: each once, in Morton order, with their planes and spacing. */
#include "volume/parts.h"

#include "base/sort.h"
#include "mesh/repair.h"
#include "mesh/zorder.h"

/* A point stands for at most so many times the area of most of its neighbours: one far from them is no
 * surface. */
static const double AREA_MOST = 4;

/* Of a median plane of more variation, points may be noisy, and are; a larger neighbourhood of so many times
 * as much sees the shape. */
static const double NOISY = 0.06, SURELY_NOISY = 0.12, BENDS = 1.1;

/* Beyond so many squared spacings, a point that is in no plane is an outlier, and any point. */
static const double OUTLIER_AREA = 9, FAR_AREA = 2500;

enum { NEAREST = 16, NEAREST_MOST = 100, LINKS = 8, CELLS = 1023, TOLD_LEAST = 64 };

/* s->p holds the distinct points; now in Morton order. */
static mr_status
sort_points(mr_ctx *ctx, samples *s)
{
	mr_mark mark = mr_mark_take(ctx);
	uint32_t *order = MR_NEW(ctx, s->n, uint32_t);
	mr_v3 *p = MR_NEW(ctx, s->n, mr_v3);

	if (!order || !p)
		return MR_EMEM;
	MR_TRY(mr_zorder(ctx, s->p, s->n, CELLS, order));
	memcpy(p, s->p, s->n * sizeof *p);
	for (size_t i = 0; i < s->n; i++)
		s->p[i] = p[order[i]];
	mr_mark_release(ctx, mark);
	return MR_OK;
}

static mr_status
distinct(mr_ctx *ctx, const mr_v3 *point, size_t n, samples *s)
{
	mr_mark mark;
	uint32_t *map;

	s->p = MR_NEW(ctx, n, mr_v3);
	mark = mr_mark_take(ctx);
	map = MR_NEW(ctx, n, uint32_t);
	if (!s->p || !map)
		return MR_EMEM;
	MR_TRY(mr_weld(ctx, point, n, 0, map, &s->n));
	for (size_t i = n; i-- > 0;)
		s->p[map[i]] = point[i];
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* MR_EMESH where the points have no volume: fewer than four, on a line, in a plane. */
static mr_status
check(mr_ctx *ctx, const samples *s)
{
	double a[6], value[3];
	mr_v3 vector[3];

	if (s->n < 4)
		return mr_fail(ctx, MR_EMESH, "%zu distinct points enclose nothing: it takes four", s->n);
	mr_covariance(s->p, s->n, 1 / mr_box_diagonal(s->box), a);
	mr_eigen_sym3(a, value, vector);
	if (value[1] <= 1e-12 * value[2])
		return mr_fail(ctx, MR_EMESH, "the %zu points lie on a line: they enclose nothing", s->n);
	if (value[0] <= 1e-12 * value[2])
		return mr_fail(ctx, MR_EMESH, "the %zu points lie in a plane: they enclose nothing", s->n);
	return MR_OK;
}

static mr_status
try_planes(mr_ctx *ctx, samples *s, size_t k, double *variation)
{
	size_t near = s->n < k ? s->n : k, links = near - 1 < LINKS ? near - 1 : LINKS;
	double area;

	MR_TRY(mr_cloud_planes(ctx, s->p, s->n, near, links, k == NEAREST, &s->plane));
	MR_TRY(mr_median(ctx, s->plane.variation, s->n, variation));
	MR_TRY(mr_median(ctx, s->plane.area, s->n, &area));
	s->spacing = sqrt(area);
	s->noise = sqrt((double)near / (double)(s->n < NEAREST ? s->n : NEAREST));
	return MR_OK;
}

/*
 * Planes of as many neighbours as it takes to see a surface through the noise: two and a half times as many
 * until they are flat, or until it is the shape that more of them see.  If noise was uncertain, it was the
 * shape before.
 */
static mr_status
find_planes(mr_ctx *ctx, samples *s)
{
	mr_mark mark = mr_mark_take(ctx);
	double first, last, variation;
	size_t k = NEAREST;

	MR_TRY(try_planes(ctx, s, k, &first));
	variation = first;
	while (variation > NOISY && k < NEAREST_MOST && 5 * k / 2 < s->n) {
		last = variation;
		k = 5 * k / 2;
		mr_mark_release(ctx, mark);
		MR_TRY(try_planes(ctx, s, k, &variation));
		if (variation > BENDS * last)
			break;
	}
	if (k > NEAREST && first < SURELY_NOISY && variation > first) {
		mr_mark_release(ctx, mark);
		MR_TRY(try_planes(ctx, s, NEAREST, &variation));
	}
	mr_stat_set(ctx, "variation", variation);
	return MR_OK;
}

/* The area that a quarter of the point's neighbours does not exceed. */
static double
usual_area(const samples *s, const double *area, size_t i)
{
	const uint32_t *neighbor = s->plane.neighbor + i * s->plane.links;
	double least[LINKS];
	size_t n = 0;

	for (size_t j = 0; j < s->plane.links && neighbor[j] != UINT32_MAX; j++) {
		double a = area[neighbor[j]];
		size_t k = n++;
		for (; k > 0 && least[k - 1] > a; k--)
			least[k] = least[k - 1];
		least[k] = a;
	}
	return n > 0 ? least[n / 4] : area[i];
}

static mr_status
limit_areas(mr_ctx *ctx, samples *s)
{
	mr_mark mark = mr_mark_take(ctx);
	double *area = MR_NEW(ctx, s->n, double);

	if (!area)
		return MR_EMEM;
	memcpy(area, s->plane.area, s->n * sizeof *area);
	for (size_t i = 0; i < s->n; i++)
		s->plane.area[i] = fmin(area[i], AREA_MOST * usual_area(s, area, i));
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* True for a point on no surface: its neighbours are far and in no plane, or very far. */
static bool
is_outlier(const samples *s, size_t i)
{
	double area = s->plane.area[i] / (s->spacing * s->spacing);

	return area > FAR_AREA || (area > OUTLIER_AREA && s->plane.variation[i] > NOISY);
}

/* The links of point i, by new numbers, without those to dropped points. */
static void
renumber_links(samples *s, const uint32_t *number, size_t i)
{
	size_t links = s->plane.links, kept = 0;
	const uint32_t *from = s->plane.neighbor + i * links;
	uint32_t *to = s->plane.neighbor + number[i] * links;

	for (size_t j = 0; j < links; j++)
		if (from[j] != UINT32_MAX && number[from[j]] != UINT32_MAX)
			to[kept++] = number[from[j]];
	while (kept < links)
		to[kept++] = UINT32_MAX;
}

static mr_status
drop_outliers(mr_ctx *ctx, samples *s)
{
	mr_mark mark = mr_mark_take(ctx);
	uint32_t *number = MR_NEW(ctx, s->n, uint32_t);
	size_t kept = 0;

	if (!number)
		return MR_EMEM;
	for (size_t i = 0; i < s->n; i++)
		number[i] = is_outlier(s, i) ? UINT32_MAX : (uint32_t)kept++;
	for (size_t i = 0; i < s->n; i++)
		if (number[i] != UINT32_MAX) {
			s->p[number[i]] = s->p[i];
			s->plane.normal[number[i]] = s->plane.normal[i];
			s->plane.area[number[i]] = s->plane.area[i];
			s->plane.variation[number[i]] = s->plane.variation[i];
			renumber_links(s, number, i);
		}
	mr_stat_set(ctx, "outliers", (double)(s->n - kept));
	s->n = kept;
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* At equal strides along the curve, so that every place keeps its share. */
static void
thin_out(samples *s, double share)
{
	size_t n = (size_t)ceil(share * (double)s->n);

	if (n >= s->n)
		return;
	for (size_t i = 0; i < n; i++)
		s->p[i] = s->p[i * s->n / n];
	s->n = n;
}

/* The same again of the points on their planes, whose outliers show better; the noise was what it was. */
static mr_status
project(mr_ctx *ctx, samples *s)
{
	double scale = s->noise * s->spacing;

	s->box = mr_box_of(s->p, s->n);
	MR_TRY(check(ctx, s));
	MR_TRY(mr_volume_project(ctx, s));
	MR_TRY(find_planes(ctx, s));
	MR_TRY(drop_outliers(ctx, s));
	s->noise = scale / s->spacing;
	return MR_OK;
}

mr_status
mr_volume_samples(mr_ctx *ctx, const mr_v3 *point, size_t n, double share, bool projected, samples *s)
{
	size_t places;

	MR_TRY(distinct(ctx, point, n, s));
	s->box = mr_box_of(s->p, s->n);
	MR_TRY(check(ctx, s));
	MR_TRY(sort_points(ctx, s));
	places = s->n;
	thin_out(s, share);
	if (s->n < places && s->n < TOLD_LEAST)
		return mr_fail(ctx, MR_ERANGE,
		    "%zu points lie so far apart that a grid tells %zu of them: wrap their parts one by one",
		    places, s->n);
	MR_TRY(find_planes(ctx, s));
	MR_TRY(drop_outliers(ctx, s));
	if (projected && s->noise > 1)
		MR_TRY(project(ctx, s));
	s->box = mr_box_of(s->p, s->n);
	MR_TRY(check(ctx, s));
	return limit_areas(ctx, s);
}
