/* Streams that tools write and read: what goes in comes out, and deltas send what changed and nothing else.
 */
#include "tests/unit/stream.h"

#include "stream/stored.h"

#include <math.h>

enum { VERTICES = 40000, SMALL = 50 };

static double position[3 * VERTICES];
static uint32_t triangles[3 * VERTICES];
static unsigned char noise[VERTICES];

static int
fill(void **state)
{
	(void)state;
	for (size_t i = 0; i < 3 * VERTICES; i++) {
		position[i] = sin(1e-3 * (double)i) * 1e3;
		triangles[i] = (uint32_t)(i / 3 + i % 3);
	}
	for (size_t i = 0; i < VERTICES; i++)
		noise[i] = (unsigned char)((i * 2654435761u) >> 13);
	return 0;
}

/* The value of a column, as bytes, is expected. */
static void
expect(mr_ctx *ctx, mr_frame *f, const char *layer, const char *name, mr_shape shape, const void *data,
    size_t rows)
{
	const void *got;
	size_t n;

	ok(ctx, mr_frame_get(ctx, f, layer, name, shape, &got, &n));
	assert_int_equal(n, rows);
	assert_int_equal((uintptr_t)got % 8, 0);
	assert_memory_equal(got, data, rows * shape.components * mr_type_size(shape.type));
}

static mr_reader *
rewound(mr_ctx *ctx, int fd)
{
	mr_reader *r;

	lseek(fd, 0, SEEK_SET);
	ok(ctx, mr_reader_open(ctx, fd, &r));
	return r;
}

static mr_frame *
next(mr_ctx *ctx, mr_reader *r)
{
	mr_frame *f;

	ok(ctx, mr_reader_next(ctx, r, &f));
	return f;
}

static void
expect_end(mr_ctx *ctx, mr_reader *r)
{
	mr_frame *f = NULL;
	mr_status status = mr_reader_next(ctx, r, &f);

	if (status != MR_END)
		fail_msg("status %d: %s", status, ctx->error);
	mr_reader_free(r);
}

/* Every type, packed and not, over block boundaries, comes back bit for bit, also packed and unpacked again.
 */
static void
round_trips(void **state)
{
	static const size_t rows[] = { 0, 1, 2, 32767, 32768, 32769, VERTICES };
	const mr_shape bytes = { 'f', 'b', 1 }, text = TEXT, wide = { '-', 'd', 255 };
	mr_ctx ctx;
	mr_frame *f;

	(void)state;
	mr_ctx_init(&ctx, 1);
	for (int packing = MR_KEEP; packing <= MR_UNPACK; packing++) {
		for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
			int fd = new_file();
			mr_writer *w = writer_on(&ctx, fd, (mr_packing)packing);
			size_t n = rows[k], few = n / 85;
			ok(&ctx, mr_frame_new(&ctx, "a fr\xc3\xa4me", &f));
			ok(&ctx, mr_frame_put(&ctx, f, "mesh", "position", POSITION, position, n));
			ok(&ctx, mr_frame_put(&ctx, f, "mesh", "triangles", TRIANGLES, triangles, n));
			ok(&ctx, mr_frame_put(&ctx, f, "base", "noise", bytes, noise, n));
			ok(&ctx, mr_frame_put(&ctx, f, "", "words", text, noise, n));
			ok(&ctx, mr_frame_put(&ctx, f, "0123456789abcdef", "0123456789abcdefghijklmn", wide,
				     position, few));
			ok(&ctx, mr_writer_put(&ctx, w, f));
			ok(&ctx, mr_writer_end(&ctx, w));
			mr_writer_free(w);

			mr_reader *r = rewound(&ctx, fd);
			f = next(&ctx, r);
			assert_string_equal(f->name, "a fr\xc3\xa4me");
			assert_true(f->key);
			assert_int_equal(f->number, 1);
			assert_int_equal(f->count, 5);
			assert_string_equal(f->columns[1].name, "triangles");
			assert_string_equal(f->columns[3].layer, "");
			expect(&ctx, f, "mesh", "position", POSITION, position, n);
			expect(&ctx, f, "mesh", "triangles", TRIANGLES, triangles, n);
			expect(&ctx, f, "base", "noise", bytes, noise, n);
			expect(&ctx, f, "", "words", text, noise, n);
			expect(&ctx, f, "0123456789abcdef", "0123456789abcdefghijklmn", wide, position, few);
			expect_end(&ctx, r);
			close(fd);
			mr_ctx_free(&ctx);
		}
	}
}

