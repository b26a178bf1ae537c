/* Normals of points, by the planes and signs that a volume has; Hoppe et al. 1992 where signs are known of
 * some. */
#include "volume/normals.h"

#include "volume/parts.h"

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
