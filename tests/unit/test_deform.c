/* Boundary-constraint modelling against a dense solve of the paper's own definition, and its invariants. */
#include "base/random.h"
#include "edit/deform.h"
#include "edit/handles.h"
#include "mesh/layers.h"
#include "op/voronoi_area.h"
#include "shapes.h"

enum { FREE = MR_REGION_FREE, FIXED = MR_REGION_FIXED, HANDLE = MR_REGION_HANDLE };

/* Meshes */

/* An n x n grid over the unit square, its inner vertices moved by up to `noise` edges. */
static mr_mesh
grid(uint32_t n, double noise, double (*height)(double x, double y))
{
	mr_v3 *p = MR_NEW(&ctx, (size_t)n * n, mr_v3);
	mr_tri *t = MR_NEW(&ctx, 2 * (size_t)(n - 1) * (n - 1), mr_tri);
	mr_random r = { 7 };
	size_t f = 0;

	for (uint32_t i = 0; i < n; i++)
		for (uint32_t j = 0; j < n; j++) {
			bool inner = i > 0 && j > 0 && i < n - 1 && j < n - 1;
			double s = inner ? noise : 0, x = (j + s * (mr_random_real(&r) - 0.5)) / (n - 1);
			double y = (i + s * (mr_random_real(&r) - 0.5)) / (n - 1);
			p[i * n + j] = mr_vec(x, y, height(x, y));
		}
	for (uint32_t i = 0; i + 1 < n; i++)
		for (uint32_t j = 0; j + 1 < n; j++) {
			uint32_t a = i * n + j;
			t[f++] = (mr_tri){ { a, a + 1, a + n + 1 } };
			t[f++] = (mr_tri){ { a, a + n + 1, a + n } };
		}
	return (mr_mesh){ "base", p, t, (size_t)n * n, f };
}

static double
flat(double x, double y)
{
	(void)x;
	(void)y;
	return 0;
}

static double
wavy(double x, double y)
{
	return 0.2 * sin(5 * x) * cos(4 * y) + 0.1 * x;
}

/* A torus of a x b quads, perturbed. */
static mr_mesh
torus(uint32_t a, uint32_t b, double noise)
{
	mr_v3 *p = MR_NEW(&ctx, (size_t)a * b, mr_v3);
	mr_tri *t = MR_NEW(&ctx, 2 * (size_t)a * b, mr_tri);
	mr_random r = { 11 };
	size_t f = 0;

	for (uint32_t i = 0; i < a; i++)
		for (uint32_t j = 0; j < b; j++) {
			double u = 2 * MR_PI * (i + noise * mr_random_real(&r)) / a;
			double v = 2 * MR_PI * (j + noise * mr_random_real(&r)) / b;
			uint32_t k = (i + 1) % a, l = (j + 1) % b;
			p[i * b + j] = mr_vec((3 + cos(v)) * cos(u), (3 + cos(v)) * sin(u), sin(v));
			t[f++] = (mr_tri){ { i * b + j, k * b + j, k * b + l } };
			t[f++] = (mr_tri){ { i * b + j, k * b + l, i * b + l } };
		}
	return (mr_mesh){ "base", p, t, (size_t)a * b, f };
}

/* Below `low` along an axis fixed (or handle 1), above `high` handle 0, free between. */
static uint32_t *
bands(const mr_mesh *m, int axis, double low, double high, uint32_t below)
{
	uint32_t *region = MR_NEW(&ctx, m->nv, uint32_t);
	mr_box box = mr_box_of(m->p, m->nv);
	const double *min = &box.min.x, *max = &box.max.x;

	for (size_t v = 0; v < m->nv; v++) {
		double x = ((&m->p[v].x)[axis] - min[axis]) / (max[axis] - min[axis]);
		region[v] = x < low ? below : x > high ? HANDLE : FREE;
	}
	return region;
}

/* A frame around a grid is constrained: `width` vertices wide. */
static uint32_t *
framed(uint32_t n, uint32_t width)
{
	uint32_t *region = MR_NEW(&ctx, (size_t)n * n, uint32_t);

	for (uint32_t i = 0; i < n; i++)
		for (uint32_t j = 0; j < n; j++)
			region[i * n + j] = i >= width && j >= width && i + width < n && j + width < n
			                        ? FREE
			                        : FIXED;
	return region;
}

/* The literal definition, dense */