/* Writes what it reads; the bytes that come out, to be freed. */
static unsigned char *
pass_on(mr_ctx *ctx, int in, mr_packing packing, size_t *n)
{
	int out = new_file();
	mr_reader *r = rewound(ctx, in);
	mr_writer *w = writer_on(ctx, out, packing);
	unsigned char *bytes;
	mr_status status;
	mr_frame *f;

	while ((status = mr_reader_next(ctx, r, &f)) == MR_OK)
		ok(ctx, mr_writer_put(ctx, w, f));
	assert_int_equal(status, MR_END);
	ok(ctx, mr_writer_end(ctx, w));
	bytes = bytes_of(out, n);
	mr_reader_free(r);
	mr_writer_free(w);
	close(out);
	return bytes;
}

static void
put_small(mr_ctx *ctx, mr_frame *f, const char *layer)
{
	ok(ctx, mr_frame_put(ctx, f, layer, "position", POSITION, position, SMALL));
	ok(ctx, mr_frame_put(ctx, f, layer, "triangles", TRIANGLES, triangles, SMALL));
}

/* Three frames: a key; a delta of positions; a delta that drops a layer and adds another. */
static int
animation(mr_ctx *ctx, mr_packing packing)
{
	int fd = new_file();
	mr_writer *w = writer_on(ctx, fd, packing);
	mr_frame *f;

	ok(ctx, mr_frame_new(ctx, "walk", &f));
	put_small(ctx, f, "mesh");
	put_small(ctx, f, "base");
	ok(ctx, mr_frame_add_history(ctx, f, "made"));
	ok(ctx, mr_writer_put(ctx, w, f));
	f->key = false;
	ok(ctx, mr_frame_put(ctx, f, "mesh", "position", POSITION, position + 3, SMALL));
	ok(ctx, mr_writer_put(ctx, w, f));
	mr_frame_drop(f, "base", NULL, 0);
	put_small(ctx, f, "control");
	ok(ctx, mr_writer_put(ctx, w, f));
	ok(ctx, mr_writer_end(ctx, w));
	mr_writer_free(w);
	return fd;
}

/* Passing on changes no byte, nor does packing and unpacking; the changes stay as small. */
static void
passing_on(void **state)
{
	mr_ctx ctx;
	size_t n, m;

	(void)state;
	mr_ctx_init(&ctx, 1);
	int fd = animation(&ctx, MR_KEEP), packed_fd;
	unsigned char *bytes = bytes_of(fd, &n), *same = pass_on(&ctx, fd, MR_KEEP, &m), *packed, *unpacked;
	assert_int_equal(n, m);
	assert_memory_equal(bytes, same, n);

	packed = pass_on(&ctx, fd, MR_PACK, &m);
	assert_true(m < n);
	packed_fd = file_of(packed, m);
	free(same);
	same = pass_on(&ctx, packed_fd, MR_KEEP, &m);
	assert_memory_equal(packed, same, m);
	unpacked = pass_on(&ctx, packed_fd, MR_UNPACK, &m);
	assert_int_equal(n, m);
	assert_memory_equal(bytes, unpacked, n);
	close(fd);
	close(packed_fd);
	free(bytes);
	free(same);
	free(packed);
	free(unpacked);
	mr_ctx_free(&ctx);
}

