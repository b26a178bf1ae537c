/* remesh_scene.h -- what the tests of remeshing's steps work on. */
#ifndef TEST_REMESH_SCENE_H
#define TEST_REMESH_SCENE_H

#include "remesh/relax.h"
#include "shapes.h"

/* A mesh, itself as the surface that is remeshed. */
typedef struct scene {
	mr_mesh m;
	mr_topology topo;
	uint32_t *curve;
	mr_dyn d;
	mr_remesh_source s;
} scene;

/* Edges whose faces meet at more than `feature` degrees lie on curves. */
static inline void
set_up(scene *x, mr_mesh m, double feature)
{
	x->m = m;
	assert_int_equal(mr_topology_build(&ctx, &x->m, &x->topo), MR_OK);
	assert_int_equal(mr_dyn_build(&ctx, &x->m, &x->topo, NULL, feature, &x->d), MR_OK);
	x->curve = MR_NEW(&ctx, 3 * m.nf, uint32_t);
	for (uint32_t h = 0; h < 3 * m.nf; h++)
		x->curve[h] = mr_dyn_curve(&x->d, h);
	x->s = (mr_remesh_source){ &x->m, &x->topo, x->curve, NULL, NULL, mr_mesh_edge_scale(&ctx, &x->m) };
}

/* Twins agree, out half-edges leave their vertices, boundary ones first. */
static inline void
assert_valid(const mr_dyn *d)
{
	for (uint32_t h = 0; h < 3 * d->nf; h++) {
		uint32_t g = d->twin[h];
		if (mr_dyn_face_dead(d, h / 3) || g == MR_NONE)
			continue;
		assert_int_equal(d->twin[g], h);
		assert_int_equal(d->v[g], mr_dyn_to(d, h));
		assert_int_equal(mr_dyn_to(d, g), d->v[h]);
		assert_true(mr_dyn_on_curve(d, h) == mr_dyn_on_curve(d, g));
	}
	for (uint32_t v = 0; v < d->nv; v++)
		if (d->kind[v] != MR_DEAD) {
			assert_int_equal(d->v[d->out[v]], v);
			assert_false(mr_dyn_face_dead(d, d->out[v] / 3));
		}
}

/* So many random splits, merges and flips, but for edges between vertices of a rim. */
static inline void
operate(mr_dyn *d, int steps, mr_random *random)
{
	uint8_t *mark = MR_NEW_ZERO(&ctx, d->nv + (size_t)steps, uint8_t);
	uint32_t middle;

	for (int step = 0; step < steps; step++) {
		uint32_t h = (uint32_t)(mr_random_bits(random) % (3 * d->nf));
		if (mr_dyn_face_dead(d, h / 3) || !mr_dyn_can_split(d, h))
			continue;
		switch (mr_random_bits(random) % 3) {
		case 0:
			assert_int_equal(mr_dyn_split(&ctx, d, h, d->p[d->v[h]], &middle), MR_OK);
			break;
		case 1:
			if (mr_dyn_can_collapse(d, h, mark))
				mr_dyn_collapse(d, h, d->p[mr_dyn_to(d, h)]);
			break;
		default:
			if (mr_dyn_can_flip(d, h))
				mr_dyn_flip(d, h);
		}
	}
}

#endif
