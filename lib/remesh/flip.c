/*
 * Flips towards valence 6 (Botsch, Kobbelt 2004, step 3), then dislocations glide along rows until they
 * meet.
 */
#include "remesh/flip.h"

#include "base/parallel.h"
#include "remesh/blocks.h"

enum { REACH_MAX = 64 };

typedef struct flipper {
	mr_dyn *d;
	int *excess; /* of each vertex: its valence over the one it should have */
	unsigned reach;
} flipper;

static void
excess_body(void *arg, size_t begin, size_t end)
{
	flipper *w = arg;

	for (uint32_t v = (uint32_t)begin; v < end; v++)
		if (w->d->kind[v] != MR_DEAD)
			w->excess[v] = (int)mr_dyn_valence(w->d, v, MR_NONE) -
			               (mr_dyn_on_boundary(w->d, v) ? 4 : 6);
}

/* True where a face with that normal would be folded against the one beyond side h or g. */
static bool
folds_beside(const mr_dyn *d, mr_v3 normal, uint32_t h, uint32_t g)
{
	uint32_t th = d->twin[h], tg = d->twin[g];

	return (th != MR_NONE && mr_folds(normal, mr_dyn_cross(d, d->p, th / 3), MR_NEAR_FOLD)) ||
	       (tg != MR_NONE && mr_folds(normal, mr_dyn_cross(d, d->p, tg / 3), MR_NEAR_FOLD));
}

bool
mr_flip_is_good(const mr_dyn *d, uint32_t h)
{
	uint32_t ia = d->v[h], ib = mr_dyn_to(d, h), ic = mr_dyn_apex(d, h), ie = mr_dyn_apex(d, d->twin[h]);
	mr_v3 a = d->p[ia], b = d->p[ib], c = d->p[ic], e = d->p[ie];
	mr_v3 n = mr_add(mr_cross(mr_sub(b, a), mr_sub(c, a)), mr_cross(mr_sub(a, b), mr_sub(e, b)));
	mr_v3 m0 = mr_cross(mr_sub(e, a), mr_sub(c, a)), m1 = mr_cross(mr_sub(c, b), mr_sub(e, b));
	double nn = mr_norm2(n);

	return mr_dot(m0, n) > 0.5 * sqrt(nn * mr_norm2(m0)) &&
	       mr_dot(m1, n) > 0.5 * sqrt(nn * mr_norm2(m1)) && mr_dyn_shape(a, e, c) > MR_NEEDLE &&
	       mr_dyn_shape(b, c, e) > MR_NEEDLE &&
	       !folds_beside(d, m0, mr_he_next(d->twin[h]), mr_he_prev(h)) &&
	       !folds_beside(d, m1, mr_he_next(h), mr_he_prev(d->twin[h]));
}

/* By how much flipping h would lower the sum of squared excesses: a^2 - (a - 1)^2 + ... */
static int
gain_of(const flipper *w, uint32_t h)
{
	const mr_dyn *d = w->d;
	int a = w->excess[d->v[h]], b = w->excess[mr_dyn_to(d, h)];
	int c = w->excess[mr_dyn_apex(d, h)], e = w->excess[mr_dyn_apex(d, d->twin[h])];

	return 2 * (a + b - c - e) - 4;
}

/* Flips h and keeps the excesses. */
static void
flip(flipper *w, uint32_t h)
{
	mr_dyn *d = w->d;

	w->excess[d->v[h]]--;
	w->excess[mr_dyn_to(d, h)]--;
	w->excess[mr_dyn_apex(d, h)]++;
	w->excess[mr_dyn_apex(d, d->twin[h])]++;
	mr_dyn_flip(d, h);
}

static bool
gains(const void *arg, uint32_t h)
{
	const flipper *w = arg;
	const mr_dyn *d = w->d;

	return !mr_dyn_face_dead(d, h / 3) && d->twin[h] != MR_NONE && h < d->twin[h] && gain_of(w, h) > 0;
}

/* The flipper of a part. */
static flipper
within(const void *arg, mr_part *part)
{
	flipper w = *(const flipper *)arg;

	w.d = part->d;
	return w;
}

static void
flip_gaining(const void *arg, mr_part *part, uint32_t h)
{
	flipper w = within(arg, part);

	if (w.d->twin[h] == MR_NONE || gain_of(&w, h) <= 0 || !mr_dyn_can_flip(w.d, h) ||
	    !mr_flip_is_good(w.d, h))
		return;
	flip(&w, h);
	mr_part_ask_around(part, w.d->v[mr_he_next(h)]); /* the ends of the new edge have one more each */
	mr_part_ask_around(part, mr_dyn_to(w.d, mr_he_next(h)));
	part->done[0]++;
}

/*
 * The edge a -> b of h has a 5-valent apex c and a 7-valent end.  Its flip moves the pair one
 * vertex on; the next edge is the one across, on the side away from the 7-valent end.  Follows the
 * row while the sum stays the same; where it is never lowered, all is as before.
 */
static void
glide(flipper *w, mr_part *part, uint32_t h, bool seven_at_end)
{
	mr_dyn *d = w->d;
	uint32_t made[REACH_MAX]; /* the edges that the flips made */
	unsigned n = 0;

	while (n < w->reach && h != MR_NONE && d->twin[h] != MR_NONE && mr_part_owns(part, h)) {
		int gain = gain_of(w, h);
		uint32_t g = d->twin[h];
		if (gain < 0 || !mr_dyn_can_flip(d, h) || !mr_flip_is_good(d, h))
			break;
		flip(w, h);
		made[n++] = mr_he_next(h);
		if (gain > 0) {
			part->done[0] += n;
			return;
		}
		/* h is a -> e now and g is b -> c; across a-e or e-b lies the next face */
		h = d->twin[seven_at_end ? h : mr_he_prev(g)];
		if (h != MR_NONE)
			h = seven_at_end ? mr_he_prev(h) : mr_he_next(h);
	}
	while (n > 0)
		flip(w, made[--n]);
}

/* A dislocation at h: a 5-valent apex, and a 7-valent end. */
static bool
is_dislocation(const void *arg, uint32_t h)
{
	const flipper *w = arg;
	const mr_dyn *d = w->d;
	int a, b;

	if (mr_dyn_face_dead(d, h / 3) || w->excess[mr_dyn_apex(d, h)] != -1)
		return false;
	a = w->excess[d->v[h]];
	b = w->excess[mr_dyn_to(d, h)];
	return (a == 1 && b == 0) || (a == 0 && b == 1);
}

static void
glide_dislocation(const void *arg, mr_part *part, uint32_t h)
{
	flipper w = within(arg, part);

	if (is_dislocation(&w, h))
		glide(&w, part, h, w.excess[mr_dyn_to(w.d, h)] == 1);
}

void
mr_regularize(mr_ctx *ctx, mr_dyn *d, unsigned reach, size_t *flips)
{
	MR_SCOPE(ctx);
	flipper w = { d, MR_NEW(ctx, d->nv, int), reach < REACH_MAX ? reach : REACH_MAX };
	mr_edge_work flips_that_gain = { .is_due = gains, .serve = flip_gaining, .arg = &w },
		     glides = { .is_due = is_dislocation, .serve = glide_dislocation, .arg = &w };
	mr_edge_queue queue = { 0 };
	size_t n[2] = { 0, 0 };

	mr_parallel(ctx, d->nv, 4096, excess_body, &w);
	mr_serve_edges(ctx, d, &flips_that_gain, &queue, n);
	if (reach > 0)
		mr_serve_edges(ctx, d, &glides, &queue, n);
	*flips = n[0];
}
