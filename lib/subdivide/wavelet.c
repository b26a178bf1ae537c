/* Lounsbery, DeRose, Warren 1997: Multiresolution analysis for surfaces of arbitrary topological type;
 * Sweldens 1996: The lifting scheme, of which this is the prediction alone. */
#include "subdivide/wavelet.h"

/* Adds the prediction, or takes it off, on level `fine`, whose coarser ones have their heights. */
static void
step(const mr_ctx *ctx, const mr_loop *fine, double sign, double *x, double *work)
{
	const mr_loop *coarse = fine - 1;

	mr_loop_predict(ctx, coarse, fine, 1, x, work);
	for (size_t i = coarse->nv; i < fine->nv; i++)
		x[i] += sign * work[i - coarse->nv];
}

void
mr_wavelet_analyse(mr_ctx *ctx, const mr_loop *level, size_t n, double *x)
{
	MR_SCOPE(ctx);
	double *work = MR_NEW(
	    ctx, level[n].nv - level[n].coarse_nv, double); /* of the level that has the most */

	for (size_t i = n; i > 0; i--)
		step(ctx, &level[i], -1, x, work);
}

void
mr_wavelet_synthesize(mr_ctx *ctx, const mr_loop *level, size_t n, double *x)
{
	MR_SCOPE(ctx);
	double *work = MR_NEW(ctx, level[n].nv - level[n].coarse_nv, double);

	for (size_t i = 1; i <= n; i++)
		step(ctx, &level[i], 1, x, work);
}

mr_status
mr_equalize(mr_ctx *ctx, const mr_loop *level, size_t n, const double *gain, double *x)
{
	mr_wavelet_analyse(ctx, level, n, x);
	for (size_t i = 0; i <= n; i++)
		for (size_t v = i ? level[i].coarse_nv : 0; v < level[i].nv; v++)
			x[v] *= gain[i];
	mr_wavelet_synthesize(ctx, level, n, x);
	for (size_t v = 0; v < level[n].nv; v++)
		if (!isfinite(x[v]))
			return mr_fail(
			    ctx, MR_ERANGE, "height %zu is no longer finite: the gains are too large", v);
	return MR_OK;
}
