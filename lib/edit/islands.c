/* Islands by the ball about a hole and by its projection; bridges as in Held 2001: FIST, section 3. */
#include "edit/islands.h"

#include "space/bvh.h"

/* ---- which ---- */

typedef struct search {
	const mr_mesh *m;
	const mr_loops *loops;
	const uint32_t *component;
	const uint32_t *first, *after; /* the loops of each component, in lists */
	const bool *open;
	uint32_t *next;
	bool *taken;
	size_t *faces, *inside; /* of each component, all and those in the ball */
	uint32_t *seen;         /* n components */
	size_t n;
	uint32_t own; /* component of the hole, its middle and normal, and the ball about it */
	mr_v3 middle, normal;
	double radius2;
} search;

static mr_v3
corner_of(const search *s, size_t k)
{
	return s->m->p[mr_he_from(s->m, s->loops->he[k])];
}

static size_t
corner_after(const search *s, uint32_t loop, size_t k)
{
	return k + 1 < s->loops->start[loop + 1] ? k + 1 : s->loops->start[loop];
}

/* Newell's, of the length of twice the area. */
static mr_v3
normal_of(const search *s, uint32_t loop)
{
	mr_v3 sum = { 0, 0, 0 };

	for (size_t k = s->loops->start[loop]; k < s->loops->start[loop + 1]; k++)
		sum = mr_add(sum, mr_cross(mr_sub(corner_of(s, k), s->middle),
				      mr_sub(corner_of(s, corner_after(s, loop, k)), s->middle)));
	return sum;
}

static bool
count_inside(void *arg, uint32_t f)
{
	search *s = arg;
	uint32_t c = s->component[s->m->t[f].v[0]];
	mr_v3 p[3];

	mr_corners(s->m, f, p);
	for (int k = 0; k < 3; k++)
		if (c == s->own || mr_norm2(mr_sub(p[k], s->middle)) > s->radius2)
			return true;
	if (s->inside[c]++ == 0)
		s->seen[s->n++] = c;
	return true;
}

/* Whether the place is within the hole, as seen along its normal: a ray crosses it an odd number of times. */
static bool
is_within(const search *s, uint32_t hole, mr_v3 q)
{
	mr_v3 x = mr_sub(corner_of(s, s->loops->start[hole]), s->middle), y = mr_cross(s->normal, x);
	bool odd = false;

	x = mr_cross(y, s->normal);
	for (size_t k = s->loops->start[hole]; k < s->loops->start[hole + 1]; k++) {
		mr_v3 a = mr_sub(corner_of(s, k), q), b = mr_sub(corner_of(s, corner_after(s, hole, k)), q);
		double ax = mr_dot(a, x), ay = mr_dot(a, y), bx = mr_dot(b, x), by = mr_dot(b, y);
		if ((ay > 0) != (by > 0) && (ax * by - bx * ay) * (by - ay) > 0)
			odd = !odd;
	}
	return odd;
}

static bool
is_island(const search *s, uint32_t hole, uint32_t loop)
{
	if (!s->open[loop] || s->taken[loop] || !(mr_dot(normal_of(s, loop), s->normal) < 0))
		return false;
	for (size_t k = s->loops->start[loop]; k < s->loops->start[loop + 1]; k++)
		if (!is_within(s, hole, corner_of(s, k)))
			return false;
	return true;
}

