/* Solids by grids of quadrilaterals, of about as many vertices as asked for. */
#include "shape/parts.h"

const char *const mr_solid_names[MR_SOLIDS] = { "sphere", "torus", "cube", "plane", "cylinder", "knot",
	"bumpy", "boxes" };

/* The nearest whole number, at least `least`. */
static size_t
whole(double x, size_t least)
{
	return x > (double)least ? (size_t)(x + 0.5) : least;
}

/*
 * A geodesic sphere: each face of an icosahedron cut into f^2 triangles, its points
 * pushed out to the sphere.
 */

typedef struct corner_weight {
	uint32_t corner, weight;
} corner_weight;

/* A point of an edge or face is known by the corners it lies between and its weights. */
static uint64_t
geodesic_key(const corner_weight in[3])
{
	enum { NO_CORNER = 15 };
	corner_weight c[3] = { { NO_CORNER, 0 }, { NO_CORNER, 0 }, { NO_CORNER, 0 } };
	size_t n = 0;

	for (int i = 0; i < 3; i++) {
		size_t j = n;
		if (in[i].weight == 0)
			continue;
		for (; j > 0 && c[j - 1].corner > in[i].corner; j--)
			c[j] = c[j - 1];
		c[j] = in[i];
		n++;
	}
	return (uint64_t)c[0].corner << 60 | (uint64_t)c[1].corner << 56 | (uint64_t)c[2].corner << 52 |
	       (uint64_t)c[0].weight << 26 | c[1].weight;
}

typedef struct geodesic {
	mr_solid_build *b;
	mr_solid_weld w;
	mr_v3 corner[12];
	uint32_t frequency;
} geodesic;

/* The vertex i steps from corner a towards b and j towards c. */
static uint32_t
geodesic_vertex(geodesic *g, const uint32_t abc[3], uint32_t i, uint32_t j)
{
	corner_weight c[3] = { { abc[0], g->frequency - i - j }, { abc[1], i }, { abc[2], j } };
	bool is_new;
	uint32_t *slot = mr_weld_slot(&g->w, geodesic_key(c), &is_new);

	if (is_new) {
		mr_v3 p = mr_vec(0, 0, 0);
		for (int k = 0; k < 3; k++)
			p = mr_axpy(c[k].weight, g->corner[c[k].corner], p);
		*slot = mr_solid_add_vertex(g->b, mr_unit(p));
	}
	return *slot;
}

static void
geodesic_face(geodesic *g, const uint32_t abc[3], uint32_t *rows)
{
	uint32_t f = g->frequency, *row = rows, *next = rows + f + 1;

	for (uint32_t i = 0; i <= f; i++)
		row[i] = geodesic_vertex(g, abc, i, 0);
	for (uint32_t j = 0; j < f; j++) {
		uint32_t *swap = row;
		for (uint32_t i = 0; i < f - j; i++)
			next[i] = geodesic_vertex(g, abc, i, j + 1);
		for (uint32_t i = 0; i < f - j; i++) {
			mr_solid_add_face(g->b, row[i], row[i + 1], next[i]);
			if (i + 1 < f - j)
				mr_solid_add_face(g->b, row[i + 1], next[i + 1], next[i]);
		}
		row = next;
		next = swap;
	}
}

static size_t
geodesic_frequency(size_t n)
{
	return whole(sqrt((double)(n > 2 ? n - 2 : 0) / 10), 1);
}

