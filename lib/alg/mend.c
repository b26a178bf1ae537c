#include "alg/mend.h"

#include "alg/facing.h"
#include "alg/refine.h"
#include "base/parallel.h"

static const double FOLD = -0.9396926207859084; /* cosine of 160 degrees */
static const double CLOSE = 0.25;               /* squared cosine of 60 degrees */

static const double THIN = 0.02; /* shape that is better than a flaw */

static const double THINNEST = 0.001; /* as the last resort */

enum { PASSES = 5, MOST = 20, NEAR = 64 };

typedef struct mender {
	mr_dyn *d;
	const mr_surface *s;
	mr_facing facing;
	uint8_t *mark; /* for the link condition */
	double least;  /* shape of what is made */
	bool last;     /* resort: slower and sure, tips and boundaries may give way */
} mender;

/* A vertex where it was, to put it back. */
typedef struct spot {
	mr_v3 p;
	uint32_t at;
} spot;

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

static bool
are_folded(const mr_dyn *d, uint32_t f, uint32_t g)
{
	mr_v3 m = mr_dyn_cross(d, d->p, f), n = mr_dyn_cross(d, d->p, g);

	return mr_dot(m, n) < FOLD * sqrt(mr_norm2(m) * mr_norm2(n));
}

static bool
is_folded(const mr_dyn *d, uint32_t h)
{
	return d->twin[h] != MR_NONE && are_folded(d, h / 3, d->twin[h] / 3);
}

/* The normal of the source at the place of v. */
static mr_v3
source_normal(const mender *w, uint32_t v)
{
	mr_closest c = mr_surface_place(w->s, w->d, v, w->d->p[v], mr_dyn_normal_around(w->d, v));

	return mr_facing_normal(&w->facing, c.face, c.bary);
}

static bool
is_flipped(const mender *w, uint32_t f)
{
	const uint32_t *v = &w->d->v[3 * f];
	mr_v3 n = mr_dyn_cross(w->d, w->d->p, f), m = mr_face_cross(w->s->m, mr_dyn_place(w->d, v[0]));
	double mn = mr_dot(m, n);

	if (!w->last && mn > 0 && mn * mn > CLOSE * mr_norm2(m) * mr_norm2(n))
		return false; /* as almost all are, told without a walk */
	return mr_dot(n, source_normal(w, v[0])) < 0 && mr_dot(n, source_normal(w, v[1])) < 0 &&
	       mr_dot(n, source_normal(w, v[2])) < 0;
}

static bool
has(const mr_dyn *d, uint32_t f, uint32_t v)
{
	return v == d->v[3 * f] || v == d->v[3 * f + 1] || v == d->v[3 * f + 2];
}

/* The flipped faces around v, and the folded edges of all faces around it; without what is counted around
 * `but`. */
static unsigned
flaws_around(const mender *w, uint32_t v, uint32_t but)
{
	const mr_dyn *d = w->d;
	uint32_t h = d->out[v];
	unsigned n = 0;

	do {
		uint32_t g = d->twin[h];
		if (!has(d, h / 3, but)) {
			n += is_flipped(w, h / 3);
			n += (g == MR_NONE || !has(d, g / 3, but)) && is_folded(d, h);
			n += is_folded(d, mr_he_next(h));
		}
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
		if (!has(d, h / 3, but))
			worst = fmin(worst, shape_of(d, h / 3));
		h = mr_dyn_ccw(d, h);
	} while (h != MR_NONE && h != d->out[v]);
	return worst;
}

/* Moves v to p, with its place; false, and all is as before, where that leaves as many flaws or makes a
 * needle. */
static bool
try_spot(mender *w, uint32_t v, mr_v3 p, bool project, unsigned flaws)
{
	mr_dyn *d = w->d;
	spot old = spot_of(d, v);
	mr_closest c = mr_surface_place(w->s, d, v, p, mr_dyn_normal_around(d, v));
	double shape = worst_shape(d, v, MR_NONE);

	put(d, v, (spot){ project ? c.point : p, c.face });
	if (worst_shape(d, v, MR_NONE) >= fmin(shape, w->least) && flaws_around(w, v, MR_NONE) < flaws)
		return true;
	put(d, v, old);
	return false;
}

/* Tries places of the surface near v and the middle of its neighbours, then these as they are. */
static bool
mend_towards_middle(mender *w, uint32_t v, unsigned flaws)
{
	const mr_dyn *d = w->d;
	mr_v3 middle = mr_dyn_middle_around(d, v);

	for (int project = 1; project >= 0; project--)
		for (int i = 0; i <= 4; i++)
			if (try_spot(w, v, mr_lerp(0.25 * i, d->p[v], middle), project, flaws))
				return true;
	return false;
}

