/* The second stream is read as far as the first has come. */
#include "stream/side_stream.h"

#include <errno.h>
#include <fcntl.h>
#include <unistd.h>

mr_status
mr_side_open(mr_ctx *ctx, const char *path, mr_side *s)
{
	mr_side r = { .path = path, .fd = strcmp(path, "-") ? open(path, O_RDONLY) : STDIN_FILENO };

	if (r.fd < 0)
		return mr_fail(ctx, MR_EIO, "%s: %s", path, strerror(errno));
	MR_TRY(mr_prefix(ctx, mr_reader_open(ctx, r.fd, &r.reader), "%s", path));
	*s = r;
	return MR_OK;
}

static mr_status
next(mr_ctx *ctx, mr_side *s)
{
	mr_status status = mr_reader_next(ctx, s->reader, &s->frame);

	s->ended = status == MR_END;
	return mr_prefix(ctx, status, "%s", s->path);
}

static unsigned long long
frames_so_far(const mr_side *s)
{
	return s->frame ? s->frame->number : 0;
}

mr_status
mr_side_take(mr_ctx *ctx, mr_side *s, uint64_t number)
{
	while (!s->ended && frames_so_far(s) < number)
		MR_TRY(next(ctx, s));
	if (frames_so_far(s) < number && frames_so_far(s) != 1)
		return mr_fail(ctx, MR_ERANGE, "%s has only %llu frames", s->path, frames_so_far(s));
	return MR_OK;
}

mr_status
mr_side_end(mr_ctx *ctx, mr_side *s, uint64_t frames)
{
	unsigned long long there;

	while (!s->ended)
		MR_TRY(next(ctx, s));
	there = frames_so_far(s);
	mr_reader_free(s->reader);
	s->reader = NULL;
	s->frame = NULL;
	if (s->fd != STDIN_FILENO)
		close(s->fd);
	if (there > frames)
		return mr_fail(ctx, MR_ERANGE, "%s has %llu frames, the first stream %llu", s->path, there,
		    (unsigned long long)frames);
	return MR_OK;
}
