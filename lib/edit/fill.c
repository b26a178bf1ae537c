/* Liepa 2003: Filling holes in meshes: triangles of least bend and area, refined to the edges around; faired
 * as in Botsch, Kobbelt 2004, section 4, with the surface as constraint. */
#include "edit/fill.h"

#include "edit/deform.h"
#include "edit/deform_system.h"
#include "edit/islands.h"
#include "mesh/repair.h"
#include "op/laplace.h"
#include "remesh/relax.h"
#include "space/contact.h"
#include "space/self_intersect.h"

/* Longer loops, their teeth aside, are rims of an open surface: the share of its area that a circle of that
 * length has. */
static const double OPEN = 0.3;

/* A loop that is filled. */
typedef struct hole {
	double length;
	uint32_t loop;
} hole;

typedef struct filler {
	mr_ctx *ctx;
	const mr_mesh *m;
	const mr_fill_opts *o;
	const mr_bvh *surface;
	mr_loops loops;
	hole *hole; /* n, the shortest first */
	size_t n;
	uint32_t *next;     /* of each loop the next of its hole, first the rim, then those of islands */
	mr_patch around;    /* the surface near the rims */
	uint32_t *at;       /* of each vertex of the rims, where it is in that */
	mr_adjacency joins; /* of that */
	mr_dyn d;           /* the patches */
	size_t rim;
	uint32_t *he, *loop; /* as in mr_patches */
	double *edge;        /* of each vertex the length of edges there */
	size_t loop_room, edge_room;
} filler;

/* ---- which loops ---- */

static int
by_length(const void *a, const void *b)
{
	const hole *x = a, *y = b;

	return x->length != y->length ? (x->length > y->length) - (x->length < y->length)
	                              : (x->loop > y->loop) - (x->loop < y->loop);
}

/* The area of its component, by each vertex that stands for one. */
static double *
find_areas(filler *w, const uint32_t *component)
{
	double *area = MR_NEW_ZERO(w->ctx, w->m->nv, double);

	for (size_t f = 0; f < w->m->nf; f++)
		area[component[w->m->t[f].v[0]]] += mr_norm(mr_face_cross(w->m, f)) / 2;
	return area;
}

static double
length_of(const filler *w, uint32_t loop)
{
	const mr_mesh *m = w->m;
	double l = 0;

	for (size_t k = w->loops.start[loop]; k < w->loops.start[loop + 1]; k++)
		l += mr_dist(m->p[mr_he_from(m, w->loops.he[k])], m->p[mr_he_to(m, w->loops.he[k])]);
	return l;
}

/* The length without the teeth of triangles: of its edges' middles, taken again and again, as of a circle. */
static double
smooth_length(const filler *w, uint32_t loop)
{
	enum { ROUNDS = 8 };
	size_t first = w->loops.start[loop], n = w->loops.start[loop + 1] - first;
	MR_SCOPE(w->ctx);
	mr_v3 *p = MR_NEW(w->ctx, n + 1, mr_v3);
	double l = 0;

	for (size_t k = 0; k < n; k++)
		p[k] = w->m->p[mr_he_from(w->m, w->loops.he[first + k])];
	for (int i = 0; i < ROUNDS; i++) {
		p[n] = p[0];
		for (size_t k = 0; k < n; k++)
			p[k] = mr_lerp(0.5, p[k], p[k + 1]);
	}
	p[n] = p[0];
	for (size_t k = 0; k < n; k++)
		l += mr_dist(p[k], p[k + 1]);
	return l / pow(cos(MR_PI / (double)n), ROUNDS);
}

/* Leaves out the loops of islands, which go with their hole. */
static void
find_islands(filler *w, const uint32_t *component, const bool *open)
{
	uint32_t *holes = MR_NEW(w->ctx, w->n, uint32_t);
	bool *taken = MR_NEW_ZERO(w->ctx, w->loops.count, bool);
	size_t n = w->n;

	for (size_t i = 0; i < n; i++)
		holes[i] = w->hole[i].loop;
	mr_islands_find(w->ctx, w->m, &w->loops, component, open, holes, n, w->next);
	for (size_t i = 0; i < w->loops.count; i++)
		if (w->next[i] != MR_NONE)
			taken[w->next[i]] = true;
	w->n = 0;
	for (size_t i = 0; i < n; i++)
		if (!taken[w->hole[i].loop])
			w->hole[w->n++] = w->hole[i];
}

