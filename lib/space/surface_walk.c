/* Steps over edges and vertices, each to where the surface is nearer, on to a local minimum. */
#include "space/surface_walk.h"

/* The corner that the place stands on, or -1. */
static int
corner_of(mr_closest p)
{
	return p.at.bary.x >= 1 ? 0 : p.at.bary.y >= 1 ? 1 : p.at.bary.z >= 1 ? 2 : -1;
}

/* The side that the place stands on, or -1. */
static int
side_of(mr_closest p)
{
	return p.at.bary.z <= 0 ? 0 : p.at.bary.x <= 0 ? 1 : p.at.bary.y <= 0 ? 2 : -1;
}

/* The nearest place on the faces around vertex v. */
static mr_closest
nearest_around(const mr_mesh *m, const mr_topology *topo, uint32_t v, mr_v3 q)
{
	uint32_t h = topo->out[v];
	mr_closest best = { .dist2 = INFINITY };

	do {
		mr_closest p = mr_face_closest(m, h / 3, q);
		if (p.dist2 < best.dist2)
			best = p;
		h = mr_he_ccw(topo, h);
	} while (h != MR_NONE && h != topo->out[v]);
	return best;
}

/* Steps from a place on to a local minimum. */
static mr_closest
walk_on(const mr_mesh *m, const mr_topology *topo, mr_closest near, mr_v3 q)
{
	for (;;) {
		mr_closest next = near;
		int corner = corner_of(near), side = corner < 0 ? side_of(near) : -1;
		if (corner >= 0) {
			next = nearest_around(m, topo, m->t[near.at.face].v[corner], q);
		} else if (side >= 0) {
			uint32_t g = topo->twin[3 * near.at.face + (uint32_t)side];
			if (g != MR_NONE)
				next = mr_face_closest(m, g / 3, q);
		}
		if (!(next.dist2 < near.dist2))
			return near;
		near = next;
	}
}

mr_closest
mr_project_walk(const mr_mesh *m, const mr_topology *topo, uint32_t f, mr_v3 q)
{
	return walk_on(m, topo, mr_face_closest(m, f, q), q);
}

mr_closest
mr_project_walk_around(const mr_mesh *m, const mr_topology *topo, uint32_t f, mr_v3 q)
{
	mr_closest best = { .dist2 = INFINITY };

	for (int k = 0; k < 3; k++) {
		mr_closest near = nearest_around(m, topo, m->t[f].v[k], q);
		if (near.dist2 < best.dist2)
			best = near;
	}
	return walk_on(m, topo, best, q);
}

/* The other curve half-edge at vertex v than the edge of h; MR_NONE where not exactly two curve edges meet.
 */
static uint32_t
other_curve(const mr_topology *topo, const uint32_t *curve, uint32_t v, uint32_t h)
{
	uint32_t e = topo->out[v], found = MR_NONE;
	unsigned n = 0;

	do {
		uint32_t p = mr_he_prev(e);
		if (curve[e] != MR_NONE) {
			n++;
			if (e != h && topo->twin[e] != h)
				found = e;
		}
		if (topo->twin[p] == MR_NONE) { /* the boundary edge that ends here */
			n++;
			if (p != h)
				found = p;
		}
		e = topo->twin[p];
	} while (e != MR_NONE && e != topo->out[v]);
	return n == 2 ? found : MR_NONE;
}

mr_closest
mr_project_curve(
    const mr_mesh *m, const mr_topology *topo, const uint32_t *curve, uint32_t h, mr_v3 q, uint32_t *on)
{
	mr_closest near = mr_side_closest(m, h, q);

	for (;;) {
		int corner = corner_of(near);
		uint32_t next = corner < 0 ? MR_NONE
		                           : other_curve(topo, curve, m->t[near.at.face].v[corner], h);
		mr_closest p;
		if (next == MR_NONE)
			break;
		p = mr_side_closest(m, next, q);
		if (!(p.dist2 < near.dist2))
			break;
		near = p;
		h = next;
	}
	*on = h;
	return near;
}
