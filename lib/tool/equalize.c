/* mr-equalize: wavelet analysis of the heights, a gain for each level, synthesis. */
#include "base/options.h"
#include "subdivide/wavelet.h"
#include "tool/cache.h"

static mr_status
equalize(mr_ctx *ctx, mr_frame *f, const double *gain, size_t gains, mr_cache *cache)
{
	double all[MR_LEVEL_MAX + 1], *x;
	const mr_loop *level;
	const double *height;
	mr_mesh control;
	size_t n;

	MR_TRY(mr_layer_mesh(ctx, f, "control", &control));
	MR_TRY(mr_displacement_get(ctx, f, &control, &n, &height));
	if (gains > n + 1)
		return mr_fail(ctx, MR_ERANGE,
		    "%zu gains, but displacement has level %zu: %zu of them at most", gains, n, n + 1);
	for (size_t i = 0; i < gains; i++)
		MR_TRY(mr_check_number(ctx, "gain", gain[i], -1e6, 1e6));
	for (size_t i = 0; i <= n; i++)
		all[i] = i < gains ? gain[i] : 1;
	MR_TRY(mr_level_cache_get(&cache->level, ctx, f, &control, 180, n, &level));
	x = MR_NEW(ctx, level[n].nv, double);
	memcpy(x, height, level[n].nv * sizeof *x);
	MR_TRY(mr_equalize(ctx, level, n, all, x));
	mr_frame_drop(f, "displacement", "range", 0);
	MR_TRY(mr_layer_put(ctx, f, "displacement", "height", x, level[n].nv));
	return mr_layer_worked(ctx, f, "displacement");
}

mr_status
mr_equalize_frame(mr_ctx *ctx, mr_frame *f, const double *gain, size_t gains, mr_cache *cache)
{
	MR_ON_COPY(ctx, f, done, NULL, done, equalize(ctx, &done, gain, gains, mr_cache_for(ctx, cache)));
}