static void
choose_loops(filler *w)
{
	const mr_mesh *m = w->m;
	double *area, most = w->o->max_length * (w->o->max_length_relative ? mr_mesh_diagonal(m) : 1);
	bool *open = MR_NEW(w->ctx, w->loops.count, bool), several;
	uint32_t *component;

	mr_components_label(w->ctx, m, &component, &several);
	area = find_areas(w, component);
	w->hole = MR_NEW(w->ctx, w->loops.count, hole);
	w->next = MR_NEW(w->ctx, w->loops.count, uint32_t);
	memset(w->next, 0xff, w->loops.count * sizeof *w->next);
	for (uint32_t i = 0; i < w->loops.count; i++) {
		double l = length_of(w, i), smooth = smooth_length(w, i),
		       all = area[component[mr_he_from(m, w->loops.he[w->loops.start[i]])]];
		open[i] = smooth * smooth > 4 * MR_PI * OPEN * all;
		if (most > 0 ? l <= most : w->o->loops > 0 || !open[i])
			w->hole[w->n++] = (hole){ l, i };
	}
	qsort(w->hole, w->n, sizeof *w->hole, by_length);
	if (several && w->n > 0)
		find_islands(w, component, open);
	if (w->o->loops > 0 && w->n > w->o->loops)
		w->n = w->o->loops;
}

/* ---- the first triangles ---- */

/* The surface around the rims, its joins, and the mean length of edges at each vertex of the rims. */
static void
look_around(filler *w)
{
	const mr_mesh *m = w->m;
	bool *chosen = MR_NEW_ZERO(w->ctx, m->nv, bool);
	uint32_t *number = MR_NEW(w->ctx, m->nv, uint32_t);
	double *sum, *count;

	for (size_t i = 0; i < w->rim; i++)
		chosen[mr_he_from(m, w->he[i])] = true;
	mr_patch_build(w->ctx, m, m->nf, chosen, MR_PATCH_RINGS, &w->around);
	mr_adjacency_build(w->ctx, &w->around.mesh, &w->joins);
	sum = MR_NEW_ZERO(w->ctx, w->around.mesh.nv, double);
	count = MR_NEW_ZERO(w->ctx, w->around.mesh.nv, double);
	for (uint32_t h = 0; h < 3 * w->around.mesh.nf; h++) {
		uint32_t a = mr_he_from(&w->around.mesh, h), b = mr_he_to(&w->around.mesh, h);
		double l = mr_dist(w->around.mesh.p[a], w->around.mesh.p[b]);
		sum[a] += l;
		sum[b] += l;
		count[a]++;
		count[b]++;
	}
	for (uint32_t i = 0; i < w->around.end[0]; i++)
		number[w->around.vertex[i]] = i;
	for (size_t i = 0; i < w->rim; i++) {
		w->at[i] = number[mr_he_from(m, w->he[i])];
		w->edge[i] = sum[w->at[i]] / count[w->at[i]];
	}
}

/* Whether two vertices of the patches have an edge of the surface in common. */
static bool
are_joined(const filler *w, uint32_t a, uint32_t b)
{
	size_t i, end;

	if (a >= w->rim || b >= w->rim)
		return false;
	i = w->joins.start[w->at[a]];
	end = w->joins.start[w->at[a] + 1];
	while (i < end && w->joins.adj[i] != w->at[b])
		i++;
	return i < end;
}

/* The polygon along the loops of a hole. */
typedef struct corners {
	const filler *w;
	uint32_t *corner; /* n of the rims */
	size_t n;
	uint32_t (*bridge)[2];
	size_t bridges;
} corners;

static bool
is_taken(const void *arg, uint32_t i, uint32_t j)
{
	const corners *c = arg;
	uint32_t a = c->corner[i], b = c->corner[j];
	bool taken = a == b || are_joined(c->w, a, b);

	for (size_t k = 0; k < c->bridges; k++)
		taken |= (a == c->bridge[k][0] && b == c->bridge[k][1]) ||
		         (b == c->bridge[k][0] && a == c->bridge[k][1]);
	return taken;
}

/* The polygon of hole l without islands. */
static corners
rim_of(const filler *w, size_t l, uint32_t first)
{
	corners c = { .w = w, .n = w->loops.start[w->hole[l].loop + 1] - w->loops.start[w->hole[l].loop] };

	c.corner = MR_NEW(w->ctx, c.n, uint32_t);
	for (uint32_t i = 0; i < c.n; i++)
		c.corner[i] = first + i;
	return c;
}

