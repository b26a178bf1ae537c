/* Signs of the planes' normals by known sides: normals that came with the points, or the directions to the
 * scanner. */
#include "volume/parts.h"
#include "volume/volume.h"

/* A direction as near to its place's plane as this (the cosine to the normal) does not decide the side. */
static const double ALONG = 0.1;

/* Normals match planes from this cosine on, and planes are alike from this likeness. */
static const double NEAR = 0.5, ALIKE = 0.8;

/* How much a normal is on the side that is known; 0 where that is not. */
static double
side_of(const mr_volume_cloud *s, const mr_v3 *toward, size_t i)
{
	double along = mr_finite(toward[i]) ? mr_dot(mr_unit(toward[i]), s->plane.normal[i]) : 0;

	return fabs(along) > ALONG ? along : 0;
}

mr_status
mr_volume_orient_toward(mr_ctx *ctx, mr_volume_cloud *s, const mr_v3 *toward, size_t *untold)
{
	mr_mark mark = mr_mark_take(ctx);
	double *vote = MR_NEW_ZERO(ctx, s->n, double);

	for (size_t i = 0; toward && i < s->n; i++)
		vote[i] = side_of(s, toward, i);
	MR_TRY(mr_volume_orient(ctx, s, vote, NULL, true, untold));
	for (size_t i = 0; i < s->n; i++)
		if (vote[i] < 0)
			s->plane.normal[i] = mr_mul(-1, s->plane.normal[i]);
	mr_mark_release(ctx, mark);
	return MR_OK;
}

mr_volume_sides
mr_volume_judge(const mr_volume_cloud *s, const mr_v3 *toward)
{
	size_t links = s->plane.links, there = 0, near = 0, pairs = 0, alike = 0;
	mr_volume_sides j = { .unlike = UINT32_MAX };

	for (size_t i = 0; i < s->n; i++) {
		double side = side_of(s, toward, i);
		j.told += side != 0;
		there += mr_finite(toward[i]) && mr_norm2(toward[i]) > 0;
		near += fabs(side) >= NEAR;
		for (size_t l = i * links; side != 0 && l < (i + 1) * links; l++) {
			uint32_t other = s->plane.neighbor[l];
			bool same;
			double like = other == UINT32_MAX ? 0 : mr_volume_likeness(s, (uint32_t)i, other);
			if (fabs(like) < ALIKE || side_of(s, toward, other) == 0)
				continue;
			pairs++;
			same = side * side_of(s, toward, other) * like > 0;
			alike += same;
			if (!same && j.unlike == UINT32_MAX)
				j.unlike = (uint32_t)i;
		}
	}
	j.near = (double)near / (double)there;
	j.alike = (double)alike / (double)pairs;
	return j;
}

/* By directions, and where a part has none, as without them. */
static mr_status
orient_toward(mr_ctx *ctx, mr_volume_cloud *s, const mr_v3 *toward, bool flat)
{
	size_t untold;

	MR_TRY(mr_volume_orient_toward(ctx, s, toward, &untold));
	if (untold > 0 && !flat) {
		MR_TRY(mr_volume_orient_outward(ctx, s));
		if (untold == s->n)
			return MR_OK;
		MR_TRY(mr_volume_orient_toward(ctx, s, toward, &untold));
	}
	mr_volume_report_patches(ctx, s);
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
	s = (mr_volume_cloud){ .p = place, .n = n };
	MR_TRY(flat ? mr_volume_planes(ctx, of, &s) : mr_volume_samples(ctx, place, n, of, 1, &s));
	if (toward || flat)
		MR_TRY(orient_toward(ctx, &s, toward, flat));
	else
		MR_TRY(mr_volume_orient_outward(ctx, &s));
	memcpy(normal, s.plane.normal, n * sizeof *normal);
	mr_mark_release(ctx, mark);
	return MR_OK;
}
