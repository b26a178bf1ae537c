/* mr-pose -- move, turn and scale a handle.  See man/mr-pose.1. */
#include "cmd.h"
#include "edit/handles.h"

static mr_motion motion = { .pose = MR_POSE_REST };
static const char *script_path;
static mr_script script;
static bool posed; /* by options, not by a script */

static mr_status
set_pose(mr_ctx *ctx, const cmd_opt *o, const char *text)
{
	posed = true;
	return mr_pose_set(ctx, &motion.pose, o->name, text);
}

static const cmd_opt table[] = {
	{ 'H', "handle", CMD_COUNT, &motion.handle, 0, 65535, "N", "the handle to pose", NULL },
	{ 't', "translate", CMD_CALL, NULL, 0, 0, "X,Y,Z", "move it (default 0,0,0)", set_pose },
	{ 'r', "rotate", CMD_CALL, NULL, 0, 0, "AX,AY,AZ,DEG",
	    "turn it about this axis, by DEG degrees (default 0,0,1,0)", set_pose },
	{ 's', "scale", CMD_CALL, NULL, 0, 0, "S|SX,SY,SZ", "scale it (default 1)", set_pose },
	{ 'c', "center", CMD_CALL, NULL, 0, 0, "X,Y,Z",
	    "turn and scale about this point (default: the centroid of the handle's vertices, as posed so "
	    "far)",
	    set_pose },
	{ 'F', "frames", CMD_COUNT, &motion.frames, 0, 1e6, "F",
	    "go there in F frames, after one at rest (default 0: at once)", NULL },
	{ 'S', "script", CMD_TEXT, &script_path, 0, 0, "FILE", "take a sequence of poses from FILE", NULL },
	{ 0 },
};

static mr_status
prepare(cmd *c)
{
	if (script_path && (posed || motion.frames))
		return mr_fail(&c->ctx, MR_EUSAGE, "--script excludes --frames and the options of one pose");
	MR_TRY(cmd_idle(c, "handle", script_path, "with --script, which names handles itself"));
	if (!script_path)
		return motion.frames ? mr_pose_check_shares(&c->ctx, &motion.pose) : MR_OK;
	motion.script = &script;
	return mr_script_read(&c->keep, script_path, &script);
}

/* Sends the frame, posed, and leaves it as it was. */
static mr_status
send(cmd *c, const mr_frame *f, const mr_handles *h, size_t number)
{
	MR_SCOPE(&c->ctx);
	mr_frame copy;

	mr_frame_copy(&c->ctx, f, &copy);
	if (number > 0 && f->key) {
		copy.key = false;
		copy.name = mr_format(&c->ctx, "%s-%04zu", f->name, number);
	}
	MR_TRY(mr_motion_put(&c->ctx, &copy, h, &motion, number));
	return cmd_send(c, &copy);
}

/* Whether the sequence ends before the motion does. */
static mr_status
look_at_length(cmd *c, mr_frame *f, size_t length)
{
	size_t frames;

	MR_TRY(mr_handles_frames(&c->ctx, f, &frames));
	if (f->key && frames > 0 && frames < length)
		mr_found(&c->ctx,
		    &(mr_finding){ .kind = MR_LIMIT, .what = "the sequence ends before the motion does" });
	return MR_OK;
}

/* The column handles.frames says how many deltas of a sequence follow its key: so one mr-pose makes the
 * sequence, and later ones pose the frames that come. */
static mr_status
pose_frame(cmd *c, mr_frame *f)
{
	static size_t at; /* frames since the key */
	static uint32_t announced;
	static bool made; /* a sequence of the last key */
	size_t length = mr_motion_length(&motion);
	mr_handles h;

	at = f->key ? 0 : at + 1;
	made &= !f->key;
	MR_TRY(look_at_length(c, f, length));
	MR_TRY(mr_handles_of_frame(&c->ctx, f, c->layer, &h));
	if (made && !f->key)
		return mr_fail(&c->ctx, MR_EUSAGE,
		    "this frame is one of a sequence, whose length is not known any more, and --frames or "
		    "--script would make one of each frame: pose it without them");
	if (length == 0 || !f->key || mr_layer_has(f, "handles", "frames"))
		return send(c, f, &h, length == 0 ? 0 : at);
	made = true;
	announced = (uint32_t)length;
	MR_TRY(mr_frame_put(&c->ctx, f, "handles", "frames", (mr_shape){ '-', 'u', 1 }, &announced, 1));
	for (size_t i = 0; i <= length; i++)
		MR_TRY(send(c, f, &h, i));
	return MR_OK;
}

const cmd_tool cmd_this = {
	.summary = "move, turn and scale a handle",
	.options = table,
	.prepare = prepare,
	.frame = pose_frame,
	.sends = true,
};
