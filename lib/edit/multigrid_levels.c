/* Botsch, Kobbelt 2004: A remeshing approach ..., section 4.4: multigrid on remeshed levels. */
#include "edit/deform_system.h"

#include "edit/correspondence.h"
#include "remesh/remesh.h"

/* A quarter of the unknowns from level to level: 16 are more than there is memory for.  A coarsest level of
 * 100 takes as long as one of 400, one of 1600 takes 6 % longer, for its factor. */
enum { LEVELS_MAX = 16, COARSEST = 400 };

/* A mesh of the hierarchy, and which of its vertices are unknowns. */
typedef struct stage {
	mr_mesh m;
	uint32_t *number; /* of each vertex: its unknown, or MR_NONE */
	size_t n;         /* unknowns */
} stage;

/* The next mesh */

/* A vertex of the coarser mesh is an unknown where the corner nearest its place on the finer one is. */
static void
number_coarse(mr_ctx *ctx, const stage *fine, const mr_places *map, stage *coarse)
{
	coarse->number = MR_NEW(ctx, coarse->m.nv, uint32_t);
	coarse->n = 0;
	for (size_t v = 0; v < coarse->m.nv; v++) {
		const uint32_t *corner = fine->m.t[map->face[v]].v;
		bool unknown = fine->number[corner[mr_largest(map->bary[v])]] != MR_NONE;
		coarse->number[v] = unknown ? (uint32_t)coarse->n++ : MR_NONE;
	}
}

/* Edges twice as long, of even triangles; areas matter little here. */
static mr_status
remesh_stage(mr_ctx *ctx, const stage *fine, stage *coarse, mr_places *map)
{
	mr_remesh_opts o = MR_REMESH_DEFAULTS;

	o.length = 2 * mr_mesh_edge_scale(ctx, &fine->m);
	o.rounds = 3;
	o.area_passes = 0;
	MR_TRY(mr_remesh(ctx, &fine->m, &o, NULL, &coarse->m, map, NULL));
	number_coarse(ctx, fine, map, coarse);
	return MR_OK;
}

/* Prolongation */

/* The places of the finer vertices on the coarser mesh. */
typedef struct places {
	const stage *fine, *coarse;
	uint32_t *face; /* MR_NONE: nowhere */
	mr_v3 *bary;
} places;

static void
place_vertices(mr_ctx *ctx, const mr_places *map, places *w)
{
	bool *stands = MR_NEW_ZERO(ctx, w->fine->m.nv, bool);
	mr_correspondence c;
	mr_incidence inc;

	w->face = MR_NEW(ctx, w->fine->m.nv, uint32_t);
	w->bary = MR_NEW_ZERO(ctx, w->fine->m.nv, mr_v3);
	mr_incidence_build(ctx, &w->coarse->m, &inc);
	mr_correspond(ctx, &w->fine->m, &w->coarse->m, &inc, map, &c);
	mr_correspond_rest(ctx, &c, stands, w->face, w->bary);
}

/* The entries of the row of v, ascending; constraints are 0 on every level. */
static int
row_of(const places *w, size_t v, int *index, double *value)
{
	double b[3] = { w->bary[v].x, w->bary[v].y, w->bary[v].z };
	int n = 0;

	if (w->face[v] == MR_NONE)
		return 0;
	for (int k = 0; k < 3; k++) {
		uint32_t c = w->coarse->number[w->coarse->m.t[w->face[v]].v[k]];
		int at = n;
		if (c == MR_NONE || b[k] == 0)
			continue;
		for (; at > 0 && index[at - 1] > (int)c; at--) {
			index[at] = index[at - 1];
			value[at] = value[at - 1];
		}
		index[at] = (int)c;
		value[at] = b[k];
		n++;
	}
	return n;
}

static mr_status
prolong(mr_ctx *ctx, const places *w, mr_sparse *p)
{
	size_t n = w->fine->n;
	mr_sparse r = { (int)n, MR_NEW(ctx, n + 1, int), MR_NEW(ctx, 3 * n, int),
		MR_NEW(ctx, 3 * n, double) };
	uint32_t *vertex = MR_NEW(ctx, n, uint32_t);

	for (size_t v = 0; v < w->fine->m.nv; v++)
		if (w->fine->number[v] != MR_NONE)
			vertex[w->fine->number[v]] = (uint32_t)v;
	r.start[0] = 0;
	for (size_t i = 0; i < n; i++)
		r.start[i + 1] = r.start[i] +
		                 row_of(w, vertex[i], r.index + r.start[i], r.value + r.start[i]);
	*p = r;
	return MR_OK;
}

mr_status
mr_hierarchy_build(
    mr_ctx *ctx, const mr_mesh *m, const uint32_t *number, size_t n, mr_coarser **level, size_t *count)
{
	mr_coarser *levels = MR_NEW_ZERO(ctx, LEVELS_MAX, mr_coarser);
	stage fine = { *m, MR_NEW(ctx, m->nv, uint32_t), n };
	size_t made = 0;

	memcpy(fine.number, number, m->nv * sizeof *number);
	while (made < LEVELS_MAX && fine.n > COARSEST) {
		stage coarse;
		places w = { .fine = &fine, .coarse = &coarse };
		mr_places map;
		MR_TRY(remesh_stage(ctx, &fine, &coarse, &map));
		if (coarse.n == 0 || coarse.n > fine.n / 2)
			break; /* as coarse as the topology allows */
		place_vertices(ctx, &map, &w);
		MR_TRY(prolong(ctx, &w, &levels[made].prolong));
		levels[made].n = coarse.n;
		made++;
		fine = coarse;
	}
	*level = levels;
	*count = made;
	return MR_OK;
}
