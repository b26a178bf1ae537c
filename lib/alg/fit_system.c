#include "alg/fit_system.h"

#include "base/parallel.h"

enum { GRAIN = 64, SLOTS = MR_FIT_PATCHES * MR_FIT_PATCH };

/* Keeps what no point and no neighbour holds. */
static const double SMALL = 1e-9;

/* The position of column c in the n ascending ones at list. */
static size_t
find(const int *list, size_t n, int c)
{
	size_t low = 0;

	while (n > 1) {
		size_t half = n / 2;
		low = list[low + half] <= c ? low + half : low;
		n -= half;
	}
	return low;
}

static size_t
length(const mr_fit_lists *l, size_t e)
{
	return l->start[e + 1] - l->start[e];
}

/* Sorts and drops repetitions; returns how many are left. */
static size_t
sort_unique(int *a, size_t n)
{
	size_t k = 0;

	for (size_t i = 1; i < n; i++) {
		int x = a[i];
		size_t j = i;
		for (; j > 0 && a[j - 1] > x; j--)
			a[j] = a[j - 1];
		a[j] = x;
	}
	for (size_t i = 0; i < n; i++)
		if (i == 0 || a[i] != a[k - 1])
			a[k++] = a[i];
	return k;
}

/* Lists being written one after another. */
typedef struct writer {
	mr_ctx *ctx;
	mr_fit_lists *l;
	size_t used, room;
	int *seen; /* nv: the last list that each vertex is in, by number + 1 */
} writer;

static mr_status
begin_lists(mr_ctx *ctx, writer *w, mr_fit_lists *l, size_t count, size_t nv)
{
	*w = (writer){ ctx, l, 0, 0, NULL };
	*l = (mr_fit_lists){ 0, MR_NEW(ctx, count + 1, size_t), NULL };
	w->room = 14 * count + 64;
	l->member = MR_NEW(ctx, w->room, int);
	w->seen = MR_NEW_ZERO(ctx, nv, int);
	return l->start && l->member && w->seen ? MR_OK : MR_EMEM;
}

static mr_status
add_member(writer *w, int v)
{
	int number = (int)w->l->count + 1;

	if (w->seen[v] == number)
		return MR_OK;
	w->seen[v] = number;
	MR_TRY(MR_RESERVE(w->ctx, w->l->member, w->used, 1, &w->room));
	w->l->member[w->used++] = v;
	return MR_OK;
}

static void
begin_list(writer *w)
{
	w->l->start[w->l->count] = w->used;
}

static void
end_list(writer *w)
{
	size_t first = w->l->start[w->l->count];

	w->used = first + sort_unique(w->l->member + first, w->used - first);
	w->l->start[++w->l->count] = w->used;
}

/* Slot i of control face f: node i % 6 of its patch i / 6. */
static void
slots_of(const mr_fit_surface *s, size_t f, uint32_t slot[SLOTS])
{
	for (uint32_t k = 0; k < MR_FIT_PATCHES; k++)
		mr_fit_nodes(s, (uint32_t)(MR_FIT_PATCHES * f) + k, slot + MR_FIT_PATCH * k);
}

static mr_status
list_patches(mr_ctx *ctx, const mr_fit_surface *s, mr_fit_lists *l)
{
	size_t nf = s->level[0].nf;
	writer w;

	MR_TRY(begin_lists(ctx, &w, l, nf, s->level[0].nv));
	for (size_t f = 0; f < nf; f++) {
		uint32_t slot[SLOTS];
		begin_list(&w);
		slots_of(s, f, slot);
		for (int i = 0; i < SLOTS; i++)
			for (int e = s->s.start[slot[i]]; e < s->s.start[slot[i] + 1]; e++)
				MR_TRY(add_member(&w, s->s.index[e]));
		end_list(&w);
	}
	return MR_OK;
}

/* The neighbours of v in its row of L: all, or the two along the boundary; at most `room`. */
static mr_status
list_stars(mr_ctx *ctx, const mr_loop *level, mr_fit_lists *l)
{
	const mr_mesh m = { .t = level->t, .nv = level->nv, .nf = level->nf };
	writer w;

	MR_TRY(begin_lists(ctx, &w, l, level->nv, level->nv));
	for (uint32_t v = 0; v < level->nv; v++) {
		uint32_t first = level->topo.out[v], h = first;
		bool boundary = h != MR_NONE && level->topo.twin[h] == MR_NONE;
		begin_list(&w);
		MR_TRY(add_member(&w, (int)v));
		while (h != MR_NONE) {
			uint32_t last = mr_he_prev(h);
			if (!boundary || h == first)
				MR_TRY(add_member(&w, (int)mr_he_to(&m, h)));
			h = mr_he_ccw(&level->topo, h);
			if (h == MR_NONE)
				MR_TRY(add_member(&w, (int)mr_he_from(&m, last)));
			if (h == first)
				break;
		}
		end_list(&w);
	}
	return MR_OK;
}

