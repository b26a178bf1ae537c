/* Points to planes (Chen, Medioni 1992), with the planes by the sum of both normals (Rusinkiewicz 2019), of
 * any number of sides at once (Neugebauer 1997); Tukey's weights trim what has no partner. */
#include "align/pairs.h"

#include "base/sort.h"

enum { UNKNOWNS = 7 };

/* Cosine of normals of points that may be partners. */
static const double COSINE = 0.7;

/* ---- pairs ---- */

pairing
mr_align_pairing(
    mr_ctx *ctx, const samples *a, const samples *b, const samples *cells, bool oriented, size_t n)
{
	n = n < a->n ? n : a->n;
	return (pairing){ a, b, cells, 1, 0, oriented, n, MR_NEW(ctx, n, mr_v3), MR_NEW(ctx, n, mr_v3),
		MR_NEW(ctx, n, uint32_t), MR_NEW(ctx, n, mr_v3), MR_NEW(ctx, n, uint32_t),
		MR_NEW(ctx, n, uint32_t) };
}

mr_status
mr_align_pair(mr_ctx *ctx, pairing *w, bool exactly, const mr_affine *map)
{
	mr_mat3 turn = mr_affine_linear(map);
	size_t n = 0;

	for (size_t i = 0; i < w->n; i++) {
		size_t k = i * w->a->n / w->n;
		w->p[i] = mr_apply(map, w->a->p[k]);
		w->normal[i] = mr_unit(mr_mat3_apply(&turn, w->a->normal[k]));
		w->near[i] = mr_align_nearby(w->cells, w->p[i]);
		if (w->near[i] != MR_NONE) {
			w->asked[n] = w->p[i];
			w->of[n++] = (uint32_t)i;
		}
	}
	if (!exactly)
		return MR_OK;
	MR_TRY(mr_near_query(ctx, w->b->near, w->asked, n, 1, w->got, NULL));
	for (size_t k = 0; k < n; k++)
		w->near[w->of[k]] = w->got[k];
	return MR_OK;
}

/* The partner of a point on the other side. */
typedef struct partner {
	mr_v3 plane;   /* its normal, between both */
	double off;    /* from b's point along it */
	double cosine; /* of both normals */
} partner;

/* False where point i has no partner within reach whose side agrees. */
static bool
find_partner(const pairing *w, size_t i, double reach, partner *to)
{
	mr_v3 n, d;

	if (w->near[i] == MR_NONE)
		return false;
	n = w->b->normal[w->near[i]];
	d = mr_sub(w->b->p[w->near[i]], w->p[i]);
	to->cosine = mr_dot(w->normal[i], n);
	if (to->cosine < 0 && !w->oriented) {
		n = mr_mul(-1, n);
		to->cosine = -to->cosine;
	}
	if (to->cosine < COSINE || !(mr_norm2(d) < reach * reach))
		return false;
	to->plane = mr_unit(mr_add(n, w->normal[i]));
	to->off = mr_dot(to->plane, d);
	return true;
}

double
mr_align_score(const pairing *w, double reach, double limit)
{
	double sum = 0;
	partner to;

	for (size_t i = 0; i < w->n; i++)
		if (find_partner(w, i, reach, &to) && fabs(to.off) < limit)
			sum += (1 - mr_square(to.off / limit)) * (to.cosine - COSINE) / (1 - COSINE);
	return sum / (double)w->n;
}

mr_status
mr_align_agreement(mr_ctx *ctx, pairing *w, const mr_affine *map, double *share)
{
	enum { AGAINST = 2 };
	const double near = 8 * STEP;
	size_t off = 0;

	MR_TRY(mr_align_pair(ctx, w, false, map));
	MR_TRY(mr_near_query(ctx, w->b->near, w->p, w->n, 1, w->near, NULL));
	for (size_t i = 0; i < w->n; i++) {
		double d2 = mr_norm2(mr_sub(w->b->p[w->near[i]], w->p[i]));
		off += !w->b->rim[w->near[i]] && d2 > STEP * STEP && d2 < near * near;
	}
	*share = mr_align_score(w, STEP, STEP / 2) - AGAINST * (double)off / (double)w->n;
	return MR_OK;
}

