/* Folds and intersections that a motion makes, looked for in crowded cells of space. */
#include "judge/judge.h"

#include "mesh/edges.h"
#include "mesh/fold.h"
#include "space/contact.h"
#include "space/self_intersect.h"

enum { SAMPLES = 1 << 14, SLOTS = 2 * SAMPLES, FEW = 2048 };

/* ---- cells of space ---- */

enum { BITS = 1 << 17, ACROSS = 4 };

typedef struct cell {
	int at[3];
} cell;

/* Cells are marked in a set of bits by their hash: a chance mark costs a vain look. */
typedef struct cells {
	double scale; /* 1 over the side of a cell */
	uint32_t *bits;
	bool any;
} cells;

static cells
cells_new(mr_ctx *ctx, double size)
{
	return (cells){ 1 / size, MR_NEW_ZERO(ctx, BITS / 32, uint32_t), false };
}

static int
cell_along(double x)
{
	const double most = 1e9, off = 0.37; /* walls at 0 are in one cell */
	int at;

	x += off;
	at = (int)(x < -most ? -most : x < most ? x : most);
	return at - (at > x);
}

static cell
cell_of(const cells *c, mr_v3 p)
{
	return (
	    cell){ { cell_along(c->scale * p.x), cell_along(c->scale * p.y), cell_along(c->scale * p.z) } };
}

static uint32_t
hash_of(cell c)
{
	uint64_t h = 0;

	for (int k = 0; k < 3; k++)
		h = (h ^ (uint32_t)c.at[k]) * 0x9e3779b97f4a7c15u;
	return (uint32_t)(h >> 40);
}

static void
mark_cell(cells *c, mr_v3 p)
{
	uint32_t h = hash_of(cell_of(c, p)) % BITS;

	c->bits[h / 32] |= 1u << h % 32;
	c->any = true;
}

static bool
is_marked(const cells *c, cell at)
{
	uint32_t h = hash_of(at) % BITS;

	return c->bits[h / 32] >> h % 32 & 1;
}

/* Whether p is in a marked cell. */
static bool
holds(const cells *c, mr_v3 p)
{
	return c->any && is_marked(c, cell_of(c, p));
}

