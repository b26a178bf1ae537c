/* Edges that change by over twice, against the edges of the faces of base that their ends stand on. */
#include "judge/strayed.h"

#include <math.h>

/* By how much the length from a to b has changed, as a factor of at least 1; its square. */
static double
change2(const mr_v3 *before, const mr_v3 *after, uint32_t a, uint32_t b)
{
	double was = mr_norm2(mr_sub(before[a], before[b])), is = mr_norm2(mr_sub(after[a], after[b]));

	return was == 0 || is == was /* both beyond what has squares */ ? 1
	       : is >= was                                              ? is / was
	       : is > 0                                                 ? was / is
	                                                                : INFINITY;
}

/* The most that an edge of a face of base has. */
static double
base_change2(const mr_ground *g, uint32_t face)
{
	const uint32_t *v = g->then.t[face].v;
	double most = 1;

	for (int k = 0; k < 3; k++)
		most = fmax(most, change2(g->then.p, g->now, v[k], v[(k + 1) % 3]));
	return most;
}

mr_strayed
mr_strayed_find(const mr_motion *m, const mr_ground *g)
{
	const double much2 = 4;
	mr_strayed s = { 0, MR_NONE };
	double most = 0;

	for (size_t e = 0; e < m->edges->count; e++) {
		uint32_t h = m->edges->he[m->edges->start[e]];
		uint32_t i = mr_he_from(m->then, h), j = mr_he_to(m->then, h);
		double is = change2(m->then->p, m->now, i, j);
		if (is <= much2 || is <= much2 * base_change2(g, g->at.face[i]) ||
		    is <= much2 * base_change2(g, g->at.face[j]))
			continue;
		s.edges++;
		if (is > most) {
			s.vertex = i;
			most = is;
		}
	}
	return s;
}
