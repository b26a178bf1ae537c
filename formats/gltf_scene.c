/* The scene of a glTF document: its nodes, from which meshes hang, are walked from the roots. */
#include "formats/gltf.h"

mr_status
mr_gltf_numbers(const mr_gltf *g, const json_t *object, const char *key, size_t count, double *x, bool *there)
{
	json_t *list = json_object_get(object, key);

	*there = list != NULL;
	if (list && json_array_size(list) != count)
		return mr_fail(
		    g->ctx, MR_EFORMAT, "%s has %zu numbers, not %zu", key, json_array_size(list), count);
	for (size_t i = 0; list && i < count; i++) {
		json_t *value = json_array_get(list, i);
		if (!json_is_number(value))
			return mr_fail(g->ctx, MR_EFORMAT, "%s: value %zu is no number", key, i);
		x[i] = json_number_value(value);
	}
	return MR_OK;
}

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

const char *
mr_gltf_name(const json_t *thing)
{
	const char *name = json_string_value(json_object_get(thing, "name"));

	return name && *name ? name : NULL;
}

typedef struct waiting {
	size_t node;
	mr_affine above; /* of what it hangs from */
} waiting;

typedef struct walk {
	const mr_gltf *g;
	waiting *pile; /* nodes that are still to be looked at, the next one last */
	size_t count, room;
	bool *seen; /* of each node */
	mr_gltf_instance *found;
	size_t instances, found_room;
	size_t several; /* nodes that show their mesh several times */
} walk;

static mr_status
push_instance(walk *w, size_t mesh, const mr_affine *map, const char *name)
{
	MR_TRY(MR_RESERVE(w->g->ctx, w->found, w->instances, 1, &w->found_room));
	w->found[w->instances++] = (mr_gltf_instance){ .mesh = mesh,
		.map = *map,
		.name = name ? name : mr_gltf_name(mr_gltf_at(w->g, "meshes", mesh)) };
	return MR_OK;
}

/* Puts a list of nodes on the pile, the first last. */
static mr_status
pile_up(walk *w, json_t *list, const mr_affine *above)
{
	mr_ctx *ctx = w->g->ctx;
	size_t n = json_array_size(list), nodes = mr_gltf_size(w->g, "nodes");

	MR_TRY(MR_RESERVE(ctx, w->pile, w->count, n, &w->room));
	for (size_t i = n; i-- > 0;) {
		json_t *value = json_array_get(list, i);
		json_int_t node = json_integer_value(value);
		if (!json_is_integer(value) || node < 0 || (uint64_t)node >= nodes)
			return mr_fail(ctx, MR_EFORMAT, "a node names a node that is none of the %zu", nodes);
		if (w->seen[node]) /* a tree by the specification: else it might have no end */
			return mr_fail(ctx, MR_EFORMAT, "node %zu hangs from more than one", (size_t)node);
		w->seen[node] = true;
		w->pile[w->count++] = (waiting){ (size_t)node, *above };
	}
	return MR_OK;
}

static mr_status
visit(walk *w, waiting at)
{
	const json_t *node = mr_gltf_at(w->g, "nodes", at.node);
	mr_affine own, map;
	size_t mesh;

	MR_TRY(node_map(w->g, node, &own));
	map = mr_compose(&at.above, &own);
	MR_TRY(mr_gltf_index(w->g, node, "mesh", "meshes", &mesh));
	w->several += mesh != MR_UNKNOWN &&
	              json_object_get(json_object_get(node, "extensions"), "EXT_mesh_gpu_instancing");
	if (mesh != MR_UNKNOWN)
		MR_TRY(push_instance(w, mesh, &map, mr_gltf_name(node)));
	return pile_up(w, json_object_get(node, "children"), &map);
}

/* Puts the nodes that hang from none on the pile, the first last: without scenes all are shown. */
static mr_status
pile_up_roots(walk *w)
{
	size_t nodes = mr_gltf_size(w->g, "nodes");
	bool *hangs = MR_NEW_ZERO(w->g->ctx, nodes, bool);

	if (!hangs)
		return MR_EMEM;
	for (size_t i = 0; i < nodes; i++) {
		const json_t *list = json_object_get(mr_gltf_at(w->g, "nodes", i), "children");
		for (size_t k = 0; k < json_array_size(list); k++) {
			json_int_t child = json_integer_value(json_array_get(list, k));
			if (child >= 0 && (uint64_t)child < nodes)
				hangs[child] = true;
		}
	}
	MR_TRY(MR_RESERVE(w->g->ctx, w->pile, w->count, nodes, &w->room));
	for (size_t i = nodes; i-- > 0;)
		if (!hangs[i]) {
			w->seen[i] = true;
			w->pile[w->count++] = (waiting){ i, mr_identity() };
		}
	return MR_OK;
}

/* scene: MR_UNKNOWN where there are none. */
static mr_status
walk_scene(walk *w, size_t scene)
{
	const mr_affine identity = mr_identity();

	if (scene == MR_UNKNOWN)
		MR_TRY(pile_up_roots(w));
	else
		MR_TRY(pile_up(w, json_object_get(mr_gltf_at(w->g, "scenes", scene), "nodes"), &identity));
	while (w->count) {
		waiting at = w->pile[--w->count];
		MR_TRY(mr_prefix(w->g->ctx, visit(w, at), "node %zu", at.node));
	}
	return MR_OK;
}

static mr_status
count_unseen(const walk *w, size_t *count)
{
	size_t meshes = mr_gltf_size(w->g, "meshes");
	bool *seen = MR_NEW_ZERO(w->g->ctx, meshes, bool);

	if (!seen)
		return MR_EMEM;
	*count = meshes;
	for (size_t i = 0; i < w->instances; i++) {
		*count -= !seen[w->found[i].mesh];
		seen[w->found[i].mesh] = true;
	}
	return MR_OK;
}

mr_status
mr_gltf_scene(const mr_gltf *g, const mr_gltf_instance **list, size_t *count, size_t *unseen, size_t *several)
{
	const mr_affine identity = mr_identity();
	size_t scene, scenes = mr_gltf_size(g, "scenes");
	walk w = { .g = g, .seen = MR_NEW_ZERO(g->ctx, mr_gltf_size(g, "nodes"), bool) };

	if (!w.seen)
		return MR_EMEM;
	MR_TRY(mr_gltf_index(g, g->root, "scene", "scenes", &scene));
	if (scenes && scene == MR_UNKNOWN)
		scene = 0;
	MR_TRY(walk_scene(&w, scene));
	for (size_t i = 0; scenes + w.instances == 0 && i < mr_gltf_size(g, "meshes"); i++)
		MR_TRY(push_instance(&w, i, &identity, NULL));
	MR_TRY(count_unseen(&w, unseen));
	*several = w.several;
	*list = w.found;
	*count = w.instances;
	return MR_OK;
}
