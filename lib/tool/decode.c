/* mr-decode: the reconstruction operator of both papers, detail onto a base or heights onto a subdivision
 * surface, posed by its response first where handles are there. */
#include "base/options.h"
#include "base/text.h"
#include "edit/chord.h"
#include "edit/detail.h"
#include "edit/handles.h"
#include "edit/held.h"
#include "edit/pose_basis.h"
#include "edit/strayed.h"
#include "measure/gaps.h"
#include "measure/harm.h"
#include "tool/cache.h"

/* Whether what was kept of a column is still true of the frame; where it is not, the arena is emptied. */
static bool
still_there(
    const mr_ctx *ctx, const mr_frame *f, const char *layer, const char *name, uint64_t *kept, mr_ctx *keep)
{
	uint64_t serial = mr_frame_find(f, layer, name)->serial;

	if (!f->key && serial && serial == *kept)
		return true;
	mr_ctx_free(mr_cache_arena(ctx, keep));
	*kept = 0;
	return false;
}

/* The faces around the vertices of base, which are to be those over which mesh was encoded. */
static mr_status
base_incidence(mr_ctx *ctx, mr_cache *cache, mr_frame *f, const mr_mesh *base, mr_incidence *inc)
{
	mr_connectivity_cache *kept;

	if (!cache) {
		MR_TRY(mr_detail_check_faces(ctx, f, base));
		return mr_incidence_build(ctx, base, inc);
	}
	kept = &cache->connectivity;
	if (!still_there(ctx, f, base->name, "triangles", &kept->base_serial, &cache->base_keep)) {
		MR_TRY(mr_detail_check_faces(ctx, f, base));
		MR_TRY(mr_fail_as(
		    ctx, &cache->base_keep, mr_incidence_build(&cache->base_keep, base, &kept->base)));
		kept->base_serial = mr_frame_find(f, base->name, "triangles")->serial;
		kept->rest_serial = 0;
		kept->rest_normal = kept->at_rest.p = kept->before.p = NULL;
	}
	*inc = kept->base;
	return MR_OK;
}

/* The normals of base where it was encoded, if that is known. */
static mr_status
rest_normals(mr_ctx *ctx, mr_cache *cache, const mr_frame *f, const mr_mesh *base, const mr_incidence *inc,
    mr_detail *d)
{
	mr_connectivity_cache *kept = cache ? &cache->connectivity : NULL;
	mr_ctx *keep = cache ? &cache->base_keep : ctx;
	mr_v3 *normal = cache ? kept->rest_normal : NULL;
	mr_mesh rest = *base;
	uint64_t serial;

	if (!d->rest)
		return MR_OK;
	rest.p = d->rest;
	d->rest_normal = normal;
	serial = mr_frame_find(f, base->name, "encoded")->serial;
	if (normal && !f->key && serial && serial == kept->rest_serial)
		return MR_OK;
	if (!normal)
		normal = MR_NEW(keep, base->nv, mr_v3);
	if (!normal)
		return mr_fail_as(ctx, keep, MR_EMEM);
	MR_TRY(mr_vertex_normals(ctx, &rest, inc, normal));
	d->rest_normal = normal;
	if (cache) {
		kept->rest_normal = normal;
		kept->rest_serial = serial;
	}
	return MR_OK;
}

/*
 * Poses the layer by its response, and warns of what that cannot do, once from key to key.  Half-way to a
 * handle that is twisted by 60 degrees a limb is 0.87 times as wide, and models that are bent or twisted by
 * so much lose 3 to 15 % of their volume; by 90 degrees up to 27 %.
 */
static mr_status
respond(mr_ctx *ctx, mr_frame *f, mr_cache *cache, mr_mesh *m)
{
	static const double most = 60;
	double degrees;

	MR_TRY(mr_response_apply(ctx, f, m, &degrees));
	if (cache && f->key)
		cache->turned_far = false;
	if (degrees <= most * (1 + 1e-9) || (cache && cache->turned_far))
		return MR_OK;
	if (cache)
		cache->turned_far = true;
	mr_warn(ctx,
	    "%s: a handle turns by %.0f degrees against what is fixed or another, and a response is linear: "
	    "beyond %.0f it thins what is between; mr-solve does not",
	    m->name, degrees, most);
	return MR_OK;
}

static mr_status
find_neighbours(mr_ctx *ctx, const mr_mesh *mesh, mr_edges *edges, mr_contacts *contacts)
{
	/* Of the diagonal.  Of 78 models of several parts, bent, 23 have some that come apart by a third of
	 * this, 28 by this, among them a house whose windows its straight walls leave, as many by 0.005. */
	const double touch = 0.003;

	MR_TRY(mr_contacts_find(ctx, mesh, touch * mr_mesh_diagonal(mesh), contacts));
	return mr_edges_build(ctx, mesh, edges);
}

