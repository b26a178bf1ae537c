/* mr-make -- generate a surface or a cloud of points of it.  See man/mr-make.1. */
#include "cmd.h"
#include "mesh/layers.h"
#include "shape/shape.h"

static mr_solid_opts solid = MR_SOLID_DEFAULTS;
static cmd_length noise = { 0, false };
static size_t points = 0, seed = 1;

static const cmd_opt table[] = {
	{ 'n', "vertices", CMD_COUNT, &solid.vertices, 0, 1e9, "N",
	    "about how many vertices; 0 is 10,000, and 30,000 for bumpy", NULL },
	{ 0, "noise", CMD_LENGTH, &noise, 0, INFINITY, "S",
	    "standard deviation of Gaussian noise along the normals", NULL },
	{ 0, "points", CMD_COUNT, &points, 0, 1e9, "N",
	    "write a cloud of N points, uniform by area, instead of the mesh; 0 is the mesh", NULL },
	{ 0, "seed", CMD_COUNT, &seed, 0, 1e15, "K", "seed of points and noise", NULL },
	{ 0, "genus", CMD_COUNT, &solid.genus, 0, 100000, "G", "boxes: the number of holes", NULL },
	{ 0, "open", CMD_FLAG, &solid.open, 0, 0, NULL, "cylinder: without its caps", NULL },
	{ 0 },
};

static mr_status
choose_solid(cmd *c)
{
	if (c->operand_count != 1)
		return mr_fail(&c->ctx, MR_EUSAGE, "one SHAPE is expected, not %zu", c->operand_count);
	for (int i = 0; i < MR_SOLIDS; i++) {
		if (!strcmp(c->operands[0], mr_solid_names[i])) {
			solid.solid = (mr_solid)i;
			return MR_OK;
		}
	}
	return mr_fail(&c->ctx, MR_EUSAGE,
	    "unknown shape %s: sphere, torus, cube, plane, cylinder, knot, bumpy or boxes", c->operands[0]);
}

static mr_status
prepare(cmd *c)
{
	const char *shape;

	MR_TRY(choose_solid(c));
	shape = mr_format(&c->ctx, "on %s", c->operands[0]);
	if (!shape)
		return MR_EMEM;
	MR_TRY(cmd_idle(c, "genus", solid.solid != MR_BOXES, shape));
	MR_TRY(cmd_idle(c, "open", solid.solid != MR_CYLINDER, shape));
	return cmd_idle(
	    c, "seed", !cmd_given(c, "points") && !cmd_given(c, "noise"), "without --noise or --points");
}

static mr_status
put_mesh(cmd *c, mr_frame *f, mr_mesh *m)
{
	mr_v3 *p = MR_NEW(&c->ctx, m->nv, mr_v3), *normal = MR_NEW(&c->ctx, m->nv, mr_v3);

	if (!p || !normal)
		return MR_EMEM;
	if (noise.value > 0) {
		MR_TRY(mr_vertex_normals(&c->ctx, m, NULL, normal));
		memcpy(p, m->p, m->nv * sizeof *p);
		mr_add_noise(p, normal, m->nv, cmd_length_of(noise, mr_mesh_diagonal(m)), seed);
		m->p = p;
	}
	return mr_layer_put_mesh(&c->ctx, f, "mesh", m);
}

static mr_status
put_points(cmd *c, mr_frame *f, const mr_mesh *m)
{
	mr_v3 *p, *normal;

	MR_TRY(mr_surface_sample(&c->ctx, m, points, seed, &p, &normal));
	mr_add_noise(p, normal, points, cmd_length_of(noise, mr_mesh_diagonal(m)), seed + 1);
	MR_TRY(mr_layer_put(&c->ctx, f, "points", "position", p, points));
	return mr_layer_put(&c->ctx, f, "points", "normal", normal, points);
}

static mr_status
make(cmd *c)
{
	mr_frame *f;
	mr_mesh m;

	MR_TRY(mr_solid_make(&c->ctx, &solid, &m));
	MR_TRY(mr_frame_new(&c->ctx, m.name, &f));
	MR_TRY(points ? put_points(c, f, &m) : put_mesh(c, f, &m));
	return cmd_send(c, f);
}

int
main(int argc, char **argv)
{
	return cmd_main(argc, argv,
	    &(cmd_tool){ .summary = "generate a surface, or a cloud of points of it",
		.operands = "SHAPE",
		.options = table,
		.prepare = prepare,
		.source = make,
		.fixed_layers = true });
}