/* Rows of L: the vertex less the mean of its neighbours; none where it has none. */
static mr_status
star_rows(mr_ctx *ctx, const mr_fit_lists *l, double **row)
{
	double *r = MR_NEW(ctx, l->start[l->count], double);

	if (!r)
		return MR_EMEM;
	for (size_t v = 0; v < l->count; v++)
		for (size_t i = l->start[v], n = length(l, v) - 1; i < l->start[v + 1]; i++)
			r[i] = n == 0 ? 0 : l->member[i] == (int)v ? 1 : -1 / (double)n;
	*row = r;
	return MR_OK;
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
		size_t n = length(j->l, f);
		double *to = j->basis + SLOTS * j->l->start[f];
		uint32_t slot[SLOTS];
		slots_of(j->s, f, slot);
		for (size_t i = 0; i < SLOTS; i++)
			for (int e = s->start[slot[i]]; e < s->start[slot[i] + 1]; e++)
				to[i * n + find(list, n, s->index[e])] = s->value[e];
	}
}

/* The pattern: all pairs of a list. */

typedef struct pattern {
	mr_ctx *ctx;
	mr_sparse *a;
	int used;
	size_t room;
	int *seen;
} pattern;

/* Adds to row v the members up to v of a list. */
static mr_status
add_pairs(pattern *p, const mr_fit_lists *l, size_t e, int v)
{
	for (size_t i = l->start[e]; i < l->start[e + 1] && l->member[i] <= v; i++) {
		int c = l->member[i];
		if (p->seen[c] == v + 1)
			continue;
		p->seen[c] = v + 1;
		if (p->used == INT32_MAX)
			return mr_fail(
			    p->ctx, MR_ERANGE, "the matrix of %d rows has 2^31 entries or more", p->a->n);
		MR_TRY(MR_RESERVE(p->ctx, p->a->index, (size_t)p->used, 1, &p->room));
		p->a->index[p->used++] = c;
	}
	return MR_OK;
}

/* The lists that each vertex is in. */
static mr_status
lists_of_vertices(mr_ctx *ctx, const mr_fit_lists *l, size_t nv, size_t **start, uint32_t **list)
{
	size_t *s = MR_NEW_ZERO(ctx, nv + 2, size_t), total = l->start[l->count];
	uint32_t *in = MR_NEW(ctx, total, uint32_t);

	if (!s || !in)
		return MR_EMEM;
	for (size_t i = 0; i < total; i++)
		s[l->member[i] + 2]++;
	for (size_t v = 0; v < nv; v++)
		s[v + 2] += s[v + 1];
	for (size_t e = 0; e < l->count; e++)
		for (size_t i = l->start[e]; i < l->start[e + 1]; i++)
			in[s[l->member[i] + 1]++] = (uint32_t)e;
	*start = s;
	*list = in;
	return MR_OK;
}

static mr_status
build_pattern(mr_ctx *ctx, const mr_fit_lists *patch, const mr_fit_lists *star, size_t nv, mr_sparse *a)
{
	mr_sparse r = { .n = (int)nv, .start = MR_NEW(ctx, nv + 1, int) };
	pattern p = { ctx, &r, 0, 40 * nv, MR_NEW_ZERO(ctx, nv, int) };
	size_t *patch_start, *star_start;
	uint32_t *patches, *stars;

	r.index = MR_NEW(ctx, p.room, int);
	if (!r.start || !r.index || !p.seen)
		return MR_EMEM;
	MR_TRY(lists_of_vertices(ctx, patch, nv, &patch_start, &patches));
	MR_TRY(lists_of_vertices(ctx, star, nv, &star_start, &stars));
	for (size_t v = 0; v < nv; v++) {
		int first = p.used;
		r.start[v] = first;
		for (size_t i = patch_start[v]; i < patch_start[v + 1]; i++)
			MR_TRY(add_pairs(&p, patch, patches[i], (int)v));
		for (size_t i = star_start[v]; i < star_start[v + 1]; i++)
			MR_TRY(add_pairs(&p, star, stars[i], (int)v));
		p.used = first + (int)sort_unique(r.index + first, (size_t)(p.used - first));
	}
	r.start[nv] = p.used;
	r.value = MR_NEW(ctx, (size_t)p.used, double);
	if (!r.value)
		return MR_EMEM;
	*a = r;
	return MR_OK;
}

