/* outfile.h -- files that are seen whole or not at all: the old file stays until the new one takes its name.
 * Until then the new one has a random name beside it, kept in ctx->unfinished. */
#ifndef MR_BASE_OUTFILE_H
#define MR_BASE_OUTFILE_H

#include "base/ctx.h"

typedef struct mr_outfile {
	int fd;
	char *path;      /* as the user calls it; NULL: no file is open */
	char *target;    /* its final name; NULL: a device or a pipe, written in place */
	char *temporary; /* its name until then; NULL: none */
} mr_outfile;

/* Opens `path` for writing, or the target of a link of that name, which may not exist yet.  It gets mode and
 * owner of the old file.  End it by one of the two below. */
mr_status mr_outfile_open(mr_ctx *ctx, const char *path, mr_outfile *f) MR_WARN_UNUSED;

/* Gives the file its name and closes it; with ctx->sync not before it is on the disk.  If that fails it is
 * dropped.  A zeroed one passes. */
mr_status mr_outfile_keep(mr_ctx *ctx, mr_outfile *f) MR_WARN_UNUSED;

/* Closes the file, which is gone.  Accepts a zeroed one, and leaves it so. */
void mr_outfile_drop(mr_ctx *ctx, mr_outfile *f);

/* Sees that what was written to a descriptor is on the disk, where it is of a file. */
mr_status mr_sync(mr_ctx *ctx, int fd, const char *path) MR_WARN_UNUSED;

#endif
