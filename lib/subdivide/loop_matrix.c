/* The limit points of a fine level as sparse combinations of the control vertices. */
#include "subdivide/loop_ring.h"

#include "base/sort.h"

/* One row: its entries add up where their column is known. */
typedef struct row {
	double *weight; /* of each control vertex */
	bool *known;
	int *index; /* those that are */
	size_t n;
} row;

/* Rows under way: `count` of them. */
typedef struct rows {
	size_t count, used, room, index_room;
	int *start, *index;
	double *value;
} rows;

static void
row_add(row *r, double w, const rows *from, uint32_t v)
{
	for (int e = from->start[v]; e < from->start[v + 1]; e++) {
		/* NOLINTNEXTLINE(clang-analyzer-core.NullDereference) a row of a start has an index */
		int i = from->index[e];
		if (!r->known[i]) {
			r->known[i] = true;
			r->weight[i] = 0;
			r->index[r->n++] = i;
		}
		r->weight[i] += w * from->value[e];
	}
}

/* Ends the row: it becomes the next one of `to`. */
static mr_status
row_end(mr_ctx *ctx, row *r, rows *to)
{
	if (r->n > (size_t)INT32_MAX - to->used)
		return mr_fail(ctx, MR_ERANGE, "the limit points have more than %d weights", INT32_MAX);
	MR_RESERVE(ctx, to->index, to->used, r->n, &to->index_room);
	MR_RESERVE(ctx, to->value, to->used, r->n, &to->room);
	mr_sort_indices((uint32_t *)r->index, r->n); /* of the same order: none is negative */
	for (size_t i = 0; i < r->n; i++) {
		to->index[to->used] = r->index[i];
		to->value[to->used++] = r->weight[r->index[i]];
		r->known[r->index[i]] = false;
	}
	r->n = 0;
	to->start[++to->count] = (int)to->used;
	return MR_OK;
}

static void
rows_begin(mr_ctx *ctx, size_t n, rows *a)
{
	*a = (rows){ .start = MR_NEW(ctx, n + 1, int) };
	a->start[0] = 0;
}

/* The mask at v applied to the rows of the level. */
static void
row_of_mask(row *r, const mr_loop *l, uint32_t v, mr_loop_mask mask, const rows *from)
{
	row_add(r, mask.self, from, v);
	for (mr_loop_ring g = mr_loop_ring_begin(l, v); g.more && mask.self != 1; mr_loop_ring_step(&g)) {
		double w = g.sharp ? mask.sharp : mask.ring;
		if (w != 0)
			row_add(r, w, from, g.to);
	}
}

static void
row_of_edge(row *r, const mr_loop *l, uint32_t h, const rows *from)
{
	bool sharp = mr_loop_sharp(l, h);

	row_add(r, sharp ? 0.5 : 0.375, from, mr_loop_from(l, h));
	row_add(r, sharp ? 0.5 : 0.375, from, mr_loop_to(l, h));
	if (sharp)
		return;
	row_add(r, 0.125, from, mr_loop_opposite(l, h));
	row_add(r, 0.125, from, mr_loop_opposite(l, l->topo.twin[h]));
}

static mr_status
refine_rows(mr_ctx *ctx, const mr_loop *coarse, const mr_loop *fine, row *r, const rows *in, rows *out)
{
	rows_begin(ctx, fine->nv, out);
	for (uint32_t v = 0; v < coarse->nv; v++) {
		row_of_mask(r, coarse, v, mr_loop_even_mask(mr_loop_kind_of(coarse, v)), in);
		MR_TRY(row_end(ctx, r, out));
	}
	for (size_t i = 0; i < fine->nv - coarse->nv; i++) {
		row_of_edge(r, coarse, fine->edge[i], in);
		MR_TRY(row_end(ctx, r, out));
	}
	return MR_OK;
}

static mr_status
limit_rows(mr_ctx *ctx, const mr_loop *l, row *r, const rows *in, rows *out)
{
	rows_begin(ctx, l->nv, out);
	for (uint32_t v = 0; v < l->nv; v++) {
		row_of_mask(r, l, v, mr_loop_limit_mask(mr_loop_kind_of(l, v)), in);
		MR_TRY(row_end(ctx, r, out));
	}
	return MR_OK;
}

static mr_status
identity_rows(mr_ctx *ctx, size_t n, row *r, rows *out)
{
	rows_begin(ctx, n, out);
	for (size_t v = 0; v < n; v++) {
		r->weight[v] = 1;
		r->index[r->n++] = (int)v;
		MR_TRY(row_end(ctx, r, out));
	}
	return MR_OK;
}

mr_status
mr_loop_limit_matrix(mr_ctx *ctx, const mr_loop *level, size_t n, mr_sparse *s)
{
	size_t nv = level[0].nv;
	row r = { MR_NEW(ctx, nv, double), MR_NEW_ZERO(ctx, nv, bool), MR_NEW(ctx, nv, int), 0 };
	rows a, b;

	if (level[n].nv > INT32_MAX)
		return mr_fail(ctx, MR_ERANGE, "%zu limit points are more than %d", level[n].nv, INT32_MAX);
	MR_TRY(identity_rows(ctx, nv, &r, &a));
	for (size_t i = 0; i < n; i++) {
		MR_TRY(refine_rows(ctx, &level[i], &level[i + 1], &r, &a, &b));
		a = b;
	}
	MR_TRY(limit_rows(ctx, &level[n], &r, &a, &b));
	*s = (mr_sparse){ (int)b.count, b.start, b.index, b.value };
	return MR_OK;
}
