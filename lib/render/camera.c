/* Named directions, and a camera that is turned, aimed and fitted to its subject. */
#include "render/camera.h"

bool
mr_camera_view(const char *name, mr_v3 up, mr_v3 *from)
{
	static const struct {
		const char *name;
		mr_v3 from; /* of a model that stands on y and looks along z */
	} views[] = { { "front", { 0, 0, 1 } }, { "back", { 0, 0, -1 } }, { "left", { -1, 0, 0 } },
		{ "right", { 1, 0, 0 } }, { "top", { 0, 1, 0 } }, { "bottom", { 0, -1, 0 } },
		{ "iso", { 1, 1, 1 } }, { "quarter", { 0.5, 0.35, 1 } } };

	for (size_t i = 0; i < sizeof views / sizeof *views; i++)
		if (!strcmp(name, views[i].name)) {
			mr_v3 f = views[i].from;
			*from = up.y > 0 ? f : up.z > 0 ? mr_vec(f.x, -f.z, f.y) : mr_vec(f.y, f.z, f.x);
			return true;
		}
	return false;
}

mr_status
mr_camera_look(mr_ctx *ctx, mr_v3 from, mr_v3 up, mr_camera *c)
{
	mr_camera r = { .distance = 1, .scale = 1, .toward = mr_unit(from) };
	mr_v3 upward = mr_unit(up);

	if (!(mr_norm2(r.toward) > 0) || !(mr_norm2(upward) > 0))
		return mr_fail(ctx, MR_EUSAGE, "a direction of view and the upward one must not be zero");
	r.right = mr_cross(upward, r.toward);
	if (mr_norm(r.right) < 1e-6) /* looking along `up`: the axis that is least along it goes up instead */
		r.right = mr_cross(fabs(r.toward.y) < 0.9 ? mr_vec(0, 1, 0)
				   : r.toward.y > 0       ? mr_vec(0, 0, -1)
							  : mr_vec(0, 0, 1),
		    r.toward);
	r.right = mr_unit(r.right);
	r.up = mr_cross(r.toward, r.right);
	*c = r;
	return MR_OK;
}

static mr_v3
to_axes(const mr_camera *c, mr_v3 p)
{
	return mr_vec(mr_dot(c->right, p), mr_dot(c->up, p), mr_dot(c->toward, p));
}

void
mr_camera_box(const mr_camera *c, const mr_mesh *m, mr_box *box)
{
	for (size_t i = 0; i < mr_mesh_places(m); i++)
		mr_box_add(box, to_axes(c, mr_mesh_place(m, i)));
}

void
mr_camera_aim(mr_camera *c, mr_box box)
{
	mr_v3 m = mr_lerp(0.5, box.min, box.max);
	double half = mr_box_diagonal(box) / 2;

	c->center = mr_axpy(m.x, c->right, mr_axpy(m.y, c->up, mr_mul(m.z, c->toward)));
	c->distance = half > 0 ? 4 * half : 1;
}

void
mr_camera_turn_to(mr_camera *c, mr_v3 at)
{
	c->distance += mr_dist(c->center, at);
	c->center = at;
}

mr_seen
mr_camera_see(const mr_camera *c, mr_v3 p)
{
	mr_v3 q = to_axes(c, mr_sub(p, c->center));
	double e = c->distance / (c->distance - q.z);

	return (mr_seen){ c->x + c->scale * e * q.x, c->y - c->scale * e * q.y, e, q.z };
}

void
mr_camera_cover(const mr_camera *c, const mr_mesh *m, mr_box *covered)
{
	mr_camera unit = *c;

	unit.scale = 1;
	unit.x = unit.y = 0;
	for (size_t i = 0; i < mr_mesh_places(m); i++) {
		mr_seen s = mr_camera_see(&unit, mr_mesh_place(m, i));
		mr_box_add(covered, mr_vec(s.x, s.y, 0));
	}
}

void
mr_camera_fit(mr_camera *c, mr_box covered, double left, double top, double w, double h)
{
	double width = covered.max.x - covered.min.x, height = covered.max.y - covered.min.y;
	double across = width > 0 ? w / width : INFINITY, down = height > 0 ? h / height : INFINITY;
	double scale = fmin(across, down);

	c->scale = isinf(scale) ? 1 : scale;
	c->x = left + w / 2 - c->scale * (covered.min.x + covered.max.x) / 2;
	c->y = top + h / 2 - c->scale * (covered.min.y + covered.max.y) / 2;
}
