/*
 * Rounds of the four steps of Botsch, Kobbelt 2004, section 4, then passes that even out areas, then
 * repairs.
 */
#include "remesh/remesh.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "mesh/dynmesh.h"
#include "remesh/extremities.h"
#include "remesh/flaws.h"
#include "remesh/flip.h"
#include "remesh/relax.h"
#include "remesh/sizing.h"
#include "remesh/split_collapse.h"

enum { GRAIN = 1024 };

typedef struct remesher {
	mr_ctx *ctx;
	const mr_remesh_opts *o;
	mr_remesh_source source;
	uint32_t *curve; /* of the source */
	double *length;  /* at the vertices of the source; NULL: uniform */
	double *mean;    /* at its faces */
	mr_dyn d;
	mr_resampled changes;
	size_t flips;
	size_t tidied;  /* splits and collapses when neighbours were last brought together */
	mr_flaws flaws; /* of the result */
	double
	    variance[2]; /* of the vertex areas over their squared mean, before and after the area passes */
} remesher;

/* 3. Flip edges to lower the deviation from valence 6 (4 on boundaries). */
static void
regularize(remesher *r, unsigned reach)
{
	size_t flips;

	mr_regularize(r->ctx, &r->d, reach, &flips);
	r->flips += flips;
}

/* Variance over squared mean of the areas of the inner vertices, in units of their squared lengths. */
static void
area_variance(remesher *r, double *variance)
{
	const mr_dyn *d = &r->d;
	MR_SCOPE(r->ctx);
	double *area, sum = 0, squares = 0, n = 0;

	area = MR_NEW(r->ctx, d->nv, double);
	mr_dyn_areas(r->ctx, d, r->source.uniform, area);
	for (uint32_t v = 0; v < d->nv; v++)
		if (d->kind[v] != MR_DEAD && !mr_dyn_on_boundary(d, v)) {
			double a = area[v] /
			           mr_square(mr_remesh_length(&r->source, d, v) / r->source.uniform);
			sum += a;
			squares += a * a;
			n++;
		}
	*variance = sum > 0 ? n * squares / (sum * sum) - 1 : 0;
}

/*
 * True where the areas have not become evener by a hundredth.  Rounds on the noisy surface of a CT scan split
 * and merge a fifth of the vertices to and fro, and leave them less even from the third on, and where they
 * are held by its sharp edges area passes change nothing after the tenth; clean models gain 2 % in each.
 */
static bool
is_still(double before, double after)
{
	const double GAIN = 0.01;

	return after > (1 - GAIN) * before;
}

/* Passes of area-based smoothing, as many as are wanted or even anything out; flips and projection keep up
 * with it. */
static mr_status
equalize_areas(remesher *r)
{
	enum { EVERY = 5 };
	mr_relax_opts o = { .damping = 0.6, .gravity = r->o->gravity, .project = r->o->project };

	area_variance(r, &r->variance[0]);
	r->variance[1] = r->variance[0];
	for (size_t left = r->o->area_passes; left > 0; left -= o.passes) {
		double before = r->variance[1];
		o.passes = left < EVERY ? left : EVERY;
		MR_TRY(mr_relax(r->ctx, &r->d, &r->source, &o));
		if (o.passes == EVERY)
			regularize(r, 0);
		area_variance(r, &r->variance[1]);
		if (is_still(before, r->variance[1]))
			break;
	}
	return MR_OK;
}

/*
 * Dense parts are thinned before the first split, which bisects far more edges than it must; edges that
 * cannot be merged yet may be after the first round.
 */
static void
thin_out(remesher *r)
{
	size_t before, enough = 8;

	do {
		before = r->changes.strung;
		mr_collapse_short(r->ctx, &r->d, &r->source, &r->changes);
	} while (r->changes.strung - before > r->d.nv / enough);
}

static size_t
changes(const remesher *r)
{
	return r->changes.splits + r->changes.collapses;
}

/*
 * True where half as many edges as there are vertices were split or merged since, of more than a cache holds:
 * the noisy surface of a CT scan changes as much in every round, and without this its fifth took twice as
 * long as its second.  The lengths of smaller ones come out a little evener without it.
 */
