/* Local thickness by rays: Shapira, Shamir, Cohen-Or 2008: Consistent mesh partitioning and skeletonisation
 * using the shape diameter function. */
#include "space/thickness.h"

#include "base/parallel.h"
#include "space/bvh.h"

typedef struct caster {
	const mr_mesh *m;
	const mr_v3 *normal; /* of the vertices */
	const mr_bvh *bvh;
	double most, least; /* length of a ray; where it begins */
	double *across;     /* of each face */
} caster;

/* The mean of the corners' normals; zero where they cancel. */
static mr_v3
direction_of(const caster *c, const uint32_t *v)
{
	return mr_unit(mr_add(c->normal[v[0]], mr_add(c->normal[v[1]], c->normal[v[2]])));
}

static double
cast(const caster *c, mr_v3 from, mr_v3 along)
{
	mr_ray_hit hit;

	return mr_bvh_ray(c->bvh, from, along, c->least, c->most, &hit) ? hit.t : c->most;
}

static void
cast_faces(void *arg, size_t begin, size_t end)
{
	static const mr_v3 centre = { 1. / 3, 1. / 3, 1. / 3 };
	caster *c = arg;

	for (size_t f = begin; f < end; f++) {
		mr_v3 n = direction_of(c, c->m->t[f].v);
		mr_v3 from = mr_place_point(c->m, (mr_place){ (uint32_t)f, centre });
		c->across[f] = c->most;
		if (mr_norm2(n) > 0)
			c->across[f] = fmin(cast(c, from, n), cast(c, from, mr_mul(-1, n)));
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
	return sorted[(n - 1) / 2];
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

mr_status
mr_thickness(mr_ctx *ctx, const mr_mesh *m, double most, double *thickness)
{
	const double apart = 1e-9; /* of the diagonal: a ray does not meet the face that it leaves */
	mr_mark mark = mr_mark_take(ctx);
	mr_v3 *normal = MR_NEW(ctx, m->nv, mr_v3);
	double *across = MR_NEW(ctx, m->nf, double);
	mr_incidence inc;
	mr_bvh *bvh;

	if (!normal || !across)
		return MR_EMEM;
	MR_TRY(mr_incidence_build(ctx, m, &inc));
	MR_TRY(mr_vertex_normals(ctx, m, &inc, normal));
	MR_TRY(mr_bvh_build(ctx, m, &bvh));
	mr_parallel(ctx, m->nf, 256, cast_faces,
	    &(caster){ m, normal, bvh, most, mr_mesh_tolerance(m, apart), across });
	for (size_t v = 0; v < m->nv; v++)
		thickness[v] = median_around(&inc, v, across, most);
	walk(m, thickness);
	mr_mark_release(ctx, mark);
	return MR_OK;
}
