/* The wrap by the volume; where that is poor, by one of a coarser grid. */
#include "volume/volume.h"
#include "wrap/parts.h"

static mr_status
wrap_volume_of(
    mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, size_t grid, const char *name, mr_wrap *c)
{
	mr_volume_opts volume = MR_VOLUME_DEFAULTS;
	double start = mr_seconds(), middle;
	mr_mesh m;

	c->found.method = MR_WRAP_VOLUME;
	volume.grid = grid;
	volume.sampling = &cloud->sampling;
	volume.sides = c->found.volume.sided > 0 ? cloud->sides : NULL; /* 0: they did not fit */
	MR_TRY(mr_volume_wrap(ctx, cloud->given, cloud->sampling.n, &volume, &m, &c->found.volume));
	c->sided = volume.sides && c->found.volume.sided > 0;
	middle = mr_seconds();
	c->found.seconds_volume = middle - start;
	MR_TRY(mr_wrap_remesh(ctx, &m, mr_wrap_length(cloud, o), &c->d));
	c->found.seconds_remesh = mr_seconds() - middle;
	return mr_wrap_finish(ctx, cloud, o, name, c);
}

/*
 * Where a tenth of the points are off the wrap, they are further apart one way than another, as the rows of a
 * sonar, and a grid as fine as the shorter way holds them asunder.  Of 196 clouds of 49 meshes, clean and
 * noisy, 186 have nine tenths within 2.2 sampling distances.
 */
static const double MISSES = 3;

static bool
misses(const mr_wrap *c, double unit)
{
	return c->cover.points_most > MISSES * unit;
}

/* The share of the way from the farther points to the wrap that a coarser grid must leave at most. */
static const double CLEARLY = 0.75;

/* Takes the volume of half as many cells in place of c where that reaches more and is no less certain. */
static mr_status
try_coarser(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, mr_wrap *c)
{
	double start = mr_seconds();
	mr_mark mark = mr_mark_take(ctx);
	mr_wrap other = *c;
	mr_status status = wrap_volume_of(
	    ctx, cloud, o, c->found.volume.grid / 2, "volume of a coarser grid", &other);
	bool better;

	if (status != MR_OK && status != MR_EMESH && status != MR_ERANGE)
		return status;
	better = status == MR_OK && other.cover.gaps.points.high < CLEARLY * c->cover.gaps.points.high &&
	         other.found.volume.levels_alike >= c->found.volume.levels_alike;
	if (better)
		*c = other;
	else
		mr_mark_release(ctx, mark);
	c->found.coarser = better;
	mr_wrap_tried(c, mr_seconds() - start);
	return MR_OK;
}

mr_status
mr_wrap_volume(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, mr_wrap *c)
{
	MR_TRY(wrap_volume_of(ctx, cloud, o, o->grid, "volume", c));
	return !o->grid && misses(c, cloud->spacing) ? try_coarser(ctx, cloud, o, c) : MR_OK;
}
