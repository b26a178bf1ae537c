/* Flaws face by face, and lists of them that follow the changes. */
#include "remesh/flaws.h"

#include "base/parallel.h"

enum { GRAIN = 1024 };

static const double CLOSE = 0.25; /* squared cosine of 60 degrees */

static bool
are_folded(const mr_dyn *d, uint32_t f, uint32_t g)
{
	return mr_folds(mr_dyn_cross(d, d->p, f), mr_dyn_cross(d, d->p, g), MR_FOLD);
}

static bool
is_folded(const mr_dyn *d, uint32_t h)
{
	return d->twin[h] != MR_NONE && are_folded(d, h / 3, d->twin[h] / 3);
}

static mr_v3
find_normal(const mr_flaws *w, uint32_t v)
{
	mr_closest c = mr_remesh_place(w->s, w->d, v, w->d->p[v], mr_dyn_normal_around(w->d, v));

	return mr_facing_normal(&w->facing, c.at);
}

mr_v3
mr_flaws_normal(const mr_flaws *w, uint32_t v)
{
	if (!w->normal)
		return find_normal(w, v);
	if (!(mr_norm2(w->normal[v]) > 0))
		w->normal[v] = find_normal(w, v);
	return w->normal[v];
}

void
mr_flaws_moved(const mr_flaws *w, uint32_t v, mr_v3 normal)
{
	w->normal[v] = normal;
}

static bool
is_flipped(const mr_flaws *w, uint32_t f)
{
	const uint32_t *v = &w->d->v[3 * f];
	mr_v3 n = mr_dyn_cross(w->d, w->d->p, f), m = mr_face_cross(w->s->m, mr_dyn_place(w->d, v[0]));
	double mn = mr_dot(m, n);

	if (!w->sure && mn > 0 && mn * mn > CLOSE * mr_norm2(m) * mr_norm2(n))
		return false; /* as almost all are, told without a walk */
	return mr_dot(n, mr_flaws_normal(w, v[0])) < 0 && mr_dot(n, mr_flaws_normal(w, v[1])) < 0 &&
	       mr_dot(n, mr_flaws_normal(w, v[2])) < 0;
}

unsigned
mr_flaws_around(const mr_flaws *w, uint32_t v, uint32_t but, unsigned most)
{
	const mr_dyn *d = w->d;
	uint32_t h = d->out[v];
	unsigned n = 0;

	do {
		uint32_t g = d->twin[h];
		if (!mr_dyn_has(d, h / 3, but)) {
			n += (g == MR_NONE || !mr_dyn_has(d, g / 3, but)) && is_folded(d, h);
			n += is_folded(d, mr_he_next(h));
		}
		h = mr_dyn_ccw(d, h);
	} while (h != MR_NONE && h != d->out[v]);
	h = d->out[v];
	do {
		if (n < most && !mr_dyn_has(d, h / 3, but))
			n += is_flipped(w, h / 3);
		h = mr_dyn_ccw(d, h);
	} while (h != MR_NONE && h != d->out[v]);
	return n < most ? n : most;
}

unsigned
mr_flaws_beside(const mr_flaws *w, uint32_t h)
{
	const mr_dyn *d = w->d;
	uint32_t g = d->twin[h];

	return (unsigned)is_flipped(w, h / 3) + is_flipped(w, g / 3) + is_folded(d, h) +
	       is_folded(d, mr_he_next(h)) + is_folded(d, mr_he_prev(h)) + is_folded(d, mr_he_next(g)) +
	       is_folded(d, mr_he_prev(g));
}