static double
cot_at(mr_v3 a, mr_v3 b, mr_v3 c)
{
	mr_v3 u = mr_sub(b, a), v = mr_sub(c, a);
	return 1 / tan(atan2(mr_norm(mr_cross(u, v)), mr_dot(u, v)));
}

/* D, row-major: (D p)_i = 1/A_i sum_j w_ij (p_j - p_i). */
static double *
dense_operator(const mr_mesh *m, bool mean_areas)
{
	size_t n = m->nv;
	double *d = MR_NEW_ZERO(&ctx, n * n, double), *area = MR_NEW(&ctx, n, double);

	mr_voronoi_areas(&ctx, m, area);
	for (size_t f = 0; f < m->nf; f++)
		for (int k = 0; k < 3; k++) {
			size_t i = m->t[f].v[k], j = m->t[f].v[(k + 1) % 3], l = m->t[f].v[(k + 2) % 3];
			double w = cot_at(m->p[l], m->p[i], m->p[j]) / 2;
			d[i * n + j] += w;
			d[j * n + i] += w;
			d[i * n + i] -= w;
			d[j * n + j] -= w;
		}
	for (size_t i = 0; i < n; i++)
		for (size_t j = 0; j < n && !mean_areas; j++)
			d[i * n + j] /= area[i];
	return d;
}

static double *
dense_power(const double *d, size_t n, size_t k)
{
	double *r = MR_NEW(&ctx, n * n, double);

	memcpy(r, d, n * n * sizeof *r);
	for (size_t step = 1; step < k; step++) {
		double *q = MR_NEW_ZERO(&ctx, n * n, double);
		for (size_t i = 0; i < n; i++)
			for (size_t l = 0; l < n; l++)
				for (size_t j = 0; j < n && d[i * n + l] != 0; j++)
					q[i * n + j] += d[i * n + l] * r[l * n + j];
		r = q;
	}
	return r;
}

/* Gauss with partial pivoting: a (n x n) and the right-hand sides b (n x 3), solved in place. */
static void
dense_solve(double *a, double *b, size_t n)
{
	for (size_t c = 0; c < n; c++) {
		size_t pivot = c;
		for (size_t i = c + 1; i < n; i++)
			if (fabs(a[i * n + c]) > fabs(a[pivot * n + c]))
				pivot = i;
		for (size_t j = 0; j < n; j++) {
			double x = a[c * n + j];
			a[c * n + j] = a[pivot * n + j];
			a[pivot * n + j] = x;
		}
		for (size_t j = 0; j < 3; j++) {
			double x = b[c * 3 + j];
			b[c * 3 + j] = b[pivot * 3 + j];
			b[pivot * 3 + j] = x;
		}
		for (size_t i = c + 1; i < n; i++) {
			double s = a[i * n + c] / a[c * n + c];
			for (size_t j = c; j < n && s != 0; j++)
				a[i * n + j] -= s * a[c * n + j];
			for (size_t j = 0; j < 3; j++)
				b[i * 3 + j] -= s * b[c * 3 + j];
		}
	}
	for (size_t i = n; i-- > 0;)
		for (size_t j = 0; j < 3; j++) {
			for (size_t l = i + 1; l < n; l++)
				b[i * 3 + j] -= a[i * n + l] * b[l * 3 + j];
			b[i * 3 + j] /= a[i * n + i];
		}
}

/* D^k p = 0 on the free vertices; the others as in p. */
static void
dense_deform(const mr_mesh *m, const uint32_t *region, size_t k, bool mean_areas, const mr_v3 *p, mr_v3 *out)
{
	size_t n = m->nv, free = 0, row = 0;
	double *d = dense_power(dense_operator(m, mean_areas), n, k);
	double *a = MR_NEW(&ctx, n * n, double), *b = MR_NEW_ZERO(&ctx, 3 * n, double);

	for (size_t i = 0; i < n; i++)
		free += region[i] == FREE;
	for (size_t i = 0; i < n; i++) {
		size_t column = 0;
		for (size_t j = 0; j < n && region[i] == FREE; j++) {
			double x = d[i * n + j];
			if (region[j] == FREE) {
				a[row * free + column++] = x;
				continue;
			}
			b[3 * row] -= x * p[j].x;
			b[3 * row + 1] -= x * p[j].y;
			b[3 * row + 2] -= x * p[j].z;
		}
		row += region[i] == FREE;
	}
	dense_solve(a, b, free);
	row = 0;
	for (size_t i = 0; i < n; i++) {
		out[i] = region[i] == FREE ? mr_vec(b[3 * row], b[3 * row + 1], b[3 * row + 2]) : p[i];
		row += region[i] == FREE;
	}
}