/* Tries places of the surface on the way to the neighbours. */
static bool
mend_towards_neighbours(mender *w, uint32_t v, unsigned flaws)
{
	const mr_dyn *d = w->d;
	uint32_t h = d->out[v];

	do {
		for (int i = 1; i <= 3; i++)
			if (try_spot(w, v, mr_lerp(0.25 * i, d->p[v], d->p[mr_dyn_to(d, h)]), true, flaws))
				return true;
		h = mr_dyn_ccw(d, h);
	} while (h != MR_NONE && h != d->out[v]);
	return false;
}

/* Adds face f to the n listed, where it is new and there is room. */
static size_t
list_face(uint32_t *list, size_t n, uint32_t f)
{
	for (size_t i = 0; i < n; i++)
		if (list[i] == f)
			return n;
	if (n < NEAR)
		list[n++] = f;
	return n;
}

/* Tries the middles of the faces of the surface near v, the nearest in faces first. */
static bool
mend_over_surface(mender *w, uint32_t v, unsigned flaws)
{
	uint32_t list[NEAR] = { mr_dyn_place(w->d, v) };
	size_t n = 1;

	for (size_t i = 0; i < n; i++) {
		const uint32_t *t = w->s->m->t[list[i]].v;
		const mr_v3 *p = w->s->m->p;
		if (try_spot(w, v, mr_mul(1.0 / 3, mr_add(p[t[0]], mr_add(p[t[1]], p[t[2]]))), true, flaws))
			return true;
		for (uint32_t k = 0; k < 3; k++) {
			uint32_t g = w->s->topo->twin[3 * list[i] + k];
			if (g != MR_NONE)
				n = list_face(list, n, g / 3);
		}
	}
	return false;
}

static bool
mend_vertex(mender *w, uint32_t v)
{
	unsigned flaws = w->d->kind[v] == MR_SMOOTH ? flaws_around(w, v, MR_NONE) : 0;

	return flaws > 0 && (mend_towards_middle(w, v, flaws) || mend_towards_neighbours(w, v, flaws));
}

/* The flaws of the two faces at h and of their edges. */
static unsigned
flaws_beside(const mender *w, uint32_t h)
{
	const mr_dyn *d = w->d;
	uint32_t g = d->twin[h];

	return (unsigned)is_flipped(w, h / 3) + is_flipped(w, g / 3) + is_folded(d, h) +
	       is_folded(d, mr_he_next(h)) + is_folded(d, mr_he_prev(h)) + is_folded(d, mr_he_next(g)) +
	       is_folded(d, mr_he_prev(g));
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
	    flaws_beside(w, g) < flaws)
		return true;
	mr_dyn_flip(d, g);
	return false;
}

/* The flaws of the faces around a and b; where the two are at one spot, as if they were one. */
static unsigned
flaws_of_pair(const mender *w, uint32_t h)
{
	const mr_dyn *d = w->d;
	uint32_t side[2] = { h, d->twin[h] };
	unsigned n = flaws_around(w, d->v[h], MR_NONE) + flaws_around(w, mr_dyn_to(d, h), d->v[h]);

	for (int i = 0; i < 2; i++)
		if (side[i] != MR_NONE) { /* over the face that is none any more */
			uint32_t x = d->twin[mr_he_next(side[i])], y = d->twin[mr_he_prev(side[i])];
			n += x != MR_NONE && y != MR_NONE && are_folded(d, x / 3, y / 3);
		}
	return n;
}

/* Merges the start of h into its end at a share of the way; false where that leaves as many flaws. */
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
		mr_closest c = mr_surface_place(w->s, d, b, mr_lerp(share, old[0].p, old[1].p), normal);
		to = (spot){ c.point, c.face };
	}
	put(d, b, to);
	put(d, a, d->kind[a] == MR_SMOOTH ? (spot){ to.p, mr_dyn_place(d, b) } : to);
	good = fmin(worst_shape(d, a, b), worst_shape(d, b, a)) > fmin(shape, w->least) &&
	       flaws_of_pair(w, h) < flaws;
	put(d, a, old[0]);
	if (good)
		mr_dyn_collapse(d, h, to.p);
	else
		put(d, b, old[1]);
	return good;
}

