/* Points in columns: XYZ, PTS, PWN, and tables with a line of names.  man/mr-formats.5 says how columns
 * without names are recognised.  A first line with one whole number counts the points. */
#include "formats/format.h"

enum { COLUMNS = 64 };

/* Statistics of a column's values. */
typedef struct column {
	mr_role role;
	const char *name; /* in the file */
	size_t name_bytes;
	mr_shades seen;
	bool negative; /* has a value that is */
} column;

typedef struct table {
	mr_ctx *ctx;
	mr_scan text;
	bool named;      /* a line of names gave the roles */
	bool in_comment; /* and was a comment: it may speak of something else */
	bool counted;
	char separator;
	uint64_t count; /* as the file claims */
	size_t columns, rows;
	double *value; /* of all rows */
	size_t room;
	column column[COLUMNS];
	size_t units[2], others[2]; /* rows of columns 3 to 5, 6 to 8 of length 1, of neither 0 nor 1 */
	double lean; /* of seven columns: how much nearer the last is to its neighbour than the fourth */
	const char *first_row; /* for sentences */
	mr_rows points;
} table;

/* The separator of a line's cells: the first character of s that the line has, else a blank. */
static char
separator_of(const mr_scan *line, const char *s)
{
	size_t n = (size_t)(line->end - line->p);

	for (; *s; s++)
		if (memchr(line->p, *s, n))
			return *s;
	return ' ';
}

/* The end of the cell at hand. */
static const char *
cell_end(const mr_scan *line, char separator)
{
	const char *e = line->p;

	while (e < line->end && (separator == ' ' ? !mr_is_blank(*e) : *e != separator))
		e++;
	return e;
}

static bool
is_comment(const mr_scan *line)
{
	return line->p == line->end || *line->p == '#' || *line->p == '%' || *line->p == '!' ||
	       (line->end - line->p >= 2 && line->p[0] == '/' && line->p[1] == '/');
}

/* The next line that says something, without blanks around it. */
static bool
next_row(mr_scan *text, mr_scan *line)
{
	while (mr_scan_line(text, line)) {
		mr_skip_blanks(line);
		while (line->end > line->p && mr_is_blank(line->end[-1]))
			line->end--;
		if (!is_comment(line))
			return true;
	}
	return false;
}

/* ---- the lines before the rows ---- */

/* Reads names with or without quotes; the number of columns, or 0 where x, y and z are not all there. */
static size_t
names(mr_scan line, column c[COLUMNS])
{
	const char separator = separator_of(&line, ";,\t");
	bool there[MR_ROLES] = { false };
	size_t n = 0;

	for (mr_skip_blanks(&line); line.p < line.end && n < COLUMNS; n++) {
		bool quoted = *line.p == '"';
		const char *w = line.p += quoted, *e = quoted ? memchr(w, '"', (size_t)(line.end - w)) : w;
		if (!e)
			return 0;
		line.p = e;
		line.p = cell_end(&line, separator);
		for (e = quoted ? e : line.p; e > w && mr_is_blank(e[-1]);)
			e--;
		c[n] = (column){
			.role = mr_role_of(w, (size_t)(e - w)), .name = w, .name_bytes = (size_t)(e - w)
		};
		if (c[n].role > MR_ALPHA)
			c[n].role = MR_NO_ROLE;
		there[c[n].role] = true;
		line.p += line.p < line.end;
		mr_skip_blanks(&line);
	}
	return there[MR_X] && there[MR_Y] && there[MR_Z] ? n : 0;
}

static bool
is_one_count(mr_scan line, uint64_t *n)
{
	uint64_t value = 0;
	const char *p = line.p;

	while (line.p < line.end && mr_is_digit(*line.p) && value < UINT64_MAX / 16)
		value = 10 * value + (uint64_t)(*line.p++ - '0');
	if (line.p == p)
		return false;
	mr_skip_blanks(&line);
	if (line.p < line.end)
		return false;
	*n = value;
	return true;
}

/* Comments, of which one may name the columns, names, a count, in any order.  A comment of the writer means
 * that a value of 1 is a dark byte, not full intensity. */
static void
read_head(table *t)
{
	mr_scan ahead = t->text, line;

	for (; mr_scan_line(&ahead, &line); t->text.p = ahead.p) {
		bool comment;
		mr_skip_blanks(&line);
		comment = is_comment(&line);
		while (comment && line.p < line.end && (*line.p == '#' || *line.p == '/'))
			line.p++;
		if (!comment && !t->counted && is_one_count(line, &t->count))
			t->counted = true;
		else if (!t->named && (t->columns = names(line, t->column)) > 0)
			t->named = true, t->in_comment = comment;
		else if (!comment)
			break;
	}
}

