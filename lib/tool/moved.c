/* What a motion has done to a surface: folds, intersections, torn detail, chords, gaps, places missed,
 * volume. */
#include "tool/moved.h"

#include "base/text.h"
#include "edit/chord.h"
#include "edit/handles.h"
#include "edit/strayed.h"
#include "measure/harm.h"
#include "space/enclosed.h"

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
 * either have 90; of few faces fewer do.
 */
static void
tell(mr_ctx *ctx, const mr_moved *m, const mr_harm *h)
{
	enum { FOLDS = 5, PAIRS = 20 };
	size_t pairs = h->pairs == MR_UNKNOWN ? 0 : h->pairs, all = h->folds + pairs, nf = m->mesh->nf,
	       *told = m->cache ? &m->cache->connectivity.told : NULL;
	char advice[120] = "", found[160];
	mr_v3 at;

	name_harm(h, pairs, found, sizeof found);
	if (h->folds <= (nf < 12 * FOLDS ? nf / 12 : FOLDS) && pairs <= (nf < 5 * PAIRS ? nf / 5 : PAIRS)) {
		if (all)
			mr_note(ctx, "%s: few", found);
		return;
	}
	if (!mr_is_news(all, told))
		return;
	if (m->base)
		advise(ctx, m->mesh, m->base, h->vertex, advice, sizeof advice);
	at = m->p[h->vertex];
	mr_warn(ctx, "%s, most of them at vertex %u (%.4g, %.4g, %.4g)%s", found, h->vertex, at.x, at.y, at.z,
	    advice);
}

/* The same of far faces, and of parts. */
static void
tell_far(mr_ctx *ctx, const mr_moved *m, const mr_harm *h)
{
	enum { PAIRS = 20 };
	size_t *told = m->cache ? &m->cache->connectivity.told_far : NULL;
	mr_v3 at;

	if (h->far == MR_UNKNOWN || h->far <= PAIRS || !mr_is_news(h->far, told))
		return;
	at = m->p[h->far_vertex];
	mr_warn(ctx,
	    "%zu more intersecting pairs of faces of mesh that are far from each other along it, or of two "
	    "parts: limbs meet, or sheets pass through each other, most of them at vertex %u (%.4g, %.4g, "
	    "%.4g)",
	    h->far, h->far_vertex, at.x, at.y, at.z);
}

void
mr_moved_strayed(mr_ctx *ctx, const mr_moved *m)
{
	enum { FEW = 5 };
	size_t *told = m->cache ? &m->cache->connectivity.told_strayed : NULL;
	mr_strayed s = mr_strayed_find(m->mesh, m->edges, m->p, m->base, m->detail);
	mr_v3 at;

	m->result->strayed_edges = s.edges;
	if (s.edges <= FEW || !mr_is_news(s.edges, told))
		return;
	at = m->p[s.vertex];
	mr_warn(ctx,
	    "detail is torn: %zu of %zu edges of mesh are over twice as long, or under half as long, as base "
	    "has them there, most at vertex %u (%.4g, %.4g, %.4g)",
	    s.edges, m->edges->count, s.vertex, at.x, at.y, at.z);
}

mr_status
mr_moved_chords(mr_ctx *ctx, const mr_moved *m)
{
	const double far = 0.01; /* of the diagonal */
	double diagonal = mr_mesh_diagonal(m->mesh);
	size_t *told = m->cache ? &m->cache->connectivity.told_chords : NULL;
	mr_chords c;
	mr_v3 at;

	MR_TRY(mr_chords_find(ctx, m->mesh, m->edges, m->p, m->base, m->inc, m->detail, far * diagonal, &c));
	m->result->long_edges = c.edges;
	if (!mr_is_news(c.edges, told))
		return MR_OK;
	at = m->p[c.vertex];
	mr_warn(ctx,
	    "%zu of %zu edges of mesh are too long to go where base goes: their middles miss it by up to "
	    "%.3g %% of the diagonal, most at vertex %u (%.4g, %.4g, %.4g); split them first, by "
	    "mr-subdivide --longest %.3g",
	    c.edges, m->edges->count, 100 * c.farthest / diagonal, c.vertex, at.x, at.y, at.z,
	    fmin(c.enough, mr_mesh_edge_scale(ctx, m->base)));
	return MR_OK;
}

void
mr_moved_gaps(mr_ctx *ctx, const mr_moved *m, const mr_contacts *contacts)
{
	/* Of the diagonal, which is five pixels of a picture of a thousand: of 357 edits 80 have such slits,
	 * 51 twice as wide. */
	const double apart = 0.005;
	size_t *told = m->cache ? &m->cache->connectivity.told_apart : NULL;
	uint32_t v;
	size_t n = mr_contacts_open(contacts, m->mesh, m->p, apart * mr_mesh_diagonal(m->mesh), &v);

	m->result->apart = n;
	if (!mr_is_news(n, told))
		return;
	mr_warn(ctx,
	    "%zu of %zu vertices at which parts of mesh, or sides of a slit, touch have come apart by over "
	    "%g %% of the diagonal, "
	    "vertex %u (%.4g, %.4g, %.4g) the farthest",
	    n, contacts->vertices, 100 * apart, v, m->p[v].x, m->p[v].y, m->p[v].z);
}

