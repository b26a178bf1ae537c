/* Vertices of a GLB: their order, their attributes and their poses. */
#include "formats/gltf_writer.h"

enum { FRAMES_A_SECOND = 24 };

/* ---- which there are ---- */

/* Normals for a model without any, as mr-render shows them: corners have their own only at creases. */
static void
make_normals(mr_ctx *ctx, layer *l)
{
	mr_model *m = &l->model;
	mr_mesh *mesh = MR_NEW(ctx, 1, mr_mesh);
	mr_incidence *around = MR_NEW(ctx, 1, mr_incidence);
	mr_v3 *corner = NULL;

	*mesh = (mr_mesh){ .p = m->p, .t = m->t, .nv = m->nv, .nf = m->nf };
	l->made = MR_NEW(ctx, 1, mr_creases);
	mr_incidence_build(ctx, mesh, around);
	mr_creases_find(ctx, mesh, around, l->made);
	for (size_t c = 0; c < 3 * m->nf; c++) {
		if (!l->made->creased[m->t[c / 3].v[c % 3]])
			continue;
		corner = corner ? corner : MR_NEW_ZERO(ctx, 3 * m->nf, mr_v3);
		corner[c] = mr_corner_normal(l->made, c / 3, (int)(c % 3));
	}
	m->normal = l->made->normal;
	m->corner_normal = corner;
}

/* Numbers the corners by vertex, texture coordinates and normal: `key` of each three numbers. */
static void
make_keys(mr_ctx *ctx, const mr_model *m, double **key)
{
	size_t corners = 3 * m->nf, count;
	uint32_t *uv = MR_NEW_ZERO(ctx, corners, uint32_t), *vn = MR_NEW_ZERO(ctx, corners, uint32_t),
		 *first = MR_NEW(ctx, corners, uint32_t);

	*key = MR_NEW(ctx, 3 * corners, double);
	if (m->corner_texcoord)
		mr_number_rows(ctx, m->corner_texcoord, 2, corners, uv, first, &count);
	if (m->corner_normal)
		mr_number_rows(ctx, &m->corner_normal->x, 3, corners, vn, first, &count);
	for (size_t c = 0; c < corners; c++) {
		(*key)[3 * c] = m->t[c / 3].v[c % 3];
		(*key)[3 * c + 1] = uv[c];
		(*key)[3 * c + 2] = vn[c] + 1.0; /* never all zero, which is none */
	}
}

/* Without seams each vertex is one, and stands for the first of its corners. */
static void
keep_vertices(const mr_model *m, vertices *v)
{
	for (size_t i = 0; i < m->nv; i++) {
		v->vertex[i] = (uint32_t)i;
		v->corner[i] = MR_NONE;
	}
	for (size_t c = 0; c < 3 * m->nf; c++) {
		uint32_t i = m->t[c / 3].v[c % 3];
		v->index[c] = i;
		if (v->corner[i] == MR_NONE)
			v->corner[i] = (uint32_t)c;
	}
	v->count = m->nv;
}

/* The first distinct corner of a vertex is that vertex, the others come after all vertices. */
static void
number_vertices(const mr_model *m, const uint32_t *first, size_t distinct, uint32_t *place, vertices *v)
{
	for (size_t i = 0; i < m->nv; i++) {
		v->vertex[i] = (uint32_t)i;
		v->corner[i] = MR_NONE;
	}
	v->count = m->nv;
	for (size_t k = 0; k < distinct; k++) {
		uint32_t vertex = m->t[first[k] / 3].v[first[k] % 3];
		size_t at = v->corner[vertex] == MR_NONE ? vertex : v->count++;
		v->vertex[at] = vertex;
		v->corner[at] = first[k];
		place[k] = (uint32_t)at;
	}
}

static void
split_vertices(mr_ctx *ctx, const mr_model *m, vertices *v)
{
	size_t corners = 3 * m->nf, distinct = 0;
	uint32_t *first = MR_NEW(ctx, corners, uint32_t), *place;
	double *key;

	make_keys(ctx, m, &key);
	mr_number_rows(ctx, key, 3, corners, v->index, first, &distinct);
	v->vertex = MR_NEW(ctx, m->nv + distinct, uint32_t);
	v->corner = MR_NEW(ctx, m->nv + distinct, uint32_t);
	place = MR_NEW(ctx, distinct, uint32_t);
	number_vertices(m, first, distinct, place, v);
	for (size_t c = 0; c < corners; c++)
		v->index[c] = place[v->index[c]];
}

