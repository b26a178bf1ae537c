/* The volume of a cloud without normals.  A soft flood, absorbed by the points, finds the side of exposed
 * points (Jeong, Kim 2001), alike planes pass it on, and the indicator (Kazhdan et al. 2006) corrects hidden
 * ones. */
#include "volume/volume.h"

#include "base/parallel.h"
#include "base/sort.h"
#include "volume/parts.h"

enum {
	GRAIN = 1024,
	MARGIN = 6, /* cells around the box of the points: more than any place asked for is away */
	CELLS_LEAST = 4,
	CELLS_MOST = 4096,     /* along the longest side of the box */
	NODES_LEAST = 1 << 20, /* or fewer, that every cloud may have */
	NODES_PER_POINT = 16,  /* that a larger one may have */
	NEARBY = 3,            /* levels on which the values of points are nearby */
	ROUNDS_MOST = 20,      /* of turning normals over */
	PARTS_MOST = 4         /* of turning parts over */
};

/* Spacings.  By 1.35 of 164 wraps five more have the right topology, at distances 2 % less; but a sphere with
 * noise of a spacing and outliers gets a handle, and sheets come apart. */
static const double CELL = 1.5;

static const double COARSER = 1.25;      /* than that: points are too many for the grid */
static const double SPARSE = 1.3;        /* steps: points further apart spread on a coarser level */
static const double ABSORPTION = 20;     /* of the flood, by a full layer of points */
static const double TURNED_LEAST = 2e-4; /* share of the points that is worth another round */
static const double THIN = 1.8;          /* steps that the inside, or a gap, must measure */
static const double LEVEL_LEAST = 0.3, LEVEL_MOST = 1.7; /* of half the rise across the surface */

/* TORN: share of alike neighbours of unlike signs by the root of the points: 2.6 and more on 59 terrains, 0.4
 * at most on 58 bodies.  BOTH: votes against a sheet's signs: 0.43 and more there, 0.06 at most here. */
static const double TORN = 1, BOTH = 0.35;

typedef struct volume {
	mr_volume_cloud s;
	mr_grid grid[DEPTHS];
	mr_grid_points f[DEPTHS];
	size_t levels, depths;
	double *value;       /* of each point */
	bool *seen;          /* of each point: on its normal's side, by the flood */
	bool sheet;          /* the flood comes to both sides of the points */
	mr_outer_sides side; /* of the points; toward NULL where none is known */
	mr_volume_result found;
} volume;

static void
set_grid(mr_box box, double step, mr_grid *g, size_t *levels)
{
	mr_v3 size = mr_sub(box.max, box.min), centre = mr_lerp(0.5, box.min, box.max), half;
	const double side[3] = { size.x, size.y, size.z };
	size_t cells[3], most = 0;

	for (int k = 0; k < 3; k++) {
		cells[k] = (size_t)ceil(side[k] / step) + (size_t)2 * MARGIN;
		most = cells[k] > most ? cells[k] : most;
	}
	*levels = mr_multigrid_levels(most);
	for (int k = 0; k < 3; k++)
		g->n[k] = mr_multigrid_nodes(cells[k], *levels);
	g->step = step;
	half = mr_mul(step / 2, mr_vec((double)(g->n[0] - 1), (double)(g->n[1] - 1), (double)(g->n[2] - 1)));
	g->origin = mr_sub(centre, half);
}

/* As fine as the sampling, as far as memory in proportion to the n points of the cloud allows. */
static void
choose_grid(mr_box box, double spacing, size_t n, size_t cells, mr_grid *g, size_t *levels)
{
	mr_v3 size = mr_sub(box.max, box.min);
	double longest = fmax(size.x, fmax(size.y, size.z)),
	       step = fmax(longest / CELLS_MOST, fmin(CELL * spacing, longest / CELLS_LEAST));
	size_t most = n * NODES_PER_POINT < NODES_LEAST ? NODES_LEAST : n * NODES_PER_POINT;

	set_grid(box, cells ? longest / (double)cells : step, g, levels);
	while (!cells && mr_grid_nodes(g) > most) {
		step *= 1.03;
		set_grid(box, step, g, levels);
	}
}

