/* What a motion did to a surface. */
#include "judge/chord.h"
#include "judge/harm.h"
#include "judge/held.h"
#include "judge/strayed.h"
#include "space/contact.h"
#include "space/enclosed.h"

/* A finding of the surface, at the vertex that has most of it. */
static void
report(mr_ctx *ctx, const mr_motion *m, mr_finding f, uint32_t vertex)
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

	mr_harm_find(ctx, m->then, m->edges, m->now, 0, &h);
	if (h.folds > at_most(FOLDS, nf / 12))
		report(ctx, m, (mr_finding){ .kind = MR_FOLDED, .count = h.folds, .of = m->edges->count },
		    h.vertex);
	if (h.pairs > at_most(PAIRS, nf / 5))
		report(ctx, m, (mr_finding){ .kind = MR_CROSSING, .count = h.pairs, .of = nf }, h.vertex);
	if (h.far > PAIRS)
		report(ctx, m, (mr_finding){ .kind = MR_COLLIDED, .count = h.far, .of = nf }, h.far_vertex);
}

void
mr_judge_contacts(mr_ctx *ctx, const mr_motion *m)
{
	const double touch = 0.003, apart = 0.005; /* of the diagonal */
	mr_contacts contacts;
	uint32_t widest;
	size_t n;

	mr_contacts_find(ctx, m->then, touch * m->diagonal, &contacts);
	n = mr_contacts_open(&contacts, m->then, m->now, apart * m->diagonal, &widest);
	if (n)
		report(ctx, m, (mr_finding){ .kind = MR_APART, .count = n, .of = contacts.vertices }, widest);
}

void
mr_judge_detail(mr_ctx *ctx, const mr_motion *m, const mr_ground *g)
{
	enum { FEW = 5 };
	const double far = 0.01; /* of the diagonal */
	mr_strayed s = mr_strayed_find(m, g);
	mr_chords c;

	if (s.edges > FEW)
		report(ctx, m, (mr_finding){ .kind = MR_TORN, .count = s.edges, .of = m->edges->count },
		    s.vertex);
	mr_chords_find(ctx, m, g, far * m->diagonal, &c);
	if (c.edges)
		report(ctx, m,
		    (mr_finding){ .kind = MR_COARSE,
			.count = c.edges,
			.of = m->edges->count,
			.limit = fmin(c.enough, mr_mesh_edge_scale(ctx, &g->then)) },
		    c.vertex);
}

/* Handles that only turn ask for no other volume. */
static mr_status
judge_volume(mr_ctx *ctx, const mr_motion *m, const mr_held *h)
{
	const double much = 0.1;
	double share;

	MR_TRY(mr_enclosed_share(ctx, m->then, m->now, &share));
	if (share < 0)
		report(ctx, m,
		    (mr_finding){ .kind = MR_VOLUME, .value = share - 1, .what = ": it is inside out" },
		    MR_NONE);
	else if (h->keeps_volume && fabs(share - 1) > much)
		report(ctx, m, (mr_finding){ .kind = MR_VOLUME, .value = share - 1 }, MR_NONE);
	return MR_OK;
}

mr_status
mr_judge_pose(mr_ctx *ctx, const mr_motion *m, const mr_ground *g)
{
	const double off = 0.005; /* of the diagonal */
	size_t missed;
	mr_held h;

	mr_held_count(ctx, m, g, off * m->diagonal, &h);
	missed = h.moved + h.missed + h.unscaled + h.faceless;
	if (missed)
		report(ctx, m,
		    (mr_finding){ .kind = MR_MISSED,
			.count = missed,
			.of = h.fixed + h.handled,
			.what = h.missed + h.moved ? "" : ": what stands on base turns but is not scaled" },
		    MR_NONE);
	return judge_volume(ctx, m, &h);
}
