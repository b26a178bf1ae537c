/* A search: around each flaw places, flips and merges are tried one after the other, and the first that
 * leaves fewer flaws stays. */
#include "remesh/flaws.h"

#include "base/parallel.h"

/* Shapes that are better than a flaw, in the order in which they are tried. */
static const double least[] = { MR_NEEDLE, 0.02, 0.001 };

enum { STAGES = 3, PASSES = 8 };

typedef struct mender {
	mr_dyn *d;
	const mr_remesh_source *s;
	uint8_t *mark; /* for the link condition */
	bool *asked;   /* faces that may be flawed: the others were not, and nothing near them has changed */
	double least;  /* shape of new faces */
	size_t left;   /* faces that may still be tried */
	bool last;     /* resort: tips give way, and a merge may leave as many flaws on fewer faces */
} mender;

/* Present, former and permitted places of a vertex. */
typedef struct spot {
	mr_v3 p;
	uint32_t at;
} spot;

static bool
is_flipped(const mr_dyn *d, const mr_remesh_source *s, uint32_t f)
{
	return mr_remesh_against(s, d, d->at, &d->v[3 * f], mr_dyn_cross(d, d->p, f));
}

static double
flipped_term(void *arg, size_t f)
{
	const mender *w = arg;

	return !mr_dyn_face_dead(w->d, f) && is_flipped(w->d, w->s, (uint32_t)f);
}

static double
folded_term(void *arg, size_t f)
{
	const mr_dyn *d = ((const mender *)arg)->d;
	double n = 0;

	for (uint32_t h = 3 * (uint32_t)f; h < 3 * f + 3 && !mr_dyn_face_dead(d, f); h++)
		n += h < d->twin[h] && mr_dyn_folds(d, h, MR_FOLD);
	return n;
}

mr_flaws
mr_flaws_count(mr_ctx *ctx, const mr_dyn *d, const mr_remesh_source *s)
{
	mender w = { .d = (mr_dyn *)(uintptr_t)d, .s = s };

	return (mr_flaws){ (size_t)mr_parallel_sum(ctx, d->nf, flipped_term, &w),
		(size_t)mr_parallel_sum(ctx, d->nf, folded_term, &w) };
}

static bool
is_flawed(const mender *w, uint32_t f)
{
	const mr_dyn *d = w->d;

	return !mr_dyn_face_dead(d, f) &&
	       (mr_dyn_folds(d, 3 * f, MR_FOLD) || mr_dyn_folds(d, 3 * f + 1, MR_FOLD) ||
		   mr_dyn_folds(d, 3 * f + 2, MR_FOLD) || is_flipped(d, w->s, f));
}

static void
ask_body(void *arg, size_t begin, size_t end)
{
	const mender *w = arg;

	for (size_t f = begin; f < end; f++)
		w->asked[f] = is_flawed(w, (uint32_t)f);
}

/* v has changed: asks for the faces around it and those beside them. */
static void
ask_around(mender *w, uint32_t v)
{
	const mr_dyn *d = w->d;
	uint32_t h = d->out[v];

	do {
		uint32_t across = d->twin[mr_he_next(h)];
		w->asked[h / 3] = true;
		if (across != MR_NONE)
			w->asked[across / 3] = true;
		h = mr_dyn_ccw(d, h);
	} while (h != MR_NONE && h != d->out[v]);
}

/* The flipped faces around v and the folded edges of all these. */
static unsigned
flaws_around(const mender *w, uint32_t v)
{
	const mr_dyn *d = w->d;
	uint32_t h = d->out[v];
	unsigned n = 0;

	do {
		n += (unsigned)is_flipped(d, w->s, h / 3) + mr_dyn_folds(d, h, MR_FOLD) +
		     mr_dyn_folds(d, mr_he_next(h), MR_FOLD);
		h = mr_dyn_ccw(d, h);
	} while (h != MR_NONE && h != d->out[v]);
	return n;
}

static double
shape_of(const mr_dyn *d, uint32_t f)
{
	const uint32_t *t = &d->v[3 * f];

	return mr_dyn_shape(d->p[t[0]], d->p[t[1]], d->p[t[2]]);
}