/* Comparing */

static mr_deform_opts
opts_of(size_t order, int areas, bool unsymmetric)
{
	mr_deform_opts opts = MR_DEFORM_DEFAULTS;

	opts.order = order;
	opts.areas = areas;
	opts.unsymmetric = unsymmetric;
	opts.solver.kind = unsymmetric ? MR_LU : MR_CHOLESKY;
	return opts;
}

static mr_deform *
deform_of(const mr_mesh *m, const uint32_t *region, mr_deform_opts opts)
{
	mr_deform *d = NULL;
	mr_status status = mr_deform_new(&ctx, m, NULL, region, &opts, &d);

	if (status != MR_OK)
		fail_msg("%s", ctx.error);
	return d;
}

static double
largest_distance(const mr_v3 *a, const mr_v3 *b, size_t n)
{
	double most = 0;

	for (size_t i = 0; i < n; i++)
		most = fmax(most, mr_dist(a[i], b[i]));
	return most;
}

static void
assert_same(const mr_mesh *m, const mr_v3 *a, const mr_v3 *b, double tolerance)
{
	double d = largest_distance(a, b, m->nv) / mr_mesh_diagonal(m);

	if (!(d <= tolerance))
		fail_msg("%g diagonals apart, more than %g", d, tolerance);
}

static mr_affine
screw(double turn, double dx, double scale)
{
	return (mr_affine){ { scale * cos(turn), -sin(turn), 0, dx, sin(turn), scale * cos(turn), 0, 0.3 * dx,
	    0, 0, 1, -dx } };
}

/* Of order k, with Voronoi areas, directly. */
static mr_deform *
of_order(const mr_mesh *m, const uint32_t *region, size_t k)
{
	return deform_of(m, region, opts_of(k, MR_AREAS_VORONOI, false));
}

static mr_v3 *
places(const mr_mesh *m)
{
	return MR_NEW(&ctx, m->nv, mr_v3);
}

static void
relax(mr_deform *d, const mr_v3 *p, mr_v3 *out)
{
	assert_int_equal(mr_deform_solve(&ctx, d, p, NULL, out), MR_OK);
}

static void
pose(mr_deform *d, const mr_v3 *p, const mr_affine *t, size_t handles, mr_v3 *out)
{
	mr_deform_maps maps = { t, NULL, handles };

	assert_int_equal(mr_deform_solve(&ctx, d, p, &maps, out), MR_OK);
}

/* The pose of all handles from what each of their maps does. */
static void
pose_by_basis(mr_deform *d, const mr_v3 *p, size_t n, const mr_affine *t, mr_v3 *out)
{
	size_t handles = mr_deform_handles(d);
	double *response = MR_NEW(&ctx, 4 * handles * n, double);

	assert_int_equal(mr_deform_basis(&ctx, d, p, response), MR_OK);
	mr_pose_by_response(&ctx, p, n, response, handles, t, out);
}

/* Tests */

typedef struct sample {
	mr_mesh m;
	uint32_t *region;
} sample;

static void
samples(sample out[4])
{
	out[0].m = torus(20, 10, 0);
	out[0].region = bands(&out[0].m, 1, 0.2, 0.8, FIXED);
	out[1].m = torus(22, 9, 0.35);
	out[1].region = bands(&out[1].m, 0, 0.15, 0.85, HANDLE + 1);
	out[2].m = grid(15, 0.5, wavy);
	out[2].region = framed(15, 2);
	out[3].m = grid(14, 0.6, wavy); /* free up to the mesh's own boundary */
	out[3].region = bands(&out[3].m, 1, 0.3, 0.75, FIXED);
}

static void
test_relax_is_the_dense_solution(void **state)
{
	sample s[4];

	(void)state;
	samples(s);
	for (int i = 0; i < 4; i++)
		for (size_t k = 1; k <= 3; k++)
			for (int areas = MR_AREAS_VORONOI; areas <= MR_AREAS_MEAN; areas++)
				for (int lu = 0; lu < 2; lu++) {
					mr_deform *d = deform_of(&s[i].m, s[i].region, opts_of(k, areas, lu));
					mr_v3 *p = places(&s[i].m);
					mr_v3 *q = places(&s[i].m);
					relax(d, s[i].m.p, p);
					dense_deform(
					    &s[i].m, s[i].region, k, areas == MR_AREAS_MEAN, s[i].m.p, q);
					assert_same(&s[i].m, p, q, 1e-9);
				}
}

