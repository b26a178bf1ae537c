/*
 * Gathers what points, face by face, and fairness ask of the control vertices.  A point pulls along the
 * normal in full and along the surface by a share: between the tangent and the point distance minimization
 * that Wang, Pottmann, Liu 2006 compare (Fitting B-spline curves to point clouds by curvature-based squared
 * distance minimization).
 */
#include "fit/normal_equations.h"

#include "base/parallel.h"
#include "base/sort.h"
#include "solve/preconditioner.h"
#include "subdivide/loop_ring.h"

enum { GRAIN = 16, PIECE = 512 }; /* control faces */

/* Keeps what no point and no neighbour holds; anything from 1e-12 to 1e-6 moves distances by less than 1e-3.
 */
static const double SMALL = 1e-9;

/* ---- which control vertices are coupled ---- */

/* The vertices that each control face's surface depends on, by its nodes. */
static mr_status
patches_of(mr_ctx *ctx, const mr_fit_surface *s, mr_sparse *patch)
{
	size_t nf = s->level[0].nf;
	mr_sparse nodes = { (int)nf, MR_NEW(ctx, nf + 1, int), MR_NEW(ctx, MR_FIT_SLOTS * nf, int),
		MR_NEW_ZERO(ctx, MR_FIT_SLOTS * nf, double) };

	nodes.start[0] = 0;
	for (size_t f = 0; f < nf; f++) {
		uint32_t slot[MR_FIT_SLOTS];
		int first = nodes.start[f], n;
		mr_fit_slots(s, f, slot);
		n = (int)mr_sort_unique(slot, MR_FIT_SLOTS);
		memcpy(nodes.index + first, slot, (size_t)n * sizeof *slot);
		nodes.start[f + 1] = first + n;
	}
	return mr_sparse_multiply(ctx, &nodes, &s->s, s->level[0].nv, patch);
}

/* Lists the neighbours of v, or those along sharp edges alone; how many. */
static size_t
neighbours_of(const mr_loop *l, uint32_t v, bool sharp, uint32_t *list)
{
	size_t n = 0;

	for (mr_loop_ring r = mr_loop_ring_begin(l, v); r.more; mr_loop_ring_step(&r))
		if (!sharp || r.sharp)
			list[n++] = r.to;
	return n;
}

/* L: each vertex less the mean of its neighbours, on a boundary or a crease of the two along it; a corner has
 * none, the end of a crease all. */
static void
stars_of(mr_ctx *ctx, const mr_loop *l, mr_sparse *star)
{
	size_t room = l->nv + 6 * l->nf;
	mr_sparse r = { (int)l->nv, MR_NEW(ctx, l->nv + 1, int), MR_NEW(ctx, room, int),
		MR_NEW(ctx, room, double) };

	r.start[0] = 0;
	for (uint32_t v = 0; v < l->nv; v++) {
		uint32_t *list = (uint32_t *)r.index + r.start[v];
		size_t n = neighbours_of(l, v, true, list + 1);
		list[0] = v;
		if (n < 2)
			n = neighbours_of(l, v, false, list + 1);
		else if (n > 2)
			n = 0;
		n = mr_sort_unique(list, n + 1);
		for (size_t i = 0; i < n; i++)
			r.value[r.start[v] + (int)i] = n == 1 ? 0 : list[i] == v ? 1 : -1 / (double)(n - 1);
		r.start[v + 1] = r.start[v] + (int)n;
	}
	*star = r;
}

/* The pattern of the equations: all vertices of a patch, and of a star, are coupled with each other. */
static mr_status
couple(mr_ctx *ctx, const mr_sparse *patch, const mr_sparse *star, mr_sparse *a)
{
	int n = patch->n + star->n, entries = patch->start[patch->n];
	size_t of_stars = (size_t)star->start[star->n], all = (size_t)entries + of_stars;
	mr_sparse rows = { n, MR_NEW(ctx, (size_t)n + 1, int), MR_NEW(ctx, all, int),
		MR_NEW_ZERO(ctx, all, double) },
		  columns;

	for (int i = 0; i <= patch->n; i++)
		rows.start[i] = patch->start[i];
	for (int i = 0; i <= star->n; i++)
		rows.start[patch->n + i] = entries + star->start[i];
	memcpy(rows.index, patch->index, (size_t)entries * sizeof *rows.index);
	memcpy(rows.index + entries, star->index, of_stars * sizeof *rows.index);
	MR_TRY(mr_sparse_transpose(ctx, &rows, (size_t)star->n, &columns));
	return mr_sparse_multiply(ctx, &columns, &rows, (size_t)star->n, a);
}