/* The polygon of hole l, whose rims begin with `first`; *end: where they end. */
static corners
find_corners(const filler *w, size_t l, const mr_v3 *p, uint32_t first, uint32_t *end)
{
	corners rim = rim_of(w, l, first), c = rim;
	uint32_t *start, rim_loop = w->hole[l].loop, n = 0;

	for (uint32_t i = w->next[rim_loop]; i != MR_NONE; i = w->next[i])
		c.bridges++;
	start = MR_NEW(w->ctx, c.bridges + 1, uint32_t);
	*start = first + (uint32_t)rim.n;
	for (uint32_t i = w->next[rim_loop]; i != MR_NONE; i = w->next[i], n++)
		start[n + 1] = start[n] + (uint32_t)(w->loops.start[i + 1] - w->loops.start[i]);
	*end = start[n];
	c.bridge = mr_alloc(w->ctx, c.bridges, sizeof *c.bridge);
	c.corner = MR_NEW(w->ctx, *end - first + 2 * c.bridges, uint32_t);
	memcpy(c.corner, rim.corner, rim.n * sizeof *c.corner);
	mr_islands_join(p, start, c.bridges, c.corner, &c.n, c.bridge);
	return c;
}

/* n - 2 triangles of the rims.  beside: the normal of the face at each of their half-edges. */
static void
span_corners(const corners *c, const mr_v3 *p, const mr_v3 *beside, mr_tri *t)
{
	const filler *w = c->w;
	mr_v3 *at = MR_NEW(w->ctx, c->n, mr_v3), *normal = MR_NEW_ZERO(w->ctx, c->n, mr_v3);

	for (size_t i = 0; i < c->n; i++) {
		uint32_t a = c->corner[i], b = c->corner[i + 1 == c->n ? 0 : i + 1];
		at[i] = p[a];
		if (mr_he_to(w->m, w->he[a]) == mr_he_from(w->m, w->he[b]))
			normal[i] = beside[a];
	}
	mr_span(w->ctx, at, normal, c->n, is_taken, c, t);
	for (size_t i = 0; i < 3 * (c->n - 2); i++)
		t[i / 3].v[i % 3] = c->corner[t[i / 3].v[i % 3]];
}

/* Whether no edge comes twice, to the two copies of a bridge's end. */
static bool
is_manifold(const filler *w, const mr_v3 *p, const mr_tri *t, size_t n)
{
	mr_topology topo;

	return mr_topology_build(w->ctx, &(mr_mesh){ w->m->name, p, t, w->rim, n }, &topo) == MR_OK;
}

/* Spans every loop, and makes the patches of that. */
static mr_status
span_loops(filler *w)
{
	size_t nf = 0;
	uint32_t first = 0, end;
	mr_v3 *p = MR_NEW(w->ctx, w->rim, mr_v3), *beside = MR_NEW(w->ctx, w->rim, mr_v3);
	mr_tri *t = MR_NEW(w->ctx, w->rim + 2 * w->loops.count, mr_tri);
	mr_topology topo;
	mr_mesh m;

	for (size_t i = 0; i < w->rim; i++) {
		p[i] = w->m->p[mr_he_from(w->m, w->he[i])];
		beside[i] = mr_face_cross(w->m, w->he[i] / 3);
	}
	for (size_t l = 0; l < w->n; l++, first = end) {
		corners c = find_corners(w, l, p, first, &end);
		span_corners(&c, p, beside, t + nf);
		if (c.bridges > 0 && !is_manifold(w, p, t + nf, c.n - 2)) {
			c = rim_of(w, l, first);
			span_corners(&c, p, beside, t + nf);
		}
		nf += c.n - 2;
	}
	m = (mr_mesh){ w->m->name, p, t, w->rim, nf };
	MR_TRY(mr_topology_build(w->ctx, &m, &topo));
	MR_TRY(mr_dyn_build(w->ctx, &m, &topo, NULL, 180, &w->d));
	memset(w->d.kind, MR_CORNER, w->rim); /* the rims stay */
	for (uint32_t h = 0; h < 3 * nf; h++)
		if (w->d.twin[h] == MR_NONE) { /* no edges between the ends of a long one can be short */
			uint32_t a = w->d.v[h], b = mr_dyn_to(&w->d, h);
			double least = 0.75 * mr_dist(p[a], p[b]);
			w->edge[a] = fmax(w->edge[a], least);
			w->edge[b] = fmax(w->edge[b], least);
		}
	return MR_OK;
}

