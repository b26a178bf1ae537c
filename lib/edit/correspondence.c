/* Turns a source map round: the parameterization of Botsch, Kobbelt 2004, section 4, from the other side. */
#include "edit/correspondence.h"

#include "base/parallel.h"
#include "space/bvh.h"

/* Gives each unlabelled vertex that hangs together with labelled ones the label that reaches it first. */
static void
spread_labels(mr_ctx *ctx, const mr_mesh *m, const mr_incidence *inc, uint32_t *label)
{
	uint32_t *queue = MR_NEW(ctx, m->nv, uint32_t);
	size_t n = 0;

	for (uint32_t v = 0; v < m->nv; v++)
		if (label[v] != MR_NONE)
			queue[n++] = v;
	for (size_t next = 0; next < n; next++)
		for (size_t i = inc->start[queue[next]]; i < inc->start[queue[next] + 1]; i++)
			for (int k = 0; k < 3; k++) {
				uint32_t w = m->t[inc->face[i]].v[k];
				if (label[w] != MR_NONE)
					continue;
				label[w] = label[queue[next]];
				queue[n++] = w;
			}
}

/* Labels each vertex of the mesh with the nearest base vertex on its faces; a vertex without one takes the
 * label of the nearest neighbours in connectivity.  lifted: the base on the mesh. */
static void
label_vertices(mr_ctx *ctx, const mr_mesh *mesh, const mr_incidence *mesh_inc, const mr_mesh *lifted,
    const mr_incidence *inc, const mr_places *source, uint32_t *label)
{
	double *dist2 = MR_NEW(ctx, mesh->nv, double);

	for (size_t i = 0; i < mesh->nv; i++) {
		label[i] = MR_NONE;
		dist2[i] = INFINITY;
	}
	for (uint32_t j = 0; j < lifted->nv; j++) {
		const uint32_t *c = mesh->t[source->face[j]].v;
		if (inc->start[j] == inc->start[j + 1])
			continue;
		for (int k = 0; k < 3; k++) {
			double d = mr_norm2(mr_sub(mesh->p[c[k]], lifted->p[j]));
			if (d < dist2[c[k]]) {
				label[c[k]] = j;
				dist2[c[k]] = d;
			}
		}
	}
	spread_labels(ctx, mesh, mesh_inc, label);
}

typedef struct walker {
	const mr_correspondence *c;
	const mr_mesh *mesh, *lifted;
	const mr_incidence *inc;
	const bool *stands;
	uint32_t *face;
	mr_v3 *bary;
	double *dist2; /* from there to the vertex */
} walker;

static inline double
outside(double x, double a, double b, double c)
{
	double low = a < b ? a : b, high = a > b ? a : b, below, above, most;

	low = c < low ? c : low;
	high = c > high ? c : high;
	below = low - x;
	above = x - high;
	most = below > above ? below : above;
	return most > 0 ? most : 0;
}

/* Whether the face's box is nearer: its nearest point lies within, so that rounding does not decide
 * otherwise. */
static inline bool
may_be_nearer(const walker *w, uint32_t f, mr_v3 q, double dist2)
{
	const uint32_t *v = w->lifted->t[f].v;
	mr_v3 a = w->lifted->p[v[0]], b = w->lifted->p[v[1]], c = w->lifted->p[v[2]];

	return mr_norm2(mr_vec(outside(q.x, a.x, b.x, c.x), outside(q.y, a.y, b.y, c.y),
		   outside(q.z, a.z, b.z, c.z))) < dist2;
}

/* The nearest place of the faces around a vertex that is nearer than sqrt(dist2), else on MR_NONE; of equal
 * faces in a row, as there may be thousands, one is looked at. */
static mr_closest
nearest_around(const walker *w, uint32_t vertex, mr_v3 q, double dist2)
{
	const mr_tri *t = w->lifted->t, *last = NULL;
	mr_closest best = { .at.face = MR_NONE, .dist2 = dist2 };

	for (size_t i = w->inc->start[vertex]; i < w->inc->start[vertex + 1]; i++) {
		uint32_t f = w->inc->face[i];
		mr_closest c;
		if (last && !memcmp(last, &t[f], sizeof *last))
			continue;
		last = &t[f];
		if (!may_be_nearer(w, f, q, best.dist2))
			continue;
		c = mr_face_closest(w->lifted, f, q);
		if (c.dist2 < best.dist2)
			best = c;
	}
	return best;
}

