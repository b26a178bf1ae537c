/*
 * bvh_tree.h -- how the hierarchy of bvh.h lies in memory; for bvh_build.c and bvh.c only.
 *
 * Contract: a tree of four children a node, in single precision and units of the
 * mesh's own box, 128 bytes a node.  Why it is exact all the same: with c the
 * centre of the mesh and 2^-k its scale, boxes are rounded to float and grown by
 * 2^-22 of the mesh, more than the rounding of a query within 2^29 mesh sizes can
 * amount to; farther off, the rounding is below 2^-50 of the distance, and bounds
 * are lowered by 2^-40.  A nearest point is clamped to the box of its triangle, so
 * no bound can exceed the distance that is computed: the answer is that of a loop
 * over all faces.
 */
#ifndef MR_SPACE_BVH_TREE_H
#define MR_SPACE_BVH_TREE_H

#include "space/bvh.h"

enum { BVH_WIDE = 4, BVH_LEAF = 4, BVH_STACK = 256 };

typedef struct mr_bvh_node {
	float lo[3][BVH_WIDE], hi[3][BVH_WIDE];
	uint32_t child[BVH_WIDE]; /* a node; of a leaf, its first place in `face`; MR_NONE: no child */
	uint8_t count[BVH_WIDE];  /* faces of a leaf; 0: a node */
} mr_bvh_node;

struct mr_bvh {
	const mr_mesh *mesh;
	mr_bvh_node *nodes; /* the root first */
	uint32_t *face;
	mr_v3 center;
	double scale; /* a power of two: 1 / scale is the size of the mesh */
};

/* A position in units of the mesh: all of its own lie within [-1, 1]. */
static inline mr_v3
bvh_unit(const mr_bvh *bvh, mr_v3 p)
{
	return mr_mul(bvh->scale, mr_sub(p, bvh->center));
}

#endif