static void
find_islands(search *s, const mr_bvh *bvh, uint32_t hole)
{
	size_t begin = s->loops->start[hole], end = s->loops->start[hole + 1];
	mr_box ball = mr_box_empty();

	s->middle = s->normal = mr_vec(0, 0, 0);
	for (size_t k = begin; k < end; k++)
		s->middle = mr_axpy(1 / (double)(end - begin), corner_of(s, k), s->middle);
	s->normal = normal_of(s, hole);
	s->own = s->component[mr_he_from(s->m, s->loops->he[begin])];
	s->radius2 = 0;
	s->n = 0;
	for (size_t k = begin; k < end; k++)
		s->radius2 = fmax(s->radius2, mr_norm2(mr_sub(corner_of(s, k), s->middle)));
	for (int sign = -1; sign <= 1; sign += 2) {
		double r = sign * sqrt(s->radius2);
		mr_box_add(&ball, mr_add(s->middle, mr_vec(r, r, r)));
	}
	mr_bvh_overlap(bvh, ball, count_inside, s);
	for (size_t i = 0; i < s->n; i++) {
		uint32_t c = s->seen[i];
		for (uint32_t l = s->first[c]; l != MR_NONE && s->inside[c] == s->faces[c]; l = s->after[l])
			if (is_island(s, hole, l)) {
				s->taken[l] = true;
				s->next[l] = s->next[hole];
				s->next[hole] = l;
			}
		s->inside[c] = 0;
	}
}

void
mr_islands_find(mr_ctx *ctx, const mr_mesh *m, const mr_loops *loops, const uint32_t *component,
    const bool *open, const uint32_t *holes, size_t n, uint32_t *next)
{
	mr_mark mark = mr_mark_take(ctx);
	uint32_t *first = MR_NEW(ctx, m->nv, uint32_t), *after = MR_NEW(ctx, loops->count, uint32_t);
	search s = { .m = m,
		.loops = loops,
		.component = component,
		.first = first,
		.after = after,
		.open = open,
		.next = next };
	mr_bvh *bvh;

	s.taken = MR_NEW_ZERO(ctx, loops->count, bool);
	s.faces = MR_NEW_ZERO(ctx, m->nv, size_t);
	s.inside = MR_NEW_ZERO(ctx, m->nv, size_t);
	s.seen = MR_NEW(ctx, m->nv, uint32_t);
	memset(first, 0xff, m->nv * sizeof *first);
	for (uint32_t l = (uint32_t)loops->count; l-- > 0;) {
		uint32_t c = component[mr_he_from(m, loops->he[loops->start[l]])];
		after[l] = first[c];
		first[c] = l;
	}
	for (size_t f = 0; f < m->nf; f++)
		s.faces[component[m->t[f].v[0]]]++;
	mr_bvh_build(ctx, m, &bvh);
	for (size_t i = 0; i < n; i++)
		find_islands(&s, bvh, holes[i]);
	mr_mark_release(ctx, mark);
}

/* ---- bridges ---- */

typedef struct bridge {
	double length2;
	size_t at; /* from this corner of the polygon */
	uint32_t island, to;
} bridge;

static void
look_for_shorter(
    const mr_v3 *p, const uint32_t *start, uint32_t island, const uint32_t *corner, size_t n, bridge *b)
{
	for (size_t i = 0; i < n; i++)
		for (uint32_t v = start[island]; v < start[island + 1]; v++) {
			double d = mr_norm2(mr_sub(p[corner[i]], p[v]));
			if (d < b->length2)
				*b = (bridge){ d, i, island, v };
		}
}

static void
cross_bridge(const uint32_t *start, const bridge *b, uint32_t *corner, size_t *n)
{
	uint32_t first = start[b->island], more = start[b->island + 1] - first;
	uint32_t *in = corner + b->at + 1;

	memmove(in + more + 2, in, (*n - b->at - 1) * sizeof *corner);
	for (uint32_t i = 0; i <= more; i++)
		*in++ = first + (b->to - first + i) % more;
	*in = corner[b->at];
	*n += more + 2;
}

void
mr_islands_join(
    const mr_v3 *p, const uint32_t *start, size_t count, uint32_t *corner, size_t *n, uint32_t (*ends)[2])
{
	memset(ends, 0xff, count * sizeof *ends);
	for (size_t joined = 0; joined < count; joined++) {
		bridge b = { .length2 = INFINITY };
		for (uint32_t i = 0; i < count; i++)
			if (ends[i][0] == MR_NONE)
				look_for_shorter(p, start, i, corner, *n, &b);
		ends[b.island][0] = corner[b.at];
		ends[b.island][1] = b.to;
		cross_bridge(start, &b, corner, n);
	}
}
