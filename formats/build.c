/* Corners gathered face by face, then triangulated. */
#include "formats/build.h"

#include "base/utf8.h"
#include "mesh/polygon.h"
#include "stream/frame.h"

static const size_t MOST_TRIANGLES = (MR_NONE - 1) / 3;

mr_status
mr_build_reserve(mr_builder *b, size_t faces)
{
	if (faces > MOST_TRIANGLES)
		return mr_fail(b->ctx, MR_ERANGE, "%zu faces are more than indices can name", faces);
	b->plain = b->faces == 0 && !b->corner_uv && !b->corner_vn;
	for (int i = 0; i < MR_MARKINGS; i++)
		b->plain &= !b->marks[i].used;
	MR_RESERVE(b->ctx, b->corner, b->corners, 3 * faces, &b->corner_room);
	return MR_OK;
}

/* ---- faces ---- */

/* From now on the faces' sizes are kept. */
static void
keep_sizes(mr_builder *b)
{
	MR_RESERVE(b->ctx, b->size, 0, b->faces + b->faces / 2 + 1024, &b->face_room);
	for (size_t i = 0; i < b->faces; i++)
		b->size[i] = 3;
	b->plain = false;
}

/* The places of n more corners; the first had none so far. */
static void
keep_places(mr_builder *b, uint32_t **places, size_t *room, const uint32_t *new, size_t n)
{
	bool first = !*places;

	if (!new &&first)
		return;
	MR_RESERVE(b->ctx, *places, first ? 0 : b->corners, (first ? b->corners : 0) + n, room);
	for (size_t i = 0; first && i < b->corners; i++)
		(*places)[i] = MR_NONE;
	for (size_t i = 0; i < n; i++)
		(*places)[b->corners + i] = new ? new[i] : MR_NONE;
	b->plain = false;
}

/* The face at the end of the corners is there: what else is known of it. */
static void
mark_face(mr_builder *b, size_t corners)
{
	if (corners > 3 && !b->size)
		keep_sizes(b);
	if (b->size) {
		MR_RESERVE(b->ctx, b->size, b->faces, 1, &b->face_room);
		b->size[b->faces] = (uint32_t)corners;
	}
	for (int i = 0; i < MR_MARKINGS; i++) {
		mr_marks *k = &b->marks[i];
		if (!k->used)
			continue;
		MR_RESERVE(b->ctx, k->of, b->faces, 1, &k->room);
		k->of[b->faces] = k->current;
	}
	b->corners += corners;
	b->faces++;
}

void
mr_build_faces(mr_builder *b, const uint32_t *size, size_t n, const uint32_t *corner, const uint32_t *uv,
    const uint32_t *vn)
{
	size_t corners = 0;

	for (size_t i = 0; i < n; i++) {
		corners += size[i];
		b->m.counts.polygons += size[i] > 3;
	}
	if (n == 0)
		return;
	MR_RESERVE(b->ctx, b->corner, b->corners, corners, &b->corner_room);
	memcpy(b->corner + b->corners, corner, corners * sizeof *corner);
	keep_places(b, &b->corner_uv, &b->uv_room, uv, corners);
	keep_places(b, &b->corner_vn, &b->vn_room, vn, corners);
	for (size_t i = 0; i < n; i++)
		mark_face(b, size[i]);
}

void
mr_build_face(mr_builder *b, const uint32_t *corner, const uint32_t *uv, const uint32_t *vn, size_t n)
{
	if (n < 3)
		b->skipped++;
	else
		mr_build_faces(b, &(uint32_t){ (uint32_t)n }, 1, corner, uv, vn);
}

/* ---- names ---- */

size_t
mr_clean_name(char *to, const char *from, size_t bytes, bool no_slash)
{
	const unsigned char *s = (const unsigned char *)from;
	size_t n = 0, step;
	uint32_t code;

	for (size_t i = 0; i < bytes; i += step ? step : 1) {
		step = mr_utf8(s + i, bytes - i, &code);
		if (step == 0 || mr_is_control(code) || (no_slash && code == '/')) {
			to[n++] = '_';
		} else {
			memcpy(to + n, from + i, step);
			n += step;
		}
	}
	to[n] = 0;
	return n;
}

