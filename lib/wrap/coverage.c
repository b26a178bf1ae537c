/* Coverage both ways: points that the wrap misses, and parts of it where there are no points. */
#include "base/sort.h"
#include "measure/gaps.h"
#include "mesh/zorder.h"
#include "space/self_intersect.h"
#include "wrap/parts.h"

static const double MOST = 0.9;

/* c->lost, of some outliers at equal strides for all of them. */
static mr_status
count_lost(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_bvh *bvh, size_t samples, mr_wrap_cover *c)
{
	size_t all = cloud->sampling.outliers, n = all < samples ? all : samples, far = 0;
	mr_v3 *q = MR_NEW(ctx, n, mr_v3);
	double *distance = MR_NEW(ctx, n, double);

	if (!q || !distance)
		return MR_EMEM;
	mr_at_strides(cloud->outlier, all, n, q);
	mr_bvh_distances(ctx, bvh, q, n, distance);
	for (size_t i = 0; i < n; i++)
		far += distance[i] > MR_WRAP_LACKS * cloud->spacing;
	c->lost = n ? far * all / n : 0;
	return MR_OK;
}

static mr_status
measure_points(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_mesh *m, size_t n, mr_wrap_cover *c)
{
	mr_mark mark = mr_mark_take(ctx);
	mr_v3 *p = MR_NEW(ctx, n, mr_v3), *q = MR_NEW(ctx, n, mr_v3);
	double *distance = MR_NEW(ctx, n, double);
	size_t missed = 0;
	mr_bvh *bvh;

	if (!p || !q || !distance)
		return MR_EMEM;
	mr_at_strides(cloud->p, cloud->n, n, p);
	MR_TRY(mr_zorder_points(ctx, p, n, q)); /* what close ones look up is in the cache */
	MR_TRY(mr_bvh_build(ctx, m, &bvh));
	mr_bvh_distances(ctx, bvh, q, n, distance);
	for (size_t i = 0; i < n; i++)
		missed += distance[i] > MR_WRAP_ENOUGH.points.high * cloud->spacing;
	c->missed = n ? (double)missed / (double)n : 0;
	c->gaps.points = mr_gap_of(distance, n);
	c->points_most = mr_kth(distance, n, (size_t)(MOST * (double)(n - 1)));
	MR_TRY(count_lost(ctx, cloud, bvh, MR_WRAP_SAMPLES, c));
	MR_TRY(mr_self_intersections(ctx, bvh, m, NULL, &c->crossings));
	mr_mark_release(ctx, mark);
	return MR_OK;
}

mr_status
mr_wrap_measure(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_mesh *m, size_t samples, mr_wrap_cover *c)
{
	mr_gap_cloud places = { cloud->p, cloud->own, cloud->near, cloud->n, cloud->spacing };

	MR_TRY(measure_points(ctx, cloud, m, cloud->n < samples ? cloud->n : samples, c));
	return mr_gap_of_surface(ctx, m, &places, samples, &c->gaps, NULL);
}
