/* The header of a PLY, and what its properties are to us. */
#include "formats/ply.h"

const type_name mr_ply_types[TYPES] = { { "char", "int8", 1 }, { "uchar", "uint8", 1 },
	{ "short", "int16", 2 }, { "ushort", "uint16", 2 }, { "int", "int32", 4 }, { "uint", "uint32", 4 },
	{ "float", "float32", 4 }, { "double", "float64", 8 } };

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
		kind kind;
		bool list;
		role role;
		const char *name;
	} roles[] = { { VERTEX, false, X, "x" }, { VERTEX, false, Y, "y" }, { VERTEX, false, Z, "z" },
		{ VERTEX, false, NX, "nx" }, { VERTEX, false, NY, "ny" }, { VERTEX, false, NZ, "nz" },
		{ VERTEX, false, RED, "red" }, { VERTEX, false, GREEN, "green" },
		{ VERTEX, false, BLUE, "blue" }, { VERTEX, false, ALPHA, "alpha" },
		{ VERTEX, false, RED, "r" }, { VERTEX, false, GREEN, "g" }, { VERTEX, false, BLUE, "b" },
		{ VERTEX, false, ALPHA, "a" }, { VERTEX, false, RED, "diffuse_red" },
		{ VERTEX, false, GREEN, "diffuse_green" }, { VERTEX, false, BLUE, "diffuse_blue" },
		{ VERTEX, false, U, "s" }, { VERTEX, false, V, "t" }, { VERTEX, false, U, "u" },
		{ VERTEX, false, V, "v" }, { VERTEX, false, U, "texture_u" },
		{ VERTEX, false, V, "texture_v" }, { VERTEX, false, U, "texture_s" },
		{ VERTEX, false, V, "texture_t" }, { VERTEX, false, FROM_X, "scanner_x" },
		{ VERTEX, false, FROM_Y, "scanner_y" }, { VERTEX, false, FROM_Z, "scanner_z" },
		{ FACE, true, INDICES, "vertex_indices" }, { FACE, true, INDICES, "vertex_index" },
		{ FACE, true, UVS, "texcoord" }, { FACE, true, NORMALS, "corner_normal" },
		{ FACE, false, GROUP, "group" }, { FACE, false, OBJECT, "object" },
		{ FACE, false, MATERIAL, "material" }, { FACE, false, SMOOTHING, "smoothing" },
		{ STRIPS, true, INDICES, "vertex_indices" }, { STRIPS, true, INDICES, "vertex_index" } };

	for (size_t i = 0; i < sizeof roles / sizeof *roles; i++)
		if (roles[i].kind == k && roles[i].list == list && is_word(w, n, roles[i].name))
			return roles[i].role;
	return NONE;
}

/* A name of a property, in the arena. */
static const char *
clean_name(mr_ctx *ctx, const char *w, size_t n)
{
	char *name = mr_alloc(ctx, n + 1, 1);

	if (name)
		mr_clean_name(name, w, n, false);
	return name;
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
	if (!(p.name = clean_name(f->ctx, w, n)))
		return MR_EMEM;
	for (size_t i = 0; i < e->properties && p.role != NONE; i++)
		if (e->property[i].role == p.role)
			p.role = NONE; /* the first of a name counts: "s" and "u" may both be there */
	if (p.role == INDICES && p.value >= FLOAT)
		return mr_scan_fail(&f->text, w, "indices are not of a whole type");
	MR_TRY(MR_RESERVE(f->ctx, e->property, e->properties, 1, &e->room));
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
	MR_TRY(MR_RESERVE(f->ctx, f->element, f->elements, 1, &f->room));
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
	f->ascii = is_word(w, n, "ascii");
	f->big = is_word(w, n, "binary_big_endian");
	if (!f->ascii && !f->big && !is_word(w, n, "binary_little_endian"))
		return mr_scan_fail(&f->text, w, "'%s' is no format of PLY", mr_word_shown(w, n, shown));
	if (!mr_scan_accept(line, "1.0"))
		return mr_scan_fail(&f->text, line->p, "the format's version is not 1.0");
	*seen = true;
	return MR_OK;
}

