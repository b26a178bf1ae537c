/*
 * deform_rotations.h -- posing by interpolated or fitted rotations, and rounds of as-rigid-as-possible steps
 * on top.
 *
 * The map of a handle is a rotation times a stretch, R S, by polar decomposition.  Relative to what moves the
 * whole, the logarithms of the rotations and the stretches are interpolated over the free vertices by weights
 * w, 1 on one handle and 0 on the other constraints: harmonic fields (Zayer, Roessl, Karni, Seidel 2005:
 * Harmonic guidance for surface deformation; Lipman, Sorkine, Levin, Cohen-Or 2005: Linear rotation-invariant
 * coordinates for meshes), eased to 3 w^2 - 2 w^3 so that the handles join without a crease.  Limbs that hang
 * between have one weight, and stay rigid.  The maps A = exp(sum of w log R) S turn the gradients of the
 * rest; with b their divergence, D^k p = D^(k-1) M^-1 b is solved with the system's own factor: there is
 * nothing new but right-hand sides.
 *
 * Gradients that are turned and no more belong to no surface: a tube of radius r that is twisted by a radians
 * a unit of its length also shears, by r a, and where its gradients deny that it shrinks, to
 * r / (1 + r^2 a^2).  So each face takes the gradient of A (p - c), of which the weights' gradient is a part,
 * c being the centroid of the section through it, the piece of its weight's level set: sections stay plane as
 * a beam's do.  A twist, by however many turns, is then exact.  Of several limbs, at one handle or where one
 * branches, each has sections of its own.
 *
 * What is as rigid as possible is a shell, which rather pinches and buckles than stretches.  After a round,
 * where the free part encloses less than nine tenths of its volume, it is blown up to that by a pressure that
 * is the same everywhere: with g the derivative of the volume by the vertices, p moves along K^-1 g, the way
 * of least energy, until the volume is right, which is a cubic of how far.
 *
 * Private to this room.
 */
#ifndef MR_EDIT_DEFORM_ROTATIONS_H
#define MR_EDIT_DEFORM_ROTATIONS_H

#include "edit/deform_volume.h"

/* Centroids along a weight, between which they are interpolated.  The edges of bends by 120 degrees are off
 * by up to 1 % more with 4 of them, and by nothing that counts with 8 or 64. */
enum { MR_SECTIONS = 16 };

typedef struct mr_clusters mr_clusters; /* deform_clusters.h */

/* What poses need, made once.  Vertices and faces are those of the patch. */
struct mr_rotations {
	mr_deform *membrane; /* the system of order 1, for rounds; d itself where that is its order */
	mr_incidence around; /* faces of each vertex */
	double (*cot)[3];    /* of each face */
	size_t count;        /* handles with weights: all but what moves the whole */
	uint32_t *region;    /* of each, count */
	double *weight;      /* count for each vertex */
	mr_v3 *center;       /* of each section */
	uint32_t (
	    *section)[2]; /* of each face and handle, its sections at the levels below and above its weight */
	/* Workspace, kept from pose to pose. */
	mr_v3 *rest, *q, *before; /* a vertex each */
	mr_mat3 *map;             /* A of each vertex */
	double *face;             /* 9 for each face */
	double *source;           /* 3 for each vertex */
	mr_volume volume;         /* for rounds, and what is fitted */
	mr_clusters *clusters;    /* NULL: rotations are interpolated, no more */
};

/* The level below a weight in levels, and not the last. */
static inline int
mr_section_below(double level)
{
	return level < MR_SECTIONS ? (int)level : MR_SECTIONS - 1;
}

/* Puts center and section, of weights that are there. */
mr_status mr_sections_find(mr_ctx *ctx, const mr_mesh *m, mr_rotations *r);

/* Makes d->rotations, once. */
mr_status mr_rotations_make(mr_ctx *ctx, mr_deform *d);

/* Frees what is no arena's.  Accepts d without them. */
void mr_rotations_free(mr_deform *d);

/*
 * As mr_deform_follow, by rotations if d is to turn, and then by rounds.  maps NULL: the constraints go where
 * p has them, which tells no rotation.
 */
mr_status mr_rotations_follow(
    mr_ctx *ctx, mr_deform *d, const mr_affine *whole, const mr_v3 *p0, const mr_deform_maps *maps, mr_v3 *p);

#endif
