/* mr-pose, of one handle and one frame; sequences and scripts are edit/handles.h. */
#include "edit/handles.h"

mr_status
mr_pose_frame(mr_ctx *ctx, mr_frame *f, const char *layer, size_t handle, const mr_pose *pose)
{
	mr_motion motion = { .handle = handle, .pose = *pose };
	mr_handles h;

	MR_TRY(mr_handles_of_frame(ctx, f, layer, &h));
	return mr_motion_put(ctx, f, &h, &motion, 0);
}
