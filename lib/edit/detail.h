/* detail.h -- the detail of a mesh over its base, as displacements along the base's Phong normals.  On the
 * same base they give every vertex back to within rounding. */
#ifndef MR_EDIT_DETAIL_H
#define MR_EDIT_DETAIL_H

#include "edit/phong.h"
#include "edit/turns.h"
#include "space/source_map.h"

/* The undeformed base, as decoding uses it. */
typedef struct mr_prepared {
	mr_v3 *normal; /* of its vertices */
	mr_scatter scatter;
} mr_prepared;

/* The columns mesh.detail_* and base.encoded: vertex i is b + h n + t1 o.x + t2 o.y + n o.z, b the point bary
 * of the triangle `face`, n its Phong normal, t1 and t2 as in mr_phong_frame; h or o is 0. */
typedef struct mr_detail {
	size_t n;
	mr_places at; /* on the base */
	const double *height;
	const mr_v3 *offset;         /* NULL: every vertex has a height */
	const mr_v3 *rest;           /* positions of the base where it was encoded */
	const mr_prepared *prepared; /* NULL: to be made */
} mr_detail;

/* Encodes the mesh over the base.  source: checked, or NULL: the base's nearest points.  MR_ERANGE where a
 * detail is not finite.  d: the arena's.  result: or NULL. */
mr_status mr_encode(mr_ctx *ctx, const mr_mesh *mesh, const mr_mesh *base, const mr_places *source,
    mr_detail *d, mr_encode_result *result);

/* MR_ERANGE where a face is not one of the base's, a place not within one, or a number not finite. */
mr_status mr_detail_check(mr_ctx *ctx, const mr_detail *d, const mr_mesh *base);

/* rest: the undeformed base.  In the arena. */
const mr_prepared *mr_detail_prepare(mr_ctx *ctx, const mr_mesh *rest);

/* Decodes d, checked, times gain, onto the base, normals and frames at rest turned as the base has around
 * them.  p: d->n, the caller's. */
mr_status mr_decode(mr_ctx *ctx, const mr_mesh *base, const mr_detail *d, double gain, mr_v3 *p);

/* The mesh as it was encoded.  d: checked and prepared.  p: d->n, the caller's. */
void mr_detail_at_rest(mr_ctx *ctx, const mr_mesh *base, const mr_detail *d, mr_v3 *p);

/* The detail of the frame's mesh, checked against the base.  MR_EMISSING without one.  d: the frame's. */
mr_status mr_detail_get(mr_ctx *ctx, mr_frame *f, const mr_mesh *base, mr_detail *d);

/* Notes where base stood when its last pose began, column base.before, unless as it was encoded; of a base
 * that a mesh is encoded over, or may be. */
mr_status mr_detail_keep_before(mr_ctx *ctx, mr_frame *f, const mr_mesh *before);

/* Puts the columns; an offset that was there and is no longer is dropped.  d: of this base, encoded; kept
 * until the frame is written. */
mr_status mr_detail_put(mr_ctx *ctx, mr_frame *f, const mr_mesh *base, const mr_detail *d);

#endif
