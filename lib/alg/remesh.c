#include "alg/remesh.h"

#include "alg/facing.h"
#include "alg/folding.h"
#include "alg/iron.h"
#include "alg/project.h"
#include "alg/refine.h"
#include "alg/relax.h"
#include "alg/sizing.h"
#include "alg/tips.h"
#include "alg/valence.h"

/* The thresholds of steps 1 and 2 of the paper, relative to the target edge length. */
static const double LONG = 4.0 / 3, SHORT = 4.0 / 5;

/*
 * Beyond the paper: a strained lattice (a grid of right angles, say) has valence 6 everywhere and no edge
 * beyond those thresholds, so nothing would move it.  Its strain shows in the angles opposite its edges:
 * edges longer or shorter than these are split or merged too where both angles are that far from 60.
 */
static const double STRETCHED = 1.05, SQUEEZED = 0.95;
/* Shape of a face so thin that its normal is rounding. */
static const double HAIR = 1e-6;
static const double WIDE = 0.2588190451025207, NARROW = 0.7071067811865476; /* cosines of 75 and 45 degrees */

typedef struct remesher {
	mr_ctx *ctx;
	const mr_remesh_opts *o;
	mr_surface source;
	mr_dyn d;
	uint32_t *mark; /* stamps for the link condition; room for the vertices of one sweep */
	uint32_t stamp;
	size_t refused; /* collapses that would have folded */
	size_t splits, collapses, flips, tips;
	size_t flipped[2], folded[2]; /* faces and edges, of the input and of the result */
	double
	    variance[2]; /* of the vertex areas over their squared mean, before and after the area passes */
	double seconds_rounds, seconds_areas;
} remesher;

static double
edge_length2(const mr_dyn *d, uint32_t h)
{
	return mr_norm2(mr_sub(d->p[mr_dyn_to(d, h)], d->p[d->v[h]]));
}

/* The target length of the edge of h: of its finer end. */
static double
target(const remesher *r, uint32_t h)
{
	double a, b;

	if (!r->source.length && !r->d.scale)
		return r->source.uniform;
	a = mr_surface_length(&r->source, &r->d, r->d.v[h]);
	b = mr_surface_length(&r->source, &r->d, mr_dyn_to(&r->d, h));
	return a < b ? a : b;
}

/* One half-edge of each edge that lives. */
static bool
is_edge(const mr_dyn *d, uint32_t h)
{
	return !mr_dyn_face_dead(d, h / 3) && (d->twin[h] == MR_NONE || h < d->twin[h]);
}

