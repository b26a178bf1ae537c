/* Streams that are cut, damaged or wrong, and memory that cannot be had: an error with its place, never other
 * values. */
#include "tests/unit/stream.h"

#include "stream/fingerprint.h"

enum { ROWS = 20 };

static double position[3 * ROWS + 3];
static uint32_t triangles[3 * ROWS];

/* How a stream was read: its end, and a print of all that it held. */
typedef struct outcome {
	mr_status status;
	uint64_t frames;
	uint64_t print;
} outcome;

static mr_status
read_frame(mr_ctx *ctx, mr_frame *f, uint64_t *sum)
{
	for (mr_column *c = f->columns; c < f->columns + f->count; c++) {
		MR_TRY(mr_column_decode(ctx, c));
		uint64_t p = mr_fingerprint(
		    c->data, (size_t)c->rows * c->shape.components * mr_type_size(c->shape.type));
		uint64_t q = mr_fingerprint(c->layer, sizeof c->layer + sizeof c->name);
		*sum = *sum * 5 + (p ^ q) + (uint64_t)f->name[0];
	}
	return MR_OK;
}

static outcome
read_all(mr_ctx *ctx, int fd)
{
	outcome o = { 0 };
	mr_reader *r = NULL;
	mr_frame *f;

	o.status = mr_reader_open(ctx, fd, &r);
	if (o.status != MR_OK)
		return o;
	while ((o.status = mr_reader_next(ctx, r, &f)) == MR_OK &&
	       (o.status = read_frame(ctx, f, &o.print)) == MR_OK)
		o.frames++;
	mr_reader_free(r);
	return o;
}

static outcome
read_bytes(mr_ctx *ctx, const void *bytes, size_t n, bool piped)
{
	int fd = piped ? pipe_of(bytes, n) : file_of(bytes, n);
	outcome o = read_all(ctx, fd);

	close(fd);
	return o;
}

static bool
same(outcome a, outcome b)
{
	return a.status == b.status && a.frames == b.frames && a.print == b.print;
}

static void
frame_one(mr_ctx *ctx, mr_frame **f)
{
	ok(ctx, mr_frame_new(ctx, "x", f));
	ok(ctx, mr_frame_put(ctx, *f, "mesh", "position", POSITION, position, ROWS));
	ok(ctx, mr_frame_put(ctx, *f, "mesh", "triangles", TRIANGLES, triangles, ROWS));
	ok(ctx, mr_frame_put(ctx, *f, "base", "region", REGION, triangles, 0));
	ok(ctx, mr_frame_put(ctx, *f, "base", "note", TEXT, "some words", 10));
}

static void
frame_two(mr_ctx *ctx, mr_frame *f)
{
	f->key = false;
	ok(ctx, mr_frame_put(ctx, f, "mesh", "position", POSITION, position + 1, ROWS));
	mr_frame_drop(f, "base", NULL, 0);
	ok(ctx, mr_frame_put(ctx, f, "", "more", REGION, triangles, 3));
}

/* A small stream with everything in it; to be freed. */
static unsigned char *
small(mr_packing packing, size_t *n)
{
	mr_ctx ctx;
	mr_frame *f;
	unsigned char *bytes;

	for (size_t i = 0; i < 3 * ROWS; i++) {
		position[i] = (double)i / 3;
		triangles[i] = (uint32_t)i;
	}
	mr_ctx_init(&ctx, 1);
	int fd = new_file();
	mr_writer *w = writer_on(&ctx, fd, packing);
	frame_one(&ctx, &f);
	ok(&ctx, mr_writer_put(&ctx, w, f));
	frame_two(&ctx, f);
	ok(&ctx, mr_writer_put(&ctx, w, f));
	ok(&ctx, mr_writer_end(&ctx, w));
	mr_writer_free(w);
	bytes = bytes_of(fd, n);
	close(fd);
	mr_ctx_free(&ctx);
	return bytes;
}