const char *
mr_clean_copy(mr_ctx *ctx, const char *from, size_t bytes)
{
	char *to = mr_alloc(ctx, bytes + 1, 1);

	mr_clean_name(to, from, bytes, false);
	return to;
}

/* The mark of faces that have none. */
static const char *
unmarked(const mr_builder *b, mr_marking what)
{
	return what == MR_GROUP && b->ungrouped ? b->ungrouped : "";
}

/* The faces so far are not marked, for which there is a name, too. */
static void
start_marks(mr_builder *b, mr_marking what)
{
	const char *none = unmarked(b, what);
	mr_marks *k = &b->marks[what];

	if (k->used)
		return;
	MR_RESERVE(b->ctx, k->of, 0, b->corner_room / 3 + b->faces + 64, &k->room);
	if (b->faces) {
		if (what != MR_SMOOTHING)
			k->current = mr_name_number(b->ctx, &k->names, none, strlen(none));
		memset(k->of, 0, b->faces * sizeof *k->of);
	}
	k->used = true;
	b->plain = false;
}

/* The name without blanks around it; if nothing is left, the name of faces without a mark. */
static mr_lines
bare_name(const mr_builder *b, mr_marking what, const char *name, size_t bytes)
{
	while (bytes && (unsigned char)*name <= ' ')
		name++, bytes--;
	while (bytes && (unsigned char)name[bytes - 1] <= ' ')
		bytes--;
	if (bytes == 0) {
		name = unmarked(b, what);
		bytes = strlen(name);
	}
	return (mr_lines){ name, bytes };
}

/* The number of a cleaned name; `own`: a new one in any case. */
static uint32_t
number_of(mr_builder *b, mr_name_table *names, mr_lines bare, bool own)
{
	size_t bytes;

	MR_RESERVE(b->ctx, b->clean, 0, bare.bytes + 1, &b->clean_room);
	bytes = mr_clean_name(b->clean, bare.text, bare.bytes, false);
	return own ? mr_name_add(b->ctx, names, b->clean, bytes)
	           : mr_name_number(b->ctx, names, b->clean, bytes);
}

void
mr_build_library(mr_builder *b, const char *name, size_t bytes)
{
	mr_lines bare = bare_name(b, MR_MATERIAL, name, bytes);

	if (bare.bytes)
		number_of(b, &b->libraries, bare, false);
}

void
mr_build_mark(mr_builder *b, mr_marking what, const char *name, size_t bytes, bool own)
{
	start_marks(b, what);
	b->marks[what].current = number_of(b, &b->marks[what].names, bare_name(b, what, name, bytes), own);
}

void
mr_build_smoothing(mr_builder *b, uint32_t group)
{
	start_marks(b, MR_SMOOTHING);
	b->marks[MR_SMOOTHING].current = group;
}

/* ---- properties ---- */

/* One as it is read: numbers, whatever its type is to be. */
typedef struct mr_kept {
	mr_property p;
	double *x;
	size_t rows, room;
} mr_kept;

size_t
mr_build_property(mr_builder *b, const char *name, const char *type, char element)
{
	bool byte = !strcmp(type, "uchar"), whole = !strcmp(type, "ushort") || !strcmp(type, "uint");
	mr_shape shape = { element, byte ? 'b' : whole ? 'u' : 'd', 1 };
	char *own = mr_format(b->ctx, "%s", name);

	for (char *c = own; *c; c++) /* a name is a word of a PLY's header */
		if (*c == ' ')
			*c = '_';
	MR_RESERVE(b->ctx, b->kept, b->properties, 1, &b->property_room);
	b->kept[b->properties++] = (mr_kept){ .p = { .name = own, .shape = shape } };
	return b->properties;
}

/* Rows below n that no value has come for, of faces that another element names, are 0. */
static void
fill_rows(mr_builder *b, mr_kept *k, size_t n)
{
	if (k->rows >= n)
		return;
	MR_RESERVE(b->ctx, k->x, k->rows, n - k->rows, &k->room);
	for (; k->rows < n; k->rows++)
		k->x[k->rows] = 0;
}

void
mr_build_value(mr_builder *b, size_t number, size_t row, double x)
{
	mr_kept *k = &b->kept[number - 1];

	fill_rows(b, k, row + 1);
	k->x[row] = x;
}

