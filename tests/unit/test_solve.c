/* The solvers: right solutions, and sentences for matrices that have none. */
#include "base/random.h"
#include "solve/preconditioner.h"
#include "solve/solver_type.h"
#include "unit.h"

#include <dlfcn.h>
#include <math.h>

enum { SIDE = 30, N = SIDE * SIDE };

/* The five-point Laplacian of a grid plus `shift` on the diagonal, all of it or the lower triangle, with a
 * drift. */
static mr_sparse
grid_of_side(int side, double shift, double drift, bool lower)
{
	int rows = side * side, n = 0;
	size_t most = 5 * (size_t)rows;
	mr_sparse a = { rows, MR_NEW(&ctx, (size_t)rows + 1, int), MR_NEW(&ctx, most, int),
		MR_NEW(&ctx, most, double) };

	for (int i = 0; i < rows; i++) {
		const int at[5] = { i - side, i - 1, i, i + 1, i + side };
		const bool inside[5] = { i >= side, i % side > 0, true, i % side < side - 1,
			i + side < rows };
		a.start[i] = n;
		for (int k = 0; k < (lower ? 3 : 5); k++)
			if (inside[k]) {
				a.index[n] = at[k];
				a.value[n++] = k == 2  ? shift + inside[0] + inside[1] + inside[3] + inside[4]
				               : k < 2 ? -1 - drift
				                       : -1 + drift;
			}
	}
	a.start[rows] = n;
	return a;
}

static mr_sparse
grid_matrix(double shift, double drift, bool lower)
{
	return grid_of_side(SIDE, shift, drift, lower);
}

static void
apply(const mr_sparse *a, const double *x, double *y)
{
	for (int i = 0; i < a->n; i++) {
		y[i] = 0;
		for (int e = a->start[i]; e < a->start[i + 1]; e++)
			y[i] += a->value[e] * x[a->index[e]];
	}
}

static void
check_solver(mr_solver_kind kind, double drift, const int *part)
{
	mr_sparse full = grid_matrix(0.1, drift, false),
		  given = grid_matrix(0.1, drift, mr_solver_is_symmetric(kind));
	double *x = MR_NEW(&ctx, 3 * N, double), *b = MR_NEW(&ctx, 3 * N, double);
	mr_random r = { 1 };
	mr_solver *s = NULL;
	mr_solver_report report;

	for (int i = 0; i < 3 * N; i++)
		x[i] = mr_random_real(&r) - 0.5;
	assert_int_equal(mr_solver_direct(&ctx, s = mr_solver_new(&ctx), kind, &given, part), MR_OK);
	memset(given.value, 0,
	    (size_t)given.start[N] * sizeof *given.value); /* it need not outlive the set-up */
	for (int run = 0; run < 2; run++) {                /* any number of times, any number of columns */
		size_t columns = run ? 1 : 3;
		for (size_t c = 0; c < columns; c++)
			apply(&full, x + c * N, b + c * N);
		assert_int_equal(mr_solver_solve(&ctx, s, b, columns), MR_OK);
		for (size_t i = 0; i < columns * N; i++)
			if (!(fabs(b[i] - x[i]) < 1e-12))
				fail_msg("x[%zu] is off by %g", i, b[i] - x[i]);
	}
	report = mr_solver_reported(s);
	assert_true(report.nnz_factor >= 3 * N && report.rcond > 1e-6 && report.rcond <= 1);
}

static void
test_cholesky(void **state)
{
	int part[N];

	(void)state;
	check_solver(MR_CHOLESKY, 0, NULL);
	check_solver(MR_CHOLMOD, 0, NULL);
	for (int i = 0; i < N; i++) /* the middle column last */
		part[i] = i % SIDE < SIDE / 2 ? 0 : i % SIDE > SIDE / 2 ? 1 : 2;
	check_solver(MR_CHOLESKY, 0, part);
	check_solver(MR_CHOLMOD, 0, part);
}

