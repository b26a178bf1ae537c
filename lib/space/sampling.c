/*
 * The sampling of a cloud by the nearest points of each: of a point's neighbourhood, the surface variation
 * (Pauly, Gross, Kobbelt 2002); outliers by how far they are from their neighbours, compared with these from
 * theirs (Breunig, Kriegel, Ng, Sander 2000: LOF).
 */
#include "space/sampling.h"

#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include "base/sort.h"
#include "mesh/layers.h"
#include "mesh/zorder.h"
#include "space/local_planes.h"
#include "space/near.h"

enum { AROUND = 8, NEAREST = 16, NEAREST_NOISY = 40, SOME = 10007, CHUNK = 1 << 13, GRAIN = 256 };

/* A neighbourhood of more variation shows noise, or a sharp shape: the larger one sees through noise.  But
 * where the first had not so much more, and the larger has more than it, it is the shape. */
static const double NOISY = 0.06, SURELY_NOISY = 0.12;

/*
 * An outlier is so many times as far from its neighbours as half of these from theirs; or as all usually are,
 * and its nearest make no plane (of this variation); or it has mostly outliers around.  Thin parts of a
 * surface that is sampled ever more sparsely make no planes either: there dense points lead to the sparse
 * ones.
 */
static const double ALONE = 2.5, SPARSE = 2.5, UNEVEN = 0.05, STREWN = 0.1;
enum { ROUNDS = 3 };

/* Few points far from all others may make a plane.  So points are outliers, too, if they are so many usual
 * spacings from their neighbours and so many times as far from the middle as nearly all. */
static const double APART = 6, BEYOND = 2, NEARLY = 0.95;

/* Fewer places have no outliers. */
enum { FEW = 64 };

/* Ratios of spacings. */
static const double LOW = 0.1, HIGH = 0.9;

/* The places, along the Z curve, where they do not depend on the order of the points. */
typedef struct cloud {
	mr_v3 *p;
	size_t n, around;
	mr_near *near;
	uint32_t *nearest; /* `around` of each, itself left out */
	double *spacing;
	uint8_t *kind, *outlier;
	double usual, reach; /* the median spacing; how far from the middle nearly all are */
	mr_v3 middle;
} cloud;

/* place: of each of n points. */
static void
find_places(mr_ctx *ctx, const mr_v3 *p, size_t n, uint32_t *place, uint8_t *repeat, cloud *c)
{
	uint32_t *order;

	c->p = MR_NEW(ctx, n, mr_v3);
	c->n = 0;
	MR_SCOPE(ctx);
	order = MR_NEW(ctx, n, uint32_t);
	mr_zorder(ctx, p, n, MR_ZORDER_CELLS, order);
	for (size_t i = 0; i < n; i++) {
		mr_v3 q = p[order[i]], *last = &c->p[c->n - (c->n > 0)];
		repeat[order[i]] = c->n > 0 && q.x == last->x && q.y == last->y && q.z == last->z;
		if (!repeat[order[i]])
			c->p[c->n++] = q;
		place[order[i]] = (uint32_t)(c->n - 1);
	}
}

/* c->nearest and c->spacing. */
static mr_status
find_spacing(mr_ctx *ctx, cloud *c)
{
	MR_SCOPE(ctx);
	size_t chunk = c->n < CHUNK ? c->n : CHUNK, k = c->around + 1;
	uint32_t *index = MR_NEW(ctx, chunk * k, uint32_t);
	double *dist2 = MR_NEW(ctx, chunk * k, double);

	for (size_t first = 0; first < c->n; first += chunk) {
		size_t m = c->n - first < chunk ? c->n - first : chunk;
		MR_TRY(mr_near_query(ctx, c->near, c->p + first, m, k, index, dist2));
		for (size_t i = 0; i < m; i++) {
			memcpy(c->nearest + (first + i) * c->around, index + i * k + 1,
			    c->around * sizeof *index);
			c->spacing[first + i] = sqrt(mr_own_area(dist2 + i * k + 1, c->around));
		}
	}
	return MR_OK;
}

/* ---- outliers ---- */

/* In the spacings of half of its neighbours. */
static double
isolation(const cloud *c, size_t i)
{
	double beside[AROUND];

	for (size_t j = 0; j < c->around; j++)
		beside[j] = c->spacing[c->nearest[i * c->around + j]];
	return c->spacing[i] / mr_kth(beside, c->around, c->around / 2);
}

