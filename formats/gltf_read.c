/*
 * glTF 2.0, read: the meshes of the scene as one model.  What glTF must repeat where a seam of normals or
 * texture coordinates runs is one vertex again: within a mesh, vertices at the same place are joined, or
 * those of one number where the file numbers them, and what their corners have is the corners'.
 */
#include "formats/gltf.h"
#include "mesh/repair.h"

/* How a primitive makes faces of its vertices. */
enum { POINTS = 0, LINE_STRIP = 3, TRIANGLES = 4, STRIP = 5, FAN = 6 };

/* What a mesh of the scene has of the vertices. */
typedef struct instance {
	const mr_gltf_instance *of;
	size_t first, last;
	bool faces;    /* it has some */
	bool numbered; /* its vertices are */
} instance;

/* The accessors of a primitive's vertices, and the material that moves the coordinates; MR_UNKNOWN: none. */
typedef struct sources {
	size_t position, normal, texcoord, color, number, mover;
} sources;

/* A primitive of an instance. */
typedef struct part {
	size_t instance;
	sources from;
	size_t first, count; /* its vertices */
	bool own;            /* that no part before it has read */
	size_t mode, indices, corners, material;
} part;

typedef struct gltf_reader {
	mr_gltf g;
	instance *instance;
	part *part;
	size_t instances, parts, part_room;
	size_t n, nf;         /* vertices as the file has them; faces, at most while they are not yet read */
	mr_v3 *p, *normal;    /* n; zero: none */
	double *uv;           /* 2 n; NaN: none */
	size_t uvs, odd_uv;   /* as the file has them; not finite */
	unsigned char *color; /* 4 n */
	mr_shades shades;     /* of 1 */
	size_t odd_colors;    /* of vertices, with a NaN */
	uint32_t *number;     /* n; MR_NONE: none */
	uint32_t *join;       /* n: the vertex of the model */
	mr_tri *t, *joined;   /* nf, of vertices as the file has them, and of the model's */
	uint32_t *object, *material;
	const char *packed; /* the extension that holds the primitive at hand; NULL: none */
	mr_gltf_left left;
	mr_model *m;
} gltf_reader;

/* ---- the primitives of the scene ---- */

static mr_status
find_instances(gltf_reader *r)
{
	const mr_gltf_instance *list;

	MR_TRY(mr_gltf_scene(&r->g, &list, &r->instances, &r->left.unseen, &r->left.several));
	r->instance = MR_NEW_ZERO(r->g.ctx, r->instances, instance);
	if (!r->instance)
		return MR_EMEM;
	for (size_t i = 0; i < r->instances; i++)
		r->instance[i].of = &list[i];
	return MR_OK;
}

static size_t
faces_of(size_t mode, size_t corners)
{
	return mode == TRIANGLES ? corners / 3 : mode >= STRIP && corners > 2 ? corners - 2 : 0;
}

static mr_status
find_sources(gltf_reader *r, const json_t *attributes, const char *texcoord, sources *s)
{
	const mr_gltf *g = &r->g;

	MR_TRY(mr_gltf_index(g, attributes, "POSITION", "accessors", &s->position));
	MR_TRY(mr_gltf_index(g, attributes, "NORMAL", "accessors", &s->normal));
	MR_TRY(mr_gltf_index(g, attributes, texcoord, "accessors", &s->texcoord));
	MR_TRY(mr_gltf_index(g, attributes, "COLOR_0", "accessors", &s->color));
	return mr_gltf_vertex_numbers(g, attributes, &s->number);
}

