/* Numbers without holes, and along the Z curve (Morton 1966). */
#include "mesh/dynmesh.h"
#include "mesh/zorder.h"

/* Applies new numbers to an array of n objects, but to those without: new[number[i]] = old[i]. */
static void
permute(mr_ctx *ctx, void *array, size_t n, size_t size, const uint32_t *number)
{
	MR_SCOPE(ctx);
	char *copy, *to = array;

	if (!array)
		return;
	copy = mr_alloc(ctx, n, size);
	memcpy(copy, array, n * size);
	for (size_t i = 0; i < n; i++)
		if (number[i] != MR_NONE)
			memcpy(to + number[i] * size, copy + i * size, size);
}

static void
permute_vertices(mr_ctx *ctx, mr_dyn *d, const uint32_t *number)
{
	permute(ctx, d->p, d->nv, sizeof *d->p, number);
	permute(ctx, d->out, d->nv, sizeof *d->out, number);
	permute(ctx, d->at, d->nv, sizeof *d->at, number);
	permute(ctx, d->kind, d->nv, sizeof *d->kind, number);
	for (size_t h = 0; h < 3 * d->nf; h++)
		if (!mr_dyn_face_dead(d, h / 3))
			d->v[h] = number[d->v[h]];
}

static uint32_t
renumbered(const uint32_t *number, uint32_t h)
{
	return h == MR_NONE ? MR_NONE : 3 * number[h / 3] + h % 3;
}

/* nv: of the vertices that live. */
static void
permute_faces(mr_ctx *ctx, mr_dyn *d, size_t nv, const uint32_t *number)
{
	for (size_t h = 0; h < 3 * d->nf; h++)
		if (!mr_dyn_face_dead(d, h / 3))
			d->twin[h] = renumbered(number, d->twin[h]);
	for (size_t v = 0; v < nv; v++)
		d->out[v] = renumbered(number, d->out[v]);
	permute(ctx, d->v, d->nf, 3 * sizeof *d->v, number);
	permute(ctx, d->twin, d->nf, 3 * sizeof *d->twin, number);
	permute(ctx, d->curve, d->nf, 3 * sizeof *d->curve, number);
}

mr_status
mr_dyn_compact(mr_ctx *ctx, mr_dyn *d)
{
	mr_mark mark = mr_mark_take(ctx);
	uint32_t *number = MR_NEW(ctx, d->nv > d->nf ? d->nv : d->nf, uint32_t), nv = 0, nf = 0;

	for (size_t v = 0; v < d->nv; v++)
		number[v] = d->kind[v] == MR_DEAD ? MR_NONE : nv++;
	permute_vertices(ctx, d, number);
	d->nv = nv;
	for (size_t f = 0; f < d->nf; f++)
		number[f] = mr_dyn_face_dead(d, f) ? MR_NONE : nf++;
	permute_faces(ctx, d, nv, number);
	d->nf = nf;
	d->free_v = d->free_f = MR_NONE;
	mr_mark_release(ctx, mark);
	if (d->room_v > d->nv + d->nv / 3)
		mr_dyn_room_v(ctx, d, d->nv + d->nv / 8 + 16);
	return d->room_f > d->nf + d->nf / 3 ? mr_dyn_room_f(ctx, d, d->nf + d->nf / 8 + 32) : MR_OK;
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
	MR_SCOPE(ctx);
	uint32_t *next = MR_NEW_ZERO(ctx, d->nv + 1, uint32_t);

	for (size_t f = 0; f < d->nf; f++)
		next[lowest(d, f) + 1]++;
	for (size_t v = 0; v < d->nv; v++)
		next[v + 1] += next[v];
	for (size_t f = 0; f < d->nf; f++)
		number[f] = next[lowest(d, f)]++;
}

void
mr_dyn_order(mr_ctx *ctx, mr_dyn *d)
{
	MR_SCOPE(ctx);
	uint32_t *number = MR_NEW(ctx, d->nv > d->nf ? d->nv : d->nf, uint32_t),
		 *order = MR_NEW(ctx, d->nv, uint32_t);

	mr_zorder(ctx, d->p, d->nv, MR_ZORDER_CELLS, order);
	for (uint32_t i = 0; i < d->nv; i++)
		number[order[i]] = i;
	permute_vertices(ctx, d, number);
	number_faces(ctx, d, number);
	permute_faces(ctx, d, d->nv, number);
}