/* A factor of many subtrees, more right-hand sides than are solved together, and any number of threads. */
static void
test_subtrees(void **state)
{
	enum { LARGE = 250, ROWS = LARGE * LARGE, COLUMNS = 6 };
	mr_sparse full = grid_of_side(LARGE, 1e-3, 0, false), lower = grid_of_side(LARGE, 1e-3, 0, true);
	double *x = MR_NEW(&ctx, COLUMNS * ROWS, double), *first = MR_NEW(&ctx, COLUMNS * ROWS, double);
	double *b = MR_NEW(&ctx, COLUMNS * ROWS, double);
	mr_random r = { 1 };
	mr_solver *s = NULL;

	(void)state;
	for (int i = 0; i < COLUMNS * ROWS; i++)
		x[i] = mr_random_real(&r) - 0.5;
	assert_int_equal(mr_solver_direct(&ctx, s = mr_solver_new(&ctx), MR_CHOLESKY, &lower, NULL), MR_OK);
	for (unsigned threads = 1; threads <= 4; threads++) {
		ctx.threads = threads;
		for (size_t c = 0; c < COLUMNS; c++)
			apply(&full, x + c * ROWS, b + c * ROWS);
		assert_int_equal(mr_solver_solve(&ctx, s, b, COLUMNS), MR_OK);
		if (threads == 1)
			memcpy(first, b, COLUMNS * ROWS * sizeof *b);
		assert_memory_equal(b, first, COLUMNS * ROWS * sizeof *b);
	}
	for (size_t i = 0; i < COLUMNS * ROWS; i++)
		if (!(fabs(b[i] - x[i]) < 1e-10))
			fail_msg("x[%zu] is off by %g", i, b[i] - x[i]);
}

static void
test_lu(void **state)
{
	(void)state;
	check_solver(MR_LU, 0, NULL);
	check_solver(MR_LU, 0.3, NULL);
}

/* Iterative solvers: the same solutions, in few steps, however many threads there are. */
static void
check_iterative(mr_solver_kind kind, const mr_hierarchy *hierarchy, size_t most)
{
	mr_sparse a = hierarchy ? *hierarchy->laplace : grid_matrix(0.1, 0, false);
	mr_solver_opts opts = MR_SOLVER_DEFAULTS;
	mr_system system = { .a = &a, .hierarchy = hierarchy };
	double *x = MR_NEW(&ctx, 6 * N, double), *b = MR_NEW(&ctx, 6 * N, double),
	       *first = MR_NEW(&ctx, 6 * N, double);
	mr_random r = { 1 };

	opts.kind = kind;
	opts.tol = 1e-13;
	for (int i = 0; i < 6 * N; i++)
		x[i] = mr_random_real(&r) - 0.5;
	for (unsigned threads = 1; threads <= 3; threads++) {
		mr_solver *s = NULL;
		ctx.threads = threads;
		assert_int_equal(mr_solver_open(&ctx, s = mr_solver_new(&ctx), &opts, &system), MR_OK);
		for (size_t c = 0; c < 6; c++)
			apply(&a, x + c * N, b + c * N);
		assert_int_equal(mr_solver_solve(&ctx, s, b, 6), MR_OK);
		for (size_t i = 0; i < 6 * N; i++)
			if (!(fabs(b[i] - x[i]) < 1e-9))
				fail_msg("x[%zu] is off by %g", i, b[i] - x[i]);
		if (threads == 1)
			memcpy(first, b, 6 * N * sizeof *b);
		assert_memory_equal(b, first, 6 * N * sizeof *b);
		assert_in_range(mr_solver_reported(s).iterations, 1, most);
		assert_true(mr_solver_reported(s).residual <= opts.tol);
	}
}

static void
test_iterative(void **state)
{
	(void)state;
	check_iterative(MR_CG, NULL, 40);
}

/* -y'' + y of the values on a line, those at its ends held: a matrix that nobody stores. */
static void
apply_line(const mr_ctx *c, const void *data, mr_multivector s, const double *x, double *y)
{
	(void)c;
	(void)data;
	for (size_t i = 0; i < s.n * s.width; i++) {
		bool end = i < s.width || i >= (s.n - 1) * s.width;
		y[i] = end ? 0 : 3 * x[i] - x[i - s.width] - x[i + s.width];
	}
}

