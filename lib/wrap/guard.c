/* Moves that fold nothing: vertices that would turn a face stay. */
#include "wrap/parts.h"
#include "base/parallel.h"

enum { GRAIN = 2048 };

/* Height over longest edge of a face that would soon have no normal. */
static const double SLIVER = 0.02;

typedef struct guard {
	mr_dyn *d;
	mr_v3 *to;
	uint8_t *turned; /* of each face */
} guard;

/* True where the move turns face f by more than 60 degrees, folds it anew against a neighbour, or leaves it a
 * worse sliver. */
static bool
turns(const guard *s, size_t f)
{
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

static void
turned_body(void *arg, size_t begin, size_t end)
{
	guard *s = arg;

	for (size_t f = begin; f < end; f++)
		s->turned[f] = !mr_dyn_face_dead(s->d, f) && turns(s, f);
}

/* Puts v back; the faces around it that turn because of that go onto the stack. */
static size_t
put_back(guard *s, uint32_t v, uint32_t *stack, size_t n)
{
	const mr_dyn *d = s->d;
	uint32_t h = d->out[v];

	if (memcmp(&s->to[v], &d->p[v], sizeof *s->to) == 0)
		return n;
	s->to[v] = d->p[v];
	do {
		if (!s->turned[h / 3] && turns(s, h / 3)) {
			s->turned[h / 3] = 1;
			stack[n++] = h / 3;
		}
		h = mr_dyn_ccw(d, h);
	} while (h != MR_NONE && h != d->out[v]);
	return n;
}

static void
hold_back(guard *s, uint32_t *stack)
{
	size_t n = 0;

	for (uint32_t f = 0; f < s->d->nf; f++)
		if (s->turned[f])
			stack[n++] = f;
	while (n > 0) {
		uint32_t f = stack[--n];
		for (uint32_t i = 0; i < 3; i++)
			n = put_back(s, s->d->v[3 * f + i], stack, n);
	}
}

mr_status
mr_wrap_move(mr_ctx *ctx, mr_v3 *to, mr_dyn *d)
{
	mr_mark mark = mr_mark_take(ctx);
	uint32_t *stack = MR_NEW(ctx, d->nf, uint32_t);
	guard s = { d, to, MR_NEW(ctx, d->nf, uint8_t) };

	if (!stack || !s.turned)
		return MR_EMEM;
	mr_parallel(ctx, d->nf, GRAIN, turned_body, &s);
	hold_back(&s, stack);
	memcpy(d->p, to, d->nv * sizeof *to);
	mr_mark_release(ctx, mark);
	return MR_OK;
}
