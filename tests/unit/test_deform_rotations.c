/* Posing by rotations against closed forms: twists, tapers, bends; against a dense solve; and its invariants.
 */
#include "base/random.h"
#include "base/rotation.h"
#include "edit/deform.h"
#include "mesh/layers.h"
#include "op/laplace.h"
#include "op/voronoi_area.h"
#include "shapes.h"

enum { FREE = MR_REGION_FREE, FIXED = MR_REGION_FIXED, HANDLE = MR_REGION_HANDLE };
enum { AROUND = 24 };
static const double LENGTH = 8;

/* A tube of radius 1 along x from 0 to LENGTH, its vertices moved by up to `noise` edges. */
static mr_mesh
tube(uint32_t rings, double noise)
{
	size_t n = (size_t)rings * AROUND, f = 0;
	mr_v3 *p = MR_NEW(&ctx, n, mr_v3);
	mr_tri *t = MR_NEW(&ctx, 2 * n, mr_tri);
	mr_random r = { 13 };

	for (uint32_t i = 0; i < rings; i++)
		for (uint32_t j = 0; j < AROUND; j++) {
			double x = LENGTH * (i + noise * (mr_random_real(&r) - 0.5)) / (rings - 1);
			double a = 2 * MR_PI * (j + 0.5 * (i % 2) + noise * (mr_random_real(&r) - 0.5)) /
			           AROUND;
			p[i * AROUND + j] = mr_vec(x, cos(a), sin(a));
		}
	for (uint32_t i = 0; i + 1 < rings; i++)
		for (uint32_t j = 0; j < AROUND; j++) {
			uint32_t a = i * AROUND + j, b = i * AROUND + (j + 1) % AROUND;
			uint32_t c = a + AROUND, d = b + AROUND;
			bool odd = i % 2;
			t[f++] = odd ? (mr_tri){ { a, d, c } } : (mr_tri){ { a, b, c } };
			t[f++] = odd ? (mr_tri){ { a, b, d } } : (mr_tri){ { b, d, c } };
		}
	return (mr_mesh){ "base", p, t, n, f };
}

/* `below` up to a quarter of the tube, handle 0 from three quarters. */
static uint32_t *
ends(const mr_mesh *m, uint32_t below)
{
	uint32_t *region = MR_NEW(&ctx, m->nv, uint32_t);

	for (size_t v = 0; v < m->nv; v++)
		region[v] = m->p[v].x < LENGTH / 4 ? below : m->p[v].x > 3 * LENGTH / 4 ? HANDLE : FREE;
	return region;
}

static mr_deform *
deform_of(const mr_mesh *m, const uint32_t *region, size_t order, size_t rounds)
{
	mr_deform_opts opts = MR_DEFORM_DEFAULTS;
	mr_deform *d = NULL;

	opts.order = order;
	opts.rotations = MR_ROTATIONS_INTERPOLATED;
	opts.rounds = rounds;
	if (mr_deform_new(&ctx, m, NULL, region, &opts, &d) != MR_OK)
		fail_msg("%s", ctx.error);
	return d;
}

static mr_v3 *
places(const mr_mesh *m)
{
	return MR_NEW(&ctx, m->nv, mr_v3);
}

static void
pose(mr_deform *d, const mr_v3 *p, const mr_affine *t, const mr_v3 *turn, size_t handles, mr_v3 *out)
{
	mr_deform_maps maps = { t, turn, handles };

	if (mr_deform_solve(&ctx, d, p, &maps, out) != MR_OK)
		fail_msg("%s", ctx.error);
}

/* About an axis through a point, by |w| radians, then moved. */
static mr_affine
turning(mr_v3 w, mr_v3 center, mr_v3 by)
{
	mr_mat3 r = mr_rotation_exp(w);
	mr_v3 at = mr_add(mr_sub(center, mr_mat3_apply(&r, center)), by);

	return (mr_affine){ { r.m[0], r.m[1], r.m[2], at.x, r.m[3], r.m[4], r.m[5], at.y, r.m[6], r.m[7],
	    r.m[8], at.z } };
}

