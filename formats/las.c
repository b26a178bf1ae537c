/*
 * LAS, airborne scans: ASPRS LAS specification 1.4, 2019, and before.  Whole coordinates with a scale and an
 * offset; colours of 16 bits in some of the point formats.  Compressed files (LAZ) are refused.  What else a
 * point has is a property, unless it is 0 for all of them, as it is where a scanner did not tell.
 */
#include "base/text.h"
#include "formats/format.h"

enum { SHORTEST_HEADER = 227, FORMATS = 11 };

/* Per point format, the bytes of a point at least, and where its colour stands (0: none). */
static const struct {
	unsigned char bytes, color;
} formats[FORMATS] = { { 20, 0 }, { 28, 0 }, { 26, 20 }, { 34, 28 }, { 57, 0 }, { 63, 28 }, { 30, 0 },
	{ 36, 30 }, { 38, 30 }, { 59, 0 }, { 67, 30 } };

/* What a point has besides: the types are PLY's, `bits` of the first byte from the lowest.  Formats below 6
 * and the others keep them elsewhere (at; 0: they do not have it). */
static const struct {
	const char *name, *type;
	unsigned char at[2];
	struct {
		unsigned char shift, bits;
	} part[2];
} fields[] = {
	{ "intensity", "ushort", { 12, 12 }, { { 0, 16 }, { 0, 16 } } },
	{ "return_number", "uchar", { 14, 14 }, { { 0, 3 }, { 0, 4 } } },
	{ "number_of_returns", "uchar", { 14, 14 }, { { 3, 3 }, { 4, 4 } } },
	{ "scan_direction", "uchar", { 14, 15 }, { { 6, 1 }, { 6, 1 } } },
	{ "edge_of_flight_line", "uchar", { 14, 15 }, { { 7, 1 }, { 7, 1 } } },
	{ "classification", "uchar", { 15, 16 }, { { 0, 5 }, { 0, 8 } } },
	{ "classification_flags", "uchar", { 15, 15 }, { { 5, 3 }, { 0, 4 } } },
	{ "scanner_channel", "uchar", { 0, 15 }, { { 0, 0 }, { 4, 2 } } },
	{ "scan_angle", "short", { 16, 18 }, { { 0, 8 }, { 0, 16 } } },
	{ "user_data", "uchar", { 17, 17 }, { { 0, 8 }, { 0, 8 } } },
	{ "point_source", "ushort", { 18, 20 }, { { 0, 16 }, { 0, 16 } } },
	{ "gps_time", "double", { 20, 22 }, { { 0, 64 }, { 0, 64 } } },
	{ "near_infrared", "ushort", { 0, 36 }, { { 0, 0 }, { 0, 16 } } },
};

enum { FIELDS = sizeof fields / sizeof *fields };

/* Whether points of the format have it. */
static bool
has_field(unsigned format, size_t i)
{
	if (!strcmp(fields[i].name, "gps_time") && (format == 0 || format == 2))
		return false;
	if (!strcmp(fields[i].name, "near_infrared") && format != 8 && format != 10)
		return false;
	return fields[i].at[format >= 6] > 0;
}

/* The field of the point at d. */
static double
field_of(const unsigned char *d, bool later, size_t i)
{
	unsigned bits = fields[i].part[later].bits, shift = fields[i].part[later].shift, value;

	d += fields[i].at[later];
	if (bits == 64)
		return mr_load_double(d, false);
	value = bits == 16 ? mr_load16(d, false) : (unsigned)*d >> shift & ((1u << bits) - 1);
	if (*fields[i].type == 's') /* the only one with a sign */
		return bits == 16 ? (int16_t)value : (int8_t)value;
	return value;
}

typedef struct las {
	unsigned format;
	size_t offset, record;
	uint64_t points;
	unsigned color;
	mr_v3 scale, origin;
} las;

static bool
has_waveforms(const las *l)
{
	return l->format == 4 || l->format == 5 || l->format >= 9;
}

static mr_v3
three(const unsigned char *p)
{
	return mr_vec(mr_load_double(p, false), mr_load_double(p + 8, false), mr_load_double(p + 16, false));
}

