/* glTF 2.0, read (Khronos 2021): the meshes of the scene as one model.  Vertices that the format repeats at
 * seams are joined again within a mesh, and what their corners have is the corners'. */
#include "formats/gltf.h"
#include "formats/materials.h"
#include "mesh/repair.h"

/* ---- the scene: its nodes, from which meshes hang ---- */

/* A mesh where a node puts it. */
typedef struct instance {
	size_t mesh;
	mr_affine map;
	const char *name; /* of the node, or else of the mesh; NULL: none.  The document's */
} instance;

typedef struct instances {
	instance *instance;
	size_t count;
	size_t unseen;  /* nodes with a mesh that the scene does not show */
	size_t several; /* nodes whose mesh EXT_mesh_gpu_instancing shows several times */
} instances;

/* T R S, of a unit quaternion x, y, z, w. */
static mr_affine
from_parts(const double t[3], const double q[4], const double s[3])
{
	double x = q[0], y = q[1], z = q[2], w = q[3];
	const double r[9] = { 1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w),
		2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), 2 * (x * z - y * w),
		2 * (y * z + x * w), 1 - 2 * (x * x + y * y) };
	mr_affine a;

	for (int i = 0; i < 3; i++) {
		for (int j = 0; j < 3; j++)
			a.m[4 * i + j] = r[3 * i + j] * s[j];
		a.m[4 * i + 3] = t[i];
	}
	return a;
}

/* Makes it one of unit length. */
static mr_status
normalize(mr_ctx *ctx, double q[4])
{
	double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);

	if (!isnormal(length))
		return mr_fail(ctx, MR_EFORMAT, "rotation is of length %g, not a unit quaternion", length);
	for (int i = 0; i < 4; i++)
		q[i] /= length;
	return MR_OK;
}

static mr_status
node_map(const mr_gltf *g, const json_t *node, mr_affine *map)
{
	double m[16], t[3] = { 0, 0, 0 }, q[4] = { 0, 0, 0, 1 }, s[3] = { 1, 1, 1 };
	bool there;

	MR_TRY(mr_gltf_numbers(g, node, "matrix", 16, m, &there));
	if (there) { /* by columns */
		for (int i = 0; i < 3; i++)
			for (int j = 0; j < 4; j++)
				map->m[4 * i + j] = m[4 * j + i];
		if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1)
			return mr_fail(g->ctx, MR_EFORMAT,
			    "matrix is not affine: its last row is %g, %g, %g, %g", m[3], m[7], m[11], m[15]);
		return MR_OK;
	}
	MR_TRY(mr_gltf_numbers(g, node, "translation", 3, t, &there));
	MR_TRY(mr_gltf_numbers(g, node, "rotation", 4, q, &there));
	MR_TRY(normalize(g->ctx, q));
	MR_TRY(mr_gltf_numbers(g, node, "scale", 3, s, &there));
	*map = from_parts(t, q, s);
	return MR_OK;
}

/* The walk down from the roots of the scene. */
typedef struct walk {
	const mr_gltf *g;
	size_t nodes;
	bool *shown;
	mr_affine *map; /* of the shown nodes: of their parent, until the walk reaches them */
	size_t *left;   /* to come to */
	size_t count;
	size_t room; /* of instances */
} walk;

/* The walk is to come to the nodes of a list, which hang from what has this map. */
static mr_status
go_on(walk *w, const json_t *list, const mr_affine *above)
{
	for (size_t k = 0; k < json_array_size(list); k++) {
		json_int_t node = json_integer_value(json_array_get(list, k));
		if (node < 0 || (uint64_t)node >= w->nodes)
			return mr_fail(
			    w->g->ctx, MR_EFORMAT, "a scene or a node names none of the %zu nodes", w->nodes);
		if (w->shown[node])
			return mr_fail(w->g->ctx, MR_EFORMAT,
			    "node %zu hangs from more than one, or from itself", (size_t)node);
		w->shown[node] = true;
		w->map[node] = *above;
		w->left[w->count++] = (size_t)node;
	}
	return MR_OK;
}

static mr_status
place_nodes(walk *w, const json_t *roots)
{
	const mr_affine identity = mr_identity();
	mr_affine own = identity;

	MR_TRY(go_on(w, roots, &identity));
	while (w->count > 0) {
		size_t at = w->left[--w->count];
		const json_t *node = mr_gltf_at(w->g, "nodes", at);
		MR_TRY(mr_prefix(w->g->ctx, node_map(w->g, node, &own), "node %zu", at));
		w->map[at] = mr_compose(&w->map[at], &own);
		MR_TRY(go_on(w, json_object_get(node, "children"), &w->map[at]));
	}
	return MR_OK;
}