static size_t
length_of(const mr_sparse *a, size_t row)
{
	return (size_t)(a->start[row + 1] - a->start[row]);
}

/* With valence 6 each face has some 300 pairs. */
static mr_status
check_valences(mr_ctx *ctx, const mr_sparse *patch)
{
	const double most = 2e7 + 1000 * (double)patch->n;
	double pairs = 0;

	for (size_t f = 0; f < (size_t)patch->n; f++)
		pairs += (double)length_of(patch, f) * (double)length_of(patch, f);
	if (pairs > most)
		return mr_fail(ctx, MR_EMESH,
		    "control: vertices with so many faces are coupled in %.3g pairs; at most %.3g may be",
		    pairs, most);
	return MR_OK;
}

mr_status
mr_fit_system_build(
    mr_ctx *ctx, const mr_fit_surface *surface, const mr_v3 *x, double form, mr_fit_system *system)
{
	size_t nv = surface->level[0].nv;
	mr_fit_system r = { .surface = surface, .form = form, .home = MR_NEW(ctx, nv, mr_v3) };

	memcpy(r.home, x, nv * sizeof *r.home);
	MR_TRY(patches_of(ctx, surface, &r.patch));
	MR_TRY(check_valences(ctx, &r.patch));
	stars_of(ctx, &surface->level[0], &r.star);
	MR_TRY(couple(ctx, &r.patch, &r.star, &r.a));
	MR_TRY(mr_sparse_transpose(ctx, &r.star, nv, &r.around));
	MR_TRY(mr_sparse_multiply(ctx, &r.around, &r.star, nv, &r.bending));
	r.b = MR_NEW(ctx, nv, mr_v3);
	r.block = MR_NEW(ctx, (size_t)r.a.start[nv], mr_fit_block);
	*system = r;
	return MR_OK;
}

/* ---- filling ---- */

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
	size_t *pairs;      /* of each face: how many those before it have */
	mr_fit_block *pair; /* of each pair of vertices of these faces */
	mr_v3 *sum;         /* of each entry of patch */
	double *row;        /* the same: workspace */
} fill_job;

/* The row of a point over the n vertices of its control face, `index`. */
static void
row_of(const mr_fit_surface *s, const int *index, size_t n, const mr_fit_foot *foot, double *row)
{
	uint32_t node[MR_FIT_PATCH];
	double w[MR_FIT_PATCH];

	memset(row, 0, n * sizeof *row);
	mr_fit_nodes(s, foot->patch, node);
	mr_fit_weights(foot->bary, w);
	for (int i = 0; i < MR_FIT_PATCH; i++)
		for (int e = s->s.start[node[i]], k = 0; e < s->s.start[node[i] + 1]; e++) {
			while (index[k] != s->s.index[e])
				k++;
			row[k] += w[i] * s->s.value[e];
		}
}

/* The direction in which a point's distance counts in full: the normal, or towards the point if the foot is
 * on the boundary. */
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

	for (size_t f = j->first + begin; f < j->first + end; f++) {
		size_t n = length_of(&s->patch, f), at = (size_t)s->patch.start[f];
		mr_fit_block *pair = j->pair + (j->pairs[f] - j->pairs[j->first]);
		memset(pair, 0, n * (n + 1) / 2 * sizeof *pair);
		memset(j->sum + at, 0, n * sizeof *j->sum);
		for (size_t i = j->start[f]; i < j->start[f + 1]; i++) {
			uint32_t k = j->order[i];
			mr_v3 normal, r = mr_sub(j->point[k], mr_fit_place(s->surface, &j->foot[k], &normal));
			row_of(s->surface, s->patch.index + at, n, &j->foot[k], j->row + at);
			add_point(j->row + at, n, j->scale * j->w[k], r, direction_of(normal, r), pair,
			    j->sum + at);
		}
	}
}

