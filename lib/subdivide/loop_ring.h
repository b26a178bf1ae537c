/*
 * loop_ring.h -- the neighbours of a vertex of a Loop surface in order, what kind of vertex it is, and the
 * weights that its kind has.
 */
#ifndef MR_SUBDIVIDE_LOOP_RING_H
#define MR_SUBDIVIDE_LOOP_RING_H

#include "subdivide/loop.h"

static inline uint32_t
mr_loop_from(const mr_loop *l, uint32_t h)
{
	return l->t[h / 3].v[h % 3];
}

static inline uint32_t
mr_loop_to(const mr_loop *l, uint32_t h)
{
	return l->t[h / 3].v[(h + 1) % 3];
}

/* The corner that the edge does not have. */
static inline uint32_t
mr_loop_opposite(const mr_loop *l, uint32_t h)
{
	return l->t[h / 3].v[(h + 2) % 3];
}

/* The odd vertex on half-edge h of the level below. */
static inline uint32_t
mr_loop_odd(const mr_loop *fine, uint32_t h)
{
	return fine->odd ? fine->odd[h] : fine->t[4 * (size_t)(h / 3) + 3].v[h % 3];
}

/* A boundary or a crease. */
static inline bool
mr_loop_sharp(const mr_loop *l, uint32_t h)
{
	return l->topo.twin[h] == MR_NONE || (l->crease && l->crease[h]);
}

/*
 * Walks the neighbours counter-clockwise, on the boundary from its first to its last:
 *
 *	for (mr_loop_ring r = mr_loop_ring_begin(l, v); r.more; mr_loop_ring_step(&r))
 */
typedef struct mr_loop_ring {
	const mr_loop *l;
	uint32_t start, h; /* h: the half-edge that leaves to it; MR_NONE: the last one of a boundary */
	uint32_t to;
	bool sharp, more;
} mr_loop_ring;

/* From half-edge h on, which leaves the vertex; an open ring is walked to its end. */
static inline mr_loop_ring
mr_loop_ring_from(const mr_loop *l, uint32_t h)
{
	mr_loop_ring r = { .l = l, .start = h, .h = h, .more = h != MR_NONE };

	if (r.more) {
		r.to = mr_loop_to(l, h);
		r.sharp = mr_loop_sharp(l, h);
	}
	return r;
}

static inline mr_loop_ring
mr_loop_ring_begin(const mr_loop *l, uint32_t v)
{
	return mr_loop_ring_from(l, l->topo.out[v]);
}

static inline void
mr_loop_ring_step(mr_loop_ring *r)
{
	uint32_t before, next;

	if (r->h == MR_NONE) {
		r->more = false;
		return;
	}
	before = mr_he_prev(r->h);
	next = r->l->topo.twin[before];
	r->more = next != r->start;
	r->to = mr_loop_from(r->l, before);
	r->sharp = mr_loop_sharp(r->l, before);
	r->h = next;
}

/* The half-edge to the first neighbour across a sharp edge; MR_NONE: there is none. */
static inline uint32_t
mr_loop_sharp_spoke(const mr_loop *l, uint32_t v)
{
	for (mr_loop_ring r = mr_loop_ring_begin(l, v); r.more; mr_loop_ring_step(&r))
		if (r.sharp)
			return r.h;
	return MR_NONE;
}

typedef enum mr_loop_shape {
	MR_LOOP_ALONE,  /* no face */
	MR_LOOP_SMOOTH, /* at most one sharp edge, the end of a crease */
	MR_LOOP_CREASE, /* two: on a curve */
	MR_LOOP_CORNER  /* more */
} mr_loop_shape;

typedef struct mr_loop_kind {
	mr_loop_shape shape;
	unsigned valence; /* of smooth vertices */
} mr_loop_kind;

static inline mr_loop_kind
mr_loop_kind_of(const mr_loop *l, uint32_t v)
{
	static const mr_loop_shape shapes[4] = { MR_LOOP_SMOOTH, MR_LOOP_SMOOTH, MR_LOOP_CREASE,
		MR_LOOP_CORNER };
	uint32_t h = l->topo.out[v];
	unsigned n = 0, sharp = 0;

	if (h == MR_NONE)
		return (mr_loop_kind){ MR_LOOP_ALONE, 0 };
	if (!l->crease && l->topo.twin[h] == MR_NONE)
		return (mr_loop_kind){ MR_LOOP_CREASE, 0 };
	for (mr_loop_ring r = mr_loop_ring_begin(l, v); r.more; mr_loop_ring_step(&r)) {
		n++;
		sharp += r.sharp;
	}
	return (mr_loop_kind){ shapes[sharp < 3 ? sharp : 3], n };
}

/* Weights of the vertex, of each neighbour, and of each one across a sharp edge. */
typedef struct mr_loop_mask {
	double self, ring, sharp;
} mr_loop_mask;

static inline double
mr_loop_beta(unsigned n)
{
	double x = 0.375 + 0.25 * cos(2 * MR_PI / n);

	return n == 6 ? 0.0625 : (0.625 - x * x) / n;
}

/* The new position of an even vertex. */
static inline mr_loop_mask
mr_loop_even_mask(mr_loop_kind kind)
{
	double beta;

	switch (kind.shape) {
	case MR_LOOP_SMOOTH:
		beta = mr_loop_beta(kind.valence);
		return (mr_loop_mask){ 1 - kind.valence * beta, beta, beta };
	case MR_LOOP_CREASE:
		return (mr_loop_mask){ 0.75, 0, 0.125 };
	default:
		return (mr_loop_mask){ 1, 0, 0 };
	}
}

/* Its position in the limit. */
static inline mr_loop_mask
mr_loop_limit_mask(mr_loop_kind kind)
{
	double chi;

	switch (kind.shape) {
	case MR_LOOP_SMOOTH: /* chi = 1 / (n + 3 / (8 beta)) */
		chi = 1 / (kind.valence + 0.375 / mr_loop_beta(kind.valence));
		return (mr_loop_mask){ 1 - kind.valence * chi, chi, chi };
	case MR_LOOP_CREASE:
		return (mr_loop_mask){ 2.0 / 3, 0, 1.0 / 6 };
	default:
		return (mr_loop_mask){ 1, 0, 0 };
	}
}

#endif
