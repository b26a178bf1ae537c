/* The valid triangle against closed forms, heights of surfaces that are known, and what cannot be sampled. */
#include "base/random.h"
#include "domain.h"
#include "sample/height_energy.h"
#include "sample/parts.h"
#include "shape/shape.h"
#include "unit.h"

static const mr_bounds anything = { .height = INFINITY, .edge2 = INFINITY, .cosine = 0 };

static int
nearer(const void *a, const void *b)
{
	double x = ((const mr_sight *)a)->d2, y = ((const mr_sight *)b)->d2;

	return x < y ? -1 : x > y;
}

/* How often the first triangle is met among 3, 4 and 5 points about random lines through a jittered lattice.
 */
static void
tries(double jitter, double share[3])
{
	enum { TRIALS = 20000, SIDE = 11 };
	mr_random r = { 7 };
	size_t met[6] = { 0 };

	for (int trial = 0; trial < TRIALS; trial++) {
		mr_sight s[SIDE * SIDE];
		size_t n = 0;
		double ox = mr_random_real(&r), oy = mr_random_real(&r);
		for (int i = -SIDE / 2; i <= SIDE / 2; i++)
			for (int j = -SIDE / 2; j <= SIDE / 2; j++) {
				double a = i + ox + jitter * (mr_random_real(&r) - 0.5);
				double b = j + oy + jitter * (mr_random_real(&r) - 0.5);
				s[n] = (mr_sight){
					.x = a + b / 2, .y = b * sqrt(0.75), .index = (uint32_t)n
				};
				s[n].d2 = s[n].x * s[n].x + s[n].y * s[n].y;
				n++;
			}
		qsort(s, n, sizeof *s, nearer);
		size_t points = mr_valid_triangle(s, 12, &anything).points;
		if (points >= 3 && points <= 5)
			met[points]++;
	}
	for (int k = 0; k < 3; k++)
		share[k] = (double)(met[3] + (k > 0 ? met[4] : 0) + (k > 1 ? met[5] : 0)) / TRIALS;
}

/* Wendel 1962: k points in random directions surround the origin with probability 1 - k / 2^(k - 1). */
static void
random_points_by_wendel(void **state)
{
	enum { TRIALS = 40000, N = 30 };
	mr_random r = { 3 };
	size_t met[N + 1] = { 0 }, sum = 0;

	(void)state;
	for (int trial = 0; trial < TRIALS; trial++) {
		mr_sight s[N];
		for (uint32_t i = 0; i < N; i++) {
			double a = 2 * MR_PI * mr_random_real(&r), d = sqrt(mr_random_real(&r));
			s[i] = (mr_sight){ d * cos(a), d * sin(a), 0, d * d, i };
		}
		qsort(s, N, sizeof *s, nearer);
		met[mr_valid_triangle(s, N, &anything).points]++;
	}
	for (int k = 3; k <= 8; k++) {
		sum += met[k];
		assert_true(fabs((double)sum / TRIALS - (1 - k * pow(2, 1 - k))) < 0.01);
	}
}

static void
lattices_from_perfect_to_random(void **state)
{
	static const double random_shares[3] = { 0.25, 0.5, 0.6875 };
	double lattice[3], some[3], more[3];

	(void)state;
	tries(0, lattice);
	tries(0.5, some);
	tries(1, more);
	assert_true(lattice[0] == 1);
	for (int k = 0; k < 3; k++) {
		assert_true(lattice[k] >= some[k] && some[k] > more[k]);
		assert_true(more[k] > random_shares[k]);
	}
}

/* The smallest triangle that the line meets, by looking at all, agrees with the search's when the search has
 * seen all points. */
