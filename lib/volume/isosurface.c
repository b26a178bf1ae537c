/* The 256 cases follow from one rule: on each face of a cube every run of inside corners is cut off by a
 * segment.  Segments form loops, cut into triangles by diagonals in no face, so that no two share one. */
#include "volume/isosurface.h"

#include "base/parallel.h"

/* Corner c stands at x = c & 1, y = c >> 1 & 1, z = c >> 2.  Edge 4 a + k runs along axis a. */
enum { EDGES = 12, TRIANGLES = 5 };

/* The triangles of one case, whose corners lie on edges. */
typedef struct kind {
	uint8_t triangles;
	uint8_t corner[TRIANGLES][3];
} kind;

/* The edge between two corners that differ in one bit. */
static unsigned
edge_between(unsigned a, unsigned b)
{
	unsigned axis = (a ^ b) >> 1, low = a & b; /* 1, 2, 4 give 0, 1, 2 */
	unsigned u = low >> ((axis + 1) % 3) & 1, v = low >> ((axis + 2) % 3) & 1;

	return 4 * axis + u + 2 * v;
}

/* The lower end of an edge. */
static unsigned
edge_low(unsigned edge)
{
	unsigned axis = edge / 4, u = edge & 1, v = edge >> 1 & 1;

	return u << (axis + 1) % 3 | v << (axis + 2) % 3;
}

/* Corner i of a face of the cube, counter-clockwise seen from outside. */
static unsigned
face_corner(unsigned face, unsigned i)
{
	unsigned axis = face / 2, side = face % 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
	unsigned a = i == 1 || i == 2, b = i >= 2;

	return side << axis | (side ? a : b) << u | (side ? b : a) << v;
}

/* The faces of the cube, as bits, that an edge lies in. */
static unsigned
edge_faces(unsigned edge)
{
	unsigned axis = edge / 4, u = (axis + 1) % 3, v = (axis + 2) % 3;

	return 1u << (2 * u + (edge & 1)) | 1u << (2 * v + (edge >> 1 & 1));
}

/* next[e]: the edge that the surface's segment from edge e leads to, EDGES where e is not crossed. */
static void
link_edges(unsigned inside, unsigned next[EDGES])
{
	for (unsigned e = 0; e < EDGES; e++)
		next[e] = EDGES;
	for (unsigned face = 0; face < 6; face++)
		for (unsigned i = 0; i < 4; i++) {
			unsigned a = face_corner(face, i), b = face_corner(face, (i + 1) % 4), j = i + 1;
			if ((inside >> a & 1) || !(inside >> b & 1))
				continue;
			while (inside >> face_corner(face, (j + 1) % 4) & 1)
				j++; /* to the end of the run that begins at b */
			next[edge_between(a, b)] = edge_between(
			    face_corner(face, j % 4), face_corner(face, (j + 1) % 4));
		}
}

/* True where the fan around the loop's edge `apex` has no diagonal in a face of the cube. */
static bool
fan_is_free(const uint8_t *loop, unsigned n, unsigned apex)
{
	for (unsigned i = 2; i + 1 < n; i++)
		if (edge_faces(loop[apex]) & edge_faces(loop[(apex + i) % n]))
			return false;
	return true;
}

static void
add_triangle(kind *k, unsigned a, unsigned b, unsigned c)
{
	uint8_t *t = k->corner[k->triangles++];

	t[0] = (uint8_t)a;
	t[1] = (uint8_t)b;
	t[2] = (uint8_t)c;
}

static void
fill_loop(kind *k, const uint8_t *loop, unsigned n)
{
	unsigned apex = 0;

	while (apex + 1 < n && !fan_is_free(loop, n, apex))
		apex++;
	for (unsigned i = 1; i + 1 < n; i++)
		add_triangle(k, loop[apex], loop[(apex + i) % n], loop[(apex + i + 1) % n]);
}

static void
make_kind(unsigned inside, kind *k)
{
	unsigned next[EDGES];

	memset(k, 0, sizeof *k);
	link_edges(inside, next);
	for (unsigned e = 0; e < EDGES; e++) {
		uint8_t loop[EDGES];
		unsigned n = 0;
		for (unsigned at = e; next[at] != EDGES;) {
			unsigned to = next[at];
			loop[n++] = (uint8_t)at;
			next[at] = EDGES;
			at = to;
		}
		if (n > 0)
			fill_loop(k, loop, n);
	}
}

/* Which nodes are inside, as bits, x in rows of whole words, and the vertices on the edges that leave the
 * nodes of two layers, [axis][layer][node]. */
typedef struct march {
	const mr_grid *g;
	const float *f;
	float level;
	const kind *kinds;
	size_t words; /* of a row */
	uint64_t *inside;
	uint32_t *vertex[3][2];
	mr_v3 *p;
	mr_tri *t;
	size_t nv, nf, room_v, room_f;
} march;

static uint64_t *
row_of(const march *m, size_t y, size_t z)
{
	return m->inside + (z * m->g->n[1] + y) * m->words;
}

static void
mark_layers(void *arg, size_t begin, size_t end)
{
	const march *m = arg;

	for (size_t z = begin; z < end; z++)
		for (size_t y = 0; y < m->g->n[1]; y++) {
			const float *f = m->f + mr_grid_index(m->g, 0, y, z);
			uint64_t *row = row_of(m, y, z);
			memset(row, 0, m->words * sizeof *row);
			for (size_t x = 0; x < m->g->n[0]; x++)
				row[x / 64] |= (uint64_t)(f[x] < m->level) << x % 64;
		}
}

