/* Lids: what of a closed wrap spans no points.  Small holes stay closed, wide openings are cut out, along a
 * line that is smooth and close to the outermost points. */
#include "base/disjoint_sets.h"
#include "base/sort.h"
#include "measure/gaps.h"
#include "mesh/clip.h"
#include "remesh/unfold.h"
#include "wrap/parts.h"

/* Spacings from a point: of a surface strewn with points one place in 1,200 is farther from them. */
static const double SUPPORTED = 1.5;

/* Half the width, in spacings, of an opening; and of a hole, which is no gap of the sampling: among 50,000
 * points strewn one is 2.2 at most. */
static const double OPENING = MR_WRAP_OPENING / 2, HOLE = 2.5;

/* Beside an opening a place has so many times its spacing to itself, as neighbours are missing on one side.
 */
static const double BESIDE = 1.25;

/* Doubtful are holes, and openings by so much wider. */
static const double DOUBT = 1.4;

/* Spacings, of those that are seen at all, that nine tenths of a wrap are within where the points support it:
 * 0.47 to 1.14 of bodies, more where flat faces are bare or an open sheet is wrapped from both sides. */
static const double FLICKERING = 1.2, SEEN = 2;

/* Spacings that the line goes back from the end of support: it is then within 1.3 spacings of the outermost
 * points, and closes over the gaps between them. */
static const double BACK = 1.25, RIM = 1;

enum { SMOOTHINGS = 3, SETTLES = 4, POINTS_PER_EDGE = 4 };

/* How far vertices are from points. */
typedef struct support {
	double *far;  /* nv: in spacings as the nearest point's, or the usual where that is more */
	double *near; /* nv: in the nearest point's */
	double *unit; /* nv: of far */
} support;

static mr_status
measure(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_mesh *m, support *s)
{
	uint32_t *nearest = MR_NEW(ctx, m->nv, uint32_t);

	s->far = MR_NEW(ctx, m->nv, double);
	s->near = MR_NEW(ctx, m->nv, double);
	s->unit = MR_NEW(ctx, m->nv, double);
	MR_TRY(mr_near_query(ctx, cloud->near, m->p, m->nv, 1, nearest, s->far));
	for (size_t v = 0; v < m->nv; v++) {
		double own = cloud->own[nearest[v]], d = sqrt(s->far[v]);
		s->unit[v] = fmax(own / BESIDE, cloud->spacing);
		s->far[v] = d / s->unit[v];
		s->near[v] = d / own;
	}
	return MR_OK;
}

/* Whether the points hardly support even the closed part. */
static void
find_flicker(mr_ctx *ctx, const support *s, size_t nv, bool *flickers)
{
	mr_mark mark = mr_mark_take(ctx);
	double *d = MR_NEW(ctx, nv, double);
	size_t n = 0;

	for (size_t v = 0; v < nv; v++)
		if (s->near[v] < SEEN)
			d[n++] = s->near[v];
	*flickers = n == 0 || mr_kth(d, n, 9 * n / 10) > FLICKERING;
	mr_mark_release(ctx, mark);
}

/* Connects vertices without support along edges. */
static void
find_regions(mr_ctx *ctx, const mr_mesh *m, const double *far, uint32_t **set)
{
	*set = mr_sets_new(ctx, m->nv);
	for (uint32_t h = 0; h < 3 * m->nf; h++)
		if (far[mr_he_from(m, h)] > SUPPORTED && far[mr_he_to(m, h)] > SUPPORTED)
			mr_sets_join(*set, mr_he_from(m, h), mr_he_to(m, h));
}

/* The place of each region, by its root, that is farthest from points.  spot: m->nv, all 0, the caller's. */
static void
find_spots(const mr_mesh *m, const double *far, uint32_t *set, mr_gap_spot *spot)
{
	for (uint32_t v = 0; v < m->nv; v++) {
		mr_gap_spot *of = spot + mr_sets_root(set, v);
		if (far[v] > of->wide)
			*of = (mr_gap_spot){ far[v], m->p[v] };
	}
}

/* Takes a region to account, by its deepest place, and says whether it is cut out. */
static bool
judge(mr_wrap_lids *lids, const mr_gap_spot *spot, int how)
{
	double half = spot->wide;
	bool wide = half > (how == MR_LIDS_NONE ? HOLE : OPENING), cut = wide && !lids->flickers;
	bool doubtful = how == MR_LIDS_AUTO && (cut ? half < DOUBT * OPENING : half > HOLE);

	lids->openings += cut;
	lids->holes += !cut && half > HOLE;
	lids->doubtful += doubtful;
	if (doubtful && 2 * half > lids->width) {
		lids->width = 2 * half;
		lids->at = spot->at;
	}
	return cut;
}

/* *m without the regions that are openings, cut where support ends. */
static mr_status
cut_openings(mr_ctx *ctx, const mr_wrap_cloud *cloud, int how, mr_wrap_lids *lids, mr_mesh *m)
{
	double *value = MR_NEW(ctx, m->nv, double);
	bool *cut = MR_NEW_ZERO(ctx, m->nv, bool);
	mr_gap_spot *spot = MR_NEW_ZERO(ctx, m->nv, mr_gap_spot);
	uint32_t *set;
	support s;

	MR_TRY(measure(ctx, cloud, m, &s));
	if (lids->flickers)
		find_flicker(ctx, &s, m->nv, &lids->flickers);
	find_regions(ctx, m, s.far, &set);
	find_spots(m, s.far, set, spot);
	for (uint32_t v = 0; v < m->nv; v++)
		if (mr_sets_root(set, v) == v && s.far[v] > SUPPORTED)
			cut[v] = judge(lids, &spot[v], how);
	for (uint32_t v = 0; v < m->nv; v++)
		value[v] = cut[mr_sets_root(set, v)] ? s.far[v] - SUPPORTED
		                                     : fmin(s.far[v] - SUPPORTED, -0.01);
	mr_mesh_clip(ctx, m, value, m);
	return MR_OK;
}