static void
add_block(mr_fit_block *to, const mr_fit_block *by)
{
	for (int i = 0; i < MR_FIT_BLOCK; i++)
		to->m[i] += by->m[i];
}

/* Adds the pairs and sums of the faces to the equations, in their order, below the diagonal. */
static void
gather(const fill_job *j)
{
	mr_fit_system *s = j->system;
	const mr_sparse *patch = &s->patch;
	const mr_fit_block *pair = j->pair;

	for (size_t f = j->first; f < j->last; f++)
		for (int i = patch->start[f]; i < patch->start[f + 1]; i++) {
			int row = patch->index[i];
			s->b[row] = mr_add(s->b[row], j->sum[i]);
			for (int k = patch->start[f], e = s->a.start[row]; k <= i; k++) {
				while (s->a.index[e] != patch->index[k])
					e++;
				add_block(&s->block[e], pair++);
			}
		}
}

/* Mirrors the lower triangle. */
static void
mirror(mr_ctx *ctx, mr_fit_system *s)
{
	int *next = MR_NEW(ctx, (size_t)s->a.n, int);

	for (int i = 0; i < s->a.n; i++)
		for (int e = s->a.start[i]; e < s->a.start[i + 1] && s->a.index[e] <= i; e++) {
			if (s->a.index[e] < i)
				s->block[next[s->a.index[e]]++] = s->block[e];
			next[i] = e + 1;
		}
}

/* Piece by piece, so that the pairs of all faces are never in memory at once. */
static void
add_points(mr_ctx *ctx, mr_fit_system *s, fill_job j)
{
	size_t nf = (size_t)s->patch.n, entries = (size_t)s->patch.start[nf], most = 0;

	j.pairs = MR_NEW_ZERO(ctx, nf + 1, size_t);
	for (size_t f = 0; f < nf; f++)
		j.pairs[f + 1] = j.pairs[f] + length_of(&s->patch, f) * (length_of(&s->patch, f) + 1) / 2;
	for (size_t f = 0; f < nf; f += PIECE) {
		size_t n = j.pairs[f + PIECE < nf ? f + PIECE : nf] - j.pairs[f];
		most = n > most ? n : most;
	}
	j.pair = MR_NEW(ctx, most, mr_fit_block);
	j.sum = MR_NEW(ctx, entries, mr_v3);
	j.row = MR_NEW(ctx, entries, double);
	for (j.first = 0; j.first < nf; j.first = j.last) {
		j.last = j.first + PIECE < nf ? j.first + PIECE : nf;
		mr_parallel(ctx, j.last - j.first, GRAIN, fill_patches, &j);
		gather(&j);
	}
	mirror(ctx, s);
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
		x[v] = length_of(&s->star, v) == 1 ? 1 : fmax(0, 1 - x[v] / enough);
	*bare = x;
}

