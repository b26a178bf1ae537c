/* mr-pack and mr-unpack: a displaced subdivision surface as a few bytes, and back. */
#include "tool/tool.h"

#include "base/options.h"
#include "compact/packed.h"
#include "space/bvh.h"
#include "subdivide/displaced.h"

/* Powers of two: the control mesh's grid is coarser than the heights, which make up for it, and less so if
 * there are boundaries or creases; it is finer than the mean edge, or the domain would fold. */
enum { COARSER = 6, COARSER_AT_CURVES = 2, FINER_THAN_EDGES = 4, SEARCH = 6, TRIES = 3 };
enum { LOOKED_AT = 20000 }; /* faces, or points, of each surface while the number of bytes is sought */
/* The search ends within this share of the error; an unreachable error becomes the error of all bits times
 * AMPLE. */
#define NEARLY 0.98
#define AMPLE  1.1
/* Errors that are tried for a number of bytes. */
#define COARSEST 1e-3
#define FINEST   1e-6

/* The surface, its target, and the packed file. */
typedef struct packing {
	mr_mesh control, target;
	const uint8_t *crease;
	mr_bvh *bvh; /* of target, while the number of bytes is sought */
	mr_loop *level;
	mr_domain domain; /* of the control mesh as it is */
	const double *height;
	const uint8_t *color;   /* four a vertex; NULL: none */
	double diagonal, error; /* error: a length */
	mr_packed p;
	mr_control_order order;
	const uint32_t *origin; /* of each packed vertex of level n: which it was */
	mr_coder head;
	mr_packed_bytes bits;
	size_t least; /* bytes of them that colours need */
} packing;

/* The points or mesh that the surface was made from; the surface itself if there are none or control was
 * posed. */
static mr_status
get_target(mr_ctx *ctx, mr_frame *f, packing *k)
{
	bool posed, points = mr_frame_has_layer(f, "points");
	mr_v3 *p;

	MR_TRY(mr_layer_is_posed(ctx, f, "control", &posed));
	if (!posed && (points || mr_layer_has(f, "mesh", "triangles")))
		return points ? mr_layer_surface_or_points(ctx, f, "points", &k->target)
		              : mr_layer_mesh(ctx, f, "mesh", &k->target);
	p = MR_NEW(ctx, k->domain.m.nv, mr_v3);
	mr_domain_displace(ctx, &k->domain, k->height, 1, p);
	k->target = k->domain.m;
	k->target.p = p;
	return MR_OK;
}

static mr_status
get_surface(mr_ctx *ctx, mr_frame *f, packing *k)
{
	const void *color = NULL;

	MR_TRY(mr_layer_mesh(ctx, f, "control", &k->control));
	MR_TRY(mr_displacement_get(ctx, f, &k->control, &k->p.n, &k->height));
	MR_TRY(mr_layer_crease(ctx, f, "control", k->control.nf, &k->crease));
	k->level = MR_NEW(ctx, k->p.n + 1, mr_loop);
	MR_TRY(mr_loop_levels(ctx, &k->control, 180, k->crease, k->p.n, k->level));
	mr_domain_on(ctx, &k->control, k->level, k->p.n, &k->domain);
	if (mr_layer_has(f, "displacement", "color"))
		MR_TRY(mr_layer_get_rows(ctx, f, "displacement", "color", k->domain.m.nv, &color));
	k->color = color;
	return get_target(ctx, f, k);
}

/* Reports the columns of control and displacement that are not packed. */
static void
tell_lost(mr_ctx *ctx, const mr_frame *f)
{
	static const char *const kept[] = { "control position", "control triangles", "control crease",
		"displacement height", "displacement level", "displacement color" };

	for (size_t i = 0; i < f->count; i++) {
		const mr_column *c = &f->columns[i];
		bool is = strcmp(c->layer, "control") != 0 && strcmp(c->layer, "displacement") != 0;
		for (size_t j = 0; j < sizeof kept / sizeof *kept; j++)
			is |= !strcmp(mr_format(ctx, "%s %s", c->layer, c->name), kept[j]);
		if (!is)
			mr_lost(ctx, c->layer, c->rows, c->name);
	}
}

