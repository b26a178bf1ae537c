/*
 * Points in columns: XYZ, PTS, PWN, and tables with a line of names.  Columns are told apart by names where
 * there are any, else by their number: 3 position; 4, 5 position and what we do not know; 6 normal, or colour
 * where all are whole numbers of 0 to 255 and some beyond 1; 7 intensity and colour, or colour and something;
 * 9 and more colour and normal in either order, the normal being the unit one.  Other columns are properties,
 * by their names; without names the fourth of four or of seven with a colour behind is intensity.  A first
 * line with one whole number is the number of points, behind which those of another cloud may stand in the
 * same way; twice as many rows of three are points, then normals.
 */
#include "formats/format.h"

typedef enum role { SKIP, X, Y, Z, NX, NY, NZ, RED, GREEN, BLUE, ALPHA, ROLES } role;

enum { COLUMNS = 64 };

typedef struct table {
	mr_ctx *ctx;
	mr_scan text;
	bool named;      /* a line of names gave the roles */
	bool in_comment; /* and was a comment: it may speak of something else */
	bool counted;
	uint64_t count; /* as the file claims */
	double full;    /* of colours; 0: their values tell */
	size_t columns, rows;
	role role[COLUMNS];
	mr_shades seen[COLUMNS];
	bool negative[COLUMNS];     /* has a value that is */
	size_t units[2], others[2]; /* rows of columns 3 to 5, 6 to 8 of length 1, of neither 0 nor 1 */
	size_t color[4];            /* columns of red, green, blue, alpha */
	mr_shades shades[2];        /* of all four, of alpha */
	size_t odd_colors;
	const char *first_row; /* for sentences */
	const char *name[COLUMNS];
	size_t name_bytes[COLUMNS];
	size_t property[COLUMNS]; /* numbers, from 1; 0: none */
	mr_builder properties;
} table;

static bool
separates(char c)
{
	return mr_is_blank(c) || c == ',' || c == ';';
}

/* Goes on to the next cell; how many commas and semicolons stand before it: with two, one is empty. */
static size_t
skip_separators(mr_scan *line)
{
	size_t commas = 0;

	for (; line->p < line->end && separates(*line->p); line->p++)
		commas += !mr_is_blank(*line->p);
	return commas;
}

static bool
is_comment(const mr_scan *line)
{
	return line->p == line->end || *line->p == '#' || *line->p == '%' || *line->p == '!' ||
	       (line->end - line->p >= 2 && line->p[0] == '/' && line->p[1] == '/');
}

/* The next line that says something, without leading blanks. */
static bool
next_row(mr_scan *text, mr_scan *line)
{
	while (mr_scan_line(text, line)) {
		mr_skip_blanks(line);
		if (!is_comment(line))
			return true;
	}
	return false;
}

/* ---- a line of names ---- */

static role
role_of(const char *w, size_t n)
{
	static const struct {
		const char *name;
		role role;
	} roles[] = { { "x", X }, { "y", Y }, { "z", Z }, { "nx", NX }, { "ny", NY }, { "nz", NZ },
		{ "normalx", NX }, { "normaly", NY }, { "normalz", NZ }, { "normal_x", NX },
		{ "normal_y", NY }, { "normal_z", NZ }, { "r", RED }, { "g", GREEN }, { "b", BLUE },
		{ "a", ALPHA }, { "red", RED }, { "green", GREEN }, { "blue", BLUE }, { "alpha", ALPHA } };
	char lower[16];

	if (n >= sizeof lower)
		return SKIP;
	for (size_t i = 0; i < n; i++)
		lower[i] = (char)(w[i] >= 'A' && w[i] <= 'Z' ? w[i] + ('a' - 'A') : w[i]);
	for (size_t i = 0; i < sizeof roles / sizeof *roles; i++)
		if (strlen(roles[i].name) == n && !memcmp(lower, roles[i].name, n))
			return roles[i].role;
	return SKIP;
}