/* Counts the records with that column's name. */
static int
count(const unsigned char *bytes, size_t n, const char *name)
{
	uint64_t stored;
	int found = 0;

	for (size_t at = 0; at < n; at += 64 + (stored + 63) / 64 * 64) {
		memcpy(&stored, bytes + at + 56, 8);
		found += !strcmp((const char *)bytes + at + 16, name);
	}
	return found;
}

static void
deltas(void **state)
{
	mr_ctx ctx;
	mr_reader *r;
	mr_frame *f;
	uint64_t kept, changed;
	size_t n;

	(void)state;
	mr_ctx_init(&ctx, 1);
	int fd = animation(&ctx, MR_KEEP);
	unsigned char *bytes = bytes_of(fd, &n);
	assert_int_equal(count(bytes, n, "triangles"), 3);
	assert_int_equal(count(bytes, n, "position"), 4);
	assert_int_equal(count(bytes, n, "history"), 1);
	assert_int_equal(count(bytes, n, "DROP"), 1);
	free(bytes);

	r = rewound(&ctx, fd);
	f = next(&ctx, r);
	kept = mr_frame_find(f, "mesh", "triangles")->serial;
	changed = mr_frame_find(f, "mesh", "position")->serial;
	assert_true(kept && changed && kept != changed);
	f = next(&ctx, r);
	assert_false(f->key);
	assert_int_equal(f->number, 2);
	assert_string_equal(f->name, "walk");
	assert_int_equal(f->count, 5);
	assert_int_equal(mr_frame_find(f, "mesh", "triangles")->serial, kept);
	assert_int_not_equal(mr_frame_find(f, "mesh", "position")->serial, changed);
	expect(&ctx, f, "mesh", "position", POSITION, position + 3, SMALL);
	expect(&ctx, f, "base", "position", POSITION, position, SMALL);
	f = next(&ctx, r);
	assert_false(mr_frame_has_layer(f, "base"));
	assert_int_equal(f->count, 5);
	assert_string_equal(f->columns[2].name, "history");
	assert_string_equal(f->columns[3].layer, "control");
	assert_int_equal(mr_frame_find(f, "mesh", "triangles")->serial, kept);
	expect(&ctx, f, "", "history", TEXT, "made\n", 5);
	expect_end(&ctx, r);
	close(fd);
	mr_ctx_free(&ctx);
}

/* A delta that nothing changed sends nothing; one after a skipped frame, and a first one, sends all. */
static void
whole_frames(void **state)
{
	mr_ctx ctx;
	mr_frame *f;
	size_t n;

	(void)state;
	mr_ctx_init(&ctx, 1);
	int fd = new_file();
	mr_writer *w = writer_on(&ctx, fd, MR_KEEP);
	ok(&ctx, mr_frame_new(&ctx, "x", &f));
	put_small(&ctx, f, "mesh");
	f->key = false;
	for (int i = 0; i < 4; i++) {
		if (i == 3)
			mr_writer_skipped(w);
		ok(&ctx, mr_writer_put(&ctx, w, f));
	}
	ok(&ctx, mr_writer_end(&ctx, w));
	mr_writer_free(w);
	unsigned char *bytes = bytes_of(fd, &n);
	assert_int_equal(count(bytes, n, "FRAME"), 4);
	assert_int_equal(count(bytes, n, "position"), 2);
	assert_int_equal(count(bytes, n, "triangles"), 2);
	free(bytes);

	mr_reader *r = rewound(&ctx, fd);
	for (int i = 0; i < 4; i++) {
		f = next(&ctx, r);
		assert_int_equal(f->key, i == 0 || i == 3);
		expect(&ctx, f, "mesh", "position", POSITION, position, SMALL);
	}
	expect_end(&ctx, r);
	close(fd);
	mr_ctx_free(&ctx);
}