/* The control mesh on its grid. */
static mr_status
put_on_grid(mr_ctx *ctx, packing *k, mr_grid_mesh *g)
{
	mr_box box = mr_box_of(k->control.p, k->control.nv);
	double lo[3] = { box.min.x, box.min.y, box.min.z };

	*g = (mr_grid_mesh){ k->control.nv, k->control.nf, MR_NEW(ctx, k->control.nv, mr_grid_point),
		(mr_tri *)k->control.t, (uint8_t *)k->crease };
	for (int i = 0; i < 3; i++) {
		double at = floor(ldexp(lo[i], -k->p.step));
		if (!(fabs(at) < 0x1p52) || mr_box_diagonal(box) > ldexp(MR_GRID_MOST, k->p.step))
			return mr_fail(ctx, MR_ERANGE, "control: too large for that error");
		k->p.origin[i] = (int64_t)at;
	}
	for (size_t v = 0; v < g->nv; v++) {
		mr_v3 p = k->control.p[v];
		double x[3] = { p.x, p.y, p.z };
		for (int i = 0; i < 3; i++)
			g->p[v].x[i] = (int32_t)(rint(ldexp(x[i], -k->p.step)) - (double)k->p.origin[i]);
	}
	return MR_OK;
}

/* Rows of the vertices of level n in the order in which the packed mesh has them. */
static void
reorder(const packing *k, size_t width, const void *rows, void *ordered)
{
	for (size_t v = 0; v < k->p.level[k->p.n].nv; v++)
		memcpy((char *)ordered + v * width, (const char *)rows + k->origin[v] * width, width);
}

/* Heights over the domain of the packed control mesh: where the line along its normal meets the tangent plane
 * of the surface at the vertex. */
static double *
heights_over(mr_ctx *ctx, const packing *k, const mr_domain *d)
{
	size_t nv = d->m.nv;
	mr_v3 *p = MR_NEW(ctx, nv, mr_v3), *q = MR_NEW(ctx, nv, mr_v3), *normal = MR_NEW(ctx, nv, mr_v3);
	double *height = MR_NEW(ctx, nv, double);
	mr_mesh surface = d->m;

	mr_domain_displace(ctx, &k->domain, k->height, 1, p);
	reorder(k, sizeof *p, p, q);
	surface.p = q;
	mr_vertex_normals(&surface, normal);
	for (size_t v = 0; v < nv; v++) {
		mr_v3 to = mr_sub(q[v], d->m.p[v]);
		double slope = mr_dot(normal[v], d->normal[v]);
		height[v] = slope > 0.5 ? mr_dot(to, normal[v]) / slope : mr_dot(to, d->normal[v]);
	}
	return height;
}

static void
domain_of_packed(mr_ctx *ctx, const mr_packed *p, mr_domain *d)
{
	mr_v3 *position = MR_NEW(ctx, p->control.nv, mr_v3);
	mr_mesh m = { "control", position, p->control.t, p->control.nv, p->control.nf };

	mr_packed_positions(p, position);
	mr_domain_on(ctx, &m, p->level, p->n, d);
}

/* All bits of the surface. */
static mr_status
pack_all(mr_ctx *ctx, packing *k, mr_domain *d)
{
	mr_grid_mesh grid;

	MR_TRY(put_on_grid(ctx, k, &grid));
	mr_coder_write(ctx, &k->head);
	mr_control_write(ctx, &k->head, &grid, &k->level[0].topo, &k->order);
	mr_coder_finish(&k->head);
	k->p.control = k->order.m;
	MR_TRY(mr_packed_levels(ctx, &k->p, true));
	k->origin = mr_packed_origin(ctx, &k->level[k->p.n], &k->p.level[k->p.n], k->p.n, &k->order);
	domain_of_packed(ctx, &k->p, d);
	k->p.fields = 1;
	MR_TRY(mr_packed_put_heights(ctx, &k->p, heights_over(ctx, k, d)));
	if (k->color) {
		uint8_t(*color)[4] = mr_alloc(ctx, d->m.nv, sizeof *color);
		reorder(k, sizeof *color, k->color, color);
		k->p.fields = 4;
		for (size_t v = 0; v < d->m.nv; v++)
			if (color[v][3] != 255)
				k->p.fields = 5;
		mr_packed_put_colors(ctx, &k->p, (const uint8_t(*)[4])color);
	}
	return mr_packed_write_fields(ctx, &k->p, &k->bits, &k->least);
}

/* The heights that so many bytes of bits give, in the arena. */
static double *
heights_of(mr_ctx *ctx, const packing *k, size_t bits)
{
	mr_packed p = k->p;
	double *height = MR_NEW(ctx, p.level[p.n].nv, double);

	mr_packed_read_fields(ctx, &p, (mr_packed_bytes){ k->bits.byte, bits }, p.n);
	mr_packed_heights(&p, p.n, height);
	return height;
}

