/*
 * limit_surface.h -- the limit surface of a control mesh as a linear function of its vertices, and the feet
 * of points on it.
 *
 * Contract: the surface is known at its nodes, the limit points of level 2; between the six nodes of a
 * triangle of level 1 it is a quadratic polynomial, which differs from the limit surface by the third order
 * of the triangle's size.
 */
#ifndef MR_FIT_LIMIT_SURFACE_H
#define MR_FIT_LIMIT_SURFACE_H

#include "space/bvh.h"
#include "subdivide/loop.h"

enum {
	MR_FIT_LEVEL = 2,     /* it is to pass nowhere through itself there */
	MR_FIT_CHILDREN = 16, /* triangles of level 2 in a control face */
	MR_FIT_PATCHES = 4,   /* triangles of level 1 */
	MR_FIT_PATCH = 6,     /* nodes of one */
	MR_FIT_SLOTS = MR_FIT_PATCHES * MR_FIT_PATCH
};

typedef struct mr_fit_surface {
	mr_loop level[MR_FIT_LEVEL + 1];
	mr_sparse s; /* nodes as combinations of the control vertices */
	mr_mesh m;   /* the nodes and the triangles of level 2 */
	mr_v3 *node; /* of m */
} mr_fit_surface;

/* The foot of a point: on a patch (a triangle of level 1), at barycentric coordinates. */
typedef struct mr_fit_foot {
	uint32_t face; /* of level 2, to walk from */
	uint32_t patch;
	mr_v3 bary;  /* of the patch */
	double dist; /* from the point to its foot */
} mr_fit_foot;

/* How far points are from a surface: units of the positions. */
typedef struct mr_fit_gap {
	double mean, rms, max;
} mr_fit_gap;

/* The surface of a control mesh, an oriented manifold (else MR_EMESH), in the arena.  crease: marks, as of
 * mr_loop_control. */
mr_status mr_fit_surface_build(mr_ctx *ctx, const mr_mesh *control, const uint8_t *crease, mr_fit_surface *s);

/* Its nodes for control vertices at x: all, or the nodes of marked control faces. */
void mr_fit_surface_move(mr_ctx *ctx, mr_fit_surface *s, const mr_v3 *x, const bool *which);

/* The six nodes of a patch: its corners a, b, c, then the middles of ab, bc, ca. */
void mr_fit_nodes(const mr_fit_surface *s, uint32_t patch, uint32_t node[MR_FIT_PATCH]);

/* The nodes of all patches of a control face. */
void mr_fit_slots(const mr_fit_surface *s, size_t face, uint32_t slot[MR_FIT_SLOTS]);

/* The polynomials that belong to them. */
void mr_fit_weights(mr_v3 bary, double w[MR_FIT_PATCH]);

/* The place of a foot; normal: unit, zero where the surface has none. */
mr_v3 mr_fit_place(const mr_fit_surface *s, const mr_fit_foot *foot, mr_v3 *normal);

/* The feet of n points, the caller's: the nearest of the whole surface, or by walking from those given. */
void mr_fit_attach(
    mr_ctx *ctx, const mr_fit_surface *s, const mr_v3 *point, size_t n, bool anew, mr_fit_foot *foot);

mr_fit_gap mr_fit_measure(const mr_ctx *ctx, const mr_fit_foot *foot, size_t n);

#endif
