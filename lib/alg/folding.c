#include "alg/folding.h"

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
folds_around(const mr_dyn *d, const mr_surface *s, uint32_t a, uint32_t b, mr_v3 p)
{
	uint32_t h = d->out[a];

	do {
		uint32_t f = h / 3;
		if (mr_dyn_to(d, h) != b && mr_dyn_apex(d, h) != b) {
			mr_v3 n = cross_after(d, f, a, b, p);
			if (mr_surface_against(s, d, d->at, &d->v[3 * f], n) &&
			    !mr_surface_against(s, d, d->at, &d->v[3 * f], mr_dyn_cross(d, d->p, f)))
				return true;
			for (uint32_t i = 0, k = mr_he_next(h); i < 2; i++, k = mr_he_next(k)) {
				uint32_t g = beyond(d, k, a, b); /* over the side and the next spoke */
				if (g != MR_NONE && mr_dyn_folds(n, cross_after(d, g / 3, a, b, p)) &&
				    !(d->twin[k] == g &&
					mr_dyn_folds(mr_dyn_cross(d, d->p, f), mr_dyn_cross(d, d->p, g / 3))))
					return true;
			}
		}
		h = mr_dyn_ccw(d, h);
	} while (h != MR_NONE && h != d->out[a]);
	return false;
}

bool
mr_merging_folds(const mr_dyn *d, const mr_surface *s, uint32_t a, uint32_t b, mr_v3 p)
{
	return folds_around(d, s, a, b, p) || folds_around(d, s, b, a, p);
}