/* The surface that so many bytes of bits give, in the arena. */
static mr_mesh
surface_of(mr_ctx *ctx, const packing *k, const mr_domain *d, size_t bits)
{
	mr_mesh surface = d->m;
	mr_v3 *at = MR_NEW(ctx, d->m.nv, mr_v3);

	mr_domain_displace(ctx, d, heights_of(ctx, k, bits), 1, at);
	surface.p = at;
	return surface;
}

/* How far it is from its target: the mean of both ways, or from points to the surface alone. */
static mr_status
measure(mr_ctx *ctx, const packing *k, const mr_domain *d, size_t bits, double *mean, double *max)
{
	MR_SCOPE(ctx);
	mr_compare_opts o = MR_COMPARE_DEFAULTS;
	mr_mesh surface = surface_of(ctx, k, d, bits);
	mr_comparison c;

	o.effort = 1;
	MR_TRY(mr_compare(ctx, &k->target, &surface, &o, &c));
	*mean = k->target.nf ? (c.ab.mean + c.ba.mean) / 2 : c.ab.mean;
	*max = k->target.nf ? fmax(c.ab.max, c.ba.max) : c.ab.max;
	return MR_OK;
}

/* The mean distance from some of the faces, or points, of a mesh, by their centroids. */
static double
mean_from(mr_ctx *ctx, const mr_mesh *m, const mr_bvh *to)
{
	MR_SCOPE(ctx);
	size_t all = m->nf ? m->nf : m->nv, step = all / LOOKED_AT + 1, n = (all - 1) / step + 1;
	mr_v3 *p = MR_NEW(ctx, n, mr_v3), corner[3];
	double *distance = MR_NEW(ctx, n, double), sum = 0, area = 0;

	for (size_t i = 0; i < n; i++) {
		if (m->nf)
			mr_corners(m, i * step, corner);
		p[i] = m->nf ? mr_mean3(corner[0], corner[1], corner[2]) : m->p[i * step];
	}
	mr_bvh_distances(ctx, to, p, n, distance);
	for (size_t i = 0; i < n; i++) {
		double weight = m->nf ? mr_norm(mr_face_cross(m, i * step)) : 1;
		sum += weight * distance[i];
		area += weight;
	}
	return sum / area;
}

/* The same mean as measure's, nearly. */
static double
estimate(mr_ctx *ctx, const packing *k, const mr_domain *d, size_t bits)
{
	MR_SCOPE(ctx);
	mr_mesh surface = surface_of(ctx, k, d, bits);
	mr_bvh *bvh;
	double there;

	mr_bvh_build(ctx, &surface, &bvh);
	there = mean_from(ctx, &k->target, bvh);
	return k->target.nf ? (there + mean_from(ctx, &surface, k->bvh)) / 2 : there;
}

/* The mean squared error of the heights after so many bytes. */
static double
squared_error(mr_ctx *ctx, const packing *k, const double *height, size_t bits)
{
	MR_SCOPE(ctx);
	size_t nv = k->p.level[k->p.n].nv;
	const double *given = heights_of(ctx, k, bits);
	double sum = 0;

	for (size_t v = 0; v < nv; v++)
		sum += (given[v] - height[v]) * (given[v] - height[v]);
	return sum / (double)nv;
}

/* The fewest bytes whose heights have at most this squared error. */
static size_t
fewest_bits(mr_ctx *ctx, const packing *k, const double *height, double most)
{
	size_t few = 0, enough = k->bits.size;

	while (enough - few > enough / 256 + 4) {
		size_t half = few + (enough - few) / 2;
		if (squared_error(ctx, k, height, half) > most)
			few = half;
		else
			enough = half;
	}
	return enough;
}

/*
 * The fewest bytes that reach the error, or AMPLE times the error of all bits if that is larger.  Model:
 * error^2 is the squared error of all bits plus a share of the squared error of the heights; the share is
 * estimated anew in each step.
 */
static size_t
search(mr_ctx *ctx, packing *k, const mr_domain *d)
{
	const double *height = heights_of(ctx, k, k->bits.size);
	double own, mean, want, share = 0.5;
	size_t bits = k->bits.size;

	mr_bvh_build(ctx, &k->target, &k->bvh);
	own = estimate(ctx, k, d, bits);
	want = fmax(k->error, AMPLE * own);
	for (int i = 0; i < SEARCH; i++) {
		size_t try = fewest_bits(ctx, k, height, (want * want - own * own) / share);
		mean = estimate(ctx, k, d, try);
		share = (mean * mean - own * own) / squared_error(ctx, k, height, try);
		if (mean <= want && try < bits)
			bits = try;
		if (mean <= want && mean > NEARLY * want)
			break;
	}
	return bits;
}