/* ---- finer, and rounder ---- */

/* Whether the face of h lies back on the surface at one of the rim's edges. */
static bool
lies_back(const filler *w, uint32_t h)
{
	mr_v3 n = mr_dyn_cross(&w->d, w->d.p, h / 3);
	bool back = false;

	for (int i = 0; i < 3; i++, h = mr_he_next(h))
		back |= w->d.twin[h] == MR_NONE &&
		        mr_dot(n, mr_face_cross(w->m, w->he[mr_dyn_to(&w->d, h)] / 3)) < 0;
	return back;
}

/* By how much an edge is too long, at most 1: it is not.  So is one that the surface has already, or that a
 * face needs to get off the surface. */
static double
excess(const filler *w, uint32_t h)
{
	uint32_t a = w->d.v[h], b = mr_dyn_to(&w->d, h);
	double l = mr_dist(w->d.p[a], w->d.p[b]) / (w->edge[a] + w->edge[b]) * 1.5;
	bool chord = a < w->rim && b < w->rim;

	return chord && (are_joined(w, a, b) || lies_back(w, h) || lies_back(w, w->d.twin[h])) ? fmax(l, 2)
	                                                                                       : l;
}

/* Halves the inner edges that are longer than `coarser` times what they may be; what that makes is for later,
 * since flips come first. */
static mr_status
split_edges(filler *w, double coarser, size_t *splits)
{
	size_t before = 3 * w->d.nf, nv = w->d.nv;

	for (uint32_t h = 0, m; h < before; h++) {
		uint32_t a = w->d.v[h], b = mr_dyn_to(&w->d, h);
		if (w->d.twin[h] == MR_NONE || h > w->d.twin[h] || excess(w, h) <= coarser)
			continue;
		MR_TRY(mr_dyn_split(w->ctx, &w->d, h, mr_lerp(0.5, w->d.p[a], w->d.p[b]), &m));
		MR_RESERVE(w->ctx, w->loop, m, 1, &w->loop_room);
		MR_RESERVE(w->ctx, w->edge, m, 1, &w->edge_room);
		w->loop[m] = w->loop[a];
		w->edge[m] = (w->edge[a] + w->edge[b]) / 2;
	}
	*splits = w->d.nv - nv;
	return MR_OK;
}

static double
cotangent_at(const mr_dyn *d, uint32_t h)
{
	double cot[3];

	mr_cotangents(d->p[mr_dyn_apex(d, h)], d->p[d->v[h]], d->p[mr_dyn_to(d, h)], cot);
	return cot[0];
}

/* Whether the two angles opposite are more than a half turn, and the edge across turns no face over. */
static bool
wants_flip(const filler *w, uint32_t h)
{
	const mr_dyn *d = &w->d;
	uint32_t g = d->twin[h], c, e;
	mr_v3 across, n;

	if (g == MR_NONE || h > g || cotangent_at(d, h) + cotangent_at(d, g) >= -1e-9)
		return false;
	c = mr_dyn_apex(d, h);
	e = mr_dyn_apex(d, g);
	across = mr_sub(d->p[e], d->p[c]);
	n = mr_add(mr_dyn_cross(d, d->p, h / 3), mr_dyn_cross(d, d->p, g / 3));
	return mr_dyn_can_flip(d, h) && !are_joined(w, c, e) &&
	       mr_dot(n, mr_cross(mr_sub(d->p[d->v[h]], d->p[c]), across)) > 0 &&
	       mr_dot(n, mr_cross(across, mr_sub(d->p[d->v[g]], d->p[c]))) > 0;
}

static void
flip_edges(filler *w)
{
	enum { PASSES = 32 };
	bool any = true;

	for (int i = 0; i < PASSES && any; i++) {
		any = false;
		for (uint32_t h = 0; h < 3 * w->d.nf; h++)
			if (wants_flip(w, h)) {
				mr_dyn_flip(&w->d, h);
				any = true;
			}
	}
}

