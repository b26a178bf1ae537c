/*
 * Signs of whole regions.  Where a sharp edge is sampled, planes alike pass a sign on wrongly, and the flood
 * does not know better where it comes in by an opening from behind; then the normals of a whole region are
 * wrong, each as its neighbours say.  The field of the right signs is the one of most energy: the normals
 * agree with the gradient of the indicator that they make.  So each region's own indicator tells whether the
 * others agree with it.
 */
#include "volume/parts.h"

#include "base/disjoint_sets.h"
#include "base/sort.h"

enum { REGIONS = 40, TURNS_MOST = 100 };

/* A region is a large thing: so many nodes and points show it. */
enum { NODES_MOST = 1 << 19, MEASURED_MOST = 1 << 17 };

/* Inside a region planes are flat, in units of the median variation, and alike.  Of the wraps that volume.c
 * counts 130 of 164 are right, by 1.5 and 6 129 and 132, by 0.8 and 0.95 131 and 130. */
static const double FLAT = 3, ALIKE = 0.9;

/* Points that a region must have to count, and their share. */
enum { POINTS_LEAST = 12 };
static const double REGION_LEAST = 0.002;

/* A region may be turned where the flood says less of its sign than this share of what it says of the largest
 * region's, and where that gains more than this share of the region's own energy.  Where none ever is, 131 of
 * those wraps are right, and 49 scans are 1 % nearer. */
static const double UNSURE = 0.25, GAIN_LEAST = 0.02;

typedef struct regions {
	uint32_t *of; /* n: the region of a point, REGIONS where it belongs to none */
	size_t count;
	double vote[REGIONS];          /* of the flood, mean: for the signs as they are */
	double pull[REGIONS][REGIONS]; /* how much one agrees with another */
} regions;

static bool
are_one(const mr_volume_cloud *s, uint32_t i, uint32_t j, double flat)
{
	return s->plane.variation[i] <= flat && s->plane.variation[j] <= flat &&
	       mr_dot(s->plane.normal[i], s->plane.normal[j]) > ALIKE;
}

/* The roots of the largest sets, by size, equal ones by number, into `root`.  Returns how many. */
static size_t
pick_largest(const mr_volume_cloud *s, const uint32_t *size, uint32_t root[REGIONS])
{
	double least = fmax(POINTS_LEAST, REGION_LEAST * (double)s->n);
	size_t count = 0;

	for (uint32_t i = 0; i < s->n; i++) {
		size_t k = count;
		if ((double)size[i] < least || (k == REGIONS && size[i] <= size[root[k - 1]]))
			continue;
		if (k == REGIONS)
			k--;
		else
			count++;
		for (; k > 0 && size[root[k - 1]] < size[i]; k--)
			root[k] = root[k - 1];
		root[k] = i;
	}
	return count;
}

/* size: zeros. */
static void
number_largest(const mr_volume_cloud *s, uint32_t *set, uint32_t *size, regions *r)
{
	uint32_t root[REGIONS], *number = size;

	for (uint32_t i = 0; i < s->n; i++) {
		r->of[i] = mr_sets_root(set, i);
		size[r->of[i]]++;
	}
	r->count = pick_largest(s, size, root);
	for (size_t i = 0; i < s->n; i++)
		number[i] = REGIONS;
	for (size_t k = 0; k < r->count; k++)
		number[root[k]] = (uint32_t)k;
	for (size_t i = 0; i < s->n; i++)
		r->of[i] = number[r->of[i]];
}

