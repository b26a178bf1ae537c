/* Cells of space. */
#include "space/cells.h"

enum { BITS = 1 << 17, ACROSS = 4 };

mr_cells
mr_cells_new(mr_ctx *ctx, double size)
{
	return (mr_cells){ size, MR_NEW_ZERO(ctx, BITS / 32, uint32_t), false };
}

static int
cell_along(const mr_cells *c, double x)
{
	const double most = 1e9, off = 0.37; /* walls at 0 are in one cell */

	int cell;

	x = x / c->size + off;
	cell = (int)(x < -most ? -most : x < most ? x : most);
	return cell - (cell > x);
}

mr_cell
mr_cell_of(const mr_cells *c, mr_v3 p)
{
	return (mr_cell){ { cell_along(c, p.x), cell_along(c, p.y), cell_along(c, p.z) } };
}

uint32_t
mr_cell_hash(mr_cell c)
{
	uint64_t h = 0;

	for (int k = 0; k < 3; k++)
		h = (h ^ (uint32_t)c.at[k]) * 0x9e3779b97f4a7c15u;
	return (uint32_t)(h >> 40);
}

void
mr_cells_mark(mr_cells *c, mr_v3 p)
{
	uint32_t h = mr_cell_hash(mr_cell_of(c, p)) % BITS;

	c->bits[h / 32] |= 1u << h % 32;
	c->any = true;
}

static bool
is_marked(const mr_cells *c, mr_cell at)
{
	uint32_t h = mr_cell_hash(at) % BITS;

	return c->bits[h / 32] >> h % 32 & 1;
}

/* Where a vertex is. */
typedef struct place {
	mr_cell at;
	bool marked;
} place;

static bool
same(const mr_cell *a, const mr_cell *b)
{
	return a->at[0] == b->at[0] && a->at[1] == b->at[1] && a->at[2] == b->at[2];
}

/* Whether a box of cells has a marked one, or is of too many. */
static bool
any_marked(const mr_cells *c, mr_cell low, mr_cell high)
{
	mr_cell at;

	for (int k = 0; k < 3; k++)
		if (high.at[k] - low.at[k] >= ACROSS)
			return true;
	for (at.at[0] = low.at[0]; at.at[0] <= high.at[0]; at.at[0]++)
		for (at.at[1] = low.at[1]; at.at[1] <= high.at[1]; at.at[1]++)
			for (at.at[2] = low.at[2]; at.at[2] <= high.at[2]; at.at[2]++)
				if (is_marked(c, at))
					return true;
	return false;
}

static bool
meets_marked(const mr_cells *c, const place *vertex, const uint32_t v[3])
{
	const place *p = &vertex[v[0]];
	mr_cell low = p->at, high = p->at;

	if (same(&p->at, &vertex[v[1]].at) && same(&p->at, &vertex[v[2]].at))
		return p->marked;
	for (int i = 1; i < 3; i++)
		for (int k = 0; k < 3; k++) {
			int at = vertex[v[i]].at.at[k];
			low.at[k] = at < low.at[k] ? at : low.at[k];
			high.at[k] = at > high.at[k] ? at : high.at[k];
		}
	return any_marked(c, low, high);
}

size_t
mr_cells_faces(mr_ctx *ctx, const mr_cells *c, const mr_mesh *m, mr_tri **faces)
{
	place *vertex = MR_NEW(ctx, m->nv, place);
	mr_tri *t = MR_NEW(ctx, m->nf, mr_tri);
	size_t n = 0;

	for (size_t v = 0; v < m->nv; v++) {
		vertex[v].at = mr_cell_of(c, m->p[v]);
		vertex[v].marked = is_marked(c, vertex[v].at);
	}
	for (size_t f = 0; f < m->nf; f++)
		if (meets_marked(c, vertex, m->t[f].v))
			t[n++] = m->t[f];
	*faces = t;
	return n;
}
