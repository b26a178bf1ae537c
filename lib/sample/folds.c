/* Where a displaced surface breaks: faces that turn over, sharp folds, faces that pass through others. */
#include "base/parallel.h"
#include "mesh/fold.h"
#include "sample/parts.h"

enum { GRAIN = 512 };

typedef struct folds {
	const mr_mesh *surface, *domain;
	const mr_topology *topo;
	bool *bad; /* each face */
} folds;

static bool
beyond(mr_v3 a, mr_v3 b, double cosine)
{
	return !(mr_dot(a, b) > cosine * mr_norm(a) * mr_norm(b));
}

/* True where the face has turned from the domain's, or is folded against one beside it. */
static bool
is_folded(const folds *x, uint32_t f)
{
	static const double turned = 0.1;
	mr_v3 n = mr_face_cross(x->surface, f);

	if (beyond(n, mr_face_cross(x->domain, f), turned))
		return true;
	for (uint32_t h = 3 * f; h < 3 * f + 3; h++) {
		uint32_t g = x->topo->twin[h];
		if (g != MR_NONE && mr_folds(n, mr_face_cross(x->surface, g / 3), MR_FOLD))
			return true;
	}
	return false;
}

static void
look(void *arg, size_t begin, size_t end)
{
	const folds *x = arg;

	for (size_t f = begin; f < end; f++)
		x->bad[f] |= is_folded(x, (uint32_t)f);
}

size_t
mr_find_folds(mr_ctx *ctx, const mr_mesh *surface, const mr_domain *d, const bool *crosses, bool *bad)
{
	size_t count = 0;
	folds x = { .surface = surface, .domain = &d->m, .topo = &d->level[d->n].topo, .bad = bad };

	if (crosses)
		memcpy(bad, crosses, surface->nf * sizeof *bad);
	else
		memset(bad, 0, surface->nf * sizeof *bad);
	mr_parallel(ctx, surface->nf, GRAIN, look, &x);
	for (size_t f = 0; f < surface->nf; f++)
		count += bad[f];
	return count;
}
