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

	x = floor(x / c->size + off);
	return (int)(x < -most ? -most : x < most ? x : most);
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

/* The cells that a face's box meets; false where they are too many. */
static bool
cells_of_face(const mr_cells *c, const mr_mesh *m, size_t f, mr_cell *low, mr_cell *high)
{
	const uint32_t *v = m->t[f].v;
	bool few = true;

	*low = *high = mr_cell_of(c, m->p[v[0]]);
	for (int i = 1; i < 3; i++) {
		mr_cell at = mr_cell_of(c, m->p[v[i]]);
		for (int k = 0; k < 3; k++) {
			low->at[k] = at.at[k] < low->at[k] ? at.at[k] : low->at[k];
			high->at[k] = at.at[k] > high->at[k] ? at.at[k] : high->at[k];
		}
	}
	for (int k = 0; k < 3; k++)
		few &= high->at[k] - low->at[k] < ACROSS;
	return few;
}

static bool
meets_marked(const mr_cells *c, const mr_mesh *m, size_t f)
{
	mr_cell low, high, at;

	if (!cells_of_face(c, m, f, &low, &high))
		return true;
	for (at.at[0] = low.at[0]; at.at[0] <= high.at[0]; at.at[0]++)
		for (at.at[1] = low.at[1]; at.at[1] <= high.at[1]; at.at[1]++)
			for (at.at[2] = low.at[2]; at.at[2] <= high.at[2]; at.at[2]++)
				if (is_marked(c, at))
					return true;
	return false;
}

size_t
mr_cells_faces(mr_ctx *ctx, const mr_cells *c, const mr_mesh *m, mr_tri **faces)
{
	size_t n = 0;

	*faces = MR_NEW(ctx, m->nf, mr_tri);
	for (size_t f = 0; f < m->nf; f++)
		if (meets_marked(c, m, f))
			(*faces)[n++] = m->t[f];
	return n;
}
