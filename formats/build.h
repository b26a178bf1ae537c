/* build.h -- what readers gather a model in: faces of any size, groups, attributes of corners.  The reader
 * checks indices, since it knows the line or the byte; the builder triangulates.  Layer rule: formats. */
#ifndef MR_BUILD_H
#define MR_BUILD_H

#include "base/name_table.h"
#include "formats/formats.h"

/* The marks of faces: each face gets the current mark. */
typedef enum mr_marking { MR_GROUP, MR_OBJECT, MR_MATERIAL, MR_SMOOTHING, MR_MARKINGS } mr_marking;

typedef struct mr_marks {
	bool used;
	uint32_t current; /* of the faces to come */
	uint32_t *of;     /* of each face: the number of a name, or the number itself of smoothing */
	size_t room;
	mr_name_table names;
} mr_marks;

typedef struct mr_builder {
	mr_ctx *ctx;
	mr_model m; /* to be: what vertices have is the reader's to set; texcoord of corners goes before it */
	uint32_t *corner; /* of all faces */
	uint32_t *size;   /* corners of each face; NULL as long as all are triangles */
	size_t corners, corner_room, faces, face_room;
	uint32_t *corner_uv, *corner_vn; /* of each corner, in uv and vn; MR_NONE of one without; or NULL */
	size_t uv_room, vn_room;
	const double *uv;     /* pairs, to be there by the end */
	const mr_v3 *vn;      /* the same */
	bool plain;           /* faces are triangles with nothing but vertices so far: see mr_build_reserve */
	struct mr_kept *kept; /* properties; of faces one row for each face */
	size_t properties, property_room;
	size_t skipped; /* faces without three corners */
	mr_marks marks[MR_MARKINGS];
	const char *ungrouped; /* the group of faces before the first, and of one without a name; NULL: "" */
	mr_name_table libraries; /* files of materials */
	char *clean;             /* a name on its way */
	size_t clean_room;
} mr_builder;

/* Room for so many triangles, to spare growing. */
mr_status mr_build_reserve(mr_builder *b, size_t faces) MR_WARN_UNUSED;

/* A face of n corners, of vertices below nv; fewer than three are counted and left out.  uv, vn: places of
 * the corners' values in the builder's arrays, MR_NONE of one without; NULL where none has any. */
void mr_build_face(mr_builder *b, const uint32_t *corner, const uint32_t *uv, const uint32_t *vn, size_t n);

/* The same of n faces of three corners and more, one after another: how many each has in `size`. */
void mr_build_faces(mr_builder *b, const uint32_t *size, size_t n, const uint32_t *corner, const uint32_t *uv,
    const uint32_t *vn);

/* The faces to come are marked with this name, cleaned and without blanks around it; `own`: it is another
 * than one of that name before. */
void mr_build_mark(mr_builder *b, mr_marking what, const char *name, size_t bytes, bool own);

/* A file of materials more; none where it is the last one again. */
void mr_build_library(mr_builder *b, const char *name, size_t bytes);

/* The faces to come are of this smoothing group. */
void mr_build_smoothing(mr_builder *b, uint32_t group);

/* A property under its name, of a type of PLY; properties of vertices precede properties of faces.  Its
 * number, from 1.  Its values come row by row; with one that is not of a whole type all are doubles. */
size_t mr_build_property(mr_builder *b, const char *name, const char *type, char element);
void mr_build_value(mr_builder *b, size_t number, size_t row, double x);

/* Reports values that are not finite as lost.  False where all n are. */
bool mr_left_out(mr_ctx *ctx, size_t odd, size_t n, const char *what) MR_WARN_UNUSED;

/* The same of a column that has no value for none: with one odd value all are lost, and this is false. */
bool mr_all_left(mr_ctx *ctx, size_t odd, size_t n, const char *what) MR_WARN_UNUSED;

/* Normals that are not finite become zero, which is none, and are reported.  False where all are. */
bool mr_normals_left(mr_ctx *ctx, mr_v3 *normal, size_t n) MR_WARN_UNUSED;

/* Values of colours.  If their type does not define full intensity, the values of the whole file do: 1 if
 * none is above it, or not far and one is no whole number; else 255; else 65535. */
typedef struct mr_shades {
	double most, full; /* of those that were seen; what becomes a byte of 255 */
	bool broken;       /* one is no whole number */
	size_t rounded;    /* clipped, or not exact in a byte */
} mr_shades;

static inline void
mr_shade_see(mr_shades *s, double x)
{
	s->most = x > s->most ? x : s->most;
	s->broken = s->broken || x > floor(x); /* which no NaN is */
}

/* The value of full intensity, by all values seen. */
double mr_shade_full(const mr_shades *s);

/* Colours are bytes.  Values less than 1/1000 beyond full, or off the byte, count as exact; every rounded
 * value of 16 bits is reported. */
static inline unsigned char
mr_shade_byte(mr_shades *s, double x)
{
	double v = 255 * x / s->full;
	float near = (float)v + 0.5F; /* a float of 0.9, too, is 230 */
	unsigned char byte = (unsigned char)(near > 0 ? fminf(near, 255) : 0);

	s->rounded += s->full == 65535 ? x != 257 * byte : fabs(v - byte) > 0.255;
	return byte;
}

/* Reports those that were rounded or clipped, and where next to nothing is left of them. */
void mr_shades_said(mr_ctx *ctx, const mr_shades *s);

/* The model; reports its losses. */
mr_status mr_build_finish(mr_builder *b, mr_model *m) MR_WARN_UNUSED;

/* True where a triangle was added without looking further: the usual case, kept short. */
static inline bool
mr_build_triangle(mr_builder *b, uint32_t i, uint32_t j, uint32_t k)
{
	uint32_t *c = b->corner + b->corners;

	if (!b->plain || b->corner_room - b->corners < 3)
		return false;
	c[0] = i, c[1] = j, c[2] = k;
	b->corners += 3;
	b->faces++;
	return true;
}

/* Numbers rows of `width` doubles, at most three, in order of first use, equal ones alike; MR_NONE of one
 * that is none: NaN, or where the width is 3 all zero.  first: of each number, its first row. */
void mr_number_rows(
    mr_ctx *ctx, const double *x, size_t width, size_t n, uint32_t *number, uint32_t *first, size_t *count);

/* Copies text without control characters, '/' where `no_slash`, and broken UTF-8, for which '_' stands;
 * NUL-terminated. */
size_t mr_clean_name(char *to, const char *from, size_t bytes, bool no_slash);

/* The same in the arena, '/' as it is. */
const char *mr_clean_copy(mr_ctx *ctx, const char *from, size_t bytes);

#endif
