/* mr-pose, of one handle and one frame; sequences and scripts are edit/handles.h. */
#include "edit/handles.h"

mr_status
mr_pose_frame(mr_ctx *ctx, mr_frame *f, const char *layer, size_t handle, const mr_pose *pose)
{
	mr_motion motion = { .handle = handle, .pose = *pose };
	mr_frame done;
	mr_handles h;

	MR_TRY(mr_frame_copy(ctx, f, &done));
	MR_TRY(mr_handles_of_frame(ctx, &done, layer, &h));
	MR_TRY(mr_motion_put(ctx, &done, &h, &motion, 0));
	*f = done;
	return MR_OK;
}