static bool
mend_by_merging(mender *w, uint32_t h)
{
	mr_dyn *d = w->d;
	unsigned flaws;

	if ((d->kind[d->v[h]] != MR_SMOOTH && !w->last) || !mr_dyn_can_collapse(d, h, w->mark))
		return false;
	flaws = flaws_of_pair(w, h);
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

/* Everything that takes long, around all vertices of f. */
static bool
mend_thoroughly(mender *w, uint32_t f)
{
	const mr_dyn *d = w->d;

	for (uint32_t i = 3 * f; i < 3 * f + 3; i++) {
		uint32_t v = d->v[i], h = d->out[v];
		do {
			uint32_t u = mr_dyn_to(d, h);
			unsigned flaws = d->kind[u] == MR_SMOOTH ? flaws_around(w, u, MR_NONE) : 0;
			if ((flaws > 0 && mend_over_surface(w, u, flaws)) || mend_ring(w, u))
				return true;
			h = mr_dyn_ccw(d, h);
		} while (h != MR_NONE && h != d->out[v]);
	}
	return false;
}

/* Unpins a tip: a corner that no curve meets. */
static void
release_tip(mr_dyn *d, uint32_t v)
{
	uint32_t h = d->out[v];

	if (d->kind[v] != MR_CORNER || mr_dyn_on_boundary(d, v))
		return;
	do {
		if (mr_dyn_on_curve(d, h))
			return;
		h = mr_dyn_ccw(d, h);
	} while (h != d->out[v]);
	d->at[v] = mr_dyn_place(d, v);
	d->kind[v] = MR_SMOOTH;
}

static bool
mend_face(mender *w, uint32_t f)
{
	const mr_dyn *d = w->d;

	for (uint32_t h = 3 * f; w->last && h < 3 * f + 3; h++)
		release_tip(w->d, d->v[h]);
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
	return w->last && mend_thoroughly(w, f);
}

static bool
has_flaw(const mender *w, uint32_t f)
{
	const mr_dyn *d = w->d;

	return !mr_dyn_face_dead(d, f) && (is_flipped(w, f) || is_folded(d, 3 * f) ||
					      is_folded(d, 3 * f + 1) || is_folded(d, 3 * f + 2));
}

/* The flaws of face f, those of its edges with lower half-edges: a quick look at what seldom has any. */
static double
own_flaws(void *arg, size_t f)
{
	const mender *w = arg;
	const mr_dyn *d = w->d;
	mr_v3 n;
	double flaws;

	if (mr_dyn_face_dead(d, f))
		return 0;
	n = mr_dyn_cross(d, d->p, f);
	flaws = is_flipped(w, (uint32_t)f);
	for (uint32_t h = (uint32_t)(3 * f); h < 3 * f + 3; h++) {
		uint32_t g = d->twin[h];
		if (g != MR_NONE && h < g && mr_dot(n, mr_dyn_cross(d, d->p, g / 3)) < 0)
			flaws += is_folded(d, h);
	}
	return flaws;
}

mr_status
mr_mend_flaws(mr_ctx *ctx, mr_dyn *d, const mr_surface *s, bool last)
{
	mr_mark mark = mr_mark_take(ctx);
	mender w = { d, s, { s->m, s->topo }, NULL, MR_NEEDLE, last };
	bool flawed = true, mended = true;

	if (mr_parallel_sum(ctx, d->nf, own_flaws, &w) == 0)
		return MR_OK;
	w.mark = MR_NEW_ZERO(ctx, d->nv, uint8_t);
	if (!w.mark)
		return MR_EMEM;
	for (int i = 0; i < MOST && flawed && (mended || i <= (last ? 2 : 1) * PASSES); i++) {
		flawed = mended = false;
		w.least = i < PASSES ? MR_NEEDLE : last && i >= 2 * PASSES ? THINNEST : THIN;
		for (uint32_t f = 0; f < d->nf; f++)
			if (has_flaw(&w, f)) {
				flawed = true;
				mended |= mend_face(&w, f);
			}
	}
	mr_mark_release(ctx, mark);
	return MR_OK;
}

bool
mr_refine_flaws(mr_dyn *d, const mr_surface *s)
{
	const mender w = { d, s, { s->m, s->topo }, NULL, 0, true };
	bool flawed = false;

	for (uint32_t f = 0; f < d->nf; f++)
		if (has_flaw(&w, f)) {
			flawed = true;
			for (uint32_t h = 3 * f; h < 3 * f + 3; h++)
				mr_refine_vertex(d, d->v[h]);
		}
	return flawed;
}