/* p = T p0 + z is the paper's absolute solve where p0 is a solution itself. */
static void
test_pose_is_the_dense_solution(void **state)
{
	mr_affine t[2] = { screw(0.7, 0.5, 1.2), screw(-0.4, -0.3, 1) };
	sample s[4];

	(void)state;
	samples(s);
	for (int i = 0; i < 4; i++)
		for (size_t k = 1; k <= 3; k++) {
			size_t n = s[i].m.nv;
			mr_deform *d = of_order(&s[i].m, s[i].region, k);
			mr_v3 *p0 = MR_NEW(&ctx, n, mr_v3), *p = MR_NEW(&ctx, n, mr_v3);
			mr_v3 *q = MR_NEW(&ctx, n, mr_v3);
			relax(d, s[i].m.p, p0);
			for (size_t v = 0; v < n; v++)
				q[v] = s[i].region[v] >= HANDLE ? mr_apply(&t[s[i].region[v] - HANDLE], p0[v])
				                                : p0[v];
			dense_deform(&s[i].m, s[i].region, k, false, q, q);
			pose(d, p0, t, mr_deform_handles(d), p);
			assert_same(&s[i].m, p, q, 1e-9);
		}
}

/* A linear function is harmonic at every order, on any triangulation of the plane. */
static void
test_plane_is_reproduced(void **state)
{
	mr_mesh m = grid(21, 0.7, flat);
	mr_v3 *q = places(&m), *p = places(&m);

	(void)state;
	for (size_t k = 1; k <= 3; k++) {
		const uint32_t *region = framed(21, 3);
		mr_deform *d = of_order(&m, region, k);
		for (size_t v = 0; v < m.nv; v++) {
			mr_v3 x = m.p[v];
			p[v] = mr_vec(x.x, x.y, 0.5 * x.x - 2 * x.y + 3);
			q[v] = region[v] == FREE ? mr_vec(0.1, x.y * x.y, 7 * x.x) : p[v];
		}
		relax(d, q, q);
		assert_same(&m, p, q, 1e-10);
	}
}

static void
test_symmetric_is_unsymmetric(void **state)
{
	mr_mesh m = torus(120, 40, 0.4);
	uint32_t *region = bands(&m, 0, 0.2, 0.9, FIXED);
	mr_affine t = screw(1, 0.5, 1.1);

	(void)state;
	for (size_t k = 1; k <= 3; k++) {
		mr_v3 *p[2];
		for (int lu = 0; lu < 2; lu++) {
			mr_deform *d = deform_of(&m, region, opts_of(k, MR_AREAS_VORONOI, lu));
			p[lu] = places(&m);
			pose(d, m.p, &t, 1, p[lu]);
		}
		assert_same(&m, p[0], p[1], 1e-9);
	}
}

static void
test_identity_keeps_every_bit(void **state)
{
	mr_mesh m = torus(30, 12, 0.4);
	mr_affine t[2] = { mr_identity(), mr_identity() };
	mr_v3 *p0 = places(&m), *p = places(&m);

	(void)state;
	memcpy(p0, m.p, m.nv * sizeof *p0);
	p0[0].z = -0.0;
	m.p = p0;
	for (int handles_only = 0; handles_only < 2; handles_only++)
		for (size_t k = 1; k <= 3; k++) {
			uint32_t *region = bands(&m, 1, 0.2, 0.8, handles_only ? HANDLE + 1 : FIXED);
			mr_deform *d = of_order(&m, region, k);
			size_t h = mr_deform_handles(d);
			assert_int_equal(h, handles_only ? 2 : 1);
			pose(d, p0, t, h, p);
			assert_memory_equal(p, p0, m.nv * sizeof *p);
			pose(d, p0, t, 0, p);
			assert_memory_equal(p, p0, m.nv * sizeof *p);
			pose_by_basis(d, p0, m.nv, t, p);
			assert_memory_equal(p, p0, m.nv * sizeof *p);
		}
}

