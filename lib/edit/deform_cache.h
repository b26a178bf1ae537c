/*
 * deform_cache.h -- a factored system that serves frame after frame, and its responses as columns.
 *
 * Contract: a system is used again where a delta frame has left all that it depends on as it was, so it never
 * changes a byte of a result.  Zeroed, the cache is empty.
 */
#ifndef MR_EDIT_DEFORM_CACHE_H
#define MR_EDIT_DEFORM_CACHE_H

#include "edit/deform.h"
#include "mesh/layers.h"

enum { MR_DEFORM_PARTS = 10 };

typedef struct mr_deform_cache {
	mr_ctx keep;                    /* of the system */
	mr_deform *deform;              /* NULL: empty */
	uint64_t part[MR_DEFORM_PARTS]; /* serials of the columns that it depends on */
} mr_deform_cache;

/*
 * The system on the mesh `rest`, the frame's layer with the positions of column `column`, under the regions
 * that mr_transfer_get finds; those that are the mesh's become columns of the layer too.
 */
mr_status mr_deform_cache_get(mr_deform_cache *cache, mr_ctx *ctx, mr_frame *f, const mr_mesh *rest,
    const char *column, const mr_deform_opts *opts, mr_deform **deform);

/* Puts the responses to the handles of the layer m, by mr_deform_basis.  MR_EMESH without a handle. */
mr_status mr_deform_put_basis(mr_ctx *ctx, mr_frame *f, const mr_mesh *m, mr_deform *d, const mr_v3 *p0);

#endif
