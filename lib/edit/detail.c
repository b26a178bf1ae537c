/* Encodes each vertex by its foot on the base, found by a walk from where the source map has it (Kobbelt,
 * Vorsatz, Seidel 1999: Multiresolution hierarchies on unstructured triangle meshes), and decodes. */
#include "edit/detail.h"

#include "base/parallel.h"
#include "edit/correspondence.h"
#include "edit/phong_projection.h"
#include "edit/turns.h"
#include "space/bvh.h"
#include "space/thickness.h"

enum { GRAIN = 1024 };

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
	size_t steps, crossed, searched, offsets;
	double residual, height; /* the largest */
} tally;

typedef struct encoder {
	mr_ground ground;
	const mr_mesh *mesh;
	const mr_bvh *bvh; /* of the base, where the source map reaches nothing */
	mr_foot *foot;     /* that may be sound; else its face is MR_NONE */
	bool *sound;       /* that are */
	double *thickness; /* of the base, a vertex: as far as feet ask for it */
	uint32_t *face;
	mr_v3 *bary, *offset;
	double *height;
	tally *tally; /* one per piece */
} encoder;

static double
thickness_at(const encoder *e, mr_place at)
{
	const uint32_t *v = e->ground.surface.m->t[at.face].v;

	return at.bary.x * e->thickness[v[0]] + at.bary.y * e->thickness[v[1]] +
	       at.bary.z * e->thickness[v[2]];
}

/*
 * A height is sound below the base's radius of curvature and its thickness.  Beyond, the normals on the way
 * meet or pass through another sheet, and any motion of the base tears the heights apart.
 */
static bool
below_curvature(const encoder *e, const mr_foot *foot)
{
	return fabs(foot->height) * mr_phong_curvature(&e->ground.surface, foot->at) < 1;
}

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

static void
keep_height(const encoder *e, size_t i, const mr_foot *foot)
{
	e->offset[i] = mr_vec(0, 0, 0);
	e->face[i] = foot->at.face;
	e->bary[i] = foot->at.bary;
	e->height[i] = foot->height;
}

/* A foot may be a little higher than the place where the vertex stands. */
static bool
find_foot(const encoder *e, mr_v3 p, mr_place start, mr_foot *foot, tally *t)
{
	double limit = 1.1 * mr_dist(p, mr_phong_point(&e->ground.surface, start)) + e->ground.tolerance;
	mr_walk walk = { 0, 0 };
	bool found = mr_foot_walk(&e->ground, p, start, limit, foot, &walk);

	t->steps += walk.steps;
	t->crossed += walk.crossed;
	t->searched += !found;
	return found || mr_foot_search(&e->ground, p, start.face, foot);
}

static void
find_feet(void *arg, size_t begin, size_t end)
{
	const encoder *e = arg;
	tally t = { 0 };

	for (size_t i = begin; i < end; i++) {
		mr_v3 p = e->mesh->p[i];
		if (e->face[i] == MR_NONE) {
			mr_place at = mr_bvh_closest(e->bvh, p).at;
			e->face[i] = at.face;
			e->bary[i] = at.bary;
		}
		if (!find_foot(e, p, (mr_place){ e->face[i], e->bary[i] }, &e->foot[i], &t) ||
		    !below_curvature(e, &e->foot[i]))
			e->foot[i].at.face = MR_NONE;
	}
	e->tally[begin / GRAIN] = t;
}

/* Asks for the thickness that the corners of a foot's face have, as far as that matters. */
static void
ask(const encoder *e, const mr_foot *foot, double most)
{
	const uint32_t *v = e->ground.surface.m->t[foot->at.face].v;

	for (int k = 0; k < 3; k++)
		e->thickness[v[k]] = fmax(e->thickness[v[k]], most);
}

static double
longest_side(const mr_mesh *m, uint32_t f)
{
	double longest = 0;

	for (uint32_t h = 3 * f; h < 3 * f + 3; h++)
		longest = fmax(longest, mr_dist(m->p[mr_he_from(m, h)], m->p[mr_he_to(m, h)]));
	return longest;
}

static bool
all_corners_are_thicker(const encoder *e, const mr_foot *foot)
{
	const uint32_t *v = e->ground.surface.m->t[foot->at.face].v;
	double least = fmin(e->thickness[v[0]], fmin(e->thickness[v[1]], e->thickness[v[2]]));

	return fabs(foot->height) < least;
}

/*
 * Tells which feet are sound.  Where all corners of a face are thicker than the height over it, so is the
 * face: rays need be no longer than that.  For the few that this leaves they are longer by the face's longest
 * side: where one corner is thicker than that, all are thicker than the height.
 */
