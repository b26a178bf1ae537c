/* voronoi_area.h -- the area that belongs to each vertex of any mesh; the sum is the mesh's area. */
#ifndef MR_OP_VORONOI_AREA_H
#define MR_OP_VORONOI_AREA_H

#include "mesh/mesh.h"

/* Mixed Voronoi areas: circumcentric parts, edge midpoints in obtuse triangles.  area: nv. */
void mr_voronoi_areas(mr_ctx *ctx, const mr_mesh *m, double *area);

/* The parts of the triangle a b c that belong to its corners; their sum is its area. */
static inline void
mr_voronoi_corners(mr_v3 a, mr_v3 b, mr_v3 c, double part[3])
{
	mr_v3 ab = mr_sub(b, a), bc = mr_sub(c, b), ca = mr_sub(a, c);
	double twice = mr_norm(mr_cross(ab, ca));
	double dot[3] = { -mr_dot(ab, ca), -mr_dot(bc, ab), -mr_dot(ca, bc) };
	double eighth = twice > 0 ? 1 / (8 * twice) : 0;
	bool obtuse = false;

	/* |e|^2 cot / 8 of the angle opposite, for both edges e at a corner; |e|^2 is the sum of the dots at
	 * its ends */
	for (int i = 0; i < 3; i++) {
		double at = dot[i], next = dot[(i + 1) % 3], last = dot[(i + 2) % 3];
		part[i] = ((at + next) * last + (at + last) * next) * eighth;
		obtuse |= at <= 0;
	}
	for (int i = 0; i < 3 && obtuse; i++)
		part[i] = dot[i] <= 0 ? twice / 4 : twice / 8;
}

#endif
