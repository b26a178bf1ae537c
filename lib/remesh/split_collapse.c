/* Steps 1 and 2 of Botsch, Kobbelt 2004, section 4. */
#include "remesh/split_collapse.h"

#include "space/surface_walk.h"

/* The thresholds of steps 1 and 2 of the paper, relative to the target edge length. */
static const double LONG = 4.0 / 3, SHORT = 4.0 / 5;

/*
 * Beyond the paper: a strained lattice (a grid of right angles, say) has valence 6 everywhere and no edge
 * beyond those thresholds, so nothing would move it.  Its strain shows in the angles opposite its edges:
 * edges longer or shorter than these are split or merged too where both angles are that far from 60.
 * Beside a curve the angles are what that makes them: there each round would split what the last one merged.
 */
static const double STRETCHED = 1.05, SQUEEZED = 0.95;
/* Shape of a face so thin that its normal is rounding. */
static const double HAIR = 1e-6;
static const double WIDE = 0.2588190451025207, NARROW = 0.7071067811865476; /* cosines of 75 and 45 degrees */

typedef struct resampler {
	mr_dyn *d;
	const mr_remesh_source *s;
	double coarser;  /* too long by as much */
	size_t most;     /* faces that there may be */
	uint8_t *mark;   /* for the link condition */
	uint8_t *strung; /* of each vertex: it was merged though an edge there is too long */
	mr_part *part;   /* whose mesh d is */
} resampler;

/* The part's counts. */
enum { DONE, STRUNG };

static double
edge_length2(const mr_dyn *d, uint32_t h)
{
	return mr_norm2(mr_sub(d->p[mr_dyn_to(d, h)], d->p[d->v[h]]));
}

/* The target length of the edge of h: of its finer end. */
static double
target(const resampler *r, uint32_t h)
{
	if (!r->s->length)
		return r->s->uniform;
	return fmin(
	    mr_remesh_length(r->s, r->d, r->d->v[h]), mr_remesh_length(r->s, r->d, mr_dyn_to(r->d, h)));
}

/* One half-edge of each edge that lives. */
static bool
is_edge(const mr_dyn *d, uint32_t h)
{
	return !mr_dyn_face_dead(d, h / 3) && (d->twin[h] == MR_NONE || h < d->twin[h]);
}

/* The longest edge of h's face, h itself among equals. */
static uint32_t
longest_side(const mr_dyn *d, uint32_t h)
{
	uint32_t n = mr_he_next(h), p = mr_he_prev(h);
	double lh = edge_length2(d, h), ln = edge_length2(d, n), lp = edge_length2(d, p);

	if (ln > lh)
		return lp > ln ? p : n;
	return lp > lh ? p : h;
}

/*
 * An edge at or near h that is the longest of both its faces (Rivara 1984): bisecting only
 * such edges keeps the angles from collapsing.  Lengths grow on the way, so it ends; MR_NONE where it leaves
 * the part.
 */
static uint32_t
locally_longest(const mr_part *part, uint32_t h)
{
	const mr_dyn *d = part->d;

	while (mr_part_owns(part, h)) {
		uint32_t g = longest_side(d, h);
		if (g == h && d->twin[h] != MR_NONE) {
			g = longest_side(d, d->twin[h]);
			if (g == d->twin[h])
				return h;
		}
		if (g == h)
			return h;
		h = g;
	}
	return MR_NONE;
}

/* Cosine of the angle opposite h in its face. */
static double
opposite_cosine(const mr_dyn *d, uint32_t h)
{
	mr_v3 c = d->p[mr_dyn_apex(d, h)], a = mr_sub(d->p[d->v[h]], c), b = mr_sub(d->p[mr_dyn_to(d, h)], c);

	return mr_dot(a, b) / sqrt(mr_norm2(a) * mr_norm2(b));
}

/* True where neither h's edge nor its opposite is on a curve. */
static bool
is_inside(const mr_dyn *d, uint32_t h)
{
	return d->twin[h] != MR_NONE && d->kind[d->v[h]] != MR_CURVE &&
	       d->kind[mr_dyn_to(d, h)] != MR_CURVE && d->kind[mr_dyn_apex(d, h)] != MR_CURVE &&
	       d->kind[mr_dyn_apex(d, d->twin[h])] != MR_CURVE;
}

static bool
too_long(const resampler *r, uint32_t h)
{
	const mr_dyn *d = r->d;
	double l = r->coarser * target(r, h), l2 = edge_length2(d, h);

	if (l2 > mr_square(LONG * l))
		return true;
	return l2 > mr_square(STRETCHED * l) && is_inside(d, h) && opposite_cosine(d, h) < WIDE &&
	       opposite_cosine(d, d->twin[h]) < WIDE;
}