/* All constraints by one rigid motion: the surface follows, whether or not it is a solution. */
static void
test_rigid_motion_is_followed(void **state)
{
	mr_mesh m = torus(60, 25, 0.4);
	uint32_t *region = bands(&m, 1, 0.2, 0.8, HANDLE + 1);
	mr_affine t[2] = { screw(1.1, 2, 1), screw(1.1, 2, 1) };
	mr_v3 *p = places(&m), *q = places(&m);

	(void)state;
	for (size_t v = 0; v < m.nv; v++)
		q[v] = mr_apply(t, m.p[v]);
	for (size_t k = 1; k <= 3; k++) {
		mr_deform *d = of_order(&m, region, k);
		pose(d, m.p, t, 2, p);
		assert_same(&m, p, q, 1e-15);
		pose_by_basis(d, m.p, m.nv, t, p);
		assert_same(&m, p, q, 1e-13);
	}
}

static void
test_basis_is_the_pose(void **state)
{
	mr_mesh m = torus(60, 25, 0.4);
	mr_affine t[2] = { screw(0.5, 1, 1.3), screw(-0.8, 0.2, 0.9) };
	mr_v3 *p = places(&m), *q = places(&m);
	mr_v3 *p0 = places(&m);

	(void)state;
	for (int handles_only = 0; handles_only < 2; handles_only++)
		for (size_t k = 1; k <= 3; k++) {
			uint32_t *region = bands(&m, 1, 0.2, 0.8, handles_only ? HANDLE + 1 : FIXED);
			mr_deform *d = of_order(&m, region, k);
			size_t h = mr_deform_handles(d);
			relax(d, m.p, p0);
			pose(d, p0, t, h, p);
			pose_by_basis(d, p0, m.nv, t, q);
			assert_same(&m, p, q, 1e-9);
		}
}

/* Iterative solvers, over a hierarchy too, agree with the direct one. */
static void
test_iterative_is_direct(void **state)
{
	mr_mesh m = torus(120, 50, 0.4);
	uint32_t *region = bands(&m, 1, 0.2, 0.8, FIXED);
	mr_affine t = screw(0.5, 1, 1.3);
	mr_v3 *p = places(&m), *q = places(&m);

	(void)state;
	for (size_t k = 1; k <= 2; k++) {
		mr_deform_opts opts = opts_of(k, MR_AREAS_VORONOI, false);
		mr_deform *d = deform_of(&m, region, opts);
		pose(d, m.p, &t, 1, p);
		for (int kind = MR_CG; kind <= MR_VCYCLE; kind++) {
			opts.solver.kind = (mr_solver_kind)kind;
			d = deform_of(&m, region, opts);
			pose(d, m.p, &t, 1, q);
			assert_same(&m, p, q, 1e-6);
		}
	}
}

/* A second torus, free and without a constraint, and an isolated free vertex: both stay, at any pose. */
static void
test_loose_components_follow(void **state)
{
	mr_mesh one = torus(20, 10, 0.3);
	mr_v3 *p = MR_NEW(&ctx, 2 * one.nv + 1, mr_v3), *q = MR_NEW(&ctx, 2 * one.nv + 1, mr_v3);
	mr_tri *t = MR_NEW(&ctx, 2 * one.nf, mr_tri);
	mr_mesh two = { "base", p, t, 2 * one.nv + 1, 2 * one.nf };
	uint32_t *region = MR_NEW(&ctx, two.nv, uint32_t), *band = bands(&one, 0, 0.2, 0.8, HANDLE + 1);
	mr_affine maps[2] = { screw(1, 1, 1), screw(0.5, 1, 1) };
	mr_deform_opts opts = opts_of(2, MR_AREAS_VORONOI, false);
	mr_deform *d;

	(void)state;
	for (size_t v = 0; v < one.nv; v++) {
		p[v] = one.p[v];
		p[one.nv + v] = mr_add(one.p[v], mr_vec(0, 0, 5));
		region[v] = band[v];
		region[one.nv + v] = FREE;
	}
	p[2 * one.nv] = mr_vec(1, 2, 3);
	region[2 * one.nv] = FREE;
	for (size_t f = 0; f < one.nf; f++) {
		t[f] = one.t[f];
		for (int k = 0; k < 3; k++)
			t[one.nf + f].v[k] = one.t[f].v[k] + (uint32_t)one.nv;
	}
	d = deform_of(&two, region, opts_of(2, MR_AREAS_VORONOI, false));
	assert_int_equal(mr_deform_report(&ctx, d).isolated_components, 2);
	pose(d, p, maps, 2, q);
	assert_true(largest_distance(p, q, one.nv) > 0.1);
	for (size_t v = one.nv; v < two.nv; v++) /* as the surface near them, which moves by less than that */
		assert_true(mr_dist(p[v], q[v]) > 0.01);
	for (size_t f = one.nf; f < two.nf; f++) { /* all but rigidly */
		const uint32_t *c = t[f].v;
		assert_true(fabs(mr_dist(q[c[0]], q[c[1]]) / mr_dist(p[c[0]], p[c[1]]) - 1) < 0.005);
	}
	maps[0] = maps[1] = mr_identity();
	pose(d, p, maps, 2, q);
	assert_memory_equal(p, q, two.nv * sizeof *p);
	maps[0] = maps[1] = screw(1, 1, 1); /* one rigid motion of all that is constrained */
	pose(d, p, maps, 2, q);
	for (size_t v = 0; v < two.nv; v++)
		assert_true(mr_dist(q[v], mr_apply(&maps[0], p[v])) < 1e-10);
	opts.apart = true;
	d = deform_of(&two, region, opts);
	pose(d, p, maps, 2, q);
	assert_memory_equal(p + one.nv, q + one.nv, (one.nv + 1) * sizeof *p);
}