static void
assert_near(const mr_mesh *m, const mr_v3 *a, const mr_v3 *b, double tolerance)
{
	double most = 0;

	for (size_t v = 0; v < m->nv; v++)
		most = fmax(most, mr_dist(a[v], b[v]));
	most /= mr_mesh_diagonal(m);
	if (!(most <= tolerance))
		fail_msg("%g diagonals apart, more than %g", most, tolerance);
}

/* The weight of handle 0 at each vertex, as the system of order k has it: its response to 1. */
static double *
weights(const mr_mesh *m, const uint32_t *region, size_t k)
{
	mr_deform_opts opts = MR_DEFORM_DEFAULTS;
	double *w = MR_NEW(&ctx, m->nv, double), *response;
	mr_deform *d = NULL;
	size_t handles;

	opts.order = k;
	assert_int_equal(mr_deform_new(&ctx, m, NULL, region, &opts, &d), MR_OK);
	handles = mr_deform_handles(d);
	response = MR_NEW(&ctx, 4 * handles * m->nv, double);
	assert_int_equal(mr_deform_basis(&ctx, d, m->p, response), MR_OK);
	for (size_t v = 0; v < m->nv; v++)
		w[v] = fmin(fmax(response[4 * handles * v + 3], 0), 1);
	return w;
}

/* However many turns: all of them lie along the tube, and it keeps its radius. */
static void
test_twists_are_exact(void **state)
{
	static const double degrees[] = { 10, 90, 179, 180, 270, 360, -360, 450, 720 };
	mr_mesh m = tube(41, 0);
	uint32_t *region = ends(&m, FIXED);
	mr_v3 *p = places(&m), *q = places(&m);

	(void)state;
	for (size_t k = 1; k <= 3; k++) {
		mr_deform *d = deform_of(&m, region, k, 0);
		double *weight = weights(&m, region, k);
		for (size_t i = 0; i < sizeof degrees / sizeof *degrees; i++) {
			mr_v3 w = mr_vec(degrees[i] * MR_PI / 180, 0, 0);
			mr_affine t = turning(w, mr_vec(0, 0, 0), mr_vec(0, 0, 0));
			for (size_t v = 0; v < m.nv; v++) {
				mr_mat3 r = mr_rotation_exp(mr_mul(weight[v], w));
				q[v] = mr_mat3_apply(&r, m.p[v]);
			}
			pose(d, m.p, &t, &w, 1, p);
			assert_near(&m, p, q, 1e-11);
		}
	}
}

/* Without a column of turns the map's own is taken, at most half of one. */
static void
test_a_map_alone_turns_the_short_way(void **state)
{
	mr_mesh m = tube(41, 0);
	uint32_t *region = ends(&m, FIXED);
	mr_v3 w = mr_vec(MR_PI * 4 / 3, 0, 0), back = mr_vec(-MR_PI * 2 / 3, 0, 0), zero = { 0, 0, 0 };
	mr_affine t = turning(w, zero, zero);
	mr_v3 *p = places(&m), *q = places(&m);
	mr_deform *d = deform_of(&m, region, 2, 0);

	(void)state;
	pose(d, m.p, &t, NULL, 1, p);
	pose(d, m.p, &t, &back, 1, q);
	assert_near(&m, p, q, 0);
	pose(d, m.p, &t, &w, 1, q);
	assert_true(mr_dist(p[20 * AROUND], q[20 * AROUND]) > 1.9);
}

