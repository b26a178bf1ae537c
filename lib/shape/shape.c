/* Solids by grids of quadrilaterals, of about as many vertices as asked for. */
#include "shape/shape.h"

#include "base/random.h"
#include "mesh/repair.h"

const char *const mr_solid_names[MR_SOLIDS] = { "sphere", "torus", "cube", "plane", "cylinder", "knot",
	"bumpy", "boxes" };

/* The nearest whole number, at least `least`. */
static size_t
whole(double x, size_t least)
{
	return x > (double)least ? (size_t)(x + 0.5) : least;
}

/* The mesh in the making, piece by piece: each has vertices of its own, and equal ones are joined in the
 * end. */
typedef struct build {
	mr_ctx *ctx;
	mr_v3 *p;
	mr_tri *t;
	size_t nv, nf, room_v, room_f;
} build;

static void
add_vertex(build *b, mr_v3 p)
{
	MR_RESERVE(b->ctx, b->p, b->nv, 1, &b->room_v);
	b->p[b->nv++] = p;
}

static void
add_face(build *b, size_t i, size_t j, size_t k)
{
	MR_RESERVE(b->ctx, b->t, b->nf, 1, &b->room_f);
	b->t[b->nf++] = (mr_tri){ { (uint32_t)i, (uint32_t)j, (uint32_t)k } };
}

/* The place of vertex i, j of a grid. */
typedef mr_v3 (*place)(const void *arg, size_t i, size_t j);

/* A grid of nu by nv quadrilaterals of two faces each: corners 0 1 2 3 are i j, i + 1 j and on around, and
 * `order` has the three of the one face, then the last of the other. */
static void
add_grid(build *b, size_t nu, size_t nv, const char *order, place at, const void *arg)
{
	size_t first = b->nv;

	for (size_t i = 0; i <= nu; i++)
		for (size_t j = 0; j <= nv; j++)
			add_vertex(b, at(arg, i, j));
	for (size_t i = 0; i < nu; i++)
		for (size_t j = 0; j < nv; j++) {
			size_t q = first + i * (nv + 1) + j, r = q + nv + 1,
			       around[4] = { q, r, r + 1, q + 1 }, c[4];
			for (int k = 0; k < 4; k++)
				c[k] = around[order[k] - '0'];
			add_face(b, c[0], c[1], c[2]);
			add_face(b, c[0], c[2], c[3]);
		}
}

/* A face of the icosahedron cut into f^2 triangles, its points pushed out to the sphere. */
static void
add_geodesic(build *b, const mr_v3 corner[3], size_t f)
{
	size_t row = b->nv;

	for (size_t j = 0; j <= f; j++)
		for (size_t i = 0; i <= f - j; i++) {
			mr_v3 p = mr_mul((double)(f - i - j), corner[0]);
			p = mr_axpy((double)j, corner[2], mr_axpy((double)i, corner[1], p));
			add_vertex(b, mr_unit(p));
		}
	for (size_t j = 0; j < f; j++) {
		size_t next = row + f - j + 1;
		for (size_t i = 0; i < f - j; i++) {
			add_face(b, row + i, row + i + 1, next + i);
			if (i + 1 < f - j)
				add_face(b, row + i + 1, next + i + 1, next + i);
		}
		row = next;
	}
}

static void
sphere(build *b, size_t n)
{
	static const uint8_t face[20][3] = { { 0, 1, 2 }, { 0, 2, 3 }, { 0, 3, 4 }, { 0, 4, 5 }, { 0, 5, 1 },
		{ 1, 6, 2 }, { 2, 7, 3 }, { 3, 8, 4 }, { 4, 9, 5 }, { 5, 10, 1 }, { 6, 7, 2 }, { 7, 8, 3 },
		{ 8, 9, 4 }, { 9, 10, 5 }, { 10, 6, 1 }, { 11, 7, 6 }, { 11, 8, 7 }, { 11, 9, 8 },
		{ 11, 10, 9 }, { 11, 6, 10 } };
	const double z = 1 / sqrt(5), r = 2 / sqrt(5);
	mr_v3 corner[12] = { [0] = { 0, 0, 1 }, [11] = { 0, 0, -1 } };
	size_t f = whole(sqrt((double)(n > 2 ? n - 2 : 0) / 10), 1);

	for (int i = 0; i < 5; i++) {
		double upper = 2 * MR_PI * i / 5, lower = upper + MR_PI / 5;
		corner[1 + i] = mr_vec(r * cos(upper), r * sin(upper), z);
		corner[6 + i] = mr_vec(r * cos(lower), r * sin(lower), -z);
	}
	for (int i = 0; i < 20; i++)
		add_geodesic(b, (mr_v3[3]){ corner[face[i][0]], corner[face[i][1]], corner[face[i][2]] }, f);
}

