/* Anchors of parts that follow, and the rigid motions that fit theirs. */
#include "edit/deform_parts.h"

#include "base/rotation.h"
#include "space/near.h"

/* The anchors of a part are those nearest to the middle of its box. */
static mr_status
find_anchors(mr_ctx *ctx, const mr_mesh *rest, const mr_box *box, mr_loose *l)
{
	MR_SCOPE(ctx);
	uint32_t *lead = MR_NEW(ctx, rest->nv, uint32_t);
	mr_v3 *at = MR_NEW(ctx, rest->nv, mr_v3), *middle = MR_NEW(ctx, l->parts, mr_v3);
	size_t leading = 0;

	for (uint32_t v = 0; v < rest->nv; v++)
		if (l->part[v] == MR_NONE) {
			at[leading] = rest->p[v];
			lead[leading++] = v;
		}
	for (size_t k = 0; k < l->parts; k++)
		middle[k] = mr_lerp(0.5, box[k].min, box[k].max);
	MR_TRY(mr_near_once(ctx, at, leading, middle, l->parts, MR_ANCHORS, l->anchor, NULL));
	for (size_t i = 0; i < l->parts * MR_ANCHORS; i++)
		if (l->anchor[i] != MR_NONE)
			l->anchor[i] = lead[l->anchor[i]];
	return MR_OK;
}

mr_status
mr_loose_make(mr_ctx *ctx, const mr_mesh *rest, const bool *follows, const uint32_t *root, mr_loose *l)
{
	mr_box *box;

	*l = (mr_loose){ .nv = rest->nv, .part = MR_NEW(ctx, rest->nv, uint32_t) };
	for (size_t v = 0; v < rest->nv; v++)
		l->part[v] = follows[v] && root[v] == v ? (uint32_t)l->parts++ : MR_NONE;
	if (!l->parts)
		return MR_OK;
	if (MR_BROWSER)
		return mr_fail(ctx, MR_EMESH, "%zu parts hold to nothing", l->parts);
	l->anchor = MR_NEW(ctx, l->parts * MR_ANCHORS, uint32_t);
	box = MR_NEW(ctx, l->parts, mr_box);
	for (size_t k = 0; k < l->parts; k++)
		box[k] = mr_box_empty();
	for (size_t v = 0; v < rest->nv; v++)
		if (follows[v]) {
			l->part[v] = l->part[root[v]];
			mr_box_add(&box[l->part[v]], rest->p[v]);
		}
	return find_anchors(ctx, rest, box, l);
}

static size_t
count_anchors(const uint32_t *anchor)
{
	size_t n = 0;

	while (n < MR_ANCHORS && anchor[n] != MR_NONE)
		n++;
	return n;
}

static mr_v3
mean_of(const uint32_t *anchor, size_t n, const mr_v3 *p)
{
	mr_v3 sum = mr_vec(0, 0, 0);

	for (size_t k = 0; k < n; k++)
		sum = mr_axpy(1 / (double)n, p[anchor[k]], sum);
	return sum;
}

/* The rigid motion that takes the anchors from p0 to p; no rotation about an undetermined axis, and none at
 * all, bit for bit, if they all move alike. */
static mr_affine
motion_of(const uint32_t *anchor, const mr_v3 *p0, const mr_v3 *p)
{
	static const double least = 1e-12;
	size_t n = count_anchors(anchor);
	mr_v3 from = mean_of(anchor, n, p0), to = mean_of(anchor, n, p),
	      shift = mr_sub(p[*anchor], p0[*anchor]);
	mr_mat3 c = { { 0 } }, r;
	double spread = 0;
	bool turns = false;

	for (size_t k = 0; k < n; k++) {
		mr_v3 x = mr_sub(p0[anchor[k]], from), y = mr_sub(p[anchor[k]], to);
		mr_v3 by = mr_sub(p[anchor[k]], p0[anchor[k]]);
		turns |= by.x != shift.x || by.y != shift.y || by.z != shift.z;
		spread += mr_norm2(x);
		mr_mat3_add_product(&c, 1, y, x);
	}
	for (int i = 0; i < 3; i++)
		c.m[4 * i] += least * spread;
	r = turns ? mr_rotation_nearest(&c) : mr_mat3_identity();
	if (turns)
		shift = mr_sub(to, mr_mat3_apply(&r, from));
	return (mr_affine){ { r.m[0], r.m[1], r.m[2], shift.x, r.m[3], r.m[4], r.m[5], shift.y, r.m[6],
	    r.m[7], r.m[8], shift.z } };
}

void
mr_loose_follow(mr_ctx *ctx, const mr_loose *l, const mr_v3 *p0, mr_v3 *p)
{
	mr_affine *motion = MR_NEW(ctx, l->parts, mr_affine);

	for (size_t k = 0; k < l->parts; k++)
		motion[k] = motion_of(l->anchor + k * MR_ANCHORS, p0, p);
	for (size_t v = 0; l->parts && v < l->nv; v++)
		if (l->part[v] != MR_NONE && !mr_is_identity(&motion[l->part[v]]))
			p[v] = mr_apply(&motion[l->part[v]], p0[v]);
}

/* A row of 4 values a handle, (x, y, z, 1) times how much it moves: (x, y, z) at the follower is known. */
static void
respond(const uint32_t *anchor, size_t handles, const mr_v3 *p0, uint32_t v, double *response)
{
	size_t n = count_anchors(anchor);
	mr_v3 off = mr_sub(p0[v], mean_of(anchor, n, p0));
	double *row = response + 4 * handles * v;

	for (size_t h = 0; h < handles; h++, row += 4) {
		for (size_t k = 0; k < n; k++)
			for (size_t c = 0; c < 4; c++)
				row[c] += response[4 * (handles * anchor[k] + h) + c] / (double)n;
		row[0] += row[3] * off.x;
		row[1] += row[3] * off.y;
		row[2] += row[3] * off.z;
	}
}

void
mr_loose_respond(const mr_loose *l, size_t handles, const mr_v3 *p0, double *response)
{
	for (uint32_t v = 0; l->parts && v < l->nv; v++)
		if (l->part[v] != MR_NONE)
			respond(l->anchor + l->part[v] * MR_ANCHORS, handles, p0, v, response);
}
