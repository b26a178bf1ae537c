/* Local thickness by rays: Shapira, Shamir, Cohen-Or 2008: Consistent mesh partitioning and skeletonisation
 * using the shape diameter function. */
#include "space/thickness.h"

#include "base/parallel.h"
#include "base/sort.h"
#include "space/bvh.h"

typedef struct caster {
	const mr_mesh *m;
	const mr_bvh *bvh;
	const mr_v3 *normal; /* of the vertices */
	double least, most;  /* where a ray begins and ends */
	double *across;      /* of each face; NAN: to be cast, INFINITY: not known */
} caster;

static void
cast_faces(void *arg, size_t begin, size_t end)
{
	static const mr_v3 centre = { 1. / 3, 1. / 3, 1. / 3 };
	caster *c = arg;

	for (size_t i = begin; i < end; i++) {
		uint32_t f = mr_bvh_order(c->bvh)[i];
		const uint32_t *v = c->m->t[f].v;
		mr_v3 normal;
		if (!isnan(c->across[f]))
			continue;
		normal = mr_add(c->normal[v[0]], mr_add(c->normal[v[1]], c->normal[v[2]]));
		c->across[f] = mr_bvh_across(c->bvh, mr_place_point(c->m, (mr_place){ f, centre }),
		    mr_unit(normal), c->least, c->most);
	}
}

/* First faces without a vertex in common, as many as there is room for. */
static void
want_some(const caster *c, bool *taken)
{
	for (size_t f = 0; f < c->m->nf; f++) {
		const uint32_t *v = c->m->t[f].v;
		c->across[f] = taken[v[0]] || taken[v[1]] || taken[v[2]] ? INFINITY : NAN;
		if (isnan(c->across[f]))
			taken[v[0]] = taken[v[1]] = taken[v[2]] = true;
	}
}

/* Then all faces around those with few edges' thickness: there one ray may measure too little or too much. */
static void
want_thin(const caster *c, const mr_incidence *inc)
{
	const double edges = 8;

	for (size_t f = 0; f < c->m->nf; f++) {
		const uint32_t *v = c->m->t[f].v;
		double sides = mr_dist(c->m->p[v[0]], c->m->p[v[1]]) + mr_dist(c->m->p[v[1]], c->m->p[v[2]]);
		if (c->across[f] < fmin(c->most, edges / 2 * sides))
			for (int k = 0; k < 3; k++)
				for (size_t i = inc->start[v[k]]; i < inc->start[v[k] + 1]; i++)
					if (c->across[inc->face[i]] == INFINITY)
						c->across[inc->face[i]] = NAN;
	}
}

/* The lower median of the faces around a vertex: one ray that slips through a gap does not count. */
static double
median_around(const mr_incidence *inc, size_t v, const double *across, double most)
{
	enum { AROUND = 64 }; /* of more faces these */
	double known[AROUND];
	size_t n = 0;

	for (size_t i = inc->start[v]; i < inc->start[v + 1] && n < AROUND; i++)
		if (across[inc->face[i]] < INFINITY)
			known[n++] = across[inc->face[i]];
	return n ? mr_kth(known, n, (n - 1) / 2) : most;
}

/* thickness[a] <= thickness[b] + |a - b| over the edges of a face; true where that lowered one. */
static bool
walk_face(const mr_mesh *m, size_t f, const double length[3], double *thickness)
{
	const double step = 1e-6; /* of a distance: less is not worth another round */
	const uint32_t *v = m->t[f].v;
	bool lowered = false;

	for (int k = 0; k < 3; k++) {
		uint32_t a = v[k], b = v[(k + 1) % 3];
		if (thickness[a] > (1 + step) * (thickness[b] + length[k])) {
			thickness[a] = thickness[b] + length[k];
			lowered = true;
		} else if (thickness[b] > (1 + step) * (thickness[a] + length[k])) {
			thickness[b] = thickness[a] + length[k];
			lowered = true;
		}
	}
	return lowered;
}

/* To and fro over the faces until nothing changes: a few rounds, as meshes lie in memory. */
static void
walk(mr_ctx *ctx, const mr_mesh *m, double *thickness)
{
	MR_SCOPE(ctx);
	double(*length)[3] = mr_alloc(ctx, m->nf, sizeof *length);

	for (size_t f = 0; f < m->nf; f++)
		for (int k = 0; k < 3; k++)
			length[f][k] = mr_dist(m->p[m->t[f].v[k]], m->p[m->t[f].v[(k + 1) % 3]]);
	for (bool lowered = true; lowered;) {
		lowered = false;
		for (size_t f = 0; f < m->nf; f++)
			lowered |= walk_face(m, f, length[f], thickness);
		for (size_t f = m->nf; lowered && f-- > 0;)
			walk_face(m, f, length[f], thickness);
	}
}

void
mr_thickness(mr_ctx *ctx, const mr_mesh *m, double most, double *thickness)
{
	MR_SCOPE(ctx);
	mr_v3 *normal = MR_NEW(ctx, m->nv, mr_v3);
	caster c = { .m = m, .normal = normal, .most = most, .across = MR_NEW(ctx, m->nf, double) };
	mr_incidence inc;
	mr_bvh *bvh;

	mr_incidence_build(ctx, m, &inc);
	mr_vertex_normals(m, normal);
	mr_bvh_build(ctx, m, &bvh);
	c.bvh = bvh;
	c.least = mr_mesh_tolerance(m, 1e-9); /* none meets the face that it leaves */
	want_some(&c, MR_NEW_ZERO(ctx, m->nv, bool));
	mr_parallel(ctx, m->nf, 256, cast_faces, &c);
	want_thin(&c, &inc);
	mr_parallel(ctx, m->nf, 256, cast_faces, &c);
	for (size_t v = 0; v < m->nv; v++)
		thickness[v] = median_around(&inc, v, c.across, most);
	walk(ctx, m, thickness);
}