/*
 * Intersections take up to eight times as long as decoding: of a sequence they are looked for in frames 1, 2,
 * 4, 8, ... behind the key, which of a thousand are ten, in the last one of those that mr-pose has made, and
 * where folds have come, or doubled.
 */
static mr_status
folds_to_look_from(mr_ctx *ctx, const mr_moved *m, size_t *enough)
{
	size_t told, at, last;

	*enough = 0;
	if (!m->cache || m->f->key)
		return MR_OK;
	told = m->cache->connectivity.looked_folds;
	at = m->cache->connectivity.frames;
	MR_TRY(mr_handles_frames(ctx, m->f, &last));
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

static const double MUCH = 0.1; /* of the volume: fitted rotations keep nine tenths of what is free */

/* What would have kept more of the volume. */
static mr_status
advise_on_volume(mr_ctx *ctx, const mr_held_pose *pose, const char **advice)
{
	double share;

	MR_TRY(mr_enclosed_share(ctx, pose->base, pose->on_base, &share));
	if (share < 1 - MUCH)
		*advice = "; mr-solve --rotations fitted keeps more of it on most models";
	return MR_OK;
}

/*
 * Warns where handles that only turn and move have changed the volume; by translations alone that is what
 * they ask for, but not that mesh turns inside out.  Of 132 bends and twists by 60 degrees 17 lost a tenth
 * and more.  Fitted rotations lost less in 10 of 12 where base had lost as much of its own, and in 1 of 5
 * where only mesh had, which has long edges.
 */
static mr_status
look_at_volume(mr_ctx *ctx, const mr_moved *m, const mr_held_pose *pose, const mr_held *h)
{
	size_t *told = m->cache ? &m->cache->connectivity.told_volume : NULL;
	const char *advice = "", *since = m->base ? "" : " since control was sampled";
	double share;

	MR_TRY(mr_enclosed_share(ctx, pose->mesh, pose->p, &share));
	m->result->volume = share;
	if (!(fabs(share - 1) > MUCH) || (!h->keeps_volume && share > 0) ||
	    !mr_is_news((size_t)fmin(1e6, 100 * fabs(share - 1)), told))
		return MR_OK;
	if (h->turned && share > 0 && share < 1)
		MR_TRY(advise_on_volume(ctx, pose, &advice));
	if (share > 0)
		mr_warn(ctx, "mesh has %s %.2g %% of its volume%s, though its handles only turn and move%s",
		    share < 1 ? "lost" : "gained", 100 * fabs(share - 1), since, advice);
	else
		mr_warn(
		    ctx, "mesh has turned inside out%s: its volume is %.2g times what it was", since, share);
	return MR_OK;
}

mr_status
mr_moved_pose(mr_ctx *ctx, const mr_moved *m, const mr_held_pose *pose)
{
	/* As gaps have it.  Of 28 models, bent by 60 degrees over a base of the default, one has a
	 * vertex that is off by so much, none by twice that. */
	const double share = 0.005;
	size_t *told = m->cache ? &m->cache->connectivity.told_held : NULL;
	mr_held h;

	MR_TRY(mr_held_count(ctx, pose, share * mr_mesh_diagonal(pose->mesh), &h));
	if (m->gain != 1) /* it may be what scales them along */
		h.unscaled = 0;
	if (mr_is_news(h.moved + h.missed + h.unscaled + h.faceless, told))
		tell_held(ctx, &h, pose->base, share);
	return look_at_volume(ctx, m, pose, &h);
}

mr_status
mr_moved_harm(mr_ctx *ctx, const mr_moved *m)
{
	mr_connectivity_cache *kept = m->cache ? &m->cache->connectivity : NULL;
	size_t enough;
	mr_harm harm;

	if (kept && m->f->key)
		forget_told(kept);
	else if (kept)
		kept->frames++;
	MR_TRY(folds_to_look_from(ctx, m, &enough));
	MR_TRY(mr_harm_find(ctx, m->mesh, m->edges, m->p, enough, &harm));
	if (kept && harm.pairs != MR_UNKNOWN)
		kept->looked_folds = harm.folds;
	tell(ctx, m, &harm);
	tell_far(ctx, m, &harm);
	m->result->folded_edges = harm.folds;
	m->result->intersections = harm.pairs;
	m->result->far_intersections = harm.far;
	return MR_OK;
}
