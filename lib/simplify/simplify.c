/* Garland, Heckbert 1997: Surface simplification using quadric error metrics. */
#include "simplify/simplify.h"

#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include "simplify/bucket_queue.h"
#include "simplify/edge_collapse.h"
#include "simplify/sectors.h"
#include "simplify/sharp_edges.h"

/* The shape that needles may have where the faces asked for cannot be had otherwise, thin plates, say; and of
 * meshes, which are looked at: with needles a thin part takes no faces from the others. */
static const double LAST_NEEDLE = 0.01;
/* The weight of seams, which may move along the surface, where boundaries have 10. */
static const double SEAM = 0.3;

static const uint16_t UNKNOWN = UINT16_MAX; /* no bucket: the edge has no merge */

/*
 * Edges wait in the queue by what their merge cost when that was last computed.  A merge mostly makes those
 * around it dearer, so an old cost is a lower bound.  It is computed again when the edge comes up; if it has
 * grown the edge goes back.
 */
typedef struct simplifier {
	mr_ctx *ctx;
	const mr_simplify_opts *o;
	const mr_simplify_ties *ties;
	const mr_mesh *m;
	mr_dyn d;          /* scaled by a power of two to about unit size; at[v]: the number in the input */
	double scale;      /* that power */
	mr_site *site;     /* of each vertex */
	mr_buckets *queue; /* of edges, by the half-edge with the lower number */
	uint16_t *bucket;  /* of each such half-edge: its last one */
	uint32_t *onto;    /* what each vertex was merged into, itself while it lives */
	uint8_t *mark;     /* for the link condition */
	uint32_t *corner;  /* of each half-edge, where ties need it: its number in the input */
	size_t target;     /* faces to stop at; 0: no such limit */
	double limit;      /* error to stop at; infinite: no such limit */
	size_t most;       /* faces for whose sake more is merged than there is room for */
	size_t fine;       /* faces at which the mesh is kept, lest the most be too few; 0: nowhere */
	bool kept;         /* before there is room for any error */
	size_t faces, merges;
	size_t seams;         /* faces that they would keep where they gave way; 0: they did not */
	double longest;       /* edge to be merged, as long as there is room: beside long ones short ones of a
	                         crease swing */
	double error2;        /* greatest of the merges done */
	double needle;        /* least shape of a face */
	const uint8_t *inner; /* of each vertex: only such are merged; NULL: all are */
} simplifier;

/* The half-edge that an edge is known by. */
static uint32_t
edge_of(const mr_dyn *d, uint32_t h)
{
	return d->twin[h] < h ? d->twin[h] : h;
}

static void
compute_body(void *arg, size_t begin, size_t end)
{
	simplifier *s = arg;

	for (size_t i = begin; i < end; i++) {
		uint32_t h = (uint32_t)i;
		mr_merge m;
		s->bucket[h] = UNKNOWN;
		if (mr_dyn_face_dead(&s->d, h / 3) || edge_of(&s->d, h) != h)
			continue;
		mr_merge_begin(&s->d, s->site, h, &m);
		s->bucket[h] = (uint16_t)mr_bucket_of((float)m.cost);
	}
}

static void
enqueue(simplifier *s, uint32_t edge, uint32_t bucket)
{
	s->bucket[edge] = (uint16_t)bucket;
	mr_buckets_put(s->queue, edge, bucket);
}

/* Fills the empty queue with all edges. */
static void
fill_queue(simplifier *s)
{
	mr_parallel(s->ctx, 3 * s->d.nf, 4096, compute_body, s);
	for (uint32_t h = 3 * (uint32_t)s->d.nf; h-- > 0;)
		if (s->bucket[h] != UNKNOWN)
			mr_buckets_put(s->queue, h, s->bucket[h]);
}

/* Takes the edge of h out of the queue: the bucket it was in, or UNKNOWN. */
static uint32_t
dequeue(simplifier *s, uint32_t h)
{
	uint32_t edge = edge_of(&s->d, h);

	if (!mr_buckets_has(s->queue, edge))
		return UNKNOWN;
	mr_buckets_remove(s->queue, edge);
	return s->bucket[edge];
}