/* x[of[i]] for rows of `size` bytes. */
static void *
gather(mr_ctx *ctx, const void *x, size_t size, const uint32_t *of, size_t n)
{
	const char *old = x;
	char *new = mr_alloc(ctx, n, size);

	for (size_t i = 0; i < n; i++)
		memcpy(new + i *size, old + of[i] * size, size);
	return new;
}

/* Values of a type: doubles where one is not of it. */
static const void *
narrow(mr_ctx *ctx, const double *x, size_t n, mr_shape *shape)
{
	const double most = shape->type == 'b' ? 255.0 : 4294967295.0;
	unsigned char *byte;
	uint32_t *whole;

	for (size_t i = 0; i < n; i++)
		if (!(x[i] >= 0 && x[i] <= most && x[i] == floor(x[i])))
			shape->type = 'd';
	if (shape->type == 'd')
		return x;
	byte = mr_alloc(ctx, n, mr_type_size(shape->type));
	whole = (uint32_t *)(void *)byte;
	for (size_t i = 0; i < n; i++)
		if (shape->type == 'b')
			byte[i] = (unsigned char)x[i];
		else
			whole[i] = (uint32_t)x[i];
	return byte;
}

/* The values of triangles where faces have several: `face` of each. */
static void
put_properties(mr_builder *b, const uint32_t *face)
{
	mr_model *m = &b->m;
	mr_property *property = MR_NEW(b->ctx, b->properties, mr_property);

	for (size_t i = 0; i < b->properties; i++) {
		mr_kept *k = &b->kept[i];
		bool of_faces = k->p.shape.element == 'f';
		mr_property *p = &property[m->properties];
		const double *x;
		if (of_faces && m->nf == 0)
			continue;
		fill_rows(b, k, of_faces ? b->faces : m->nv);
		x = of_faces && face ? gather(b->ctx, k->x, sizeof *x, face, m->nf) : k->x;
		*p = k->p;
		p->data = narrow(b->ctx, x, of_faces ? m->nf : m->nv, &p->shape);
		m->properties++;
	}
	m->property = property;
}

/* ---- attributes ---- */

bool
mr_left_out(mr_ctx *ctx, size_t odd, size_t n, const char *what)
{
	mr_lost(ctx, NULL, odd, what);
	return odd < n || n == 0;
}

bool
mr_all_left(mr_ctx *ctx, size_t odd, size_t n, const char *what)
{
	mr_lost(ctx, NULL, odd ? n : 0, what);
	return odd == 0;
}

bool
mr_normals_left(mr_ctx *ctx, mr_v3 *normal, size_t n)
{
	size_t odd = 0;

	for (size_t i = 0; i < n; i++)
		if (!mr_finite(normal[i])) {
			normal[i] = mr_vec(0, 0, 0);
			odd++;
		}
	return mr_left_out(ctx, odd, n, "normals");
}

double
mr_shade_full(const mr_shades *s)
{
	if (s->most <= 1 || (s->broken && s->most <= 2))
		return 1;
	return s->most <= 255.255 ? 255 : 65535;
}

void
mr_shades_said(mr_ctx *ctx, const mr_shades *s)
{
	const double dark = 4096; /* of 65535: 12 bits, or 8 with a value too large */

	if (s->full == 65535 && s->most > 0 && s->most < dark)
		mr_tell(
		    ctx, MR_GUESSED, 1, "colors up to %g are read as parts of 65535: nearly black", s->most);
	else
		mr_tell(ctx, MR_ROUNDED, s->rounded, "values of colors");
}

/* Whether a value of `width` doubles is none. */
static bool
is_absent(const double *x, size_t width)
{
	return isnan(x[0] + x[1]) || (width == 3 && x[0] == 0 && x[1] == 0 && x[2] == 0);
}

