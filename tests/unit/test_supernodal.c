/* Supernodal solves against dense ones, of random factors in panels. */
#include "base/random.h"
#include "solve/supernodal.h"
#include "unit.h"

#include <math.h>

typedef struct factor {
	mr_panels l;
	double *dense; /* n x n, column by column; zero above the diagonal */
} factor;

static size_t
below(mr_random *r, size_t n)
{
	return (size_t)(mr_random_bits(r) % n);
}

/* A tree in postorder: the parent of each of `count` panels, `count` of a root. */
static size_t *
random_tree(mr_random *r, size_t count)
{
	size_t *parent = MR_NEW(&ctx, count, size_t), *stack = MR_NEW(&ctx, count, size_t), waiting = 0;

	assert_true(parent && stack);
	for (size_t s = 0; s < count; s++) {
		size_t children = below(r, 4) ? below(r, 3) : waiting;
		parent[s] = count;
		while (children-- > 0 && waiting > 0)
			parent[stack[--waiting]] = s;
		stack[waiting++] = s;
	}
	return parent;
}

/*
 * Panels of 1 to `widest` columns: the rows of each are its own columns, a share of its parent's columns, the
 * first of them too, and of its parent's other rows.  A forest where the tree has several roots.
 */
static factor
random_factor(mr_random *r, size_t count, size_t widest, double share)
{
	size_t *parent = random_tree(r, count), rows = 0, values = 0, n;
	int *first = MR_NEW(&ctx, count + 1, int), *row, *permutation;
	int *above = MR_NEW(&ctx, count, int), *below_it = MR_NEW(&ctx, count, int);
	size_t *row_at = MR_NEW(&ctx, count + 1, size_t), *value_at = MR_NEW(&ctx, count + 1, size_t);
	int **list = MR_NEW(&ctx, count, int *);
	size_t *length = MR_NEW(&ctx, count, size_t);
	double *value;
	factor f;

	first[0] = 0;
	for (size_t s = 0; s < count; s++)
		first[s + 1] = first[s] + 1 + (int)below(r, widest);
	n = (size_t)first[count];
	for (size_t s = count; s-- > 0;) {
		list[s] = MR_NEW(&ctx, n, int);
		length[s] = 0;
		for (int c = first[s]; c < first[s + 1]; c++)
			list[s][length[s]++] = c;
		for (size_t k = 0; parent[s] < count && k < length[parent[s]]; k++)
			if (k == 0 || mr_random_real(r) < share)
				list[s][length[s]++] = list[parent[s]][k];
		rows += length[s];
		values += length[s] * (size_t)(first[s + 1] - first[s]);
	}
	row = MR_NEW(&ctx, rows, int);
	value = MR_NEW(&ctx, values, double);
	permutation = MR_NEW(&ctx, n, int);
	f.dense = MR_NEW_ZERO(&ctx, n * n, double);
	assert_true(row && value && permutation && f.dense);
	row_at[0] = value_at[0] = 0;
	for (size_t s = 0; s < count; s++) {
		size_t nc = (size_t)(first[s + 1] - first[s]), nr = length[s];
		row_at[s + 1] = row_at[s] + nr;
		value_at[s + 1] = value_at[s] + nr * nc;
		memcpy(row + row_at[s], list[s], nr * sizeof *row);
		for (size_t c = 0; c < nc; c++)
			for (size_t k = 0; k < nr; k++) {
				double x = k == c ? 1 + mr_random_real(r)
				                  : (mr_random_real(r) - 0.5) / (double)nr;
				size_t column = (size_t)first[s] + c;
				/* above the diagonal of a panel stands what nobody may read */
				value[value_at[s] + c * nr + k] = k < c ? NAN : x;
				if (k >= c)
					f.dense[column * n + (size_t)list[s][k]] = x;
			}
	}
	for (size_t i = 0; i < n; i++)
		permutation[i] = (int)i;
	for (size_t i = n; i-- > 1;) {
		size_t j = below(r, i + 1);
		int x = permutation[i];
		permutation[i] = permutation[j];
		permutation[j] = x;
	}
	for (size_t s = 0; s < count; s++)
		below_it[s] = (int)s;
	for (size_t s = 0; s < count; s++) {
		above[s] = parent[s] < count ? (int)parent[s] : -1;
		if (parent[s] < count && below_it[s] < below_it[parent[s]])
			below_it[parent[s]] = below_it[s];
	}
	f.l = (mr_panels){ .n = n,
		.count = count,
		.first = first,
		.row = row,
		.parent = above,
		.first_below = below_it,
		.row_at = row_at,
		.value_at = value_at,
		.value = value,
		.permutation = permutation };
	return f;
}

