/*
 * deform_energy.h -- posing by local and global steps: an energy says for each face what gradient it shall
 * have, and the system finds the surface whose gradients come nearest.
 *
 * The map of a handle is a rotation times a stretch, R S, by polar decomposition.  Relative to what moves the
 * whole, the logarithms of the rotations and the stretches are interpolated over the free vertices by weights
 * w, 1 on one handle and 0 on the other constraints (Zayer, Roessl, Karni, Seidel 2005: Harmonic guidance for
 * surface deformation; Lipman, Sorkine, Levin, Cohen-Or 2005: Linear rotation-invariant coordinates for
 * meshes): the system's own response to 1, which joins the handles as smoothly as the surface does.  Limbs
 * that hang between have one weight, and stay rigid.  The maps A = exp(sum of w log R) S turn the gradients
 * of the rest; with b their divergence, D^k p = D^(k-1) M^-1 b is solved: there is nothing new but right-hand
 * sides.
 *
 * Gradients that are turned and no more belong to no surface: a tube of radius r that is twisted by a radians
 * a unit of its length also shears, by r a, and where its gradients deny that it shrinks, to
 * r / (1 + r^2 a^2).  So each face takes the gradient of A (p - c), of which the weights' gradient is a part,
 * c being the centroid of the section through it, the piece of its weight's level set: sections stay plane as
 * a beam's do.  A twist, by however many turns, is then exact.
 *
 * As rigid as possible (Sorkine, Alexa 2007) is a shell, which rather pinches and buckles than stretches:
 * what encloses a volume keeps nine tenths of it.  Private to this room.
 */
#ifndef MR_EDIT_DEFORM_ENERGY_H
#define MR_EDIT_DEFORM_ENERGY_H

#include "edit/deform_system.h"

typedef struct mr_energies mr_energies;

/*
 * What poses need beyond the system, by s->opts: *e is NULL where that is nothing.  region: of the mesh's
 * vertices; lowest: that which moves the whole.  s, region: borrowed.
 */
mr_status mr_energies_make(mr_ctx *ctx, mr_deform_system *s, const uint32_t *region, uint32_t lowest,
    mr_energies **e) MR_WARN_UNUSED;

/* As mr_system_follow, by the energies of s->opts. */
mr_status mr_energies_follow(mr_ctx *ctx, mr_energies *e, const mr_affine *whole, const mr_v3 *p0,
    const mr_deform_maps *maps, mr_v3 *p) MR_WARN_UNUSED;

/*
 * Sections through what turns: the level sets of weights, piece by piece, as a handle may hold several limbs
 * and limbs may branch.
 *
 * Of a face and a weight: the centroid of the section through it, and by how much the weight differs across
 * the face, squared.
 */
typedef struct mr_section {
	mr_v3 center;
	double spread2;
} mr_section;

/* weight: `count` for each vertex; cot: of the corners of each face.  Returns `count` for each face. */
mr_section *
mr_sections_find(mr_ctx *ctx, const mr_mesh *m, const double *weight, size_t count, const double (*cot)[3]);

/*
 * The volume that a patch encloses, and the pressure that keeps it.  With g the derivative of the volume by
 * the vertices, p moves along K^-1 g, the way of least energy, until the volume is right, which is a cubic of
 * how far.
 *
 * What is enclosed has the patch's own faces, by the mesh's vertices, and behind them those that close it
 * over its rim, which go with the constraints; none where the patch ends at a boundary that is free.  region:
 * of each vertex of the mesh.
 */
mr_mesh mr_inside_make(mr_ctx *ctx, const mr_patch *patch, const uint32_t *region);

/* Moves the free vertices by as much pressure as makes the volume `least`. */
mr_status mr_inside_keep(
    mr_ctx *ctx, mr_deform_system *s, const mr_mesh *inside, double least, mr_v3 *p) MR_WARN_UNUSED;

#endif
