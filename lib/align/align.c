/* Rigid alignment: of many guesses those that bring most points onto the other side, and of these, drawn near
 * by points to planes, the one on which most points lie. */
#include "align/pairs.h"

#include "base/parallel.h"
#include "base/random.h"

enum { GUESSES = 8000, SHOWN = 128, TRIED = 24, DRAWN = 500, JUDGED = 1500, ROUNDS = 12, LAST = 60 };

/* Guesses that turn each other's points by less than this many steps are one. */
static const double SAME = 6;

/* A motion is sure if no other place comes this close to its score.  Of 295 pairs of scans that have 40 or 60
 * % in common, 47 are elsewhere: 3 of them are sure at 0.2, and 5 at 0.18. */
static const double BETTER = 0.2;

/* ---- guesses ---- */

/* Two points with normals of like features fix a motion (Drost et al. 2010; Fischler, Bolles 1981). */
enum { KEYS = 1000, ALIKE = 3, TRIALS = 2000000 };

/* Two pairs are alike where lengths differ by so many steps, and cosines of normals by so much. */
static const double STEPS_OFF = 2, COSINE_OFF = 0.25;

/* Points closer than that, in steps, do not fix a motion. */
static const double APART = 8;

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

typedef struct candidate {
	mr_affine map;
	double score;
} candidate;

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

/* How the points of a may lie on b, at most GUESSES; how many. */
static size_t
guess_motions(mr_ctx *ctx, const model *a, const model *b, candidate *c)
{
	MR_SCOPE(ctx);
	size_t keys = a->sparse.n < KEYS ? a->sparse.n : KEYS, n = keys * ALIKE, got = 0;
	matching w = { a, b, keys, MR_NEW(ctx, n, match) };
	mr_random r = { 1 };

	mr_parallel(ctx, keys, 16, find_matches, &w);
	for (size_t i = 0; i < TRIALS && got < GUESSES; i++) {
		size_t x = mr_random_bits(&r) % n, y = mr_random_bits(&r) % n;
		got += fit_pair(a, b, w.match[x], w.match[y], &c[got].map);
	}
	return got;
}

static int
compare_scores(const void *a, const void *b)
{
	const candidate *x = a, *y = b;

	return (x->score < y->score) - (x->score > y->score);
}

/* Whether two maps bring points of the unit box to about the same places. */
static bool
is_same(const mr_affine *x, const mr_affine *y)
{
	for (int i = 0; i < 8; i++) {
		mr_v3 corner = mr_vec(i & 1 ? 0.3 : -0.3, i & 2 ? 0.3 : -0.3, i & 4 ? 0.3 : -0.3);
		if (mr_dist(mr_apply(x, corner), mr_apply(y, corner)) > SAME * STEP)
			return false;
	}
	return true;
}

/* Scores the guesses and brings the best, each of another place, to the front. */
static mr_status
choose(mr_ctx *ctx, const model *a, const model *b, bool oriented, candidate *c, size_t n, size_t *chosen)
{
	pairing w = mr_align_pairing(ctx, &a->sparse, &b->sparse, &b->sparse, oriented, SHOWN);
	size_t kept = 0;

	for (size_t i = 0; i < n; i++) {
		MR_TRY(mr_align_pair(ctx, &w, false, &c[i].map));
		c[i].score = mr_align_score(&w, 3 * STEP, 2 * STEP);
	}
	qsort(c, n, sizeof *c, compare_scores);
	for (size_t i = 0; i < n && kept < TRIED; i++) {
		size_t k = 0;
		while (k < kept && !is_same(&c[i].map, &c[k].map))
			k++;
		if (k == kept)
			c[kept++] = c[i];
	}
	*chosen = kept;
	return MR_OK;
}

/* ---- all of it ---- */

/* Aligns one side with the other. */
static mr_status
draw_near(
    mr_ctx *ctx, pairing *w, double from, double to, size_t rounds, bool scale, mr_affine *map, drawn *d)
{
	mr_affine pose[2] = { mr_identity(), *map };

	MR_TRY(mr_align_draw_near(ctx, w, 1, pose, 2, from, to, rounds, scale, d));
	*map = pose[1];
	return MR_OK;
}

/* How well both sides agree on a motion, seen from either. */
static mr_status
judge(mr_ctx *ctx, pairing both[2], candidate *c)
{
	mr_affine back = mr_align_inverse(&c->map);
	double there, here;

	MR_TRY(mr_align_agreement(ctx, &both[0], &c->map, &there));
	MR_TRY(mr_align_agreement(ctx, &both[1], &back, &here));
	c->score = (there + here) / 2;
	return MR_OK;
}

