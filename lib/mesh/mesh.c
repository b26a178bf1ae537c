/* Connectivity of triangle meshes by counting sorts: half-edges (Kettner 1999), the faces and neighbours of
 * vertices; and their normals. */
#include "mesh/mesh.h"

#include "base/parallel.h"
#include "base/sort.h"
#include "base/vectors.h"
#include "mesh/edges.h"

static mr_status
check_corners(mr_ctx *ctx, const mr_mesh *m)
{
	for (size_t f = 0; f < m->nf; f++) {
		const uint32_t *v = m->t[f].v;
		if (mr_face_repeats(m, f))
			return mr_advise(ctx, MR_REPAIR,
			    mr_fail(ctx, MR_EMESH, "%s: face %zu (%u %u %u) has a vertex twice", m->name, f,
				v[0], v[1], v[2]));
	}
	return MR_OK;
}

static mr_status
match_twins(mr_ctx *ctx, const mr_mesh *m, const mr_edges *edges, uint32_t *twin)
{
	for (size_t e = 0; e < edges->count; e++) {
		const uint32_t *h = edges->he + edges->start[e];
		uint32_t n = mr_edge_faces(edges, e), a = mr_he_from(m, h[0]), b = mr_he_to(m, h[0]);
		if (n > 2)
			return mr_advise(ctx, MR_REPAIR,
			    mr_fail(ctx, MR_EMESH, "%s: edge %u-%u has %u faces", m->name, a, b, n));
		if (n == 2 && mr_same_direction(m, h[0], h[1]))
			return mr_advise(ctx, MR_REPAIR,
			    mr_fail(ctx, MR_EMESH,
				"%s: the two faces at edge %u-%u have opposite orientations", m->name, a, b));
		twin[h[0]] = n == 2 ? h[1] : MR_NONE;
		if (n == 2)
			twin[h[1]] = h[0];
	}
	return MR_OK;
}

/* The number of faces met by turning counter-clockwise from h, once around or to the boundary. */
static uint32_t
fan_size(const mr_topology *topo, uint32_t h)
{
	uint32_t n = 0, g = h;

	do {
		n++;
		g = mr_he_ccw(topo, g);
	} while (g != MR_NONE && g != h);
	return n;
}

/* Whether a vertex rather keeps h than g: one of the boundary, or to the lower vertex. */
static bool
is_better(const mr_mesh *m, const uint32_t *twin, uint32_t h, uint32_t g)
{
	bool boundary = twin[h] == MR_NONE;

	return boundary != (twin[g] == MR_NONE) ? boundary : mr_he_to(m, h) < mr_he_to(m, g);
}

/* Picks the half-edge that each vertex keeps, and finds vertices whose faces form several fans. */
static mr_status
choose_out(mr_ctx *ctx, const mr_mesh *m, mr_topology *topo)
{
	uint32_t *degree = MR_NEW_ZERO(ctx, m->nv, uint32_t);

	memset(topo->out, 0xff, m->nv * sizeof *topo->out);
	for (uint32_t h = 0; h < 3 * m->nf; h++) {
		uint32_t *out = &topo->out[mr_he_from(m, h)];
		degree[mr_he_from(m, h)]++;
		if (*out == MR_NONE || is_better(m, topo->twin, h, *out))
			*out = h;
	}
	for (uint32_t v = 0; v < m->nv; v++)
		if (degree[v] && fan_size(topo, topo->out[v]) != degree[v])
			return mr_advise(ctx, MR_REPAIR,
			    mr_fail(ctx, MR_EMESH, "%s: the %u faces at vertex %u form more than one fan",
				m->name, degree[v], v));
	return MR_OK;
}

mr_status
mr_topology_build(mr_ctx *ctx, const mr_mesh *m, mr_topology *topo)
{
	mr_topology r = { MR_NEW(ctx, 3 * m->nf, uint32_t), MR_NEW(ctx, m->nv, uint32_t) };
	MR_SCOPE(ctx);
	mr_edges edges;

	MR_TRY(check_corners(ctx, m));
	mr_edges_build(ctx, m, &edges);
	MR_TRY(match_twins(ctx, m, &edges, r.twin));
	MR_TRY(choose_out(ctx, m, &r));
	*topo = r;
	return MR_OK;
}