/* Nothing fixed, both ends turned against each other: what is between shares the difference. */
static void
test_two_handles_share_a_twist(void **state)
{
	mr_mesh m = tube(41, 0);
	uint32_t *region = ends(&m, HANDLE + 1);
	mr_v3 w[2] = { mr_vec(3.5, 0, 0), mr_vec(-2.9, 0, 0) }, by = { 0.3, -2, 1 }, zero = { 0, 0, 0 };
	mr_affine t[2] = { turning(w[0], zero, by), turning(w[1], zero, by) };
	mr_v3 *p = places(&m), *q = places(&m);

	(void)state;
	for (size_t k = 1; k <= 3; k++) {
		mr_deform *d = deform_of(&m, region, k, 0);
		double *weight = weights(&m, region, k);
		for (size_t v = 0; v < m.nv; v++) {
			mr_mat3 r = mr_rotation_exp(mr_lerp(weight[v], w[1], w[0]));
			q[v] = mr_add(mr_mat3_apply(&r, m.p[v]), by);
		}
		pose(d, m.p, t, w, 2, p);
		assert_near(&m, p, q, 1e-11);
	}
}

/* Thickened on the way to the handle, and turned too. */
static void
test_tapers_are_exact(void **state)
{
	mr_mesh m = tube(41, 0);
	uint32_t *region = ends(&m, FIXED);
	mr_v3 *p = places(&m), *q = places(&m);
	double *weight = weights(&m, region, 2);

	(void)state;
	for (int turned = 0; turned < 2; turned++) {
		mr_v3 w = mr_vec(turned ? 4 : 0, 0, 0);
		mr_affine t = turning(w, mr_vec(0, 0, 0), mr_vec(0, 0, 0));
		mr_deform *d = deform_of(&m, region, 2, 0);
		for (int i = 0; i < 12; i++)
			t.m[i] *= i % 4 == 1 || i % 4 == 2 ? 3 : 1;
		for (size_t v = 0; v < m.nv; v++) {
			double s = weight[v];
			mr_mat3 r = mr_rotation_exp(mr_mul(s, w));
			q[v] = mr_vec(m.p[v].x, (1 + 2 * s) * m.p[v].y, (1 + 2 * s) * m.p[v].z);
			q[v] = mr_mat3_apply(&r, q[v]);
		}
		pose(d, m.p, &t, &w, 1, p);
		assert_near(&m, p, q, 1e-11);
	}
}

/* Where the axis is at x when each place of it turns by its share of an angle, about z. */
static mr_v3
axis_at(const double *weight, uint32_t rings, double x, double angle)
{
	enum { STEPS = 4000 };
	mr_v3 at = { 0, 0, 0 };

	for (int i = 0; i < STEPS; i++) {
		double ring = x / LENGTH * (rings - 1) * (i + 0.5) / STEPS, low = floor(ring);
		const double *w = weight + (size_t)low * AROUND;
		double a = angle * (w[0] + (ring - low) * (w[AROUND] - w[0]));
		at = mr_axpy(x / STEPS, mr_vec(cos(a), sin(a), 0), at);
	}
	return at;
}

/* A bar that ends where its axis leads, bent by up to a turn and a half: sections stay plane and as they are.
 */
static void
test_bends_are_a_beams(void **state)
{
	mr_mesh m = tube(81, 0);
	uint32_t *region = ends(&m, FIXED);
	mr_v3 *p = places(&m), *q = places(&m);
	double *weight = weights(&m, region, 2);
	mr_deform *d = deform_of(&m, region, 2, 0);

	(void)state;
	for (int degrees = 60; degrees <= 540; degrees += 120) {
		mr_v3 w = mr_vec(0, 0, degrees * MR_PI / 180), end = mr_vec(3 * LENGTH / 4, 0, 0),
		      at = { 0, 0, 0 };
		mr_affine t = turning(w, end, mr_sub(axis_at(weight, 81, end.x, w.z), end));
		pose(d, m.p, &t, &w, 1, p);
		for (size_t v = 0; v < m.nv; v++) {
			mr_mat3 r = mr_rotation_exp(mr_mul(weight[v], w));
			if (v % AROUND == 0)
				at = axis_at(weight, 81, m.p[v].x, w.z);
			q[v] = mr_add(at, mr_mat3_apply(&r, mr_vec(0, m.p[v].y, m.p[v].z)));
		}
		assert_near(&m, p, q, 2.5e-5 * degrees);
	}
}

