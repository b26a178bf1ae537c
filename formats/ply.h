/*
 * ply.h -- a PLY as it is read: its elements with their properties, and what comes of them.
 *
 * Contract: the names are short, since ply.c and ply_header.c alone include this.
 * Layer rule: formats.
 */
#ifndef MR_PLY_H
#define MR_PLY_H

#include "formats/format.h"

typedef enum type { CHAR, UCHAR, SHORT, USHORT, INT, UINT, FLOAT, DOUBLE, TYPES } type;

typedef struct type_name {
	const char *name, *alias;
	unsigned char bytes;
	char kind; /* as of mr_load_number */
} type_name;

extern const type_name mr_ply_types[TYPES];

/* What a property of faces is to us. */
typedef enum role { NONE, INDICES, UVS } role;

typedef struct property {
	bool list;
	type count, value; /* of a list: of its length and of its items */
	role role;
	const char *name;
	size_t kept; /* of a face's: its number from 1 among the properties of the builder; 0: none of them */
} property;

typedef enum kind { OTHER, VERTEX, FACE, STRIPS } kind;

typedef struct element {
	kind kind;
	char name[MR_SHOWN];
	uint64_t rows;
	property *property;
	size_t properties, room;
} element;

/* Values of a list that each corner of a face has some of. */
typedef struct corner_list {
	double *value; /* of all faces */
	size_t count, room;
	size_t had;      /* the count before the face at hand */
	size_t odd;      /* faces with as many as make no sense */
	uint32_t *place; /* of the corners at hand */
	size_t place_room;
} corner_list;

typedef struct ply {
	mr_ctx *ctx;
	mr_scan text; /* the header, then the rows */
	bool binary, big;
	element *element;
	size_t elements, room;
	mr_builder b;
	uint32_t *indices; /* of the list at hand */
	size_t indices_count, indices_room;
	corner_list uv;
	double *row; /* of the row at hand, value by value */
	size_t row_room;
	mr_rows rows;    /* of vertices */
	bool vertices;   /* are read */
	size_t textures; /* that are left out */
} ply;

/* The property of a role, or NULL. */
static inline const property *
find(const element *e, role r)
{
	for (size_t i = 0; i < e->properties; i++)
		if (e->property[i].role == r)
			return &e->property[i];
	return NULL;
}

static inline bool
has(const element *e, role r)
{
	return find(e, r);
}

/* Reads the header; the properties then have their roles, or are kept as numbers. */
mr_status mr_ply_header(ply *f) MR_WARN_UNUSED;

#endif