static void
prefixes(void **state)
{
	mr_ctx ctx;
	size_t n;

	(void)state;
	mr_ctx_init(&ctx, 1);
	for (int packing = MR_KEEP; packing <= MR_PACK; packing++) {
		unsigned char *s = small((mr_packing)packing, &n);
		for (size_t cut = 0; cut < n; cut++) {
			outcome a = read_bytes(&ctx, s, cut, false), b = read_bytes(&ctx, s, cut, true);
			char begin[80];
			assert_int_equal(a.status, MR_EFORMAT);
			assert_true(same(a, b));
			snprintf(begin, sizeof begin, "stream ends without END at byte ");
			assert_memory_equal(ctx.error, begin, strlen(begin));
		}
		assert_int_equal(read_bytes(&ctx, s, n, true).status, MR_END);
		free(s);
	}
	mr_ctx_free(&ctx);
}

/* A bit that is not what it was is an error or, where it is no part of any value, seen by nobody. */
static void
flipped_bits(void **state)
{
	mr_ctx ctx;
	size_t n, unseen = 0;

	(void)state;
	mr_ctx_init(&ctx, 1);
	for (int packing = MR_KEEP; packing <= MR_PACK; packing++) {
		unsigned char *s = small((mr_packing)packing, &n);
		outcome good = read_bytes(&ctx, s, n, false);
		assert_int_equal(good.status, MR_END);
		assert_int_equal(good.frames, 2);
		for (size_t bit = 0; bit < 8 * n; bit++) {
			s[bit / 8] ^= (unsigned char)(1 << bit % 8);
			outcome o = read_bytes(&ctx, s, n, bit % 2);
			if (o.status != MR_EFORMAT && !same(o, good))
				fail_msg("bit %zu of byte %zu changes the values", bit % 8, bit / 8);
			unseen += o.status != MR_EFORMAT;
			s[bit / 8] ^= (unsigned char)(1 << bit % 8);
		}
		free(s);
	}
	assert_int_equal(unseen, 0);
	mr_ctx_free(&ctx);
}

/* Memory fails at the k-th call, for every k: no crash, no leak, and what is said is that. */
static void
reading_without_memory(void **state)
{
	mr_ctx ctx;
	size_t n;

	(void)state;
	for (int way = 0; way < 4; way++) {
		unsigned char *s = small(way & 1 ? MR_PACK : MR_KEEP, &n);
		outcome o = { 0 };
		for (uint64_t k = 1; o.status != MR_END; k++) {
			mr_ctx_init(&ctx, 1);
			ctx.fail_at = k;
			o = read_bytes(&ctx, s, n, way & 2);
			if (o.status != MR_END) {
				assert_int_equal(o.status, MR_EMEM);
				assert_non_null(strstr(ctx.error, "no memory"));
			}
			mr_ctx_free(&ctx);
			assert_true(k < 1000);
		}
		free(s);
	}
}

/* The same for writing: a frame is sent whole or not at all, and can be sent when there is memory again. */
static void
writing_without_memory(void **state)
{
	bool done = false;

	(void)state;
	for (uint64_t k = 1; !done; k++) {
		mr_ctx ctx, good;
		mr_frame *f[2];
		mr_writer *w = NULL;
		mr_status status;
		assert_true(k < 1000);
		mr_ctx_init(&ctx, 1);
		mr_ctx_init(&good, 1);
		frame_one(&good, &f[0]);
		frame_one(&good, &f[1]);
		frame_two(&good, f[1]);
		int fd = new_file();
		ctx.fail_at = k;
		status = mr_writer_open(&ctx, fd, MR_PACK, &w);
		done = status == MR_OK;
		for (int i = 0; status == MR_OK && i < 2; i++) {
			mr_status put = mr_writer_put(&ctx, w, f[i]);
			if (put == MR_OK)
				continue;
			done = false;
			assert_int_equal(put, MR_EMEM);
			assert_non_null(strstr(ctx.error, "no memory"));
			mr_writer_skipped(w);
			ok(&ctx, mr_writer_put(&ctx, w, f[i]));
		}
		if (status == MR_OK) {
			ok(&ctx, mr_writer_end(&ctx, w));
			lseek(fd, 0, SEEK_SET);
			ctx.fail_at = 0;
			outcome o = read_all(&ctx, fd);
			assert_int_equal(o.status, MR_END);
			assert_int_equal(o.frames, 2);
		} else {
			assert_int_equal(status, MR_EMEM);
		}
		mr_writer_free(w);
		close(fd);
		mr_ctx_free(&ctx);
		mr_ctx_free(&good);
	}
}

