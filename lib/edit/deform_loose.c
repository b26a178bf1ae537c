/* Anchors of parts that follow, and the rigid motions that fit theirs. */
#include "edit/deform_loose.h"

#include "base/rotation.h"
#include "space/near.h"

/* The vertices that follow, part by part. */
static void
list_parts(mr_ctx *ctx, size_t nv, const bool *follows, const uint32_t *part, mr_loose *l)
{
	mr_mark mark;
	uint32_t *number;

	for (size_t v = 0; v < nv; v++) {
		l->n += follows[v];
		l->parts += follows[v] && part[v] == v;
	}
	l->vertex = MR_NEW(ctx, l->n, uint32_t);
	l->start = MR_NEW_ZERO(ctx, l->parts + 2, size_t);
	mark = mr_mark_take(ctx);
	number = MR_NEW(ctx, nv, uint32_t);
	for (uint32_t v = 0, n = 0; v < nv; v++)
		if (follows[v] && part[v] == v)
			number[v] = n++;
	for (size_t v = 0; v < nv; v++)
		if (follows[v])
			l->start[number[part[v]] + 2]++;
	for (size_t k = 2; k < l->parts + 2; k++)
		l->start[k] += l->start[k - 1];
	for (uint32_t v = 0; v < nv; v++)
		if (follows[v])
			l->vertex[l->start[number[part[v]] + 1]++] = v;
	mr_mark_release(ctx, mark);
}

/* The anchors of a part are those nearest to the middle of its box. */
mr_status
mr_loose_make(mr_ctx *ctx, const mr_mesh *rest, const bool *leads, const bool *follows, const uint32_t *part,
    mr_loose *l)
{
	uint32_t *lead;
	size_t leading = 0;
	mr_v3 *at, *middle;
	mr_mark mark;

	list_parts(ctx, rest->nv, follows, part, l);
	l->anchor = MR_NEW(ctx, l->parts * MR_ANCHORS, uint32_t);
	mark = mr_mark_take(ctx);
	lead = MR_NEW(ctx, rest->nv, uint32_t);
	at = MR_NEW(ctx, rest->nv, mr_v3);
	middle = MR_NEW(ctx, l->parts, mr_v3);
	for (uint32_t v = 0; v < rest->nv; v++)
		if (leads[v]) {
			at[leading] = rest->p[v];
			lead[leading++] = v;
		}
	for (size_t k = 0; k < l->parts; k++) {
		mr_box box = mr_box_empty();
		for (size_t i = l->start[k]; i < l->start[k + 1]; i++)
			mr_box_add(&box, rest->p[l->vertex[i]]);
		middle[k] = mr_lerp(0.5, box.min, box.max);
	}
	if (l->parts > 0)
		MR_TRY(mr_near_once(ctx, at, leading, middle, l->parts, MR_ANCHORS, l->anchor, NULL));
	for (size_t i = 0; i < l->parts * MR_ANCHORS; i++)
		if (l->anchor[i] != MR_NONE)
			l->anchor[i] = lead[l->anchor[i]];
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* The anchors of a part, all alike. */
typedef struct anchors {
	size_t n;
	const uint32_t *vertex;
	mr_v3 center; /* of them, at p0 */
} anchors;

static mr_v3
mean_of(const anchors *a, const mr_v3 *p)
{
	mr_v3 sum = mr_vec(0, 0, 0);

	for (size_t k = 0; k < a->n; k++)
		sum = mr_axpy(1 / (double)a->n, p[a->vertex[k]], sum);
	return sum;
}

static anchors
anchors_of(const mr_loose *l, size_t part, const mr_v3 *p0)
{
	anchors a = { .vertex = l->anchor + part * MR_ANCHORS };

	while (a.n < MR_ANCHORS && a.vertex[a.n] != MR_NONE)
		a.n++;
	a.center = mean_of(&a, p0);
	return a;
}

/* Whether the anchors all go the same way, bit for bit, and which. */
static bool
shifted(const anchors *a, const mr_v3 *p0, const mr_v3 *p, mr_v3 *by)
{
	*by = mr_sub(p[a->vertex[0]], p0[a->vertex[0]]);
	for (size_t k = 1; k < a->n; k++) {
		mr_v3 u = mr_sub(p[a->vertex[k]], p0[a->vertex[k]]);
		if (u.x != by->x || u.y != by->y || u.z != by->z)
			return false;
	}
	return true;
}

/* The rotation that takes the anchors from p0 to p; about an axis that they do not tell, none. */
static mr_mat3
rotation_of(const anchors *a, const mr_v3 *p0, const mr_v3 *p, mr_v3 center)
{
	const double least = 1e-12;
	mr_mat3 c = { { 0 } };
	double spread = 0;

	for (size_t k = 0; k < a->n; k++) {
		mr_v3 x = mr_sub(p0[a->vertex[k]], a->center), y = mr_sub(p[a->vertex[k]], center);
		double from[3] = { x.x, x.y, x.z }, to[3] = { y.x, y.y, y.z };
		spread += mr_norm2(x);
		for (int i = 0; i < 9; i++)
			c.m[i] += to[i / 3] * from[i % 3];
	}
	for (int i = 0; i < 3; i++)
		c.m[4 * i] += least * spread;
	return mr_rotation_nearest(&c);
}

void
mr_loose_follow(const mr_loose *l, const mr_v3 *p0, mr_v3 *p)
{
	for (size_t k = 0; k < l->parts; k++) {
		anchors a = anchors_of(l, k, p0);
		mr_v3 by, center = mean_of(&a, p);
		bool shift = shifted(&a, p0, p, &by);
		mr_mat3 r = shift ? mr_mat3_identity() : rotation_of(&a, p0, p, center);
		for (size_t i = l->start[k]; i < l->start[k + 1]; i++) {
			uint32_t v = l->vertex[i];
			if (!shift)
				p[v] = mr_add(center, mr_mat3_apply(&r, mr_sub(p0[v], a.center)));
			else if (mr_norm2(by) > 0)
				p[v] = mr_add(p0[v], by);
		}
	}
}

/* A row of 4 values a handle, (x, y, z, 1) times how much it moves: what (x, y, z) is at the follower is
 * known. */
static void
respond(const anchors *a, size_t handles, mr_v3 off, const double *response, double *row)
{
	for (size_t h = 0; h < handles; h++, row += 4) {
		for (size_t k = 0; k < a->n; k++)
			for (size_t c = 0; c < 4; c++)
				row[c] += response[4 * (handles * a->vertex[k] + h) + c] / (double)a->n;
		row[0] += row[3] * off.x;
		row[1] += row[3] * off.y;
		row[2] += row[3] * off.z;
	}
}

void
mr_loose_respond(const mr_loose *l, size_t handles, const mr_v3 *p0, double *response)
{
	for (size_t k = 0; k < l->parts; k++) {
		anchors a = anchors_of(l, k, p0);
		for (size_t i = l->start[k]; i < l->start[k + 1]; i++) {
			uint32_t v = l->vertex[i];
			respond(&a, handles, mr_sub(p0[v], a.center), response, response + 4 * handles * v);
		}
	}
}