/* A motion of all constraints is the whole's, whatever it is; without any, no bit changes. */
static void
test_rigid_motions_are_exact(void **state)
{
	mr_mesh m = tube(31, 0.5);
	uint32_t *region = ends(&m, HANDLE + 1);
	mr_v3 w[2] = { mr_vec(3, 1, -2), mr_vec(3, 1, -2) }, *p = places(&m), *q = places(&m),
	      zero = { 0, 0, 0 };
	mr_affine t[2], rest[2] = { mr_identity(), mr_identity() };

	(void)state;
	t[0] = t[1] = turning(w[0], mr_vec(1, 2, 3), mr_vec(0.5, 4, -1));
	for (size_t k = 1; k <= 3; k++)
		for (size_t rounds = 0; rounds <= 3; rounds++) {
			mr_deform *d = deform_of(&m, region, k, rounds);
			for (size_t v = 0; v < m.nv; v++)
				q[v] = mr_apply(&t[0], m.p[v]);
			pose(d, m.p, t, w, 2, p);
			assert_near(&m, p, q, 1e-12);
			pose(d, m.p, rest, NULL, 2, p);
			assert_memory_equal(p, m.p, m.nv * sizeof *p);
			t[1] = turning(zero, zero, mr_vec(1, 2, 3)); /* a move, and a turn of the whole */
			t[1] = t[0];
		}
}

/* What does not turn is posed linearly, to the bit. */
static void
test_moves_are_linear(void **state)
{
	mr_mesh m = tube(31, 0.5);
	uint32_t *region = ends(&m, FIXED);
	mr_affine t = turning(mr_vec(0, 0, 0), mr_vec(0, 0, 0), mr_vec(1, 2, -1));
	mr_v3 *p = places(&m), *q = places(&m);
	mr_deform_opts opts = MR_DEFORM_DEFAULTS;
	mr_deform *linear = NULL, *d = deform_of(&m, region, 2, 0);

	(void)state;
	assert_int_equal(mr_deform_new(&ctx, &m, NULL, region, &opts, &linear), MR_OK);
	pose(d, m.p, &t, NULL, 1, p);
	pose(linear, m.p, &t, NULL, 1, q);
	assert_memory_equal(p, q, m.nv * sizeof *p);
}

/* Dense, of the whole mesh */

/* D = M^-1 (-L), row-major. */
static double *
dense_operator(const mr_mesh *m)
{
	size_t n = m->nv;
	double *d = MR_NEW_ZERO(&ctx, n * n, double), *area = MR_NEW(&ctx, n, double);

	mr_voronoi_areas(&ctx, m, area);
	for (size_t f = 0; f < m->nf; f++)
		for (int k = 0; k < 3; k++) {
			size_t i = m->t[f].v[k], j = m->t[f].v[(k + 1) % 3];
			double cot[3];
			mr_cotangents(m->p[m->t[f].v[0]], m->p[m->t[f].v[1]], m->p[m->t[f].v[2]], cot);
			d[i * n + j] += cot[(k + 2) % 3] / 2;
			d[j * n + i] += cot[(k + 2) % 3] / 2;
			d[i * n + i] -= cot[(k + 2) % 3] / 2;
			d[j * n + j] -= cot[(k + 2) % 3] / 2;
		}
	for (size_t i = 0; i < n * n; i++)
		d[i] /= area[i / n];
	return d;
}

/* y = D x, vectors. */
static void
apply(const double *d, size_t n, const mr_v3 *x, mr_v3 *y)
{
	for (size_t i = 0; i < n; i++) {
		y[i] = mr_vec(0, 0, 0);
		for (size_t j = 0; j < n; j++)
			y[i] = mr_axpy(d[i * n + j], x[j], y[i]);
	}
}

