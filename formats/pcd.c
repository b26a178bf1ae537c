/* PCD, the Point Cloud Library's format, in text, binary, and binary packed by LZF (M. Lehmann, liblzf),
 * field by field. */
#include "formats/format.h"

enum { FIELDS = 64, COLUMNS = FIELDS + 6 };

/* Three bytes of LZF stand for 264 at most. */
enum { SWELLS = 88 };

typedef struct field {
	const char *name;
	size_t name_bytes;
	char type; /* I, U or F */
	size_t size, count, offset;
} field;

typedef struct pcd {
	mr_ctx *ctx;
	mr_scan text;
	field field[FIELDS];
	size_t fields, stride; /* stride: of numbers in text, of bytes else */
	uint64_t width, height, points;
	bool has_points, binary, packed;
	const unsigned char *planes; /* of packed ones: the fields, each of all points */
	const field *rgb;            /* four bytes, blue first, in a whole number or in the bits of a float */
	mr_v3 viewpoint;
	mr_rows rows; /* of fields, then of colours, then of the viewpoint */
	double x[COLUMNS];
	size_t surplus; /* rows of text that have numbers of no field */
	size_t clear;   /* points with an alpha other than of none or all */
} pcd;

/* ---- the header ---- */

static mr_status
field_names(pcd *f, mr_scan *line)
{
	const char *w;
	size_t n;

	for (f->fields = 0; mr_scan_word(line, &w, &n); f->fields++) {
		if (f->fields == FIELDS)
			return mr_scan_fail(&f->text, w, "more than %d fields", (int)FIELDS);
		f->field[f->fields] = (field){
			.name = w, .name_bytes = n, .type = 'F', .size = 4, .count = 1
		};
	}
	return MR_OK;
}

/* The value of a line for each field: its SIZE, TYPE or COUNT. */
static mr_status
field_words(pcd *f, mr_scan *line, char what)
{
	const char *w;
	uint64_t n = 0;
	size_t bytes;

	for (field *d = f->field; d < f->field + f->fields; d++) {
		if (what != 'T')
			MR_TRY(mr_scan_count(line, "a field's size or count", 1 << 20, &n));
		else if (!mr_scan_word(line, &w, &bytes) || bytes != 1 || !strchr("IUF", *w))
			return mr_scan_fail(&f->text, line->p, "a field's type is not I, U or F");
		if (what == 'T')
			d->type = *w;
		else
			*(what == 'S' ? &d->size : &d->count) = (size_t)n;
	}
	return MR_OK;
}

static mr_status
data_kind(pcd *f, mr_scan *line)
{
	if (mr_scan_accept(line, "binary"))
		f->binary = true;
	else if (mr_scan_accept(line, "binary_compressed"))
		f->binary = f->packed = true;
	else if (!mr_scan_accept(line, "ascii"))
		return mr_scan_fail(&f->text, line->p, "DATA is none of ascii, binary and binary_compressed");
	return MR_OK;
}

/* ---- columns ---- */

/* PLY's name for a type that holds all values of a field. */
static const char *
type_of(const field *d)
{
	return d->type != 'U' || d->size == 8 ? "double" : d->size == 1 ? "uchar" : "uint";
}

static bool
is_named(const field *d, const char *name)
{
	return mr_word_is(d->name, d->name_bytes, name);
}

/* "_" only fills up. */
static void
add_field(pcd *f, field *d)
{
	bool one = d->count == 1, packed = one && d->size == 4 && (is_named(d, "rgb") || is_named(d, "rgba"));

	if (packed && !f->rgb)
		f->rgb = d;
	if (!one && !is_named(d, "_"))
		mr_tell(f->ctx, MR_LOST, 1, "field %.*s", (int)d->name_bytes, d->name);
	mr_rows_add(&f->rows, one ? mr_role_of(d->name, d->name_bytes) : MR_NO_ROLE, d->name, d->name_bytes,
	    one && !is_named(d, "_") && d != f->rgb ? type_of(d) : NULL);
}

static void
add_columns(pcd *f)
{
	bool seen = f->viewpoint.x != 0 || f->viewpoint.y != 0 || f->viewpoint.z != 0; /* else not known */

	for (size_t i = 0; i < f->fields; i++)
		add_field(f, &f->field[i]);
	mr_rows_add_unnamed(&f->rows, MR_RED, f->rgb ? 3 : 0);
	if (f->rgb)
		f->rows.shades[0].full = 255;
	mr_rows_add_unnamed(&f->rows, MR_FROM_X, seen ? 3 : 0);
	mr_rows_begin(&f->rows);
}

