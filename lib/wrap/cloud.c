#include "wrap/parts.h"

#include "base/sort.h"
#include "space/local_planes.h"

/* Points nearer to a plane (a line, a place) than this share of the diagonal lie on it. */
static const double FLAT = 1e-6;

/* Strays are so many boxes of nearly all points away from it, and so many sampling distances from others. */
static const double AWAY = 1, ALONE = 10;

/* A point whose square is larger than that of so many sampling distances is an outlier, or at a hole. */
static const double LONELY = 3;

enum { RING = 8, SAMPLES = 4096 };

/* The vector from the nearest point of the line a + t u, u unit, to p. */
static mr_v3
off_line(mr_v3 a, mr_v3 u, mr_v3 p)
{
	mr_v3 w = mr_sub(p, a);

	return mr_axpy(-mr_dot(w, u), u, w);
}

/*
 * Measures how the cloud spreads: the farthest point b from the first, the farthest c from the line, the
 * farthest from the plane.
 */
static mr_status
check_extent(mr_ctx *ctx, const mr_wrap_cloud *cloud)
{
	const mr_v3 *p = cloud->p;
	double least = FLAT * cloud->diagonal, far = 0;
	mr_v3 u = { 0, 0, 0 }, n = { 0, 0, 0 }, w;

	for (size_t i = 1; i < cloud->n; i++) {
		w = mr_sub(p[i], p[0]);
		if (mr_norm(w) > far) {
			far = mr_norm(w);
			u = mr_unit(w);
		}
	}
	far = 0;
	for (size_t i = 1; i < cloud->n; i++) {
		w = off_line(p[0], u, p[i]);
		if (mr_norm(w) > far) {
			far = mr_norm(w);
			n = mr_unit(mr_cross(u, w));
		}
	}
	if (far <= least)
		return mr_fail(
		    ctx, MR_EMESH, "%zu points lie on a line: no surface closes around them", cloud->n);
	far = 0;
	for (size_t i = 1; i < cloud->n; i++)
		far = fmax(far, fabs(mr_dot(mr_sub(p[i], p[0]), n)));
	if (far <= least)
		return mr_fail(
		    ctx, MR_EMESH, "%zu points lie in a plane: no surface closes around them", cloud->n);
	return MR_OK;
}

static mr_status
index_points(mr_ctx *ctx, const mr_v3 *point, size_t n, mr_wrap_cloud *cloud)
{
	*cloud = (mr_wrap_cloud){ .p = point, .n = n, .box = mr_box_of(point, n) };
	cloud->diagonal = mr_box_diagonal(cloud->box);
	if (n < 4)
		return mr_fail(
		    ctx, MR_EMESH, "%zu point%s: a closed surface needs 4 at least", n, n == 1 ? "" : "s");
	MR_TRY(mr_cloud_check_spread(ctx, point, n));
	MR_TRY(mr_near_build(ctx, point, n, &cloud->near));
	cloud->places = mr_near_distinct(cloud->near);
	if (cloud->places < 4)
		return mr_fail(ctx, MR_EMESH, "%zu points at %zu place%s: a closed surface needs 4 at least",
		    n, cloud->places, cloud->places == 1 ? "" : "s");
	return MR_OK;
}

/*
 * A disk around a point with its k nearest has an area of about k squares of the side s: s = r sqrt(pi / k).
 * side: count, of points taken at equal strides.
 */
static mr_status
sample_sides(mr_ctx *ctx, const mr_wrap_cloud *cloud, double *side, size_t count)
{
	mr_mark mark = mr_mark_take(ctx);
	size_t k = cloud->places - 1 < RING ? cloud->places - 1 : RING;
	mr_v3 *q = MR_NEW(ctx, count, mr_v3);
	uint32_t *index = MR_NEW(ctx, count * (k + 1), uint32_t);
	double *dist2 = MR_NEW(ctx, count * (k + 1), double);

	if (!q || !index || !dist2)
		return MR_EMEM;
	for (size_t i = 0; i < count; i++)
		q[i] = cloud->p[i * cloud->n / count];
	MR_TRY(mr_near_query(ctx, cloud->near, q, count, k + 1, index, dist2));
	for (size_t i = 0; i < count; i++) /* the first of them is the point itself */
		side[i] = sqrt(dist2[i * (k + 1) + k] * MR_PI / (double)k);
	mr_mark_release(ctx, mark);
	return MR_OK;
}