/* The attributes that are read: of the coordinates those of the colour's picture, or the first ones. */
static mr_status
find_attributes(gltf_reader *r, const json_t *json, part *p)
{
	json_t *attributes = json_object_get(json, "attributes");
	mr_gltf_texture t = { 0 };
	char texcoord[32];

	MR_TRY(mr_gltf_texture_of(&r->g, p->material, &t));
	snprintf(texcoord, sizeof texcoord, "TEXCOORD_%zu", t.set);
	if (!json_object_get(attributes, texcoord)) {
		snprintf(texcoord, sizeof texcoord, "TEXCOORD_0");
		t.moves = false;
	}
	p->from.mover = t.moves ? p->material : MR_UNKNOWN;
	MR_TRY(find_sources(r, attributes, texcoord, &p->from));
	return p->from.position == MR_UNKNOWN
	           ? MR_OK
	           : mr_gltf_note_attributes(&r->g, attributes, texcoord, &r->left);
}

/* The extension that holds what a primitive has, in a view of its own; NULL: none. */
static const char *
packed_by(const json_t *primitive)
{
	const char *name;
	json_t *value;

	json_object_foreach(json_object_get(primitive, "extensions"), name,
	    value) if (json_object_get(value, "bufferView")) return name;
	return NULL;
}

/* The number of rows of an accessor whose values a column of `width` is made of. */
static mr_status
count_rows(gltf_reader *r, size_t accessor, size_t width, size_t *rows)
{
	mr_accessor a;

	MR_TRY(mr_accessor_open(&r->g, accessor, &a));
	if (!a.data && r->packed)
		return mr_gltf_needs(&r->g, r->packed);
	if (!a.data)
		return mr_fail(r->g.ctx, MR_EFORMAT, "accessor %zu has no buffer view", accessor);
	if (a.components < width || (width < 3 && a.components != width))
		return mr_fail(r->g.ctx, MR_EFORMAT, "accessor %zu has rows of %zu numbers, not %zu",
		    accessor, a.components, width);
	if (*rows != MR_UNKNOWN && a.count != *rows)
		return mr_fail(
		    r->g.ctx, MR_EFORMAT, "accessor %zu has %zu rows, not %zu", accessor, a.count, *rows);
	*rows = a.count;
	return MR_OK;
}

static mr_status
count_vertices(gltf_reader *r, part *p)
{
	const part *before = r->parts ? &r->part[r->parts - 1] : NULL;

	p->count = MR_UNKNOWN;
	p->first = r->n;
	p->own = true;
	MR_TRY(count_rows(r, p->from.position, 3, &p->count));
	if (p->from.normal != MR_UNKNOWN)
		MR_TRY(count_rows(r, p->from.normal, 3, &p->count));
	if (p->from.texcoord != MR_UNKNOWN)
		MR_TRY(count_rows(r, p->from.texcoord, 2, &p->count));
	if (p->from.color != MR_UNKNOWN)
		MR_TRY(count_rows(r, p->from.color, 3, &p->count));
	if (p->from.number != MR_UNKNOWN)
		MR_TRY(count_rows(r, p->from.number, 2, &p->count));
	if (before && before->instance == p->instance && !memcmp(&before->from, &p->from, sizeof p->from)) {
		p->first = before->first;
		p->own = false;
	}
	return MR_OK;
}

static mr_status
count_corners(gltf_reader *r, part *p)
{
	size_t corners = p->count;

	if (p->indices != MR_UNKNOWN) {
		corners = MR_UNKNOWN;
		MR_TRY(count_rows(r, p->indices, 1, &corners));
	}
	if (p->mode == TRIANGLES && corners % 3)
		return mr_fail(r->g.ctx, MR_EFORMAT, "triangles of %zu corners", corners);
	p->corners = corners;
	return MR_OK;
}

