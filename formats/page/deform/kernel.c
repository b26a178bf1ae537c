/*
 * kernel.c -- the deformation of the page, as WebAssembly for its workers (kernel.js): a base posed by its
 * response to handles (lib/edit/pose_basis.c), how it turns around each vertex, the rotations of Sorkine and
 * Alexa 2007 of faces with their normals, smoothed (lib/edit/turns.c), and the detail on it
 * (lib/edit/detail.c).
 *
 * Vectors are of four floats.  Places are doubles: edges are small beside them.
 */
typedef float v4 __attribute__((vector_size(16)));
typedef int m4 __attribute__((vector_size(16)));
typedef double d4 __attribute__((vector_size(32)));
typedef unsigned u32;

typedef struct mat {
	v4 x, y, z; /* columns; the fourth row is of no meaning */
} mat;

/* Four at a time: the k-th of each vector is of the k-th. */
typedef struct quat {
	v4 w, x, y, z;
} quat;

enum { STEPS = 12 };

/* Of the last step, in radians, squared: the next would be its square. */
static const float NEAR = 1e-7f;

static v4
cross(v4 a, v4 b)
{
	v4 c = a * __builtin_shufflevector(b, b, 1, 2, 0, 3) - __builtin_shufflevector(a, a, 1, 2, 0, 3) * b;

	return __builtin_shufflevector(c, c, 1, 2, 0, 3);
}

/* from + A w of each of n vertices; a: the columns of A. */
void
pose(const d4 *from, const v4 *w, const d4 *a, d4 *to, u32 n)
{
	const d4 x = a[0], y = a[1], z = a[2], one = a[3];

	for (u32 i = 0; i < n; i++) {
		d4 v = __builtin_convertvector(w[i], d4);
		to[i] = from[i] + x * v[0] + y * v[1] + z * v[2] + one * v[3];
	}
}

/*
 * Adds what each face, now at p, gives to the sums of y x^T of its corners: of its sides y1, y2 and its
 * normal n y1 r1^T + y2 r2^T + n r3^T, where r1, r2, r3 are of the face at rest.
 */
void
add_faces(const d4 *p, const u32 (*t)[3], const float (*rest)[9], mat *sum, u32 faces)
{
	for (u32 f = 0; f < faces; f++) {
		const d4 b = p[t[f][1]];
		const v4 u = __builtin_convertvector(b - p[t[f][0]], v4),
			 v = __builtin_convertvector(p[t[f][2]] - b, v4);
		const v4 n = cross(u, v);
		const float *r = rest[f];
		const mat s = { u * r[0] + v * r[3] + n * r[6], u * r[1] + v * r[4] + n * r[7],
			u * r[2] + v * r[5] + n * r[8] };
		for (int k = 0; k < 3; k++) {
			mat *to = &sum[t[f][k]];
			to->x += s.x;
			to->y += s.y;
			to->z += s.z;
		}
	}
}

/* Of each of n vertices the sums of the faces around it, which are those of their corners. */
void
smooth(const mat *sum, const u32 *first, const u32 *other, const float *weight, mat *out, u32 n)
{
	for (u32 v = 0; v < n; v++) {
		mat s = { { 0 }, { 0 }, { 0 } };
		for (u32 j = first[v]; j < first[v + 1]; j++) {
			const mat *m = &sum[other[j]];
			const float w = weight[j];
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

/* Places without their fourth component. */
void
narrow(const d4 *p, float (*out)[3], u32 n)
{
	for (u32 i = 0; i < n; i++)
		for (int k = 0; k < 3; k++)
			out[i][k] = (float)p[i][k];
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

/*
 * Of n vertices, a multiple of 4, the rotations nearest to the sums, from those that were, and the normals
 * turned.  Those whose rotation is not found so come into `lost`; returns how many those are.
 */
u32
turn(const mat *sum, quat *q, const v4 *normal, v4 *turned, u32 *lost, u32 n)
{
	u32 count = 0;

	for (u32 v = 0; v < n; v += 4) {
		const mat *m = &sum[v];
		v4 x[4], y[4], z[4], moved = { 0 };
		quat at = q[v / 4];
		m4 far = { -1, -1, -1, -1 };
		transpose(m[0].x, m[1].x, m[2].x, m[3].x, x);
		transpose(m[0].y, m[1].y, m[2].y, m[3].y, y);
		transpose(m[0].z, m[1].z, m[2].z, m[3].z, z);
		for (int i = 0; i < STEPS && (far[0] | far[1] | far[2] | far[3]); i++) {
			moved = step(&at, x, y, z);
			far = moved > NEAR;
		}
		q[v / 4] = at;
		turn_normals(&at, &normal[v], &turned[v]);
		for (u32 k = 0; k < 4; k++)
			if (!(moved[k] <= NEAR))
				lost[count++] = v + k;
	}
	return count;
}

/* b + h n of each row of detail, at the place of its weights between three vertices. */
void
decode(const d4 *p, const v4 *n, const u32 (*corner)[3], const float (*weight)[3], const float *height,
    float (*out)[3], u32 rows)
{
	for (u32 i = 0; i < rows; i++) {
		const u32 a = corner[i][0], b = corner[i][1], c = corner[i][2];
		const float u = weight[i][0], v = weight[i][1], s = weight[i][2];
		const v4 m = u * n[a] + v * n[b] + s * n[c], m2 = m * m;
		const float size = m2[0] + m2[1] + m2[2];
		const v4 at = __builtin_convertvector(u * p[a] + v * p[b] + s * p[c], v4) +
		              m * (size > 0 ? height[i] / __builtin_sqrtf(size) : 0);
		for (int k = 0; k < 3; k++)
			out[i][k] = at[k];
	}
}
