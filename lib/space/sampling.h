/*
 * sampling.h -- how a cloud samples its surface: how densely, with what noise, and which of its points belong
 * to none.
 *
 * Found once, by the first tool of a pipe that needs it, and kept in the layer; the later ones read it there.
 *
 * Contract: the same for every order of the points and number of threads and, but for rounding, wherever the
 * cloud lies, however it is turned and scaled; the noise of more than 10007 places is measured at so many of
 * them.
 */
#ifndef MR_SPACE_SAMPLING_H
#define MR_SPACE_SAMPLING_H

#include "mesh/mesh.h"
#include "space/near.h"
#include "stream/frame.h"

/* Points at one position are one place. */
typedef struct mr_sampling {
	const double *spacing;  /* n: side of the square of surface that the point's place has to itself */
	const uint8_t *outlier; /* n: 1 where the place belongs to no surface, else 0 */
	const uint8_t *repeat;  /* n: 1 where an earlier point is at the same place, else 0 */
	double noise;      /* standard deviation from a smooth surface; median, 0 of fewer than ten places */
	size_t neighbours; /* nearest points that it takes to see the surface through the noise; 16 or more */
	size_t n, places, outliers; /* of the places: outliers */
	/* of the others: */
	double usual;    /* median spacing */
	double area;     /* of the surface: the sum of their squares */
	double evenness; /* a low spacing over a high one (10 and 90 % are lower): 1 where they are equal */
	mr_near *near;   /* of the places that mr_sampling_places gives; NULL: it is yet to be built */
} mr_sampling;

/*
 * Spacings of noise from which on points are noisy: noise of 0.3 % of the diagonal on 50,000 points is 0.48
 * to 0.84 of their spacing.  There triangles make a crust, three times as far from the truth.  Clean clouds
 * are below 0.08, vertices of models below 0.45.
 */
static const double MR_NOISY = 0.35;

/* n finite points; the columns are in the arena.  known: figures known already, which it becomes, or NULL. */
mr_status mr_sampling_find(mr_ctx *ctx, const mr_v3 *p, size_t n, const mr_sampling *known, mr_sampling *s);

/*
 * The sampling of a layer's points: by its columns, checked; if these are missing, found and, in a layer
 * without triangles, put there.  MR_ERANGE if a column is no sampling's, and if the median spacing of two
 * points or more is 0.
 */
mr_status mr_sampling_of(mr_ctx *ctx, mr_frame *f, const mr_mesh *points, mr_sampling *s);

/* Only by its columns; false where these are not there. */
mr_status
mr_sampling_stored(mr_ctx *ctx, mr_frame *f, const char *layer, size_t n, mr_sampling *s, bool *stored);

/* The n points along the Z curve, sorted (n, the caller's), and the sampling in that order, its columns in
 * the arena. */
void
mr_sampling_sort(mr_ctx *ctx, const mr_v3 *p, const mr_sampling *s, mr_v3 *sorted, mr_sampling *of_sorted);

/* The points among the n points p that count, each place once, without outliers, along the Z curve, and their
 * indices (NULL: not wanted); in the arena. */
void mr_sampling_places(
    mr_ctx *ctx, const mr_v3 *p, const mr_sampling *s, mr_v3 **place, uint32_t **index, size_t *count);

#endif