static void
add_instance(walk *w, instances *s, size_t mesh, const mr_affine *map, const char *name)
{
	MR_RESERVE(w->g->ctx, s->instance, s->count, 1, &w->room);
	s->instance[s->count++] = (instance){ .mesh = mesh,
		.map = *map,
		.name = name ? name : mr_gltf_name(mr_gltf_at(w->g, "meshes", mesh)) };
}

static mr_status
visit(walk *w, instances *s, size_t node)
{
	const json_t *json = mr_gltf_at(w->g, "nodes", node);
	size_t mesh;

	MR_TRY(mr_prefix(w->g->ctx, mr_gltf_index(w->g, json, "mesh", "meshes", &mesh), "node %zu", node));
	if (mesh == MR_UNKNOWN)
		return MR_OK;
	s->unseen += !w->shown[node];
	if (!w->shown[node])
		return MR_OK;
	s->several += json_object_get(json_object_get(json, "extensions"), "EXT_mesh_gpu_instancing") != NULL;
	add_instance(w, s, mesh, &w->map[node], mr_gltf_name(json));
	return MR_OK;
}

/* The meshes of the scene that is to be shown; without a scene, all meshes as they are. */
static mr_status
find_scene(const mr_gltf *g, instances *s)
{
	const mr_affine identity = mr_identity();
	size_t n = mr_gltf_size(g, "nodes"), scenes = mr_gltf_size(g, "scenes"), scene;
	walk w = { .g = g,
		.nodes = n,
		.shown = MR_NEW_ZERO(g->ctx, n, bool),
		.map = MR_NEW(g->ctx, n, mr_affine),
		.left = MR_NEW(g->ctx, n, size_t) };

	*s = (instances){ 0 };
	MR_TRY(mr_gltf_index(g, g->root, "scene", "scenes", &scene));
	for (size_t i = 0; scenes == 0 && i < mr_gltf_size(g, "meshes"); i++)
		add_instance(&w, s, i, &identity, NULL);
	if (scenes == 0)
		return MR_OK;
	MR_TRY(place_nodes(
	    &w, json_object_get(mr_gltf_at(g, "scenes", scene == MR_UNKNOWN ? 0 : scene), "nodes")));
	for (size_t i = 0; i < n; i++)
		MR_TRY(visit(&w, s, i));
	return MR_OK;
}

/* ---- primitives ---- */

/* How a primitive makes faces of its vertices. */
enum { POINTS = 0, LINE_STRIP = 3, TRIANGLES = 4, STRIP = 5, FAN = 6 };

/* Attributes of vertices. */
enum { POSITION, NORMAL, TEXCOORD, COLOR, ATTRIBUTES };

/* A primitive of a mesh of the scene, and its accessors; MR_UNKNOWN: none. */
typedef struct part {
	const instance *of;
	size_t accessor[ATTRIBUTES], indices, material;
	mr_gltf_placing placing; /* of pictures */
	size_t mode, corners;
	size_t first, count; /* its vertices */
	bool own;            /* that no part before it has read */
	size_t placed;       /* the part that they have texture coordinates of; MR_UNKNOWN: none */
} part;

typedef struct reader {
	mr_gltf g;
	mr_builder b;
	mr_gltf_looks looks;
	instances scene;
	part *part;
	size_t parts, part_room;
	size_t n, nf; /* vertices as the file has them; faces, at most */
	double *
	    column[ATTRIBUTES]; /* of vertices, whose normals may be zero, texture coordinates NaN; or NULL */
	size_t odd_uv;
	uint32_t *join;                    /* n: the vertex of the model */
	uint32_t *index;                   /* of the part at hand */
	size_t lines, targets, attributes; /* that are left out */
} reader;

/* ---- what the values of vertices become ---- */

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

/* offset + R(-turn) S(scale) uv: v runs down the picture in glTF, up in OBJ. */
static void
place_texcoords(reader *r, const mr_gltf_placing *p, size_t n, double *uv)
{
	double c = cos(p->turn), s = sin(p->turn);

	for (size_t i = 0; i < n; i++) {
		double u = p->scale[0] * uv[2 * i], v = p->scale[1] * uv[2 * i + 1];
		uv[2 * i] = p->offset[0] + c * u + s * v;
		uv[2 * i + 1] = 1 - (p->offset[1] + c * v - s * u);
		if (isfinite(uv[2 * i]) && isfinite(uv[2 * i + 1]))
			continue;
		uv[2 * i] = (double)NAN;
		r->odd_uv++;
	}
}

