/* A guarded move (mesh/guarded_move.h) of a wrap that folds nothing. */
#include "mesh/guarded_move.h"
#include "wrap/parts.h"

/*
 * Cosine of 60 degrees, by which a face may turn at once.  At 37 or 90 degrees as many wraps of 133 clouds
 * are sound, at distances that differ by 1 %; but at 90 one around a handful of points folds in on itself and
 * ends a tenth of its size off them.
 */
static const double TURN = 0.5;

/* Height over longest edge of a face that would soon have no normal.  Without it one of 68 wraps that have
 * passed through themselves does not come apart; a quarter to five times as much leaves as many. */
static const double SLIVER = 0.02;

typedef struct guard {
	const mr_dyn *d;
	mr_mesh from, to;
} guard;

static double
shape_of(const mr_mesh *m, uint32_t f)
{
	const uint32_t *v = m->t[f].v;

	return mr_dyn_shape(m->p[v[0]], m->p[v[1]], m->p[v[2]]);
}

/* True where the move turns face f too far, closes it against a neighbour, or leaves it a worse
 * sliver. */
static bool
is_bad(const void *arg, uint32_t f)
{
	const guard *s = arg;
	mr_v3 before = mr_face_cross(&s->from, f), after = mr_face_cross(&s->to, f);
	double shape = shape_of(&s->to, f);

	return (shape < SLIVER && shape < shape_of(&s->from, f)) ||
	       mr_dot(before, after) <= TURN * sqrt(mr_norm2(before) * mr_norm2(after)) ||
	       mr_folds_more(&s->from, &s->to, s->d->twin, f, MR_NEAR_FOLD);
}

mr_status
mr_wrap_move(mr_ctx *ctx, mr_v3 *to, mr_dyn *d)
{
	guard s = { d, mr_dyn_view(d, "control"), mr_dyn_view(d, "control") };
	mr_guard g = mr_dyn_guard(d);

	s.to.p = to;
	g.is_bad = is_bad;
	g.arg = &s;
	MR_TRY(mr_guarded_move(ctx, &g, d->p, to));
	memcpy(d->p, to, d->nv * sizeof *to);
	return MR_OK;
}