static mr_status
read_primitive(gltf_reader *r, const json_t *json, size_t number)
{
	instance *i = &r->instance[number];
	part p = { .instance = number };

	MR_TRY(mr_gltf_count(&r->g, json, "mode", TRIANGLES, FAN, &p.mode));
	r->left.targets += json_array_size(json_object_get(json, "targets"));
	if (p.mode != POINTS && p.mode <= LINE_STRIP) {
		r->left.lines++;
		return MR_OK;
	}
	MR_TRY(mr_gltf_index(&r->g, json, "indices", "accessors", &p.indices));
	MR_TRY(mr_gltf_index(&r->g, json, "material", "materials", &p.material));
	MR_TRY(find_attributes(r, json, &p));
	r->packed = packed_by(json);
	if (p.from.position == MR_UNKNOWN) /* by the specification there is nothing to draw */
		return MR_OK;
	MR_TRY(count_vertices(r, &p));
	MR_TRY(count_corners(r, &p));
	if (p.own)
		r->n += p.count;
	r->nf += faces_of(p.mode, p.corners);
	i->faces |= p.mode != POINTS;
	i->numbered &= p.from.number != MR_UNKNOWN;
	i->last = r->n;
	if (r->n >= MR_NONE || r->nf > (MR_NONE - 1) / 3)
		return mr_fail(r->g.ctx, MR_ERANGE,
		    "%zu vertices and %zu faces are more than indices can name", r->n, r->nf);
	MR_TRY(MR_RESERVE(r->g.ctx, r->part, r->parts, 1, &r->part_room));
	r->part[r->parts++] = p;
	return MR_OK;
}

static mr_status
find_parts(gltf_reader *r)
{
	for (size_t i = 0; i < r->instances; i++) {
		size_t mesh = r->instance[i].of->mesh;
		json_t *list = json_object_get(mr_gltf_at(&r->g, "meshes", mesh), "primitives");
		r->instance[i].first = r->instance[i].last = r->n;
		r->instance[i].numbered = true;
		for (size_t k = 0; k < json_array_size(list); k++)
			MR_TRY(mr_prefix(r->g.ctx, read_primitive(r, json_array_get(list, k), i),
			    "mesh %zu, primitive %zu", mesh, k));
	}
	return MR_OK;
}

/* ---- vertices as the file has them ---- */

static mr_v3
row(const mr_affine *a, int i)
{
	return mr_vec(a->m[4 * i], a->m[4 * i + 1], a->m[4 * i + 2]);
}

static double
determinant(const mr_affine *a)
{
	return mr_dot(row(a, 0), mr_cross(row(a, 1), row(a, 2)));
}

/* A normal goes with the cofactors, which turn it over where the map mirrors: the faces are turned over
 * there, so that it is turned back. */
static mr_v3
apply_to_normal(const mr_affine *a, mr_v3 n)
{
	mr_v3 x = mr_cross(row(a, 1), row(a, 2)), y = mr_cross(row(a, 2), row(a, 0)),
	      z = mr_cross(row(a, 0), row(a, 1));
	mr_v3 turned = mr_unit(mr_vec(mr_dot(x, n), mr_dot(y, n), mr_dot(z, n)));

	return determinant(a) < 0 ? mr_mul(-1, turned) : turned;
}

static mr_status
read_positions(gltf_reader *r, const part *p, const mr_accessor *a)
{
	const mr_affine *map = &r->instance[p->instance].of->map;
	bool moves = !mr_is_identity(map);

	mr_accessor_reals(a, 3, &r->p[p->first].x);
	for (size_t i = 0; i < p->count; i++) {
		mr_v3 *x = &r->p[p->first + i];
		if (moves)
			*x = mr_apply(map, *x);
		if (!mr_finite(*x))
			return mr_fail(
			    r->g.ctx, MR_EFORMAT, "accessor %zu: position %zu is not finite", a->number, i);
	}
	return MR_OK;
}

static mr_status
read_normals(gltf_reader *r, const part *p, const mr_accessor *a)
{
	const mr_affine *map = &r->instance[p->instance].of->map;
	bool moves = !mr_is_identity(map);

	mr_accessor_reals(a, 3, &r->normal[p->first].x);
	for (size_t i = 0; i < p->count; i++) {
		mr_v3 *n = &r->normal[p->first + i];
		if (moves && mr_finite(*n))
			*n = apply_to_normal(map, *n);
	}
	return MR_OK;
}