static mr_status
find_regions(mr_ctx *ctx, const mr_volume_cloud *s, regions *r)
{
	size_t links = s->plane.links;
	mr_mark mark;
	uint32_t *set, *size;
	double flat;

	MR_TRY(mr_median(ctx, s->plane.variation, s->n, &flat));
	flat *= FLAT;
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
count_votes(const mr_volume_cloud *s, const double *flood, regions *r)
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
measure_pull(const mr_volume_cloud *s, const mr_grid *g, const float *u, size_t a, regions *r)
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
measure_region(mr_ctx *ctx, mr_volume_cloud *s, const mr_grid *g, size_t levels, size_t a, regions *r)
{
	mr_mark mark = mr_mark_take(ctx);
	float *u = MR_NEW(ctx, mr_grid_nodes(g), float);
	mr_grid_multigrid m;
	mr_grid_points f;

	if (!u)
		return MR_EMEM;
	for (size_t i = 0; i < s->n; i++)
		s->depth[i] = r->of[i] != a;
	MR_TRY(mr_volume_field(ctx, s, g, 0, &f));
	MR_TRY(mr_multigrid_begin(ctx, g->n, levels, u, false, &m));
	mr_volume_divergence(ctx, s, &f, m.level[0].b);
	mr_multigrid_full(ctx, &m);
	measure_pull(s, g, u, a, r);
	mr_mark_release(ctx, mark);
	return MR_OK;
}

static bool
is_unsure(const regions *r, size_t a)
{
	return a > 0 && r->vote[a] < UNSURE * r->vote[0];
}

/* Points at equal strides, each for all of its stride, and the regions of these: as they lie in Morton order
 * every place has its share. */
static mr_status
thin_out(mr_ctx *ctx, const mr_volume_cloud *s, const regions *r, mr_volume_cloud *thin, uint32_t **of)
{
	size_t n = s->n < MEASURED_MOST ? s->n : MEASURED_MOST;
	uint32_t *region = MR_NEW(ctx, n, uint32_t);

	*thin = (mr_volume_cloud){ .n = n,
		.p = MR_NEW(ctx, n, mr_v3),
		.depth = MR_NEW(ctx, n, uint8_t),
		.plane = { .normal = MR_NEW(ctx, n, mr_v3), .area = MR_NEW(ctx, n, double) } };
	if (!region || !thin->p || !thin->depth || !thin->plane.normal || !thin->plane.area)
		return MR_EMEM;
	for (size_t i = 0; i < n; i++) {
		size_t at = i * s->n / n;
		region[i] = r->of[at];
		thin->p[i] = s->p[at];
		thin->plane.normal[i] = s->plane.normal[at];
		thin->plane.area[i] = s->plane.area[at] * (double)s->n / (double)n;
	}
	*of = region;
	return MR_OK;
}

/* Of the unsure regions; g: a level of the volume's. */
static mr_status
measure_unsure(mr_ctx *ctx, const mr_volume_cloud *s, const mr_grid *g, size_t levels, regions *r)
{
	mr_mark mark = mr_mark_take(ctx);
	uint32_t *all = r->of;
	mr_grid coarse = *g;
	mr_volume_cloud thin;

	for (; levels > 1 && mr_grid_nodes(&coarse) > NODES_MOST; levels--) {
		coarse.step *= 2;
		for (int k = 0; k < 3; k++)
			coarse.n[k] = (coarse.n[k] - 1) / 2 + 1;
	}
	MR_TRY(thin_out(ctx, s, r, &thin, &r->of));
	for (size_t a = 1; a < r->count; a++)
		if (is_unsure(r, a))
			MR_TRY(measure_region(ctx, &thin, &coarse, levels, a, r));
	r->of = all;
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* What turning a and b (or a alone) over would add to the energy.  What a and c pull at each other is alike.
 */
static double
gain(const regions *r, const double sign[REGIONS], size_t a, size_t b)
{
	double sum = 0;

	for (size_t c = 0; c < r->count; c++)
		if (c != a && c != b)
			sum -= 2 * sign[c] *
			       (sign[a] * r->pull[a][c] + (a == b ? 0 : sign[b] * r->pull[b][c]));
	return sum - GAIN_LEAST * (r->pull[a][a] + (a == b ? 0 : r->pull[b][b]));
}

/* The one region (twice), or the two, that gain most by being turned; 0 where none does.  The largest stays.
 */
static size_t
best_turn(const regions *r, const double sign[REGIONS], size_t *other)
{
	double most = 0;
	size_t best = 0;

	for (size_t a = 1; a < r->count; a++)
		for (size_t b = a; b < r->count; b++)
			if (is_unsure(r, a) && is_unsure(r, b) && gain(r, sign, a, b) > most) {
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
apply_signs(mr_ctx *ctx, const regions *r, const double sign[REGIONS], mr_volume_cloud *s)
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
	return mr_volume_orient(ctx, s, vote, NULL, true);
}

static bool
any_unsure(const regions *r)
{
	for (size_t a = 1; a < r->count; a++)
		if (is_unsure(r, a))
			return true;
	return false;
}

mr_status
mr_volume_regions(mr_ctx *ctx, mr_volume_cloud *s, const double *flood, const mr_grid *g, size_t levels,
    mr_volume_result *result)
{
	mr_mark mark = mr_mark_take(ctx);
	double sign[REGIONS];
	size_t turns = 0;
	regions r;

	MR_TRY(find_regions(ctx, s, &r));
	count_votes(s, flood, &r);
	if (any_unsure(&r)) {
		MR_TRY(measure_unsure(ctx, s, g, levels, &r));
		turns = turn_regions(&r, sign);
	}
	if (turns > 0)
		MR_TRY(apply_signs(ctx, &r, sign, s));
	result->regions = r.count;
	result->regions_turned = turns;
	mr_mark_release(ctx, mark);
	return MR_OK;
}
