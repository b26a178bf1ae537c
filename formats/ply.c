/* Stanford PLY, read (G. Turk, 1994): text and both byte orders, any properties, lists, triangle strips.
 * Numbers that are nothing to us are kept under their names; other lists and elements are left out. */
#include "formats/format.h"

typedef enum type { CHAR, UCHAR, SHORT, USHORT, INT, UINT, FLOAT, DOUBLE, TYPES } type;

typedef struct type_name {
	const char *name, *alias;
	unsigned char bytes;
	char kind; /* as of mr_load_number */
} type_name;

/* The role of a face property. */
typedef enum role { NONE, INDICES, UVS } role;

typedef struct property {
	bool list;
	type count, value; /* of a list: of its length and of its items */
	role role;
	const char *name;
	size_t kept; /* of a face's: its number from 1 among the properties of the builder; 0: none of them */
} property;

typedef enum kind { OTHER, VERTEX, FACE, STRIPS, KINDS } kind;

typedef struct element {
	kind kind;
	char name[MR_SHOWN];
	uint64_t rows;
	property *property;
	size_t properties, room;
} element;

/* Values of a list that each corner of a face has some of. */
typedef struct corner_list {
	double *value; /* of all faces */
	size_t count, room;
	size_t had;      /* the count before the face at hand */
	size_t odd;      /* faces with as many as make no sense */
	uint32_t *place; /* of the corners at hand */
	size_t place_room;
} corner_list;

typedef struct ply {
	mr_ctx *ctx;
	mr_scan text; /* the header, then the rows */
	bool binary, big;
	element *element;
	size_t elements, room;
	uint32_t *indices; /* of the list at hand */
	size_t indices_count, indices_room;
	corner_list uv;
	double *row; /* of the row at hand, value by value */
	size_t row_room;
	mr_rows rows;    /* of vertices */
	bool vertices;   /* are read */
	size_t textures; /* that are left out */
} ply;

static bool
has(const element *e, role r)
{
	size_t i = 0;

	while (i < e->properties && e->property[i].role != r)
		i++;
	return i < e->properties;
}

/* ---- the header ---- */

static const type_name types[TYPES] = { { "char", "int8", 1, 'I' }, { "uchar", "uint8", 1, 'U' },
	{ "short", "int16", 2, 'I' }, { "ushort", "uint16", 2, 'U' }, { "int", "int32", 4, 'I' },
	{ "uint", "uint32", 4, 'U' }, { "float", "float32", 4, 'F' }, { "double", "float64", 8, 'F' } };

/* The next word of a line, which `what` lacks where there is none. */
static mr_status
header_word(ply *f, mr_scan *line, const char *what, const char **w, size_t *n)
{
	return mr_scan_word(line, w, n) ? MR_OK : mr_scan_fail(&f->text, line->p, "%s", what);
}

static mr_status
header_type(ply *f, mr_scan *line, type *t)
{
	char shown[MR_SHOWN];
	const char *w;
	size_t n;

	MR_TRY(header_word(f, line, "a property lacks its type", &w, &n));
	for (*t = 0; *t < TYPES; ++*t)
		if (mr_word_is(w, n, types[*t].name) || mr_word_is(w, n, types[*t].alias))
			return MR_OK;
	return mr_scan_fail(&f->text, w, "'%s' is no type of PLY", mr_word_shown(w, n, shown));
}

static mr_status
header_property(ply *f, mr_scan *line)
{
	element *e = f->elements ? &f->element[f->elements - 1] : NULL;
	property p = { 0 };
	const char *w;
	size_t n;

	if (!e)
		return mr_scan_fail(&f->text, line->p, "a property before any element");
	p.list = mr_scan_accept(line, "list");
	if (p.list) {
		MR_TRY(header_type(f, line, &p.count));
		if (p.count >= FLOAT)
			return mr_scan_fail(&f->text, line->p, "the length of a list is not of a whole type");
	}
	MR_TRY(header_type(f, line, &p.value));
	MR_TRY(header_word(f, line, "a property lacks its name", &w, &n));
	if (e->kind >= FACE && p.list)
		p.role = mr_word_is(w, n, "vertex_indices") || mr_word_is(w, n, "vertex_index") ? INDICES
		         : mr_word_is(w, n, "texcoord")                                         ? UVS
		                                                                                : NONE;
	p.name = mr_clean_copy(f->ctx, w, n);
	if (has(e, p.role))
		p.role = NONE; /* the first of a name counts */
	if (p.role == INDICES && p.value >= FLOAT)
		return mr_scan_fail(&f->text, w, "indices are not of a whole type");
	MR_RESERVE(f->ctx, e->property, e->properties, 1, &e->room);
	e->property[e->properties++] = p;
	return MR_OK;
}

