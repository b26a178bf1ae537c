/* frame.h -- a frame: named layers of named, typed columns, in their order (man/mr-stream.5).  The bytes, not
 * to be changed, belong to the reader, or to the tool that put them until the frame is written. */
#ifndef MR_STREAM_FRAME_H
#define MR_STREAM_FRAME_H

#include "base/ctx.h"

enum { MR_LAYER_MAX = 16, MR_COLUMN_MAX = 24, MR_HEADER = 64 };

typedef struct mr_column {
	char layer[MR_LAYER_MAX + 1]; /* empty: belongs to no layer */
	char name[MR_COLUMN_MAX + 1];
	mr_shape shape;
	uint64_t rows;
	uint64_t serial;             /* of the reader's payload; 0 for a column that the tool put */
	const void *data;            /* rows x components values; NULL: stored, not decoded yet */
	const unsigned char *header; /* as read; NULL for a column that the tool put */
	struct mr_stored
	    *stored; /* the reader's record of it: stream/stored.h; NULL for one that the tool put */
} mr_column;

struct mr_frame {
	const char *name;
	bool key;        /* a key frame; else a delta */
	uint64_t number; /* from 1, over all streams read */
	mr_column *columns;
	size_t count, room;
};

static inline bool
mr_same_shape(mr_shape a, mr_shape b)
{
	return a.element == b.element && a.type == b.type && a.components == b.components;
}

/* Files that came with models are columns of bytes and of no layer, named by a checksum and the size: two of
 * one name are the same. */
static inline bool
mr_column_is_file(const mr_column *c)
{
	return !*c->layer && mr_same_shape(c->shape, (mr_shape){ '-', 'b', 1 });
}

static inline bool
mr_frame_has_files(const mr_frame *f)
{
	size_t i = 0;

	while (i < f->count && !mr_column_is_file(&f->columns[i]))
		i++;
	return i < f->count;
}

/* Bytes of one value of a type: 8, 4 or 1. */
size_t mr_type_size(char type);

/* Copies the list of columns, so that columns put into the copy stay out of `frame`; the rest is shared.
 * Tools work on such a copy, which becomes the frame at their end: one that fails has changed nothing. */
void mr_frame_copy(mr_ctx *ctx, const mr_frame *frame, mr_frame *copy);

/* Ends a tool: its copy becomes the frame, and its figures the result, unless that is NULL. */
void mr_frame_finish(mr_frame *frame, const mr_frame *copy, void *result, const void *found, size_t bytes);

/* NOLINTBEGIN(bugprone-macro-parentheses): it declares the copy */
/* How a tool's function ends: `work` is done on a copy of the frame, and finished.  result: NULL, and found
 * the copy, of a tool that finds nothing. */
#define MR_ON_COPY(ctx, frame, copy, result, found, work)                                                    \
	mr_frame copy;                                                                                       \
	MR_ENTER(ctx);                                                                                       \
	mr_frame_copy((ctx), (frame), &copy);                                                                \
	MR_TRY(work);                                                                                        \
	mr_frame_finish((frame), &copy, (result), &(found), sizeof(found));                                  \
	return MR_OK
/* NOLINTEND(bugprone-macro-parentheses) */

/* A copy of all that the frame has, decoded, which may outlive it: in the arena of `keep`. */
mr_status mr_frame_keep(mr_ctx *ctx, mr_ctx *keep, mr_frame *frame, mr_frame **copy);

/* The column, or NULL.  Not decoded: for its shape and rows. */
const mr_column *mr_frame_find(const mr_frame *frame, const char *layer, const char *name);

/* A row of a decoded column of numbers as one: its only value, or the length of several. */
double mr_column_number(const mr_column *column, size_t row);

/* Decodes one column, whatever it is. */
mr_status mr_column_decode(mr_ctx *ctx, mr_column *column);

/* Appends a column of another frame as it is, decoded or not; its bytes stay where they are, and must be
 * there until this frame is written.  MR_ERANGE where this frame has a column of that layer and name. */
mr_status mr_frame_pass(mr_ctx *ctx, mr_frame *frame, const mr_column *column);

/* Passes on all columns of another frame; its history follows the one that is there.  MR_ERANGE where a
 * layer, or a column of no layer but a file, is in both. */
mr_status mr_frame_merge(mr_ctx *ctx, mr_frame *frame, mr_frame *from);

/* The text of a column of no layer, a line each; none where it is not there. */
mr_status mr_frame_lines(mr_ctx *ctx, mr_frame *frame, const char *name, const char **text, size_t *n);

/* Whether column i is the first of a layer. */
bool mr_frame_begins_layer(const mr_frame *frame, size_t i);

/* Appends one line to the frame's history; control characters and bytes that are not UTF-8 become '?'. */
mr_status mr_frame_add_history(mr_ctx *ctx, mr_frame *frame, const char *line);

/* Ends the output with a note, for processes of its group, that this process fails and has said why.  Errors
 * of writing are ignored. */
void mr_writer_fail(mr_ctx *ctx, mr_writer *w);

/* Whether reading failed since the stream ends so, and the process that said why is of the same group as
 * this. */
bool mr_reader_told(const mr_reader *r);

#endif