/* Where the pairs (i, j <= i) of each list's entries are in a, list after list: *first has count + 1. */
static mr_status
place_pairs(mr_ctx *ctx, const mr_fit_lists *l, const mr_sparse *a, size_t **first, int **at)
{
	size_t *start = MR_NEW(ctx, l->count + 1, size_t), k = 0;
	int *place;

	if (!start)
		return MR_EMEM;
	for (size_t e = 0; e < l->count; e++) {
		start[e] = k;
		k += length(l, e) * (length(l, e) + 1) / 2;
	}
	start[l->count] = k;
	place = MR_NEW(ctx, k, int);
	if (!place)
		return MR_EMEM;
	k = 0;
	for (size_t e = 0; e < l->count; e++)
		for (size_t i = l->start[e]; i < l->start[e + 1]; i++) {
			int row = l->member[i], begin = a->start[row];
			size_t n = (size_t)(a->start[row + 1] - begin);
			for (size_t j = l->start[e]; j <= i; j++)
				place[k++] = begin + (int)find(a->index + begin, n, l->member[j]);
		}
	*first = start;
	*at = place;
	return MR_OK;
}

mr_status
mr_fit_system_build(mr_ctx *ctx, const mr_fit_surface *surface, mr_fit_system *system)
{
	size_t nv = surface->level[0].nv;
	mr_fit_system r = { .surface = surface };

	MR_TRY(list_patches(ctx, surface, &r.patch));
	MR_TRY(list_stars(ctx, &surface->level[0], &r.star));
	MR_TRY(star_rows(ctx, &r.star, &r.star_row));
	r.basis = MR_NEW_ZERO(ctx, SLOTS * r.patch.start[r.patch.count], double);
	r.b = MR_NEW(ctx, 3 * nv, double);
	if (!r.basis || !r.b)
		return MR_EMEM;
	mr_parallel(ctx, r.patch.count, GRAIN, spread_basis, &(basis_job){ surface, &r.patch, r.basis });
	MR_TRY(build_pattern(ctx, &r.patch, &r.star, nv, &r.a));
	MR_TRY(place_pairs(ctx, &r.patch, &r.a, &r.patch_pairs, &r.patch_at));
	MR_TRY(place_pairs(ctx, &r.star, &r.a, &r.star_pairs, &r.star_at));
	*system = r;
	return MR_OK;
}

/* Filling */

/* The points on each control face, by index: order[start[f]] to order[start[f + 1]]. */
static mr_status
sort_points(mr_ctx *ctx, const mr_fit_foot *foot, size_t n, size_t nf, size_t **start, uint32_t **order)
{
	size_t *s = MR_NEW_ZERO(ctx, nf + 2, size_t);
	uint32_t *o = MR_NEW(ctx, n, uint32_t);

	if (!s || !o)
		return MR_EMEM;
	for (size_t i = 0; i < n; i++)
		s[foot[i].patch / MR_FIT_PATCHES + 2]++;
	for (size_t f = 0; f < nf; f++)
		s[f + 2] += s[f + 1];
	for (size_t i = 0; i < n; i++)
		o[s[foot[i].patch / MR_FIT_PATCHES + 1]++] = (uint32_t)i;
	*start = s;
	*order = o;
	return MR_OK;
}

