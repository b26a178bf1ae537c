/*
 * fuzz_model.c -- the reader of the format that $FORMAT names, given any bytes: a valid model or a sentence,
 * and what is valid is written in the format, where it can be, and read again.  "gz" is a file that is
 * inflated and recognised, "png" and "jpeg" are pictures, "regions" is a file of mr-select --from, "mrz" the
 * head and the bits of a packed surface, whose checksums are put in.
 */
#include "compact/packed.h"
#include "edit/selection_file.h"
#include "formats/bytes.h"
#include "formats/format.h"
#include "formats/formats.h"
#include "formats/image.h"
#include "formats/model.h"

#include <unistd.h>
#include <zlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n);

static void
insist(bool good)
{
	if (!good)
		abort();
}

static void
check(const mr_model *m)
{
	insist(m->nv > 0);
	for (size_t i = 0; i < m->nv; i++)
		insist(mr_finite(m->p[i]) && (!m->normal || mr_finite(m->normal[i])));
	for (size_t f = 0; f < m->nf; f++)
		for (int k = 0; k < 3; k++)
			insist(m->t[f].v[k] < m->nv);
}

/* A file of its own, emptied for every use, which ends with the process; a name for it. */
static const char *
file_of(const uint8_t *bytes, size_t n)
{
	static char name[32];
	static int fd = -1;

	if (fd < 0) {
		FILE *f = tmpfile();
		insist(f && (fd = dup(fileno(f))) >= 0 && !fclose(f));
		snprintf(name, sizeof name, "/proc/self/fd/%d", fd);
	}
	insist(!ftruncate(fd, 0) && pwrite(fd, bytes, n, 0) == (ssize_t)n);
	return name;
}

/* By way of a frame, written and read again: no more triangles than there were. */
static void
write_again(mr_ctx *ctx, const mr_model *m, const char *format)
{
	const char *layer = m->nf ? "mesh" : "points";
	mr_frame *frame;
	mr_model there;
	const char *path = "/tmp/mr-fuzz-written";
	char name[64];
	bool binary;
	mr_model again;

	snprintf(name, sizeof name, "%s-%ld", path, (long)getpid());
	if (mr_format_check(ctx, name, format, true, &binary) < 0)
		return;
	insist(mr_frame_new(ctx, "model", &frame) == MR_OK);
	if (mr_model_put(ctx, frame, layer, m) == MR_OK && mr_model_get(ctx, frame, layer, &there) == MR_OK &&
	    mr_model_write(ctx, name, format, &there, NULL) == MR_OK) {
		insist(mr_model_read(ctx, name, format, &again) == MR_OK);
		check(&again);
		insist(again.nf <= m->nf);
		unlink(name);
	} else {
		insist(*ctx->error);
	}
}

/* A file of regions, given to points of the name and number that it asks for. */
static mr_status
read_regions(mr_ctx *ctx, const uint8_t *bytes, size_t n)
{
	enum { MOST = 1 << 16 };
	static uint32_t region[MOST];
	mr_selection_file file;
	mr_mesh m = { .name = "points" };
	size_t selected = 0;
	mr_status status = mr_selection_file_read(ctx, file_of(bytes, n), &file);

	if (status != MR_OK || file.nv > MOST)
		return status;
	memset(region, 0, sizeof region);
	m.nv = (size_t)file.nv;
	status = mr_selection_file_apply(ctx, &file, &m, region, &selected);
	insist(status != MR_OK || selected <= m.nv); /* who asked refuses none */
	return status;
}

/* A file of the bytes: the first says how many are its head, by two; no block is whole. */
static size_t
packed_file(const uint8_t *bytes, size_t n, unsigned char *file)
{
	size_t head = n ? 2 * (size_t)bytes[0] : 0, size = 0;
	uint32_t check;

	head = head < n ? head : n ? n - 1 : 0;
	memcpy(file, "mrz1\n", 5);
	size = 5;
	file[size++] = (unsigned char)(128 | (head & 127));
	file[size++] = (unsigned char)(head >> 7);
	if (head)
		memcpy(file + size, bytes + 1, head);
	check = (uint32_t)crc32(0, file + size, (uInt)head);
	size += head;
	for (int i = 0; i < 4; i++)
		file[size++] = (unsigned char)(check >> 8 * i);
	if (n > head + 1)
		memcpy(file + size, bytes + 1 + head, n - head - 1 < 4000 ? n - head - 1 : 4000);
	return size + (n > head + 1 ? (n - head - 1 < 4000 ? n - head - 1 : 4000) : 0);
}

static mr_status
read_packed(mr_ctx *ctx, const uint8_t *bytes, size_t n)
{
	static unsigned char file[8192];
	mr_unpack_opts o = MR_UNPACK_DEFAULTS;
	mr_frame *f;

	return mr_unpack_frame(ctx, file, packed_file(bytes, n, file), &o, &f, NULL);
}

static mr_status
read_any(mr_ctx *ctx, const char *format, const uint8_t *bytes, size_t n, mr_model *m)
{
	mr_image image;

	MR_ENTER(ctx);
	if (!strcmp(format, "mrz"))
		return read_packed(ctx, bytes, n);
	if (!strcmp(format, "regions"))
		return read_regions(ctx, bytes, n);
	if (!strcmp(format, "png"))
		return mr_png_read(ctx, bytes, n, &image);
	if (!strcmp(format, "jpeg"))
		return mr_jpeg_read(ctx, bytes, n, &image);
	if (!strcmp(format, "gz"))
		return mr_model_read(ctx, file_of(bytes, n), NULL, m);
	return mr_model_parse(ctx, "-", format, bytes, n, m);
}

int
LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n)
{
	const char *format = getenv("FORMAT");
	mr_model m = { 0 };
	mr_status status;
	mr_ctx ctx;

	insist(format != NULL);
	mr_ctx_init(&ctx, 1);
	status = read_any(&ctx, format, bytes, n, &m);
	insist(status == MR_OK || (status < 0 && *ctx.error));
	if (status == MR_OK && m.nv) {
		check(&m);
		if (strcmp(format, "gz"))
			write_again(&ctx, &m, format);
	}
	mr_ctx_free(&ctx);
	return 0;
}
