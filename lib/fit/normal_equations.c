/*
 * Gathers what points, face by face, and fairness ask of the control vertices.  A point pulls along the
 * normal in full and along the surface by a share: between the tangent and the point distance minimization
 * that Wang, Pottmann, Liu 2006 compare (Fitting B-spline curves to point clouds by curvature-based squared
 * distance minimization).
 */
#include "fit/normal_equations.h"

#include "base/parallel.h"

enum { GRAIN = 16, PIECE = 512 }; /* control faces */

/* Keeps what no point and no neighbour holds; anything from 1e-12 to 1e-6 moves distances by less than 1e-3.
 */
static const double SMALL = 1e-9;

/* Rows of L: the vertex less the mean of its neighbours; none where it has none. */
static void
star_rows(mr_ctx *ctx, const mr_fit_lists *l, double **row)
{
	double *r = MR_NEW(ctx, l->start[l->count], double);

	for (size_t v = 0; v < l->count; v++)
		for (size_t i = l->start[v], n = mr_fit_length(l, v) - 1; i < l->start[v + 1]; i++)
			r[i] = n == 0 ? 0 : l->member[i] == (int)v ? 1 : -1 / (double)n;
	*row = r;
}

typedef struct basis_job {
	const mr_fit_surface *s;
	const mr_fit_lists *l;
	double *basis;
} basis_job;

static void
spread_basis(void *arg, size_t begin, size_t end)
{
	basis_job *j = arg;
	const mr_sparse *s = &j->s->s;

	for (size_t f = begin; f < end; f++) {
		const int *list = j->l->member + j->l->start[f];
		size_t n = mr_fit_length(j->l, f);
		double *to = j->basis + MR_FIT_SLOTS * j->l->start[f];
		uint32_t slot[MR_FIT_SLOTS];
		mr_fit_slots(j->s, f, slot);
		for (size_t i = 0; i < MR_FIT_SLOTS; i++)
			for (int e = s->start[slot[i]]; e < s->start[slot[i] + 1]; e++)
				to[i * n + mr_fit_find(list, n, s->index[e])] = s->value[e];
	}
}

mr_status
mr_fit_system_build(
    mr_ctx *ctx, const mr_fit_surface *surface, const mr_v3 *x, double form, mr_fit_system *system)
{
	size_t nv = surface->level[0].nv;
	mr_fit_system r = { .surface = surface, .form = form };
	mr_v3 *home = MR_NEW(ctx, nv, mr_v3);

	memcpy(home, x, nv * sizeof *home);
	r.home = home;

	mr_fit_list_patches(ctx, surface, &r.patch);
	mr_fit_list_stars(ctx, &surface->level[0], &r.star);
	star_rows(ctx, &r.star, &r.star_row);
	r.basis = MR_NEW_ZERO(ctx, MR_FIT_SLOTS * r.patch.start[r.patch.count], double);
	r.b = MR_NEW(ctx, nv, mr_v3);
	mr_parallel(ctx, r.patch.count, GRAIN, spread_basis, &(basis_job){ surface, &r.patch, r.basis });
	MR_TRY(mr_fit_pattern(ctx, &r.patch, &r.star, nv, &r.a));
	r.block = MR_NEW(ctx, (size_t)r.a.start[nv], mr_fit_block);
	mr_fit_place_pairs(ctx, &r.patch, &r.a, &r.patch_pairs, &r.patch_at);
	mr_fit_place_pairs(ctx, &r.star, &r.a, &r.star_pairs, &r.star_at);
	*system = r;
	return MR_OK;
}

/* Filling */

/* The points on each control face, by index: order[start[f]] to order[start[f + 1]]. */
static void
sort_points(mr_ctx *ctx, const mr_fit_foot *foot, size_t n, size_t nf, size_t **start, uint32_t **order)
{
	size_t *s = MR_NEW_ZERO(ctx, nf + 2, size_t);
	uint32_t *o = MR_NEW(ctx, n, uint32_t);

	for (size_t i = 0; i < n; i++)
		s[foot[i].patch / MR_FIT_PATCHES + 2]++;
	for (size_t f = 0; f < nf; f++)
		s[f + 2] += s[f + 1];
	for (size_t i = 0; i < n; i++)
		o[s[foot[i].patch / MR_FIT_PATCHES + 1]++] = (uint32_t)i;
	*start = s;
	*order = o;
}

typedef struct fill_job {
	mr_fit_system *system;
	const mr_v3 *point;
	const mr_fit_foot *foot;
	const double *w;
	const size_t *start;
	const uint32_t *order;
	double scale;       /* nv / n */
	size_t first, last; /* control faces */
	mr_fit_block *pair; /* of each pair of these faces, as patch_at */
	mr_v3 *sum;         /* of each entry of patch */
	double *row;        /* the same: workspace */
} fill_job;

