/* Distances of a surface from points, both ways; the law by which tools warn of surface without points. */
#include "measure/gaps.h"

#include "base/sort.h"
#include "space/bvh.h"

/* Surface is bare that is so many times farther from the nearest place than that one from its neighbours. */
static const double FAR = 4;

/* Spacings that a result and its points may be apart anywhere.  54 uniform clouds: 5 farther, all wrong. */
static const double WIDE = 3;

/* The share of the area that may be bare without a warning. */
static const double BARE_MOST = 0.01;

mr_gap
mr_gap_of(double *distance, size_t n)
{
	mr_gap side;
	double sum = 0;

	mr_unmeasured(&side, sizeof side);
	if (n == 0)
		return side;
	for (size_t i = 0; i < n; i++)
		sum += distance[i];
	side.mean = sum / (double)n;
	side.max = mr_kth(distance, n, n - 1);
	side.high = mr_kth(distance, n, (size_t)ceil(0.99 * (double)n) - 1);
	return side;
}

/* The i-th of equal areas' place within its face: R2 (Roberts 2018), folded into the triangle. */
static mr_v3
place_in(const mr_mesh *m, size_t face, size_t i)
{
	const uint32_t *v = m->t[face].v;
	double whole, a = modf(0.5 + 0.7548776662466927 * (double)i, &whole),
		      b = modf(0.5 + 0.5698402909980532 * (double)i, &whole);

	if (a + b > 1) {
		a = 1 - a;
		b = 1 - b;
	}
	return mr_axpy(
	    a, mr_sub(m->p[v[1]], m->p[v[0]]), mr_axpy(b, mr_sub(m->p[v[2]], m->p[v[0]]), m->p[v[0]]));
}

/* A place in each of n equal parts of the area, in the order of the faces; how many: 0 of no area.  q: n. */
static size_t
spread_places(mr_ctx *ctx, const mr_mesh *m, size_t n, mr_v3 *q)
{
	double step = 2 * mr_mesh_area(ctx, m) / (double)n, sum = 0;
	size_t i = 0;

	for (size_t f = 0; f < m->nf && step > 0; f++) {
		sum += mr_norm(mr_face_cross(m, f));
		for (; i < n && ((double)i + 0.5) * step < sum; i++)
			q[i] = place_in(m, f, i);
	}
	return i;
}

mr_status
mr_gap_of_surface(mr_ctx *ctx, const mr_mesh *m, const mr_gap_cloud *cloud, size_t samples, mr_gaps *gaps,
    mr_gap_spot *widest)
{
	MR_SCOPE(ctx);
	mr_v3 *q = MR_NEW(ctx, samples, mr_v3);
	uint32_t *nearest = MR_NEW(ctx, samples, uint32_t);
	double *distance = MR_NEW(ctx, samples, double);
	size_t n, bare = 0;

	n = spread_places(ctx, m, samples, q);
	MR_TRY(mr_near_query(ctx, cloud->near, q, n, 1, nearest, distance));
	for (size_t i = 0; i < n; i++) {
		double wide;
		distance[i] = sqrt(distance[i]);
		wide = distance[i] / fmax(cloud->usual, cloud->spacing[nearest[i]]);
		bare += wide > FAR;
		if (widest && wide > widest->wide)
			*widest = (mr_gap_spot){ wide, q[i] };
	}
	gaps->surface = mr_gap_of(distance, n);
	gaps->bare = n ? (double)bare / (double)n : 0;
	return MR_OK;
}

void
mr_gaps_report(mr_ctx *ctx, const char *layer, const mr_gaps *g)
{
	if (g->bare > BARE_MOST)
		mr_found(ctx, &(mr_finding){ .kind = MR_BARE, .layer = layer, .value = g->bare });
}

void
mr_gap_spots_report(mr_ctx *ctx, const char *layer, const mr_gaps *gaps, const mr_gap_spot *of_surface,
    const mr_gap_spot *of_points)
{
	mr_gaps_report(ctx, layer, gaps);
	if (gaps->bare <= BARE_MOST && of_surface->wide > WIDE)
		mr_found(ctx, &(mr_finding){ .kind = MR_BARE,
				  .layer = layer,
				  .value = gaps->bare,
				  .placed = true,
				  .vertex = MR_NO_VERTEX,
				  .at = of_surface->at });
	if (of_points->wide > WIDE)
		mr_found(ctx, &(mr_finding){ .kind = MR_UNREACHED,
				  .layer = layer,
				  .count = 1,
				  .placed = true,
				  .vertex = MR_NO_VERTEX,
				  .at = of_points->at });
}

/* Shares of the diagonal that a surface and its mesh may be apart anywhere, and but for OFF_MOST. */
static const double FAR_OF_MESH = 0.018, OFF = 0.005, OFF_MOST = 0.02;

void
mr_gaps_add(
    mr_ctx *ctx, const mr_mesh *from, const mr_bvh *bvh, size_t samples, double off, mr_mesh_gaps *gaps)
{
	size_t corners = 3 * from->nf < samples ? 3 * from->nf : samples, n, beyond = 0;
	mr_v3 *q = MR_NEW(ctx, samples + corners, mr_v3);
	double *distance = MR_NEW(ctx, samples + corners, double);

	n = spread_places(ctx, from, samples, q);
	for (size_t i = 0; i < corners; i++) {
		size_t h = i * 3 * from->nf / corners;
		q[n + i] = from->p[from->t[h / 3].v[h % 3]];
	}
	mr_bvh_distances(ctx, bvh, q, n + corners, distance);
	for (size_t i = 0; i < n + corners; i++) {
		beyond += i < n && distance[i] > off;
		if (distance[i] > gaps->widest) {
			gaps->widest = distance[i];
			gaps->at = q[i];
		}
	}
	gaps->off = fmax(gaps->off, n ? (double)beyond / (double)n : 0);
	gaps->surface = mr_gap_of(distance, n);
}

void
mr_gaps_to_mesh(mr_ctx *ctx, const mr_mesh *surface, const mr_mesh *mesh, size_t samples, mr_mesh_gaps *gaps)
{
	MR_SCOPE(ctx);
	double off = OFF * mr_mesh_diagonal(mesh);
	mr_mesh_gaps g = { .widest = 0 };
	mr_bvh *bvh, *bvh_mesh;

	mr_bvh_build(ctx, surface, &bvh);
	mr_bvh_build(ctx, mesh, &bvh_mesh);
	mr_gaps_add(ctx, mesh, bvh, samples, off, &g);
	mr_gaps_add(ctx, surface, bvh_mesh, samples, off, &g);
	*gaps = g;
}

void
mr_mesh_gaps_report(mr_ctx *ctx, const char *layer, const mr_mesh_gaps *g, const mr_mesh *mesh)
{
	double diagonal = mr_mesh_diagonal(mesh);

	if (g->widest > FAR_OF_MESH * diagonal || g->off > OFF_MOST)
		mr_found(ctx, &(mr_finding){ .kind = MR_DISTANT,
				  .layer = layer,
				  .what = "more faces come nearer",
				  .value = g->widest / diagonal,
				  .placed = true,
				  .vertex = MR_NO_VERTEX,
				  .at = g->at });
}
