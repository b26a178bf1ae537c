/* remesh_scene.h -- what the tests of remeshing's steps work on. */
#ifndef TEST_REMESH_SCENE_H
#define TEST_REMESH_SCENE_H

#include "remesh/relax.h"
#include "shapes.h"

/* A mesh, itself as the surface that is remeshed. */
typedef struct scene {
	mr_mesh m;
	mr_topology topo;
	mr_curves curves;
	mr_dyn d;
	mr_remesh_source s;
} scene;

/* Edges whose faces meet at more than `feature` degrees lie on curves. */
static inline void
set_up(scene *x, mr_mesh m, double feature)
{
	x->m = m;
	assert_int_equal(mr_topology_build(&ctx, &x->m, &x->topo), MR_OK);
	assert_int_equal(mr_dyn_build(&ctx, &x->m, &x->topo, feature, &x->d), MR_OK);
	assert_int_equal(mr_curves_copy(&ctx, &x->d.curves, &x->curves), MR_OK);
	x->s = (mr_remesh_source){ &x->m, &x->topo, &x->curves, NULL, mr_mesh_edge_scale(&ctx, &x->m) };
}

#endif
