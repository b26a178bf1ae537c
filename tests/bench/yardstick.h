/* yardstick.h -- what the yardsticks share: frames read and written, numbers printed, colours. */
#ifndef MR_BENCH_YARDSTICK_H
#define MR_BENCH_YARDSTICK_H

#include "mesh/layers.h"
#include "render/colormap.h"

#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const mr_rgb sound = { 205, 198, 188 }, harmed = { 214, 40, 40 };

static mr_status
read_stream(mr_ctx *ctx, const char *path, mr_frame **frame)
{
	mr_reader *reader;
	mr_status status;
	int fd = open(path, O_RDONLY);

	if (fd < 0)
		return mr_fail(ctx, MR_EIO, "cannot be opened");
	MR_TRY(mr_reader_open(ctx, fd, &reader));
	while ((status = mr_reader_next(ctx, reader, frame)) == MR_OK)
		;
	return status < 0 ? status : MR_OK;
}

/* The last frame of a stream (.mrs), or a model of any format.  The reader and the descriptor last as long as
 * the process. */
static mr_status
read_frame(mr_ctx *ctx, const char *path, mr_frame **frame)
{
	size_t n = strlen(path);

	*frame = NULL;
	if (n > 4 && !strcmp(path + n - 4, ".mrs"))
		MR_TRY(mr_prefix(ctx, read_stream(ctx, path, frame), "%s", path));
	else
		MR_TRY(mr_prefix(ctx, mr_import(ctx, path, NULL, frame, NULL), "%s", path));
	return *frame ? MR_OK : mr_fail(ctx, MR_EMISSING, "%s: no frame", path);
}

static mr_status
read_mesh(mr_ctx *ctx, const char *path, mr_mesh *m)
{
	mr_frame *frame;

	MR_TRY(read_frame(ctx, path, &frame));
	return mr_prefix(ctx, mr_layer_mesh(ctx, frame, "mesh", m), "%s", path);
}

static mr_status
write_stream(mr_ctx *ctx, int fd, const mr_frame *frame)
{
	mr_writer *writer;

	if (fd < 0)
		return mr_fail(ctx, MR_EIO, "cannot be written");
	MR_TRY(mr_writer_open(ctx, fd, MR_PACK, &writer));
	MR_TRY(mr_writer_put(ctx, writer, frame));
	return mr_writer_end(ctx, writer);
}

static mr_status
write_frame(mr_ctx *ctx, const char *path, const mr_frame *frame)
{
	int fd = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0666);

	return mr_prefix(ctx, write_stream(ctx, fd, frame), "%s", path);
}

/* A frame of one mesh, called as the file is; harm: colours of its faces, or NULL. */
static mr_status
write_picture(mr_ctx *ctx, const char *path, const char *note, const mr_mesh *m, const mr_rgb *harm)
{
	const char *slash = strrchr(path, '/'), *stem = slash ? slash + 1 : path;
	char *name = mr_format(ctx, "%s%s", stem, note);
	mr_frame *frame;

	if (!name)
		return MR_EMEM;
	MR_TRY(mr_frame_new(ctx, name, &frame));
	MR_TRY(mr_layer_put_mesh(ctx, frame, "mesh", m));
	if (harm)
		MR_TRY(mr_frame_put(ctx, frame, "mesh", "harm", (mr_shape){ 'f', 'b', 3 }, harm, m->nf));
	return write_frame(ctx, path, frame);
}

static void
print_real(const char *name, double x)
{
	if (isfinite(x))
		printf(",\"%s\":%.5g", name, x);
	else
		printf(",\"%s\":null", name);
}

#endif