/* fairness |L (x + z - c home)|^2, of which x bends by L (x - c home), and fairness bare |x + z - home|^2. */
static void
add_fairness(mr_ctx *ctx, mr_fit_system *s, const mr_v3 *x, const double *bare, double fairness)
{
	size_t nv = (size_t)s->a.n;
	mr_v3 *bend = MR_NEW(ctx, nv, mr_v3), *form = MR_NEW(ctx, nv, mr_v3), *pull = MR_NEW(ctx, nv, mr_v3);

	mr_sparse_apply(ctx, &s->star, NULL, nv, 3, &x->x, &bend->x);
	mr_sparse_apply(ctx, &s->star, NULL, nv, 3, &s->home->x, &form->x);
	for (size_t v = 0; v < nv; v++)
		bend[v] = mr_axpy(-fmax(s->form, bare[v]), form[v], bend[v]);
	mr_sparse_apply(ctx, &s->around, NULL, nv, 3, &bend->x, &pull->x);
	for (size_t v = 0; v < nv; v++) {
		mr_v3 back = mr_axpy(bare[v], mr_sub(s->home[v], x[v]), mr_mul(-1, pull[v]));
		s->b[v] = mr_axpy(fairness, back, s->b[v]);
		for (int i = s->bending.start[v], e = s->a.start[v]; e < s->a.start[v + 1]; e++) {
			if (i < s->bending.start[v + 1] && s->bending.index[i] == s->a.index[e])
				s->a.value[e] += fairness * s->bending.value[i++];
			if (s->a.index[e] == (int)v)
				s->a.value[e] += fairness * bare[v] + SMALL;
		}
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

	sort_points(ctx, foot, n, (size_t)s->patch.n, &start, &order);
	measure_bare(ctx, s, start, &bare);
	j.start = start;
	j.order = order;
	memset(s->block, 0, (size_t)s->a.start[nv] * sizeof *s->block);
	memset(s->b, 0, nv * sizeof *s->b);
	add_points(ctx, s, j);
	split_trace(s);
	add_fairness(ctx, s, x, bare, fairness);
	mr_mark_release(ctx, mark);
}

/* ---- solving ---- */

/*
 * Relative, in the norm of the energy.  1e-2 saves 3 steps of 10 and leaves up to 3 % more distance; 1e-4
 * gains less than 0.1 %.
 */
static const double ACCURACY = 1e-3;

enum { MOST_STEPS = 50 }; /* of which 16 models take 12 at most */

/* z = B r for x, y and z: b is of one of them. */
static mr_status
precondition(mr_ctx *ctx, void *b, mr_multivector s, const double *r, double *z)
{
	const mr_preconditioner *common = b;

	return common->apply(ctx, common->data, (mr_multivector){ s.n / 3, 3 }, r, z);
}

typedef struct product {
	const mr_fit_system *system;
	const mr_v3 *x;
	mr_v3 *y;
} product;

static void
apply_rows(void *arg, size_t begin, size_t end)
{
	const product *j = arg;
	const mr_sparse *a = &j->system->a;

	for (size_t i = begin; i < end; i++) {
		mr_v3 y = { 0, 0, 0 };
		for (int e = a->start[i]; e < a->start[i + 1]; e++) {
			const double *m = j->system->block[e].m, common = a->value[e];
			mr_v3 x = j->x[a->index[e]];
			y.x += (common + m[0]) * x.x + m[3] * x.y + m[5] * x.z;
			y.y += m[3] * x.x + (common + m[1]) * x.y + m[4] * x.z;
			y.z += m[5] * x.x + m[4] * x.y + (common + m[2]) * x.z;
		}
		j->y[i] = y;
	}
}

static void
apply(const mr_ctx *ctx, const void *system, mr_multivector s, const double *x, double *y)
{
	mr_parallel(ctx, s.n / 3, GRAIN, apply_rows, &(product){ system, (const void *)x, (void *)y });
}

/*
 * Conjugate gradients (Hestenes, Stiefel 1952), preconditioned by the incomplete Cholesky factor of the part
 * of the matrix that x, y and z have in common: a ninth of the whole's entries.  A row has all vertices that
 * a control face couples, so that there is nothing to gain by fill: complete factors save one step in thirty,
 * and on thousands of control vertices take a quarter of the fit.
 */
mr_status
mr_fit_solve(mr_ctx *ctx, mr_fit_system *system, mr_v3 *motion)
{
	mr_mark mark = mr_mark_take(ctx);
	size_t nv = (size_t)system->a.n, steps = 0;
	mr_preconditioner b;
	mr_cg g = { .s = { 3 * nv, 1 },
		.apply = apply,
		.a = system,
		.b = &(mr_preconditioner){ .apply = precondition, .data = &b },
		.tol = ACCURACY,
		.most = MOST_STEPS };

	MR_TRY(mr_incomplete_new(ctx, &system->a, false, &b));
	memset(motion, 0, nv * sizeof *motion);
	MR_TRY(mr_cg_improve(ctx, &g, (double *)motion, (double *)system->b, &steps));
	mr_mark_release(ctx, mark);
	return MR_OK;
}