static void
smallest_of_several(void **state)
{
	mr_random r = { 11 };

	(void)state;
	for (int trial = 0; trial < 2000; trial++) {
		mr_sight s[4];
		double best = INFINITY, height = 0;
		mr_valid v;
		for (uint32_t i = 0; i < 4; i++) {
			s[i] = (mr_sight){ mr_random_real(&r) - 0.5, mr_random_real(&r) - 0.5,
				mr_random_real(&r), 0, i };
			s[i].d2 = s[i].x * s[i].x + s[i].y * s[i].y;
		}
		qsort(s, 4, sizeof *s, nearer);
		v = mr_valid_triangle(s, 4, &anything);
		for (int skip = 3; skip >= 0 && !(skip < 3 && v.points == 3); skip--) {
			const mr_sight *t[3];
			double w[3], sum = 0, area;
			int n = 0;
			for (int i = 0; i < 4; i++)
				if (i != skip)
					t[n++] = &s[i];
			for (int k = 0; k < 3; k++) {
				const mr_sight *a = t[(k + 1) % 3], *b = t[(k + 2) % 3];
				sum += w[k] = a->x * b->y - a->y * b->x;
			}
			if (w[0] / sum < 0 || w[1] / sum < 0 || w[2] / sum < 0)
				continue;
			area = mr_norm(
				   mr_cross(mr_vec(t[1]->x - t[0]->x, t[1]->y - t[0]->y, t[1]->t - t[0]->t),
				       mr_vec(t[2]->x - t[0]->x, t[2]->y - t[0]->y, t[2]->t - t[0]->t))) /
			       2;
			if (area < best) {
				best = area;
				height = (w[0] * t[0]->t + w[1] * t[1]->t + w[2] * t[2]->t) / sum;
			}
		}
		assert_true(v.taken == isfinite(best));
		if (v.taken)
			assert_true(fabs(v.height - height) < 1e-9 && fabs(v.area - best) < 1e-9);
	}
}

static mr_domain
domain_of(mr_solid solid, size_t vertices, size_t level, bool open)
{
	mr_make_opts o = { .solid = solid, .vertices = vertices, .open = open };
	mr_mesh control;

	assert_int_equal(mr_solid_make(&ctx, &o, &control), MR_OK);
	return domain(&control, level);
}

static mr_v3 *
sphere_points(size_t n, double noise)
{
	mr_make_opts o = { .solid = MR_SPHERE, .vertices = 50000 };
	mr_mesh m;
	mr_v3 *p, *normal;

	assert_int_equal(mr_solid_make(&ctx, &o, &m), MR_OK);
	assert_int_equal(mr_surface_sample(&ctx, &m, n, 5, &p, &normal), MR_OK);
	for (size_t i = 0; i < n; i++)
		p[i] = mr_unit(p[i]);
	mr_add_noise(p, normal, n, noise, 6);
	return p;
}

/* The mean and largest distance of the displaced vertices from the unit sphere. */
static void
sphere_errors(const mr_domain *d, const double *height, double *mean, double *most)
{
	*mean = *most = 0;
	for (size_t i = 0; i < d->m.nv; i++) {
		double e = fabs(mr_norm(mr_axpy(height[i], d->normal[i], d->m.p[i])) - 1);
		*mean += e / (double)d->m.nv;
		*most = fmax(*most, e);
	}
}

static void
sphere_from_points(void **state)
{
	mr_domain d = domain_of(MR_SPHERE, 42, 4, false);
	double *height = MR_NEW(&ctx, d.m.nv, double), mean, most, paper, paper_most;
	mr_v3 *p = sphere_points(12000, 0);
	mr_sample_opts o = MR_SAMPLE_DEFAULTS;

	(void)state;
	o.refine = 0;
	assert_int_equal(mr_sample_points(&ctx, &d, p, 12000, NULL, &o, height, NULL), MR_OK);
	sphere_errors(&d, height, &paper, &paper_most);
	assert_true(paper < 1e-3 && paper_most < 2e-2);
	o.refine = 3;
	assert_int_equal(mr_sample_points(&ctx, &d, p, 12000, NULL, &o, height, NULL), MR_OK);
	sphere_errors(&d, height, &mean, &most);
	assert_true(mean < 2e-3 && most < paper_most);
}

