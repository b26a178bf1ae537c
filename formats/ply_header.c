/* The header of a PLY, and what its properties are to us. */
#include "formats/ply.h"

const type_name mr_ply_types[TYPES] = { { "char", "int8", 1, 'I' }, { "uchar", "uint8", 1, 'U' },
	{ "short", "int16", 2, 'I' }, { "ushort", "uint16", 2, 'U' }, { "int", "int32", 4, 'I' },
	{ "uint", "uint32", 4, 'U' }, { "float", "float32", 4, 'F' }, { "double", "float64", 8, 'F' } };

static bool
is_word(const char *w, size_t n, const char *word)
{
	return n == strlen(word) && !memcmp(w, word, n);
}

static mr_status
header_type(ply *f, mr_scan *line, type *t)
{
	char shown[MR_SHOWN];
	const char *w;
	size_t n;

	if (!mr_scan_word(line, &w, &n))
		return mr_scan_fail(&f->text, line->p, "a property lacks its type");
	for (*t = 0; *t < TYPES; ++*t)
		if (is_word(w, n, mr_ply_types[*t].name) || is_word(w, n, mr_ply_types[*t].alias))
			return MR_OK;
	return mr_scan_fail(&f->text, w, "'%s' is no type of PLY", mr_word_shown(w, n, shown));
}

static role
role_of(kind k, bool list, const char *w, size_t n)
{
	static const struct {
		bool list;
		role role;
		const char *name;
	} roles[] = { { true, INDICES, "vertex_indices" }, { true, INDICES, "vertex_index" },
		{ true, UVS, "texcoord" } };

	for (size_t i = 0; i < sizeof roles / sizeof *roles; i++)
		if (roles[i].list == list && is_word(w, n, roles[i].name) &&
		    (k == FACE || (k == STRIPS && i < 2)))
			return roles[i].role;
	return NONE;
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
	if (!mr_scan_word(line, &w, &n))
		return mr_scan_fail(&f->text, line->p, "a property lacks its name");
	p.role = role_of(e->kind, p.list, w, n);
	p.name = mr_clean_copy(f->ctx, w, n);
	for (size_t i = 0; i < e->properties && p.role != NONE; i++)
		if (e->property[i].role == p.role)
			p.role = NONE; /* the first of a name counts: "s" and "u" may both be there */
	if (p.role == INDICES && p.value >= FLOAT)
		return mr_scan_fail(&f->text, w, "indices are not of a whole type");
	MR_RESERVE(f->ctx, e->property, e->properties, 1, &e->room);
	e->property[e->properties++] = p;
	return MR_OK;
}

static mr_status
header_element(ply *f, mr_scan *line)
{
	element e = { 0 };
	const char *w;
	size_t n;

	if (!mr_scan_word(line, &w, &n))
		return mr_scan_fail(&f->text, line->p, "an element lacks its name");
	mr_word_shown(w, n, e.name);
	MR_TRY(mr_scan_count(line, "the number of an element", UINT64_MAX / 16, &e.rows));
	e.kind = is_word(w, n, "vertex")      ? VERTEX
	         : is_word(w, n, "face")      ? FACE
	         : is_word(w, n, "tristrips") ? STRIPS
	                                      : OTHER;
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

	if (!mr_scan_word(line, &w, &n))
		return mr_scan_fail(&f->text, line->p, "the format lacks its name");
	f->binary = !is_word(w, n, "ascii");
	f->big = is_word(w, n, "binary_big_endian");
	if (f->binary && !f->big && !is_word(w, n, "binary_little_endian"))
		return mr_scan_fail(&f->text, w, "'%s' is no format of PLY", mr_word_shown(w, n, shown));
	if (!mr_scan_accept(line, "1.0"))
		return mr_scan_fail(&f->text, line->p, "the format's version is not 1.0");
	*seen = true;
	return MR_OK;
}

/* ---- which properties are kept, and as what ---- */

/* What is full of a colour: bytes and 16 bits without sign say it. */
static double
full_of(const element *e, const mr_rows *r, mr_role of)
{
	type t = r->at[of] ? e->property[r->at[of] - 1].value : DOUBLE;

	return t <= UCHAR ? 255 : t == USHORT ? 65535 : 0;
}

/* Of vertices all are columns of rows; of faces, those that are nothing else. */
static void
choose_vertex_properties(ply *f, const element *e)
{
	for (size_t i = 0; i < e->properties; i++) {
		const property *p = &e->property[i];
		mr_rows_add(&f->rows, p->list ? MR_NO_ROLE : mr_role_of(p->name, strlen(p->name)), p->name,
		    strlen(p->name), p->list ? NULL : mr_ply_types[p->value].name);
	}
	f->rows.shades[0].full = full_of(e, &f->rows, MR_RED);
	f->rows.shades[1].full = full_of(e, &f->rows, MR_ALPHA);
	mr_rows_begin(&f->rows);
}

static void
choose_face_properties(ply *f, element *e)
{
	for (size_t i = 0; i < e->properties; i++) {
		property *p = &e->property[i];
		if (p->role == NONE && !p->list)
			mr_build_property(&f->b, p->name, mr_ply_types[p->value].name, 'f', &p->kept);
	}
}

/* Those of vertices come first, whatever the order of the elements. */
static void
choose_properties(ply *f)
{
	for (size_t i = 0; i < f->elements; i++)
		if (f->element[i].kind == VERTEX)
			choose_vertex_properties(f, &f->element[i]);
	for (size_t i = 0; i < f->elements; i++)
		if (f->element[i].kind == FACE)
			choose_face_properties(f, &f->element[i]);
}

/* ---- the lines ---- */

mr_status
mr_ply_header(ply *f)
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
