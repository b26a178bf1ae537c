/*
 * The 256 cases are not a table that somebody typed but follow from one rule: on each face of a cube, every
 * run of inside corners is cut off by a segment.  The two cubes beside a face cut it alike, and the segments
 * of a cube form loops through the crossed edges, so each crossing of an edge of the grid lies on one fan of
 * four loops.  A loop is cut into triangles by diagonals that lie in no face of the cube, so that no two
 * loops share one: a fan around one of its edges, as there is in each of the cases.
 */
#include "volume/isosurface.h"

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

/* Vertices on the edges that leave the nodes of two layers, [axis][layer][node]. */
typedef struct march {
	const mr_grid *g;
	const float *f;
	const kind *kinds;
	uint32_t *vertex[3][2];
	mr_v3 *p;
	mr_tri *t;
	size_t nv, nf;
} march;

/* The inside ones of the four corners at the low x end of the cube at the node, as bits. */
static inline unsigned
inside_end(const mr_grid *g, const float *f, size_t node)
{
	size_t up = g->n[0], far = g->n[0] * g->n[1];
	const float *q = f + node;

	return (unsigned)(q[0] < 0) | (unsigned)(q[up] < 0) << 2 | (unsigned)(q[far] < 0) << 4 |
	       (unsigned)(q[far + up] < 0) << 6;
}

/* Those of the whole cube that is next along x, of which the low end has been looked at. */
static inline unsigned
inside_next(const mr_grid *g, const float *f, size_t node, unsigned *low)
{
	unsigned high = inside_end(g, f, node + 1), all = *low | high << 1;

	*low = high;
	return all;
}

/* The vertices on the edges that leave the nodes of layer z towards greater coordinates. */
static void
add_layer(march *m, size_t z)
{
	const mr_grid *g = m->g;
	const size_t stride[3] = { 1, g->n[0], g->n[0] * g->n[1] };

	for (size_t y = 0; y < g->n[1]; y++)
		for (size_t x = 0; x < g->n[0]; x++) {
			size_t at[3] = { x, y, z }, node = mr_grid_index(g, x, y, z), flat = y * g->n[0] + x;
			float a = m->f[node];
			for (size_t axis = 0; axis < 3; axis++) {
				float b;
				if (at[axis] + 1 == g->n[axis])
					continue;
				b = m->f[node + stride[axis]];
				if ((a < 0) == (b < 0))
					continue;
				mr_v3 p = mr_grid_place(g, x, y, z);
				(&p.x)[axis] += g->step * ((double)a / ((double)a - (double)b));
				m->p[m->nv] = p;
				m->vertex[axis][z & 1][flat] = (uint32_t)m->nv++;
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
add_cube(march *m, const kind *k, size_t x, size_t y, size_t z)
{
	for (unsigned i = 0; i < k->triangles; i++) {
		mr_tri *t = &m->t[m->nf++];
		for (int j = 0; j < 3; j++)
			t->v[j] = edge_vertex(m, x, y, z, k->corner[i][j]);
	}
}

static void
add_cubes(march *m, size_t z)
{
	const mr_grid *g = m->g;

	for (size_t y = 0; y + 1 < g->n[1]; y++) {
		size_t row = mr_grid_index(g, 0, y, z);
		unsigned end = inside_end(g, m->f, row);
		for (size_t x = 0; x + 1 < g->n[0]; x++) {
			unsigned inside = inside_next(g, m->f, row + x, &end);
			if (inside != 0 && inside != 255)
				add_cube(m, &m->kinds[inside], x, y, z);
		}
	}
}

/* Counts what add_layer and add_cubes will make: no array grows. */
static void
count_all(march *m)
{
	const mr_grid *g = m->g;

	for (size_t z = 0; z + 1 < g->n[2]; z++)
		for (size_t y = 0; y + 1 < g->n[1]; y++) {
			size_t row = mr_grid_index(g, 0, y, z);
			unsigned end = inside_end(g, m->f, row);
			for (size_t x = 0; x + 1 < g->n[0]; x++) {
				unsigned in = inside_next(g, m->f, row + x, &end), low = in & 1;
				if (in == 0 || in == 255)
					continue;
				m->nf += m->kinds[in].triangles;
				m->nv += (size_t)(low != (in >> 1 & 1)) + (low != (in >> 2 & 1)) +
				         (low != (in >> 4 & 1));
			}
		}
}

/* Nothing inside on the grid's own faces: the surface would be open there, and the counts wrong. */
static mr_status
check_faces(mr_ctx *ctx, const mr_grid *g, const float *f)
{
	for (size_t z = 0; z < g->n[2]; z++)
		for (size_t y = 0; y < g->n[1]; y++) {
			bool face = z == 0 || z + 1 == g->n[2] || y == 0 || y + 1 == g->n[1];
			for (size_t x = 0; x < g->n[0]; x += face || g->n[0] == 1 ? 1 : g->n[0] - 1)
				if (!(f[mr_grid_index(g, x, y, z)] >= 0))
					return mr_fail(ctx, MR_ERANGE,
					    "node %zu %zu %zu on the face of a grid of %zu x %zu x %zu is "
					    "inside",
					    x, y, z, g->n[0], g->n[1], g->n[2]);
		}
	return MR_OK;
}

mr_status
mr_isosurface(mr_ctx *ctx, const mr_grid *g, const float *f, mr_mesh *out)
{
	march m = { .g = g, .f = f };
	kind *kinds = MR_NEW(ctx, 256, kind);
	mr_mark mark;

	MR_TRY(check_faces(ctx, g, f));
	for (unsigned inside = 0; inside < 256; inside++)
		make_kind(inside, &kinds[inside]);
	m.kinds = kinds;
	count_all(&m);
	if (m.nv >= MR_NONE || m.nf > (MR_NONE - 1) / 3)
		return mr_fail(
		    ctx, MR_ERANGE, "an isosurface of %zu vertices and %zu faces is too large", m.nv, m.nf);
	m.p = MR_NEW(ctx, m.nv, mr_v3);
	m.t = MR_NEW(ctx, m.nf, mr_tri);
	mark = mr_mark_take(ctx);
	for (int i = 0; i < 6; i++)
		m.vertex[i / 2][i % 2] = MR_NEW(ctx, g->n[0] * g->n[1], uint32_t);
	m.nv = m.nf = 0;
	add_layer(&m, 0);
	for (size_t z = 0; z + 1 < g->n[2]; z++) {
		add_layer(&m, z + 1);
		add_cubes(&m, z);
	}
	*out = (mr_mesh){ .name = "isosurface", .p = m.p, .t = m.t, .nv = m.nv, .nf = m.nf };
	mr_mark_release(ctx, mark);
	return MR_OK;
}