/* Edges as long as those around, of nearly equilateral triangles. */
static mr_status
refine(filler *w)
{
	enum { PASSES = 64 };
	const mr_relax_opts relax = { .damping = 0.5, .passes = 3 };
	mr_mesh m = { .name = w->m->name };
	double most = 1;
	size_t splits, passes = 0;

	flip_edges(w);
	for (uint32_t h = 0; h < 3 * w->d.nf; h++)
		if (w->d.twin[h] != MR_NONE)
			most = fmax(most, excess(w, h));
	do {
		most = fmax(1, most / 2);
		MR_TRY(split_edges(w, most, &splits));
		flip_edges(w);
	} while ((splits > 0 || most > 1) && ++passes < PASSES);
	for (int i = 0; i < 3; i++) {
		MR_TRY(mr_relax(w->ctx, &w->d, &(mr_remesh_source){ .m = &m }, &relax));
		flip_edges(w);
	}
	return MR_OK;
}

/* A surface and patches of it, whose first `rim` vertices are those `at` it has. */
static mr_mesh
join(mr_ctx *ctx, const mr_mesh *m, const mr_mesh *patches, size_t rim, const uint32_t *at)
{
	size_t nv = m->nv + patches->nv - rim, nf = m->nf + patches->nf;
	mr_v3 *p = MR_NEW(ctx, nv, mr_v3);
	mr_tri *t = MR_NEW(ctx, nf, mr_tri);

	memcpy(p, m->p, m->nv * sizeof *p);
	memcpy(p + m->nv, patches->p + rim, (patches->nv - rim) * sizeof *p);
	memcpy(t, m->t, m->nf * sizeof *t);
	for (size_t i = 0; i < 3 * patches->nf; i++) {
		uint32_t v = patches->t[i / 3].v[i % 3];
		t[m->nf + i / 3].v[i % 3] = v < rim ? at[v] : (uint32_t)(v - rim + m->nv);
	}
	return (mr_mesh){ m->name, p, t, nv, nf };
}

/* Lets the new vertices of loops `first` to `end` go where D^k p = 0, all others as they are. */
static mr_status
solve(filler *w, size_t order, size_t first, size_t end)
{
	mr_mesh patches = mr_dyn_view(&w->d, w->m->name),
		m = join(w->ctx, &w->around.mesh, &patches, w->rim, w->at);
	size_t before = w->around.mesh.nv - w->rim, free = 0;
	mr_v3 *to = MR_NEW(w->ctx, m.nv, mr_v3);
	uint32_t *region = MR_NEW_ZERO(w->ctx, m.nv, uint32_t);
	mr_deform_opts o = MR_DEFORM_DEFAULTS;
	mr_deform *deform;

	o.order = order;
	o.apart = true;
	for (size_t v = w->rim; v < w->d.nv; v++)
		if (w->loop[v] >= first && w->loop[v] < end) {
			region[before + v] = MR_REGION_FREE;
			free++;
		}
	if (free == 0)
		return MR_OK;
	MR_TRY(mr_deform_new(w->ctx, &m, NULL, region, &o, &deform));
	MR_TRY(mr_deform_solve(w->ctx, deform, m.p, NULL, to));
	memcpy(w->d.p + w->rim, to + before + w->rim, (w->d.nv - w->rim) * sizeof *to);
	return MR_OK;
}

/* Fairs loops together.  If their system has no solution in doubles, halves the set until one loop is left,
 * which gets a lower order. */
static mr_status
fair(filler *w, size_t order, size_t first, size_t end)
{
	mr_mark mark = mr_mark_take(w->ctx);
	mr_status status = solve(w, order, first, end);
	size_t middle = first + (end - first) / 2;

	mr_mark_release(w->ctx, mark);
	if (status != MR_ENUMERIC)
		return status;
	if (middle == first)
		return order > 1 ? fair(w, order - 1, first, end) : MR_OK;
	MR_TRY(fair(w, order, first, middle));
	return fair(w, order, middle, end);
}

/* ---- what crosses ---- */

