/*
 * How a base turns around each of its vertices while it is dragged: lib/edit/turns.c in single precision,
 * four at a time, each rotation found from the one before; and the detail on it, lib/edit/detail.c.  Places
 * are doubles: edges are small beside them.
 */
#include "formats/page/library/turning.h"

enum { STEPS = 12 };

/* Of the last step, in radians, squared: the next would be its square. */
static const float NEAR = 1e-7f;

static v4
cross(v4 a, v4 b)
{
	v4 c = a * __builtin_shufflevector(b, b, 1, 2, 0, 3) - __builtin_shufflevector(a, a, 1, 2, 0, 3) * b;

	return __builtin_shufflevector(c, c, 1, 2, 0, 3);
}

/* Adds what each face, now at p, gives to the sums of y x^T of its corners: of its sides y1, y2 and its
 * normal n y1 r1^T + y2 r2^T + n r3^T, where r1, r2, r3 are of the face at rest. */
static void
add_faces(const mr_turning *t, const d4 *p, mat *sum)
{
	for (size_t f = 0; f < t->nf; f++) {
		const uint32_t *c = t->t[f].v;
		const d4 b = p[c[1]];
		const v4 u = __builtin_convertvector(b - p[c[0]], v4),
			 v = __builtin_convertvector(p[c[2]] - b, v4);
		const v4 n = cross(u, v);
		const float *r = t->rest[f];
		const mat s = { u * r[0] + v * r[3] + n * r[6], u * r[1] + v * r[4] + n * r[7],
			u * r[2] + v * r[5] + n * r[8] };
		for (int k = 0; k < 3; k++) {
			mat *to = &sum[c[k]];
			to->x += s.x;
			to->y += s.y;
			to->z += s.z;
		}
	}
}

/* Of each vertex the sums of the faces around it, which are those of their corners. */
static void
smooth(const mr_turning *t, const mat *sum, mat *out)
{
	for (size_t v = 0; v < t->nv; v++) {
		mat s = { { 0 }, { 0 }, { 0 } };
		for (size_t j = t->around.start[v]; j < t->around.start[v + 1]; j++) {
			const mat *m = &sum[t->around.adj[j]];
			const float w = t->weight[j];
			s.x += w * m->x;
			s.y += w * m->y;
			s.z += w * m->z;
		}
		out[v] = s;
	}
}

/* a where the mask is set, else b */
static v4
choose(m4 mask, v4 a, v4 b)
{
	return (v4)((mask & (m4)a) | (~mask & (m4)b));
}

static v4
root(v4 a)
{
	v4 r = { __builtin_sqrtf(a[0]), __builtin_sqrtf(a[1]), __builtin_sqrtf(a[2]), __builtin_sqrtf(a[3]) };

	return r;
}

/* Four vectors, of each a component a row. */
static void
transpose(v4 a, v4 b, v4 c, v4 d, v4 out[4])
{
	v4 ab = __builtin_shufflevector(a, b, 0, 4, 1, 5), cd = __builtin_shufflevector(c, d, 0, 4, 1, 5);
	v4 high = __builtin_shufflevector(a, b, 2, 6, 3, 7), low = __builtin_shufflevector(c, d, 2, 6, 3, 7);

	out[0] = __builtin_shufflevector(ab, cd, 0, 1, 4, 5);
	out[1] = __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
	out[2] = __builtin_shufflevector(high, low, 0, 1, 4, 5);
	out[3] = __builtin_shufflevector(high, low, 2, 3, 6, 7);
}

/*
 * One step from the rotations q towards those nearest to the sums S, sx, sy, sz their columns: with K = R^T S
 * the turn w of (tr K - K) w = what K has of no symmetry, twice.  |w|^2; where the matrix is not definite it
 * is not a number.
 */
