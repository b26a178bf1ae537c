/* heard.h -- the warnings and findings that a test hears. */
#ifndef TEST_HEARD_H
#define TEST_HEARD_H

#include "base/ctx.h"

static char heard[2048]; /* one a line */

/* A finding: its kind, count and words. */
static inline void
hear_finding(void *user, const mr_finding *f)
{
	(void)user;
	snprintf(heard + strlen(heard), sizeof heard - strlen(heard), "%zu %s\n", f->count,
	    f->what ? f->what : mr_finding_name(f->kind));
}

/* From now on, nothing heard yet. */
static inline void
listen_to(mr_ctx *ctx)
{
	ctx->listener.found = hear_finding;
	heard[0] = 0;
}

#endif
