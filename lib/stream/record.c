/* Headers to and from bytes, and what must hold of them. */
#include "stream/record.h"

#include "base/utf8.h"

#include <libdeflate.h>

/* Offsets of the fields of a header. */
enum {
	LAYER = 0,
	NAME = 16,
	ELEMENT = 40,
	TYPE = 41,
	COMPONENTS = 42,
	CODEC = 43,
	CRC = 44,
	ROWS = 48,
	STORED = 56
};

static const char *const kinds[] = { NULL, "START", "FRAME", "DROP", "ENDFRAME", "END" };

enum { KINDS = sizeof kinds / sizeof *kinds };

size_t
mr_type_size(char type)
{
	return type == 'd' ? 8 : type == 'u' ? 4 : 1;
}

bool
mr_shape_size(mr_shape s, uint64_t rows, uint64_t *size)
{
	const uint64_t most = (uint64_t)1 << 56;
	uint64_t row = s.components * mr_type_size(s.type);

	if (!s.element || !strchr("vf-", s.element) || !s.type || !strchr("dubt", s.type) || row == 0 ||
	    (s.type == 't' && s.components != 1) || rows > most / row)
		return false;
	*size = rows * row;
	return true;
}

static mr_kind
kind_of(const char *name)
{
	for (int k = MR_START; k < KINDS; k++)
		if (!strcmp(kinds[k], name))
			return (mr_kind)k;
	return MR_COLUMN;
}

static bool
printable(const char *name)
{
	for (; *name; name++)
		if (*name <= ' ' || *name > '~')
			return false;
	return true;
}

bool
mr_name_valid(const char *name, size_t most)
{
	size_t n = strlen(name);

	return n > 0 && n <= most && printable(name) && (most == MR_LAYER_MAX || kind_of(name) == MR_COLUMN);
}

bool
mr_frame_name_valid(const char *name, size_t length)
{
	const unsigned char *s = (const unsigned char *)name;
	size_t step;
	uint32_t c;

	if (length == 0 || length > MR_NAME_MAX ||
	    (s[0] == '.' && (length == 1 || (length == 2 && s[1] == '.'))))
		return false;
	for (size_t i = 0; i < length; i += step) {
		step = mr_utf8(s + i, length - i, &c);
		if (step == 0 || mr_is_control(c) || c == '/')
			return false;
	}
	return true;
}

mr_record
mr_record_of(mr_kind kind, const char *layer, size_t stored)
{
	mr_record r = {
		.kind = kind, .shape = { '-', 't', 1 }, .rows = stored, .stored = stored, .size = stored
	};

	snprintf(r.layer, sizeof r.layer, "%s", kind == MR_START ? MR_MAGIC : layer);
	snprintf(r.name, sizeof r.name, "%s", kinds[kind]);
	return r;
}

/* Copies a NUL-padded field; false where something follows the padding or a character is none of a name. */
static bool
field(char *to, const unsigned char *from, size_t n)
{
	size_t length = 0;

	while (length < n && from[length])
		length++;
	for (size_t i = length; i < n; i++)
		if (from[i])
			return false;
	memcpy(to, from, length);
	to[length] = 0;
	return printable(to);
}

/* The rules of structural records. */
static mr_status
check_structure(mr_ctx *ctx, const mr_record *r, uint64_t offset)
{
	uint64_t most = r->kind == MR_FRAME ? MR_NAME_MAX + 6 : r->kind == MR_DROP ? MR_COLUMN_MAX : 0;

	if (r->shape.element != '-' || r->shape.type != 't' || r->codec != MR_RAW)
		return mr_fail(
		    ctx, MR_EFORMAT, "byte %llu: %s is not of raw text", (unsigned long long)offset, r->name);
	if (r->stored > most)
		return mr_fail(ctx, MR_EFORMAT, "byte %llu: %s has %llu bytes, more than %llu",
		    (unsigned long long)offset, r->name, (unsigned long long)r->stored,
		    (unsigned long long)most);
	if (r->kind != MR_DROP && *r->layer)
		return mr_fail(ctx, MR_EFORMAT, "byte %llu: %s names the layer %s",
		    (unsigned long long)offset, r->name, r->layer);
	return MR_OK;
}

