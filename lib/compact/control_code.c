/* Triangles grow over the edges of a control mesh; writing and reading are the same walk. */
#include "compact/control_code.h"

/* Models of the choices.  NEAR: classes of distance from the predicted vertex. */
enum { NEAR = 4, DEGREES = 16 };
#define RIM (MR_NONE - 1)

typedef struct choices {
	mr_odds rim[2], fresh[NEAR][DEGREES], side[2][NEAR], crease[3][3];
	mr_number_odds axis[2][3];
} choices;

/* The mesh so far, and its source. */
typedef struct growing {
	mr_ctx *ctx;
	mr_coder *c;
	mr_grid_mesh m;         /* in the order of the file */
	size_t nv, nf;          /* of it, so far */
	uint32_t *twin;         /* MR_NONE: open; RIM: of the boundary */
	uint32_t *first, *more; /* the half-edges that leave a vertex: a list */
	uint8_t *degree;        /* faces of a vertex */
	choices *odds;
	bool rim; /* the last edge coded is on the boundary */
	bool bad; /* the file is damaged */
	/* writing alone */
	const mr_grid_mesh *from;
	const mr_topology *topo;
	uint32_t *old_vertex, *new_vertex, *old_half;
} growing;

static uint32_t
from(const growing *g, uint32_t h)
{
	return g->m.t[h / 3].v[h % 3];
}

/* The open half-edge from a to b; MR_NONE: there is none. */
static uint32_t
open_edge(const growing *g, uint32_t a, uint32_t b)
{
	uint32_t h = g->first[a];

	while (h != MR_NONE && !(g->twin[h] == MR_NONE && from(g, mr_he_next(h)) == b))
		h = g->more[h];
	return h;
}

static void
join(growing *g, uint32_t h, uint32_t other)
{
	g->twin[h] = other;
	if (other != MR_NONE)
		g->twin[other] = h;
}

/* Adds a face.  Its first edge joins half-edge `at`, unless that is MR_NONE; the others join matching open
 * edges. half: its first half-edge in the input mesh. */
static void
add_face(growing *g, mr_tri t, uint32_t at, uint32_t half)
{
	uint32_t h = (uint32_t)(3 * g->nf);

	g->m.t[g->nf] = t;
	for (uint32_t i = 0, k = half; g->from && i < 3; i++, k = mr_he_next(k))
		g->old_half[h + i] = k;
	g->nf++;
	join(g, h, at);
	for (uint32_t i = 1; i < 3; i++)
		join(g, h + i, open_edge(g, t.v[(i + 1) % 3], t.v[i]));
	for (uint32_t i = 0; i < 3; i++) {
		g->more[h + i] = g->first[t.v[i]];
		g->first[t.v[i]] = h + i;
		g->degree[t.v[i]] = (uint8_t)(g->degree[t.v[i]] + (g->degree[t.v[i]] < UINT8_MAX));
	}
}

/* Adds a vertex, predicted at p; old: its index in the input mesh. */
static uint32_t
add_vertex(growing *g, uint32_t old, mr_grid_point p, bool first)
{
	uint32_t v = (uint32_t)g->nv;
	mr_number_odds *odds = g->odds->axis[first];

	g->bad |= g->nv == g->m.nv || g->c->ended;
	if (g->bad)
		return 0;
	for (int i = 0; i < 3; i++) {
		int64_t x = mr_code_number(g->c, &odds[i], g->from ? g->from->p[old].x[i] - p.x[i] : 0);
		x += p.x[i];
		g->bad |= x > MR_GRID_MOST || x < -MR_GRID_MOST;
		g->m.p[v].x[i] = g->bad ? 0 : (int32_t)x;
	}
	if (g->from) {
		g->old_vertex[v] = old;
		g->new_vertex[old] = v;
	}
	g->nv++;
	return v;
}

/* The class of the distance from p to q, relative to the edge ab: 0 is near, NEAR - 1 is far. */
static int
nearness(mr_grid_point p, mr_grid_point q, mr_grid_point a, mr_grid_point b)
{
	int64_t away = 0, edge = 0;
	int n = 0;

	for (int i = 0; i < 3; i++) {
		int64_t d = (int64_t)p.x[i] - q.x[i], e = (int64_t)a.x[i] - b.x[i];
		away += d * d;
		edge += e * e;
	}
	while (n < NEAR - 1 && 4 * away > edge) {
		away /= 4;
		n++;
	}
	return n;
}

