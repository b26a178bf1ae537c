/* name_table.h -- names, numbered as they come, in one text. */
#ifndef MR_BASE_NAME_TABLE_H
#define MR_BASE_NAME_TABLE_H

#include "base/ctx.h"

/* Starts zeroed; in the arena. */
typedef struct mr_name_table {
	char *text; /* each name and a newline */
	size_t bytes, room;
	size_t *start;  /* of each in text */
	uint32_t *slot; /* a hash table of number + 1 */
	size_t count, start_room, slots;
} mr_name_table;

/* The number of the first that is called so; a new one where none is. */
uint32_t mr_name_number(mr_ctx *ctx, mr_name_table *n, const char *name, size_t bytes);

/* A new one, though there may be others that are called so. */
uint32_t mr_name_add(mr_ctx *ctx, mr_name_table *n, const char *name, size_t bytes);

/* Strings, each but once, that outlive the call.  Starts zeroed. */
typedef struct mr_string_set {
	mr_ctx keep;
	mr_name_table names;
} mr_string_set;

void mr_string_set_free(mr_string_set *set);
bool mr_string_set_has(const mr_string_set *set, const char *text);
void mr_string_set_add(mr_ctx *ctx, mr_string_set *set, const char *text);

#endif