/* The edge that the two other sides of h's face become, out of the queue; *bucket is the lower of theirs. */
static uint32_t
fuse_sides(simplifier *s, uint32_t h, uint32_t *bucket)
{
	uint32_t next = mr_he_next(h), prev = mr_he_prev(h);
	uint32_t a = dequeue(s, next), b = dequeue(s, prev);

	next = s->d.twin[next];
	prev = s->d.twin[prev];
	*bucket = a < b ? a : b;
	return next < prev ? next : prev;
}

static bool
is_inner(const simplifier *s, uint32_t h)
{
	return !s->inner || (s->inner[s->d.v[h]] && s->inner[mr_dyn_to(&s->d, h)]);
}

/* Edges at v that were given up get another chance: what stands around them has changed. */
static void
retry_around(simplifier *s, uint32_t v)
{
	const mr_dyn *d = &s->d;
	uint32_t h = d->out[v];

	do {
		uint32_t back = mr_he_prev(h);
		if (!mr_buckets_has(s->queue, edge_of(d, h)) && is_inner(s, h))
			enqueue(s, edge_of(d, h), 0);
		if (d->twin[back] == MR_NONE && !mr_buckets_has(s->queue, back) && is_inner(s, back))
			enqueue(s, back, 0);
		h = d->twin[back];
	} while (h != MR_NONE && h != d->out[v]);
}

static void
merge(simplifier *s, uint32_t h, const mr_merge *m)
{
	mr_dyn *d = &s->d;
	uint32_t a = d->v[h], b = mr_dyn_to(d, h), g = d->twin[h], bucket[2] = { UNKNOWN, UNKNOWN };
	uint32_t side = fuse_sides(s, h, &bucket[0]), other = g == MR_NONE ? 0 : fuse_sides(s, g, &bucket[1]);
	mr_quadric qa = mr_quadric_moved(&s->site[a].q, mr_sub(m->p, d->p[a]));
	mr_quadric qb = mr_quadric_moved(&s->site[b].q, mr_sub(m->p, d->p[b]));

	d->kind[b] = d->kind[a] > d->kind[b] ? d->kind[a] : d->kind[b];
	if (s->ties->values) {
		mr_field fa = mr_field_moved(s->site[a].field, mr_sub(m->p, d->p[a])),
			 fb = mr_field_moved(s->site[b].field, mr_sub(m->p, d->p[b]));
		*s->site[b].field = d->kind[b] == MR_SMOOTH ? mr_field_sum(&fa, &fb)
		                                            : (mr_field){ .weight = 0 };
	}
	mr_dyn_collapse(d, h, m->p);
	s->site[b] = (mr_site){ mr_quadric_sum(&qa, &qb), fmin(s->site[a].room, s->site[b].room),
		s->site[a].rim || s->site[b].rim, s->site[b].field };
	s->onto[a] = b;
	s->faces -= g == MR_NONE ? 1 : 2;
	s->merges++;
	s->error2 = fmax(s->error2, m->error2);
	if (bucket[0] != UNKNOWN)
		enqueue(s, side, bucket[0]);
	if (bucket[1] != UNKNOWN)
		enqueue(s, other, bucket[1]);
	retry_around(s, b);
}

/* The error that the merge of h may have. */
static double
room_at(const simplifier *s, uint32_t h)
{
	double room = fmin(s->site[s->d.v[h]].room, s->site[mr_dyn_to(&s->d, h)].room);

	return s->scale * (s->most ? fmin(s->limit, room) : s->limit);
}

/* Whether h bounds a part of two faces: one of them would be left, and half of the area. */
static bool
is_of_last_two(const mr_dyn *d, uint32_t h)
{
	uint32_t n = d->twin[mr_he_next(h)], p = d->twin[mr_he_prev(h)], e = n == MR_NONE ? p : n;

	return d->twin[h] == MR_NONE && (n == MR_NONE) != (p == MR_NONE) &&
	       d->twin[mr_he_next(e)] == MR_NONE && d->twin[mr_he_prev(e)] == MR_NONE;
}

/* Whether the ends of h can be merged; the one that lives has the higher kind of theirs. */
static bool
can_collapse(const simplifier *s, uint32_t h)
{
	uint8_t *a = &s->d.kind[s->d.v[h]], *b = &s->d.kind[mr_dyn_to(&s->d, h)], kind_a = *a, kind_b = *b;
	bool can;

	if (is_of_last_two(&s->d, h))
		return false;
	*a = kind_a < kind_b ? kind_a : kind_b;
	*b = kind_a < kind_b ? kind_b : kind_a;
	can = mr_dyn_can_collapse(&s->d, h, s->mark);
	*a = kind_a;
	*b = kind_b;
	return can;
}

