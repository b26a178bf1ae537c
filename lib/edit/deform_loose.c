/* Anchors of parts that follow, and the rigid motions that fit theirs. */
#include "edit/deform_loose.h"

#include "base/parallel.h"
#include "base/rotation.h"
#include "space/near.h"

enum { NEAREST = 16 }; /* to a vertex: enough to tell a rotation */

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

/* The anchors of part k: those nearest to some of its vertices, one that is nearest to several as often. */
static void
choose_anchors(const mr_mesh *rest, const uint32_t *nearest, const uint32_t *lead, size_t k, mr_loose *l)
{
	size_t begin = l->start[k], n = l->start[k + 1] - begin, asked = n < MR_ANCHORS ? n : MR_ANCHORS,
	       at = 0;
	size_t each = MR_ANCHORS / asked < NEAREST ? MR_ANCHORS / asked : NEAREST;
	uint32_t *anchor = l->anchor + k * MR_ANCHORS;
	mr_box box = mr_box_empty();
	double size;

	for (size_t i = 0; i < n; i++)
		mr_box_add(&box, rest->p[l->vertex[begin + i]]);
	for (size_t i = 0; i < asked; i++)
		for (size_t j = 0; j < each; j++) {
			uint32_t near = nearest[NEAREST * (begin + i * n / asked) + j];
			if (near != MR_NONE)
				anchor[at++] = lead[near];
		}
	while (at < MR_ANCHORS)
		anchor[at++] = MR_NONE;
	/* With 4 of 55,659 edges of followers in 6 edits 19 are stretched by over 1.2, with 2 207, with 1
	 * 2,453; one motion a part stretches none, but what hangs along a limb does not bend with it. */
	size = 4 * mr_box_diagonal(box);
	l->softness[k] = size * size;
}

mr_status
mr_loose_make(mr_ctx *ctx, const mr_mesh *rest, const bool *leads, const bool *follows, const uint32_t *part,
    mr_loose *l)
{
	uint32_t *lead, *nearest;
	size_t leading = 0;
	mr_v3 *at, *q;
	mr_mark mark;

	list_parts(ctx, rest->nv, follows, part, l);
	l->anchor = MR_NEW(ctx, l->parts * MR_ANCHORS, uint32_t);
	l->softness = MR_NEW(ctx, l->parts, double);
	mark = mr_mark_take(ctx);
	lead = MR_NEW(ctx, rest->nv, uint32_t);
	nearest = MR_NEW(ctx, NEAREST * l->n, uint32_t);
	at = MR_NEW(ctx, rest->nv, mr_v3);
	q = MR_NEW(ctx, l->n, mr_v3);
	for (uint32_t v = 0; v < rest->nv; v++)
		if (leads[v]) {
			at[leading] = rest->p[v];
			lead[leading++] = v;
		}
	for (size_t i = 0; i < l->n; i++)
		q[i] = rest->p[l->vertex[i]];
	if (l->n > 0)
		MR_TRY(mr_near_once(ctx, at, leading, q, l->n, NEAREST, nearest, NULL));
	for (size_t k = 0; k < l->parts; k++)
		choose_anchors(rest, nearest, lead, k, l);
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* The anchors of a follower, by weight. */
typedef struct anchors {
	size_t n;
	const uint32_t *vertex;
	double weight[MR_ANCHORS]; /* sum to 1 */
	mr_v3 center;              /* of them, at p0 */
} anchors;

/* The nearer the more. */
static anchors
weigh(const mr_loose *l, size_t part, mr_v3 x, const mr_v3 *p0)
{
	anchors a = { .vertex = l->anchor + part * MR_ANCHORS };
	double sum = 0;

	while (a.n < MR_ANCHORS && a.vertex[a.n] != MR_NONE) {
		double soft = mr_norm2(mr_sub(p0[a.vertex[a.n]], x)) + l->softness[part];
		a.weight[a.n] = soft > 0 ? 1 / (soft * soft) : 1;
		sum += a.weight[a.n++];
	}
	for (size_t k = 0; k < a.n; k++) {
		a.weight[k] /= sum;
		a.center = mr_axpy(a.weight[k], p0[a.vertex[k]], a.center);
	}
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
		spread += a->weight[k] * mr_norm2(x);
		for (int i = 0; i < 9; i++)
			c.m[i] += a->weight[k] * to[i / 3] * from[i % 3];
	}
	for (int i = 0; i < 3; i++)
		c.m[4 * i] += least * spread;
	return mr_rotation_nearest(&c);
}

static mr_v3
followed(const anchors *a, const mr_v3 *p0, const mr_v3 *p, mr_v3 x)
{
	mr_v3 center = { 0, 0, 0 }, by;
	mr_mat3 r;

	if (shifted(a, p0, p, &by))
		return mr_norm2(by) > 0 ? mr_add(x, by) : x;
	for (size_t k = 0; k < a->n; k++)
		center = mr_axpy(a->weight[k], p[a->vertex[k]], center);
	r = rotation_of(a, p0, p, center);
	return mr_add(center, mr_mat3_apply(&r, mr_sub(x, a->center)));
}

typedef struct follow_job {
	const mr_loose *l;
	const mr_v3 *p0;
	mr_v3 *p;
} follow_job;

static void
follow_parts(void *arg, size_t begin, size_t end)
{
	follow_job *j = arg;

	for (size_t k = begin; k < end; k++)
		for (size_t i = j->l->start[k]; i < j->l->start[k + 1]; i++) {
			uint32_t v = j->l->vertex[i];
			anchors a = weigh(j->l, k, j->p0[v], j->p0);
			j->p[v] = followed(&a, j->p0, j->p, j->p0[v]);
		}
}

void
mr_loose_follow(const mr_ctx *ctx, const mr_loose *l, const mr_v3 *p0, mr_v3 *p)
{
	mr_parallel(ctx, l->parts, 1, follow_parts, &(follow_job){ l, p0, p });
}

/* A row of 4 values a handle, (x, y, z, 1) times how much it moves: what (x, y, z) is at the follower is
 * known. */
static void
respond(const anchors *a, size_t handles, mr_v3 off, const double *response, double *row)
{
	for (size_t h = 0; h < handles; h++, row += 4) {
		for (size_t k = 0; k < a->n; k++)
			for (size_t c = 0; c < 4; c++)
				row[c] += a->weight[k] * response[4 * (handles * a->vertex[k] + h) + c];
		row[0] += row[3] * off.x;
		row[1] += row[3] * off.y;
		row[2] += row[3] * off.z;
	}
}

void
mr_loose_respond(const mr_loose *l, size_t handles, const mr_v3 *p0, double *response)
{
	for (size_t k = 0; k < l->parts; k++)
		for (size_t i = l->start[k]; i < l->start[k + 1]; i++) {
			uint32_t v = l->vertex[i];
			anchors a = weigh(l, k, p0[v], p0);
			respond(&a, handles, mr_sub(p0[v], a.center), response, response + 4 * handles * v);
		}
}
