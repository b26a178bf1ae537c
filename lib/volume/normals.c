/* Normals of points, by the planes and signs that a volume has; Hoppe et al. 1992 where signs are known of
 * some. */
#include "volume/normals.h"

#include "volume/parts.h"

enum { NEAREST = 16, LINKS = 8 };

/* A direction as near to its place's plane as this (the cosine to the normal) tells nothing of a side. */
static const double ALONG = 0.1;

/* The planes of a cloud that encloses nothing. */
static mr_status
flat_planes(mr_ctx *ctx, mr_v3 *place, size_t n, const mr_sampling *of, mr_volume_cloud *s)
{
	size_t k = n < of->neighbours ? n : of->neighbours;

	*s = (mr_volume_cloud){ .p = place, .n = n };
	return mr_cloud_planes(
	    ctx, place, n, k, k - 1 < LINKS ? k - 1 : LINKS, of->neighbours <= NEAREST, &s->plane);
}

/* How much a normal is on the side that is known; 0 where that is not. */
static double
side_of(const mr_volume_cloud *s, const mr_v3 *toward, size_t i)
{
	double along = mr_dot(mr_unit(toward[i]), s->plane.normal[i]);

	return fabs(along) > ALONG ? along : 0;
}

/* Signs that neighbours tell, of what is known of some, or of none. */
static mr_status
orient_by_neighbours(mr_ctx *ctx, mr_volume_cloud *s, const mr_v3 *toward)
{
	mr_mark mark = mr_mark_take(ctx);
	double *vote = MR_NEW_ZERO(ctx, s->n, double);

	if (!vote)
		return MR_EMEM;
	for (size_t i = 0; toward && i < s->n; i++)
		vote[i] = side_of(s, toward, i);
	MR_TRY(mr_volume_orient(ctx, s, vote));
	for (size_t i = 0; toward && i < s->n; i++)
		if (side_of(s, toward, i) < 0)
			s->plane.normal[i] = mr_mul(-1, s->plane.normal[i]);
	mr_mark_release(ctx, mark);
	return MR_OK;
}

mr_status
mr_places_normals(
    mr_ctx *ctx, mr_v3 *place, size_t n, const mr_sampling *of, const mr_v3 *toward, mr_v3 *normal)
{
	mr_mark mark = mr_mark_take(ctx);
	int dimensions = mr_cloud_dimensions(place, n);
	bool flat = n < 4 || dimensions < 3;
	mr_volume_cloud s;

	if (n < 3 || dimensions < 2)
		return mr_fail(
		    ctx, MR_EMESH, "%zu distinct points%s have no normals", n, n < 3 ? "" : " on a line");
	MR_TRY(
	    flat ? flat_planes(ctx, place, n, of, &s) : mr_volume_samples(ctx, place, n, of, 1, &s));
	MR_TRY(toward || flat ? orient_by_neighbours(ctx, &s, toward) : mr_volume_orient_outward(ctx, &s));
	memcpy(normal, s.plane.normal, n * sizeof *normal);
	mr_mark_release(ctx, mark);
	return MR_OK;
}