/* The patches whose loops are not bad. */
static void
gather(filler *w, const bool *bad, mr_patches *out)
{
	mr_v3 *p = MR_NEW(w->ctx, w->d.nv, mr_v3);
	mr_tri *t = MR_NEW(w->ctx, w->d.nf, mr_tri);
	uint32_t *he = MR_NEW(w->ctx, w->rim, uint32_t);
	uint32_t *loop = MR_NEW(w->ctx, w->d.nv, uint32_t), *number = MR_NEW(w->ctx, w->d.nv, uint32_t);
	size_t nv = 0, nf = 0;

	*out = (mr_patches){ .he = he, .loop = loop };
	for (size_t v = 0; v < w->d.nv; v++) {
		if (bad[w->loop[v]])
			continue;
		if (v < w->rim)
			he[out->rim++] = w->he[v];
		p[nv] = w->d.p[v];
		loop[nv] = w->loop[v];
		number[v] = (uint32_t)nv++;
	}
	for (size_t f = 0; f < w->d.nf; f++) {
		if (bad[w->loop[w->d.v[3 * f]]])
			continue;
		for (size_t k = 0; k < 3; k++)
			t[nf].v[k] = number[w->d.v[3 * f + k]];
		nf++;
	}
	out->m = (mr_mesh){ w->m->name, p, t, nv, nf };
}

typedef struct crossing {
	const mr_patches *patches;
	const mr_mesh *other; /* these, or the surface */
	uint32_t face;
} crossing;

static uint32_t
loop_of(const mr_patches *patches, size_t f)
{
	return patches->loop[patches->m.t[f].v[0]];
}

/* Whether the face does not meet face g, or g is of a longer loop, whose patch gives way. */
static bool
is_good(void *arg, uint32_t g)
{
	const crossing *c = arg;
	const mr_mesh *m = &c->patches->m;
	mr_v3 p[3], q[3];

	if (c->other == m && (g == c->face || loop_of(c->patches, g) > loop_of(c->patches, c->face)))
		return true;
	mr_corners(m, c->face, p);
	mr_corners(c->other, g, q);
	return mr_triangle_degenerate(p[0], p[1], p[2]) || mr_triangle_degenerate(q[0], q[1], q[2]) ||
	       !mr_triangles_intersect(p, q);
}

/* Finds the loops whose patches cross something: bad, one for each loop, and the vertices of their faces that
 * do.  Whether there is one. */
static bool
find_crossings(const filler *w, const mr_patches *patches, bool *bad, bool *at)
{
	crossing old = { patches, w->m, 0 }, new = { patches, &patches->m, 0 };
	mr_bvh *bvh;
	bool any = false;

	memset(bad, 0, w->n * sizeof *bad);
	memset(at, 0, w->d.nv * sizeof *at);
	mr_bvh_build(w->ctx, &patches->m, &bvh);
	for (uint32_t f = 0; f < patches->m.nf; f++) {
		mr_v3 p[3];
		old.face = new.face = f;
		mr_corners(&patches->m, f, p);
		if (mr_bvh_overlap(w->surface, mr_box_of(p, 3), is_good, &old) &&
		    mr_bvh_overlap(bvh, mr_box_of(p, 3), is_good, &new))
			continue;
		any = bad[loop_of(patches, f)] = true;
		for (int k = 0; k < 3; k++)
			at[patches->m.t[f].v[k]] = true;
	}
	return any;
}

/* Smooths patches for a few rounds where they intersect anything, and drops those that still do. */
static mr_status
settle(filler *w, bool *bad, mr_patches *out)
{
	enum { ROUNDS = 8 };
	bool *at = MR_NEW(w->ctx, w->d.nv, bool);
	mr_mark mark = mr_mark_take(w->ctx);
	int i = 0;

	gather(w, bad, out);
	while (find_crossings(w, out, bad, at) && i++ < ROUNDS) {
		for (uint32_t v = (uint32_t)w->rim; v < w->d.nv; v++)
			if (at[v])
				w->d.p[v] = mr_dyn_middle_around(&w->d, v);
		memset(bad, 0, w->n * sizeof *bad);
		mr_mark_release(w->ctx, mark);
		gather(w, bad, out);
	}
	if (i > ROUNDS)
		gather(w, bad, out);
	return MR_OK;
}

static void
report_open(const filler *w, const char *why, size_t n, const uint32_t *vertex)
{
	mr_finding f = { .kind = MR_LIMIT, .layer = w->m->name };

	if (n == 0)
		return;
	if (vertex) {
		f.placed = true;
		f.vertex = *vertex;
		f.at = w->m->p[f.vertex];
	}
	f.what = mr_format(w->ctx, "open, %s: %zu", why, n);
	mr_found(w->ctx, &f);
}

