/* Encodes each vertex by its foot on the base, found by a walk from its place by the source map (Kobbelt,
 * Vorsatz, Seidel 1999: Multiresolution hierarchies on unstructured triangle meshes), and decodes. */
#include "edit/detail.h"

#include "base/parallel.h"
#include "base/vectors.h"
#include "edit/correspondence.h"
#include "space/bvh.h"

enum { GRAIN = 1024, LOOKS = 16, SOON = 16 };

/* o in the frame there */
static mr_v3
offset_in(const mr_phong *s, mr_place at, mr_v3 o)
{
	mr_tangent_frame f = mr_phong_frame(s, at);

	return mr_axpy(o.x, f.t1, mr_axpy(o.y, f.t2, mr_mul(o.z, f.n)));
}

static bool
has_offset(const mr_detail *d, size_t i)
{
	return d->offset && mr_norm2(d->offset[i]) > 0;
}

/* b + h n + t1 o.x + t2 o.y + n o.z */
static mr_v3
displaced(const mr_phong *s, const mr_detail *d, size_t i)
{
	mr_place at = mr_places_at(&d->at, i);
	mr_v3 p = mr_axpy(d->height[i], mr_phong_normal(s, at), mr_phong_point(s, at));

	return has_offset(d, i) ? mr_add(p, offset_in(s, at, d->offset[i])) : p;
}

/* Encoding (Kobbelt, Vorsatz, Seidel 1999: Multiresolution hierarchies on unstructured triangle meshes) */

typedef struct tally {
	size_t offsets;
	double residual, height; /* the largest */
} tally;

typedef struct encoder {
	mr_foot_ground ground;
	const mr_mesh *mesh;
	const mr_correspondence *map; /* NULL without a source map, and for all that it reaches nothing of: */
	const mr_bvh *bvh;            /* of the base */
	const mr_v3 *normal;          /* of mesh, of any length; NULL where it has no faces */
	mr_foot *foot;
	mr_v3 *stand; /* the feet's points */
	bool *sound;  /* the feet are */
	uint32_t *face;
	mr_v3 *bary, *offset;
	double *height;
	tally *tally; /* one per piece */
} encoder;

/* The full offset from the place where a vertex stands, for want of a sound height. */
static void
keep_offset(const encoder *e, size_t i, mr_place at)
{
	mr_tangent_frame f = mr_phong_frame(&e->ground.surface, at);
	mr_v3 o = mr_sub(e->mesh->p[i], mr_phong_point(&e->ground.surface, at));

	e->offset[i] = mr_vec(mr_dot(o, f.t1), mr_dot(o, f.t2), mr_dot(o, f.n));
	e->face[i] = at.face;
	e->bary[i] = at.bary;
	e->height[i] = 0;
}

/* A height is sound below the base's radius of curvature: beyond, normals meet, and motions tear. */
static bool
is_sound(const encoder *e, const mr_foot *foot)
{
	return fabs(foot->height) * mr_phong_curvature(&e->ground.surface, foot->at) < 1;
}

/* Whether the foot is on a sheet that faces as mesh does. */
static bool
faces_alike(const encoder *e, size_t i, const mr_foot *foot)
{
	return !e->normal || mr_dot(e->normal[i], mr_phong_normal(&e->ground.surface, foot->at)) > 0;
}

/* A foot may be a little higher than the place where the vertex stands. */
static bool
walk_to_foot(const encoder *e, size_t i, mr_place start)
{
	double limit = 1.1 * mr_dist(e->mesh->p[i], mr_phong_point(&e->ground.surface, start)) +
	               e->ground.tolerance;

	return mr_foot_walk(&e->ground, e->mesh->p[i], start, limit, &e->foot[i]);
}

static void
settle(const encoder *e, size_t i, bool sound)
{
	e->sound[i] = sound;
	if (sound)
		e->stand[i] = mr_phong_point(&e->ground.surface, e->foot[i].at);
}

/* Whether a height is about as large as the base's distance from the mesh near by: else of another sheet. */
static bool
is_likely(const encoder *e, size_t i, mr_place start)
{
	const double much = 1.5, some = 0.05;
	mr_v3 there = mr_phong_point(&e->ground.surface, start),
	      on_mesh = mr_place_point(&e->map->lifted, start);

	return fabs(e->foot[i].height) <=
	       much * mr_dist(there, on_mesh) + some * mr_dist(e->mesh->p[i], on_mesh);
}