/* Whether the file may hold so many points. */
static bool
can_hold(const pcd *f)
{
	uint64_t left = (uint64_t)(f->text.end - f->text.p) + 1;

	/* NOLINTNEXTLINE(clang-analyzer-core.DivideZero) x, y and z have bytes */
	return f->points <= left * (f->packed ? SWELLS : 1) / (f->binary ? f->stride : 2) + 1;
}

static mr_status
check_header(pcd *f)
{
	for (size_t i = 0; i < f->fields; i++) {
		field *d = &f->field[i];
		if ((d->size != 1 && d->size != 2 && d->size != 4 && d->size != 8) ||
		    (d->type == 'F' && d->size < 4))
			return mr_scan_fail(
			    &f->text, f->text.p, "a field of type %c and %zu bytes", d->type, d->size);
		d->offset = f->stride;
		f->stride += f->binary ? d->size * d->count : d->count;
	}
	add_columns(f);
	if (!f->rows.at[MR_X] || !f->rows.at[MR_Y] || !f->rows.at[MR_Z])
		return mr_scan_fail(&f->text, f->text.p, "the fields lack x, y or z");
	if (!f->has_points)
		f->points = f->width * f->height;
	if (!can_hold(f))
		return mr_scan_fail(&f->text, f->text.p, "%llu points, beyond the end of the file",
		    (unsigned long long)f->points);
	return mr_rows_room(&f->rows, f->points);
}

/* One line of the header; *data: it is the last. */
static mr_status
header_line(pcd *f, mr_scan *line, bool *data)
{
	char shown[MR_SHOWN];
	const char *w;
	size_t n;

	*data = mr_scan_accept(line, "DATA");
	if (*data)
		return data_kind(f, line);
	if (mr_scan_accept(line, "FIELDS") || mr_scan_accept(line, "COLUMNS"))
		return field_names(f, line);
	for (const char *const *k = (const char *const[]){ "SIZE", "TYPE", "COUNT", NULL }; *k; k++)
		if (mr_scan_accept(line, *k))
			return field_words(f, line, **k);
	if (mr_scan_accept(line, "WIDTH"))
		return mr_scan_count(line, "WIDTH", UINT32_MAX, &f->width);
	if (mr_scan_accept(line, "HEIGHT"))
		return mr_scan_count(line, "HEIGHT", UINT32_MAX, &f->height);
	if (mr_scan_accept(line, "VIEWPOINT")) /* and how it is turned */
		return mr_scan_position(line, &f->viewpoint);
	if (mr_scan_accept(line, "POINTS"))
		return f->has_points = true, mr_scan_count(line, "POINTS", UINT64_MAX / 16, &f->points);
	if (mr_scan_accept(line, "VERSION") || !mr_scan_word(line, &w, &n))
		return MR_OK;
	return mr_scan_fail(&f->text, w, "'%s' begins no line of a PCD header", mr_word_shown(w, n, shown));
}

static mr_status
read_header(pcd *f)
{
	mr_scan line;
	bool data = false;

	while (!data && mr_scan_line(&f->text, &line)) {
		mr_skip_blanks(&line);
		if (line.p < line.end && *line.p != '#')
			MR_TRY(header_line(f, &line, &data));
	}
	return data ? check_header(f) : mr_scan_fail(&f->text, f->text.end, "the header has no DATA");
}

/* ---- LZF ---- */

/* Unpacks exactly `size` bytes; false where the packed ones do not give that. */
static bool
unpack(const unsigned char *from, size_t bytes, unsigned char *to, size_t size)
{
	const unsigned char *end = from + bytes;
	size_t at = 0;

	while (from < end) {
		size_t n = *from >> 5, back = (size_t)(*from & 31) << 8;
		if (n == 0) { /* so many bytes as they are, and one more */
			n = (size_t)*from++ + 1;
			if ((size_t)(end - from) < n || size - at < n)
				return false;
			memcpy(to + at, from, n);
			from += n;
			at += n;
			continue;
		}
		from++;
		if (n == 7 && from < end)
			n += *from++;
		if (from == end)
			return false;
		back += (size_t)*from++ + 1;
		n += 2;
		if (back > at || size - at < n)
			return false;
		for (; n > 0; n--, at++) /* the source may be the bytes just written */
			to[at] = to[at - back];
	}
	return at == size;
}