static void
find_sound(mr_ctx *ctx, const encoder *e, const mr_sounding *base)
{
	const double enough = 1.001;
	const double least = mr_mesh_tolerance(base->m, MR_RAY_BEGINS);
	size_t left = 0;

	memset(e->thickness, 0, base->m->nv * sizeof *e->thickness);
	for (size_t i = 0; i < e->mesh->nv; i++)
		if (e->foot[i].at.face != MR_NONE)
			ask(e, &e->foot[i], enough * fabs(e->foot[i].height) + least);
	mr_thickness(ctx, base, e->thickness);
	for (size_t i = 0; i < e->mesh->nv; i++) {
		e->sound[i] = e->foot[i].at.face != MR_NONE && all_corners_are_thicker(e, &e->foot[i]);
		left += e->foot[i].at.face != MR_NONE && !e->sound[i];
	}
	if (left == 0)
		return;
	memset(e->thickness, 0, base->m->nv * sizeof *e->thickness);
	for (size_t i = 0; i < e->mesh->nv; i++)
		if (e->foot[i].at.face != MR_NONE && !e->sound[i])
			ask(e, &e->foot[i],
			    enough * (fabs(e->foot[i].height) + longest_side(base->m, e->foot[i].at.face)));
	mr_thickness(ctx, base, e->thickness);
	for (size_t i = 0; i < e->mesh->nv; i++)
		if (e->foot[i].at.face != MR_NONE && !e->sound[i])
			e->sound[i] = fabs(e->foot[i].height) < thickness_at(e, e->foot[i].at);
}

static void
keep_piece(void *arg, size_t begin, size_t end)
{
	const encoder *e = arg;
	mr_detail d = { e->mesh->nv, { e->face, e->bary }, e->height, e->offset, NULL, NULL };
	tally *t = &e->tally[begin / GRAIN];

	for (size_t i = begin; i < end; i++) {
		if (e->sound[i]) {
			keep_height(e, i, &e->foot[i]);
		} else {
			keep_offset(e, i, (mr_place){ e->face[i], e->bary[i] });
			t->offsets++;
		}
		t->residual = fmax(t->residual, mr_dist(displaced(&e->ground.surface, &d, i), e->mesh->p[i]));
		t->height = fmax(t->height, fabs(e->height[i]));
	}
}

static mr_encode_result
report(const encoder *e, double diagonal)
{
	size_t n = e->mesh->nv;
	tally sum = { 0 };

	for (size_t i = 0; i < (n + GRAIN - 1) / GRAIN; i++) {
		const tally *t = &e->tally[i];
		sum.steps += t->steps;
		sum.crossed += t->crossed;
		sum.searched += t->searched;
		sum.offsets += t->offsets;
		sum.residual = fmax(sum.residual, t->residual);
		sum.height = fmax(sum.height, t->height);
	}
	return (mr_encode_result){ .heights = n - sum.offsets,
		.offsets = sum.offsets,
		.searched = sum.searched,
		.steps_mean = n ? (double)sum.steps / (double)n : 0,
		.crossed_mean = n ? (double)sum.crossed / (double)n : 0,
		.residual_max = diagonal > 0 ? sum.residual / diagonal : 0,
		.height_max = diagonal > 0 ? sum.height / diagonal : 0 };
}

static bool
any_offset(const encoder *e)
{
	for (size_t i = 0; i < e->mesh->nv; i += GRAIN)
		if (e->tally[i / GRAIN].offsets)
			return true;
	return false;
}

