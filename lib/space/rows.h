/* rows.h -- points in rows, as a line scanner or a sonar leaves them: far denser along than across. */
#ifndef MR_SPACE_ROWS_H
#define MR_SPACE_ROWS_H

#include "space/near.h"

/* Medians over the points: how far apart they are in the direction of the next ones, and how far the nearest
 * one across that is. */
typedef struct mr_rows {
	double along, across;
} mr_rows;

/* p: n places, near: of them.  Of some at equal strides; 0 of fewer than five places. */
mr_status mr_find_rows(mr_ctx *ctx, const mr_v3 *p, size_t n, const mr_near *near, mr_rows *found);

#endif
