/* bake.h -- what a surface or a cloud looks like, in a texture of another surface (Cignoni et al. 1998).
 * Texture coordinates are rounded to a 256th of a texel; then all that decides which face a texel is on is
 * exact. */
#ifndef MR_RENDER_BAKE_H
#define MR_RENDER_BAKE_H

#include "render/raster.h"
#include "subdivide/atlas.h"

/* The source of the bake; none: the target's own fine surface. */
typedef struct mr_bake_source {
	mr_subject look;            /* a surface, or points; normal: nv, of a surface, too, or NULL */
	const mr_v3 *corner_normal; /* 3 nf, unit, zero where there is none; NULL: see look.normal */
	bool colored;               /* look has colours or pictures */
} mr_bake_source;

/* The target. */
typedef struct mr_bake_target {
	mr_mesh m;
	const double *uv;             /* 6 nf: of the corners; v upwards */
	const mr_v3 *normal;          /* 3 nf: of the corners, unit */
	mr_mesh fine;                 /* the surface that m stands for; nf 0: m itself */
	const mr_v3 *fine_normal;     /* unit */
	mr_atlas grid;                /* its vertices on each face of m */
	size_t width, height, gutter; /* of the texture */
} mr_bake_target;

typedef struct mr_baked {
	mr_image color, normal; /* pixel NULL: of a source without */
	size_t texels;          /* on faces */
	size_t turned;          /* of them, those whose normal looks away from the target */
} mr_baked;

/* Each texel shows the source along the target's normal, if that faces the same way and is at most some three
 * times as far as the nearest place, else the nearest place; for points the mean of eight, weighted by
 * distance (Franke, Nielson 1980).  Normals are in tangent space (Mikkelsen 2008); points without normals
 * take `fine`'s.  Texels off the faces continue them for `gutter`; the rest has the mean colour. */
mr_status
mr_bake_draw(mr_ctx *ctx, const mr_bake_source *s, const mr_bake_target *t, mr_baked *baked) MR_WARN_UNUSED;

/* The share of side x side texels on a face that are within another, too.  meet: for the two; or NULL. */
double mr_texture_overlap(mr_ctx *ctx, size_t nf, const double *uv, size_t side,
    void (*meet)(void *arg, uint32_t a, uint32_t b), void *arg);

#endif
