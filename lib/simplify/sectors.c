/*
 * Between two curves with k faces, a subdivision shrinks the edges at a corner to 3/8 + cos(pi / k) / 4, the
 * curves to 1/2.  Up to three faces the curves stay the longer: the limit surface spans the angle below half
 * a turn between them, whatever the control mesh does.
 */
#include "simplify/sectors.h"

/* Faces of a sector that is WIDE: the fit may turn its curves by the rest of half a turn. */
enum { ENOUGH = 4 };
static const double WIDE = 5 * MR_PI / 6;

/* The edge across the widest face of the sector that begins at h; MR_NONE where that has faces enough. */
static uint32_t
edge_to_split(const mr_dyn *d, uint32_t h)
{
	double sum = 0, widest = 0;
	uint32_t across = MR_NONE;
	mr_v3 p = d->p[d->v[h]];
	int faces = 0;

	do {
		double angle = mr_angle(mr_sub(d->p[mr_dyn_to(d, h)], p), mr_sub(d->p[mr_dyn_apex(d, h)], p));
		if (angle > widest) {
			widest = angle;
			across = mr_he_next(h);
		}
		sum += angle;
		faces++;
		h = mr_dyn_ccw(d, h);
	} while (h != MR_NONE && !mr_dyn_on_curve(d, h));
	return sum > WIDE && faces < ENOUGH ? across : MR_NONE;
}

static mr_status
split(mr_ctx *ctx, mr_dyn *d, uint32_t h)
{
	uint32_t middle;

	return mr_dyn_split(ctx, d, h, mr_mul(0.5, mr_add(d->p[d->v[h]], d->p[mr_dyn_to(d, h)])), &middle);
}

static mr_status
fill_around(mr_ctx *ctx, mr_dyn *d, uint32_t v)
{
	uint32_t end[2], h = d->out[v], across;

	if (mr_dyn_along(d, v, end) < 3)
		return MR_OK;
	do {
		while (mr_dyn_on_curve(d, h) && (across = edge_to_split(d, h)) != MR_NONE &&
		       mr_dyn_can_split(d, across))
			MR_TRY(split(ctx, d, across));
		h = mr_dyn_ccw(d, h);
	} while (h != MR_NONE && h != d->out[v]);
	return MR_OK;
}

mr_status
mr_fill_sectors(mr_ctx *ctx, mr_mesh *m, uint8_t **sharp)
{
	mr_topology topo;
	mr_dyn d;

	MR_TRY(mr_topology_build(ctx, m, &topo));
	MR_TRY(mr_dyn_build(ctx, m, &topo, *sharp, 180, &d));
	for (uint32_t v = 0; v < m->nv; v++)
		MR_TRY(fill_around(ctx, &d, v));
	*m = mr_dyn_view(&d, m->name);
	*sharp = MR_NEW(ctx, 3 * m->nf, uint8_t);
	for (uint32_t h = 0; h < 3 * m->nf; h++)
		(*sharp)[h] = d.twin[h] != MR_NONE && mr_dyn_on_curve(&d, h);
	return MR_OK;
}