/* The edges of mesh, and where its parts touch. */
static mr_status
mesh_neighbours(mr_ctx *ctx, mr_cache *cache, const mr_frame *f, const mr_mesh *mesh, mr_edges *edges,
    mr_contacts *contacts)
{
	mr_connectivity_cache *kept;

	if (!cache)
		return find_neighbours(ctx, mesh, edges, contacts);
	kept = &cache->connectivity;
	if (kept->place_serial != mr_frame_find(f, mesh->name, "position")->serial)
		kept->mesh_serial = 0; /* parts may touch elsewhere */
	if (!still_there(ctx, f, mesh->name, "triangles", &kept->mesh_serial, &cache->mesh_keep)) {
		MR_TRY(mr_fail_as(ctx, &cache->mesh_keep,
		    find_neighbours(&cache->mesh_keep, mesh, &kept->mesh, &kept->contacts)));
		kept->mesh_serial = mr_frame_find(f, mesh->name, "triangles")->serial;
		kept->place_serial = mr_frame_find(f, mesh->name, "position")->serial;
	}
	*edges = kept->mesh;
	*contacts = kept->contacts;
	return MR_OK;
}

static double
longest_edge_at(const mr_mesh *m, uint32_t vertex)
{
	double longest = 0;

	for (size_t f = 0; f < m->nf; f++)
		for (int k = 0; k < 3; k++)
			if (m->t[f].v[k] == vertex || m->t[f].v[(k + 1) % 3] == vertex)
				longest = fmax(
				    longest, mr_dist(m->p[m->t[f].v[k]], m->p[m->t[f].v[(k + 1) % 3]]));
	return longest;
}

/*
 * Where the edges at the harm are too long to follow the base, the step that splits them as finely as that
 * is. It was tried on 23 edits with harm: of 16 with edges of over five of the base's lengths 12 had none
 * after that, of the others none.
 */
static void
advise(mr_ctx *ctx, const mr_mesh *mesh, const mr_mesh *base, uint32_t vertex, char *advice, size_t size)
{
	const double coarse = 5;
	double edge = mr_mesh_edge_scale(ctx, base), longest = longest_edge_at(mesh, vertex);

	if (longest > coarse * edge)
		snprintf(advice, size,
		    "; its edges are long, up to %.3g: split them first, by mr-subdivide --longest %.3g",
		    longest, edge);
}

/* "3 more folded edges of mesh and 40 more intersecting pairs of near faces", without what there is none of.
 */
static void
name_harm(const mr_harm *h, size_t pairs, char *text, size_t size)
{
	int n = 0;

	if (h->folds)
		n = snprintf(text, size, "%zu more folded edge%s of mesh", h->folds, mr_plural(h->folds));
	if (pairs)
		snprintf(text + n, size - (size_t)n, "%s%zu more intersecting pair%s of near faces%s",
		    n ? " and " : "", pairs, mr_plural(pairs), n ? "" : " of mesh");
}

/*
 * Tells of harm: of a sequence again where it is twice as much as was told.  Few are told under -v alone:
 * over 5 folds or 20 pairs have 41 of 318 edits of 106 models, all 14 that are wrecked among them; one of
 * either have 90; of few faces fewer do.  base: that it follows, or NULL.
 */
static void
tell(mr_ctx *ctx, mr_cache *cache, const mr_mesh *mesh, const mr_mesh *base, const mr_v3 *p, const mr_harm *h)
{
	enum { FOLDS = 5, PAIRS = 20 };
	size_t pairs = h->pairs == MR_UNKNOWN ? 0 : h->pairs, all = h->folds + pairs, nf = mesh->nf,
	       *told = cache ? &cache->connectivity.told : NULL;
	char advice[120] = "", found[160];

	name_harm(h, pairs, found, sizeof found);
	if (h->folds <= (nf < 12 * FOLDS ? nf / 12 : FOLDS) && pairs <= (nf < 5 * PAIRS ? nf / 5 : PAIRS)) {
		if (all)
			mr_note(ctx, "%s: few", found);
		return;
	}
	if (!mr_is_news(all, told))
		return;
	if (base)
		advise(ctx, mesh, base, h->vertex, advice, sizeof advice);
	mr_warn(ctx, "%s, most of them at vertex %u (%.4g, %.4g, %.4g)%s", found, h->vertex, p[h->vertex].x,
	    p[h->vertex].y, p[h->vertex].z, advice);
}