/* ---- rows ---- */

/* Reads a number, a word such as nan, or an empty cell, which is none, and moves past the separator; false
 * for anything else. */
static bool
next_number(mr_scan *line, char separator, double *x)
{
	const char *e = mr_real_read(line->p, line->end, x), *end;

	if (!e || (e < line->end && *e != separator && !mr_is_blank(*e))) {
		for (e = end = cell_end(line, separator); e > line->p && mr_is_blank(e[-1]);)
			e--;
		if (e > line->p && !mr_word_not_finite(line->p, (size_t)(e - line->p), x))
			return false;
		*x = e > line->p ? *x : (double)NAN;
		e = end;
	}
	while (e < line->end && mr_is_blank(*e))
		e++;
	if (e < line->end && separator != ' ' && *e++ != separator)
		return false;
	line->p = e;
	mr_skip_blanks(line);
	return true;
}

/* The numbers of a row. */
static mr_status
row_values(const table *t, mr_scan *line, double x[COLUMNS], size_t *count)
{
	const char *comment = memchr(line->p, '#', (size_t)(line->end - line->p));
	char shown[MR_SHOWN];
	size_t n = 0, bytes;

	line->end = comment && comment[-1] != '.' ? comment : line->end; /* 1.#INF is no 1 */
	for (; line->p < line->end; n++) {
		if (n == COLUMNS)
			return mr_scan_fail(&t->text, line->p, "more than %d columns", (int)COLUMNS);
		if (next_number(line, t->separator, &x[n]))
			continue;
		bytes = (size_t)(cell_end(line, t->separator) - line->p);
		return mr_scan_fail(&t->text, line->p, "column %zu is '%s', not a number", n + 1,
		    mr_word_shown(line->p, bytes, shown));
	}
	if (n + 1 == t->columns && t->separator != ' ' && line->end[-1] == t->separator)
		x[n++] = (double)NAN; /* an empty cell is the last */
	*count = n;
	return MR_OK;
}

/* The types of columns by the first row. */
static mr_status
begin_rows(table *t, const mr_scan *row, size_t n)
{
	t->first_row = row->p;
	if (n < 3)
		return mr_scan_fail(&t->text, row->p, "%zu columns, where a point has 3 at least", n);
	t->named &= !t->in_comment || n == t->columns;
	if (t->named && n != t->columns)
		return mr_scan_fail(&t->text, row->p, "%zu columns, where %zu are named", n, t->columns);
	t->columns = n;
	return MR_OK;
}

/* Looks at all rows: how many, of how many columns, and which could be colours. */
static mr_status
survey(table *t)
{
	mr_scan text = t->text, line;
	size_t n = 0;

	while (next_row(&text, &line)) {
		const mr_scan row = line;
		double *x;
		MR_RESERVE(t->ctx, t->value, t->rows * t->columns, COLUMNS, &t->room);
		x = t->value + t->rows * t->columns;
		if (t->rows == 0)
			t->separator = separator_of(&line, ";,"); /* tabs between numbers are blanks */
		MR_TRY(row_values(t, &line, x, &n));
		if (t->rows == 0)
			MR_TRY(begin_rows(t, &row, n));
		if (n == 1 && t->counted && x[0] >= 0 && x[0] < MR_NONE) { /* a scan more */
			t->count += (uint64_t)x[0];
			continue;
		}
		if (n != t->columns)
			return mr_scan_fail(&t->text, row.p, "%zu columns, where line %zu has %zu", n,
			    mr_line_number(&t->text, t->first_row), t->columns);
		for (size_t i = 0; i < n; i++) {
			mr_shade_see(&t->column[i].seen, x[i]);
			t->column[i].negative |= x[i] < 0;
		}
		for (size_t k = 0; k < 2 && 6 + 3 * k <= n; k++) {
			mr_v3 v = mr_vec(x[3 + 3 * k], x[4 + 3 * k], x[5 + 3 * k]);
			bool unit = mr_has_unit_length(v);
			t->units[k] += unit;
			t->others[k] += !unit && mr_norm2(v) > 0;
		}
		if (n == 7 && mr_finite(mr_vec(x[4] - x[3], x[6] - x[5], 0)))
			t->lean += fabs(x[4] - x[3]) - fabs(x[6] - x[5]);
		t->rows++;
	}
	if (t->counted && t->rows < t->count)
		return mr_scan_fail(&t->text, t->text.end, "the file ends after %zu of %llu points", t->rows,
		    (unsigned long long)t->count);
	return MR_OK;
}

