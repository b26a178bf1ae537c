/* The points to wrap: each place once, without outliers. */
#include "wrap/parts.h"

#include "base/text.h"
#include "space/local_planes.h"

static mr_status
look_at_extent(mr_ctx *ctx, mr_wrap_cloud *cloud)
{
	int dimensions = mr_cloud_dimensions(cloud->p, cloud->n);

	if (dimensions < 2)
		return mr_fail(ctx, MR_EMESH, "%zu of %zu points lie on a line: they make no surface",
		    cloud->sampling.n - cloud->sampling.outliers, cloud->sampling.n);
	cloud->flat = dimensions == 2;
	return MR_OK;
}

static void
set_outliers_apart(mr_ctx *ctx, mr_wrap_cloud *cloud)
{
	const mr_sampling *s = &cloud->sampling;
	mr_v3 *p = MR_NEW(ctx, s->outliers, mr_v3);
	size_t n = 0;

	for (size_t i = 0; i < s->n; i++)
		if (s->outlier[i] && !s->repeat[i])
			p[n++] = cloud->given[i];
	cloud->outlier = p;
	if (n > 0)
		mr_note(ctx, "%zu outlier%s left out", n, mr_plural(n));
}

mr_status
mr_wrap_cloud_open(
    mr_ctx *ctx, const mr_v3 *point, size_t n, const mr_sampling *sampling, mr_wrap_cloud *cloud)
{
	mr_sampling *s = &cloud->sampling;
	uint32_t *index;
	double *own;
	mr_v3 *p;

	*cloud = (mr_wrap_cloud){ .given = point };
	if (n < 4)
		return mr_fail(
		    ctx, MR_EMESH, "%zu point%s: a closed surface needs 4 at least", n, mr_plural(n));
	MR_TRY(mr_sampling_find(ctx, point, n, sampling, s));
	cloud->spacing = s->usual;
	mr_sampling_places(ctx, point, s, &p, &index, &cloud->n);
	if (cloud->n < 4)
		return mr_fail(ctx, MR_EMESH, "%zu points at %zu place%s: a closed surface needs 4 at least",
		    n, cloud->n, mr_plural(cloud->n));
	own = MR_NEW(ctx, cloud->n, double);
	for (size_t i = 0; i < cloud->n; i++) {
		own[i] = s->spacing[index[i]];
		cloud->area += own[i] * own[i]; /* in an order that does not depend on the points' order */
	}
	cloud->p = p;
	cloud->own = own;
	cloud->of = index;
	cloud->box = mr_box_of(p, cloud->n);
	cloud->diagonal = mr_box_diagonal(cloud->box);
	MR_TRY(look_at_extent(ctx, cloud));
	set_outliers_apart(ctx, cloud);
	cloud->near = s->near;
	return s->near ? MR_OK : mr_near_build_distinct(ctx, p, cloud->n, &cloud->near);
}