static void
report(const filler *w, const bool *bad, mr_fill_result *r)
{
	uint32_t vertex = 0;

	for (size_t l = w->n; l-- > 0;) {
		size_t *count = bad[l] ? &r->crossing : &r->filled;
		for (uint32_t i = w->hole[l].loop; i != MR_NONE; i = w->next[i])
			++*count;
		if (bad[l])
			vertex = mr_he_from(w->m, w->loops.he[w->loops.start[w->hole[l].loop]]);
	}
	report_open(w, "edges of three faces interrupt the boundary", w->loops.broken, NULL);
	if (w->n == 0 && w->loops.broken == 0 && !(w->o->max_length > 0))
		report_open(w, "rims of an open surface", w->loops.count, NULL);
	report_open(w, "holes whose filling would cross the surface", r->crossing, &vertex);
}

static mr_mesh
join_patches(const filler *w, const mr_patches *out)
{
	uint32_t *at = MR_NEW(w->ctx, out->rim, uint32_t);

	for (size_t i = 0; i < out->rim; i++)
		at[i] = mr_he_from(w->m, out->he[i]);
	return join(w->ctx, w->m, &out->m, out->rim, at);
}

/* The rims of the loops that are filled, hole by hole. */
static void
list_rims(filler *w)
{
	size_t n = 0;

	w->rim = w->loop_room = w->edge_room = 0;
	for (size_t l = 0; l < w->n; l++)
		for (uint32_t i = w->hole[l].loop; i != MR_NONE; i = w->next[i])
			w->rim += w->loops.start[i + 1] - w->loops.start[i];
	w->he = MR_NEW(w->ctx, w->rim, uint32_t);
	w->at = MR_NEW(w->ctx, w->rim, uint32_t);
	MR_RESERVE(w->ctx, w->loop, 0, w->rim, &w->loop_room);
	MR_RESERVE(w->ctx, w->edge, 0, w->rim, &w->edge_room);
	for (size_t l = 0; l < w->n; l++)
		for (uint32_t i = w->hole[l].loop; i != MR_NONE; i = w->next[i])
			for (size_t k = w->loops.start[i]; k < w->loops.start[i + 1]; k++) {
				w->loop[n] = (uint32_t)l;
				w->he[n++] = w->loops.he[k];
			}
}

/* Leaves the islands of holes alone that cannot be filled with them.  Whether there are such. */
static bool
leave_islands(filler *w, const bool *bad)
{
	bool any = false;

	for (size_t l = 0; l < w->n; l++)
		if (bad[l] && w->next[w->hole[l].loop] != MR_NONE) {
			w->next[w->hole[l].loop] = MR_NONE;
			any = true;
		}
	return any;
}

/* Spans the holes, without islands where the triangles with them cross anything. */
static mr_status
span_holes(filler *w, bool *bad, mr_patches *out)
{
	bool islands = false;

	do {
		list_rims(w);
		look_around(w);
		MR_TRY(span_loops(w));
		islands = false;
		for (size_t l = 0; l < w->n; l++)
			islands |= w->next[w->hole[l].loop] != MR_NONE;
		memset(bad, 0, w->n * sizeof *bad);
		if (islands) {
			gather(w, bad, out);
			find_crossings(w, out, bad, MR_NEW(w->ctx, w->d.nv, bool));
		}
	} while (leave_islands(w, bad));
	memset(bad, 0, w->n * sizeof *bad);
	return MR_OK;
}

static mr_status
fill_holes(filler *w, bool *bad, mr_patches *out)
{
	mr_bvh *surface;

	mr_bvh_build(w->ctx, w->m, &surface);
	w->surface = surface;
	MR_TRY(span_holes(w, bad, out));
	MR_TRY(refine(w));
	MR_TRY(fair(w, 1, 0, w->n));
	for (int i = 0; i < 2 && w->o->order > 1; i++) {
		MR_TRY(refine(w));
		MR_TRY(fair(w, w->o->order, 0, w->n));
	}
	MR_TRY(settle(w, bad, out));
	return leave_islands(w, bad) ? fill_holes(w, bad, out) : MR_OK;
}

/* ---- loops that touch ---- */

