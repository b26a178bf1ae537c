/* mr-equalize -- weigh the levels of a displacement against each other.  See man/mr-equalize.1. */
#include "subdivide/displaced.h"
#include "subdivide/wavelet.h"
#include "cmd.h"

static const char *gains_text;
static double gain[MR_LEVEL_MAX + 1];
static size_t gains;

static const cmd_opt table[] = {
	{ 'g', "gain", CMD_TEXT, &gains_text, 0, 0, "G0,G1,...",
	    "factors of the control mesh's heights and of each level's, coarse first (default 1)", NULL },
	{ 0 },
};

static mr_status
prepare(cmd *c)
{
	for (size_t i = 0; i <= MR_LEVEL_MAX; i++)
		gain[i] = 1;
	if (!gains_text)
		return MR_OK;
	gains = 1;
	for (const char *s = gains_text; *s; s++)
		gains += *s == ',';
	if (gains > MR_LEVEL_MAX + 1)
		return mr_fail(&c->ctx, MR_EUSAGE,
		    "--gain: %zu factors, but there are at most %d levels and one", gains, MR_LEVEL_MAX);
	return cmd_parse_reals(&c->ctx, "--gain", gains_text, gains, gain);
}

static mr_level_cache kept;

static mr_status
equalize_frame(cmd *c, mr_frame *f)
{
	const mr_loop *level;
	const double *height;
	mr_mesh control;
	double *x;
	size_t n;

	MR_TRY(mr_layer_mesh(&c->ctx, f, "control", &control));
	MR_TRY(mr_displacement_get(&c->ctx, f, &control, &n, &height));
	if (gains > n + 1)
		return mr_fail(&c->ctx, MR_ERANGE,
		    "%zu gains, but displacement has level %zu: %zu of them at most", gains, n, n + 1);
	MR_TRY(mr_level_cache_get(&kept, &c->keep, f, &control, 180, n, &level));
	x = MR_NEW(&c->ctx, level[n].nv, double);
	if (!x)
		return MR_EMEM;
	memcpy(x, height, level[n].nv * sizeof *x);
	MR_TRY(mr_equalize(&c->ctx, level, n, gain, x));
	return mr_layer_put(&c->ctx, f, "displacement", "height", x, level[n].nv);
}

int
main(int argc, char **argv)
{
	return cmd_main(argc, argv,
	    &(cmd_tool){ .summary = "weigh the levels of a displacement against each other",
		.options = table,
		.prepare = prepare,
		.frame = equalize_frame,
		.fixed_layers = true });
}
