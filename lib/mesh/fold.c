/* Folds, counted and kept from. */
#include "mesh/fold.h"

#include "base/parallel.h"

typedef struct counting {
	const mr_mesh *m;
	const uint32_t *twin;
} counting;

/* The folds towards later faces. */
static double
folds_of_face(void *arg, size_t f)
{
	const counting *c = arg;
	mr_v3 n = mr_face_cross(c->m, f);
	int folds = 0;

	for (size_t h = 3 * f; h < 3 * f + 3; h++)
		if (c->twin[h] != MR_NONE && h < c->twin[h])
			folds += mr_folds(n, mr_face_cross(c->m, c->twin[h] / 3), MR_FOLD);
	return folds;
}

size_t
mr_count_folds(const mr_ctx *ctx, const mr_mesh *m, const uint32_t *twin)
{
	return (size_t)mr_parallel_sum(ctx, m->nf, folds_of_face, &(counting){ m, twin });
}

static double
cosine_between(const mr_mesh *m, uint32_t f, uint32_t g)
{
	return mr_dot(mr_unit(mr_face_cross(m, f)), mr_unit(mr_face_cross(m, g)));
}

bool
mr_folds_more(const mr_mesh *from, const mr_mesh *to, const uint32_t *twin, uint32_t f, double cosine)
{
	mr_v3 n = mr_face_cross(to, f);

	for (uint32_t h = 3 * f; h < 3 * f + 3; h++) {
		uint32_t g = twin[h] / 3;
		if (twin[h] != MR_NONE && mr_folds(n, mr_face_cross(to, g), cosine) &&
		    cosine_between(to, f, g) < cosine_between(from, f, g))
			return true;
	}
	return false;
}