static mr_status
header_element(ply *f, mr_scan *line)
{
	static const char *const kinds[KINDS] = { "", "vertex", "face", "tristrips" };
	element e = { 0 };
	const char *w;
	size_t n;

	MR_TRY(header_word(f, line, "an element lacks its name", &w, &n));
	mr_word_shown(w, n, e.name);
	MR_TRY(mr_scan_count(line, "the number of an element", UINT64_MAX / 16, &e.rows));
	for (kind k = VERTEX; k < KINDS; k++)
		if (mr_word_is(w, n, kinds[k]))
			e.kind = k;
	for (size_t i = 0; i < f->elements; i++)
		if (e.kind != OTHER && f->element[i].kind == e.kind)
			return mr_scan_fail(&f->text, w, "element %s is there twice", e.name);
	MR_RESERVE(f->ctx, f->element, f->elements, 1, &f->room);
	f->element[f->elements++] = e;
	return MR_OK;
}

static mr_status
header_format(ply *f, mr_scan *line, bool *seen)
{
	char shown[MR_SHOWN];
	const char *w;
	size_t n;

	MR_TRY(header_word(f, line, "the format lacks its name", &w, &n));
	f->binary = !mr_word_is(w, n, "ascii");
	f->big = mr_word_is(w, n, "binary_big_endian");
	if (f->binary && !f->big && !mr_word_is(w, n, "binary_little_endian"))
		return mr_scan_fail(&f->text, w, "'%s' is no format of PLY", mr_word_shown(w, n, shown));
	if (!mr_scan_accept(line, "1.0"))
		return mr_scan_fail(&f->text, line->p, "the format's version is not 1.0");
	*seen = true;
	return MR_OK;
}

/* ---- which properties are kept, and as what ---- */

/* Full intensity of a colour: unsigned types of 8 and 16 bits define it. */
static double
full_of(const element *e, const mr_rows *r, mr_role of)
{
	type t = r->at[of] ? e->property[r->at[of] - 1].value : DOUBLE;

	return t <= UCHAR ? 255 : t == USHORT ? 65535 : 0;
}

/* All properties of vertices are columns of rows; of faces only properties without a role. */
static void
choose_vertex_properties(ply *f, const element *e)
{
	for (size_t i = 0; i < e->properties; i++) {
		const property *p = &e->property[i];
		mr_rows_add(&f->rows, p->list ? MR_NO_ROLE : mr_role_of(p->name, strlen(p->name)), p->name,
		    strlen(p->name), p->list ? NULL : types[p->value].name);
	}
	f->rows.shades[0].full = full_of(e, &f->rows, MR_RED);
	f->rows.shades[1].full = full_of(e, &f->rows, MR_ALPHA);
	mr_rows_begin(&f->rows);
}

static void
choose_properties(ply *f)
{
	for (size_t i = 0; i < f->elements; i++) {
		element *e = &f->element[i];
		if (e->kind == VERTEX)
			choose_vertex_properties(f, e);
		for (size_t j = 0; e->kind == FACE && j < e->properties; j++) {
			property *p = &e->property[j];
			if (!p->list)
				p->kept = mr_build_property(&f->rows.b, p->name, types[p->value].name, 'f');
		}
	}
}

