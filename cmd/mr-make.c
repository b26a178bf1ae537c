/* mr-make -- generate a surface or a cloud of points of it.  See man/mr-make.1. */
#include "cmd.h"
#include "shape/shape.h"

static mr_make_opts opts = MR_MAKE_DEFAULTS;
static size_t seed = 1;

static const cmd_opt table[] = {
	{ 'n', "vertices", CMD_COUNT, &opts.vertices, 0, 1e9, "N",
	    "about how many vertices; 0 is 10,000, and 30,000 for bumpy", NULL },
	{ 0, "noise", CMD_LENGTH, CMD_LENGTH_OF(mr_make_opts, opts, noise), 0, INFINITY, "S",
	    "standard deviation of Gaussian noise along the normals", NULL },
	{ 0, "points", CMD_COUNT, &opts.points, 0, 1e9, "N",
	    "write a cloud of N points, uniform by area, instead of the mesh; 0 is the mesh", NULL },
	{ 0, "seed", CMD_COUNT, &seed, 0, 1e15, "K", "seed of points and noise", NULL },
	{ 0, "genus", CMD_COUNT, &opts.genus, 0, 100000, "G", "boxes: the number of holes", NULL },
	{ 0, "open", CMD_FLAG, &opts.open, 0, 0, NULL, "cylinder: without its caps", NULL },
	{ 0, "texcoords", CMD_FLAG, &opts.texcoords, 0, 0, NULL, "with texture coordinates", NULL },
	{ 0 },
};

static mr_status
choose_solid(cmd *c)
{
	if (c->operand_count != 1)
		return mr_fail(&c->ctx, MR_EUSAGE, "one SHAPE is expected, not %zu", c->operand_count);
	for (int i = 0; i < MR_SOLIDS; i++) {
		if (!strcmp(c->operands[0], mr_solid_names[i])) {
			opts.solid = (mr_solid)i;
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
	MR_TRY(cmd_idle(c, "genus", opts.solid != MR_BOXES, shape));
	MR_TRY(cmd_idle(c, "open", opts.solid != MR_CYLINDER, shape));
	MR_TRY(cmd_idle(c, "texcoords", opts.points > 0, "with --points"));
	return cmd_idle(
	    c, "seed", !cmd_given(c, "points") && !cmd_given(c, "noise"), "without --noise or --points");
}

static mr_status
make(cmd *c, const char *shape)
{
	mr_frame *f;

	(void)shape; /* choose_solid has read it */
	opts.seed = seed;
	MR_TRY(mr_make(&c->ctx, &opts, &f));
	return cmd_send(c, f);
}

const cmd_tool cmd_this = {
	.summary = "generate a surface, or a cloud of points of it",
	.operands = "SHAPE [OUT.mrs]",
	.options = table,
	.prepare = prepare,
	.source = make,
	.fixed_layers = true,
};
