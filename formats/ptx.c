/* PTX, Leica's text of scans: columns, rows, position and axes, a matrix that multiplies points from the left
 * and puts the scanner, then lines x y z intensity [r g b], 0 0 0 where no answer came. */
#include "formats/format.h"

typedef struct ptx {
	mr_ctx *ctx;
	mr_scan text;
	mr_rows rows;
	size_t grids;
} ptx;

typedef struct scan {
	uint64_t points;
	double matrix[16]; /* by rows: x' = x matrix */
} scan;

static mr_status
numbers_of_line(ptx *f, const char *what, size_t least, size_t most, double *x, size_t *count)
{
	mr_scan line;

	if (!mr_scan_line(&f->text, &line))
		return mr_scan_fail(&f->text, f->text.end, "the file ends inside a scan");
	return mr_scan_reals(&line, what, least, most, x, count);
}

static mr_status
exactly(ptx *f, double *x, size_t n)
{
	const char *where = f->text.p;

	MR_TRY(numbers_of_line(f, "a line of the head", n, n, x, &n));
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

/* A row of the columns: place, intensity, colour, the scanner's place. */
static mr_status
read_point(ptx *f, const scan *s)
{
	const char *where = f->text.p;
	const double *m = s->matrix;
	double x[10] = { 0 };
	size_t n = 0;
	mr_v3 p;

	MR_TRY(numbers_of_line(f, "a point", 3, 7, x, &n));
	if (n > 4 && n < 7)
		return mr_scan_fail(&f->text, where, "%zu numbers, where a point has 3, 4 or 7", n);
	if (x[0] == 0 && x[1] == 0 && x[2] == 0)
		x[0] = (double)NAN;
	if (n < 7)
		x[4] = x[5] = x[6] = (double)NAN;
	p = mr_vec(m[0] * x[0] + m[4] * x[1] + m[8] * x[2] + m[12],
	    m[1] * x[0] + m[5] * x[1] + m[9] * x[2] + m[13],
	    m[2] * x[0] + m[6] * x[1] + m[10] * x[2] + m[14]);
	x[0] = p.x, x[1] = p.y, x[2] = p.z;
	memcpy(x + 7, m + 12, 3 * sizeof *m);
	mr_rows_put(&f->rows, x);
	return MR_OK;
}

mr_status
mr_ptx_read(mr_ctx *ctx, const unsigned char *data, size_t size, mr_model *m)
{
	ptx f = { .ctx = ctx, .text = mr_scan_of(ctx, data, size), .rows.b.ctx = ctx, .rows.sparse = true };
	scan s;

	mr_rows_add_unnamed(&f.rows, MR_X, 3);
	mr_rows_add(&f.rows, MR_NO_ROLE, "intensity", strlen("intensity"), "double");
	mr_rows_add_unnamed(&f.rows, MR_RED, 3);
	mr_rows_add_unnamed(&f.rows, MR_FROM_X, 3);
	mr_rows_begin(&f.rows);
	for (mr_skip_space(&f.text); f.text.p < f.text.end; mr_skip_space(&f.text)) {
		MR_TRY(read_head(&f, &s));
		MR_TRY(mr_rows_room(&f.rows, s.points));
		for (uint64_t i = 0; i < s.points; i++)
			MR_TRY(read_point(&f, &s));
	}
	mr_lost(ctx, NULL, f.grids, "grids of scans");
	mr_rows_end(&f.rows);
	return mr_build_finish(&f.rows.b, m);
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