/* A comment "group NAME" names the next group, as mr_ply_write has it, and so on. */
static mr_status
header_comment(ply *f, mr_scan *line)
{
	static const char *const words[] = { "group", "object", "material" };

	for (size_t i = 0; i < 3; i++)
		if (mr_scan_accept(line, words[i])) {
			named_list *l = &f->names[i];
			MR_TRY(MR_RESERVE(f->ctx, l->name, l->count, 1, &l->room));
			l->name[l->count++] = (mr_lines){ line->p, (size_t)(line->end - line->p) };
			return MR_OK;
		}
	if (mr_scan_accept(line, "TextureFile"))
		f->textures++;
	else if (mr_scan_accept(line, "mtllib"))
		return mr_build_library(&f->b, line->p, (size_t)(line->end - line->p));
	return MR_OK;
}

/* ---- which properties are kept, and as what ---- */

/* Parts without the whole are numbers as any others. */
static void
demote(element *e, const role *parts, size_t n)
{
	bool whole = true;

	for (size_t i = 0; i < n; i++)
		whole &= has(e, parts[i]);
	for (size_t i = 0; i < e->properties && !whole; i++)
		for (size_t k = 0; k < n; k++)
			if (e->property[i].role == parts[k])
				e->property[i].role = NONE;
}

/* Numbers of groups, objects and materials need names, smoothing groups a type without sign: -1 is none. */
static void
demote_marks(ply *f, element *e)
{
	for (size_t i = 0; i < e->properties; i++) {
		property *p = &e->property[i];
		bool whole = p->value == UCHAR || p->value == USHORT || p->value == UINT;
		if (p->role >= GROUP && (p->role == SMOOTHING ? !whole : !f->names[p->role - GROUP].count))
			p->role = NONE;
	}
}

/* Those of vertices come first, whatever the order of the elements. */
static mr_status
keep_properties(ply *f, kind k)
{
	for (size_t i = 0; i < f->elements; i++) {
		element *e = &f->element[i];
		for (size_t j = 0; e->kind == k && j < e->properties; j++)
			if (e->property[j].role == NONE && !e->property[j].list)
				MR_TRY(mr_build_property(&f->b, e->property[j].name,
				    mr_ply_types[e->property[j].value].name, k == VERTEX ? 'v' : 'f',
				    &e->property[j].kept));
	}
	return MR_OK;
}

static mr_status
choose_properties(ply *f)
{
	static const role normals[] = { NX, NY, NZ }, colors[] = { RED, GREEN, BLUE },
			  alpha[] = { RED, ALPHA }, uv[] = { U, V }, scanner[] = { FROM_X, FROM_Y, FROM_Z };

	for (size_t i = 0; i < f->elements; i++) {
		element *e = &f->element[i];
		if (e->kind == VERTEX) {
			demote(e, normals, 3);
			demote(e, colors, 3);
			demote(e, uv, 2);
			demote(e, scanner, 3);
			if (!has(e, RED))
				demote(e, alpha, 2);
		} else if (e->kind == FACE)
			demote_marks(f, e);
	}
	MR_TRY(keep_properties(f, VERTEX));
	return keep_properties(f, FACE);
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
			f->p = (const unsigned char *)f->text.p;
			return choose_properties(f);
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
			MR_TRY(header_comment(f, &line));
		else if (!mr_scan_accept(&line, "obj_info") && f->elements > 0 && mr_scan_word(&line, &w, &n))
			return mr_scan_fail(
			    &f->text, w, "'%s' begins no line of a PLY header", mr_word_shown(w, n, shown));
		first = false;
	}
	return mr_scan_fail(&f->text, f->text.end, "the header has no end_header");
}
