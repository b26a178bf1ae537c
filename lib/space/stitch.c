/* The boundary as a mesh of segments, in a tree; its vertices are looked for beside them. */
#include "space/stitch.h"

#include "base/sort.h"
#include "mesh/edges.h"
#include "mesh/mend.h"
#include "mesh/subset.h"
#include "space/bvh.h"
#include "space/near.h"

/* Edges of one face, of those that have an area. */
typedef struct rim {
	const mr_mesh *m;
	mr_tri *segment; /* from, to, to */
	uint32_t *half;  /* half-edge of m */
	bool *on;        /* nv: the vertex is at one */
	size_t count;
} rim;

static void
find_rim(mr_ctx *ctx, const mr_mesh *m, rim *r)
{
	mr_tri *t = MR_NEW(ctx, m->nf, mr_tri);
	uint32_t *face = MR_NEW(ctx, m->nf, uint32_t);
	mr_mesh live = { .p = m->p, .t = t, .nv = m->nv };
	mr_edges edges;

	for (uint32_t i = 0; i < m->nf; i++)
		if (!mr_face_repeats(m, i) && mr_norm2(mr_face_cross(m, i)) > 0) {
			face[live.nf] = i;
			t[live.nf++] = m->t[i];
		}
	mr_edges_build(ctx, &live, &edges);
	*r = (rim){ .m = m,
		.segment = MR_NEW(ctx, edges.count, mr_tri),
		.half = MR_NEW(ctx, edges.count, uint32_t),
		.on = MR_NEW_ZERO(ctx, m->nv, bool) };
	for (size_t e = 0; e < edges.count; e++) {
		uint32_t h = edges.he[edges.start[e]], a = mr_he_from(&live, h), b = mr_he_to(&live, h);
		if (mr_edge_faces(&edges, e) != 1)
			continue;
		r->segment[r->count] = (mr_tri){ { a, b, b } };
		r->half[r->count++] = 3 * face[h / 3] + h % 3;
		r->on[a] = r->on[b] = true;
	}
}

/* ---- vertices that are to be one ---- */

static int
ascending(const void *a, const void *b)
{
	double x = *(const double *)a, y = *(const double *)b;

	return x < y ? -1 : x > y;
}

mr_status
mr_weld_distance(mr_ctx *ctx, const mr_mesh *m, double *distance, const bool **may)
{
	const double least = 10;
	double *length, *d, widest = least;
	uint32_t *index;
	size_t n = 0;
	mr_v3 *p;
	rim r;

	*distance = 0;
	find_rim(ctx, m, &r);
	*may = r.on;
	if (r.count == 0)
		return MR_OK;
	MR_SCOPE(ctx);
	p = MR_NEW(ctx, m->nv, mr_v3);
	for (size_t i = 0; i < m->nv; i++)
		if (r.on[i])
			p[n++] = m->p[i];
	d = MR_NEW(ctx, 2 * n, double);
	index = MR_NEW(ctx, 2 * n, uint32_t);
	MR_TRY(mr_near_once(ctx, p, n, p, n, 2, index, d));
	length = MR_NEW(ctx, r.count + n, double);
	for (size_t i = 0; i < r.count; i++)
		length[i] = mr_dist(m->p[r.segment[i].v[0]], m->p[r.segment[i].v[1]]);
	qsort(length, r.count, sizeof *length, ascending);
	const double median = length[r.count / 2];
	for (size_t i = 0; i < n; i++)
		length[r.count + i] = sqrt(d[2 * i + 1]);
	qsort(length, r.count + n, sizeof *length, ascending);
	for (size_t i = 0; i + 1 < r.count + n && length[i] < median; i++)
		if (length[i] > 0 && length[i + 1] >= widest * length[i]) {
			widest = length[i + 1] / length[i];
			*distance = sqrt(length[i] * length[i + 1]);
		}
	return MR_OK;
}

/* ---- vertices on edges ---- */

typedef struct stitch {
	uint32_t half, vertex; /* of the face's side on which it stands */
	double t;
} stitch;

typedef struct search {
	mr_ctx *ctx;
	const rim *r;
	uint32_t vertex;
	double within;
	stitch *found;
	size_t count, room;
} search;

/* Whether the vertex stands on the segment, away from its ends and no corner of its face. */
static bool
stands_on(void *arg, uint32_t segment)
{
	search *s = arg;
	const mr_mesh *m = s->r->m;
	uint32_t h = s->r->half[segment], v = s->vertex;
	mr_v3 a = m->p[mr_he_from(m, h)], d = mr_sub(m->p[mr_he_to(m, h)], a), x = mr_sub(m->p[v], a);
	double length = mr_norm(d), along = mr_dot(x, d) / length;

	if (mr_has_corner(m->t[h / 3], v) || along <= s->within || along >= length - s->within ||
	    mr_norm(mr_axpy(-along / length, d, x)) > s->within)
		return true;
	MR_RESERVE(s->ctx, s->found, s->count, 1, &s->room);
	s->found[s->count++] = (stitch){ h, v, along / length };
	return true;
}

static int
by_place(const void *a, const void *b)
{
	const stitch *x = a, *y = b;

	if (x->half != y->half)
		return x->half < y->half ? -1 : 1;
	if (x->t != y->t)
		return x->t < y->t ? -1 : 1;
	return x->vertex < y->vertex ? -1 : x->vertex > y->vertex;
}

