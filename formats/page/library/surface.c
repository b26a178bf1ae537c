/* A surface as the page shows it: with what normals, what a ray meets, discs over it. */
#include "formats/page/library/export.h"
#include "space/bvh.h"
#include "space/geodesic.h"

typedef struct surface {
	/* For the page to read: what was found last; what is drawn: triangles of the vertices, and, behind
	 * them, of one for each corner at a crease; of which vertex each of these is; normals of all */
	uint32_t *found, *index, *source;
	float (*normal)[3];
	size_t n;               /* of those at creases, */
	uint32_t *end, *face;   /* and the faces that each is shaded with */
	mr_ctx ctx, tree, list; /* of what stands; of the tree; of what was found last */
	mr_mesh m;
	mr_v3 *p, *cross; /* of the vertices, and of the faces, as mr_face_cross has it */
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
	for (size_t f = 0; f < s->m.nf; f++)
		s->cross[f] = mr_face_cross(&s->m, f);
	mr_ctx_free(&s->tree);
	mr_ctx_init(&s->tree, 1);
	s->bvh = NULL;
}

static void
begin(surface *s)
{
	s->p = MR_NEW(&s->ctx, s->m.nv, mr_v3);
	s->cross = MR_NEW(&s->ctx, s->m.nf, mr_v3);
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

/* The vertices no farther over the surface than that from a place on a face: how many; `found` has
 * them. */
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

/* Faces farther apart are not shaded as one, as in mr-render; a vertex is asked whose normal is farther from
 * a face. */
static const double CREASE = 0.70710678118654752,
		    BENT = 0.90630778703664996; /* cosines of 45 and 25 degrees */

static mr_v3
sum_faces(const surface *s, const uint32_t *face, size_t n)
{
	mr_v3 sum = { 0, 0, 0 };

	for (size_t i = 0; i < n; i++)
		sum = mr_add(sum, s->cross[face[i]]);
	return mr_unit(sum);
}

static bool
within(const surface *s, mr_v3 normal, uint32_t f, double cosine)
{
	return mr_dot(normal, s->cross[f]) >= cosine * mr_norm(s->cross[f]);
}

/* Gives the corners of a vertex at a crease vertices of their own. */
static void
part_vertex(surface *s, uint32_t v, size_t *room, size_t *faces, size_t *face_room)
{
	const uint32_t *f = s->around.face + s->around.start[v];
	size_t n = s->around.start[v + 1] - s->around.start[v];

	for (size_t i = 0; i < n; i++) {
		size_t source_room = *room;
		mr_v3 own = mr_unit(s->cross[f[i]]);
		MR_RESERVE(&s->ctx, s->source, s->n, 1, &source_room);
		MR_RESERVE(&s->ctx, s->end, s->n, 1, room);
		MR_RESERVE(&s->ctx, s->face, *faces, n, face_room);
		for (size_t j = 0; j < n; j++)
			if (j == i || within(s, own, f[j], CREASE))
				s->face[(*faces)++] = f[j];
		for (int k = 0; k < 3; k++)
			if (s->m.t[f[i]].v[k] == v)
				s->index[3 * f[i] + (uint32_t)k] = (uint32_t)(s->m.nv + s->n);
		s->source[s->n] = v;
		s->end[s->n++] = (uint32_t)*faces;
	}
}

static void
part(surface *s)
{
	size_t room = 0, faces = 0, face_room = 0;

	s->index = MR_NEW(&s->ctx, 3 * s->m.nf, uint32_t);
	memcpy(s->index, s->m.t, 3 * s->m.nf * sizeof *s->index);
	for (uint32_t v = 0; v < s->m.nv; v++) {
		size_t first = s->around.start[v], n = s->around.start[v + 1] - first;
		mr_v3 normal = sum_faces(s, s->around.face + first, n);
		bool bent = false;
		for (size_t i = 0; i < n && !bent; i++)
			bent = !within(s, normal, s->around.face[first + i], BENT);
		if (bent)
			part_vertex(s, v, &room, &faces, &face_room);
	}
	s->normal = mr_alloc(&s->ctx, s->m.nv + s->n, sizeof *s->normal);
}

/* Parts its vertices where it has creases now: how many vertices there are beside its own, or MR_NONE; and of
 * these which they stand for; the triangles of all. */
MR_EXPORT(surface_part)
size_t
surface_part(surface *s)
{
	part(s);
	return s->n;
}

/* Unit normals of all these vertices, as they are now. */
MR_EXPORT(surface_normals)
void
surface_normals(surface *s)
{
	size_t nv = s->m.nv;

	for (size_t i = 0; i < nv + s->n; i++) {
		const uint32_t *face = i < nv ? s->around.face : s->face;
		size_t first = i < nv ? s->around.start[i] : i == nv ? 0 : s->end[i - nv - 1];
		size_t end = i < nv ? s->around.start[i + 1] : s->end[i - nv];
		mr_v3 normal = sum_faces(s, face + first, end - first);
		s->normal[i][0] = (float)normal.x;
		s->normal[i][1] = (float)normal.y;
		s->normal[i][2] = (float)normal.z;
	}
}