static bool
is_untidy(const remesher *r)
{
	enum { CACHED = 1 << 18 };

	return r->d.nv > CACHED && changes(r) - r->tidied > r->d.nv / 2;
}

/* Neighbours close together in memory. */
static mr_status
tidy(remesher *r)
{
	r->tidied = changes(r);
	return mr_blocks_divide(r->ctx, &r->d);
}

/*
 * One round of the paper's four steps.  In step 3 dislocations glide; the reach is short, since a long
 * glide shears the rows it passes more than the next relaxation can undo.
 *
 * The first round bisects edges that are much too long step by step, all to twice the length before any to
 * the length, and dense parts are thinned in between. Bisected all at once, a sliver leaves slivers like it,
 * four times as many for edges half as long.
 */
static mr_status
one_round(remesher *r, bool first)
{
	enum { REACH = 3, RELAX = 3 };
	mr_relax_opts o = {
		.damping = 1, .gravity = r->source.length ? 1 : 0, .passes = RELAX, .project = r->o->project
	};

	for (double coarser = first ? mr_coarsest(&r->d, &r->source) : 1; coarser > 1; coarser /= 2) {
		MR_TRY(mr_split_long(r->ctx, &r->d, &r->source, coarser, &r->changes));
		thin_out(r);
	}
	MR_TRY(mr_split_long(r->ctx, &r->d, &r->source, 1, &r->changes));
	mr_collapse_short(r->ctx, &r->d, &r->source, &r->changes);
	if (first)
		MR_TRY(tidy(r)); /* it leaves as many holes as vertices */
	regularize(r, REACH);
	MR_TRY(mr_relax(r->ctx, &r->d, &r->source, &o));
	return MR_OK;
}

/* How much finer and coarser than the uniform length adapted lengths may be. */
static const double ADAPTIVE_RANGE = 5;

static void
find_means(remesher *r)
{
	const mr_mesh *m = r->source.m;

	for (size_t f = 0; r->length && f < m->nf; f++) {
		const uint32_t *v = m->t[f].v;
		r->mean[f] = (r->length[v[0]] + r->length[v[1]] + r->length[v[2]]) / 3;
	}
}

/* All lengths, by a factor. */
static void
lengthen(remesher *r, double factor)
{
	r->source.uniform *= factor;
	for (size_t v = 0; r->length && v < r->source.m->nv; v++)
		r->length[v] *= factor;
	find_means(r);
}

/* By how much longer a length gives so many faces: flat / c^2 + thin / c = faces. */
static double
factor_for(mr_demand n, double faces)
{
	return (n.thin + sqrt(mr_square(n.thin) + 4 * faces * n.flat)) / (2 * faces);
}

/* How many faces there are to be; 0: as many as the length gives.  A closed surface has twice as many as
 * vertices. */
static double
faces_wanted(const mr_remesh_opts *o)
{
	return o->faces > 0 ? (double)o->faces : 2 * (double)o->vertices;
}

/* How many times as many as are wanted there are; 1 where none is. */
static double
excess(const remesher *r)
{
	size_t vertices = 0, faces = 0;

	for (size_t v = 0; v < r->d.nv; v++)
		vertices += r->d.kind[v] != MR_DEAD;
	for (size_t f = 0; f < r->d.nf; f++)
		faces += !mr_dyn_face_dead(&r->d, f);
	if (r->o->faces > 0)
		return (double)faces / (double)r->o->faces;
	return r->o->vertices > 0 ? (double)vertices / (double)r->o->vertices : 1;
}

static bool
misses(double excess)
{
	return fabs(excess - 1) > 0.05;
}