typedef struct fill_job {
	const mr_fit_system *system;
	const mr_v3 *point;
	const mr_fit_foot *foot;
	const double *w;
	const size_t *start;
	const uint32_t *order;
	double scale;  /* nv / n */
	double *pairs; /* of each control face, as patch_at */
	mr_v3 *sum;    /* of each entry of patch */
	double *row;   /* the same: workspace */
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

static void
fill_patches(void *arg, size_t begin, size_t end)
{
	fill_job *j = arg;
	const mr_fit_lists *l = &j->system->patch;

	for (size_t f = begin; f < end; f++) {
		size_t n = length(l, f);
		double *row = j->row + l->start[f], *pairs = j->pairs + j->system->patch_pairs[f];
		mr_v3 *sum = j->sum + l->start[f];
		memset(pairs, 0, n * (n + 1) / 2 * sizeof *pairs);
		memset(sum, 0, n * sizeof *sum);
		for (size_t i = j->start[f]; i < j->start[f + 1]; i++) {
			uint32_t k = j->order[i];
			mr_v3 r = mr_sub(j->point[k], mr_fit_place(j->system->surface, &j->foot[k]));
			double w = j->scale * j->w[k], *to = pairs;
			row_of(j->system->basis + SLOTS * l->start[f], n, &j->foot[k], row);
			for (size_t a = 0; a < n; a++) {
				double wa = w * row[a];
				for (size_t b = 0; b <= a; b++)
					*to++ += wa * row[b];
				sum[a] = mr_axpy(wa, r, sum[a]);
			}
		}
	}
}

static void
add_sum(mr_fit_system *s, int v, mr_v3 r)
{
	size_t nv = (size_t)s->a.n;

	s->b[v] += r.x;
	s->b[nv + (size_t)v] += r.y;
	s->b[2 * nv + (size_t)v] += r.z;
}

static mr_status
add_points(mr_ctx *ctx, mr_fit_system *s, fill_job j)
{
	const mr_fit_lists *l = &s->patch;

	j.pairs = MR_NEW(ctx, s->patch_pairs[l->count], double);
	j.sum = MR_NEW(ctx, l->start[l->count], mr_v3);
	j.row = MR_NEW(ctx, l->start[l->count], double);
	if (!j.pairs || !j.sum || !j.row)
		return MR_EMEM;
	mr_parallel(ctx, l->count, GRAIN, fill_patches, &j);
	for (size_t k = 0; k < s->patch_pairs[l->count]; k++)
		s->a.value[s->patch_at[k]] += j.pairs[k];
	for (size_t i = 0; i < l->start[l->count]; i++)
		add_sum(s, l->member[i], j.sum[i]);
	return MR_OK;
}

/* The part of L x along the surface at vertex v: without its part along the normal, or inside the boundary
 * curve only the part along it. */
static mr_v3
along(const mr_fit_system *s, const mr_v3 *x, const mr_v3 *normal, size_t v)
{
	const mr_fit_lists *l = &s->star;
	size_t first = l->start[v];
	const uint32_t *out = s->surface->level[0].topo.out;
	mr_v3 sum = { 0, 0, 0 }, d, ends[2];
	int k = 0;

	for (size_t i = first; i < l->start[v + 1]; i++) {
		sum = mr_axpy(s->star_row[i], x[l->member[i]], sum);
		if (l->member[i] != (int)v)
			ends[k++ % 2] = x[l->member[i]];
	}
	if (out[v] == MR_NONE || s->surface->level[0].topo.twin[out[v]] != MR_NONE)
		return mr_axpy(-mr_dot(sum, normal[v]), normal[v], sum);
	d = k == 2 ? mr_unit(mr_sub(ends[1], ends[0])) : mr_vec(0, 0, 0);
	return mr_mul(mr_dot(sum, d), d);
}

/* fairness |L z + t|^2: the outer product of each row of L, and -t times it. */
static mr_status
add_fairness(mr_ctx *ctx, mr_fit_system *s, const mr_v3 *x, double fairness)
{
	const mr_fit_lists *l = &s->star;
	mr_v3 *normal = MR_NEW(ctx, l->count, mr_v3);

	if (!normal)
		return MR_EMEM;
	mr_loop_limit(ctx, &s->surface->level[0], x, NULL, normal);
	for (size_t v = 0; v < l->count; v++) {
		const int *at = s->star_at + s->star_pairs[v];
		mr_v3 t = along(s, x, normal, v);
		for (size_t i = l->start[v]; i < l->start[v + 1]; i++) {
			double c = fairness * s->star_row[i];
			for (size_t k = l->start[v]; k <= i; k++)
				s->a.value[*at++] += c * s->star_row[k];
			add_sum(s, l->member[i], mr_mul(-c, t));
		}
	}
	return MR_OK;
}

mr_status
mr_fit_system_fill(mr_ctx *ctx, mr_fit_system *s, const mr_v3 *x, const mr_v3 *point, const mr_fit_foot *foot,
    const double *w, size_t n, double fairness)
{
	mr_mark mark = mr_mark_take(ctx);
	size_t nv = (size_t)s->a.n;
	fill_job j = { .system = s, .point = point, .foot = foot, .w = w, .scale = (double)nv / (double)n };
	size_t *start;
	uint32_t *order;

	MR_TRY(sort_points(ctx, foot, n, s->patch.count, &start, &order));
	j.start = start;
	j.order = order;
	memset(s->a.value, 0, (size_t)s->a.start[nv] * sizeof *s->a.value);
	memset(s->b, 0, 3 * nv * sizeof *s->b);
	MR_TRY(add_points(ctx, s, j));
	MR_TRY(add_fairness(ctx, s, x, fairness));
	for (size_t v = 0; v < nv; v++)
		s->a.value[s->a.start[v + 1] - 1] += SMALL; /* the diagonal ends the row */
	mr_mark_release(ctx, mark);
	return MR_OK;
}