void
mr_glb_find_vertices(glb *w, layer *l)
{
	mr_model *m = &l->model;
	vertices *v = &l->v;

	if (w->scene->gltf.no_normals)
		m->normal = m->corner_normal = NULL;
	else if (m->nf && !m->normal && !m->corner_normal)
		make_normals(w->ctx, l);
	*v = (vertices){ .index = MR_NEW(w->ctx, 3 * m->nf, uint32_t) };
	if (m->corner_texcoord || m->corner_normal) {
		split_vertices(w->ctx, m, v);
		return;
	}
	v->vertex = MR_NEW(w->ctx, m->nv, uint32_t);
	v->corner = MR_NEW(w->ctx, m->nv, uint32_t);
	keep_vertices(m, v);
}

/* ---- values ---- */

/* How rows of numbers are stored. */
typedef struct form {
	size_t kind; /* of a component, as the format numbers them */
	bool normalized;
	size_t width, stride; /* components, and bytes from row to row */
} form;

static const form FLOATS = { MR_GLTF_FLOAT, false, 3, 12 }, PAIRS = { MR_GLTF_FLOAT, false, 2, 8 },
		  SHADES = { MR_GLTF_UNSIGNED_SHORT, true, 4, 8 },
		  PLACES = { MR_GLTF_UNSIGNED_SHORT, false, 3, 8 }, MOVES = { MR_GLTF_SHORT, false, 3, 8 },
		  DIRECTIONS = { MR_GLTF_BYTE, true, 3, 4 }, SHARES = { MR_GLTF_UNSIGNED_SHORT, true, 2, 4 };

static void
store(char *to, const form *f, const double *x)
{
	for (size_t k = 0; k < f->width; k++) {
		int whole = f->kind == MR_GLTF_FLOAT ? 0 : (int)x[k];
		if (f->kind == MR_GLTF_FLOAT)
			to = mr_store_float(to, (float)x[k]);
		else
			*to++ = (char)(whole & 255);
		if (f->kind == MR_GLTF_SHORT || f->kind == MR_GLTF_UNSIGNED_SHORT)
			*to++ = (char)(whole >> 8 & 255);
	}
}

/* A view of n rows. */
static size_t
put_view(glb *w, const form *f, const double *x, size_t n, size_t target)
{
	char *to = NULL;
	size_t view = mr_glb_new_view(w, n, f->stride, target, MR_VIEW_ROWS, &to);

	for (size_t i = 0; i < n; i++)
		store(to + i * f->stride, f, x + i * f->width);
	return view;
}

/* An accessor of n rows; view: MR_UNKNOWN where they are zero. */
static size_t
put_accessor(glb *w, const form *f, size_t view, size_t n)
{
	static const char *const types[] = { "", "SCALAR", "VEC2", "VEC3", "VEC4" };

	return mr_glb_push(w, "accessors",
	    json_pack("{s:o*, s:I, s:o*, s:I, s:s}", "bufferView", index_of(w, view), "componentType",
		number(f->kind), "normalized", f->normalized ? json_true() : NULL, "count", number(n), "type",
		types[f->width]));
}

static size_t
put_rows(glb *w, const form *f, const double *x, size_t n)
{
	return put_accessor(w, f, put_view(w, f, x, n, MR_GLTF_ARRAY), n);
}

/* The least and the greatest of vectors. */
static void
put_bounds(glb *w, size_t accessor, const mr_v3 *x, size_t n)
{
	mr_box box = mr_box_empty();

	for (size_t i = 0; i < n; i++)
		mr_box_add(&box, x[i]);
	mr_glb_set_bounds(w, accessor, json_pack("[f, f, f]", box.min.x, box.min.y, box.min.z),
	    json_pack("[f, f, f]", box.max.x, box.max.y, box.max.z));
}

/* Rows of l->x that are not zero, but at least one, moved to its begin; returns their number. */
static size_t
gather_moved(layer *l)
{
	size_t count = 0;

	for (size_t i = 0; i < l->v.count; i++) {
		mr_v3 x = l->x[i];
		if (x.x == 0 && x.y == 0 && x.z == 0)
			continue;
		l->x[count] = x;
		l->row[count++] = (uint32_t)i;
	}
	l->row[0] = count ? l->row[0] : 0;
	return count ? count : 1;
}