void
mr_number_rows(
    mr_ctx *ctx, const double *x, size_t width, size_t n, uint32_t *number, uint32_t *first, size_t *count)
{
	size_t mask = 64, bytes = width * sizeof *x;
	MR_SCOPE(ctx);
	uint32_t *slot, used = 0; /* number + 1 */

	while (mask < n + n / 2)
		mask *= 2;
	slot = MR_NEW_ZERO(ctx, mask--, uint32_t);
	for (size_t i = 0; i < n; i++) {
		size_t at = mr_hash_reals(x + width * i, width) & mask;
		number[i] = MR_NONE;
		if (is_absent(x + width * i, width))
			continue;
		while (slot[at] && memcmp(x + width * i, x + width * first[slot[at] - 1], bytes))
			at = (at + 1) & mask;
		if (slot[at] == 0) {
			first[used] = (uint32_t)i;
			slot[at] = ++used;
		}
		number[i] = slot[at] - 1;
	}
	*count = used;
}

/* The values of vertices if all corners of each vertex have the same value, to the bit; else NULL.  Vertices
 * of no face get zeros. */
static const double *
of_vertices(mr_builder *b, size_t width, const double *corner, size_t *seams)
{
	enum { NEW, ONE, SEVERAL };
	const mr_model *m = &b->m;
	double *value = MR_NEW_ZERO(b->ctx, width * m->nv, double);
	unsigned char *seen = MR_NEW_ZERO(b->ctx, m->nv, unsigned char);
	bool whole = true;

	for (size_t i = 0; i < 3 * m->nf; i++) {
		size_t v = m->t[i / 3].v[i % 3];
		const double *x = corner + width * i;
		if (is_absent(x, width))
			whole = false;
		else if (seen[v] == NEW) {
			memcpy(value + width * v, x, width * sizeof *x);
			seen[v] = ONE;
		} else if (seen[v] == ONE && memcmp(value + width * v, x, width * sizeof *x)) {
			seen[v] = SEVERAL;
			++*seams;
		}
	}
	return whole && *seams == 0 ? value : NULL;
}

/* The values of corners that stand at `place` of a list: as values of vertices, or else of corners. */
static void
put_values(mr_builder *b, const uint32_t *place, size_t width, const double *list, double none,
    const double **vertex, const double **corner, size_t *seams)
{
	size_t n = 3 * b->m.nf;
	double *x = MR_NEW(b->ctx, width * n, double);

	for (size_t i = 0; i < n; i++)
		for (size_t k = 0; k < width; k++)
			x[width * i + k] = place[i] == MR_NONE ? none : list[width * place[i] + k];
	*vertex = of_vertices(b, width, x, seams);
	*corner = *vertex ? NULL : x;
}

/* Texture coordinates of corners have precedence over vertices' own. */
static void
put_texcoords(mr_builder *b, const uint32_t *place)
{
	mr_model *m = &b->m;
	const double *before = m->texcoord, *now;

	put_values(b, place, 2, b->uv, NAN, &now, &m->corner_texcoord, &m->counts.seam_vertices);
	if (before && (!now || memcmp(now, before, 2 * m->nv * sizeof *now)))
		mr_lost(b->ctx, NULL, m->nv, "texture coordinates of vertices");
	m->texcoord = now;
}

static void
put_normals(mr_builder *b, const uint32_t *place)
{
	const double *vertex, *corner;

	put_values(b, place, 3, &b->vn->x, 0, &vertex, &corner, &b->m.counts.crease_vertices);
	b->m.normal = (const mr_v3 *)vertex;
	b->m.corner_normal = (const mr_v3 *)corner;
}

/* ---- faces to triangles ---- */

/* The triangles that the faces become. */
typedef struct triangles {
	mr_tri *t;
	uint32_t *face;  /* of each, the face that it is a part of */
	uint32_t *place; /* of each corner, its number among the corners of all faces */
	size_t n;
} triangles;

static bool
is_proper(const uint32_t *c, const uint32_t *v)
{
	return c[v[0]] != c[v[1]] && c[v[1]] != c[v[2]] && c[v[2]] != c[v[0]];
}

/* Triangles of a polygon, but those that name a vertex twice; of a triangle as the file has it. */
static void
add_face(mr_builder *b, triangles *r, mr_tri *room, size_t face, size_t first)
{
	static const mr_tri whole = { { 0, 1, 2 } };
	const uint32_t *c = b->corner + first;
	size_t n = b->size[face];

	if (n == 3)
		room[0] = whole;
	else
		mr_polygon_triangulate(b->ctx, b->m.p, c, n, room);
	for (size_t i = 0; i < n - 2; i++) {
		const uint32_t *v = room[i].v;
		if (n > 3 && !is_proper(c, v))
			continue;
		r->t[r->n] = (mr_tri){ { c[v[0]], c[v[1]], c[v[2]] } };
		for (size_t k = 0; k < 3; k++)
			r->place[3 * r->n + k] = (uint32_t)(first + v[k]);
		r->face[r->n++] = (uint32_t)face;
	}
}