mr_status
mr_align_find(mr_ctx *ctx, const model *a, const model *b, bool scale, mr_align_result *r, mr_affine *map)
{
	bool oriented = a->oriented && b->oriented;
	candidate *c = MR_NEW(ctx, GUESSES, candidate);
	pairing few = mr_align_pairing(ctx, &a->sparse, &b->sparse, &b->sparse, oriented, DRAWN);
	pairing both[2] = { mr_align_pairing(ctx, &a->sparse, &b->sparse, &b->sparse, oriented, JUDGED),
		mr_align_pairing(ctx, &b->sparse, &a->sparse, &a->sparse, oriented, JUDGED) };
	pairing all = mr_align_pairing(ctx, &a->dense, &b->dense, &b->sparse, oriented, a->dense.n);
	size_t n = guess_motions(ctx, a, b, c);
	drawn d;

	MR_TRY(choose(ctx, a, b, oriented, c, n, &n));
	if (n == 0)
		return MR_OK;
	for (size_t i = 0; i < n; i++) {
		MR_TRY(draw_near(ctx, &few, 3 * STEP, 1.5 * STEP, ROUNDS, scale, &c[i].map, &d));
		MR_TRY(judge(ctx, both, &c[i]));
	}
	qsort(c, n, sizeof *c, compare_scores);
	for (size_t i = 1; i < n && r->second == 0; i++)
		r->second = is_same(&c[0].map, &c[i].map) ? 0 : c[i].score;
	MR_TRY(draw_near(ctx, &all, 1.5 * STEP, 1 * STEP, LAST, scale, &c[0].map, &d));
	MR_TRY(judge(ctx, both, &c[0]));
	*map = c[0].map;
	r->score = c[0].score;
	r->overlap = d.share;
	r->residual = d.rms;
	r->found = r->score > 0;
	r->sure = r->score - r->second > BETTER;
	return MR_OK;
}

void
mr_align_put_map(const model *a, const model *b, const mr_affine *map, mr_align_result *r)
{
	double s = b->unit / a->unit;
	mr_affine out = *map;
	mr_mat3 l = mr_affine_linear(map);

	for (int i = 0; i < 12; i++)
		out.m[i] *= i % 4 == 3 ? b->unit : s;
	mr_v3 t = mr_add(mr_vec(out.m[3], out.m[7], out.m[11]), b->middle);
	l = mr_affine_linear(&out);
	t = mr_sub(t, mr_mat3_apply(&l, a->middle));
	out.m[3] = t.x;
	out.m[7] = t.y;
	out.m[11] = t.z;
	memcpy(r->map, out.m, sizeof r->map);
	r->scale = cbrt(mr_mat3_determinant(&l));
	r->residual *= b->unit;
}

mr_status
mr_align_diagonal(mr_ctx *ctx, mr_align_side s, double *diagonal)
{
	*diagonal = mr_box_diagonal(mr_box_of(s.m->p, s.m->nv));
	return *diagonal > 0 ? MR_OK : mr_fail(ctx, MR_EMESH, "%s: all points are at one place", s.m->name);
}

mr_status
mr_align(mr_ctx *ctx, mr_align_side a, mr_align_side b, bool scale, mr_align_result *r)
{
	MR_SCOPE(ctx);
	double of_a, of_b, unit;
	mr_align_result found = { 0 };
	model from, to;
	mr_affine map = mr_identity();

	MR_TRY(mr_align_diagonal(ctx, a, &of_a));
	MR_TRY(mr_align_diagonal(ctx, b, &of_b));
	unit = mr_align_unit(fmin(of_a, of_b), fmax(of_a, of_b));
	MR_TRY(mr_align_model(ctx, a, scale ? of_a : unit, &from));
	MR_TRY(mr_align_model(ctx, b, scale ? of_b : unit, &to));
	MR_TRY(mr_align_features(ctx, from.oriented && to.oriented, &from));
	MR_TRY(mr_align_features(ctx, from.oriented && to.oriented, &to));
	MR_TRY(mr_align_find(ctx, &from, &to, scale, &found, &map));
	mr_align_put_map(&from, &to, &map, &found);
	*r = found;
	return MR_OK;
}

mr_status
mr_align_judge(mr_ctx *ctx, const mr_mesh *a, const mr_mesh *b, const mr_comparison *apart)
{
	MR_SCOPE(ctx);
	const double far = 0.01; /* of the diagonal */
	mr_compare_opts o = MR_COMPARE_DEFAULTS;
	mr_v3 *p = MR_NEW(ctx, a->nv, mr_v3);
	mr_mesh moved = { a->name, p, a->t, a->nv, a->nf };
	mr_align_result r;
	mr_comparison c;
	mr_affine map;

	if (!ctx->listener.found || apart->both.mean < far * apart->diagonal ||
	    mr_align(ctx, (mr_align_side){ a, NULL }, (mr_align_side){ b, NULL }, false, &r) < 0 || !r.found)
		return MR_OK;
	o.vertices_only = true;
	memcpy(map.m, r.map, sizeof map.m);
	for (size_t i = 0; i < a->nv; i++)
		p[i] = mr_apply(&map, a->p[i]);
	MR_TRY(mr_compare(ctx, &moved, b, &o, &c));
	if (4 * c.both.mean < apart->both.mean)
		mr_found(ctx, &(mr_finding){ .kind = MR_UNALIGNED,
				  .layer = a->name,
				  .what = "a rigid motion brings it four times nearer: mr-align finds it" });
	return MR_OK;
}