/* Selects points that are as far apart as the grid shows. */
static double
useful_share(const mr_v3 *point, size_t n, double spacing, const mr_volume_opts *opts)
{
	mr_box box = mr_box_of(point, n);
	size_t levels;
	double coarser;
	mr_grid g;

	if (!(spacing > 0 && mr_box_diagonal(box) > 0))
		return 1;
	choose_grid(box, spacing, n, opts->grid, &g, &levels);
	coarser = g.step / (CELL * spacing);
	return coarser > COARSER ? 1 / (coarser * coarser) : 1;
}

/* The volume that the normals enclose (the divergence theorem), relative to the sizes of its terms: 0.2 and
 * more for nearly all closed models. */
static double
enclosed_share(const mr_volume_cloud *s)
{
	mr_v3 c = { 0, 0, 0 };
	double all = 0, sum = 0, size = 0;

	for (size_t i = 0; i < s->n; i++) {
		c = mr_axpy(s->plane.area[i], s->p[i], c);
		all += s->plane.area[i];
	}
	c = mr_mul(1 / all, c);
	for (size_t i = 0; i < s->n; i++) {
		double term = s->plane.area[i] * mr_dot(s->plane.normal[i], mr_sub(s->p[i], c));
		sum += term;
		size += fabs(term);
	}
	return size > 0 ? sum / size : 0;
}

/* The difference of the value from one side of each point's plane to the other. */
typedef struct across {
	const volume *v;
	const float *u;
	double *out;
	double reach;
	size_t some; /* of the points, at equal strides */
} across;

static double
across_at(const across *a, size_t i)
{
	const mr_volume_cloud *s = &a->v->s;
	const mr_grid *g = &a->v->grid[0];
	mr_v3 d = mr_mul(a->reach * g->step, s->plane.normal[i]);

	return mr_volume_at(g, a->u, mr_add(s->p[i], d)) - mr_volume_at(g, a->u, mr_sub(s->p[i], d));
}

static void
measure_across(void *arg, size_t begin, size_t end)
{
	const across *a = arg;

	for (size_t i = begin; i < end; i++)
		a->out[i] = across_at(a, i * a->v->s.n / a->some);
}

/* value: how much more of the flood, 1 - u, there is on a normal's side than on the other; out: the part on
 * both. */
static void
measure_flood(void *arg, size_t begin, size_t end)
{
	const across *a = arg;
	const mr_volume_cloud *s = &a->v->s;

	for (size_t i = begin; i < end; i++) {
		mr_v3 d = mr_mul(a->v->grid[0].step, s->plane.normal[i]);
		double before = mr_volume_at(&a->v->grid[0], a->u, mr_add(s->p[i], d));
		double behind = mr_volume_at(&a->v->grid[0], a->u, mr_sub(s->p[i], d));
		a->v->value[i] = behind - before;
		a->out[i] = 2 - before - behind;
	}
}

static bool
is_torn(const volume *v)
{
	mr_volume_sides j = mr_volume_judge(&v->s, v->s.plane.normal);

	return (1 - j.alike) * sqrt((double)v->s.n) > TORN;
}

/* The share of the votes against the signs. */
static double
against_share(const volume *v)
{
	double against = 0, all = 0;

	for (size_t i = 0; i < v->s.n; i++) {
		all += fabs(v->value[i]);
		against += fmax(0, -v->value[i]);
	}
	return all > 0 ? against / all : 0;
}

/* Signs by the flood, 1 - w, and neighbours; v->value: its votes for them. */
static mr_status
orient_by_votes(mr_ctx *ctx, volume *v, const float *w)
{
	mr_mark mark = mr_mark_take(ctx);
	double *flood = MR_NEW(ctx, v->s.n, double);
	size_t untold;

	mr_parallel(ctx, v->s.n, GRAIN, measure_flood, &(across){ v, w, flood, 1, 0 });
	MR_TRY(mr_volume_orient(ctx, &v->s, v->value, flood, true, &untold));
	if (is_torn(v))
		MR_TRY(mr_volume_orient(ctx, &v->s, v->value, flood, false, &untold));
	v->sheet = against_share(v) > BOTH;
	mr_mark_release(ctx, mark);
	return MR_OK;
}

