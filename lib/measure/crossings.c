/* Intersections before and after; before, only where there are some after. */
#include "measure/crossings.h"

#include "space/bvh.h"
#include "space/self_intersect.h"

/* Pairs, or faces, that say nothing. */
enum { FEW = 5 };

/* The faces of m that are kept. */
static mr_status
take_faces(mr_ctx *ctx, const mr_mesh *m, const bool *keep, mr_mesh *part)
{
	mr_tri *t = MR_NEW(ctx, m->nf, mr_tri);

	if (!t)
		return MR_EMEM;
	*part = *m;
	part->t = t;
	part->nf = 0;
	for (size_t f = 0; f < m->nf; f++)
		if (keep[f])
			t[part->nf++] = m->t[f];
	return MR_OK;
}

/* The faces of m that became, in part, those of `after` that cross others. */
static mr_status
part_that_crosses(mr_ctx *ctx, const mr_mesh *m, const uint32_t *onto, const mr_mesh *after,
    const bool *crosses, mr_mesh *part)
{
	bool *near = MR_NEW_ZERO(ctx, after->nv, bool), *keep = MR_NEW(ctx, m->nf, bool);

	if (!near || !keep)
		return MR_EMEM;
	for (size_t f = 0; f < after->nf; f++)
		for (int k = 0; k < 3 && crosses[f]; k++)
			near[after->t[f].v[k]] = true;
	for (size_t f = 0; f < m->nf; f++) {
		const uint32_t *v = m->t[f].v;
		keep[f] = near[onto[v[0]]] || near[onto[v[1]]] || near[onto[v[2]]];
	}
	return take_faces(ctx, m, keep, part);
}

/* A corner of the first face that crosses one. */
static uint32_t
first_vertex(const mr_mesh *m, const bool *crosses)
{
	size_t f = 0;

	while (!crosses[f])
		f++;
	return m->t[f].v[0];
}

/* The share of the faces that cross which are farther than they are long from those of m that did. */
static mr_status
find_new(mr_ctx *ctx, const mr_mesh *m, const bool *crossed, const mr_mesh *after, const bool *crosses,
    double *share)
{
	size_t count = 0, all = 0;
	mr_mesh old;
	mr_bvh *bvh;

	MR_TRY(take_faces(ctx, m, crossed, &old));
	MR_TRY(mr_bvh_build(ctx, &old, &bvh));
	for (size_t f = 0; f < after->nf; f++) {
		const uint32_t *v = after->t[f].v;
		mr_v3 p[3] = { after->p[v[0]], after->p[v[1]], after->p[v[2]] };
		mr_closest c = { .dist2 = INFINITY };
		if (crosses[f] && old.nf > 0)
			c = mr_bvh_closest(bvh, mr_mean3(p[0], p[1], p[2]));
		all += crosses[f];
		count += crosses[f] && sqrt(c.dist2) > mr_box_diagonal(mr_box_of(p, 3));
	}
	*share = (double)count / (double)all;
	return MR_OK;
}

/* What there is to say of crossings of which a share is new. */
static const char *
cause_of(double share)
{
	if (share == 0)
		return ", in the same places";
	return share < 0.5 ? ", most of them in the same places"
	                   : ": it is too coarse for what is thin or near";
}

mr_status
mr_crossings_warn(mr_ctx *ctx, const mr_mesh *before, const uint32_t *onto, const mr_mesh *after)
{
	mr_mark mark = mr_mark_take(ctx);
	bool *crosses = MR_NEW(ctx, after->nf, bool), *crossed = MR_NEW(ctx, before->nf, bool);
	size_t pairs, old = 0;
	double new;
	mr_mesh part = *before;
	mr_v3 at;

	if (!crosses || !crossed)
		return MR_EMEM;
	MR_TRY(mr_self_intersections(ctx, NULL, after, crosses, &pairs));
	if (pairs > FEW && onto)
		MR_TRY(part_that_crosses(ctx, before, onto, after, crosses, &part));
	if (pairs > FEW)
		MR_TRY(mr_self_intersections(ctx, NULL, &part, crossed, &old));
	if (pairs > FEW + 2 * old) { /* bodies that crossed before do so in more or fewer pairs */
		uint32_t v = first_vertex(after, crosses);
		MR_TRY(find_new(ctx, &part, crossed, after, crosses, &new));
		at = after->p[v];
		mr_warn(ctx,
		    "%zu pairs of faces of the result intersect, where %zu did before%s, as at vertex %u "
		    "(%.4g, %.4g, %.4g)",
		    pairs, old, cause_of(new), v, at.x, at.y, at.z);
	}
	mr_mark_release(ctx, mark);
	return MR_OK;
}
