/* The fuzz target of the stream over mutated seeds, for a few seconds, without libFuzzer. */
#include "tests/fuzz/fuzz_stream.c"
#include "tests/unit/stream.h"

#include "base/random.h"

enum { ROOM = 16384, SECONDS = 3 };

/* A key frame and two deltas, packed or not. */
static size_t
seed_stream(unsigned char *to, mr_packing packing)
{
	static double p[90];
	static uint32_t t[90];
	mr_ctx ctx;
	mr_frame *f;
	size_t n;

	mr_ctx_init(&ctx, 1);
	int fd = new_file();
	mr_writer *w = writer_on(&ctx, fd, packing);
	ok(&ctx, mr_frame_new(&ctx, "seed", &f));
	ok(&ctx, mr_frame_put(&ctx, f, "mesh", "position", POSITION, p, 30));
	ok(&ctx, mr_frame_put(&ctx, f, "mesh", "triangles", TRIANGLES, t, 30));
	ok(&ctx, mr_frame_put(&ctx, f, "base", "region", REGION, t, 70));
	ok(&ctx, mr_frame_add_history(&ctx, f, "line"));
	ok(&ctx, mr_writer_put(&ctx, w, f));
	f->key = false;
	p[1] = 3;
	ok(&ctx, mr_frame_put(&ctx, f, "mesh", "position", POSITION, p, 30));
	mr_frame_drop(f, "base", "region", 0);
	ok(&ctx, mr_writer_put(&ctx, w, f));
	ok(&ctx, mr_writer_put(&ctx, w, f));
	ok(&ctx, mr_writer_end(&ctx, w));
	mr_writer_free(w);
	mr_ctx_free(&ctx);
	unsigned char *bytes = bytes_of(fd, &n);
	assert_true(n <= ROOM / 2);
	memcpy(to, bytes, n);
	free(bytes);
	close(fd);
	return n;
}

/* The length of the record at `at`, padding and all, or what is left. */
static size_t
length_at(const unsigned char *s, size_t n, size_t at)
{
	uint64_t stored;

	if (n - at < 64)
		return n - at;
	memcpy(&stored, s + at + 56, 8);
	return stored < n && 64 + (stored + 63) / 64 * 64 < n - at ? 64 + (size_t)((stored + 63) / 64 * 64)
	                                                           : n - at;
}

/* Makes the checksum of the record at `at` good again, so that what is behind it is reached. */
static void
mend(unsigned char *s, size_t n, size_t at)
{
	uint64_t stored;
	uint32_t crc;

	if (n - at < 64)
		return;
	memcpy(&stored, s + at + 56, 8);
	if (stored > n - at - 64)
		return;
	memset(s + at + 44, 0, 4);
	crc = (uint32_t)crc32(crc32(0, s + at, 64), s + at + 64, (unsigned)stored);
	memcpy(s + at + 44, &crc, 4);
}

/* Changes bytes of a record, or repeats, removes or swaps whole ones. */
static size_t
mutate(mr_random *random, unsigned char *s, size_t n)
{
	uint64_t r = mr_random_bits(random);
	size_t steps = r >> 8 & 15, at = 0, length;

	while (steps-- && at + length_at(s, n, at) < n)
		at += length_at(s, n, at);
	length = length_at(s, n, at);
	switch (r & 7) {
	case 0: /* twice */
		if (n + length > ROOM)
			return n;
		memmove(s + at + length, s + at, n - at);
		return n + length;
	case 1: /* gone */
		memmove(s + at, s + at + length, n - at - length);
		return n - length;
	case 2: /* cut */
		return at + (size_t)(r >> 16) % (length + 1);
	case 3: /* a bit */
		s[at + (r >> 16) % length] ^= (unsigned char)(1u << (r >> 60 & 7));
		return n;
	default: /* a byte of the header or of the payload, with a good checksum */
		s[at + (r >> 16) % (r & 1 ? 64 : length)] = (unsigned char)(r >> 40 & 3 ? r >> 48 & 3
											: r >> 48);
		mend(s, n, at);
		return n;
	}
}

static void
mutations(void **state)
{
	static unsigned char seeds[2][ROOM], s[ROOM];
	mr_random random = { 1 };
	size_t length[2], tried = 0;
	double end = mr_seconds() + SECONDS;

	(void)state;
	length[0] = seed_stream(seeds[0], MR_KEEP);
	length[1] = seed_stream(seeds[1], MR_PACK);
	while (mr_seconds() < end) {
		size_t which = mr_random_bits(&random) & 1, n = length[which],
		       changes = mr_random_bits(&random) & 3;
		memcpy(s, seeds[which], n);
		for (size_t i = 0; i <= changes && n >= 64; i++)
			n = mutate(&random, s, n);
		LLVMFuzzerTestOneInput(s, n);
		tried++;
	}
	assert_true(tried > 100);
}

int
main(void)
{
	const struct CMUnitTest tests[] = { cmocka_unit_test(mutations) };

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
