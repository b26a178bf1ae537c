/* Control mesh and heights, stored in place of the surface that they make. */
#include "formats/page_displaced.h"

/* The level that has as many vertices and faces as the mesh; false: none. */
static bool
find_level(const mr_page_displaced *d, const mr_mesh *mesh, size_t *at)
{
	for (size_t i = 0; i <= d->n; i++)
		if (d->level[i].nv == mesh->nv && d->level[i].nf == mesh->nf) {
			*at = i;
			return true;
		}
	return false;
}

static mr_status
make_mesh(mr_ctx *ctx, mr_frame *f, const mr_page_displaced *d, mr_mesh *m)
{
	mr_domain domain;
	mr_mesh control;
	mr_v3 *p;

	MR_TRY(mr_layer_mesh(ctx, f, "control", &control));
	mr_domain_on(ctx, &control, d->level, d->at, &domain);
	p = MR_NEW(ctx, domain.m.nv, mr_v3);
	mr_domain_displace(ctx, &domain, d->height, 1, p);
	*m = domain.m;
	m->p = p;
	return MR_OK;
}

/* Whether mesh is, bit by bit, what mr-decode makes of the frame on one of the levels. */
static mr_status
compare_mesh(mr_ctx *ctx, mr_frame *f, mr_page_displaced *d)
{
	mr_mesh mesh, made;
	mr_mark mark;

	MR_TRY(mr_layer_surface_or_points(ctx, f, "mesh", &mesh));
	if (!find_level(d, &mesh, &d->at) ||
	    memcmp(mesh.t, d->level[d->at].t, mesh.nf * sizeof *mesh.t) != 0) {
		d->at = d->n;
		return MR_OK;
	}
	mark = mr_mark_take(ctx);
	MR_TRY(make_mesh(ctx, f, d, &made));
	d->is_mesh = !memcmp(made.p, mesh.p, mesh.nv * sizeof *mesh.p);
	if (!d->is_mesh)
		d->at = d->n;
	mr_mark_release(ctx, mark);
	return MR_OK;
}

mr_status
mr_page_displaced_get(mr_ctx *ctx, mr_frame *f, mr_page_displaced *d)
{
	mr_page_displaced r = { .there = true };
	mr_mesh control;
	const uint8_t *mark;
	mr_loop *level;
	mr_box box;

	if (!mr_frame_has_layer(f, "displacement"))
		return mr_layer_missing(ctx, f, "displacement", "displacement");
	MR_TRY(mr_layer_mesh(ctx, f, "control", &control));
	MR_TRY(mr_displacement_get(ctx, f, &control, &r.n, &r.height));
	level = MR_NEW(ctx, r.n + 1, mr_loop);
	MR_TRY(mr_layer_crease(ctx, f, control.name, control.nf, &mark));
	MR_TRY(mr_loop_levels_marked(ctx, &control, 180, mark, r.n, level));
	box = mr_mesh_box(&control);
	r.extent = fmax(box.max.x - box.min.x, fmax(box.max.y - box.min.y, box.max.z - box.min.z));
	r.level = level;
	r.at = r.n;
	if (mr_layer_has(f, "mesh", "position"))
		MR_TRY(compare_mesh(ctx, f, &r));
	*d = r;
	return MR_OK;
}
