/* Where one side may lie on the other: two points with normals fix a motion (Drost, Ulrich, Navab, Ilic 2010;
 * Fischler, Bolles 1981). */
#include "align/model.h"

#include "base/parallel.h"
#include "base/random.h"

enum { KEYS = 1000, ALIKE = 3, TRIALS = 2000000 };

/* Two pairs are alike where lengths differ by so many steps, and cosines of normals by so much. */
static const double STEPS_OFF = 2, COSINE_OFF = 0.25;

/* Points closer than that, in steps, do not fix a motion. */
static const double APART = 8;

/* ---- points of like features ---- */

typedef struct match {
	uint32_t a, b;
} match;

typedef struct matching {
	const model *a, *b;
	size_t keys;
	match *match; /* ALIKE of each key */
} matching;

static float
difference(const float *x, const float *y)
{
	float sum = 0;

	for (int c = 0; c < FEATURE; c++)
		sum += (x[c] - y[c]) * (x[c] - y[c]);
	return sum;
}

static void
find_matches(void *arg, size_t begin, size_t end)
{
	matching *w = arg;

	for (size_t k = begin; k < end; k++) {
		size_t a = k * w->a->sparse.n / w->keys;
		match *to = w->match + k * ALIKE;
		float best[ALIKE];
		for (int i = 0; i < ALIKE; i++) {
			best[i] = INFINITY;
			to[i] = (match){ (uint32_t)a, 0 };
		}
		for (size_t b = 0; b < w->b->sparse.n; b++) {
			float d = difference(w->a->feature[a], w->b->feature[b]);
			int i = ALIKE;
			for (; i > 0 && d < best[i - 1]; i--)
				if (i < ALIKE) {
					best[i] = best[i - 1];
					to[i].b = to[i - 1].b;
				}
			if (i < ALIKE) {
				best[i] = d;
				to[i].b = (uint32_t)b;
			}
		}
	}
}

/* ---- motions ---- */

static mr_affine
motion(const mr_mat3 *r, mr_v3 from, mr_v3 to)
{
	mr_v3 t = mr_sub(to, mr_mat3_apply(r, from));
	const double *m = r->m;

	return (mr_affine){ { m[0], m[1], m[2], t.x, m[3], m[4], m[5], t.y, m[6], m[7], m[8], t.z } };
}

static bool
differ(mr_v3 x, mr_v3 y, mr_v3 u, mr_v3 v)
{
	return fabs(mr_dot(x, y) - mr_dot(u, v)) > COSINE_OFF;
}

/* The motion that brings two points of a with their normals to those of b; false where they are not alike. */
static bool
fit_pair(const model *a, const model *b, match x, match y, mr_affine *t)
{
	const mr_v3 *p = a->sparse.p, *q = b->sparse.p;
	mr_v3 da = mr_sub(p[y.a], p[x.a]), db = mr_sub(q[y.b], q[x.b]);
	mr_v3 nx = a->sparse.normal[x.a], ny = a->sparse.normal[y.a];
	mr_v3 mx = b->sparse.normal[x.b], my = b->sparse.normal[y.b];
	double la = mr_norm(da), lb = mr_norm(db);
	mr_mat3 sum = { { 0 } };

	if (la < APART * STEP || fabs(la - lb) > STEPS_OFF * STEP || lb == 0)
		return false;
	da = mr_mul(1 / la, da);
	db = mr_mul(1 / lb, db);
	if (differ(nx, ny, mx, my) || differ(nx, da, mx, db) || differ(ny, da, my, db))
		return false;
	mr_mat3_add_product(&sum, 2, db, da);
	mr_mat3_add_product(&sum, 1, mx, nx);
	mr_mat3_add_product(&sum, 1, my, ny);
	sum = mr_rotation_nearest(&sum);
	*t = motion(&sum, mr_lerp(0.5, p[x.a], p[y.a]), mr_lerp(0.5, q[x.b], q[y.b]));
	return true;
}

mr_status
mr_align_guess(mr_ctx *ctx, const model *a, const model *b, size_t most, mr_affine *guess, size_t *found)
{
	MR_SCOPE(ctx);
	size_t keys = a->sparse.n < KEYS ? a->sparse.n : KEYS, n = keys * ALIKE, got = 0;
	matching w = { a, b, keys, MR_NEW(ctx, n, match) };
	mr_random r = { 1 };

	mr_parallel(ctx, keys, 16, find_matches, &w);
	for (size_t i = 0; i < TRIALS && got < most; i++) {
		size_t x = mr_random_bits(&r) % n, y = mr_random_bits(&r) % n;
		got += fit_pair(a, b, w.match[x], w.match[y], &guess[got]);
	}
	*found = got;
	return MR_OK;
}