static mr_status
set_up(remesher *r, const mr_mesh *m, const mr_topology *topo, const uint8_t *seam)
{
	double adaptive = r->o->adaptive * (r->o->adaptive_relative ? mr_mesh_diagonal(m) : 1),
	       uniform = r->o->length * (r->o->length_relative ? mr_mesh_diagonal(m) : 1);

	if (!(uniform > 0))
		uniform = r->o->ratio * mr_mesh_edge_scale(r->ctx, m);
	if (!(mr_mesh_area(r->ctx, m) > 0))
		return mr_fail(r->ctx, MR_EMESH, "%s: the surface has no area", m->name);
	MR_TRY(mr_dyn_build(r->ctx, m, topo, seam, r->o->feature, &r->d));
	if (r->d.curve) {
		r->curve = MR_NEW(r->ctx, 3 * m->nf, uint32_t);
		memcpy(r->curve, r->d.curve, 3 * m->nf * sizeof *r->curve);
	}
	if (adaptive > 0) {
		r->length = MR_NEW(r->ctx, m->nv, double);
		mr_sizing_field(r->ctx, m, topo, &r->d, adaptive, uniform / ADAPTIVE_RANGE,
		    uniform * ADAPTIVE_RANGE, r->length);
	} else if (r->o->lengths) {
		r->length = MR_NEW(r->ctx, m->nv, double);
		memcpy(r->length, r->o->lengths, m->nv * sizeof *r->length);
		mr_sizing_grade(r->ctx, m, topo, r->length);
	} else if (r->o->feature < 180) {
		mr_sizing_curves(r->ctx, m, topo, &r->d, uniform, &r->length);
	}
	r->mean = r->length ? MR_NEW(r->ctx, m->nf, double) : NULL;
	r->source = (mr_remesh_source){ m, topo, r->curve, r->length, r->mean, uniform };
	find_means(r);
	/* By area alone: where the surface is thinner than its edges that is too short, which the rounds
	 * mend. One too long they cannot: it flattens limbs for good. */
	if (faces_wanted(r->o) > 0)
		lengthen(r, sqrt(mr_remesh_demand(&r->d, &r->source).area / faces_wanted(r->o)));
	if (r->o->project)
		mr_pin_tips(r->ctx, &r->d, &r->source);
	return MR_OK;
}

/*
 * Bytes a face, beside the source's: at the peak, the first split, 81 to 86 a demanded face, and up to 125
 * where flaws are mended.
 */
static const double FACE_BYTES = 125;

/*
 * By their ratio, lengths are to give about as many faces as there are: of 130 models none demands more than
 * ten times as many, and it is a rod of 12,000 slivers that does.
 */
static const double FACE_SHARE = 100;

static double
most_faces(const mr_mesh *m, const mr_remesh_opts *o)
{
	double most = fmin(MR_NONE / 6, mr_memory_available() / FACE_BYTES),
	       finest = fmax(1, 1 / o->ratio) * (o->adaptive > 0 ? ADAPTIVE_RANGE : 1);

	if (o->length > 0 || faces_wanted(o) > 0)
		return most;
	return fmin(most, FACE_SHARE * mr_square(finest) * (double)m->nf);
}

/* Refuses a length that would take more faces than can be numbered, or be kept in memory. */
static mr_status
check_demand(remesher *r)
{
	mr_demand n = mr_remesh_demand(&r->d, &r->source);
	double faces = n.flat + n.thin, most = most_faces(r->source.m, r->o);

	r->changes.most = (size_t)most;
	if (faces <= most)
		return MR_OK;
	if (!isfinite(faces))
		return mr_fail(r->ctx, MR_ERANGE,
		    "%s: edges of length %g take more faces than can be counted", r->source.m->name,
		    r->source.uniform);
	return mr_too_fine(r->ctx, &r->source, faces, most, r->source.uniform * factor_for(n, most));
}

/*
 * Between rounds the length grows by the root of how many times too many there are, since faces go with its
 * square; where there still are when the rounds are over, the surface is thinner than its edges, and they go
 * with the length itself.
 */
