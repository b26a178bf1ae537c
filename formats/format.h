/* format.h -- the table of formats.  `sniff` looks at bytes only; `read` fails with "line N: ..." or "byte N:
 * ..."; `write` leaves failures to the sink.  Layer rule: formats. */
#ifndef MR_FORMAT_H
#define MR_FORMAT_H

#include "formats/build.h"
#include "formats/bytes.h"
#include "formats/model.h"
#include "formats/rows.h"
#include "formats/scan.h"
#include "mesh/polygon.h"

typedef bool mr_sniff(const unsigned char *data, size_t size);
typedef mr_status mr_read_model(mr_ctx *ctx, const unsigned char *data, size_t size, mr_model *m);
typedef mr_status mr_write_model(mr_sink *s, const mr_model *m);

typedef struct mr_file_format {
	const char *name;
	bool binary;       /* the output is not for a terminal */
	const char *magic; /* its first bytes after blanks, a bar between; NULL: sniff decides */
	mr_sniff *sniff;   /* NULL: by magic, name or suffix only */
	mr_read_model *read;
	mr_write_model *write;                                       /* NULL: read only */
	mr_status (*write_scene)(mr_sink *s, const mr_scene *scene); /* NULL: holds one model */
} mr_file_format;

/* mr_model_read of bytes in memory; `path` is for its suffix and `format` may be NULL. */
mr_status mr_model_parse(mr_ctx *ctx, const char *path, const char *format, const unsigned char *data,
    size_t size, mr_model *m) MR_WARN_UNUSED;

/* Passes the mark that a text in UTF-8 may begin with; a binary STL may begin with anything. */
void mr_skip_mark(const unsigned char **data, size_t *size);

/* mr_stl_is_binary: whether the file's size fits its count of triangles. */
mr_sniff mr_obj_sniff, mr_stl_is_binary, mr_stl_sniff, mr_off_sniff, mr_xyz_sniff, mr_ptx_sniff;
mr_read_model mr_gltf_read, mr_las_read, mr_obj_read, mr_off_read, mr_pcd_read, mr_ply_read, mr_ptx_read,
    mr_stl_read, mr_xyz_read;
mr_write_model mr_glb_write, mr_gltf_write, mr_obj_write, mr_off_write, mr_ply_write, mr_ply_write_ascii,
    mr_ply_write_float, mr_pts_write, mr_pwn_write, mr_stl_write, mr_stl_write_ascii, mr_xyz_write;
mr_status mr_glb_write_scene(mr_sink *s, const mr_scene *scene);
mr_status mr_gltf_write_scene(mr_sink *s, const mr_scene *scene);

/* Reports what a GLB does not keep of the model. */
mr_status mr_glb_note_lost(mr_sink *s, const mr_model *m);

/* A text over the bytes. */
static inline mr_scan
mr_scan_of(mr_ctx *ctx, const unsigned char *data, size_t size)
{
	const char *p = (const char *)data;

	return (mr_scan){ ctx, p, p, size ? p + size : p, false };
}

/* x as a float holds it.  By way of memory: GCC 12 loses pairs of these conversions where it vectorises them.
 */
static inline double
mr_as_float(double x)
{
	volatile float f = (float)x;

	return (double)f;
}

/* Whether a normal is unit, in as few digits as files have. */
static inline bool
mr_has_unit_length(mr_v3 n)
{
	return fabs(mr_norm2(n) - 1) < 0.02;
}

/* Writes numbers with a blank between them, then `end`. */
void mr_put_reals(mr_sink *s, const double *x, size_t n, char end);

/* Reports as lost what the model has and `keeps` does not name, a word each: columns by their names in a
 * layer, "alpha" of colours, "property" and "faces". */
void mr_note_lost(mr_sink *s, const mr_model *m, const char *keeps);

/* The model's faces, polygons as they were; reports those that no longer are. */
void mr_faces_of(mr_sink *s, const mr_model *m, mr_polygons *faces);

/* Reports that `count` of n positions are off by up to a share of the diagonal. */
void mr_coarse(mr_ctx *ctx, size_t count, size_t n, double share);

/* Reports positions that float32 moves visibly; MR_ERANGE where one overflows it. */
mr_status mr_note_rounded(mr_sink *s, const mr_model *m);

/* A little- or big-endian value in memory. */
static inline uint16_t
mr_load16(const unsigned char *p, bool big)
{
	return (uint16_t)(big ? p[0] << 8 | p[1] : p[1] << 8 | p[0]);
}

static inline uint32_t
mr_load32(const unsigned char *p, bool big)
{
	uint32_t v;
	memcpy(&v, p, 4);
	return big ? __builtin_bswap32(v) : v;
}

static inline uint64_t
mr_load64(const unsigned char *p, bool big)
{
	uint64_t v;
	memcpy(&v, p, 8);
	return big ? __builtin_bswap64(v) : v;
}

/* A number of 1, 2, 4 or 8 bytes: I with a sign, U without, F a float of 4 or 8. */
static inline double
mr_load_number(const unsigned char *p, char kind, size_t bytes, bool big)
{
	uint64_t u = bytes == 1   ? *p
	             : bytes == 2 ? mr_load16(p, big)
	             : bytes == 4 ? mr_load32(p, big)
	                          : mr_load64(p, big);
	uint32_t v = (uint32_t)u;
	float f;
	double d;

	memcpy(&f, &v, sizeof f);
	memcpy(&d, &u, sizeof d);
	if (kind == 'F')
		return bytes == 8 ? d : (double)f;
	if (kind == 'U')
		return (double)u;
	return bytes == 1   ? (double)(int8_t)u
	       : bytes == 2 ? (double)(int16_t)u
	       : bytes == 4 ? (double)(int32_t)u
	                    : (double)(int64_t)u;
}

static inline double
mr_load_float(const unsigned char *p, bool big)
{
	return mr_load_number(p, 'F', 4, big);
}

static inline double
mr_load_double(const unsigned char *p, bool big)
{
	return mr_load_number(p, 'F', 8, big);
}

/* A value as bytes, little-endian as all machines are that this is for; returns the end. */
static inline char *
mr_store32(char *to, uint32_t v)
{
	return (char *)memcpy(to, &v, sizeof v) + sizeof v;
}

static inline char *
mr_store_float(char *to, float f)
{
	return (char *)memcpy(to, &f, sizeof f) + sizeof f;
}

static inline char *
mr_store_double(char *to, double d)
{
	return (char *)memcpy(to, &d, sizeof d) + sizeof d;
}

/* Three floats. */
static inline char *
mr_store_floats(char *to, mr_v3 a)
{
	return mr_store_float(mr_store_float(mr_store_float(to, (float)a.x), (float)a.y), (float)a.z);
}

#endif