static bool
too_short(const resampler *r, uint32_t h)
{
	const mr_dyn *d = r->d;
	double l = target(r, h), l2 = edge_length2(d, h);

	if (l2 < mr_square(SHORT * l))
		return true;
	return l2 < mr_square(SQUEEZED * l) && is_inside(d, h) && opposite_cosine(d, h) > NARROW &&
	       opposite_cosine(d, d->twin[h]) > NARROW;
}

/* The place of a new vertex, first at an end of its edge: a walk from there may not get to it. */
static void
place_middle(resampler *r, uint32_t m)
{
	const mr_remesh_source *s = r->s;
	mr_dyn *d = r->d;
	double far2 = mr_square(MR_FAR * mr_remesh_length(s, d, m));
	mr_closest c = mr_project_walk(s->m, s->topo, d->at[m], d->p[m]);

	if (c.dist2 > far2)
		c = mr_project_walk_around(s->m, s->topo, d->at[m], d->p[m]);
	if (c.dist2 > far2)
		c = mr_remesh_place(s, d, m, d->p[m], mr_dyn_normal_around(d, m));
	d->at[m] = c.at.face;
}

/* The area of the equilateral triangle with a side of 1. */
static const double EQUILATERAL = 0.4330127018922193;

mr_demand
mr_remesh_demand(const mr_dyn *d, const mr_remesh_source *s)
{
	resampler r = { .d = (mr_dyn *)(uintptr_t)d, .s = s };
	mr_demand sum = { 0 };

	for (uint32_t f = 0; f < d->nf; f++) {
		double l, longest = 0, area;
		if (mr_dyn_face_dead(d, f))
			continue;
		l = fmin(target(&r, 3 * f), target(&r, 3 * f + 1));
		for (uint32_t h = 3 * f; h < 3 * f + 3; h++)
			longest = fmax(longest, edge_length2(d, h));
		longest = sqrt(longest) / l;
		area = mr_norm(mr_dyn_cross(d, d->p, f)) / (2 * EQUILATERAL * l * l);
		sum.area += area;
		*(area > longest ? &sum.flat : &sum.thin) += fmax(area, longest);
	}
	return sum;
}

static const double ROUNDED_UP = 1.05; /* whatever two digits make of it */

mr_status
mr_too_fine(mr_ctx *ctx, const mr_remesh_source *s, double faces, double most, double length)
{
	return mr_fail(ctx, MR_ERANGE,
	    "%s: edges of length %g take about %.6g faces or more, where at most %.6g may be: take a length "
	    "of %.2g",
	    s->m->name, s->uniform, ceil(faces), floor(most), ROUNDED_UP * length);
}

double
mr_coarsest(const mr_dyn *d, const mr_remesh_source *s)
{
	resampler r = { .d = (mr_dyn *)(uintptr_t)d, .s = s };
	double ratio2 = 0, coarser = 1;

	for (uint32_t h = 0; h < 3 * d->nf; h++)
		if (is_edge(d, h))
			ratio2 = fmax(ratio2, edge_length2(d, h) / mr_square(LONG * target(&r, h)));
	while (ratio2 > mr_square(2 * coarser))
		coarser *= 2;
	return coarser;
}

static bool
is_long(const void *arg, uint32_t h)
{
	const resampler *r = arg;

	return is_edge(r->d, h) && too_long(r, h);
}

/* The resampler of a part. */
static resampler
within(const void *arg, mr_part *part)
{
	resampler r = *(const resampler *)arg;

	r.d = part->d;
	r.part = part;
	return r;
}

/* Splits edge g, the longest of its faces; false where it cannot be. */
static bool
split(resampler *r, uint32_t g)
{
	mr_dyn *d = r->d;
	mr_v3 a = d->p[d->v[g]], b = d->p[mr_dyn_to(d, g)], middle = mr_lerp(0.5, a, b);
	uint32_t m;

	if (!mr_dyn_can_split(d, g) || !mr_divides(middle, a, b))
		return false;
	r->part->status = r->part->ctx && d->nf >= r->most ? mr_too_fine(r->part->ctx, r->s, (double)d->nf,
								 (double)r->most, 2 * r->s->uniform)
	                                                   : mr_dyn_split(r->part->ctx, d, g, middle, &m);
	if (r->part->status < 0)
		return false;
	if (d->kind[m] == MR_SMOOTH)
		place_middle(r, m);
	mr_part_ask_around(r->part, m);
	r->part->done[DONE]++;
	return true;
}

