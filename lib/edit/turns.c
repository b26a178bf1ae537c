/* Deformation gradients of faces with their normals (Sumner, Popovic 2004), weighted by area and smoothed.
 * With x1, x2 two sides, n the normal, A twice the area at rest, y1, y2, m those now: A F = y1 (x2 x n)^T +
 * y2 (n x x1)^T + A m n^T. */
#include "edit/turns.h"

#include "base/parallel.h"
#include "base/vectors.h"

enum { AREA = 9, LANES = 8, SOON = 16 };

/* Some faces side by side: the coordinates of their corners at rest and now, and their turns. */
typedef struct lanes {
	double x[9][LANES], y[9][LANES], out[10][LANES];
} lanes;

static MR_INLINED mr_v3
side(double p[9][LANES], int corner, int lane)
{
	double(*q)[LANES] = p + 3 * corner;

	return mr_vec(q[0][lane] - p[0][lane], q[1][lane] - p[1][lane], q[2][lane] - p[2][lane]);
}

static MR_INLINED void
put_row(lanes *f, int lane, int row, mr_v3 sum)
{
	f->out[3 * row][lane] = sum.x;
	f->out[3 * row + 1][lane] = sum.y;
	f->out[3 * row + 2][lane] = sum.z;
}

/* A (F - 1), and A; 0 of a face without area. */
static MR_INLINED void
turn_lanes(lanes *f, double unit)
{
	for (int i = 0; i < LANES; i++) {
		mr_v3 x1 = side(f->x, 1, i), x2 = side(f->x, 2, i), y1 = side(f->y, 1, i),
		      y2 = side(f->y, 2, i);
		mr_v3 n = mr_cross(x1, x2), m = mr_cross(y1, y2), b1 = mr_sub(y1, x1), b2 = mr_sub(y2, x2);
		double area = mr_norm(n);
		mr_v3 scaled = mr_mul(area > 0 ? unit / area : 0, n), b3 = mr_sub(m, n);
		mr_v3 a1 = mr_cross(x2, scaled), a2 = mr_cross(scaled, x1);
		put_row(f, i, 0, mr_axpy(b3.x, scaled, mr_axpy(b2.x, a2, mr_mul(b1.x, a1))));
		put_row(f, i, 1, mr_axpy(b3.y, scaled, mr_axpy(b2.y, a2, mr_mul(b1.y, a1))));
		put_row(f, i, 2, mr_axpy(b3.z, scaled, mr_axpy(b2.z, a2, mr_mul(b1.z, a1))));
		f->out[AREA][i] = unit * area;
	}
}

static MR_INLINED void
add_turn(mr_turn *sum, const mr_turn *t)
{
	for (int i = 0; i < 10; i++)
		sum->sum[i] += t->sum[i];
}

static MR_INLINED void
add_to_corners(mr_turn *to, const uint32_t v[3], const mr_turn *t)
{
	for (int k = 0; k < 3; k++)
		add_turn(&to[v[k]], t);
}

/* A pass over faces. */
typedef struct pass {
	const mr_mesh *rest;
	const mr_v3 *now;
	double unit; /* of inverse areas */
	const mr_turn *from;
	mr_turn *to; /* of the vertices */
} pass;

/* To each vertex the turns of its faces. */
MR_VECTORS static void
give_faces(void *arg, const mr_tri *t, size_t n)
{
	const pass *w = arg;
	lanes s;

	for (size_t first = 0; first < n; first += LANES) {
		size_t count = n - first < LANES ? n - first : LANES;
		for (size_t i = 0; i < LANES; i++) {
			const uint32_t *v = t[first + (i < count ? i : 0)].v;
			const uint32_t *soon = t[first + i + SOON < n ? first + i + SOON : 0].v;
			mr_soon(w->rest->p, sizeof *w->now, soon);
			mr_soon(w->now, sizeof *w->now, soon);
			mr_soon(w->to, sizeof *w->to, soon);
			for (int k = 0; k < 3; k++) {
				mr_v3 x = w->rest->p[v[k]], y = w->now[v[k]];
				s.x[3 * k][i] = x.x;
				s.x[3 * k + 1][i] = x.y;
				s.x[3 * k + 2][i] = x.z;
				s.y[3 * k][i] = y.x;
				s.y[3 * k + 1][i] = y.y;
				s.y[3 * k + 2][i] = y.z;
			}
		}
		turn_lanes(&s, w->unit);
		for (size_t i = 0; i < count; i++) {
			mr_turn turn;
			for (int k = 0; k < 10; k++)
				turn.sum[k] = s.out[k][i];
			add_to_corners(w->to, t[first + i].v, &turn);
		}
	}
}

