/* Folds and intersections that a motion makes, looked for in crowded cells of space. */
#include "judge/judge.h"

#include "mesh/edges.h"
#include "mesh/fold.h"
#include "space/cells.h"
#include "space/contact.h"
#include "space/self_intersect.h"

enum { SAMPLES = 1 << 14, SLOTS = 2 * SAMPLES, FEW = 2048 };

typedef struct crowd {
	mr_mesh then, now;
	mr_cells cells;
	mr_v3 *normal_then, *normal; /* sums around the vertices */
} crowd;

/* Faces that turn against those around them: of two that are folded one does, by the sum of normals at a
 * corner that they share. */

static bool
is_against(mr_v3 n, mr_v3 sum)
{
	const double cosine = 0.3; /* that of 85 degrees, half of a fold, is less */
	double d = mr_dot(n, sum);

	return d <= 0 || d * d < cosine * cosine * mr_norm2(n) * mr_norm2(sum);
}

static bool
turns_against(const mr_mesh *m, size_t f, const mr_v3 *sum)
{
	const uint32_t *v = m->t[f].v;
	mr_v3 n = mr_face_cross(m, f);

	return mr_norm2(n) > 0 &&
	       (is_against(n, sum[v[0]]) || is_against(n, sum[v[1]]) || is_against(n, sum[v[2]]));
}

/* The least cosine that the face's normal has with the sums at its corners. */
static double
agreement(const mr_mesh *m, size_t f, const mr_v3 *sum)
{
	mr_v3 n = mr_unit(mr_face_cross(m, f));
	double least = 1;

	for (int k = 0; k < 3; k++)
		least = fmin(least, mr_dot(n, mr_unit(sum[m->t[f].v[k]])));
	return least;
}

static void
mark_turned(crowd *c)
{
	const double more = 0.1;

	for (size_t f = 0; f < c->now.nf; f++)
		if (turns_against(&c->now, f, c->normal) &&
		    agreement(&c->now, f, c->normal) < agreement(&c->then, f, c->normal_then) - more)
			for (int k = 0; k < 3; k++)
				mr_cells_mark(&c->cells, c->now.p[c->now.t[f].v[k]]);
}

/* Cells that hold what was far apart, or sheets that came by each other, by vertices at equal strides. */

typedef struct content {
	mr_cell at;
	bool used, crowded;
	uint32_t first, last;  /* vertices */
	float low[3], high[3]; /* where it was, in cells */
} content;

static content *
content_of(content *table, mr_cell at)
{
	size_t i = mr_cell_hash(at) % SLOTS;

	while (table[i].used && memcmp(&table[i].at, &at, sizeof at))
		i = (i + 1) % SLOTS;
	return &table[i];
}

/* How far b is before the sheet that a is on. */
static double
before_sheet(const mr_mesh *m, const mr_v3 *normal, size_t a, size_t b)
{
	return mr_dot(mr_unit(normal[a]), mr_sub(m->p[b], m->p[a]));
}

/* Whether b was on one side of the sheet that a is on, and is on the other: on a sheet that faces the other
 * way, or one that was clearly apart. */
static bool
came_by(const crowd *c, size_t a, size_t b)
{
	const double clearly = 0.2;
	double was = before_sheet(&c->then, c->normal_then, a, b),
	       is = before_sheet(&c->now, c->normal, a, b);

	return was * is < 0 && (mr_dot(c->normal[a], c->normal[b]) < 0 ||
				   fabs(was) > clearly * mr_dist(c->then.p[a], c->then.p[b]));
}

static void
add_vertex(const crowd *c, content *table, uint32_t v)
{
	const float far = 3; /* cells */
	mr_cell at = mr_cell_of(&c->cells, c->now.p[v]);
	content *x = content_of(table, at);

	for (int k = 0; k < 3; k++) {
		float was = (float)(mr_coordinate(c->then.p[v], k) / c->cells.size);
		x->low[k] = x->used && x->low[k] < was ? x->low[k] : was;
		x->high[k] = x->used && x->high[k] > was ? x->high[k] : was;
		x->crowded |= x->high[k] - x->low[k] > far;
	}
	x->first = x->used ? x->first : v;
	x->crowded |= x->used && (came_by(c, x->first, v) || came_by(c, x->last, v));
	x->last = v;
	x->at = at;
	x->used = true;
}

