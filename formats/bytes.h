/* bytes.h -- whole files in, buffered files out; gzip on both sides.  Layer rule: formats. */
#ifndef MR_BYTES_H
#define MR_BYTES_H

#include "base/outfile.h"

/* The bytes of a file, in memory of their own. */
typedef struct mr_file_bytes {
	const unsigned char *data;
	size_t size;
	void *memory; /* to free */
} mr_file_bytes;

/* Reads all of a file ("-": stdin), whether it can seek or not; inflates gzip.  End them with
 * mr_file_bytes_end. */
mr_status mr_file_bytes_read(mr_ctx *ctx, const char *path, mr_file_bytes *b) MR_WARN_UNUSED;

/* A file by its path, or where data is not NULL the bytes of one that is in a stream under that name. */
typedef struct mr_file {
	const char *name; /* NULL: no file */
	const unsigned char *data;
	size_t size;
} mr_file;

/* The bytes of either, to be ended likewise. */
mr_status mr_file_read(mr_ctx *ctx, const mr_file *f, mr_file_bytes *b) MR_WARN_UNUSED;

/* A copy in the arena, named by a checksum and the size: the same bytes have the same name. */
mr_file mr_file_copy(mr_ctx *ctx, const void *data, size_t size, const char *suffix);

/* Frees the bytes, and returns the status of what was done with them.  Accepts zeroed ones. */
mr_status mr_file_bytes_end(mr_file_bytes *b, mr_status status);

/* By the bytes that gzip begins with. */
static inline bool
mr_is_gzip(const unsigned char *data, size_t size)
{
	return size >= 3 && data[0] == 0x1f && data[1] == 0x8b && data[2] == 8;
}

/* The destination of a writer's bytes.  The first failure is kept and reported by mr_sink_close. */
typedef struct mr_sink {
	mr_ctx *ctx;
	const char *path; /* as named by the user */
	mr_outfile file;
	bool hold;   /* set by the caller: the file stays open, for the caller to keep or to drop */
	void *gz;    /* the compressor, or NULL */
	bool memory; /* the buffer grows, and nothing is written */
	char *buffer;
	size_t used, room;
	mr_status status;
} mr_sink;

enum { MR_SINK_BUFFER = 1 << 16, MR_SINK_ROOM = 4096 };

/* Opens a file ("-": stdout).  `compress`: gzip. */
mr_status mr_sink_open(mr_ctx *ctx, const char *path, bool compress, mr_sink *s) MR_WARN_UNUSED;

/* Ends the file and gives it its name, if not on hold; after a failure, of `status` or on the way, drops it.
 */
mr_status mr_sink_close(mr_sink *s, mr_status status) MR_WARN_UNUSED;

/* Writes data into a file in the folder of `path`, named path's stem + `end`.  *name: its name without
 * folder. */
mr_status mr_put_beside(mr_ctx *ctx, const char *path, const char *end, const void *data, size_t bytes,
    const char **name) MR_WARN_UNUSED;

void mr_sink_flush(mr_sink *s);
void mr_put(mr_sink *s, const void *data, size_t bytes);

/* Formatted text of less than MR_SINK_ROOM bytes. */
void mr_print(mr_sink *s, const char *format, ...) MR_PRINTF(2, 3);

/* Puts n rows, which all threads make at the same time: `row` puts one, and changes nothing but the sink that
 * it is given. */
typedef void mr_row(mr_sink *s, const void *arg, size_t i);
void mr_put_each(mr_sink *s, size_t n, mr_row *row, const void *arg);

/* A place for up to MR_SINK_ROOM bytes; mr_sink_fill sets their end. */
static inline char *
mr_sink_room(mr_sink *s)
{
	if (s->room - s->used < MR_SINK_ROOM)
		mr_sink_flush(s);
	return s->buffer + s->used;
}

static inline void
mr_sink_fill(mr_sink *s, const char *end)
{
	s->used = (size_t)(end - s->buffer);
}

#endif