/* The worst shape of the faces around v, but for those with `but`. */
static double
worst_shape(const mr_dyn *d, uint32_t v, uint32_t but)
{
	uint32_t h = d->out[v];
	double worst = 1;

	do {
		if (!mr_dyn_has(d, h / 3, but))
			worst = fmin(worst, shape_of(d, h / 3));
		h = mr_dyn_ccw(d, h);
	} while (h != MR_NONE && h != d->out[v]);
	return worst;
}

static spot
spot_of(const mr_dyn *d, uint32_t v)
{
	return (spot){ d->p[v], d->at[v] };
}

static void
put(mr_dyn *d, uint32_t v, spot to)
{
	d->p[v] = to.p;
	d->at[v] = to.at;
}

/* Moves v to p, with its place; false, and all is as before, where that leaves as many flaws or makes a
 * needle. */
static bool
try_spot(mender *w, uint32_t v, mr_v3 p, bool project, unsigned flaws)
{
	mr_dyn *d = w->d;
	spot old = spot_of(d, v);
	mr_closest c = mr_remesh_place(w->s, d, v, p, mr_dyn_normal_around(d, v));
	double shape = worst_shape(d, v, MR_NONE);

	put(d, v, (spot){ project ? c.point : p, c.at.face });
	if (worst_shape(d, v, MR_NONE) >= fmin(shape, w->least) && flaws_around(w, v) < flaws) {
		ask_around(w, v);
		return true;
	}
	put(d, v, old);
	return false;
}

/* Tries places of the surface near v and the middle of its neighbours, then these as they are. */
static bool
mend_vertex(mender *w, uint32_t v)
{
	const mr_dyn *d = w->d;
	unsigned flaws = d->kind[v] == MR_SMOOTH ? flaws_around(w, v) : 0;
	mr_v3 middle = mr_dyn_middle_around(d, v);

	for (int project = 1; project >= 0 && flaws > 0; project--)
		for (int i = 0; i <= 4; i++)
			if (try_spot(w, v, mr_lerp(0.25 * i, d->p[v], middle), project, flaws))
				return true;
	return false;
}

/* Counts the two faces at h, around their four corners. */
static unsigned
flaws_beside(const mender *w, uint32_t h)
{
	const mr_dyn *d = w->d;

	return flaws_around(w, d->v[h]) + flaws_around(w, mr_dyn_to(d, h)) +
	       flaws_around(w, mr_dyn_apex(d, h)) + flaws_around(w, mr_dyn_apex(d, d->twin[h]));
}

static bool
mend_edge(mender *w, uint32_t h)
{
	mr_dyn *d = w->d;
	unsigned flaws;
	uint32_t g;

	if (!mr_dyn_can_flip(d, h))
		return false;
	flaws = flaws_beside(w, h);
	mr_dyn_flip(d, h);
	g = mr_he_next(h); /* the edge that it made */
	if (shape_of(d, g / 3) > w->least && shape_of(d, d->twin[g] / 3) > w->least &&
	    flaws_beside(w, g) < flaws) {
		ask_around(w, d->v[g]);
		ask_around(w, mr_dyn_to(d, g));
		return true;
	}
	w->asked[g / 3] = w->asked[d->twin[g] / 3] = true; /* back, each has the other's number */
	mr_dyn_flip(d, g);
	return false;
}

/* Merges the start of h into its end at a share of the way; false where that leaves `flaws` or more.  It is
 * tried with both at one spot, where the faces between them have no area and no flaw. */
static bool
try_merge(mender *w, uint32_t h, double share, unsigned flaws)
{
	mr_dyn *d = w->d;
	uint32_t a = d->v[h], b = mr_dyn_to(d, h);
	spot old[2] = { spot_of(d, a), spot_of(d, b) }, to = old[1];
	double shape = fmin(worst_shape(d, a, MR_NONE), worst_shape(d, b, MR_NONE));
	bool good;

	if (d->kind[b] == MR_SMOOTH) {
		mr_v3 normal = mr_add(mr_dyn_normal_around(d, a), mr_dyn_normal_around(d, b));
		mr_closest c = mr_remesh_place(w->s, d, b, mr_lerp(share, old[0].p, old[1].p), normal);
		to = (spot){ c.point, c.at.face };
	}
	put(d, b, to);
	put(d, a, d->kind[a] == MR_SMOOTH ? (spot){ to.p, mr_dyn_place(d, b) } : (spot){ to.p, old[0].at });
	good = fmin(worst_shape(d, a, b), worst_shape(d, b, a)) > fmin(shape, w->least) &&
	       flaws_around(w, a) + flaws_around(w, b) < flaws;
	put(d, a, old[0]);
	if (good) {
		mr_dyn_collapse(d, h, to.p);
		ask_around(w, b);
	} else {
		put(d, b, old[1]);
	}
	return good;
}