/* Figures of the point and its neighbours. */
static double
unevenness(const cloud *c, size_t i)
{
	mr_v3 q[1 + AROUND] = { c->p[i] };
	double variation;

	for (size_t j = 0; j < c->around; j++)
		q[1 + j] = c->p[c->nearest[i * c->around + j]];
	mr_plane_fit(q, 1 + c->around, &variation);
	return variation;
}

static bool
is_apart(const cloud *c, size_t i)
{
	return c->spacing[i] > APART * c->usual && mr_dist(c->p[i], c->middle) > BEYOND * c->reach;
}

/* The class of a point by itself: an outlier, or, among sparse points, more likely one or not, or none. */
enum { DENSE, FLAT, DOUBTFUL, OUTLIER };

static void
judge(void *arg, size_t begin, size_t end)
{
	const cloud *c = arg;

	for (size_t i = begin; i < end; i++)
		if (isolation(c, i) > ALONE || is_apart(c, i))
			c->kind[i] = OUTLIER;
		else if (c->spacing[i] <= SPARSE * c->usual)
			c->kind[i] = DENSE;
		else
			c->kind[i] = unevenness(c, i) > UNEVEN ? DOUBTFUL : FLAT;
}

static size_t
outliers_around(const cloud *c, size_t i)
{
	size_t count = 0;

	for (size_t j = 0; j < c->around; j++)
		count += c->outlier[c->nearest[i * c->around + j]];
	return count;
}

/* Among outliers a plane may be chance. */
static void
spread(mr_ctx *ctx, cloud *c)
{
	MR_SCOPE(ctx);
	uint8_t *lost = MR_NEW(ctx, c->n, uint8_t);

	for (int round = 0; round < ROUNDS; round++) {
		for (size_t i = 0; i < c->n; i++)
			lost[i] = c->outlier[i] || 2 * outliers_around(c, i) > c->around;
		memcpy(c->outlier, lost, c->n);
	}
}

static bool
is_nearest(const cloud *c, uint32_t i, uint32_t of)
{
	for (size_t j = 0; j < c->around; j++)
		if (c->nearest[of * c->around + j] == i)
			return true;
	return false;
}

/* The sparse points that dense ones lead to, each among the nearest of the next; returns how many. list:
 * c->n, the caller's. */
static size_t
reach_sparse(const cloud *c, bool *reached, uint32_t *list)
{
	size_t n = 0, dense;

	for (uint32_t i = 0; i < c->n; i++) {
		reached[i] = c->kind[i] == DENSE && !c->outlier[i];
		if (reached[i])
			list[n++] = i;
	}
	dense = n;
	for (size_t k = 0; k < n; k++) {
		const uint32_t *to = c->nearest + list[k] * c->around;
		for (size_t j = 0; j < c->around; j++)
			if (!reached[to[j]] && c->kind[to[j]] != OUTLIER && is_nearest(c, list[k], to[j])) {
				reached[to[j]] = true;
				list[n++] = to[j];
			}
	}
	memmove(list, list + dense, (n - dense) * sizeof *list);
	return n - dense;
}

/* Regions of the listed points and of the sparse points reachable from them. */
static void
join_reached(const cloud *c, const bool *reached, const uint32_t *list, size_t n, uint32_t *region)
{
	for (size_t k = 0; k < n; k++)
		for (size_t j = 0; j < c->around; j++) {
			uint32_t to = c->nearest[list[k] * c->around + j];
			if (reached[to] && c->kind[to] != DENSE)
				mr_sets_join(region, list[k], to);
		}
}

/* Keeps the sparse ends of surfaces, however thin: regions of sparse points that dense ones lead to, unless
 * they are as uneven as points strewn in space. */
static void
keep_sparse_ends(mr_ctx *ctx, cloud *c)
{
	MR_SCOPE(ctx);
	uint32_t *list = MR_NEW(ctx, c->n, uint32_t), *region = mr_sets_new(ctx, c->n);
	size_t *count = MR_NEW_ZERO(ctx, c->n, size_t), n;
	double *sum = MR_NEW_ZERO(ctx, c->n, double);
	bool *reached = MR_NEW(ctx, c->n, bool);

	n = reach_sparse(c, reached, list);
	join_reached(c, reached, list, n, region);
	for (size_t k = 0; k < n; k++) {
		uint32_t r = mr_sets_root(region, list[k]);
		sum[r] += unevenness(c, list[k]);
		count[r]++;
	}
	for (size_t k = 0; k < n; k++) {
		uint32_t r = mr_sets_root(region, list[k]);
		if (sum[r] < STREWN * (double)count[r])
			c->outlier[list[k]] = false;
	}
}

