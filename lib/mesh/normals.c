/* Each face's rotation is applied to the normals at its corners, and what comes of it is added up. */
#include "mesh/normals.h"

#include "base/parallel.h"
#include "base/rotation.h"

/* The outcome for a face. */
typedef struct turn {
	mr_mat3 rotation;
	double area; /* 0: it says nothing */
	bool moved;
} turn;

typedef struct turning {
	const mr_mesh *m;
	const mr_v3 *p;
	const mr_incidence *around;
	turn *face;
	const mr_v3 *corner; /* normals as they were */
	mr_v3 *to;
} turning;

/* With the edges a, b and the normal n as columns of O, and as they are now of N, that nearest to N O^-1. */
static mr_mat3
nearest_rotation(mr_v3 a, mr_v3 b, mr_v3 now_a, mr_v3 now_b)
{
	mr_v3 n = mr_unit(mr_cross(a, b)), now_n = mr_unit(mr_cross(now_a, now_b));
	mr_mat3 r = { { 0 } };

	mr_mat3_add_product(&r, 1, now_a, mr_cross(b, n));
	mr_mat3_add_product(&r, 1, now_b, mr_cross(n, a));
	mr_mat3_add_product(&r, mr_norm(mr_cross(a, b)), now_n, n);
	return mr_rotation_nearest(&r);
}

static bool
has_moved(const mr_mesh *m, const mr_v3 *p, size_t f)
{
	for (int k = 0; k < 3; k++)
		if (memcmp(&m->p[m->t[f].v[k]], &p[m->t[f].v[k]], sizeof *p))
			return true;
	return false;
}

static void
turn_faces(void *arg, size_t begin, size_t end)
{
	const turning *j = arg;

	for (size_t f = begin; f < end; f++) {
		const uint32_t *v = j->m->t[f].v;
		const mr_v3 *p = j->m->p, *q = j->p;
		mr_v3 a = mr_sub(p[v[1]], p[v[0]]), b = mr_sub(p[v[2]], p[v[0]]);
		mr_v3 now_a = mr_sub(q[v[1]], q[v[0]]), now_b = mr_sub(q[v[2]], q[v[0]]);
		turn *t = &j->face[f];
		*t = (turn){ mr_mat3_identity(), mr_norm(mr_cross(a, b)), has_moved(j->m, q, f) };
		if (!(mr_norm(mr_cross(now_a, now_b)) > 0))
			t->area = 0;
		if (t->area > 0 && t->moved)
			t->rotation = nearest_rotation(a, b, now_a, now_b);
	}
}

/* Sets the normal n of vertex v, or of its corners that share it: the sum's direction, its own length. */
static mr_v3
turned(const turning *j, size_t v, mr_v3 n)
{
	mr_v3 sum = mr_vec(0, 0, 0);
	bool moved = false;

	for (size_t i = j->around->start[v]; i < j->around->start[v + 1]; i++) {
		uint32_t f = j->around->face[i];
		const uint32_t *c = j->m->t[f].v;
		int k = c[0] == v ? 0 : c[1] == v ? 1 : 2;
		if (!(j->face[f].area > 0) ||
		    (j->corner && memcmp(&j->corner[3 * (size_t)f + (size_t)k], &n, sizeof n)))
			continue;
		sum = mr_axpy(j->face[f].area, mr_mat3_apply(&j->face[f].rotation, n), sum);
		moved |= j->face[f].moved;
	}
	sum = mr_mul(mr_norm(n) / mr_norm(sum), sum);
	return moved && mr_finite(sum) ? sum : n;
}

static void
turn_vertices(void *arg, size_t begin, size_t end)
{
	const turning *j = arg;

	for (size_t v = begin; v < end; v++)
		j->to[v] = turned(j, v, j->to[v]);
}

static void
turn_corners(void *arg, size_t begin, size_t end)
{
	const turning *j = arg;

	for (size_t i = begin; i < end; i++)
		j->to[i] = turned(j, j->m->t[i / 3].v[i % 3], j->corner[i]);
}

void
mr_turn_normals(mr_ctx *ctx, const mr_mesh *before, const mr_v3 *p, mr_v3 *normal, mr_v3 *corner)
{
	enum { GRAIN = 1024 };
	MR_SCOPE(ctx);
	turning j = { before, p, NULL, MR_NEW(ctx, before->nf, turn), NULL, normal };
	mr_incidence around;
	mr_v3 *was;

	mr_incidence_build(ctx, before, &around);
	j.around = &around;
	mr_parallel(ctx, before->nf, GRAIN, turn_faces, &j);
	if (normal)
		mr_parallel(ctx, before->nv, GRAIN, turn_vertices, &j);
	if (corner) {
		was = MR_NEW(ctx, 3 * before->nf, mr_v3);
		memcpy(was, corner, 3 * before->nf * sizeof *was);
		j.corner = was;
		j.to = corner;
		mr_parallel(ctx, 3 * before->nf, GRAIN, turn_corners, &j);
	}
}
