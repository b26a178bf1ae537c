/* The box, coarse to fine (Jeong, Kim 2001, introduction: successively subdivide, smooth and project). */
#include "wrap/parts.h"

/* The first level has about so many edges along the diagonal, or up to twice as many. */
static const double FIRST_EDGES = 10;

double
mr_wrap_length(const mr_wrap_cloud *cloud, const mr_wrap_opts *o)
{
	mr_v3 size = mr_sub(cloud->box.max, cloud->box.min);

	if (o->resolution)
		return fmax(size.x, fmax(size.y, size.z)) / (double)o->resolution;
	/* faces of sqrt(3) / 4 l^2, two points for each; few points need no fewer faces than the first level
	 */
	return fmin(2.07 * sqrt(cloud->area / (double)cloud->n), cloud->diagonal / FIRST_EDGES);
}

/* Rounds over the levels, each of remeshing and then drawing closer. */
enum { FIRST_ROUNDS = 6, ROUNDS = 2, LAST_ROUNDS = 1, DRAWS = 2 };

/* Points for each squared edge of a level. */
static const double POINTS_PER_EDGE = 12;

/* Faces for each point, of the last level.  Of 230 clouds of 1000 points and more, scans with outliers and
 * parts unseen among them, all but one have 1.2 at most; of a cluster and a point far off there is no end. */
static const double MOST_FACES = 4;

static mr_status
run_level(
    mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, double length, size_t rounds, mr_dyn *d)
{
	for (size_t i = 0; i < rounds; i++) {
		mr_mesh m = mr_dyn_view(d, "control");

		MR_TRY(mr_wrap_remesh(ctx, &m, length, d));
		for (int j = 0; j < DRAWS; j++) {
			MR_TRY(mr_wrap_draw(ctx, cloud, o->alpha, length, length, d));
			MR_TRY(mr_wrap_smooth(ctx, o->lambda, true, d));
		}
	}
	return MR_OK;
}

static mr_status
thin_level(
    mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, double length, size_t rounds, mr_dyn *d)
{
	double count = ceil(POINTS_PER_EDGE * cloud->area / (length * length));
	mr_wrap_cloud thin;
	mr_status status;

	if (!(count < (double)cloud->n / 2))
		return run_level(ctx, cloud, o, length, rounds, d);
	status = mr_wrap_cloud_thin(ctx, cloud, (size_t)count, &thin);
	if (status == MR_OK)
		status = run_level(ctx, &thin, o, length, rounds, d);
	mr_near_free(thin.near);
	return status;
}

/* Whether edges of half the length are of use: what is far from all points needs no finer faces. */
static bool
is_finer_of_use(const mr_wrap_cloud *cloud, const mr_wrap_opts *o, const mr_dyn *d)
{
	return o->resolution || 4.0 * (double)d->nf <= MOST_FACES * (double)cloud->n;
}

static size_t
edges_along(double side, double length)
{
	return side > length ? (size_t)ceil(side / length) : 1;
}

static mr_status
begin_box(mr_ctx *ctx, const mr_wrap_cloud *cloud, double length, mr_dyn *d)
{
	mr_v3 size = mr_sub(cloud->box.max, cloud->box.min);
	mr_mesh box;

	MR_TRY(mr_wrap_box(ctx, cloud->box,
	    (size_t[]){
		edges_along(size.x, length), edges_along(size.y, length), edges_along(size.z, length) },
	    &box));
	return mr_wrap_dyn(ctx, &box, d);
}

mr_status
mr_wrap_box_to_points(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, mr_dyn *d)
{
	double last = mr_wrap_length(cloud, o), length = last;
	mr_mesh m;

	while (2 * length < cloud->diagonal / FIRST_EDGES)
		length *= 2;
	MR_TRY(begin_box(ctx, cloud, length, d));
	MR_TRY(thin_level(ctx, cloud, o, length, FIRST_ROUNDS, d));
	while (length > 1.01 * last && is_finer_of_use(cloud, o, d)) {
		length /= 2;
		MR_TRY(thin_level(ctx, cloud, o, length, length > 1.01 * last ? ROUNDS : LAST_ROUNDS, d));
	}
	m = mr_dyn_view(d, "control");
	return mr_wrap_remesh(ctx, &m, length, d);
}
