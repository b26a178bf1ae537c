/*
 * records.h -- mutates a stream record by record, by libFuzzer's mutations and its own, and makes its
 * checksums right again, so that each mutation comes as far as what works on the columns.
 */
#ifndef MR_FUZZ_RECORDS_H
#define MR_FUZZ_RECORDS_H

#include "base/random.h"
#include "stream/record.h"

#include <unistd.h>
#include <zlib.h>

enum { SUM_AT = 44, ROWS_AT = 48, STORED_AT = 56, TYPE_AT = 41 };

size_t LLVMFuzzerCustomMutator(uint8_t *bytes, size_t n, size_t room, unsigned seed);
size_t LLVMFuzzerMutate(uint8_t *bytes, size_t n, size_t room);

static void
insist(bool good, const char *why)
{
	if (good)
		return;
	fprintf(stderr, "%s\n", why);
	abort();
}

static uint64_t
number_at(const uint8_t *record, size_t at)
{
	uint64_t value;

	memcpy(&value, record + at, sizeof value);
	return value;
}

/* The length of a record, padding and all; 0 where it does not fit into what is left. */
static size_t
length_of(const uint8_t *record, size_t left)
{
	uint64_t stored = left < MR_HEADER ? left : number_at(record, STORED_AT);

	return stored >= left || MR_HEADER + mr_record_padded(stored) > left
	           ? 0
	           : MR_HEADER + (size_t)mr_record_padded(stored);
}

static void
repair(uint8_t *bytes, size_t n)
{
	for (size_t at = 0, length; at < n && (length = length_of(bytes + at, n - at)) > 0; at += length) {
		size_t stored = (size_t)number_at(bytes + at, STORED_AT);
		uint32_t sum;
		memset(bytes + at + MR_HEADER + stored, 0, length - MR_HEADER - stored);
		memset(bytes + at + SUM_AT, 0, sizeof sum);
		sum = (uint32_t)crc32_z(0, bytes + at, MR_HEADER + stored);
		memcpy(bytes + at + SUM_AT, &sum, sizeof sum);
	}
}

/* The place of a record that has a payload, or of any. */
static size_t
some_record(mr_random *random, const uint8_t *bytes, size_t n, bool full)
{
	size_t found = 0, seen = 0;

	for (size_t at = 0, length; at < n && (length = length_of(bytes + at, n - at)) > 0; at += length)
		if ((!full || length > MR_HEADER) && mr_random_bits(random) % ++seen == 0)
			found = at;
	return found;
}

static double
odd_number(mr_random *random, double old, double other)
{
	static const double odd[] = { 0, -0.0, 1, -1, 1e-300, 1e300, 5e-324, 1e30, 1e-30, 1e15, INFINITY,
		NAN };
	uint64_t kind = mr_random_bits(random) % 16;

	switch (kind) {
	case 0:
		return odd[mr_random_bits(random) % (sizeof odd / sizeof *odd)];
	case 1:
		return old * 1e6;
	case 2:
		return -old;
	case 3:
	case 4:
	case 5:
		return old * (1 + 0.1 * (mr_random_real(random) - 0.5));
	default:
		return other;
	}
}

/* Some values of a column are as those of another place, or odd. */
static void
change_values(mr_random *random, uint8_t *record)
{
	size_t size = record[TYPE_AT] == 'd' ? sizeof(double) : sizeof(uint32_t);
	size_t n = (size_t)number_at(record, STORED_AT) / size, times = 1 + mr_random_bits(random) % 8;
	uint8_t *payload = record + MR_HEADER;

	while (n && times--) {
		uint8_t *to = payload + mr_random_bits(random) % n * size;
		const uint8_t *from = payload + mr_random_bits(random) % n * size;
		double old, other;
		if (size == sizeof old) {
			memcpy(&old, to, size);
			memcpy(&other, from, size);
			old = odd_number(random, old, other);
			memcpy(to, &old, size);
		} else {
			memmove(to, from, size);
		}
	}
}

/* All values of a component are one value: a flat mesh, a mesh in one point. */
static void
flatten(mr_random *random, uint8_t *record)
{
	size_t n = (size_t)number_at(record, STORED_AT) / sizeof(double), step = record[TYPE_AT + 1];
	size_t from = step ? mr_random_bits(random) % step : 0;

	if (record[TYPE_AT] != 'd' || !step)
		return;
	for (size_t i = from + step; i < n; i += step)
		memcpy(record + MR_HEADER + sizeof(double) * i, record + MR_HEADER + sizeof(double) * from,
		    sizeof(double));
}

