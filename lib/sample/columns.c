/* Columns of points, or of a mesh, at the vertices of the surface that is displaced to them. */
#include "base/parallel.h"
#include "base/sort.h"
#include "sample/parts.h"
#include "space/bvh.h"

enum { LOOKED_AT = 16, NEAREST = 6, CHUNK = 1 << 13, GRAIN = 256 };

typedef struct job {
	const mr_domain *d;
	const mr_sample_cloud *c;
	const uint32_t *of; /* point of each place */
	size_t k, first;
	const uint32_t *nearest; /* k of each vertex from the first, and their squared distances */
	const double *dist2;
	uint32_t *parent; /* NEAREST of each vertex from the first, and their weights, 0 of none */
	double *weight;
	const mr_carried *column; /* of those that are means */
	double *robust;           /* the weights for it */
} job;

/* Squared distances below this share of the farthest that is looked at are as good as none. */
static const double THERE = 1e-12;

/* The nearest points of a vertex's own sheet, or of any sheet if that has none, and their weights: inverse
 * squares, as higher powers come no nearer to linear functions. */
static void
weigh(const job *j, size_t i, uint32_t point[NEAREST], double weight[NEAREST])
{
	const uint32_t *near = j->nearest + i * j->k;
	const double *dist2 = j->dist2 + i * j->k;
	mr_v3 normal = j->d->normal[j->first + i];
	size_t n = 0;

	for (int any = 0; any < 2 && n == 0; any++)
		for (size_t k = 0; k < j->k && n < NEAREST; k++) {
			if (!any && !mr_same_side(j->c, near[k], normal))
				continue;
			point[n] = j->of[near[k]];
			weight[n++] = 1 / fmax(dist2[k] / dist2[j->k - 1], THERE);
		}
	for (; n < NEAREST; n++) {
		point[n] = point[0];
		weight[n] = 0;
	}
}

static void
weigh_vertices(void *arg, size_t begin, size_t end)
{
	const job *j = arg;

	for (size_t i = begin; i < end; i++)
		weigh(j, i, j->parent + i * NEAREST, j->weight + i * NEAREST);
}

/* A value is a spot if its distance from the median is over so many times the median distance. */
static const double FAR = 6;

/* Adds the distances of component k from its median. */
static void
add_distances(const mr_carried *c, size_t k, const uint32_t parent[NEAREST], const double weight[NEAREST],
    double far[NEAREST])
{
	double x[NEAREST], sorted[NEAREST], median;
	size_t n = 0;

	for (size_t i = 0; i < NEAREST; i++) {
		size_t at = parent[i] * c->shape.components + k;
		x[i] = c->shape.type == 'd' ? ((const double *)c->from)[at] : ((const uint8_t *)c->from)[at];
		if (weight[i] > 0 && isfinite(x[i]))
			sorted[n++] = x[i];
	}
	median = n > 0 ? mr_kth(sorted, n, n / 2) : 0;
	for (size_t i = 0; i < NEAREST && n > 0; i++)
		far[i] += isfinite(x[i]) ? fabs(x[i] - median) : 0;
}

static void
leave_out_spots(void *arg, size_t begin, size_t end)
{
	const job *j = arg;

	for (size_t i = begin; i < end; i++) {
		double *weight = j->robust + i * NEAREST, far[NEAREST] = { 0 }, sorted[NEAREST], most;
		size_t n = 0;
		memcpy(weight, j->weight + i * NEAREST, NEAREST * sizeof *weight);
		for (size_t k = 0; k < j->column->shape.components; k++)
			add_distances(j->column, k, j->parent + i * NEAREST, weight, far);
		for (size_t k = 0; k < NEAREST; k++)
			if (weight[k] > 0)
				sorted[n++] = far[k];
		most = FAR * mr_kth(sorted, n, n / 2);
		for (size_t k = 0; k < NEAREST; k++)
			if (far[k] > most)
				weight[k] = 0;
	}
}

