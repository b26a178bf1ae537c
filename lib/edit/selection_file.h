/*
 * selection_file.h -- regions of all vertices of one layer, as a text: what the page of mr-view saves.
 *
 *	mr-selection 1 mesh 8002 16000 9c2d01ab     layer, vertices, faces, checksum of the triangles
 *	fixed 0-99 105                              vertices and ranges of them, counted from 0
 *	free 100-104 106-8000
 *	handle 1 8001                               a region may have several lines
 *
 * Text after a # is left out.
 */
#ifndef MR_EDIT_SELECTION_FILE_H
#define MR_EDIT_SELECTION_FILE_H

#include "mesh/mesh.h"
#include "stream/frame.h"

typedef struct mr_selection_file {
	const char *path;
	char layer[MR_LAYER_MAX + 1];
	uint64_t nv, nf;
	uint32_t checksum;
	uint32_t *region; /* of each vertex; MR_NONE: the file gives it none */
} mr_selection_file;

/* Reads the file, into the arena; the path is kept by pointer.  MR_EFORMAT with the line where it is no
 * selection, has a vertex twice, or one that its first line does not count. */
mr_status mr_selection_file_read(mr_ctx *ctx, const char *path, mr_selection_file *file) MR_WARN_UNUSED;

/* Gives the vertices in the file their regions; others keep theirs.  region: nv, in and out.  MR_EMESH where
 * the file is of another layer or of other triangles. */
mr_status mr_selection_file_apply(mr_ctx *ctx, const mr_selection_file *file, const mr_mesh *m,
    uint32_t *region, size_t *selected) MR_WARN_UNUSED;

#endif