/* Looks at the edge that came up: merges it, puts it back, or gives it up. */
static void
serve(simplifier *s, uint32_t h, uint32_t bucket)
{
	double limit = room_at(s, h);
	uint32_t now;
	mr_merge m; /* its cost in that case */

	mr_merge_begin(&s->d, s->site, h, &m);
	now = mr_bucket_of((float)m.cost);
	if (now > bucket) {
		enqueue(s, h, now);
		return;
	}
	if ((s->most && mr_norm(m.sum.ab) > s->longest) || !mr_merge_finish(&s->d, s->site, &m) ||
	    m.error2 > limit * limit)
		return;
	now = mr_bucket_of((float)m.cost);
	if (now > bucket) {
		enqueue(s, h, now);
		return;
	}
	if (can_collapse(s, h) && mr_merge_is_sound(&s->d, &m, s->needle))
		merge(s, h, &m);
}

/* Whether there are seams that may give way for a number of faces. */
static bool
may_give_way(const simplifier *s)
{
	return s->ties->face && !s->ties->fixed && s->d.curve && s->target > 0;
}

/* Lets seams go that keep so many faces.  Values jump across them: what is merged there has no field. */
static void
give_up_seams(simplifier *s, size_t faces)
{
	s->d.curve = NULL;
	s->seams = faces;
	for (size_t v = 0; v < s->d.nv; v++) {
		s->d.kind[v] = s->d.kind[v] == MR_DEAD ? MR_DEAD : MR_SMOOTH;
		if (s->site[v].field)
			*s->site[v].field = (mr_field){ .weight = 0 };
	}
}

/* Lets errors be larger, where there are more faces than the most, or needles be thinner; each once, for the
 * sake of a number of faces; but not where a finer mesh was kept.  On a mesh with sharp edges larger errors
 * would close pockets and bend flats. */
static bool
relax(simplifier *s)
{
	bool first = s->needle > LAST_NEEDLE && s->target > 0;

	if (s->kept && s->faces > s->most)
		return false;
	if (s->most > 0 && s->faces > s->most && (!s->d.curve || s->o->weight)) {
		s->target = s->most;
		s->most = 0;
		return true;
	}
	s->needle = LAST_NEEDLE;
	if (first || !may_give_way(s))
		return first;
	give_up_seams(s, s->faces);
	return true;
}

/* Adds the plane of face f to its corners, a third of the area each. */
static void
add_face(simplifier *s, uint32_t f, mr_v3 normal, double area)
{
	for (uint32_t h = 3 * f; h < 3 * f + 3; h++) {
		mr_quadric *q = &s->site[s->d.v[h]].q;
		mr_quadric_add_plane(q, normal, area / 3);
		q->area += area / 3;
	}
}

/* Adds the plane through boundary or sharp edge h that stands upright on its face to the ends. */
static void
add_rim(simplifier *s, uint32_t h, mr_v3 normal, double area_weight)
{
	const mr_dyn *d = &s->d;
	uint32_t a = d->v[h], b = mr_dyn_to(d, h);
	mr_v3 edge = mr_sub(d->p[b], d->p[a]), side = mr_unit(mr_cross(normal, edge));
	double of_edge = d->twin[h] == MR_NONE || !s->ties->face ? s->o->boundary : SEAM;
	double weight = area_weight * of_edge * mr_norm2(edge) / 2;

	if (d->twin[h] == MR_NONE)
		s->site[a].rim = s->site[b].rim = true;
	mr_quadric_add_plane(&s->site[a].q, side, weight);
	mr_quadric_add_plane(&s->site[b].q, side, weight);
}

/* Handles face f, by its corners. */
static double
weight_of(const simplifier *s, uint32_t f)
{
	const double *w = s->o->weight;
	const uint32_t *v = s->d.v + 3 * (size_t)f, *at = s->d.at;

	return w ? (w[at[v[0]]] + w[at[v[1]]] + w[at[v[2]]]) / 3 : 1;
}

/* Adds how the values of face f go on in its plane to the fields of its corners except corners on curves,
 * where the other side has its own. */
