/*
 * Deformation gradients of faces with their normals (Sumner, Popovic 2004: Deformation transfer for triangle
 * meshes), weighted by area and smoothed.  With x1, x2 two sides, n the normal and A twice the area at rest,
 * y1, y2 and m those now, A F = y1 (x2 x n)^T + y2 (n x x1)^T + A m n^T.
 */
#include "edit/turns.h"

#include "base/parallel.h"
#include "base/vectors.h"

enum { GRAIN = 1024, AREA = 9 };

typedef struct turning {
	const mr_mesh *rest, *now;
	const mr_incidence *inc;
	const mr_turn *from;
	mr_turn *to;
	double unit; /* of areas */
} turning;

/* d += y x^T */
static MR_INLINED void
add_product(double d[9], mr_v3 y, mr_v3 x)
{
	const double row[3] = { y.x, y.y, y.z };

	for (int i = 0; i < 3; i++) {
		d[3 * i] += row[i] * x.x;
		d[3 * i + 1] += row[i] * x.y;
		d[3 * i + 2] += row[i] * x.z;
	}
}

/* A (F - 1), and A. */
static MR_INLINED mr_turn
turn_of_face(const mr_mesh *rest, const mr_mesh *now, const uint32_t v[3], double unit)
{
	mr_v3 x1 = mr_sub(rest->p[v[1]], rest->p[v[0]]), x2 = mr_sub(rest->p[v[2]], rest->p[v[0]]);
	mr_v3 y1 = mr_sub(now->p[v[1]], now->p[v[0]]), y2 = mr_sub(now->p[v[2]], now->p[v[0]]);
	mr_v3 n = mr_cross(x1, x2), m = mr_cross(y1, y2), scaled;
	double area = mr_norm(n);
	mr_turn t = { { 0 } };

	if (!(area > 0))
		return t;
	scaled = mr_mul(unit / area, n);
	add_product(t.sum, mr_sub(y1, x1), mr_cross(x2, scaled));
	add_product(t.sum, mr_sub(y2, x2), mr_cross(scaled, x1));
	add_product(t.sum, mr_sub(m, n), scaled);
	t.sum[AREA] = unit * area;
	return t;
}

MR_VECTORS static void
faces_from_places(void *arg, size_t begin, size_t end)
{
	const turning *t = arg;

	for (size_t f = begin; f < end; f++)
		t->to[f] = turn_of_face(t->rest, t->now, t->rest->t[f].v, t->unit);
}

static MR_INLINED void
add_turn(mr_turn *sum, const mr_turn *t)
{
	for (int i = 0; i < 10; i++)
		sum->sum[i] += t->sum[i];
}

MR_VECTORS static void
vertices_from_faces(void *arg, size_t begin, size_t end)
{
	const turning *t = arg;

	for (size_t v = begin; v < end; v++) {
		mr_turn s = { { 0 } };
		for (size_t i = t->inc->start[v]; i < t->inc->start[v + 1]; i++)
			add_turn(&s, &t->from[t->inc->face[i]]);
		t->to[v] = s;
	}
}

/* By the sums of faces' corners. */
MR_VECTORS static void
vertices_from_vertices(void *arg, size_t begin, size_t end)
{
	const turning *t = arg;

	for (size_t v = begin; v < end; v++) {
		mr_turn s = { { 0 } };
		for (size_t i = t->inc->start[v]; i < t->inc->start[v + 1]; i++) {
			const uint32_t *corner = t->rest->t[t->inc->face[i]].v;
			mr_turn f = t->from[corner[0]];
			add_turn(&f, &t->from[corner[1]]);
			add_turn(&f, &t->from[corner[2]]);
			add_turn(&s, &f);
		}
		t->to[v] = s;
	}
}

const mr_turn *
mr_turns(mr_ctx *ctx, const mr_mesh *rest, const mr_mesh *now, const mr_incidence *inc)
{
	/* 99 models bent, twisted and pulled: 150 folds and 2,587 pairs with 2, 139 and 2,523 with 3, 124 and
	 * 2,411 with 5, 118 and 2,444 with 10 */
	enum { PASSES = 2 };
	double size = mr_box_diagonal(mr_box_of(rest->p, rest->nv));
	turning t = { rest, now, inc, NULL, NULL, 1 / (size * size) };
	mr_turn *vertex = MR_NEW(ctx, rest->nv, mr_turn), *other;
	mr_mark mark = mr_mark_take(ctx);

	t.to = other = MR_NEW(ctx, rest->nf > rest->nv ? rest->nf : rest->nv, mr_turn);
	mr_parallel(ctx, rest->nf, GRAIN, faces_from_places, &t);
	t.from = other;
	t.to = vertex;
	mr_parallel(ctx, rest->nv, GRAIN, vertices_from_faces, &t);
	for (int i = 0; i < PASSES; i++) { /* an even number, so that the last is to `vertex` */
		t.from = i % 2 ? other : vertex;
		t.to = i % 2 ? vertex : other;
		mr_parallel(ctx, rest->nv, GRAIN, vertices_from_vertices, &t);
	}
	mr_mark_release(ctx, mark);
	return vertex;
}

/* f F / A */
static mr_mat3
gradient_of(const mr_turn *t, double f)
{
	mr_mat3 m = { { f, 0, 0, 0, f, 0, 0, 0, f } };

	for (int i = 0; i < 9 && t->sum[AREA] > 0; i++)
		m.m[i] += f * t->sum[i] / t->sum[AREA];
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
