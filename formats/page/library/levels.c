/* The levels of a displaced subdivision surface, for the page: each is made when it is asked for. */
#include "formats/page/library/export.h"
#include "subdivide/displaced.h"

typedef struct levels {
	mr_ctx ctx;
	mr_mesh control;
	size_t made; /* the finest so far */
	mr_loop level[MR_LEVEL_MAX + 1];
} levels;

/* NULL where there is no memory.  p, t, crease (or NULL): malloc's, and from now on its own. */
MR_EXPORT(levels_new)
levels *
levels_new(const mr_v3 *p, size_t nv, const mr_tri *t, size_t nf, const uint8_t *crease)
{
	levels *l = calloc(1, sizeof *l);

	if (!l)
		return NULL;
	mr_ctx_init(&l->ctx, 1);
	l->control = (mr_mesh){ "control", p, t, nv, nf };
	return mr_loop_control(&l->ctx, &l->control, 180, crease, &l->level[0]) == MR_OK ? l : NULL;
}

/* Level n, of which the triangles are; NULL where there is no memory. */
MR_EXPORT(levels_triangles)
const mr_tri *
levels_triangles(levels *l, size_t n)
{
	for (; l->made < n; l->made++)
		if (mr_loop_refine(&l->ctx, &l->level[l->made], &l->level[l->made + 1]) != MR_OK)
			return NULL;
	return l->level[n].t;
}

/* The surface on level n, which is made, over the control mesh at p, with these heights. */
MR_EXPORT(levels_displaced)
void
levels_displaced(levels *l, size_t n, const mr_v3 *p, const double *height, mr_v3 *out)
{
	MR_SCOPE(&l->ctx);
	mr_mesh control = l->control;
	mr_domain domain;

	control.p = p;
	mr_domain_on(&l->ctx, &control, l->level, n, &domain);
	mr_domain_displace(&l->ctx, &domain, height, 1, out);
}
