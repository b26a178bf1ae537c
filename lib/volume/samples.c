/* The points of a volume, with their planes and spacing. */
#include "volume/parts.h"

#include "base/sort.h"

/* A point stands for at most so many times the area of most of its neighbours: one far from them is no
 * surface. */
static const double AREA_MOST = 4;

enum { NEAREST = 16, LINKS = 8, TOLD_LEAST = 64 };

/* MR_EMESH where what counts of n points has no volume: fewer than four, on a line, in a plane. */
static mr_status
check(mr_ctx *ctx, const mr_volume_cloud *s, size_t n)
{
	int dimensions = mr_cloud_dimensions(s->p, s->n);

	if (s->n < 4)
		return mr_fail(ctx, MR_EMESH, "%zu distinct points enclose nothing: it takes four", s->n);
	if (dimensions < 3)
		return mr_fail(ctx, MR_EMESH, "the %zu points lie %s: they enclose nothing", n,
		    dimensions < 2 ? "on a line" : "in a plane");
	return MR_OK;
}

mr_status
mr_volume_planes(mr_ctx *ctx, const mr_sampling *of, mr_volume_cloud *s)
{
	size_t near = s->n < of->neighbours ? s->n : of->neighbours;
	double area;

	MR_TRY(mr_cloud_planes(ctx, s->p, s->n, near, near - 1 < LINKS ? near - 1 : LINKS,
	    of->neighbours <= NEAREST, &s->plane));
	mr_median(ctx, s->plane.area, s->n, &area);
	s->spacing = sqrt(area);
	s->noise = sqrt((double)of->neighbours / NEAREST);
	return MR_OK;
}

/* The area that a quarter of the point's neighbours does not exceed. */
static double
usual_area(const mr_volume_cloud *s, const double *area, size_t i)
{
	const uint32_t *neighbor = s->plane.neighbor + i * s->plane.links;
	double least[LINKS];
	size_t n = 0;

	for (size_t j = 0; j < s->plane.links && neighbor[j] != UINT32_MAX; j++)
		least[n++] = area[neighbor[j]];
	return n > 0 ? mr_kth(least, n, n / 4) : area[i];
}

static void
limit_areas(mr_ctx *ctx, mr_volume_cloud *s)
{
	mr_mark mark = mr_mark_take(ctx);
	double *area = MR_NEW(ctx, s->n, double);

	memcpy(area, s->plane.area, s->n * sizeof *area);
	for (size_t i = 0; i < s->n; i++)
		s->plane.area[i] = fmin(area[i], AREA_MOST * usual_area(s, area, i));
	mr_mark_release(ctx, mark);
}

/* At equal strides along the curve, so that every place keeps its share: the mean may be less noisy. */
static void
thin_out(mr_volume_cloud *s, double share, mr_sampling *of)
{
	size_t n = (size_t)ceil(share * (double)s->n);

	for (size_t i = 0; i < n; i++)
		s->p[i] = s->p[i * s->n / n];
	s->n = n;
	of->usual /= sqrt(share);
	if (of->noise < MR_NOISY * of->usual)
		of->neighbours = NEAREST;
}

mr_status
mr_volume_samples(
    mr_ctx *ctx, mr_v3 *place, size_t n, const mr_sampling *sampling, double share, mr_volume_cloud *s)
{
	mr_sampling of = *sampling;

	s->p = place;
	s->n = n;
	MR_TRY(check(ctx, s, of.n));
	if (share < 1) {
		thin_out(s, share, &of);
		if (s->n < TOLD_LEAST)
			return mr_advise(ctx, MR_THIN_OUT,
			    mr_fail(ctx, MR_ERANGE,
				"%zu points lie so far apart, for how near their neighbours are, that the "
				"grid "
				"resolves only %zu of them",
				n, s->n));
		MR_TRY(check(ctx, s, n));
	}
	MR_TRY(mr_volume_planes(ctx, &of, s));
	s->box = mr_box_of(s->p, s->n);
	limit_areas(ctx, s);
	return MR_OK;
}
