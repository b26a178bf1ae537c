/* axes.h -- which way x, y and z go in a picture. */
#ifndef MR_RENDER_AXES_H
#define MR_RENDER_AXES_H

#include "render/camera.h"
#include "render/canvas.h"

/* Draws the axes as the camera sees them, x red, y green, z blue, into the left corner above the row
 * `bottom`; a unit is `unit` pixels, all take 70 of them. */
void mr_axes_draw(mr_image *image, const mr_camera *camera, double unit, double bottom);

#endif