/* The n ends, first and last, of the edges of m that have one face. */
static mr_status
find_rim(mr_ctx *ctx, const mr_mesh *m, uint32_t (**rim)[2], size_t *n)
{
	mr_topology topo;

	MR_TRY(mr_topology_build(ctx, m, &topo));
	*rim = mr_alloc(ctx, 3 * m->nf, sizeof **rim);
	*n = 0;
	for (uint32_t h = 0; h < 3 * m->nf; h++)
		if (topo.twin[h] == MR_NONE) {
			(*rim)[*n][0] = mr_he_from(m, h);
			(*rim)[(*n)++][1] = mr_he_to(m, h);
		}
	return MR_OK;
}

/* Points along those where support ends. */
static mr_status
strew_rim(mr_ctx *ctx, const mr_mesh *m, const double *far, mr_v3 **p, size_t *n)
{
	uint32_t(*rim)[2];
	size_t edges;

	MR_TRY(find_rim(ctx, m, &rim, &edges));
	*p = MR_NEW(ctx, POINTS_PER_EDGE * edges, mr_v3);
	*n = 0;
	for (size_t i = 0; i < edges; i++)
		for (size_t k = 0; k < POINTS_PER_EDGE && far[rim[i][0]] > RIM; k++)
			(*p)[(*n)++] = mr_lerp((double)k / POINTS_PER_EDGE, m->p[rim[i][0]], m->p[rim[i][1]]);
	return MR_OK;
}

/* Cuts m again, farther in: so the line closes over the gaps between points at the rim. */
static mr_status
draw_back(mr_ctx *ctx, const mr_wrap_cloud *cloud, mr_mesh *m)
{
	uint32_t *nearest = MR_NEW(ctx, m->nv, uint32_t);
	double *value = MR_NEW(ctx, m->nv, double);
	support s;
	mr_v3 *p;
	size_t n;

	MR_TRY(measure(ctx, cloud, m, &s));
	MR_TRY(strew_rim(ctx, m, s.far, &p, &n));
	if (n == 0)
		return MR_OK;
	MR_TRY(mr_near_once(ctx, p, n, m->p, m->nv, 1, nearest, value));
	for (size_t v = 0; v < m->nv; v++)
		value[v] = BACK * s.unit[v] - sqrt(value[v]);
	mr_mesh_clip(ctx, m, value, m);
	return MR_OK;
}

/* The vertices of the rim to the middle between themselves and their neighbours along it. */
static mr_status
smooth_rim(mr_ctx *ctx, mr_mesh *m)
{
	mr_v3 *sum = MR_NEW(ctx, m->nv, mr_v3), *p = MR_NEW(ctx, m->nv, mr_v3);
	uint32_t(*rim)[2];
	size_t n;

	MR_TRY(find_rim(ctx, m, &rim, &n));
	memcpy(p, m->p, m->nv * sizeof *p);
	for (int pass = 0; pass < SMOOTHINGS; pass++) {
		memset(sum, 0, m->nv * sizeof *sum);
		for (size_t i = 0; i < n; i++) {
			mr_v3 half = mr_mul(0.25, mr_add(p[rim[i][0]], p[rim[i][1]]));
			sum[rim[i][0]] = mr_add(sum[rim[i][0]], half);
			sum[rim[i][1]] = mr_add(sum[rim[i][1]], half);
		}
		for (size_t i = 0; i < n; i++)
			p[rim[i][0]] = sum[rim[i][0]];
	}
	m->p = p;
	return MR_OK;
}

mr_status
mr_wrap_cut(mr_ctx *ctx, const mr_wrap_cloud *cloud, int how, bool flickering, mr_mesh *m, mr_wrap_lids *lids)
{
	size_t before = lids->openings;

	lids->flickers = flickering;
	MR_TRY(cut_openings(ctx, cloud, how, lids, m));
	if (lids->openings == before)
		return MR_OK;
	MR_TRY(draw_back(ctx, cloud, m));
	if (m->nf == 0)
		return mr_fail(ctx, MR_EMESH, "%zu openings leave nothing of the surface", lids->openings);
	return smooth_rim(ctx, m);
}

mr_status
mr_wrap_settle_open(
    mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, const mr_mesh *m, mr_dyn *d)
{
	MR_TRY(mr_wrap_remesh(ctx, cloud, o, m, d));
	MR_TRY(mr_wrap_settle(ctx, cloud, o, SETTLES, d));
	mr_unfold(d);
	return MR_OK;
}

mr_status
mr_wrap_open(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, bool flickering,
    mr_wrap_lids *lids, mr_dyn *d)
{
	mr_mesh m = mr_dyn_view(d, "control");
	size_t before = lids->openings;

	MR_TRY(mr_wrap_cut(ctx, cloud, o->lids, flickering, &m, lids));
	return lids->openings > before ? mr_wrap_settle_open(ctx, cloud, o, &m, d) : MR_OK;
}