static size_t
count_moved(const layer *l)
{
	size_t count = 0;

	for (size_t i = 0; i < l->v.count; i++)
		count += l->x[i].x != 0 || l->x[i].y != 0 || l->x[i].z != 0;
	return count;
}

/* Only the rows of l->x that are not zero, and which they are; l->x is no more then. */
static size_t
put_sparse(glb *w, layer *l, const form *f)
{
	size_t n = l->v.count, count = gather_moved(l);
	size_t index = mr_glb_put_indices(w, l->row, count, n, MR_UNKNOWN);
	size_t view = put_view(w, f, &l->x->x, count, MR_UNKNOWN),
	       accessor = put_accessor(w, f, MR_UNKNOWN, n);

	mr_glb_set(w, accessor, "sparse",
	    json_pack("{s:I, s:{s:I, s:I}, s:{s:I}}", "count", number(count), "indices", "bufferView",
		number(index), "componentType", number(mr_index_kind(n)), "values", "bufferView",
		number(view)));
	return accessor;
}

/* Writes the displacements l->x of a pose, as a sparse accessor where that is smaller; its views are packed
 * tightly. */
static size_t
put_changes(glb *w, layer *l, const form *f)
{
	const size_t words = 240; /* about the bytes of its JSON */
	form tight = *f;

	tight.stride = f->kind == MR_GLTF_FLOAT ? 12 : f->kind == MR_GLTF_BYTE ? 3 : 6;
	if (w->scene->gltf.compress && tight.stride != f->stride)
		return put_rows(w, f, &l->x->x, l->v.count); /* zeros are packed, odd rows are not */
	if (words + count_moved(l) * (tight.stride + mr_index_bytes(l->v.count)) < l->v.count * f->stride)
		return put_sparse(w, l, &tight);
	return put_rows(w, f, &l->x->x, l->v.count);
}

/* ---- places ---- */

static mr_v3
as_floats(mr_v3 a)
{
	return mr_vec(mr_as_float(a.x), mr_as_float(a.y), mr_as_float(a.z));
}

/* A place as the file has it: in floats, or in steps of its grid. */
static mr_v3
place_of(const layer *l, mr_v3 p)
{
	mr_v3 a = mr_sub(p, l->origin);

	return l->step > 0 ? mr_vec(rint(a.x / l->step), rint(a.y / l->step), rint(a.z / l->step))
	                   : as_floats(p);
}

static void
put_positions(glb *w, layer *l)
{
	for (size_t i = 0; i < l->v.count; i++)
		l->x[i] = place_of(l, l->model.p[l->v.vertex[i]]);
	l->position = put_rows(w, l->step > 0 ? &PLACES : &FLOATS, &l->x->x, l->v.count);
	put_bounds(w, l->position, l->x, l->v.count);
}

/* How far a pose moves them: the difference of the stored numbers, so that nothing is rounded twice. */
static size_t
put_motion(glb *w, layer *l, const mr_v3 *p)
{
	mr_v3 least, most;
	mr_box box = mr_box_empty();
	size_t accessor;

	for (size_t i = 0; i < l->v.count; i++) {
		uint32_t v = l->v.vertex[i];
		l->x[i] = as_floats(mr_sub(place_of(l, p[v]), place_of(l, l->model.p[v])));
		mr_box_add(&box, l->x[i]);
	}
	least = box.min, most = box.max;
	accessor = put_changes(w, l, l->step > 0 ? &MOVES : &FLOATS);
	mr_glb_set_bounds(w, accessor, json_pack("[f, f, f]", least.x, least.y, least.z),
	    json_pack("[f, f, f]", most.x, most.y, most.z));
	return accessor;
}

/* A grid over the model of 16 bits, 15 and a sign for how far poses move it. */
static void
find_grid(layer *l)
{
	const mr_model *m = &l->model;
	mr_box box = mr_box_empty();
	double far = 0, most;
	mr_v3 size;

	for (size_t i = 0; i < m->nv; i++)
		mr_box_add(&box, m->p[i]);
	for (size_t k = 0; k < l->node->targets; k++)
		for (size_t i = 0; i < m->nv; i++) {
			mr_v3 d = mr_sub(l->node->target[k].p[i], m->p[i]);
			far = fmax(far, fmax(fabs(d.x), fmax(fabs(d.y), fabs(d.z))));
		}
	size = mr_sub(box.max, box.min);
	most = fmax(size.x, fmax(size.y, size.z));
	l->origin = box.min;
	l->step = fmax(most / 65535, far / 32766); /* both ends are rounded */
	if (l->step == 0)
		l->step = 1;
}

