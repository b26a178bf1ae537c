/* The curves of the result as triangles without area, in a tree. */
#include "remesh/feature_loss.h"

/* Of the target length, the uniform one at least: an edge that turns by 50 degrees is off its curve by 0.11.
 */
static const double FAR = 0.25;

static void
gather_curves(mr_ctx *ctx, const mr_dyn *d, mr_mesh *curves)
{
	mr_tri *t = MR_NEW(ctx, d->curves.count, mr_tri);
	size_t n = 0;

	for (uint32_t h = 0; h < 3 * d->nf; h++)
		if (!mr_dyn_face_dead(d, h / 3) && mr_dyn_on_curve(d, h))
			t[n++] = (mr_tri){ { d->v[h], mr_dyn_to(d, h), mr_dyn_to(d, h) } };
	*curves = (mr_mesh){ "curves", d->p, t, d->nv, n };
}

static bool
is_sharp(const mr_remesh_source *s, uint32_t h)
{
	return h < s->topo->twin[h] && s->topo->twin[h] != MR_NONE && mr_curves_get(s->curves, h) != MR_NONE;
}

static double
length_at(const mr_remesh_source *s, uint32_t v)
{
	return s->length ? s->length[v] : s->uniform;
}

void
mr_feature_loss(mr_ctx *ctx, const mr_dyn *d, const mr_remesh_source *s, size_t *edges, size_t *lost)
{
	mr_mark mark = mr_mark_take(ctx);
	mr_bvh *bvh;
	mr_mesh curves, view = mr_dyn_view(d, s->m->name);
	double most; /* where so few are wanted that the target length says nothing */

	*edges = *lost = 0;
	if (s->curves->count == 0)
		return;
	most = 2 * mr_mesh_edge_scale(ctx, &view);
	gather_curves(ctx, d, &curves);
	mr_bvh_build(ctx, &curves, &bvh);
	for (uint32_t h = 0; h < 3 * s->m->nf; h++)
		if (is_sharp(s, h)) {
			uint32_t a = mr_he_from(s->m, h), b = mr_he_to(s->m, h);
			double far = FAR *
			             fmin(most, fmax(s->uniform, fmin(length_at(s, a), length_at(s, b))));
			mr_closest c = mr_bvh_closest(bvh, mr_lerp(0.5, s->m->p[a], s->m->p[b]));
			*lost += c.dist2 > far * far;
			++*edges;
		}
	mr_mark_release(ctx, mark);
}
