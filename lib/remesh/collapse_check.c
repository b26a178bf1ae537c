/* A merge is tried on the faces around: none may fold, turn from the source, or leave the plane. */
#include "remesh/collapse_check.h"

/* The half-edge of the neighbour over h once a and b are one: beyond a face that goes. */
static uint32_t
beyond(const mr_dyn *d, uint32_t h, uint32_t a, uint32_t b)
{
	uint32_t g = d->twin[h];

	if (g == MR_NONE)
		return g;
	for (uint32_t e = g, k = 0; k < 3; k++, e = mr_he_next(e))
		if ((d->v[e] == a && mr_dyn_to(d, e) == b) || (d->v[e] == b && mr_dyn_to(d, e) == a))
			return d->twin[mr_he_next(g) == e ? mr_he_prev(g) : mr_he_next(g)];
	return g;
}

/* The cross product of face f once a and b are one, at p. */
static mr_v3
cross_after(const mr_dyn *d, uint32_t f, uint32_t a, uint32_t b, mr_v3 p)
{
	mr_v3 q[3];

	for (uint32_t k = 0; k < 3; k++) {
		uint32_t v = d->v[3 * f + k];
		q[k] = v == a || v == b ? p : d->p[v];
	}
	return mr_cross(mr_sub(q[1], q[0]), mr_sub(q[2], q[0]));
}

/* The same of the faces around a alone. */
static bool
folds_around(const mr_dyn *d, const mr_remesh_source *s, uint32_t a, uint32_t b, mr_v3 p)
{
	uint32_t h = d->out[a];

	do {
		uint32_t f = h / 3;
		if (mr_dyn_to(d, h) != b && mr_dyn_apex(d, h) != b) {
			mr_v3 n = cross_after(d, f, a, b, p);
			if (mr_remesh_against(s, d, d->at, &d->v[3 * f], n) &&
			    !mr_remesh_against(s, d, d->at, &d->v[3 * f], mr_dyn_cross(d, d->p, f)))
				return true;
			for (uint32_t i = 0, k = mr_he_next(h); i < 2; i++, k = mr_he_next(k)) {
				uint32_t g = beyond(d, k, a, b); /* over the side and the next spoke */
				if (g != MR_NONE &&
				    mr_folds(n, cross_after(d, g / 3, a, b, p), MR_NEAR_FOLD) &&
				    !(d->twin[k] == g && mr_folds(mr_dyn_cross(d, d->p, f),
							     mr_dyn_cross(d, d->p, g / 3), MR_NEAR_FOLD)))
					return true;
			}
		}
		h = mr_dyn_ccw(d, h);
	} while (h != MR_NONE && h != d->out[a]);
	return false;
}

/* True where n is within 75 degrees of an axis: two such normals are no fold, nor near one. */
static bool
near_axis(mr_v3 n, mr_v3 axis, double axis2)
{
	double along = mr_dot(n, axis), half2 = (1 + MR_NEAR_FOLD) / 2; /* squared cosine of half the angle */

	return along > 0 && along * along > half2 * axis2 * mr_norm2(n);
}

/* True where the faces around a, those beyond them, and the source there all look the same way. */
static bool
plain_around(const mr_dyn *d, const mr_remesh_source *s, uint32_t a, uint32_t b, mr_v3 p, mr_v3 axis)
{
	double axis2 = mr_norm2(axis);
	mr_v3 source = mr_face_cross(s->m, mr_dyn_place(d, a));
	uint32_t h = d->out[a];

	do {
		uint32_t g = d->twin[mr_he_next(h)], to = mr_dyn_to(d, h), apex = mr_dyn_apex(d, h);
		if (to != b && apex != b) {
			mr_v3 n = mr_cross(mr_sub(d->p[to], p), mr_sub(d->p[apex], p));
			if (!near_axis(n, axis, axis2) || mr_dot(n, source) < 0)
				return false;
			if (g != MR_NONE && mr_dyn_apex(d, g) != b &&
			    !near_axis(mr_dyn_cross(d, d->p, g / 3), axis, axis2))
				return false;
		}
		h = mr_dyn_ccw(d, h);
	} while (h != MR_NONE && h != d->out[a]);
	return true;
}

bool
mr_merging_folds(const mr_dyn *d, const mr_remesh_source *s, uint32_t a, uint32_t b, mr_v3 p, mr_v3 axis)
{
	if (plain_around(d, s, a, b, p, axis) && plain_around(d, s, b, a, p, axis))
		return false; /* as almost everywhere, told with half the normals */
	return folds_around(d, s, a, b, p) || folds_around(d, s, b, a, p);
}