static void
move(const mr_gltf_texture *t, double *uv)
{
	double u = uv[0], v = uv[1];

	uv[0] = t->map[0] * u + t->map[1] * v + t->map[2];
	uv[1] = t->map[3] * u + t->map[4] * v + t->map[5];
}

/* v runs down the picture in glTF, up in OBJ. */
static mr_status
read_texcoords(gltf_reader *r, const part *p, const mr_accessor *a)
{
	double *uv = r->uv + 2 * p->first;
	mr_gltf_texture t = { 0 };

	MR_TRY(mr_gltf_texture_of(&r->g, p->from.mover, &t));
	mr_accessor_reals(a, 2, uv);
	for (size_t i = 0; i < p->count; i++) {
		if (t.moves)
			move(&t, uv + 2 * i);
		uv[2 * i + 1] = 1 - uv[2 * i + 1];
		if (!isfinite(uv[2 * i]) || !isfinite(uv[2 * i + 1])) {
			uv[2 * i] = uv[2 * i + 1] = NAN;
			r->odd_uv++;
		}
	}
	r->uvs += p->count;
	return MR_OK;
}

/* Colours are linear there. */
static mr_status
read_colors(gltf_reader *r, const part *p, const mr_accessor *a)
{
	mr_mark mark = mr_mark_take(r->g.ctx);
	double *x = MR_NEW(r->g.ctx, 4 * p->count, double);

	if (!x)
		return MR_EMEM;
	for (size_t i = 0; i < p->count; i++)
		x[4 * i + 3] = 1;
	mr_accessor_reals(a, 4, x);
	for (size_t i = 0; i < p->count; i++) {
		const double *c = x + 4 * i;
		r->odd_colors += isnan(c[0] + c[1] + c[2] + c[3]) ? 1 : 0;
		for (size_t k = 0; k < 4; k++)
			r->color[4 * (p->first + i) + k] = mr_shade_byte(
			    &r->shades, k == 3 ? c[k] : mr_linear_to_srgb(c[k]));
	}
	mr_mark_release(r->g.ctx, mark);
	return MR_OK;
}

static mr_status
read_numbers(gltf_reader *r, const part *p, const mr_accessor *a)
{
	mr_mark mark = mr_mark_take(r->g.ctx);
	double *x = MR_NEW(r->g.ctx, 2 * p->count, double);

	if (!x)
		return MR_EMEM;
	mr_accessor_reals(a, 2, x);
	for (size_t i = 0; i < p->count; i++) {
		double number = x[2 * i] + 65536 * x[2 * i + 1];
		r->number[p->first + i] = number >= 0 && number < MR_NONE ? (uint32_t)number : MR_NONE;
	}
	mr_mark_release(r->g.ctx, mark);
	return MR_OK;
}

static mr_status
read_column(gltf_reader *r, const part *p, size_t accessor,
    mr_status (*read)(gltf_reader *r, const part *p, const mr_accessor *a))
{
	mr_accessor a;

	if (accessor == MR_UNKNOWN)
		return MR_OK;
	MR_TRY(mr_accessor_open(&r->g, accessor, &a));
	return read(r, p, &a);
}

/* What some parts have, the others have not yet. */
static mr_status
make_columns(gltf_reader *r)
{
	mr_ctx *ctx = r->g.ctx;
	bool normal = false, texcoord = false, color = false;

	for (size_t i = 0; i < r->parts; i++) {
		normal |= r->part[i].from.normal != MR_UNKNOWN;
		texcoord |= r->part[i].from.texcoord != MR_UNKNOWN;
		color |= r->part[i].from.color != MR_UNKNOWN;
	}
	r->p = MR_NEW(ctx, r->n, mr_v3);
	r->join = MR_NEW(ctx, r->n, uint32_t);
	r->number = MR_NEW(ctx, r->n, uint32_t);
	if (!r->p || !r->join || !r->number || (normal && !(r->normal = MR_NEW_ZERO(ctx, r->n, mr_v3))) ||
	    (texcoord && !(r->uv = MR_NEW(ctx, 2 * r->n, double))) ||
	    (color && !(r->color = MR_NEW(ctx, 4 * r->n, unsigned char))))
		return MR_EMEM;
	for (size_t i = 0; texcoord && i < 2 * r->n; i++)
		r->uv[i] = NAN;
	for (size_t i = 0; i < r->n; i++)
		r->number[i] = MR_NONE;
	if (color)
		memset(r->color, 255, 4 * r->n);
	return MR_OK;
}

