/* Where a displaced surface breaks: faces that turn over, sharp folds, faces that pass through others. */
#include "alg/sample_parts.h"
#include "base/parallel.h"
#include "mesh/intersect.h"

enum { GRAIN = 512 };

typedef struct folds {
	const mr_mesh *surface, *domain;
	const mr_topology *topo;
	const mr_bvh *bvh; /* of the surface; NULL: crossings are not looked for */
	bool *bad;         /* each face */
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
	static const double turned = 0.1, folded = -0.97;
	mr_v3 n = mr_face_cross(x->surface, f);

	if (beyond(n, mr_face_cross(x->domain, f), turned))
		return true;
	for (uint32_t h = 3 * f; h < 3 * f + 3; h++) {
		uint32_t g = x->topo->twin[h];
		if (g != MR_NONE && beyond(n, mr_face_cross(x->surface, g / 3), folded))
			return true;
	}
	return false;
}

static void
corners(const mr_mesh *m, uint32_t f, mr_v3 p[3])
{
	for (int k = 0; k < 3; k++)
		p[k] = m->p[m->t[f].v[k]];
}

typedef struct crossing {
	const mr_mesh *m;
	uint32_t face;
	mr_v3 p[3];
} crossing;

/* False, which ends the search, where the faces cross. */
static bool
passes(void *arg, uint32_t face)
{
	const crossing *c = arg;
	mr_v3 q[3];

	if (face == c->face)
		return true;
	corners(c->m, face, q);
	return mr_triangle_degenerate(q[0], q[1], q[2]) || !mr_triangles_intersect(c->p, q);
}

static bool
is_crossed(const folds *x, uint32_t f)
{
	crossing c = { .m = x->surface, .face = f };

	corners(x->surface, f, c.p);
	if (mr_triangle_degenerate(c.p[0], c.p[1], c.p[2]))
		return false;
	return !mr_bvh_overlap(x->bvh, mr_box_of(c.p, 3), passes, &c);
}

static void
look(void *arg, size_t begin, size_t end)
{
	const folds *x = arg;

	for (size_t f = begin; f < end; f++)
		x->bad[f] = is_folded(x, (uint32_t)f) || (x->bvh && is_crossed(x, (uint32_t)f));
}

mr_status
mr_find_folds(
    mr_ctx *ctx, const mr_mesh *surface, const mr_domain *d, bool crossings, bool *bad, size_t *count)
{
	mr_mark mark = mr_mark_take(ctx);
	folds x = { .surface = surface, .domain = &d->m, .topo = &d->level[d->n].topo, .bad = bad };
	mr_bvh *bvh;

	if (crossings) {
		MR_TRY(mr_bvh_build(ctx, surface, &bvh));
		x.bvh = bvh;
	}
	mr_parallel(ctx, surface->nf, GRAIN, look, &x);
	*count = 0;
	for (size_t f = 0; f < surface->nf; f++)
		*count += bad[f];
	mr_mark_release(ctx, mark);
	return MR_OK;
}