/* The rotation of each vertex from rest to p: faces around it, their edges with cotangents. */
static void
local_rotations(const mr_mesh *m, const mr_v3 *p, mr_mat3 *r)
{
	mr_mat3 *sum = MR_NEW_ZERO(&ctx, m->nv, mr_mat3);

	for (size_t f = 0; f < m->nf; f++) {
		const uint32_t *v = m->t[f].v;
		double cot[3];
		mr_cotangents(m->p[v[0]], m->p[v[1]], m->p[v[2]], cot);
		for (int k = 0; k < 3; k++) {
			mr_v3 x = mr_sub(m->p[v[(k + 1) % 3]], m->p[v[(k + 2) % 3]]);
			mr_v3 y = mr_sub(p[v[(k + 1) % 3]], p[v[(k + 2) % 3]]);
			for (int corner = 0; corner < 3; corner++)
				for (int i = 0; i < 9; i++)
					sum[v[corner]].m[i] += cot[k] * mr_coordinate(y, i / 3) *
					                       mr_coordinate(x, i % 3);
		}
	}
	for (size_t i = 0; i < m->nv; i++)
		r[i] = mr_rotation_nearest(&sum[i]);
}

/* M^-1 times minus the divergence of the rest's gradients, turned by the mean of each face's corners. */
static void
turned_differentials(const mr_mesh *m, const mr_mat3 *r, mr_v3 *b)
{
	double *area = MR_NEW(&ctx, m->nv, double);

	memset(b, 0, m->nv * sizeof *b);
	mr_voronoi_areas(&ctx, m, area);
	for (size_t f = 0; f < m->nf; f++) {
		const uint32_t *v = m->t[f].v;
		mr_mat3 mean = { { 0 } };
		double cot[3];
		mr_cotangents(m->p[v[0]], m->p[v[1]], m->p[v[2]], cot);
		for (int k = 0; k < 3; k++)
			mean = mr_mat3_axpy(1.0 / 3, &r[v[k]], &mean);
		for (int k = 0; k < 3; k++) {
			uint32_t i = v[(k + 1) % 3], j = v[(k + 2) % 3];
			mr_v3 e = mr_mat3_apply(&mean, mr_sub(m->p[j], m->p[i]));
			b[i] = mr_axpy(cot[k] / 2 / area[i], e, b[i]);
			b[j] = mr_axpy(-cot[k] / 2 / area[j], e, b[j]);
		}
	}
}

/* A round asks for D^k p = D^(k-1) of the differentials turned by the rotations that fit the pose before it.
 */
static void
test_a_round_is_its_equation(void **state)
{
	mr_mesh m = tube(21, 0.5);
	uint32_t *region = ends(&m, FIXED);
	mr_v3 w = mr_vec(0.3, -0.5, 0.7), *before = places(&m), *after = places(&m), *x = places(&m),
	      *y = places(&m);
	mr_mat3 *r = MR_NEW(&ctx, m.nv, mr_mat3);
	mr_affine t = turning(w, mr_vec(LENGTH / 2, 0.2, 0.1), mr_vec(0.2, 0, 0.1));
	double *dense = dense_operator(&m);

	(void)state;
	for (size_t k = 1; k <= 3; k++) {
		mr_deform *d = deform_of(&m, region, k, 0), *one = deform_of(&m, region, k, 1);
		double residual = 0, scale = 0;
		pose(d, m.p, &t, &w, 1, before);
		pose(one, m.p, &t, &w, 1, after);
		local_rotations(&m, before, r);
		for (size_t v = 0; v < m.nv; v++)
			if (region[v] != FREE)
				r[v] = region[v] == HANDLE ? mr_rotation_exp(w) : mr_mat3_identity();
		turned_differentials(&m, r, y);
		apply(dense, m.nv, after, x);
		for (size_t v = 0; v < m.nv; v++)
			x[v] = mr_sub(x[v], y[v]);
		for (size_t step = 1; step < k; step++) {
			apply(dense, m.nv, x, y);
			memcpy(x, y, m.nv * sizeof *x);
			apply(dense, m.nv, after, y);
		}
		for (size_t v = 0; v < m.nv; v++) {
			residual = fmax(residual, region[v] == FREE ? mr_norm(x[v]) : 0);
			scale = fmax(scale, mr_norm(x[v]));
		}
		assert_true(scale > 1e-3); /* on the constraints it is none */
		if (!(residual < 1e-9 * scale))
			fail_msg("order %zu: %g of %g", k, residual, scale);
	}
}