/* The same of far faces, and of parts. */
static void
tell_far(mr_ctx *ctx, mr_cache *cache, const mr_v3 *p, const mr_harm *h)
{
	enum { PAIRS = 20 };
	size_t *told = cache ? &cache->connectivity.told_far : NULL;

	if (h->far == MR_UNKNOWN || h->far <= PAIRS || !mr_is_news(h->far, told))
		return;
	mr_warn(ctx,
	    "%zu more intersecting pairs of faces of mesh that are far from each other along it, or of two "
	    "parts: limbs meet, or sheets pass through each other, most of them at vertex %u (%.4g, %.4g, "
	    "%.4g)",
	    h->far, h->far_vertex, p[h->far_vertex].x, p[h->far_vertex].y, p[h->far_vertex].z);
}

/* Warns of detail that is torn where base is not. */
static size_t
look_for_strayed(mr_ctx *ctx, mr_cache *cache, const mr_mesh *mesh, const mr_edges *edges,
    const mr_mesh *base, const mr_detail *d, const mr_v3 *p)
{
	enum { FEW = 5 };
	size_t *told = cache ? &cache->connectivity.told_strayed : NULL;
	mr_strayed s = mr_strayed_find(mesh, edges, p, base, d);

	if (s.edges <= FEW || !mr_is_news(s.edges, told))
		return s.edges;
	mr_warn(ctx,
	    "detail is torn: %zu of %zu edges of mesh are over twice as long, or under half as long, as base "
	    "has them there, most at vertex %u (%.4g, %.4g, %.4g)",
	    s.edges, edges->count, s.vertex, p[s.vertex].x, p[s.vertex].y, p[s.vertex].z);
	return s.edges;
}

/* Warns of straight edges that cut across a bend of base, or a twist. */
static mr_status
look_for_chords(mr_ctx *ctx, mr_cache *cache, const mr_mesh *mesh, const mr_edges *edges, const mr_mesh *base,
    const mr_incidence *inc, const mr_detail *d, const mr_v3 *p, size_t *count)
{
	const double far = 0.01; /* of the diagonal */
	double diagonal = mr_mesh_diagonal(mesh);
	size_t *told = cache ? &cache->connectivity.told_chords : NULL;
	mr_chords c;

	MR_TRY(mr_chords_find(ctx, mesh, edges, p, base, inc, d, far * diagonal, &c));
	*count = c.edges;
	if (!mr_is_news(c.edges, told))
		return MR_OK;
	mr_warn(ctx,
	    "%zu of %zu edges of mesh are too long to go where base goes: their middles miss it by up to "
	    "%.3g %% of the diagonal, most at vertex %u (%.4g, %.4g, %.4g); split them first, by "
	    "mr-subdivide --longest %.3g",
	    c.edges, edges->count, 100 * c.farthest / diagonal, c.vertex, p[c.vertex].x, p[c.vertex].y,
	    p[c.vertex].z, fmin(c.enough, mr_mesh_edge_scale(ctx, base)));
	return MR_OK;
}

/* Parts that touched and do not any more; warns of them as tell does. */
static size_t
look_for_gaps(mr_ctx *ctx, mr_cache *cache, const mr_mesh *mesh, const mr_contacts *contacts, const mr_v3 *p)
{
	/* Of the diagonal, which is five pixels of a picture of a thousand: of 357 edits 80 have such slits,
	 * 51 twice as wide. */
	const double apart = 0.005;
	size_t *told = cache ? &cache->connectivity.told_apart : NULL;
	uint32_t v;
	size_t n = mr_contacts_open(contacts, mesh, p, apart * mr_mesh_diagonal(mesh), &v);

	if (!mr_is_news(n, told))
		return n;
	mr_warn(ctx,
	    "%zu of %zu vertices at which parts of mesh, or sides of a slit, touch have come apart by over "
	    "%g %% of the diagonal, "
	    "vertex %u (%.4g, %.4g, %.4g) the farthest",
	    n, contacts->vertices, 100 * apart, v, p[v].x, p[v].y, p[v].z);
	return n;
}

/*
 * Intersections take up to eight times as long as decoding: of a sequence they are looked for in frames 1, 2,
 * 4, 8, ... behind the key, which of a thousand are ten, in the last one of those that mr-pose has made, and
 * where folds have come, or doubled.
 */
static mr_status
folds_to_look_from(mr_ctx *ctx, mr_frame *f, const mr_cache *cache, size_t *enough)
{
	size_t told, at, last;

	*enough = 0;
	if (!cache || f->key)
		return MR_OK;
	told = cache->connectivity.looked_folds;
	at = cache->connectivity.frames;
	MR_TRY(mr_handles_frames(ctx, f, &last));
	if (at != last && (at & (at - 1)))
		*enough = told ? 2 * told : 1;
	return MR_OK;
}

static void
forget_told(mr_connectivity_cache *kept)
{
	kept->told = kept->told_far = kept->told_strayed = kept->told_apart = kept->told_held =
	    kept->told_chords = kept->told_volume = 0;
	kept->looked_folds = kept->frames = 0;
}