static mr_status
measure_sampling(mr_ctx *ctx, mr_wrap_cloud *cloud)
{
	mr_mark mark = mr_mark_take(ctx);
	size_t count = cloud->n < SAMPLES ? cloud->n : SAMPLES;
	double *side = MR_NEW(ctx, count, double), most, sum = 0;

	if (!side)
		return MR_EMEM;
	MR_TRY(sample_sides(ctx, cloud, side, count));
	mr_sort_reals(side, count);
	cloud->spacing = side[count / 2];
	most = LONELY * cloud->spacing;
	for (size_t i = 0; i < count; i++)
		sum += side[i] < most ? side[i] * side[i] : most * most;
	cloud->area = sum / (double)count * (double)cloud->places;
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* The box of nearly all points, widened. */
static mr_status
wide_box(mr_ctx *ctx, const mr_wrap_cloud *cloud, mr_box *box)
{
	mr_mark mark = mr_mark_take(ctx);
	size_t count = cloud->n < SAMPLES ? cloud->n : SAMPLES, rare = count / 100;
	double *x = MR_NEW(ctx, count, double), low[3], high[3], longest = 0, wider;

	if (!x)
		return MR_EMEM;
	for (int k = 0; k < 3; k++) {
		for (size_t i = 0; i < count; i++)
			x[i] = mr_coordinate(cloud->p[i * cloud->n / count], k);
		mr_sort_reals(x, count);
		low[k] = x[rare];
		high[k] = x[count - 1 - rare];
		longest = fmax(longest, high[k] - low[k]);
	}
	wider = AWAY * longest;
	box->min = mr_vec(low[0] - wider, low[1] - wider, low[2] - wider);
	box->max = mr_vec(high[0] + wider, high[1] + wider, high[2] + wider);
	mr_mark_release(ctx, mark);
	return MR_OK;
}

static bool
is_inside(mr_box b, mr_v3 p)
{
	return p.x >= b.min.x && p.x <= b.max.x && p.y >= b.min.y && p.y <= b.max.y && p.z >= b.min.z &&
	       p.z <= b.max.z;
}

/* Of the points outside of a box: those that are alone there.  stray: cloud->n. */
static mr_status
find_strays(mr_ctx *ctx, const mr_wrap_cloud *cloud, mr_box box, bool *stray, size_t *count)
{
	mr_mark mark = mr_mark_take(ctx);
	size_t k = cloud->places - 1 < RING ? cloud->places - 1 : RING;
	uint32_t index[RING + 1];
	double dist2[RING + 1], far = ALONE * cloud->spacing;

	*count = 0;
	for (size_t i = 0; i < cloud->n; i++) {
		stray[i] = !is_inside(box, cloud->p[i]);
		if (!stray[i])
			continue;
		MR_TRY(mr_near_query(ctx, cloud->near, &cloud->p[i], 1, k + 1, index, dist2));
		stray[i] = dist2[k] > far * far;
		*count += stray[i];
	}
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* Few points far from all others would have the cells of a grid, and the edges of a box, as long as their
 * way. */
static mr_status
drop_strays(mr_ctx *ctx, mr_wrap_cloud *cloud)
{
	bool *stray = MR_NEW(ctx, cloud->n, bool);
	size_t strays, kept = 0;
	mr_box box;
	mr_v3 *p;

	if (!stray)
		return MR_EMEM;
	MR_TRY(wide_box(ctx, cloud, &box));
	MR_TRY(find_strays(ctx, cloud, box, stray, &strays));
	mr_stat_set(ctx, "strays", (double)strays);
	if (strays == 0)
		return MR_OK;
	mr_warn(ctx, "%zu point%s far from all others: left out", strays, strays == 1 ? " is" : "s are");
	p = MR_NEW(ctx, cloud->n - strays, mr_v3);
	if (!p)
		return MR_EMEM;
	for (size_t i = 0; i < cloud->n; i++)
		if (!stray[i])
			p[kept++] = cloud->p[i];
	mr_near_free(cloud->near);
	cloud->near = NULL;
	return index_points(ctx, p, kept, cloud);
}

mr_status
mr_wrap_cloud_open(mr_ctx *ctx, const mr_v3 *point, size_t n, mr_wrap_cloud *cloud)
{
	MR_TRY(index_points(ctx, point, n, cloud));
	MR_TRY(measure_sampling(ctx, cloud));
	MR_TRY(drop_strays(ctx, cloud));
	MR_TRY(check_extent(ctx, cloud));
	return measure_sampling(ctx, cloud);
}

mr_status
mr_wrap_cloud_thin(mr_ctx *ctx, const mr_wrap_cloud *cloud, size_t count, mr_wrap_cloud *thin)
{
	mr_v3 *p;

	*thin = *cloud;
	thin->near = NULL;
	thin->n = count < cloud->n ? count : cloud->n;
	p = MR_NEW(ctx, thin->n, mr_v3);
	if (!p)
		return MR_EMEM;
	for (size_t i = 0; i < thin->n; i++)
		p[i] = cloud->p[i * cloud->n / thin->n];
	thin->p = p;
	MR_TRY(mr_near_build(ctx, p, thin->n, &thin->near));
	thin->places = mr_near_distinct(thin->near);
	thin->spacing = cloud->spacing * sqrt((double)cloud->places / (double)thin->places);
	return MR_OK;
}