/* The energy of as-rigid-as-possible deformation, which rounds of order 1 shall lower. */
static double
energy(const mr_mesh *m, const mr_v3 *p)
{
	mr_mat3 *r = MR_NEW(&ctx, m->nv, mr_mat3);
	double sum = 0;

	local_rotations(m, p, r);
	for (size_t f = 0; f < m->nf; f++) {
		const uint32_t *v = m->t[f].v;
		double cot[3];
		mr_cotangents(m->p[v[0]], m->p[v[1]], m->p[v[2]], cot);
		for (int k = 0; k < 3; k++)
			for (int corner = 0; corner < 3; corner++) {
				mr_v3 x = mr_sub(m->p[v[(k + 1) % 3]], m->p[v[(k + 2) % 3]]);
				mr_v3 y = mr_sub(p[v[(k + 1) % 3]], p[v[(k + 2) % 3]]);
				sum += cot[k] * mr_norm2(mr_sub(y, mr_mat3_apply(&r[v[corner]], x)));
			}
	}
	return sum;
}

static void
test_rounds_make_it_more_rigid(void **state)
{
	mr_mesh m = tube(61, 0.3);
	uint32_t *region = ends(&m, FIXED);
	mr_v3 w = mr_vec(0, 0, 2), *p = places(&m);
	mr_affine t = turning(w, mr_vec(LENGTH / 2, 0, 0), mr_vec(0, 0, 0));
	double last = INFINITY;

	(void)state;
	for (size_t rounds = 0; rounds <= 6; rounds++) {
		mr_deform *d = deform_of(&m, region, 1, rounds);
		double e;
		pose(d, m.p, &t, &w, 1, p);
		e = energy(&m, p);
		assert_true(e < last);
		last = e;
	}
}

/* A handle of another size stays as large, and what is between has the sizes between. */
static void
test_rounds_keep_stretches(void **state)
{
	mr_mesh m = tube(41, 0);
	uint32_t *region = ends(&m, FIXED);
	mr_affine t = mr_identity();
	mr_v3 *p = places(&m);
	double *weight = weights(&m, region, 2);
	mr_deform *d = deform_of(&m, region, 2, 4);

	(void)state;
	t.m[5] = t.m[10] = 2;
	pose(d, m.p, &t, NULL, 1, p);
	for (size_t v = 0; v < m.nv; v++) {
		double s = weight[v], radius = hypot(p[v].y, p[v].z);
		assert_true(fabs(radius - (1 + s)) < 0.06);
	}
}

/* The volume of a tube with flat ends. */
static double
volume_of(const mr_mesh *m, const mr_v3 *p)
{
	double sum = 0;

	for (size_t f = 0; f < m->nf; f++)
		sum += mr_dot(p[m->t[f].v[0]], mr_cross(p[m->t[f].v[1]], p[m->t[f].v[2]])) / 6;
	for (size_t end = 0; end < 2; end++) {
		size_t at = end ? m->nv - AROUND : 0;
		for (size_t j = 1; j + 1 < AROUND; j++) {
			double cone = mr_dot(p[at], mr_cross(p[at + j], p[at + j + 1])) / 6;
			sum += end ? cone : -cone;
		}
	}
	return sum;
}

/* The same from inside. */
static mr_mesh
inside_out(const mr_mesh *m)
{
	mr_tri *t = MR_NEW(&ctx, m->nf, mr_tri);

	for (size_t f = 0; f < m->nf; f++)
		t[f] = (mr_tri){ { m->t[f].v[1], m->t[f].v[0], m->t[f].v[2] } };
	return (mr_mesh){ m->name, m->p, t, m->nv, m->nf };
}