enum { LINE = 30000 };

/* Solves for right-hand sides 0 and 1, with the ends at 1, and returns the largest residual. */
static double
solve_line(const double *goal, size_t most, double *inverse, double *x, size_t *steps)
{
	mr_preconditioner b = mr_jacobi_of(inverse, LINE);
	mr_cg g = { .s = { LINE, 2 }, .apply = apply_line, .b = &b, .goal = goal, .tol = 1e-3, .most = most };
	double *r = MR_NEW(&ctx, 2 * LINE, double), worst = 0;

	memset(x, 0, 2 * LINE * sizeof *x);
	x[0] = x[1] = x[2 * LINE - 2] = x[2 * LINE - 1] = 1;
	apply_line(&ctx, NULL, g.s, x, r);
	for (size_t i = 2; i < 2 * LINE - 2; i++)
		r[i] = (double)(i % 2) - r[i];
	*steps = 0;
	assert_int_equal(mr_cg_improve(&ctx, &g, x, r, steps), MR_OK);
	assert_true(x[0] == 1 && x[1] == 1 && x[2 * LINE - 2] == 1 && x[2 * LINE - 1] == 1);
	for (size_t i = 2; i < 2 * LINE - 2; i++)
		worst = fmax(worst, fabs((double)(i % 2) - (3 * x[i] - x[i - 2] - x[i + 2])));
	return worst;
}

/* To a goal with any number of threads, by the error's energy, as far as the steps go, and where nothing is
 * free. */
static void
test_matrix_free(void **state)
{
	static const double goal[2] = { 1e-9, 1e-9 };
	double *x[2] = { MR_NEW(&ctx, 2 * LINE, double), MR_NEW(&ctx, 2 * LINE, double) };
	double *inverse = MR_NEW_ZERO(&ctx, LINE, double);
	size_t steps, fewer;

	(void)state;
	for (size_t i = 1; i < LINE - 1; i++)
		inverse[i] = 1.0 / 3;
	for (unsigned k = 0; k < 2; k++) {
		ctx.threads = 1 + 2 * k;
		assert_true(solve_line(goal, 100, inverse, x[k], &steps) < 1e-9);
	}
	assert_memory_equal(x[0], x[1], 2 * LINE * sizeof *x[0]);
	assert_in_range(steps, 5, 30);
	assert_true(solve_line(NULL, 100, inverse, x[0], &fewer) < 1e-2);
	assert_in_range(fewer, 4, steps - 1);
	assert_true(solve_line(NULL, 3, inverse, x[0], &steps) > 1e-2);
	assert_int_equal(steps, 3);
	memset(inverse, 0, LINE * sizeof *inverse);
	assert_true(solve_line(NULL, 100, inverse, x[0], &steps) == 2);
	assert_int_equal(steps, 0);
}

/* Linear interpolation along a side from every second point: the coarse points and their weights, at most
 * two. */
static int
interpolate(int x, int at[2], double weight[2])
{
	bool between = x % 2 && x / 2 + 1 < SIDE / 2;

	at[0] = x / 2;
	at[1] = x / 2 + 1;
	weight[0] = between ? 0.5 : 1;
	weight[1] = 0.5;
	return between ? 2 : 1;
}

static mr_sparse
interpolation(void)
{
	mr_sparse p = { N, MR_NEW(&ctx, N + 1, int), MR_NEW(&ctx, 4 * N, int), MR_NEW(&ctx, 4 * N, double) };
	int n = 0;

	for (int i = 0; i < N; i++) {
		int row[2], column[2];
		double u[2], v[2];
		p.start[i] = n;
		for (int a = 0; a < interpolate(i / SIDE, row, u); a++)
			for (int b = 0; b < interpolate(i % SIDE, column, v); b++) {
				p.index[n] = SIDE / 2 * row[a] + column[b];
				p.value[n++] = u[a] * v[b];
			}
	}
	p.start[N] = n;
	return p;
}