static void
mark_gathered(mr_ctx *ctx, crowd *c)
{
	content *table = MR_NEW_ZERO(ctx, SLOTS, content);
	uint32_t stride = 1 + (uint32_t)(c->now.nv / SAMPLES);

	for (uint32_t v = 0; v < c->now.nv; v += stride)
		add_vertex(c, table, v);
	for (size_t i = 0; i < SLOTS; i++)
		if (table[i].crowded)
			mr_cells_mark(&c->cells, c->now.p[table[i].first]);
}

static size_t
less(size_t a, size_t b)
{
	return a > b ? a - b : 0;
}

/* A corner of the face that has most harm, of equal ones the lowest. */
static uint32_t
worst_vertex(const mr_mesh *m, const uint32_t *harm)
{
	size_t worst = 0;

	for (size_t f = 1; f < m->nf; f++)
		if (harm[f] > harm[worst])
			worst = f;
	return m->nf && harm[worst] ? m->t[worst].v[0] : MR_NONE;
}

/* Whether the faces at half-edges h and g of an edge are folded. */
static bool
folded(const mr_mesh *m, uint32_t h, uint32_t g)
{
	mr_v3 a = mr_face_cross(m, h / 3), b = mr_face_cross(m, g / 3);

	return mr_folds(mr_same_direction(m, h, g) ? mr_mul(-1, a) : a, b, MR_FOLD);
}

static void
count_folds(mr_ctx *ctx, const crowd *c, uint32_t *harm, size_t *folds)
{
	size_t came = 0, went = 0;
	mr_edges edges;

	mr_edges_build(ctx, &c->now, &edges);
	for (size_t e = 0; e < edges.count; e++) {
		const uint32_t *h = &edges.he[edges.start[e]];
		bool now = mr_edge_faces(&edges, e) == 2 && folded(&c->now, h[0], h[1]);
		bool then = mr_edge_faces(&edges, e) == 2 && folded(&c->then, h[0], h[1]);
		came += now && !then;
		went += then && !now;
		for (int i = 0; now && !then && i < 2; i++)
			harm[h[i] / 3]++;
	}
	*folds = less(came, went);
}

/* Intersections */

bool
mr_faces_stand(const mr_mesh *before, const mr_mesh *after, uint32_t f, uint32_t g)
{
	const double little = 1e-3; /* of their extent */
	mr_v3 p[6], q[6];
	double most;

	mr_corners(before, f, p);
	mr_corners(before, g, p + 3);
	mr_corners(after, f, q);
	mr_corners(after, g, q + 3);
	most = little * mr_box_diagonal(mr_box_of(p, 6));
	for (int i = 0; i < 6; i++)
		for (int k = 0; k < i; k++)
			if (!(fabs(mr_dist(q[i], q[k]) - mr_dist(p[i], p[k])) <= most))
				return false;
	return true;
}

/* How far the corners p reach beyond the plane of q, on the side where they reach less. */
static double
reach(const mr_v3 p[3], const mr_v3 q[3])
{
	mr_v3 n = mr_unit(mr_cross(mr_sub(q[1], q[0]), mr_sub(q[2], q[0])));
	double low = 0, high = 0;

	for (int i = 0; i < 3; i++) {
		double d = mr_dot(n, mr_sub(p[i], q[0]));
		low = fmin(low, d);
		high = fmax(high, d);
	}
	return fmin(-low, high);
}

typedef struct tally {
	const mr_mesh *then, *now;
	const uint32_t *part;           /* of each vertex, of what hangs together in the crowd */
	double deep;                    /* what passes by less rubs; of small faces a tenth */
	uint32_t *near_harm, *far_harm; /* of the faces; NULL: for no one */
	size_t near, far;
} tally;

