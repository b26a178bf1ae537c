/* A surface as the page shows it: what a ray meets, what the eye sees, discs over it, its folded edges. */
#include "formats/page/library/export.h"
#include "mesh/edges.h"
#include "mesh/fold.h"
#include "space/bvh.h"
#include "space/geodesic.h"

typedef struct surface {
	mr_ctx ctx, tree, keep; /* of what stands; of the tree, as long as nothing moves; of the edges */
	mr_mesh m;
	mr_v3 *p;
	mr_incidence around;
	mr_bvh *bvh;    /* NULL: not made yet */
	mr_edges edges; /* of no count: not made yet */
	double *distance;
	uint32_t *found;
} surface;

/* The vertices are at p, three floats each. */
MR_EXPORT(surface_move)
void
surface_move(surface *s, const float (*p)[3])
{
	for (size_t v = 0; v < s->m.nv; v++)
		s->p[v] = mr_vec(p[v][0], p[v][1], p[v][2]);
	mr_ctx_free(&s->tree);
	s->bvh = NULL;
}

static mr_status
begin(surface *s)
{
	s->p = MR_NEW(&s->ctx, s->m.nv, mr_v3);
	s->distance = MR_NEW(&s->ctx, s->m.nv, double);
	s->found = MR_NEW(&s->ctx, s->m.nv + 6 * s->m.nf, uint32_t);
	s->m.p = s->p;
	return s->p && s->distance && s->found ? mr_incidence_build(&s->ctx, &s->m, &s->around) : MR_EMEM;
}

MR_EXPORT(surface_free)
void
surface_free(surface *s)
{
	mr_ctx_free(&s->ctx);
	mr_ctx_free(&s->tree);
	mr_ctx_free(&s->keep);
	free((void *)(uintptr_t)s->m.t);
	free(s);
}

/* NULL where there is no memory.  t: malloc's, and from now on its own. */
MR_EXPORT(surface_new)
surface *
surface_new(size_t nv, const mr_tri *t, size_t nf)
{
	surface *s = calloc(1, sizeof *s);

	if (!s)
		return NULL;
	mr_ctx_init(&s->ctx, 1);
	mr_ctx_init(&s->tree, 1);
	mr_ctx_init(&s->keep, 1);
	s->m = (mr_mesh){ "surface", NULL, t, nv, nf };
	if (begin(s) == MR_OK)
		return s;
	surface_free(s);
	return NULL;
}

/* Makes the tree, where it is not there. */
MR_EXPORT(surface_ready)
bool
surface_ready(surface *s)
{
	return s->bvh || mr_bvh_build(&s->tree, &s->m, &s->bvh) == MR_OK;
}

/* The face that a ray meets first, and where: ray[0] + t ray[1] in ray[0]; MR_NONE.  With its tree. */
MR_EXPORT(surface_hit)
uint32_t
surface_hit(const surface *s, mr_v3 ray[2])
{
	mr_ray_hit hit;

	if (!mr_bvh_ray(s->bvh, ray[0], ray[1], 0, INFINITY, &hit))
		return MR_NONE;
	ray[0] = mr_axpy(hit.t, ray[1], ray[0]);
	return hit.at.face;
}

/* Keeps those of n vertices before which, from `near` before the eye on, no face is; how many they are.  With
 * its tree. */
MR_EXPORT(surface_seen)
size_t
surface_seen(const surface *s, const mr_v3 *eye, double near, uint32_t *vertex, size_t n)
{
	const double close = 1e-6;
	size_t kept = 0;

	for (size_t i = 0; i < n; i++) {
		mr_v3 way = mr_sub(s->p[vertex[i]], *eye);
		mr_ray_hit hit;
		if (!mr_bvh_ray(s->bvh, *eye, way, near / mr_norm(way), 1 - close, &hit))
			vertex[kept++] = vertex[i];
	}
	return kept;
}

/* The vertices no farther over the surface than that from a place on a face: how many; surface_found has
 * them. */
MR_EXPORT(surface_disc)
size_t
surface_disc(surface *s, uint32_t face, const mr_v3 *place, double radius)
{
	mr_mark mark = mr_mark_take(&s->ctx);
	size_t n = 0;

	if (mr_geodesic_from(&s->ctx, &s->m, &s->around, face, *place, radius, s->distance) != MR_OK)
		return 0;
	mr_mark_release(&s->ctx, mark);
	for (uint32_t v = 0; v < s->m.nv; v++)
		if (s->distance[v] <= radius)
			s->found[n++] = v;
	return n;
}

/* How many edges between two faces are folded; surface_found has the two ends of each. */
MR_EXPORT(surface_folds)
size_t
surface_folds(surface *s)
{
	const mr_mesh *m = &s->m;
	size_t n = 0;

	if (!s->edges.count && mr_edges_build(&s->keep, m, &s->edges) != MR_OK)
		return 0;
	for (size_t e = 0; e < s->edges.count; e++) {
		const uint32_t *h = s->edges.he + s->edges.start[e];
		if (mr_edge_faces(&s->edges, e) != 2)
			continue;
		mr_v3 a = mr_face_cross(m, h[0] / 3), b = mr_face_cross(m, h[1] / 3);
		if (!mr_folds(a, mr_same_direction(m, h[0], h[1]) ? mr_mul(-1, b) : b, MR_FOLD))
			continue;
		s->found[n++] = mr_he_from(m, h[0]);
		s->found[n++] = mr_he_to(m, h[0]);
	}
	return n / 2;
}

MR_EXPORT(surface_found)
const uint32_t *
surface_found(const surface *s)
{
	return s->found;
}
