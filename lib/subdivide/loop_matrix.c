/* The limit points of a fine level as sparse combinations of the control vertices: a product of the masks of
 * all levels. */
#include "subdivide/loop_ring.h"

/* Adds w to the last row, which is short, at its column. */
static void
add(mr_sparse *a, uint32_t column, double w)
{
	int e = a->start[a->n + 1]++;

	for (; e > a->start[a->n] && a->index[e - 1] > (int)column; e--) {
		a->index[e] = a->index[e - 1];
		a->value[e] = a->value[e - 1];
	}
	a->index[e] = (int)column;
	a->value[e] = w;
}

static void
end_row(mr_sparse *a)
{
	a->n++;
	a->start[a->n + 1] = a->start[a->n];
}

static void
row_of_mask(const mr_loop *l, uint32_t v, mr_loop_mask mask, mr_sparse *a)
{
	add(a, v, mask.self);
	for (mr_loop_ring g = mr_loop_ring_begin(l, v); g.more && mask.self != 1; mr_loop_ring_step(&g)) {
		double w = g.sharp ? mask.sharp : mask.ring;
		if (w != 0)
			add(a, g.to, w);
	}
	end_row(a);
}

static void
row_of_edge(const mr_loop *l, uint32_t h, mr_sparse *a)
{
	bool sharp = mr_loop_sharp(l, h);
	uint32_t c = mr_loop_opposite(l, h), d = sharp ? c : mr_loop_opposite(l, l->topo.twin[h]);

	add(a, mr_loop_from(l, h), sharp ? 0.5 : 0.375);
	add(a, mr_loop_to(l, h), sharp ? 0.5 : 0.375);
	if (!sharp)
		add(a, c, c == d ? 0.25 : 0.125);
	if (c != d)
		add(a, d, 0.125);
	end_row(a);
}

/* The matrix from the vertices of l to the next level; if that is NULL, to their limit points. */
static void
masks_of(mr_ctx *ctx, const mr_loop *l, const mr_loop *next, mr_sparse *a)
{
	size_t rows = next ? next->nv : l->nv, room = l->nv + 6 * l->nf + 4 * (rows - l->nv);

	*a = (mr_sparse){ 0, MR_NEW_ZERO(ctx, rows + 2, int), MR_NEW(ctx, room, int),
		MR_NEW(ctx, room, double) };
	for (uint32_t v = 0; v < l->nv; v++) {
		mr_loop_kind kind = mr_loop_kind_of(l, v);
		row_of_mask(l, v, next ? mr_loop_even_mask(kind) : mr_loop_limit_mask(kind), a);
	}
	for (size_t i = 0; i < rows - l->nv; i++)
		row_of_edge(l, next->edge[i], a);
}

mr_status
mr_loop_limit_matrix(mr_ctx *ctx, const mr_loop *level, size_t n, mr_sparse *s)
{
	mr_sparse masks, product;

	if (level[n].nv > INT32_MAX / 8)
		return mr_fail(ctx, MR_ERANGE, "%zu limit points are too many", level[n].nv);
	for (size_t i = 0; i <= n; i++) {
		masks_of(ctx, &level[i], i < n ? &level[i + 1] : NULL, &masks);
		if (i > 0) {
			MR_TRY(mr_sparse_multiply(ctx, &masks, s, level[0].nv, &product));
			masks = product;
		}
		*s = masks;
	}
	return MR_OK;
}