static void
find_outliers(mr_ctx *ctx, cloud *c)
{
	mr_mark mark = mr_mark_take(ctx);
	double *x = MR_NEW(ctx, c->n, double);

	memcpy(x, c->spacing, c->n * sizeof *x);
	c->usual = mr_kth(x, c->n, c->n / 2);
	c->middle = mr_vec(0, 0, 0);
	for (size_t i = 0; i < c->n; i++)
		c->middle = mr_axpy(1 / (double)c->n, c->p[i], c->middle);
	for (size_t i = 0; i < c->n; i++)
		x[i] = mr_dist(c->p[i], c->middle);
	c->reach = mr_kth(x, c->n, (size_t)(NEARLY * (double)c->n));
	mr_mark_release(ctx, mark);
	mr_parallel(ctx, c->n, GRAIN, judge, c);
	for (size_t i = 0; i < c->n; i++)
		c->outlier[i] = c->kind[i] >= DOUBTFUL;
	spread(ctx, c);
	keep_sparse_ends(ctx, c);
}

/* ---- the quadric through points around one: weighted least squares by the normal equations ---- */

enum { TERMS = 6 };

/* Solves A x = b in place (Cholesky); false where A is not positive definite. */
static bool
solve(double a[TERMS][TERMS], double b[TERMS])
{
	for (int j = 0; j < TERMS; j++) {
		for (int i = j; i < TERMS; i++) {
			double s = a[i][j];
			for (int k = 0; k < j; k++)
				s -= a[i][k] * a[j][k];
			if (i == j && !(s > 1e-12 * a[j][j]))
				return false;
			a[i][j] = i == j ? sqrt(s) : s / a[j][j];
		}
	}
	for (int i = 0; i < TERMS; i++) {
		for (int k = 0; k < i; k++)
			b[i] -= a[i][k] * b[k];
		b[i] /= a[i][i];
	}
	for (int i = TERMS; i-- > 0;) {
		for (int k = i + 1; k < TERMS; k++)
			b[i] -= a[k][i] * b[k];
		b[i] /= a[i][i];
	}
	return true;
}

/* The quadric of least squares through n heights t; the quadratic terms shrink a little, which keeps the
 * system definite. */
static bool
fit_quadric(const double *row, const double *t, size_t n, double coefficient[TERMS])
{
	double a[TERMS][TERMS] = { { 0 } };

	memset(coefficient, 0, TERMS * sizeof *coefficient);
	for (size_t k = 0; k < n; k++)
		for (int i = 0; i < TERMS; i++) {
			const double *x = row + k * TERMS;
			coefficient[i] += x[i] * t[k];
			for (int j = 0; j <= i; j++)
				a[i][j] += x[i] * x[j];
		}
	for (int i = 1; i < TERMS; i++)
		a[i][i] += (i < 3 ? 1e-6 : 1e-3) * (double)n;
	return solve(a, coefficient);
}

/*
 * The signed distances of k points from the quadric through them over their plane; off: k, the caller's.
 * Returns their deviation: the root of the mean square, for the points beyond as many as make a quadric; 0,
 * and no distances, where these make none.
 */
