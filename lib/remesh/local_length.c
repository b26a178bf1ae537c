/* A factor of the target length at each vertex, shrunk where an edge cannot be and graded around. */
#include "remesh/local_length.h"

static const float LEAST = 1.0f / 8, STEP = 0.7f;
static const double SLOPE = 0.5;
static const double FIT = 1.25;      /* target over edge, at most: 4/5 of it is too short */
static const double ENOUGH = 1.0001; /* lengths that differ by less are alike: floats */

void
mr_refine_begin(mr_ctx *ctx, mr_dyn *d)
{
	d->scale = MR_NEW(ctx, d->room_v, float);
	for (size_t v = 0; v < d->nv; v++)
		d->scale[v] = 1;
}

/* Where b may be at most, given a. */
static bool
limit(mr_dyn *d, const mr_remesh_source *s, uint32_t a, uint32_t b)
{
	double most;

	if (!(d->scale[b] > d->scale[a]))
		return false; /* as almost everywhere, told without a root */
	most = d->scale[a] + SLOPE * mr_dist(d->p[a], d->p[b]) / s->uniform;
	if (!(d->scale[b] > most * ENOUGH))
		return false;
	d->scale[b] = (float)most;
	return true;
}

void
mr_refine_grade(mr_dyn *d, const mr_remesh_source *s)
{
	bool changed;

	if (!d->scale)
		return;
	do {
		changed = false;
		for (uint32_t h = 0; h < 3 * d->nf; h++)
			if (!mr_dyn_face_dead(d, h / 3)) {
				changed |= limit(d, s, d->v[h], mr_dyn_to(d, h));
				changed |= limit(d, s, mr_dyn_to(d, h), d->v[h]);
			}
	} while (changed);
}

void
mr_refine_edge(mr_dyn *d, const mr_remesh_source *s, uint32_t h)
{
	uint32_t end[2] = { d->v[h], mr_dyn_to(d, h) };
	float fit = (float)(FIT * mr_dist(d->p[end[0]], d->p[end[1]]) / s->uniform);

	if (!d->scale)
		return;
	for (int i = 0; i < 2; i++) {
		float *scale = &d->scale[end[i]];
		float most = fmaxf(LEAST, fmaxf(fit, STEP * *scale));
		*scale = fminf(*scale, most);
	}
}
