/*
 * Signs of whole parts that agree with themselves.  No flood comes to the inner shell of a hollow body or far
 * into a bore, and what points there lie on is as much of a surface the other way round.  But the indicator
 * of bodies is 0 or 1: into a cavity that counts as a body it goes from 1 to 2, and from 0 to -1 into a body
 * that counts as a cavity.  On the surface it is 1/2, on one that is inside out 3/2 or -1/2.
 */
#include "volume/parts.h"

#include "base/disjoint_sets.h"

/*
 * Of the rise: how far beyond 0 and 1 the indicator is on what is inside out, as a mean over neighbours; on
 * an open surface it is near 0, and in a body near 1.  By 0.1 some bores stay bodies, by 0 a body that is cut
 * open is torn; by 0.05 of 300 clouds of 60 closed models, clean, noisy, near one another, holed and cut, ten
 * are right that were not, of hollow bodies, chains and pipes, and none is wrong that was right but by
 * chance.
 */
static const double BEYOND = 0.05;

/* Share of the points that a part has: noise makes smaller ones. */
static const double PART_LEAST = 0.01;

/* Whether the indicator, `at` each point, is on the mean over the point and its neighbours none of a body. */
static bool
is_inside_out(const mr_volume_cloud *s, const double *at, double rise, size_t i)
{
	const uint32_t *neighbor = s->plane.neighbor + i * s->plane.links;
	double sum = at[i], count = 1;

	for (size_t k = 0; k < s->plane.links && neighbor[k] != UINT32_MAX; k++, count++)
		sum += at[neighbor[k]];
	return sum < -BEYOND * rise * count || sum > (1 + BEYOND) * rise * count;
}

/* Joins neighbours that are wrong, and counts the points of each set, at its root. */
static void
join_wrong(const mr_volume_cloud *s, const uint8_t *wrong, uint32_t *part, uint32_t *size)
{
	size_t links = s->plane.links;

	for (uint32_t i = 0; i < s->n; i++)
		for (size_t k = i * links; k < (i + 1) * links && s->plane.neighbor[k] != UINT32_MAX; k++)
			if (wrong[i] && wrong[s->plane.neighbor[k]])
				mr_sets_join(part, i, s->plane.neighbor[k]);
	for (uint32_t i = 0; i < s->n; i++)
		size[mr_sets_root(part, i)]++;
}

mr_status
mr_volume_turn_parts(
    mr_ctx *ctx, mr_volume_cloud *s, const mr_grid *g, const float *u, double rise, size_t *turned)
{
	mr_mark mark = mr_mark_take(ctx);
	double *at = MR_NEW(ctx, s->n, double), most = fmin(rise, 1); /* nested parts make it more */
	uint32_t *part = mr_sets_new(ctx, s->n), *size = MR_NEW_ZERO(ctx, s->n, uint32_t);
	uint8_t *wrong = MR_NEW(ctx, s->n, uint8_t);

	if (!at || !part || !size || !wrong)
		return MR_EMEM;
	for (size_t i = 0; i < s->n; i++)
		at[i] = mr_volume_at(g, u, s->p[i]);
	for (size_t i = 0; i < s->n; i++)
		wrong[i] = is_inside_out(s, at, most, i);
	join_wrong(s, wrong, part, size);
	*turned = 0;
	for (uint32_t i = 0; i < s->n; i++)
		if (wrong[i] && size[mr_sets_root(part, i)] >= PART_LEAST * (double)s->n) {
			s->plane.normal[i] = mr_mul(-1, s->plane.normal[i]);
			++*turned;
		}
	mr_mark_release(ctx, mark);
	return MR_OK;
}