static double
quadric_residuals(const mr_v3 *q, size_t k, double *off)
{
	double a[6], value[3], row[NEAREST_NOISY * TERMS], t[NEAREST_NOISY];
	double z[TERMS], radius2 = 0, radius, sum = 0;
	mr_v3 axis[3], mean = mr_vec(0, 0, 0);

	if (k <= TERMS)
		return 0;
	for (size_t i = 0; i < k; i++)
		mean = mr_axpy(1 / (double)k, q[i], mean);
	for (size_t i = 0; i < k; i++)
		radius2 = fmax(radius2, mr_norm2(mr_sub(q[i], mean)));
	radius = sqrt(radius2);
	mr_covariance(q, k, 1 / radius, a);
	mr_eigen_sym3(a, value, axis);
	for (size_t i = 0; i < k; i++) {
		mr_v3 d = mr_mul(1 / radius, mr_sub(q[i], mean));
		double x = mr_dot(d, axis[2]), y = mr_dot(d, axis[1]);
		/* coefficients of 1 x y xx rxy yy, r the root of 2: the norm of the last three is their
		 * matrix's */
		memcpy(row + i * TERMS, (double[TERMS]){ 1, x, y, x * x, sqrt(2) * x * y, y * y },
		    TERMS * sizeof *row);
		t[i] = mr_dot(d, axis[0]);
	}
	if (!fit_quadric(row, t, k, z))
		return 0;
	for (size_t i = 0; i < k; i++) {
		off[i] = radius * t[i];
		for (int j = 0; j < TERMS; j++)
			off[i] -= radius * z[j] * row[i * TERMS + (size_t)j];
		sum += off[i] * off[i];
	}
	return sqrt(sum / (double)(k - TERMS));
}

/* ---- noise ---- */

/* Uses some places, at equal strides. */
typedef struct look {
	const cloud *c;
	size_t k;
	const uint32_t *index; /* k of each, itself the first */
	double *variation, *residual;
} look;

static void
look_around(void *arg, size_t begin, size_t end)
{
	const look *l = arg;
	mr_v3 q[NEAREST_NOISY];
	double off[NEAREST_NOISY];

	for (size_t i = begin; i < end; i++) {
		for (size_t j = 0; j < l->k; j++)
			q[j] = l->c->p[l->index[i * l->k + j]];
		if (l->k <= NEAREST)
			mr_plane_around(q, l->k, &l->variation[i]);
		else
			mr_plane_fit(q, l->k, &l->variation[i]);
		l->residual[i] = quadric_residuals(q, l->k, off);
	}
}

/* The medians of neighbourhoods of k points. */
static mr_status
look_at(mr_ctx *ctx, const cloud *c, size_t k, double *variation, double *noise)
{
	MR_SCOPE(ctx);
	size_t n = c->n < SOME ? c->n : SOME;
	mr_v3 *q = MR_NEW(ctx, n, mr_v3);
	uint32_t *index = MR_NEW(ctx, n * k, uint32_t);
	look l = { c, k, index, MR_NEW(ctx, n, double), MR_NEW(ctx, n, double) };

	mr_at_strides(c->p, c->n, n, q);
	MR_TRY(mr_near_query(ctx, c->near, q, n, k, index, NULL));
	mr_parallel(ctx, n, GRAIN, look_around, &l);
	*variation = mr_kth(l.variation, n, n / 2);
	*noise = mr_kth(l.residual, n, n / 2);
	return MR_OK;
}

static mr_status
find_noise(mr_ctx *ctx, const cloud *c, mr_sampling *s)
{
	double variation, wide, noise;

	if (c->n < NEAREST)
		return MR_OK;
	MR_TRY(look_at(ctx, c, NEAREST, &variation, &s->noise));
	if (variation <= NOISY || c->n < NEAREST_NOISY)
		return MR_OK;
	MR_TRY(look_at(ctx, c, NEAREST_NOISY, &wide, &noise));
	if (variation < SURELY_NOISY && wide > variation)
		return MR_OK;
	s->neighbours = NEAREST_NOISY;
	s->noise = noise;
	return MR_OK;
}

/* ---- the whole ---- */

/* The figures of the places that are no outliers, whose spacings are x. */
static void
sum_up(mr_sampling *s, double *x, size_t count)
{
	double high;

	s->usual = mr_kth(x, count, count / 2);
	high = mr_kth(x, count, (size_t)(HIGH * (double)count));
	s->evenness = high > 0 ? mr_kth(x, count, (size_t)(LOW * (double)count)) / high : 1;
	for (size_t i = 0; i < count; i++)
		s->area += x[i] * x[i];
}

/* All but noise, by the columns. */
static void
find_figures(mr_ctx *ctx, mr_sampling *s)
{
	MR_SCOPE(ctx);
	double *x = MR_NEW(ctx, s->n, double);
	size_t count = 0;

	s->places = s->outliers = 0;
	s->usual = s->area = s->evenness = 0;
	for (size_t i = 0; i < s->n; i++) {
		s->places += !s->repeat[i];
		s->outliers += !s->repeat[i] && s->outlier[i];
		if (!s->repeat[i] && !s->outlier[i])
			x[count++] = s->spacing[i];
	}
	if (count > 0)
		sum_up(s, x, count);
}