static void
add_field(simplifier *s, uint32_t f, double area)
{
	const mr_dyn *d = &s->d;
	size_t n = s->ties->values;
	double x[MR_VALUES][3];
	mr_v3 p[3], g[MR_VALUES];

	for (uint32_t k = 0; k < 3; k++) {
		p[k] = d->p[d->v[3 * f + k]];
		for (size_t i = 0; i < n; i++)
			x[i][k] = s->scale * s->ties->value[n * s->corner[3 * f + k] + i];
	}
	for (size_t i = 0; i < n; i++)
		if (!mr_gradient(p, x[i], &g[i]))
			return;
	for (uint32_t k = 0; k < 3; k++) {
		mr_field *field = s->site[d->v[3 * f + k]].field;
		if (d->kind[d->v[3 * f + k]] != MR_SMOOTH)
			continue;
		for (size_t i = 0; i < n; i++)
			mr_field_add(field, i, g[i], x[i][k], area / 3);
		field->weight += area / 3;
	}
}

static void
add_quadrics(simplifier *s)
{
	const mr_dyn *d = &s->d;

	for (uint32_t f = 0; f < d->nf; f++) {
		mr_v3 cross = mr_dyn_cross(d, d->p, f), normal = mr_unit(cross);
		double weight = weight_of(s, f);
		add_face(s, f, normal, weight * mr_norm(cross) / 2);
		if (s->ties->values && !s->seams)
			add_field(s, f, weight * mr_norm(cross) / 2);
		for (uint32_t h = 3 * f; h < 3 * f + 3; h++)
			if (d->twin[h] == MR_NONE || mr_dyn_on_curve(d, h))
				add_rim(s, h, normal, weight);
	}
}

/* Keeps the input's numbers of half-edges; the curves are the half-edges that `sharp` marks. */
static void
take_source(simplifier *s, const uint8_t *sharp)
{
	mr_dyn *d = &s->d;

	s->corner = MR_NEW(s->ctx, 3 * d->nf, uint32_t);
	memcpy(s->corner, d->curve, 3 * d->nf * sizeof *s->corner);
	for (size_t h = 0; h < 3 * d->nf; h++)
		d->curve[h] = sharp && sharp[d->curve[h]] ? d->curve[h] : MR_NONE;
	if (!sharp)
		d->curve = NULL;
}

/* The mesh without its isolated vertices, neighbours close in memory. */
static mr_status
copy_mesh(simplifier *s, const mr_mesh *m)
{
	const uint8_t *sharp = s->ties->sharp ? *s->ties->sharp : NULL;
	mr_topology topo;
	mr_dyn d = { .nv = m->nv,
		.nf = m->nf,
		.room_v = m->nv,
		.room_f = m->nf,
		.free_v = MR_NONE,
		.free_f = MR_NONE };

	MR_TRY(mr_topology_build(s->ctx, m, &topo));
	d.twin = topo.twin;
	d.out = topo.out;
	d.p = MR_NEW(s->ctx, m->nv, mr_v3);
	d.at = MR_NEW(s->ctx, m->nv, uint32_t);
	d.kind = MR_NEW(s->ctx, m->nv, uint8_t);
	d.v = MR_NEW(s->ctx, 3 * m->nf, uint32_t);
	memcpy(d.v, m->t, 3 * m->nf * sizeof *d.v);
	for (uint32_t v = 0; v < m->nv; v++) {
		d.p[v] = mr_mul(s->scale, m->p[v]);
		d.at[v] = v;
		d.kind[v] = d.out[v] == MR_NONE ? MR_DEAD : MR_SMOOTH;
	}
	d.curve = s->ties->face || sharp ? MR_NEW(s->ctx, 3 * m->nf, uint32_t) : NULL;
	for (uint32_t h = 0; d.curve && h < 3 * m->nf; h++)
		d.curve[h] = h;
	MR_TRY(mr_dyn_compact(s->ctx, &d));
	mr_dyn_order(s->ctx, &d);
	s->d = d;
	if (d.curve)
		take_source(s, sharp);
	return MR_OK;
}

/* A mesh with fewer faces than are asked for keeps all; otherwise curves shorter than three edges of the
 * result are doubted. */