/* Fewer rows: the last ones go. */
static size_t
shorten(mr_random *random, uint8_t *bytes, size_t n, size_t at)
{
	uint64_t rows = number_at(bytes + at, ROWS_AT), stored = number_at(bytes + at, STORED_AT), kept;
	size_t length = length_of(bytes + at, n - at), shorter;

	if (!rows || stored % rows)
		return n;
	kept = mr_random_bits(random) % rows;
	stored = stored / rows * kept;
	memcpy(bytes + at + ROWS_AT, &kept, sizeof kept);
	memcpy(bytes + at + STORED_AT, &stored, sizeof stored);
	shorter = MR_HEADER + (size_t)mr_record_padded(stored);
	memmove(bytes + at + shorter, bytes + at + length, n - at - length);
	return n - (length - shorter);
}

/* Once more, at the place of another record. */
static size_t
repeat(mr_random *random, uint8_t *bytes, size_t n, size_t at, size_t room)
{
	size_t length = length_of(bytes + at, n - at), to = some_record(random, bytes, n, false);
	uint8_t *copy;

	if (n + length > room)
		return n;
	copy = malloc(length);
	insist(copy != NULL, "no memory");
	memcpy(copy, bytes + at, length);
	memmove(bytes + to + length, bytes + to, n - to);
	memcpy(bytes + to, copy, length);
	free(copy);
	return n + length;
}

static size_t
leave_out(uint8_t *bytes, size_t n, size_t at)
{
	size_t length = length_of(bytes + at, n - at);

	memmove(bytes + at, bytes + at + length, n - at - length);
	return n - length;
}

/* A file of its own for every use: opened once, emptied each time. */
static int
emptied(int *fd)
{
	if (*fd < 0) {
		FILE *f = tmpfile();
		insist(f && (*fd = dup(fileno(f))) >= 0 && !fclose(f), "no temporary file");
	}
	insist(!ftruncate(*fd, 0) && !lseek(*fd, 0, SEEK_SET), "no empty file");
	return *fd;
}

static int
file_of(int *fd, const uint8_t *bytes, size_t n)
{
	emptied(fd);
	insist(write(*fd, bytes, n) == (ssize_t)n && !lseek(*fd, 0, SEEK_SET), "a file cannot be written");
	return *fd;
}

/* Reads to the end; how many frames there were, MR_UNKNOWN where the reader refuses them. */
static size_t
frames_of(int fd)
{
	size_t frames = 0;
	mr_reader *reader = NULL;
	mr_status status;
	mr_frame *f;
	mr_ctx ctx;

	mr_ctx_init(&ctx, 1);
	status = mr_reader_open(&ctx, fd, &reader);
	insist(status == MR_OK, "the reader cannot begin");
	while ((status = mr_reader_next(&ctx, reader, &f)) == MR_OK)
		frames++;
	mr_reader_free(reader);
	mr_ctx_free(&ctx);
	return status == MR_END ? frames : MR_UNKNOWN;
}

static bool
is_stream(const uint8_t *bytes, size_t n)
{
	static int fd = -1;

	return frames_of(file_of(&fd, bytes, n)) != MR_UNKNOWN;
}

static size_t
mutate(mr_random *random, uint8_t *bytes, size_t n, size_t room)
{
	uint64_t kind = mr_random_bits(random) % 16;
	size_t at = some_record(random, bytes, n, kind > 2), length = length_of(bytes + at, n - at);

	if (!length)
		n = LLVMFuzzerMutate(bytes, n, room);
	else if (kind == 0)
		n = leave_out(bytes, n, at);
	else if (kind == 1)
		n = repeat(random, bytes, n, at, room);
	else if (kind == 2)
		LLVMFuzzerMutate(bytes + at, 44, 44);
	else if (kind == 3)
		n = shorten(random, bytes, n, at);
	else if (kind == 4)
		flatten(random, bytes + at);
	else if (kind < 8)
		LLVMFuzzerMutate(bytes + at + MR_HEADER, length - MR_HEADER, length - MR_HEADER);
	else
		change_values(random, bytes + at);
	repair(bytes, n);
	return n;
}

/* A mutation that is still a stream, if one of a few is. */
size_t
LLVMFuzzerCustomMutator(uint8_t *bytes, size_t n, size_t room, unsigned seed)
{
	uint8_t *old = malloc(n);
	mr_random random = { seed };
	size_t length = n;

	insist(old != NULL, "no memory");
	memcpy(old, bytes, n);
	for (int tries = 0; tries < 6; tries++) {
		memcpy(bytes, old, n);
		length = mutate(&random, bytes, n, room);
		if (is_stream(bytes, length))
			break;
	}
	free(old);
	return length;
}

#endif
