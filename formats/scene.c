/* Frames gathered for one file. */
#include "formats/format.h"

#include "mesh/layers.h"

/* ---- the layers of a frame ---- */

/* The parts of a frame that are written. */
typedef struct layers {
	const char **name;
	mr_model *model;
	size_t count;
} layers;

static mr_status
get_layers(mr_ctx *ctx, mr_frame *f, const char *list, layers *l)
{
	size_t most = 1;

	for (const char *c = list; c && *c; c++)
		most += *c == ',';
	*l = (layers){ .name = MR_NEW(ctx, most, const char *), .model = MR_NEW(ctx, most, mr_model) };
	for (const char *c = list; l->count < most; l->count++) {
		size_t bytes = c ? strcspn(c, ",") : 0;
		const char *name = c ? mr_format(ctx, "%.*s", (int)bytes, c) : NULL;
		MR_TRY(mr_layer_result(ctx, f, name, &l->name[l->count]));
		MR_TRY(mr_model_complete(ctx, f, l->name[l->count], &l->model[l->count]));
		c = c ? c + bytes + 1 : NULL;
	}
	return MR_OK;
}

/* ---- nodes and poses ---- */

static bool
same_bytes(const void *a, const void *b, size_t n)
{
	return a == b || n == 0 || (a && b && !memcmp(a, b, n));
}

/* Whether the models differ in places and normals alone. */
static bool
same_surface(const mr_model *a, const mr_model *b)
{
	return a->nv == b->nv && a->nf == b->nf && same_bytes(a->t, b->t, a->nf * sizeof *a->t) &&
	       same_bytes(a->color, b->color, 4 * a->nv) &&
	       same_bytes(a->texcoord, b->texcoord, 2 * a->nv * sizeof *a->texcoord) &&
	       same_bytes(a->corner_texcoord, b->corner_texcoord, 6 * a->nf * sizeof *a->corner_texcoord) &&
	       same_bytes(a->material, b->material, a->nf * sizeof *a->material);
}

/* Whether the frame shows what the open nodes show, in another pose. */
static bool
is_pose(const mr_scene *scene, const mr_frame *f, const layers *l)
{
	if (f->key || scene->nodes - scene->open != l->count)
		return false;
	for (size_t i = 0; i < l->count; i++) {
		const mr_scene_node *n = &scene->node[scene->open + i];
		if (strcmp(n->layer, l->name[i]) || !same_surface(&n->model, &l->model[i]))
			return false;
	}
	return true;
}

/* The models of the layers of a copy that outlives the frame. */
static mr_status
add_nodes(mr_ctx *ctx, mr_ctx *keep, mr_scene *scene, mr_frame *f, const layers *l)
{
	mr_frame *own;

	scene->open = scene->nodes;
	scene->takes++;
	MR_TRY(mr_frame_keep(ctx, keep, f, &own));
	own->key = false; /* losses have been reported */
	MR_RESERVE(keep, scene->node, scene->nodes, l->count, &scene->room);
	for (size_t i = 0; i < l->count; i++) {
		mr_scene_node *n = &scene->node[scene->nodes++];
		*n = (mr_scene_node){
			.take = scene->takes, .frame = own->name, .layer = mr_format(keep, "%s", l->name[i])
		};
		MR_TRY(mr_fail_as(ctx, keep, mr_model_complete(keep, own, n->layer, &n->model)));
	}
	return MR_OK;
}

/* A copy of n vectors; NULL of none. */
static void
copy_vectors(mr_ctx *keep, const mr_v3 *from, size_t n, const mr_v3 **to)
{
	mr_v3 *copy = from ? MR_NEW(keep, n, mr_v3) : NULL;

	*to = from ? memcpy(copy, from, n * sizeof *from) : NULL;
}

static void
add_target(mr_ctx *keep, mr_scene_node *n, const mr_model *m)
{
	mr_target t;

	copy_vectors(keep, m->p, m->nv, &t.p);
	copy_vectors(keep, m->normal, m->nv, &t.normal);
	copy_vectors(keep, m->corner_normal, 3 * m->nf, &t.corner_normal);
	MR_RESERVE(keep, n->target, n->targets, 1, &n->target_room);
	n->target[n->targets++] = t;
}

mr_status
mr_scene_add(mr_ctx *ctx, mr_ctx *keep, mr_scene *scene, mr_frame *f, const char *list)
{
	mr_sink losses = { .ctx = ctx };
	layers l;
	bool pose;

	MR_TRY(get_layers(ctx, f, list, &l));
	pose = is_pose(scene, f, &l);
	if (!pose && !f->key && scene->nodes)
		mr_lost(ctx, NULL, 1,
		    "motion: triangles, colors or materials differ from those of the frame before");
	for (size_t i = 0; i < l.count; i++) {
		mr_status status = pose ? mr_note_rounded(&losses, &l.model[i])
		                        : mr_glb_note_lost(&losses, &l.model[i]);
		MR_TRY(mr_prefix(ctx, status, "%s", l.name[i]));
	}
	for (size_t i = 0; pose && i < l.count; i++)
		add_target(keep, &scene->node[scene->open + i], &l.model[i]);
	return pose ? MR_OK : add_nodes(ctx, keep, scene, f, &l);
}
