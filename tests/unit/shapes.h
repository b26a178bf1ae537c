/* shapes.h -- generated surfaces for unit tests. */
#ifndef TEST_SHAPES_H
#define TEST_SHAPES_H

#include "base/random.h"
#include "measure/measure.h"
#include "shape/shape.h"
#include "unit.h"

/* In [-1/2, 1/2]^3; arguments of a call have no order, these have. */
static inline mr_v3
random_vector(mr_random *r)
{
	double x = mr_random_real(r), y = mr_random_real(r), z = mr_random_real(r);

	return mr_vec(x - 0.5, y - 0.5, z - 0.5);
}

/* A surface of about n vertices. */
static inline mr_mesh
shape(mr_solid solid, size_t n)
{
	mr_mesh m;
	mr_make_opts o = MR_MAKE_DEFAULTS;

	o.solid = solid;
	o.vertices = n;
	assert_int_equal(mr_solid_make(&ctx, &o, &m), MR_OK);
	return m;
}

/* n x n rhombs, each of two equilateral triangles with sides of 1, in the plane z = 0: vertex (n + 1) j + i
 * is the i-th of row j, faces 2 (n j + i) and the next share its diagonal from the end of row j to the begin
 * of the next. */
static inline mr_mesh
lattice(uint32_t n)
{
	mr_v3 *p = MR_NEW(&ctx, (n + 1) * (n + 1), mr_v3);
	mr_tri *t = MR_NEW(&ctx, 2 * n * n, mr_tri);

	assert_true(p && t);
	for (uint32_t j = 0; j <= n; j++)
		for (uint32_t i = 0; i <= n; i++)
			p[(n + 1) * j + i] = mr_vec(i + 0.5 * j, sqrt(0.75) * j, 0);
	for (uint32_t j = 0; j < n; j++)
		for (uint32_t i = 0; i < n; i++) {
			uint32_t v = (n + 1) * j + i, f = 2 * (n * j + i);
			t[f] = (mr_tri){ { v, v + 1, v + n + 1 } };
			t[f + 1] = (mr_tri){ { v + 1, v + n + 2, v + n + 1 } };
		}
	return (mr_mesh){ "lattice", p, t, (n + 1) * (n + 1), 2 * n * n };
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

static inline mr_census
census_of(const mr_mesh *m)
{
	mr_edges edges;
	mr_census c;

	mr_edges_build(&ctx, m, &edges);
	mr_take_census(&ctx, m, &edges, &c);
	return c;
}

#endif