/* Vertices on edges, in order along them; of several at one place, and of several sides of a face, the
 * first. */
static void
find_stitches(mr_ctx *ctx, const mr_mesh *m, search *s)
{
	mr_mesh segments;
	mr_bvh *tree;
	size_t n = 0;
	rim r;

	find_rim(ctx, m, &r);
	*s = (search){ .ctx = ctx, .r = &r, .within = mr_mesh_tolerance(m, 1e-5) };
	segments = (mr_mesh){ .p = m->p, .t = r.segment, .nv = m->nv, .nf = r.count };
	if (r.count == 0)
		return;
	mr_bvh_build(ctx, &segments, &tree);
	for (s->vertex = 0; s->vertex < m->nv; s->vertex++) {
		mr_v3 p = m->p[s->vertex], reach = mr_vec(s->within, s->within, s->within);
		if (r.on[s->vertex])
			mr_bvh_overlap(tree, (mr_box){ mr_sub(p, reach), mr_add(p, reach) }, stands_on, s);
	}
	if (s->count)
		qsort(s->found, s->count, sizeof *s->found, by_place);
	for (size_t i = 0; i < s->count; i++) {
		const stitch *x = &s->found[i], *last = n ? &s->found[n - 1] : NULL;
		if (last && last->half / 3 == x->half / 3 &&
		    (last->half != x->half || mr_dist(m->p[last->vertex], m->p[x->vertex]) <= s->within))
			continue;
		s->found[n++] = *x;
	}
	s->count = n;
}

/* The faces after it: of which each is a part, and each corner between which two of that. */
typedef struct pieces {
	mr_tri *t;
	uint32_t *of, *parent; /* parent: 6 for each face */
	double *weight;
	size_t n;
} pieces;

/* A corner at share x of the side from corner a to b of face f. */
static void
put_corner(pieces *q, size_t f, int k, uint32_t vertex, int a, int b, double x)
{
	size_t i = 6 * q->n + 2 * (size_t)k;

	q->t[q->n].v[k] = vertex;
	q->of[q->n] = (uint32_t)f;
	q->parent[i] = (uint32_t)(3 * f) + (uint32_t)a;
	q->parent[i + 1] = (uint32_t)(3 * f) + (uint32_t)b;
	q->weight[i] = 1 - x;
	q->weight[i + 1] = x;
}

/* A face, as a fan about the corner that is not of the side with n vertices. */
static void
put_fan(pieces *q, const mr_mesh *m, size_t f, const stitch *s, size_t n)
{
	const uint32_t *v = m->t[f].v;
	int a = n ? (int)(s->half % 3) : 0, b = (a + 1) % 3, c = (a + 2) % 3;

	for (size_t i = 0; i <= n; i++) {
		put_corner(q, f, a, i ? s[i - 1].vertex : v[a], a, b, i ? s[i - 1].t : 0);
		put_corner(q, f, b, i < n ? s[i].vertex : v[b], a, b, i < n ? s[i].t : 1);
		put_corner(q, f, c, v[c], c, a, 0);
		q->n++;
	}
}

static mr_status
put_pieces(mr_ctx *ctx, mr_frame *f, const mr_mesh *m, const pieces *q)
{
	mr_carried corner[2];
	size_t corners = 0;

	if (mr_layer_has(f, m->name, "texcoord")) /* which for the face beyond the edge may be others */
		MR_TRY(mr_layer_to_corners(ctx, f, m, "texcoord"));
	for (size_t i = 0; i < f->count; i++) {
		if (strcmp(f->columns[i].layer, m->name) || strncmp(f->columns[i].name, "corner_", 7) ||
		    corners == 2)
			continue;
		MR_TRY(mr_carried_begin(ctx, f, i, m->nf, q->n, &corner[corners]));
		mr_carried_make(
		    ctx, &corner[corners++], 3, 0, (mr_rows_from){ 3 * q->n, 2, q->parent, q->weight });
	}
	MR_TRY(mr_layer_gather(ctx, f, m->name, 'f', q->of, q->n));
	MR_TRY(mr_carried_put(ctx, f, m->name, corner, corners));
	return mr_layer_put(ctx, f, m->name, "triangles", q->t, q->n);
}

mr_status
mr_layer_stitch(mr_ctx *ctx, mr_frame *f, const char *layer, size_t *stitched)
{
	enum {
		ROUNDS = 32
	}; /* in each, one side of a face is split: three, and the new ones, are done by the fifth */
	search s = { .count = 1 };
	pieces q;
	mr_mesh m;

	*stitched = 0;
	for (int round = 0; round < ROUNDS && s.count > 0; round++) {
		size_t n = 0;
		MR_TRY(mr_layer_mesh_of_any_size(ctx, f, layer, &m));
		find_stitches(ctx, &m, &s);
		if (s.count == 0)
			break;
		n = m.nf + s.count;
		q = (pieces){ MR_NEW(ctx, n, mr_tri), MR_NEW(ctx, n, uint32_t), MR_NEW(ctx, 6 * n, uint32_t),
			MR_NEW(ctx, 6 * n, double), 0 };
		for (size_t face = 0, i = 0, end; face < m.nf; face++, i = end) {
			for (end = i; end < s.count && s.found[end].half / 3 == face;)
				end++;
			put_fan(&q, &m, face, s.found + i, end - i);
		}
		MR_TRY(put_pieces(ctx, f, &m, &q));
		*stitched += s.count;
	}
	return MR_OK;
}