/* Whatever is put, dropped and reordered: the merged frame at the other end is the frame, in its order. */
static void
merged_is_the_frame(void **state)
{
	static const char *const names[] = { "a", "b", "c", "d", "e", "f" }, *const layers[] = { "", "mesh",
		"base" };
	enum { FRAMES = 400 };
	const mr_shape shape = { '-', 'u', 1 };
	uint32_t seed = 1, value[64];
	mr_ctx ctx;
	mr_frame *f, *copy[FRAMES], *got;

	(void)state;
	mr_ctx_init(&ctx, 1);
	for (uint32_t i = 0; i < 64; i++)
		value[i] = i % 8; /* few values, so that some stay */
	int fd = new_file();
	mr_writer *w = writer_on(&ctx, fd, MR_KEEP);
	ok(&ctx, mr_frame_new(&ctx, "x", &f));
	for (int k = 0; k < FRAMES; k++) {
		for (int change = 0; change < 4; change++) {
			seed = seed * 1664525 + 1013904223;
			const char *layer = layers[(seed >> 8) % 3], *name = names[(seed >> 12) % 6];
			if ((seed >> 28) == 0)
				mr_frame_drop(f, layer, NULL, 0);
			else if ((seed >> 28) < 6)
				mr_frame_drop(f, layer, name, '-');
			else
				ok(&ctx, mr_frame_put(&ctx, f, layer, name, shape, value + (seed >> 16) % 32,
					     seed >> 16 & 3));
		}
		f->key = k % 50 == 49;
		ok(&ctx, mr_frame_new(&ctx, "x", &copy[k]));
		for (size_t i = 0; i < f->count; i++)
			ok(&ctx, mr_frame_pass(&ctx, copy[k], &f->columns[i]));
		ok(&ctx, mr_writer_put(&ctx, w, f));
	}
	ok(&ctx, mr_writer_end(&ctx, w));
	mr_writer_free(w);
	mr_reader *r = rewound(&ctx, fd);
	for (int k = 0; k < FRAMES; k++) {
		got = next(&ctx, r);
		assert_int_equal(got->count, copy[k]->count);
		for (size_t i = 0; i < got->count; i++) {
			const mr_column *a = &got->columns[i], *b = &copy[k]->columns[i];
			assert_string_equal(a->layer, b->layer);
			assert_string_equal(a->name, b->name);
			expect(&ctx, got, a->layer, a->name, shape, b->data, b->rows);
		}
	}
	expect_end(&ctx, r);
	close(fd);
	mr_ctx_free(&ctx);
}

/* What a tool puts on a frame that was read is of that frame alone. */
static void
changes_stay_in_their_frame(void **state)
{
	mr_ctx ctx;
	mr_frame *f;
	char name[16];

	(void)state;
	mr_ctx_init(&ctx, 1);
	int fd = animation(&ctx, MR_KEEP);
	mr_reader *r = rewound(&ctx, fd);
	for (int k = 0; k < 2; k++) {
		f = next(&ctx, r);
		assert_int_equal(f->count, 5);
		for (int i = 0; i < 100; i++) { /* more than the reader has room for */
			snprintf(name, sizeof name, "x%d", i);
			ok(&ctx, mr_frame_put(&ctx, f, "mesh", name, REGION, triangles, SMALL));
		}
		mr_frame_drop(f, "mesh", "triangles", 0);
		ok(&ctx, mr_frame_put(&ctx, f, "mesh", "position", POSITION, position + 9, SMALL));
		expect(&ctx, f, "mesh", "position", POSITION, position + 9, SMALL);
		expect(&ctx, f, "mesh", "x77", REGION, triangles, SMALL);
		assert_null(mr_frame_find(f, "mesh", "triangles"));
		mr_frame_drop(f, "mesh", NULL, 'f');
		assert_true(mr_frame_has_layer(f, "mesh"));
		mr_frame_drop(f, "mesh", NULL, 'v');
		assert_false(mr_frame_has_layer(f, "mesh"));
		mr_ctx_free(&ctx); /* as the command does between frames */
	}
	f = next(&ctx, r);
	expect(&ctx, f, "mesh", "triangles", TRIANGLES, triangles, SMALL);
	expect_end(&ctx, r);
	close(fd);
	mr_ctx_free(&ctx);
}