static mr_status
read_vertices(gltf_reader *r)
{
	MR_TRY(make_columns(r));
	for (size_t i = 0; i < r->parts; i++) {
		const part *p = &r->part[i];
		if (!p->own)
			continue;
		MR_TRY(read_column(r, p, p->from.position, read_positions));
		MR_TRY(read_column(r, p, p->from.normal, read_normals));
		MR_TRY(read_column(r, p, p->from.texcoord, read_texcoords));
		MR_TRY(read_column(r, p, p->from.color, read_colors));
		if (r->instance[p->instance].numbered)
			MR_TRY(read_column(r, p, p->from.number, read_numbers));
	}
	return MR_OK;
}

/* ---- faces ---- */

/* Face k of corners in a row. */
static mr_tri
face_of(size_t mode, const uint32_t *c, size_t k)
{
	if (mode == FAN)
		return (mr_tri){ { c[k + 1], c[k + 2], c[0] } };
	if (mode == STRIP)
		return (mr_tri){ { c[k], c[k + 1 + k % 2], c[k + 2 - k % 2] } };
	return (mr_tri){ { c[3 * k], c[3 * k + 1], c[3 * k + 2] } };
}

static bool
repeats(mr_tri t)
{
	return t.v[0] == t.v[1] || t.v[1] == t.v[2] || t.v[2] == t.v[0];
}

static void
add_face(gltf_reader *r, const part *p, mr_tri t, bool turned)
{
	uint32_t first = (uint32_t)p->first;

	r->t[r->nf] = (mr_tri){ { first + t.v[0], first + t.v[turned ? 2 : 1],
	    first + t.v[turned ? 1 : 2] } };
	if (r->object)
		r->object[r->nf] = (uint32_t)p->instance;
	if (r->material)
		r->material[r->nf] = (uint32_t)(p->material != MR_UNKNOWN ? p->material
									  : mr_gltf_size(&r->g, "materials"));
	r->nf++;
}

static mr_status
read_part_faces(gltf_reader *r, const part *p)
{
	mr_mark mark = mr_mark_take(r->g.ctx);
	uint32_t *corner = MR_NEW(r->g.ctx, p->corners, uint32_t);
	bool turned = determinant(&r->instance[p->instance].of->map) < 0;
	mr_accessor a;

	if (!corner)
		return MR_EMEM;
	for (size_t i = 0; i < p->corners && p->indices == MR_UNKNOWN; i++)
		corner[i] = (uint32_t)i;
	if (p->indices != MR_UNKNOWN) {
		MR_TRY(mr_accessor_open(&r->g, p->indices, &a));
		MR_TRY(mr_accessor_indices(&r->g, &a, p->count, corner));
	}
	for (size_t k = 0; k < faces_of(p->mode, p->corners); k++) {
		mr_tri t = face_of(p->mode, corner, k);
		if (p->mode == TRIANGLES || !repeats(t)) /* a strip goes on elsewhere by such faces */
			add_face(r, p, t, turned);
	}
	mr_mark_release(r->g.ctx, mark);
	return MR_OK;
}