/* From the base vertex near by on the mesh. */
static void
find_easy_feet(void *arg, size_t begin, size_t end)
{
	const encoder *e = arg;

	for (size_t i = begin; i < end; i++) {
		mr_place near = mr_correspond_near(e->map, e->ground.surface.m, i);
		mr_correspond_soon(e->map, e->ground.surface.m, i, end);
		settle(e, i,
		    near.face != MR_NONE && walk_to_foot(e, i, near) && is_likely(e, i, near) &&
			is_sound(e, &e->foot[i]) && faces_alike(e, i, &e->foot[i]));
		if (e->sound[i]) {
			e->face[i] = e->foot[i].at.face;
			e->bary[i] = e->foot[i].at.bary;
		}
	}
}

/* From the place where a vertex stands. */
static void
find_feet(void *arg, size_t begin, size_t end)
{
	const encoder *e = arg;

	for (size_t i = begin; i < end; i++) {
		mr_place start;
		if (e->sound[i])
			continue;
		if (e->face[i] == MR_NONE) {
			mr_place at = mr_bvh_closest(e->bvh, e->mesh->p[i]).at;
			e->face[i] = at.face;
			e->bary[i] = at.bary;
		}
		start = (mr_place){ e->face[i], e->bary[i] };
		settle(e, i, walk_to_foot(e, i, start) && is_sound(e, &e->foot[i]));
	}
}

/* Vertices side by side on mesh whose feet are far apart, as on another sheet, have none that are sound. */
static void
part_far_feet(const encoder *e)
{
	const double far2 = 16;
	const mr_mesh *m = e->mesh;

	for (size_t f = 0; f < m->nf; f++) {
		const uint32_t *soon = m->t[f + SOON < m->nf ? f + SOON : f].v;
		mr_soon(m->p, sizeof *m->p, soon);
		mr_soon(e->stand, sizeof *e->stand, soon);
		for (int k = 0; k < 3; k++) {
			uint32_t a = m->t[f].v[k], b = m->t[f].v[(k + 1) % 3];
			if (a < b && e->sound[a] && e->sound[b] &&
			    mr_norm2(mr_sub(e->stand[a], e->stand[b])) >
				far2 * mr_norm2(mr_sub(m->p[a], m->p[b])))
				e->sound[a] = e->sound[b] = false;
		}
	}
}

static bool
all_sound(const encoder *e)
{
	for (size_t i = 0; i < e->mesh->nv; i++)
		if (!e->sound[i])
			return false;
	return true;
}

static bool
any_astray(const encoder *e)
{
	for (size_t i = 0; i < e->mesh->nv; i++)
		if (!e->sound[i] && e->face[i] == MR_NONE)
			return true;
	return false;
}

static void
find_all_feet(mr_ctx *ctx, const mr_places *source, encoder *e)
{
	size_t n = e->mesh->nv;
	mr_correspondence *map = MR_NEW(ctx, 1, mr_correspondence);
	mr_bvh *bvh;

	memset(e->face, 0xff, n * sizeof *e->face);
	if (source) {
		mr_correspond(ctx, e->mesh, e->ground.surface.m, e->ground.inc, source, map);
		e->map = map;
		e->normal = e->mesh->nf ? mr_area_normals(ctx, e->mesh) : NULL;
		mr_parallel(ctx, n, GRAIN, find_easy_feet, e);
		part_far_feet(e);
		if (all_sound(e))
			return;
		mr_correspond_rest(ctx, map, e->sound, e->face, e->bary);
	}
	if (any_astray(e)) {
		mr_bvh_build(ctx, e->ground.surface.m, &bvh);
		e->bvh = bvh;
	}
	mr_parallel(ctx, n, GRAIN, find_feet, e);
	part_far_feet(e);
}