static void
split_long(const void *arg, mr_part *part, uint32_t h)
{
	resampler r = within(arg, part);
	bool going = true;

	while (going && too_long(&r, h)) {
		uint32_t g = locally_longest(part, h);
		going = g != MR_NONE && mr_part_has_room(part) && split(&r, g);
		if (g == MR_NONE)
			mr_part_defer(part, h);
		else if (!mr_part_has_room(part)) {
			part->full = true;
			mr_part_ask(part, h);
		}
	}
}

/* 1. Split all edges that are longer than 4/3 l at their midpoint. */
mr_status
mr_split_long(mr_ctx *ctx, mr_dyn *d, const mr_remesh_source *s, double coarser, mr_resampled *done)
{
	resampler r = { .d = d, .s = s, .coarser = coarser, .most = done->most };
	mr_edge_work work = {
		.is_due = is_long, .serve = split_long, .arg = &r, .splits = true, .most = done->most
	};

	size_t n[2] = { 0, 0 };
	mr_status status = mr_serve_edges(ctx, d, &work, &done->queue, n);

	done->splits += n[DONE];
	return status;
}

/* False where moving the end v of an edge to p makes it too long; where it is so already, `*strung`. */
static bool
length_is_good(mr_v3 other, mr_v3 v, mr_v3 p, double longest2, bool *strung)
{
	if (mr_norm2(mr_sub(other, p)) <= longest2)
		return true;
	*strung = true;
	return mr_norm2(mr_sub(other, v)) > longest2;
}

/*
 * True where moving v to p turns no face around v that stays (those with vertex `gone` do not) by more than
 * 60 degrees or away from `facing`, makes no needle worse and no edge longer than `longest`, except existing
 * ones: `*strung` then.  The face of such an edge stays in its plane: far from here it might meet the other
 * side of a plate.
 */
static bool
move_is_good(const mr_dyn *d, uint32_t v, uint32_t gone, mr_v3 p, mr_v3 facing, double longest2, bool *strung)
{
	uint32_t h = d->out[v];

	do {
		uint32_t b = mr_dyn_to(d, h), c = mr_dyn_apex(d, h);
		mr_v3 pb = d->p[b], pc = d->p[c], pv = d->p[v];
		bool strings = false;
		if (b != gone && c != gone) {
			mr_v3 before = mr_cross(mr_sub(pb, pv), mr_sub(pc, pv)),
			      after = mr_cross(mr_sub(pb, p), mr_sub(pc, p));
			double shape = mr_dyn_shape(pv, pb, pc), moved = mr_dyn_shape(p, pb, pc);
			if (!length_is_good(pb, pv, p, longest2, &strings) ||
			    !length_is_good(pc, pv, p, longest2, &strings))
				return false;
			if (strings && mr_square(mr_dot(before, mr_sub(p, pv))) >
					   mr_square(MR_FAR) * longest2 * mr_norm2(before))
				return false;
			*strung |= strings;
			if (moved < MR_NEEDLE && moved < 0.2 * shape)
				return false;
			if (mr_dot(after, facing) <= 0 && mr_dot(before, facing) > 0)
				return false;
			if (shape >= HAIR &&
			    mr_dot(before, after) < 0.5 * sqrt(mr_norm2(before) * mr_norm2(after)))
				return false;
		}
		h = mr_dyn_ccw(d, h);
	} while (h != MR_NONE && h != d->out[v]);
	return true;
}

/* The longest edge, in targets, that a merge with the limit `longest2` may leave at v: no longer than v's own
 * target allows, or the next round splits it again. */
static double
longest_at(const resampler *r, uint32_t v, double slack, double longest2)
{
	if (!r->s->length)
		return longest2;
	return fmin(longest2, mr_square(slack * mr_remesh_length(r->s, r->d, v)));
}

/* True where moving v to p makes an edge to a neighbour of it too long, as most refused merges do: found
 * without a normal. */
static bool
overreaches(const resampler *r, uint32_t v, uint32_t gone, mr_v3 p, double slack, double longest2)
{
	const mr_dyn *d = r->d;
	uint32_t h = d->out[v];
	bool strung;

	do {
		uint32_t b = mr_dyn_to(d, h);
		if (b != gone && mr_dyn_apex(d, h) != gone &&
		    !length_is_good(d->p[b], d->p[v], p, longest_at(r, b, slack, longest2), &strung))
			return true;
		h = mr_dyn_ccw(d, h);
	} while (h != MR_NONE && h != d->out[v]);
	return false;
}

/* The place of the merged vertex: the middle, of a curve on it, or the end that must stay.  *at: b's place
 * then. */
static mr_v3
merged_position(const mr_dyn *d, const mr_remesh_source *s, uint32_t a, uint32_t b, uint32_t *at)
{
	mr_v3 middle = mr_lerp(0.5, d->p[a], d->p[b]);

	*at = d->at[b];
	if (d->kind[a] != d->kind[b])
		return d->p[b];
	if (d->kind[b] == MR_CURVE)
		return mr_project_curve(s->m, s->topo, s->curve, d->at[b], middle, at).point;
	return middle;
}

