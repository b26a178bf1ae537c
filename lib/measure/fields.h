/*
 * fields.h -- fields of a struct by name, for reports.
 */
#ifndef MR_MEASURE_FIELDS_H
#define MR_MEASURE_FIELDS_H

#include "base/text.h"

typedef enum mr_figure_kind {
	MR_FIGURE_COUNT,  /* size_t */
	MR_FIGURE_SIGNED, /* int64_t */
	MR_FIGURE_REAL,   /* double */
	MR_FIGURE_TRUTH   /* bool */
} mr_figure_kind;

typedef struct mr_figure {
	const char *name;
	mr_figure_kind kind;
	size_t offset; /* in the struct */
} mr_figure;

#define MR_LENGTH(array) (sizeof(array) / sizeof *(array))

/* Appends ,"name":value for each of n figures of the struct at `values`. */
void mr_figures_json(mr_text *t, const mr_figure *table, size_t n, const void *values);

#endif
