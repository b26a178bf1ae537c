/* Normals of vertices, and, where a face is far from its vertex's, of the faces there that are near to it. */
#include "mesh/creases.h"

#include "base/parallel.h"

static const double CREASE = 0.70710678118654752,
		    HALF = 0.92387953251128674; /* cosines of 45 and 22.5 degrees */

static void
vertex_normals(void *arg, size_t begin, size_t end)
{
	const mr_creases *c = arg;

	for (size_t i = begin; i < end; i++) {
		size_t first = c->around->start[i], last = c->around->start[i + 1];
		mr_v3 sum = mr_vec(0, 0, 0);
		bool creased = false;
		for (size_t k = first; k < last; k++)
			sum = mr_add(sum, mr_face_cross(c->m, c->around->face[k]));
		sum = mr_unit(sum);
		for (size_t k = first; k < last && !creased; k++) {
			mr_v3 n = mr_face_cross(c->m, c->around->face[k]);
			creased = mr_dot(n, sum) < HALF * mr_norm(n);
		}
		c->normal[i] = sum;
		c->creased[i] = creased;
	}
}

void
mr_creases_find(mr_ctx *ctx, const mr_mesh *m, const mr_incidence *around, mr_creases *c)
{
	*c = (mr_creases){ m, around, MR_NEW(ctx, m->nv, mr_v3), MR_NEW(ctx, m->nv, bool) };
	mr_parallel(ctx, m->nv, 1024, vertex_normals, c);
}

mr_v3
mr_corner_normal_posed(const mr_creases *c, const mr_v3 *p, size_t face, int corner)
{
	const mr_mesh posed = { .p = p, .t = c->m->t };
	uint32_t v = c->m->t[face].v[corner];
	mr_v3 own = mr_unit(mr_face_cross(c->m, face)), sum = mr_vec(0, 0, 0);

	for (size_t k = c->around->start[v]; k < c->around->start[v + 1]; k++) {
		mr_v3 n = mr_face_cross(c->m, c->around->face[k]);
		if (!c->creased[v] || mr_dot(n, own) >= CREASE * mr_norm(n))
			sum = mr_add(sum, mr_face_cross(&posed, c->around->face[k]));
	}
	return sum;
}

mr_v3
mr_corner_normal(const mr_creases *c, size_t face, int corner)
{
	uint32_t v = c->m->t[face].v[corner];

	return c->creased[v] ? mr_unit(mr_corner_normal_posed(c, c->m->p, face, corner)) : c->normal[v];
}
