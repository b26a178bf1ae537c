/* A surface as the page shows it: with what normals, what a ray meets, discs over it. */
#include "formats/page/library/export.h"
#include "mesh/creases.h"
#include "space/bvh.h"
#include "space/geodesic.h"

typedef struct surface {
	/* For the page to read: what was found last; of each corner the place and the normal */
	uint32_t *found;
	float (*place)[3], (*normal)[3];
	mr_ctx ctx, tree, list; /* of what stands; of the tree; of what was found last */
	mr_mesh m;
	mr_v3 *p;
	mr_incidence around;
	mr_bvh *bvh; /* NULL: not made yet */
	double *distance;
} surface;

/* The vertices are at p, three floats each. */
MR_EXPORT(surface_move)
void
surface_move(surface *s, const float (*p)[3])
{
	for (size_t v = 0; v < s->m.nv; v++)
		s->p[v] = mr_vec(p[v][0], p[v][1], p[v][2]);
	mr_ctx_free(&s->tree);
	mr_ctx_init(&s->tree, 1);
	s->bvh = NULL;
}

static void
begin(surface *s)
{
	s->p = MR_NEW(&s->ctx, s->m.nv, mr_v3);
	s->place = mr_alloc(&s->ctx, 3 * s->m.nf, sizeof *s->place);
	s->normal = mr_alloc(&s->ctx, 3 * s->m.nf, sizeof *s->normal);
	s->distance = MR_NEW(&s->ctx, s->m.nv, double);
	s->m.p = s->p;
	mr_incidence_build(&s->ctx, &s->m, &s->around);
}

MR_EXPORT(surface_free)
void
surface_free(surface *s)
{
	mr_ctx_free(&s->ctx);
	mr_ctx_free(&s->tree);
	mr_ctx_free(&s->list);
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
	mr_ctx_init(&s->list, 1);
	s->m = (mr_mesh){ "surface", NULL, t, nv, nf };
	begin(s);
	return s;
}

/* Makes the tree, where it is not there. */
MR_EXPORT(surface_ready)
bool
surface_ready(surface *s)
{
	if (!s->bvh)
		mr_bvh_build(&s->tree, &s->m, &s->bvh);
	return true;
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

/* Room for a list of what is found. */
static void
make_list(surface *s, size_t n)
{
	mr_ctx_free(&s->list);
	mr_ctx_init(&s->list, 1);
	s->found = MR_NEW(&s->list, n, uint32_t);
}

/* The vertices no farther over the surface than that from a place on a face: how many; `found` has them. */
MR_EXPORT(surface_disc)
size_t
surface_disc(surface *s, uint32_t face, const mr_v3 *place, double radius)
{
	size_t n = 0;

	mr_geodesic_from(&s->list, &s->m, &s->around, face, *place, radius, s->distance);
	make_list(s, s->m.nv);
	for (uint32_t v = 0; v < s->m.nv; v++)
		if (s->distance[v] <= radius)
			s->found[n++] = v;
	return n;
}

/* The corners that n vertices are of faces: how many; `found` has them. */
MR_EXPORT(surface_corners_of)
size_t
surface_corners_of(surface *s, const uint32_t *vertex, size_t n)
{
	const size_t *start = s->around.start;
	size_t corners = 0;

	for (size_t i = 0; i < n; i++)
		corners += start[vertex[i] + 1] - start[vertex[i]];
	make_list(s, corners);
	corners = 0;
	for (size_t i = 0; i < n; i++)
		for (size_t j = start[vertex[i]]; j < start[vertex[i] + 1]; j++)
			for (uint32_t k = 3 * s->around.face[j]; k < 3 * s->around.face[j] + 3; k++)
				if (s->m.t[k / 3].v[k % 3] == vertex[i])
					s->found[corners++] = k;
	return corners;
}

/* Places and normals of all corners, as they are now. */
MR_EXPORT(surface_corners)
void
surface_corners(surface *s)
{
	mr_creases creases;

	make_list(s, 0);
	mr_creases_find(&s->list, &s->m, &s->around, &creases);
	for (size_t k = 0; k < 3 * s->m.nf; k++) {
		mr_v3 p = s->p[s->m.t[k / 3].v[k % 3]], n = mr_corner_normal(&creases, k / 3, (int)(k % 3));
		s->place[k][0] = (float)p.x, s->place[k][1] = (float)p.y, s->place[k][2] = (float)p.z;
		s->normal[k][0] = (float)n.x, s->normal[k][1] = (float)n.y, s->normal[k][2] = (float)n.z;
	}
}
