/* Guarded moves (mesh/guarded_move.h) of a wrap: they fold nothing, and take back what passes through itself.
 */
#include "mesh/guarded_move.h"

#include "space/self_intersect.h"
#include "wrap/parts.h"

/* Cosine of 60 degrees, by which a face may turn at once: at 90 a wrap of a handful of points folds in on
 * itself. */
static const double TURN = 0.5;

/* Height over longest edge of a face that would soon have no normal. */
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
turns(const void *arg, uint32_t f)
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
	g.is_bad = turns;
	g.arg = &s;
	MR_TRY(mr_guarded_move(ctx, &g, d->p, to));
	memcpy(d->p, to, d->nv * sizeof *to);
	return MR_OK;
}

typedef struct crossing {
	const mr_dyn *d;
	bool *crosses; /* each face */
} crossing;

static mr_status
find_crossings(mr_ctx *ctx, void *arg)
{
	const crossing *w = arg;
	mr_mesh m = mr_dyn_view(w->d, "control");
	size_t count;

	mr_self_intersections(ctx, NULL, &m, w->crosses, &count);
	return MR_OK;
}

static bool
crosses(const void *arg, uint32_t f)
{
	return ((const crossing *)arg)->crosses[f];
}

/* Without the ring sheets of which one has settled into the next are left with folds. */
mr_status
mr_wrap_part(mr_ctx *ctx, const mr_v3 *home, mr_dyn *d)
{
	mr_mark mark = mr_mark_take(ctx);
	crossing w = { d, MR_NEW(ctx, d->nf, bool) };
	mr_guard g = mr_dyn_guard(d);

	g.halves = 2;
	g.rings = 1;
	g.look = find_crossings;
	g.is_bad = crosses;
	g.arg = &w;
	MR_TRY(mr_guarded_move(ctx, &g, home, d->p));
	mr_mark_release(ctx, mark);
	return MR_OK;
}