/* The exponent of the step of the control mesh's grid. */
static int
grid_step(const packing *k)
{
	const mr_mesh *m = &k->control;
	bool curves = k->crease || mr_loop_boundary(&k->level[0]);
	int step = k->p.unit + (curves ? COARSER_AT_CURVES : COARSER), most;
	double sum = 0;

	for (uint32_t h = 0; h < 3 * m->nf; h++)
		sum += mr_dist(m->p[mr_he_from(m, h)], m->p[mr_he_to(m, h)]);
	most = sum > 0 ? ilogb(sum / (3 * (double)m->nf)) - FINER_THAN_EDGES : step;
	return step < most ? step : most;
}

/* Codes all bits for the error.  If only a number of bytes is given: for the largest error that fills them.
 */
static mr_status
pack_for(mr_ctx *ctx, packing *k, const mr_pack_opts *o, mr_domain *d)
{
	double error = o->error > 0 ? o->error : COARSEST;

	k->diagonal = mr_box_diagonal(mr_box_of(k->target.p, k->target.nv));
	for (;; error /= 4) {
		mr_mark mark = mr_mark_take(ctx);
		k->error = error * k->diagonal;
		k->p.unit = ilogb(k->error) - 1;
		k->p.step = grid_step(k);
		MR_TRY(pack_all(ctx, k, d));
		if (o->error > 0 || k->bits.size > o->bytes || error < FINEST)
			return MR_OK;
		mr_mark_release(ctx, mark);
	}
}

/* How many bytes of bits a file has room for; SIZE_MAX where no number is asked for. */
static mr_status
room_for_bits(mr_ctx *ctx, const packing *k, const mr_pack_opts *o, size_t *room)
{
	/* the count of bits takes up to 4 more bytes than a count of none */
	size_t head = mr_packed_file(ctx, &k->p, &k->head, (mr_packed_bytes){ NULL, 0 }).size + 4;

	*room = o->bytes ? mr_packed_room(head, o->bytes) : SIZE_MAX;
	return o->bytes == 0 || o->bytes >= head
	           ? MR_OK
	           : mr_fail(ctx, MR_ERANGE, "control: takes %zu bytes alone", head);
}

/* Chooses the number of bytes and measures the error.  If the estimate was too low, searches again for a
 * smaller one. */
static mr_status
choose_bits(
    mr_ctx *ctx, packing *k, const mr_domain *d, const mr_pack_opts *o, size_t *bits, mr_pack_result *r)
{
	double want = k->error;
	size_t room;

	MR_TRY(room_for_bits(ctx, k, o, &room));
	*bits = 0;
	for (int i = 0; i < TRIES; i++) {
		size_t before = *bits, found = o->error > 0 ? search(ctx, k, d) : k->bits.size;
		found = found < k->least ? k->least : found;
		*bits = found < room ? found : room;
		if (i && *bits == before)
			break;
		MR_TRY(measure(ctx, k, d, *bits, &r->error, &r->error_max));
		if (!(o->error > 0) || found > room || r->error <= want)
			break;
		k->error *= (1 + NEARLY) / 2 * want / r->error;
	}
	r->error /= k->diagonal;
	r->error_max /= k->diagonal;
	return MR_OK;
}

static void
tell_if_unreached(mr_ctx *ctx, const mr_pack_opts *o, double error)
{
	if (o->error > 0 && o->bytes == 0 && error > 1.01 * o->error)
		mr_found(ctx, &(mr_finding){ .kind = MR_INEXACT,
				  .layer = "displacement",
				  .what = mr_format(ctx,
				      "the surface is %.2g %% off what it was made from, however many bytes",
				      100 * error) });
}

static mr_status
pack(mr_ctx *ctx, mr_frame *f, const mr_pack_opts *o, mr_packed_bytes *file, mr_control_order *order,
    mr_pack_result *r)
{
	packing *k = MR_NEW_ZERO(ctx, 1, packing);
	mr_domain d;
	size_t bits;

	MR_TRY(mr_check_number(ctx, "error", o->error, 0, 0.1));
	if (o->error == 0 && o->bytes == 0)
		return mr_fail(ctx, MR_EUSAGE, "neither an error nor a number of bytes is asked for");
	MR_TRY(get_surface(ctx, f, k));
	snprintf(k->p.name, sizeof k->p.name, "%s", f->name);
	MR_TRY(pack_for(ctx, k, o, &d));
	*r = (mr_pack_result){ 0, k->head.count, k->p.n, d.m.nv, 0, 0 };
	MR_TRY(choose_bits(ctx, k, &d, o, &bits, r));
	*file = mr_packed_file(ctx, &k->p, &k->head, (mr_packed_bytes){ k->bits.byte, bits });
	r->bytes = file->size;
	*order = k->order;
	tell_if_unreached(ctx, o, r->error);
	return MR_OK;
}

