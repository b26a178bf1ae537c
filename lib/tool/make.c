/* mr-make: a solid, as a mesh or as a cloud of points of it. */
#include "mesh/layers.h"

#include "base/options.h"
#include "shape/shape.h"

static double
deviation(const mr_make_opts *o, const mr_mesh *m)
{
	return o->noise_relative ? o->noise * mr_mesh_diagonal(m) : o->noise;
}

static mr_status
put_mesh(mr_ctx *ctx, mr_frame *f, const mr_make_opts *o, mr_mesh *m)
{
	mr_v3 *p = MR_NEW(ctx, m->nv, mr_v3), *normal = MR_NEW(ctx, m->nv, mr_v3);
	double *uv = NULL;

	if (o->texcoords)
		mr_solid_texcoords(ctx, o->solid, m, &uv);
	if (o->noise > 0) {
		mr_vertex_normals(m, normal);
		memcpy(p, m->p, m->nv * sizeof *p);
		mr_add_noise(p, normal, m->nv, deviation(o, m), o->seed);
		m->p = p;
	}
	MR_TRY(mr_layer_put_mesh(ctx, f, "mesh", m));
	return uv ? mr_layer_put(ctx, f, "mesh", "corner_texcoord", uv, m->nf) : MR_OK;
}

static mr_status
put_points(mr_ctx *ctx, mr_frame *f, const mr_make_opts *o, const mr_mesh *m)
{
	mr_v3 *p, *normal;

	MR_TRY(mr_surface_sample(ctx, m, o->points, o->seed, &p, &normal));
	mr_add_noise(p, normal, o->points, deviation(o, m), o->seed + 1);
	MR_TRY(mr_layer_put(ctx, f, "points", "position", p, o->points));
	return mr_layer_put(ctx, f, "points", "normal", normal, o->points);
}

static mr_status
make(mr_ctx *ctx, const mr_make_opts *o, mr_frame **frame)
{
	mr_frame *f;
	mr_mesh m;

	MR_TRY(mr_check_choice(ctx, "solid", (int)o->solid, MR_SOLIDS - 1));
	MR_TRY(mr_check_number(ctx, "noise", o->noise, 0, 1e300));
	MR_TRY(mr_check_number(ctx, "genus", (double)o->genus, 0, 100000));
	MR_TRY(mr_solid_make(ctx, o, &m));
	MR_TRY(mr_frame_new(ctx, m.name, &f));
	MR_TRY(o->points ? put_points(ctx, f, o, &m) : put_mesh(ctx, f, o, &m));
	*frame = f;
	return MR_OK;
}

mr_status
mr_make(mr_ctx *ctx, const mr_make_opts *opts, mr_frame **frame)
{
	static const mr_make_opts defaults = MR_MAKE_DEFAULTS;

	MR_ENTER(ctx);
	return make(ctx, opts ? opts : &defaults, frame);
}
