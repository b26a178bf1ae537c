/* solve.h -- the options of mr_solve_frame, checked before there is a frame. */
#ifndef MR_TOOL_SOLVE_H
#define MR_TOOL_SOLVE_H

#include "base/ctx.h"

/* MR_EUSAGE where they contradict each other. */
mr_status mr_solve_check(mr_ctx *ctx, const mr_solve_opts *opts);

#endif