void
mr_incidence_build(mr_ctx *ctx, const mr_mesh *m, mr_incidence *a)
{
	size_t *start = MR_NEW_ZERO(ctx, m->nv + 2, size_t);
	uint32_t *face = MR_NEW(ctx, 3 * m->nf, uint32_t);

	for (size_t f = 0; f < m->nf; f++)
		for (int i = 0; i < 3; i++)
			start[m->t[f].v[i] + 2]++;
	for (size_t v = 0; v <= m->nv; v++)
		start[v + 1] += start[v];
	for (uint32_t f = 0; f < m->nf; f++)
		for (int i = 0; i < 3; i++)
			face[start[m->t[f].v[i] + 1]++] = f;
	*a = (mr_incidence){ start, face };
}

bool
mr_face_is_repeated(const mr_mesh *m, const mr_incidence *around, uint32_t f)
{
	const size_t *start = around->start;
	const uint32_t *v = m->t[f].v;
	uint32_t a = v[0]; /* which the fewest have */

	for (int k = 1; k < 3; k++)
		a = start[v[k] + 1] - start[v[k]] < start[a + 1] - start[a] ? v[k] : a;
	for (size_t i = start[a]; around->face[i] < f; i++) {
		mr_tri t = m->t[around->face[i]];
		if (mr_has_corner(t, v[0]) && mr_has_corner(t, v[1]) && mr_has_corner(t, v[2]))
			return true;
	}
	return false;
}

void
mr_adjacency_build(mr_ctx *ctx, const mr_mesh *m, mr_adjacency *a)
{
	size_t *start = MR_NEW(ctx, m->nv + 1, size_t), n = 0;
	uint32_t *adj = MR_NEW(ctx, 6 * m->nf, uint32_t);
	MR_SCOPE(ctx);
	mr_incidence inc;

	mr_incidence_build(ctx, m, &inc);
	for (uint32_t v = 0; v < m->nv; v++) {
		size_t first = n;
		start[v] = first;
		for (size_t i = inc.start[v]; i < inc.start[v + 1]; i++)
			for (int k = 0; k < 3; k++) {
				uint32_t w = m->t[inc.face[i]].v[k];
				if (w != v)
					adj[n++] = w;
			}
		n = first + mr_sort_unique(adj + first, n - first);
	}
	start[m->nv] = n;
	*a = (mr_adjacency){ start, adj };
}

static double
face_area(void *arg, size_t f)
{
	return 0.5 * mr_norm(mr_face_cross(arg, f));
}

double
mr_mesh_area(const mr_ctx *ctx, const mr_mesh *m)
{
	mr_mesh copy = *m;

	return mr_parallel_sum(ctx, m->nf, face_area, &copy);
}

typedef struct cones {
	const mr_mesh *m;
	mr_v3 apex;
} cones;

/* Six times the volume between the face and the apex. */
static double
cone(void *arg, size_t f)
{
	const cones *c = arg;
	const uint32_t *v = c->m->t[f].v;
	mr_v3 a = mr_sub(c->m->p[v[0]], c->apex), b = mr_sub(c->m->p[v[1]], c->apex);

	return mr_dot(a, mr_cross(b, mr_sub(c->m->p[v[2]], c->apex)));
}

double
mr_mesh_volume(const mr_ctx *ctx, const mr_mesh *m)
{
	mr_box box = mr_mesh_box(m);

	return mr_parallel_sum(ctx, m->nf, cone, &(cones){ m, mr_lerp(0.5, box.min, box.max) }) / 6;
}

void
mr_vertices_used(mr_ctx *ctx, const mr_tri *t, size_t nf, size_t nv, bool **used, size_t *count)
{
	*used = MR_NEW_ZERO(ctx, nv, bool);
	*count = 0;
	for (size_t c = 0; c < 3 * nf; c++) {
		bool *own = &(*used)[t[c / 3].v[c % 3]];
		*count += !*own;
		*own = true;
	}
}

mr_box
mr_mesh_box(const mr_mesh *m)
{
	mr_box b = mr_box_empty();

	for (size_t i = 0; i < mr_mesh_places(m); i++)
		mr_box_add(&b, mr_mesh_place(m, i));
	return b;
}

double
mr_mesh_diagonal(const mr_mesh *m)
{
	return mr_box_diagonal(mr_mesh_box(m));
}

double
mr_mesh_tolerance(const mr_mesh *m, double share)
{
	return mr_box_tolerance(mr_mesh_box(m), share);
}