/* Noise of a fiftieth of the radius: the robust way comes nearer than the triangles, and is taken. */
static void
sphere_from_noise(void **state)
{
	mr_domain d = domain_of(MR_SPHERE, 42, 3, false);
	double *height = MR_NEW(&ctx, d.m.nv, double), mean, most, triangle, triangle_most;
	mr_v3 *p = sphere_points(6000, 0.02);
	mr_sample_opts o = MR_SAMPLE_DEFAULTS;

	(void)state;
	o.method = MR_SAMPLE_TRIANGLE;
	assert_int_equal(mr_sample_points(&ctx, &d, p, 6000, NULL, &o, height, NULL), MR_OK);
	sphere_errors(&d, height, &triangle, &triangle_most);
	for (int i = 0; i < 2; i++) {
		o.method = i ? MR_SAMPLE_AUTO : MR_SAMPLE_ROBUST;
		assert_int_equal(mr_sample_points(&ctx, &d, p, 6000, NULL, &o, height, NULL), MR_OK);
		sphere_errors(&d, height, &mean, &most);
		assert_true(mean < 0.5 * triangle && most < triangle_most);
	}
}

/* What is cross-validated: the more noise, the fairer, and the mean distance grows less than the noise. */
static void
noise_makes_fair(void **state)
{
	mr_domain d = domain_of(MR_SPHERE, 42, 3, false);
	double *height = MR_NEW(&ctx, d.m.nv, double), mean[2], most;
	mr_sample_opts o = MR_SAMPLE_DEFAULTS;
	mr_sample_result r[2];

	(void)state;
	o.method = MR_SAMPLE_ROBUST;
	for (int i = 0; i < 2; i++) {
		mr_v3 *p = sphere_points(6000, i ? 0.02 : 0.002);
		assert_int_equal(mr_sample_points(&ctx, &d, p, 6000, NULL, &o, height, &r[i]), MR_OK);
		sphere_errors(&d, height, &mean[i], &most);
	}
	assert_true(r[1].fairness > 4 * r[0].fairness);
	assert_true(mean[1] < 8 * mean[0]);
}

static void
torus_from_mesh(void **state)
{
	mr_domain d = domain_of(MR_TORUS, 200, 3, false);
	mr_make_opts o = { .solid = MR_TORUS, .vertices = 20000 };
	double *height = MR_NEW(&ctx, d.m.nv, double), worst = 0;
	mr_sample_opts opts = MR_SAMPLE_DEFAULTS;
	mr_mesh torus;

	(void)state;
	assert_int_equal(mr_solid_make(&ctx, &o, &torus), MR_OK);
	for (opts.refine = 0; opts.refine <= 3; opts.refine += 3) {
		assert_int_equal(mr_sample_mesh(&ctx, &d, &torus, &opts, height, NULL), MR_OK);
		for (size_t i = 0; i < d.m.nv; i++) {
			mr_v3 p = mr_axpy(height[i], d.normal[i], d.m.p[i]);
			double ring = sqrt(p.x * p.x + p.y * p.y) - 1;
			worst = fmax(worst, fabs(sqrt(ring * ring + p.z * p.z) - 0.4));
		}
		assert_true(worst < 2e-3);
	}
}

/* A plane's heights that are linear stay so where they are filled in. */
static void
fills_smoothly(void **state)
{
	mr_make_opts o = { .solid = MR_PLANE, .vertices = 900 };
	mr_heights e;
	mr_mesh m;
	double *h;
	bool *known;
	size_t filled;

	(void)state;
	assert_int_equal(mr_solid_make(&ctx, &o, &m), MR_OK);
	mr_heights_new(&ctx, &m, 1, &e);
	h = MR_NEW(&ctx, m.nv, double);
	known = MR_NEW(&ctx, m.nv, bool);
	for (size_t i = 0; i < m.nv; i++) {
		known[i] = !(fabs(m.p[i].x) < 0.3 && fabs(m.p[i].y) < 0.3);
		h[i] = known[i] ? 1 + 2 * m.p[i].x - m.p[i].y : 1e9;
	}
	assert_int_equal(mr_heights_fill(&ctx, &e, known, h, &filled), MR_OK);
	assert_true(filled > 50);
	for (size_t i = 0; i < m.nv; i++)
		assert_true(fabs(h[i] - (1 + 2 * m.p[i].x - m.p[i].y)) < 0.02);
}