static mr_status
run(remesher *r)
{
	enum { SETTLED = 2 }; /* the rounds before reach the target density, which may be less even */
	double before = INFINITY, after, had = 1;
	size_t rounds = r->o->rounds;

	if (rounds > 0) {
		MR_TRY(tidy(r));
		thin_out(r);
	}
	MR_TRY(check_demand(r));
	for (size_t i = 0; i < rounds; i++) {
		if (i > 0) {
			double now = excess(r);
			bool thin = i >= r->o->rounds && had > 1 && now > 1;
			lengthen(r, thin ? now : sqrt(now));
			had = now;
		}
		MR_TRY(one_round(r, i == 0));
		area_variance(r, &after);
		if (i >= SETTLED && is_still(before, after) && !misses(excess(r)))
			rounds = i + 1;
		before = after;
		if (i + 1 == rounds && misses(excess(r)) && rounds < 2 * r->o->rounds)
			rounds++; /* it was far more, or is thinner than its edges */
		if (i + 1 == rounds || is_untidy(r))
			MR_TRY(tidy(r));
		mr_progress(r->ctx, "remeshing", (double)(i + 1) / (double)(rounds + 1));
	}
	return equalize_areas(r);
}

typedef struct mapping {
	const remesher *r;
	uint32_t *face;
	mr_v3 *bary;
} mapping;

static void
map_body(void *arg, size_t begin, size_t end)
{
	const mapping *j = arg;
	const mr_dyn *d = &j->r->d;

	for (uint32_t v = (uint32_t)begin; v < end; v++) {
		mr_closest c = mr_remesh_place(&j->r->source, d, v, d->p[v], mr_dyn_normal_around(d, v));
		j->face[v] = c.at.face;
		j->bary[v] = c.at.bary;
	}
}

/* The place of each vertex on the source: the nearest point of its face, which may differ without
 * projection. */
static void
map_to_source(remesher *r, mr_places *map)
{
	uint32_t *face = MR_NEW(r->ctx, r->d.nv, uint32_t);
	mr_v3 *bary = MR_NEW(r->ctx, r->d.nv, mr_v3);

	mr_parallel(r->ctx, r->d.nv, GRAIN, map_body, &(mapping){ r, face, bary });
	*map = (mr_places){ face, bary };
}

static void
find_kept(const remesher *r, mr_kept *kept)
{
	uint32_t *along = MR_NEW(r->ctx, 3 * r->d.nf, uint32_t);

	for (uint32_t h = 0; h < 3 * r->d.nf; h++) {
		uint32_t c = mr_dyn_curve(&r->d, h);
		along[h] = c != MR_NONE && kept->seam[c] ? c : MR_NONE;
	}
	kept->along = along;
}

static mr_remesh_result
report(const remesher *r)
{
	return (mr_remesh_result){ .length = r->source.uniform,
		.splits = r->changes.splits,
		.collapses = r->changes.collapses,
		.flips = r->flips,
		.vertices = r->d.nv,
		.faces = r->d.nf,
		.area_variance_before = r->variance[0],
		.area_variance_after = r->variance[1],
		.flipped = r->flaws.flipped,
		.folded = r->flaws.folded };
}

mr_status
mr_remesh(mr_ctx *ctx, const mr_mesh *m, const mr_remesh_opts *o, mr_kept *kept, mr_mesh *out, mr_places *map,
    mr_remesh_result *result)
{
	remesher r = { .ctx = ctx, .o = o };
	mr_topology topo;

	MR_TRY(mr_topology_build(ctx, m, &topo));
	MR_TRY(set_up(&r, m, &topo, kept ? kept->seam : NULL));
	MR_TRY(run(&r));
	r.flaws = mr_flaws_count(ctx, &r.d, &r.source);
	if (r.flaws.flipped + r.flaws.folded > 0 && o->rounds > 0) {
		mr_mend_flaws(ctx, &r.d, &r.source);
		r.flaws = mr_flaws_count(ctx, &r.d, &r.source);
	}
	MR_TRY(mr_dyn_compact(ctx, &r.d));
	map_to_source(&r, map);
	if (kept && kept->seam)
		find_kept(&r, kept);
	if (misses(excess(&r)))
		mr_found(ctx, &(mr_finding){ .kind = MR_LIMIT,
				  .layer = "base",
				  .what = "thin parts need more vertices than asked for" });
	if (result)
		*result = report(&r);
	*out = mr_dyn_view(&r.d, m->name);
	return MR_OK;
}
