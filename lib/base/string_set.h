/* string_set.h -- strings, each but once. */
#ifndef MR_BASE_STRING_SET_H
#define MR_BASE_STRING_SET_H

#include "base/ctx.h"

/* Starts zeroed. */
typedef struct mr_string_set {
	mr_ctx keep;
	char **slot; /* a hash table */
	size_t count, mask;
} mr_string_set;

void mr_string_set_free(mr_string_set *set);

bool mr_string_set_has(const mr_string_set *set, const char *text);

/* Adds a copy where it is not there. */
void mr_string_set_add(mr_ctx *ctx, mr_string_set *set, const char *text);

#endif
