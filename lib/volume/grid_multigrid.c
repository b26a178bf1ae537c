/* Multigrid on a grid's nodes (Briggs, Henson, McCormick 2000): red-black Gauss-Seidel, full weighting,
 * linear interpolation; the equation is (6 + screen) u - sum of the six neighbours = b. */
#include "volume/parts.h"

#include "base/parallel.h"

/* ROW_MOST: nodes along an axis of 4096 cells, with margins, rounded up. */
enum { COARSEST = 12, SWEEPS = 2, COARSEST_SWEEPS = 40, PIECE = 1 << 15, ROW_MOST = 1 << 13 };

size_t
mr_multigrid_levels(size_t cells)
{
	size_t levels = 1;

	while (cells >> (levels - 1) > COARSEST && levels < LEVELS_MOST)
		levels++;
	return levels;
}

size_t
mr_multigrid_nodes(size_t cells, size_t levels)
{
	size_t unit = (size_t)1 << (levels - 1), units = (cells + unit - 1) / unit;

	return (units < 2 ? 2 : units) * unit + 1;
}

static size_t
nodes_of(const mr_grid_level *l)
{
	return l->n[0] * l->n[1] * l->n[2];
}

void
mr_multigrid_begin(
    mr_ctx *ctx, const size_t n[3], size_t levels, float *u, bool screened, mr_grid_multigrid *m)
{
	m->levels = levels;
	for (size_t i = 0; i < levels; i++) {
		mr_grid_level *l = &m->level[i];
		for (int k = 0; k < 3; k++)
			l->n[k] = i == 0 ? n[k] : (m->level[i - 1].n[k] - 1) / 2 + 1;
		l->u = i == 0 ? u : MR_NEW(ctx, nodes_of(l), float);
		l->b = MR_NEW_ZERO(ctx, nodes_of(l), float);
		l->screen = !screened ? NULL : i == 0 ? l->b : MR_NEW_ZERO(ctx, nodes_of(l), float);
		memset(l->u, 0, nodes_of(l) * sizeof *l->u);
	}
}

/* A loop over the inner layers of a level. */
typedef struct pass {
	const mr_grid_level *fine, *coarse;
	const float *from; /* NULL: the residuals of the finer level */
	float *to;
	float scale;
	size_t colour;
	float keep;
} pass;

static void
over_layers(mr_ctx *ctx, const mr_grid_level *l, mr_body body, pass *p)
{
	mr_parallel(ctx, l->n[2] - 2, PIECE / (l->n[0] * l->n[1]) + 1, body, p);
}

static void
relax_rows(const mr_grid_level *l, size_t z, size_t colour)
{
	size_t up = l->n[0], far = l->n[0] * l->n[1];

	for (size_t y = 1; y + 1 < l->n[1]; y++) {
		float *u = l->u + z * far + y * up;
		const float *b = l->b + z * far + y * up,
			    *s = l->screen ? l->screen + z * far + y * up : NULL;
		size_t first = 1 + ((y + z + 1 + colour) & 1), end = l->n[0] - 1;
		if (s)
			for (size_t x = first; x < end; x += 2)
				u[x] = (b[x] + u[x - 1] + u[x + 1] + *(u + x - up) + u[x + up] +
					   *(u + x - far) + u[x + far]) /
				       (6 + s[x]);
		else
			for (size_t x = first; x < end; x += 2)
				u[x] = (b[x] + u[x - 1] + u[x + 1] + *(u + x - up) + u[x + up] +
					   *(u + x - far) + u[x + far]) *
				       (1.0f / 6);
	}
}

static void
relax_layers(void *arg, size_t begin, size_t end)
{
	const pass *p = arg;

	for (size_t z = begin; z < end; z++)
		relax_rows(p->fine, z + 1, p->colour);
}

static void
relax(mr_ctx *ctx, const mr_grid_level *l, size_t sweeps)
{
	for (size_t i = 0; i < 2 * sweeps; i++)
		over_layers(ctx, l, relax_layers, &(pass){ .fine = l, .colour = i & 1 });
}

/* line += weight times a row of the finer level, but for its ends. */
static void
add_row(const pass *p, size_t y, size_t z, float weight, float *line)
{
	const mr_grid_level *l = p->fine;
	size_t up = l->n[0], far = l->n[0] * l->n[1], row = z * far + y * up;

	if (p->from) {
		for (size_t x = 1; x + 1 < l->n[0]; x++)
			line[x] += weight * p->from[row + x];
		return;
	}
	for (size_t x = 1; x + 1 < l->n[0]; x++) {
		size_t i = row + x;
		line[x] += weight *
		           (l->b[i] - (6 + (l->screen ? l->screen[i] : 0)) * l->u[i] + l->u[i - 1] +
			       l->u[i + 1] + l->u[i - up] + l->u[i + up] + l->u[i - far] + l->u[i + far]);
	}
}

