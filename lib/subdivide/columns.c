/* Each kind of column has its own way to a finer mesh. */
#include "subdivide/columns.h"

/* The corners of a fine triangle in the triangle that it is a part of. */
typedef struct corners {
	uint32_t face;
	mr_v3 at[3];
} corners;

static corners
corners_of(const mr_refined *r, size_t f)
{
	corners c = { r->face ? r->face[f] : (uint32_t)(f >> 2 * r->n), { { 0, 0, 0 } } };

	if (r->face)
		memcpy(c.at, r->bary + 3 * f, sizeof c.at);
	else
		mr_loop_corners(r->n, f, c.at);
	return c;
}

/* Each fine vertex between the corners of a triangle that it lies on; the mesh's own are themselves. */
static void
find_vertices(mr_ctx *ctx, const mr_refined *r, mr_rows_from *rows)
{
	uint32_t *parent = MR_NEW_ZERO(ctx, 3 * r->fine.nv, uint32_t);
	double *weight = MR_NEW_ZERO(ctx, 3 * r->fine.nv, double);

	for (size_t i = 0; i < r->m.nv; i++) {
		parent[3 * i] = (uint32_t)i;
		weight[3 * i] = 1;
	}
	for (size_t f = 0; f < r->fine.nf; f++) {
		corners c = corners_of(r, f);
		for (int k = 0; k < 3; k++) {
			size_t i = 3 * (size_t)r->fine.t[f].v[k];
			if (weight[i] + weight[i + 1] + weight[i + 2] > 0)
				continue;
			memcpy(parent + i, r->m.t[c.face].v, 3 * sizeof *parent);
			memcpy(weight + i, &c.at[k], 3 * sizeof *weight);
		}
	}
	*rows = (mr_rows_from){ r->fine.nv, 3, parent, weight };
}

/* The corners of fine triangles, between the corners of the one that each is a part of, some at a time. */
static mr_status
make_corners(mr_ctx *ctx, const mr_refined *r, const mr_carried *c)
{
	enum { CHUNK = 1 << 14 };
	MR_SCOPE(ctx);
	uint32_t(*parent)[9] = mr_alloc(ctx, CHUNK, sizeof *parent);
	double(*weight)[9] = mr_alloc(ctx, CHUNK, sizeof *weight);

	for (size_t first = 0; first < r->fine.nf; first += CHUNK) {
		size_t n = r->fine.nf - first < CHUNK ? r->fine.nf - first : CHUNK;
		for (size_t i = 0; i < n; i++) {
			corners at = corners_of(r, first + i);
			memcpy(weight[i], at.at, sizeof weight[i]);
			for (uint32_t k = 0; k < 9; k++)
				parent[i][k] = 3 * at.face + k % 3;
		}
		mr_carried_make(ctx, c, 3, 3 * first, (mr_rows_from){ 3 * n, 3, *parent, *weight });
	}
	return MR_OK;
}

static mr_status
make_faces(mr_ctx *ctx, const mr_refined *r, mr_carried *c)
{
	MR_SCOPE(ctx);
	uint32_t *of = MR_NEW(ctx, r->fine.nf, uint32_t);

	for (size_t f = 0; f < r->fine.nf; f++)
		of[f] = corners_of(r, f).face;
	c->kind = MR_LABEL;
	mr_carried_make(ctx, c, 1, 0, (mr_rows_from){ r->fine.nf, 1, of, NULL });
	return MR_OK;
}

/* Numbers, or bytes, by Loop's rules. */
static void
by_loop(mr_ctx *ctx, const mr_refined *r, mr_carried *c)
{
	size_t width = c->shape.components, coarse = width * r->m.nv, fine = width * r->fine.nv;
	MR_SCOPE(ctx);
	double *x, *y;

	if (c->shape.type == 'd') {
		mr_loop_values(ctx, r->level, r->n, width, c->from, c->to);
		return;
	}
	x = MR_NEW(ctx, coarse, double);
	y = MR_NEW(ctx, fine, double);
	for (size_t i = 0; i < coarse; i++)
		x[i] = ((const uint8_t *)c->from)[i];
	mr_loop_values(ctx, r->level, r->n, width, x, y);
	for (size_t i = 0; i < fine; i++) /* averages, so from 0 to 255 */
		((uint8_t *)c->to)[i] = (uint8_t)(y[i] + 0.5);
}

typedef struct making {
	const mr_refined *r;
	mr_rows_from vertices;
} making;

static mr_status
make(void *arg, mr_ctx *ctx, mr_carried *c)
{
	making *m = arg;
	const mr_refined *r = m->r;

	if (c->shape.element == 'f')
		return c->kind != MR_LABEL && !strncmp(c->name, "corner_", 7) ? make_corners(ctx, r, c)
		                                                              : make_faces(ctx, r, c);
	if (c->kind == MR_MEAN && r->level) {
		by_loop(ctx, r, c);
		return MR_OK;
	}
	if (!m->vertices.n)
		find_vertices(ctx, r, &m->vertices);
	mr_carried_make(ctx, c, 1, 0, m->vertices);
	return MR_OK;
}

mr_status
mr_refine_columns(
    mr_ctx *ctx, mr_frame *f, const char *layer, const mr_refined *r, mr_carried **out, size_t *count)
{
	static const char *const polygon[] = { "polygon", NULL };
	making m = { .r = r };
	mr_descent d = { r->m.nv, r->m.nf, r->fine.nv, r->fine.nf, r->level && r->n > 0 ? polygon : NULL,
		make, &m };

	return mr_columns_descend(ctx, f, layer, &d, out, count);
}

void
mr_refined_flat(mr_ctx *ctx, const mr_refined *r, mr_v3 *p)
{
	const mr_carried c = { .shape = { 'v', 'd', 3 }, .kind = MR_MEAN, .from = r->m.p, .to = p };
	MR_SCOPE(ctx);
	mr_rows_from rows;

	find_vertices(ctx, r, &rows);
	mr_carried_make(ctx, &c, 1, 0, rows);
}
