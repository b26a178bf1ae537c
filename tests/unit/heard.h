/* heard.h -- the warnings that a test hears. */
#ifndef TEST_HEARD_H
#define TEST_HEARD_H

#include "base/ctx.h"

static char heard[2048]; /* one a line */

static inline void
hear(void *user, const char *text)
{
	(void)user;
	snprintf(heard + strlen(heard), sizeof heard - strlen(heard), "%s\n", text);
}

/* From now on, nothing heard yet. */
static inline void
listen_to(mr_ctx *ctx)
{
	ctx->listener.warn = hear;
	heard[0] = 0;
}

#endif