static double
square(double x)
{
	return x * x;
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
 * such edges keeps the angles from collapsing.  Lengths grow on the way, so it ends.
 */
static uint32_t
locally_longest(const mr_dyn *d, uint32_t h)
{
	for (;;) {
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
}

/* Cosine of the angle opposite h in its face. */
static double
opposite_cosine(const mr_dyn *d, uint32_t h)
{
	mr_v3 c = d->p[mr_dyn_apex(d, h)], a = mr_sub(d->p[d->v[h]], c), b = mr_sub(d->p[mr_dyn_to(d, h)], c);

	return mr_dot(a, b) / sqrt(mr_norm2(a) * mr_norm2(b));
}

static bool
too_long(const remesher *r, uint32_t h)
{
	const mr_dyn *d = &r->d;
	double l = target(r, h), l2 = edge_length2(d, h);

	if (l2 > square(LONG * l))
		return true;
	return l2 > square(STRETCHED * l) && d->twin[h] != MR_NONE && opposite_cosine(d, h) < WIDE &&
	       opposite_cosine(d, d->twin[h]) < WIDE;
}

static bool
too_short(const remesher *r, uint32_t h)
{
	const mr_dyn *d = &r->d;
	double l = target(r, h), l2 = edge_length2(d, h);

	if (l2 < square(SHORT * l))
		return true;
	return l2 < square(SQUEEZED * l) && d->twin[h] != MR_NONE && opposite_cosine(d, h) > NARROW &&
	       opposite_cosine(d, d->twin[h]) > NARROW;
}

/* The place of a new vertex, first that of an end of its edge: a walk from there may not get to it. */
static void
place_middle(remesher *r, uint32_t m)
{
	const mr_surface *s = &r->source;
	mr_dyn *d = &r->d;
	mr_closest c = mr_project_walk(s->m, s->topo, d->at[m], d->p[m]);

	if (c.dist2 > square(MR_FAR * mr_surface_length(s, d, m)))
		c = mr_surface_place(s, d, m, d->p[m], mr_dyn_normal_around(d, m));
	d->at[m] = c.face;
}

/* 1. Split all edges that are longer than 4/3 l at their midpoint. */
static mr_status
split_long(remesher *r)
{
	mr_dyn *d = &r->d;

	for (uint32_t h = 0; h < 3 * d->nf; h++)
		while (is_edge(d, h) && too_long(r, h)) {
			uint32_t g = locally_longest(d, h), m;
			mr_v3 middle = mr_lerp(0.5, d->p[d->v[g]], d->p[mr_dyn_to(d, g)]);
			MR_TRY(mr_dyn_split(r->ctx, d, g, middle, &m));
			if (d->kind[m] == MR_SMOOTH)
				place_middle(r, m);
			r->splits++;
		}
	return MR_OK;
}

/*
 * True where moving v to p turns no face around v that stays (those with vertex `gone` do not) by
 * more than 60 degrees or away from `facing`, makes no needle worse and no edge longer than `longest`.
 */
static bool
move_is_good(const mr_dyn *d, uint32_t v, uint32_t gone, mr_v3 p, mr_v3 facing, double longest2)
{
	uint32_t h = d->out[v];

	do {
		uint32_t b = mr_dyn_to(d, h), c = mr_dyn_apex(d, h);
		mr_v3 pb = d->p[b], pc = d->p[c], pv = d->p[v];
		if (b != gone && c != gone) {
			mr_v3 before = mr_cross(mr_sub(pb, pv), mr_sub(pc, pv)),
			      after = mr_cross(mr_sub(pb, p), mr_sub(pc, p));
			double shape = mr_dyn_shape(pv, pb, pc), moved = mr_dyn_shape(p, pb, pc);
			if (mr_norm2(mr_sub(pb, p)) > longest2 || mr_norm2(mr_sub(pc, p)) > longest2)
				return false;
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

/* Where the merged vertex goes: the midpoint, or the end that must stay. */
static mr_v3
merged_position(const mr_dyn *d, uint32_t a, uint32_t b)
{
	if (d->kind[a] == d->kind[b])
		return mr_lerp(0.5, d->p[a], d->p[b]);
	return d->p[b];
}

static bool
try_collapse(remesher *r, uint32_t h, double longest2)
{
	mr_dyn *d = &r->d;
	uint32_t a, b;
	mr_v3 p, facing;

	if (d->twin[h] != MR_NONE && d->kind[d->v[h]] > d->kind[mr_dyn_to(d, h)])
		h = d->twin[h]; /* the one that is more bound stays */
	a = d->v[h];
	b = mr_dyn_to(d, h);
	if (!mr_dyn_can_collapse(d, h, r->mark, ++r->stamp))
		return false;
	p = merged_position(d, a, b);
	facing = mr_add(mr_dyn_normal_around(d, a), mr_dyn_normal_around(d, b));
	if (!move_is_good(d, a, b, p, facing, longest2) || !move_is_good(d, b, a, p, facing, longest2))
		return false;
	if (mr_merging_folds(d, &r->source, a, b, p)) {
		r->refused++;
		return false;
	}
	mr_dyn_collapse(d, h, p);
	if (d->scale && d->kind[b] == MR_SMOOTH)
		d->at[b] = mr_surface_place(&r->source, d, b, p, mr_dyn_normal_around(d, b)).face;
	r->collapses++;
	return true;
}

static mr_status
begin_marks(remesher *r)
{
	r->mark = MR_NEW_ZERO(r->ctx, r->d.nv, uint32_t);
	r->stamp = 0;
	return r->mark ? MR_OK : MR_EMEM;
}

/* 2. Collapse all edges that are shorter than 4/5 l into their midpoint. */
static mr_status
collapse_short(remesher *r)
{
	mr_dyn *d = &r->d;
	mr_mark mark;

	if (r->refused > 0 && !d->scale)
		MR_TRY(mr_refine_begin(r->ctx, d));
	mark = mr_mark_take(r->ctx);
	MR_TRY(begin_marks(r));
	for (uint32_t h = 0; h < 3 * d->nf; h++)
		if (is_edge(d, h) && too_short(r, h)) {
			size_t refused = r->refused;
			if (!try_collapse(r, h, square(LONG * target(r, h))) && r->refused > refused)
				mr_refine_edge(d, &r->source, h);
		}
	mr_mark_release(r->ctx, mark);
	return MR_OK;
}

/* Merges the ends of a side of h's face, the shortest first; true where one could be. */
static bool
collapse_a_side(remesher *r, uint32_t h)
{
	uint32_t side[3] = { h, mr_he_next(h), mr_he_prev(h) };

	for (int i = 0; i < 3; i++)
		for (int j = 2; j > i; j--)
			if (edge_length2(&r->d, side[j]) < edge_length2(&r->d, side[j - 1])) {
				uint32_t swap = side[j];
				side[j] = side[j - 1];
				side[j - 1] = swap;
			}
	for (int i = 0; i < 3; i++)
		if (try_collapse(r, side[i], square(2 * target(r, side[i]))))
			return true;
	return false;
}

/* Needles that the steps of the paper left: flips the longest side away, or takes the face out. */
static mr_status
mend_needles(remesher *r)
{
	mr_dyn *d = &r->d;
	mr_mark mark = mr_mark_take(r->ctx);

	MR_TRY(begin_marks(r));
	for (uint32_t f = 0; f < d->nf; f++) {
		const uint32_t *v = &d->v[3 * f];
		uint32_t longest;
		if (mr_dyn_face_dead(d, f) || mr_dyn_shape(d->p[v[0]], d->p[v[1]], d->p[v[2]]) >= MR_NEEDLE)
			continue;
		longest = longest_side(d, longest_side(d, 3 * f));
		if (mr_dyn_can_flip(d, longest) && mr_flip_is_good(d, &r->source, longest))
			mr_dyn_flip(d, longest);
		else
			collapse_a_side(r, 3 * f);
	}
	mr_mark_release(r->ctx, mark);
	return MR_OK;
}

/* 3. Flip edges to lower the deviation from valence 6 (4 on boundaries). */
static mr_status
regularize(remesher *r, unsigned reach)
{
	size_t flips;

	MR_TRY(mr_regularize(r->ctx, &r->d, &r->source, reach, &flips));
	r->flips += flips;
	return MR_OK;
}

/* At most `area_passes` passes of area-based smoothing; flips and projection keep up with it. */
static mr_status
equalize_areas(remesher *r)
{
	enum { EVERY = 5 };
	mr_relax_opts o = { .damping = 0.6, .gravity = r->o->gravity };

	for (size_t i = 1; i <= r->o->area_passes; i++) {
		o.project = r->o->project && (i % EVERY == 0 || i == r->o->area_passes);
		MR_TRY(mr_relax(r->ctx, &r->d, &r->source, &o));
		if (i % EVERY == 0)
			MR_TRY(regularize(r, 0));
	}
	mr_iron(&r->d, true);
	mr_mend_flaws(&r->d, &r->source);
	return MR_OK;
}

/*
 * One round of the paper's four steps.  In step 3 dislocations glide; the reach is short, since a long
 * glide shears the rows it passes more than the next relaxation can undo.
 */
static mr_status
one_round(remesher *r)
{
	enum { REACH = 3, RELAX = 3 };
	mr_relax_opts o = { .damping = 1, .gravity = r->source.length ? 1 : 0, .project = r->o->project };

	MR_TRY(split_long(r));
	MR_TRY(collapse_short(r));
	MR_TRY(mend_needles(r));
	MR_TRY(mr_dyn_compact(r->ctx, &r->d)); /* the first round leaves as many holes as vertices */
	MR_TRY(regularize(r, REACH));
	for (int i = 1; i <= RELAX; i++) {
		o.project = r->o->project && i == RELAX;
		MR_TRY(mr_relax(r->ctx, &r->d, &r->source, &o));
	}
	mr_iron(&r->d, false);
	return MR_OK;
}

/* Variance over squared mean of the areas of the inner vertices, in units of their squared lengths. */
static mr_status
area_variance(remesher *r, double *variance)
{
	const mr_dyn *d = &r->d;
	mr_mark mark = mr_mark_take(r->ctx);
	double *area = MR_NEW(r->ctx, d->nv, double), sum = 0, squares = 0, n = 0;

	if (!area)
		return MR_EMEM;
	mr_dyn_areas(r->ctx, d, area);
	for (uint32_t v = 0; v < d->nv; v++)
		if (d->kind[v] != MR_DEAD && !mr_dyn_on_boundary(d, v)) {
			double a = area[v] / square(mr_surface_length(&r->source, d, v));
			sum += a;
			squares += a * a;
			n++;
		}
	*variance = sum > 0 ? n * squares / (sum * sum) - 1 : 0;
	mr_mark_release(r->ctx, mark);
	return MR_OK;
}

static mr_status
run(remesher *r)
{
	double start = mr_seconds(), middle;

	for (size_t i = 0; i < r->o->rounds; i++) {
		MR_TRY(one_round(r));
		mr_refine_grade(&r->d, &r->source);
		if (i == 0 || i + 1 == r->o->rounds)
			MR_TRY(mr_dyn_order(r->ctx, &r->d)); /* the first round changes most */
		mr_progress(r->ctx, "remeshing", (double)(i + 1) / (double)(r->o->rounds + 1));
	}
	middle = mr_seconds();
	r->seconds_rounds = middle - start;
	MR_TRY(area_variance(r, &r->variance[0]));
	MR_TRY(equalize_areas(r));
	MR_TRY(area_variance(r, &r->variance[1]));
	r->seconds_areas = mr_seconds() - middle;
	return MR_OK;
}

/* Where each vertex lies on the source: on its face the nearest point, which without projection may be
 * elsewhere. */
static mr_status
map_to_source(remesher *r, mr_source_map *map)
{
	const mr_dyn *d = &r->d;
	const mr_surface *s = &r->source;
	uint32_t *face = MR_NEW(r->ctx, d->nv, uint32_t);
	mr_v3 *bary = MR_NEW(r->ctx, d->nv, mr_v3);

	if (!face || !bary)
		return MR_EMEM;
	for (size_t v = 0; v < d->nv; v++) {
		mr_closest c = mr_surface_place(
		    s, d, (uint32_t)v, d->p[v], mr_dyn_normal_around(d, (uint32_t)v));
		face[v] = c.face;
		bary[v] = c.bary;
	}
	*map = (mr_source_map){ face, bary };
	return MR_OK;
}

/* Triangles flipped and edges folded, of the input and of the result. */
static void
count_flaws(remesher *r, const mr_source_map *map)
{
	const mr_facing facing = { r->source.m, r->source.topo };
	mr_mesh view = mr_dyn_view(&r->d, r->source.m->name);

	r->flipped[0] = mr_count_flipped_source(&facing);
	r->flipped[1] = mr_count_flipped(&facing, &view, map);
	r->folded[0] = mr_count_folded(r->source.m, r->source.topo->twin);
	r->folded[1] = mr_count_folded(&view, r->d.twin);
}

/* How much finer and coarser than the uniform length adapted lengths may be. */
static const double ADAPTIVE_RANGE = 5;

/* Refuses a length that would take more faces than can be numbered. */
static mr_status
check_length(remesher *r, const mr_mesh *m, double length)
{
	double area = mr_mesh_area(r->ctx, m), faces = area / (sqrt(3) / 4 * length * length);

	if (!(area > 0))
		return mr_fail(r->ctx, MR_EMESH, "%s: the surface has no area", m->name);
	if (!(faces < (double)(MR_NONE / 6)))
		return mr_fail(r->ctx, MR_ERANGE,
		    "%s: edges of length %g would take about %.2g faces, more than %u", m->name, length,
		    faces, MR_NONE / 6);
	return MR_OK;
}

static mr_status
set_up(remesher *r, const mr_mesh *m, const mr_topology *topo)
{
	uint32_t *curve = NULL;
	double *length = NULL,
	       uniform = r->o->length > 0 ? r->o->length : r->o->ratio * mr_mesh_edge_scale(r->ctx, m);

	MR_TRY(check_length(r, m, uniform));
	MR_TRY(mr_dyn_build(r->ctx, m, topo, r->o->feature, &r->d));
	if (r->d.curve) {
		curve = MR_NEW(r->ctx, 3 * m->nf, uint32_t);
		if (!curve)
			return MR_EMEM;
		memcpy(curve, r->d.curve, 3 * m->nf * sizeof *curve);
	}
	if (r->o->adaptive > 0) {
		length = MR_NEW(r->ctx, m->nv, double);
		if (!length)
			return MR_EMEM;
		MR_TRY(mr_sizing_field(
		    r->ctx, m, r->o->adaptive, uniform / ADAPTIVE_RANGE, uniform * ADAPTIVE_RANGE, length));
	}
	r->source = (mr_surface){ m, topo, curve, length, uniform };
	return r->o->project ? mr_pin_tips(r->ctx, &r->d, &r->source, &r->tips) : MR_OK;
}

static void
report(const remesher *r)
{
	mr_stat_set(r->ctx, "length", r->source.uniform);
	mr_stat_set(r->ctx, "splits", (double)r->splits);
	mr_stat_set(r->ctx, "collapses", (double)r->collapses);
	mr_stat_set(r->ctx, "flips", (double)r->flips);
	mr_stat_set(r->ctx, "tips", (double)r->tips);
	mr_stat_set(r->ctx, "vertices", (double)r->d.nv);
	mr_stat_set(r->ctx, "faces", (double)r->d.nf);
	mr_stat_set(r->ctx, "area_variance_before", r->variance[0]);
	mr_stat_set(r->ctx, "area_variance_after", r->variance[1]);
	mr_stat_set(r->ctx, "flipped_before", (double)r->flipped[0]);
	mr_stat_set(r->ctx, "flipped", (double)r->flipped[1]);
	mr_stat_set(r->ctx, "folded_before", (double)r->folded[0]);
	mr_stat_set(r->ctx, "folded", (double)r->folded[1]);
	mr_stat_set(r->ctx, "seconds_rounds", r->seconds_rounds);
	mr_stat_set(r->ctx, "seconds_areas", r->seconds_areas);
}

mr_status
mr_remesh(mr_ctx *ctx, const mr_mesh *m, const mr_remesh_opts *o, mr_mesh *out, mr_source_map *map)
{
	remesher r = { .ctx = ctx, .o = o };
	mr_topology topo;

	MR_TRY(mr_topology_build(ctx, m, &topo));
	MR_TRY(set_up(&r, m, &topo));
	MR_TRY(run(&r));
	MR_TRY(mr_dyn_compact(ctx, &r.d));
	MR_TRY(map_to_source(&r, map));
	count_flaws(&r, map);
	report(&r);
	*out = mr_dyn_view(&r.d, m->name);
	return MR_OK;
}
