/* Texture coordinates by where a vertex is: around an axis, with a seam at the half turn. */
#include "shape/shape.h"

static bool
on_axis(mr_solid solid, mr_v3 p)
{
	return solid != MR_TORUS && hypot(p.x, solid == MR_BUMPY ? p.z : p.y) < 1e-9;
}

/* A turn is 1. */
static double
turn(double y, double x)
{
	return atan2(y, x) / (2 * MR_PI);
}

static void
place_of(mr_solid solid, mr_v3 p, double uv[2])
{
	double r = mr_norm(p);

	switch (solid) {
	case MR_TORUS:
		uv[0] = turn(p.y, p.x);
		uv[1] = turn(p.z, hypot(p.x, p.y) - 1);
		break;
	case MR_CYLINDER:
		uv[0] = turn(p.y, p.x);
		uv[1] = (p.z + 2) / 4;
		break;
	case MR_BUMPY: /* its front looks along z, where the middle of the picture is */
		uv[0] = turn(p.x, p.z) + 0.5;
		uv[1] = 1 - acos(r > 0 ? p.y / r : 0) / MR_PI;
		break;
	default:
		uv[0] = turn(p.y, p.x);
		uv[1] = 1 - acos(r > 0 ? p.z / r : 0) / MR_PI;
	}
}

/* The turn nearest to another. */
static double
near_turn(double x, double other)
{
	return x - floor(x - other + 0.5);
}

/* The corners of a face around the axis: none a half turn from the first; one on the axis between the others.
 */
static void
wrap_face(mr_solid solid, const mr_v3 p[3], double uv[6])
{
	int first = on_axis(solid, p[0]) ? 1 : 0;

	for (int k = 0; k < 3; k++)
		place_of(solid, p[k], uv + 2 * k);
	for (int k = 0; k < 3; k++) {
		uv[2 * k] = near_turn(uv[2 * k], uv[2 * first]);
		if (solid == MR_TORUS)
			uv[2 * k + 1] = near_turn(uv[2 * k + 1], uv[1]);
	}
	for (int k = 0; k < 3; k++)
		if (on_axis(solid, p[k]))
			uv[2 * k] = (uv[2 * ((k + 1) % 3)] + uv[2 * ((k + 2) % 3)]) / 2;
}

static bool
on_cap(const mr_v3 p[3])
{
	return fabs(p[0].z) == 2 && p[1].z == p[0].z && p[2].z == p[0].z;
}

bool
mr_solid_has_texcoords(mr_solid solid)
{
	return solid == MR_SPHERE || solid == MR_TORUS || solid == MR_PLANE || solid == MR_CYLINDER ||
	       solid == MR_BUMPY;
}

void
mr_solid_texcoords(mr_ctx *ctx, mr_solid solid, const mr_mesh *m, double **corners)
{
	double *uv = MR_NEW(ctx, 6 * m->nf, double);

	for (size_t f = 0; f < m->nf; f++) {
		const uint32_t *v = m->t[f].v;
		const mr_v3 p[3] = { m->p[v[0]], m->p[v[1]], m->p[v[2]] };
		if (solid != MR_PLANE && !(solid == MR_CYLINDER && on_cap(p))) {
			wrap_face(solid, p, uv + 6 * f);
			continue;
		}
		for (int k = 0; k < 3; k++) {
			uv[6 * f + 2 * (size_t)k] = (p[k].x + 1) / 2;
			uv[6 * f + 2 * (size_t)k + 1] = (p[k].y + 1) / 2;
		}
	}
	*corners = uv;
}