static bool
mend_by_merging(mender *w, uint32_t h)
{
	mr_dyn *d = w->d;
	unsigned flaws;

	if ((d->kind[d->v[h]] != MR_SMOOTH && !w->last) || !mr_dyn_can_collapse(d, h, w->mark))
		return false;
	flaws = flaws_around(w, d->v[h]) + flaws_around(w, mr_dyn_to(d, h)) + w->last;
	for (int i = 2; i >= 0; i--)
		if (try_merge(w, h, 0.5 * i, flaws))
			return true;
	return false;
}

/* Merges v with one of its neighbours. */
static bool
mend_ring(mender *w, uint32_t v)
{
	const mr_dyn *d = w->d;
	uint32_t h = d->out[v];

	do {
		if (mend_by_merging(w, h) || (d->twin[h] != MR_NONE && mend_by_merging(w, d->twin[h])))
			return true;
		h = mr_dyn_ccw(d, h);
	} while (h != MR_NONE && h != d->out[v]);
	return false;
}

/* Unpins a tip: a corner that no curve meets. */
static void
release_tip(mr_dyn *d, uint32_t v)
{
	uint32_t end[2];

	if (d->kind[v] != MR_CORNER || mr_dyn_along(d, v, end) > 0)
		return;
	d->at[v] = mr_dyn_place(d, v);
	d->kind[v] = MR_SMOOTH;
}

static bool
mend_face(mender *w, uint32_t f)
{
	mr_dyn *d = w->d;

	for (uint32_t h = 3 * f; w->last && h < 3 * f + 3; h++)
		release_tip(d, d->v[h]);
	for (uint32_t h = 3 * f; h < 3 * f + 3; h++)
		if (mend_vertex(w, d->v[h]))
			return true;
	for (uint32_t h = 3 * f; h < 3 * f + 3; h++)
		if (mend_edge(w, h))
			return true;
	for (uint32_t h = 3 * f; h < 3 * f + 3; h++)
		if (d->twin[h] != MR_NONE && mend_vertex(w, mr_dyn_apex(d, d->twin[h])))
			return true;
	for (uint32_t h = 3 * f; h < 3 * f + 3; h++)
		if (mend_ring(w, d->v[h]))
			return true;
	return false;
}

static bool
mend_all(mender *w)
{
	bool mended = false;

	for (uint32_t f = 0; f < w->d->nf && w->left > 0; f++)
		if (w->asked[f] && (w->asked[f] = is_flawed(w, f))) {
			w->left--;
			mended |= mend_face(w, f);
		}
	return mended;
}

/*
 * Few faces are tried: real models have less than one flawed in 400.  The tip of a spike, thinner than its
 * edges all the way, has half of all flawed and would take minutes, in vain.
 */
void
mr_mend_flaws(mr_ctx *ctx, mr_dyn *d, const mr_remesh_source *s)
{
	mr_mark mark = mr_mark_take(ctx);
	mender w = { .d = d,
		.s = s,
		.mark = MR_NEW_ZERO(ctx, d->nv, uint8_t),
		.asked = MR_NEW(ctx, d->nf, bool),
		.left = 1000 + d->nf / 16 };

	mr_parallel(ctx, d->nf, 4096, ask_body, &w);
	for (int stage = 0; stage < STAGES; stage++) {
		w.least = least[stage];
		w.last = stage == STAGES - 1;
		for (int i = 0; i < PASSES && mend_all(&w); i++)
			;
	}
	mr_mark_release(ctx, mark);
}