static void
mark_seen(volume *v)
{
	double loud = mr_volume_loud(v->value, v->s.n);

	for (size_t i = 0; i < v->s.n; i++)
		v->seen[i] = v->value[i] > loud;
}

/* The flood from outside, u, is 1 - w: w is zero on the faces of the grid and absorbed to 1 at points.  w: of
 * the grid's nodes, for the while. */
static mr_status
orient_by_flood(mr_ctx *ctx, volume *v, float *w)
{
	mr_mark mark = mr_mark_take(ctx);
	mr_grid_multigrid m;
	mr_grid_level *l = &m.level[0];
	size_t nodes = mr_grid_nodes(&v->grid[0]);

	mr_multigrid_begin(ctx, v->grid[0].n, v->levels, w, true, &m);
	/* the screen of a step; a coarser level's step is twice as long */
	for (size_t d = v->depths; d-- > 0;) {
		mr_volume_spread(ctx, &v->s, &v->f[d], NULL, m.level[d].screen);
		if (d + 1 < v->depths)
			mr_multigrid_prolong(ctx, &m.level[d], &m.level[d + 1], m.level[d + 1].screen,
			    m.level[d].screen, 1, 0.5f);
	}
	for (size_t i = 0; i < nodes; i++)
		l->screen[i] *= (float)ABSORPTION;
	mr_multigrid_full(ctx, &m);
	mr_mark_release(ctx, mark);
	MR_TRY(orient_by_votes(ctx, v, w));
	mark_seen(v);
	return MR_OK;
}

static void
drop_sides(mr_ctx *ctx, volume *v)
{
	const char *what = !v->side.normals
	                       ? "the places of the scanner contradict the points, and are not used"
	                   : v->found.sided
	                       ? "the normals of the points contradict their places, and are not used"
	                       : "the normals of the points have no length, and are not used";

	mr_found(ctx, &(mr_finding){ .kind = MR_GUESSED, .layer = "points", .what = what });
	v->found.sided = 0;
	v->side.toward = NULL;
}

/* The share of the points seen by the flood whose normals point to the other side. */
static double
unseen_share(const volume *v, const mr_v3 *by_flood)
{
	size_t seen = 0, against = 0;

	for (size_t i = 0; i < v->s.n; i++) {
		seen += v->seen[i];
		against += v->seen[i] && mr_dot(v->s.plane.normal[i], by_flood[i]) < 0;
	}
	return seen > 0 ? (double)against / (double)seen : 0;
}

/* Sides that enclose nothing, as of normals that all point upward, are none where the flood has others. */
static mr_status
check_sides(mr_ctx *ctx, volume *v, float *w)
{
	MR_SCOPE(ctx);
	mr_v3 *by_flood = MR_NEW(ctx, v->s.n, mr_v3);
	size_t untold;

	MR_TRY(orient_by_flood(ctx, v, w));
	memcpy(by_flood, v->s.plane.normal, v->s.n * sizeof *by_flood);
	MR_TRY(mr_volume_orient_toward(ctx, &v->s, v->side.toward, &untold));
	if (v->sheet || unseen_share(v, by_flood) <= BOTH)
		return MR_OK;
	memcpy(v->s.plane.normal, by_flood, v->s.n * sizeof *by_flood);
	drop_sides(ctx, v);
	return MR_OK;
}

/* A body that is seen from within, as a room, has its inside where it is seen from. */
static mr_status
orient(mr_ctx *ctx, volume *v, float *w)
{
	static const double LITTLE = 0.05;
	size_t untold;
	double share;

	if (!v->side.toward)
		return orient_by_flood(ctx, v, w);
	MR_TRY(mr_volume_orient_toward(ctx, &v->s, v->side.toward, &untold));
	share = enclosed_share(&v->s);
	if (fabs(share) < LITTLE)
		return check_sides(ctx, v, w);
	v->found.turned = share < 0;
	for (size_t i = 0; v->found.turned && i < v->s.n; i++)
		v->s.plane.normal[i] = mr_mul(-1, v->s.plane.normal[i]);
	return MR_OK;
}

