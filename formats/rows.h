/* rows.h -- vertices as rows of numbers: columns by their roles make positions, normals, colours, texture
 * coordinates, places of the scanner; the others are properties by their names.  Layer rule: formats. */
#ifndef MR_ROWS_H
#define MR_ROWS_H

#include "formats/build.h"
#include "formats/bytes.h"

typedef enum mr_role {
	MR_NO_ROLE,
	MR_X,
	MR_Y,
	MR_Z,
	MR_NX,
	MR_NY,
	MR_NZ,
	MR_RED,
	MR_GREEN,
	MR_BLUE,
	MR_ALPHA,
	MR_U,
	MR_V,
	MR_FROM_X,
	MR_FROM_Y,
	MR_FROM_Z,
	MR_ROLES
} mr_role;

/* The role of a name in files, in either case of letters. */
mr_role mr_role_of(const char *name, size_t bytes);

/* Groups of columns: position, normal, colour, texture coordinates, the scanner's place. */
enum { MR_PARTS = 5 };

typedef struct mr_rows_column {
	mr_role role;
	const char *name, *type; /* type: of PLY; NULL: what has no role is passed over */
	size_t property;         /* its number, from 1; 0: none */
} mr_rows_column;

typedef struct mr_rows {
	mr_builder b;
	mr_rows_column *column;
	size_t columns, column_room;
	size_t at[MR_ROLES];    /* the column of a role, from 1; 0: none */
	size_t n;               /* rows so far */
	double *part[MR_PARTS]; /* of all rows: NaN of an alpha, and in a sparse one of a colour, that is not
	                           there */
	size_t room[MR_PARTS];
	mr_shades shades[2]; /* of colours, of alpha; full: 0 where the values decide */
	bool sparse;         /* rows may be without a colour, NaN: those are white */
} mr_rows;

/* A column more; the first of a role has it.  The name is copied, cleaned. */
void mr_rows_add(mr_rows *r, mr_role role, const char *name, size_t bytes, const char *type);

/* n columns more without names, of the roles from the first on. */
void mr_rows_add_unnamed(mr_rows *r, mr_role first, size_t n);

/* Parts without the whole are properties from now on. */
void mr_rows_begin(mr_rows *r);

/* Room for rows; MR_ERANGE beyond what indices can name. */
mr_status mr_rows_room(mr_rows *r, uint64_t more) MR_WARN_UNUSED;

/* The next row, where there is room; of one without a place, which is left out later, all else is 0. */
void mr_rows_put(mr_rows *r, const double *x);

/* Gives the vertices to the builder; reports what was lost of them. */
void mr_rows_end(mr_rows *r);

/* ---- written ---- */

/* Output columns, side by side in memory. */
typedef struct mr_part {
	const void *data; /* NULL: not there */
	char type;        /* of mr_shape: d, u or b; or f: doubles, written as floats, not as text */
	size_t width, stride;
	const char *names; /* of the columns, a blank between */
} mr_part;

/* The parts of a model's vertices. */
void mr_vertex_parts(const mr_model *m, mr_part part[MR_PARTS]);

mr_part mr_property_part(const mr_property *p);

/* Row i of the parts that are there: as text, a blank after each number, or little-endian. */
void mr_put_parts(mr_sink *s, const mr_part *part, size_t parts, size_t i, bool text);

/* In text, the last blank of a row becomes its newline. */
void mr_end_row(mr_sink *s);

/* n rows. */
void mr_put_rows(mr_sink *s, const mr_part *part, size_t parts, size_t n, bool text);

#endif
