/* Guarded moves (mesh/guarded_move.h) of a wrap: they fold nothing, and take back what passes through itself.
 */
#include "mesh/guarded_move.h"

#include "space/self_intersect.h"
#include "wrap/parts.h"

/* Height over longest edge of a face that would soon have no normal. */
static const double SLIVER = 0.02;

mr_status
mr_wrap_move(mr_ctx *ctx, mr_v3 *to, mr_dyn *d)
{
	mr_mesh m = mr_dyn_view(d, "control");

	MR_TRY(mr_move_unfolded(ctx, &m, &(mr_topology){ d->twin, d->out }, SLIVER, to));
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
