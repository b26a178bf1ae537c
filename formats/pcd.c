/* PCD, the Point Cloud Library's format, in text and plain binary.  A point that is not finite is none, by
 * its documentation, and left out. */
#include "formats/format.h"

enum { FIELDS = 64 };

typedef enum role { SKIP, X, Y, Z, NX, NY, NZ, RGB, ROLES } role;

typedef struct field {
	role role;
	char type; /* I, U or F */
	unsigned size, count;
	size_t offset;
} field;

typedef struct pcd {
	mr_ctx *ctx;
	mr_scan text;
	field field[FIELDS];
	size_t fields, sizes, kinds, counts, stride;
	uint64_t width, height, points;
	bool has_points, binary;
	const field *of[ROLES];
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
		if (f->fields == FIELDS)
			return mr_scan_fail(&f->text, w, "more than %d fields", (int)FIELDS);
		f->field[f->fields] = (field){ .type = 'F', .size = 4, .count = 1 };
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
		return mr_scan_fail(&f->text, line->p, "compressed PCD is not read");
	else if (!mr_scan_accept(line, "ascii"))
		return mr_scan_fail(&f->text, line->p, "DATA is neither ascii nor binary");
	return MR_OK;
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
		if (d->role == SKIP || d->count != 1 || f->of[d->role])
			continue;
		if (d->type == 'F' && d->size < 4)
			return mr_scan_fail(&f->text, f->text.p, "a field of type F and %u bytes", d->size);
		f->of[d->role] = d;
	}
	if (f->binary)
		f->stride = offset;
	if (!f->of[X] || !f->of[Y] || !f->of[Z])
		return mr_scan_fail(&f->text, f->text.p, "the fields lack x, y or z");
	if (!f->has_points)
		f->points = f->width * f->height;
	if (f->points > (size_t)(f->text.end - f->text.p) / (f->binary ? f->stride : 2) + 1)
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
		} else if (!mr_scan_accept(&line, "VERSION") && !mr_scan_accept(&line, "VIEWPOINT")) {
			mr_scan_word(&line, &w, &n);
			return mr_scan_fail(
			    &f->text, w, "'%s' begins no line of a PCD header", mr_word_shown(w, n, shown));
		}
	}
	return mr_scan_fail(&f->text, f->text.end, "the header has no DATA");
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
		return value >= 0 && value < 4294967296.0 ? (uint32_t)value : 0;
	memcpy(&bits, &f, sizeof bits);
	return bits;
}

static mr_status
read_row(pcd *f, double value[ROLES], uint32_t *rgb)
{
	size_t column = 0;
	mr_scan line;

	if (f->binary) {
		const unsigned char *p = (const unsigned char *)f->text.p;
		if ((size_t)(f->text.end - f->text.p) < f->stride)
			return mr_fail(f->ctx, MR_EFORMAT, "byte %zu: the file ends inside a point",
			    (size_t)(f->text.end - f->text.start));
		for (int r = X; r < ROLES; r++)
			if (f->of[r] && r != RGB)
				value[r] = binary_value(p + f->of[r]->offset, f->of[r]);
		if (f->of[RGB])
			*rgb = f->of[RGB]->size == 4 ? mr_load32(p + f->of[RGB]->offset, false) : 0;
		f->text.p += f->stride;
		return MR_OK;
	}
	do
		if (!mr_scan_line(&f->text, &line))
			return mr_scan_fail(&f->text, f->text.end, "the file ends before its last point");
	while (mr_skip_blanks(&line), line.p == line.end);
	for (size_t i = 0; i < f->fields; i++)
		for (unsigned k = 0; k < f->field[i].count; k++, column++) {
			double x = 0;
			MR_TRY(mr_scan_real(&line, "a number of a point", &x));
			if (f->of[f->field[i].role] == &f->field[i])
				value[f->field[i].role] = x;
		}
	if (f->of[RGB])
		*rgb = color_bits(value[RGB], f->of[RGB]);
	return MR_OK;
}

mr_status
mr_pcd_read(mr_ctx *ctx, const unsigned char *data, size_t size, mr_model *m)
{
	pcd f = { .ctx = ctx, .text = mr_scan_of(ctx, data, size), .height = 1 };
	mr_v3 *p, *normal = NULL;
	unsigned char *color = NULL;
	double v[ROLES] = { 0 };
	bool odd = false;
	uint32_t rgb = 0;
	size_t n = 0;

	MR_TRY(read_header(&f));
	p = MR_NEW(ctx, (size_t)f.points, mr_v3);
	if (!p || (f.of[NX] && f.of[NY] && f.of[NZ] && !(normal = MR_NEW(ctx, (size_t)f.points, mr_v3))) ||
	    (f.of[RGB] && !(color = mr_alloc(ctx, (size_t)f.points, 4))))
		return MR_EMEM;
	for (uint64_t i = 0; i < f.points; i++) {
		MR_TRY(read_row(&f, v, &rgb));
		p[n] = mr_vec(v[X], v[Y], v[Z]);
		if (!mr_finite(p[n]))
			continue;
		if (normal) {
			normal[n] = mr_vec(v[NX], v[NY], v[NZ]);
			odd |= !mr_finite(normal[n]);
		}
		if (color) {
			unsigned char c[4] = { (unsigned char)(rgb >> 16), (unsigned char)(rgb >> 8),
				(unsigned char)rgb, 255 };
			memcpy(color + 4 * n, c, 4);
		}
		n++;
	}
	if (n < f.points)
		mr_note(ctx, "%llu points that are not finite left out", (unsigned long long)f.points - n);
	m->counts.points_left_out = (size_t)f.points - n;
	if (odd)
		mr_dropped(ctx, &m->counts.dropped_normals, "normals", "one is not a finite number");
	*m = (mr_model){
		.p = p, .nv = n, .normal = odd ? NULL : normal, .color = color, .counts = m->counts
	};
	return MR_OK;
}

bool
mr_pcd_sniff(const unsigned char *data, size_t size)
{
	mr_scan text = mr_scan_of(NULL, data, size), line;

	if (mr_scan_accept(&text, "VERSION"))
		return true;
	return mr_scan_line(&text, &line) && mr_scan_accept(&line, "#") && mr_scan_accept(&line, ".PCD");
}
