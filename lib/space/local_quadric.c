/* Weighted least squares by the normal equations, of which there are six. */
#include "space/local_quadric.h"

#include "space/local_planes.h"

#include <math.h>
#include <string.h>

enum { TERMS = 6 };

/* Solves A x = b in place (Cholesky); false where A is not positive definite. */
static bool
solve(double a[TERMS][TERMS], double b[TERMS])
{
	for (int j = 0; j < TERMS; j++) {
		for (int i = j; i < TERMS; i++) {
			double s = a[i][j];
			for (int k = 0; k < j; k++)
				s -= a[i][k] * a[j][k];
			if (i == j && !(s > 1e-12 * a[j][j]))
				return false;
			a[i][j] = i == j ? sqrt(s) : s / a[j][j];
		}
	}
	for (int i = 0; i < TERMS; i++) {
		for (int k = 0; k < i; k++)
			b[i] -= a[i][k] * b[k];
		b[i] /= a[i][i];
	}
	for (int i = TERMS; i-- > 0;) {
		for (int k = i + 1; k < TERMS; k++)
			b[i] -= a[k][i] * b[k];
		b[i] /= a[i][i];
	}
	return true;
}

/* Coefficients of 1 x y xx rxy yy, r the root of 2: the norm of the last three is that of their matrix. */
static void
row_at(double x, double y, double row[TERMS])
{
	memcpy(row, (double[TERMS]){ 1, x, y, x * x, sqrt(2) * x * y, y * y }, TERMS * sizeof *row);
}

/* The quadric of least squares through n heights t; the quadratic terms shrink a little, which keeps the
 * system definite. */
static bool
fit(const double *row, const double *t, size_t n, double coefficient[TERMS])
{
	double a[TERMS][TERMS] = { { 0 } };

	memset(coefficient, 0, TERMS * sizeof *coefficient);
	for (size_t k = 0; k < n; k++)
		for (int i = 0; i < TERMS; i++) {
			const double *x = row + k * TERMS;
			coefficient[i] += x[i] * t[k];
			for (int j = 0; j <= i; j++)
				a[i][j] += x[i] * x[j];
		}
	for (int i = 1; i < TERMS; i++)
		a[i][i] += (i < 3 ? 1e-6 : 1e-3) * (double)n;
	return solve(a, coefficient);
}

double
mr_quadric_residuals(const mr_v3 *q, size_t k, double *off)
{
	double a[6], value[3], row[MR_QUADRIC_POINTS * TERMS], t[MR_QUADRIC_POINTS];
	double z[TERMS], radius2 = 0, radius, sum = 0;
	mr_v3 axis[3], mean = mr_vec(0, 0, 0);

	if (k <= TERMS)
		return 0;
	for (size_t i = 0; i < k; i++)
		mean = mr_axpy(1 / (double)k, q[i], mean);
	for (size_t i = 0; i < k; i++)
		radius2 = fmax(radius2, mr_norm2(mr_sub(q[i], mean)));
	radius = sqrt(radius2);
	mr_covariance(q, k, 1 / radius, a);
	mr_eigen_sym3(a, value, axis);
	for (size_t i = 0; i < k; i++) {
		mr_v3 d = mr_mul(1 / radius, mr_sub(q[i], mean));
		double x = mr_dot(d, axis[2]), y = mr_dot(d, axis[1]);
		row_at(x, y, row + i * TERMS);
		t[i] = mr_dot(d, axis[0]);
	}
	if (!fit(row, t, k, z))
		return 0;
	for (size_t i = 0; i < k; i++) {
		off[i] = radius * t[i];
		for (int j = 0; j < TERMS; j++)
			off[i] -= radius * z[j] * row[i * TERMS + (size_t)j];
		sum += off[i] * off[i];
	}
	return sqrt(sum / (double)(k - TERMS));
}