/* An open half-edge h from u to v, where the next face grows; o is the third corner of its own face. */
typedef struct gate {
	uint32_t h, u, v, o;
	mr_grid_point expected;
} gate;

/* Lists up to `room` vertices that share an open edge with u (side 0) or v (side 1). */
static size_t
neighbours(const growing *g, const gate *at, int side, uint32_t *w, size_t room)
{
	size_t n = 0;

	for (uint32_t h = g->first[side ? at->v : at->u]; h != MR_NONE && n < room; h = g->more[h]) {
		uint32_t e = side ? h : mr_he_prev(h), to = from(g, side ? mr_he_next(e) : e);
		if (g->twin[e] == MR_NONE && to != at->u && to != at->v && to != at->o)
			w[n++] = to;
	}
	return n;
}

/* Codes which existing vertex is the apex: `wanted`, when writing. */
static uint32_t
code_known(growing *g, const gate *at, uint32_t w[2][NEAR], const size_t n[2], uint32_t wanted)
{
	const mr_grid_point *p = g->m.p;
	unsigned bits = 0;

	for (int side = 0; side < 2; side++)
		for (size_t i = 0; i < n[side]; i++) {
			int near = nearness(p[w[side][i]], at->expected, p[at->u], p[at->v]);
			if (mr_code_bit(g->c, &g->odds->side[side][near], w[side][i] == wanted))
				return w[side][i];
		}
	while (g->nv > (size_t)1 << bits)
		bits++;
	return mr_code_plain(g->c, bits, wanted);
}

/* Codes the apex of the face at the gate; old: its index in the input mesh. */
static uint32_t
code_apex(growing *g, const gate *at, uint32_t old)
{
	const mr_grid_point *p = g->m.p;
	uint32_t w[2][NEAR], wanted = g->from ? g->new_vertex[old] : 0;
	size_t n[2] = { neighbours(g, at, 0, w[0], NEAR), neighbours(g, at, 1, w[1], NEAR) };
	int near = NEAR - 1, degree = (g->degree[at->u] + g->degree[at->v]);

	for (int side = 0; side < 2; side++)
		for (size_t i = 0; i < n[side]; i++) {
			int d = nearness(p[w[side][i]], at->expected, p[at->u], p[at->v]);
			near = d < near ? d : near;
		}
	degree = degree < DEGREES ? degree : DEGREES - 1;
	if (mr_code_bit(g->c, &g->odds->fresh[near][degree], wanted == MR_NONE))
		return add_vertex(g, old, at->expected, false);
	return code_known(g, at, w, n, wanted);
}

/* Codes whether half-edge h is on the boundary, else the face across it. */
static void
grow_at(growing *g, uint32_t h)
{
	gate at = { h, from(g, h), from(g, mr_he_next(h)), from(g, mr_he_prev(h)), { { 0 } } };
	uint32_t half = g->from ? g->topo->twin[g->old_half[h]] : 0, w;

	g->rim = mr_code_bit(g->c, &g->odds->rim[g->rim], half == MR_NONE);
	if (g->rim) {
		g->twin[h] = RIM;
		return;
	}
	for (int i = 0; i < 3; i++)
		at.expected.x[i] = g->m.p[at.u].x[i] + g->m.p[at.v].x[i] - g->m.p[at.o].x[i];
	w = code_apex(g, &at, g->from ? g->from->t[half / 3].v[(half + 2) % 3] : 0);
	g->bad |= w >= g->nv || w == at.u || w == at.v;
	if (!g->bad)
		add_face(g, (mr_tri){ { at.v, at.u, w } }, h, half);
}

/* Adds the first face of a component; old: its index in the input mesh. */
static void
plant(growing *g, size_t old)
{
	mr_grid_point at = g->nv ? g->m.p[g->nv - 1] : (mr_grid_point){ { 0 } };
	mr_tri t;

	for (int i = 0; i < 3; i++) {
		t.v[i] = add_vertex(g, g->from ? g->from->t[old].v[i] : 0, at, i == 0);
		if (g->bad)
			return;
		at = g->m.p[t.v[i]];
	}
	add_face(g, t, MR_NONE, (uint32_t)(3 * old));
}

