/*
 * bit_planes.h -- coefficients on the levels of a subdivision surface, most significant bits first, so that
 * every prefix is a surface (Taubman 2000; Shapiro 1993).  Neighbours give the context of a bit (Wu 1997).
 *
 * Pass p has of level j bit p + j: a coefficient counts as much as the square root of the area that it
 * changes, and a level's vertices stand half as far apart as one level below.
 */
#ifndef MR_COMPACT_BIT_PLANES_H
#define MR_COMPACT_BIT_PLANES_H

#include "compact/coder.h"
#include "subdivide/loop.h"

enum { MR_BIT_PLANES_MOST = 30 };

/* One field: a number a vertex. */
typedef struct mr_bit_planes {
	int32_t *x;                       /* level[n].nv coefficients; read: as far as they are known */
	uint8_t planes[MR_LEVEL_MAX + 1]; /* of each level: bits of its largest one */
} mr_bit_planes;

/* Counts the planes of each level.  MR_ERANGE where there are more than MR_BIT_PLANES_MOST. */
mr_status mr_bit_planes_count(mr_ctx *ctx, const mr_loop *level, size_t n, mr_bit_planes *f);

/* How many passes there are. */
unsigned mr_bit_planes_passes(const mr_bit_planes *f, size_t fields, size_t n);

/* Writes the fields, or reads them until c has ended; f->planes is given.  Its memory stays in the arena,
 * where c grows.  end: MR_BIT_PLANES_MOST byte counts, one for the end of each pass, or NULL; unused ones
 * stay. */
void mr_bit_planes_code(
    mr_ctx *ctx, mr_coder *c, const mr_loop *level, size_t n, mr_bit_planes *f, size_t fields, size_t *end);

#endif
