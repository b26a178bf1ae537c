#include "edit/phong.h"

#include "base/parallel.h"

/* What a face gives to its corners' normals. */
typedef struct face_normal {
	mr_v3 unit;      /* zero where the face has no area */
	double angle[3]; /* interior, at each corner */
} face_normal;

typedef struct normals_job {
	const mr_mesh *m;
	const mr_incidence *inc;
	face_normal *face;
	mr_v3 *normal;
} normals_job;

static void
normals_of_faces(void *arg, size_t begin, size_t end)
{
	normals_job *j = arg;

	for (size_t f = begin; f < end; f++) {
		const uint32_t *v = j->m->t[f].v;
		mr_v3 a = mr_sub(j->m->p[v[1]], j->m->p[v[0]]), b = mr_sub(j->m->p[v[2]], j->m->p[v[0]]);
		mr_v3 cross = mr_cross(a, b);
		double twice_area = mr_norm(cross), first, second;

		if (!(twice_area > 0)) {
			j->face[f] = (face_normal){ 0 };
			continue;
		}
		first = atan2(twice_area, mr_dot(a, b));
		second = atan2(twice_area, mr_dot(a, mr_sub(a, b)));
		j->face[f] = (face_normal){ mr_mul(1 / twice_area, cross),
			{ first, second, MR_PI - first - second } };
	}
}

static void
normals_of_vertices(void *arg, size_t begin, size_t end)
{
	normals_job *j = arg;

	for (size_t v = begin; v < end; v++) {
		mr_v3 sum = { 0, 0, 0 };
		for (size_t i = j->inc->start[v]; i < j->inc->start[v + 1]; i++) {
			const uint32_t *c = j->m->t[j->inc->face[i]].v;
			const face_normal *f = &j->face[j->inc->face[i]];
			sum = mr_axpy(f->angle[c[0] == v ? 0 : c[1] == v ? 1 : 2], f->unit, sum);
		}
		j->normal[v] = mr_unit(sum);
	}
}

mr_status
mr_phong_normals(mr_ctx *ctx, const mr_mesh *m, const mr_incidence *inc, mr_v3 *normal)
{
	mr_mark mark = mr_mark_take(ctx);
	normals_job j = { m, inc, MR_NEW(ctx, m->nf, face_normal), normal };

	if (!j.face)
		return MR_EMEM;
	mr_parallel(ctx, m->nf, 4096, normals_of_faces, &j);
	mr_parallel(ctx, m->nv, 4096, normals_of_vertices, &j);
	mr_mark_release(ctx, mark);
	return MR_OK;
}

mr_v3
mr_phong_normal(const mr_phong *s, uint32_t face, mr_v3 w)
{
	const uint32_t *v = s->m->t[face].v;
	mr_v3 n = mr_bary_point(w, s->normal[v[0]], s->normal[v[1]], s->normal[v[2]]);

	if (mr_norm2(n) > 0)
		return mr_unit(n);
	n = mr_unit(mr_face_cross(s->m, face));
	return mr_norm2(n) > 0 ? n : mr_vec(0, 0, 1);
}

/*
 * a without its part along the unit vector n, at unit length; zero where nothing is left.  What rounding
 * leaves along n is taken away again at unit length: a may lie all but along n, and the frame is to be
 * orthonormal all the same.
 */
static mr_v3
tangent(mr_v3 a, mr_v3 n)
{
	mr_v3 unit = mr_unit(a), t = mr_axpy(-mr_dot(unit, n), n, unit);

	if (!(mr_norm2(t) > 1e-20))
		return mr_vec(0, 0, 0);
	t = mr_unit(t);
	return mr_unit(mr_axpy(-mr_dot(t, n), n, t));
}

mr_tangent_frame
mr_phong_frame(const mr_phong *s, uint32_t face, mr_v3 w)
{
	const uint32_t *v = s->m->t[face].v;
	mr_v3 n = mr_phong_normal(s, face, w);
	mr_v3 t1 = tangent(mr_sub(s->m->p[v[1]], s->m->p[v[0]]), n);

	if (mr_norm2(t1) == 0) /* an edge of no length, or one along n: any tangent serves */
		t1 = tangent(fabs(n.x) < 0.7 ? mr_vec(1, 0, 0) : mr_vec(0, 1, 0), n);
	return (mr_tangent_frame){ n, t1, mr_cross(n, t1) };
}
