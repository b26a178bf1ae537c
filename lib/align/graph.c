/* Several sides in one frame of reference: the pairs that fit are the edges of a graph, whose best spanning
 * tree composes motions; then all pairs that lie on each other draw near at once (Neugebauer 1997). */
#include "align/pairs.h"

#include "base/disjoint_sets.h"

enum { ROUNDS = 40, SHOWN = 500 };

typedef struct edge {
	uint32_t from, onto;
	mr_affine map; /* between models */
	mr_align_result r;
} edge;

typedef struct graph {
	size_t n, edges;
	model *model;
	edge *edge;      /* best first */
	uint32_t *part;  /* sets of sides that are joined */
	uint32_t root;   /* the side that stays */
	mr_affine *pose; /* of each in its part */
	const edge **by; /* the edge that joins it; NULL: the root, or none */
} graph;

/* All in one unit, so that a map between models has no scale. */
static mr_status
make_models(mr_ctx *ctx, const mr_align_side *side, graph *g)
{
	double least = INFINITY, most = 0, one;
	bool oriented = true;

	for (size_t i = 0; i < g->n; i++) {
		MR_TRY(mr_align_diagonal(ctx, side[i], &one));
		least = fmin(least, one);
		most = fmax(most, one);
	}
	for (size_t i = 0; i < g->n; i++) {
		MR_TRY(mr_align_model(ctx, side[i], mr_align_unit(least, most), &g->model[i]));
		oriented &= g->model[i].oriented;
	}
	for (size_t i = 0; i < g->n; i++)
		MR_TRY(mr_align_features(ctx, oriented, &g->model[i]));
	return MR_OK;
}

/* The pairs that fit, each from its smaller side. */
static mr_status
find_edges(mr_ctx *ctx, graph *g)
{
	for (uint32_t i = 0; i < g->n; i++)
		for (uint32_t k = i + 1; k < g->n; k++) {
			bool swap = g->model[i].sparse.n <= g->model[k].sparse.n;
			edge *e = &g->edge[g->edges];
			MR_SCOPE(ctx);
			*e = (edge){ swap ? i : k, swap ? k : i, mr_identity(), { .found = false } };
			MR_TRY(mr_align_find(
			    ctx, &g->model[e->from], &g->model[e->onto], false, &e->r, &e->map));
			g->edges += e->r.found;
		}
	return MR_OK;
}

static int
compare_edges(const void *a, const void *b)
{
	const edge *x = a, *y = b;
	double by = x->r.score - x->r.second, other = y->r.score - y->r.second;

	if (by != other)
		return by < other ? 1 : -1;
	return x->from != y->from ? (x->from > y->from) - (x->from < y->from)
	                          : (x->onto > y->onto) - (x->onto < y->onto);
}

/* Puts the sides of one part to where an edge has them on the other's. */
static void
join(graph *g, const edge *e)
{
	uint32_t moved = mr_sets_root(g->part, e->from), stays = mr_sets_root(g->part, e->onto);
	mr_affine back = mr_align_inverse(&g->pose[e->from]), by = mr_compose(&e->map, &back);

	if (moved == stays)
		return;
	by = mr_compose(&g->pose[e->onto], &by);
	for (uint32_t i = 0; i < g->n; i++)
		if (mr_sets_root(g->part, i) == moved)
			g->pose[i] = mr_compose(&by, &g->pose[i]);
	if (!g->by[e->from])
		g->by[e->from] = e;
	if (!g->by[e->onto])
		g->by[e->onto] = e;
	mr_sets_join(g->part, moved, stays);
}

/* The tree of the best edges: every side in its part, and the largest part, of equal ones the first. */
static void
grow_tree(mr_ctx *ctx, graph *g)
{
	size_t *count = MR_NEW_ZERO(ctx, g->n, size_t);

	qsort(g->edge, g->edges, sizeof *g->edge, compare_edges);
	for (size_t i = 0; i < g->edges; i++)
		join(g, &g->edge[i]);
	for (uint32_t i = 0; i < g->n; i++)
		count[mr_sets_root(g->part, i)]++;
	for (uint32_t i = 0; i < g->n; i++)
		g->root = count[i] > count[g->root] ? i : g->root;
}

