/*
 * bvh_tree.h -- how the hierarchy of bvh.h lies in memory; for the files of this room only.
 *
 * Contract: a tree of four children a node, in single precision and units of the
 * mesh's own box, 128 bytes a node.  Why it is exact all the same: with c the
 * centre of the mesh and 2^-k its scale, boxes are rounded to float and grown by
 * 2^-22 of the mesh, more than the rounding of a query within 2^29 mesh sizes can
 * amount to; farther off, the rounding is below 2^-50 of the distance, and bounds
 * are lowered by 2^-40.  A nearest point is clamped to the box of its triangle, so
 * no bound can exceed the distance that is computed: the answer equals a loop's over all faces.  If most
 * vertices fill less than 2^-12 of the mesh, as with one astray at 1e12, c is among them, and a side of a box
 * at x is grown by 2^-22 of |x|, or of their extent: the rounding of a query at u is 2^-52 |u|, less than
 * that where u is near x, and below 2^-40 of the distance elsewhere.
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

/* Most nodes of a tree of n faces: every node has four children, every leaf at least one face. */
static inline size_t
bvh_node_bound(size_t n)
{
	return n > BVH_LEAF ? (n - 2) / 3 : 1;
}

/* A node or leaf still to be visited. */
typedef struct bvh_entry {
	double bound;
	uint32_t child, count;
} bvh_entry;

/* Pushes the children of a node that are there and not beyond the limit, the farthest first. */
static inline bvh_entry *
bvh_push_sorted(bvh_entry *top, const mr_bvh_node *d, const double bound[BVH_WIDE], double limit)
{
	bvh_entry *base = top;

	for (int c = 0; c < BVH_WIDE; c++) {
		bvh_entry e = { bound[c], d->child[c], d->count[c] };
		bvh_entry *at = top;
		if (e.child == MR_NONE || e.bound > limit)
			continue;
		for (; at > base && at[-1].bound < e.bound; at--)
			*at = at[-1];
		*at = e;
		top++;
	}
	return top;
}

/* Whether the box of child c meets that from lo to hi. */
static inline bool
bvh_box_meets(const mr_bvh_node *d, int c, mr_v3 lo, mr_v3 hi)
{
	return d->lo[0][c] <= hi.x && d->hi[0][c] >= lo.x && d->lo[1][c] <= hi.y && d->hi[1][c] >= lo.y &&
	       d->lo[2][c] <= hi.z && d->hi[2][c] >= lo.z;
}

/* Squared distances from q to the four boxes, lowered by what rounding can do. */
static inline void
bvh_box_distances(const mr_bvh_node *d, mr_v3 q, double out[BVH_WIDE])
{
	const double lower = 1 - 0x1p-40;

	for (int c = 0; c < BVH_WIDE; c++) {
		double ax = d->lo[0][c] - q.x, bx = q.x - d->hi[0][c];
		double ay = d->lo[1][c] - q.y, by = q.y - d->hi[1][c];
		double az = d->lo[2][c] - q.z, bz = q.z - d->hi[2][c];
		double x = ax > bx ? ax : bx, y = ay > by ? ay : by, z = az > bz ? az : bz;
		x = x > 0 ? x : 0;
		y = y > 0 ? y : 0;
		z = z > 0 ? z : 0;
		out[c] = (x * x + y * y + z * z) * lower;
	}
}

#endif