static mr_status
read_header(ply *f)
{
	char shown[MR_SHOWN];
	bool format = false, first = true;
	mr_scan line;
	const char *w;
	size_t n;

	while (mr_scan_line(&f->text, &line)) {
		if (mr_scan_accept(&line, "end_header")) {
			if (!format)
				return mr_scan_fail(&f->text, line.p, "the header lacks its format");
			f->text.binary = f->binary;
			choose_properties(f);
			return MR_OK;
		}
		if (first && !mr_scan_accept(&line, "ply"))
			return mr_scan_fail(&f->text, line.p, "the file does not begin with 'ply'");
		if (!first && mr_scan_accept(&line, "format"))
			MR_TRY(header_format(f, &line, &format));
		else if (mr_scan_accept(&line, "element"))
			MR_TRY(header_element(f, &line));
		else if (mr_scan_accept(&line, "property"))
			MR_TRY(header_property(f, &line));
		else if (mr_scan_accept(&line, "comment"))
			f->textures += mr_scan_accept(&line, "TextureFile");
		else if (!mr_scan_accept(&line, "obj_info") && f->elements > 0 && mr_scan_word(&line, &w, &n))
			return mr_scan_fail(
			    &f->text, w, "'%s' begins no line of a PLY header", mr_word_shown(w, n, shown));
		first = false;
	}
	return mr_scan_fail(&f->text, f->text.end, "the header has no end_header");
}

/* ---- values ---- */

static size_t
bytes_left(const ply *f)
{
	return (size_t)(f->text.end - f->text.p);
}

/* The place of the next value. */
static const char *
here(ply *f)
{
	if (!f->text.binary)
		mr_skip_space(&f->text);
	return f->text.p;
}

/* The next value; in a binary file its bytes are known to be there. */
static mr_status
next_value(ply *f, type t, double *x)
{
	if (!f->text.binary)
		return mr_scan_real(&f->text, "a value", x); /* all its digits, even of a float */
	*x = mr_load_number((const unsigned char *)f->text.p, types[t].kind, types[t].bytes, f->big);
	f->text.p += types[t].bytes;
	return MR_OK;
}

/* The length of a list, whose items then fit in the remaining bytes. */
static mr_status
next_length(ply *f, const property *p, size_t *n)
{
	const char *where = here(f);
	double x = 0;
	size_t left, each = !f->text.binary ? 2 : types[p->value].bytes;

	if (f->text.binary && bytes_left(f) < types[p->count].bytes)
		return mr_scan_fail(&f->text, f->text.end, "the file ends before the length of a list");
	MR_TRY(next_value(f, p->count, &x));
	left = bytes_left(f) + !f->text.binary;
	if (!(x >= 0) || x != floor(x))
		return mr_scan_fail(&f->text, where, "a list of length %g", x);
	if (x > (double)(left / each))
		return mr_scan_fail(&f->text, where, "a list of length %.17g, beyond the end of the file", x);
	*n = (size_t)x;
	return MR_OK;
}

/* Bytes of a row without its lists' items: at least so many a row takes. */
static size_t
row_bytes(const element *e, bool ascii)
{
	size_t bytes = 0;

	for (size_t i = 0; i < e->properties; i++)
		bytes += ascii
		             ? 2
		             : types[e->property[i].list ? e->property[i].count : e->property[i].value].bytes;
	return bytes;
}

/* Refuses a number of rows that the rest of the file cannot hold, before anything is allocated for them; then
 * makes room for one. */
static mr_status
begin_rows(ply *f, const element *e)
{
	size_t left = bytes_left(f), bytes = row_bytes(e, !f->text.binary);

	if (e->rows && bytes && e->rows > (left + !f->text.binary) / bytes)
		return mr_scan_fail(&f->text, here(f),
		    "%llu rows of element %s cannot be in the %zu bytes that are left",
		    (unsigned long long)e->rows, e->name, left);
	MR_RESERVE(f->ctx, f->row, 0, e->properties, &f->row_room);
	return MR_OK;
}

static mr_status
pass_list(ply *f, const property *p)
{
	size_t n = 0;
	double x;

	MR_TRY(next_length(f, p, &n));
	if (f->text.binary) {
		f->text.p += n * types[p->value].bytes;
		return MR_OK;
	}
	while (n-- > 0)
		MR_TRY(mr_scan_real(&f->text, "an item of a list", &x));
	return MR_OK;
}

/* ---- faces ---- */