/* ---- points to planes ---- */

/* The weighted rows J x = off of the least-squares system. */
typedef struct equations {
	size_t n; /* unknowns */
	double *a, *x;
	double weight, square; /* sums, of the weights and of off^2 */
} equations;

/* A pair as side 0 sees it. */
typedef struct row {
	mr_v3 p, plane;
	double off;
	size_t from, onto;
} row;

/* x = A^-1 b of a positive definite matrix, by Cholesky in place. */
static void
solve(const equations *e)
{
	double *a = e->a, *x = e->x;
	size_t n = e->n;

	for (size_t i = 0; i < n; i++)
		for (size_t j = 0; j <= i; j++) {
			double sum = a[i * n + j];
			for (size_t k = 0; k < j; k++)
				sum -= a[i * n + k] * a[j * n + k];
			a[i * n + j] = i == j ? sqrt(sum) : sum / a[j * n + j];
		}
	for (size_t i = 0; i < n; i++) {
		for (size_t k = 0; k < i; k++)
			x[i] -= a[i * n + k] * x[k];
		x[i] /= a[i * n + i];
	}
	for (size_t i = n; i-- > 0;) {
		for (size_t k = i + 1; k < n; k++)
			x[i] -= a[k * n + i] * x[k];
		x[i] /= a[i * n + i];
	}
}

/* The pairs within reach, not on the rim; how many. */
static size_t
find_rows(const pairing *w, const mr_affine *pose, double reach, row *to)
{
	mr_mat3 turn = mr_affine_linear(&pose[w->onto]);
	size_t n = 0;
	partner with;

	for (size_t i = 0; i < w->n; i++)
		if (find_partner(w, i, reach, &with) && !w->b->rim[w->near[i]] &&
		    !w->a->rim[i * w->a->n / w->n])
			to[n++] = (row){ mr_apply(&pose[w->onto], w->p[i]), mr_mat3_apply(&turn, with.plane),
				with.off, w->from, w->onto };
	return n;
}

/* A block of J^T J, of two sides; side 0 has no unknowns, and what is above the diagonal is not asked for. */
static void
add_block(equations *e, size_t u, size_t v, const double j[UNKNOWNS], double weight)
{
	if (v == 0 || v > u)
		return;
	for (size_t i = 0; i < UNKNOWNS; i++)
		for (size_t k = 0; k < UNKNOWNS; k++)
			e->a[((u - 1) * UNKNOWNS + i) * e->n + (v - 1) * UNKNOWNS + k] += weight * j[i] *
			                                                                  j[k];
}

static void
add_right(equations *e, size_t u, const double j[UNKNOWNS], double weight)
{
	for (size_t i = 0; u && i < UNKNOWNS; i++)
		e->x[(u - 1) * UNKNOWNS + i] += weight * j[i];
}

/* off = J (x of a - x of b) */
static void
add_row(equations *e, const row *r, double weight, bool scale)
{
	mr_v3 turn = mr_cross(r->p, r->plane);
	const double j[UNKNOWNS] = { turn.x, turn.y, turn.z, r->plane.x, r->plane.y, r->plane.z,
		scale ? mr_dot(r->p, r->plane) : 0 };

	add_block(e, r->from, r->from, j, weight);
	add_block(e, r->onto, r->onto, j, weight);
	add_block(e, r->from, r->onto, j, -weight);
	add_block(e, r->onto, r->from, j, -weight);
	add_right(e, r->from, j, weight * r->off);
	add_right(e, r->onto, j, -weight * r->off);
	e->weight += weight;
	e->square += weight * r->off * r->off;
}

