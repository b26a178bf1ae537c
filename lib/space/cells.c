/* Cells of space. */
#include "space/cells.h"

enum { BITS = 1 << 17, ACROSS = 4 };

mr_cells
mr_cells_new(mr_ctx *ctx, double size)
{
	return (mr_cells){ 1 / size, MR_NEW_ZERO(ctx, BITS / 32, uint32_t), false };
}

static int
cell_along(double x)
{
	const double most = 1e9, off = 0.37; /* walls at 0 are in one cell */
	int cell;

	x += off;
	cell = (int)(x < -most ? -most : x < most ? x : most);
	return cell - (cell > x);
}

mr_cell
mr_cell_of(const mr_cells *c, mr_v3 p)
{
	return (mr_cell){ { cell_along(c->scale * p.x), cell_along(c->scale * p.y),
	    cell_along(c->scale * p.z) } };
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

bool
mr_cells_hold(const mr_cells *c, mr_v3 p)
{
	return c->any && is_marked(c, mr_cell_of(c, p));
}

bool
mr_cells_meet(const mr_cells *c, mr_box box)
{
	mr_cell low = mr_cell_of(c, box.min), high = mr_cell_of(c, box.max), at;

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