/* A list of indices; -1 ends a strip. */
static mr_status
read_indices(ply *f, const property *p, bool strips)
{
	size_t n = 0, size = types[p->value].bytes;

	MR_TRY(next_length(f, p, &n));
	MR_RESERVE(f->ctx, f->indices, 0, n, &f->indices_room);
	f->indices_count = n;
	for (size_t i = 0; i < n; i++) {
		const char *where = here(f);
		uint64_t at;
		double x = 0;
		if (f->text.binary && (p->value == INT || p->value == UINT)) {
			uint32_t raw = mr_load32(
			    (const unsigned char *)f->text.p, f->big); /* the usual case */
			f->text.p += size;
			if (raw < f->rows.b.m.nv) {
				f->indices[i] = raw;
				continue;
			}
			x = p->value == INT ? (double)(int32_t)raw : (double)raw;
		} else if (!f->text.binary && f->text.p < f->text.end && mr_is_digit(*f->text.p)) {
			MR_TRY(mr_scan_count(&f->text, "an index", UINT32_MAX, &at));
			x = (double)at;
		} else
			MR_TRY(next_value(f, p->value, &x));
		if (strips && x == -1)
			f->indices[i] = MR_NONE;
		else if (x >= 0 && x < (double)f->rows.b.m.nv && x == floor(x))
			f->indices[i] = (uint32_t)x;
		else
			return mr_scan_fail(&f->text, where, "vertex %.17g of %zu", x, f->rows.b.m.nv);
	}
	return MR_OK;
}

static mr_status
read_corners(ply *f, const property *p, corner_list *l)
{
	size_t n = 0;

	MR_TRY(next_length(f, p, &n));
	MR_RESERVE(f->ctx, l->value, l->count, n, &l->room);
	l->had = l->count;
	for (size_t i = 0; i < n; i++)
		MR_TRY(next_value(f, p->value, &l->value[l->count++]));
	return MR_OK;
}

/* The places of the corners' coordinates in the list: NULL where this face has none, or as many as make no
 * sense. */
static void
places_of(ply *f, corner_list *l, const uint32_t **places)
{
	size_t n = f->indices_count, first = l->had / 2;

	*places = NULL;
	if (l->count - l->had != 2 * n) {
		l->odd += l->count > l->had;
		l->count = l->had;
		return;
	}
	MR_RESERVE(f->ctx, l->place, 0, n, &l->place_room);
	for (size_t i = first; i < first + n; i++)
		l->place[i - first] = isfinite(l->value[2 * i] + l->value[2 * i + 1]) ? (uint32_t)i : MR_NONE;
	*places = n ? l->place : NULL;
	l->had = l->count;
}

/* The triangles of strips; those that name a vertex twice only join strips. */
static void
add_strips(ply *f)
{
	const uint32_t *s = f->indices;
	size_t length = 0;

	for (size_t i = 0; i < f->indices_count; i++) {
		bool odd;
		uint32_t t[3];
		length = s[i] == MR_NONE ? 0 : length + 1;
		if (length < 3)
			continue;
		odd = (length & 1) == 0; /* every other one is turned over */
		t[0] = s[i - 2 + odd], t[1] = s[i - 1 - odd], t[2] = s[i];
		if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0])
			mr_build_face(&f->rows.b, t, NULL, NULL, 3);
	}
}

static void
add_face(ply *f)
{
	const uint32_t *c = f->indices, *uv;

	places_of(f, &f->uv, &uv);
	if (f->indices_count != 3 || uv || !mr_build_triangle(&f->rows.b, c[0], c[1], c[2]))
		mr_build_face(&f->rows.b, c, uv, NULL, f->indices_count);
}

/* ---- rows ---- */

/* Value i of the row at hand, or its list. */
static mr_status
read_value(ply *f, const element *e, uint64_t row, size_t i)
{
	const property *p = &e->property[i];

	if (p->role == INDICES)
		return read_indices(f, p, e->kind == STRIPS);
	if (p->role == UVS)
		return read_corners(f, p, &f->uv);
	if (p->list)
		return pass_list(f, p);
	if (f->text.binary && bytes_left(f) < types[p->value].bytes)
		return mr_scan_fail(&f->text, f->text.end, "the file ends in row %llu of %llu of element %s",
		    (unsigned long long)row + 1, (unsigned long long)e->rows, e->name);
	return next_value(f, p->value, &f->row[i]);
}