/* Streams made by hand, each with one thing wrong, and the sentence. */
typedef struct script {
	unsigned char s[8192];
	size_t n;
} script;

static void
open_frame(script *b, const char *text)
{
	b->n = mark(b->s, "START", "mrmesh1\n", "");
	b->n += mark(b->s + b->n, "FRAME", "", text);
}

static void
close_frame(script *b)
{
	b->n += mark(b->s + b->n, "ENDFRAME", "", "");
	b->n += mark(b->s + b->n, "END", "", "");
}

static void
add(script *b, const char *layer, const char *name, const char *shape, int components, int codec,
    uint64_t rows, uint64_t stored)
{
	static const char zeros[4096];

	b->n += record(b->s + b->n, layer, name, shape, components, codec, rows, zeros, stored);
}

static void
expect_failure(const script *b, const char *sentence)
{
	mr_ctx ctx;

	mr_ctx_init(&ctx, 1);
	for (int piped = 0; piped < 2; piped++) {
		outcome o = read_bytes(&ctx, b->s, b->n, piped);
		if (o.status != MR_EFORMAT || !strstr(ctx.error, sentence))
			fail_msg(
			    "status %d, '%s', not '%s'", o.status, o.status < 0 ? ctx.error : "", sentence);
	}
	mr_ctx_free(&ctx);
}

static void
wrong_columns(void **state)
{
	static const struct {
		const char *layer, *name, *shape;
		int components, codec;
		uint64_t rows, stored;
		const char *sentence;
	} wrong[] = {
		{ "mesh", "x", "vd", 3, 0, 2, 40,
		    "byte 192: column x of layer 'mesh' stores 40 bytes, its rows have 48" },
		{ "mesh", "x", "vd", 3, 0, UINT64_MAX / 12, 0, "no such shape" },
		{ "mesh", "x", "vd", 0, 0, 2, 0, "no such shape" },
		{ "mesh", "x", "vx", 1, 0, 2, 2, "no such shape" },
		{ "mesh", "x", "ed", 1, 0, 2, 16, "no such shape" },
		{ "mesh", "x", "-t", 2, 0, 2, 4, "no such shape" },
		{ "mesh", "x", "vd", 1, 2, 2, 16, "has codec 2" },
		{ "mesh", "x", "vb", 1, 1, 1000000, 100, "cannot have packed 1000000 bytes into 100" },
		{ "mesh", "x", "vb", 1, 1, 1000, 100,
		    "mesh: x: packed bytes are damaged, or not those of 1000 rows" },
		{ "mesh", "", "vb", 1, 0, 4, 4, "bad name of a column" },
		{ "mesh", "a b", "vb", 1, 0, 4, 4, "bad name of a column" },
		{ "mesh", "\xc3\xa4", "vb", 1, 0, 4, 4, "bad name of a column" },
		{ "a\tb", "x", "vb", 1, 0, 4, 4, "bad name of a layer" },
		{ "mrmesh1\n", "x", "vb", 1, 0, 4, 4, "bad name of a layer" },
		{ "mesh", "START", "-t", 1, 0, 0, 0, "bad name of a layer" },
		{ "", "FRAME", "-t", 1, 0, 0, 0, "FRAME stands within a frame" },
		{ "", "END", "-t", 1, 0, 0, 0, "END stands within a frame" },
		{ "mesh", "END", "-t", 1, 0, 0, 0, "END names the layer mesh" },
		{ "", "END", "-t", 1, 0, 4, 4, "END has 4 bytes, more than 0" },
		{ "", "ENDFRAME", "vt", 1, 0, 0, 0, "ENDFRAME is not of raw text" },
		{ "mesh", "DROP", "-t", 1, 0, 0, 0,
		    "DROP of column '' of layer 'mesh': the frame before has none" },
		{ "mesh", "position", "vd", 3, 0, 2, 48,
		    "column position has 2 rows, but region, also of element v, has 3" },
		{ "mesh", "region", "vu", 1, 0, 3, 12, "byte 320: region comes twice in a frame" },
	};

	(void)state;
	for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
		script b;
		open_frame(&b, "key x");
		if (i + 2 >= sizeof wrong / sizeof *wrong)
			add(&b, "mesh", "region", "vu", 1, 0, 3, 12);
		add(&b, wrong[i].layer, wrong[i].name, wrong[i].shape, wrong[i].components, wrong[i].codec,
		    wrong[i].rows, wrong[i].stored);
		close_frame(&b);
		expect_failure(&b, wrong[i].sentence);
	}
}

