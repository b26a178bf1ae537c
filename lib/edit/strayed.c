/* Edges that change by over twice, against the edges of the faces of base that their ends stand on. */
#include "edit/strayed.h"

#include <math.h>

/* By how much the length from a to b has changed, as a factor of at least 1; its square. */
static double
change2(const mr_v3 *before, const mr_v3 *after, uint32_t a, uint32_t b)
{
	double was = mr_norm2(mr_sub(before[a], before[b])), is = mr_norm2(mr_sub(after[a], after[b]));

	return was == 0 || is == was /* both beyond what has squares */ ? 1 : is >= was ? is / was : is > 0 ? was / is : INFINITY;
}

/* The most that an edge of a face of base has. */
static double
base_change2(const mr_mesh *base, const mr_v3 *rest, uint32_t face)
{
	const uint32_t *v = base->t[face].v;
	double most = 1;

	for (int k = 0; k < 3; k++) {
		double is = change2(rest, base->p, v[k], v[(k + 1) % 3]);
		most = is > most ? is : most;
	}
	return most;
}

mr_strayed
mr_strayed_find(
    const mr_mesh *mesh, const mr_edges *edges, const mr_v3 *p, const mr_mesh *base, const mr_detail *d)
{
	const double much2 = 4;
	mr_strayed s = { 0, MR_NONE };
	double most = 0;

	for (size_t e = 0; e < edges->count; e++) {
		uint32_t h = edges->he[edges->start[e]], i = mr_he_from(mesh, h), j = mr_he_to(mesh, h);
		double is = change2(mesh->p, p, i, j);
		if (is <= much2 || is <= much2 * base_change2(base, d->rest, d->at.face[i]) ||
		    is <= much2 * base_change2(base, d->rest, d->at.face[j]))
			continue;
		s.edges++;
		if (is > most) {
			s.vertex = i;
			most = is;
		}
	}
	return s;
}
