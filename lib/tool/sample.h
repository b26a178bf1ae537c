/*
 * sample.h -- what mr_sample_frame will look for heights in.
 */
#ifndef MR_TOOL_SAMPLE_H
#define MR_TOOL_SAMPLE_H

#include "stream/frame.h"

/* True where it is triangles that lines along the normals meet, not points.  layer: NULL: points, else mesh.
 */
bool mr_sample_meets_faces(const mr_frame *f, const char *layer);

/* Warns, of key frames, where mr-solve has moved control and `from`, which mr-fit and mr-sample go by, has
 * not followed.  remedy: the end of the sentence. */
mr_status mr_sample_warn_of_move(mr_ctx *ctx, mr_frame *f, const char *from, const char *remedy);

#endif