double
mr_mesh_edge_scale(const mr_ctx *ctx, const mr_mesh *m)
{
	return m->nf ? sqrt(4 * mr_mesh_area(ctx, m) / (sqrt(3) * (double)m->nf)) : 0;
}

/* The angles of points (x, y), y > 0, from the x axis, within a few units in the last place: by a minimax
 * polynomial of atan for each eighth of a turn. */
MR_VECTORS static void
find_angles(const double *y, const double *x, size_t n, double *angle)
{
	static const double c[] = { 1, -0.3333333333333312, 0.19999999999940837, -0.14285714279244968,
		0.11111110744657099, -0.09090896801472813, 0.07692045194561481, -0.06662950246036792,
		0.05846866752275139, -0.05035049795312439, 0.03796390316111083, -0.017803896394812564 };
	const double eighth = MR_PI / 4, slope = 0.41421356237309503; /* of a sixteenth */

	for (size_t i = 0; i < n; i++) {
		double ax = fabs(x[i]), low = ax < y[i] ? ax : y[i], high = ax < y[i] ? y[i] : ax;
		double turn = low > slope * high ? 1 : 0, t = (low - turn * high) / (high + turn * low);
		double steep = ax < y[i] ? -1 : 1, quarter = ax < y[i] ? MR_PI / 2 : 0;
		double back = x[i] < 0 ? -1 : 1, half = x[i] < 0 ? MR_PI : 0, z = t * t, sum = c[11];
		for (int k = 10; k >= 0; k--)
			sum = c[k] + z * sum;
		angle[i] = half + back * (quarter + steep * (turn * eighth + t * sum));
	}
}

enum { AT_ONCE = 64, SOON = 16 };

/* To their corners' sums, of at most AT_ONCE faces; nothing where a face has no area. */
static void
add_normals(const mr_mesh *m, size_t first, size_t n, mr_v3 *sum)
{
	double y[2 * AT_ONCE], x[2 * AT_ONCE], angle[2 * AT_ONCE];
	mr_v3 unit[AT_ONCE];

	for (size_t i = 0; i < n; i++) {
		const uint32_t *v = m->t[first + i].v;
		const uint32_t *soon = m->t[first + i + SOON < m->nf ? first + i + SOON : first].v;
		mr_v3 a = mr_sub(m->p[v[1]], m->p[v[0]]), b = mr_sub(m->p[v[2]], m->p[v[0]]);
		mr_v3 cross = mr_cross(a, b);
		double twice_area = mr_norm(cross);

		y[2 * i] = y[2 * i + 1] = twice_area;
		x[2 * i] = mr_dot(a, b);
		x[2 * i + 1] = mr_dot(a, mr_sub(a, b));
		unit[i] = mr_mul(1 / twice_area, cross);
		mr_soon(m->p, sizeof *m->p, soon);
		mr_soon(sum, sizeof *sum, soon);
	}
	find_angles(y, x, 2 * n, angle);
	for (size_t i = 0; i < n; i++) {
		const uint32_t *v = m->t[first + i].v;
		double a = angle[2 * i], b = angle[2 * i + 1];
		if (!(y[2 * i] > 0))
			continue;
		sum[v[0]] = mr_axpy(a, unit[i], sum[v[0]]);
		sum[v[1]] = mr_axpy(b, unit[i], sum[v[1]]);
		sum[v[2]] = mr_axpy(MR_PI - a - b, unit[i], sum[v[2]]);
	}
}

mr_v3 *
mr_area_normals(mr_ctx *ctx, const mr_mesh *m)
{
	mr_v3 *sum = MR_NEW_ZERO(ctx, m->nv, mr_v3);

	for (size_t f = 0; f < m->nf; f++) {
		mr_v3 n = mr_face_cross(m, f);
		for (int k = 0; k < 3; k++)
			sum[m->t[f].v[k]] = mr_add(sum[m->t[f].v[k]], n);
	}
	return sum;
}

void
mr_vertex_normals(const mr_mesh *m, mr_v3 *normal)
{
	memset(normal, 0, m->nv * sizeof *normal);
	for (size_t f = 0; f < m->nf; f += AT_ONCE)
		add_normals(m, f, m->nf - f < AT_ONCE ? m->nf - f : AT_ONCE, normal);
	for (size_t v = 0; v < m->nv; v++)
		normal[v] = mr_unit(normal[v]);
}