/* ---- normals ---- */

/* Whether it can be made unit. */
static bool
is_direction(mr_v3 n)
{
	return isfinite(mr_norm2(n)) && mr_norm2(n) > 0;
}

/* A normal that is a unit vector to the four digits of most files stays as it is; the format asks for three.
 */
static mr_v3
as_unit(mr_v3 n)
{
	mr_v3 f = as_floats(n);

	return fabs(mr_norm2(f) - 1) < 5e-4 ? f : as_floats(mr_unit(n));
}

/* The normal of a vertex.  Without one it takes its triangle's; without a triangle, the z axis. */
static mr_v3
normal_of(const layer *l, const mr_target *pose, size_t i)
{
	uint32_t c = l->v.corner[i];
	mr_v3 n = mr_vec(0, 0, 0);

	if (l->made && c != MR_NONE)
		n = mr_corner_normal_posed(l->made, pose->p, c / 3, (int)(c % 3));
	else if (pose->corner_normal && c != MR_NONE)
		n = pose->corner_normal[c];
	else if (pose->normal)
		n = pose->normal[l->v.vertex[i]];
	if (!is_direction(n) && c != MR_NONE) {
		const uint32_t *t = l->model.t[c / 3].v;
		n = mr_cross(mr_sub(pose->p[t[1]], pose->p[t[0]]), mr_sub(pose->p[t[2]], pose->p[t[0]]));
	}
	return is_direction(n) ? as_unit(n) : mr_vec(0, 0, 1);
}

/* In steps of a byte. */
static mr_v3
in_bytes(mr_v3 n)
{
	return mr_vec(rint(127 * n.x), rint(127 * n.y), rint(127 * n.z));
}

/* How long `to` may be that no component differs by more than 1 from `from`: only its direction counts. */
static double
reach(double from, double to)
{
	return to > 0 ? (1 + from) / to : to < 0 ? (from - 1) / to : 1;
}

static mr_v3
turn_in_bytes(mr_v3 from, mr_v3 to)
{
	mr_v3 a = in_bytes(from), f = mr_mul(1 / 127.0, a);
	double s = fmin(fmin(1, reach(f.x, to.x)), fmin(reach(f.y, to.y), reach(f.z, to.z)));
	mr_v3 d = mr_sub(in_bytes(mr_mul(s, to)), a);

	return mr_vec(fmax(fmin(d.x, 127), -127), fmax(fmin(d.y, 127), -127), fmax(fmin(d.z, 127), -127));
}

static void
put_normals(glb *w, layer *l)
{
	const mr_target rest = { l->model.p, l->model.normal, l->model.corner_normal };
	bool bytes = w->scene->gltf.quantize;

	l->unit = MR_NEW(w->ctx, l->v.count, mr_v3);
	for (size_t i = 0; i < l->v.count; i++) {
		l->unit[i] = normal_of(l, &rest, i);
		l->x[i] = bytes ? in_bytes(l->unit[i]) : l->unit[i];
	}
	l->normal = put_rows(w, bytes ? &DIRECTIONS : &FLOATS, &l->x->x, l->v.count);
}

/* How a pose turns them. */
static size_t
put_turn(glb *w, layer *l, const mr_target *pose)
{
	bool bytes = w->scene->gltf.quantize;

	for (size_t i = 0; i < l->v.count; i++) {
		mr_v3 to = normal_of(l, pose, i);
		l->x[i] = bytes ? turn_in_bytes(l->unit[i], to) : as_floats(mr_sub(to, l->unit[i]));
	}
	return put_changes(w, l, bytes ? &DIRECTIONS : &FLOATS);
}

/* Points have normals where all of them have some. */
static bool
has_normals(glb *w, const mr_model *m)
{
	size_t normals = 0;

	if (m->nf)
		return m->normal || m->corner_normal;
	for (size_t i = 0; m->normal && i < m->nv; i++)
		normals += is_direction(m->normal[i]);
	mr_lost(w->ctx, NULL, normals < m->nv ? normals : 0, "normals beside points without");
	return normals == m->nv;
}

/* ---- texture coordinates and colours ---- */