static void
drops_spikes(void **state)
{
	mr_make_opts o = { .solid = MR_SPHERE, .vertices = 1000 };
	mr_random r = { 1 };
	mr_heights e;
	mr_mesh m;
	double *h;
	bool *known;
	size_t dropped;

	(void)state;
	assert_int_equal(mr_solid_make(&ctx, &o, &m), MR_OK);
	mr_heights_new(&ctx, &m, 1, &e);
	h = MR_NEW(&ctx, m.nv, double);
	known = MR_NEW(&ctx, m.nv, bool);
	for (size_t i = 0; i < m.nv; i++) {
		known[i] = true;
		h[i] = i % 50 ? 0.01 * mr_random_real(&r) : 1;
	}
	mr_heights_drop_spikes(&ctx, &e, m.p, h, known, &dropped);
	assert_int_equal(dropped, (m.nv + 49) / 50);
	for (size_t i = 0; i < m.nv; i++)
		assert_true(known[i] == (i % 50 != 0));
}

/*
 * A disc thinner than its points are apart, of which the upper side is red and has number 1, the lower black
 * and 2: away from the rim each vertex has what its own side has.  What is no number, an outlier and a repeat
 * count for nothing.
 */
static void
columns_keep_to_their_sheet(void **state)
{
	enum { N = 4000 };
	mr_make_opts o = { .solid = MR_SPHERE, .vertices = 600 };
	mr_random r = { 5 };
	static mr_v3 p[N + 2];
	static uint8_t color[N + 2][4];
	static double value[N + 2];
	static uint32_t label[N + 2];
	uint8_t spared[2][N + 2] = { { 0 } };
	mr_sampling s;
	mr_mesh control;
	mr_domain d;
	mr_v3 *flat;
	double *height;
	size_t seen = 0;

	(void)state;
	assert_int_equal(mr_solid_make(&ctx, &o, &control), MR_OK);
	flat = MR_NEW(&ctx, control.nv, mr_v3);
	for (size_t v = 0; v < control.nv; v++)
		flat[v] = mr_vec(control.p[v].x, control.p[v].y, 0.01 * control.p[v].z);
	control.p = flat;
	d = domain(&control, 2);
	height = MR_NEW_ZERO(&ctx, d.m.nv, double);
	for (size_t i = 0; i < N; i++) {
		double x, y;
		do {
			x = 2 * mr_random_real(&r) - 1;
			y = 2 * mr_random_real(&r) - 1;
		} while (x * x + y * y > 1);
		p[i] = mr_vec(x, y, (i % 2 ? -0.01 : 0.01) * sqrt(1 - x * x - y * y));
		color[i][0] = i % 2 ? 0 : 255;
		value[i] = i % 50 ? 1 + (double)(i % 2) : NAN;
		label[i] = 70000 + i % 2;
	}
	assert_int_equal(mr_sampling_find(&ctx, p, N, NULL, &s), MR_OK);
	p[N] = p[N + 1] = mr_vec(0, 0, 0.01);
	label[N] = label[N + 1] = 9;
	spared[0][N] = spared[1][N + 1] = 1;
	s.outlier = spared[0];
	s.repeat = spared[1];
	s.spacing = MR_NEW_ZERO(&ctx, N + 2, double);
	s.n = N + 2;
	mr_carried c[3] = { { "color", { 'v', 'b', 4 }, MR_MEAN, color, MR_NEW(&ctx, 4 * d.m.nv, uint8_t),
				d.m.nv },
		{ "value", { 'v', 'd', 1 }, MR_MEAN, value, MR_NEW(&ctx, d.m.nv, double), d.m.nv },
		{ "label", { 'v', 'u', 1 }, MR_LABEL, label, MR_NEW(&ctx, d.m.nv, uint32_t), d.m.nv } };
	assert_int_equal(mr_sample_columns(&ctx, &d, height, p, &s, c, 3), MR_OK);
	for (size_t v = 0; v < d.m.nv; v++) {
		mr_v3 q = d.m.p[v];
		bool up = d.normal[v].z > 0;
		if (q.x * q.x + q.y * q.y > 0.8)
			continue;
		seen++;
		assert_int_equal(((uint8_t *)c[0].to)[4 * v], up ? 255 : 0);
		assert_true(fabs(((double *)c[1].to)[v] - (up ? 1 : 2)) < 1e-12);
		assert_int_equal(((uint32_t *)c[2].to)[v], up ? 70000 : 70001);
	}
	assert_true(seen > 1000);
}