/* (1 2 1) / 4 along each axis. */
static void
restrict_layers(void *arg, size_t begin, size_t end)
{
	static const float w[3] = { 0.25f, 0.5f, 0.25f };
	const pass *p = arg;
	const size_t *n = p->coarse->n;
	float line[ROW_MOST];

	for (size_t z = begin + 1; z <= end; z++)
		for (size_t y = 1; y + 1 < n[1]; y++) {
			float *to = p->to + (z * n[1] + y) * n[0];
			memset(line, 0, p->fine->n[0] * sizeof *line);
			for (size_t k = 0; k < 9; k++)
				add_row(p, 2 * y - 1 + k % 3, 2 * z - 1 + k / 3, w[k % 3] * w[k / 3], line);
			for (size_t x = 1; x + 1 < n[0]; x++)
				to[x] = p->scale *
				        (0.25f * (line[2 * x - 1] + line[2 * x + 1]) + 0.5f * line[2 * x]);
		}
}

void
mr_multigrid_restrict(mr_ctx *ctx, const mr_grid_level *fine, const mr_grid_level *coarse, const float *from,
    float *to, float scale)
{
	over_layers(ctx, coarse, restrict_layers,
	    &(pass){ .fine = fine, .coarse = coarse, .from = from, .to = to, .scale = scale });
}

static void
prolong_layers(void *arg, size_t begin, size_t end)
{
	const pass *p = arg;
	const mr_grid_level *f = p->fine, *c = p->coarse;

	for (size_t z = begin + 1; z <= end; z++)
		for (size_t y = 1; y + 1 < f->n[1]; y++) {
			size_t z0 = z / 2, z1 = (z + 1) / 2, y0 = y / 2, y1 = (y + 1) / 2;
			const float *a = p->from + (z0 * c->n[1] + y0) * c->n[0],
				    *b = p->from + (z0 * c->n[1] + y1) * c->n[0],
				    *d = p->from + (z1 * c->n[1] + y0) * c->n[0],
				    *e = p->from + (z1 * c->n[1] + y1) * c->n[0];
			float *to = p->to + (z * f->n[1] + y) * f->n[0];
			float before = a[0] + b[0] + d[0] + e[0];
			for (size_t x = 1; x + 1 < f->n[0]; x += 2) {
				size_t i = (x + 1) / 2;
				float now = a[i] + b[i] + d[i] + e[i];
				to[x] = p->keep * to[x] + p->scale * 0.125f * (before + now);
				if (x + 2 < f->n[0])
					to[x + 1] = p->keep * to[x + 1] + p->scale * 0.25f * now;
				before = now;
			}
		}
}

void
mr_multigrid_prolong(mr_ctx *ctx, const mr_grid_level *fine, const mr_grid_level *coarse, const float *from,
    float *to, float keep, float scale)
{
	over_layers(ctx, fine, prolong_layers,
	    &(pass){ .fine = fine, .coarse = coarse, .from = from, .to = to, .keep = keep, .scale = scale });
}

static void
cycle_from(mr_ctx *ctx, mr_grid_multigrid *m, size_t i)
{
	mr_grid_level *l = &m->level[i], *c = l + 1;

	if (i + 1 == m->levels) {
		relax(ctx, l, COARSEST_SWEEPS);
		return;
	}
	relax(ctx, l, SWEEPS);
	mr_multigrid_restrict(ctx, l, c, NULL, c->b, 4); /* twice the step: four times the right side */
	memset(c->u, 0, nodes_of(c) * sizeof *c->u);
	cycle_from(ctx, m, i + 1);
	mr_multigrid_prolong(ctx, l, c, c->u, l->u, 1, 1);
	relax(ctx, l, SWEEPS);
}

void
mr_multigrid_full(mr_ctx *ctx, mr_grid_multigrid *m)
{
	for (size_t i = 0; i + 1 < m->levels; i++) {
		mr_grid_level *l = &m->level[i], *c = l + 1;
		mr_multigrid_restrict(ctx, l, c, l->b, c->b, 4);
		if (l->screen)
			mr_multigrid_restrict(ctx, l, c, l->screen, c->screen, 4);
	}
	for (size_t i = m->levels; i-- > 0;) {
		if (i + 1 < m->levels)
			mr_multigrid_prolong(
			    ctx, &m->level[i], &m->level[i + 1], m->level[i + 1].u, m->level[i].u, 0, 1);
		cycle_from(ctx, m, i);
	}
}