/* Where the vertices of mesh stood when base was where its column `name` has it. */
static mr_status
places_on(mr_ctx *ctx, const mr_frame *f, mr_cache *cache, const mr_mesh *on, const char *name,
    const mr_incidence *inc, const mr_detail *d, mr_stood *kept, const mr_v3 **p)
{
	mr_ctx *keep = cache ? &cache->base_keep : ctx;
	uint64_t serial[2] = { mr_frame_find(f, on->name, name)->serial,
		mr_frame_find(f, "mesh", "detail_height")->serial };

	if (!kept->p || kept->rows < d->n)
		kept->p = MR_NEW(keep, d->n, mr_v3);
	else if (!f->key && serial[0] && serial[1] && !memcmp(serial, kept->serial, sizeof serial)) {
		*p = kept->p;
		return MR_OK;
	}
	if (!kept->p)
		return mr_fail_as(ctx, keep, MR_EMEM);
	if (on->p == d->rest)
		mr_decode_at_rest(ctx, on, d, kept->p);
	else
		MR_TRY(mr_decode(ctx, on, inc, d, 1, kept->p));
	kept->rows = d->n;
	memcpy(kept->serial, serial, sizeof serial);
	*p = kept->p;
	return MR_OK;
}

/* Warns of some constrained vertices, where there are any, and of why. */
static void
tell_some(mr_ctx *ctx, size_t some, size_t all, const char *which, double share, const char *why)
{
	if (some)
		mr_warn(ctx, "%zu of %zu %s by over %g %% of the diagonal: %s", some, all, which, 100 * share,
		    why);
}

/* Of those that are not where they belong though base, where the pose began, or control holds its own there:
 * it has none at theirs. */
static void
tell_held(mr_ctx *ctx, const mr_held *h, const mr_mesh *on, double share)
{
	static const char missed[] = "vertices of handles of mesh miss their place";
	bool base = !strcmp(on->name, "base");
	char coarse[160];

	if (base) /* half the length held all, of six models */
		snprintf(coarse, sizeof coarse,
		    "base is too coarse to hold them; mr-remesh -L %.2g makes it finer",
		    mr_mesh_edge_scale(ctx, on) / 2);
	else /* four times the faces, of four scans */
		snprintf(coarse, sizeof coarse,
		    "control is too coarse to hold them; one of more faces, as mr-simplify -n %zu makes, "
		    "holds more",
		    4 * on->nf);
	tell_some(ctx, h->moved, h->fixed, "fixed vertices of mesh have moved", share, coarse);
	tell_some(ctx, h->missed, h->handled, missed, share, coarse);
	if (h->faceless)
		mr_warn(ctx,
		    "%zu constrained vert%s of mesh with no face: what no face has goes with the surface "
		    "nearest "
		    "to it",
		    h->faceless, h->faceless == 1 ? "ex" : "ices");
	tell_some(ctx, h->unscaled, h->handled, missed, share,
	    base ? "the handle is scaled or mirrored, and heights over base keep their length and turn; "
		   "mr-decode --gain scales all of them, mr-transform a whole model"
		 : "the handle is scaled or mirrored, and heights over control keep their length and turn; "
		   "mr-decode --gain scales all of them, mr-transform a whole model");
}

static double
volume_ratio(const mr_ctx *ctx, const mr_mesh *before, const mr_v3 *p)
{
	mr_mesh now = *before;

	now.p = p;
	return fabs(mr_mesh_volume(ctx, &now) / mr_mesh_volume(ctx, before));
}

/*
 * Warns where handles that only turn and move have changed the volume; by translations alone that is what
 * they ask for.  Of 132 bends and twists by 60 degrees 17 lost a tenth and more.  Fitted rotations lost less
 * in 10 of 12 where base had lost as much of its own, and in 1 of 5 where only mesh had, which has long
 * edges.
 */
static void
tell_volume(mr_ctx *ctx, mr_cache *cache, const mr_held_pose *pose, double ratio, double degrees)
{
	const double much = 0.1, least_turn = 1;
	size_t *told = cache ? &cache->connectivity.told_volume : NULL;
	bool lost = ratio < 1;

	if (degrees < least_turn || !(fabs(ratio - 1) > much) ||
	    !mr_is_news((size_t)fmin(1e6, 100 * fabs(ratio - 1)), told))
		return;
	mr_warn(ctx, "mesh has %s %.2g %% of its volume between handles that turn by up to %.0f degrees%s",
	    lost ? "lost" : "gained", 100 * fabs(ratio - 1), degrees,
	    lost && volume_ratio(ctx, pose->base, pose->on_base) < 1 - much
		? "; mr-solve --rotations fitted keeps more of it on most models"
		: "");
}