/* The row of a point over its control face's list. */
static void
row_of(const double *basis, size_t n, const mr_fit_foot *foot, double *row)
{
	const double *node = basis + (size_t)(foot->patch % MR_FIT_PATCHES) * MR_FIT_PATCH * n;
	double w[MR_FIT_PATCH];

	mr_fit_weights(foot->bary, w);
	for (size_t i = 0; i < n; i++)
		row[i] = w[0] * node[i] + w[1] * node[n + i] + w[2] * node[2 * n + i] +
		         w[3] * node[3 * n + i] + w[4] * node[4 * n + i] + w[5] * node[5 * n + i];
}

/* The direction in which a point's distance counts in full: the normal, or that of the distance where the
 * foot stands on the boundary. */
static mr_v3
direction_of(mr_v3 normal, mr_v3 r)
{
	double along = mr_dot(normal, r);

	return along * along < 0.25 * mr_norm2(r) ? mr_unit(r) : normal;
}

/* w d d^T */
static mr_fit_block
outer(double w, mr_v3 d)
{
	return (mr_fit_block){ { w * d.x * d.x, w * d.y * d.y, w * d.z * d.z, w * d.x * d.y, w * d.y * d.z,
	    w * d.z * d.x } };
}

/* Adds a point of weight w with residual r and direction d to its face's pairs and sums. */
static void
add_point(const double *row, size_t n, double w, mr_v3 r, mr_v3 d, mr_fit_block *pair, mr_v3 *sum)
{
	mr_fit_block block = outer(w, d);
	mr_v3 pull = mr_axpy(w * (1 - MR_FIT_SLIP) * mr_dot(r, d), d, mr_mul(w * MR_FIT_SLIP, r));

	for (size_t a = 0; a < n; a++) {
		sum[a] = mr_axpy(row[a], pull, sum[a]);
		for (size_t b = 0; b <= a; b++, pair++) {
			double c = row[a] * row[b];
			for (int k = 0; k < MR_FIT_BLOCK; k++)
				pair->m[k] += c * block.m[k];
		}
	}
}

static void
fill_patches(void *arg, size_t begin, size_t end)
{
	fill_job *j = arg;
	const mr_fit_system *s = j->system;
	const mr_fit_lists *l = &s->patch;

	for (size_t f = j->first + begin; f < j->first + end; f++) {
		size_t n = mr_fit_length(l, f);
		double *row = j->row + l->start[f];
		mr_fit_block *pair = j->pair + (s->patch_pairs[f] - s->patch_pairs[j->first]);
		mr_v3 *sum = j->sum + l->start[f];
		memset(pair, 0, n * (n + 1) / 2 * sizeof *pair);
		memset(sum, 0, n * sizeof *sum);
		for (size_t i = j->start[f]; i < j->start[f + 1]; i++) {
			uint32_t k = j->order[i];
			mr_v3 normal, r = mr_sub(j->point[k], mr_fit_place(s->surface, &j->foot[k], &normal));
			row_of(s->basis + MR_FIT_SLOTS * l->start[f], n, &j->foot[k], row);
			add_point(row, n, j->scale * j->w[k], r, direction_of(normal, r), pair, sum);
		}
	}
}

/* Adds the pairs and sums of the faces to the equations, in their order. */
static void
gather(const fill_job *j)
{
	mr_fit_system *s = j->system;
	const mr_fit_lists *l = &s->patch;
	size_t from = s->patch_pairs[j->first];

	for (size_t k = from; k < s->patch_pairs[j->last]; k++)
		for (int i = 0; i < MR_FIT_BLOCK; i++)
			s->block[s->patch_at[k]].m[i] += j->pair[k - from].m[i];
	for (size_t i = l->start[j->first]; i < l->start[j->last]; i++)
		s->b[l->member[i]] = mr_add(s->b[l->member[i]], j->sum[i]);
}

/* Pairs of the largest piece. */
static size_t
most_pairs(const mr_fit_system *s)
{
	size_t most = 0, count = s->patch.count;

	for (size_t f = 0; f < count; f += PIECE) {
		size_t last = f + PIECE < count ? f + PIECE : count,
		       n = s->patch_pairs[last] - s->patch_pairs[f];
		most = n > most ? n : most;
	}
	return most;
}

