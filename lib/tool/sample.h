/* sample.h -- what mr_sample_frame will look for heights in. */
#ifndef MR_TOOL_SAMPLE_H
#define MR_TOOL_SAMPLE_H

#include "stream/frame.h"

/* True where it is triangles that lines along the normals meet, not points.  layer: NULL: points, else mesh.
 */
bool mr_sample_meets_faces(const mr_frame *f, const char *layer);

/* Reports MR_STALE, of key frames, where control has moved and `from`, which is fitted and sampled, has not
 * followed. */
mr_status mr_sample_report_move(mr_ctx *ctx, mr_frame *f, const char *from);

#endif
