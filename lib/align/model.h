/* model.h -- private to its room: what is known of one side, about its middle, by a unit. */
#ifndef MR_ALIGN_MODEL_H
#define MR_ALIGN_MODEL_H

#include "align/align.h"
#include "base/rotation.h"
#include "space/near.h"

/* Cells around samples, each with the one nearest to its middle: to look at many places quickly. */
typedef struct grid {
	mr_v3 origin;
	double edge;
	size_t side[3];
	uint32_t *sample; /* of each cell; MR_NONE: none is within two cells */
} grid;

/* Points with normals of a surface, of even density. */
typedef struct samples {
	mr_v3 *p, *normal;
	bool *rim; /* whether the surface ends there; NULL: not known */
	size_t n;
	mr_near *near;
	grid cells;
} samples;

enum { FEATURE = 33 };

typedef struct model {
	mr_v3 middle;
	double unit;
	bool oriented; /* the sides of normals are known, not guessed */
	samples dense, sparse;
	float (*feature)[FEATURE]; /* of sparse points */
} model;

/* The distance between neighbours of `sparse`, in units; the surface is looked at on about twice it. */
static const double STEP = 0.015;

/* A sample near p, or MR_NONE where none is within two steps. */
uint32_t mr_align_nearby(const samples *s, mr_v3 p);

/* The samples of a side. */
mr_status mr_align_model(mr_ctx *ctx, mr_align_side side, double unit, model *m) MR_WARN_UNUSED;

/* The features of its sparse ones; not oriented: their normals point away from what is around them. */
mr_status mr_align_features(mr_ctx *ctx, bool oriented, model *m) MR_WARN_UNUSED;

#endif