/* edges: of pose->mesh. */
static mr_status
look_at_pose(
    mr_ctx *ctx, mr_cache *cache, const mr_held_pose *pose, const mr_edges *edges, mr_decode_result *result)
{
	/* As look_for_gaps has it.  Of 28 models, bent by 60 degrees over a base of the default, one has a
	 * vertex that is off by so much, none by twice that. */
	const double share = 0.005;
	size_t *told = cache ? &cache->connectivity.told_held : NULL;
	mr_held h;

	MR_TRY(mr_held_count(ctx, pose, share * mr_mesh_diagonal(pose->mesh), &h));
	if (mr_is_news(h.moved + h.missed + h.unscaled + h.faceless, told))
		tell_held(ctx, &h, pose->base, share);
	if (mr_edges_enclose(pose->mesh, edges) && mr_mesh_volume(ctx, pose->mesh) != 0) {
		result->volume = volume_ratio(ctx, pose->mesh, pose->p);
		tell_volume(ctx, cache, pose, result->volume, h.turn);
	}
	return MR_OK;
}

/* Judges by where the pose began: an earlier one may have bent what is fixed now, or a handle.  at_rest: the
 * mesh as it was encoded. */
static mr_status
look_at_held(mr_ctx *ctx, mr_frame *f, mr_cache *cache, const mr_mesh *at_rest, const mr_mesh *base,
    const mr_edges *edges, const mr_incidence *inc, const mr_detail *d, const mr_v3 *p,
    mr_decode_result *result)
{
	mr_stood none = { 0 }, *kept = cache ? &cache->connectivity.before : &none;
	mr_mesh mesh = *at_rest, before = *base;
	mr_held_pose pose = { .mesh = &mesh, .base = &before, .p = p, .on_base = base->p, .at = d->at };

	if (!mr_layer_has(f, "mesh", "region") || !mr_layer_has(f, base->name, "region"))
		return MR_OK;
	MR_TRY(mr_layer_region(ctx, f, base->name, base->nv, &pose.base_region));
	MR_TRY(mr_layer_region(ctx, f, "mesh", mesh.nv, &pose.region));
	MR_TRY(mr_detail_before(ctx, f, base, d, &before.p));
	if (before.p != d->rest)
		MR_TRY(places_on(ctx, f, cache, &before, "before", inc, d, kept, &mesh.p));
	return look_at_pose(ctx, cache, &pose, edges, result);
}

/* What the motion of mesh to p has done to it. */
static mr_status
look_for_flaws(mr_ctx *ctx, mr_frame *f, mr_cache *cache, const mr_mesh *mesh, const mr_edges *edges,
    const mr_mesh *base, const mr_v3 *p, mr_decode_result *result)
{
	size_t enough;
	mr_harm harm;

	if (cache && f->key)
		forget_told(&cache->connectivity);
	else if (cache)
		cache->connectivity.frames++;
	MR_TRY(folds_to_look_from(ctx, f, cache, &enough));
	MR_TRY(mr_harm_find(ctx, mesh, edges, p, enough, &harm));
	if (cache && harm.pairs != MR_UNKNOWN)
		cache->connectivity.looked_folds = harm.folds;
	tell(ctx, cache, mesh, base, p, &harm);
	tell_far(ctx, cache, p, &harm);
	result->folded_edges = harm.folds;
	result->intersections = harm.pairs;
	result->far_intersections = harm.far;
	return MR_OK;
}

/* The same of the frame's mesh, and of how it stands to base; d: its detail, of which not all is decoded
 * where that is not `whole`. */
static mr_status
look_for_harm(mr_ctx *ctx, mr_frame *f, mr_cache *cache, const mr_mesh *base, const mr_incidence *inc,
    const mr_detail *d, bool whole, const mr_v3 *p, mr_decode_result *result)
{
	mr_contacts contacts;
	mr_edges edges;
	mr_mesh mesh, rest, encoded;
	mr_stood none = { 0 }, *kept = cache ? &cache->connectivity.at_rest : &none;

	MR_TRY(mr_layer_mesh(ctx, f, "mesh", &mesh));
	MR_TRY(mesh_neighbours(ctx, cache, f, &mesh, &edges, &contacts));
	MR_TRY(look_for_flaws(ctx, f, cache, &mesh, &edges, base, p, result));
	if (whole && d->rest) {
		rest = mesh;
		encoded = *base;
		encoded.p = d->rest;
		MR_TRY(places_on(ctx, f, cache, &encoded, "encoded", inc, d, kept, &rest.p));
		result->strayed_edges = look_for_strayed(ctx, cache, &rest, &edges, base, d, p);
		MR_TRY(look_for_chords(ctx, cache, &rest, &edges, base, inc, d, p, &result->long_edges));
		MR_TRY(look_at_held(ctx, f, cache, &rest, base, &edges, inc, d, p, result));
	}
	result->apart = look_for_gaps(ctx, cache, &mesh, &contacts, p);
	return MR_OK;
}

