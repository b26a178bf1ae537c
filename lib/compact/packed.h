/*
 * packed.h -- the packed file (man/mr-compact.5): a head with the control mesh on a grid, then heights and
 * colours in blocks.  Every prefix that holds the head is a surface.  All values are integers, and steps are
 * powers of two, so that all machines agree.
 */
#ifndef MR_COMPACT_PACKED_H
#define MR_COMPACT_PACKED_H

#include "compact/bit_planes.h"
#include "compact/control_code.h"

/* Fields of a vertex: its height; then of a colour lightness, orange, green (YCoCg) and, maybe, opacity. */
enum { MR_PACKED_FIELDS = 5, MR_PACKED_NAME = 255 };

typedef struct mr_packed {
	char name[MR_PACKED_NAME + 1]; /* of the frame */
	mr_grid_mesh control;
	int step;          /* a vertex is at 2^step (origin + p) */
	int64_t origin[3]; /* below 2^52 */
	size_t n;          /* its level */
	int unit;          /* of heights on the finest level, whose numbers are in 2^(unit - n) */
	size_t fields;     /* 1, 4 or 5 */
	const mr_loop *level;
	mr_bit_planes field[MR_PACKED_FIELDS]; /* numbers, or coefficients, of level n */
} mr_packed;

/* Bytes of a file, or of the bits of its fields. */
typedef struct mr_packed_bytes {
	const unsigned char *byte;
	size_t size;
} mr_packed_bytes;

/* The levels of the control mesh, in the arena, the finest with its faces or without them.  MR_EMESH where it
 * is no oriented manifold. */
mr_status mr_packed_levels(mr_ctx *ctx, mr_packed *p, bool faces);

/* The positions of the control vertices: p->control.nv, the caller's. */
void mr_packed_positions(const mr_packed *p, mr_v3 *position);

/* Heights and colours (of 0 to 255, four of each vertex) as numbers of the fields, and back.  MR_ERANGE where
 * one is too large for the unit. */
mr_status mr_packed_put_heights(mr_ctx *ctx, mr_packed *p, const double *height);
void mr_packed_put_colors(mr_ctx *ctx, mr_packed *p, const uint8_t (*color)[4]);
void mr_packed_heights(const mr_packed *p, size_t level, double *height);
void mr_packed_colors(const mr_packed *p, size_t level, uint8_t (*color)[4]);

/* The vertices on level n in the mesh that was packed, for each vertex of the packed one; in the arena.
 * from, to: level n of these; order: of the control mesh. */
const uint32_t *mr_packed_origin(
    mr_ctx *ctx, const mr_loop *from, const mr_loop *to, size_t n, const mr_control_order *order);

/* Codes all fields, whose numbers are overwritten; bits: in the arena.  *least: bytes that colours need. */
mr_status mr_packed_write_fields(mr_ctx *ctx, mr_packed *p, mr_packed_bytes *bits, size_t *least);

/* Decodes the fields on level `upto` from these bits, all or a prefix; in the arena. */
void mr_packed_read_fields(mr_ctx *ctx, mr_packed *p, mr_packed_bytes bits, size_t upto);

/* The file of a coded control mesh and these bits; in the arena. */
mr_packed_bytes
mr_packed_file(mr_ctx *ctx, const mr_packed *p, const mr_coder *control, mr_packed_bytes bits);

/* Bytes of the fields in a file of `size` bytes with a head of `head` bytes. */
size_t mr_packed_room(size_t head, size_t size);

/* Reads the head, the control mesh and the bits of the fields, of which *missing bytes are cut off; in the
 * arena. MR_EFORMAT for a damaged file or an incomplete head. */
mr_status
mr_packed_open(mr_ctx *ctx, mr_packed_bytes file, mr_packed *p, mr_packed_bytes *bits, size_t *missing);

#endif
