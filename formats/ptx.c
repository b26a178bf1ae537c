/*
 * PTX, Leica's text of scans: columns, rows, the scanner's position and axes (seven lines), a matrix of four
 * rows, by which each point is multiplied from the left, then columns x rows lines x y z intensity [r g b].
 * The scanner is where its own origin comes to lie.  A ray without an answer is 0 0 0, and left out.
 */
#include "base/text.h"
#include "formats/format.h"

typedef struct ptx {
	mr_ctx *ctx;
	mr_scan text;
	mr_v3 *p, *scanner;
	float *rgb; /* of each point, NAN of one without; NULL: no point has any */
	mr_shades shades;
	mr_builder properties;
	size_t intensity; /* the number of that property */
	size_t count, room, scanner_room, rgb_room;
	size_t colored, odd_colors, grids;
} ptx;

typedef struct scan {
	uint64_t points;
	double matrix[16]; /* by rows: x' = x matrix */
} scan;

static mr_status
numbers_of_line(ptx *f, double *x, size_t most, size_t *count)
{
	mr_scan line;
	size_t n = 0;

	if (!mr_scan_line(&f->text, &line))
		return mr_scan_fail(&f->text, f->text.end, "the file ends inside a scan");
	for (mr_skip_blanks(&line); line.p < line.end; mr_skip_blanks(&line)) {
		if (n == most)
			return mr_scan_fail(&f->text, line.p, "more than %zu numbers", most);
		MR_TRY(mr_scan_real(&line, "a number", &x[n++]));
	}
	*count = n;
	return MR_OK;
}

static mr_status
exactly(ptx *f, double *x, size_t wanted)
{
	const char *where = f->text.p;
	size_t n = 0;

	MR_TRY(numbers_of_line(f, x, wanted, &n));
	if (n < wanted)
		return mr_scan_fail(&f->text, where, "%zu numbers, not %zu", n, wanted);
	for (size_t i = 0; i < n; i++)
		if (!isfinite(x[i]))
			return mr_scan_fail(&f->text, where, "a number is not finite");
	return MR_OK;
}

static mr_status
read_head(ptx *f, scan *s)
{
	const char *where = f->text.p;
	uint64_t columns, rows;
	double skipped[3];

	MR_TRY(mr_scan_count(&f->text, "the number of columns", UINT32_MAX, &columns));
	MR_TRY(mr_scan_count(&f->text, "the number of rows", UINT32_MAX, &rows));
	mr_skip_blanks(&f->text);
	if (f->text.p < f->text.end)
		f->text.p++;
	for (int i = 0; i < 4; i++)
		MR_TRY(exactly(f, skipped, 3));
	for (int i = 0; i < 4; i++)
		MR_TRY(exactly(f, s->matrix + 4 * i, 4));
	s->points = columns * rows; /* below 2^64 */
	f->grids += columns > 1 && rows > 1;
	if (s->points > (size_t)(f->text.end - f->text.p) / 8 + 1)
		return mr_scan_fail(&f->text, where, "%llu x %llu points, beyond the end of the file",
		    (unsigned long long)columns, (unsigned long long)rows);
	return MR_OK;
}

static mr_status
make_room(ptx *f, size_t more)
{
	MR_TRY(MR_RESERVE(f->ctx, f->p, f->count, more, &f->room));
	return MR_RESERVE(f->ctx, f->scanner, f->count, more, &f->scanner_room);
}

/* Of the next point; those before the first that has a colour are without. */
static mr_status
keep_color(ptx *f, const double *rgb)
{
	const size_t at = 3 * f->count, kept = f->rgb ? at : 0;
	bool odd = false;

	MR_TRY(MR_RESERVE(f->ctx, f->rgb, kept, at - kept + 3, &f->rgb_room));
	for (size_t i = kept; i < at; i++)
		f->rgb[i] = NAN;
	for (size_t k = 0; k < 3; k++) {
		odd |= isnan(rgb[k]);
		mr_shade_see(&f->shades, rgb[k]);
		f->rgb[at + k] = (float)rgb[k];
	}
	f->colored++;
	f->odd_colors += odd;
	return MR_OK;
}