/* P' L L' P x = b, in place. */
static void
dense_solve(const factor *f, double *b)
{
	size_t n = f->l.n;
	double *x = MR_NEW(&ctx, n, double);

	for (size_t i = 0; i < n; i++)
		x[i] = b[f->l.permutation[i]];
	for (size_t j = 0; j < n; j++) {
		x[j] /= f->dense[j * n + j];
		for (size_t i = j + 1; i < n; i++)
			x[i] -= f->dense[j * n + i] * x[j];
	}
	for (size_t j = n; j-- > 0;) {
		for (size_t i = j + 1; i < n; i++)
			x[j] -= f->dense[j * n + i] * x[i];
		x[j] /= f->dense[j * n + j];
	}
	for (size_t i = 0; i < n; i++)
		b[f->l.permutation[i]] = x[i];
}

static double *
random_sides(mr_random *r, size_t n)
{
	double *b = MR_NEW(&ctx, n, double);

	assert_non_null(b);
	for (size_t i = 0; i < n; i++)
		b[i] = mr_random_real(r) - 0.5;
	return b;
}

static void
assert_solves(const factor *f, mr_supernodal *s, mr_random *r, size_t columns)
{
	size_t n = f->l.n;
	double *b = random_sides(r, n * (columns + 1)), *want = MR_NEW(&ctx, n * columns, double),
	       after = b[n * columns];

	memcpy(want, b, n * columns * sizeof *want);
	mr_supernodal_solve(&ctx, s, b, columns);
	for (size_t c = 0; c < columns; c++)
		dense_solve(f, want + c * n);
	for (size_t i = 0; i < n * columns; i++)
		assert_true(fabs(b[i] - want[i]) < 1e-12);
	assert_true(b[n * columns] == after);
}

static void
small_factors_solve_as_dense_ones(void **state)
{
	mr_random r = { 1 };

	(void)state;
	for (int k = 0; k < 150; k++) {
		factor f = random_factor(&r, 1 + below(&r, 20), 1 + below(&r, 12), mr_random_real(&r));
		mr_supernodal *s;
		s = mr_supernodal_new(&ctx, &f.l);
		for (size_t columns = 1; columns <= 9; columns++)
			assert_solves(&f, s, &r, columns);
		assert_solves(&f, s, &r, 1); /* nothing is left of the last */
		mr_ctx_free(&ctx);
	}
}

/* Large enough for several subtrees, which threads share; the bits do not tell how many there were. */
static void
subtrees_solve_as_dense_ones(void **state)
{
	mr_random r = { 2 };

	(void)state;
	for (int k = 0; k < 4; k++) {
		factor f = random_factor(&r, 60, 50, 0.5);
		double *b[4];
		mr_supernodal *s;
		s = mr_supernodal_new(&ctx, &f.l);
		assert_solves(&f, s, &r, 3);
		assert_solves(&f, s, &r, 5);
		b[0] = random_sides(&r, 3 * f.l.n);
		for (unsigned threads = 1; threads < 4; threads++) {
			b[threads] = MR_NEW(&ctx, 3 * f.l.n, double);
			memcpy(b[threads], b[0], 3 * f.l.n * sizeof *b[0]);
			ctx.threads = threads;
			mr_supernodal_solve(&ctx, s, b[threads], 3);
			assert_memory_equal(b[threads], b[1], 3 * f.l.n * sizeof *b[0]);
		}
		mr_ctx_free(&ctx);
	}
}

/* Columns are independent: each as it is alone, bit for bit. */
static void
columns_do_not_mix(void **state)
{
	mr_random r = { 3 };
	factor f = random_factor(&r, 12, 9, 0.5);
	size_t n = f.l.n;
	double *b = random_sides(&r, 6 * n), *one = MR_NEW(&ctx, n, double);
	mr_supernodal *s;

	(void)state;
	s = mr_supernodal_new(&ctx, &f.l);
	for (size_t c = 0; c < 6; c++) {
		double *all = MR_NEW(&ctx, 6 * n, double);
		memcpy(all, b, 6 * n * sizeof *all);
		memcpy(one, b + c * n, n * sizeof *one);
		mr_supernodal_solve(&ctx, s, all, 6);
		mr_supernodal_solve(&ctx, s, one, 1);
		assert_memory_equal(one, all + c * n, n * sizeof *one);
	}
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(small_factors_solve_as_dense_ones, setup, teardown),
		cmocka_unit_test_setup_teardown(subtrees_solve_as_dense_ones, setup, teardown),
		cmocka_unit_test_setup_teardown(columns_do_not_mix, setup, teardown),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