/* Marks the vertices of a loop whose place another that is not beside it has.  Whether there are such. */
static bool
mark_touching(const filler *w, uint32_t loop, bool *touching)
{
	const uint32_t *he = w->loops.he + w->loops.start[loop];
	size_t n = w->loops.start[loop + 1] - w->loops.start[loop], places;
	MR_SCOPE(w->ctx);
	uint32_t *place = MR_NEW(w->ctx, n, uint32_t), *last = MR_NEW(w->ctx, n, uint32_t);
	mr_v3 *p = MR_NEW(w->ctx, n, mr_v3);
	bool any = false;

	for (size_t i = 0; i < n; i++)
		p[i] = w->m->p[mr_he_from(w->m, he[i])];
	mr_weld(w->ctx, p, n, 0, place, &places);
	memset(last, 0xff, n * sizeof *last);
	for (uint32_t i = 0; i < n; i++) {
		uint32_t j = last[place[i]];
		last[place[i]] = i;
		if (j == MR_NONE || i - j == 1 || i - j == n - 1)
			continue;
		touching[mr_he_from(w->m, he[i])] = touching[mr_he_from(w->m, he[j])] = any = true;
	}
	return any;
}

/* m with the vertices that touch joined; map: their new numbers. */
static mr_mesh
join_vertices(mr_ctx *ctx, const mr_mesh *m, const bool *touching, uint32_t *map)
{
	mr_tri *t = MR_NEW(ctx, m->nf, mr_tri);
	mr_v3 *p = MR_NEW(ctx, m->nv, mr_v3);
	size_t nv, nf = 0;

	mr_weld_some(ctx, m->p, m->nv, 0, touching, map, &nv);
	for (size_t v = 0; v < m->nv; v++)
		p[map[v]] = m->p[v];
	for (size_t f = 0; f < m->nf; f++) {
		for (int k = 0; k < 3; k++)
			t[nf].v[k] = map[m->t[f].v[k]];
		nf += t[nf].v[0] != t[nf].v[1] && t[nf].v[1] != t[nf].v[2] && t[nf].v[2] != t[nf].v[0];
	}
	return (mr_mesh){ m->name, p, t, nv, nf };
}

/* Whether all loops through vertices that touch can be filled once these are joined: else what stays open
 * would touch itself at one vertex. */
static mr_status
try_joined(mr_ctx *ctx, const mr_mesh *m, const mr_fill_opts *o, const bool *touching, bool *good)
{
	uint32_t *map = MR_NEW(ctx, m->nv, uint32_t);
	mr_mesh joined = join_vertices(ctx, m, touching, map);
	uint32_t *open = MR_NEW_ZERO(ctx, joined.nv, uint32_t);
	bool *bad;
	filler w = { .ctx = ctx, .m = &joined, .o = o };
	mr_patches patches;

	mr_loops_find(ctx, &joined, &w.loops);
	for (size_t k = 0; k < w.loops.start[w.loops.count]; k++)
		open[mr_he_from(&joined, w.loops.he[k])]++;
	choose_loops(&w);
	bad = MR_NEW_ZERO(ctx, w.n, bool);
	MR_TRY(fill_holes(&w, bad, &patches));
	for (size_t i = 0; i < patches.rim; i++)
		open[mr_he_from(&joined, patches.he[i])]--;
	*good = true;
	for (size_t v = 0; v < m->nv; v++)
		*good &= !touching[v] || !open[map[v]];
	return MR_OK;
}

mr_status
mr_fill_touching(mr_ctx *ctx, const mr_mesh *m, const mr_fill_opts *o, bool **touching)
{
	filler w = { .ctx = ctx, .m = m, .o = o };
	bool any = false;

	*touching = MR_NEW_ZERO(ctx, m->nv, bool);
	mr_loops_find(ctx, m, &w.loops);
	choose_loops(&w);
	for (size_t i = 0; i < w.n; i++)
		any |= mark_touching(&w, w.hole[i].loop, *touching);
	if (any)
		MR_TRY(try_joined(ctx, m, o, *touching, &any));
	*touching = any ? *touching : NULL;
	return MR_OK;
}

mr_status
mr_fill(mr_ctx *ctx, const mr_mesh *m, const mr_fill_opts *o, mr_patches *out, mr_fill_result *result)
{
	filler w = { .ctx = ctx, .m = m, .o = o };
	bool *bad;

	mr_loops_find(ctx, m, &w.loops);
	choose_loops(&w);
	bad = MR_NEW_ZERO(ctx, w.n, bool);
	*result = (mr_fill_result){ .loops = w.loops.count };
	*out = (mr_patches){ .all = *m };
	if (w.n > 0) {
		MR_TRY(fill_holes(&w, bad, out));
		out->all = join_patches(&w, out);
	}
	report(&w, bad, result);
	result->vertices = out->m.nv - out->rim;
	result->faces = out->m.nf;
	return MR_OK;
}
