/* Numbers without holes, and along the Z curve (Morton 1966). */
#include "mesh/dynmesh.h"
#include "mesh/zorder.h"

/* Applies a permutation to an array of n objects: new[number[i]] = old[i]. */
static void
permute(mr_ctx *ctx, void *array, size_t n, size_t size, const uint32_t *number)
{
	mr_mark mark = mr_mark_take(ctx);
	char *copy = mr_alloc(ctx, n, size), *to = array;

	memcpy(copy, array, n * size);
	for (size_t i = 0; i < n; i++)
		memcpy(to + number[i] * size, copy + i * size, size);
	mr_mark_release(ctx, mark);
}

static void
number_vertices(mr_ctx *ctx, const mr_dyn *d, uint32_t *number)
{
	mr_mark mark = mr_mark_take(ctx);
	uint32_t *order = MR_NEW(ctx, d->nv, uint32_t);

	mr_zorder(ctx, d->p, d->nv, MR_ZORDER_CELLS, order);
	for (uint32_t i = 0; i < d->nv; i++)
		number[order[i]] = i;
	mr_mark_release(ctx, mark);
}

static uint32_t
lowest(const mr_dyn *d, size_t f)
{
	const uint32_t *v = d->v + 3 * f;
	uint32_t low = v[0] < v[1] ? v[0] : v[1];

	return low < v[2] ? low : v[2];
}

/* By their lowest vertex: a counting sort. */
static void
number_faces(mr_ctx *ctx, const mr_dyn *d, uint32_t *number)
{
	mr_mark mark = mr_mark_take(ctx);
	uint32_t *next = MR_NEW_ZERO(ctx, d->nv + 1, uint32_t);

	for (size_t f = 0; f < d->nf; f++)
		next[lowest(d, f) + 1]++;
	for (size_t v = 0; v < d->nv; v++)
		next[v + 1] += next[v];
	for (size_t f = 0; f < d->nf; f++)
		number[f] = next[lowest(d, f)]++;
	mr_mark_release(ctx, mark);
}

static void
permute_vertices(mr_ctx *ctx, mr_dyn *d, const uint32_t *number)
{
	permute(ctx, d->p, d->nv, sizeof *d->p, number);
	permute(ctx, d->out, d->nv, sizeof *d->out, number);
	permute(ctx, d->at, d->nv, sizeof *d->at, number);
	permute(ctx, d->kind, d->nv, sizeof *d->kind, number);
	for (size_t h = 0; h < 3 * d->nf; h++)
		d->v[h] = number[d->v[h]];
}

static void
permute_faces(mr_ctx *ctx, mr_dyn *d, const uint32_t *number)
{
	for (size_t h = 0; h < 3 * d->nf; h++)
		if (d->twin[h] != MR_NONE)
			d->twin[h] = 3 * number[d->twin[h] / 3] + d->twin[h] % 3;
	for (size_t v = 0; v < d->nv; v++)
		d->out[v] = 3 * number[d->out[v] / 3] + d->out[v] % 3;
	permute(ctx, d->v, d->nf, 3 * sizeof *d->v, number);
	permute(ctx, d->twin, d->nf, 3 * sizeof *d->twin, number);
	mr_curves_renumber(ctx, &d->curves, number);
}

void
mr_dyn_order(mr_ctx *ctx, mr_dyn *d)
{
	mr_mark mark = mr_mark_take(ctx);
	uint32_t *number = MR_NEW(ctx, d->nv > d->nf ? d->nv : d->nf, uint32_t);

	number_vertices(ctx, d, number);
	permute_vertices(ctx, d, number);
	number_faces(ctx, d, number);
	permute_faces(ctx, d, number);
	mr_mark_release(ctx, mark);
}

/* Vertex v becomes w, which no face has. */
static void
move_vertex(mr_dyn *d, uint32_t v, uint32_t w)
{
	uint32_t h = d->out[v];

	do {
		d->v[h] = w;
		h = mr_dyn_ccw(d, h);
	} while (h != MR_NONE && h != d->out[v]);
	d->p[w] = d->p[v];
	d->out[w] = d->out[v];
	d->at[w] = d->at[v];
	d->kind[w] = d->kind[v];
}

/* Half-edge h becomes k. */
static void
move_half_edge(mr_dyn *d, uint32_t h, uint32_t k)
{
	uint32_t g = d->twin[h], v = d->v[h], curve = mr_dyn_curve(d, h);

	if (h == k)
		return;
	d->v[k] = v;
	d->twin[k] = g;
	if (g != MR_NONE)
		d->twin[g] = k;
	if (d->out[v] == h)
		d->out[v] = k;
	if (curve != MR_NONE) {
		mr_curves_set(&d->curves, h, MR_NONE);
		mr_curves_set(&d->curves, k, curve);
	}
}

/* In place, since numbers only fall: this is when the most memory is in use. */
static void
close_holes(mr_dyn *d)
{
	uint32_t nv = 0, nf = 0;

	for (uint32_t v = 0; v < d->nv; v++)
		if (d->kind[v] != MR_DEAD)
			move_vertex(d, v, nv++);
	for (uint32_t f = 0; f < d->nf; f++)
		if (!mr_dyn_face_dead(d, f)) {
			for (uint32_t i = 0; i < 3; i++)
				move_half_edge(d, 3 * f + i, 3 * nf + i);
			nf++;
		}
	d->nv = nv;
	d->nf = nf;
	d->free_v = d->free_f = MR_NONE;
}

mr_status
mr_dyn_compact(mr_ctx *ctx, mr_dyn *d)
{
	close_holes(d);
	if (d->room_v > d->nv + d->nv / 3)
		mr_dyn_room_v(ctx, d, d->nv + d->nv / 8 + 16);
	return d->room_f > d->nf + d->nf / 3 ? mr_dyn_room_f(ctx, d, d->nf + d->nf / 8 + 32) : MR_OK;
}
