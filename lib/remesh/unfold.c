/* Umbrella smoothing (Kobbelt, Campagna, Vorsatz, Seidel 1998) of the vertices at folds alone, one by one;
 * vertices that must not move stay, so that nothing has to be taken back. */
#include "remesh/unfold.h"

enum { MOST = 10 };

static bool
makes_a_needle(const mr_dyn *d, uint32_t v, mr_v3 p)
{
	uint32_t h = d->out[v];

	do {
		mr_v3 b = d->p[mr_dyn_to(d, h)], c = d->p[mr_dyn_apex(d, h)];
		if (mr_dyn_shape(p, b, c) < MR_NEEDLE)
			return true;
		h = mr_dyn_ccw(d, h);
	} while (h != d->out[v]);
	return false;
}

/* Half of the way to the middle of the neighbours. */
static void
draw_in(mr_dyn *d, uint32_t v)
{
	mr_v3 p;

	if (d->kind[v] != MR_SMOOTH)
		return;
	p = mr_lerp(0.5, d->p[v], mr_dyn_middle_around(d, v));
	if (!makes_a_needle(d, v, p))
		d->p[v] = p;
}

void
mr_unfold(mr_dyn *d)
{
	bool folded = true;

	for (int i = 0; i < MOST && folded; i++) {
		folded = false;
		for (uint32_t h = 0; h < 3 * d->nf; h++) {
			if (mr_dyn_face_dead(d, h / 3) || h > d->twin[h] || !mr_dyn_folds(d, h, MR_NEAR_FOLD))
				continue;
			folded = true;
			draw_in(d, d->v[h]);
			draw_in(d, mr_dyn_to(d, h));
			draw_in(d, mr_dyn_apex(d, h));
			draw_in(d, mr_dyn_apex(d, d->twin[h]));
		}
	}
}