/* Reads names with or without quotes; the number of columns, or 0 where x, y and z are not all there. */
static size_t
names(mr_scan line, role r[COLUMNS], const char *name[COLUMNS], size_t bytes[COLUMNS])
{
	bool there[ROLES] = { false };
	size_t n = 0;

	for (;;) {
		const char *w, *e;
		for (size_t commas = skip_separators(&line), due = n > 0; commas > due && n < COLUMNS;
		     commas--)
			r[n] = SKIP, name[n] = line.p, bytes[n++] = 0;
		if (line.p == line.end || n == COLUMNS)
			break;
		w = line.p;
		if (*w == '"') {
			w++;
			e = memchr(w, '"', (size_t)(line.end - w));
			if (!e)
				return 0;
			line.p = e + 1;
		} else {
			while (line.p < line.end && !separates(*line.p))
				line.p++;
			e = line.p;
		}
		r[n] = role_of(w, (size_t)(e - w));
		name[n] = w;
		bytes[n] = (size_t)(e - w);
		if (there[r[n]])
			r[n] = SKIP; /* the first of a name counts */
		there[r[n++]] = true;
	}
	return there[X] && there[Y] && there[Z] ? n : 0;
}

/* ---- rows ---- */

static mr_status
bad_word(const table *t, const mr_scan *line)
{
	char shown[MR_SHOWN];
	const char *e = line->p;

	while (e < line->end && !separates(*e))
		e++;
	return mr_scan_fail(
	    &t->text, line->p, "'%s' is not a number", mr_word_shown(line->p, (size_t)(e - line->p), shown));
}