static void
wrong_frames(void **state)
{
	static const struct {
		const char *text, *sentence;
	} wrong[] = {
		{ "", "byte 64: FRAME says neither" },
		{ "key", "says neither" },
		{ "key ", "says neither" },
		{ "KEY x", "says neither" },
		{ "key a/b", "has a bad name" },
		{ "key ..", "has a bad name" },
		{ "key \xff", "has a bad name" },
		{ "delta x", "begins a stream with a delta" },
	};
	script b;

	(void)state;
	for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
		open_frame(&b, wrong[i].text);
		close_frame(&b);
		expect_failure(&b, wrong[i].sentence);
	}
	open_frame(&b, "key x");
	close_frame(&b);
	b.n += mark(b.s + b.n, "END", "", "");
	expect_failure(&b, "this is not a stream: no START here");
	open_frame(&b, "key x");
	close_frame(&b);
	b.n -= 64;
	add(&b, "mesh", "x", "vb", 1, 0, 1, 1);
	expect_failure(&b, "x stands outside of a frame");
	open_frame(&b, "key x");
	b.n += mark(b.s + b.n, "START", "mrmesh1\n", "");
	expect_failure(&b, "START stands within a frame");
	b.n = (size_t)snprintf((char *)b.s, sizeof b.s, "OFF\n3 1 0\n");
	expect_failure(&b, "byte 0: this is not a stream: no START here");
}

/* Padding, and deltas that drop or repeat what they must not. */
static void
wrong_deltas(void **state)
{
	/* Nothing of them is in the sentence: a terminal would obey. */
	static const struct {
		const char *s;
		size_t n;
	} bad_names[] = { { "\033[2J", 4 }, { "re\ngion", 7 }, { "\xc3\xa4", 2 }, { "re gion", 7 },
		{ "region\0", 7 }, { "END", 3 } };
	script b, begun;

	(void)state;
	open_frame(&begun, "key x");
	add(&begun, "mesh", "region", "vu", 1, 0, 3, 12);
	b = begun;
	b.s[b.n - 1] = 1;
	close_frame(&b);
	expect_failure(&b, "byte 319: the padding of region is not zero");

	begun.n += mark(begun.s + begun.n, "ENDFRAME", "", "");
	begun.n += mark(begun.s + begun.n, "FRAME", "", "delta x");
	b = begun;
	add(&b, "mesh", "position", "vd", 3, 0, 2, 48);
	close_frame(&b);
	expect_failure(&b, "mesh: column position has 2 rows, but region, also of element v, has 3");
	b = begun;
	b.n += mark(b.s + b.n, "DROP", "mesh", "regions");
	close_frame(&b);
	expect_failure(&b, "DROP of column 'regions' of layer 'mesh': the frame before has none");
	b = begun;
	add(&b, "mesh", "region", "vu", 1, 0, 5, 20);
	b.n += mark(b.s + b.n, "DROP", "mesh", "region");
	close_frame(&b);
	expect_failure(&b, "DROP of column 'region' of layer 'mesh': the frame before has none");
	for (size_t i = 0; i < sizeof bad_names / sizeof *bad_names; i++) {
		b = begun;
		b.n += record(
		    b.s + b.n, "mesh", "DROP", "-t", 1, 0, bad_names[i].n, bad_names[i].s, bad_names[i].n);
		close_frame(&b);
		expect_failure(&b, "byte 512: DROP has a bad name of a column");
	}
}