/* ---- roles of columns without names ---- */

/* The greatest of three columns without a negative value; else -1. */
static double
most_of(const table *t, size_t i)
{
	double most = 0;

	for (const column *c = t->column + i; c < t->column + i + 3; c++) {
		if (c->negative)
			return -1;
		most = fmax(most, c->seen.most);
	}
	return most;
}

/* Whole numbers of 0 to 255, some beyond 1. */
static bool
could_be_color(const table *t, size_t i)
{
	const column *c = t->column + i;
	double most = most_of(t, i);

	return most > 1 && most <= 255 && !c[0].seen.broken && !c[1].seen.broken && !c[2].seen.broken;
}

/* Nearly all rows that are not zero are of length 1. */
static bool
are_unit(const table *t, size_t i)
{
	return t->units[i == 6] > 0 && t->others[i == 6] <= t->rows / 100;
}

static void
assign(table *t, size_t at, mr_role first)
{
	for (size_t k = 0; k < 3; k++)
		t->column[at + k].role = (mr_role)(first + k);
	if (first == MR_NX && t->others[at == 6] > t->rows / 100)
		mr_tell(t->ctx, MR_GUESSED, 1, "columns %zu to %zu are read as normals, not of length 1",
		    at + 1, at + 3);
}

/* The second of two triples is the normal if it alone is unit, or if only the first can be a colour. */
static void
guess_pair(table *t)
{
	bool behind = !are_unit(t, 3) && (are_unit(t, 6) || could_be_color(t, 3));
	size_t normal = behind ? 6 : 3, color = behind ? 3 : 6;

	assign(t, normal, MR_NX);
	if (could_be_color(t, color))
		assign(t, color, MR_RED);
}

/* Intensity and colour, as a PTS has them, or colour and something, whichever is nearer to the colour's two
 * in the middle. */
static void
guess_seven(table *t)
{
	bool first = could_be_color(t, 3), last = could_be_color(t, 4) || (t->counted && most_of(t, 4) == 0);
	bool either = first && last && !t->counted;

	last &= !either || t->lean >= 0;
	if (either)
		mr_tell(t->ctx, MR_GUESSED, 1, "columns %s are read as colors: columns %s could be, too",
		    last ? "5 to 7" : "4 to 6", last ? "4 to 6" : "5 to 7");
	if (first || last)
		assign(t, last ? 4 : 3, MR_RED);
}

static void
guess_roles(table *t)
{
	for (size_t i = 0; i < t->columns; i++)
		t->column[i].role = MR_NO_ROLE;
	t->points.shades[0].full = 255; /* of columns that are colours because of it */
	assign(t, 0, MR_X);
	if (t->columns == 6)
		assign(t, 3, could_be_color(t, 3) ? MR_RED : MR_NX);
	else if (t->columns == 7)
		guess_seven(t);
	else if (t->columns >= 9)
		guess_pair(t);
}

/* ---- the model ---- */

/* Columns without a name that are 0 fill up; the fourth of four, or of seven before a colour, is intensity.
 */
static mr_status
add_columns(table *t)
{
	for (size_t i = 0; i < t->columns; i++) {
		const column *c = &t->column[i];
		bool intensity = i == 3 &&
		                 (t->columns == 4 || (t->columns == 7 && t->column[4].role == MR_RED));
		bool told = t->named || c->negative || c->seen.most > 0 || c->seen.broken;
		char *name = t->named && c->name_bytes
		                 ? mr_format(t->ctx, "%.*s", (int)c->name_bytes, c->name)
		             : intensity ? mr_format(t->ctx, "intensity")
		                         : mr_format(t->ctx, "column%zu", i + 1);
		mr_rows_add(&t->points, c->role, name, strlen(name), told ? "double" : NULL);
	}
	mr_rows_begin(&t->points);
	return mr_rows_room(&t->points, t->rows);
}

/* Twice as many rows of three as counted, of which the second half are of length 1, or 0: normals. */
static bool
are_halves(const table *t)
{
	size_t others = 0;

	if (!t->counted || t->columns != 3 || t->count == 0 || t->rows != 2 * t->count)
		return false;
	for (const mr_v3 *n = t->points.b.m.p + t->count; n < t->points.b.m.p + t->rows; n++)
		others += !mr_has_unit_length(*n) && mr_norm2(*n) > 0;
	return others <= t->count / 100;
}

