/* report.h -- what mr-info and mr-compare say, for people (six digits) and as JSON (one line, all seventeen).
 * Figures that are not defined are "-" or null. */
#ifndef MR_MEASURE_REPORT_H
#define MR_MEASURE_REPORT_H

#include "base/text.h"
#include "mesh/layers.h"

typedef struct mr_report_opts {
	const char *layer; /* that one alone; NULL: all */
	bool json;
	bool check; /* the laws of the layers (mesh/validate.h), and whether a displacement can be decoded,
	               too */
	bool skip_intersections;
} mr_report_opts;

/* Appends the report of a frame, of layers that cannot be measured as such.  *broken, where not NULL: the
 * first law that the frame breaks, in the arena, or NULL. */
mr_status
mr_report_frame(mr_ctx *ctx, mr_frame *f, const mr_report_opts *opts, mr_text *text, const char **broken);

/* Appends the report of a comparison of layers called a and b in a frame. */
void mr_report_comparison(
    const mr_comparison *c, const mr_frame *f, const char *a, const char *b, bool json, mr_text *text);

#endif