/* The motion of seven unknowns, after a pose. */
static void
move(mr_affine *pose, const double x[UNKNOWNS])
{
	mr_mat3 turn = mr_rotation_exp(mr_vec(x[0], x[1], x[2]));
	const double *m = turn.m, s = exp(x[6]);
	mr_affine by = { { s * m[0], s * m[1], s * m[2], x[3], s * m[3], s * m[4], s * m[5], x[4], s * m[6],
	    s * m[7], s * m[8], x[5] } };

	*pose = mr_compose(&by, pose);
}

/* The rows of all pairs within reach, by Tukey's weights. */
static void
add_rows(mr_ctx *ctx, equations *e, const row *r, size_t n, bool scale)
{
	double *size = MR_NEW(ctx, n, double), limit, trace = 0;

	for (size_t k = 0; k < n; k++)
		size[k] = fabs(r[k].off);
	limit = 4.685 * 1.4826 * mr_kth(size, n, n / 2) + 1e-14;
	for (size_t k = 0; k < n; k++) {
		double u = r[k].off / limit;
		add_row(e, &r[k], fabs(u) < 1 ? mr_square(1 - u * u) : 0, scale);
	}
	for (size_t i = 0; i < e->n; i++)
		trace += e->a[i * e->n + i];
	for (size_t i = 0; i < e->n; i++) /* a surface may slide on itself: then it stays */
		e->a[i * e->n + i] += 1e-9 * trace + (i % UNKNOWNS == UNKNOWNS - 1 && !scale ? 1 : 0);
}

/* One step of Gauss and Newton over the pairs within reach. */
static drawn
step(mr_ctx *ctx, const pairing *w, size_t pairings, mr_affine *pose, size_t sides, double reach, bool scale)
{
	MR_SCOPE(ctx);
	equations e = { .n = UNKNOWNS * (sides - 1) };
	size_t n = 0, most = 0;
	double moved = 0;
	row *r;

	for (size_t i = 0; i < pairings; i++)
		most += w[i].n;
	r = MR_NEW(ctx, most, row);
	for (size_t i = 0; i < pairings; i++)
		n += find_rows(&w[i], pose, reach, r + n);
	if (n < e.n)
		return (drawn){ INFINITY, 0, 0 };
	e.a = MR_NEW_ZERO(ctx, e.n * e.n, double);
	e.x = MR_NEW_ZERO(ctx, e.n, double);
	add_rows(ctx, &e, r, n, scale);
	solve(&e);
	for (size_t i = 1; i < sides; i++)
		move(&pose[i], e.x + (i - 1) * UNKNOWNS);
	for (size_t i = 0; i < e.n; i++)
		moved += e.x[i] * e.x[i];
	return (drawn){ sqrt(e.square / e.weight), (double)n / (double)most, sqrt(moved) };
}

mr_affine
mr_align_inverse(const mr_affine *t)
{
	const double *m = t->m, s = m[0] * m[0] + m[1] * m[1] + m[2] * m[2];
	mr_affine back = { { m[0] / s, m[4] / s, m[8] / s, 0, m[1] / s, m[5] / s, m[9] / s, 0, m[2] / s,
	    m[6] / s, m[10] / s, 0 } };
	mr_v3 to = mr_apply(&back, mr_vec(m[3], m[7], m[11]));

	back.m[3] = -to.x;
	back.m[7] = -to.y;
	back.m[11] = -to.z;
	return back;
}

mr_status
mr_align_draw_near(mr_ctx *ctx, pairing *w, size_t pairings, mr_affine *pose, size_t sides, double from,
    double to, size_t rounds, bool scale, drawn *d)
{
	const double rest = 1e-10;

	for (size_t i = 0; i < rounds; i++) {
		double reach = fmax(to, from * pow(0.7, (double)i));
		for (size_t k = 0; k < pairings; k++) {
			mr_affine back = mr_align_inverse(&pose[w[k].onto]),
				  map = mr_compose(&back, &pose[w[k].from]);
			MR_TRY(mr_align_pair(ctx, &w[k], true, &map));
		}
		*d = step(ctx, w, pairings, pose, sides, reach, scale);
		if (!(d->moved > rest) && reach == to)
			break;
	}
	return MR_OK;
}