mr_status
mr_pack_in_place(mr_ctx *ctx, mr_frame *f, double error, mr_packed_bytes *file, mr_control_order *order)
{
	mr_pack_opts o = { .error = error };
	mr_pack_result r;

	return pack(ctx, f, &o, file, order, &r);
}

mr_status
mr_pack_frame(mr_ctx *ctx, mr_frame *f, const mr_pack_opts *opts, const void **byte, size_t *size,
    mr_pack_result *result)
{
	static const mr_pack_opts defaults = MR_PACK_DEFAULTS;
	mr_control_order order;
	mr_packed_bytes file;
	mr_pack_result r;

	MR_ENTER(ctx);
	MR_TRY(pack(ctx, f, opts ? opts : &defaults, &file, &order, &r));
	tell_lost(ctx, f);
	*byte = file.byte;
	*size = file.size;
	if (result)
		*result = r;
	return MR_OK;
}

/* The control mesh as a layer. */
static mr_status
put_control(mr_ctx *ctx, const mr_packed *p, mr_frame *f, mr_domain *d)
{
	mr_v3 *position = MR_NEW(ctx, p->control.nv, mr_v3);
	mr_mesh m = { "control", position, p->control.t, p->control.nv, p->control.nf };

	mr_packed_positions(p, position);
	MR_TRY(mr_layer_put_mesh(ctx, f, "control", &m));
	if (p->control.crease)
		MR_TRY(mr_layer_put(ctx, f, "control", "crease", p->control.crease, m.nf));
	*d = (mr_domain){ .n = d->n, .level = p->level };
	d->m.nv = p->level[d->n].nv;
	return MR_OK;
}

static mr_status
put_displacement(mr_ctx *ctx, const mr_packed *p, mr_frame *f, const mr_domain *d)
{
	double *height = MR_NEW(ctx, d->m.nv, double);
	uint8_t(*color)[4];

	mr_packed_heights(p, d->n, height);
	MR_TRY(mr_displacement_put(ctx, f, d, height));
	if (p->fields == 1)
		return MR_OK;
	color = mr_alloc(ctx, d->m.nv, sizeof *color);
	mr_packed_colors(p, d->n, color);
	return mr_frame_put(ctx, f, "displacement", "color", (mr_shape){ 'v', 'b', 4 }, color, d->m.nv);
}

static mr_status
unpack(mr_ctx *ctx, mr_packed_bytes file, const mr_unpack_opts *o, mr_frame **frame, mr_unpack_result *r)
{
	mr_packed *p = MR_NEW(ctx, 1, mr_packed);
	mr_packed_bytes bits;
	mr_domain d = { 0 };
	size_t missing, size = file.size;
	mr_frame *f;

	if (o->bytes && o->bytes < file.size)
		file.size = o->bytes;
	MR_TRY(mr_packed_open(ctx, file, p, &bits, &missing));
	MR_TRY(mr_packed_levels(ctx, p, false));
	if (o->level != MR_UNKNOWN && o->level > p->n)
		return mr_fail(ctx, MR_ERANGE, "level %zu, but it ends with level %zu", o->level, p->n);
	d.n = o->level == MR_UNKNOWN ? p->n : o->level;
	mr_packed_read_fields(ctx, p, bits, d.n);
	MR_TRY(mr_frame_new(ctx, p->name, &f));
	MR_TRY(put_control(ctx, p, f, &d));
	MR_TRY(put_displacement(ctx, p, f, &d));
	if (file.size == size)
		mr_lost(ctx, "displacement", missing, "bytes at the end of the file");
	*r = (mr_unpack_result){ file.size, d.n, p->n, d.m.nv };
	*frame = f;
	return MR_OK;
}

mr_status
mr_unpack_frame(mr_ctx *ctx, const void *byte, size_t size, const mr_unpack_opts *opts, mr_frame **frame,
    mr_unpack_result *result)
{
	static const mr_unpack_opts defaults = MR_UNPACK_DEFAULTS;
	mr_packed_bytes file = { byte, size };
	mr_unpack_result r;

	MR_ENTER(ctx);
	MR_TRY(unpack(ctx, file, opts ? opts : &defaults, frame, &r));
	if (result)
		*result = r;
	return MR_OK;
}
