/* mr-simplify -- simplify a surface by quadric error metrics.  See man/mr-simplify.1. */
#include "simplify/simplify.h"
#include "cmd.h"
#include "mesh/layers.h"

/* By default, but for control meshes. */
enum { FACES_A_FACE = 10 };

static mr_simplify_opts opts = MR_SIMPLIFY_DEFAULTS;
static size_t faces;
static double ratio;
static cmd_length error;
static const char *map_layer, *to;

static const cmd_opt table[] = {
	{ 'n', "faces", CMD_COUNT, &faces, 0, 4e9, "N", "stop at so many; 0: no such limit", NULL },
	{ 'r', "ratio", CMD_REAL, &ratio, 0, 1, "RATIO", "stop at this share; 0: no such limit", NULL },
	{ 'e', "error", CMD_LENGTH, &error, 0, 1e300, "LENGTH",
	    "most distance to the planes of what is merged; 0: no such limit", NULL },
	{ 0, "boundary", CMD_REAL, &opts.boundary, 0, 1e6, "WEIGHT", "of a boundary's planes", NULL },
	{ 't', "to", CMD_TEXT, &to, 0, 0, "LAYER", "write the result as that layer; the surface stays",
	    NULL },
	{ 0, "map", CMD_TEXT, &map_layer, 0, 0, "LAYER",
	    "keep the surface as that layer, with the places of its vertices on the result", NULL },
	{ 0 },
};

/* The layer that the result is written as. */
static const char *
result_layer(const mr_mesh *m)
{
	return to ? to : m->name;
}

/* The points that a control mesh is for: those of the frame, if there are any. */
static mr_status
read_points(mr_ctx *ctx, mr_frame *f, const mr_mesh *m, mr_mesh *points)
{
	*points = (mr_mesh){ 0 };
	if (strcmp(result_layer(m), "control") || !mr_frame_has_layer(f, "points"))
		return MR_OK;
	return mr_layer_points(ctx, f, "points", points);
}

/* The faces to stop at; 0: no such limit.  A control mesh is made for the points, or for the mesh that it
 * comes from. */
static size_t
target(mr_ctx *ctx, const mr_mesh *m, const mr_mesh *points)
{
	size_t asked = faces ? faces : (size_t)ceil(ratio * (double)m->nf);

	if (asked || error.value > 0)
		return asked;
	if (points->nv > 0)
		return mr_simplify_faces_for(ctx, points->nv);
	if (to && !strcmp(to, "control"))
		return mr_simplify_faces_for(ctx, m->nv);
	return m->nf / FACES_A_FACE;
}

static mr_status
weigh(mr_ctx *ctx, const mr_mesh *m, const mr_mesh *points)
{
	double *weight = NULL;

	if (points->nv > 0) {
		weight = MR_NEW(ctx, m->nv, double);
		if (!weight)
			return MR_EMEM;
		MR_TRY(mr_simplify_weigh(ctx, m, points->p, points->nv, weight));
	}
	opts.weight = weight;
	return MR_OK;
}

/* Keeps surface m as layer map_layer, with where its vertices lie on the result. */
static mr_status
put_map(cmd *c, mr_frame *f, const mr_mesh *m, const mr_mesh *out, const uint32_t *onto)
{
	char face[MR_COLUMN_MAX + 1], bary[MR_COLUMN_MAX + 1];
	mr_source_map map;

	MR_TRY(mr_simplify_map(&c->ctx, m, out, onto, &map));
	snprintf(face, sizeof face, "%s_face", m->name);
	snprintf(bary, sizeof bary, "%s_bary", m->name);
	MR_TRY(mr_layer_put_mesh(&c->ctx, f, map_layer, m));
	MR_TRY(mr_layer_put(&c->ctx, f, map_layer, face, map.face, m->nv));
	return mr_layer_put(&c->ctx, f, map_layer, bary, map.bary, m->nv);
}

/* Another tool would take the surface for what the layer holds by convention. */
static mr_status
check_name(cmd *c, const char *option, const char *layer)
{
	MR_TRY(cmd_layer_name(c, option, layer));
	if (layer && mr_layer_no_surface(layer))
		return mr_fail(&c->ctx, MR_EUSAGE, "%s: layer %s holds no surface", option, layer);
	return MR_OK;
}

static mr_status
prepare(cmd *c)
{
	MR_TRY(check_name(c, "--to", to));
	MR_TRY(check_name(c, "--map", map_layer));
	MR_TRY(cmd_idle(c, "map", to, "with --to, which keeps the surface"));
	return cmd_idle(c, "ratio", faces > 0, "with --faces");
}

static mr_status
simplify_frame(cmd *c, mr_frame *f)
{
	static const char *const reads[] = { "control", "base", "mesh", NULL };
	mr_ctx *ctx = &c->ctx;
	mr_source_map over, source;
	bool mapped = false;
	const char *layer;
	uint32_t *onto;
	mr_mesh m, points, out;

	MR_TRY(mr_layer_choose(ctx, f, c->layer, reads, &layer));
	MR_TRY(mr_layer_mesh(ctx, f, layer, &m));
	if ((map_layer && !strcmp(map_layer, layer)) || (to && !strcmp(to, layer)))
		return mr_fail(
		    ctx, MR_EUSAGE, "--%s: %s is the layer that is simplified", to ? "to" : "map", layer);
	MR_TRY(read_points(ctx, f, &m, &points));
	opts.faces = target(ctx, &m, &points);
	MR_TRY(weigh(ctx, &m, &points));
	opts.error = error.value > 0 ? cmd_length_of(error, mr_mesh_diagonal(&m)) : INFINITY;
	onto = MR_NEW(ctx, m.nv, uint32_t);
	if (!onto)
		return MR_EMEM;
	MR_TRY(mr_simplify(ctx, &m, &opts, &out, onto));
	if (to)
		return mr_layer_put_mesh(ctx, f, to, &out);
	if (!strcmp(layer, "base")) {
		MR_TRY(mr_simplify_source(ctx, &m, &out, onto, &over));
		MR_TRY(mr_source_map_follow(ctx, f, &m, &over, out.nv, &source, &mapped));
	}
	MR_TRY(mr_layer_put_mesh(ctx, f, layer, &out));
	if (mapped)
		MR_TRY(mr_source_map_put(ctx, f, &source, out.nv));
	return map_layer ? put_map(c, f, &m, &out, onto) : MR_OK;
}

int
main(int argc, char **argv)
{
	return cmd_main(argc, argv,
	    &(cmd_tool){ .summary = "simplify a surface by quadric error metrics",
		.options = table,
		.prepare = prepare,
		.frame = simplify_frame });
}
