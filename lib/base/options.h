/* Options of a library's caller, in which anything may stand: each check says MR_EUSAGE with a sentence. */
#ifndef MR_BASE_OPTIONS_H
#define MR_BASE_OPTIONS_H

#include "base/ctx.h"

/* A number, or a count, from least to most. */
mr_status mr_check_number(mr_ctx *ctx, const char *name, double value, double least, double most);

/* A value of an enumeration that begins with 0 and ends with `last`. */
mr_status mr_check_choice(mr_ctx *ctx, const char *name, int choice, int last);

#endif