/* What was read and is put back is passed on as it was stored: packed here, and known by its serial. */
static void
put_back(void **state)
{
	const void *t, *p;
	size_t nt, np, n, m;
	mr_ctx ctx;
	mr_frame *f;

	(void)state;
	mr_ctx_init(&ctx, 1);
	int in = animation(&ctx, MR_PACK), out = new_file();
	mr_reader *r = rewound(&ctx, in);
	mr_writer *w = writer_on(&ctx, out, MR_KEEP);
	for (int k = 0; k < 3; k++) {
		f = next(&ctx, r);
		ok(&ctx, mr_frame_get(&ctx, f, "mesh", "triangles", TRIANGLES, &t, &nt));
		ok(&ctx, mr_frame_get(&ctx, f, "mesh", "position", POSITION, &p, &np));
		ok(&ctx, mr_frame_put(&ctx, f, "mesh", "triangles", TRIANGLES, t, nt));
		ok(&ctx, mr_frame_put(&ctx, f, "mesh", "position", POSITION, p, np));
		ok(&ctx, mr_writer_put(&ctx, w, f));
	}
	expect_end(&ctx, r);
	ok(&ctx, mr_writer_end(&ctx, w));
	mr_writer_free(w);
	unsigned char *before = bytes_of(in, &n), *after = bytes_of(out, &m);
	assert_int_equal(n, m);
	assert_memory_equal(before, after, n);
	free(before);
	free(after);
	close(in);
	close(out);
	mr_ctx_free(&ctx);
}

/* Columns of two readers are told apart, though each reader counts its own. */
static void
two_readers(void **state)
{
	mr_ctx ctx;
	mr_reader *r[2];
	mr_frame *f;
	int fd[2], out = new_file();

	(void)state;
	mr_ctx_init(&ctx, 1);
	mr_writer *w = writer_on(&ctx, out, MR_KEEP);
	for (int i = 0; i < 2; i++) {
		fd[i] = new_file();
		mr_writer *source = writer_on(&ctx, fd[i], MR_KEEP);
		ok(&ctx, mr_frame_new(&ctx, "x", &f));
		ok(&ctx, mr_frame_put(&ctx, f, "mesh", "position", POSITION, position + i, SMALL));
		ok(&ctx, mr_writer_put(&ctx, source, f));
		ok(&ctx, mr_writer_end(&ctx, source));
		mr_writer_free(source);
		r[i] = rewound(&ctx, fd[i]);
		f = next(&ctx, r[i]);
		f->key = i == 0;
		ok(&ctx, mr_writer_put(&ctx, w, f));
	}
	ok(&ctx, mr_writer_end(&ctx, w));
	mr_writer_free(w);
	mr_reader *merged = rewound(&ctx, out);
	for (int i = 0; i < 2; i++) {
		expect(&ctx, next(&ctx, merged), "mesh", "position", POSITION, position + i, SMALL);
		mr_reader_free(r[i]);
		close(fd[i]);
	}
	expect_end(&ctx, merged);
	close(out);
	mr_ctx_free(&ctx);
}