/* The sides that are joined, the root first; how many. */
static size_t
list_joined(graph *g, uint32_t *side)
{
	size_t n = 0;

	for (uint32_t i = 0; i < g->n; i++)
		if (mr_sets_root(g->part, i) == g->root)
			side[n++] = i;
	return n;
}

/* Whether some of the points of a lie on b. */
static mr_status
meet(mr_ctx *ctx, const model *a, const model *b, const mr_affine *map, bool *do_meet)
{
	MR_SCOPE(ctx);
	pairing w = mr_align_pairing(
	    ctx, &a->sparse, &b->sparse, &b->sparse, a->oriented && b->oriented, SHOWN);

	MR_TRY(mr_align_pair(ctx, &w, true, map));
	*do_meet = mr_align_score(&w, 1.5 * STEP, STEP) > 0;
	return MR_OK;
}

/* The pairs of joined sides that meet, both ways, with the poses of those in order. */
static mr_status
pair_joined(mr_ctx *ctx, const graph *g, const uint32_t *side, size_t n, const mr_affine *pose, pairing *w,
    size_t *pairings)
{
	for (size_t i = 0; i < n; i++)
		for (size_t k = 0; k < n; k++) {
			const model *a = &g->model[side[i]], *b = &g->model[side[k]];
			mr_affine back = mr_align_inverse(&pose[k]), map = mr_compose(&back, &pose[i]);
			bool do_meet = false;
			if (i != k)
				MR_TRY(meet(ctx, a, b, &map, &do_meet));
			if (!do_meet)
				continue;
			w[*pairings] = mr_align_pairing(
			    ctx, &a->dense, &b->dense, &b->sparse, a->oriented && b->oriented, a->dense.n);
			w[*pairings].from = i;
			w[(*pairings)++].onto = k;
		}
	return MR_OK;
}

/* All pairs draw near at once. */
static mr_status
relax(mr_ctx *ctx, graph *g, const uint32_t *side, size_t n)
{
	MR_SCOPE(ctx);
	mr_affine *pose = MR_NEW(ctx, n, mr_affine), back = mr_align_inverse(&g->pose[g->root]);
	pairing *w = MR_NEW(ctx, n * n, pairing);
	size_t pairings = 0;
	drawn d;

	for (size_t i = 0; i < n; i++)
		pose[i] = i ? mr_compose(&back, &g->pose[side[i]]) : mr_identity();
	MR_TRY(pair_joined(ctx, g, side, n, pose, w, &pairings));
	MR_TRY(mr_align_draw_near(ctx, w, pairings, pose, n, 1.5 * STEP, STEP, ROUNDS, false, &d));
	for (size_t i = 0; i < n; i++)
		g->pose[side[i]] = pose[i];
	return MR_OK;
}

mr_status
mr_align_all(mr_ctx *ctx, const mr_align_side *side, size_t n, mr_align_result *r)
{
	MR_SCOPE(ctx);
	graph g = { .n = n,
		.model = MR_NEW(ctx, n, model),
		.edge = MR_NEW(ctx, n * n / 2 + 1, edge),
		.part = mr_sets_new(ctx, n),
		.pose = MR_NEW(ctx, n, mr_affine),
		.by = MR_NEW_ZERO(ctx, n, const edge *) };
	uint32_t *joined = MR_NEW(ctx, n, uint32_t);
	size_t count;

	for (size_t i = 0; i < n; i++)
		g.pose[i] = mr_identity();
	MR_TRY(make_models(ctx, side, &g));
	MR_TRY(find_edges(ctx, &g));
	grow_tree(ctx, &g);
	count = list_joined(&g, joined);
	if (count > 1)
		MR_TRY(relax(ctx, &g, joined, count));
	for (size_t i = 0; i < n; i++)
		r[i] = (mr_align_result){ .scale = 1 };
	for (size_t i = 0; i < count; i++) {
		uint32_t k = joined[i];
		if (g.by[k])
			r[k] = g.by[k]->r;
		else
			r[k].sure = true;
		mr_align_put_map(&g.model[k], &g.model[g.root], &g.pose[k], &r[k]);
		r[k].found = true;
	}
	return MR_OK;
}
