/*
 * name_lists.h -- names of groups, objects and materials: a text of one a line, and a column of the lines'
 * numbers.
 */
#ifndef MR_MESH_NAME_LISTS_H
#define MR_MESH_NAME_LISTS_H

#include "mesh/layers.h"

/* Where the lines of a text begin, count + 1 of them, each behind the newline of the one before; in the
 * arena, over the text. */
void mr_line_starts(mr_ctx *ctx, const char *text, size_t bytes, const char ***starts, size_t *count);

enum { MR_NAMINGS = 3 };

/* The names of the columns; the lists are those of text. */
typedef struct mr_naming {
	const char *column, *list;
} mr_naming;

extern const mr_naming mr_namings[MR_NAMINGS];

/* The lines of a layer's lists; where there is no list, none. */
typedef struct mr_name_lists {
	const char **line[MR_NAMINGS]; /* count + 1 starts, each behind the newline of the one before */
	size_t count[MR_NAMINGS];
} mr_name_lists;

/* l: in the arena, over f's own text. */
mr_status mr_name_lists_of(mr_ctx *ctx, mr_frame *f, const char *layer, mr_name_lists *l) MR_WARN_UNUSED;

/* Lists of the names alone that the layer's columns number, in their order, for a part of the layer that l is
 * of. */
mr_status
mr_name_lists_cut(mr_ctx *ctx, const mr_name_lists *l, mr_frame *part, const char *layer) MR_WARN_UNUSED;

#endif