static mr_status
decode_detail(mr_ctx *ctx, mr_frame *f, const mr_decode_opts *o, mr_cache *cache, mr_decode_result *result)
{
	mr_incidence inc;
	mr_detail detail;
	mr_mesh base;
	mr_v3 *p;

	MR_TRY(mr_layer_mesh(ctx, f, "base", &base));
	MR_TRY(base_incidence(ctx, cache, f, &base, &inc));
	MR_TRY(respond(ctx, f, cache, &base));
	MR_TRY(mr_detail_get(ctx, f, &base, &detail));
	MR_TRY(rest_normals(ctx, cache, f, &base, &inc, &detail));
	p = MR_NEW(ctx, detail.n, mr_v3);
	if (!p)
		return MR_EMEM;
	MR_TRY(mr_decode(ctx, &base, &inc, &detail, o->gain, p));
	if (!o->blind && mr_layer_has(f, "mesh", "triangles"))
		MR_TRY(look_for_harm(ctx, f, cache, &base, &inc, &detail, o->gain == 1, p, result));
	MR_TRY(mr_layer_move(ctx, f, "mesh", MR_POSED, p, detail.n));
	return mr_layer_followed(ctx, f, "base");
}

/* The displaced surface over d at a gain of 1, but on the control mesh as it was encoded, its edges, and what
 * it stands on. */
static mr_status
build_encoded(mr_ctx *ctx, const mr_domain *d, const mr_mesh *encoded, const double *height, mr_mesh *surface,
    mr_edges *edges, const mr_v3 **foot)
{
	mr_domain before;
	mr_v3 *p;

	MR_TRY(mr_domain_on(ctx, encoded, d->level, d->n, &before));
	p = MR_NEW(ctx, before.m.nv, mr_v3);
	if (!p)
		return MR_EMEM;
	mr_domain_displace(ctx, &before, height, 1, p);
	*surface = before.m;
	*foot = before.m.p;
	surface->p = p;
	return mr_edges_build(ctx, surface, edges);
}

/* The same of the frame, kept as long as it is. */
static mr_status
find_encoded(mr_ctx *ctx, mr_cache *cache, mr_frame *f, const mr_domain *d, const double *height,
    mr_mesh *surface, mr_edges *edges, const mr_v3 **foot)
{
	mr_connectivity_cache *kept = cache ? &cache->connectivity : NULL;
	mr_ctx *keep = cache ? &cache->displaced_keep : ctx;
	uint64_t heights = mr_frame_find(f, "displacement", "height")->serial;
	mr_mesh encoded;
	const void *p;

	MR_TRY(mr_layer_mesh(ctx, f, "control", &encoded));
	MR_TRY(mr_layer_get_rows(ctx, f, "control", "encoded", encoded.nv, &p));
	encoded.p = p;
	if (!kept)
		return build_encoded(ctx, d, &encoded, height, surface, edges, foot);
	if (kept->height_serial != heights)
		kept->displaced_serial = 0;
	if (!still_there(ctx, f, "control", "encoded", &kept->displaced_serial, keep)) {
		MR_TRY(mr_fail_as(ctx, keep,
		    build_encoded(keep, d, &encoded, height, &kept->displaced, &kept->displaced_edges,
			&kept->displaced_foot)));
		kept->displaced_serial = mr_frame_find(f, "control", "encoded")->serial;
		kept->height_serial = heights;
	}
	*surface = kept->displaced;
	*edges = kept->displaced_edges;
	*foot = kept->displaced_foot;
	return MR_OK;
}

/* Of each vertex over d the region of the control vertices that it lies between, free where these have
 * several. */
static mr_status
regions_of_levels(mr_ctx *ctx, const mr_domain *d, const uint32_t *control, const uint32_t **region)
{
	uint32_t *r = MR_NEW(ctx, d->m.nv, uint32_t);

	if (!r)
		return MR_EMEM;
	memcpy(r, control, d->level[0].nv * sizeof *r);
	for (size_t n = 1; n <= d->n; n++) {
		const mr_loop *level = &d->level[n], *below = level - 1;
		for (size_t v = level->coarse_nv; v < level->nv; v++) {
			uint32_t h = level->edge[v - level->coarse_nv];
			uint32_t a = r[below->t[h / 3].v[h % 3]], b = r[below->t[h / 3].v[(h + 1) % 3]];
			r[v] = a == b ? a : MR_REGION_FREE;
		}
	}
	*region = r;
	return MR_OK;
}

/* What control does not hold of the surface; pose: that, as it stood, with what it stands on, and where it is
 * now. */