/* To each vertex those at the corners of its faces. */
MR_VECTORS static void
give_rings(void *arg, const mr_tri *t, size_t n)
{
	const pass *w = arg;

	for (size_t i = 0; i < n; i++) {
		const uint32_t *v = t[i].v;
		const uint32_t *soon = t[i + SOON < n ? i + SOON : i].v;
		mr_turn s = w->from[v[0]];
		mr_soon(w->from, sizeof *w->from, soon);
		mr_soon(w->to, sizeof *w->to, soon);
		add_turn(&s, &w->from[v[1]]);
		add_turn(&s, &w->from[v[2]]);
		add_to_corners(w->to, v, &s);
	}
}

static void
clear(void *arg, size_t begin, size_t end)
{
	const pass *w = arg;

	memset(w->to + begin, 0, (end - begin) * sizeof *w->to);
}

const mr_turn *
mr_turns(mr_ctx *ctx, const mr_mesh *rest, const mr_scatter *scatter, const mr_v3 *now)
{
	/* 99 models bent, twisted and pulled: 150 folds and 2,587 pairs with 2, 139 and 2,523 with 3, 124 and
	 * 2,411 with 5, 118 and 2,444 with 10 */
	enum { PASSES = 2, GRAIN = 4096 };
	double size = mr_box_diagonal(mr_box_of(rest->p, rest->nv));
	mr_turn *turn[2] = { MR_NEW(ctx, rest->nv, mr_turn), MR_NEW(ctx, rest->nv, mr_turn) };
	pass w = { .rest = rest, .now = now, .unit = 1 / (size * size) };

	for (int i = 0; i <= PASSES; i++) {
		w.from = turn[(i + 1) % 2];
		w.to = turn[i % 2];
		mr_parallel(ctx, rest->nv, GRAIN, clear, &w);
		mr_scatter_run(ctx, scatter, i > 0 ? give_rings : give_faces, &w);
	}
	return w.to;
}

/* f F / A */
static mr_mat3
gradient_of(const mr_turn *t, double f)
{
	double share = t->sum[AREA] > 0 ? f / t->sum[AREA] : 0;
	mr_mat3 m = { { f, 0, 0, 0, f, 0, 0, 0, f } };

	for (int i = 0; i < 9; i++)
		m.m[i] += share * t->sum[i];
	return m;
}

/* Normals go as the cross products of tangents do: by the cofactors. */
mr_v3
mr_turn_normal(const mr_turn *turn, mr_v3 n)
{
	const double clear = 1e-3;
	mr_mat3 g = gradient_of(turn, 1), r;
	const double *m = g.m;
	mr_v3 x = mr_vec(m[0], m[3], m[6]), y = mr_vec(m[1], m[4], m[7]), z = mr_vec(m[2], m[5], m[8]);
	mr_v3 to = mr_axpy(n.x, mr_cross(y, z), mr_axpy(n.y, mr_cross(z, x), mr_mul(n.z, mr_cross(x, y))));

	if (mr_norm2(to) > clear && mr_norm2(to) < 1 / clear)
		return mr_unit(to);
	r = mr_rotation_nearest(&g);
	return mr_mat3_apply(&r, n);
}

mr_mat3
mr_turn_rotation(const mr_turn *turn, const uint32_t v[3], mr_v3 bary)
{
	const double w[3] = { bary.x, bary.y, bary.z };
	mr_mat3 sum = { { 0 } };

	for (int k = 0; k < 3; k++) {
		mr_mat3 g = gradient_of(&turn[v[k]], w[k]);
		sum = mr_mat3_axpy(1, &g, &sum);
	}
	return mr_rotation_nearest(&sum);
}
