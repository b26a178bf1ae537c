/* page_steps.h -- columns of a page's stream: whole steps in place of numbers.  Layer rule: formats includes
 * lib. */
#ifndef MR_PAGE_STEPS_H
#define MR_PAGE_STEPS_H

#include "base/text.h"
#include "stream/frame.h"

/*
 * What a column's values are: origin + step times a whole number; step 0: whole numbers as they are.  Of
 * each row the first `components` are kept, and the page finds the others.  Rows of more than three values
 * begin at 0, and their origin is only told.
 */
typedef struct mr_steps {
	double step, origin[3];
	uint8_t components;
} mr_steps;

/* The largest step, a power of two, of which the extent is less than 2^24; 1 where there is none to speak of.
 */
double mr_step_of(double extent);

/*
 * Puts the column, decoded, as whole numbers of which the sums over the rows are stored: the packing of
 * streams takes differences, which then are steps without a sign, the small ones, of either direction, with
 * small numbers.  Steps that are not within 31 bits of the origin are not to be asked for.  A line in `notes`
 * tells the page.
 */
mr_status mr_steps_put(
    mr_ctx *ctx, mr_frame *to, const mr_column *column, const mr_steps *steps, mr_text *notes) MR_WARN_UNUSED;

#endif