/* Values of attribute k as the model has them. */
static void
change(reader *r, const part *p, size_t k, double *x)
{
	const mr_affine *map = &p->of->map;
	mr_v3 *v = (mr_v3 *)(void *)x;

	if (k == TEXCOORD)
		place_texcoords(r, &p->placing, p->count, x);
	if (k >= TEXCOORD || mr_is_identity(map))
		return;
	for (size_t i = 0; i < p->count; i++)
		if (k == POSITION)
			v[i] = mr_apply(map, v[i]);
		else if (mr_finite(v[i]))
			v[i] = apply_to_normal(map, v[i]);
}

static const struct {
	const char *name;
	size_t width, least; /* least: the numbers that an accessor must have of it */
	double none;         /* of vertices without */
} attributes[ATTRIBUTES] = { { "POSITION", 3, 3, 0 }, { "NORMAL", 3, 3, 0 },
	{ "TEXCOORD", 2, 2, (double)NAN }, { "COLOR_0", 4, 3, 1 } };

/* ---- the primitives of the scene ---- */

static size_t
faces_of(size_t mode, size_t corners)
{
	return mode == TRIANGLES ? corners / 3 : mode >= STRIP && corners > 2 ? corners - 2 : 0;
}

static mr_status
find_accessors(reader *r, const json_t *json, part *p)
{
	const json_t *list = json_object_get(json, "attributes");

	MR_TRY(mr_gltf_index(&r->g, json, "material", "materials", &p->material));
	p->placing = p->material != MR_UNKNOWN ? r->looks.placing[p->material]
	                                       : (mr_gltf_placing){ .scale = { 1, 1 } };
	r->attributes += json_object_size(list);
	for (size_t k = 0; k < ATTRIBUTES; k++) {
		const char *name = k == TEXCOORD ? mr_format(r->g.ctx, "TEXCOORD_%zu", p->placing.set)
		                                 : attributes[k].name;
		MR_TRY(mr_gltf_index(&r->g, list, name, "accessors", &p->accessor[k]));
		r->attributes -= p->accessor[k] != MR_UNKNOWN;
	}
	return mr_gltf_index(&r->g, json, "indices", "accessors", &p->indices);
}

/* The number of rows of an accessor whose values a column of `width` is made of. */
static mr_status
count_rows(reader *r, size_t accessor, size_t width, size_t *rows)
{
	mr_accessor a;

	if (accessor == MR_UNKNOWN)
		return MR_OK;
	MR_TRY(mr_accessor_open(&r->g, accessor, &a));
	if (!a.data)
		return mr_fail(r->g.ctx, MR_EFORMAT,
		    "accessor %zu has no buffer view: an extension may have packed it", accessor);
	if (a.components < width || (width < 3 && a.components != width))
		return mr_fail(r->g.ctx, MR_EFORMAT, "accessor %zu has rows of %zu numbers, not %zu",
		    accessor, a.components, width);
	if (*rows != MR_UNKNOWN && a.count != *rows)
		return mr_fail(
		    r->g.ctx, MR_EFORMAT, "accessor %zu has %zu rows, not %zu", accessor, a.count, *rows);
	*rows = a.count;
	return MR_OK;
}

static bool
has_texcoords_of(const part *p, const part *q)
{
	return p->accessor[TEXCOORD] == q->accessor[TEXCOORD] &&
	       !memcmp(&p->placing, &q->placing, sizeof p->placing);
}

/* Primitives of one mesh with several materials share vertices if they have the same texture coordinates. */
static bool
shares_vertices(const reader *r, const part *p, const part *before)
{
	bool textured = before && before->placed != MR_UNKNOWN && p->accessor[TEXCOORD] != MR_UNKNOWN;

	return before && p->accessor[POSITION] == before->accessor[POSITION] &&
	       (!textured || has_texcoords_of(p, &r->part[before->placed])) &&
	       !memcmp(&p->of->map, &before->of->map, sizeof p->of->map) &&
	       (p->mode == POINTS) == (before->mode == POINTS);
}

