/* mesh.h -- triangle meshes as read-only views of arrays that somebody else keeps, and their connectivity.  A
 * mesh from mesh/layers.h has valid indices and finite positions; it may be non-manifold. */
#ifndef MR_MESH_H
#define MR_MESH_H

#include "base/vec.h"

#define MR_NONE UINT32_MAX

/* Half-edge 3 f + i runs from t[f].v[i] to t[f].v[(i + 1) % 3]; twin[h] is the opposite one, MR_NONE on the
 * boundary; out[v] leaves v, on the boundary along it, MR_NONE of an isolated vertex. */
typedef struct mr_topology {
	uint32_t *twin; /* 3 nf */
	uint32_t *out;  /* nv */
} mr_topology;

static inline uint32_t
mr_he_next(uint32_t h)
{
	return h % 3 == 2 ? h - 2 : h + 1;
}

static inline uint32_t
mr_he_prev(uint32_t h)
{
	return h % 3 == 0 ? h + 2 : h - 1;
}

static inline uint32_t
mr_he_from(const mr_mesh *m, uint32_t h)
{
	return m->t[h / 3].v[h % 3];
}

static inline uint32_t
mr_he_to(const mr_mesh *m, uint32_t h)
{
	return m->t[h / 3].v[(h + 1) % 3];
}

/* The next half-edge leaving the same vertex, counter-clockwise; MR_NONE at the boundary. */
static inline uint32_t
mr_he_ccw(const mr_topology *topo, uint32_t h)
{
	return topo->twin[mr_he_prev(h)];
}

/* The half-edges of an oriented manifold mesh, boundary and isolated vertices allowed, in the arena. MR_EMESH
 * names the edge of three faces or of opposite orientations, the vertex of two fans, or the face with a
 * vertex twice. */
mr_status mr_topology_build(mr_ctx *ctx, const mr_mesh *m, mr_topology *topo);

/* Neighbours of each vertex, sorted, each once: adj[start[i]] to adj[start[i + 1]]; start has nv + 1. */
typedef struct mr_adjacency {
	size_t *start;
	uint32_t *adj;
} mr_adjacency;
void mr_adjacency_build(mr_ctx *ctx, const mr_mesh *m, mr_adjacency *a);

/* Faces around each vertex, by index, of any mesh: face[start[i]] to face[start[i + 1]]. */
typedef struct mr_incidence {
	size_t *start;
	uint32_t *face;
} mr_incidence;
void mr_incidence_build(mr_ctx *ctx, const mr_mesh *m, mr_incidence *a);

/* Whether an earlier face has the corners of face f, in any order. */
bool mr_face_is_repeated(const mr_mesh *m, const mr_incidence *around, uint32_t f);

/* Whether face f has a vertex twice. */
static inline bool
mr_face_repeats(const mr_mesh *m, size_t f)
{
	const uint32_t *v = m->t[f].v;

	return v[0] == v[1] || v[1] == v[2] || v[2] == v[0];
}

static inline bool
mr_has_corner(mr_tri t, uint32_t v)
{
	return t.v[0] == v || t.v[1] == v || t.v[2] == v;
}

/* The places of face f's corners. */
static inline void
mr_corners(const mr_mesh *m, size_t f, mr_v3 p[3])
{
	for (int i = 0; i < 3; i++)
		p[i] = m->p[m->t[f].v[i]];
}

/* A place on a surface: on a face, at barycentric coordinates. */
typedef struct mr_place {
	uint32_t face;
	mr_v3 bary;
} mr_place;

/* The point there. */
static inline mr_v3
mr_place_point(const mr_mesh *m, mr_place at)
{
	const uint32_t *v = m->t[at.face].v;

	return mr_bary_point(at.bary, m->p[v[0]], m->p[v[1]], m->p[v[2]]);
}

/* Places as columns: of the vertices of one surface on another, say. */
typedef struct mr_places {
	const uint32_t *face;
	const mr_v3 *bary;
} mr_places;

static inline mr_place
mr_places_at(const mr_places *places, size_t i)
{
	return (mr_place){ places->face[i], places->bary[i] };
}

/* Twice the area times the unit normal of face f. */
static inline mr_v3
mr_face_cross(const mr_mesh *m, size_t f)
{
	mr_v3 a = m->p[m->t[f].v[0]];
	return mr_cross(mr_sub(m->p[m->t[f].v[1]], a), mr_sub(m->p[m->t[f].v[2]], a));
}

/* Which of nv vertices have a face; *count: how many do. */
void mr_vertices_used(mr_ctx *ctx, const mr_tri *t, size_t nf, size_t nv, bool **used, size_t *count);

double mr_mesh_area(const mr_ctx *ctx, const mr_mesh *m);

/* The volume that the faces enclose, positive where their normals point outward. */
double mr_mesh_volume(const mr_ctx *ctx, const mr_mesh *m);

/* The box of the mesh: of its faces' corners, or without faces of its vertices.  An isolated vertex, as at
 * the origin of a far model, does not count. */
static inline size_t
mr_mesh_places(const mr_mesh *m)
{
	return m->nf ? 3 * m->nf : m->nv;
}

static inline mr_v3
mr_mesh_place(const mr_mesh *m, size_t i)
{
	return m->p[m->nf ? m->t[i / 3].v[i % 3] : i];
}

/* Whether each face has the same corners by number. */
static inline bool
mr_same_triangles(const mr_mesh *a, const mr_mesh *b)
{
	return a->nv == b->nv && a->nf == b->nf &&
	       (a->nf == 0 || a->t == b->t || !memcmp(a->t, b->t, a->nf * sizeof *a->t));
}

/* The bounding box of its places. */
mr_box mr_mesh_box(const mr_mesh *m);

/* The diagonal of that box: the unit of every relative length and error. */
double mr_mesh_diagonal(const mr_mesh *m);

/* A length that is none: `share` of the diagonal, at least the rounding of coordinates. */
double mr_mesh_tolerance(const mr_mesh *m, double share);

/* Edge of the equilateral triangle of mean area, sqrt(4 Area / (sqrt(3) F)); 0 without faces. */
double mr_mesh_edge_scale(const mr_ctx *ctx, const mr_mesh *m);

/* Unit vertex normals by angle (Thuermer, Wuethrich 1998); zero without a face of positive area. */
void mr_vertex_normals(const mr_mesh *m, mr_v3 *normal);

/* For each vertex the sum of the normals of its faces, as long as twice their areas; in the arena. */
mr_v3 *mr_area_normals(mr_ctx *ctx, const mr_mesh *m);

#endif