/* Half of what the indicator rises by across the surface, or, as over thin parts it never does, the median
 * value at some points where that is more. */
static double
half_rise(mr_ctx *ctx, const volume *v, const float *u)
{
	enum { MOST = 10007 };
	mr_mark mark = mr_mark_take(ctx);
	size_t m = v->s.n < MOST ? v->s.n : MOST;
	double *rise = MR_NEW(ctx, m, double), half = 0;

	for (int reach = 1; reach <= 3; reach++) {
		mr_parallel(ctx, m, GRAIN, measure_across, &(across){ v, u, rise, reach, m });
		half = fmax(half, -mr_kth(rise, m, m - 1 - m / 2) / 2);
	}
	for (size_t i = 0; i < m; i++)
		rise[i] = mr_volume_at(&v->grid[0], u, v->s.p[i * v->s.n / m]);
	half = fmax(half, mr_kth(rise, m, m / 2));
	mr_mark_release(ctx, mark);
	return half;
}

/* Turns the normals over along which the indicator u rises and whose side is not seen; how many. */
static size_t
turn_over(mr_ctx *ctx, volume *v, const float *u)
{
	size_t turned = 0;

	mr_parallel(ctx, v->s.n, GRAIN, measure_across, &(across){ v, u, v->value, 1, v->s.n });
	for (size_t i = 0; i < v->s.n; i++)
		if (v->value[i] > 0 && !v->seen[i]) {
			v->s.plane.normal[i] = mr_mul(-1, v->s.plane.normal[i]);
			turned++;
		}
	return turned;
}

/* Sparse points spread on coarser levels; a right side there is of four times the squared step. */
static void
spread_normals(mr_ctx *ctx, const volume *v, mr_grid_multigrid *m)
{
	for (size_t d = v->depths; d-- > 0;) {
		mr_volume_divergence(ctx, &v->s, &v->f[d], m->level[d].b);
		if (d + 1 < v->depths)
			mr_multigrid_prolong(
			    ctx, &m->level[d], &m->level[d + 1], m->level[d + 1].b, m->level[d].b, 1, 0.25f);
	}
}

/* A sheet has no indicator. */
static bool
may_turn(const volume *v)
{
	return !v->side.toward && !v->sheet;
}

/* Solves and turns over until few normals are turned. */
static void
settle(mr_ctx *ctx, volume *v, mr_grid_multigrid *m)
{
	for (size_t rounds = 0;; rounds++) {
		spread_normals(ctx, v, m);
		mr_multigrid_full(ctx, m);
		if (rounds == ROUNDS_MOST || !may_turn(v) ||
		    (double)turn_over(ctx, v, m->level[0].u) <= TURNED_LEAST * (double)v->s.n)
			return;
	}
}

/* Settles, and again as long as whole parts were the wrong way round, and fewer points each time. */
static void
solve_indicator(mr_ctx *ctx, volume *v, mr_grid_multigrid *m)
{
	size_t before = SIZE_MAX, turned;

	settle(ctx, v, m);
	for (int i = 0; i < PARTS_MOST && may_turn(v); i++) {
		double half = half_rise(ctx, v, m->level[0].u);
		mr_volume_turn_parts(ctx, &v->s, &v->grid[0], m->level[0].u, 2 * half, &turned);
		if (turned == 0 || turned >= before)
			break;
		before = turned;
		settle(ctx, v, m);
	}
}

/* How far from p along d, in steps, the value is above (rise 1) or below (-1) `at`, its value at p: THIN at
 * most. */