static mr_status
unpack_planes(pcd *f)
{
	const unsigned char *p = (const unsigned char *)f->text.p;
	size_t left = (size_t)(f->text.end - f->text.p), size = (size_t)f->points * f->stride;
	unsigned char *planes;

	if (left < 8 || mr_load32(p, false) > left - 8)
		return mr_scan_fail(&f->text, f->text.p, "the packed points go beyond the end of the file");
	if (mr_load32(p + 4, false) != size)
		return mr_scan_fail(&f->text, f->text.p, "%u bytes are packed, where %llu points take %zu",
		    mr_load32(p + 4, false), (unsigned long long)f->points, size);
	planes = mr_alloc(f->ctx, size, 1);
	if (!unpack(p + 8, mr_load32(p, false), planes, size))
		return mr_scan_fail(&f->text, f->text.p, "the packed points are damaged");
	f->planes = planes;
	return MR_OK;
}

/* ---- points ---- */

static mr_status
read_binary(pcd *f, uint64_t i)
{
	const unsigned char *row = (const unsigned char *)f->text.p;

	if (!f->packed && (size_t)(f->text.end - f->text.p) < f->stride)
		return mr_fail(f->ctx, MR_EFORMAT, "byte %zu: the file ends inside a point",
		    (size_t)(f->text.end - f->text.start));
	for (size_t k = 0; k < f->fields; k++) {
		const field *d = &f->field[k];
		const unsigned char *at = f->packed
		                              ? f->planes + d->offset * f->points + i * d->size * d->count
		                              : row + d->offset;
		f->x[k] = d == f->rgb ? mr_load32(at, false)
		          : d->count  ? mr_load_number(at, d->type, d->size, false)
		                      : 0;
	}
	if (!f->packed)
		f->text.p += f->stride;
	return MR_OK;
}

/* The four bytes of a colour that was written as a number. */
static double
color_bits(double value, const field *d)
{
	float f = (float)value;
	uint32_t bits;

	if (d->type != 'F')
		return value >= -2147483648.0 && value < 4294967296.0 ? (uint32_t)(int64_t)value : 0;
	memcpy(&bits, &f, sizeof bits);
	return isnan(value) ? value : bits;
}

static mr_status
read_text(pcd *f)
{
	mr_scan line;

	do
		if (!mr_scan_line(&f->text, &line))
			return mr_scan_fail(&f->text, f->text.end, "the file ends before its last point");
	while (mr_skip_blanks(&line), line.p == line.end);
	for (size_t i = 0; i < f->fields; i++) {
		for (size_t k = 0; k < f->field[i].count; k++)
			MR_TRY(mr_scan_real(&line, "a number of a point", &f->x[i]));
		if (&f->field[i] == f->rgb)
			f->x[i] = color_bits(f->x[i], f->rgb);
	}
	mr_skip_blanks(&line);
	f->surplus += line.p < line.end;
	return MR_OK;
}

/* The parts of the colour into columns of their own. */
static void
part_color(pcd *f)
{
	double whole = f->x[f->rgb - f->field];
	uint32_t bits = isnan(whole) ? 0 : (uint32_t)whole;

	f->clear += bits >> 24 != 0 && bits >> 24 != 255;
	for (int k = 0; k < 3; k++)
		f->x[f->fields + (size_t)k] = isnan(whole) ? whole : (double)(bits >> (16 - 8 * k) & 255);
}

static mr_status
read_points(pcd *f)
{
	size_t seen = f->rows.at[MR_FROM_X];
	double from[3] = { f->viewpoint.x, f->viewpoint.y, f->viewpoint.z };

	for (uint64_t i = 0; i < f->points; i++) {
		MR_TRY(f->binary ? read_binary(f, i) : read_text(f));
		if (f->rgb)
			part_color(f);
		if (seen)
			memcpy(f->x + seen - 1, from, sizeof from);
		mr_rows_put(&f->rows, f->x);
	}
	return MR_OK;
}

/* Says what stands where no field or no point is. */
static void
say_rest(pcd *f)
{
	mr_lost(f->ctx, NULL, f->surplus, "numbers behind points");
	mr_lost(f->ctx, NULL, f->clear, "alpha");
	if (f->packed)
		f->text.p += 8 + mr_load32((const unsigned char *)f->text.p, false);
	if (!f->binary)
		mr_skip_comments(&f->text);
	mr_scan_rest(&f->text);
	mr_lost(f->ctx, NULL, f->width > 1 && f->height > 1, "the grid of points");
}

mr_status
mr_pcd_read(mr_ctx *ctx, const unsigned char *data, size_t size, mr_model *m)
{
	pcd f = { .ctx = ctx, .text = mr_scan_of(ctx, data, size), .height = 1, .rows.b.ctx = ctx };

	MR_TRY(read_header(&f));
	if (f.packed)
		MR_TRY(unpack_planes(&f));
	MR_TRY(read_points(&f));
	say_rest(&f);
	mr_rows_end(&f.rows);
	return mr_build_finish(&f.rows.b, m);
}