static void
find_sharp_edges(simplifier *s, const mr_mesh *m)
{
	size_t most = s->most > s->target ? s->most : s->target;
	double edge = s->scale * sqrt(2.3 * mr_mesh_area(s->ctx, m) / (double)(most + 1));

	if (mr_sharp_edges(s->ctx, &s->d, s->o->creases || s->faces <= most ? 0 : 3 * edge,
		s->ties->face ? 0 : edge / 2))
		s->longest = 1.5 * edge;
}

/* Pieces that the curves part. */
static size_t
count_charts(const simplifier *s)
{
	MR_SCOPE(s->ctx);
	const mr_dyn *d = &s->d;
	uint32_t *set = mr_sets_new(s->ctx, d->nf);
	size_t n = 0;

	for (uint32_t h = 0; h < 3 * d->nf; h++)
		if (d->twin[h] != MR_NONE && !mr_dyn_on_curve(d, h))
			mr_sets_join(set, h / 3, d->twin[h] / 3);
	for (uint32_t f = 0; f < d->nf; f++)
		n += set[f] == f;
	return n;
}

static mr_status
begin(simplifier *s, const mr_mesh *m)
{
	size_t charts;

	MR_TRY(copy_mesh(s, m));
	s->site = MR_NEW_ZERO(s->ctx, s->d.nv, mr_site);
	s->onto = mr_sets_new(s->ctx, s->d.nv);
	s->mark = MR_NEW_ZERO(s->ctx, s->d.nv, uint8_t);
	s->bucket = MR_NEW(s->ctx, 3 * s->d.nf, uint16_t);
	s->faces = s->d.nf;
	if (s->ties->sharp)
		find_sharp_edges(s, m);
	for (uint32_t v = 0; s->ties->fixed && v < s->d.nv; v++)
		if (s->ties->fixed[s->d.at[v]])
			s->d.kind[v] = MR_CORNER;
	for (uint32_t v = 0; v < s->d.nv; v++)
		s->site[v].room = s->o->room ? s->o->room[s->d.at[v]] : INFINITY;
	if (s->ties->values) {
		mr_field *field = mr_alloc_zero(s->ctx, s->d.nv, sizeof *field);
		for (uint32_t v = 0; v < s->d.nv; v++)
			s->site[v].field = &field[v];
	}
	if (s->fine)
		s->most = 0;
	if (may_give_way(s) && (charts = count_charts(s)) > s->target)
		give_up_seams(s, charts);
	add_quadrics(s);
	mr_buckets_new(s->ctx, 3 * s->d.nf, &s->queue);
	return MR_OK;
}

/* Maps each vertex of the input to the vertex of the result that it was merged into.  number: of live
 * vertices. */
static void
number_onto(simplifier *s, size_t nv, const uint32_t *number, uint32_t *onto)
{
	for (size_t v = 0; v < nv; v++)
		onto[v] = MR_NONE;
	for (uint32_t v = 0; v < s->d.nv; v++) {
		uint32_t w = v;
		while (s->onto[w] != w)
			w = s->onto[w] = s->onto[s->onto[w]];
		onto[s->d.at[v]] = number[w];
	}
}

/* The vertices that live, in the order of the input's numbers, and their faces. */
static void
keep(simplifier *s, mr_mesh *out, uint32_t *onto, mr_simplify_result *r)
{
	const mr_dyn *d = &s->d;
	mr_v3 *p = MR_NEW(s->ctx, d->nv - s->merges, mr_v3);
	mr_tri *t = MR_NEW(s->ctx, s->faces, mr_tri);
	uint32_t *number = MR_NEW(s->ctx, d->nv, uint32_t), nv = 0;
	uint8_t *sharp = d->curve ? MR_NEW(s->ctx, 3 * d->nf, uint8_t) : NULL;
	uint32_t *face = s->ties->face ? MR_NEW(s->ctx, s->faces, uint32_t) : NULL;
	size_t nf = 0;

	if (sharp)
		mr_mark_sharp_edges(d, sharp);
	for (uint32_t v = 0; v < d->nv; v++)
		if (s->onto[v] == v) {
			number[v] = nv;
			p[nv++] = mr_mul(1 / s->scale, d->p[v]);
		}
	for (size_t f = 0; f < d->nf; f++) {
		if (mr_dyn_face_dead(d, f))
			continue;
		if (sharp)
			memmove(sharp + 3 * nf, sharp + 3 * f, 3);
		if (face)
			face[nf] = s->corner[3 * f] / 3;
		t[nf++] = (mr_tri){ { number[d->v[3 * f]], number[d->v[3 * f + 1]],
		    number[d->v[3 * f + 2]] } };
	}
	if (s->ties->sharp)
		*s->ties->sharp = sharp;
	if (face)
		*s->ties->face = face;
	number_onto(s, s->m->nv, number, onto);
	*out = (mr_mesh){ s->m->name, p, t, nv, nf };
	*r = (mr_simplify_result){ nv, nf, s->merges, 0, sqrt(s->error2) / s->scale };
}