static mr_status
count_part(reader *r, part *p)
{
	const part *before = r->parts ? &r->part[r->parts - 1] : NULL;

	p->count = p->corners = MR_UNKNOWN;
	for (size_t k = 0; k < ATTRIBUTES; k++)
		MR_TRY(count_rows(r, p->accessor[k], attributes[k].least, &p->count));
	MR_TRY(count_rows(r, p->indices, 1, &p->corners));
	if (p->indices == MR_UNKNOWN)
		p->corners = p->count;
	if (p->mode == TRIANGLES && p->corners % 3)
		return mr_fail(r->g.ctx, MR_EFORMAT, "triangles of %zu corners", p->corners);
	p->own = !shares_vertices(r, p, before);
	p->placed = p->accessor[TEXCOORD] != MR_UNKNOWN ? r->parts : p->own ? MR_UNKNOWN : before->placed;
	p->first = p->own ? r->n : before->first;
	r->n += p->own ? p->count : 0;
	r->nf += faces_of(p->mode, p->corners);
	if (r->n >= MR_NONE || r->nf > (MR_NONE - 1) / 3)
		return mr_fail(r->g.ctx, MR_ERANGE,
		    "%zu vertices and %zu faces are more than indices can name", r->n, r->nf);
	return MR_OK;
}

static mr_status
add_part(reader *r, json_t *json, const instance *of)
{
	part p = { .of = of };

	MR_TRY(mr_gltf_count(&r->g, json, "mode", TRIANGLES, FAN, &p.mode));
	r->targets += json_array_size(json_object_get(json, "targets"));
	if (p.mode != POINTS && p.mode <= LINE_STRIP) {
		r->lines++;
		return MR_OK;
	}
	MR_TRY(find_accessors(r, json, &p));
	MR_TRY(mr_gltf_draco(&r->g, json));
	if (p.accessor[POSITION] == MR_UNKNOWN) /* by the specification there is nothing to draw */
		return MR_OK;
	MR_TRY(count_part(r, &p));
	MR_RESERVE(r->g.ctx, r->part, r->parts, 1, &r->part_room);
	r->part[r->parts++] = p;
	return MR_OK;
}

static mr_status
find_parts(reader *r)
{
	for (size_t i = 0; i < r->scene.count; i++) {
		const instance *of = &r->scene.instance[i];
		json_t *list = json_object_get(mr_gltf_at(&r->g, "meshes", of->mesh), "primitives");
		for (size_t k = 0; k < json_array_size(list); k++)
			MR_TRY(mr_prefix(r->g.ctx, add_part(r, json_array_get(list, k), of),
			    "mesh %zu, primitive %zu", of->mesh, k));
	}
	return MR_OK;
}

/* ---- vertices as the file has them ---- */

/* Values of vertices, unless the part before has read them. */
static mr_status
read_column(reader *r, const part *p, size_t k)
{
	size_t number = p->accessor[k];
	double *x = r->column[k] + attributes[k].width * p->first;
	mr_accessor a;

	if (number == MR_UNKNOWN || (!p->own && number == p[-1].accessor[k]))
		return MR_OK;
	MR_TRY(mr_accessor_open(&r->g, number, &a));
	mr_accessor_reals(&a, attributes[k].width, x);
	change(r, p, k, x);
	return MR_OK;
}

/* Reads attribute k; parts without it get its default where others have it. */
static mr_status
read_columns(reader *r, size_t k)
{
	size_t n = attributes[k].width * r->n;
	bool there = false;

	for (size_t i = 0; i < r->parts; i++)
		there |= r->part[i].accessor[k] != MR_UNKNOWN;
	if (!there)
		return MR_OK;
	r->column[k] = MR_NEW(r->g.ctx, n, double);
	for (size_t i = 0; i < n; i++)
		r->column[k][i] = attributes[k].none;
	for (size_t i = 0; i < r->parts; i++)
		MR_TRY(read_column(r, &r->part[i], k));
	return MR_OK;
}

static mr_status
read_vertices(reader *r)
{
	for (size_t k = 0; k < ATTRIBUTES; k++)
		MR_TRY(read_columns(r, k));
	if (r->column[NORMAL] && !mr_normals_left(r->g.ctx, (mr_v3 *)(void *)r->column[NORMAL], r->n))
		r->column[NORMAL] = NULL;
	if (!mr_left_out(r->g.ctx, r->odd_uv, r->n, "texture coordinates"))
		r->column[TEXCOORD] = NULL;
	return MR_OK;
}

/* ---- vertices as the model has them ---- */