/* The next point has none. */
static mr_status
keep_no_color(ptx *f)
{
	if (!f->rgb)
		return MR_OK;
	MR_TRY(MR_RESERVE(f->ctx, f->rgb, 3 * f->count, 3, &f->rgb_room));
	f->rgb[3 * f->count] = NAN;
	return MR_OK;
}

static mr_status
read_point(ptx *f, const scan *s)
{
	const char *where = f->text.p;
	const double *m = s->matrix;
	double x[7] = { 0 };
	size_t n = 0;

	MR_TRY(numbers_of_line(f, x, 7, &n));
	if (n != 3 && n != 4 && n != 7)
		return mr_scan_fail(&f->text, where, "%zu numbers, where a point has 3, 4 or 7", n);
	if (x[0] == 0 && x[1] == 0 && x[2] == 0)
		return MR_OK;
	f->p[f->count] = mr_vec(m[0] * x[0] + m[4] * x[1] + m[8] * x[2] + m[12],
	    m[1] * x[0] + m[5] * x[1] + m[9] * x[2] + m[13],
	    m[2] * x[0] + m[6] * x[1] + m[10] * x[2] + m[14]);
	if (!mr_finite(f->p[f->count]))
		return mr_scan_fail(&f->text, where, "a coordinate is not finite");
	MR_TRY(n == 7 ? keep_color(f, x + 4) : keep_no_color(f));
	f->scanner[f->count] = mr_vec(m[12], m[13], m[14]);
	MR_TRY(mr_build_value(&f->properties, f->intensity, f->count, n > 3 ? x[3] : 0));
	f->count++;
	return MR_OK;
}

/* Where some points have colours, those without are white. */
static mr_status
read_colors(ptx *f, mr_model *m)
{
	unsigned char *color;

	if (!f->rgb || !mr_all_left(f->ctx, f->odd_colors, f->colored, "colors"))
		return MR_OK;
	color = mr_alloc(f->ctx, f->count, 4);
	if (!color)
		return MR_EMEM;
	memset(color, 255, 4 * f->count);
	f->shades.full = mr_shade_full(&f->shades);
	for (size_t i = 0; i < f->count; i++)
		for (size_t k = 0; k < 3 && !isnan(f->rgb[3 * i]); k++)
			color[4 * i + k] = mr_shade_byte(&f->shades, (double)f->rgb[3 * i + k]);
	mr_shades_said(f->ctx, &f->shades);
	m->color = color;
	return MR_OK;
}

mr_status
mr_ptx_read(mr_ctx *ctx, const unsigned char *data, size_t size, mr_model *m)
{
	ptx f = { .ctx = ctx, .text = mr_scan_of(ctx, data, size), .properties = { .ctx = ctx } };
	scan s;

	MR_TRY(mr_build_property(&f.properties, "intensity", "double", 'v', &f.intensity));
	for (mr_skip_space(&f.text); f.text.p < f.text.end; mr_skip_space(&f.text)) {
		MR_TRY(read_head(&f, &s));
		MR_TRY(make_room(&f, (size_t)s.points));
		for (uint64_t i = 0; i < s.points; i++)
			MR_TRY(read_point(&f, &s));
	}
	mr_lost(ctx, NULL, f.grids, "grids of scans");
	*m = (mr_model){ .p = f.p, .nv = f.count, .scanner = f.scanner };
	MR_TRY(read_colors(&f, m));
	return mr_build_properties(&f.properties, m);
}

/* How many numbers the line has; 0 where it has anything else. */
static size_t
count_numbers(mr_scan *text)
{
	mr_scan line;
	size_t n = 0;
	double x;

	if (!mr_scan_line(text, &line))
		return 0;
	for (mr_skip_blanks(&line); line.p < line.end; mr_skip_blanks(&line), n++)
		if (!(line.p = mr_real_read(line.p, line.end, &x)))
			return 0;
	return n;
}

bool
mr_ptx_sniff(const unsigned char *data, size_t size)
{
	static const size_t expected[] = { 1, 1, 3, 3, 3, 3, 4, 4, 4, 4 };
	mr_scan text = mr_scan_of(NULL, data, size);

	for (size_t i = 0; i < sizeof expected / sizeof *expected; i++)
		if (count_numbers(&text) != expected[i])
			return false;
	return true;
}
