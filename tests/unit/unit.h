/* unit.h -- what unit tests share: cmocka, and a context that each test has to itself. */
#ifndef TEST_UNIT_H
#define TEST_UNIT_H

#include "base/ctx.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

static mr_ctx ctx;

static inline int
setup(void **state)
{
	(void)state;
	mr_ctx_init(&ctx, 2);
	return 0;
}

static inline int
teardown(void **state)
{
	(void)state;
	mr_ctx_free(&ctx);
	return 0;
}

#endif
