/* Three lines from one place, each with its letter; the one that comes nearest to the eye lies over the
 * others. */
#include "render/axes.h"

/* In units: half of the room that all take, the length of an axis, from its end to the middle of its letter.
 */
static const double ROOM = 35, LENGTH = 22, APART = 7, WIDTH = 2;

static const mr_rgb colors[] = { { 208, 58, 58 }, { 56, 150, 70 }, { 56, 104, 214 } };

/* Where axis k ends in the picture, to the right and downwards, and how far towards the eye, in its lengths.
 */
static mr_v3
end_of(const mr_camera *c, int k)
{
	return mr_vec(mr_coordinate(c->right, k), -mr_coordinate(c->up, k), mr_coordinate(c->toward, k));
}

/* Which way the letter lies: on along the axis; of one that is seen from its end, away from the others. */
static mr_v3
way_of(const mr_v3 end[3], int k)
{
	const double seen = 0.2;
	mr_v3 along = mr_vec(end[k].x, end[k].y, 0), sum = mr_add(end[(k + 1) % 3], end[(k + 2) % 3]);

	if (mr_norm(along) < seen)
		along = mr_vec(-sum.x, -sum.y, 0);
	return mr_norm(along) > 0 ? mr_unit(along) : mr_vec(-1, 0, 0);
}

static void
draw_axis(mr_image *image, const mr_v3 end[3], int k, mr_v3 origin, double unit)
{
	const char name[] = { "xyz"[k], '\0' };
	mr_v3 tip = mr_axpy(LENGTH * unit, mr_vec(end[k].x, end[k].y, 0), origin);
	mr_v3 letter = mr_axpy(APART * unit, way_of(end, k), tip);
	double from[2] = { origin.x, origin.y }, to[2] = { tip.x, tip.y };

	mr_image_line(image, from, to, WIDTH * unit, colors[k]);
	mr_image_text(image, letter.x - 2.5 * unit, letter.y - 4.5 * unit, unit, colors[k], name);
}

void
mr_axes_draw(mr_image *image, const mr_camera *camera, double unit, double bottom)
{
	mr_v3 end[3], origin = mr_vec(ROOM * unit, bottom - ROOM * unit, 0);
	int order[] = { 0, 1, 2 };

	for (int k = 0; k < 3; k++)
		end[k] = end_of(camera, k);
	for (int i = 1; i < 3; i++) /* the farthest first */
		for (int j = i; j > 0 && end[order[j]].z < end[order[j - 1]].z; j--) {
			int other = order[j];
			order[j] = order[j - 1];
			order[j - 1] = other;
		}
	for (int i = 0; i < 3; i++)
		draw_axis(image, end, order[i], origin, unit);
}