/* A surface over the periodic rectangle [0, 1)^2. */
typedef struct tube {
	size_t nu, nv;
	mr_v3 (*at)(double u, double v);
} tube;

static mr_v3
tube_place(const void *arg, size_t i, size_t j)
{
	const tube *t = arg;

	return t->at((double)(i % t->nu) / (double)t->nu, (double)(j % t->nv) / (double)t->nv);
}

/* Numbers of rings and columns for about n points with square cells; `ratio`: of the two circles' lengths. */
static void
add_tube(build *b, size_t n, double ratio, size_t least, mr_v3 (*at)(double u, double v))
{
	tube t = { .nu = whole(sqrt((double)n * ratio), least), .at = at };

	t.nv = whole((double)n / (double)t.nu, 3);
	add_grid(b, t.nu, t.nv, "0123", tube_place, &t);
}

static mr_v3
torus_point(double u, double v)
{
	double a = 2 * MR_PI * u, b = 2 * MR_PI * v, r = 1 + 0.4 * cos(b);

	return mr_vec(r * cos(a), r * sin(a), 0.4 * sin(b));
}

static const double KNOT_RADIUS = 0.45, KNOT_TUBE = 0.2, KNOT_LENGTH = 15.337059286565475; /* of the curve */

/* The curve runs on a torus, twice around it and three times around its tube, across its normal. */
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

static mr_v3
plane_place(const void *arg, size_t i, size_t j)
{
	const double half = (double)*(const size_t *)arg / 2;

	return mr_vec((double)j / half - 1, (double)i / half - 1, 0);
}

static void
plane(build *b, size_t n)
{
	size_t s = whole(sqrt((double)n) - 1, 1);

	add_grid(b, s, s, "0321", plane_place, &s);
}

/* A ring of `count` vertices at height z; a ring of none is its centre.  The first of them. */
static size_t
add_ring(build *b, size_t count, double radius, double z)
{
	size_t first = b->nv;

	for (size_t i = 0; i < count; i++) {
		double a = 2 * MR_PI * (double)i / (double)count;
		add_vertex(b, mr_vec(radius * cos(a), radius * sin(a), z));
	}
	if (count == 0)
		add_vertex(b, mr_vec(0, 0, z));
	return first;
}

/* Faces between two rings of m and n vertices, the outer one counter-clockwise seen from outside. */
static void
join_rings(build *b, size_t outer, size_t m, size_t inner, size_t n, bool flip)
{
	size_t i = 0, j = 0;

	while (i < m || j < n) {
		/* NOLINTNEXTLINE(clang-analyzer-core.DivideZero) the outer ring has vertices */
		size_t a = outer + i % m, c = inner + (n ? j % n : 0), d;
		bool step = j == n || (i < m && (i + 1) * n <= (j + 1) * m); /* the later one goes on */

		d = step ? outer + ++i % m : inner + ++j % n;
		add_face(b, a, flip ? c : d, flip ? d : c);
	}
}

/* The caps are hexagonal: ring j of k has 6 j vertices, so edges are nearly as long as on the side. */
static void
cylinder(build *b, size_t n, bool open)
{
	/* 6 k (h + 1) + 2 (1 + 3 k (k - 1)) vertices with h = 4 k / (pi / 3) */
	double quad = 72 / MR_PI + (open ? 0 : 6);
	size_t k = whole(sqrt((double)n / quad), 1), h = whole(12 * (double)k / MR_PI, 1), bottom = 0,
	       top = 0;

	for (size_t i = 0; i <= h; i++)
		top = add_ring(b, 6 * k, 1, 4 * (double)i / (double)h - 2);
	for (size_t i = 0; i < h; i++)
		join_rings(b, i * 6 * k, 6 * k, (i + 1) * 6 * k, 6 * k, false);
	for (size_t j = open ? 0 : k; j > 0; j--) {
		double radius = (double)(j - 1) / (double)k;
		size_t low = add_ring(b, 6 * (j - 1), radius, -2), high = add_ring(b, 6 * (j - 1), radius, 2);
		join_rings(b, bottom, 6 * j, low, 6 * (j - 1), true);
		join_rings(b, top, 6 * j, high, 6 * (j - 1), false);
		bottom = low;
		top = high;
	}
}

/* Surfaces of unit cells: the sides between a full and an empty one, cut into s^2 squares. */
typedef struct cells {
	size_t count[3]; /* cells along each axis */
	size_t s;
	bool holes;  /* without the cells of odd first and middle second index */
	double size; /* of a cell */
} cells;