/* The numbers of a row; NAN for words such as nan. */
static mr_status
row_values(const table *t, mr_scan *line, double x[COLUMNS], size_t *count)
{
	size_t n = 0;

	for (;;) {
		double value;
		const char *e;
		if (skip_separators(line) > (n > 0))
			return mr_scan_fail(&t->text, line->p, "column %zu is empty", n + 1);
		if (line->p == line->end || *line->p == '#')
			break;
		e = mr_real_read(line->p, line->end, &value);
		if (!e || (e < line->end && !separates(*e))) {
			for (e = line->p; e < line->end && !separates(*e); e++)
				;
			if (!mr_word_not_finite(line->p, (size_t)(e - line->p), &value))
				return bad_word(t, line);
		}
		if (n == COLUMNS)
			return mr_scan_fail(&t->text, line->p, "more than %d columns", (int)COLUMNS);
		x[n++] = value;
		line->p = e;
	}
	*count = n;
	return MR_OK;
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

/* A comment of the writer: a value of 1 is a dark byte, not full. */
static bool
tells_bytes(mr_scan line)
{
	const size_t n = strlen(MR_XYZ_BYTES);

	mr_skip_blanks(&line);
	return (size_t)(line.end - line.p) == n && !memcmp(line.p, MR_XYZ_BYTES, n);
}

/* The lines before the rows: comments that name columns, names, a count, in either order. */
static mr_status
read_head(table *t)
{
	mr_scan ahead = t->text, line;

	for (; mr_scan_line(&ahead, &line); t->text.p = ahead.p) {
		mr_skip_blanks(&line);
		if (is_comment(&line)) {
			while (line.p < line.end && (*line.p == '#' || *line.p == '/'))
				line.p++;
			if (tells_bytes(line))
				t->full = 255;
			if (!t->named)
				t->columns = names(line, t->role, t->name, t->name_bytes);
			t->in_comment = t->in_comment || (!t->named && t->columns > 0);
		} else if (!t->counted && is_one_count(line, &t->count))
			t->counted = true;
		else if (t->named || !(t->columns = names(line, t->role, t->name, t->name_bytes)))
			break;
		t->named = t->columns > 0;
	}
	return MR_OK;
}

/* A word "1,5" of words that blanks or semicolons part: two numbers, or one with a decimal comma.  NULL:
 * none. */
static const char *
decimal_comma(mr_scan line)
{
	const char *found = NULL;
	size_t words = 0;

	while (line.p < line.end && *line.p != '#') {
		const char *w = line.p, *comma = NULL;
		for (; line.p < line.end && !mr_is_blank(*line.p) && *line.p != ';'; line.p++)
			if (*line.p == ',' && comma)
				return NULL;
			else if (*line.p == ',')
				comma = line.p;
		if (comma && (comma == w || comma + 1 == line.p || memchr(w, '.', (size_t)(comma - w))))
			return NULL;
		found = !found && comma ? w : found;
		words += line.p > w;
		line.p += line.p < line.end && *line.p != '#';
	}
	return words > 1 ? found : NULL;
}

/* Words that are no names we know are one with blanks in it, where that makes as many as there are columns.
 */
static void
join_names(table *t, size_t columns)
{
	size_t first = 0, runs = 0, length = 0, more = t->columns - columns, rest;

	for (size_t i = 0; i < t->columns; i++) {
		if (t->role[i] != SKIP)
			continue;
		if (i == 0 || t->role[i - 1] != SKIP) {
			first = i;
			runs++;
		}
		length++;
	}
	if (runs != 1 || length != more + 1)
		return;
	t->name_bytes[first] = (size_t)(t->name[first + more] + t->name_bytes[first + more] - t->name[first]);
	rest = columns - first - 1;
	memmove(t->role + first + 1, t->role + first + length, rest * sizeof *t->role);
	memmove(t->name + first + 1, t->name + first + length, rest * sizeof *t->name);
	memmove(t->name_bytes + first + 1, t->name_bytes + first + length, rest * sizeof *t->name_bytes);
	t->columns = columns;
}

/* What is told of the columns by the first row. */
static mr_status
begin_rows(table *t, const mr_scan *row, size_t n)
{
	const char *comma = decimal_comma(*row), *e;
	char shown[MR_SHOWN];

	t->first_row = row->p;
	if (comma) {
		for (e = comma; e < row->end && !mr_is_blank(*e) && *e != ';'; e++)
			;
		return mr_scan_fail(&t->text, comma,
		    "'%s' is two numbers, or one with a comma for a point: write a point, or commas between "
		    "all",
		    mr_word_shown(comma, (size_t)(e - comma), shown));
	}
	if (n < 3)
		return mr_scan_fail(&t->text, row->p, "%zu columns, where a point has 3 at least", n);
	if (t->named && n < t->columns)
		join_names(t, n);
	if (t->in_comment && n != t->columns) {
		mr_tell(
		    t->ctx, MR_GUESSED, 1, "a comment of %zu words names no columns of %zu", t->columns, n);
		t->named = false;
	}
	if (t->named && n != t->columns)
		return mr_scan_fail(&t->text, row->p, "%zu columns, where %zu are named", n, t->columns);
	t->columns = n;
	return MR_OK;
}

/* Another cloud of the file: behind as many rows as were counted stands the number of more. */
static bool
begins_another(table *t, mr_scan row)
{
	uint64_t more;

	if (!t->counted || t->rows != t->count || !is_one_count(row, &more))
		return false;
	t->count += more;
	return true;
}

static void
see_length(table *t, size_t k, mr_v3 v)
{
	bool unit = mr_has_unit_length(v);

	t->units[k] += unit;
	t->others[k] += !unit && mr_norm2(v) > 0;
}

/* Looks at all rows: how many, of how many columns, and which could be colours. */
static mr_status
survey(table *t)
{
	mr_scan text = t->text, line;
	double x[COLUMNS] = { 0 };
	size_t n = 0;

	while (next_row(&text, &line)) {
		const mr_scan row = line;
		MR_TRY(row_values(t, &line, x, &n));
		if (n == 1 && begins_another(t, row))
			continue;
		if (t->rows == 0)
			MR_TRY(begin_rows(t, &row, n));
		if (n != t->columns)
			return mr_scan_fail(&t->text, row.p, "%zu columns, where line %zu has %zu", n,
			    mr_line_number(&t->text, t->first_row), t->columns);
		for (size_t i = 0; i < n; i++) {
			mr_shade_see(&t->seen[i], x[i]);
			t->negative[i] = t->negative[i] || x[i] < 0;
		}
		for (size_t k = 0; k < 2 && 6 + 3 * k <= n; k++)
			see_length(t, k, mr_vec(x[3 + 3 * k], x[4 + 3 * k], x[5 + 3 * k]));
		t->rows++;
	}
	if (t->counted && t->rows < t->count)
		return mr_scan_fail(&t->text, t->text.end, "the file ends after %zu of %llu points", t->rows,
		    (unsigned long long)t->count);
	return MR_OK;
}

/* Every value a whole number of 0 to 255. */
static bool
is_byte(const table *t, size_t i)
{
	return !t->seen[i].broken && !t->negative[i] && t->seen[i].most <= 255;
}

static bool
are_bytes(const table *t, size_t i)
{
	return is_byte(t, i) && is_byte(t, i + 1) && is_byte(t, i + 2);
}

static bool
could_be_color(const table *t, size_t i)
{
	return are_bytes(t, i) && (t->seen[i].most > 1 || t->seen[i + 1].most > 1 || t->seen[i + 2].most > 1);
}

/* Values of 0 to 1, not all of them 0. */
static bool
are_shares(const table *t, size_t i)
{
	double most = 0;

	for (size_t k = i; k < i + 3; k++) {
		if (t->negative[k])
			return false;
		most = fmax(most, t->seen[k].most);
	}
	return most > 0 && most <= 1;
}

/* Nearly all rows that are not zero are of length 1. */
static bool
are_unit(const table *t, size_t i)
{
	size_t k = i == 6;

	return t->units[k] > 0 && t->others[k] <= t->rows / 100;
}

static void
assign(table *t, size_t at, role first)
{
	for (size_t k = 0; k < 3; k++)
		t->role[at + k] = (role)(first + (role)k);
}

/* Of two triples a unit one is the normal; of two such the first, unless only that could be a colour. */
static bool
normal_is_behind(const table *t)
{
	bool first = are_unit(t, 3), second = are_unit(t, 6);

	if (first && second)
		return are_shares(t, 3) && !are_shares(t, 6);
	return first || second ? second : could_be_color(t, 3);
}

/* Warns where what is read as normals may be colours, or something else. */
static void
doubt_normals(const table *t, size_t at)
{
	if (t->others[at == 6] > t->rows / 100)
		mr_tell(t->ctx, MR_GUESSED, 1, "columns %zu to %zu are read as normals, not of length 1",
		    at + 1, at + 3);
}

static void
guess_pair(table *t)
{
	bool behind = normal_is_behind(t);
	size_t normal = behind ? 6 : 3, color = behind ? 3 : 6;

	assign(t, normal, NX);
	doubt_normals(t, normal);
	if (could_be_color(t, color)) {
		assign(t, color, RED);
	} else if (are_unit(t, normal) && are_shares(t, color)) {
		assign(t, color, RED);
		t->full = 1;
	}
}

/* Seven columns: intensity and colour, or colour and something. */
static void
guess_seven(table *t)
{
	bool first = could_be_color(t, 3), last = t->counted ? are_bytes(t, 4) : could_be_color(t, 4);

	if (first && last && !t->counted)
		mr_tell(
		    t->ctx, MR_GUESSED, 1, "columns 4 to 6 are read as colors: columns 5 to 7 could be, too");
	if (last && (t->counted || !first))
		assign(t, 4, RED);
	else if (first)
		assign(t, 3, RED);
}

/* What the columns are, where no names tell. */
static void
guess_roles(table *t)
{
	size_t n = t->columns;

	memset(t->role, 0, sizeof t->role);
	t->full = 255; /* of columns that are colours because of it */
	assign(t, 0, X);
	if (n == 6)
		assign(t, 3, could_be_color(t, 3) ? RED : NX);
	else if (n == 7)
		guess_seven(t);
	else if (n >= 9)
		guess_pair(t);
	if (n == 6 && t->role[3] == NX)
		doubt_normals(t, 3);
}

/* ---- the model ---- */

static size_t
column_of(const table *t, role r)
{
	for (size_t i = 0; i < t->columns; i++)
		if (t->role[i] == r)
			return i;
	return COLUMNS;
}

static bool
has_three(const table *t, role first)
{
	return column_of(t, first) < COLUMNS && column_of(t, (role)(first + 1)) < COLUMNS &&
	       column_of(t, (role)(first + 2)) < COLUMNS;
}

/* ---- properties ---- */

/* What the file calls a column, or what it is by its place. */
static mr_status
name_of(const table *t, size_t i, const char **name)
{
	bool intensity = i == 3 && (t->columns == 4 || (t->columns == 7 && t->role[4] == RED));
	char *clean = mr_alloc(t->ctx, t->named ? t->name_bytes[i] + 1 : 1, 1);

	if (!clean)
		return MR_EMEM;
	if (t->named)
		mr_clean_name(clean, t->name[i], t->name_bytes[i], false);
	*name = t->named && *clean ? clean : intensity ? "intensity" : mr_format(t->ctx, "column%zu", i + 1);
	return *name ? MR_OK : MR_EMEM;
}

/* Whether the column is a part of what points have by convention: of three that are all there. */
static bool
is_part(const table *t, role r)
{
	return r != SKIP && (r <= Z || has_three(t, r <= NZ ? NX : RED));
}

/* A value is not 0, as those are that fill up a column without a name. */
static bool
says(const table *t, size_t i)
{
	return t->seen[i].most > 0 || t->negative[i] || t->seen[i].broken;
}

static mr_status
begin_properties(table *t)
{
	const char *name;

	for (size_t i = 0; i < t->columns; i++)
		if (!is_part(t, t->role[i]) && (t->named || says(t, i))) {
			MR_TRY(name_of(t, i, &name));
			MR_TRY(mr_build_property(&t->properties, name, "double", 'v', &t->property[i]));
		}
	return MR_OK;
}

static void
begin_colors(table *t)
{
	for (size_t k = 0; k < 4; k++) {
		size_t at = t->color[k] = column_of(t, (role)(RED + k));
		for (mr_shades *s = t->shades; at < COLUMNS && s <= &t->shades[k == 3]; s++) {
			s->most = fmax(s->most, t->seen[at].most);
			s->broken |= t->seen[at].broken;
		}
	}
	for (size_t k = 0; k < 2; k++)
		t->shades[k].full = t->full > 0 ? t->full : mr_shade_full(&t->shades[k]);
}

static void
set_color(table *t, const double *x, unsigned char *c)
{
	bool odd = false;

	for (size_t k = 0; k < 4; k++) {
		size_t at = t->color[k];
		c[k] = at == COLUMNS ? 255 : mr_shade_byte(&t->shades[k == 3], x[at]);
		odd |= at < COLUMNS && isnan(x[at]);
	}
	t->odd_colors += odd;
}

static mr_v3
three(const table *t, const double *x, role first)
{
	return mr_vec(
	    x[column_of(t, first)], x[column_of(t, (role)(first + 1))], x[column_of(t, (role)(first + 2))]);
}

/* Twice as many rows of three as counted, of which the second half are of length 1, or 0: normals. */
static bool
halves(const table *t, const mr_v3 *p)
{
	size_t others = 0;

	if (!t->counted || t->columns != 3 || t->count == 0 || t->rows != 2 * t->count)
		return false;
	for (size_t i = t->rows / 2; i < t->rows; i++)
		others += !mr_has_unit_length(p[i]) && mr_norm2(p[i]) > 0;
	return others <= t->rows / 200;
}

static bool
useful(mr_ctx *ctx, mr_v3 *n, size_t count)
{
	size_t zero = 0;

	if (!mr_normals_left(ctx, n, count))
		return false;
	for (size_t i = 0; i < count; i++)
		zero += mr_norm2(n[i]) == 0;
	return zero < count;
}

static mr_status
fill(table *t, mr_v3 *p, mr_v3 *normal, unsigned char *color)
{
	mr_scan text = t->text, line;
	double x[COLUMNS] = { 0 };
	size_t n = 0;

	for (size_t i = 0; next_row(&text, &line); i += n > 1) {
		const char *where = line.p;
		MR_TRY(row_values(t, &line, x, &n));
		if (n == 1) /* the count of another cloud */
			continue;
		p[i] = three(t, x, X);
		if (!mr_finite(p[i]))
			return mr_scan_fail(&t->text, where, "a coordinate is not finite");
		if (normal)
			normal[i] = three(t, x, NX);
		if (color)
			set_color(t, x, color + 4 * i);
		for (size_t k = 0; k < t->columns; k++)
			if (t->property[k])
				MR_TRY(mr_build_value(&t->properties, t->property[k], i, x[k]));
	}
	return MR_OK;
}

mr_status
mr_xyz_read(mr_ctx *ctx, const unsigned char *data, size_t size, mr_model *m)
{
	table t = { .ctx = ctx, .text = mr_scan_of(ctx, data, size), .properties = { .ctx = ctx } };
	mr_v3 *p, *normal = NULL;
	unsigned char *color = NULL;
	size_t n;

	MR_TRY(read_head(&t));
	MR_TRY(survey(&t));
	if (!t.named)
		guess_roles(&t);
	p = MR_NEW(ctx, t.rows, mr_v3);
	if (!p || (has_three(&t, NX) && !(normal = MR_NEW(ctx, t.rows, mr_v3))) ||
	    (has_three(&t, RED) && !(color = mr_alloc(ctx, t.rows, 4))))
		return MR_EMEM;
	MR_TRY(begin_properties(&t));
	begin_colors(&t);
	MR_TRY(fill(&t, p, normal, color));
	if (color && !mr_all_left(ctx, t.odd_colors, t.rows, "colors"))
		color = NULL;
	for (int i = 0; color && i < 2; i++)
		mr_shades_said(ctx, &t.shades[i]);
	n = halves(&t, p) ? t.rows / 2 : t.rows;
	if (n < t.rows)
		normal = p + n;
	else if (t.counted && t.rows > t.count)
		mr_tell(ctx, MR_GUESSED, 1, "%zu points, where the file counts %llu", t.rows,
		    (unsigned long long)t.count);
	if (normal && n && !useful(ctx, normal, n))
		normal = NULL;
	*m = (mr_model){ .p = p, .nv = n, .normal = normal, .color = color };
	return mr_build_properties(&t.properties, m);
}

/* The first line that says something is numbers, one or three and more, or names with x, y and z among them.
 */
bool
mr_xyz_sniff(const unsigned char *data, size_t size)
{
	mr_scan text = mr_scan_of(NULL, data, size), line;
	role r[COLUMNS];
	const char *name[COLUMNS];
	size_t n = 0, bytes[COLUMNS];
	uint64_t count;

	if (memchr(data, 0, size < 4096 ? size : 4096) || !next_row(&text, &line))
		return false;
	if (is_one_count(line, &count) && !next_row(&text, &line))
		return false;
	if (names(line, r, name, bytes))
		return true;
	for (skip_separators(&line); line.p < line.end && *line.p != '#'; n++, skip_separators(&line)) {
		double x;
		const char *e = mr_real_read(line.p, line.end, &x);
		if (!e || (e < line.end && !separates(*e)))
			return false;
		line.p = e;
	}
	return n >= 3;
}