static double
width(const mr_grid *g, const float *u, mr_v3 p, double at, mr_v3 d, double rise)
{
	double t = 0;

	while (t < THIN && rise * (mr_volume_at(g, u, mr_axpy((t + THIN / 6) * g->step, d, p)) - at) > 0)
		t += THIN / 6;
	return t;
}

/* The value on the surface to be, near each point: its own; if the inside, or a gap, is thinner than the grid
 * can hold, the value of a place beyond, so that it becomes thicker. */
static void
measure_level(void *arg, size_t begin, size_t end)
{
	const across *a = arg;
	const mr_volume_cloud *s = &a->v->s;
	const mr_grid *g = &a->v->grid[0];

	for (size_t i = begin; i < end; i++) {
		mr_v3 n = s->plane.normal[i];
		double at = mr_volume_at(g, a->u, s->p[i]);
		double in = width(g, a->u, s->p[i], at, mr_mul(-1, n), 1),
		       out = width(g, a->u, s->p[i], at, n, -1);
		a->out[i] = mr_volume_at(g, a->u, mr_axpy((out - in) / 2 * g->step, n, s->p[i]));
	}
}

/* Level 1's u = mean of the values of the points nearby; `far` where there are none. */
static void
spread_values(mr_ctx *ctx, const volume *v, const mr_walls *w, mr_grid_multigrid *m, double far)
{
	static const float LITTLE = 0.05f; /* 0.01: 127 right; 0.2: 130, at distances 2 % longer */
	size_t depths = m->levels < 1 + NEARBY ? m->levels : 1 + NEARBY;
	mr_mark mark = mr_mark_take(ctx);
	float *weight[1 + NEARBY] = { NULL, w->area };

	for (size_t i = 2; i < depths; i++)
		weight[i] = MR_NEW_ZERO(ctx, m->level[i].n[0] * m->level[i].n[1] * m->level[i].n[2], float);
	mr_volume_spread(ctx, &v->s, &w->of, v->value, m->level[1].b);
	for (size_t i = 1; i + 1 < depths; i++) {
		mr_grid_level *l = &m->level[i], *c = l + 1;
		mr_multigrid_restrict(ctx, l, c, l->b, c->b, 1);
		mr_multigrid_restrict(ctx, l, c, weight[i], weight[i + 1], 1);
	}
	for (size_t i = depths; i-- > 1;) {
		mr_grid_level *l = &m->level[i];
		size_t nodes = l->n[0] * l->n[1] * l->n[2];
		for (size_t k = 0; k < nodes; k++)
			l->u[k] = (float)far;
		if (i + 1 < depths)
			mr_multigrid_prolong(ctx, l, l + 1, l[1].u, l->u, 0, 1);
		for (size_t k = 0; k < nodes; k++)
			l->u[k] = (l->b[k] + LITTLE * l->u[k]) / (weight[i][k] + LITTLE);
	}
	mr_mark_release(ctx, mark);
}

/* f = value wanted nearby - indicator, in place of the indicator: positive on the faces of the grid. */
static mr_status
make_level(mr_ctx *ctx, volume *v, const mr_walls *w, double half, mr_grid_multigrid *m)
{
	mr_grid_level *l = &m->level[0];
	size_t nodes = mr_grid_nodes(&v->grid[0]);
	float *c = l->b;

	mr_parallel(ctx, v->s.n, GRAIN, measure_level, &(across){ v, l->u, v->value, 0, 0 });
	if (!(half > 0))
		return mr_fail(
		    ctx, MR_EMESH, "%zu points enclose nothing: no side of them is the inside", v->s.n);
	for (size_t i = 0; i < v->s.n; i++)
		v->value[i] = fmax(LEVEL_LEAST * half, fmin(v->value[i], LEVEL_MOST * half));
	spread_values(ctx, v, w, m, half);
	for (size_t i = 0; i < nodes; i++)
		c[i] = (float)half;
	mr_multigrid_prolong(ctx, l, &m->level[1], m->level[1].u, c, 0, 1);
	for (size_t i = 0; i < nodes; i++)
		l->u[i] = c[i] - l->u[i];
	return MR_OK;
}

