/*
 * parts.h -- what the files of shape.h share: building a mesh vertex by vertex.
 *
 * Private to this room.
 */
#ifndef MR_SHAPE_PARTS_H
#define MR_SHAPE_PARTS_H

#include "shape/shape.h"

/* A mesh under construction: room for exactly the vertices and faces it will have. */
typedef struct mr_solid_build {
	mr_v3 *p;
	mr_tri *t;
	size_t nv, nf;
} mr_solid_build;

/* build.c does what follows. */
mr_status mr_solid_begin(mr_ctx *ctx, size_t nv, size_t nf, mr_solid_build *b);

/* The number of the new vertex. */
uint32_t mr_solid_add_vertex(mr_solid_build *b, mr_v3 p);

/* The face i j k, and the two faces of the quadrangle i j k l, counter-clockwise. */
void mr_solid_add_face(mr_solid_build *b, uint32_t i, uint32_t j, uint32_t k);
void mr_solid_add_quad(mr_solid_build *b, uint32_t i, uint32_t j, uint32_t k, uint32_t l);

/* Vertices by key: open addressing, at most half full. */
typedef struct mr_solid_weld {
	uint64_t *key; /* plus 1; 0: empty */
	uint32_t *vertex;
	size_t mask;
} mr_solid_weld;

void mr_weld_begin(mr_ctx *ctx, size_t nv, mr_solid_weld *w);

/* The slot of the key; *is_new where it was not there: the caller stores the vertex in it. */
uint32_t *mr_weld_slot(mr_solid_weld *w, uint64_t key, bool *is_new);

/* A function of space, negative inside. */
typedef double (*mr_field)(void *arg, mr_v3 x);

/*
 * The surface where the field is zero, from its values at points `step` apart in the box,
 * outside of which it must be positive: some 4.5 vertices per squared step of area.  marching_tetrahedra.c.
 */
mr_status mr_march(mr_ctx *ctx, mr_field field, void *arg, mr_box box, double step, mr_solid_build *b);

/* The bumpy creature of about n vertices: bumpy.c. */
mr_status mr_bumpy(mr_ctx *ctx, size_t n, mr_solid_build *b);

#endif
