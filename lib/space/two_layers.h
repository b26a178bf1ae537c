/* two_layers.h -- points in two layers, as of the sides of a thin plate or of two scans out of register. */
#ifndef MR_SPACE_TWO_LAYERS_H
#define MR_SPACE_TWO_LAYERS_H

#include "space/near.h"

/* Points in two layers nearer to each other than points of one are, as of the sides of a thin plate. */
typedef struct mr_layers {
	double share; /* of the points */
	double dense; /* of them, those around which most are */
	double apart; /* how far, the median; 0 of none */
	mr_v3 at;     /* the place around which most are */
} mr_layers;

/* p: n places, near: alike, usual: their spacing.  Of some at equal strides. */
mr_status
mr_find_layers(mr_ctx *ctx, const mr_v3 *p, size_t n, const mr_near *near, double usual, mr_layers *found);

/* Reports MR_UNCERTAIN where more points lie so than chance, or noise, would have it. */
mr_status mr_report_layers(mr_ctx *ctx, const mr_v3 *p, size_t n, const mr_near *near, double usual);

#endif
