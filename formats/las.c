/* LAS (ASPRS, LAS specification 1.4, 2019, and before): whole coordinates with scale and offset, 16-bit
 * colours; not LAZ.  Other fields of points become properties, unless they are 0 for all. */
#include "formats/format.h"

enum { SHORTEST_HEADER = 227, FORMATS = 11 };

/* Per point format, the bytes of a point at least, and where its colour stands (0: none). */
static const struct {
	unsigned char bytes, color;
} formats[FORMATS] = { { 20, 0 }, { 28, 0 }, { 26, 20 }, { 34, 28 }, { 57, 0 }, { 63, 28 }, { 30, 0 },
	{ 36, 30 }, { 38, 30 }, { 59, 0 }, { 67, 30 } };

/* The other fields of a point: the types are PLY's, `bits` of the first byte from the lowest.  Formats below
 * 6 and the others keep them elsewhere.  in: a bit for each format that has them. */
static const struct {
	const char *name, *type;
	unsigned in;
	unsigned char at[2];
	struct {
		unsigned char shift, bits;
	} part[2];
} fields[] = {
	{ "intensity", "ushort", 0x7ff, { 12, 12 }, { { 0, 16 }, { 0, 16 } } },
	{ "return_number", "uchar", 0x7ff, { 14, 14 }, { { 0, 3 }, { 0, 4 } } },
	{ "number_of_returns", "uchar", 0x7ff, { 14, 14 }, { { 3, 3 }, { 4, 4 } } },
	{ "scan_direction", "uchar", 0x7ff, { 14, 15 }, { { 6, 1 }, { 6, 1 } } },
	{ "edge_of_flight_line", "uchar", 0x7ff, { 14, 15 }, { { 7, 1 }, { 7, 1 } } },
	{ "classification", "uchar", 0x7ff, { 15, 16 }, { { 0, 5 }, { 0, 8 } } },
	{ "classification_flags", "uchar", 0x7ff, { 15, 15 }, { { 5, 3 }, { 0, 4 } } },
	{ "scanner_channel", "uchar", 0x7c0, { 0, 15 }, { { 0, 0 }, { 4, 2 } } },
	{ "scan_angle", "short", 0x7ff, { 16, 18 }, { { 0, 8 }, { 0, 16 } } },
	{ "user_data", "uchar", 0x7ff, { 17, 17 }, { { 0, 8 }, { 0, 8 } } },
	{ "point_source", "ushort", 0x7ff, { 18, 20 }, { { 0, 16 }, { 0, 16 } } },
	{ "gps_time", "double", 0x7fa, { 20, 22 }, { { 0, 64 }, { 0, 64 } } },
	{ "near_infrared", "ushort", 0x500, { 0, 36 }, { { 0, 0 }, { 0, 16 } } },
};

enum { FIELDS = sizeof fields / sizeof *fields };

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
	if (points)
		l->points = points;
	if (l->record < formats[format].bytes)
		return mr_fail(ctx, MR_EFORMAT, "byte 105: points of %zu bytes, where format %u has %u",
		    l->record, format, (unsigned)formats[format].bytes);
	if (l->offset < SHORTEST_HEADER || l->offset > size || l->points > (size - l->offset) / l->record)
		return mr_fail(ctx, MR_EFORMAT,
		    "byte 96: %llu points of %zu bytes at %zu, where the file has %zu bytes",
		    (unsigned long long)l->points, l->record, l->offset, size);
	if (l->points == 0 && size - l->offset >= l->record)
		return mr_fail(ctx, MR_EFORMAT,
		    "byte 107: the header counts no point, but %zu bytes are there", size - l->offset);
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

/* Whether the field is not 0 for all points, and so becomes a property. */
static bool
is_told(const unsigned char *data, const las *l, size_t i)
{
	uint64_t k = 0;

	while (k < l->points && field_of(data + l->offset + k * l->record, l->format >= 6, i) == 0)
		k++;
	return k < l->points;
}

/* Columns of place and colour, then of the fields that are not 0. */
static mr_status
add_columns(const unsigned char *data, const las *l, mr_rows *r, bool told[FIELDS])
{
	mr_rows_add_unnamed(r, MR_X, 3);
	mr_rows_add_unnamed(r, MR_RED, l->color ? 3 : 0);
	for (size_t i = 0; i < FIELDS; i++) {
		told[i] = (fields[i].in >> l->format & 1) && is_told(data, l, i);
		if (told[i])
			mr_rows_add(r, MR_NO_ROLE, fields[i].name, strlen(fields[i].name), fields[i].type);
	}
	r->shades[0].full = 255;
	mr_rows_begin(r);
	return mr_rows_room(r, l->points);
}

static mr_status
read_points(mr_ctx *ctx, const unsigned char *data, const las *l, mr_rows *r)
{
	unsigned shift = l->color ? color_shift(data, l) : 0;
	size_t rounded = 0;
	bool told[FIELDS];

	MR_TRY(add_columns(data, l, r, told));
	for (const unsigned char *d = data + l->offset; r->n < l->points; d += l->record) {
		double x[6 + FIELDS];
		size_t n = 3;
		x[0] = l->scale.x * (int32_t)mr_load32(d, false) + l->origin.x;
		x[1] = l->scale.y * (int32_t)mr_load32(d + 4, false) + l->origin.y;
		x[2] = l->scale.z * (int32_t)mr_load32(d + 8, false) + l->origin.z;
		for (size_t k = 0; l->color && k < 3; k++) {
			unsigned c = mr_load16(d + l->color + 2 * k, false), lower = shift ? c & 255 : 0;
			x[n++] = c >> shift;
			rounded += lower && lower != c >> 8;
		}
		for (size_t i = 0; i < FIELDS; i++)
			if (told[i])
				x[n++] = field_of(d, l->format >= 6, i);
		mr_rows_put(r, x);
	}
	mr_tell(ctx, MR_ROUNDED, rounded, "values of colors");
	return MR_OK;
}

mr_status
mr_las_read(mr_ctx *ctx, const unsigned char *data, size_t size, mr_model *m)
{
	mr_rows r = { .b.ctx = ctx };
	las l = { 0 };

	MR_TRY(read_header(ctx, data, size, &l));
	MR_TRY(read_points(ctx, data, &l, &r));
	mr_lost(ctx, NULL, l.record - formats[l.format].bytes, "more bytes of each point");
	mr_rows_end(&r);
	return mr_build_finish(&r.b, m);
}