static void
begin(mr_ctx *ctx, size_t cells, size_t n, volume *v)
{
	choose_grid(v->s.box, v->s.noise * v->s.spacing, n, cells, &v->grid[0], &v->levels);
	v->depths = v->levels < DEPTHS ? v->levels : DEPTHS;
	v->sheet = false;
	v->value = MR_NEW(ctx, v->s.n, double);
	v->seen = MR_NEW(ctx, v->s.n, bool);
	v->s.depth = MR_NEW(ctx, v->s.n, uint8_t);
	for (size_t i = 0; i < v->s.n; i++) {
		double side = sqrt(v->s.plane.area[i]) / v->grid[0].step;
		v->s.depth[i] = 0;
		for (; side > SPARSE && v->s.depth[i] + 1u < v->depths; side /= 2)
			v->s.depth[i]++;
	}
	for (unsigned d = 0; d < v->depths; d++) {
		mr_grid *g = &v->grid[d];
		if (d > 0) {
			*g = v->grid[d - 1];
			g->step *= 2;
			for (int k = 0; k < 3; k++)
				g->n[k] = (g->n[k] - 1) / 2 + 1;
		}
		mr_volume_field(ctx, &v->s, g, d, &v->f[d]);
	}
}

/* f, of the grid's nodes: below the level inside. */
static mr_status
fill_field(mr_ctx *ctx, volume *v, const mr_walls *w, float *f, float *level)
{
	mr_grid_multigrid m;
	double rise;

	MR_TRY(orient(ctx, v, f));
	mr_multigrid_begin(ctx, v->grid[0].n, v->levels, f, false, &m);
	solve_indicator(ctx, v, &m);
	rise = half_rise(ctx, v, f);
	MR_TRY(make_level(ctx, v, w, rise, &m));
	return mr_volume_level(ctx, w, &v->grid[0], f, rise, level, &v->found);
}

static void
report_uncertain(mr_ctx *ctx, const char *what, mr_v3 at)
{
	mr_finding f = {
		.kind = MR_UNCERTAIN, .what = what, .placed = true, .vertex = MR_NO_VERTEX, .at = at
	};

	mr_found(ctx, &f);
}

/* Patches on the wrong side end at neighbours whose planes are alike and signs are not: 0.06 % of these pairs
 * at most where all is right. */
void
mr_volume_report_patches(mr_ctx *ctx, const mr_volume_cloud *s)
{
	static const double UNLIKE = 1e-3;
	mr_volume_sides j = mr_volume_judge(s, s->plane.normal);

	if (1 - j.alike > UNLIKE)
		report_uncertain(ctx, ": neighbours have normals on unlike sides", s->p[j.unlike]);
}

/* Along a normal that is on the right side the indicator u falls: of clouds thick enough it hardly does at
 * 1.7 % of the points at most. */
static void
report_sides(mr_ctx *ctx, volume *v, const float *u)
{
	static const double HARDLY = 0.25, SHARE = 0.03;
	size_t unsure = 0, first = 0;
	double half = half_rise(ctx, v, u);

	mr_parallel(ctx, v->s.n, GRAIN, measure_across, &(across){ v, u, v->value, 1, v->s.n });
	for (size_t i = v->s.n; i-- > 0;)
		if (-v->value[i] < HARDLY * 2 * half) {
			unsure++;
			first = i;
		}
	if ((double)unsure > SHARE * (double)v->s.n)
		report_uncertain(
		    ctx, ": body or gaps are too thin to show which side is outside", v->s.p[first]);
	else
		mr_volume_report_patches(ctx, &v->s);
}

/* By the indicator, with f for the while. */
static void
orient_body(mr_ctx *ctx, volume *v, float *f)
{
	mr_grid_multigrid m;

	mr_multigrid_begin(ctx, v->grid[0].n, v->levels, f, false, &m);
	solve_indicator(ctx, v, &m);
	report_sides(ctx, v, m.level[0].u);
}

