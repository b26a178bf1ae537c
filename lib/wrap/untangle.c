/* Moves that let a wrap pass through itself are taken back. */
#include "wrap/parts.h"
#include "space/self_intersect.h"

/* Halves of the way home before all of it; each round goes a ring further. */
enum { HALVES = 4, MOST = 12 };

static mr_status
find_crossings(mr_ctx *ctx, const mr_dyn *d, bool *crosses, size_t *count)
{
	mr_mark mark = mr_mark_take(ctx);
	mr_mesh m = mr_dyn_view(d, "control");
	mr_bvh *bvh;

	MR_TRY(mr_bvh_build(ctx, &m, &bvh));
	MR_TRY(mr_self_intersections(ctx, bvh, &m, crosses, count));
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* The vertices of marked faces, and then the faces of marked vertices. */
static void
grow(const mr_dyn *d, bool *face, bool *vertex)
{
	for (size_t h = 0; h < 3 * d->nf; h++)
		vertex[d->v[h]] |= face[h / 3];
	for (size_t h = 0; h < 3 * d->nf; h++)
		face[h / 3] |= vertex[d->v[h]];
}

mr_status
mr_wrap_part(mr_ctx *ctx, const mr_v3 *home, mr_dyn *d)
{
	mr_mark mark = mr_mark_take(ctx);
	bool *face = MR_NEW(ctx, d->nf, bool), *vertex = MR_NEW(ctx, d->nv, bool);
	size_t count;

	if (!face || !vertex)
		return MR_EMEM;
	for (int round = 0; round < MOST; round++) {
		MR_TRY(find_crossings(ctx, d, face, &count));
		if (count == 0)
			break;
		memset(vertex, 0, d->nv * sizeof *vertex);
		for (int ring = 0; ring <= round; ring++)
			grow(d, face, vertex);
		for (size_t v = 0; v < d->nv; v++)
			if (vertex[v])
				d->p[v] = round < HALVES ? mr_lerp(0.5, d->p[v], home[v]) : home[v];
	}
	mr_mark_release(ctx, mark);
	return MR_OK;
}
