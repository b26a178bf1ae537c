/* Half-edges sorted by their ends: an edge's stand together. */
#include "mesh/edges.h"

#include "base/parallel.h"

/* A half-edge as seen from its lower vertex. */
typedef struct spoke {
	uint32_t to, he;
} spoke;

static int
compare_spokes(const void *a, const void *b)
{
	const spoke *x = a, *y = b;

	return x->to != y->to ? (x->to > y->to) - (x->to < y->to) : (x->he > y->he) - (x->he < y->he);
}

/* Sorts the spokes of one vertex by `to`, then `he`: few, mostly. */
static void
sort_spokes(spoke *s, size_t n)
{
	if (n > 32) {
		qsort(s, n, sizeof *s, compare_spokes);
		return;
	}
	for (size_t i = 1; i < n; i++) {
		spoke x = s[i];
		size_t j = i;
		for (; j > 0 && compare_spokes(&s[j - 1], &x) > 0; j--)
			s[j] = s[j - 1];
		s[j] = x;
	}
}

typedef struct table {
	uint32_t *start; /* nv + 1: the spokes of each vertex, the lower of an edge */
	spoke *spoke;
} table;

static uint32_t
low(const mr_mesh *m, uint32_t h)
{
	uint32_t a = mr_he_from(m, h), b = mr_he_to(m, h);

	return a < b ? a : b;
}

static uint32_t
high(const mr_mesh *m, uint32_t h)
{
	uint32_t a = mr_he_from(m, h), b = mr_he_to(m, h);

	return a < b ? b : a;
}

static void
sort_vertices(void *arg, size_t begin, size_t end)
{
	table *t = arg;

	for (size_t v = begin; v < end; v++)
		sort_spokes(t->spoke + t->start[v], t->start[v + 1] - t->start[v]);
}

/* A counting sort of the half-edges by their lower vertex. */
static void
fill(const mr_mesh *m, table *t)
{
	memset(t->start, 0, (m->nv + 2) * sizeof *t->start);
	for (size_t f = 0; f < m->nf; f++)
		for (uint32_t i = 0; i < 3 && !mr_face_repeats(m, f); i++)
			t->start[low(m, (uint32_t)(3 * f) + i) + 2]++;
	for (size_t v = 0; v < m->nv; v++)
		t->start[v + 2] += t->start[v + 1];
	for (size_t f = 0; f < m->nf; f++)
		for (uint32_t i = 0; i < 3 && !mr_face_repeats(m, f); i++) {
			uint32_t h = (uint32_t)(3 * f) + i;
			t->spoke[t->start[low(m, h) + 1]++] = (spoke){ high(m, h), h };
		}
}

/* Whether spoke i of a vertex begins another edge. */
static bool
begins(const table *t, size_t v, uint32_t i)
{
	return i == t->start[v] || t->spoke[i].to != t->spoke[i - 1].to;
}

void
mr_edges_build(mr_ctx *ctx, const mr_mesh *m, mr_edges *out)
{
	mr_edges e = { 0, NULL, MR_NEW(ctx, 3 * m->nf, uint32_t) };
	uint32_t *start = MR_NEW(ctx, 3 * m->nf + 1, uint32_t);
	MR_SCOPE(ctx);
	table t = { MR_NEW(ctx, m->nv + 2, uint32_t), MR_NEW(ctx, 3 * m->nf, spoke) };

	fill(m, &t);
	mr_parallel(ctx, m->nv, 4096, sort_vertices, &t);
	for (size_t v = 0; v < m->nv; v++)
		for (uint32_t i = t.start[v]; i < t.start[v + 1]; i++) {
			if (begins(&t, v, i))
				start[e.count++] = i;
			e.he[i] = t.spoke[i].he;
		}
	start[e.count] = t.start[m->nv];
	e.start = start;
	*out = e;
}

/* Whether edge e has an even number of faces, as many one way as the other. */
static bool
is_closed(const mr_mesh *m, const mr_edges *edges, size_t e)
{
	const uint32_t *h = edges->he + edges->start[e];
	uint32_t n = mr_edge_faces(edges, e), same = 0;

	for (uint32_t i = 0; i < n; i++)
		same += mr_same_direction(m, h[0], h[i]);
	return 2 * same == n;
}

bool
mr_edges_enclose(const mr_mesh *m, const mr_edges *edges)
{
	for (size_t e = 0; e < edges->count; e++)
		if (!is_closed(m, edges, e))
			return false;
	return edges->count > 0;
}