/* The largest distance of the vertices of the first half from those of the second. */
static double
widest_gap(const mr_mesh *two, const mr_v3 *p)
{
	return largest_distance(p, p + two->nv / 2, two->nv / 2);
}

/* Two sheets on each other, of which the lower is held at one side and the upper is moved at the other: they
 * stay on each other, unless they are told not to; rigid motions of both are exact. */
static void
test_parts_that_touch_stay_together(void **state)
{
	mr_mesh one = grid(40, 0.3, wavy), two = both(&one, &one, mr_vec(0, 0, 0.005));
	uint32_t *region = MR_NEW(&ctx, two.nv, uint32_t);
	mr_affine maps[2] = { screw(0.6, 0.2, 1), screw(0.6, 0.2, 1) };
	mr_deform_opts opts = opts_of(2, MR_AREAS_VORONOI, false);
	mr_v3 *p = places(&two), *q = places(&two);
	mr_deform *d;

	(void)state;
	for (size_t v = 0; v < one.nv; v++) {
		region[v] = one.p[v].x < 0.2 ? (uint32_t)FIXED : FREE;
		region[one.nv + v] = one.p[v].x > 0.8 ? HANDLE : FREE;
	}
	for (int turned = 0; turned < 2; turned++) {
		opts.rotations = turned ? MR_ROTATIONS_INTERPOLATED : MR_ROTATIONS_LINEAR;
		opts.apart = false;
		d = deform_of(&two, region, opts);
		pose(d, two.p, maps, 1, p);
		assert_true(largest_distance(p, two.p, one.nv) > 0.3);
		assert_true(widest_gap(&two, p) < 0.05);
		opts.apart = true;
		d = deform_of(&two, region, opts);
		pose(d, two.p, maps, 1, p);
		assert_memory_equal(p, two.p, one.nv * sizeof *p);
		assert_true(widest_gap(&two, p) > 0.7);
	}
	for (size_t v = 0; v < one.nv; v++)
		region[v] = region[v] == FIXED ? HANDLE + 1 : FREE;
	opts.apart = false;
	d = deform_of(&two, region, opts);
	pose(d, two.p, maps, 2, p);
	for (size_t v = 0; v < two.nv; v++)
		q[v] = mr_apply(&maps[0], two.p[v]);
	assert_same(&two, p, q, 1e-12);
}

/* Folded, needle, zero-area and repeated faces: finite results, or a sentence. */
static void
test_degenerate_faces_give_no_nan(void **state)
{
	mr_mesh m = grid(16, 0.4, wavy);
	mr_tri *t = MR_NEW(&ctx, m.nf + 3, mr_tri);
	mr_v3 *p = places(&m), *q = places(&m);
	uint32_t *region = framed(16, 3);

	(void)state;
	memcpy(t, m.t, m.nf * sizeof *t);
	memcpy(p, m.p, m.nv * sizeof *p);
	p[16 * 8 + 8] = p[16 * 8 + 9];                              /* a zero edge */
	p[16 * 5 + 5] = mr_lerp(0.5, p[16 * 5 + 4], p[16 * 5 + 6]); /* a straight angle */
	t[m.nf++] = (mr_tri){ { 100, 100, 101 } };
	t[m.nf++] = (mr_tri){ { 100, 100, 100 } };
	t[m.nf++] = t[3];
	m.t = t;
	m.p = p;
	for (size_t k = 1; k <= 3; k++) {
		mr_deform_opts opts = opts_of(k, MR_AREAS_VORONOI, false);
		mr_deform *d = NULL;
		mr_status status = mr_deform_new(&ctx, &m, NULL, region, &opts, &d);
		if (status == MR_ENUMERIC && k > 1)
			continue;
		assert_int_equal(status, MR_OK);
		relax(d, p, q);
		for (size_t v = 0; v < m.nv; v++)
			assert_true(mr_finite(q[v]));
	}
}