static bool
cell_full(const cells *c, const size_t i[3])
{
	if (i[0] >= c->count[0] || i[1] >= c->count[1] || i[2] >= c->count[2])
		return false;
	return !(c->holes && i[0] % 2 == 1 && i[1] == 1);
}

/* The side of a cell across an axis, the upper one or the lower one. */
typedef struct side {
	const cells *c;
	const size_t *cell;
	size_t axis, upper;
} side;

static mr_v3
side_place(const void *arg, size_t a, size_t d)
{
	const side *o = arg;
	const cells *c = o->c;
	size_t at[3], u = (o->axis + 1) % 3, v = (o->axis + 2) % 3;
	double x[3];

	at[o->axis] = (o->cell[o->axis] + o->upper) * c->s;
	at[u] = o->cell[u] * c->s + a;
	at[v] = o->cell[v] * c->s + d;
	for (int k = 0; k < 3; k++)
		x[k] = c->size * ((double)at[k] / (double)c->s - 0.5 * (double)c->count[k]);
	return mr_vec(x[0], x[1], x[2]);
}

static void
add_cell(build *b, const cells *c, const size_t cell[3])
{
	for (size_t axis = 0; axis < 3; axis++)
		for (size_t upper = 0; upper < 2; upper++) {
			size_t beside[3] = { cell[0], cell[1], cell[2] };
			beside[axis] += upper ? 1 : (size_t)-1; /* below 0 wraps to outside */
			if (!cell_full(c, beside))
				add_grid(b, c->s, c->s, upper ? "0123" : "3210", side_place,
				    &(side){ c, cell, axis, upper });
		}
}

/* `sides` of the cells are outside, `genus` is of the whole: sides s^2 + 2 - 2 genus vertices. */
static void
add_cells(build *b, cells *c, size_t sides, size_t genus, size_t n)
{
	double squares = (double)n - 2 + 2 * (double)genus;

	c->s = whole(sqrt(squares > 0 ? squares / (double)sides : 0), 1);
	for (size_t i = 0; i < c->count[0]; i++)
		for (size_t j = 0; j < c->count[1]; j++)
			for (size_t k = 0; k < c->count[2]; k++)
				if (cell_full(c, (size_t[3]){ i, j, k }))
					add_cell(b, c, (size_t[3]){ i, j, k });
}

static void
cube(build *b, size_t n)
{
	add_cells(b, &(cells){ .count = { 1, 1, 1 }, .size = 2 }, 6, 0, n);
}

static void
boxes(build *b, size_t n, size_t genus)
{
	cells c = { .count = { 2 * genus + 1, 3, 1 }, .holes = true, .size = 1 };
	size_t flat = 2 * (3 * (2 * genus + 1) - genus), outer = 2 * (2 * genus + 1 + 3), inner = 4 * genus;

	add_cells(b, &c, flat + outer + inner, genus, n);
}

static void
make(build *b, const mr_make_opts *o, size_t n)
{
	switch (o->solid) {
	case MR_SPHERE:
		sphere(b, n);
		break;
	case MR_TORUS:
		add_tube(b, n, 1 / 0.4, 3, torus_point);
		break;
	case MR_CUBE:
		cube(b, n);
		break;
	case MR_PLANE:
		plane(b, n);
		break;
	case MR_CYLINDER:
		cylinder(b, n, o->open);
		break;
	case MR_KNOT:
		add_tube(b, n, KNOT_LENGTH / (2 * MR_PI * KNOT_TUBE), 24, knot_point);
		break;
	case MR_BOXES:
		boxes(b, n, o->genus);
		break;
	case MR_BUMPY:
	case MR_SOLIDS:
		break;
	}
}

static void
join_equal(mr_ctx *ctx, build *b)
{
	uint32_t *map = MR_NEW(ctx, b->nv, uint32_t);
	size_t count;

	mr_weld(ctx, b->p, b->nv, 0, map, &count);
	for (size_t i = 0; i < b->nv; i++) /* a new number is never greater than the old one */
		b->p[map[i]] = b->p[i];
	for (size_t f = 0; f < b->nf; f++)
		for (int k = 0; k < 3; k++)
			b->t[f].v[k] = map[b->t[f].v[k]];
	b->nv = count;
}

mr_status
mr_solid_make(mr_ctx *ctx, const mr_make_opts *o, mr_mesh *m)
{
	build b = { .ctx = ctx };

	if (o->vertices > MR_NONE / 8) /* a vertex has up to four copies, and twice as many faces */
		return mr_fail(ctx, MR_ERANGE, "%zu vertices are too many", o->vertices);
	if (o->genus > 100000)
		return mr_fail(ctx, MR_ERANGE, "a genus of %zu is too large", o->genus);
	if (o->solid == MR_BUMPY)
		return mr_bumpy(ctx, o->vertices ? o->vertices : 30000, m);
	make(&b, o, o->vertices ? o->vertices : 10000);
	join_equal(ctx, &b);
	*m = (mr_mesh){ .name = mr_solid_names[o->solid], .p = b.p, .t = b.t, .nv = b.nv, .nf = b.nf };
	return MR_OK;
}