/* Faces have objects where these have names or are several, and materials where there are any. */
static mr_status
read_faces(gltf_reader *r)
{
	mr_ctx *ctx = r->g.ctx;
	bool objects = r->instances > 1 || (r->instances == 1 && r->instance[0].of->name);
	size_t n = mr_gltf_size(&r->g, "materials");
	bool materials = n > 1 || (n == 1 && mr_gltf_name(mr_gltf_at(&r->g, "materials", 0)));

	r->t = MR_NEW(ctx, r->nf, mr_tri);
	if (!r->t || (objects && !(r->object = MR_NEW(ctx, r->nf, uint32_t))) ||
	    (materials && !(r->material = MR_NEW(ctx, r->nf, uint32_t))))
		return MR_EMEM;
	r->nf = 0;
	for (size_t i = 0; i < r->parts; i++)
		if (r->part[i].mode != POINTS)
			MR_TRY(read_part_faces(r, &r->part[i]));
	return MR_OK;
}

/* ---- vertices as the model has them ---- */

static mr_status
join_faces(gltf_reader *r)
{
	r->joined = MR_NEW(r->g.ctx, r->nf, mr_tri);
	if (!r->joined)
		return MR_EMEM;
	for (size_t c = 0; c < 3 * r->nf; c++)
		r->joined[c / 3].v[c % 3] = r->join[r->t[c / 3].v[c % 3]];
	return MR_OK;
}

static mr_status
join_by_place(gltf_reader *r, const instance *at, size_t *nv)
{
	size_t joined = at->last - at->first;

	for (size_t k = at->first; k < at->last; k++)
		r->join[k] = (uint32_t)(k - at->first);
	if (at->faces)
		MR_TRY(mr_weld(r->g.ctx, r->p + at->first, joined, 0, r->join + at->first, &joined));
	for (size_t k = at->first; k < at->last; k++)
		r->join[k] += (uint32_t)*nv;
	*nv += joined;
	return MR_OK;
}

static bool
same_place(mr_v3 a, mr_v3 b)
{
	return a.x == b.x && a.y == b.y && a.z == b.z;
}

/* In the order of the numbers; what somebody has moved away from others of its number comes behind them. */
static mr_status
join_by_number(gltf_reader *r, size_t *nv)
{
	uint32_t *first = MR_NEW(r->g.ctx, r->n, uint32_t), next = 0;

	if (!first)
		return MR_EMEM;
	for (size_t k = 0; k < r->n; k++)
		first[k] = MR_NONE;
	for (size_t k = r->n; k-- > 0;)
		if (r->number[k] != MR_NONE)
			first[r->number[k]] = (uint32_t)k;
	for (size_t i = 0; i < r->n; i++)
		if (first[i] != MR_NONE)
			r->join[first[i]] = next++;
	for (size_t k = 0; k < r->n; k++) {
		uint32_t other = r->number[k] != MR_NONE ? first[r->number[k]] : (uint32_t)k;
		if (other != k)
			r->join[k] = same_place(r->p[k], r->p[other]) ? r->join[other] : next++;
	}
	*nv = next;
	return MR_OK;
}

/* Numbers are those of a model's vertices, of which the file repeats some: others are another program's. */
static bool
numbers_make_sense(const gltf_reader *r, const instance *at)
{
	for (size_t k = at->first; k < at->last; k++)
		if (r->number[k] >= r->n)
			return false;
	return true;
}

static void
forget_numbers(gltf_reader *r, instance *at)
{
	for (size_t k = at->first; k < at->last; k++)
		r->number[k] = MR_NONE;
	at->numbered = false;
}

/* Joins vertices, and gathers their places. */
static mr_status
join_vertices(gltf_reader *r)
{
	size_t nv = 0;
	mr_v3 *p;

	for (size_t i = 0; i < r->instances; i++)
		if (!numbers_make_sense(r, &r->instance[i]))
			forget_numbers(r, &r->instance[i]);
	MR_TRY(join_by_number(r, &nv));
	for (size_t i = 0; i < r->instances; i++)
		if (!r->instance[i].numbered)
			MR_TRY(join_by_place(r, &r->instance[i], &nv));
	p = MR_NEW(r->g.ctx, nv, mr_v3);
	if (!p)
		return MR_EMEM;
	for (size_t k = r->n; k-- > 0;)
		p[r->join[k]] = r->p[k];
	r->m->p = p;
	r->m->nv = nv;
	return join_faces(r);
}