static void
test_refusals(void **state)
{
	mr_mesh m = torus(12, 8, 0);
	uint32_t *region = MR_NEW_ZERO(&ctx, m.nv, uint32_t);
	mr_deform_opts opts = MR_DEFORM_DEFAULTS;
	mr_affine t[3] = { mr_identity(), mr_identity(), screw(1, 1, 1) };
	mr_deform_maps three = { t, NULL, 3 };
	mr_v3 *p = places(&m);
	mr_deform *d = NULL;

	(void)state;
	opts.unsymmetric = true;
	assert_int_equal(mr_deform_new(&ctx, &m, NULL, region, &opts, &d), MR_EUSAGE);
	opts.unsymmetric = false;
	assert_int_equal(mr_deform_new(&ctx, &m, NULL, region, &opts, &d), MR_EMESH);
	assert_non_null(strstr(ctx.error, "no free vertex"));
	for (size_t v = 0; v < m.nv; v++)
		region[v] = FREE;
	assert_int_equal(mr_deform_new(&ctx, &m, NULL, region, &opts, &d), MR_EMESH);
	assert_non_null(strstr(ctx.error, "nothing holds"));
	region[5] = HANDLE;
	region[6] = HANDLE + 4;
	d = deform_of(&m, region, opts);
	assert_int_equal(mr_deform_handles(d), 5);
	assert_int_equal(mr_deform_solve(&ctx, d, m.p, &three, p), MR_ERANGE);
	assert_non_null(strstr(ctx.error, "handle 2 has no vertex"));
	pose(d, m.p, t, 2, p);
}

static void
test_threads_and_runs_change_nothing(void **state)
{
	mr_mesh m = torus(150, 60, 0.4);
	uint32_t *region = bands(&m, 1, 0.2, 0.8, FIXED);
	mr_affine t = screw(0.7, 1, 1);
	mr_v3 *first = places(&m), *p = places(&m);

	(void)state;
	for (unsigned run = 0; run < 4; run++) {
		mr_deform *d;
		ctx.threads = run % 2 ? 3 : 1;
		d = deform_of(&m, region, (mr_deform_opts)MR_DEFORM_DEFAULTS);
		relax(d, m.p, p);
		pose(d, p, &t, 1, p);
		if (run == 0)
			memcpy(first, p, m.nv * sizeof *p);
		assert_memory_equal(p, first, m.nv * sizeof *p);
	}
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_relax_is_the_dense_solution, setup, teardown),
		cmocka_unit_test_setup_teardown(test_pose_is_the_dense_solution, setup, teardown),
		cmocka_unit_test_setup_teardown(test_plane_is_reproduced, setup, teardown),
		cmocka_unit_test_setup_teardown(test_symmetric_is_unsymmetric, setup, teardown),
		cmocka_unit_test_setup_teardown(test_identity_keeps_every_bit, setup, teardown),
		cmocka_unit_test_setup_teardown(test_rigid_motion_is_followed, setup, teardown),
		cmocka_unit_test_setup_teardown(test_basis_is_the_pose, setup, teardown),
		cmocka_unit_test_setup_teardown(test_iterative_is_direct, setup, teardown),
		cmocka_unit_test_setup_teardown(test_loose_components_follow, setup, teardown),
		cmocka_unit_test_setup_teardown(test_parts_that_touch_stay_together, setup, teardown),
		cmocka_unit_test_setup_teardown(test_degenerate_faces_give_no_nan, setup, teardown),
		cmocka_unit_test_setup_teardown(test_refusals, setup, teardown),
		cmocka_unit_test_setup_teardown(test_threads_and_runs_change_nothing, setup, teardown),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
