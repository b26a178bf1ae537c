/* A box of a lattice of quadrilaterals, each cut in two. */
#include "wrap/parts.h"

/*
 * Lattice points (i, j, k) on the surface of the box, numbered in layers of k: the whole of the first and
 * the last, of those between the rim.
 */
typedef struct box {
	size_t n[3];
	mr_box at;
	mr_v3 *p;
	mr_tri *t;
	size_t faces;
} box;

/* The number of (i, j) in its layer's rim: j = 0, then j = n[1], then the two columns between. */
static size_t
in_rim(const box *b, size_t i, size_t j)
{
	if (j == 0)
		return i;
	if (j == b->n[1])
		return b->n[0] + 1 + i;
	return 2 * (b->n[0] + 1) + 2 * (j - 1) + (i > 0);
}

static size_t
number_of(const box *b, const size_t at[3])
{
	size_t layer = (b->n[0] + 1) * (b->n[1] + 1), rim = 2 * (b->n[0] + b->n[1]);

	if (at[2] == 0)
		return at[1] * (b->n[0] + 1) + at[0];
	if (at[2] == b->n[2])
		return layer + (b->n[2] - 1) * rim + at[1] * (b->n[0] + 1) + at[0];
	return layer + (at[2] - 1) * rim + in_rim(b, at[0], at[1]);
}

static double
between(double low, double high, size_t i, size_t n)
{
	double s = (double)i / (double)n;

	return (1 - s) * low + s * high;
}

static uint32_t
corner(box *b, const size_t at[3])
{
	size_t v = number_of(b, at);

	b->p[v] = mr_vec(between(b->at.min.x, b->at.max.x, at[0], b->n[0]),
	    between(b->at.min.y, b->at.max.y, at[1], b->n[1]),
	    between(b->at.min.z, b->at.max.z, at[2], b->n[2]));
	return (uint32_t)v;
}

/* The side across axis a, at its end where `far`: squares of two triangles. */
static void
make_side(box *b, size_t a, bool far)
{
	size_t u = (a + 1) % 3, w = (a + 2) % 3, at[3];

	at[a] = far ? b->n[a] : 0;
	for (size_t j = 0; j < b->n[w]; j++)
		for (size_t i = 0; i < b->n[u]; i++) {
			uint32_t c[4];
			for (size_t x = 0; x < 4; x++) {
				at[u] = i + (x == 1 || x == 2);
				at[w] = j + (x >= 2);
				c[x] = corner(b, at);
			}
			b->t[b->faces++] = far ? (mr_tri){ { c[0], c[1], c[2] } }
			                       : (mr_tri){ { c[0], c[2], c[1] } };
			b->t[b->faces++] = far ? (mr_tri){ { c[0], c[2], c[3] } }
			                       : (mr_tri){ { c[0], c[3], c[2] } };
		}
}

mr_status
mr_wrap_box(mr_ctx *ctx, mr_box at, const size_t edges[3], mr_mesh *out)
{
	box b = { .n = { edges[0], edges[1], edges[2] }, .at = at };
	size_t squares = 2 * (edges[0] * edges[1] + edges[1] * edges[2] + edges[2] * edges[0]);

	if (squares >= UINT32_MAX / 8)
		return mr_fail(ctx, MR_ERANGE, "a box of %zu x %zu x %zu edges has too many faces", edges[0],
		    edges[1], edges[2]);
	b.p = MR_NEW(ctx, squares + 2, mr_v3);
	b.t = MR_NEW(ctx, 2 * squares, mr_tri);
	for (size_t a = 0; a < 3; a++) {
		make_side(&b, a, false);
		make_side(&b, a, true);
	}
	*out = (mr_mesh){ .name = "control", .p = b.p, .t = b.t, .nv = squares + 2, .nf = b.faces };
	return MR_OK;
}

mr_status
mr_wrap_dyn(mr_ctx *ctx, const mr_mesh *m, mr_dyn *d)
{
	mr_topology topo;

	MR_TRY(mr_topology_build(ctx, m, &topo));
	return mr_dyn_build(ctx, m, &topo, 180, d);
}