mr_status
mr_encode(mr_ctx *ctx, const mr_mesh *mesh, const mr_mesh *base, const mr_places *source, mr_detail *d,
    mr_encode_result *result)
{
	size_t n = mesh->nv;
	double diagonal = mr_mesh_diagonal(mesh);
	encoder e = { .mesh = mesh,
		.face = MR_NEW(ctx, n, uint32_t),
		.bary = MR_NEW(ctx, n, mr_v3),
		.offset = MR_NEW(ctx, n, mr_v3),
		.height = MR_NEW(ctx, n, double) };
	mr_mark mark = mr_mark_take(ctx);
	mr_encode_result figures;
	mr_detail found;
	mr_sounding body;

	e.foot = MR_NEW(ctx, n, mr_foot);
	e.sound = MR_NEW(ctx, n, bool);
	e.thickness = MR_NEW(ctx, base->nv, double);
	e.tally = MR_NEW_ZERO(ctx, (n + GRAIN - 1) / GRAIN, tally);
	MR_TRY(mr_sounding_build(ctx, base, &body));
	e.ground = (mr_ground){ { base, body.normal }, body.inc, mr_mesh_tolerance(mesh, 1e-14) };
	e.bvh = body.bvh;
	if (source)
		MR_TRY(mr_correspond(ctx, mesh, base, body.inc, source, e.face, e.bary));
	else
		memset(e.face, 0xff, n * sizeof *e.face);
	mr_parallel(ctx, n, GRAIN, find_feet, &e);
	find_sound(ctx, &e, &body);
	mr_parallel(ctx, n, GRAIN, keep_piece, &e);
	found = (mr_detail){ n, { e.face, e.bary }, e.height, any_offset(&e) ? e.offset : NULL, base->p,
		NULL };
	MR_TRY(mr_detail_check(ctx, &found, base)); /* products overflow far from the origin */
	figures = report(&e, diagonal);
	*d = found;
	if (result)
		*result = figures;
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* Decoding */

/* What a row of detail is on a base of nf faces. */
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
	for (size_t i = 0; i < d->n; i++)
		MR_TRY(check_row(ctx, d, i, base->name, base->nf));
	for (size_t i = 0; d->rest && i < base->nv; i++)
		if (!mr_finite(d->rest[i]))
			return mr_fail(ctx, MR_ERANGE, "%s: encoded %zu (%g %g %g) is not finite", base->name,
			    i, d->rest[i].x, d->rest[i].y, d->rest[i].z);
	return MR_OK;
}

typedef struct decoder {
	mr_phong surface; /* its normals as those at rest were turned */
	mr_phong rest;
	const mr_mat3 *turn; /* of the surface's vertices; NULL: offsets turn with the triangle */
	const mr_detail *d;
	double gain;
	mr_v3 *p;
} decoder;

/* The offset at rest, turned as the surface is there. */
static mr_v3
turned_offset(const decoder *j, mr_place at, mr_v3 o)
{
	const uint32_t *v = j->surface.m->t[at.face].v;
	const double w[3] = { at.bary.x, at.bary.y, at.bary.z };
	mr_mat3 sum = { { 0 } };

	for (int k = 0; k < 3; k++)
		sum = mr_mat3_axpy(w[k], &j->turn[v[k]], &sum);
	sum = mr_rotation_nearest(&sum);
	return mr_mat3_apply(&sum, offset_in(&j->rest, at, o));
}

/* b + gain (h n + o) */
static mr_v3
decode_vertex(const decoder *j, size_t i)
{
	mr_place at = mr_places_at(&j->d->at, i);
	mr_v3 b = mr_phong_point(&j->surface, at), o;

	if (!has_offset(j->d, i))
		return mr_axpy(j->gain * j->d->height[i], mr_phong_normal(&j->surface, at), b);
	o = j->turn ? turned_offset(j, at, j->d->offset[i]) : offset_in(&j->surface, at, j->d->offset[i]);
	return mr_axpy(j->gain, o, b);
}

static void
decode_piece(void *arg, size_t begin, size_t end)
{
	const decoder *j = arg;

	for (size_t i = begin; i < end; i++)
		j->p[i] = decode_vertex(j, i);
}

typedef struct turner {
	const mr_mat3 *turn;
	const mr_v3 *rest;
	mr_v3 *normal;
} turner;

static void
turn_normals(void *arg, size_t begin, size_t end)
{
	const turner *t = arg;

	for (size_t v = begin; v < end; v++)
		t->normal[v] = mr_mat3_apply(&t->turn[v], t->rest[v]);
}

/* Normals of the moved surface itself turn to and fro where it is crumpled a little, and tear apart what
 * stands on them. */
static mr_status
turn_frames(mr_ctx *ctx, const mr_mesh *rest, const mr_incidence *inc, mr_v3 *normal, decoder *j)
{
	mr_v3 *made;

	j->rest = (mr_phong){ rest, j->d->rest_normal };
	if (!j->rest.normal) {
		made = MR_NEW(ctx, rest->nv, mr_v3);
		MR_TRY(mr_vertex_normals(ctx, rest, inc, made));
		j->rest.normal = made;
	}
	mr_turns(ctx, rest, j->surface.m, inc, &j->turn);
	mr_parallel(ctx, rest->nv, 4096, turn_normals, &(turner){ j->turn, j->rest.normal, normal });
	return MR_OK;
}

