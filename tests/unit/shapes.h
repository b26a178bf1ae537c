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

/* Both in one mesh, b moved by `shift`. */
static inline mr_mesh
both(const mr_mesh *a, const mr_mesh *b, mr_v3 shift)
{
	mr_v3 *p = MR_NEW(&ctx, a->nv + b->nv, mr_v3);
	mr_tri *t = MR_NEW(&ctx, a->nf + b->nf, mr_tri);

	assert_true(p && t);
	memcpy(p, a->p, a->nv * sizeof *p);
	memcpy(t, a->t, a->nf * sizeof *t);
	for (size_t v = 0; v < b->nv; v++)
		p[a->nv + v] = mr_add(b->p[v], shift);
	for (size_t f = 0; f < b->nf; f++)
		for (int k = 0; k < 3; k++)
			t[a->nf + f].v[k] = (uint32_t)a->nv + b->t[f].v[k];
	return (mr_mesh){ "both", p, t, a->nv + b->nv, a->nf + b->nf };
}

#endif
