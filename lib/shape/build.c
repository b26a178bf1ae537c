/* Vertices and faces added one by one, and vertices joined by a key. */
#include "shape/parts.h"

#include "base/random.h"

mr_status
mr_solid_begin(mr_ctx *ctx, size_t nv, size_t nf, mr_solid_build *b)
{
	mr_solid_build r = { .nv = 0 };

	if (nv >= MR_NONE || nf > (MR_NONE - 1) / 3)
		return mr_fail(ctx, MR_ERANGE, "%zu vertices and %zu faces are too many", nv, nf);
	r.p = MR_NEW(ctx, nv, mr_v3);
	r.t = MR_NEW(ctx, nf, mr_tri);
	*b = r;
	return MR_OK;
}

uint32_t
mr_solid_add_vertex(mr_solid_build *b, mr_v3 p)
{
	b->p[b->nv] = p;
	return (uint32_t)b->nv++;
}

void
mr_solid_add_face(mr_solid_build *b, uint32_t i, uint32_t j, uint32_t k)
{
	b->t[b->nf++] = (mr_tri){ { i, j, k } };
}

void
mr_solid_add_quad(mr_solid_build *b, uint32_t i, uint32_t j, uint32_t k, uint32_t l)
{
	mr_solid_add_face(b, i, j, k);
	mr_solid_add_face(b, i, k, l);
}

void
mr_weld_begin(mr_ctx *ctx, size_t nv, mr_solid_weld *w)
{
	mr_solid_weld r = { .mask = 15 };

	while (r.mask < 2 * nv)
		r.mask = 2 * r.mask + 1;
	r.key = MR_NEW_ZERO(ctx, r.mask + 1, uint64_t);
	r.vertex = MR_NEW(ctx, r.mask + 1, uint32_t);
	*w = r;
}

uint32_t *
mr_weld_slot(mr_solid_weld *w, uint64_t key, bool *is_new)
{
	mr_random hash = { key };
	size_t i = (size_t)mr_random_bits(&hash) & w->mask;

	while (w->key[i] && w->key[i] != key + 1)
		i = (i + 1) & w->mask;
	*is_new = w->key[i] == 0;
	w->key[i] = key + 1;
	return &w->vertex[i];
}