/* Piece by piece, so that the pairs of all faces are never in memory at once. */
static void
add_points(mr_ctx *ctx, mr_fit_system *s, fill_job j)
{
	const mr_fit_lists *l = &s->patch;

	j.pair = MR_NEW(ctx, most_pairs(s), mr_fit_block);
	j.sum = MR_NEW(ctx, l->start[l->count], mr_v3);
	j.row = MR_NEW(ctx, l->start[l->count], double);
	for (j.first = 0; j.first < l->count; j.first = j.last) {
		j.last = j.first + PIECE < l->count ? j.first + PIECE : l->count;
		mr_parallel(ctx, j.last - j.first, GRAIN, fill_patches, &j);
		gather(&j);
	}
}

/* Splits the points' part, slip A + (1 - slip) N with A the trace of N, into a multiple of the identity and a
 * rest of trace 0. */
static void
split_trace(mr_fit_system *s)
{
	for (int k = 0; k < s->a.start[s->a.n]; k++) {
		double *m = s->block[k].m, trace = m[0] + m[1] + m[2];
		for (int i = 0; i < MR_FIT_BLOCK; i++)
			m[i] = (1 - MR_FIT_SLIP) * (m[i] - (i < 3 ? trace / 3 : 0));
		s->a.value[k] = (MR_FIT_SLIP + (1 - MR_FIT_SLIP) / 3) * trace;
	}
}

/*
 * How bare each vertex is: 1 where no point stands on the faces around it, 0 where as many do as it usually
 * has faces.  Twice as many or half of it: no model of 24 is off by 1 % more or less.
 */
static void
measure_bare(mr_ctx *ctx, const mr_fit_system *s, const size_t *start, double **bare)
{
	const double enough = 6;
	const mr_loop *l = &s->surface->level[0];
	double *x = MR_NEW_ZERO(ctx, l->nv, double);

	for (size_t f = 0; f < l->nf; f++)
		for (int k = 0; k < 3; k++)
			x[l->t[f].v[k]] += (double)(start[f + 1] - start[f]);
	for (size_t v = 0; v < l->nv; v++)
		x[v] = mr_fit_length(&s->star, v) == 1 ? 1 : fmax(0, 1 - x[v] / enough);
	*bare = x;
}

/* L (x - c home) at vertex v: what it is bent by, beyond the share of what it was. */
static mr_v3
bend_at(const mr_fit_system *s, const mr_v3 *x, double bare, size_t v)
{
	const mr_fit_lists *l = &s->star;
	mr_v3 sum = { 0, 0, 0 };
	double c = fmax(s->form, bare);

	for (size_t i = l->start[v]; i < l->start[v + 1]; i++) {
		int j = l->member[i];
		sum = mr_axpy(s->star_row[i], mr_axpy(-c, s->home[j], x[j]), sum);
	}
	return sum;
}

/* fairness |L (x + z - c home)|^2: the outer product of each row of L, and -L (x - c home) times it;
 * and fairness bare |x + z - home|^2. */
static void
add_fairness(mr_fit_system *s, const mr_v3 *x, const double *bare, double fairness)
{
	const mr_fit_lists *l = &s->star;

	for (size_t v = 0; v < l->count; v++) {
		const int *at = s->star_at + s->star_pairs[v];
		mr_v3 bend = bend_at(s, x, bare[v], v);
		for (size_t i = l->start[v]; i < l->start[v + 1]; i++) {
			double c = fairness * s->star_row[i];
			for (size_t k = l->start[v]; k <= i; k++)
				s->a.value[*at++] += c * s->star_row[k];
			s->b[l->member[i]] = mr_axpy(-c, bend, s->b[l->member[i]]);
		}
		/* the diagonal ends the row */
		s->a.value[s->a.start[v + 1] - 1] += fairness * bare[v] + SMALL;
		s->b[v] = mr_axpy(fairness * bare[v], mr_sub(s->home[v], x[v]), s->b[v]);
	}
}

void
mr_fit_system_fill(mr_ctx *ctx, mr_fit_system *s, const mr_v3 *x, const mr_v3 *point, const mr_fit_foot *foot,
    const double *w, size_t n, double fairness)
{
	mr_mark mark = mr_mark_take(ctx);
	size_t nv = (size_t)s->a.n;
	fill_job j = { .system = s, .point = point, .foot = foot, .w = w, .scale = (double)nv / (double)n };
	size_t *start;
	uint32_t *order;
	double *bare;

	sort_points(ctx, foot, n, s->patch.count, &start, &order);
	measure_bare(ctx, s, start, &bare);
	j.start = start;
	j.order = order;
	memset(s->block, 0, (size_t)s->a.start[nv] * sizeof *s->block);
	memset(s->b, 0, nv * sizeof *s->b);
	add_points(ctx, s, j);
	split_trace(s);
	add_fairness(s, x, bare, fairness);
	mr_mark_release(ctx, mark);
}
