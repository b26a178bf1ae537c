/* deform_energy.h -- posing by local and global steps: an energy says what gradient each face shall have, the
 * system finds the surface whose gradients come nearest.  The handles' maps R S (polar decomposition) are
 * interpolated by weights, the system's response to 1 (Zayer, Roessl, Karni, Seidel 2005; Lipman, Sorkine,
 * Levin, Cohen-Or 2005).  Gradients that are only turned shrink a tube of radius r, twisted by a a unit, to r
 * / (1 + r^2 a^2).  So each face takes the gradient of A (p - c), c the centroid of the section through it, a
 * piece of the weight's level set, and twists are exact.  As rigid as possible (Sorkine, Alexa 2007) is a
 * shell: what encloses a volume keeps nine tenths of it.  Private to this room. */
#ifndef MR_EDIT_DEFORM_ENERGY_H
#define MR_EDIT_DEFORM_ENERGY_H

#include "edit/deform_system.h"

typedef struct mr_energies mr_energies;

/* The data of poses beyond the system, by s->opts; *e NULL: nothing.  region: of the mesh's vertices; lowest:
 * the region that moves the whole.  s, region: borrowed. */
mr_status mr_energies_make(mr_ctx *ctx, mr_deform_system *s, const uint32_t *region, uint32_t lowest,
    mr_energies **e) MR_WARN_UNUSED;

/* As mr_system_follow, by the energies of s->opts. */
mr_status mr_energies_follow(mr_ctx *ctx, mr_energies *e, const mr_affine *whole, const mr_v3 *p0,
    const mr_deform_maps *maps, mr_v3 *p) MR_WARN_UNUSED;

/* For a face and a weight: the centroid of the section through it, a piece of the weight's level set, and by
 * how much the weight differs across the face, squared. */
typedef struct mr_section {
	mr_v3 center;
	double spread2;
} mr_section;

/* weight: `count` for each vertex; cot: of the corners of each face.  Returns `count` for each face. */
mr_section *
mr_sections_find(mr_ctx *ctx, const mr_mesh *m, const double *weight, size_t count, const double (*cot)[3]);

/* The faces that enclose a patch's volume: its own, by the mesh's vertices, and a closing over its rim, which
 * moves with the constraints; none where it ends at a free boundary.  region: of each vertex of the mesh. */
mr_mesh mr_inside_make(mr_ctx *ctx, const mr_patch *patch, const uint32_t *region);

/* Moves the free vertices along K^-1 g, g the derivative of the volume by them, the way of least energy,
 * until the volume is `least`. */
mr_status mr_inside_keep(
    mr_ctx *ctx, mr_deform_system *s, const mr_mesh *inside, double least, mr_v3 *p) MR_WARN_UNUSED;

#endif
