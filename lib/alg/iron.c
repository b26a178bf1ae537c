#include "alg/iron.h"

#include "alg/facing.h"

static const double FOLD = -0.9396926207859084; /* cosine of 160 degrees */

static const double CLOSE = 0.25; /* squared cosine of 60 degrees */

enum { MOST = 10 };

static bool
is_folded(const mr_dyn *d, uint32_t h)
{
	uint32_t g = d->twin[h];
	mr_v3 m, n;

	if (g == MR_NONE)
		return false;
	m = mr_dyn_cross(d, d->p, h / 3);
	n = mr_dyn_cross(d, d->p, g / 3);
	return mr_dot(m, n) < FOLD * sqrt(mr_norm2(m) * mr_norm2(n));
}

static mr_v3
middle_of_neighbours(const mr_dyn *d, uint32_t v)
{
	uint32_t h = d->out[v];
	mr_v3 sum = { 0, 0, 0 };
	double n = 0;

	do {
		sum = mr_add(sum, d->p[mr_dyn_to(d, h)]);
		n++;
		h = mr_dyn_ccw(d, h);
	} while (h != d->out[v]);
	return mr_mul(1 / n, sum);
}

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

static bool
is_on_curve(const mr_dyn *d, uint32_t v)
{
	uint32_t h = d->out[v];

	do {
		if (mr_dyn_on_curve(d, h) || mr_dyn_on_curve(d, mr_he_prev(h)))
			return true;
		h = mr_dyn_ccw(d, h);
	} while (h != MR_NONE && h != d->out[v]);
	return false;
}

/* Half of the way to the middle of the neighbours. */
static void
draw_in(mr_dyn *d, uint32_t v, bool tips)
{
	mr_v3 p;

	if (d->kind[v] != MR_SMOOTH && (!tips || is_on_curve(d, v)))
		return;
	p = mr_lerp(0.5, d->p[v], middle_of_neighbours(d, v));
	if (!makes_a_needle(d, v, p))
		d->p[v] = p;
}

size_t
mr_iron(mr_dyn *d, bool tips)
{
	size_t folds = 1;

	for (int i = 0; i < MOST && folds; i++) {
		folds = 0;
		for (uint32_t h = 0; h < 3 * d->nf; h++) {
			if (mr_dyn_face_dead(d, h / 3) || h > d->twin[h] || !is_folded(d, h))
				continue;
			folds++;
			draw_in(d, d->v[h], tips);
			draw_in(d, mr_dyn_to(d, h), tips);
			draw_in(d, mr_dyn_apex(d, h), tips);
			draw_in(d, mr_dyn_apex(d, d->twin[h]), tips);
		}
	}
	return folds;
}

/* A vertex at its old or at a new place, for comparing. */
typedef struct spot {
	mr_v3 p;
	uint32_t at;
} spot;

typedef struct mender {
	mr_dyn *d;
	const mr_surface *s;
	mr_facing facing;
} mender;

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

	if (mn > 0 && mn * mn > CLOSE * mr_norm2(m) * mr_norm2(n))
		return false; /* as almost all are, told without a walk */
	return mr_dot(n, source_normal(w, v[0])) < 0 && mr_dot(n, source_normal(w, v[1])) < 0 &&
	       mr_dot(n, source_normal(w, v[2])) < 0;
}

/* The flipped faces around v, and the folded edges of all faces around it. */
static unsigned
flaws_around(const mender *w, uint32_t v)
{
	const mr_dyn *d = w->d;
	uint32_t h = d->out[v];
	unsigned n = 0;

	do {
		n += is_flipped(w, h / 3);
		n += is_folded(d, h);
		n += is_folded(d, mr_he_next(h));
		h = mr_dyn_ccw(d, h);
	} while (h != MR_NONE && h != d->out[v]);
	return n;
}

/* Moves v to p, with its place; false, and all is as before, where that leaves as many flaws or makes a
 * needle. */
static bool
try_spot(mender *w, uint32_t v, mr_v3 p, bool project)
{
	mr_dyn *d = w->d;
	spot old = { d->p[v], d->at[v] };
	unsigned flaws = flaws_around(w, v);
	mr_closest c = mr_surface_place(w->s, d, v, p, mr_dyn_normal_around(d, v));

	if (project)
		p = c.point;
	if (flaws == 0 || makes_a_needle(d, v, p))
		return false;
	d->p[v] = p;
	d->at[v] = c.face;
	if (flaws_around(w, v) < flaws)
		return true;
	d->p[v] = old.p;
	d->at[v] = old.at;
	return false;
}

/* The nearest place of the surface, the middle of the neighbours there, or that middle as it is. */
static bool
mend_vertex(mender *w, uint32_t v)
{
	const mr_dyn *d = w->d;
	mr_v3 middle;

	if (d->kind[v] != MR_SMOOTH)
		return false;
	middle = middle_of_neighbours(d, v);
	for (int project = 1; project >= 0; project--)
		for (int i = 0; i <= 4; i++)
			if (try_spot(w, v, mr_lerp(0.25 * i, d->p[v], middle), project))
				return true;
	return false;
}

/* One time over all edges and faces; returns how many vertices were moved. */
static size_t
mend_all(mender *w)
{
	const mr_dyn *d = w->d;
	size_t mended = 0;

	for (uint32_t h = 0; h < 3 * d->nf; h++) {
		if (mr_dyn_face_dead(d, h / 3) || (!is_folded(d, h) && !(h % 3 == 0 && is_flipped(w, h / 3))))
			continue;
		mended += mend_vertex(w, d->v[h]) || mend_vertex(w, mr_dyn_to(d, h)) ||
		          mend_vertex(w, mr_dyn_apex(d, h)) ||
		          (d->twin[h] != MR_NONE && mend_vertex(w, mr_dyn_apex(d, d->twin[h])));
	}
	return mended;
}

void
mr_mend_flaws(mr_dyn *d, const mr_surface *s)
{
	mender w = { d, s, { s->m, s->topo } };

	for (int i = 0; i < MOST && mend_all(&w) > 0; i++)
		;
}
