/* mr-pose, of one handle and one frame; sequences and scripts are edit/handles.h. */
#include "edit/handles.h"

static mr_status
check_pose(mr_ctx *ctx, const mr_pose *pose)
{
	if (!mr_finite(pose->translate) || !mr_finite(pose->scale) || !mr_finite(pose->axis) ||
	    !isfinite(pose->degrees) || (pose->centered && !mr_finite(pose->center)))
		return mr_fail(ctx, MR_EUSAGE, "the pose has a number that is not finite");
	if (pose->degrees != 0 && !(mr_norm2(pose->axis) > 0))
		return mr_fail(ctx, MR_EUSAGE, "the axis of the rotation has no direction");
	return MR_OK;
}

mr_status
mr_pose_frame(mr_ctx *ctx, mr_frame *f, const char *layer, size_t handle, const mr_pose *pose)
{
	mr_motion motion = { .handle = handle, .pose = *pose };
	mr_frame done;
	mr_handles h;

	MR_ENTER(ctx);
	MR_TRY(check_pose(ctx, pose));
	mr_frame_copy(ctx, f, &done);
	MR_TRY(mr_handles_of_frame(ctx, &done, layer, &h));
	MR_TRY(mr_motion_put(ctx, &done, &h, &motion, 0));
	*f = done;
	return MR_OK;
}