static v4
step(quat *q, const v4 *sx, const v4 *sy, const v4 *sz)
{
	const v4 w = q->w, x = q->x, y = q->y, z = q->z;
	const v4 r0 = 1 - 2 * (y * y + z * z), r1 = 2 * (x * y - w * z), r2 = 2 * (x * z + w * y);
	const v4 r3 = 2 * (x * y + w * z), r4 = 1 - 2 * (x * x + z * z), r5 = 2 * (y * z - w * x);
	const v4 r6 = 2 * (x * z - w * y), r7 = 2 * (y * z + w * x), r8 = 1 - 2 * (x * x + y * y);
	const v4 k0 = r0 * sx[0] + r3 * sx[1] + r6 * sx[2], k1 = r0 * sy[0] + r3 * sy[1] + r6 * sy[2],
		 k2 = r0 * sz[0] + r3 * sz[1] + r6 * sz[2];
	const v4 k3 = r1 * sx[0] + r4 * sx[1] + r7 * sx[2], k4 = r1 * sy[0] + r4 * sy[1] + r7 * sy[2],
		 k5 = r1 * sz[0] + r4 * sz[1] + r7 * sz[2];
	const v4 k6 = r2 * sx[0] + r5 * sx[1] + r8 * sx[2], k7 = r2 * sy[0] + r5 * sy[1] + r8 * sy[2],
		 k8 = r2 * sz[0] + r5 * sz[1] + r8 * sz[2];
	const v4 a0 = k4 + k8, a4 = k0 + k8, a8 = k0 + k4, a1 = -0.5f * (k1 + k3), a2 = -0.5f * (k2 + k6),
		 a5 = -0.5f * (k5 + k7);
	const v4 b0 = k7 - k5, b1 = k2 - k6, b2 = k3 - k1;
	const v4 c0 = a4 * a8 - a5 * a5, c1 = a2 * a5 - a1 * a8, c2 = a1 * a5 - a2 * a4;
	const v4 c4 = a0 * a8 - a2 * a2, c5 = a1 * a2 - a0 * a5, c8 = a0 * a4 - a1 * a1;
	const v4 det = a0 * c0 + a1 * c1 + a2 * c2, f = 0.5f / det;
	const v4 u0 = f * (c0 * b0 + c1 * b1 + c2 * b2), u1 = f * (c1 * b0 + c4 * b1 + c5 * b2),
		 u2 = f * (c2 * b0 + c5 * b1 + c8 * b2);
	const v4 n0 = w - x * u0 - y * u1 - z * u2, n1 = x + w * u0 + y * u2 - z * u1;
	const v4 n2 = y + w * u1 + z * u0 - x * u2, n3 = z + w * u2 + x * u1 - y * u0;
	const v4 g = 1 / root(n0 * n0 + n1 * n1 + n2 * n2 + n3 * n3);
	const m4 definite = (det > 0) & (c8 > 0) & (a0 > 0);

	*q = (quat){ choose(definite, g * n0, w), choose(definite, g * n1, x), choose(definite, g * n2, y),
		choose(definite, g * n3, z) };
	return choose(definite, 4 * (u0 * u0 + u1 * u1 + u2 * u2), det * (0.0f / 0.0f));
}

/* R n for the normals n, a vector a vertex. */
static void
turn_normals(const quat *q, const v4 *n, v4 *out)
{
	v4 v[4], r[3];

	transpose(n[0], n[1], n[2], n[3], v);
	const v4 a = 2 * (q->y * v[2] - q->z * v[1]), b = 2 * (q->z * v[0] - q->x * v[2]),
		 c = 2 * (q->x * v[1] - q->y * v[0]);
	r[0] = v[0] + q->w * a + q->y * c - q->z * b;
	r[1] = v[1] + q->w * b + q->z * a - q->x * c;
	r[2] = v[2] + q->w * c + q->x * b - q->y * a;
	transpose(r[0], r[1], r[2], r[2], out);
}

/* The rotation nearest to a sum that Newton's method has not found, and the normal turned by it. */
static void
turn_one(const mat *m, quat *q, uint32_t k, v4 normal, v4 *turned)
{
	mr_mat3 s = { { m->x[0], m->y[0], m->z[0], m->x[1], m->y[1], m->z[1], m->x[2], m->y[2], m->z[2] } };
	mr_mat3 r = mr_rotation_nearest(&s);
	mr_v3 half = mr_mul(0.5, mr_rotation_log(&r, mr_vec(0, 0, 0))),
	      n = mr_vec(normal[0], normal[1], normal[2]);
	double angle = mr_norm(half), f = angle > 0 ? sin(angle) / angle : 1;

	q->w[k] = (float)cos(angle);
	q->x[k] = (float)(f * half.x);
	q->y[k] = (float)(f * half.y);
	q->z[k] = (float)(f * half.z);
	n = mr_mat3_apply(&r, n);
	*turned = (v4){ (float)n.x, (float)n.y, (float)n.z, 0 };
}

/* The rotations nearest to the sums, from those that were, and the normals turned. */
static void
turn(mr_turning *t, const mat *sum)
{
	for (size_t v = 0; v < t->nv; v += 4) {
		const mat *m = &sum[v];
		v4 x[4], y[4], z[4], moved = { 0 };
		quat at = t->q[v / 4];
		m4 far = { -1, -1, -1, -1 };
		transpose(m[0].x, m[1].x, m[2].x, m[3].x, x);
		transpose(m[0].y, m[1].y, m[2].y, m[3].y, y);
		transpose(m[0].z, m[1].z, m[2].z, m[3].z, z);
		for (int i = 0; i < STEPS && (far[0] | far[1] | far[2] | far[3]); i++) {
			moved = step(&at, x, y, z);
			far = moved > NEAR;
		}
		t->q[v / 4] = at;
		turn_normals(&at, &t->normal[v], &t->turned[v]);
		for (uint32_t k = 0; k < 4; k++)
			if (!(moved[k] <= NEAR))
				turn_one(&m[k], &t->q[v / 4], k, t->normal[v + k], &t->turned[v + k]);
	}
}