static mr_status
carry(mr_ctx *ctx, job *j, const mr_v3 *vertex, const mr_carried *column, size_t count)
{
	size_t nv = j->d->m.nv, chunk = nv < CHUNK ? nv : CHUNK;
	uint32_t *nearest = MR_NEW(ctx, chunk * j->k, uint32_t);
	double *dist2 = MR_NEW(ctx, chunk * j->k, double);

	j->parent = MR_NEW(ctx, chunk * NEAREST, uint32_t);
	j->weight = MR_NEW(ctx, chunk * NEAREST, double);
	j->robust = MR_NEW(ctx, chunk * NEAREST, double);
	j->nearest = nearest;
	j->dist2 = dist2;
	for (j->first = 0; j->first < nv; j->first += chunk) {
		size_t n = nv - j->first < chunk ? nv - j->first : chunk;
		MR_TRY(mr_near_query(ctx, j->c->near, vertex + j->first, n, j->k, nearest, dist2));
		mr_parallel(ctx, n, GRAIN, weigh_vertices, j);
		for (size_t i = 0; i < count; i++) {
			mr_rows_from from = { n, NEAREST, j->parent, j->weight };
			if (column[i].kind == MR_MEAN) {
				j->column = &column[i];
				mr_parallel(ctx, n, GRAIN, leave_out_spots, j);
				from.weight = j->robust;
			}
			mr_carried_make(ctx, &column[i], 1, j->first, from);
		}
	}
	return MR_OK;
}

mr_status
mr_sample_columns(mr_ctx *ctx, const mr_domain *d, const double *height, const mr_v3 *point,
    const mr_sampling *s, const mr_carried *column, size_t count)
{
	mr_mark mark = mr_mark_take(ctx);
	mr_v3 *vertex = MR_NEW(ctx, d->m.nv, mr_v3), *p;
	job j = { .d = d };
	mr_sample_cloud c = { 0 };
	uint32_t *of;

	mr_domain_displace(ctx, d, height, 1, vertex);
	mr_sampling_places(ctx, point, s, &p, &of, &c.n);
	c.p = p;
	mr_sample_place(ctx, d, &c, NULL);
	MR_TRY(mr_near_build_distinct(ctx, p, c.n, &c.near));
	j.c = &c;
	j.of = of;
	j.k = c.n < LOOKED_AT ? c.n : LOOKED_AT;
	MR_TRY(carry(ctx, &j, vertex, column, count));
	mr_mark_release(ctx, mark);
	return MR_OK;
}

typedef struct mesh_job {
	const mr_mesh *m;
	const mr_bvh *bvh;
	const mr_v3 *vertex;
	uint32_t *parent; /* three of each vertex, and their weights */
	double *weight;
} mesh_job;

static void
place_vertices(void *arg, size_t begin, size_t end)
{
	const mesh_job *j = arg;

	for (size_t i = begin; i < end; i++) {
		mr_place at = mr_bvh_closest(j->bvh, j->vertex[i]).at;
		memcpy(j->parent + 3 * i, j->m->t[at.face].v, 3 * sizeof *j->parent);
		memcpy(j->weight + 3 * i, &at.bary, sizeof at.bary);
	}
}

void
mr_sample_mesh_columns(mr_ctx *ctx, const mr_domain *d, const double *height, const mr_mesh *m,
    const mr_carried *column, size_t count)
{
	MR_SCOPE(ctx);
	size_t n = d->m.nv;
	mr_v3 *vertex = MR_NEW(ctx, n, mr_v3);
	mesh_job j = { m, NULL, vertex, MR_NEW(ctx, 3 * n, uint32_t), MR_NEW(ctx, 3 * n, double) };
	mr_bvh *bvh;

	mr_domain_displace(ctx, d, height, 1, vertex);
	mr_bvh_build(ctx, m, &bvh);
	j.bvh = bvh;
	mr_parallel(ctx, n, GRAIN, place_vertices, &j);
	for (size_t i = 0; i < count; i++)
		mr_carried_make(ctx, &column[i], 1, 0, (mr_rows_from){ n, 3, j.parent, j.weight });
}
