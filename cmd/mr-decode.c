/* mr-decode -- put the detail of a mesh back onto its base surface.  See man/mr-decode.1. */
#include "alg/deform.h"
#include "alg/detail.h"
#include "alg/handles.h"
#include "cmd.h"
#include "mesh/layers.h"

static double gain = 1;

static const cmd_opt table[] = {
	{ 'g', "gain", CMD_REAL, &gain, -1e6, 1e6, "G", "multiply the detail by G", NULL },
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

	*inc = &kept.inc;
	if (!f->key && serial && serial == kept.serial)
		return MR_OK;
	if (kept.serial)
		mr_mark_release(&c->keep, kept.mark);
	kept.serial = 0;
	kept.mark = mr_mark_take(&c->keep);
	MR_TRY(mr_incidence_build(&c->keep, base, &kept.inc));
	kept.serial = serial;
	return MR_OK;
}

/* Poses the base by its response, where the frame has handles; they are used up. */
static mr_status
pose_base(mr_ctx *ctx, mr_frame *f, mr_mesh *base)
{
	const mr_column *column = mr_frame_find(f, "base", "response");
	mr_v3 *p = MR_NEW(ctx, base->nv, mr_v3);
	const void *response;
	mr_mesh posed;
	mr_affine *t;
	size_t n;

	if (!mr_layer_has(f, "handles", "transform"))
		return MR_OK;
	if (!column)
		return mr_fail(ctx, MR_EMISSING,
		    "handles, but no base.response: pose the base by mr-solve, or give it its response by "
		    "mr-solve --basis");
	MR_TRY(mr_layer_get_rows(ctx, f, "base", "response", base->nv, &response));
	MR_TRY(mr_handles_rows(ctx, f, column->shape.components / 4, &t, &n));
	if (column->shape.components != 4 * n)
		return mr_fail(ctx, MR_ERANGE,
		    "base: column response has %u values a vertex, not 4 for each of %zu handles",
		    column->shape.components, n);
	if (!p)
		return MR_EMEM;
	MR_TRY(mr_pose_by_response(ctx, base->p, base->nv, response, n, t, p));
	mr_frame_drop(f, "handles", NULL, 0);
	mr_frame_drop(f, "base", "response", 0);
	mr_frame_drop(f, "base", "normal", 0);
	MR_TRY(mr_layer_put_positions(ctx, f, "base", p, base->nv));
	MR_TRY(mr_layer_points(ctx, f, "base", &posed)); /* a response that is not finite shows here */
	base->p = posed.p;
	return MR_OK;
}

static mr_status
decode_frame(cmd *c, mr_frame *f)
{
	const mr_incidence *inc;
	mr_detail detail;
	mr_mesh base;
	mr_v3 *p;

	MR_TRY(mr_layer_mesh(&c->ctx, f, "base", &base));
	MR_TRY(base_incidence(c, f, &base, &inc));
	MR_TRY(pose_base(&c->ctx, f, &base));
	MR_TRY(mr_detail_get(&c->ctx, f, &base, &detail));
	p = MR_NEW(&c->ctx, detail.n, mr_v3);
	if (!p)
		return MR_EMEM;
	MR_TRY(mr_decode(&c->ctx, &base, inc, &detail, gain, p));
	mr_frame_drop(f, "mesh", "normal", 0);
	return mr_layer_put_positions(&c->ctx, f, "mesh", p, detail.n);
}

int
main(int argc, char **argv)
{
	return cmd_main(argc, argv,
	    &(cmd_tool){ .summary = "put the detail of a mesh back onto its base surface",
		.options = table,
		.frame = decode_frame,
		.fixed_layers = true });
}