/* The next face of the input mesh that is not coded yet. */
static size_t
next_face(const growing *g, size_t f)
{
	while (g->from && g->new_vertex[g->from->t[f].v[0]] != MR_NONE)
		f++;
	return f;
}

static void
code_faces(growing *g)
{
	size_t f = 0;

	for (uint32_t h = 0; g->nf < g->m.nf && !g->bad; h++) {
		if (h == 3 * g->nf) {
			f = next_face(g, f);
			plant(g, f);
		}
		if (!g->bad && g->twin[h] == MR_NONE && g->nf < g->m.nf)
			grow_at(g, h);
	}
}

/* Codes the isolated vertices. */
static void
code_isolated(growing *g)
{
	uint32_t old = 0;

	while (g->nv < g->m.nv && !g->bad) {
		while (g->from && g->new_vertex[old] != MR_NONE)
			old++;
		add_vertex(g, old, g->nv ? g->m.p[g->nv - 1] : (mr_grid_point){ { 0 } }, true);
	}
}

static void
code_creases(growing *g)
{
	uint8_t *at = MR_NEW_ZERO(g->ctx, g->m.nv, uint8_t); /* creases that end there, up to 2 */

	for (uint32_t h = 0; h < 3 * g->m.nf; h++) {
		uint32_t twin = g->twin[h], a = from(g, h), b = from(g, mr_he_next(h));
		if (twin >= RIM || twin < h)
			continue;
		bool is = mr_code_bit(g->c, &g->odds->crease[at[a]][at[b]],
		    g->from &&
			(g->from->crease[g->old_half[h]] || g->from->crease[g->topo->twin[g->old_half[h]]]));
		g->m.crease[h] = g->m.crease[twin] = is;
		at[a] = (uint8_t)(at[a] + (is && at[a] < 2));
		at[b] = (uint8_t)(at[b] + (is && at[b] < 2));
	}
}

static void
begin(mr_ctx *ctx, mr_coder *c, const mr_grid_mesh *m, growing *g)
{
	*g = (growing){ .ctx = ctx, .c = c, .m = *m };
	g->m.p = MR_NEW(ctx, m->nv, mr_grid_point);
	g->m.t = MR_NEW(ctx, m->nf, mr_tri);
	g->m.crease = m->crease ? MR_NEW_ZERO(ctx, 3 * m->nf, uint8_t) : NULL;
	g->twin = MR_NEW(ctx, 3 * m->nf, uint32_t);
	g->more = MR_NEW(ctx, 3 * m->nf, uint32_t);
	g->first = MR_NEW(ctx, m->nv, uint32_t);
	memset(g->first, 0xff, m->nv * sizeof *g->first);
	g->degree = MR_NEW_ZERO(ctx, m->nv, uint8_t);
	g->odds = MR_NEW_ZERO(ctx, 1, choices);
}

static void
code_all(growing *g)
{
	code_faces(g);
	code_isolated(g);
	if (g->m.crease && !g->bad)
		code_creases(g);
}

void
mr_control_write(
    mr_ctx *ctx, mr_coder *c, const mr_grid_mesh *m, const mr_topology *topo, mr_control_order *order)
{
	growing g;

	begin(ctx, c, m, &g);
	g.from = m;
	g.topo = topo;
	g.old_vertex = MR_NEW(ctx, m->nv, uint32_t);
	g.new_vertex = MR_NEW(ctx, m->nv, uint32_t);
	memset(g.new_vertex, 0xff, m->nv * sizeof *g.new_vertex);
	g.old_half = MR_NEW(ctx, 3 * m->nf, uint32_t);
	code_all(&g);
	*order = (mr_control_order){ g.m, g.old_vertex, g.old_half };
}

mr_status
mr_control_read(mr_ctx *ctx, mr_coder *c, mr_grid_mesh *m)
{
	growing g;

	begin(ctx, c, m, &g);
	code_all(&g);
	if (g.bad || c->ended)
		return mr_fail(ctx, MR_EFORMAT, "the control mesh is damaged");
	*m = g.m;
	return MR_OK;
}