static bool
goes_deep(const tally *s, uint32_t f, uint32_t g)
{
	const double share = 0.1;
	mr_v3 p[3], q[3];
	double size;

	mr_corners(s->now, f, p);
	mr_corners(s->now, g, q);
	size = fmin(mr_box_diagonal(mr_box_of(p, 3)), mr_box_diagonal(mr_box_of(q, 3)));
	return fmin(reach(p, q), reach(q, p)) > fmin(s->deep, share * size);
}

static void
count_pair(void *arg, uint32_t f, uint32_t g)
{
	tally *s = arg;
	bool near = s->part[s->now->t[f].v[0]] == s->part[s->now->t[g].v[0]];
	uint32_t *harm = near ? s->near_harm : s->far_harm;

	if (mr_faces_stand(s->then, s->now, f, g) || (!near && !goes_deep(s, f, g)))
		return;
	__atomic_fetch_add(near ? &s->near : &s->far, 1, __ATOMIC_RELAXED);
	if (harm) {
		__atomic_fetch_add(&harm[f], 1, __ATOMIC_RELAXED);
		__atomic_fetch_add(&harm[g], 1, __ATOMIC_RELAXED);
	}
}

/* More pairs than there were: where a surface intersects already, others go while some come. */
static void
count_pairs(mr_ctx *ctx, const crowd *c, double diagonal, uint32_t *near_harm, uint32_t *far_harm, mr_harm *h)
{
	const double deep = 0.001 * diagonal;
	uint32_t *part;
	bool several;
	tally came = { &c->then, &c->now, NULL, deep, near_harm, far_harm, 0, 0 }, went;

	mr_components_label(ctx, &c->now, &part, &several);
	came.part = part;
	mr_intersections_visit(ctx, NULL, &c->now, count_pair, &came);
	if (!came.near && !came.far)
		return;
	went = (tally){ &c->now, &c->then, part, deep, NULL, NULL, 0, 0 };
	mr_intersections_visit(ctx, NULL, &c->then, count_pair, &went);
	h->pairs = less(came.near, went.near);
	h->far = less(came.far, went.far);
}

static void
look_at_crowd(mr_ctx *ctx, crowd *c, double diagonal, mr_harm *harm)
{
	uint32_t *near_harm, *far_harm;
	mr_tri *t = NULL;

	if (c->now.nf > FEW) {
		c->now.nf = c->then.nf = mr_cells_faces(ctx, &c->cells, &c->now, &t);
		c->now.t = c->then.t = t;
	}
	near_harm = MR_NEW_ZERO(ctx, c->now.nf, uint32_t);
	far_harm = MR_NEW_ZERO(ctx, c->now.nf, uint32_t);
	count_folds(ctx, c, near_harm, &harm->folds);
	count_pairs(ctx, c, diagonal, near_harm, far_harm, harm);
	harm->vertex = worst_vertex(&c->now, near_harm);
	harm->far_vertex = worst_vertex(&c->now, far_harm);
}

/* Cells of some vertices each. */
static double
cell_size(const mr_motion *m)
{
	const double share = 0.02, vertices = 8;

	return m->diagonal * fmax(share, sqrt(vertices / (double)m->then->nv));
}

void
mr_harm_find(mr_ctx *ctx, const mr_motion *m, mr_harm *harm)
{
	mr_mark mark = mr_mark_take(ctx);
	crowd c = { .then = *m->then, .now = *m->then, .cells = mr_cells_new(ctx, cell_size(m)) };

	*harm = (mr_harm){ .vertex = MR_NONE, .far_vertex = MR_NONE };
	c.now.p = m->now;
	if (!(m->diagonal > 0))
		return;
	c.normal_then = mr_area_normals(ctx, &c.then);
	c.normal = mr_area_normals(ctx, &c.now);
	mark_turned(&c);
	mark_gathered(ctx, &c);
	if (c.cells.any || c.now.nf <= FEW)
		look_at_crowd(ctx, &c, m->diagonal, harm);
	mr_mark_release(ctx, mark);
}
