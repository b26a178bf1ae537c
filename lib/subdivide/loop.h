/*
 * loop.h -- Loop's subdivision surfaces: connectivity level by level, subdivision and limit stencils.
 *
 * Rules: Loop 1987 inside, cubic B-splines on the boundary and on creases, corners where other than two of
 * those meet (Hoppe et al. 1994).  With n neighbours, beta = (5/8 - (3/8 + cos(2 pi / n) / 4)^2) / n.
 *
 * Contract: the vertices of a level keep their numbers on all finer ones, so what belongs to a coarse level
 * is a prefix of what belongs to a fine one.  The odd vertices follow, one an edge, in the order of the lower
 * half-edge of each.  Triangle f = (a, b, c) with the odd vertices ab, bc, ca becomes 4 f: (a, ab, ca),
 * 4 f + 1: (ab, b, bc), 4 f + 2: (ca, bc, c), 4 f + 3: (ab, bc, ca).
 */
#ifndef MR_SUBDIVIDE_LOOP_H
#define MR_SUBDIVIDE_LOOP_H

#include "mesh/mesh.h"
#include "solve/sparse.h"

/* One level. */
typedef struct mr_loop {
	size_t nv, nf;
	const mr_tri *t;
	mr_topology topo;
	const bool *crease;   /* of each half-edge; NULL: no crease but the boundary */
	size_t coarse_nv;     /* vertices of the level below, which come first; nv where there is none */
	const uint32_t *edge; /* of odd vertex coarse_nv + i: its half-edge on the level below */
	const uint32_t *odd;  /* of each half-edge on the level below: its odd vertex; NULL: t has them */
} mr_loop;

/*
 * Level 0: the control mesh, oriented manifold, boundary allowed (else MR_EMESH).  Creases are edges whose
 * faces meet at more than `crease` degrees (180: none), and those that are marked on either side: 3 m->nf, 0
 * where one is not; NULL: none.  Isolated vertices stay where they are on every level.  l: in the arena.
 */
mr_status mr_loop_control(mr_ctx *ctx, const mr_mesh *m, double crease, const uint8_t *mark, mr_loop *l);

/* The next level, in the arena.  MR_ERANGE where it would have 2^32 half-edges or more. */
mr_status mr_loop_refine(mr_ctx *ctx, const mr_loop *coarse, mr_loop *fine);

/* The same without faces: t, topo and crease are empty. */
void mr_loop_refine_vertices(mr_ctx *ctx, const mr_loop *coarse, mr_loop *fine);

/* Boundary edges of a level. */
size_t mr_loop_boundary(const mr_loop *l);

/* Levels 0 to n: level[0] to level[n], the caller's, over m.  MR_ERANGE as above, before any work. */
mr_status
mr_loop_levels(mr_ctx *ctx, const mr_mesh *m, double crease, const uint8_t *mark, size_t n, mr_loop *level);

/* Vertices on level n of a closed or open mesh with nv vertices, nf faces and `boundary` boundary edges;
 * SIZE_MAX where that is too many. */
size_t mr_loop_count(size_t nv, size_t nf, size_t boundary, size_t n);

/* The corners of triangle f on level n in its triangle of level 0, f >> 2 n. */
void mr_loop_corners(size_t n, size_t f, mr_v3 at[3]);

/*
 * Values on the fine level from the coarse level below it: `width` a vertex, next to each other.  in:
 * coarse->nv rows; out: fine->nv rows, the caller's, elsewhere.
 */
void mr_loop_subdivide(const mr_ctx *ctx, const mr_loop *coarse, const mr_loop *fine, size_t width,
    const double *in, double *out);

/* The same from level 0 to level n: in: level[0].nv rows; out: level[n].nv rows, the caller's, elsewhere. */
void mr_loop_values(mr_ctx *ctx, const mr_loop *level, size_t n, size_t width, const double *in, double *out);

/* The odd rows alone: out has fine->nv - coarse->nv rows. */
void mr_loop_predict(const mr_ctx *ctx, const mr_loop *coarse, const mr_loop *fine, size_t width,
    const double *in, double *out);

/*
 * Limit points and unit limit normals of the level's vertices at p, nv each, the caller's, either may be
 * NULL, neither p.  On a crease and at a corner a normal is the unit sum of the normals of the sectors
 * between sharp edges; it is zero where the limit tangents are parallel.
 */
void mr_loop_limit(const mr_ctx *ctx, const mr_loop *l, const mr_v3 *p, mr_v3 *limit, mr_v3 *normal);

/*
 * The limit points of level n's vertices as combinations of the control vertices: level[n].nv rows, each of
 * sum 1, columns below level[0].nv.  s: in the arena, above its temporaries.  MR_ERANGE if it has 2^31
 * weights or more.
 */
mr_status mr_loop_limit_matrix(mr_ctx *ctx, const mr_loop *level, size_t n, mr_sparse *s);

#endif
