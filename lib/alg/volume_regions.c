/*
 * Signs of whole regions.  Where a sharp edge is sampled, planes alike pass a sign on wrongly, and the flood
 * does not know better where it comes in by an opening from behind; then the normals of a whole region are
 * wrong, each as its neighbours say.  The field of the right signs is the one of most energy: the normals
 * agree with the gradient of the indicator that they make.  So each region's own indicator tells whether the
 * others agree with it.
 */
#include "alg/volume_parts.h"

#include "base/sets.h"

enum { REGIONS = 40, TURNS_MOST = 100 };

/* Inside a region planes are flat, in units of the median variation, and alike. */
static const double FLAT = 3, ALIKE = 0.9;

/* Points that a region must have to count, and their share. */
enum { POINTS_LEAST = 12 };
static const double REGION_LEAST = 0.002;

/* A region may be turned where the flood says less of its sign than this share of what it says of the largest
 * region's, and where that gains more than this share of the region's own energy. */
static const double UNSURE = 0.25, GAIN_LEAST = 0.02;

typedef struct regions {
	uint32_t *of; /* n: the region of a point, REGIONS where it belongs to none */
	size_t count;
	double vote[REGIONS];          /* of the flood, mean: for the signs as they are */
	double pull[REGIONS][REGIONS]; /* how much one agrees with another */
} regions;

static int
ascending(const void *a, const void *b)
{
	const double *x = a, *y = b;

	return (*x > *y) - (*x < *y);
}

static mr_status
flat_limit(mr_ctx *ctx, const samples *s, double *limit)
{
	mr_mark mark = mr_mark_take(ctx);
	double *v = MR_NEW(ctx, s->n, double);

	if (!v)
		return MR_EMEM;
	memcpy(v, s->plane.variation, s->n * sizeof *v);
	qsort(v, s->n, sizeof *v, ascending);
	*limit = FLAT * v[s->n / 2];
	mr_mark_release(ctx, mark);
	return MR_OK;
}

static bool
are_one(const samples *s, uint32_t i, uint32_t j, double flat)
{
	return s->plane.variation[i] <= flat && s->plane.variation[j] <= flat &&
	       mr_dot(s->plane.normal[i], s->plane.normal[j]) > ALIKE;
}

/* Numbers the largest sets, by size. */
static void
number_largest(const samples *s, uint32_t *set, uint32_t *size, regions *r)
{
	for (uint32_t i = 0; i < s->n; i++) {
		size[mr_sets_root(set, i)]++;
		r->of[i] = REGIONS;
	}
	for (r->count = 0; r->count < REGIONS; r->count++) {
		uint32_t best = 0;
		for (uint32_t i = 1; i < s->n; i++)
			if (size[i] > size[best])
				best = i;
		if (size[best] < POINTS_LEAST || (double)size[best] < REGION_LEAST * (double)s->n)
			return;
		size[best] = 0;
		for (uint32_t i = 0; i < s->n; i++)
			if (mr_sets_root(set, i) == best)
				r->of[i] = (uint32_t)r->count;
	}
}