void
mr_turning_find(mr_turning *t, const d4 *p)
{
	memset(t->sum, 0, (t->nv + 3) / 4 * 4 * sizeof *t->sum);
	add_faces(t, p, t->sum);
	smooth(t, t->sum, t->other);
	smooth(t, t->other, t->sum);
	turn(t, t->sum);
}

/* What a face at rest gives to the sums of y x^T of its edges and normals, its sides at unit mean length: of
 * the sides y1, y2 and the normal n of the face now y1 (2 x1 + x2)^T + y2 (x1 + 2 x2)^T + 6 n (x1 x x2)^T. */
static void
face_at_rest(const mr_mesh *m, size_t f, float r[9])
{
	const uint32_t *v = m->t[f].v;
	mr_v3 u = mr_sub(m->p[v[1]], m->p[v[0]]), w = mr_sub(m->p[v[2]], m->p[v[1]]);
	double all = mr_norm2(u) + mr_norm2(w) + mr_norm2(mr_add(u, w)), g = all > 0 ? 2 / all : 0;
	const mr_v3 rows[3] = { mr_mul(g, mr_axpy(2, u, w)), mr_mul(g, mr_axpy(2, w, u)),
		mr_mul(3 * g * g, mr_cross(u, w)) };

	for (int i = 0; i < 3; i++) {
		r[3 * i] = (float)rows[i].x;
		r[3 * i + 1] = (float)rows[i].y;
		r[3 * i + 2] = (float)rows[i].z;
	}
}

/* With itself and each neighbour a vertex has that many faces in common. */
static mr_status
weigh(mr_ctx *ctx, const mr_mesh *m, mr_turning *t)
{
	mr_incidence inc;
	size_t n = 0;

	MR_TRY(mr_incidence_build(ctx, m, &inc));
	t->around = (mr_adjacency){ MR_NEW_ZERO(ctx, m->nv + 1, size_t), MR_NEW(ctx, 9 * m->nf, uint32_t) };
	t->weight = MR_NEW_ZERO(ctx, 9 * m->nf, float);
	if (!t->around.start || !t->around.adj || !t->weight)
		return MR_EMEM;
	for (size_t v = 0; v < m->nv; v++) {
		size_t begin = n, j;
		for (size_t i = 3 * inc.start[v]; i < 3 * inc.start[v + 1]; i++) {
			uint32_t u = m->t[inc.face[i / 3]].v[i % 3];
			for (j = begin; j < n && t->around.adj[j] != u; j++)
				;
			t->around.adj[j] = u;
			t->weight[j]++;
			n += j == n;
		}
		t->around.start[v + 1] = n;
	}
	return MR_OK;
}

mr_status
mr_turning_begin(mr_ctx *ctx, const mr_mesh *m, const mr_v3 *normal, mr_turning *t)
{
	size_t n = (m->nv + 3) / 4 * 4;
	float(*rest)[9] = mr_alloc(ctx, m->nf, sizeof *rest);
	v4 *packed = MR_NEW_ZERO(ctx, n, v4);

	*t = (mr_turning){ .nv = m->nv,
		.nf = m->nf,
		.t = m->t,
		.rest = (const float(*)[9])rest,
		.normal = packed,
		.sum = MR_NEW(ctx, n, mat),
		.other = MR_NEW_ZERO(ctx, n, mat),
		.q = MR_NEW(ctx, n / 4, quat),
		.turned = MR_NEW(ctx, n, v4) };
	if (!rest || !packed || !t->sum || !t->other || !t->q || !t->turned)
		return MR_EMEM;
	for (size_t f = 0; f < m->nf; f++)
		face_at_rest(m, f, rest[f]);
	for (size_t v = 0; v < m->nv; v++)
		packed[v] = (v4){ (float)normal[v].x, (float)normal[v].y, (float)normal[v].z, 0 };
	for (size_t i = 0; i < n / 4; i++)
		t->q[i] = (quat){ { 1, 1, 1, 1 }, { 0 }, { 0 }, { 0 } };
	return weigh(ctx, m, t);
}

mr_mat3
mr_turning_mean(const mr_turning *t, const uint32_t corner[3], const float weight[3])
{
	mr_mat3 sum = { { 0 } };

	for (int k = 0; k < 3; k++) {
		const quat *q = &t->q[corner[k] / 4];
		uint32_t i = corner[k] % 4;
		double w = q->w[i], x = q->x[i], y = q->y[i], z = q->z[i];
		mr_mat3 r = { { 1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
		    2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x), 2 * (x * z - w * y),
		    2 * (y * z + w * x), 1 - 2 * (x * x + y * y) } };
		sum = mr_mat3_axpy(weight[k], &r, &sum);
	}
	return mr_rotation_nearest(&sum);
}
