/* select.h -- mr_select_frame and mr_crop_frame for rules that were parsed before, as of a command line. */
#ifndef MR_TOOL_SELECT_H
#define MR_TOOL_SELECT_H

#include "edit/select.h"

mr_status mr_select_by(
    mr_ctx *ctx, mr_frame *f, const mr_selection *s, const mr_select_opts *opts, mr_select_result *result);

/* Frees what is kept, fixes what is dropped.  s: may_miss, of one rule or more. */
mr_status
mr_crop_by(mr_ctx *ctx, mr_frame *f, const char *layer, const mr_selection *s, mr_crop_result *result);

#endif