/* Without a face in the middle. */
static mr_mesh
torn(const mr_mesh *m)
{
	mr_tri *t = MR_NEW(&ctx, m->nf, mr_tri);

	memcpy(t, m->t, m->nf * sizeof *t);
	t[m->nf / 2] = t[m->nf - 1];
	return (mr_mesh){ m->name, m->p, t, m->nv, m->nf - 1 };
}

/* Half a turn pinches a tube; what it encloses keeps nine tenths, whichever way it faces, but with a hole it
 * encloses nothing. */
static void
test_rounds_keep_volume(void **state)
{
	mr_mesh m = tube(41, 0), kind[3] = { m, inside_out(&m), torn(&m) };
	uint32_t *region = ends(&m, FIXED);
	mr_v3 w = mr_vec(MR_PI, 0, 0), zero = { 0, 0, 0 }, *p[3];
	mr_affine t = turning(w, zero, zero);
	double whole = volume_of(&m, m.p), least = 1 - 0.1 * (LENGTH / 2 + 1.5) / LENGTH;

	(void)state;
	for (size_t k = 1; k <= 2; k++) {
		for (int i = 0; i < 3; i++) {
			mr_deform *d = deform_of(&kind[i], region, k, 6);
			p[i] = places(&m);
			pose(d, m.p, &t, &w, 1, p[i]);
		}
		assert_true(volume_of(&m, p[0]) > least * whole);
		assert_true(volume_of(&m, p[0]) < 0.98 * whole);
		assert_near(&m, p[0], p[1], 1e-7);
		assert_true(volume_of(&m, p[2]) < 0.85 * whole);
	}
}

/* Two tubes side by side, which touch: the triangles between them are no hole. */
static void
test_parts_that_touch_keep_volume(void **state)
{
	mr_mesh one = tube(41, 0), m = both(&one, &one, mr_vec(0, 2.02, 0));
	uint32_t *region = ends(&m, FIXED);
	mr_v3 *q = places(&m), w = mr_vec(MR_PI, 0, 0), zero = { 0, 0, 0 };
	mr_affine map = turning(w, zero, zero);
	mr_deform *d = deform_of(&m, region, 2, 6);

	(void)state;
	pose(d, m.p, &map, &w, 1, q);
	assert_true(volume_of(&one, q) + volume_of(&one, q + one.nv) > 1.8 * volume_of(&one, one.p));
}

/* A domed sheet that is pushed through by what holds its middle encloses nothing to keep: it is where it
 * would be without rounds, to a part of the way. */
static void
test_dents_are_not_blown_up(void **state)
{
	enum { N = 25 };
	mr_mesh m = { "base", NULL, NULL, N * N, 2 * (N - 1) * (N - 1) };
	mr_v3 *p = places(&m), *plain = places(&m), *q = places(&m), w = mr_vec(0.3, 0, 0);
	mr_tri *t = MR_NEW(&ctx, m.nf, mr_tri);
	uint32_t *region = MR_NEW(&ctx, m.nv, uint32_t);
	mr_affine map = turning(w, mr_vec(0, 0, 0), mr_vec(0, 0, -0.4));
	mr_deform *none, *d;

	(void)state;
	for (uint32_t i = 0; i < N * N; i++) {
		double x = 2.0 * (i % N) / (N - 1) - 1, y = 2.0 * (i / N) / (N - 1) - 1,
		       far = fmax(fabs(x), fabs(y));
		p[i] = mr_vec(x, y, 0.2 * (1 - x * x) * (1 - y * y));
		region[i] = far > 0.85 ? FIXED : far < 0.25 ? HANDLE : FREE;
	}
	for (uint32_t f = 0; f < m.nf; f++) {
		uint32_t a = f / 2 / (N - 1) * N + f / 2 % (N - 1);
		t[f] = f % 2 ? (mr_tri){ { a, a + N + 1, a + N } } : (mr_tri){ { a, a + 1, a + N + 1 } };
	}
	m.p = p;
	m.t = t;
	none = deform_of(&m, region, 2, 0);
	d = deform_of(&m, region, 2, 4);
	pose(none, m.p, &map, &w, 1, plain);
	pose(d, m.p, &map, &w, 1, q);
	for (size_t v = 0; v < m.nv; v++)
		assert_true(mr_dist(plain[v], q[v]) < 0.15);
}

