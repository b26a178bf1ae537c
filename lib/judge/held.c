/* The maps of regions by least squares, and who is off them. */
#include "judge/held.h"

#include "base/rotation.h"
#include "mesh/layers.h"

#include <math.h>

/* to + A (x - from), from and to the means. */
typedef struct fit {
	size_t n;
	mr_v3 from, to;
	mr_mat3 xx, yx; /* sums of x x^T and y x^T about them; then A is yx */
	mr_mat3 turn;   /* the rotation nearest to A */
	bool given;     /* places of its own to each vertex */
} fit;

static void
add_product(mr_mat3 *sum, mr_v3 a, mr_v3 b)
{
	const double x[3] = { a.x, a.y, a.z }, y[3] = { b.x, b.y, b.z };

	for (int i = 0; i < 9; i++)
		sum->m[i] += x[i / 3] * y[i % 3];
}

/* Of a symmetric matrix. */
static mr_mat3
inverse(const mr_mat3 *s)
{
	const double *m = s->m, f = 1 / mr_mat3_determinant(s);

	return (mr_mat3){ { f * (m[4] * m[8] - m[5] * m[7]), f * (m[2] * m[7] - m[1] * m[8]),
	    f * (m[1] * m[5] - m[2] * m[4]), f * (m[5] * m[6] - m[3] * m[8]), f * (m[0] * m[8] - m[2] * m[6]),
	    f * (m[2] * m[3] - m[0] * m[5]), f * (m[3] * m[7] - m[4] * m[6]), f * (m[1] * m[6] - m[0] * m[7]),
	    f * (m[0] * m[4] - m[1] * m[3]) } };
}

/* A, which turns where x has no extent. */
static mr_mat3
linear_part(const fit *f)
{
	const double little = 1e-9;
	double extent = f->xx.m[0] + f->xx.m[4] + f->xx.m[8];
	mr_mat3 identity = mr_mat3_identity(), turn = identity, xx, yx;

	if (!(extent > 0))
		return identity;
	turn = mr_mat3_axpy(little * extent, &identity, &f->yx);
	turn = mr_rotation_nearest(&turn);
	xx = mr_mat3_axpy(little * extent, &identity, &f->xx);
	yx = mr_mat3_axpy(little * extent, &turn, &f->yx);
	xx = inverse(&xx);
	return mr_mat3_multiply(&yx, &xx);
}

/* That of fixed vertices is the identity. */
static void
fit_maps(const mr_ground *g, size_t regions, fit *fits)
{
	const mr_v3 *from = g->then.p, *to = g->now;
	const uint32_t *region = g->region;
	size_t nv = g->then.nv;

	for (size_t v = 0; v < nv; v++) {
		fit *f = &fits[region[v]];
		f->n++;
		f->from = mr_add(f->from, from[v]);
		f->to = mr_add(f->to, to[v]);
	}
	for (size_t r = 0; r < regions; r++) {
		fits[r].from = mr_mul(1 / fmax(1, (double)fits[r].n), fits[r].from);
		fits[r].to = r == MR_REGION_FIXED ? fits[r].from
		                                  : mr_mul(1 / fmax(1, (double)fits[r].n), fits[r].to);
	}
	for (size_t v = 0; v < nv; v++) {
		fit *f = &fits[region[v]];
		mr_v3 x = mr_sub(from[v], f->from);
		add_product(&f->xx, x, x);
		add_product(&f->yx, mr_sub(to[v], f->to), x);
	}
	for (size_t r = 0; r < regions; r++) {
		fits[r].yx = r == MR_REGION_FIXED ? mr_mat3_identity() : linear_part(&fits[r]);
		fits[r].turn = mr_rotation_nearest(&fits[r].yx);
	}
}

static mr_v3
map_of(const fit *f, mr_v3 from)
{
	return mr_add(f->to, mr_mat3_apply(&f->yx, mr_sub(from, f->from)));
}

/* Where vertex v belongs if what stands on base turns with it and keeps its length. */
static mr_v3
turned(const mr_motion *m, const mr_ground *g, const fit *f, size_t v)
{
	mr_v3 foot = g->foot ? g->foot[v] : mr_place_point(&g->then, mr_places_at(&g->at, v));

	return mr_add(map_of(f, foot), mr_mat3_apply(&f->turn, mr_sub(m->then->p[v], foot)));
}

static void
count_vertex(
    const mr_motion *m, const mr_ground *g, const fit *f, size_t v, bool faceless, double far, mr_held *h)
{
	uint32_t r = g->surface_region[v];
	bool off = !f->given && (f->n || r == MR_REGION_FIXED) &&
	           mr_dist(m->now[v], map_of(f, m->then->p[v])) > far;

	if (!off)
		return;
	if (faceless)
		h->faceless++;
	else if (r == MR_REGION_FIXED)
		h->moved++;
	else if (mr_mat3_determinant(&f->yx) >= 0 && mr_dist(m->now[v], turned(m, g, f, v)) > far)
		h->missed++;
	else
		h->unscaled++;
}

static bool
is_rigid(const fit *f)
{
	const double little = 0.01;

	return !f->given && fabs(mr_mat3_determinant(&f->yx) - 1) < little;
}

/* keeps_volume of mr_held: handles turn, or are where they were.  far: that is no move. */
static bool
keeps_volume(const fit *fits, size_t regions, double far, bool *turned)
{
	const double least = MR_PI / 6; /* of a pull, which may change the volume, handles turn by less */
	const fit *lowest = NULL;
	bool moved = false;

	*turned = false;
	for (size_t r = 0; r < regions; r++) {
		const fit *own = &fits[r];
		mr_mat3 between;
		if (!own->n || r == MR_REGION_FREE)
			continue;
		if (!is_rigid(own))
			return false;
		lowest = lowest ? lowest : own;
		between = mr_mat3_multiply_transposed(&lowest->turn, &own->turn);
		*turned |= mr_norm(mr_rotation_log(&between, mr_vec(0, 0, 0))) >= least;
		moved |= mr_dist(own->to, map_of(lowest, own->from)) > far;
	}
	return *turned || !moved;
}

void
mr_held_count(mr_ctx *ctx, const mr_motion *m, const mr_ground *g, double far, mr_held *held)
{
	const mr_mesh *mesh = m->then, *base = &g->then;
	mr_mark mark = mr_mark_take(ctx);
	size_t regions = MR_REGION_HANDLE;
	mr_held h = { 0 };
	size_t count;
	bool *used;
	fit *fits;

	for (size_t v = 0; v < base->nv; v++)
		regions = g->region[v] < regions ? regions : (size_t)g->region[v] + 1;
	fits = MR_NEW_ZERO(ctx, regions, fit);
	mr_vertices_used(ctx, mesh->t, mesh->nf, mesh->nv, &used, &count);
	fit_maps(g, regions, fits);
	for (size_t v = 0; v < base->nv; v++) {
		fit *f = &fits[g->region[v]];
		f->given |= mr_dist(g->now[v], map_of(f, base->p[v])) > far;
	}
	h.keeps_volume = keeps_volume(fits, regions, far, &h.turned);
	for (size_t v = 0; v < mesh->nv; v++) {
		uint32_t r = g->surface_region[v];
		h.fixed += used[v] && r == MR_REGION_FIXED;
		h.handled += used[v] && r >= MR_REGION_HANDLE;
		if (r != MR_REGION_FREE && r < regions)
			count_vertex(m, g, &fits[r], v, !used[v], far, &h);
	}
	mr_mark_release(ctx, mark);
	*held = h;
}
