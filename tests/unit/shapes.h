/* shapes.h -- generated surfaces for unit tests. */
#ifndef TEST_SHAPES_H
#define TEST_SHAPES_H

#include "shape/shape.h"
#include "unit.h"

/* A surface of about n vertices. */
static inline mr_mesh
shape(mr_solid solid, size_t n)
{
	mr_mesh m;
	mr_solid_opts o = MR_SOLID_DEFAULTS;

	o.solid = solid;
	o.vertices = n;
	assert_int_equal(mr_solid_make(&ctx, &o, &m), MR_OK);
	return m;
}

#endif
