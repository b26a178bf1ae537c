/* gallery.h -- pictures of frames: panels side by side with labels and legends.  A shot is what shares a
 * camera and a scale of colours: a key frame with its deltas, or more where the caller likes. */
#ifndef MR_RENDER_GALLERY_H
#define MR_RENDER_GALLERY_H

#include "render/raster.h"
#include "stream/frame.h"

/* One layer of one frame. */
typedef struct mr_panel {
	const char *frame, *layer;
	mr_subject subject;
	uint64_t worn[4]; /* serials of the columns that its paint is made of */
	double *value;    /* numbers, as many as there would be colours, in their place; NULL: none */
} mr_panel;

/* One frame's panels: panel[first] to panel[first + count]. */
typedef struct mr_shown {
	const char *name;
	uint64_t number;
	bool key;
	size_t first, count;
} mr_shown;

/* Frames that were collected; starts zeroed. */
typedef struct mr_gallery {
	mr_panel *panel;
	mr_shown *frame;
	size_t panels, panel_room, frames, frame_room;
} mr_gallery;

/* Adds a frame, copied into the arena `keep`.  MR_EMISSING where a layer or the column is missing. */
mr_status
mr_gallery_add(mr_ctx *ctx, mr_ctx *keep, mr_gallery *g, mr_frame *frame, const mr_render_opts *opts);

/* Frames that share a camera and a scale of colours: frame[first] to frame[first + count]. */
typedef struct mr_shot {
	size_t first, count;
	mr_camera camera;
	double low, high; /* of numbers that give colours */
} mr_shot;

/* Finds camera and range of a shot. */
mr_status mr_shot_aim(
    mr_ctx *ctx, const mr_gallery *g, size_t first, size_t count, const mr_render_opts *opts, mr_shot *shot);

/* Draws frame i, of the shot: its panels side by side.  image: in the arena. */
mr_status mr_shot_draw(mr_ctx *ctx, const mr_gallery *g, const mr_shot *shot, size_t i,
    const mr_render_opts *opts, mr_image *image);

/* Draws all frames, at least one, into one picture.  image: in the arena. */
mr_status mr_sheet_draw(mr_ctx *ctx, const mr_gallery *g, const mr_render_opts *opts, mr_image *image);

#endif
