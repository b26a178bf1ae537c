/* Edges between faces of a mesh that meet at a large angle, larger than those around. */
#include "simplify/sharp_edges.h"

#include "base/disjoint_sets.h"

/* Degrees between faces. */
static const double SHARP = 40;

/* At most this share of a piece's mean edge angle is the mean angle of the other edges of its faces: machine
 * parts have up to 0.07, scanned bodies 0.09 and more. */
static const double AROUND = 0.08;

/* Cosine: a sharp edge that turns by more has a corner. */
static const double TURN = 0.7071067811865476;

/* A connected piece of the curves. */
typedef struct piece {
	double length, sharp, around; /* sums of lengths and angles */
	size_t n, beside;             /* edges; others of their faces */
} piece;

static double
bend(const mr_dyn *d, uint32_t h)
{
	uint32_t g = d->twin[h];

	return g == MR_NONE
	           ? 0
	           : mr_angle(mr_unit(mr_dyn_cross(d, d->p, h / 3)), mr_unit(mr_dyn_cross(d, d->p, g / 3))) *
	                 180 / MR_PI;
}

static void
mark(const mr_dyn *d)
{
	for (uint32_t h = 0; h < 3 * d->nf; h++)
		d->curve[h] = d->twin[h] != MR_NONE && bend(d, h) > SHARP ? h : MR_NONE;
}

static void
measure(const mr_dyn *d, uint32_t h, piece *p)
{
	uint32_t side[2] = { mr_he_next(h), mr_he_prev(h) };

	p->length += mr_dist(d->p[d->v[h]], d->p[mr_dyn_to(d, h)]) / 2;
	p->sharp += bend(d, h);
	p->n++;
	for (int k = 0; k < 2; k++)
		if (!mr_dyn_on_curve(d, side[k]) && d->twin[side[k]] != MR_NONE) {
			p->around += bend(d, side[k]);
			p->beside++;
		}
}

/* The shorter, the sharper it must be relative to its surroundings: small bores and pins are. */
static bool
counts(const piece *p, double length)
{
	double most = AROUND * fmin(1, p->length / length);

	return p->around * (double)p->n <= most * p->sharp * (double)p->beside;
}

static void
drop_pieces(mr_ctx *ctx, const mr_dyn *d, double length)
{
	mr_mark here = mr_mark_take(ctx);
	uint32_t *set = mr_sets_new(ctx, d->nv);
	piece *of = MR_NEW_ZERO(ctx, d->nv, piece);

	for (uint32_t h = 0; h < 3 * d->nf; h++)
		if (mr_dyn_on_curve(d, h))
			mr_sets_join(set, d->v[h], mr_dyn_to(d, h));
	for (uint32_t h = 0; h < 3 * d->nf; h++)
		if (mr_dyn_on_curve(d, h))
			measure(d, h, &of[mr_sets_root(set, d->v[h])]);
	for (uint32_t h = 0; h < 3 * d->nf; h++)
		if (mr_dyn_on_curve(d, h) && !counts(&of[mr_sets_root(set, d->v[h])], length))
			d->curve[h] = MR_NONE;
	mr_mark_release(ctx, here);
}

/* Whether two curve edges meet at v, their ends, and the cosine between them. */
static bool
turn_at(const mr_dyn *d, uint32_t v, uint32_t end[2], double *turn)
{
	if (mr_dyn_along(d, v, end) != 2)
		return false;
	*turn = mr_dot(mr_unit(mr_sub(d->p[v], d->p[end[0]])), mr_unit(mr_sub(d->p[end[1]], d->p[v])));
	return true;
}

/* Whether the curve from v by w meets others within `reach`, or turns more than at v. */
static bool
is_outdone(const mr_dyn *d, uint32_t v, double turn, uint32_t w, double reach)
{
	uint32_t from = v, end[2], next;
	double there;

	for (; w != v && mr_dist(d->p[v], d->p[w]) < reach; from = w, w = next) {
		if (!turn_at(d, w, end, &there) || there < turn || (!(there > turn) && w < v))
			return true;
		next = end[0] == from ? end[1] : end[0];
	}
	return false;
}

/* The kind of v, with a corner where a curve turns the most within `reach`, if that is not 0; and of
 * boundaries without sharp edges no corner: scans have ragged ones. */
static mr_kind
kind_of(const mr_dyn *d, uint32_t v, double reach)
{
	uint32_t end[2];
	double turn;

	if (d->kind[v] == MR_DEAD || mr_dyn_along(d, v, end) == 0)
		return (mr_kind)d->kind[v];
	if (!turn_at(d, v, end, &turn))
		return MR_CORNER;
	return mr_dyn_on_boundary(d, v) || reach == 0 || turn > TURN ||
	               is_outdone(d, v, turn, end[0], reach) || is_outdone(d, v, turn, end[1], reach)
	           ? MR_CURVE
	           : MR_CORNER;
}

bool
mr_sharp_edges(mr_ctx *ctx, mr_dyn *d, double length, double reach)
{
	bool any = false;

	if (!d->curve) {
		d->curve = MR_NEW(ctx, 3 * d->nf, uint32_t);
		mark(d);
		if (length > 0)
			drop_pieces(ctx, d, length);
	}
	for (uint32_t h = 0; h < 3 * d->nf; h++)
		any |= mr_dyn_on_curve(d, h);
	if (!any) {
		d->curve = NULL;
		return false;
	}
	for (uint32_t h = 0; h < 3 * d->nf; h++)
		if (d->twin[h] == MR_NONE)
			d->curve[h] = h;
	for (uint32_t v = 0; v < d->nv; v++)
		d->kind[v] = (uint8_t)kind_of(d, v, reach);
	return true;
}

/* Marks the edge at v that bends most of those that are not sharp. */
static void
mark_corner(const mr_dyn *d, uint32_t v, uint8_t *sharp)
{
	uint32_t h = d->out[v], most = MR_NONE;

	do {
		if (!mr_dyn_on_curve(d, h) && (most == MR_NONE || bend(d, h) > bend(d, most)))
			most = h;
		h = mr_dyn_ccw(d, h);
	} while (h != MR_NONE && h != d->out[v]);
	if (most != MR_NONE)
		sharp[most] = sharp[d->twin[most]] = 1;
}

void
mr_mark_sharp_edges(const mr_dyn *d, uint8_t *sharp)
{
	uint32_t end[2];

	memset(sharp, 0, 3 * d->nf);
	for (uint32_t h = 0; h < 3 * d->nf; h++)
		if (!mr_dyn_face_dead(d, h / 3) && d->twin[h] != MR_NONE)
			sharp[h] = mr_dyn_on_curve(d, h);
	for (uint32_t v = 0; v < d->nv; v++)
		if (d->kind[v] == MR_CORNER && mr_dyn_along(d, v, end) == 2)
			mark_corner(d, v, sharp);
}
