/* The normal field of Phong shading (Phong 1975: Illumination for computer generated pictures) and its
 * frames. */
#include "edit/phong.h"

mr_v3
mr_phong_face_normal(const mr_phong *s, uint32_t face)
{
	mr_v3 n = mr_unit(mr_face_cross(s->m, face));

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
mr_phong_frame(const mr_phong *s, mr_place at)
{
	const uint32_t *v = s->m->t[at.face].v;
	mr_v3 n = mr_phong_normal(s, at);
	mr_v3 t1 = tangent(mr_sub(s->m->p[v[1]], s->m->p[v[0]]), n);

	if (mr_norm2(t1) == 0) /* an edge of no length, or one along n: any tangent serves */
		t1 = tangent(fabs(n.x) < 0.7 ? mr_vec(1, 0, 0) : mr_vec(0, 1, 0), n);
	return (mr_tangent_frame){ n, t1, mr_cross(n, t1) };
}

double
mr_phong_curvature(const mr_phong *s, mr_place at)
{
	const uint32_t *v = s->m->t[at.face].v;
	mr_v3 raw = mr_bary_point(at.bary, s->normal[v[0]], s->normal[v[1]], s->normal[v[2]]);
	mr_tangent_frame f = mr_phong_frame(s, at);
	double length = mr_norm(raw), e[2][2], m[2][2], w[2][2], det, mean, half;

	for (int k = 0; k < 2; k++) {
		mr_v3 edge = mr_sub(s->m->p[v[k + 1]], s->m->p[v[0]]);
		mr_v3 turn = mr_sub(s->normal[v[k + 1]], s->normal[v[0]]);
		e[0][k] = mr_dot(edge, f.t1), e[1][k] = mr_dot(edge, f.t2);
		m[0][k] = mr_dot(turn, f.t1), m[1][k] = mr_dot(turn, f.t2);
	}
	det = length * (e[0][0] * e[1][1] - e[0][1] * e[1][0]);
	for (int i = 0; i < 2; i++) { /* W = m e^-1 / length */
		w[i][0] = (m[i][0] * e[1][1] - m[i][1] * e[1][0]) / det;
		w[i][1] = (m[i][1] * e[0][0] - m[i][0] * e[0][1]) / det;
	}
	mean = 0.5 * (w[0][0] + w[1][1]);
	half = hypot(0.5 * (w[0][0] - w[1][1]), 0.5 * (w[0][1] + w[1][0]));
	return det > 0 || det < 0 ? fabs(mean) + half : INFINITY;
}
