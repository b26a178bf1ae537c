/* mr-fill: a surface with its boundary loops filled, and its columns on the patches. */
#include "edit/fill.h"

#include "base/options.h"
#include "edit/deform.h"
#include "mesh/layers.h"
#include "mesh/loops.h"
#include "mesh/mend.h"
#include "space/carry.h"

typedef struct filled {
	mr_ctx *ctx;
	const mr_mesh *m; /* as it was */
	mr_patches s;
	uint32_t *near;      /* of each vertex of the patches the rim's that is nearest along edges */
	mr_v3 *normal;       /* of each vertex of all */
	mr_deform *membrane; /* of the patches; NULL: no vertex is new */
	double *x;           /* a value at each vertex of the patches, and whether a loop has none */
	bool *none;
} filled;

static void
find_nearest(filled *w)
{
	uint32_t *queue = MR_NEW(w->ctx, w->s.m.nv, uint32_t);
	mr_adjacency joins;
	size_t n = w->s.rim;

	w->near = MR_NEW(w->ctx, w->s.m.nv, uint32_t);
	mr_adjacency_build(w->ctx, &w->s.m, &joins);
	memset(w->near, 0xff, w->s.m.nv * sizeof *w->near);
	for (uint32_t v = 0; v < n; v++)
		w->near[v] = queue[v] = v;
	for (size_t i = 0; i < n; i++)
		for (size_t k = joins.start[queue[i]]; k < joins.start[queue[i] + 1]; k++)
			if (w->near[joins.adj[k]] == MR_NONE) {
				w->near[joins.adj[k]] = w->near[queue[i]];
				queue[n++] = joins.adj[k];
			}
}

static mr_status
set_up(filled *w)
{
	uint32_t *region = MR_NEW_ZERO(w->ctx, w->s.m.nv, uint32_t);
	mr_deform_opts o = MR_DEFORM_DEFAULTS;

	find_nearest(w);
	w->normal = MR_NEW(w->ctx, w->s.all.nv, mr_v3);
	mr_vertex_normals(&w->s.all, w->normal);
	w->none = MR_NEW(w->ctx, w->s.rim + 1, bool);
	o.order = 1;
	o.apart = true;
	for (size_t v = w->s.rim; v < w->s.m.nv; v++)
		region[v] = MR_REGION_FREE;
	return w->s.m.nv > w->s.rim ? mr_deform_new(w->ctx, &w->s.m, NULL, region, &o, &w->membrane) : MR_OK;
}

static double
value_at(const mr_carried *c, size_t i)
{
	return c->shape.type == 'd' ? ((const double *)c->from)[i] : ((const uint8_t *)c->from)[i];
}

/* The values of the rims go on as harmonic functions, `wide` of them; not where they are not finite. */
static mr_status
extend(filled *w, size_t wide)
{
	mr_v3 *from = MR_NEW_ZERO(w->ctx, w->s.m.nv, mr_v3), *to = MR_NEW(w->ctx, w->s.m.nv, mr_v3);

	for (size_t i = 0; i < w->s.rim * wide; i++)
		if (!isfinite(w->x[i])) {
			w->none[w->s.loop[i / wide]] = true;
			w->x[i] = 0;
		}
	for (size_t first = 0; w->membrane && first < wide; first += 3) {
		size_t n = wide - first < 3 ? wide - first : 3;
		for (size_t v = 0; v < w->s.rim; v++)
			memcpy(&from[v], w->x + v * wide + first, n * sizeof *w->x);
		MR_TRY(mr_deform_solve(w->ctx, w->membrane, from, NULL, to));
		for (size_t v = w->s.rim; v < w->s.m.nv; v++)
			memcpy(w->x + v * wide + first, &to[v], n * sizeof *w->x);
	}
	return MR_OK;
}

static void
begin(filled *w, size_t wide)
{
	w->x = MR_NEW(w->ctx, w->s.m.nv * wide, double);
	memset(w->none, 0, (w->s.rim + 1) * sizeof *w->none);
}

/* Means of vertices; a loop without them takes the nearest old vertices'. */
static mr_status
make_means(filled *w, const mr_carried *c)
{
	size_t wide = c->shape.components;

	begin(w, wide);
	for (size_t i = 0; i < w->s.rim * wide; i++)
		w->x[i] = value_at(c, mr_he_from(w->m, w->s.he[i / wide]) * wide + i % wide);
	MR_TRY(extend(w, wide));
	for (size_t i = w->s.rim * wide; i < w->s.m.nv * wide; i++) {
		size_t at = i + (w->m->nv - w->s.rim) * wide;
		if (w->none[w->s.loop[i / wide]])
			continue;
		if (c->shape.type == 'd')
			((double *)c->to)[at] = w->x[i];
		else
			((uint8_t *)c->to)[at] = (uint8_t)(fmin(fmax(w->x[i], 0), 255) + 0.5);
	}
	return MR_OK;
}

/* Values of corners go on where all along a loop the faces at a vertex have the same. */
static mr_status
make_corners(filled *w, const mr_carried *c)
{
	size_t wide = c->shape.components / 3, first = w->m->nf * c->shape.components;
	double *to = (double *)c->to + first;
	const double *from = c->from;

	begin(w, wide);
	for (size_t i = 0, begun = 0; i < w->s.rim; i++) {
		bool last = i + 1 == w->s.rim || w->s.loop[i + 1] != w->s.loop[i] ||
		            mr_he_from(w->m, w->s.he[i + 1]) != mr_he_to(w->m, w->s.he[i]);
		const double *end = from + mr_he_next(w->s.he[i]) * wide;
		const double *start = from + w->s.he[last ? begun : i + 1] * wide;
		memcpy(w->x + i * wide, from + w->s.he[i] * wide, wide * sizeof *end);
		w->none[w->s.loop[i]] |= memcmp(start, end, wide * sizeof *end) != 0;
		begun = last ? i + 1 : begun;
	}
	MR_TRY(extend(w, wide));
	for (size_t i = 0; i < 3 * w->s.m.nf; i++) {
		uint32_t v = w->s.m.t[i / 3].v[i % 3];
		for (size_t k = 0; k < wide; k++)
			to[i * wide + k] = w->none[w->s.loop[v]] ? NAN : w->x[v * wide + k];
	}
	return MR_OK;
}