static mr_status
triangulate(mr_builder *b, triangles *r)
{
	size_t total = b->corners - 2 * b->faces, most = 0, first = 0;
	mr_tri *room;

	if (total > MOST_TRIANGLES)
		return mr_fail(b->ctx, MR_ERANGE, "%zu triangles are more than indices can name", total);
	for (size_t f = 0; f < b->faces; f++)
		most = b->size[f] > most ? b->size[f] : most;
	*r = (triangles){ .t = MR_NEW(b->ctx, total, mr_tri),
		.face = MR_NEW(b->ctx, total, uint32_t),
		.place = MR_NEW(b->ctx, 3 * total, uint32_t) };
	room = MR_NEW(b->ctx, most, mr_tri);
	for (size_t f = 0; f < b->faces; first += b->size[f++]) {
		size_t before = r->n;
		add_face(b, r, room, f, first);
		b->skipped += r->n == before;
	}
	return r->n ? MR_OK
	            : mr_fail(b->ctx, MR_EMESH, "none of the %zu faces has a triangle of three vertices",
			  b->faces);
}

/* The numbers of the polygons, without those that have no triangle. */
static const uint32_t *
number_polygons(mr_builder *b, const triangles *r)
{
	uint32_t *number = MR_NEW(b->ctx, r->n, uint32_t), next = 0;

	for (size_t f = 0; f < r->n; f++)
		number[f] = f > 0 && r->face[f] == r->face[f - 1] ? next - 1 : next++;
	return number;
}

static mr_lines
lines_of(const mr_name_table *names)
{
	return names->bytes ? (mr_lines){ names->text, names->bytes - 1 } : (mr_lines){ NULL, 0 };
}

/* Gives each triangle the marks of its face. */
static void
put_marks(mr_builder *b, const uint32_t *face)
{
	mr_model *m = &b->m;
	const uint32_t **of[MR_MARKINGS] = { &m->group, &m->object, &m->material, &m->smoothing };
	mr_lines *names[MR_MARKINGS] = { &m->groups, &m->objects, &m->materials, NULL };

	for (int i = 0; i < MR_MARKINGS; i++) {
		const mr_marks *k = &b->marks[i];
		if (!k->used)
			continue;
		*of[i] = face ? gather(b->ctx, k->of, sizeof *k->of, face, m->nf) : k->of;
		if (names[i])
			*names[i] = lines_of(&k->names);
	}
	m->mtllib = lines_of(&b->libraries);
}

/* Triangles, with what the faces and their corners have. */
static mr_status
put_faces(mr_builder *b, triangles *r)
{
	const uint32_t *uv = b->corner_uv, *vn = b->corner_vn;
	mr_model *m = &b->m;

	m->t = (const mr_tri *)b->corner; /* three indices each */
	m->nf = b->faces;
	if (b->size) {
		MR_TRY(triangulate(b, r));
		m->t = r->t;
		m->nf = r->n;
		m->polygon = number_polygons(b, r);
		if (uv)
			uv = gather(b->ctx, uv, sizeof *uv, r->place, 3 * r->n);
		if (vn)
			vn = gather(b->ctx, vn, sizeof *vn, r->place, 3 * r->n);
	}
	put_marks(b, r->face);
	if (uv)
		put_texcoords(b, uv);
	if (vn)
		put_normals(b, vn);
	return MR_OK;
}

mr_status
mr_build_finish(mr_builder *b, mr_model *m)
{
	triangles r = { 0 };

	if (b->faces == 0 && b->skipped)
		return mr_fail(b->ctx, MR_EMESH, "none of the %zu faces has three corners", b->skipped);
	if (b->faces)
		MR_TRY(put_faces(b, &r));
	put_properties(b, r.face);
	mr_lost(b->ctx, NULL, b->skipped, "faces without three corners");
	*m = b->m;
	return MR_OK;
}
