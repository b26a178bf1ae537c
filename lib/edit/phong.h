/* phong.h -- a triangle mesh with the continuous normal field of Phong shading: N(w) interpolates the vertex
 * normals, n = N / |N|, so p = b + h n(b) follows what the mesh is deformed into (Kobbelt, Vorsatz, Seidel
 * 1999). */
#ifndef MR_EDIT_PHONG_H
#define MR_EDIT_PHONG_H

#include "mesh/mesh.h"

typedef struct mr_phong {
	const mr_mesh *m;
	const mr_v3 *normal; /* as mr_vertex_normals makes them */
} mr_phong;

/* An orthonormal frame: n the Phong normal, t1 and t2 tangents. */
typedef struct mr_tangent_frame {
	mr_v3 n, t1, t2;
} mr_tangent_frame;

static inline mr_v3
mr_phong_point(const mr_phong *s, mr_place at)
{
	return mr_place_point(s->m, at);
}

/* For where the vertices' normals cancel. */
mr_v3 mr_phong_face_normal(const mr_phong *s, uint32_t face);

/* n there; the face's own normal where the vertices' cancel. */
static inline mr_v3
mr_phong_normal(const mr_phong *s, mr_place at)
{
	const uint32_t *v = s->m->t[at.face].v;
	mr_v3 n = mr_bary_point(at.bary, s->normal[v[0]], s->normal[v[1]], s->normal[v[2]]);

	return mr_norm2(n) > 0 ? mr_unit(n) : mr_phong_face_normal(s, at.face);
}

/* The larger principal curvature there, without sign: how the Phong normal turns. */
double mr_phong_curvature(const mr_phong *s, mr_place at);

/* The frame there: t1 is the face's edge 0-1 without its part along n, t2 = n x t1. */
mr_tangent_frame mr_phong_frame(const mr_phong *s, mr_place at);

/* The surface on which feet are looked for. */
typedef struct mr_foot_ground {
	mr_phong surface;
	const mr_incidence *inc;
	double tolerance; /* the residual |b + h n - p| that is accepted */
} mr_foot_ground;

typedef struct mr_foot {
	mr_place at;   /* its coordinates within 1e-9 of the face */
	double height; /* along the Phong normal */
} mr_foot;

/* Newton's method from `start`, over edges into neighbouring faces.  True where it found a foot with |height|
 * <= limit, this side of the centres of curvature; *foot is written only then. */
bool mr_foot_walk(const mr_foot_ground *g, mr_v3 p, mr_place start, double limit, mr_foot *foot);

#endif