mr_status
mr_decode(
    mr_ctx *ctx, const mr_mesh *base, const mr_incidence *inc, const mr_detail *d, double gain, mr_v3 *p)
{
	mr_mark mark = mr_mark_take(ctx);
	mr_v3 *normal = MR_NEW(ctx, base->nv, mr_v3);
	decoder j = { .surface = { base, normal }, .d = d, .gain = gain, .p = p };
	mr_mesh rest = *base;

	rest.p = d->rest;
	MR_TRY(
	    d->rest ? turn_frames(ctx, &rest, inc, normal, &j) : mr_vertex_normals(ctx, base, inc, normal));
	mr_parallel(ctx, d->n, 4096, decode_piece, &j);
	mr_mark_release(ctx, mark);
	return MR_OK;
}

void
mr_decode_at_rest(const mr_ctx *ctx, const mr_mesh *base, const mr_detail *d, double gain, mr_v3 *p)
{
	mr_mesh rest = *base;
	decoder j = { .surface = { &rest, d->rest_normal }, .d = d, .gain = gain, .p = p };

	rest.p = d->rest;
	mr_parallel(ctx, d->n, 4096, decode_piece, &j);
}

/* The columns */

mr_status
mr_detail_get(mr_ctx *ctx, mr_frame *f, const mr_mesh *base, mr_detail *d)
{
	const void *face, *bary, *height, *offset = NULL, *rest = NULL;
	mr_detail r;
	size_t n;

	if (!mr_layer_has(f, "mesh", "detail_height"))
		return mr_fail(ctx, MR_EMISSING, "mesh has no detail: it comes from mr-encode");
	MR_TRY(mr_layer_get(ctx, f, "mesh", "detail_height", &height, &n));
	MR_TRY(mr_layer_get_rows(ctx, f, "mesh", "detail_face", n, &face));
	MR_TRY(mr_layer_get_rows(ctx, f, "mesh", "detail_bary", n, &bary));
	if (mr_layer_has(f, "mesh", "detail_offset"))
		MR_TRY(mr_layer_get_rows(ctx, f, "mesh", "detail_offset", n, &offset));
	if (mr_layer_has(f, base->name, "encoded"))
		MR_TRY(mr_layer_get_rows(ctx, f, base->name, "encoded", base->nv, &rest));
	r = (mr_detail){ n, { face, bary }, height, offset, rest, NULL };
	MR_TRY(mr_detail_check(ctx, &r, base));
	*d = r;
	return MR_OK;
}

/* A hash of the triangles, by FNV-1a of words; not for use against an adversary. */
static void
print_faces(const mr_mesh *m, uint32_t print[2])
{
	uint64_t h = 0xcbf29ce484222325u;

	for (size_t f = 0; f < m->nf; f++)
		for (int k = 0; k < 3; k++)
			h = (h ^ m->t[f].v[k]) * 0x100000001b3u;
	print[0] = (uint32_t)h;
	print[1] = (uint32_t)(h >> 32);
}

mr_status
mr_detail_check_faces(mr_ctx *ctx, mr_frame *f, const mr_mesh *base)
{
	const void *known;
	uint32_t print[2];

	if (!mr_layer_has(f, base->name, "encoded_faces"))
		return MR_OK;
	MR_TRY(mr_layer_get_rows(ctx, f, base->name, "encoded_faces", 1, &known));
	print_faces(base, print);
	return memcmp(known, print, sizeof print) ? mr_fail(ctx, MR_EMESH,
							"%s has other triangles than those over which mesh "
							"was encoded: mr-encode comes after what "
							"changes them",
							base->name)
	                                          : MR_OK;
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
	uint32_t *print = MR_NEW(ctx, 2, uint32_t);

	print_faces(base, print);
	MR_TRY(mr_layer_put(ctx, f, "mesh", "detail_face", d->at.face, d->n));
	MR_TRY(mr_layer_put(ctx, f, "mesh", "detail_bary", d->at.bary, d->n));
	MR_TRY(mr_layer_put(ctx, f, "mesh", "detail_height", d->height, d->n));
	MR_TRY(mr_layer_put(ctx, f, base->name, "encoded", d->rest, base->nv));
	MR_TRY(mr_layer_put(ctx, f, base->name, "encoded_faces", print, 1));
	mr_frame_drop(f, base->name, "before", 0);
	if (d->offset)
		MR_TRY(mr_layer_put(ctx, f, "mesh", "detail_offset", d->offset, d->n));
	else
		mr_frame_drop(f, "mesh", "detail_offset", 0);
	MR_TRY(mr_layer_worked(ctx, f, "mesh"));
	return mr_layer_followed(ctx, f, base->name);
}