static void
histories(void **state)
{
	mr_ctx ctx;
	mr_frame *f;
	const char clean[] = "one\ntwo ? \xc3\xa9 ? ?? ?\n";

	(void)state;
	mr_ctx_init(&ctx, 1);
	ok(&ctx, mr_frame_new(&ctx, "x", &f));
	ok(&ctx, mr_frame_add_history(&ctx, f, "one"));
	ok(&ctx, mr_frame_add_history(&ctx, f, "two \n \xc3\xa9 \xff \xc0\x80 \xc2\x85"));
	expect(&ctx, f, "", "history", TEXT, clean, sizeof clean - 1);
	ok(&ctx, mr_frame_put(&ctx, f, "", "history", TEXT, "open", 4));
	ok(&ctx, mr_frame_add_history(&ctx, f, ""));
	expect(&ctx, f, "", "history", TEXT, "open\n\n", 6);
	ok(&ctx, mr_frame_put(&ctx, f, "", "history", REGION, triangles, 4));
	assert_int_equal(mr_frame_add_history(&ctx, f, "x"), MR_EMISSING);
	mr_ctx_free(&ctx);
}

/* Names and shapes that the format forbids are refused where they are put, and frames that would break its
 * law. */
static void
refusals(void **state)
{
	static const char *const bad_frames[] = { "", ".", "..", "a/b", "a\nb", "\x7f", "\xff", "\xc2\x85",
		"\xed\xa0\x80", "\xc0\xaf", "\xf4\x90\x80\x80", "\xe2\x82" };
	static const char *const bad_columns[] = { "", "START", "FRAME", "DROP", "ENDFRAME", "END", "a b",
		"\xc3\xa4", "0123456789abcdefghijklmno" };
	static const mr_shape bad_shapes[] = { { 'v', 'x', 1 }, { 'x', 'd', 1 }, { 'v', 'd', 0 },
		{ '-', 't', 2 }, { 0, 0, 1 } };
	mr_ctx ctx;
	mr_frame *f = NULL;
	const void *data = NULL;
	size_t rows, n;

	(void)state;
	mr_ctx_init(&ctx, 1);
	for (size_t i = 0; i < sizeof bad_frames / sizeof *bad_frames; i++)
		assert_int_equal(mr_frame_new(&ctx, bad_frames[i], &f), MR_ERANGE);
	assert_null(f);
	ok(&ctx, mr_frame_new(&ctx, "...", &f));
	for (size_t i = 0; i < sizeof bad_columns / sizeof *bad_columns; i++)
		assert_int_equal(
		    mr_frame_put(&ctx, f, "mesh", bad_columns[i], REGION, triangles, 1), MR_ERANGE);
	for (size_t i = 0; i < sizeof bad_shapes / sizeof *bad_shapes; i++)
		assert_int_equal(mr_frame_put(&ctx, f, "mesh", "x", bad_shapes[i], triangles, 1), MR_ERANGE);
	assert_int_equal(mr_frame_put(&ctx, f, "0123456789abcdefg", "x", REGION, triangles, 1), MR_ERANGE);
	assert_int_equal(mr_frame_put(&ctx, f, "mesh", "x", POSITION, position, SIZE_MAX / 8), MR_ERANGE);
	assert_int_equal(f->count, 0);

	put_small(&ctx, f, "mesh");
	assert_int_equal(mr_frame_get(&ctx, f, "base", "position", POSITION, &data, &rows), MR_EMISSING);
	assert_string_equal(ctx.error, "base: no column position");
	assert_int_equal(mr_frame_get(&ctx, f, "mesh", "position", TRIANGLES, &data, &rows), MR_EMISSING);
	assert_string_equal(ctx.error, "mesh: column position is v d3, not f u3");
	assert_null(data);
	assert_int_equal(mr_frame_pass(&ctx, f, &f->columns[0]), MR_ERANGE);

	int fd = new_file();
	mr_writer *w = writer_on(&ctx, fd, MR_KEEP);
	ok(&ctx, mr_frame_put(&ctx, f, "mesh", "region", REGION, triangles, 7));
	assert_int_equal(mr_writer_put(&ctx, w, f), MR_ERANGE);
	assert_string_equal(
	    ctx.error, "mesh: column region has 7 rows, but position, also of element v, has 50");
	free(bytes_of(fd, &n));
	assert_int_equal(n, 0); /* nothing was sent of it */
	ok(&ctx, mr_frame_put(&ctx, f, "mesh", "region", REGION, triangles, SMALL));
	ok(&ctx, mr_writer_put(&ctx, w, f));
	ok(&ctx, mr_writer_end(&ctx, w));
	mr_writer_free(w);
	mr_reader *r = rewound(&ctx, fd);
	assert_int_equal(next(&ctx, r)->count, 3);
	expect_end(&ctx, r);
	close(fd);
	mr_ctx_free(&ctx);
}