static mr_status
read_header(mr_ctx *ctx, const unsigned char *d, size_t size, las *l)
{
	uint64_t points;
	unsigned format;

	if (size < SHORTEST_HEADER)
		return mr_fail(ctx, MR_EFORMAT, "byte %zu: the file ends in its header", size);
	format = d[104];
	if (format & 0xc0)
		return mr_fail(ctx, MR_EFORMAT,
		    "byte 104: compressed points (LAZ) are not read: PDAL's `pdal translate in.laz out.las` "
		    "or LAStools' las2las unpacks them");
	if (format >= FORMATS)
		return mr_fail(ctx, MR_EFORMAT, "byte 104: point format %u is not known", format);
	*l = (las){ .format = format,
		.offset = mr_load32(d + 96, false),
		.record = mr_load16(d + 105, false),
		.points = mr_load32(d + 107, false),
		.color = formats[format].color,
		.scale = three(d + 131),
		.origin = three(d + 155) };
	points = d[25] >= 4 && size >= 255 ? mr_load64(d + 247, false) : 0;
	if (points && l->points && points != l->points)
		mr_warn(ctx, "%llu points are read, where the count of older versions is %llu",
		    (unsigned long long)points, (unsigned long long)l->points);
	if (points)
		l->points = points;
	if (l->record < formats[format].bytes)
		return mr_fail(ctx, MR_EFORMAT, "byte 105: points of %zu bytes, where format %u has %u",
		    l->record, format, (unsigned)formats[format].bytes);
	if (l->offset < SHORTEST_HEADER || l->offset > size || l->points > (size - l->offset) / l->record)
		return mr_fail(ctx, MR_EFORMAT,
		    "byte 96: %llu points of %zu bytes at %zu, where the file has %zu bytes",
		    (unsigned long long)l->points, l->record, l->offset, size);
	if (!mr_finite(l->scale) || !mr_finite(l->origin))
		return mr_fail(ctx, MR_EFORMAT, "byte 131: scale or offset is not finite");
	if (l->scale.x == 0 || l->scale.y == 0 || l->scale.z == 0)
		return mr_fail(ctx, MR_EFORMAT, "byte 131: the scale is %g, %g, %g, which leaves no shape",
		    l->scale.x, l->scale.y, l->scale.z);
	return MR_OK;
}

/* 16 bits by the specification; many files have 8 in them. */
static unsigned
color_shift(const unsigned char *d, const las *l)
{
	for (uint64_t i = 0; i < l->points; i++)
		for (unsigned k = 0; k < 3; k++)
			if (d[l->offset + i * l->record + l->color + 2 * k + 1])
				return 8;
	return 0;
}

static mr_status
read_field(mr_builder *b, const unsigned char *data, const las *l, size_t i)
{
	size_t number, k = 0;
	double x;

	while (k < l->points && field_of(data + l->offset + k * l->record, l->format >= 6, i) == 0)
		k++;
	if (k == l->points)
		return MR_OK;
	MR_TRY(mr_build_property(b, fields[i].name, fields[i].type, 'v', &number));
	for (k = 0; k < l->points; k++) {
		x = field_of(data + l->offset + k * l->record, l->format >= 6, i);
		MR_TRY(mr_build_value(b, number, k, x));
	}
	return MR_OK;
}

static mr_status
read_fields(mr_ctx *ctx, const unsigned char *data, const las *l, mr_model *m)
{
	mr_builder b = { .ctx = ctx };

	for (size_t i = 0; i < FIELDS; i++)
		if (has_field(l->format, i))
			MR_TRY(read_field(&b, data, l, i));
	if (l->record > formats[l->format].bytes)
		mr_warn(
		    ctx, "%zu bytes more of each point are left out", l->record - formats[l->format].bytes);
	if (has_waveforms(l))
		mr_warn(ctx, "waveforms of the points are left out");
	return mr_build_properties(&b, m);
}

/* Bytes of the file, from one to before another. */
typedef struct extent {
	uint64_t from, to;
} extent;

/* Records in the extent, which ends behind them then, and whose length has `width` bytes; whether one says
 * where on Earth the points are. */
static size_t
count_records(const unsigned char *d, extent *e, uint64_t most, unsigned width, bool *place)
{
	const size_t head = 52 + width;
	uint64_t at = e->from, end = e->to;
	size_t n = 0;

	for (; n < most && at <= end && end - at >= head; n++) {
		uint64_t bytes = width == 8 ? mr_load64(d + at + 20, false) : mr_load16(d + at + 20, false);
		*place |= !memcmp(d + at + 2, "LASF_Projection", 15);
		if (bytes > end - at - head)
			return n + 1;
		at += head + bytes;
	}
	e->to = at;
	return n;
}

/* Variable length records stand before the points and, by version 1.4, behind them. */
typedef struct records {
	size_t count;
	bool place;
	extent behind;
} records;