static void
test_multigrid(void **state)
{
	mr_sparse l = grid_matrix(1e-3, 0, false), p = interpolation();
	double *weight = MR_NEW(&ctx, N, double);
	mr_coarser level = { p, N / 4 };
	mr_hierarchy h = { .laplace = &l, .weight = weight, .order = 1, .count = 1, .level = &level };
	uint32_t strip[2 * SIDE];

	(void)state;
	for (int i = 0; i < N; i++)
		weight[i] = 1;
	check_iterative(MR_MULTIGRID, &h, 30);
	check_iterative(MR_VCYCLE, &h, 40);
	for (uint32_t i = 0; i < 2 * SIDE; i++)
		strip[i] = i;
	h.strip = strip;
	h.strip_count = 2 * SIDE;
	check_iterative(MR_MULTIGRID, &h, 30);
}

/* A level of zeros, as where all weights of a coarse level cancel, is smoothed to finite numbers. */
static void
test_multigrid_of_zeros(void **state)
{
	mr_sparse l = grid_matrix(1e-3, 0, false), p = interpolation();
	mr_coarser level = { p, N / 4 };
	double *weight = MR_NEW(&ctx, N, double), *b = MR_NEW_ZERO(&ctx, N, double);
	mr_hierarchy h = { .laplace = &l, .weight = weight, .order = 1, .count = 1, .level = &level };
	mr_system system = { .a = &l, .hierarchy = &h };

	(void)state;
	memset(l.value, 0, (size_t)l.start[N] * sizeof *l.value);
	for (int i = 0; i < N; i++)
		weight[i] = 1;
	for (int kind = MR_MULTIGRID; kind <= MR_VCYCLE; kind++) {
		mr_solver_opts opts = MR_SOLVER_DEFAULTS;
		mr_solver *s = NULL;
		opts.kind = (mr_solver_kind)kind;
		opts.iterations = 10;
		b[0] = 1;
		assert_int_equal(mr_solver_open(&ctx, s = mr_solver_new(&ctx), &opts, &system), MR_OK);
		assert_int_equal(mr_solver_solve(&ctx, s, b, 1), MR_ENUMERIC);
		assert_null(strstr(ctx.error, "nan"));
	}
}

/* What does not converge is an error, with what was reached. */
static void
test_no_convergence(void **state)
{
	mr_sparse a = grid_matrix(1e-6, 0, false);
	double *b = MR_NEW(&ctx, N, double);
	mr_solver_opts opts = MR_SOLVER_DEFAULTS;
	mr_solver *s = mr_solver_new(&ctx);

	(void)state;
	opts.kind = MR_CG;
	opts.iterations = 3;
	for (int i = 0; i < N; i++)
		b[i] = i % 5;
	assert_int_equal(mr_solver_open(&ctx, s, &opts, &(mr_system){ .a = &a }), MR_OK);
	assert_int_equal(mr_solver_solve(&ctx, s, b, 1), MR_ENUMERIC);
	assert_non_null(strstr(ctx.error, "no convergence: a relative residual of "));
	assert_non_null(strstr(ctx.error, "after 3 iterations"));
}

/* Factors that exceed the memory are refused before they are there. */
static void
test_memory(void **state)
{
	(void)state;
	for (int kind = MR_CHOLESKY; kind <= MR_LU; kind++) {
		mr_sparse a = grid_matrix(0.1, 0, mr_solver_is_symmetric((mr_solver_kind)kind));
		mr_solver_opts opts = MR_SOLVER_DEFAULTS;
		opts.kind = (mr_solver_kind)kind;
		opts.memory = 1000;
		assert_int_equal(
		    mr_solver_open(&ctx, mr_solver_new(&ctx), &opts, &(mr_system){ .a = &a }), MR_ERANGE);
		assert_non_null(strstr(ctx.error, "MB"));
	}
}

