/*
 * PCD, the Point Cloud Library's format, in text, binary, and binary packed by LZF (M. Lehmann, liblzf),
 * field by field.  A point that is not finite is none, by its documentation, and left out.
 */
#include "formats/format.h"

enum { FIELDS = 64 };

/* Three bytes of LZF stand for 264 at most. */
enum { SWELLS = 88 };

typedef enum role { SKIP, X, Y, Z, NX, NY, NZ, RGB, ROLES } role;

typedef struct field {
	role role;
	char type; /* I, U or F */
	unsigned size, count;
	size_t offset;
	const char *name;
	size_t property; /* its number, from 1; 0: none */
	double value;    /* of the point at hand */
} field;

typedef struct pcd {
	mr_ctx *ctx;
	mr_scan text;
	field field[FIELDS];
	size_t fields, sizes, kinds, counts, stride;
	uint64_t width, height, points;
	bool has_points, binary, packed;
	const unsigned char *planes; /* of packed ones: the fields, each of all points */
	mr_v3 viewpoint;
	bool turned; /* the viewpoint has an orientation */
	mr_builder properties;
	const field *of[ROLES];
	bool alpha;    /* the colour is rgba */
	bool no_color; /* of the point at hand: the text has no number */
	size_t no_colors;
	size_t surplus; /* rows of text that have numbers of no field */
} pcd;

/* ---- the header ---- */

static mr_status
field_names(pcd *f, mr_scan *line)
{
	static const struct {
		const char *name;
		role role;
	} roles[] = { { "x", X }, { "y", Y }, { "z", Z }, { "normal_x", NX }, { "normal_y", NY },
		{ "normal_z", NZ }, { "rgb", RGB }, { "rgba", RGB } };
	const char *w;
	size_t n;

	for (f->fields = 0; mr_scan_word(line, &w, &n); f->fields++) {
		char *name = mr_alloc(f->ctx, n + 1, 1);
		if (f->fields == FIELDS)
			return mr_scan_fail(&f->text, w, "more than %d fields", (int)FIELDS);
		if (!name)
			return MR_EMEM;
		mr_clean_name(name, w, n, false);
		f->field[f->fields] = (field){ .type = 'F', .size = 4, .count = 1, .name = name };
		for (size_t i = 0; i < sizeof roles / sizeof *roles; i++)
			if (strlen(roles[i].name) == n && !memcmp(roles[i].name, w, n))
				f->field[f->fields].role = roles[i].role;
	}
	return MR_OK;
}

static mr_status
field_sizes(pcd *f, mr_scan *line)
{
	uint64_t n;

	for (size_t i = 0; i < f->fields; i++) {
		MR_TRY(mr_scan_count(line, "a field's size", 8, &n));
		if (n != 1 && n != 2 && n != 4 && n != 8)
			return mr_scan_fail(&f->text, line->p, "a field of %u bytes", (unsigned)n);
		f->field[i].size = (unsigned)n;
	}
	return MR_OK;
}

static mr_status
field_types(pcd *f, mr_scan *line)
{
	const char *w;
	size_t n;

	for (size_t i = 0; i < f->fields; i++) {
		if (!mr_scan_word(line, &w, &n) || n != 1 || !strchr("IUF", *w))
			return mr_scan_fail(&f->text, line->p, "a field's type is not I, U or F");
		f->field[i].type = *w;
	}
	return MR_OK;
}