/* Vertices with numbers close to each other, which are neighbours: a part of the mesh that a thread works on.
 */
enum { BLOCK = 1 << 14 };

/* How many times as many faces as in the end the blocks are left with: the borders between them are finer. */
static const double SPARE = 2;
/* Buckets by which costs double: the blocks' merges keep step with each other. */
enum { DOUBLED = 128 };

typedef struct blocks {
	simplifier *part;
	uint32_t level; /* buckets above it wait */
} blocks;

static void
serve_blocks(void *arg, size_t begin, size_t end)
{
	const blocks *w = arg;

	for (size_t i = begin; i < end; i++) {
		simplifier *s = &w->part[i];
		uint32_t bucket;
		while (mr_buckets_lowest(s->queue) <= w->level) {
			uint32_t h = mr_buckets_take(s->queue, &bucket);
			serve(s, h, bucket);
		}
	}
}

/* Marks the vertices whose faces lie in one block.  *between: the number of faces that touch others. */
static const uint8_t *
find_inner(const simplifier *s, size_t *between)
{
	const mr_dyn *d = &s->d;
	uint8_t *inner = MR_NEW(s->ctx, d->nv, uint8_t);

	memset(inner, 1, d->nv);
	for (size_t f = 0; f < d->nf; f++) {
		const uint32_t *v = &d->v[3 * f];
		if (mr_dyn_face_dead(d, f) || (v[0] / BLOCK == v[1] / BLOCK && v[1] / BLOCK == v[2] / BLOCK))
			continue;
		inner[v[0]] = inner[v[1]] = inner[v[2]] = 0;
	}
	*between = 0;
	for (size_t f = 0; f < d->nf; f++) {
		const uint32_t *v = &d->v[3 * f];
		*between += !mr_dyn_face_dead(d, f) && (!inner[v[0]] || !inner[v[1]] || !inner[v[2]]);
	}
	return inner;
}

/* Queues of the blocks' own edges.  *between: faces that do not change. */
static simplifier *
divide(simplifier *s, size_t n, size_t *between)
{
	simplifier *part = MR_NEW(s->ctx, n, simplifier);
	const uint8_t *inner = find_inner(s, between);

	for (size_t i = 0; i < n; i++) {
		part[i] = *s;
		part[i].faces = part[i].merges = 0;
		part[i].inner = inner;
		part[i].queue = mr_buckets_beside(s->ctx, s->queue);
	}
	mr_parallel(s->ctx, 3 * s->d.nf, 4096, compute_body, s);
	for (uint32_t h = 3 * (uint32_t)s->d.nf; h-- > 0;) {
		simplifier *own = &part[s->d.v[h] / BLOCK];
		if (s->bucket[h] != UNKNOWN && is_inner(own, h))
			mr_buckets_put(own->queue, h, s->bucket[h]);
	}
	return part;
}

/* Adds up what the blocks have done so far.  start: what was there before them. */
static void
gather(simplifier *s, const simplifier *start, const simplifier *part, size_t n)
{
	s->merges = start->merges;
	s->faces = start->faces;
	for (size_t i = 0; i < n; i++) {
		s->merges += part[i].merges;
		s->faces += part[i].faces; /* less than nothing, modulo 2^64 */
		s->error2 = fmax(s->error2, part[i].error2);
	}
}

static uint32_t
lowest_of(const simplifier *part, size_t n)
{
	uint32_t lowest = MR_BUCKETS;

	for (size_t i = 0; i < n; i++) {
		uint32_t own = mr_buckets_lowest(part[i].queue);
		lowest = own < lowest ? own : lowest;
	}
	return lowest;
}

