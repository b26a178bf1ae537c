/* Local thickness by rays: Shapira, Shamir, Cohen-Or 2008: Consistent mesh partitioning and skeletonisation
 * using the shape diameter function. */
#include "space/thickness.h"

#include "base/parallel.h"
#include "space/bvh.h"

typedef struct caster {
	const mr_sounding *body;
	const double *most; /* of the vertices */
	double least;       /* where a ray begins */
	double *across;     /* of each face */
} caster;

/* The mean of the corners' normals; zero where they cancel. */
static mr_v3
direction_of(const caster *c, const uint32_t *v)
{
	const mr_v3 *n = c->body->normal;

	return mr_unit(mr_add(n[v[0]], mr_add(n[v[1]], n[v[2]])));
}

static double
most_of(const caster *c, const uint32_t *v)
{
	return fmax(c->most[v[0]], fmax(c->most[v[1]], c->most[v[2]]));
}

static void
cast_faces(void *arg, size_t begin, size_t end)
{
	static const mr_v3 centre = { 1. / 3, 1. / 3, 1. / 3 };
	caster *c = arg;
	const mr_mesh *m = c->body->m;

	for (size_t i = begin; i < end; i++) {
		uint32_t f = mr_bvh_order(c->body->bvh)[i];
		const uint32_t *v = m->t[f].v;
		c->across[f] = most_of(c, v);
		if (c->across[f] > c->least)
			c->across[f] = mr_bvh_across(c->body->bvh, mr_place_point(m, (mr_place){ f, centre }),
			    direction_of(c, v), c->least, c->across[f]);
	}
}

/* The lower median of the faces around a vertex: one ray that slips through a gap does not count. */
static double
median_around(const mr_incidence *inc, size_t v, const double *across, double most)
{
	enum { AROUND = 64 }; /* of more faces these */
	size_t n = inc->start[v + 1] - inc->start[v];
	double sorted[AROUND];

	if (n == 0)
		return most;
	n = n < AROUND ? n : AROUND;
	for (size_t i = 0; i < n; i++) {
		double x = across[inc->face[inc->start[v] + i]];
		size_t k = i;
		for (; k > 0 && sorted[k - 1] > x; k--)
			sorted[k] = sorted[k - 1];
		sorted[k] = x;
	}
	return fmin(sorted[(n - 1) / 2], most);
}

/* thickness[a] <= thickness[b] + |a - b| over the edges of a face; true where that lowered one. */
static bool
walk_face(const mr_mesh *m, size_t f, double *thickness)
{
	const double step = 1e-6; /* of a distance: less is not worth another round */
	const uint32_t *v = m->t[f].v;
	bool lowered = false;

	for (int k = 0; k < 3; k++) {
		uint32_t a = v[k], b = v[(k + 1) % 3];
		double length = mr_dist(m->p[a], m->p[b]);
		if (thickness[a] > (1 + step) * (thickness[b] + length)) {
			thickness[a] = thickness[b] + length;
			lowered = true;
		} else if (thickness[b] > (1 + step) * (thickness[a] + length)) {
			thickness[b] = thickness[a] + length;
			lowered = true;
		}
	}
	return lowered;
}

/* To and fro over the faces until nothing changes: a few rounds, as meshes lie in memory. */
static void
walk(const mr_mesh *m, double *thickness)
{
	for (bool lowered = true; lowered;) {
		lowered = false;
		for (size_t f = 0; f < m->nf; f++)
			lowered |= walk_face(m, f, thickness);
		for (size_t f = m->nf; lowered && f-- > 0;)
			walk_face(m, f, thickness);
	}
}

/* What is asked for at a vertex concerns those around it, by as much less as they are off. */
static void
spread(const mr_mesh *m, double *most)
{
	double all = 0;

	for (size_t v = 0; v < m->nv; v++)
		all = fmax(all, most[v]);
	for (size_t v = 0; v < m->nv; v++)
		most[v] = all - most[v];
	walk(m, most);
	for (size_t v = 0; v < m->nv; v++)
		most[v] = all - most[v];
}

mr_status
mr_sounding_build(mr_ctx *ctx, const mr_mesh *m, mr_sounding *body)
{
	mr_incidence *inc = MR_NEW(ctx, 1, mr_incidence);
	mr_v3 *normal = MR_NEW(ctx, m->nv, mr_v3);
	mr_bvh *bvh;

	MR_TRY(mr_incidence_build(ctx, m, inc));
	MR_TRY(mr_vertex_normals(ctx, m, inc, normal));
	mr_bvh_build(ctx, m, &bvh);
	*body = (mr_sounding){ m, inc, normal, bvh };
	return MR_OK;
}

void
mr_thickness(mr_ctx *ctx, const mr_sounding *body, double *thickness)
{
	const mr_mesh *m = body->m;
	mr_mark mark = mr_mark_take(ctx);
	double *across = MR_NEW(ctx, m->nf, double);

	spread(m, thickness);
	mr_parallel(ctx, m->nf, 256, cast_faces,
	    &(caster){ body, thickness, mr_mesh_tolerance(m, MR_RAY_BEGINS), across });
	for (size_t v = 0; v < m->nv; v++)
		thickness[v] = median_around(body->inc, v, across, thickness[v]);
	walk(m, thickness);
	mr_mark_release(ctx, mark);
}