mr_status
mr_volume_orient_outward(mr_ctx *ctx, mr_volume_cloud *s)
{
	mr_mark mark = mr_mark_take(ctx);
	volume v = { .s = *s };
	float *f;

	begin(ctx, 0, s->n, &v);
	f = MR_NEW(ctx, mr_grid_nodes(&v.grid[0]), float);
	MR_TRY(orient_by_flood(ctx, &v, f));
	if (v.sheet)
		report_uncertain(ctx, ": outside is on both sides of the points", v.s.p[0]);
	else
		orient_body(ctx, &v, f);
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* Whether given sides are worth more than the flood's: true normals of 116 of 120 clouds are so good; at
 * random half of the directions are near and half of the neighbours alike. */
static bool
are_consistent(const mr_volume_sides *j, bool normals)
{
	static const double NEAR_LEAST = 0.7, ALIKE_LEAST = 0.9;

	return j->told > 0 && j->alike >= ALIKE_LEAST && (!normals || j->near >= NEAR_LEAST);
}

/* Takes the given sides where they fit the points.  index: of each place. */
static void
take_sides(mr_ctx *ctx, const uint32_t *index, size_t places, const mr_outer_sides *sides, volume *v)
{
	mr_v3 *toward = MR_NEW(ctx, v->s.n, mr_v3);
	mr_volume_sides judged;

	for (size_t i = 0; i < v->s.n; i++)
		toward[i] = sides->toward[index[i * places / v->s.n]];
	judged = mr_volume_judge(&v->s, toward);
	v->found.sided = judged.told;
	v->side = (mr_outer_sides){ toward, sides->normals };
	if (!are_consistent(&judged, sides->normals))
		drop_sides(ctx, v);
}

/* v->s of what counts of n points; *places: how many these are. */
static mr_status
take_points(mr_ctx *ctx, const mr_v3 *point, size_t n, const mr_volume_opts *opts, size_t *places, volume *v)
{
	mr_sampling s;
	uint32_t *index;
	mr_v3 *p;

	MR_TRY(mr_sampling_find(ctx, point, n, opts->sampling, &s));
	mr_sampling_places(ctx, point, &s, &p, &index, places);
	MR_TRY(mr_volume_samples(ctx, p, *places, &s, useful_share(p, *places, s.usual, opts), &v->s));
	if (opts->sides)
		take_sides(ctx, index, *places, opts->sides, v);
	return MR_OK;
}

mr_status
mr_volume_wrap(mr_ctx *ctx, const mr_v3 *point, size_t n, const mr_volume_opts *opts, mr_mesh *out,
    mr_volume_result *result)
{
	size_t places;
	volume v;
	mr_mark mark;
	mr_mesh m;
	mr_walls w;
	float *f, level;

	if (opts->grid > CELLS_MOST)
		return mr_fail(ctx, MR_ERANGE, "a grid of %zu cells: %d at most", opts->grid, CELLS_MOST);
	mr_unmeasured(&v.found, sizeof v.found);
	v.found.turned = false;
	v.side.toward = NULL;
	MR_TRY(take_points(ctx, point, n, opts, &places, &v));
	begin(ctx, opts->grid, places, &v);
	mr_walls_begin(ctx, &v.s, &v.grid[0], &w);
	f = MR_NEW(ctx, mr_grid_nodes(&v.grid[0]), float);
	mark = mr_mark_take(ctx);
	MR_TRY(fill_field(ctx, &v, &w, f, &level));
	mr_mark_release(ctx, mark);
	MR_TRY(mr_volume_surface(ctx, &w, &v.grid[0], f, level, &m));
	if (m.nf == 0)
		return mr_fail(ctx, MR_EMESH, "%zu points enclose nothing at a grid of %zu x %zu x %zu nodes",
		    v.s.n, v.grid[0].n[0], v.grid[0].n[1], v.grid[0].n[2]);
	m.name = "volume";
	*out = m;
	v.found.samples = v.s.n;
	v.found.spacing = v.s.spacing;
	v.found.noise = v.s.noise;
	v.found.cell = v.grid[0].step;
	if (result)
		*result = v.found;
	return MR_OK;
}