static mr_status
look_at_held_by_control(mr_ctx *ctx, mr_frame *f, mr_cache *cache, const mr_domain *d, const mr_mesh *control,
    mr_held_pose pose, const mr_edges *edges, mr_decode_result *result)
{
	mr_mesh encoded = *control;
	const void *p;

	if (!mr_layer_has(f, "control", "region"))
		return MR_OK;
	MR_TRY(mr_layer_get_rows(ctx, f, "control", "encoded", encoded.nv, &p));
	encoded.p = p;
	pose.base = &encoded;
	pose.on_base = control->p;
	MR_TRY(mr_layer_region(ctx, f, "control", control->nv, &pose.base_region));
	MR_TRY(regions_of_levels(ctx, d, pose.base_region, &pose.region));
	return look_at_pose(ctx, cache, &pose, edges, result);
}

/* What posing the control mesh, or the gain, has done to the surface, now at p. */
static mr_status
look_at_displaced(mr_ctx *ctx, mr_frame *f, mr_cache *cache, const mr_domain *d, const mr_mesh *control,
    const double *height, double gain, const mr_v3 *p, mr_decode_result *result)
{
	bool posed = mr_layer_has(f, "control", "encoded");
	mr_held_pose pose = { .p = p };
	mr_mesh before;
	mr_edges edges;

	if (posed)
		MR_TRY(find_encoded(ctx, cache, f, d, height, &before, &edges, &pose.foot));
	else if (gain != 1)
		MR_TRY(build_encoded(ctx, d, control, height, &before, &edges, &pose.foot));
	else
		return MR_OK;
	MR_TRY(look_for_flaws(ctx, f, cache, &before, &edges, NULL, p, result));
	pose.mesh = &before;
	return posed && gain == 1 ? look_at_held_by_control(ctx, f, cache, d, control, pose, &edges, result)
	                          : MR_OK;
}

/* What mr-sample found of the points' columns at the vertices, those of coarse levels first. */
static mr_status
put_columns(mr_ctx *ctx, mr_frame *f, size_t nv)
{
	size_t n = f->count, bytes;
	const void *types;

	for (size_t i = 0; i < n; i++) {
		mr_column *c = &f->columns[i];
		if (!mr_column_carried(c, "displacement"))
			continue;
		MR_TRY(mr_column_decode(ctx, c));
		if (c->rows < nv)
			return mr_fail(ctx, MR_ERANGE, "displacement: %s has %llu rows for %zu vertices",
			    c->name, (unsigned long long)c->rows, nv);
		MR_TRY(mr_frame_put(ctx, f, "mesh", c->name, c->shape, c->data, nv));
	}
	if (!mr_layer_has(f, "displacement", "properties"))
		return MR_OK;
	MR_TRY(mr_layer_get(ctx, f, "displacement", "properties", &types, &bytes));
	return mr_layer_put(ctx, f, "mesh", "properties", types, bytes);
}

/* Takes those of before away, so that nothing is said to be lost that is not. */
static void
drop_columns(mr_frame *f)
{
	for (size_t i = f->count; i-- > 0;) {
		char name[MR_COLUMN_MAX + 1];
		snprintf(name, sizeof name, "%s", f->columns[i].name);
		if (mr_column_carried(&f->columns[i], "mesh") && mr_layer_has(f, "displacement", name))
			mr_frame_drop(f, "mesh", name, 0);
	}
}

/* Level J of the surface needs the first heights alone. */
static mr_status
decode_control(mr_ctx *ctx, mr_frame *f, const mr_decode_opts *o, mr_cache *cache, mr_decode_result *result)
{
	const mr_loop *refined;
	const double *height;
	bool posed = mr_layer_has(f, "handles", "transform") || mr_layer_has(f, "control", "encoded");
	mr_mesh control;
	mr_domain d;
	mr_v3 *p;
	size_t n;

	MR_TRY(mr_layer_mesh(ctx, f, "control", &control));
	MR_TRY(mr_displacement_get(ctx, f, &control, &n, &height));
	if (o->level != MR_UNKNOWN && o->level > n)
		return mr_fail(
		    ctx, MR_ERANGE, "--level %zu, but displacement ends with level %zu", o->level, n);
	if (o->level != MR_UNKNOWN)
		n = o->level;
	MR_TRY(respond(ctx, f, cache, &control));
	MR_TRY(mr_cache_levels(ctx, cache, f, &control, 180, n, &refined));
	MR_TRY(mr_domain_on(ctx, &control, refined, n, &d));
	p = MR_NEW(ctx, d.m.nv, mr_v3);
	if (!p)
		return MR_EMEM;
	mr_domain_displace(ctx, &d, height, o->gain, p);
	if (!o->blind)
		MR_TRY(look_at_displaced(ctx, f, cache, &d, &control, height, o->gain, p, result));
	if (f->key && mr_layer_has(f, "mesh", "detail_face"))
		mr_warn(ctx,
		    "mesh, which has detail over base, is made anew from control, without what base has "
		    "done to it");
	else
		MR_TRY(mr_displaced_warn_of_change(ctx, f, &control, &d, o->gain == 1 && !posed ? p : NULL));
	d.m.p = p;
	drop_columns(f);
	MR_TRY(mr_layer_replace(ctx, f, "mesh", &d.m));
	MR_TRY(mr_layer_followed(ctx, f, "control"));
	MR_TRY(mr_layer_followed(ctx, f, "displacement"));
	MR_TRY(put_columns(ctx, f, d.m.nv));
	return mr_layer_warn_of_rest(ctx, f, "mesh", "control");
}