static void
keep_piece(void *arg, size_t begin, size_t end)
{
	const encoder *e = arg;
	mr_detail d = { e->mesh->nv, { e->face, e->bary }, e->height, e->offset, NULL, NULL };
	tally *t = &e->tally[begin / GRAIN];
	double off;

	for (size_t i = begin; i < end; i++) {
		if (e->sound[i]) {
			e->face[i] = e->foot[i].at.face;
			e->bary[i] = e->foot[i].at.bary;
			e->height[i] = e->foot[i].height;
			t->height = fmax(t->height, fabs(e->height[i]));
		} else {
			keep_offset(e, i, (mr_place){ e->face[i], e->bary[i] });
			t->offsets++;
		}
		if (e->sound[i] && i % LOOKS != 0)
			continue;
		off = mr_dist(displaced(&e->ground.surface, &d, i), e->mesh->p[i]);
		t->residual = off > t->residual ? off : t->residual;
	}
}

static mr_encode_result
report(const encoder *e, double diagonal)
{
	size_t n = e->mesh->nv;
	tally sum = { 0 };

	for (size_t i = 0; i < (n + GRAIN - 1) / GRAIN; i++) {
		const tally *t = &e->tally[i];
		sum.offsets += t->offsets;
		sum.residual = fmax(sum.residual, t->residual);
		sum.height = fmax(sum.height, t->height);
	}
	return (mr_encode_result){ .heights = n - sum.offsets,
		.offsets = sum.offsets,
		.residual_max = diagonal > 0 ? sum.residual / diagonal : 0,
		.height_max = diagonal > 0 ? sum.height / diagonal : 0 };
}

mr_status
mr_encode(mr_ctx *ctx, const mr_mesh *mesh, const mr_mesh *base, const mr_places *source, mr_detail *d,
    mr_encode_result *result)
{
	size_t n = mesh->nv;
	encoder e = { .mesh = mesh,
		.face = MR_NEW(ctx, n, uint32_t),
		.bary = MR_NEW(ctx, n, mr_v3),
		.offset = MR_NEW_ZERO(ctx, n, mr_v3),
		.height = MR_NEW(ctx, n, double) };
	MR_SCOPE(ctx);
	mr_v3 *normal = MR_NEW(ctx, base->nv, mr_v3);
	mr_box box = mr_mesh_box(mesh);
	mr_incidence inc;
	mr_detail found;

	e.foot = MR_NEW(ctx, n, mr_foot);
	e.stand = MR_NEW(ctx, n, mr_v3);
	e.sound = MR_NEW_ZERO(ctx, n, bool);
	e.tally = MR_NEW_ZERO(ctx, (n + GRAIN - 1) / GRAIN, tally);
	mr_incidence_build(ctx, base, &inc);
	mr_vertex_normals(base, normal);
	e.ground = (mr_foot_ground){ { base, normal }, &inc, mr_box_tolerance(box, 1e-14) };
	find_all_feet(ctx, source, &e);
	mr_parallel(ctx, n, GRAIN, keep_piece, &e);
	found = (mr_detail){ n, { e.face, e.bary }, e.height, all_sound(&e) ? NULL : e.offset, base->p,
		NULL };
	MR_TRY(mr_detail_check(ctx, &found, base)); /* products overflow far from the origin */
	if (result)
		*result = report(&e, mr_box_diagonal(box));
	*d = found;
	return MR_OK;
}

/* Decoding */

/* The meaning of a row of detail on a base of nf faces. */
static mr_status
check_row(mr_ctx *ctx, const mr_detail *d, size_t i, const char *base, size_t nf)
{
	mr_v3 b = d->at.bary[i], o = d->offset ? d->offset[i] : mr_vec(0, 0, 0);

	if (d->at.face[i] >= nf)
		return mr_fail(ctx, MR_ERANGE, "mesh: detail_face %zu is %u, but %s has %zu faces", i,
		    d->at.face[i], base, nf);
	if (!mr_bary_within(b))
		return mr_fail(ctx, MR_ERANGE,
		    "mesh: detail_bary %zu (%g %g %g) is no place within a face of %s", i, b.x, b.y, b.z,
		    base);
	if (!isfinite(d->height[i]))
		return mr_fail(ctx, MR_ERANGE, "mesh: detail_height %zu (%g) is not finite", i, d->height[i]);
	if (!mr_finite(o))
		return mr_fail(
		    ctx, MR_ERANGE, "mesh: detail_offset %zu (%g %g %g) is not finite", i, o.x, o.y, o.z);
	return MR_OK;
}