/* The rules of the sizes in a column's header. */
static mr_status
check_sizes(mr_ctx *ctx, const mr_record *r, uint64_t offset)
{
	unsigned long long at = offset, size = r->size, stored = r->stored;

	if (r->codec == MR_RAW && stored != size)
		return mr_fail(ctx, MR_EFORMAT,
		    "byte %llu: column %s of layer '%s' stores %llu bytes, its rows have %llu", at, r->name,
		    r->layer, stored, size);
	if (r->codec == MR_PACKED && (stored >= (uint64_t)1 << 56 || stored < size / MR_RATIO))
		return mr_fail(ctx, MR_EFORMAT,
		    "byte %llu: column %s of layer '%s' cannot have packed %llu bytes into %llu", at, r->name,
		    r->layer, size, stored);
	return MR_OK;
}

mr_status
mr_record_parse(mr_ctx *ctx, const unsigned char header[MR_HEADER], uint64_t offset, mr_record *record)
{
	unsigned long long at = offset;
	mr_record r = { .shape = { (char)header[ELEMENT], (char)header[TYPE], header[COMPONENTS] } };
	bool start = !memcmp(header + LAYER, MR_MAGIC, MR_MAGIC_BYTES);

	memcpy(&r.rows, header + ROWS, sizeof r.rows);
	memcpy(&r.stored, header + STORED, sizeof r.stored);

	if (!field(r.name, header + NAME, MR_COLUMN_MAX) || !*r.name)
		return mr_fail(ctx, MR_EFORMAT, "byte %llu: no record begins here: bad name of a column", at);
	r.kind = kind_of(r.name);
	if ((r.kind == MR_START) != start || !field(r.layer, header + LAYER + (start ? MR_MAGIC_BYTES : 0),
						 MR_LAYER_MAX - (start ? MR_MAGIC_BYTES : 0)))
		return mr_fail(ctx, MR_EFORMAT, "byte %llu: no record begins here: bad name of a layer", at);
	if (!mr_shape_size(r.shape, r.rows, &r.size))
		return mr_fail(ctx, MR_EFORMAT,
		    "byte %llu: column %s of layer '%s': no such shape: "
		    "element %d, type %d, %u components, %llu rows",
		    at, r.name, r.layer, header[ELEMENT], header[TYPE], header[COMPONENTS],
		    (unsigned long long)r.rows);
	if (header[CODEC] > MR_PACKED)
		return mr_fail(ctx, MR_EFORMAT, "byte %llu: column %s of layer '%s' has codec %u of %d", at,
		    r.name, r.layer, header[CODEC], MR_PACKED + 1);
	r.codec = (mr_codec)header[CODEC];
	MR_TRY(check_sizes(ctx, &r, offset));
	if (r.kind != MR_COLUMN)
		MR_TRY(check_structure(ctx, &r, offset));
	*record = r;
	return MR_OK;
}

/* The CRC-32 of the header with its checksum zero, then of the payload. */
static uint32_t
checksum(const unsigned char header[MR_HEADER], const void *payload, size_t stored)
{
	unsigned char h[MR_HEADER];

	memcpy(h, header, MR_HEADER);
	memset(h + CRC, 0, 4);
	return libdeflate_crc32(libdeflate_crc32(0, h, MR_HEADER), payload, stored);
}

void
mr_record_encode(const mr_record *r, const void *payload, unsigned char header[MR_HEADER])
{
	uint32_t crc;

	memset(header, 0, MR_HEADER);
	memcpy(header + LAYER, r->layer, strlen(r->layer));
	memcpy(header + NAME, r->name, strlen(r->name));
	header[ELEMENT] = (unsigned char)r->shape.element;
	header[TYPE] = (unsigned char)r->shape.type;
	header[COMPONENTS] = r->shape.components;
	header[CODEC] = (unsigned char)r->codec;
	memcpy(header + ROWS, &r->rows, sizeof r->rows);
	memcpy(header + STORED, &r->stored, sizeof r->stored);
	crc = checksum(header, payload, (size_t)r->stored);
	memcpy(header + CRC, &crc, sizeof crc);
}

mr_status
mr_record_verify(
    mr_ctx *ctx, const unsigned char header[MR_HEADER], const void *payload, size_t stored, uint64_t offset)
{
	uint32_t said, is = checksum(header, payload, stored);

	memcpy(&said, header + CRC, sizeof said);
	if (said != is)
		return mr_fail(ctx, MR_EFORMAT,
		    "byte %llu: the checksum of %.24s is %08x, not %08x: damaged bytes",
		    (unsigned long long)offset, header + NAME, is, said);
	return MR_OK;
}
