/* Points uniform by area: a face by its share of the running sum of areas, then a place in it. */
#include "shape/shape.h"

#include "base/random.h"

/* The first face whose running sum of areas is above x. */
static size_t
face_at(const double *sum, size_t nf, double x)
{
	size_t low = 0, high = nf - 1;

	while (low < high) {
		size_t middle = low + (high - low) / 2;
		if (sum[middle] > x)
			high = middle;
		else
			low = middle + 1;
	}
	return low;
}

mr_status
mr_surface_sample(mr_ctx *ctx, const mr_mesh *m, size_t count, uint64_t seed, mr_v3 **points, mr_v3 **normals)
{
	mr_v3 *p = MR_NEW(ctx, count, mr_v3), *normal = MR_NEW(ctx, count, mr_v3);
	MR_SCOPE(ctx);
	double *sum = MR_NEW(ctx, m->nf, double), total = 0;
	mr_random r = { seed };

	for (size_t f = 0; f < m->nf; f++)
		sum[f] = total += mr_norm(mr_face_cross(m, f));
	if (!(total > 0))
		return mr_fail(ctx, MR_EMESH, "%s: the %zu faces have no area to sample", m->name, m->nf);
	for (size_t i = 0; i < count; i++) {
		size_t f = face_at(sum, m->nf, mr_random_real(&r) * total);
		/* uniform in the triangle (Osada, Funkhouser, Chazelle, Dobkin 2002, section 4) */
		double a = sqrt(mr_random_real(&r)), b = mr_random_real(&r);
		p[i] = mr_place_point(m, (mr_place){ (uint32_t)f, mr_vec(1 - a, a * (1 - b), a * b) });
		normal[i] = mr_unit(mr_face_cross(m, f));
	}
	*points = p;
	*normals = normal;
	return MR_OK;
}

/* A Gaussian deviate (Box, Muller 1958). */
static double
gaussian(mr_random *r)
{
	double u = 1 - mr_random_real(r), v = mr_random_real(r);

	return sqrt(-2 * log(u)) * cos(2 * MR_PI * v);
}

void
mr_add_noise(mr_v3 *p, const mr_v3 *normal, size_t n, double deviation, uint64_t seed)
{
	mr_random r = { seed };

	for (size_t i = 0; i < n; i++)
		p[i] = mr_axpy(deviation * gaussian(&r), normal[i], p[i]);
}
