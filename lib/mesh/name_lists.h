/* name_lists.h -- names of groups, objects and materials: a text, and a column of its lines' numbers. */
#ifndef MR_MESH_NAME_LISTS_H
#define MR_MESH_NAME_LISTS_H

#include "mesh/layers.h"

/* The starts of a text's lines, count + 1, each after a newline; in the arena, over the text. */
void mr_line_starts(mr_ctx *ctx, const char *text, size_t bytes, const char ***starts, size_t *count);

enum { MR_NAMINGS = 3 };

/* The names of the columns; the lists are text's. */
typedef struct mr_naming {
	const char *column, *list;
} mr_naming;

extern const mr_naming mr_namings[MR_NAMINGS];

/* The list of the names that a column has the numbers of; NULL: it has none. */
const char *mr_names_of(const char *column);

#endif
