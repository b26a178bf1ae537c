/* mr-simplify -- simplify a surface by quadric error metrics.  See man/mr-simplify.1. */
#include "alg/simplify.h"
#include "cmd.h"
#include "mesh/layers.h"

/* By default, of a control mesh that has points, and of others. */
enum { POINTS_A_FACE = 32, FACES_A_FACE = 10 };

/* Of a control mesh, at least so many, or one for every so many points where that is less: fewer would not
 * follow a surface with limbs or handles.  But never fewer than an icosahedron has: the limit surface of
 * those is small within them, and a fit to points as few would have to blow them up. */
enum { LEAST = 300, LEAST_POINTS_A_FACE = 4, ROUND = 20 };

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

/* The faces of a control mesh for n points. */
static size_t
faces_for(mr_ctx *ctx, size_t n)
{
	size_t count = n / POINTS_A_FACE, least = n / LEAST_POINTS_A_FACE;

	least = least < ROUND ? ROUND : least < LEAST ? least : LEAST;
	if (count >= least)
		return count;
	mr_note(ctx, "%zu faces for %zu points, as one for every %d would be too few", least, n,
	    (int)POINTS_A_FACE);
	return least;
}

/* The faces to stop at; 0: no such limit.  A control mesh is made for the points, or for the mesh that it
 * comes from. */
static mr_status
target(cmd *c, mr_frame *f, const mr_mesh *m, size_t *n)
{
	mr_mesh points;

	*n = faces ? faces : (size_t)ceil(ratio * (double)m->nf);
	if (*n || error.value > 0)
		return MR_OK;
	*n = m->nf / FACES_A_FACE;
	if (strcmp(to ? to : m->name, "control"))
		return MR_OK;
	if (!mr_frame_has_layer(f, "points")) {
		*n = to ? faces_for(&c->ctx, m->nv) : *n;
		return MR_OK;
	}
	MR_TRY(mr_layer_points(&c->ctx, f, "points", &points));
	*n = faces_for(&c->ctx, points.nv);
	return MR_OK;
}

/* A control mesh is to be as dense as the points. */
static mr_status
weigh(mr_ctx *ctx, mr_frame *f, const mr_mesh *m)
{
	mr_mesh points;
	double *w = MR_NEW(ctx, m->nv, double);

	opts.weight = w;
	MR_TRY(mr_layer_points(ctx, f, "points", &points));
	return w ? mr_simplify_weigh(ctx, m, points.p, points.nv, w) : MR_EMEM;
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
	mr_mesh m, out;

	MR_TRY(mr_layer_choose(ctx, f, c->layer, reads, &layer));
	MR_TRY(mr_layer_mesh(ctx, f, layer, &m));
	if ((map_layer && !strcmp(map_layer, layer)) || (to && !strcmp(to, layer)))
		return mr_fail(
		    ctx, MR_EUSAGE, "--%s: %s is the layer that is simplified", to ? "to" : "map", layer);
	MR_TRY(target(c, f, &m, &opts.faces));
	opts.weight = NULL;
	if (!strcmp(to ? to : layer, "control") && mr_frame_has_layer(f, "points"))
		MR_TRY(weigh(ctx, f, &m));
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
