/* Weighted least squares by the normal equations, of which there are six. */
#include "space/local_quadric.h"

#include <math.h>
#include <string.h>

enum { TERMS = MR_QUADRIC_TERMS };

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

void
mr_quadric_row(double x, double y, double row[TERMS])
{
	memcpy(row, (double[TERMS]){ 1, x, y, x * x, sqrt(2) * x * y, y * y }, TERMS * sizeof *row);
}

bool
mr_quadric_fit(const double *row, const double *t, const double *weight, size_t n, double coefficient[TERMS])
{
	double a[TERMS][TERMS] = { { 0 } }, b[TERMS] = { 0 }, sum = 0;

	for (size_t k = 0; k < n; k++) {
		const double *x = row + k * TERMS;
		double w = weight[k];
		sum += w;
		for (int i = 0; i < TERMS; i++) {
			b[i] += w * x[i] * t[k];
			for (int j = 0; j <= i; j++)
				a[i][j] += w * x[i] * x[j];
		}
	}
	for (int i = 1; i < TERMS; i++)
		a[i][i] += (i < 3 ? 1e-6 : 1e-3) * sum;
	if (!(sum > 0) || !solve(a, b))
		return false;
	memcpy(coefficient, b, sizeof b);
	return true;
}
