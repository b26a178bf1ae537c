/* mr-normals: normals of points and of surfaces. */
#include "volume/volume.h"

#include "base/options.h"
#include "mesh/layers.h"
#include "space/near.h"

/* A normal that is there fits within 60 degrees of its place's plane: beyond it is of another side. */
static const double FITS = 0.5;

/* The points that have a place of their own, as places: place k is point `of`[k]. */
typedef struct places {
	mr_v3 *p;
	uint32_t *of;
	size_t n;
} places;

/* The side of each place's normal, if something decides it; NULL: nothing does. */
static void
find_sides(mr_ctx *ctx, const places *q, const mr_normals_opts *o, const mr_v3 *there, const mr_v3 *scanner,
    const mr_v3 **side)
{
	mr_v3 *d = MR_NEW(ctx, q->n, mr_v3);

	*side = NULL;
	if (!o->from && !scanner && !(o->keep && there))
		return;
	for (size_t k = 0; k < q->n; k++) {
		size_t i = q->of[k];
		d[k] = mr_vec(0, 0, 0);
		if (o->keep && there && mr_finite(there[i]))
			d[k] = there[i];
		if (mr_norm2(d[k]) == 0 && (o->from || scanner))
			d[k] = mr_sub(o->from ? *o->from : scanner[i], q->p[k]);
	}
	*side = d;
}

/* Points that are no place have the normal of the nearest one. */
static mr_status
fill_others(mr_ctx *ctx, const mr_mesh *m, const mr_sampling *s, const places *q, mr_v3 *normal)
{
	uint32_t *other = MR_NEW(ctx, m->nv, uint32_t), *nearest = MR_NEW(ctx, m->nv, uint32_t);
	mr_v3 *p = MR_NEW(ctx, m->nv, mr_v3);
	size_t n = 0;

	for (size_t i = 0; i < m->nv; i++)
		if (s->repeat[i] || s->outlier[i]) {
			p[n] = m->p[i];
			other[n++] = (uint32_t)i;
		}
	if (n == 0)
		return MR_OK;
	MR_TRY(mr_near_once(ctx, q->p, q->n, p, n, 1, nearest, NULL));
	for (size_t k = 0; k < n; k++)
		normal[other[k]] = normal[q->of[nearest[k]]];
	return MR_OK;
}

/* Takes back those that are there and fit, counts, and compares. */
static void
finish(const mr_normals_opts *o, const mr_v3 *there, size_t n, mr_v3 *normal, mr_normals_result *r)
{
	size_t some = 0, same = 0;

	for (size_t i = 0; i < n; i++) {
		mr_v3 old = there && mr_finite(there[i]) ? mr_unit(there[i]) : mr_vec(0, 0, 0);
		bool kept = there && o->keep && mr_dot(old, normal[i]) >= FITS;
		if (kept)
			normal[i] = there[i];
		r->kept += kept;
		if (o->flip)
			normal[i] = mr_mul(-1, normal[i]);
		some += mr_norm2(old) > 0;
		same += mr_norm2(old) > 0 && mr_dot(old, normal[i]) > 0;
	}
	r->estimated = n - r->kept;
	r->agree = some ? (double)same / (double)some : NAN;
}

static mr_status
of_points(mr_ctx *ctx, mr_frame *f, const mr_mesh *m, const mr_normals_opts *o, const mr_v3 *there,
    mr_v3 *normal, mr_normals_result *r)
{
	const void *scanner = NULL;
	const mr_v3 *side;
	mr_v3 *of_places;
	mr_sampling s;
	places q;

	MR_TRY(mr_sampling_of(ctx, f, m, &s));
	if (o->neighbours)
		s.neighbours = o->neighbours;
	if (mr_layer_has(f, m->name, "scanner"))
		MR_TRY(mr_layer_get_rows(ctx, f, m->name, "scanner", m->nv, &scanner));
	mr_sampling_places(ctx, m->p, &s, &q.p, &q.of, &q.n);
	find_sides(ctx, &q, o, there, scanner, &side);
	of_places = MR_NEW(ctx, q.n, mr_v3);
	MR_TRY(mr_prefix(ctx, mr_places_normals(ctx, q.p, q.n, &s, side, of_places), "%s", m->name));
	for (size_t k = 0; k < q.n; k++)
		normal[q.of[k]] = of_places[k];
	r->outliers = s.outliers;
	return fill_others(ctx, m, &s, &q, normal);
}

static mr_status
put_normals(mr_ctx *ctx, mr_frame *f, const mr_normals_opts *o, mr_normals_result *r)
{
	static const char *const reads[] = { "mesh", "control", "points", NULL };
	const void *there = NULL;
	const char *layer;
	mr_v3 *normal;
	mr_mesh m;

	MR_TRY(mr_check_number(ctx, "neighbours", (double)o->neighbours, 0, 128));
	MR_TRY(mr_layer_choose_warned(ctx, f, o->layer, reads, &layer));
	MR_TRY(mr_layer_surface_or_points(ctx, f, layer, &m));
	if (m.nf && (o->neighbours || o->from))
		return mr_fail(ctx, MR_EUSAGE,
		    "%s has faces: neighbours and the place they are seen from are of points", layer);
	if (mr_layer_has(f, layer, "normal"))
		MR_TRY(mr_layer_get_rows(ctx, f, layer, "normal", m.nv, &there));
	normal = MR_NEW(ctx, m.nv, mr_v3);
	if (m.nf)
		mr_vertex_normals(&m, normal);
	else
		MR_TRY(of_points(ctx, f, &m, o, there, normal, r));
	finish(o, there, m.nv, normal, r);
	mr_frame_drop(f, layer, "corner_normal", 0);
	return mr_layer_put(ctx, f, layer, "normal", normal, m.nv);
}

mr_status
mr_normals_frame(mr_ctx *ctx, mr_frame *f, const mr_normals_opts *opts, mr_normals_result *result)
{
	static const mr_normals_opts defaults;
	mr_normals_result r = { 0 };

	MR_ON_COPY(ctx, f, done, result, r, put_normals(ctx, &done, opts ? opts : &defaults, &r));
}
