/* formats.h -- models in the formats of the outside world, read from a file or a pipe, `.gz` or not.  Every
 * index is checked, doubles survive bit for bit, and what a format cannot hold is reported as a finding. */
#ifndef MR_FORMATS_H
#define MR_FORMATS_H

#include "formats/bytes.h"
#include "mesh/mesh.h"

/* Reports `count` of what the words say; nothing of none. */
void mr_tell(mr_ctx *ctx, mr_finding_kind kind, size_t count, const char *format, ...) MR_PRINTF(4, 5);

/* Names, one a line: each followed by a newline but the last.  An empty one names nothing. */
typedef struct mr_lines {
	const char *text;
	size_t bytes;
} mr_lines;

/* A number that each vertex or each face has under a name of its own, as PLY has them. */
typedef struct mr_property {
	const char *name; /* at most MR_COLUMN_MAX bytes, of no column by convention */
	mr_shape shape;   /* of one component: b uchar; u ushort or uint; d the others */
	const void *data; /* nv or nf */
} mr_property;

/* A mesh, or where nf is 0 a cloud; NULL is what the file has not.  Texture coordinates and normals are of
 * vertices where all the corners of each have the same, else of corners. */
typedef struct mr_model {
	const char *path;              /* of the file that is read */
	const mr_v3 *p;                /* nv */
	const bool *placed;            /* nv, of a model that was read: the others are to go; NULL: all */
	const mr_v3 *normal;           /* nv, as the file has them: not made unit */
	const mr_v3 *scanner;          /* nv: from where the point was seen */
	const unsigned char *color;    /* 4 nv: red, green, blue, alpha */
	const double *texcoord;        /* 2 nv */
	const mr_tri *t;               /* nf */
	const double *corner_texcoord; /* 6 nf: of a triangle's corners; NaN of one without */
	const mr_v3 *corner_normal;    /* 3 nf; zero of one without */
	const uint32_t *group, *object, *material; /* nf, each a line of groups, objects, materials */
	const uint32_t *smoothing;                 /* nf: smoothing groups of OBJ, 0 none */
	const uint32_t *polygon;                   /* nf: the polygon that the triangle is a part of */
	mr_lines groups, objects, materials;       /* names */
	mr_lines mtllib;                           /* files of materials, as the file names them */
	const mr_file *file;                       /* of these and their pictures, those in the stream */
	const mr_property *property;               /* properties of them */
	size_t nv, nf, properties, files;
	mr_import_result counts; /* of a model that was read */
} mr_model;

/* Reads a file ("-": stdin) into the arena.  `format` NULL: by the bytes, or else the suffix.  Equal vertices
 * of STL are joined, polygons triangulated; poor faces stay.  MR_EMESH where there is no vertex. */
mr_status mr_model_read(mr_ctx *ctx, const char *path, const char *format, mr_model *m) MR_WARN_UNUSED;

/* Writes a file ("-": stdout).  `format` NULL: by the suffix, before `.gz`, which compresses.  It is seen
 * whole or not at all; where `held` is not NULL it is the caller's to keep or to drop. */
mr_status mr_model_write(
    mr_ctx *ctx, const char *path, const char *format, const mr_model *m, mr_outfile *held) MR_WARN_UNUSED;

/* MR_EUSAGE, naming those there are, where the format is unknown or cannot be written.  `binary`: not for a
 * terminal. */
mr_status mr_format_check(
    mr_ctx *ctx, const char *path, const char *format, bool writable, bool *binary) MR_WARN_UNUSED;

/* The file's name without folder, `.gz` and suffix, made fit for a frame's name ("stdin" for "-"). */
const char *mr_format_stem(mr_ctx *ctx, const char *path);

#endif