unsigned
mr_flaws_of_pair(const mr_flaws *w, uint32_t h, unsigned most)
{
	const mr_dyn *d = w->d;
	uint32_t a = d->v[h], b = mr_dyn_to(d, h), side[2] = { h, d->twin[h] };
	unsigned n = mr_flaws_around(w, a, MR_NONE, most);

	if (n < most)
		n += mr_flaws_around(w, b, a, most - n);
	if (mr_norm2(mr_sub(d->p[a], d->p[b])) > 0)
		return n;
	for (int i = 0; i < 2; i++)
		if (side[i] != MR_NONE) { /* over the face that is none any more */
			uint32_t x = d->twin[mr_he_next(side[i])], y = d->twin[mr_he_prev(side[i])];
			n += x != MR_NONE && y != MR_NONE && are_folded(d, x / 3, y / 3);
		}
	return n;
}

bool
mr_is_flawed(const mr_flaws *w, uint32_t f)
{
	const mr_dyn *d = w->d;

	return !mr_dyn_face_dead(d, f) && (is_flipped(w, f) || is_folded(d, 3 * f) ||
					      is_folded(d, 3 * f + 1) || is_folded(d, 3 * f + 2));
}

/* Notes whether face f has a flaw: a quick look at what seldom has any. */
static double
find_flaw(void *arg, size_t f)
{
	const mr_flaws *w = arg;
	const mr_dyn *d = w->d;
	bool flawed = false;

	if (!mr_dyn_face_dead(d, f)) {
		mr_v3 n = mr_dyn_cross(d, d->p, f);
		for (uint32_t h = (uint32_t)(3 * f); h < 3 * f + 3 && !flawed; h++)
			flawed = d->twin[h] != MR_NONE &&
			         mr_dot(n, mr_dyn_cross(d, d->p, d->twin[h] / 3)) < 0 && is_folded(d, h);
		flawed = flawed || is_flipped(w, (uint32_t)f);
	}
	w->state[f] = flawed ? MR_SUSPECT : MR_SOUND;
	return flawed;
}

typedef struct normals_job {
	const mr_flaws *w;
	mr_v3 *normal;
} normals_job;

static void
normals_body(void *arg, size_t begin, size_t end)
{
	const normals_job *j = arg;

	for (uint32_t v = (uint32_t)begin; v < end; v++)
		if (j->w->d->kind[v] != MR_DEAD)
			j->normal[v] = find_normal(j->w, v);
}

void
mr_flaws_find(mr_ctx *ctx, const mr_dyn *d, const mr_remesh_source *s, bool sure, mr_flaws *w, size_t *count)
{
	mr_v3 *normal = MR_NEW_ZERO(ctx, d->nv, mr_v3);

	*w = (mr_flaws){ d, s, { s->m, s->topo }, sure, MR_NEW(ctx, d->nf, uint8_t), NULL };
	if (sure) {
		mr_parallel(ctx, d->nv, GRAIN, normals_body, &(normals_job){ w, normal });
		w->normal = normal;
	}
	*count = (size_t)mr_parallel_sum(ctx, d->nf, find_flaw, w);
	w->normal = normal; /* few were asked for; from now on one thread asks */
}

/* The faces around v and those beside them; its place may be another. */
static void
suspect_around(const mr_flaws *w, uint32_t v)
{
	const mr_dyn *d = w->d;
	uint32_t h = d->out[v];

	w->normal[v] = (mr_v3){ 0, 0, 0 };
	do {
		w->state[h / 3] = MR_SUSPECT;
		if (d->twin[mr_he_next(h)] != MR_NONE)
			w->state[d->twin[mr_he_next(h)] / 3] = MR_SUSPECT;
		h = mr_dyn_ccw(d, h);
	} while (h != MR_NONE && h != d->out[v]);
}

void
mr_flaws_suspect(const mr_flaws *w, uint32_t v)
{
	const mr_dyn *d = w->d;
	uint32_t h = d->out[v];

	suspect_around(w, v);
	do {
		suspect_around(w, mr_dyn_to(d, h));
		suspect_around(w, mr_dyn_to(d, mr_he_next(h)));
		h = mr_dyn_ccw(d, h);
	} while (h != MR_NONE && h != d->out[v]);
}
