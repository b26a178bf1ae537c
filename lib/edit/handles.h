/* handles.h -- where handles go: affine maps, their sequences, and scripts of them. */
#ifndef MR_EDIT_HANDLES_H
#define MR_EDIT_HANDLES_H

#include "mesh/layers.h"

/* Sets the part `what` from its text: "translate" x,y,z; "rotate" ax,ay,az,degrees; "scale" s or sx,sy,sz;
 * "center" x,y,z.  MR_EUSAGE with a sentence. */
mr_status mr_pose_set(mr_ctx *ctx, mr_pose *pose, const char *what, const char *text);

/* MR_EUSAGE where a part of the way (0 < share < 1) is not defined: a scale that is not positive. */
mr_status mr_pose_check_shares(mr_ctx *ctx, const mr_pose *pose);

/* T = C translate rotate scale C^-1, a share of the way: of translation and angle, as power of the scale. */
mr_affine mr_pose_map(const mr_pose *pose, mr_v3 center, double share);

/* The handles of a layer, by number; count 0: the number is not in use. */
typedef struct mr_handles {
	size_t n; /* highest number in use, and one */
	size_t *count;
	mr_v3 *centroid;
} mr_handles;

/* Finds the handles among the regions of nv vertices.  MR_EMISSING where there is none. */
mr_status mr_handles_find(mr_ctx *ctx, const mr_mesh *m, const uint32_t *region, mr_handles *h);

/* The same in the layer with the regions: `layer`, or where it is NULL mesh, else control. */
mr_status mr_handles_of_frame(mr_ctx *ctx, mr_frame *f, const char *layer, mr_handles *h);

/* The handles' maps, and how far each has turned: along the axis, as long as the angle. */
typedef struct mr_handle_rows {
	size_t n;
	mr_affine *map;
	mr_v3 *turn; /* the logarithm of the map's rotation with all its turns, which a map does not hold */
} mr_handle_rows;

/* The frame's maps and turns (handles.transform, handles.turn), at least n: absent ones are the identity,
 * absent turns the smallest.  MR_ERANGE where one is not finite, or the columns differ in length.  row: in
 * the arena. */
mr_status mr_handles_rows(mr_ctx *ctx, mr_frame *f, size_t n, mr_handle_rows *row);

/* map[handle] = T map[handle], its turn the logarithm nearest to the sum of both turns.  MR_EMISSING where no
 * vertex is of the handle.  row: at least h->n. */
mr_status mr_handles_pose(
    mr_ctx *ctx, const mr_handles *h, size_t handle, const mr_pose *pose, double share, mr_handle_rows *row);

/* Handles that have posed are used up; for how many frames they go on (handles.frames) stays. */
void mr_handles_drop(mr_frame *f);

/* How many deltas follow the key, as far as handles have said; 0: not known. */
mr_status mr_handles_frames(mr_ctx *ctx, mr_frame *f, size_t *frames);

/*
 * A script of poses, one frame after another:
 *
 *	frame
 *	0 translate=0,0,0.1 rotate=0,0,1,15
 *	1 scale=1.1
 *	frame
 *	...
 *
 * The word `frame` begins a frame; every other line names a handle and gives its place in that frame,
 * counted from rest, in the words of mr_pose_set.  Several lines for one handle apply in order.  Text after a
 *# is a comment.
 */
typedef struct mr_script {
	struct mr_script_line *line;
	size_t n, frames;
} mr_script;

/* MR_EIO, or MR_EFORMAT with file and line.  In the arena. */
mr_status mr_script_read(mr_ctx *ctx, const char *path, mr_script *script);

/* Applies frame `number`, from 1; 0 is rest, and after the last frame the last pose stays. */
mr_status
mr_script_pose(mr_ctx *ctx, const mr_handles *h, const mr_script *script, size_t number, mr_handle_rows *row);

/* The handles' motions: by a script, or of one handle at once or in `frames` frames. */
typedef struct mr_motion {
	const mr_script *script; /* NULL: none, and what follows counts */
	size_t handle, frames;
	mr_pose pose;
} mr_motion;

/* How many frames follow the one at rest; 0: there is no sequence. */
size_t mr_motion_length(const mr_motion *m);

/* Poses frame `number` of the sequence: 0 is at rest, after the last frame the last pose stays. */
mr_status mr_motion_put(mr_ctx *ctx, mr_frame *f, const mr_handles *h, const mr_motion *m, size_t number);

/* p = p0 + sum over handles h of W_h (T_h - I), W_h the n x 4 block of the response; the identity gives p0
 * bit for bit.  response: n rows of 4 handles values.  out: n, the caller's, may be p0. */
void mr_pose_by_response(mr_ctx *ctx, const mr_v3 *p0, size_t n, const double *response, size_t handles,
    const mr_affine *t, mr_v3 *out);

/* The layer's response, which it has, to the frame's handles: finite. */
mr_status
mr_response_get(mr_ctx *ctx, mr_frame *f, const mr_mesh *m, const double **response, mr_handle_rows *handles);

/* Poses the frame's layer m by its column `response`, if the frame has handles; both are used up.
 * MR_EMISSING where there are handles and no response.  m: with the posed positions. */
mr_status mr_response_apply(mr_ctx *ctx, mr_frame *f, mr_mesh *m);

#endif