static void
threads_do_not_matter(void **state)
{
	mr_domain d = domain_of(MR_SPHERE, 42, 3, false);
	double *height[2] = { MR_NEW(&ctx, d.m.nv, double), MR_NEW(&ctx, d.m.nv, double) };
	mr_v3 *p = sphere_points(9000, 0.01);
	mr_sample_opts o = MR_SAMPLE_DEFAULTS;

	(void)state;
	for (o.method = 0; o.method < 2; o.method++) {
		for (int k = 0; k < 2; k++) {
			ctx.threads = k ? 3 : 1;
			assert_int_equal(
			    mr_sample_points(&ctx, &d, p, 9000, NULL, &o, height[k], NULL), MR_OK);
		}
		assert_memory_equal(height[0], height[1], d.m.nv * sizeof(double));
	}
}

static void
refuses(void **state)
{
	mr_domain closed = domain_of(MR_SPHERE, 42, 2, false), open = domain_of(MR_PLANE, 25, 2, false);
	double *height = MR_NEW(&ctx, closed.m.nv + open.m.nv, double);
	mr_sample_opts o = MR_SAMPLE_DEFAULTS;
	mr_random r = { 9 };
	mr_v3 p[100];

	(void)state;
	for (size_t i = 0; i < 100; i++)
		p[i] = mr_vec(1, 2, 3);
	assert_int_equal(mr_sample_points(&ctx, &closed, p, 0, NULL, &o, height, NULL), MR_EMESH);
	assert_int_equal(mr_sample_points(&ctx, &closed, p, 100, NULL, &o, height, NULL), MR_EMESH);
	for (size_t i = 0; i < 100; i++)
		p[i] = mr_axpy((double)i, mr_vec(1, 2, 3), mr_vec(0.1, 0.2, 0.3));
	assert_int_equal(mr_sample_points(&ctx, &closed, p, 100, NULL, &o, height, NULL), MR_EMESH);
	for (size_t i = 0; i < 100; i++)
		p[i] = mr_vec(2 * mr_random_real(&r) - 1, 2 * mr_random_real(&r) - 1, 0);
	assert_int_equal(mr_sample_points(&ctx, &closed, p, 100, NULL, &o, height, NULL), MR_EMESH);
	assert_int_equal(mr_sample_points(&ctx, &open, p, 100, NULL, &o, height, NULL), MR_OK);
	p[0].z = 1;
	assert_int_equal(mr_sample_points(&ctx, &closed, p, 3, NULL, &o, height, NULL), MR_EMESH);
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(random_points_by_wendel),
		cmocka_unit_test(lattices_from_perfect_to_random),
		cmocka_unit_test(smallest_of_several),
		cmocka_unit_test_setup_teardown(sphere_from_points, setup, teardown),
		cmocka_unit_test_setup_teardown(sphere_from_noise, setup, teardown),
		cmocka_unit_test_setup_teardown(noise_makes_fair, setup, teardown),
		cmocka_unit_test_setup_teardown(torus_from_mesh, setup, teardown),
		cmocka_unit_test_setup_teardown(fills_smoothly, setup, teardown),
		cmocka_unit_test_setup_teardown(drops_spikes, setup, teardown),
		cmocka_unit_test_setup_teardown(columns_keep_to_their_sheet, setup, teardown),
		cmocka_unit_test_setup_teardown(threads_do_not_matter, setup, teardown),
		cmocka_unit_test_setup_teardown(refuses, setup, teardown),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