/* ---- points uniform by area: a face by its share of the running sum of areas, then a place in it ---- */

/* The first face whose running sum of areas is above x. */
static size_t
face_at(const double *sum, size_t nf, double x)
{
	size_t low = 0, high = nf - 1;

	while (low < high) {
		size_t middle = low + (high - low) / 2;
		if (sum[middle] > x)
			high = middle;
		else
			low = middle + 1;
	}
	return low;
}

mr_status
mr_surface_sample(mr_ctx *ctx, const mr_mesh *m, size_t count, uint64_t seed, mr_v3 **points, mr_v3 **normals)
{
	mr_v3 *p = MR_NEW(ctx, count, mr_v3), *normal = MR_NEW(ctx, count, mr_v3);
	MR_SCOPE(ctx);
	double *sum = MR_NEW(ctx, m->nf, double), total = 0;
	mr_random r = { seed };

	for (size_t f = 0; f < m->nf; f++)
		sum[f] = total += mr_norm(mr_face_cross(m, f));
	if (!(total > 0))
		return mr_fail(ctx, MR_EMESH, "%s: the %zu faces have no area to sample", m->name, m->nf);
	for (size_t i = 0; i < count; i++) {
		size_t f = face_at(sum, m->nf, mr_random_real(&r) * total);
		/* uniform in the triangle (Osada, Funkhouser, Chazelle, Dobkin 2002, section 4) */
		double a = sqrt(mr_random_real(&r)), b = mr_random_real(&r);
		p[i] = mr_place_point(m, (mr_place){ (uint32_t)f, mr_vec(1 - a, a * (1 - b), a * b) });
		normal[i] = mr_unit(mr_face_cross(m, f));
	}
	*points = p;
	*normals = normal;
	return MR_OK;
}

/* A Gaussian deviate (Box, Muller 1958). */
static double
gaussian(mr_random *r)
{
	double u = 1 - mr_random_real(r), v = mr_random_real(r);

	return sqrt(-2 * log(u)) * cos(2 * MR_PI * v);
}

void
mr_add_noise(mr_v3 *p, const mr_v3 *normal, size_t n, double deviation, uint64_t seed)
{
	mr_random r = { seed };

	for (size_t i = 0; i < n; i++)
		p[i] = mr_axpy(deviation * gaussian(&r), normal[i], p[i]);
}

/* ---- texture coordinates: of a plane its own places, else around the upright axis ---- */

/* With the axis along z; bumpy, which stands on y, looks along x, where the middle of the picture is. */
static mr_v3
upright(mr_solid solid, mr_v3 p)
{
	return solid == MR_BUMPY ? mr_vec(p.z, p.x, p.y) : p;
}

static bool
on_axis(mr_v3 p)
{
	return hypot(p.x, p.y) < 1e-9;
}

/* The corners of a face around the axis: none a half turn from the first; one on it between the others. */
static void
wrap_face(const mr_v3 p[3], double uv[6])
{
	int first = on_axis(p[0]) ? 1 : 0;

	for (int k = 0; k < 3; k++) {
		double r = mr_norm(p[k]);
		uv[2 * k] = 0.5 + atan2(p[k].y, p[k].x) / (2 * MR_PI);
		uv[2 * k + 1] = 1 - acos(r > 0 ? p[k].z / r : 0) / MR_PI;
	}
	for (int k = 0; k < 3; k++)
		uv[2 * k] -= floor(uv[2 * k] - uv[2 * first] + 0.5);
	for (int k = 0; k < 3; k++)
		if (on_axis(p[k]))
			uv[2 * k] = (uv[2 * ((k + 1) % 3)] + uv[2 * ((k + 2) % 3)]) / 2;
}

void
mr_solid_texcoords(mr_ctx *ctx, mr_solid solid, const mr_mesh *m, double **corners)
{
	double *uv = MR_NEW(ctx, 6 * m->nf, double);

	for (size_t f = 0; f < m->nf; f++) {
		mr_v3 p[3];
		for (size_t k = 0; k < 3; k++) {
			p[k] = upright(solid, m->p[m->t[f].v[k]]);
			uv[6 * f + 2 * k] = (p[k].x + 1) / 2;
			uv[6 * f + 2 * k + 1] = (p[k].y + 1) / 2;
		}
		if (solid != MR_PLANE)
			wrap_face(p, uv + 6 * f);
	}
	*corners = uv;
}
