/*
 * shape.h -- generated surfaces with known geometry, samples of a surface, and noise.
 *
 * Contract: every shape is an oriented manifold, outward; closed but for the plane
 * and the open cylinder.  Positions depend on the options only (and on libm's last bit).
 *
 *	sphere    radius 1; a geodesic icosahedron of frequency f: 10 f^2 + 2 vertices
 *	torus     radii 1 and 0.4 about the z axis
 *	cube      [-1, 1]^3, s^2 squares a side: 6 s^2 + 2 vertices
 *	plane     [-1, 1]^2 at z = 0, upward: (s + 1)^2 vertices
 *	cylinder  radius 1 about the z axis, |z| <= 2, closed unless `open`
 *	knot      tube of radius 0.2 around the (2, 3) knot on a torus of radii 1 and 0.45
 *	bumpy     a creature with limbs and a scaly skin, y upward: at least 5,000 vertices
 *	boxes     a slab of 2 g + 1 by 3 by 1 unit cells without every other inner one: genus g
 */
#ifndef MR_SHAPE_H
#define MR_SHAPE_H

#include "mesh/mesh.h"

/* The names of the solids, in the order of mr_solid. */
extern const char *const mr_solid_names[MR_SOLIDS];

/* The shape, in the arena; its name is the solid's. */
mr_status mr_solid_make(mr_ctx *ctx, const mr_make_opts *opts, mr_mesh *m);

/* The bumpy creature of about n vertices, in the arena. */
mr_status mr_bumpy(mr_ctx *ctx, size_t n, mr_mesh *m);

/* Texture coordinates of the corners of a solid as it was made: a picture fills the square from 0 to 1, on a
 * plane, and around the upright axis of all else.  corners: 6 nf, in the arena. */
void mr_solid_texcoords(mr_ctx *ctx, mr_solid solid, const mr_mesh *m, double **corners);

/* `count` points drawn uniformly by area with the seed, in the arena, each with the unit normal of its face.
 * MR_EMESH where the surface has no area. */
mr_status mr_surface_sample(
    mr_ctx *ctx, const mr_mesh *m, size_t count, uint64_t seed, mr_v3 **points, mr_v3 **normals);

/* Moves n points along their normals by Gaussian distances of standard deviation `deviation`. */
void mr_add_noise(mr_v3 *p, const mr_v3 *normal, size_t n, double deviation, uint64_t seed);

#endif
