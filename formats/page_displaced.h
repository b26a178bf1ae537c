/* page_displaced.h -- displaced subdivision surfaces in a page, which subdivides and displaces them itself.
 * Layer rule: formats includes lib. */
#ifndef MR_PAGE_DISPLACED_H
#define MR_PAGE_DISPLACED_H

#include "subdivide/displaced.h"

/* That of a frame; zeroed: there is none. */
typedef struct mr_page_displaced {
	bool there;
	bool is_mesh; /* mesh is this surface on level `at`, and need not be stored */
	size_t n, at; /* finest level; the one to show first */
	const mr_loop *level;
	const double *height;
	double extent; /* of the control mesh: the largest side of its box */
} mr_page_displaced;

/* Control mesh and heights, checked as mr-decode does.  MR_EMISSING where they are not there. */
mr_status mr_page_displaced_get(mr_ctx *ctx, mr_frame *f, mr_page_displaced *d) MR_WARN_UNUSED;

#endif
