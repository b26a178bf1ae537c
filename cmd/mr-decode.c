/* mr-decode -- put detail back onto its base surface, and heights onto a subdivision surface.  See
 * man/mr-decode.1. */
#include "edit/detail.h"
#include "subdivide/displaced.h"
#include "edit/pose_basis.h"
#include "cmd.h"

typedef enum source { DETAIL, CONTROL } source;

static double gain = 1;
static size_t level;
static int from;

static const cmd_opt table[] = {
	{ 'g', "gain", CMD_REAL, &gain, -1e6, 1e6, "G", "multiply the detail by G", NULL },
	{ 0, "level", CMD_COUNT, &level, 0, MR_LEVEL_MAX, "J",
	    "subdivisions of the control mesh (default: as many as have heights)", NULL },
	{ 0, "from", CMD_CHOICE, &from, 0, 0, "detail|control",
	    "what to put the mesh together from (default: detail where it is there)", NULL },
	{ 0 },
};

/* The base's incidence, which outlives the frame: a delta mostly keeps the triangles. */
static struct {
	mr_incidence inc;
	mr_mark mark;
	uint64_t serial; /* of base.triangles; 0: none is kept */
} kept;

static mr_status
base_incidence(cmd *c, const mr_frame *f, const mr_mesh *base, const mr_incidence **inc)
{
	uint64_t serial = mr_frame_find(f, "base", "triangles")->serial;
	mr_status status;

	*inc = &kept.inc;
	if (!f->key && serial && serial == kept.serial)
		return MR_OK;
	if (kept.serial)
		mr_mark_release(&c->keep, kept.mark);
	kept.serial = 0;
	kept.mark = mr_mark_take(&c->keep);
	status = mr_incidence_build(&c->keep, base, &kept.inc);
	if (status == MR_OK)
		kept.serial = serial;
	else
		mr_mark_release(&c->keep, kept.mark);
	return status;
}

static mr_status
decode_detail(cmd *c, mr_frame *f)
{
	const mr_incidence *inc;
	mr_detail detail;
	mr_mesh base;
	mr_v3 *p;

	MR_TRY(mr_layer_mesh(&c->ctx, f, "base", &base));
	MR_TRY(base_incidence(c, f, &base, &inc));
	MR_TRY(mr_response_apply(&c->ctx, f, &base));
	MR_TRY(mr_detail_get(&c->ctx, f, &base, &detail));
	p = MR_NEW(&c->ctx, detail.n, mr_v3);
	if (!p)
		return MR_EMEM;
	MR_TRY(mr_decode(&c->ctx, &base, inc, &detail, gain, p));
	return mr_layer_move(&c->ctx, f, "mesh", MR_POSED, p, detail.n);
}

static mr_level_cache levels;

/* Level J of the surface needs the first heights alone. */
static mr_status
decode_control(cmd *c, mr_frame *f)
{
	const mr_loop *refined;
	const double *height;
	mr_mesh control;
	mr_domain d;
	mr_v3 *p;
	size_t n;

	MR_TRY(mr_layer_mesh(&c->ctx, f, "control", &control));
	MR_TRY(mr_displacement_get(&c->ctx, f, &control, &n, &height));
	if (cmd_given(c, "level") && level > n)
		return mr_fail(
		    &c->ctx, MR_ERANGE, "--level %zu, but displacement ends with level %zu", level, n);
	if (cmd_given(c, "level"))
		n = level;
	MR_TRY(mr_response_apply(&c->ctx, f, &control));
	MR_TRY(mr_level_cache_get(&levels, &c->keep, f, &control, 180, n, &refined));
	MR_TRY(mr_domain_on(&c->ctx, &control, refined, n, &d));
	p = MR_NEW(&c->ctx, d.m.nv, mr_v3);
	if (!p)
		return MR_EMEM;
	mr_domain_displace(&c->ctx, &d, height, gain, p);
	d.m.p = p;
	return mr_layer_put_mesh(&c->ctx, f, "mesh", &d.m);
}

static mr_status
choose(cmd *c, const mr_frame *f, int *chosen)
{
	bool detail = mr_layer_has(f, "mesh", "detail_face");

	*chosen = from;
	if (cmd_given(c, "from"))
		return MR_OK;
	if (!detail && !mr_frame_has_layer(f, "displacement"))
		return mr_fail(&c->ctx, MR_EMISSING,
		    "neither detail of mesh, which mr-encode makes, nor displacement, which mr-sample makes");
	*chosen = detail ? DETAIL : CONTROL;
	if (detail && cmd_given(c, "level"))
		return mr_fail(
		    &c->ctx, MR_EUSAGE, "--level has no effect on the detail that is here: --from control");
	return MR_OK;
}

static mr_status
decode_frame(cmd *c, mr_frame *f)
{
	int chosen;

	MR_TRY(choose(c, f, &chosen));
	return chosen == DETAIL ? decode_detail(c, f) : decode_control(c, f);
}

static mr_status
prepare(cmd *c)
{
	return cmd_idle(c, "level", cmd_given(c, "from") && from == DETAIL, "with --from detail");
}

int
main(int argc, char **argv)
{
	return cmd_main(argc, argv,
	    &(cmd_tool){ .summary = "put detail or heights back onto their smooth surface",
		.options = table,
		.prepare = prepare,
		.frame = decode_frame,
		.fixed_layers = true });
}