/* Joins the places of each mesh, from part i on; *end: the part after it. */
static void
join_mesh(reader *r, size_t i, size_t *end)
{
	size_t first = r->part[i].first, last = first, joined;
	bool faces = false;

	for (; i < r->parts && (r->part[i].of == r->part[*end].of || !r->part[i].own); i++) {
		last = r->part[i].own ? r->part[i].first + r->part[i].count : last;
		faces |= r->part[i].mode != POINTS;
	}
	*end = i;
	joined = last - first;
	for (size_t k = first; k < last; k++)
		r->join[k] = (uint32_t)(k - first);
	if (faces)
		mr_weld(r->g.ctx, (mr_v3 *)(void *)r->column[POSITION] + first, joined, 0, r->join + first,
		    &joined);
	for (size_t k = first; k < last; k++)
		r->join[k] += (uint32_t)r->b.m.nv;
	r->b.m.nv += joined;
}

/* Each vertex has the first colour that it is given.  They are linear in the file. */
static void
join_colors(reader *r)
{
	const double *x = r->column[COLOR];
	size_t n = x ? 4 * r->n : 0, odd = 0, several = 0;
	unsigned char *of = MR_NEW(r->g.ctx, n, unsigned char), *color;
	mr_shades shades = { .full = 1 };

	for (size_t i = 0; i < n; i++) {
		odd += isnan(x[i]) ? 1 : 0;
		of[i] = mr_shade_byte(&shades, i % 4 == 3 ? x[i] : mr_linear_to_srgb(x[i]));
	}
	if (!mr_all_left(r->g.ctx, odd, r->n, "colors") || n == 0)
		return;
	mr_shades_said(r->g.ctx, &shades);
	r->b.m.color = color = MR_NEW(r->g.ctx, 4 * r->b.m.nv, unsigned char);
	for (size_t k = r->n; k-- > 0;)
		memcpy(color + 4 * (size_t)r->join[k], of + 4 * k, 4);
	for (size_t k = 0; k < r->n; k++)
		several += memcmp(color + 4 * (size_t)r->join[k], of + 4 * k, 4) != 0;
	mr_lost(r->g.ctx, NULL, several, "colors of joined vertices");
}

static void
join_vertices(reader *r)
{
	const mr_v3 *at = (const mr_v3 *)(const void *)r->column[POSITION];
	mr_v3 *p;

	r->join = MR_NEW(r->g.ctx, r->n, uint32_t);
	for (size_t i = 0; i < r->parts;) {
		size_t end = i;
		join_mesh(r, i, &end);
		i = end;
	}
	r->b.m.p = p = MR_NEW(r->g.ctx, r->b.m.nv, mr_v3);
	for (size_t k = r->n; k-- > 0;)
		p[r->join[k]] = at[k];
	join_colors(r);
	r->b.uv = r->column[TEXCOORD];
	r->b.vn = (const mr_v3 *)(const void *)r->column[NORMAL];
	if (r->nf == 0) { /* points are not joined */
		r->b.m.normal = r->b.vn;
		r->b.m.texcoord = r->b.uv;
	}
}

/* ---- faces ---- */

/* Corners of face k, in the order of the file. */
static void
corners_of(size_t mode, size_t k, size_t c[3])
{
	c[0] = mode == FAN ? k + 1 : mode == STRIP ? k : 3 * k;
	c[1] = mode == FAN ? k + 2 : mode == STRIP ? k + 1 + k % 2 : 3 * k + 1;
	c[2] = mode == FAN ? 0 : mode == STRIP ? k + 2 - k % 2 : 3 * k + 2;
}

static void
add_face(reader *r, const part *p, size_t k, bool turned)
{
	uint32_t v[3], at[3];
	size_t c[3];

	corners_of(p->mode, k, c);
	for (size_t i = 0; i < 3; i++) {
		size_t corner = c[turned && i ? 3 - i : i];
		at[i] = (uint32_t)p->first + (r->index ? r->index[corner] : (uint32_t)corner);
		v[i] = r->join[at[i]];
	}
	if (p->mode != TRIANGLES && (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]))
		return; /* a strip goes on elsewhere by such faces */
	mr_build_face(&r->b, v, r->b.uv && p->accessor[TEXCOORD] != MR_UNKNOWN ? at : NULL,
	    r->b.vn && p->accessor[NORMAL] != MR_UNKNOWN ? at : NULL, 3);
}

/* Names of n things, in their order; of several without a name each is called `what` and its number, and so
 * is a single one where `all`. */
