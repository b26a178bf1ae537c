/* Lee, Moreton, Hoppe 2000: Displaced subdivision surfaces, section 4.3. */
#include "base/parallel.h"
#include "sample/parts.h"
#include "space/bvh.h"

enum { GRAIN = 256 };

typedef struct rays {
	const mr_domain *d;
	const mr_mesh *mesh;
	const mr_sample_cloud *c; /* its vertices */
	const mr_bvh *bvh;
	double apart; /* from one hit to the next */
	double *height;
	bool *hit;
} rays;

/* True where the face looks the way of n, and its corners are nearest to parts of the domain that do so. */
static bool
on_sheet(const rays *r, uint32_t face, mr_v3 n)
{
	const uint32_t *v = r->mesh->t[face].v;

	return mr_dot(mr_unit(mr_face_cross(r->mesh, face)), n) > 0.1 && mr_same_side(r->c, v[0], n) &&
	       mr_same_side(r->c, v[1], n) && mr_same_side(r->c, v[2], n);
}

/* The nearest hit on the sheet of n that is not farther than `most`. */
static bool
first_front(const rays *r, mr_v3 v, mr_v3 n, double sign, double most, double *height)
{
	enum { FACES = 4 }; /* hits on other sheets, at most */
	double from = 0;

	for (int i = 0; i < FACES; i++) {
		mr_ray_hit hit;
		if (!mr_bvh_ray(r->bvh, v, mr_mul(sign, n), from, most, &hit))
			return false;
		if (on_sheet(r, hit.at.face, n)) {
			*height = sign * hit.t;
			return true;
		}
		from = hit.t + r->apart;
	}
	return false;
}

static void
shoot(void *arg, size_t begin, size_t end)
{
	const rays *r = arg;

	for (size_t i = begin; i < end; i++) {
		mr_v3 v = r->d->m.p[i], n = r->d->normal[i];
		double up, down, most;
		bool above, below;
		r->hit[i] = false;
		r->height[i] = 0;
		if (!(mr_norm2(n) > 0))
			continue;
		/* the near sheet: not much farther than the surface is in any direction */
		most = 4 * sqrt(mr_bvh_closest(r->bvh, v).dist2) + r->apart;
		above = first_front(r, v, n, 1, most, &up);
		below = first_front(r, v, n, -1, above ? up : most, &down);
		r->hit[i] = above || below;
		r->height[i] = below ? down : above ? up : 0;
	}
}

void
mr_sample_rays(mr_ctx *ctx, const mr_domain *d, const mr_mesh *mesh, const mr_sample_cloud *c, double *height,
    bool *hit, mr_sample_result *result)
{
	mr_mark mark = mr_mark_take(ctx);
	mr_bvh *bvh;
	rays r = { .d = d,
		.mesh = mesh,
		.c = c,
		.apart = mr_mesh_tolerance(mesh, 1e-9),
		.height = height,
		.hit = hit };

	mr_bvh_build(ctx, mesh, &bvh);
	r.bvh = bvh;
	mr_parallel(ctx, d->m.nv, GRAIN, shoot, &r);
	result->missed = 0;
	for (size_t i = 0; i < d->m.nv; i++)
		result->missed += !hit[i];
	mr_mark_release(ctx, mark);
}