/* c->p is there, and c->near of two places or more. */
static mr_status
find_of_places(mr_ctx *ctx, cloud *c, mr_sampling *s)
{

	c->around = c->n < 1 + AROUND ? c->n - (c->n > 0) : AROUND;
	c->nearest = MR_NEW(ctx, c->n * c->around, uint32_t);
	c->spacing = MR_NEW_ZERO(ctx, c->n, double);
	c->kind = MR_NEW(ctx, c->n, uint8_t);
	c->outlier = MR_NEW_ZERO(ctx, c->n, uint8_t);
	s->neighbours = NEAREST;
	s->noise = 0;
	if (c->n < 2)
		return MR_OK;
	MR_TRY(find_spacing(ctx, c));
	MR_TRY(find_noise(ctx, c, s));
	if (c->n >= FEW)
		find_outliers(ctx, c);
	return MR_OK;
}

static mr_status
find(mr_ctx *ctx, const mr_v3 *p, size_t n, mr_sampling *out)
{
	double *spacing = MR_NEW(ctx, n, double);
	uint8_t *outlier = MR_NEW(ctx, n, uint8_t), *repeat = MR_NEW(ctx, n, uint8_t);
	mr_mark mark = mr_mark_take(ctx), behind;
	uint32_t *place = MR_NEW(ctx, n, uint32_t);
	mr_sampling s = { .spacing = spacing, .outlier = outlier, .repeat = repeat, .n = n };
	cloud c = { .near = NULL };

	find_places(ctx, p, n, place, repeat, &c);
	if (c.n > 1)
		MR_TRY(mr_near_build_distinct(ctx, c.p, c.n, &c.near));
	behind = mr_mark_take(ctx);
	MR_TRY(find_of_places(ctx, &c, &s));
	for (size_t i = 0; i < n; i++) {
		spacing[i] = c.spacing[place[i]];
		outlier[i] = c.outlier[place[i]];
	}
	mr_mark_release(ctx, behind);
	find_figures(ctx, &s);
	if (s.outliers == 0)
		s.near = c.near;
	else
		mr_mark_release(ctx, mark);
	*out = s;
	return MR_OK;
}

mr_status
mr_sampling_find(mr_ctx *ctx, const mr_v3 *p, size_t n, const mr_sampling *known, mr_sampling *s)
{
	if (!known)
		return find(ctx, p, n, s);
	*s = *known;
	return MR_OK;
}

void
mr_sampling_sort(mr_ctx *ctx, const mr_v3 *p, const mr_sampling *s, mr_v3 *sorted, mr_sampling *of_sorted)
{
	double *spacing = MR_NEW(ctx, s->n, double);
	uint8_t *outlier = MR_NEW(ctx, s->n, uint8_t), *repeat = MR_NEW(ctx, s->n, uint8_t);
	MR_SCOPE(ctx);
	uint32_t *order = MR_NEW(ctx, s->n, uint32_t);

	mr_zorder(ctx, p, s->n, MR_ZORDER_CELLS, order);
	for (size_t i = 0; i < s->n; i++) {
		sorted[i] = p[order[i]];
		spacing[i] = s->spacing[order[i]];
		outlier[i] = s->outlier[order[i]];
		repeat[i] = s->repeat[order[i]];
	}
	*of_sorted = *s;
	of_sorted->spacing = spacing;
	of_sorted->outlier = outlier;
	of_sorted->repeat = repeat;
}

void
mr_sampling_places(
    mr_ctx *ctx, const mr_v3 *p, const mr_sampling *s, mr_v3 **place, uint32_t **index, size_t *count)
{
	mr_v3 *q = MR_NEW(ctx, s->n, mr_v3), *kept;
	uint32_t *of = MR_NEW(ctx, s->n, uint32_t), *from, *order;
	size_t n = 0;

	MR_SCOPE(ctx);
	kept = MR_NEW(ctx, s->n, mr_v3);
	from = MR_NEW(ctx, s->n, uint32_t);
	order = MR_NEW(ctx, s->n, uint32_t);
	for (uint32_t i = 0; i < s->n; i++)
		if (!s->repeat[i] && !s->outlier[i]) {
			kept[n] = p[i];
			from[n++] = i;
		}
	mr_zorder(ctx, kept, n, MR_ZORDER_CELLS, order);
	for (size_t i = 0; i < n; i++) {
		q[i] = kept[order[i]];
		of[i] = from[order[i]];
	}
	*place = q;
	if (index)
		*index = of;
	*count = n;
}

