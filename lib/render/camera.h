/* camera.h -- from space to the pixels of a panel: look, box, aim, cover and fit, in this order; box and
 * cover may be called for several models. */
#ifndef MR_RENDER_CAMERA_H
#define MR_RENDER_CAMERA_H

#include "mesh/mesh.h"

typedef struct mr_camera {
	mr_v3 right, up, toward; /* orthonormal; `toward` points from the scene to the eye */
	mr_v3 center;            /* what the eye looks at */
	double distance;         /* of the eye from the centre */
	double scale;            /* pixels per unit at the centre */
	double x, y;             /* pixel of the centre, from the panel's upper left corner, y downwards */
} mr_camera;

/* The eye's direction in the view named front, back, left, right, top, bottom, iso or quarter, of a model
 * that stands upright on the axis `up`.  False: there is no such view. */
bool mr_camera_view(const char *name, mr_v3 up, mr_v3 *from);

/* A point as the camera sees it: pixels, enlargement by perspective, height towards the eye. */
typedef struct mr_seen {
	double x, y, enlarged, z;
} mr_seen;

/* A camera whose eye stands in the direction `from`, with `up` upwards (any, where they are parallel).
 * MR_EUSAGE where one is zero. */
mr_status mr_camera_look(mr_ctx *ctx, mr_v3 from, mr_v3 up, mr_camera *c);

/* Grows the box of the mesh's places along the camera's axes: x right, y up, z towards the eye. */
void mr_camera_box(const mr_camera *c, const mr_mesh *m, mr_box *box);

/* Puts the centre into the middle of the box; the eye at four half diagonals. */
void mr_camera_aim(mr_camera *c, mr_box box);

/* Looks at another point, from as far behind it. */
void mr_camera_turn_to(mr_camera *c, mr_v3 at);

/* Grows the rectangle (x, y of the box) that they cover in the picture at a scale of 1. */
void mr_camera_cover(const mr_camera *c, const mr_mesh *m, mr_box *covered);

/* Sets scale and place so that the rectangle fills the middle of w by h pixels at (left, top). */
void mr_camera_fit(mr_camera *c, mr_box covered, double left, double top, double w, double h);

mr_seen mr_camera_see(const mr_camera *c, mr_v3 p);

#endif