/* The nodes after word w of a row. */
static uint64_t
next_of(const uint64_t *row, size_t w, size_t words)
{
	return row[w] >> 1 | (w + 1 < words ? row[w + 1] << 63 : 0);
}

static void
add_vertex(mr_ctx *ctx, march *m, size_t x, size_t y, size_t z, size_t axis)
{
	const size_t stride[3] = { 1, m->g->n[0], m->g->n[0] * m->g->n[1] };
	const float *f = m->f + mr_grid_index(m->g, x, y, z);
	double a = (double)f[0] - (double)m->level, b = (double)f[stride[axis]] - (double)m->level;
	mr_v3 p = mr_grid_place(m->g, x, y, z);

	(&p.x)[axis] += m->g->step * (a / (a - b));
	m->vertex[axis][z & 1][y * m->g->n[0] + x] = (uint32_t)m->nv;
	MR_RESERVE(ctx, m->p, m->nv, 1, &m->room_v);
	m->p[m->nv++] = p;
}

/* The vertices on the edges that leave the nodes of layer z towards greater coordinates: there are none on
 * the grid's far faces, where all is outside. */
static void
add_layer(mr_ctx *ctx, march *m, size_t z)
{
	for (size_t y = 0; y + 1 < m->g->n[1]; y++) {
		const uint64_t *row = row_of(m, y, z), *up = row_of(m, y + 1, z), *far = row_of(m, y, z + 1);
		for (size_t w = 0; w < m->words; w++) {
			const uint64_t crossed[3] = { row[w] ^ next_of(row, w, m->words), row[w] ^ up[w],
				row[w] ^ far[w] };
			for (uint64_t left = crossed[0] | crossed[1] | crossed[2]; left; left &= left - 1) {
				size_t bit = (size_t)__builtin_ctzll(left);
				for (size_t axis = 0; axis < 3; axis++)
					if (crossed[axis] >> bit & 1)
						add_vertex(ctx, m, 64 * w + bit, y, z, axis);
			}
		}
	}
}

/* The vertex of an edge of the cube at x y z. */
static uint32_t
edge_vertex(const march *m, size_t x, size_t y, size_t z, unsigned edge)
{
	unsigned low = edge_low(edge);

	return m->vertex[edge / 4][(z + (low >> 2)) & 1][(y + (low >> 1 & 1)) * m->g->n[0] + x + (low & 1)];
}

static void
add_cube(mr_ctx *ctx, march *m, const kind *k, size_t x, size_t y, size_t z)
{
	MR_RESERVE(ctx, m->t, m->nf, TRIANGLES, &m->room_f);
	for (unsigned i = 0; i < k->triangles; i++) {
		mr_tri *t = &m->t[m->nf++];
		for (int j = 0; j < 3; j++)
			t->v[j] = edge_vertex(m, x, y, z, k->corner[i][j]);
	}
}

/* The cubes between layers z and z + 1 whose corners are not all alike. */
static void
add_cubes(mr_ctx *ctx, march *m, size_t z)
{
	for (size_t y = 0; y + 1 < m->g->n[1]; y++)
		for (size_t w = 0; w < m->words; w++) {
			uint64_t corner[8], any = 0, all = UINT64_MAX;
			for (size_t c = 0; c < 8; c += 2) {
				const uint64_t *row = row_of(m, y + c / 2 % 2, z + c / 4);
				corner[c] = row[w];
				corner[c + 1] = next_of(row, w, m->words);
				any |= corner[c] | corner[c + 1];
				all &= corner[c] & corner[c + 1];
			}
			for (uint64_t left = any & ~all; left; left &= left - 1) {
				unsigned x = (unsigned)__builtin_ctzll(left), inside = 0;
				for (unsigned c = 0; c < 8; c++)
					inside |= (unsigned)(corner[c] >> x & 1) << c;
				add_cube(ctx, m, &m->kinds[inside], 64 * w + x, y, z);
			}
		}
}

mr_status
mr_isosurface(mr_ctx *ctx, const mr_grid *g, const float *f, float level, mr_mesh *out)
{
	march m = { .g = g, .f = f, .level = level, .words = (g->n[0] + 63) / 64 };
	kind *kinds = MR_NEW(ctx, 256, kind);

	for (unsigned inside = 0; inside < 256; inside++)
		make_kind(inside, &kinds[inside]);
	m.kinds = kinds;
	m.inside = MR_NEW(ctx, m.words * g->n[1] * g->n[2], uint64_t);
	for (int i = 0; i < 6; i++)
		m.vertex[i / 2][i % 2] = MR_NEW(ctx, g->n[0] * g->n[1], uint32_t);
	mr_parallel(ctx, g->n[2], 1, mark_layers, &m);
	add_layer(ctx, &m, 0);
	for (size_t z = 0; z + 1 < g->n[2]; z++) {
		if (z + 2 < g->n[2])
			add_layer(ctx, &m, z + 1);
		add_cubes(ctx, &m, z);
		if (m.nv >= MR_NONE || m.nf > (MR_NONE - 1) / 3)
			return mr_fail(ctx, MR_ERANGE,
			    "an isosurface of over %zu vertices and %zu faces is too large", m.nv, m.nf);
	}
	*out = (mr_mesh){ .name = "isosurface", .p = m.p, .t = m.t, .nv = m.nv, .nf = m.nf };
	return MR_OK;
}
