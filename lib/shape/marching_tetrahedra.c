/*
 * The surface where a function is zero, by marching tetrahedra (Doi, Koide 1991) over
 * cubes that are each cut into six around a diagonal (Kuhn): always a closed manifold.
 */
#include "shape/parts.h"

#include "base/parallel.h"

typedef struct lattice {
	mr_field field;
	void *arg;
	mr_v3 origin;
	double step;
	size_t n[3]; /* points along each axis */
	double *f;   /* at the points, x fastest */
} lattice;

/* A point of the lattice. */
typedef struct site {
	size_t x[3], index;
} site;

static size_t
index_of(const lattice *l, const size_t x[3])
{
	return (x[2] * l->n[1] + x[1]) * l->n[0] + x[0];
}

static mr_v3
place_of(const lattice *l, const size_t x[3])
{
	return mr_axpy(l->step, mr_vec((double)x[0], (double)x[1], (double)x[2]), l->origin);
}

static void
fill_layers(void *arg, size_t begin, size_t end)
{
	const lattice *l = arg;

	for (size_t z = begin; z < end; z++)
		for (size_t y = 0; y < l->n[1]; y++)
			for (size_t x = 0; x < l->n[0]; x++) {
				size_t at[3] = { x, y, z };
				l->f[index_of(l, at)] = l->field(l->arg, place_of(l, at));
			}
}

/* What marching makes: with a build that is NULL it only counts faces. */
typedef struct march {
	const lattice *l;
	mr_solid_build *b;
	mr_solid_weld w;
	size_t faces;
} march;

/* The vertex on the edge between two sites; the edge is known by its lower end and its direction, one of
 * seven. */
static uint32_t
edge_vertex(march *m, const site *p, const site *q)
{
	const lattice *l = m->l;
	const site *low = p->index < q->index ? p : q, *high = low == p ? q : p;
	uint64_t way = (high->x[0] - low->x[0]) | (high->x[1] - low->x[1]) << 1 |
	               (high->x[2] - low->x[2]) << 2;
	double a = l->f[low->index], b = l->f[high->index];
	bool is_new;
	uint32_t *slot = mr_weld_slot(&m->w, (uint64_t)low->index << 3 | way, &is_new);

	if (is_new)
		*slot = mr_solid_add_vertex(
		    m->b, mr_lerp(a / (a - b), place_of(l, low->x), place_of(l, high->x)));
	return *slot;
}

/* Twice the middle of an edge, in steps. */
static mr_v3
middle(const site *p, const site *q)
{
	return mr_vec((double)(p->x[0] + q->x[0]), (double)(p->x[1] + q->x[1]), (double)(p->x[2] + q->x[2]));
}

/* A face whose corners lie between in[i] and out[i], its outside towards the latter: whole numbers decide. */
static void
add_face(march *m, const site *const in[3], const site *const out[3])
{
	mr_v3 a = middle(in[0], out[0]), b = middle(in[1], out[1]), c = middle(in[2], out[2]),
	      away = mr_vec(0, 0, 0);
	uint32_t v[3];

	m->faces++;
	if (!m->b)
		return;
	for (int i = 0; i < 3; i++) {
		v[i] = edge_vertex(m, in[i], out[i]);
		away = mr_add(away, mr_sub(middle(out[i], out[i]), middle(in[i], in[i])));
	}
	if (mr_dot(mr_cross(mr_sub(b, a), mr_sub(c, a)), away) > 0)
		mr_solid_add_face(m->b, v[0], v[1], v[2]);
	else
		mr_solid_add_face(m->b, v[0], v[2], v[1]);
}

static void
march_tetrahedron(march *m, const site s[4])
{
	const site *in[4], *out[4];
	int ins = 0, outs = 0;

	for (int i = 0; i < 4; i++)
		if (m->l->f[s[i].index] < 0)
			in[ins++] = &s[i];
		else
			out[outs++] = &s[i];
	if (ins == 1) {
		add_face(
		    m, (const site *[]){ in[0], in[0], in[0] }, (const site *[]){ out[0], out[1], out[2] });
	} else if (ins == 3) {
		add_face(
		    m, (const site *[]){ in[0], in[1], in[2] }, (const site *[]){ out[0], out[0], out[0] });
	} else if (ins == 2) {
		add_face(
		    m, (const site *[]){ in[0], in[0], in[1] }, (const site *[]){ out[0], out[1], out[1] });
		add_face(
		    m, (const site *[]){ in[0], in[1], in[1] }, (const site *[]){ out[0], out[1], out[0] });
	}
}

/* The six tetrahedra lead from the cube's lowest corner to its highest, by the axes in any order. */
static void
march_cube(march *m, const size_t x[3])
{
	static const int order[6][3] = { { 0, 1, 2 }, { 0, 2, 1 }, { 1, 0, 2 }, { 1, 2, 0 }, { 2, 0, 1 },
		{ 2, 1, 0 } };

	for (int k = 0; k < 6; k++) {
		site s[4] = { { { x[0], x[1], x[2] }, 0 } };
		for (int i = 0; i < 4; i++) {
			if (i > 0) {
				s[i] = s[i - 1];
				s[i].x[order[k][i - 1]]++;
			}
			s[i].index = index_of(m->l, s[i].x);
		}
		march_tetrahedron(m, s);
	}
}

static void
march_all(march *m)
{
	const lattice *l = m->l;

	m->faces = 0;
	for (size_t z = 0; z + 1 < l->n[2]; z++)
		for (size_t y = 0; y + 1 < l->n[1]; y++)
			for (size_t x = 0; x + 1 < l->n[0]; x++)
				march_cube(m, (size_t[3]){ x, y, z });
}

mr_status
mr_march(mr_ctx *ctx, mr_field field, void *arg, mr_box box, double step, mr_solid_build *b)
{
	lattice l = { .field = field, .arg = arg, .origin = box.min, .step = step };
	mr_v3 size = mr_sub(box.max, box.min);
	march m = { .l = &l };
	mr_mark mark;

	l.n[0] = (size_t)ceil(size.x / step) + 1;
	l.n[1] = (size_t)ceil(size.y / step) + 1;
	l.n[2] = (size_t)ceil(size.z / step) + 1;
	l.f = MR_NEW(ctx, l.n[0] * l.n[1] * l.n[2], double);
	mr_parallel(ctx, l.n[2], 1, fill_layers, &l);
	march_all(&m);
	MR_TRY(mr_solid_begin(ctx, m.faces, m.faces, b)); /* vertices are fewer: about half as many */
	mark = mr_mark_take(ctx);
	mr_weld_begin(ctx, m.faces, &m.w);
	m.b = b;
	march_all(&m);
	mr_mark_release(ctx, mark);
	return MR_OK;
}
