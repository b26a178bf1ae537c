/* Texture coordinates by where a vertex is: of a plane its own, else around the upright axis, with a seam at
 * the half turn. */
#include "shape/shape.h"

/* With the axis along z; bumpy, which stands on y, looks along x, where the middle of the picture is. */
static mr_v3
upright(mr_solid solid, mr_v3 p)
{
	return solid == MR_BUMPY ? mr_vec(p.z, p.x, p.y) : p;
}

static bool
on_axis(mr_v3 p)
{
	return hypot(p.x, p.y) < 1e-9;
}

/* The corners of a face around the axis: none a half turn from the first; one on the axis between the others.
 */
static void
wrap_face(const mr_v3 p[3], double uv[6])
{
	int first = on_axis(p[0]) ? 1 : 0;

	for (int k = 0; k < 3; k++) {
		double r = mr_norm(p[k]);
		uv[2 * k] = 0.5 + atan2(p[k].y, p[k].x) / (2 * MR_PI);
		uv[2 * k + 1] = 1 - acos(r > 0 ? p[k].z / r : 0) / MR_PI;
	}
	for (int k = 0; k < 3; k++)
		uv[2 * k] -= floor(uv[2 * k] - uv[2 * first] + 0.5);
	for (int k = 0; k < 3; k++)
		if (on_axis(p[k]))
			uv[2 * k] = (uv[2 * ((k + 1) % 3)] + uv[2 * ((k + 2) % 3)]) / 2;
}

void
mr_solid_texcoords(mr_ctx *ctx, mr_solid solid, const mr_mesh *m, double **corners)
{
	double *uv = MR_NEW(ctx, 6 * m->nf, double);

	for (size_t f = 0; f < m->nf; f++) {
		mr_v3 p[3];
		for (size_t k = 0; k < 3; k++) {
			p[k] = upright(solid, m->p[m->t[f].v[k]]);
			uv[6 * f + 2 * k] = (p[k].x + 1) / 2;
			uv[6 * f + 2 * k + 1] = (p[k].y + 1) / 2;
		}
		if (solid != MR_PLANE)
			wrap_face(p, uv + 6 * f);
	}
	*corners = uv;
}