/* ---- columns ---- */

static mr_status
check_columns(mr_ctx *ctx, const char *layer, const mr_sampling *s, const double *whole)
{
	for (size_t i = 0; i < s->n; i++)
		if (!(s->spacing[i] >= 0 && isfinite(s->spacing[i])) || s->outlier[i] > 1 || s->repeat[i] > 1)
			return mr_fail(ctx, MR_ERANGE, "%s: point %zu has spacing %g, outlier %u, repeat %u",
			    layer, i, s->spacing[i], s->outlier[i], s->repeat[i]);
	if (!(whole[0] >= 0 && isfinite(whole[0])) || !(whole[1] >= NEAREST && whole[1] <= NEAREST_NOISY))
		return mr_fail(ctx, MR_ERANGE,
		    "%s: column sampling holds noise %g, %g neighbours of %d to %d", layer, whole[0],
		    whole[1], NEAREST, NEAREST_NOISY);
	return MR_OK;
}

/* Squares of lengths below 1e-162 are 0: such spacings are no unit. */
static mr_status
check_usual(mr_ctx *ctx, const char *layer, const mr_sampling *s)
{
	if (s->places - s->outliers < 2 || s->usual > 0)
		return MR_OK;
	return mr_fail(ctx, MR_ERANGE,
	    "%s: the median spacing of %zu points is 0: they lie closer to each other than can be computed "
	    "with",
	    layer, s->places - s->outliers);
}

mr_status
mr_sampling_stored(mr_ctx *ctx, mr_frame *f, const char *layer, size_t n, mr_sampling *out, bool *stored)
{
	const void *spacing, *outlier, *repeat, *whole;
	mr_sampling s = { .n = n };

	*stored = false;
	if (!mr_layer_has(f, layer, "spacing") || !mr_layer_has(f, layer, "outlier") ||
	    !mr_layer_has(f, layer, "repeat") || !mr_layer_has(f, layer, "sampling"))
		return MR_OK;
	MR_TRY(mr_layer_get_rows(ctx, f, layer, "spacing", n, &spacing));
	MR_TRY(mr_layer_get_rows(ctx, f, layer, "outlier", n, &outlier));
	MR_TRY(mr_layer_get_rows(ctx, f, layer, "repeat", n, &repeat));
	MR_TRY(mr_layer_get_rows(ctx, f, layer, "sampling", 1, &whole));
	s.spacing = spacing;
	s.outlier = outlier;
	s.repeat = repeat;
	MR_TRY(check_columns(ctx, layer, &s, whole));
	s.noise = ((const double *)whole)[0];
	s.neighbours = (size_t)((const double *)whole)[1];
	find_figures(ctx, &s);
	MR_TRY(check_usual(ctx, layer, &s));
	*out = s;
	*stored = true;
	return MR_OK;
}

static mr_status
put_columns(mr_ctx *ctx, mr_frame *f, const char *layer, const mr_sampling *s)
{
	double *whole = MR_NEW(ctx, 2, double);

	whole[0] = s->noise;
	whole[1] = (double)s->neighbours;
	MR_TRY(mr_layer_put(ctx, f, layer, "spacing", s->spacing, s->n));
	MR_TRY(mr_layer_put(ctx, f, layer, "outlier", s->outlier, s->n));
	MR_TRY(mr_layer_put(ctx, f, layer, "repeat", s->repeat, s->n));
	return mr_layer_put(ctx, f, layer, "sampling", whole, 1);
}

mr_status
mr_sampling_of(mr_ctx *ctx, mr_frame *f, const mr_mesh *points, mr_sampling *s)
{
	const mr_column *faces = mr_frame_find(f, points->name, "triangles");
	bool stored;

	MR_TRY(mr_sampling_stored(ctx, f, points->name, points->nv, s, &stored));
	if (stored)
		return MR_OK;
	MR_TRY(mr_prefix(ctx, find(ctx, points->p, points->nv, s), "%s", points->name));
	MR_TRY(check_usual(ctx, points->name, s));
	return faces && faces->rows ? MR_OK : put_columns(ctx, f, points->name, s);
}
