/* Compares normals with pseudonormals: Baerentzen, Aanaes 2005: Signed distance computation using the angle
 * weighted pseudonormal. */
#include "remesh/orientation.h"

static const double SNAP = 1e-9; /* of a barycentric coordinate: on an edge or vertex */

/* The sum of the unit normals of the faces around v, by angle. */
static mr_v3
vertex_normal(const mr_facing *s, uint32_t v)
{
	uint32_t h = s->topo->out[v];
	mr_v3 sum = { 0, 0, 0 };

	do {
		const mr_v3 *p = s->m->p;
		mr_v3 b = mr_sub(p[mr_he_to(s->m, h)], p[v]),
		      c = mr_sub(p[mr_he_from(s->m, mr_he_prev(h))], p[v]);
		sum = mr_axpy(mr_angle(b, c), mr_unit(mr_face_cross(s->m, h / 3)), sum);
		h = mr_he_ccw(s->topo, h);
	} while (h != MR_NONE && h != s->topo->out[v]);
	return sum;
}

mr_v3
mr_facing_normal(const mr_facing *s, mr_place at)
{
	const double w[3] = { at.bary.x, at.bary.y, at.bary.z };
	uint32_t face = at.face;
	mr_v3 n = mr_unit(mr_face_cross(s->m, face));

	for (uint32_t k = 0; k < 3; k++)
		if (w[k] >= 1 - SNAP)
			return vertex_normal(s, s->m->t[face].v[k]);
	for (uint32_t k = 0; k < 3; k++) {
		uint32_t twin = s->topo->twin[3 * face + (k + 1) % 3]; /* opposite corner k */
		if (w[k] <= SNAP && twin != MR_NONE)
			return mr_add(n, mr_unit(mr_face_cross(s->m, twin / 3)));
	}
	return n;
}

size_t
mr_count_flipped(const mr_facing *s, const mr_mesh *m, const mr_places *map)
{
	size_t flipped = 0;

	for (size_t f = 0; f < m->nf; f++) {
		mr_v3 cross = mr_face_cross(m, f);
		unsigned against = 0;
		for (int k = 0; k < 3 && against == (unsigned)k; k++) {
			uint32_t v = m->t[f].v[k];
			against += mr_dot(cross, mr_facing_normal(s, mr_places_at(map, v))) < 0;
		}
		flipped += against == 3;
	}
	return flipped;
}