/* How far mesh is from the points, where it is known how these lie. */
static mr_status
look_at_gaps(mr_ctx *ctx, mr_frame *f, mr_gaps *gaps)
{
	mr_sampling sampling;
	mr_mesh points, mesh;
	bool known;

	if (!mr_layer_has(f, "points", "sampling"))
		return MR_OK;
	MR_TRY(mr_layer_points(ctx, f, "points", &points));
	MR_TRY(mr_sampling_stored(ctx, f, "points", points.nv, &sampling, &known));
	MR_TRY(mr_layer_mesh(ctx, f, "mesh", &mesh));
	return known ? mr_gaps_measure(ctx, &mesh, points.p, &sampling, gaps) : MR_OK;
}

/* Whether it is the control mesh that handles pose, or else that, or the heights over it, that were worked on
 * last. */
static mr_status
is_control_latest(mr_ctx *ctx, mr_frame *f, bool *is)
{
	bool base = mr_layer_has(f, "base", "response"), control = mr_layer_has(f, "control", "response");
	const char *latest;

	MR_TRY(mr_layer_latest(ctx, f, &latest));
	*is = latest && (!strcmp(latest, "displacement") || !strcmp(latest, "control"));
	if (mr_layer_has(f, "handles", "transform") && base != control)
		*is = control;
	*is = *is && mr_frame_has_layer(f, "displacement");
	return MR_OK;
}

static mr_status
choose(mr_ctx *ctx, mr_frame *f, const mr_decode_opts *o, int *from)
{
	bool detail = mr_layer_has(f, "mesh", "detail_face"), control;

	*from = o->from;
	if (o->from != MR_FROM_ANY)
		return MR_OK;
	if (!detail && !mr_frame_has_layer(f, "displacement"))
		return mr_fail(ctx, MR_EMISSING,
		    "neither detail of mesh, which mr-encode makes, nor displacement, which mr-sample makes");
	MR_TRY(is_control_latest(ctx, f, &control));
	*from = detail && !control ? MR_FROM_DETAIL : MR_FROM_CONTROL;
	if (*from == MR_FROM_DETAIL && o->level != MR_UNKNOWN)
		return mr_fail(ctx, MR_EUSAGE, "--level has no effect on the detail that is here%s",
		    mr_frame_has_layer(f, "displacement") ? ": --from control" : "");
	return MR_OK;
}

/* gaps: whether those are looked at. */
static mr_status
decode(
    mr_ctx *ctx, mr_frame *f, const mr_decode_opts *o, mr_cache *cache, bool gaps, mr_decode_result *result)
{
	int from;

	mr_unmeasured(result, sizeof *result);
	MR_TRY(mr_check_number(ctx, "gain", o->gain, -1e6, 1e6));
	MR_TRY(mr_check_choice(ctx, "from", o->from, MR_FROM_CONTROL));
	MR_TRY(choose(ctx, f, o, &from));
	if (mr_layer_has(f, from == MR_FROM_DETAIL ? "base" : "control", "target"))
		return mr_fail(ctx, MR_EMISSING,
		    "%s has targets and has not gone there: mr-solve comes before",
		    from == MR_FROM_DETAIL ? "base" : "control");
	if (from == MR_FROM_DETAIL)
		MR_TRY(decode_detail(ctx, f, o, cache, result));
	else
		MR_TRY(decode_control(ctx, f, o, cache, result));
	mr_frame_drop(f, "handles", NULL, 0);
	mr_frame_drop(f, "base", "before", 0);
	return gaps && from == MR_FROM_CONTROL ? look_at_gaps(ctx, f, &result->gaps) : MR_OK;
}

mr_status
mr_decode_frame(
    mr_ctx *ctx, mr_frame *f, const mr_decode_opts *opts, mr_cache *cache, mr_decode_result *result)
{
	static const mr_decode_opts defaults = MR_DECODE_DEFAULTS;
	mr_decode_result r;
	mr_frame done;

	MR_TRY(mr_frame_copy(ctx, f, &done));
	MR_TRY(decode(ctx, &done, opts ? opts : &defaults, cache, result, &r));
	return mr_frame_finish(f, &done, result, &r, sizeof r);
}
