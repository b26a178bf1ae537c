/* mr-pose -- say where a handle goes.  See man/mr-pose.1. */
#include "alg/handles.h"
#include "cmd.h"
#include "mesh/layers.h"

static size_t handle, frames;
static const char *script_path;
static mr_script script;
static mr_pose pose = MR_POSE_REST;
static bool posed; /* by options, not by a script */

static mr_status
set_pose(mr_ctx *ctx, const cmd_opt *o, const char *text)
{
	posed = true;
	return mr_pose_set(ctx, &pose, o->name, text);
}

static const cmd_opt table[] = {
	{ 'H', "handle", CMD_COUNT, &handle, 0, 65535, "N", "the handle to pose", NULL },
	{ 't', "translate", CMD_CALL, NULL, 0, 0, "X,Y,Z", "move it (default 0,0,0)", set_pose },
	{ 'r', "rotate", CMD_CALL, NULL, 0, 0, "AX,AY,AZ,DEG",
	    "turn it about this axis, by DEG degrees (default 0,0,1,0)", set_pose },
	{ 's', "scale", CMD_CALL, NULL, 0, 0, "S|SX,SY,SZ", "scale it (default 1)", set_pose },
	{ 'c', "center", CMD_CALL, NULL, 0, 0, "X,Y,Z",
	    "turn and scale about this point (default: the centroid of the handle's vertices, as posed so "
	    "far)",
	    set_pose },
	{ 'F', "frames", CMD_COUNT, &frames, 0, 1e6, "F",
	    "go there in F frames behind one at rest (default 0: at once)", NULL },
	{ 'S', "script", CMD_TEXT, &script_path, 0, 0, "FILE", "take a sequence of poses from FILE", NULL },
	{ 0 },
};

static mr_status
prepare(cmd *c)
{
	if (script_path && (posed || frames))
		return mr_fail(&c->ctx, MR_EUSAGE, "--script excludes --frames and the options of one pose");
	MR_TRY(cmd_idle(c, "handle", script_path, "with --script, which names handles itself"));
	if (script_path)
		return mr_script_read(&c->keep, script_path, &script);
	return frames ? mr_pose_check_shares(&c->ctx, &pose) : MR_OK;
}

/* How many frames follow the one at rest; 0: there is no sequence. */
static size_t
length(void)
{
	return script_path ? script.frames : frames;
}

/* Poses frame `number` of the sequence: 0 is at rest, behind the last the last pose stays. */
static mr_status
pose_number(cmd *c, mr_frame *f, const mr_handles *h, size_t number)
{
	double share = frames == 0 || number >= frames ? 1 : (double)number / (double)frames;
	mr_affine *row;
	size_t n;

	MR_TRY(mr_handles_rows(&c->ctx, f, h->n, &row, &n));
	if (script_path)
		MR_TRY(mr_script_pose(&c->ctx, h, &script, number, row));
	else
		MR_TRY(mr_handles_pose(&c->ctx, h, handle, &pose, share, row));
	return mr_layer_put(&c->ctx, f, "handles", "transform", row, n);
}

/* Sends the frame, posed, and leaves it as it was. */
static mr_status
send(cmd *c, const mr_frame *f, const mr_handles *h, size_t number)
{
	mr_mark mark = mr_mark_take(&c->ctx);
	mr_frame copy;

	MR_TRY(mr_frame_copy(&c->ctx, f, &copy));
	if (number > 0 && f->key) {
		copy.key = false;
		copy.name = mr_format(&c->ctx, "%s-%04zu", f->name, number);
		if (!copy.name)
			return MR_EMEM;
	}
	MR_TRY(pose_number(c, &copy, h, number));
	MR_TRY(cmd_send(c, &copy));
	mr_mark_release(&c->ctx, mark);
	return MR_OK;
}

/* The layer with the regions: -l, else the mesh, else the control mesh. */
static mr_status
find_handles(cmd *c, mr_frame *f, mr_handles *h)
{
	const char *layer = c->layer ? c->layer : mr_layer_has(f, "mesh", "region") ? "mesh" : "control";
	const uint32_t *region;
	mr_mesh m;

	if (!mr_layer_has(f, layer, "region"))
		return mr_fail(&c->ctx, MR_EMISSING, "no regions: they come from mr-select");
	MR_TRY(mr_layer_points(&c->ctx, f, layer, &m));
	MR_TRY(mr_layer_region(&c->ctx, f, layer, m.nv, &region));
	return mr_handles_find(&c->ctx, &m, region, h);
}

/*
 * The column handles.frames says how many deltas of a sequence follow its key: so one
 * mr-pose makes the sequence, and those behind it pose the frames that come.
 */
static mr_status
pose_frame(cmd *c, mr_frame *f)
{
	static size_t at; /* frames since the key */
	static uint32_t announced;
	mr_handles h;

	at = f->key ? 0 : at + 1;
	MR_TRY(find_handles(c, f, &h));
	if (length() == 0 || !f->key || mr_layer_has(f, "handles", "frames"))
		return send(c, f, &h, length() == 0 ? 0 : at);
	announced = (uint32_t)length();
	MR_TRY(mr_frame_put(&c->ctx, f, "handles", "frames", (mr_shape){ '-', 'u', 1 }, &announced, 1));
	for (size_t i = 0; i <= length(); i++)
		MR_TRY(send(c, f, &h, i));
	return MR_OK;
}

int
main(int argc, char **argv)
{
	return cmd_main(argc, argv,
	    &(cmd_tool){ .summary = "say where a handle goes",
		.options = table,
		.prepare = prepare,
		.frame = pose_frame,
		.sends = true });
}