static void
test_what_has_no_solution(void **state)
{
	mr_sparse indefinite = grid_matrix(-1, 0, true), singular = grid_matrix(0, 0, false);
	mr_solver_opts opts = MR_SOLVER_DEFAULTS;
	uint32_t *vertex = MR_NEW(&ctx, N, uint32_t);

	(void)state;
	assert_int_equal(
	    mr_solver_direct(&ctx, mr_solver_new(&ctx), MR_CHOLESKY, &indefinite, NULL), MR_ENUMERIC);
	assert_non_null(strstr(ctx.error, "not positive definite (at row "));
	for (size_t i = 0; i < N; i++)
		vertex[i] = 100000;
	assert_int_equal(mr_solver_open(&ctx, mr_solver_new(&ctx), &opts,
			     &(mr_system){ .a = &indefinite, .vertex = vertex }),
	    MR_ENUMERIC);
	assert_non_null(strstr(ctx.error, "(at vertex 100000)"));
	for (int e = singular.start[5]; e < singular.start[6]; e++)
		singular.value[e] = 0;
	assert_int_equal(mr_solver_direct(&ctx, mr_solver_new(&ctx), MR_LU, &singular, NULL), MR_ENUMERIC);
	assert_non_null(strstr(ctx.error, "singular"));
}

/* A program that has OpenBLAS take several threads still does so after a solver is set up. */
static void
test_blas_threads(void **state)
{
	void *process = dlopen(NULL, RTLD_LAZY);
	union {
		void *symbol;
		void (*set)(int);
		int (*get)(void);
	} set = { dlsym(process, "openblas_set_num_threads") },
	  get = { dlsym(process, "openblas_get_num_threads") },
	  levels = { dlsym(process, "omp_get_max_active_levels") };
	mr_sparse a = grid_matrix(0.1, 0, true);
	int before, outer, inner;

	(void)state;
	if (!set.symbol || !get.symbol || !levels.symbol)
		skip();
	set.set(3);
	before = levels.get();
	outer = mr_serial_begin();
	assert_int_equal(get.get(), 1);
	assert_int_equal(mr_solver_direct(&ctx, mr_solver_new(&ctx), MR_CHOLESKY, &a, NULL), MR_OK);
	inner = mr_serial_begin();
	mr_serial_end(inner);
	assert_int_equal(get.get(), 1);
	assert_int_equal(levels.get(), 0);
	mr_serial_end(outer);
	assert_int_equal(get.get(), 3);
	assert_int_equal(levels.get(), before);
	dlclose(process);
}

static void
test_one_unknown(void **state)
{
	int start[2] = { 0, 1 }, index[1] = { 0 };
	double value[1] = { 4 };
	mr_sparse a = { 1, start, index, value };

	(void)state;
	for (int kind = MR_CHOLESKY; kind <= MR_LU; kind++) {
		double b[2] = { 8, -2 };
		mr_solver *s = NULL;
		assert_int_equal(
		    mr_solver_direct(&ctx, s = mr_solver_new(&ctx), (mr_solver_kind)kind, &a, NULL), MR_OK);
		assert_int_equal(mr_solver_solve(&ctx, s, b, 2), MR_OK);
		assert_true(b[0] == 2 && b[1] == -0.5);
	}
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_cholesky, setup, teardown),
		cmocka_unit_test_setup_teardown(test_subtrees, setup, teardown),
		cmocka_unit_test_setup_teardown(test_lu, setup, teardown),
		cmocka_unit_test_setup_teardown(test_iterative, setup, teardown),
		cmocka_unit_test_setup_teardown(test_matrix_free, setup, teardown),
		cmocka_unit_test_setup_teardown(test_multigrid, setup, teardown),
		cmocka_unit_test_setup_teardown(test_multigrid_of_zeros, setup, teardown),
		cmocka_unit_test_setup_teardown(test_no_convergence, setup, teardown),
		cmocka_unit_test_setup_teardown(test_memory, setup, teardown),
		cmocka_unit_test_setup_teardown(test_what_has_no_solution, setup, teardown),
		cmocka_unit_test_setup_teardown(test_blas_threads, setup, teardown),
		cmocka_unit_test_setup_teardown(test_one_unknown, setup, teardown),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