/* A stream of no frames; several streams in one input; a descriptor that stands within a file. */
static void
sequences(void **state)
{
	mr_ctx ctx;
	size_t n, total;

	(void)state;
	mr_ctx_init(&ctx, 1);
	int empty = new_file(), walk = animation(&ctx, MR_KEEP);
	mr_writer *w = writer_on(&ctx, empty, MR_KEEP);
	ok(&ctx, mr_writer_end(&ctx, w));
	mr_writer_free(w);
	expect_end(&ctx, rewound(&ctx, empty));

	unsigned char *one = bytes_of(walk, &n), *all = malloc(2 * n + 128 + 3);
	assert_non_null(all);
	memcpy(all, "xyz", 3);
	memcpy(all + 3, one, n);
	assert_int_equal(pread(empty, all + 3 + n, 128, 0), 128);
	memcpy(all + 3 + n + 128, one, n);
	total = 3 + n + 128 + n;
	for (int way = 0; way < 3; way++) { /* mapped; unaligned in a file; from a pipe */
		int fd = way == 1 ? file_of(all, total)
		         : way    ? pipe_of(all + 3, total - 3)
		                  : file_of(all + 3, total - 3);
		mr_reader *r;
		if (way == 1)
			lseek(fd, 3, SEEK_SET);
		ok(&ctx, mr_reader_open(&ctx, fd, &r));
		for (uint64_t k = 1; k <= 6; k++) {
			mr_frame *f = next(&ctx, r);
			assert_int_equal(f->number, k);
			assert_int_equal(f->key, k % 3 == 1);
			expect(&ctx, f, "mesh", "triangles", TRIANGLES, triangles, SMALL);
		}
		expect_end(&ctx, r);
		close(fd);
	}
	free(one);
	free(all);
	close(empty);
	close(walk);
	mr_ctx_free(&ctx);
}

/* Nothing is sent behind an error of writing, and no END. */
static void
full_disk(void **state)
{
	mr_ctx ctx;
	mr_frame *f;

	(void)state;
	mr_ctx_init(&ctx, 1);
	FILE *full = fopen("/dev/full", "w");
	if (!full)
		skip();
	mr_writer *w = writer_on(&ctx, fileno(full), MR_KEEP);
	ok(&ctx, mr_frame_new(&ctx, "x", &f));
	put_small(&ctx, f, "mesh");
	assert_int_equal(mr_writer_put(&ctx, w, f), MR_EIO);
	assert_string_equal(ctx.error, "cannot write: No space left on device");
	assert_true(dup2(new_file(), fileno(full)) >= 0); /* there is room again, but a hole before it */
	assert_int_equal(mr_writer_put(&ctx, w, f), MR_EIO);
	assert_int_equal(mr_writer_end(&ctx, w), MR_EIO);
	mr_writer_free(w);
	fclose(full);
	mr_ctx_free(&ctx);
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(round_trips),
		cmocka_unit_test(passing_on),
		cmocka_unit_test(deltas),
		cmocka_unit_test(whole_frames),
		cmocka_unit_test(merged_is_the_frame),
		cmocka_unit_test(changes_stay_in_their_frame),
		cmocka_unit_test(put_back),
		cmocka_unit_test(two_readers),
		cmocka_unit_test(histories),
		cmocka_unit_test(refusals),
		cmocka_unit_test(sequences),
		cmocka_unit_test(full_disk),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, fill, NULL);
}