static void
make_polygons(const filled *w, const mr_carried *c)
{
	const uint32_t *from = c->from;
	uint32_t *to = c->to, most = 0;

	for (size_t f = 0; f < w->m->nf; f++)
		most = from[f] > most ? from[f] : most;
	for (size_t f = w->m->nf; f < w->s.all.nf; f++)
		to[f] = ++most;
}

/* The nearest old row, of vertices or of faces. */
static void
make_nearest(const filled *w, const mr_carried *c, bool of_vertices)
{
	mr_rows_from rows = { .n = of_vertices ? w->s.m.nv - w->s.rim : w->s.m.nf, .width = 1 };
	uint32_t *parent = MR_NEW(w->ctx, rows.n, uint32_t);
	mr_carried label = *c;

	for (size_t i = 0; i < rows.n; i++) {
		uint32_t h = w->s.he[w->near[of_vertices ? i + w->s.rim : w->s.m.t[i].v[0]]];
		parent[i] = of_vertices ? mr_he_from(w->m, h) : h / 3;
	}
	label.kind = MR_LABEL;
	rows.parent = parent;
	mr_carried_make(w->ctx, &label, 1, of_vertices ? w->m->nv : w->m->nf, rows);
}

static mr_status
make(void *arg, mr_ctx *ctx, mr_carried *c)
{
	filled *w = arg;
	bool of_vertices = c->shape.element == 'v';
	size_t before = of_vertices ? w->m->nv : w->m->nf;

	(void)ctx;
	memcpy(c->to, c->from, before * c->shape.components * mr_type_size(c->shape.type));
	make_nearest(w, c, of_vertices);
	if (!strcmp(c->name, "polygon"))
		make_polygons(w, c);
	else if (!strcmp(c->name, "corner_normal"))
		for (size_t i = 3 * w->m->nf; i < 3 * w->s.all.nf; i++)
			((mr_v3 *)c->to)[i] = w->normal[w->s.all.t[i / 3].v[i % 3]];
	else if (!strcmp(c->name, "corner_texcoord"))
		return make_corners(w, c);
	else if (c->kind == MR_DIRECTION)
		memcpy((mr_v3 *)c->to + before, w->normal + before, (w->s.all.nv - before) * sizeof(mr_v3));
	else if (of_vertices && c->kind == MR_MEAN)
		return make_means(w, c);
	return MR_OK;
}

/* The columns that go along, and the filled surface. */
static mr_status
put(filled *w, mr_frame *f, const char *layer)
{
	mr_descent d = { w->m->nv, w->m->nf, w->s.all.nv, w->s.all.nf, NULL, make, w };
	mr_carried *carried;
	size_t n;

	MR_TRY(mr_columns_descend(w->ctx, f, layer, &d, &carried, &n));
	MR_TRY(mr_layer_put_mesh(w->ctx, f, layer, &w->s.all));
	return mr_carried_put(w->ctx, f, layer, carried, n);
}

/* Along open seams; and a loop that passes a place by two vertices becomes several, each of which can be
 * spanned. */
static mr_status
join_vertices(mr_ctx *ctx, mr_frame *f, const mr_fill_opts *o, mr_mesh *m)
{
	bool *touching;
	size_t joined;

	if (!strcmp(m->name, "mesh"))
		MR_TRY(mr_layer_join_seams(ctx, f, m));
	MR_TRY(mr_fill_touching(ctx, m, o, &touching));
	if (!touching)
		return MR_OK;
	MR_TRY(mr_layer_weld(ctx, f, m->name, 0, touching, &joined));
	return mr_layer_mesh(ctx, f, m->name, m);
}

static mr_status
fill(mr_ctx *ctx, mr_frame *f, const mr_fill_opts *o, mr_fill_result *r)
{
	static const char *const reads[] = { "mesh", "base", NULL };
	const char *layer;
	mr_mesh m;
	filled w = { .ctx = ctx, .m = &m };
	mr_loops loops;

	MR_TRY(mr_check_number(ctx, "max_length", o->max_length, 0, 1e300));
	MR_TRY(mr_check_number(ctx, "order", (double)o->order, 1, 3));
	MR_TRY(mr_layer_choose_warned(ctx, f, o->layer, reads, &layer));
	MR_TRY(mr_layer_mesh(ctx, f, layer, &m));
	mr_loops_find(ctx, &m, &loops);
	*r = (mr_fill_result){ 0 };
	if (loops.count + loops.broken == 0)
		return mr_layer_worked(ctx, f, layer);
	MR_TRY(join_vertices(ctx, f, o, &m));
	MR_TRY(mr_prefix(ctx, mr_fill(ctx, &m, o, &w.s, r), "%s", layer));
	if (r->filled == 0)
		return mr_layer_worked(ctx, f, layer);
	MR_TRY(set_up(&w));
	return put(&w, f, layer);
}

mr_status
mr_fill_frame(mr_ctx *ctx, mr_frame *f, const mr_fill_opts *opts, mr_fill_result *result)
{
	static const mr_fill_opts defaults = MR_FILL_DEFAULTS;
	mr_fill_result r;

	MR_ON_COPY(ctx, f, done, result, r, fill(ctx, &done, opts ? opts : &defaults, &r));
}