/* What the reader says of a delta that sends one column and drops another, of a key frame of so many. */
static mr_status
count_columns(mr_ctx *ctx, size_t columns, bool sends, bool drops)
{
	unsigned char *s = malloc(64 * (columns + 20));
	size_t n = 0;

	assert_non_null(s);
	n += mark(s + n, "START", "mrmesh1\n", "");
	n += mark(s + n, "FRAME", "", "key x");
	for (size_t i = 0; i < columns; i++) {
		char name[24];
		snprintf(name, sizeof name, "c%zu", i);
		n += record(s + n, "mesh", name, "vb", 1, 0, 0, "", 0);
	}
	n += mark(s + n, "ENDFRAME", "", "");
	n += mark(s + n, "FRAME", "", "delta x");
	if (sends)
		n += record(s + n, "mesh", "more", "vb", 1, 0, 0, "", 0);
	if (drops)
		n += mark(s + n, "DROP", "mesh", "c0");
	n += mark(s + n, "ENDFRAME", "", "");
	n += mark(s + n, "END", "", "");
	mr_status status = read_bytes(ctx, s, n, false).status;
	free(s);
	return status;
}

static void
too_many_columns(void **state)
{
	mr_ctx ctx;

	(void)state;
	mr_ctx_init(&ctx, 1);
	assert_int_equal(count_columns(&ctx, 4096, false, false), MR_END);
	assert_int_equal(count_columns(&ctx, 4097, false, true), MR_EFORMAT);
	assert_string_equal(ctx.error, "before byte 262400: a frame of more than 4096 columns");
	assert_int_equal(count_columns(&ctx, 4096, true, true), MR_END);
	assert_int_equal(count_columns(&ctx, 4096, true, false), MR_EFORMAT);
	assert_non_null(strstr(ctx.error, "a frame of more than 4096 columns"));
	mr_ctx_free(&ctx);
}

/* A packed payload inflates to its rows exactly, and nothing stands behind it. */
static void
wrong_packing(void **state)
{
	static const unsigned char values[1000];
	unsigned char packed[100] = { 0 };
	unsigned long n = sizeof packed;

	(void)state;
	assert_int_equal(compress(packed, &n, values, sizeof values), Z_OK);
	for (int k = 0; k < 4; k++) {
		script b;
		open_frame(&b, "key x");
		b.n += record(b.s + b.n, "mesh", "x", "vb", 1, 1,
		    k == 1   ? 999
		    : k == 2 ? 1001
			     : 1000,
		    packed, n + (k == 3));
		close_frame(&b);
		if (k == 0) {
			mr_ctx ctx;
			mr_ctx_init(&ctx, 1);
			assert_int_equal(read_bytes(&ctx, b.s, b.n, true).status, MR_END);
			mr_ctx_free(&ctx);
		} else {
			expect_failure(&b, "are damaged, or not those of");
		}
	}
}

/* A header that promises 2^50 bytes costs no memory, from a pipe or a file. */
static void
promises(void **state)
{
	mr_ctx ctx;
	script b;

	(void)state;
	mr_ctx_init(&ctx, 1);
	open_frame(&b, "key x");
	add(&b, "mesh", "x", "vb", 1, 0, 64, 64);
	uint64_t huge = (uint64_t)1 << 50;
	memcpy(b.s + 192 + 48, &huge, 8);
	memcpy(b.s + 192 + 56, &huge, 8);
	expect_failure(&b, "stream ends without END");
	mr_ctx_free(&ctx);
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(prefixes),
		cmocka_unit_test(flipped_bits),
		cmocka_unit_test(reading_without_memory),
		cmocka_unit_test(writing_without_memory),
		cmocka_unit_test(wrong_columns),
		cmocka_unit_test(wrong_frames),
		cmocka_unit_test(wrong_deltas),
		cmocka_unit_test(too_many_columns),
		cmocka_unit_test(wrong_packing),
		cmocka_unit_test(promises),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
