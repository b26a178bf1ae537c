/*
 * fuzz_stream.c -- the reader, given any bytes, as a file and as a pipe: it reads frames or fails with a
 *sentence, and both ways agree; what it reads is written and read again.
 *
 * tests/unit/test_stream_fuzz.c runs it without libFuzzer.
 */
#include "stream/fingerprint.h"
#include "stream/stored.h"

#include <unistd.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n);

/* What was read: how it ended, and a print of every value. */
typedef struct outcome {
	mr_status status;
	uint64_t frames;
	uint64_t print;
} outcome;

static void
insist(bool good)
{
	if (!good)
		abort();
}

static void
add(uint64_t *sum, const void *data, size_t n)
{
	*sum = (*sum ^ mr_fingerprint(data, n)) * 0x9e3779b97f4a7c15u;
}

static mr_status
add_frame(mr_ctx *ctx, mr_frame *f, uint64_t *sum)
{
	add(sum, f->name, strlen(f->name));
	for (mr_column *c = f->columns; c < f->columns + f->count; c++) {
		MR_TRY(mr_column_decode(ctx, c));
		add(sum, c->layer, strlen(c->layer));
		add(sum, c->name, strlen(c->name));
		add(sum, c->data, (size_t)c->rows * c->shape.components * mr_type_size(c->shape.type));
	}
	return MR_OK;
}

/* Reads a descriptor to its end; with a writer, also writes the frames that are good. */
static outcome
consume(mr_ctx *ctx, int fd, mr_writer *w)
{
	outcome o = { 0 };
	mr_reader *r;
	mr_frame *f;

	insist(mr_reader_open(ctx, fd, &r) == MR_OK);
	while ((o.status = mr_reader_next(ctx, r, &f)) == MR_OK) {
		mr_mark mark = mr_mark_take(ctx);
		o.status = add_frame(ctx, f, &o.print);
		if (o.status == MR_OK && w)
			insist(mr_writer_put(ctx, w, f) == MR_OK);
		mr_mark_release(ctx, mark);
		if (o.status != MR_OK)
			break;
		o.frames++;
	}
	insist(o.status == MR_END || (o.status == MR_EFORMAT && *ctx->error));
	mr_reader_free(r);
	return o;
}

static int
scratch(void)
{
	FILE *f = tmpfile();
	int fd = f ? dup(fileno(f)) : -1;

	insist(fd >= 0);
	fclose(f);
	return fd;
}

/* A file of its own for every use: opened once, emptied each time. */
static int
emptied(int *fd)
{
	if (*fd < 0)
		*fd = scratch();
	insist(!ftruncate(*fd, 0) && !lseek(*fd, 0, SEEK_SET));
	return *fd;
}

int
LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n)
{
	static int in = -1, out = -1;
	outcome mapped, piped, again;
	mr_writer *w;
	mr_ctx ctx;
	int ends[2];

	if (n > 65536) /* what a pipe holds */
		return 0;
	mr_ctx_init(&ctx, 1);
	emptied(&in);
	emptied(&out);
	insist(write(in, bytes, n) == (ssize_t)n && !lseek(in, 0, SEEK_SET));
	insist(mr_writer_open(&ctx, out, n % 2 ? MR_PACK : MR_UNPACK, &w) == MR_OK);
	mapped = consume(&ctx, in, w);

	insist(!pipe(ends) && write(ends[1], bytes, n) == (ssize_t)n);
	close(ends[1]);
	piped = consume(&ctx, ends[0], NULL);
	close(ends[0]);
	insist(mapped.status == piped.status && mapped.frames == piped.frames &&
	       mapped.print == piped.print);

	if (mapped.status == MR_END) {
		insist(mr_writer_end(&ctx, w) == MR_OK && !lseek(out, 0, SEEK_SET));
		again = consume(&ctx, out, NULL);
		insist(again.status == MR_END && again.frames == mapped.frames &&
		       again.print == mapped.print);
	}
	mr_writer_free(w);
	mr_ctx_free(&ctx);
	return 0;
}