static void
name_marks(reader *r, mr_marking kind, const char **name, size_t n, const char *what, bool all)
{
	size_t unnamed = 0;

	for (size_t i = 0; i < n; i++)
		unnamed += !name[i];
	for (size_t i = 0; i < n; i++) {
		if (!name[i])
			name[i] = unnamed == 1 && !all ? "" : mr_format(r->g.ctx, "%s%zu", what, i);
		mr_build_mark(&r->b, kind, name[i], strlen(name[i]), true);
	}
}

/* Materials that look different have names that differ. */
static void
name_materials(reader *r, const char **name, size_t n)
{
	mr_name_table known = { 0 };

	for (size_t i = 0; i < n; i++) {
		const char *own = mr_gltf_name(mr_gltf_at(&r->g, "materials", i));
		name[i] = own && r->looks.said ? mr_clean_copy(r->g.ctx, own, strlen(own)) : own;
		for (size_t all = known.count;
		     name[i] && r->looks.said &&
		     mr_name_number(r->g.ctx, &known, name[i], strlen(name[i])) < all;)
			name[i] = mr_format(r->g.ctx, "%s.%zu", name[i], i);
	}
	if (n > 1 || (n == 1 && (*name || r->looks.said)))
		name_marks(r, MR_MATERIAL, name, n, "material", r->looks.said);
	if (r->looks.said)
		mr_gltf_looks_put(&r->looks, name, n, &r->b);
}

/* Faces have objects where these have names or are several, and materials where there are any. */
static void
name_all(reader *r)
{
	size_t objects = r->scene.count, materials = mr_gltf_size(&r->g, "materials");
	const char **name = MR_NEW(r->g.ctx, objects + materials, const char *);

	for (size_t i = 0; i < objects; i++)
		name[i] = r->scene.instance[i].name;
	if (objects > 1 || (objects == 1 && *name))
		name_marks(r, MR_OBJECT, name, objects, "mesh", false);
	name_materials(r, name, materials);
}

static mr_status
read_faces(reader *r, const part *p)
{
	bool turned = determinant(&p->of->map) < 0;
	mr_accessor a;

	r->b.marks[MR_OBJECT].current = (uint32_t)(p->of - r->scene.instance);
	if (p->material != MR_UNKNOWN)
		r->b.marks[MR_MATERIAL].current = (uint32_t)p->material;
	else if (r->b.marks[MR_MATERIAL].used)
		mr_build_mark(&r->b, MR_MATERIAL, "", 0, false);
	r->index = NULL;
	if (p->indices != MR_UNKNOWN) {
		MR_TRY(mr_accessor_open(&r->g, p->indices, &a));
		r->index = MR_NEW(r->g.ctx, a.count, uint32_t);
		MR_TRY(mr_accessor_indices(&r->g, &a, p->count, r->index));
	}
	for (size_t k = 0; k < faces_of(p->mode, p->corners); k++)
		add_face(r, p, k, turned);
	return MR_OK;
}

/* ---- losses ---- */

static void
say_left(const reader *r)
{
	static const char *const arrays[] = { "skins", "animations", "cameras" };

	mr_lost(r->g.ctx, NULL, r->nf ? r->looks.left : mr_gltf_size(&r->g, "images"), "images");
	for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++)
		mr_lost(r->g.ctx, NULL, mr_gltf_size(&r->g, arrays[i]), arrays[i]);
	mr_lost(r->g.ctx, NULL, r->looks.plain, "looks of materials");
	mr_lost(r->g.ctx, NULL, r->targets, "morph targets");
	mr_lost(r->g.ctx, NULL, r->lines, "lines");
	mr_lost(r->g.ctx, NULL, r->scene.unseen, "meshes that the scene does not show");
	mr_lost(r->g.ctx, NULL, r->scene.several, "instances of meshes");
	mr_lost(r->g.ctx, NULL, r->attributes, "other attributes");
}

/* ---- the document ---- */

mr_status
mr_gltf_read(mr_ctx *ctx, const unsigned char *data, size_t size, mr_model *m)
{
	reader r = { .b.ctx = ctx };

	MR_TRY(mr_gltf_open(ctx, m->path, data, size, &r.g));
	MR_TRY(mr_gltf_looks_read(&r.g, &r.looks));
	MR_TRY(find_scene(&r.g, &r.scene));
	MR_TRY(find_parts(&r));
	MR_TRY(read_vertices(&r));
	join_vertices(&r);
	if (r.nf)
		name_all(&r);
	for (size_t i = 0; i < r.parts; i++)
		MR_TRY(read_faces(&r, &r.part[i]));
	say_left(&r);
	return mr_build_finish(&r.b, m);
}