/* Each vertex has the first colour that it is given. */
static mr_status
join_colors(gltf_reader *r)
{
	unsigned char *color = MR_NEW(r->g.ctx, 4 * r->m->nv, unsigned char);
	size_t several = 0;

	if (!color)
		return MR_EMEM;
	for (size_t k = r->n; k-- > 0;)
		memcpy(color + 4 * (size_t)r->join[k], r->color + 4 * k, 4);
	for (size_t k = 0; k < r->n; k++)
		several += memcmp(color + 4 * (size_t)r->join[k], r->color + 4 * k, 4) != 0;
	mr_lost(r->g.ctx, NULL, several, "colors of joined vertices");
	mr_shades_said(r->g.ctx, &r->shades);
	r->m->color = color;
	return MR_OK;
}

/* What vertices without a face have; where `vertex` is NULL, as corners do not agree, it is lost. */
static mr_status
join_isolated(gltf_reader *r, const double *x, size_t width, double *vertex, const char *what)
{
	size_t lost = 0, count;
	bool *used;

	MR_TRY(mr_vertices_used(r->g.ctx, r->joined, r->nf, r->m->nv, &used, &count));
	for (size_t k = 0; k < r->n; k++) {
		size_t v = r->join[k];
		bool is_own = !used[v] && !mr_is_absent(x + width * k, width);
		lost += is_own && !vertex;
		if (is_own && vertex)
			memcpy(vertex + width * v, x + width * k, width * sizeof *x);
	}
	mr_tell(r->g.ctx, MR_LOST, lost, "%s of isolated vertices", what);
	return MR_OK;
}

/* A column of rows of `width`, of vertices where those of all corners agree, else of corners. */
static mr_status
join_column(gltf_reader *r, const char *what, const double *x, size_t width, const double **of_vertices,
    const double **of_corners, size_t *several)
{
	double *corner = MR_NEW(r->g.ctx, 3 * width * r->nf, double), *vertex;

	if (!corner)
		return MR_EMEM;
	if (r->nf == 0) { /* points are not joined */
		*of_vertices = x;
		return MR_OK;
	}
	for (size_t c = 0; c < 3 * r->nf; c++)
		memcpy(corner + width * c, x + width * r->t[c / 3].v[c % 3], width * sizeof *x);
	MR_TRY(mr_corners_to_vertices(r->g.ctx, r->joined, r->nf, r->m->nv, width, corner, &vertex, several));
	*of_vertices = vertex;
	*of_corners = vertex ? NULL : corner;
	return join_isolated(r, x, width, vertex, what);
}

static mr_status
join_columns(gltf_reader *r)
{
	const double *normal = NULL, *corner_normal = NULL;
	mr_import_result *counts = &r->m->counts;

	if (r->normal && !mr_normals_left(r->g.ctx, r->normal, r->n))
		r->normal = NULL;
	if (!mr_left_out(r->g.ctx, r->odd_uv, r->uvs, "texture coordinates"))
		r->uv = NULL;
	if (!mr_all_left(r->g.ctx, r->odd_colors, r->n, "colors"))
		r->color = NULL;
	if (r->color)
		MR_TRY(join_colors(r));
	if (r->uv)
		MR_TRY(join_column(r, "texture coordinates", r->uv, 2, &r->m->texcoord,
		    &r->m->corner_texcoord, &counts->seam_vertices));
	if (r->normal)
		MR_TRY(join_column(
		    r, "normals", &r->normal->x, 3, &normal, &corner_normal, &counts->crease_vertices));
	r->m->normal = (const mr_v3 *)(const void *)normal;
	r->m->corner_normal = (const mr_v3 *)(const void *)corner_normal;
	return MR_OK;
}

/* ---- names ---- */