/* Merges within blocks, on all threads, the cheapest first; what spans two blocks stays as it is. */
static void
merge_in_blocks(simplifier *s)
{
	size_t n = (s->d.nv + BLOCK - 1) / BLOCK, most = s->target > s->most ? s->target : s->most, between;
	double enough = SPARE * (double)(!s->kept && s->fine ? s->fine : most);
	simplifier start = *s;
	blocks w = { 0 };

	if (n < 3 || (double)s->faces <= enough)
		return;
	MR_SCOPE(s->ctx);
	w.part = divide(s, n, &between);
	enough += (double)between;
	for (; (double)s->faces > enough && (w.level = lowest_of(w.part, n)) < MR_BUCKETS;) {
		w.level += DOUBLED;
		mr_parallel(s->ctx, n, 1, serve_blocks, &w);
		gather(s, &start, w.part, n);
		mr_progress(s->ctx, "merging", (double)s->merges / (double)(s->d.nv - s->target / 2));
	}
	mr_buckets_clear(s->queue, 3 * s->d.nf);
}

/* Keeps the mesh that is fine enough for any points; then there is room for errors. */
static void
keep_fine(simplifier *s, mr_mesh *out, uint32_t *onto, mr_simplify_result *r)
{
	keep(s, out, onto, r);
	s->kept = true;
	s->most = s->o->most;
	mr_buckets_clear(s->queue, 3 * s->d.nf);
	merge_in_blocks(s);
	fill_queue(s);
}

/* Merges until there are few enough faces.  Edges given up are tried again as long as others were merged, but
 * once where a fine mesh is kept: again and again would take another hundredth of the faces. */
static void
merge_all(simplifier *s, mr_mesh *out, uint32_t *onto, mr_simplify_result *r)
{
	size_t before;

	merge_in_blocks(s);
	do {
		uint32_t h, bucket;
		before = s->merges;
		fill_queue(s);
		while (s->faces > s->target && (h = mr_buckets_take(s->queue, &bucket)) != MR_NONE) {
			serve(s, h, bucket);
			if (!s->kept && s->faces <= s->fine)
				keep_fine(s, out, onto, r);
		}
	} while (s->faces > s->target && ((s->merges > before && !s->kept) || relax(s)));
	if (!s->kept || s->faces <= s->o->most)
		keep(s, out, onto, r);
}

/* Reports that too many faces are left, or that seams gave way. */
static void
report(const simplifier *s, size_t nf)
{
	mr_finding f = { .kind = MR_LIMIT, .layer = s->m->name };

	if (nf > s->target && s->target && !s->most && !isfinite(s->limit))
		f.what = mr_format(s->ctx,
		    "%s: %zu faces are left, not %zu: merging more would change the topology or fold it",
		    s->m->name, nf, s->target);
	else if (s->seams)
		f.what = mr_format(
		    s->ctx, "%s: seams give way, which would keep %zu faces", s->m->name, s->seams);
	if (f.what)
		mr_found(s->ctx, &f);
}

mr_status
mr_simplify(mr_ctx *ctx, const mr_mesh *m, const mr_simplify_opts *opts, const mr_simplify_ties *ties,
    mr_mesh *out, uint32_t *onto, mr_simplify_result *result)
{
	static const mr_simplify_ties none = { 0 };
	double diagonal = mr_mesh_diagonal(m);
	mr_simplify_result r;
	simplifier s = { .ctx = ctx,
		.o = opts,
		.ties = ties ? ties : &none,
		.m = m,
		.needle = ties && ties->needles ? LAST_NEEDLE : MR_NEEDLE,
		.longest = INFINITY,
		.scale = diagonal > 0 ? ldexp(1, -(int)fmax(-1000, ilogb(diagonal)))
		                      : 1, /* a number for any */
		.target = opts->faces ? opts->faces : (size_t)ceil(opts->ratio * (double)m->nf),
		.most = opts->room ? opts->most : 0,
		.fine = opts->room ? opts->fine : 0,
		.limit = opts->error <= 0       ? INFINITY
		         : opts->error_relative ? opts->error * diagonal
		                                : opts->error };

	MR_TRY(begin(&s, m));
	merge_all(&s, out, onto, &r);
	report(&s, out->nf);
	if (s.ties->sharp && *s.ties->sharp && !s.ties->face) /* of a control mesh */
		MR_TRY(mr_fill_sectors(ctx, out, s.ties->sharp));
	r.vertices = out->nv;
	r.faces = out->nf;
	if (result)
		*result = r;
	return MR_OK;
}