/* v runs down the picture in glTF. */
static void
find_texcoord(glb *w, const layer *l, size_t i, double *x)
{
	static const double none[2] = { 0, 1 };
	const mr_model *m = &l->model;
	const double *uv = m->texcoord ? m->texcoord + 2 * (size_t)l->v.vertex[i] : none;

	if (m->corner_texcoord && l->v.corner[i] != MR_NONE)
		uv = m->corner_texcoord + 2 * (size_t)l->v.corner[i];
	w->large |= isfinite(uv[0] + uv[1]) && !has_texcoord(uv);
	uv = has_texcoord(uv) ? uv : none;
	x[0] = uv[0];
	x[1] = 1 - uv[1];
}

/* In 16 bits where all are within the picture. */
static void
put_texcoords(glb *w, layer *l)
{
	size_t n = l->v.count;
	double *x = &l->x->x;
	bool within = w->scene->gltf.quantize;

	for (size_t i = 0; i < n; i++)
		find_texcoord(w, l, i, x + 2 * i);
	for (size_t i = 0; i < 2 * n && within; i++)
		within = x[i] >= 0 && x[i] <= 1;
	for (size_t i = 0; i < 2 * n && within; i++)
		x[i] = rint(65535 * x[i]);
	l->texcoord = put_rows(w, within ? &SHARES : &PAIRS, x, n);
}

/* Linear there, where sixteen bits give every byte back. */
static void
put_colors(glb *w, layer *l)
{
	double linear[2][256], *x = MR_NEW(w->ctx, 4 * l->v.count, double);

	for (int i = 0; i < 256; i++) {
		linear[0][i] = floor(65535 * mr_srgb_to_linear(i / 255.0) + 0.5);
		linear[1][i] = 257 * i;
	}
	for (size_t i = 0; i < 4 * l->v.count; i++)
		x[i] = linear[i % 4 == 3][l->model.color[4 * (size_t)l->v.vertex[i / 4] + i % 4]];
	l->color = put_rows(w, &SHADES, x, l->v.count);
}

void
mr_glb_put_vertices(glb *w, layer *l)
{
	const mr_model *m = &l->model;

	l->x = MR_NEW(w->ctx, l->v.count, mr_v3);
	l->row = MR_NEW(w->ctx, l->v.count, uint32_t);
	l->normal = l->texcoord = l->color = MR_UNKNOWN;
	if (w->scene->gltf.quantize)
		find_grid(l);
	put_positions(w, l);
	if (has_normals(w, m))
		put_normals(w, l);
	if (m->texcoord || m->corner_texcoord)
		put_texcoords(w, l);
	if (m->color)
		put_colors(w, l);
}

/* ---- poses ---- */

/* Frame 0 is the key, at frame i target i - 1 alone weighs 1: when, and how much. */
static void
put_weights(glb *w, size_t targets, size_t *sampler)
{
	static const form numbers = { MR_GLTF_FLOAT, false, 1, 4 };
	size_t frames = targets + 1, n = frames * targets, input, output;
	double *time = MR_NEW(w->ctx, frames, double), *weight = MR_NEW_ZERO(w->ctx, n, double);

	for (size_t i = 0; i < frames; i++)
		time[i] = (double)i / FRAMES_A_SECOND;
	for (size_t k = 0; k < targets; k++)
		weight[(k + 1) * targets + k] = 1;
	input = put_accessor(w, &numbers, put_view(w, &numbers, time, frames, MR_UNKNOWN), frames);
	mr_glb_set_bounds(w, input, json_pack("[f]", 0.), json_pack("[f]", mr_as_float(time[targets])));
	output = put_accessor(w, &numbers, put_view(w, &numbers, weight, n, MR_UNKNOWN), n);
	*sampler = mr_glb_append(
	    w, w->samplers, json_pack("{s:I, s:I}", "input", number(input), "output", number(output)));
}

/* Writes the poses as morph targets; normals too if every pose has them. */
void
mr_glb_put_poses(glb *w, layer *l)
{
	const mr_scene_node *node = l->node;
	bool turned = l->normal != MR_UNKNOWN;

	for (size_t i = 0; i < node->targets && !l->made; i++)
		turned = turned && (node->target[i].normal || node->target[i].corner_normal);
	for (size_t i = 0; i < node->targets; i++) {
		size_t position = put_motion(w, l, node->target[i].p);
		size_t normal = turned ? put_turn(w, l, &node->target[i]) : MR_UNKNOWN;
		mr_glb_append(w, l->targets,
		    json_pack("{s:I, s:o*}", "POSITION", number(position), "NORMAL", index_of(w, normal)));
	}
	if (node->targets)
		put_weights(w, node->targets, &l->sampler);
}