/* Names, one a line: within one a tab stands for an end of line, and is warned of. */
static mr_status
add_line(mr_ctx *ctx, const char *name, bool first, mr_lines *l, size_t *room)
{
	char *text = (char *)(size_t)l->text;
	size_t bytes = strlen(name);

	MR_TRY(MR_RESERVE(ctx, text, l->bytes, bytes + 2, room));
	if (!first)
		text[l->bytes++] = '\n';
	for (size_t i = 0; i < bytes; i++)
		text[l->bytes++] = name[i] == '\n' || name[i] == '\r' ? '\t' : name[i];
	l->text = text;
	return MR_OK;
}

/* The names of n things, NULL where they have none: the only one without has an empty name, of several each
 * is called `what` and its number. */
static mr_status
add_lines(mr_ctx *ctx, const char *const *name, size_t n, const char *what, mr_lines *l)
{
	size_t unnamed = 0, room = 0;

	for (size_t i = 0; i < n; i++)
		unnamed += !name[i];
	for (size_t i = 0; i < n; i++) {
		const char *own = name[i] ? name[i] : unnamed == 1 ? "" : mr_format(ctx, "%s%zu", what, i);
		if (!own)
			return MR_EMEM;
		MR_TRY(add_line(ctx, own, i == 0, l, &room));
	}
	return MR_OK;
}

static mr_status
name_objects(gltf_reader *r)
{
	const char **name = MR_NEW(r->g.ctx, r->instances, const char *);

	if (!name)
		return MR_EMEM;
	for (size_t i = 0; i < r->instances; i++)
		name[i] = r->instance[i].of->name;
	return r->object ? add_lines(r->g.ctx, name, r->instances, "mesh", &r->m->objects) : MR_OK;
}

/* An empty name more is that of faces without a material. */
static mr_status
name_materials(gltf_reader *r)
{
	size_t n = mr_gltf_size(&r->g, "materials"), without = 0;
	const char **name = MR_NEW(r->g.ctx, n + 1, const char *);

	if (!name)
		return MR_EMEM;
	if (!r->material)
		return MR_OK;
	for (size_t i = 0; i < n; i++)
		name[i] = mr_gltf_name(mr_gltf_at(&r->g, "materials", i));
	name[n] = "";
	for (size_t f = 0; f < r->nf && !without; f++)
		without = r->material[f] == n;
	return add_lines(r->g.ctx, name, n + without, "material", &r->m->materials);
}

/* ---- the document ---- */

static mr_status
read_document(gltf_reader *r)
{
	MR_TRY(find_instances(r));
	MR_TRY(find_parts(r));
	MR_TRY(read_vertices(r));
	MR_TRY(read_faces(r));
	MR_TRY(join_vertices(r));
	MR_TRY(join_columns(r));
	MR_TRY(name_objects(r));
	MR_TRY(name_materials(r));
	r->m->t = r->nf ? r->joined : NULL;
	r->m->nf = r->nf;
	r->m->object = r->nf ? r->object : NULL;
	r->m->material = r->nf ? r->material : NULL;
	mr_gltf_say_left(&r->g, &r->left);
	return MR_OK;
}

mr_status
mr_gltf_read(mr_ctx *ctx, const unsigned char *data, size_t size, mr_model *m)
{
	mr_model made = { 0 };
	gltf_reader r = { .m = &made, .shades.full = 1 };
	mr_status status;

	MR_TRY(mr_gltf_open(ctx, data, size, &r.g));
	status = read_document(&r);
	mr_gltf_free(&r.g);
	if (status >= 0)
		*m = made;
	return status;
}

bool
mr_glb_sniff(const unsigned char *data, size_t size)
{
	return size >= 4 && mr_load32(data, false) == MR_GLTF_MAGIC;
}

/* No other format begins with a brace. */
bool
mr_gltf_sniff(const unsigned char *data, size_t size)
{
	mr_scan text = mr_scan_of(NULL, data, size);

	mr_skip_space(&text);
	return text.p < text.end && *text.p == '{';
}
