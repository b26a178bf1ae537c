/*
 * How far two surfaces, or clouds, are from one another: distances from points of one to the nearest point of
 * the other, exact point to triangle.  Mean and root mean square are integrals over the surface by the
 * midpoint rule on a subdivision of its faces; the greatest distance lies between max, which is attained, and
 * max_bound.
 */
#include "measure/compare_parts.h"

#include "base/options.h"
#include "mesh/edges.h"

/* A cloud as a mesh of faces without area, one a point. */
static mr_status
with_faces(mr_ctx *ctx, const mr_mesh *m, mr_mesh *out)
{
	mr_tri *t;

	*out = *m;
	if (m->nf)
		return MR_OK;
	if (m->nv == 0)
		return mr_fail(ctx, MR_EMESH, "%s: no points to compare", m->name);
	if (m->nv > (MR_NONE - 1) / 3)
		return mr_fail(
		    ctx, MR_ERANGE, "%s: %zu points are more than %u", m->name, m->nv, (MR_NONE - 1) / 3);
	t = MR_NEW(ctx, m->nv, mr_tri);
	for (uint32_t i = 0; i < m->nv; i++)
		t[i] = (mr_tri){ { i, i, i } };
	out->t = t;
	out->nf = m->nv;
	return MR_OK;
}

static bool
corresponds(const mr_mesh *a, const mr_mesh *b)
{
	return a->nv == b->nv && a->nf == b->nf && (a->nf == 0 || !memcmp(a->t, b->t, a->nf * sizeof *a->t));
}

static void
measure_deviation(const mr_mesh *a, const mr_mesh *b, mr_deviation *d)
{
	double sum = 0, square = 0;

	d->max = -1;
	for (size_t i = 0; i < a->nv; i++) {
		double x = mr_dist(a->p[i], b->p[i]);
		if (x > d->max) {
			d->max = x;
			d->vertex = i;
		}
		sum += x;
		square += x * x;
	}
	d->mean = sum / (double)a->nv;
	d->rms = sqrt(square / (double)a->nv);
}

static void
measure_stretch(mr_ctx *ctx, const mr_mesh *a, const mr_mesh *b, mr_deviation *d)
{
	mr_mark mark = mr_mark_take(ctx);
	double low = INFINITY, high = 0, sum = 0;
	mr_edges edges;
	size_t n = 0;

	mr_edges_build(ctx, a, &edges);
	for (size_t e = 0; e < edges.count; e++) {
		uint32_t h = edges.he[edges.start[e]], from = mr_he_from(a, h), to = mr_he_to(a, h);
		double stretch = mr_dist(b->p[from], b->p[to]) / mr_dist(a->p[from], a->p[to]);
		if (isnan(stretch)) /* of length 0 in both */
			continue;
		low = fmin(low, stretch);
		high = fmax(high, stretch);
		sum += stretch;
		n++;
	}
	d->stretch_min = n ? low : NAN;
	d->stretch_max = n ? high : NAN;
	d->stretch_mean = n ? sum / (double)n : NAN;
	mr_mark_release(ctx, mark);
}

static mr_distance
join(const mr_distance *a, const mr_distance *b)
{
	return (mr_distance){ fmin(a->min, b->min), fmax(a->max, b->max), fmax(a->max_bound, b->max_bound),
		(a->mean + b->mean) / 2, sqrt((a->rms * a->rms + b->rms * b->rms) / 2),
		a->samples + b->samples };
}

static mr_status
compare(mr_ctx *ctx, const mr_mesh *a, const mr_mesh *b, const mr_compare_opts *o, mr_comparison *out)
{
	mr_mark mark = mr_mark_take(ctx);
	mr_comparison c = { .corresponds = corresponds(a, b), .diagonal = mr_mesh_diagonal(b) };
	double scale = fmax(mr_mesh_diagonal(a), c.diagonal);
	mr_mesh fa, fb;

	MR_TRY(mr_check_number(ctx, "tolerance", o->tolerance, 1e-9, 1));
	MR_TRY(with_faces(ctx, a, &fa));
	MR_TRY(with_faces(ctx, b, &fb));
	MR_TRY(mr_compare_one_way(ctx, &fa, &fb, o, c.corresponds, scale, &c.ab));
	MR_TRY(mr_compare_one_way(ctx, &fb, &fa, o, c.corresponds, scale, &c.ba));
	c.both = join(&c.ab, &c.ba);
	if (c.corresponds) {
		measure_deviation(a, b, &c.deviation);
		measure_stretch(ctx, a, b, &c.deviation);
	}
	mr_mark_release(ctx, mark);
	*out = c;
	return MR_OK;
}

mr_status
mr_compare(mr_ctx *ctx, const mr_mesh *a, const mr_mesh *b, const mr_compare_opts *opts, mr_comparison *out)
{
	static const mr_compare_opts defaults = MR_COMPARE_DEFAULTS;

	MR_ENTER(ctx);
	return compare(ctx, a, b, opts ? opts : &defaults, out);
}