/* From vertex to vertex while that comes nearer. */
static mr_closest
walk(const walker *w, uint32_t vertex, mr_v3 q)
{
	mr_closest near = nearest_around(w, vertex, q, INFINITY);

	for (;;) {
		mr_closest best = near;
		for (int k = 0; k < 3; k++) {
			uint32_t v = w->lifted->t[near.at.face].v[k];
			mr_closest c = v == vertex ? near : nearest_around(w, v, q, best.dist2);
			if (c.dist2 < best.dist2) {
				best = c;
				vertex = v;
			}
		}
		if (!(best.dist2 < near.dist2))
			return near;
		near = best;
	}
}

static void
stand(const walker *w, size_t i, const mr_closest *c)
{
	w->face[i] = c->at.face;
	w->bary[i] = c->at.bary;
	w->dist2[i] = c->dist2;
}

static void
walk_piece(void *arg, size_t begin, size_t end)
{
	const walker *w = arg;

	for (size_t i = begin; i < end; i++) {
		uint32_t label = w->c->label[i];
		if (w->stands[i]) {
			mr_v3 at = mr_place_point(w->lifted, (mr_place){ w->face[i], w->bary[i] });
			w->dist2[i] = mr_norm2(mr_sub(at, w->mesh->p[i]));
		} else if (label != MR_NONE) {
			mr_closest c = walk(w, label, w->mesh->p[i]);
			stand(w, i, &c);
		} else {
			w->face[i] = MR_NONE;
		}
	}
}

/* The squared distance from vertex i of a place so much nearer than its own that the walk ended too early. */
static double
nearer(const walker *w, uint32_t i)
{
	static const double less = 0.98; /* of the squared distance: rounding is no reason to go on */

	return less * w->dist2[i];
}

/* Walks from where a neighbour stands if that is nearer; true where it is. */
static bool
improve(const walker *w, uint32_t i, uint32_t neighbour)
{
	uint32_t face = w->face[neighbour];
	mr_closest c;

	if (w->stands[i] || (!w->stands[neighbour] && !(w->dist2[neighbour] < w->dist2[i])) ||
	    face == w->face[i] || !may_be_nearer(w, face, w->mesh->p[i], nearer(w, i)))
		return false;
	c = mr_face_closest(w->lifted, face, w->mesh->p[i]);
	if (!(c.dist2 < nearer(w, i)))
		return false;
	c = walk(w, w->lifted->t[face].v[0], w->mesh->p[i]);
	if (!(c.dist2 < nearer(w, i)))
		return false;
	stand(w, i, &c);
	return true;
}

/* Whether a neighbour does not stand yet. */
static bool
has_other(const walker *w, const mr_incidence *inc, uint32_t u)
{
	for (size_t i = inc->start[u]; i < inc->start[u + 1]; i++)
		for (int k = 0; k < 3; k++)
			if (!w->stands[w->mesh->t[inc->face[i]].v[k]])
				return true;
	return false;
}

/* A walk downhill ends where every step leads away: on the underside of a plate below the vertex, say, if it
 * began there.  So vertices follow their neighbours that stand nearer, until none comes nearer. */
static void
follow_neighbours(mr_ctx *ctx, const walker *w, const mr_incidence *inc)
{
	size_t n = w->mesh->nv, waiting = 0;
	uint32_t *queue = MR_NEW(ctx, n, uint32_t); /* a ring of those whose neighbours are to follow */
	bool *queued = MR_NEW_ZERO(ctx, n, bool);

	for (uint32_t i = 0; i < n; i++)
		if (!w->stands[i] || has_other(w, inc, i)) {
			queue[waiting++] = i;
			queued[i] = true;
		}
	for (size_t first = 0; waiting > 0; first = (first + 1) % n, waiting--) {
		uint32_t u = queue[first];
		queued[u] = false;
		for (size_t i = inc->start[u]; w->face[u] != MR_NONE && i < inc->start[u + 1]; i++)
			for (int k = 0; k < 3; k++) {
				uint32_t v = w->mesh->t[inc->face[i]].v[k];
				if (!improve(w, v, u) || queued[v])
					continue;
				queue[(first + waiting++) % n] = v;
				queued[v] = true;
			}
	}
}