static mr_status
geodesic_sphere(mr_ctx *ctx, size_t f, mr_solid_build *b)
{
	static const uint32_t face[20][3] = { { 0, 1, 2 }, { 0, 2, 3 }, { 0, 3, 4 }, { 0, 4, 5 }, { 0, 5, 1 },
		{ 1, 6, 2 }, { 2, 7, 3 }, { 3, 8, 4 }, { 4, 9, 5 }, { 5, 10, 1 }, { 6, 7, 2 }, { 7, 8, 3 },
		{ 8, 9, 4 }, { 9, 10, 5 }, { 10, 6, 1 }, { 11, 7, 6 }, { 11, 8, 7 }, { 11, 9, 8 },
		{ 11, 10, 9 }, { 11, 6, 10 } };
	geodesic g = { .b = b, .frequency = (uint32_t)f };
	const double z = 1 / sqrt(5), r = 2 / sqrt(5);
	mr_mark mark;
	uint32_t *rows;

	if (f >= 1 << 14)
		return mr_fail(ctx, MR_ERANGE, "a geodesic sphere of frequency %zu is too large", f);
	MR_TRY(mr_solid_begin(ctx, 10 * f * f + 2, 20 * f * f, b));
	mark = mr_mark_take(ctx);
	mr_weld_begin(ctx, 10 * f * f + 2, &g.w);
	rows = MR_NEW(ctx, 2 * (f + 1), uint32_t);
	g.corner[0] = mr_vec(0, 0, 1);
	g.corner[11] = mr_vec(0, 0, -1);
	for (int i = 0; i < 5; i++) {
		double upper = 2 * MR_PI * i / 5, lower = upper + MR_PI / 5;
		g.corner[1 + i] = mr_vec(r * cos(upper), r * sin(upper), z);
		g.corner[6 + i] = mr_vec(r * cos(lower), r * sin(lower), -z);
	}
	for (int i = 0; i < 20; i++)
		geodesic_face(&g, face[i], rows);
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* Surfaces over a periodic rectangle [0, 1)^2 of nu by nv points. */
static mr_status
periodic_grid(mr_ctx *ctx, size_t nu, size_t nv, mr_v3 (*at)(double u, double v), mr_solid_build *b)
{
	MR_TRY(mr_solid_begin(ctx, nu * nv, 2 * nu * nv, b));
	for (size_t i = 0; i < nu; i++)
		for (size_t j = 0; j < nv; j++)
			mr_solid_add_vertex(b, at((double)i / (double)nu, (double)j / (double)nv));
	for (size_t i = 0; i < nu; i++) {
		for (size_t j = 0; j < nv; j++) {
			size_t k = (i + 1) % nu, l = (j + 1) % nv;
			mr_solid_add_quad(b, (uint32_t)(i * nv + j), (uint32_t)(k * nv + j),
			    (uint32_t)(k * nv + l), (uint32_t)(i * nv + l));
		}
	}
	return MR_OK;
}

/* The periodic grid of about n points whose cells are squares where the lengths of the two circles stand in
 * `ratio`. */
static mr_status
tube(mr_ctx *ctx, size_t n, double ratio, size_t least, mr_v3 (*at)(double u, double v), mr_solid_build *b)
{
	size_t nu = whole(sqrt((double)n * ratio), least), nv = whole((double)n / (double)nu, 3);

	return periodic_grid(ctx, nu, nv, at, b);
}

static mr_v3
torus_point(double u, double v)
{
	double a = 2 * MR_PI * u, b = 2 * MR_PI * v, r = 1 + 0.4 * cos(b);

	return mr_vec(r * cos(a), r * sin(a), 0.4 * sin(b));
}

static const double KNOT_RADIUS = 0.45, KNOT_TUBE = 0.2, KNOT_LENGTH = 15.337059286565475; /* of the curve */

/*
 * The curve runs on a torus, twice around it and three times around its tube; the
 * torus's normal is at right angles to it, and closes up with it.
 */
static mr_v3
knot_point(double u, double v)
{
	double a = 4 * MR_PI * u, b = 6 * MR_PI * u, w = 2 * MR_PI * v, r = 1 + KNOT_RADIUS * cos(b);
	mr_v3 c = mr_vec(r * cos(a), r * sin(a), KNOT_RADIUS * sin(b));
	mr_v3 normal = mr_vec(cos(b) * cos(a), cos(b) * sin(a), sin(b));
	mr_v3 along = mr_vec(-2 * r * sin(a), 2 * r * cos(a), 0);
	mr_v3 around = mr_mul(3 * KNOT_RADIUS, mr_vec(-sin(b) * cos(a), -sin(b) * sin(a), cos(b)));
	mr_v3 side = mr_cross(normal, mr_unit(mr_add(along, around)));

	return mr_axpy(KNOT_TUBE * cos(w), normal, mr_axpy(KNOT_TUBE * sin(w), side, c));
}

static mr_status
plane(mr_ctx *ctx, size_t n, mr_solid_build *b)
{
	size_t s = whole(sqrt((double)n) - 1, 1);

	MR_TRY(mr_solid_begin(ctx, (s + 1) * (s + 1), 2 * s * s, b));
	for (size_t i = 0; i <= s; i++)
		for (size_t j = 0; j <= s; j++)
			mr_solid_add_vertex(
			    b, mr_vec(2 * (double)j / (double)s - 1, 2 * (double)i / (double)s - 1, 0));
	for (size_t i = 0; i < s; i++) {
		for (size_t j = 0; j < s; j++) {
			uint32_t a = (uint32_t)(i * (s + 1) + j), c = (uint32_t)(a + s + 1);
			mr_solid_add_quad(b, a, a + 1, c + 1, c);
		}
	}
	return MR_OK;
}

/* A ring of `count` vertices of the given radius at height z; a ring of none is its centre. */
static uint32_t
add_ring(mr_solid_build *b, size_t count, double radius, double z)
{
	uint32_t first = (uint32_t)b->nv;

	for (size_t i = 0; i < count; i++) {
		double a = 2 * MR_PI * (double)i / (double)count;
		mr_solid_add_vertex(b, mr_vec(radius * cos(a), radius * sin(a), z));
	}
	if (count == 0)
		mr_solid_add_vertex(b, mr_vec(0, 0, z));
	return first;
}

/* Faces between two rings, the outer one of m vertices counter-clockwise seen from outside, the inner one of
 * n. */
static void
join_rings(mr_solid_build *b, uint32_t outer, size_t m, uint32_t inner, size_t n, bool flip)
{
	size_t i = 0, j = 0;

	while (i < m || j < n) {
		/* NOLINTNEXTLINE(clang-analyzer-core.DivideZero) the outer ring has vertices */
		uint32_t a = outer + (uint32_t)(i % m), c = inner + (uint32_t)(n ? j % n : 0), d;
		bool step = j == n || (i < m && (i + 1) * n <= (j + 1) * m); /* the one behind goes on */

		d = step ? outer + (uint32_t)(++i % m) : inner + (uint32_t)(++j % n);
		if (flip)
			mr_solid_add_face(b, a, c, d);
		else
			mr_solid_add_face(b, a, d, c);
	}
}

/* The caps are hexagonal: ring j of k has 6 j vertices, so edges are nearly as long as on the side. */
static mr_status
cylinder(mr_ctx *ctx, size_t n, bool open, mr_solid_build *b)
{
	/* 6 k (h + 1) + 2 (1 + 3 k (k - 1)) vertices with h = 4 k / (pi / 3) */
	double quad = 72 / MR_PI + (open ? 0 : 6);
	size_t k = whole(sqrt((double)n / quad), 1), h = whole(12 * (double)k / MR_PI, 1);
	size_t side = 6 * k * (h + 1), cap = open ? 0 : 1 + 3 * k * (k - 1);
	uint32_t bottom = 0, top = 0;

	MR_TRY(mr_solid_begin(ctx, side + 2 * cap, 12 * k * h + (open ? 0 : 12 * k * k), b));
	for (size_t i = 0; i <= h; i++)
		top = add_ring(b, 6 * k, 1, 4 * (double)i / (double)h - 2);
	for (size_t i = 0; i < h; i++)
		join_rings(b, (uint32_t)(i * 6 * k), 6 * k, (uint32_t)((i + 1) * 6 * k), 6 * k, false);
	for (size_t j = open ? 0 : k; j > 0; j--) {
		double radius = (double)(j - 1) / (double)k;
		uint32_t low = add_ring(b, 6 * (j - 1), radius, -2);
		uint32_t high = add_ring(b, 6 * (j - 1), radius, 2);
		join_rings(b, bottom, 6 * j, low, 6 * (j - 1), true);
		join_rings(b, top, 6 * j, high, 6 * (j - 1), false);
		bottom = low;
		top = high;
	}
	return MR_OK;
}

/* Surfaces of unit cells: the sides between a full and an empty one, cut into s^2 squares. */
typedef struct cells {
	mr_solid_build *b;
	mr_solid_weld w;
	size_t count[3]; /* cells along each axis */
	size_t s;
	bool holes; /* without the cells of odd first and middle second index */
	mr_v3 size; /* of a cell */
} cells;

static bool
cell_full(const cells *c, const size_t i[3])
{
	if (i[0] >= c->count[0] || i[1] >= c->count[1] || i[2] >= c->count[2])
		return false;
	return !(c->holes && i[0] % 2 == 1 && i[1] == 1);
}

static uint32_t
cells_vertex(cells *c, const size_t at[3])
{
	bool is_new;
	uint32_t *slot = mr_weld_slot(&c->w, (uint64_t)at[0] << 42 | (uint64_t)at[1] << 21 | at[2], &is_new);

	if (is_new) {
		double x[3], s = (double)c->s;
		for (int k = 0; k < 3; k++)
			x[k] = (double)at[k] / s - 0.5 * (double)c->count[k];
		*slot = mr_solid_add_vertex(
		    c->b, mr_vec(c->size.x * x[0], c->size.y * x[1], c->size.z * x[2]));
	}
	return *slot;
}

/* The side of cell i across `axis`, the upper one or the lower one. */
static void
cells_side(cells *c, const size_t i[3], int axis, bool upper)
{
	int u = (axis + 1) % 3, v = (axis + 2) % 3;

	for (size_t a = 0; a < c->s; a++) {
		for (size_t d = 0; d < c->s; d++) {
			uint32_t q[4];
			for (size_t k = 0; k < 4; k++) {
				size_t at[3];
				at[axis] = (i[axis] + upper) * c->s;
				at[u] = i[u] * c->s + a + (k == 1 || k == 2);
				at[v] = i[v] * c->s + d + (k >= 2);
				q[upper ? k : 3 - k] = cells_vertex(c, at);
			}
			mr_solid_add_quad(c->b, q[0], q[1], q[2], q[3]);
		}
	}
}

static void
cells_sides(cells *c, const size_t i[3])
{
	for (int axis = 0; axis < 3; axis++) {
		for (int upper = 0; upper < 2; upper++) {
			size_t beside[3] = { i[0], i[1], i[2] };
			beside[axis] += upper ? 1 : (size_t)-1; /* below 0 wraps to outside */
			if (!cell_full(c, beside))
				cells_side(c, i, axis, upper);
		}
	}
}

/* `sides` of the solid's cells are outside, `genus` is that of the whole: sides s^2 + 2 - 2 genus vertices.
 */
static mr_status
cells_make(mr_ctx *ctx, cells *c, size_t sides, size_t genus, size_t n)
{
	double squares = (double)n - 2 + 2 * (double)genus;
	mr_mark mark;

	c->s = whole(sqrt(squares > 0 ? squares / (double)sides : 0), 1);
	if ((c->count[0] > c->count[1] ? c->count[0] : c->count[1]) * c->s >= 1 << 21)
		return mr_fail(ctx, MR_ERANGE, "%zu vertices are too many", n);
	MR_TRY(mr_solid_begin(ctx, sides * c->s * c->s + 2 - 2 * genus, 2 * sides * c->s * c->s, c->b));
	mark = mr_mark_take(ctx);
	mr_weld_begin(ctx, sides * c->s * c->s + 2, &c->w);
	for (size_t i = 0; i < c->count[0]; i++)
		for (size_t j = 0; j < c->count[1]; j++)
			for (size_t k = 0; k < c->count[2]; k++)
				if (cell_full(c, (size_t[3]){ i, j, k }))
					cells_sides(c, (size_t[3]){ i, j, k });
	mr_mark_release(ctx, mark);
	return MR_OK;
}

static mr_status
cube(mr_ctx *ctx, size_t n, mr_solid_build *b)
{
	cells c = { .b = b, .count = { 1, 1, 1 }, .size = { 2, 2, 2 } };

	return cells_make(ctx, &c, 6, 0, n);
}

static mr_status
boxes(mr_ctx *ctx, size_t n, size_t genus, mr_solid_build *b)
{
	cells c = { .b = b, .count = { 2 * genus + 1, 3, 1 }, .holes = true, .size = { 1, 1, 1 } };
	size_t flat = 2 * (3 * (2 * genus + 1) - genus), outer = 2 * (2 * genus + 1 + 3), inner = 4 * genus;

	if (genus > 100000)
		return mr_fail(ctx, MR_ERANGE, "a genus of %zu is too large", genus);
	return cells_make(ctx, &c, flat + outer + inner, genus, n);
}

static mr_status
make(mr_ctx *ctx, const mr_make_opts *o, size_t n, mr_solid_build *b)
{
	switch (o->solid) {
	case MR_SPHERE:
		return geodesic_sphere(ctx, geodesic_frequency(n), b);
	case MR_TORUS:
		return tube(ctx, n, 1 / 0.4, 3, torus_point, b);
	case MR_CUBE:
		return cube(ctx, n, b);
	case MR_PLANE:
		return plane(ctx, n, b);
	case MR_CYLINDER:
		return cylinder(ctx, n, o->open, b);
	case MR_KNOT:
		return tube(ctx, n, KNOT_LENGTH / (2 * MR_PI * KNOT_TUBE), 24, knot_point, b);
	case MR_BUMPY:
		return mr_bumpy(ctx, n, b);
	case MR_BOXES:
		return boxes(ctx, n, o->genus, b);
	case MR_SOLIDS:
		break;
	}
	return mr_fail(ctx, MR_ERANGE, "no shape has the number %d", (int)o->solid);
}

mr_status
mr_solid_make(mr_ctx *ctx, const mr_make_opts *o, mr_mesh *m)
{
	mr_solid_build b;

	if (o->vertices >= MR_NONE)
		return mr_fail(ctx, MR_ERANGE, "%zu vertices are too many", o->vertices);
	MR_TRY(make(ctx, o, o->vertices ? o->vertices : o->solid == MR_BUMPY ? 30000 : 10000, &b));
	*m = (mr_mesh){ .name = mr_solid_names[o->solid], .p = b.p, .t = b.t, .nv = b.nv, .nf = b.nf };
	return MR_OK;
}