/* Whether a box meets a marked cell, or more than some cells. */
static bool
meets(const cells *c, mr_box box)
{
	cell low = cell_of(c, box.min), high = cell_of(c, box.max), at;

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

/* ---- crowded ones ---- */

typedef struct crowd {
	mr_mesh then, now;
	const mr_motion *m;
	cells turned, gathered;
	uint32_t *vertex; /* of then and now, of the crowd alone */
} crowd;

/* Faces that turn against their neighbours shorten the sum of unit normals. */
static bool
turns_against(const mr_ring *r)
{
	const float less = 0.15f; /* for each face */
	mr_float4 then2 = r->then * r->then, now2 = r->now * r->now;
	float faces = r->now[3], most = (1 - less) * faces, is2 = now2[0] + now2[1] + now2[2];

	return is2 < most * most && sqrtf(is2) < sqrtf(then2[0] + then2[1] + then2[2]) - less * faces;
}

/* Cells that hold what was far apart, or sheets that came by each other, by vertices at equal strides. */

typedef struct content {
	cell at;
	bool used, crowded;
	uint32_t first, last;  /* vertices */
	float low[3], high[3]; /* where it was, in cells */
} content;

static content *
content_of(content *table, cell at)
{
	size_t i = hash_of(at) % SLOTS;

	while (table[i].used && memcmp(&table[i].at, &at, sizeof at))
		i = (i + 1) % SLOTS;
	return &table[i];
}

static mr_v3
vector(mr_float4 x)
{
	return mr_vec((double)x[0], (double)x[1], (double)x[2]);
}

/* How far b is before the sheet that a is on, times the length of its normal. */
static double
before_sheet(const mr_mesh *m, mr_float4 normal, size_t a, size_t b)
{
	return mr_dot(vector(normal), mr_sub(m->p[b], m->p[a]));
}

/* Whether b has changed sides of a's sheet: b is on a sheet that faces the other way, or was clearly
 * apart. */
static bool
came_by(const crowd *c, size_t a, size_t b)
{
	const double clearly = 0.2;
	const mr_ring *ring = c->m->ring;
	double was = before_sheet(&c->then, ring[a].then, a, b);

	return was * before_sheet(&c->now, ring[a].now, a, b) < 0 &&
	       (mr_dot(vector(ring[a].now), vector(ring[b].now)) < 0 ||
		   fabs(was) > clearly * mr_norm(vector(ring[a].then)) * mr_dist(c->then.p[a], c->then.p[b]));
}

static void
add_vertex(const crowd *c, content *table, uint32_t v)
{
	const float far = 3; /* cells */
	cell at = cell_of(&c->gathered, c->now.p[v]);
	content *x = content_of(table, at);

	for (int k = 0; k < 3; k++) {
		float was = (float)(c->gathered.scale * mr_coordinate(c->then.p[v], k));
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
			mark_cell(&c->gathered, c->now.p[table[i].first]);
}

static size_t
less(size_t a, size_t b)
{
	return a > b ? a - b : 0;
}

/* A corner of the face that has most harm, of equal ones the lowest. */
static uint32_t
worst_vertex(const crowd *c, const uint32_t *harm)
{
	const mr_mesh *m = &c->now;
	size_t worst = 0;

	for (size_t f = 1; f < m->nf; f++)
		if (harm[f] > harm[worst])
			worst = f;
	return m->nf && harm[worst] ? c->vertex[m->t[worst].v[0]] : MR_NONE;
}

static void
count_folds(mr_ctx *ctx, const crowd *c, uint32_t *harm, size_t *folds)
{
	size_t came = 0, went = 0;
	mr_edges edges;

	mr_edges_build(ctx, &c->now, &edges);
	for (size_t e = 0; e < edges.count; e++) {
		const uint32_t *h = &edges.he[edges.start[e]];
		bool now = mr_edge_faces(&edges, e) == 2 && mr_is_fold(&c->now, h[0], h[1]);
		bool then = mr_edge_faces(&edges, e) == 2 && mr_is_fold(&c->then, h[0], h[1]);
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
count_pairs(
    mr_ctx *ctx, const crowd *c, uint32_t *near_harm, uint32_t *far_harm, uint32_t *before, mr_harm *h)
{
	const double deep = 0.001 * c->m->diagonal;
	uint32_t *part;
	bool several;
	tally came = { &c->then, &c->now, NULL, deep, near_harm, far_harm, 0, 0 }, went;

	mr_components_label(ctx, &c->now, &part, &several);
	came.part = part;
	mr_intersections_visit(ctx, NULL, &c->now, count_pair, &came);
	if (!came.near && !came.far)
		return;
	went = (tally){ &c->now, &c->then, part, deep, before, before, 0, 0 };
	mr_intersections_visit(ctx, NULL, &c->then, count_pair, &went);
	h->pairs = less(came.near, went.near);
	h->far = less(came.far, went.far);
}

static bool
meets_marked(const crowd *c, size_t f)
{
	mr_v3 p[3];
	mr_box box;

	mr_corners(&c->now, (uint32_t)f, p);
	box = mr_box_of(p, 3);
	return (c->turned.any && meets(&c->turned, box)) || (c->gathered.any && meets(&c->gathered, box));
}

/* The faces with a corner in a marked cell, and wide ones that meet one. */
static size_t
list_faces(mr_ctx *ctx, const crowd *c, mr_tri *t)
{
	bool *marked = MR_NEW(ctx, c->now.nv, bool);
	bool few = c->now.nf <= FEW;
	size_t n = 0, wide = 0;

	for (size_t v = 0; v < c->now.nv; v++)
		marked[v] = few || holds(&c->turned, c->now.p[v]) || holds(&c->gathered, c->now.p[v]);
	for (size_t f = 0; f < c->now.nf; f++) {
		const uint32_t *v = c->now.t[f].v;
		bool is_wide = wide < c->m->wides && c->m->wide[wide] == f;
		wide += is_wide;
		if (marked[v[0]] || marked[v[1]] || marked[v[2]] || (is_wide && meets_marked(c, f)))
			t[n++] = c->now.t[f];
	}
	return n;
}

/* The crowd becomes n faces t, and their corners, newly numbered; c->vertex: their old numbers. */
static void
keep_faces(mr_ctx *ctx, crowd *c, mr_tri *t, size_t n)
{
	uint32_t *number = MR_NEW(ctx, c->now.nv, uint32_t), nv = 0;
	mr_v3 *then = MR_NEW(ctx, 3 * n, mr_v3), *now = MR_NEW(ctx, 3 * n, mr_v3);

	c->vertex = MR_NEW(ctx, 3 * n, uint32_t);
	memset(number, 0xff, c->now.nv * sizeof *number);
	for (size_t i = 0; i < 3 * n; i++) {
		uint32_t *v = &t[i / 3].v[i % 3];
		if (number[*v] == MR_NONE) {
			then[nv] = c->then.p[*v];
			now[nv] = c->now.p[*v];
			c->vertex[nv] = *v;
			number[*v] = nv++;
		}
		*v = number[*v];
	}
	c->then = (mr_mesh){ .name = c->then.name, .nv = nv, .nf = n, .p = then, .t = t };
	c->now = c->then;
	c->now.p = now;
}

/* Marks the corners of faces with more harm than before (NULL: none). */
static void
mark(const crowd *c, const uint32_t *harm, const uint32_t *before, uint8_t how, uint8_t *marks)
{
	for (size_t i = 0; marks && i < 3 * c->now.nf; i++)
		if (harm[i / 3] > (before ? before[i / 3] : 0))
			marks[c->vertex[c->now.t[i / 3].v[i % 3]]] |= how;
}

static void
look_at_crowd(mr_ctx *ctx, crowd *c, uint8_t *marks, mr_harm *harm)
{
	mr_tri *t = MR_NEW(ctx, c->now.nf, mr_tri);
	uint32_t *near_harm, *far_harm, *before;

	keep_faces(ctx, c, t, list_faces(ctx, c, t));
	near_harm = MR_NEW_ZERO(ctx, c->now.nf, uint32_t);
	far_harm = MR_NEW_ZERO(ctx, c->now.nf, uint32_t);
	before = MR_NEW_ZERO(ctx, c->now.nf, uint32_t);
	count_folds(ctx, c, near_harm, &harm->folds);
	mark(c, near_harm, NULL, MR_HARM_FOLD, marks);
	count_pairs(ctx, c, near_harm, far_harm, before, harm);
	mark(c, near_harm, before, MR_HARM_NEAR, marks);
	mark(c, far_harm, before, MR_HARM_FAR, marks);
	harm->vertex = worst_vertex(c, near_harm);
	harm->far_vertex = worst_vertex(c, far_harm);
}

void
mr_harm_find(mr_ctx *ctx, const mr_motion *m, uint8_t *marks, mr_harm *harm)
{
	const double share = 0.02;
	MR_SCOPE(ctx);
	crowd c = { .then = *m->then,
		.now = *m->then,
		.m = m,
		.turned = cells_new(ctx, m->cell),
		.gathered = cells_new(ctx, fmax(m->cell, share * m->diagonal)) };

	*harm = (mr_harm){ .vertex = MR_NONE, .far_vertex = MR_NONE };
	c.now.p = m->now;
	if (!(m->diagonal > 0))
		return;
	for (size_t v = 0; v < c.now.nv; v++)
		if (turns_against(&m->ring[v]))
			mark_cell(&c.turned, c.now.p[v]);
	mark_gathered(ctx, &c);
	if (c.turned.any || c.gathered.any || c.now.nf <= FEW)
		look_at_crowd(ctx, &c, marks, harm);
}