static mr_status
find_regions(mr_ctx *ctx, const samples *s, regions *r)
{
	size_t links = s->plane.links;
	mr_mark mark;
	uint32_t *set, *size;
	double flat;

	MR_TRY(flat_limit(ctx, s, &flat));
	r->of = MR_NEW(ctx, s->n, uint32_t);
	mark = mr_mark_take(ctx);
	set = mr_sets_new(ctx, s->n);
	size = MR_NEW_ZERO(ctx, s->n, uint32_t);
	if (!r->of || !set || !size)
		return MR_EMEM;
	for (uint32_t i = 0; i < s->n; i++)
		for (size_t k = 0; k < links && s->plane.neighbor[i * links + k] != UINT32_MAX; k++)
			if (are_one(s, i, s->plane.neighbor[i * links + k], flat))
				mr_sets_join(set, i, s->plane.neighbor[i * links + k]);
	number_largest(s, set, size, r);
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* What the flood says of the signs as they are, on the mean. */
static void
count_votes(const samples *s, const double *flood, regions *r)
{
	double count[REGIONS] = { 0 };

	for (size_t a = 0; a < r->count; a++)
		r->vote[a] = 0;
	for (size_t i = 0; i < s->n; i++)
		if (r->of[i] < REGIONS) {
			r->vote[r->of[i]] += flood[i];
			count[r->of[i]]++;
		}
	for (size_t a = 0; a < r->count; a++)
		r->vote[a] /= count[a];
}

/* pull[a][b] = sum over b of area times how much the indicator of a falls along the normal. */
static void
measure_pull(const samples *s, const mr_grid *g, const float *u, size_t a, regions *r)
{
	for (size_t b = 0; b < r->count; b++)
		r->pull[a][b] = 0;
	for (size_t i = 0; i < s->n; i++) {
		mr_v3 d = mr_mul(g->step / 2, s->plane.normal[i]);
		if (r->of[i] < REGIONS)
			r->pull[a][r->of[i]] += s->plane.area[i] *
			                        (mr_volume_at(g, u, mr_sub(s->p[i], d)) -
						    mr_volume_at(g, u, mr_add(s->p[i], d)));
	}
}

static mr_status
measure_region(mr_ctx *ctx, const samples *s, const mr_grid *g, size_t levels, size_t a, regions *r)
{
	mr_mark mark = mr_mark_take(ctx);
	samples one = *s;
	multigrid m;
	field f;

	one.depth = MR_NEW(ctx, s->n, uint8_t);
	if (!one.depth)
		return MR_EMEM;
	for (size_t i = 0; i < s->n; i++)
		one.depth[i] = r->of[i] != a;
	MR_TRY(mr_volume_field(ctx, &one, g, 0, &f));
	MR_TRY(mr_multigrid_begin(ctx, g->n, levels, false, &m));
	mr_volume_divergence(ctx, &one, &f, m.level[0].b);
	mr_multigrid_full(ctx, &m);
	measure_pull(s, g, m.level[0].u, a, r);
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* What turning a and b (or a alone) over would add to the energy. */
static double
gain(const regions *r, const double sign[REGIONS], size_t a, size_t b)
{
	double sum = 0;

	for (size_t c = 0; c < r->count; c++)
		if (c != a && c != b)
			sum -= sign[c] * (sign[a] * (r->pull[a][c] + r->pull[c][a]) +
					     (a == b ? 0 : sign[b] * (r->pull[b][c] + r->pull[c][b])));
	return sum - GAIN_LEAST * (r->pull[a][a] + (a == b ? 0 : r->pull[b][b]));
}

/* The one region (twice), or the two, that gain most by being turned; 0 where none does.  The largest stays.
 */
static size_t
best_turn(const regions *r, const double sign[REGIONS], size_t *other)
{
	double most = 0, unsure = UNSURE * r->vote[0];
	size_t best = 0;

	for (size_t a = 1; a < r->count; a++)
		for (size_t b = a; b < r->count; b++)
			if (r->vote[a] < unsure && r->vote[b] < unsure && gain(r, sign, a, b) > most) {
				most = gain(r, sign, a, b);
				best = a;
				*other = b;
			}
	return best;
}

static size_t
turn_regions(const regions *r, double sign[REGIONS])
{
	size_t turns = 0, a, b = 0;

	for (size_t k = 0; k < r->count; k++)
		sign[k] = 1;
	while (turns < TURNS_MOST && (a = best_turn(r, sign, &b)) > 0) {
		sign[a] *= -1;
		if (b != a)
			sign[b] *= -1;
		turns++;
	}
	return turns;
}

/* The other points follow the regions. */
static mr_status
apply_signs(mr_ctx *ctx, const regions *r, const double sign[REGIONS], samples *s)
{
	double *vote = MR_NEW_ZERO(ctx, s->n, double);

	if (!vote)
		return MR_EMEM;
	for (size_t i = 0; i < s->n; i++) {
		if (r->of[i] == REGIONS)
			continue;
		vote[i] = 1;
		if (sign[r->of[i]] < 0)
			s->plane.normal[i] = mr_mul(-1, s->plane.normal[i]);
	}
	return mr_volume_orient(ctx, s, vote);
}

static bool
any_unsure(const regions *r)
{
	for (size_t a = 1; a < r->count; a++)
		if (r->vote[a] < UNSURE * r->vote[0])
			return true;
	return false;
}

mr_status
mr_volume_regions(mr_ctx *ctx, samples *s, const double *flood, const mr_grid *g, size_t levels)
{
	mr_mark mark = mr_mark_take(ctx);
	double sign[REGIONS];
	size_t turns = 0;
	regions r;

	MR_TRY(find_regions(ctx, s, &r));
	count_votes(s, flood, &r);
	if (any_unsure(&r)) {
		for (size_t a = 0; a < r.count; a++)
			MR_TRY(measure_region(ctx, s, g, levels, a, &r));
		turns = turn_regions(&r, sign);
	}
	if (turns > 0)
		MR_TRY(apply_signs(ctx, &r, sign, s));
	mr_stat_set(ctx, "regions", (double)r.count);
	mr_stat_set(ctx, "regions_turned", (double)turns);
	mr_mark_release(ctx, mark);
	return MR_OK;
}