static records
find_records(const unsigned char *d, size_t size, const las *l)
{
	extent before = { mr_load16(d + 94, false), l->offset };
	records r = { .behind = { size, size } };

	r.count = count_records(d, &before, mr_load32(d + 100, false), 2, &r.place);
	if (d[25] >= 4 && size >= 247 && mr_load64(d + 235, false) <= size) {
		r.behind.from = mr_load64(d + 235, false);
		r.count += count_records(d, &r.behind, mr_load32(d + 243, false), 8, &r.place);
	}
	return r;
}

/* The record of waveforms that the file itself has, since version 1.3; one without a length is all the rest.
 */
static extent
waveforms(const unsigned char *d, size_t size, const las *l)
{
	enum { INSIDE = 2, HEAD = 60 };
	uint64_t from, bytes;

	if (!has_waveforms(l) || d[25] < 3 || size < 235 || !(d[6] & INSIDE))
		return (extent){ size, size };
	from = mr_load64(d + 227, false);
	if (from > size || size - from < HEAD)
		return (extent){ size, size };
	bytes = mr_load64(d + from + 20, false);
	return (extent){ from, bytes && bytes <= size - from - HEAD ? from + HEAD + bytes : size };
}

/* How many bytes there are, unless all are zeros, which fill up. */
static uint64_t
count_bytes(const unsigned char *d, uint64_t from, uint64_t to)
{
	for (uint64_t i = from; i < to; i++)
		if (d[i])
			return to - from;
	return 0;
}

/* Bytes behind the points that belong neither to waveforms nor to `own` records. */
static uint64_t
count_rest(const unsigned char *d, size_t size, const las *l, extent own)
{
	const extent waves = waveforms(d, size, l), a = waves.from < own.from ? waves : own,
		     b = waves.from < own.from ? own : waves;
	uint64_t at = l->offset + l->points * l->record, rest = count_bytes(d, at, a.from);

	at = a.to > at ? a.to : at;
	rest += count_bytes(d, at, b.from);
	at = b.to > at ? b.to : at;
	return rest + count_bytes(d, at, size);
}

/* Says what of the file is no point. */
static mr_status
warn_of_others(mr_ctx *ctx, const unsigned char *d, size_t size, const las *l)
{
	const records r = find_records(d, size, l);
	unsigned long long rest = count_rest(d, size, l, r.behind);

	if (l->points == 0)
		return rest < l->record
		           ? MR_OK
		           : mr_fail(ctx, MR_EFORMAT,
				 "byte 107: the header counts no point, but %llu bytes are there", rest);
	if (r.count)
		mr_warn(ctx, "%zu variable length record%s left out%s", r.count, mr_plural(r.count),
		    r.place ? ", the coordinate system among them" : "");
	if (rest)
		mr_warn(ctx, "%llu bytes behind the last point left out: the header counts %llu points", rest,
		    (unsigned long long)l->points);
	return MR_OK;
}

mr_status
mr_las_read(mr_ctx *ctx, const unsigned char *data, size_t size, mr_model *m)
{
	unsigned char *color = NULL;
	unsigned shift;
	size_t rounded = 0;
	mr_v3 *p;
	las l = { 0 };

	MR_TRY(read_header(ctx, data, size, &l));
	p = MR_NEW(ctx, (size_t)l.points, mr_v3);
	if (!p || (l.color && !(color = mr_alloc(ctx, (size_t)l.points, 4))))
		return MR_EMEM;
	shift = l.color ? color_shift(data, &l) : 0;
	for (size_t i = 0; i < l.points; i++) {
		const unsigned char *d = data + l.offset + i * l.record;
		p[i] = mr_vec(l.scale.x * (int32_t)mr_load32(d, false) + l.origin.x,
		    l.scale.y * (int32_t)mr_load32(d + 4, false) + l.origin.y,
		    l.scale.z * (int32_t)mr_load32(d + 8, false) + l.origin.z);
		if (!mr_finite(p[i]))
			return mr_fail(
			    ctx, MR_EFORMAT, "byte %zu: a coordinate is not finite", l.offset + i * l.record);
		for (unsigned k = 0; color && k < 3; k++) {
			unsigned x = mr_load16(d + l.color + 2 * k, false), lower = shift ? x & 255 : 0;
			color[4 * i + k] = (unsigned char)(x >> shift);
			rounded += lower && lower != x >> 8;
		}
		if (color)
			color[4 * i + 3] = 255;
	}
	*m = (mr_model){ .p = p, .nv = (size_t)l.points, .color = color, .counts = m->counts };
	mr_colors_rounded(ctx, rounded);
	MR_TRY(warn_of_others(ctx, data, size, &l));
	return read_fields(ctx, data, &l, m);
}

bool
mr_las_sniff(const unsigned char *data, size_t size)
{
	return size >= 4 && !memcmp(data, "LASF", 4);
}