mr_status
mr_detail_check(mr_ctx *ctx, const mr_detail *d, const mr_mesh *base)
{
	size_t odd;

	for (size_t i = 0; i < d->n; i++)
		MR_TRY(check_row(ctx, d, i, base->name, base->nf));
	odd = mr_first_infinite((const double *)d->rest, 3 * base->nv) / 3;
	return odd == base->nv ? MR_OK
	                       : mr_fail(ctx, MR_ERANGE, "%s: encoded %zu (%g %g %g) is not finite",
				     base->name, odd, d->rest[odd].x, d->rest[odd].y, d->rest[odd].z);
}

typedef struct decoder {
	mr_phong surface; /* its normals as those at rest were turned */
	mr_phong rest;
	const mr_turn *turn; /* of the surface's vertices */
	const mr_detail *d;
	double gain;
	mr_v3 *p;
} decoder;

/* The offset at rest, turned as the surface is there. */
static mr_v3
turned_offset(const decoder *j, mr_place at, mr_v3 o)
{
	mr_mat3 turn = mr_turn_rotation(j->turn, j->surface.m->t[at.face].v, at.bary);

	return mr_mat3_apply(&turn, offset_in(&j->rest, at, o));
}

/* b + gain (h n + o) */
static mr_v3
decode_vertex(const decoder *j, size_t i)
{
	mr_place at = mr_places_at(&j->d->at, i);
	mr_v3 b = mr_phong_point(&j->surface, at);

	if (!has_offset(j->d, i))
		return mr_axpy(j->gain * j->d->height[i], mr_phong_normal(&j->surface, at), b);
	return mr_axpy(j->gain, turned_offset(j, at, j->d->offset[i]), b);
}

static void
decode_piece(void *arg, size_t begin, size_t end)
{
	const decoder *j = arg;
	const mr_phong *s = &j->surface;

	for (size_t i = begin; i < end; i++) { /* the places are scattered over the base */
		if (i + SOON < end)
			__builtin_prefetch(&s->m->t[j->d->at.face[i + SOON]]);
		if (i + SOON / 2 < end) {
			const uint32_t *soon = s->m->t[j->d->at.face[i + SOON / 2]].v;
			mr_soon(s->m->p, sizeof *s->m->p, soon);
			mr_soon(s->normal, sizeof *s->normal, soon);
		}
		j->p[i] = decode_vertex(j, i);
	}
}

typedef struct turner {
	const mr_turn *turn;
	const mr_v3 *rest;
	mr_v3 *normal;
} turner;

static void
turn_normals(void *arg, size_t begin, size_t end)
{
	const turner *t = arg;

	for (size_t v = begin; v < end; v++)
		t->normal[v] = mr_turn_normal(&t->turn[v], t->rest[v]);
}

const mr_prepared *
mr_detail_prepare(mr_ctx *ctx, const mr_mesh *rest)
{
	mr_prepared *r = MR_NEW(ctx, 1, mr_prepared);

	*r = (mr_prepared){ MR_NEW(ctx, rest->nv, mr_v3), mr_scatter_make(ctx, rest) };
	mr_vertex_normals(rest, r->normal);
	return r;
}

/* Normals of the moved surface itself turn to and fro where it is crumpled, and tear what stands on them. */
static void
turn_frames(mr_ctx *ctx, const mr_mesh *rest, mr_v3 *normal, decoder *j)
{
	const mr_prepared *prepared = j->d->prepared ? j->d->prepared : mr_detail_prepare(ctx, rest);

	j->rest = (mr_phong){ rest, prepared->normal };
	j->turn = mr_turns(ctx, rest, &prepared->scatter, j->surface.m->p);
	mr_parallel(ctx, rest->nv, 4096, turn_normals, &(turner){ j->turn, j->rest.normal, normal });
}