static void
test_iterative_is_direct(void **state)
{
	static const mr_solver_kind kind[] = { MR_LU, MR_CG, MR_MULTIGRID };
	mr_mesh m = tube(61, 0.3);
	uint32_t *region = ends(&m, FIXED);
	mr_v3 w = mr_vec(1, 0.5, 3), *p = places(&m), *q = places(&m);
	mr_affine t = turning(w, mr_vec(LENGTH / 2, 0, 0), mr_vec(0.1, 0, 0));
	mr_deform *direct = deform_of(&m, region, 2, 2);

	(void)state;
	pose(direct, m.p, &t, &w, 1, q);
	for (int i = 0; i < 3; i++) {
		mr_deform_opts opts = MR_DEFORM_DEFAULTS;
		mr_deform *d = NULL;
		opts.rotations = MR_ROTATIONS_INTERPOLATED;
		opts.rounds = 2;
		opts.solver.kind = kind[i];
		opts.solver.tol = 1e-12;
		assert_int_equal(mr_deform_new(&ctx, &m, NULL, region, &opts, &d), MR_OK);
		pose(d, m.p, &t, &w, 1, p);
		assert_near(&m, p, q, 1e-7);
	}
}

static void
test_threads_and_order_of_poses_change_nothing(void **state)
{
	mr_mesh m = tube(401, 0.3);
	uint32_t *region = ends(&m, FIXED);
	mr_v3 w = mr_vec(7, 0.5, 3), zero = { 0, 0, 0 }, *first = places(&m), *p = places(&m);
	mr_affine t = turning(w, mr_vec(LENGTH / 2, 0, 0), mr_vec(0.1, 0, 0)), other = turning(zero, zero, w);

	(void)state;
	for (unsigned run = 0; run < 4; run++) {
		mr_deform *d;
		ctx.threads = run % 2 ? 3 : 1;
		d = deform_of(&m, region, 2, 2);
		if (run > 1)
			pose(d, m.p, &other, NULL, 1, p);
		pose(d, m.p, &t, &w, 1, p);
		if (run == 0)
			memcpy(first, p, m.nv * sizeof *p);
		assert_memory_equal(p, first, m.nv * sizeof *p);
	}
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_twists_are_exact, setup, teardown),
		cmocka_unit_test_setup_teardown(test_a_map_alone_turns_the_short_way, setup, teardown),
		cmocka_unit_test_setup_teardown(test_two_handles_share_a_twist, setup, teardown),
		cmocka_unit_test_setup_teardown(test_tapers_are_exact, setup, teardown),
		cmocka_unit_test_setup_teardown(test_bends_are_a_beams, setup, teardown),
		cmocka_unit_test_setup_teardown(test_rigid_motions_are_exact, setup, teardown),
		cmocka_unit_test_setup_teardown(test_moves_are_linear, setup, teardown),
		cmocka_unit_test_setup_teardown(test_a_round_is_its_equation, setup, teardown),
		cmocka_unit_test_setup_teardown(test_rounds_make_it_more_rigid, setup, teardown),
		cmocka_unit_test_setup_teardown(test_rounds_keep_stretches, setup, teardown),
		cmocka_unit_test_setup_teardown(test_rounds_keep_volume, setup, teardown),
		cmocka_unit_test_setup_teardown(test_parts_that_touch_keep_volume, setup, teardown),
		cmocka_unit_test_setup_teardown(test_dents_are_not_blown_up, setup, teardown),
		cmocka_unit_test_setup_teardown(test_iterative_is_direct, setup, teardown),
		cmocka_unit_test_setup_teardown(
		    test_threads_and_order_of_poses_change_nothing, setup, teardown),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
