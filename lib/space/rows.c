/* The nearest point across the direction to others that are near: where points lie alike in all directions it
 * is as near as these. */
#include "space/rows.h"

#include "base/sort.h"

/* Rows up to half so many times as far apart as their points are told. */
enum { NEAREST = 256, LOOKS = 128 };

/* In a row it is the second on one side; the first may be of a pair that is nearly one point. */
enum { NEXT = 4 };

/* How far the nearest of k points at q is that is more across d than along it; of none, the farthest. */
static double
nearest_across(const mr_v3 *p, const uint32_t *index, size_t k, mr_v3 q, mr_v3 d)
{
	double far = 0;

	for (size_t j = 1; j < k && index[j] != UINT32_MAX; j++) {
		mr_v3 to = mr_sub(p[index[j]], q);
		double along = mr_dot(d, to);
		far = mr_norm(to);
		if (2 * along * along < far * far)
			break;
	}
	return far;
}

mr_status
mr_find_rows(mr_ctx *ctx, const mr_v3 *p, size_t n, const mr_near *near, mr_rows *found)
{
	mr_mark mark = mr_mark_take(ctx);
	size_t looks = n < LOOKS ? n : LOOKS, k = n < NEAREST ? n : NEAREST;
	mr_v3 *q = MR_NEW(ctx, looks, mr_v3);
	uint32_t *index = MR_NEW(ctx, looks * k, uint32_t);
	double *along = MR_NEW(ctx, looks, double), *across = MR_NEW(ctx, looks, double);

	*found = (mr_rows){ 0 };
	if (n <= NEXT)
		return MR_OK;
	mr_at_strides(p, n, looks, q);
	MR_TRY(mr_near_query(ctx, near, q, looks, k, index, NULL));
	for (size_t i = 0; i < looks; i++) {
		const uint32_t *nearest = index + i * k; /* the first is the point itself */
		mr_v3 to = mr_sub(p[nearest[NEXT]], q[i]);
		along[i] = mr_norm(to) / (NEXT / 2);
		across[i] = nearest_across(p, nearest, k, q[i], mr_unit(to));
	}
	found->along = mr_kth(along, looks, looks / 2);
	found->across = mr_kth(across, looks, looks / 2);
	mr_mark_release(ctx, mark);
	return MR_OK;
}