/* The other neighbour of v along its curve than u. */
static uint32_t
further(const mr_dyn *d, uint32_t v, uint32_t u)
{
	uint32_t end[2];

	mr_dyn_along(d, v, end);
	return end[0] == u ? end[1] : end[0];
}

static bool
turns_sharply(mr_v3 a, mr_v3 b, mr_v3 c)
{
	mr_v3 in = mr_sub(b, a), out = mr_sub(c, b);

	return mr_dot(in, out) < MR_CORNER_COSINE * sqrt(mr_norm2(in) * mr_norm2(out));
}

/* True where vertex v of a curve would turn sharply, were its neighbour u at p. */
static bool
makes_corner(const mr_dyn *d, uint32_t v, uint32_t u, mr_v3 p)
{
	return d->kind[v] == MR_CURVE && turns_sharply(d->p[further(d, v, u)], d->p[v], p);
}

/*
 * True where merging a into its neighbour b along a curve, at p, makes the curve turn like a corner: it would
 * crush a loop smaller than an edge.
 */
static bool
cuts_curve(const mr_dyn *d, uint32_t a, uint32_t b, mr_v3 p)
{
	uint32_t x = further(d, a, b), y;

	if (makes_corner(d, x, a, p))
		return true;
	if (d->kind[b] != MR_CURVE)
		return false;
	y = further(d, b, a);
	return turns_sharply(d->p[x], p, d->p[y]) || makes_corner(d, y, b, p);
}

/* Merges the ends of h, where that makes no edge too long. */
static void
try_collapse(resampler *r, uint32_t h)
{
	mr_dyn *d = r->d;
	double longest2 = mr_square(LONG * target(r, h));
	uint32_t a, b, at;
	mr_v3 p, facing;
	bool strung = false;

	if (d->twin[h] != MR_NONE && d->kind[d->v[h]] > d->kind[mr_dyn_to(d, h)])
		h = d->twin[h]; /* the one that is more bound stays */
	a = d->v[h];
	b = mr_dyn_to(d, h);
	if (d->kind[a] == MR_SMOOTH) {
		p = merged_position(d, r->s, a, b, &at);
		if (overreaches(r, a, b, p, LONG, longest2) || overreaches(r, b, a, p, LONG, longest2))
			return;
	}
	if (!mr_dyn_can_collapse(d, h, r->mark))
		return;
	p = merged_position(d, r->s, a, b, &at);
	facing = mr_add(mr_dyn_normal_around(d, a), mr_dyn_normal_around(d, b));
	if (!move_is_good(d, a, b, p, facing, longest2, &strung) ||
	    !move_is_good(d, b, a, p, facing, longest2, &strung) ||
	    (strung && (r->strung[a] || r->strung[b])) || (d->kind[a] == MR_CURVE && cuts_curve(d, a, b, p)))
		return;
	mr_dyn_collapse(d, h, p);
	d->at[b] = at;
	mr_part_ask_around(r->part, b);
	r->strung[b] = strung;
	r->part->done[STRUNG] += strung;
	if (strung && d->kind[b] == MR_SMOOTH)
		d->at[b] = mr_remesh_place(r->s, d, b, p, mr_dyn_normal_around(d, b)).at.face;
	r->part->done[DONE]++;
}

static bool
is_short(const void *arg, uint32_t h)
{
	const resampler *r = arg;

	return is_edge(r->d, h) && too_short(r, h);
}

static void
collapse_short(const void *arg, mr_part *part, uint32_t h)
{
	resampler r = within(arg, part);

	if (too_short(&r, h))
		try_collapse(&r, h);
}

/* 2. Collapse all edges that are shorter than 4/5 l into their midpoint. */
void
mr_collapse_short(mr_ctx *ctx, mr_dyn *d, const mr_remesh_source *s, mr_resampled *done)
{
	mr_edge_queue_reserve(ctx, d, &done->queue);
	MR_SCOPE(ctx);
	resampler r = { .d = d, .s = s, .coarser = 1 };
	mr_edge_work work = { .is_due = is_short, .serve = collapse_short, .arg = &r };
	size_t n[2] = { 0, 0 };

	r.mark = MR_NEW_ZERO(ctx, d->nv, uint8_t);
	r.strung = MR_NEW_ZERO(ctx, d->nv, uint8_t);
	mr_serve_edges(ctx, d, &work, &done->queue, n);
	done->collapses += n[DONE];
	done->strung += n[STRUNG];
}
