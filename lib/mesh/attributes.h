/* attributes.h -- what the columns by convention are, and what becomes of them in rows made of others. */
#ifndef MR_MESH_ATTRIBUTES_H
#define MR_MESH_ATTRIBUTES_H

#include "stream/frame.h"

/* The kind of a column.  From MR_MEAN on it goes along to rows that are made of its own. */
typedef enum mr_attribute {
	MR_OWN,       /* what is of this surface alone, or found anew */
	MR_SAMPLED,   /* how points sample their surface */
	MR_NUMBER,    /* a triangle of `refers` */
	MR_PLACE,     /* barycentric coordinates in one */
	MR_MEAN,      /* the mean of those that are finite, whole numbers rounded */
	MR_DIRECTION, /* the same, as long as its parents on the mean */
	MR_LABEL,     /* that of the greatest weight, the lowest parent of equal ones */
	MR_LEAST      /* the least of those with a weight */
} mr_attribute;

/* Values for the rows of a surface without the column, when it is joined with one that has it. */
typedef enum mr_missing {
	MR_NEEDED, /* nothing can: the column is lost */
	MR_ZERO,   /* for labels with a list, the first name */
	MR_NAN,
	MR_WHITE,  /* opaque */
	MR_COUNTED /* the row's own number */
} mr_missing;

typedef struct mr_column_info {
	const char *layer, *name; /* layer NULL: any */
	mr_shape shape;           /* components 0: any number */
	mr_attribute kind;
	mr_missing missing;
	const char *refers; /* the layer with whose triangles it goes stale; NULL: none */
	const char *what;
} mr_column_info;

/* Every column by convention; ends with a name of NULL. */
extern const mr_column_info mr_columns[];

/* The one of this name, or NULL. */
const mr_column_info *mr_column_of(const char *layer, const char *name);

/* By the table; numbers of others are NaN. */
mr_missing mr_column_missing(const mr_column *c);

/* Whether a column of this name is one by convention. */
bool mr_column_known(const char *layer, const char *name);

/* Whether it is one in any layer that is a surface, as which others may be taken. */
bool mr_column_of_surfaces(const char *name);

/* Whether it is a column of the layer's vertices that goes along from points by displacement to mesh: colour,
 * or none by convention of any of these. */
bool mr_column_carried(const mr_column *c, const char *layer);

/* How n rows are made: each of `width` parents and their weights; NULL: of one parent, by itself. */
typedef struct mr_rows_from {
	size_t n, width;
	const uint32_t *parent;
	const double *weight;
} mr_rows_from;

/* A column that goes along. */
typedef struct mr_carried {
	char name[MR_COLUMN_MAX + 1];
	mr_shape shape;
	mr_attribute kind;
	const void *from;
	void *to; /* rows of them */
	size_t rows;
} mr_carried;

/* A surface and one made of it: their vertices and faces, what does not go along (ends with NULL; NULL:
 * nothing), and how a column of vertices or faces is made. */
typedef struct mr_descent {
	size_t nv, nf, to_nv, to_nf;
	const char *const *but;
	mr_status (*make)(void *arg, mr_ctx *ctx, mr_carried *c);
	void *arg;
} mr_descent;

/* Whether the layer has columns that go along but for those. */
bool mr_columns_go_along(const mr_frame *f, const char *layer, const char *const *but);

/* The columns of a layer that go along to a surface made of it: by convention from MR_MEAN on, and all that
 * are none by convention.  list: *count of them, in the arena, for mr_carried_put. */
mr_status mr_columns_descend(mr_ctx *ctx, mr_frame *f, const char *layer, const mr_descent *d,
    mr_carried **list, size_t *count) MR_WARN_UNUSED;

/* Column i of the frame, which must have `before` rows, and room for `rows` of it. */
mr_status mr_carried_begin(
    mr_ctx *ctx, mr_frame *f, size_t i, size_t before, size_t rows, mr_carried *c) MR_WARN_UNUSED;

/* Makes the rows of c from `first` on.  Of what corners have, three rows a face, `parts` is 3, else 1. */
void mr_carried_make(const mr_ctx *ctx, const mr_carried *c, size_t parts, size_t first, mr_rows_from r);

/* Puts them into a layer. */
mr_status mr_carried_put(
    mr_ctx *ctx, mr_frame *f, const char *layer, const mr_carried *list, size_t count) MR_WARN_UNUSED;

#endif