static mr_status
field_counts(pcd *f, mr_scan *line)
{
	uint64_t n;

	for (size_t i = 0; i < f->fields; i++) {
		MR_TRY(mr_scan_count(line, "a field's count", 1 << 20, &n));
		f->field[i].count = (unsigned)n;
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

/* A position and a quaternion, the real part first; files end behind the position, too. */
static mr_status
viewpoint(pcd *f, mr_scan *line)
{
	double q;

	MR_TRY(mr_scan_position(line, &f->viewpoint));
	for (int i = 0; i < 4 && (mr_skip_blanks(line), line->p < line->end); i++) {
		MR_TRY(mr_scan_real(line, "the viewpoint's orientation", &q));
		f->turned |= i > 0 && q != 0;
	}
	return MR_OK;
}

/* What PLY calls the type of a field. */
static const char *
type_of(const field *d)
{
	static const char *const whole[2][3] = { { "char", "short", "int" }, { "uchar", "ushort", "uint" } };

	if (d->type == 'F')
		return d->size == 4 ? "float" : "double";
	return d->size == 8 ? "double" : whole[d->type == 'U'][d->size / 2];
}

/* A field that we do not know is a property, and so is one that cannot be four bytes; "_" is none, but fills
 * up. */
static mr_status
keep_field(pcd *f, field *d)
{
	if (d->role == RGB && d->size != 4)
		d->role = SKIP;
	if (d->role != SKIP || !strcmp(d->name, "_"))
		return MR_OK;
	if (d->count == 1)
		return mr_build_property(&f->properties, d->name, type_of(d), 'v', &d->property);
	mr_tell(f->ctx, MR_LOST, 1, "field %s", d->name);
	return MR_OK;
}

/* Whether the file may hold so many points. */
static bool
can_hold(const pcd *f)
{
	size_t left = (size_t)(f->text.end - f->text.p);

	if (f->packed)
		/* NOLINTNEXTLINE(clang-analyzer-core.DivideZero) x, y and z have bytes */
		return f->points <= (uint64_t)left * SWELLS / f->stride;
	/* NOLINTNEXTLINE(clang-analyzer-core.DivideZero) the same */
	return f->points <= left / (f->binary ? f->stride : 2) + 1;
}

static mr_status
check_header(pcd *f)
{
	size_t offset = 0;

	for (size_t i = 0; i < f->fields; i++) {
		field *d = &f->field[i];
		d->offset = f->binary ? offset : f->stride;
		offset += (size_t)d->size * d->count;
		f->stride += d->count;
		if (d->type == 'F' && d->size < 4)
			return mr_scan_fail(&f->text, f->text.p, "a field of type F and %u bytes", d->size);
		if (d->role != SKIP && (d->count != 1 || f->of[d->role]))
			d->role = SKIP;
		MR_TRY(keep_field(f, d));
		if (d->role != SKIP)
			f->of[d->role] = d;
	}
	if (f->binary)
		f->stride = offset;
	f->alpha = f->of[RGB] && !strcmp(f->of[RGB]->name, "rgba") && f->of[RGB]->type != 'F';
	if (!f->of[X] || !f->of[Y] || !f->of[Z])
		return mr_scan_fail(&f->text, f->text.p, "the fields lack x, y or z");
	if (!f->has_points)
		f->points = f->width * f->height;
	if (!can_hold(f))
		return mr_scan_fail(&f->text, f->text.p, "%llu points, beyond the end of the file",
		    (unsigned long long)f->points);
	return MR_OK;
}

static mr_status
read_header(pcd *f)
{
	char shown[MR_SHOWN];
	mr_scan line;
	const char *w;
	size_t n;

	while (mr_scan_line(&f->text, &line)) {
		mr_skip_blanks(&line);
		if (line.p == line.end || *line.p == '#')
			continue;
		if (mr_scan_accept(&line, "DATA")) {
			MR_TRY(data_kind(f, &line));
			return check_header(f);
		}
		if (mr_scan_accept(&line, "FIELDS") || mr_scan_accept(&line, "COLUMNS"))
			MR_TRY(field_names(f, &line));
		else if (mr_scan_accept(&line, "SIZE"))
			MR_TRY(field_sizes(f, &line));
		else if (mr_scan_accept(&line, "TYPE"))
			MR_TRY(field_types(f, &line));
		else if (mr_scan_accept(&line, "COUNT"))
			MR_TRY(field_counts(f, &line));
		else if (mr_scan_accept(&line, "WIDTH"))
			MR_TRY(mr_scan_count(&line, "WIDTH", UINT32_MAX, &f->width));
		else if (mr_scan_accept(&line, "HEIGHT"))
			MR_TRY(mr_scan_count(&line, "HEIGHT", UINT32_MAX, &f->height));
		else if (mr_scan_accept(&line, "POINTS")) {
			MR_TRY(mr_scan_count(&line, "POINTS", UINT64_MAX / 16, &f->points));
			f->has_points = true;
		} else if (mr_scan_accept(&line, "VIEWPOINT")) {
			MR_TRY(viewpoint(f, &line));
		} else if (!mr_scan_accept(&line, "VERSION")) {
			mr_scan_word(&line, &w, &n);
			return mr_scan_fail(
			    &f->text, w, "'%s' begins no line of a PCD header", mr_word_shown(w, n, shown));
		}
	}
	return mr_scan_fail(&f->text, f->text.end, "the header has no DATA");
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
		for (; n > 0; n--, at++) /* what is copied may be what was just written */
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
	if (!planes)
		return MR_EMEM;
	if (!unpack(p + 8, mr_load32(p, false), planes, size))
		return mr_scan_fail(&f->text, f->text.p, "the packed points are damaged");
	f->planes = planes;
	return MR_OK;
}

/* ---- points ---- */

static double
binary_value(const unsigned char *p, const field *d)
{
	uint64_t u = d->size == 1   ? *p
	             : d->size == 2 ? mr_load16(p, false)
	             : d->size == 4 ? mr_load32(p, false)
	                            : mr_load64(p, false);

	if (d->type == 'F')
		return d->size == 8 ? mr_load_double(p, false) : (double)mr_load_float(p, false);
	if (d->type == 'I' && d->size < 8 && u >> (8 * d->size - 1))
		return (double)u - (double)(UINT64_C(1) << (8 * d->size));
	return d->type == 'I' ? (double)(int64_t)u : (double)u;
}

/* A colour is four bytes, blue first, in a whole number or in the bits of a float. */
static uint32_t
color_bits(double value, const field *d)
{
	float f = (float)value;
	uint32_t bits;

	if (d->type != 'F')
		return value >= -2147483648.0 && value < 4294967296.0 ? (uint32_t)(int64_t)value : 0;
	memcpy(&bits, &f, sizeof bits);
	return bits;
}

/* Where a binary field of point i is; `row` is the point, of a file that is not packed. */
static const unsigned char *
place_of(const pcd *f, const field *d, const unsigned char *row, uint64_t i)
{
	size_t width = (size_t)d->size * d->count;

	return f->packed ? f->planes + d->offset * f->points + i * width : row + d->offset;
}

/* Fields whose numbers are wanted. */
static bool
is_wanted(const pcd *f, const field *d)
{
	return d->property || f->of[d->role] == d;
}

/* The properties of the point that was read. */
static mr_status
take_properties(pcd *f, size_t row)
{
	for (const field *d = f->field; d < f->field + f->fields; d++)
		if (d->property)
			MR_TRY(mr_build_value(&f->properties, d->property, row, d->value));
	return MR_OK;
}

static mr_status
read_binary(pcd *f, uint64_t i, double value[ROLES], uint32_t *rgb)
{
	const unsigned char *p = (const unsigned char *)f->text.p;

	if (!f->packed && (size_t)(f->text.end - f->text.p) < f->stride)
		return mr_fail(f->ctx, MR_EFORMAT, "byte %zu: the file ends inside a point",
		    (size_t)(f->text.end - f->text.start));
	for (size_t k = 0; k < f->fields; k++) {
		field *d = &f->field[k];
		const unsigned char *at = place_of(f, d, p, i);
		if (!is_wanted(f, d))
			continue;
		if (d->role == RGB)
			*rgb = mr_load32(at, false);
		else
			value[d->role] = d->value = binary_value(at, d);
	}
	if (!f->packed)
		f->text.p += f->stride;
	return MR_OK;
}

static mr_status
read_text(pcd *f, double value[ROLES], uint32_t *rgb)
{
	mr_scan line;

	do
		if (!mr_scan_line(&f->text, &line))
			return mr_scan_fail(&f->text, f->text.end, "the file ends before its last point");
	while (mr_skip_blanks(&line), line.p == line.end);
	for (field *d = f->field; d < f->field + f->fields; d++)
		for (unsigned k = 0; k < d->count; k++) {
			double x = 0;
			MR_TRY(mr_scan_real(&line, "a number of a point", &x));
			if (is_wanted(f, d))
				value[d->role] = x;
			d->value = x;
		}
	mr_skip_blanks(&line);
	f->surplus += line.p < line.end;
	if (f->of[RGB]) {
		f->no_color = isnan(value[RGB]);
		*rgb = color_bits(value[RGB], f->of[RGB]);
	}
	return MR_OK;
}

static bool
is_origin(mr_v3 p)
{
	return p.x == 0 && p.y == 0 && p.z == 0;
}

/* The points: as many as are finite. */
static mr_status
read_points(pcd *f, mr_v3 *p, mr_v3 *normal, unsigned char *color, size_t *count)
{
	double v[ROLES] = { 0 };
	uint32_t rgb = 0;
	size_t n = 0;

	for (uint64_t i = 0; i < f->points; i++) {
		MR_TRY(f->binary ? read_binary(f, i, v, &rgb) : read_text(f, v, &rgb));
		p[n] = mr_vec(v[X], v[Y], v[Z]);
		if (!mr_finite(p[n]))
			continue;
		MR_TRY(take_properties(f, n));
		f->no_colors += f->no_color;
		if (normal)
			normal[n] = mr_vec(v[NX], v[NY], v[NZ]);
		if (color) {
			unsigned char c[4] = { (unsigned char)(rgb >> 16), (unsigned char)(rgb >> 8),
				(unsigned char)rgb, f->alpha ? (unsigned char)(rgb >> 24) : 255 };
			memcpy(color + 4 * n, c, 4);
		}
		n++;
	}
	*count = n;
	return MR_OK;
}

/* Says what stands where no field or no point is. */
static void
warn_of_rest(pcd *f)
{
	const unsigned char *p = (const unsigned char *)f->text.p;

	mr_lost(f->ctx, NULL, f->surplus, "numbers behind points");
	if (f->packed)
		f->text.p += 8 + mr_load32(p, false);
	if (!f->binary)
		mr_skip_comments(&f->text);
	mr_scan_rest(&f->text);
}

/* Where no point can be seen, alpha was not told. */
static void
mend_alpha(unsigned char *color, size_t n)
{
	for (size_t i = 0; i < n; i++)
		if (color[4 * i + 3])
			return;
	for (size_t i = 0; i < n; i++)
		color[4 * i + 3] = 255;
}

mr_status
mr_pcd_read(mr_ctx *ctx, const unsigned char *data, size_t size, mr_model *m)
{
	pcd f = {
		.ctx = ctx, .text = mr_scan_of(ctx, data, size), .height = 1, .properties = { .ctx = ctx }
	};
	mr_v3 *p, *normal = NULL;
	unsigned char *color = NULL;
	size_t n;

	MR_TRY(read_header(&f));
	if (f.packed)
		MR_TRY(unpack_planes(&f));
	p = MR_NEW(ctx, (size_t)f.points, mr_v3);
	if (!p || (f.of[NX] && f.of[NY] && f.of[NZ] && !(normal = MR_NEW(ctx, (size_t)f.points, mr_v3))) ||
	    (f.of[RGB] && !(color = mr_alloc(ctx, (size_t)f.points, 4))))
		return MR_EMEM;
	MR_TRY(read_points(&f, p, normal, color, &n));
	warn_of_rest(&f);
	if (color && !mr_all_left(ctx, f.no_colors, n, "colors"))
		color = NULL;
	if (color)
		mend_alpha(color, n);
	if (normal && !mr_normals_left(ctx, normal, n))
		normal = NULL;
	*m = (mr_model){ .p = p, .nv = n, .normal = normal, .color = color };
	mr_lost(ctx, NULL, f.width > 1 && f.height > 1, "the grid of points");
	mr_lost(ctx, NULL, f.turned, "the viewpoint's orientation");
	/* the origin is what stands there where none is known */
	if (!is_origin(f.viewpoint))
		MR_TRY(mr_scanned_from(ctx, f.viewpoint, m));
	return mr_build_properties(&f.properties, m);
}

bool
mr_pcd_sniff(const unsigned char *data, size_t size)
{
	mr_scan text = mr_scan_of(NULL, data, size), line;

	if (mr_scan_accept(&text, "VERSION") || mr_scan_accept(&text, "FIELDS"))
		return true;
	return mr_scan_line(&text, &line) && mr_scan_accept(&line, "#") && mr_scan_accept(&line, ".PCD");
}
