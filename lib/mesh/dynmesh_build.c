/* A dynmesh from a mesh, with its curves of sharp edges; views and copies of it. */
#include "mesh/dynmesh.h"

/* Unit direction from a to b. */
static mr_v3
direction(const mr_dyn *d, uint32_t a, uint32_t b)
{
	return mr_unit(mr_sub(d->p[b], d->p[a]));
}

/* Boundaries, seams, and edges sharper than `feature` degrees. */
static void
mark_curves(mr_ctx *ctx, mr_dyn *d, const uint8_t *seam, double feature)
{
	double cosine = cos(feature * MR_PI / 180);

	for (uint32_t h = 0; h < 3 * d->nf; h++) {
		uint32_t g = d->twin[h];
		if (g != MR_NONE && !(seam && seam[h]) &&
		    !(feature < 180 && mr_dot(mr_unit(mr_dyn_cross(d, d->p, h / 3)),
					   mr_unit(mr_dyn_cross(d, d->p, g / 3))) < cosine))
			continue;
		if (!d->curve) {
			d->curve = MR_NEW(ctx, 3 * d->room_f, uint32_t);
			memset(d->curve, 0xff, 3 * d->nf * sizeof *d->curve);
		}
		d->curve[h] = h;
	}
}

/* The kind of v by the curve edges that meet there. */
static mr_kind
kind_of(const mr_dyn *d, uint32_t v)
{
	uint32_t end[2];
	unsigned curves = mr_dyn_along(d, v, end);

	if (curves == 0)
		return MR_SMOOTH;
	return curves == 2 && mr_dot(direction(d, end[0], v), direction(d, v, end[1])) > MR_CORNER_COSINE
	           ? MR_CURVE
	           : MR_CORNER;
}

/* A place on the source for a vertex to begin with: a face at it, or a curve half-edge. */
static uint32_t
first_place(const mr_dyn *d, uint32_t v)
{
	uint32_t h = d->out[v];

	if (d->kind[v] == MR_SMOOTH)
		return h / 3;
	do {
		if (mr_dyn_on_curve(d, h))
			return h;
		h = mr_dyn_ccw(d, h);
	} while (h != MR_NONE && h != d->out[v]);
	return d->out[v];
}

void
mr_dyn_room_v(mr_ctx *ctx, mr_dyn *d, size_t room)
{
	mr_v3 *p = mr_grow(ctx, d->p, d->nv, room, sizeof *p);
	uint32_t *out = mr_grow(ctx, d->out, d->nv, room, sizeof *out);
	uint32_t *at = mr_grow(ctx, d->at, d->nv, room, sizeof *at);
	uint8_t *kind = mr_grow(ctx, d->kind, d->nv, room, sizeof *kind);

	d->p = p;
	d->out = out;
	d->at = at;
	d->kind = kind;
	d->room_v = room;
}

mr_status
mr_dyn_room_f(mr_ctx *ctx, mr_dyn *d, size_t room)
{
	uint32_t *v = mr_grow(ctx, d->v, 3 * d->nf, 3 * room, sizeof *v);
	uint32_t *twin = mr_grow(ctx, d->twin, 3 * d->nf, 3 * room, sizeof *twin);

	if (room > (MR_NONE - 1) / 3)
		return mr_fail(
		    ctx, MR_ERANGE, "remeshing would take more than %zu faces", (size_t)(MR_NONE - 1) / 6);
	d->v = v;
	d->twin = twin;
	if (d->curve)
		d->curve = mr_grow(ctx, d->curve, 3 * d->nf, 3 * room, sizeof *d->curve);
	d->room_f = room;
	return MR_OK;
}

/* Room for what splits add, more than they need but seldom: what is not used of it costs no memory. */
static size_t
ample(size_t n)
{
	return n < MR_NONE / 16 ? 4 * n + 32 : n + n / 4 + 32;
}

mr_status
mr_dyn_build(
    mr_ctx *ctx, const mr_mesh *m, const mr_topology *topo, const uint8_t *seam, double feature, mr_dyn *out)
{
	mr_dyn d = { .free_v = MR_NONE, .free_f = MR_NONE };

	mr_dyn_room_v(ctx, &d, ample(m->nv));
	MR_TRY(mr_dyn_room_f(ctx, &d, ample(m->nf)));
	d.nv = m->nv;
	d.nf = m->nf;
	memcpy(d.p, m->p, m->nv * sizeof *d.p);
	memcpy(d.out, topo->out, m->nv * sizeof *d.out);
	memcpy(d.v, m->t, 3 * m->nf * sizeof *d.v);
	memcpy(d.twin, topo->twin, 3 * m->nf * sizeof *d.twin);
	mark_curves(ctx, &d, seam, feature);
	memset(d.kind, MR_SMOOTH, m->nv);
	for (uint32_t v = 0; v < m->nv; v++) {
		if (d.out[v] == MR_NONE) {
			d.kind[v] = MR_DEAD; /* an isolated vertex: not part of the surface */
			continue;
		}
		d.kind[v] = (uint8_t)kind_of(&d, v);
		d.at[v] = first_place(&d, v);
	}
	*out = d;
	return MR_OK;
}

mr_mesh
mr_dyn_view(const mr_dyn *d, const char *name)
{
	return (mr_mesh){ name, d->p, (const mr_tri *)(const void *)d->v, d->nv, d->nf };
}
