/* The level of the surface: the wanted one if its neighbours have the same Euler number, else of the longest
 * run of levels that do (persistence: Edelsbrunner, Letscher, Zomorodian 2002). */
#include "mesh/clip.h"
#include "space/connected.h"
#include "volume/parts.h"
#include "volume/volume.h"

#include <stdlib.h>

enum { LEVELS = MR_VOLUME_LEVELS, MIDDLE = LEVELS / 2, LASTING = 3 };

/* From the wanted level to the first or last, as a share of the indicator's rise: of 986 wraps of 58 closed
 * meshes 794 have the right topology, without it 761. */
static const double RANGE = 0.4;

enum { POINTS_LEAST = 12, VERTICES_LEAST = 36, MANY = 100 };

/* The area of the points around a wall that stays, as a share of its area. */
static const double SHARE_LEAST = 0.3;

/* For a wall that points cover evenly: how often its vertices see a point, and how many they are in a squared
 * step of the grid by which they see them. */
static const double SEEN = 4.5, PER_STEP = 6;

void
mr_walls_begin(mr_ctx *ctx, const mr_volume_cloud *s, const mr_grid *g, mr_walls *w)
{
	double *one = MR_NEW(ctx, s->n, double);

	*w = (mr_walls){ .s = s, .grid = *g };
	w->grid.step *= 2;
	for (int k = 0; k < 3; k++)
		w->grid.n[k] = (g->n[k] - 1) / 2 + 1;
	w->points = MR_NEW(ctx, mr_grid_nodes(&w->grid), float);
	w->area = MR_NEW(ctx, mr_grid_nodes(&w->grid), float);
	mr_volume_field(ctx, s, &w->grid, DEPTHS, &w->of);
	for (size_t i = 0; i < s->n; i++)
		one[i] = w->grid.step * w->grid.step / s->plane.area[i];
	mr_volume_spread(ctx, s, &w->of, one, w->points);
	mr_volume_spread(ctx, s, &w->of, NULL, w->area);
}

/* A component of the surface, and how many points, of how much area, its vertices see. */
typedef struct wall {
	double vertices, points, area;
} wall;

static void
see(const mr_walls *w, mr_v3 p, wall *of)
{
	mr_v3 d = mr_mul(1 / w->grid.step, mr_sub(p, w->grid.origin));
	size_t i = mr_grid_index(&w->grid, (size_t)(d.x + 0.5), (size_t)(d.y + 0.5), (size_t)(d.z + 0.5));

	of->vertices++;
	of->points += (double)w->points[i];
	of->area += (double)w->area[i];
}

/* A few points that stand for much area are as likely strewn as of a surface: they count as others do, at
 * most. */
static bool
is_supported(const mr_walls *w, const wall *of)
{
	double points = of->points / SEEN, side = w->s->spacing / w->grid.step;
	double area = fmin(of->area / SEEN, points < MANY ? points * side * side : INFINITY);

	return points >= POINTS_LEAST && of->vertices >= VERTICES_LEAST &&
	       area >= SHARE_LEAST * of->vertices / PER_STEP;
}

/* m without walls that are not supported; the one with most points stays. */
static void
keep_walls(mr_ctx *ctx, const mr_walls *w, mr_mesh *m)
{
	double *value = MR_NEW(ctx, m->nv, double);
	size_t largest = 0;
	mr_connected c;
	wall *of;

	mr_connected_by_faces(ctx, m, &c);
	if (c.parts <= 1)
		return;
	of = MR_NEW_ZERO(ctx, c.parts, wall);
	for (size_t v = 0; v < m->nv; v++)
		see(w, m->p[v], &of[c.part[v]]);
	for (size_t k = 1; k < c.parts; k++)
		largest = of[k].area > of[largest].area ? k : largest;
	for (size_t v = 0; v < m->nv; v++)
		value[v] = c.part[v] == largest || is_supported(w, &of[c.part[v]]) ? -1 : 1;
	mr_mesh_clip(ctx, m, value, m);
}

mr_status
mr_volume_surface(mr_ctx *ctx, const mr_walls *w, const mr_grid *g, const float *f, float level, mr_mesh *out)
{
	MR_TRY(mr_isosurface(ctx, g, f, level, out));
	keep_walls(ctx, w, out);
	return MR_OK;
}

typedef struct run {
	int first, last;
} run;

/* The levels around one whose numbers are its own. */
static run
run_around(const int64_t *euler, int level)
{
	run r = { level, level };

	while (r.first > 0 && euler[r.first - 1] == euler[level])
		r.first--;
	while (r.last + 1 < LEVELS && euler[r.last + 1] == euler[level])
		r.last++;
	return r;
}

/* The level of a run that is nearest to the one that is wanted. */
static int
nearest_of(run r)
{
	return r.first > MIDDLE ? r.first : r.last < MIDDLE ? r.last : MIDDLE;
}

/* The interval of the wanted level, if it lasts; else the longest, of equal ones the nearest. */
static run
lasting_run(const int64_t *euler)
{
	run best = run_around(euler, MIDDLE);

	if (best.last - best.first + 1 >= LASTING)
		return best;
	for (int i = 0; i < LEVELS; i++) {
		run r = run_around(euler, i);
		int longer = (r.last - r.first) - (best.last - best.first);
		if (longer > 0 ||
		    (longer == 0 && abs(nearest_of(r) - MIDDLE) < abs(nearest_of(best) - MIDDLE)))
			best = r;
	}
	return best;
}

static float
level_of(double rise, int i)
{
	return (float)(RANGE * rise * (i - MIDDLE) / MIDDLE);
}

mr_status
mr_volume_level(mr_ctx *ctx, const mr_walls *w, const mr_grid *g, const float *f, double rise, float *level,
    mr_volume_result *result)
{
	int64_t euler[LEVELS];
	run r;

	for (int i = 0; i < LEVELS; i++) {
		mr_mark mark = mr_mark_take(ctx);
		mr_mesh m;
		MR_TRY(mr_volume_surface(ctx, w, g, f, level_of(rise, i), &m));
		euler[i] = (int64_t)m.nv - (int64_t)(m.nf / 2);
		mr_mark_release(ctx, mark);
	}
	r = lasting_run(euler);
	result->levels_alike = (size_t)(r.last - r.first) + 1;
	result->euler = (double)euler[r.first];
	*level = level_of(rise, nearest_of(r));
	return MR_OK;
}