/* A number more in the line of a text would move all that follows. */
static mr_status
read_row(ply *f, const element *e, uint64_t row)
{
	for (size_t i = 0; i < e->properties; i++)
		MR_TRY(read_value(f, e, row, i));
	if (f->text.binary)
		return MR_OK;
	mr_skip_blanks(&f->text);
	if (f->text.p == f->text.end || *f->text.p == '\n')
		return MR_OK;
	return mr_scan_fail(&f->text, f->text.p, "more numbers in a line than element %s has", e->name);
}

/* Allocates the rows of an element whose properties are complete. */
static mr_status
begin_element(ply *f, const element *e)
{
	MR_TRY(begin_rows(f, e));
	if (e->kind == OTHER)
		return MR_OK;
	if (e->kind == VERTEX && !(f->rows.at[MR_X] && f->rows.at[MR_Y] && f->rows.at[MR_Z]))
		return mr_scan_fail(&f->text, here(f), "element vertex lacks x, y or z");
	if (e->kind == VERTEX)
		return mr_rows_room(&f->rows, e->rows);
	if (e->rows && !has(e, INDICES))
		return mr_scan_fail(&f->text, here(f), "element %s has no list of vertex_indices", e->name);
	if (e->rows && !f->vertices)
		return mr_scan_fail(&f->text, here(f), "element %s before the vertices is not read", e->name);
	return mr_build_reserve(&f->rows.b, e->kind == FACE && e->rows < MR_NONE / 3 ? (size_t)e->rows : 0);
}

static mr_status
read_element(ply *f, const element *e)
{
	MR_TRY(begin_element(f, e));
	for (uint64_t row = 0; e->properties && row < e->rows; row++) {
		size_t faces = f->rows.b.faces;
		MR_TRY(read_row(f, e, row));
		if (e->kind == VERTEX)
			mr_rows_put(&f->rows, f->row);
		else if (e->kind == FACE)
			add_face(f);
		else if (e->kind == STRIPS)
			add_strips(f);
		for (size_t k = 0; k < e->properties && f->rows.b.faces > faces; k++)
			if (e->property[k].kept)
				mr_build_value(&f->rows.b, e->property[k].kept, faces, f->row[k]);
	}
	if (e->kind == VERTEX) {
		mr_rows_end(&f->rows);
		f->vertices = true;
	}
	return MR_OK;
}

/* ---- the file ---- */

/* Properties that have no role and are no number of a vertex or a face. */
static void
lose_others(ply *f)
{
	mr_lost(f->ctx, NULL, f->textures, "names of textures");
	mr_lost(f->ctx, NULL, f->uv.odd, "lists texcoord of another length");
	for (size_t i = 0; i < f->elements; i++) {
		const element *e = &f->element[i];
		if (e->kind == OTHER)
			mr_tell(f->ctx, MR_LOST, e->rows, "element %s", e->name);
		for (size_t k = 0; e->kind != OTHER && k < e->properties; k++) {
			const property *p = &e->property[k];
			if (p->list && p->role == NONE)
				mr_tell(f->ctx, MR_LOST, e->rows, "%s of element %s", p->name, e->name);
		}
	}
}

mr_status
mr_ply_read(mr_ctx *ctx, const unsigned char *data, size_t size, mr_model *m)
{
	ply f = { .ctx = ctx, .text = mr_scan_of(ctx, data, size), .rows.b.ctx = ctx };

	MR_TRY(read_header(&f));
	for (size_t i = 0; i < f.elements; i++)
		MR_TRY(read_element(&f, &f.element[i]));
	if (!f.vertices)
		return mr_fail(ctx, MR_EMESH, "ply without a vertex");
	if (!f.text.binary)
		mr_skip_comments(&f.text);
	mr_scan_rest(&f.text);
	lose_others(&f);
	f.rows.b.uv = f.uv.value;
	return mr_build_finish(&f.rows.b, m);
}
