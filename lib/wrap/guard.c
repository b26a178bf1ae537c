/* Moves of a wrap that fold nothing. */
#include "mesh/guarded_move.h"
#include "wrap/parts.h"

/* Height over longest edge of a face that would soon have no normal. */
static const double SLIVER = 0.02;

typedef struct guard {
	const mr_dyn *d;
	const mr_v3 *to;
} guard;

/* True where the move turns face f by more than 60 degrees, folds it anew against a neighbour, or leaves it a
 * worse sliver. */
static bool
turns(const void *arg, uint32_t f)
{
	const guard *s = arg;
	const mr_dyn *d = s->d;
	const uint32_t *v = &d->v[3 * f];
	const mr_v3 *p = d->p, *q = s->to;
	mr_v3 before = mr_dyn_cross(d, d->p, f), after = mr_dyn_cross(d, s->to, f);

	double shape = mr_dyn_shape(q[v[0]], q[v[1]], q[v[2]]);

	if (shape < SLIVER && shape < mr_dyn_shape(p[v[0]], p[v[1]], p[v[2]]))
		return true;
	if (mr_dot(before, after) <= 0.5 * sqrt(mr_norm2(before) * mr_norm2(after)))
		return true;
	for (size_t h = 3 * f; h < 3 * f + 3; h++) {
		uint32_t g = d->twin[h];
		if (g != MR_NONE && mr_dyn_folds(after, mr_dyn_cross(d, s->to, g / 3)) &&
		    !mr_dyn_folds(before, mr_dyn_cross(d, d->p, g / 3)))
			return true;
	}
	return false;
}

mr_status
mr_wrap_move(mr_ctx *ctx, mr_v3 *to, mr_dyn *d)
{
	guard s = { d, to };
	mr_guard g = mr_dyn_guard(d);

	g.is_bad = turns;
	g.arg = &s;
	MR_TRY(mr_guarded_move(ctx, &g, d->p, to));
	memcpy(d->p, to, d->nv * sizeof *to);
	return MR_OK;
}