mr_status
mr_decode(mr_ctx *ctx, const mr_mesh *base, const mr_detail *d, double gain, mr_v3 *p)
{
	MR_SCOPE(ctx);
	mr_v3 *normal = MR_NEW(ctx, base->nv, mr_v3);
	decoder j = { .surface = { base, normal }, .d = d, .gain = gain, .p = p };
	mr_mesh rest = *base;

	rest.p = d->rest;
	turn_frames(ctx, &rest, normal, &j);
	mr_parallel(ctx, d->n, 4096, decode_piece, &j);
	return MR_OK;
}

static void
rest_piece(void *arg, size_t begin, size_t end)
{
	const decoder *j = arg;

	for (size_t i = begin; i < end; i++)
		j->p[i] = displaced(&j->rest, j->d, i);
}

void
mr_detail_at_rest(mr_ctx *ctx, const mr_mesh *base, const mr_detail *d, mr_v3 *p)
{
	mr_mesh rest = *base;

	rest.p = d->rest;
	mr_parallel(ctx, d->n, 4096, rest_piece,
	    &(decoder){ .rest = { &rest, d->prepared->normal }, .d = d, .p = p });
}

/* The columns */

mr_status
mr_detail_get(mr_ctx *ctx, mr_frame *f, const mr_mesh *base, mr_detail *d)
{
	const void *face, *bary, *height, *offset = NULL, *rest;
	mr_detail r;
	size_t n;

	if (!mr_layer_has(f, "mesh", "detail_height"))
		return mr_advise(ctx, MR_ENCODE, mr_fail(ctx, MR_EMISSING, "mesh has no detail"));
	MR_TRY(mr_layer_get(ctx, f, "mesh", "detail_height", &height, &n));
	MR_TRY(mr_layer_get_rows(ctx, f, "mesh", "detail_face", n, &face));
	MR_TRY(mr_layer_get_rows(ctx, f, "mesh", "detail_bary", n, &bary));
	if (mr_layer_has(f, "mesh", "detail_offset"))
		MR_TRY(mr_layer_get_rows(ctx, f, "mesh", "detail_offset", n, &offset));
	MR_TRY(mr_layer_get_rows(ctx, f, base->name, "encoded", base->nv, &rest));
	r = (mr_detail){ n, { face, bary }, height, offset, rest, NULL };
	MR_TRY(mr_detail_check(ctx, &r, base));
	*d = r;
	return MR_OK;
}

mr_status
mr_detail_keep_before(mr_ctx *ctx, mr_frame *f, const mr_mesh *before)
{
	const void *encoded;
	bool posed;

	if (strcmp(before->name, "base") != 0)
		return MR_OK;
	MR_TRY(mr_layer_is_posed(ctx, f, "base", &posed));
	if (posed) /* mesh has not followed it yet: the pose goes on */
		return MR_OK;
	if (!mr_layer_has(f, "base", "encoded"))
		return mr_layer_has(f, "mesh", "triangles")
		           ? mr_layer_put(ctx, f, "base", "before", before->p, before->nv)
		           : MR_OK;
	MR_TRY(mr_layer_get_rows(ctx, f, "base", "encoded", before->nv, &encoded));
	if (memcmp(before->p, encoded, before->nv * sizeof *before->p))
		return mr_layer_put(ctx, f, "base", "before", before->p, before->nv);
	mr_frame_drop(f, "base", "before", 0);
	return MR_OK;
}

mr_status
mr_detail_put(mr_ctx *ctx, mr_frame *f, const mr_mesh *base, const mr_detail *d)
{
	MR_TRY(mr_layer_put(ctx, f, "mesh", "detail_face", d->at.face, d->n));
	MR_TRY(mr_layer_put(ctx, f, "mesh", "detail_bary", d->at.bary, d->n));
	MR_TRY(mr_layer_put(ctx, f, "mesh", "detail_height", d->height, d->n));
	MR_TRY(mr_layer_put(ctx, f, base->name, "encoded", d->rest, base->nv));
	mr_frame_drop(f, base->name, "before", 0);
	if (d->offset)
		MR_TRY(mr_layer_put(ctx, f, "mesh", "detail_offset", d->offset, d->n));
	else
		mr_frame_drop(f, "mesh", "detail_offset", 0);
	MR_TRY(mr_layer_worked(ctx, f, "mesh"));
	return mr_layer_followed(ctx, f, base->name);
}
