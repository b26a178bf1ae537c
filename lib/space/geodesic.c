/*
 * Marching over triangles (Kimmel, Sethian 1998) with the update of Novotni and Klein 2002: the distances of
 * two corners fix a source in the plane of their triangle, and the third corner is as far as the straight way
 * from there, if that way passes between the two.  If an obtuse triangle breaks the order, a vertex that
 * becomes nearer is looked at again.
 */
#include "space/geodesic.h"

#include "base/priority_queue.h"
#include "space/bvh.h"

typedef struct entry {
	double distance;
	uint32_t vertex;
} entry;

typedef struct front {
	entry *queue;
	size_t n, room;
} front;

static bool
before(const void *a, const void *b)
{
	const entry *x = a, *y = b;

	return x->distance < y->distance || (x->distance == y->distance && x->vertex < y->vertex);
}

/* The distance of corner c across the edge a-b, whose ends are da and db away. */
static double
behind_edge(mr_v3 a, mr_v3 b, mr_v3 c, double da, double db)
{
	double ab = mr_dist(a, b), ac = mr_dist(a, c), bc = mr_dist(b, c), along = fmin(da + ac, db + bc);
	double sx, sy, cx, cy, x;

	if (!(ab > 0) || !isfinite(da) || !isfinite(db))
		return along;
	/* a at (0, 0), b at (ab, 0), c above the edge, the source below it */
	sx = (da * da - db * db + ab * ab) / (2 * ab);
	cx = (ac * ac - bc * bc + ab * ab) / (2 * ab);
	if (da * da < sx * sx)
		return along;
	sy = sqrt(da * da - sx * sx);
	cy = sqrt(fmax(ac * ac - cx * cx, 0));
	x = sy + cy > 0 ? sx + (cx - sx) * sy / (sy + cy) : cx;
	return x >= 0 && x <= ab ? hypot(cx - sx, cy + sy) : along;
}

typedef struct march {
	const mr_mesh *m;
	mr_v3 source;
	double *distance;
	front front;
} march;

/* Gives v the distance d if that is nearer by more than `step` of the way it came over, |way|. */
static void
relax(mr_ctx *ctx, march *j, uint32_t v, double d, double way)
{
	front *f = &j->front;
	const double step = 1e-4; /* less does not pay: it would run on through all that follows */

	/* corners that are not settled yet can put the source too near: space is the shortest way of all */
	d = fmax(d, mr_dist(j->m->p[v], j->source));
	if (!(d < j->distance[v] - step * way))
		return;
	j->distance[v] = d;
	MR_RESERVE(ctx, f->queue, f->n, 1, &f->room);
	mr_queue_push(f->queue, f->n++, sizeof(entry), &(entry){ d, v }, before);
}

/* Looks from v and one more corner of the face at the third, both ways. */
static void
relax_face(mr_ctx *ctx, march *j, uint32_t v, const uint32_t c[3])
{
	const mr_v3 *p = j->m->p;
	const double *d = j->distance;

	for (int k = 0; k < 3; k++) {
		uint32_t a = c[k], b = c[(k + 1) % 3], third = c[(k + 2) % 3];
		double way = fmin(mr_dist(p[a], p[third]), mr_dist(p[b], p[third]));
		if (third != v)
			relax(ctx, j, third, behind_edge(p[a], p[b], p[third], d[a], d[b]), way);
	}
}

static mr_closest
nearest_point(const mr_mesh *m, mr_v3 p)
{
	mr_closest best = { .at.face = MR_NONE, .dist2 = INFINITY };

	for (uint32_t f = 0; f < m->nf; f++) {
		mr_closest c = mr_face_closest(m, f, p);
		if (c.dist2 < best.dist2)
			best = c;
	}
	return best;
}

void
mr_geodesic_from(mr_ctx *ctx, const mr_mesh *m, const mr_incidence *inc, uint32_t face, mr_v3 source,
    double reach, double *distance)
{
	MR_SCOPE(ctx);
	march j = { m, source, distance, { 0 } };

	for (size_t v = 0; v < m->nv; v++)
		distance[v] = INFINITY;
	for (int k = 0; k < 3 && face != MR_NONE; k++) {
		uint32_t v = m->t[face].v[k];
		relax(ctx, &j, v, mr_dist(m->p[v], source), 0);
	}
	while (j.front.n > 0) {
		entry e;
		mr_queue_pop(j.front.queue, j.front.n--, sizeof e, &e, before);
		if (e.distance > reach)
			break;
		if (e.distance > distance[e.vertex])
			continue;
		for (size_t i = inc->start[e.vertex]; i < inc->start[e.vertex + 1]; i++)
			relax_face(ctx, &j, e.vertex, m->t[inc->face[i]].v);
	}
	for (size_t v = 0; v < m->nv; v++)
		if (distance[v] > reach)
			distance[v] = INFINITY;
}

void
mr_geodesic_distances(mr_ctx *ctx, const mr_mesh *m, mr_v3 p, double reach, double *distance)
{
	MR_SCOPE(ctx);
	mr_closest source = nearest_point(m, p);
	mr_incidence inc;

	mr_incidence_build(ctx, m, &inc);
	mr_geodesic_from(ctx, m, &inc, source.at.face, source.point, reach, distance);
}
