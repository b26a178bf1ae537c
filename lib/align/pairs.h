/* pairs.h -- private to its room: points that lie on other sides, and the motions that bring them there. */
#ifndef MR_ALIGN_PAIRS_H
#define MR_ALIGN_PAIRS_H

#include "align/model.h"

/* Some points of a where its side stands, as b sees them, and their nearest on b. */
typedef struct pairing {
	const samples *a, *b, *cells; /* cells: those of b that are looked at first */
	size_t from, onto;            /* which sides these are */
	bool oriented;
	size_t n; /* of a, at equal strides */
	mr_v3 *p, *normal;
	uint32_t *near; /* MR_NONE: none */
	mr_v3 *asked;   /* work of a query */
	uint32_t *of, *got;
} pairing;

/* The result of an iteration. */
typedef struct drawn {
	double rms;   /* of distances to planes, weighted */
	double share; /* of the points that have a partner */
	double moved; /* by the round's step */
} drawn;

/* From side 1 to side 0, unless the caller changes that. */
pairing mr_align_pairing(
    mr_ctx *ctx, const samples *a, const samples *b, const samples *cells, bool oriented, size_t n);

/* The pairs of a map: by the cells alone, or exactly. */
mr_status mr_align_pair(mr_ctx *ctx, pairing *w, bool exactly, const mr_affine *map) MR_WARN_UNUSED;

/* The share of the points on the other side: each by its distance from the plane and by the normals. */
double mr_align_score(const pairing *w, double reach, double limit);

/* That share of a map, exactly, less twice the share of the points that contradict it: one to eight steps
 * from the other side, where that does not end. */
mr_status mr_align_agreement(mr_ctx *ctx, pairing *w, const mr_affine *map, double *share) MR_WARN_UNUSED;

/* The inverse of a similarity. */
mr_affine mr_align_inverse(const mr_affine *t);

/* Rounds of pairing and stepping, within a reach that falls from `from` to `to`, until all sides rest.
 * pose: of each of them; side 0 stays.  scale: of two sides the other may grow. */
mr_status mr_align_draw_near(mr_ctx *ctx, pairing *w, size_t pairings, mr_affine *pose, size_t sides,
    double from, double to, size_t rounds, bool scale, drawn *d) MR_WARN_UNUSED;

/* The motion between two models, where they are. */
mr_status mr_align_find(mr_ctx *ctx, const model *a, const model *b, bool scale, mr_align_result *r,
    mr_affine *map) MR_WARN_UNUSED;

/* Converts a motion between models, which are centred and scaled, to one between the sides. */
void mr_align_put_map(const model *a, const model *b, const mr_affine *map, mr_align_result *r);

/* The diagonal of the box of a side; MR_EMESH if it has no extent. */
mr_status mr_align_diagonal(mr_ctx *ctx, mr_align_side s, double *diagonal) MR_WARN_UNUSED;

/* The unit of sides whose diagonals are from `least` to `most`. */
static inline double
mr_align_unit(double least, double most)
{
	return fmax(least, most / 4);
}

#endif
