/* Points spread over the nodes of a grid, and values of nodes at points. */
#include "volume/parts.h"

#include "base/parallel.h"

/* Layers of cells that one thread works on.  A point reaches one layer of nodes below its cell and two above,
 * so every other slab of four at once never meets another. */
enum { SLAB = 4 };

/* The position of p in the grid: its cell, and how far into it. */
typedef struct spot {
	size_t x[3];
	double t[3];
} spot;

static spot
spot_of(const mr_grid *g, mr_v3 p, mr_v3 shift)
{
	mr_v3 d = mr_axpy(1 / g->step, mr_sub(p, g->origin), shift);
	const double c[3] = { d.x, d.y, d.z };
	spot s;

	for (int k = 0; k < 3; k++) {
		size_t most = g->n[k] - 3;
		s.x[k] = !(c[k] > 0) ? 0 : c[k] >= (double)most ? most : (size_t)c[k];
		s.t[k] = c[k] - (double)s.x[k];
	}
	return s;
}

/* The weight of corner 0 to 7 of a cell, and its node. */
static double
corner(const mr_grid *g, const spot *s, unsigned c, size_t *node)
{
	size_t x = c & 1, y = c >> 1 & 1, z = c >> 2;

	*node = mr_grid_index(g, s->x[0] + x, s->x[1] + y, s->x[2] + z);
	return (x ? s->t[0] : 1 - s->t[0]) * (y ? s->t[1] : 1 - s->t[1]) * (z ? s->t[2] : 1 - s->t[2]);
}

double
mr_volume_at(const mr_grid *g, const float *u, mr_v3 p)
{
	spot s = spot_of(g, p, mr_vec(0, 0, 0));
	const float *low = u + mr_grid_index(g, s.x[0], s.x[1], s.x[2]);
	double w[3][2], sum = 0;

	for (int k = 0; k < 3; k++) {
		w[k][0] = 1 - s.t[k];
		w[k][1] = s.t[k];
	}
	for (size_t z = 0; z < 2; z++, low += g->n[0] * g->n[1])
		for (size_t y = 0; y < 2; y++) {
			const float *row = low + y * g->n[0];
			sum += w[0][0] * w[1][y] * w[2][z] * (double)row[0];
			sum += w[0][1] * w[1][y] * w[2][z] * (double)row[1];
		}
	return sum;
}

void
mr_volume_field(mr_ctx *ctx, const mr_volume_cloud *s, const mr_grid *grid, unsigned depth, mr_grid_points *f)
{
	size_t layers = grid->n[2] - 1, *at;
	mr_mark mark;

	f->grid = *grid;
	f->first = MR_NEW_ZERO(ctx, layers + 1, size_t);
	f->order = MR_NEW(ctx, s->n, uint32_t);
	mark = mr_mark_take(ctx);
	at = MR_NEW(ctx, layers, size_t);
	for (size_t i = 0; i < s->n; i++)
		if (depth == DEPTHS || s->depth[i] == depth)
			f->first[spot_of(grid, s->p[i], mr_vec(0, 0, 0)).x[2] + 1]++;
	for (size_t z = 0; z < layers; z++) {
		f->first[z + 1] += f->first[z];
		at[z] = f->first[z];
	}
	for (size_t i = 0; i < s->n; i++)
		if (depth == DEPTHS || s->depth[i] == depth)
			f->order[at[spot_of(grid, s->p[i], mr_vec(0, 0, 0)).x[2]]++] = (uint32_t)i;
	mr_mark_release(ctx, mark);
}

typedef struct work {
	const mr_volume_cloud *s;
	const mr_grid_points *f;
	const double *value;
	float *to;
	void (*add)(const struct work *w, size_t i);
	size_t odd;
} work;

/* div V = sum over axes of differences of V on the edges: V spreads over the edges around the point. */
static void
add_divergence(const work *w, size_t i)
{
	const mr_grid *g = &w->f->grid;
	const size_t stride[3] = { 1, g->n[0], g->n[0] * g->n[1] };
	double scale = w->s->plane.area[i] / (g->step * g->step);
	const double v[3] = { scale * w->s->plane.normal[i].x, scale * w->s->plane.normal[i].y,
		scale * w->s->plane.normal[i].z };

	for (size_t k = 0; k < 3; k++) {
		spot s = spot_of(g, w->s->p[i],
		    mr_vec(k == 0 ? -0.5 : 0, k == 1 ? -0.5 : 0, k == 2 ? -0.5 : 0)); /* the edges' middles */
		for (unsigned c = 0; c < 8; c++) {
			size_t node;
			float part = (float)(v[k] * corner(g, &s, c, &node));
			w->to[node] += part;
			w->to[node + stride[k]] -= part;
		}
	}
}

static void
add_value(const work *w, size_t i)
{
	const mr_grid *g = &w->f->grid;
	spot s = spot_of(g, w->s->p[i], mr_vec(0, 0, 0));
	double v = w->s->plane.area[i] / (g->step * g->step) * (w->value ? w->value[i] : 1);

	for (unsigned c = 0; c < 8; c++) {
		size_t node;
		float part = (float)(v * corner(g, &s, c, &node));
		w->to[node] += part;
	}
}

static void
spread_slabs(void *arg, size_t begin, size_t end)
{
	const work *w = arg;
	size_t layers = w->f->grid.n[2] - 1;

	for (size_t slab = begin; slab < end; slab++) {
		size_t z = (2 * slab + w->odd) * SLAB, top = z + SLAB < layers ? z + SLAB : layers;
		if (z >= layers)
			break;
		for (size_t i = w->f->first[z]; i < w->f->first[top]; i++)
			w->add(w, w->f->order[i]);
	}
}

static void
spread(mr_ctx *ctx, work *w)
{
	size_t slabs = (w->f->grid.n[2] - 1 + SLAB - 1) / SLAB;

	memset(w->to, 0, mr_grid_nodes(&w->f->grid) * sizeof *w->to);
	for (w->odd = 0; w->odd < 2; w->odd++)
		mr_parallel(ctx, (slabs + 1) / 2, 1, spread_slabs, w);
}

void
mr_volume_divergence(mr_ctx *ctx, const mr_volume_cloud *s, const mr_grid_points *f, float *to)
{
	/* Laplacian u = - div n, so 6 u - neighbours = + div: out of the lower node of an edge, into the
	 * upper */
	spread(ctx, &(work){ .s = s, .f = f, .to = to, .add = add_divergence });
}

void
mr_volume_spread(
    mr_ctx *ctx, const mr_volume_cloud *s, const mr_grid_points *f, const double *value, float *to)
{
	spread(ctx, &(work){ .s = s, .f = f, .value = value, .to = to, .add = add_value });
}
