/* The normal field of Phong shading (Phong 1975: Illumination for computer generated pictures) and its
 * frames. */
#include "edit/phong.h"

mr_v3
mr_phong_face_normal(const mr_phong *s, uint32_t face)
{
	mr_v3 n = mr_unit(mr_face_cross(s->m, face));

	return mr_norm2(n) > 0 ? n : mr_vec(0, 0, 1);
}

/* a without its part along the unit vector n, at unit length, zero where nothing is left; again, as a may lie
 * all but along n. */
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
mr_phong_frame(const mr_phong *s, mr_place at)
{
	const uint32_t *v = s->m->t[at.face].v;
	mr_v3 n = mr_phong_normal(s, at);
	mr_v3 t1 = tangent(mr_sub(s->m->p[v[1]], s->m->p[v[0]]), n);

	if (mr_norm2(t1) == 0) /* an edge of no length, or one along n: any tangent serves */
		t1 = tangent(fabs(n.x) < 0.7 ? mr_vec(1, 0, 0) : mr_vec(0, 1, 0), n);
	return (mr_tangent_frame){ n, t1, mr_cross(n, t1) };
}

/* a without its part along the unit vector n. */
static mr_v3
across(mr_v3 a, mr_v3 n)
{
	return mr_axpy(-mr_dot(a, n), n, a);
}

/* With a, b the edges across the normal, W a = c and W b = d what becomes of it along them: the eigenvalues
 * of W's symmetric part. */
double
mr_phong_curvature(const mr_phong *s, mr_place at)
{
	const uint32_t *v = s->m->t[at.face].v;
	mr_v3 raw = mr_bary_point(at.bary, s->normal[v[0]], s->normal[v[1]], s->normal[v[2]]),
	      n = mr_unit(raw);
	mr_v3 a = across(mr_sub(s->m->p[v[1]], s->m->p[v[0]]), n);
	mr_v3 b = across(mr_sub(s->m->p[v[2]], s->m->p[v[0]]), n);
	mr_v3 c = across(mr_sub(s->normal[v[1]], s->normal[v[0]]), n);
	mr_v3 d = across(mr_sub(s->normal[v[2]], s->normal[v[0]]), n);
	double length = mr_norm(raw), area = length * mr_dot(n, mr_cross(a, b));
	double half = (mr_dot(n, mr_cross(c, b)) + mr_dot(n, mr_cross(a, d))) / (2 * area);
	double skew = (mr_dot(a, d) - mr_dot(b, c)) / (2 * area);
	double det = mr_dot(n, mr_cross(c, d)) / (length * area);

	return area > 0 || area < 0 ? fabs(half) + sqrt(fmax(0, half * half + skew * skew - det)) : INFINITY;
}
