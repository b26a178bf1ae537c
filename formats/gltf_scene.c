/* The scene of a glTF document: its nodes, from which meshes hang. */
#include "formats/gltf.h"

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
	double most = fmax(fmax(fabs(q[0]), fabs(q[1])), fmax(fabs(q[2]), fabs(q[3]))), squares = 0;

	if (most == 0)
		return mr_fail(ctx, MR_EFORMAT, "rotation is zero, which is no quaternion of unit length");
	for (int i = 0; i < 4; i++) {
		q[i] /= most; /* squares neither over- nor underflow */
		squares += q[i] * q[i];
	}
	for (int i = 0; i < 4; i++)
		q[i] /= sqrt(squares);
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

/* The walk up from each node to what it hangs from. */
typedef struct walk {
	const mr_gltf *g;
	size_t nodes;
	size_t *parent; /* of each node; MR_UNKNOWN: it hangs from none */
	mr_affine *map; /* of those that are done */
	bool *done, *shown;
	size_t *path; /* workspace */
	mr_gltf_scene *s;
	size_t room;
} walk;

static mr_status
find_parents(walk *w)
{
	for (size_t i = 0; i < w->nodes; i++)
		w->parent[i] = MR_UNKNOWN;
	for (size_t i = 0; i < w->nodes; i++) {
		const json_t *list = json_object_get(mr_gltf_at(w->g, "nodes", i), "children");
		for (size_t k = 0; k < json_array_size(list); k++) {
			json_int_t child = json_integer_value(json_array_get(list, k));
			if (child < 0 || (uint64_t)child >= w->nodes)
				return mr_fail(w->g->ctx, MR_EFORMAT,
				    "node %zu: a child is none of the %zu nodes", i, w->nodes);
			if (w->parent[child] != MR_UNKNOWN)
				return mr_fail(w->g->ctx, MR_EFORMAT, "node %zu hangs from more than one",
				    (size_t)child);
			w->parent[child] = i;
		}
	}
	return MR_OK;
}

/* Of the scene, or where there is none, all that hang from none. */
static mr_status
show_roots(walk *w, size_t scene)
{
	const json_t *list = json_object_get(mr_gltf_at(w->g, "scenes", scene), "nodes");

	for (size_t i = 0; scene == MR_UNKNOWN && i < w->nodes; i++)
		w->shown[i] = w->parent[i] == MR_UNKNOWN;
	for (size_t i = 0; i < json_array_size(list); i++) {
		json_int_t node = json_integer_value(json_array_get(list, i));
		if (node < 0 || (uint64_t)node >= w->nodes)
			return mr_fail(w->g->ctx, MR_EFORMAT,
			    "the scene names a node that is none of the %zu", w->nodes);
		w->shown[node] = true;
	}
	return MR_OK;
}

/* Composes the maps down to a node, and to those between that have none yet. */
static mr_status
place(walk *w, size_t node)
{
	size_t n = 0;

	for (size_t at = node; at != MR_UNKNOWN && !w->done[at]; at = w->parent[at]) {
		if (n == w->nodes)
			return mr_fail(w->g->ctx, MR_EFORMAT, "node %zu hangs from itself", node);
		w->path[n++] = at;
	}
	while (n-- > 0) {
		size_t at = w->path[n], above = w->parent[at];
		MR_TRY(mr_prefix(
		    w->g->ctx, node_map(w->g, mr_gltf_at(w->g, "nodes", at), &w->map[at]), "node %zu", at));
		if (above != MR_UNKNOWN) {
			w->map[at] = mr_compose(&w->map[above], &w->map[at]);
			w->shown[at] |= w->shown[above];
		}
		w->done[at] = true;
	}
	return MR_OK;
}

static void
add_instance(walk *w, size_t mesh, const mr_affine *map, const char *name)
{
	mr_gltf_scene *s = w->s;

	MR_RESERVE(w->g->ctx, s->instance, s->count, 1, &w->room);
	s->instance[s->count++] = (mr_gltf_instance){ .mesh = mesh,
		.map = *map,
		.name = name ? name : mr_gltf_name(mr_gltf_at(w->g, "meshes", mesh)) };
}

static mr_status
visit(walk *w, size_t node)
{
	const json_t *json = mr_gltf_at(w->g, "nodes", node);
	size_t mesh;

	MR_TRY(place(w, node));
	MR_TRY(mr_prefix(w->g->ctx, mr_gltf_index(w->g, json, "mesh", "meshes", &mesh), "node %zu", node));
	if (mesh == MR_UNKNOWN)
		return MR_OK;
	w->s->unseen += !w->shown[node];
	if (!w->shown[node])
		return MR_OK;
	w->s->several += json_object_get(json_object_get(json, "extensions"), "EXT_mesh_gpu_instancing") !=
	                 NULL;
	add_instance(w, mesh, &w->map[node], mr_gltf_name(json));
	return MR_OK;
}

mr_status
mr_gltf_scene_find(const mr_gltf *g, mr_gltf_scene *s)
{
	const mr_affine identity = mr_identity();
	size_t n = mr_gltf_size(g, "nodes"), scenes = mr_gltf_size(g, "scenes"), scene;
	walk w = { .g = g,
		.nodes = n,
		.s = s,
		.parent = MR_NEW(g->ctx, n, size_t),
		.path = MR_NEW(g->ctx, n, size_t),
		.map = MR_NEW(g->ctx, n, mr_affine),
		.done = MR_NEW_ZERO(g->ctx, n, bool),
		.shown = MR_NEW_ZERO(g->ctx, n, bool) };

	*s = (mr_gltf_scene){ 0 };
	MR_TRY(mr_gltf_index(g, g->root, "scene", "scenes", &scene));
	if (scenes && scene == MR_UNKNOWN)
		scene = 0;
	MR_TRY(find_parents(&w));
	MR_TRY(show_roots(&w, scene));
	for (size_t i = 0; i < n; i++)
		MR_TRY(visit(&w, i));
	for (size_t i = 0; scenes + s->count == 0 && i < mr_gltf_size(g, "meshes"); i++)
		add_instance(&w, i, &identity, NULL);
	return MR_OK;
}
