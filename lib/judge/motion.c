/* What a motion did to a surface. */
#include "judge/judge.h"
#include "space/contact.h"

void
mr_motion_found(mr_ctx *ctx, const mr_motion *m, mr_finding f, uint32_t vertex)
{
	f.layer = m->then->name;
	f.placed = vertex != MR_NONE;
	f.vertex = vertex;
	if (f.placed)
		f.at = m->now[vertex];
	mr_found(ctx, &f);
}

static size_t
at_most(size_t a, size_t b)
{
	return a < b ? a : b;
}

void
mr_judge_harm(mr_ctx *ctx, const mr_motion *m)
{
	enum { FOLDS = 5, PAIRS = 20 }; /* fewer say nothing, but of few faces */
	size_t nf = m->then->nf;
	mr_harm h;

	mr_harm_find(ctx, m, &h);
	if (h.folds > at_most(FOLDS, nf / 12))
		mr_motion_found(
		    ctx, m, (mr_finding){ .kind = MR_FOLDED, .count = h.folds, .of = 3 * nf / 2 }, h.vertex);
	if (h.pairs > at_most(PAIRS, nf / 5))
		mr_motion_found(
		    ctx, m, (mr_finding){ .kind = MR_CROSSING, .count = h.pairs, .of = nf }, h.vertex);
	if (h.far > PAIRS)
		mr_motion_found(
		    ctx, m, (mr_finding){ .kind = MR_COLLIDED, .count = h.far, .of = nf }, h.far_vertex);
}

void
mr_judge_contacts(mr_ctx *ctx, const mr_motion *m, bool *closed)
{
	const double touch = 0.003, apart = 0.005; /* of the diagonal */
	mr_contacts contacts;
	uint32_t widest;
	size_t n;

	mr_contacts_find(ctx, m->then, touch * m->diagonal, &contacts);
	*closed = contacts.closed;
	if (!contacts.vertices)
		return;
	n = mr_contacts_open(&contacts, m->then, m->now, apart * m->diagonal, &widest);
	if (n)
		mr_motion_found(
		    ctx, m, (mr_finding){ .kind = MR_APART, .count = n, .of = contacts.vertices }, widest);
}
