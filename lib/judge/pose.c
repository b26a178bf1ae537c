/* Constrained vertices off the maps fitted to their regions by least squares; and the volume. */
#include "judge/judge.h"

#include "base/rotation.h"

/* to + A (x - from), from and to the means. */
typedef struct fit {
	size_t n;
	mr_v3 from, to;
	mr_mat3 xx, yx; /* sums of x x^T and y x^T about them; then A is yx */
	mr_mat3 turn;   /* the rotation nearest to A */
	bool given;     /* places of its own to each vertex */
} fit;

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
	xx = mr_mat3_inverse_transposed(&xx); /* symmetric */
	return mr_mat3_multiply(&yx, &xx);
}

/* The map of fixed vertices is the identity. */
static void
fit_maps(const mr_ground *g, size_t regions, size_t stride, fit *fits)
{
	const mr_v3 *from = g->then.p, *to = g->now;
	const uint32_t *region = g->region;
	size_t nv = g->then.nv;

	for (size_t v = 0; v < nv; v += stride) {
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
	for (size_t v = 0; v < nv; v += stride) {
		fit *f = &fits[region[v]];
		mr_v3 x = mr_sub(from[v], f->from);
		mr_mat3_add_product(&f->xx, 1, x, x);
		mr_mat3_add_product(&f->yx, 1, mr_sub(to[v], f->to), x);
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

/* Handles that only turn ask for no other volume.  far: that is no move. */
static bool
keeps_volume(const fit *fits, size_t regions, double far)
{
	const double little = 0.01;     /* change of volume, of rigid parts */
	const double least = MR_PI / 6; /* of a pull, which may change the volume, handles turn by less */
	const fit *lowest = NULL;
	bool moved = false, turned = false;

	for (size_t r = 0; r < regions; r++) {
		const fit *own = &fits[r];
		mr_mat3 between;
		if (!own->n || r == MR_REGION_FREE)
			continue;
		if (own->given || !(fabs(mr_mat3_determinant(&own->yx) - 1) < little))
			return false;
		lowest = lowest ? lowest : own;
		between = mr_mat3_multiply_transposed(&lowest->turn, &own->turn);
		turned |= mr_norm(mr_rotation_log(&between, mr_vec(0, 0, 0))) >= least;
		moved |= mr_dist(own->to, map_of(lowest, own->from)) > far;
	}
	return turned || !moved;
}

enum { LOOKS = 1 << 14 };

/* The volume of the closed surface as a share of the old one, by faces at equal strides. */
static double
volume_share(const mr_motion *m)
{
	const mr_mesh *then = m->then;
	mr_v3 from = then->p[then->t[0].v[0]], to = m->now[then->t[0].v[0]];
	double was = 0, is = 0;

	for (size_t f = 0; f < then->nf; f += 1 + then->nf / LOOKS) {
		const uint32_t *v = then->t[f].v;
		was += mr_dot(mr_sub(then->p[v[0]], from),
		    mr_cross(mr_sub(then->p[v[1]], from), mr_sub(then->p[v[2]], from)));
		is += mr_dot(
		    mr_sub(m->now[v[0]], to), mr_cross(mr_sub(m->now[v[1]], to), mr_sub(m->now[v[2]], to)));
	}
	return was != 0 ? is / was : 1;
}

static void
judge_volume(mr_ctx *ctx, const mr_motion *m, bool kept)
{
	const double much = 0.1;
	double share = volume_share(m);

	if (share < 0)
		mr_motion_found(ctx, m,
		    (mr_finding){ .kind = MR_VOLUME, .value = share - 1, .what = ": it is inside out" },
		    MR_NONE);
	else if (kept && fabs(share - 1) > much)
		mr_motion_found(ctx, m, (mr_finding){ .kind = MR_VOLUME, .value = share - 1 }, MR_NONE);
}

/* A region is left out whose own vertices are off its map, because each was given a place. */
static void
judge_places(mr_ctx *ctx, const mr_motion *m, const mr_ground *g, const fit *fits, size_t regions, double far)
{
	size_t stride = 1 + m->then->nv / LOOKS, off = 0, looked = 0;

	for (size_t v = 0; v < m->then->nv; v += stride) {
		uint32_t r = g->surface_region[v];
		if (r == MR_REGION_FREE || r >= regions)
			continue;
		looked++;
		off += !fits[r].given && (fits[r].n || r == MR_REGION_FIXED) &&
		       mr_dist(m->now[v], map_of(&fits[r], m->then->p[v])) > far;
	}
	if (off)
		mr_motion_found(ctx, m,
		    (mr_finding){ .kind = MR_MISSED, .count = off * stride, .of = looked * stride }, MR_NONE);
}

void
mr_judge_pose(mr_ctx *ctx, const mr_motion *m, const mr_ground *g, bool closed)
{
	const double far = 0.005 * m->diagonal;
	const mr_mesh *base = &g->then;
	size_t regions = MR_REGION_HANDLE, stride = 1 + base->nv / LOOKS;
	fit *fits;

	for (size_t v = 0; v < base->nv; v++)
		regions = g->region[v] < regions ? regions : (size_t)g->region[v] + 1;
	fits = MR_NEW_ZERO(ctx, regions, fit);
	fit_maps(g, regions, stride, fits);
	for (size_t v = 0; v < base->nv; v += stride) {
		fit *f = &fits[g->region[v]];
		f->given |= mr_dist(g->now[v], map_of(f, base->p[v])) > far;
	}
	judge_places(ctx, m, g, fits, regions, far);
	if (closed && m->then->nf)
		judge_volume(ctx, m, keeps_volume(fits, regions, far));
}