/* Normals that are all zero are none. */
static void
finish_normals(table *t)
{
	mr_model *m = &t->points.b.m;
	size_t zero = 0;

	if (are_halves(t)) {
		m->nv = (size_t)t->count;
		m->normal = m->p + m->nv;
	} else if (t->counted && t->rows > t->count)
		mr_tell(t->ctx, MR_GUESSED, 1, "%zu points, where the file counts %llu", t->rows,
		    (unsigned long long)t->count);
	while (m->normal && zero < m->nv && mr_norm2(m->normal[zero]) == 0)
		zero++;
	if (zero == m->nv)
		m->normal = NULL;
}

mr_status
mr_xyz_read(mr_ctx *ctx, const unsigned char *data, size_t size, mr_model *m)
{
	table t = { .ctx = ctx, .text = mr_scan_of(ctx, data, size), .points.b.ctx = ctx };

	read_head(&t);
	MR_TRY(survey(&t));
	if (t.rows == 0)
		return mr_fail(ctx, MR_EMESH, "no row of numbers");
	if (!t.named)
		guess_roles(&t);
	MR_TRY(add_columns(&t));
	for (const double *x = t.value, *end = x + t.rows * t.columns; x < end; x += t.columns)
		mr_rows_put(&t.points, x);
	mr_rows_end(&t.points);
	finish_normals(&t);
	return mr_build_finish(&t.points.b, m);
}

static bool
separates(char c)
{
	return mr_is_blank(c) || c == ',' || c == ';';
}

/* The first line that says something is numbers, one or three and more, or names with x, y and z among them.
 */
bool
mr_xyz_sniff(const unsigned char *data, size_t size)
{
	mr_scan text = mr_scan_of(NULL, data, size), line;
	column c[COLUMNS];
	uint64_t count;
	size_t n = 0;
	double x;

	if (memchr(data, 0, size < 4096 ? size : 4096) || !next_row(&text, &line))
		return false;
	if (is_one_count(line, &count) && !next_row(&text, &line))
		return false;
	if (names(line, c))
		return true;
	for (; line.p < line.end && *line.p != '#'; n++) {
		const char *w = line.p;
		while (line.p < line.end && !separates(*line.p))
			line.p++;
		if (mr_real_read(w, line.p, &x) != line.p && !mr_word_not_finite(w, (size_t)(line.p - w), &x))
			return false;
		while (line.p < line.end && separates(*line.p))
			line.p++;
	}
	return n >= 3;
}

/* ---- written ---- */

/* A line of names where there are colours, which could be normals. */
mr_status
mr_xyz_write(mr_sink *s, const mr_model *m)
{
	mr_part part[MR_PARTS];

	mr_note_lost(s, m, "normal color");
	if (m->color)
		mr_print(s, "# x y z%s red green blue\n", m->normal ? " nx ny nz" : "");
	mr_vertex_parts(m, part);
	part[2].width = 3;
	mr_put_rows(s, part, 3, m->nv, true);
	return MR_OK;
}

/* A position, an intensity, which only points without a colour may lack, and a colour. */
mr_status
mr_pts_write(mr_sink *s, const mr_model *m)
{
	static const double none = 0;
	mr_part part[MR_PARTS];
	size_t i = 0;

	while (i < m->properties &&
	       (strcmp(m->property[i].name, "intensity") || m->property[i].shape.element != 'v'))
		i++;
	mr_note_lost(s, m, i < m->properties && m->properties == 1 ? "color property" : "color");
	mr_vertex_parts(m, part);
	part[1] = i < m->properties ? mr_property_part(&m->property[i])
	                            : (mr_part){ m->color ? &none : NULL, 'd', 1, 0, "" };
	part[2].width = 3;
	mr_print(s, "%zu\n", m->nv);
	mr_put_rows(s, part, 3, m->nv, true);
	return MR_OK;
}

mr_status
mr_pwn_write(mr_sink *s, const mr_model *m)
{
	mr_model own = { .p = m->p, .nv = m->nv, .normal = m->normal };

	if (!m->normal)
		return mr_fail(s->ctx, MR_EMISSING, "pwn is points with normals, and there are no normals");
	mr_note_lost(s, m, "normal");
	return mr_xyz_write(s, &own);
}
