/* Minimum degree within the parts of a dissection (Amestoy, Davis, Duff 1996: CAMD); in a browser the parts
 * alone. */
#include "solve/sparse.h"

#ifdef __wasm__
mr_status
mr_order(mr_ctx *ctx, const mr_sparse *a, const int *part, int *order)
{
	int *next = MR_NEW_ZERO(ctx, (size_t)a->n + 1, int);

	for (int i = 0; i < a->n; i++)
		next[part[i] + 1]++;
	for (int i = 0; i < a->n; i++)
		next[i + 1] += next[i];
	for (int i = 0; i < a->n; i++)
		order[next[part[i]]++] = i;
	return MR_OK;
}
#else
#include <camd.h>

mr_status
mr_order(mr_ctx *ctx, const mr_sparse *a, const int *part, int *order)
{
	double control[CAMD_CONTROL];

	camd_defaults(control);
	if (a->n > 0 && camd_order(a->n, a->start, a->index, order, control, NULL, part) < CAMD_OK)
		return mr_fail(ctx, MR_EMEM, "no memory to find an order of elimination");
	return MR_OK;
}
#endif