void
mr_correspond(mr_ctx *ctx, const mr_mesh *mesh, const mr_mesh *base, const mr_incidence *inc,
    const mr_places *source, mr_correspondence *c)
{
	mr_v3 *on_mesh = MR_NEW(ctx, base->nv, mr_v3);

	*c = (mr_correspondence){
		.mesh = mesh, .lifted = *base, .inc = inc, .label = MR_NEW(ctx, mesh->nv, uint32_t)
	};
	mr_incidence_build(ctx, mesh, &c->mesh_inc);
	for (size_t j = 0; j < base->nv; j++)
		on_mesh[j] = mr_place_point(mesh, mr_places_at(source, j));
	c->lifted.p = on_mesh;
	label_vertices(ctx, mesh, &c->mesh_inc, &c->lifted, inc, source, c->label);
}

/* Whether q is over the inside of a face, not all but a line, and where. */
static bool
is_over(const mr_mesh *m, uint32_t face, mr_v3 q, mr_place *at)
{
	const double thin = 1e-8;
	const uint32_t *v = m->t[face].v;
	mr_v3 b = mr_sub(m->p[v[1]], m->p[v[0]]), c = mr_sub(m->p[v[2]], m->p[v[0]]),
	      d = mr_sub(q, m->p[v[0]]);
	double bb = mr_norm2(b), bc = mr_dot(b, c), cc = mr_norm2(c), bd = mr_dot(b, d), cd = mr_dot(c, d);
	double det = bb * cc - bc * bc, y = cc * bd - bc * cd, z = bb * cd - bc * bd;

	if (!(y > 0 && z > 0 && y + z < det && det > thin * bb * cc))
		return false;
	y /= det;
	z /= det;
	*at = (mr_place){ face, { 1 - y - z, y, z } };
	return true;
}

void
mr_correspond_soon(const mr_correspondence *c, const mr_mesh *base, size_t i, size_t end)
{
	enum { SOON = 8 };
	const size_t *start = c->inc->start;
	uint32_t first = i + 3 * SOON < end ? c->label[i + 3 * SOON] : MR_NONE;
	uint32_t second = i + 2 * SOON < end ? c->label[i + 2 * SOON] : MR_NONE;
	uint32_t third = i + SOON < end ? c->label[i + SOON] : MR_NONE;

	if (first != MR_NONE) {
		__builtin_prefetch(&start[first]);
		__builtin_prefetch(&base->p[first]);
	}
	if (second != MR_NONE)
		__builtin_prefetch(&c->inc->face[start[second]]);
	if (third != MR_NONE)
		__builtin_prefetch(&base->t[c->inc->face[start[third]]]);
}

mr_place
mr_correspond_near(const mr_correspondence *c, const mr_mesh *base, size_t i)
{
	uint32_t v = c->label[i];
	mr_closest near = { .dist2 = INFINITY, .at.face = MR_NONE };

	if (v == MR_NONE)
		return near.at;
	for (size_t j = c->inc->start[v]; j < c->inc->start[v + 1]; j++)
		if (is_over(base, c->inc->face[j], c->mesh->p[i], &near.at))
			return near.at;
	for (size_t j = c->inc->start[v]; j < c->inc->start[v + 1]; j++) {
		mr_closest n = mr_face_closest(base, c->inc->face[j], c->mesh->p[i]);
		if (n.dist2 < near.dist2)
			near = n;
	}
	return near.at;
}

void
mr_correspond_rest(mr_ctx *ctx, const mr_correspondence *c, const bool *stands, uint32_t *face, mr_v3 *bary)
{
	MR_SCOPE(ctx);
	walker w = { c, c->mesh, &c->lifted, c->inc, stands, face, bary, MR_NEW(ctx, c->mesh->nv, double) };

	mr_parallel(ctx, c->mesh->nv, 1024, walk_piece, &w);
	follow_neighbours(ctx, &w, &c->mesh_inc);
}
