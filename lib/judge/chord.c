/* The middles of long edges, carried by the frames of the faces of base that are nearest to them. */
#include "judge/chord.h"

#include "space/bvh.h"
#include "space/contact.h"

static mr_v3
middle(const mr_v3 *p, const mr_mesh *m, uint32_t h)
{
	return mr_lerp(0.5, p[mr_he_from(m, h)], p[mr_he_to(m, h)]);
}

static double
length(const mr_mesh *m, uint32_t h)
{
	return mr_dist(m->p[mr_he_from(m, h)], m->p[mr_he_to(m, h)]);
}

/* An orthonormal frame of a face: along its first side, across it, and its normal. */
static void
frame_of(const mr_mesh *m, uint32_t f, mr_v3 axis[3])
{
	const uint32_t *v = m->t[f].v;

	axis[0] = mr_unit(mr_sub(m->p[v[1]], m->p[v[0]]));
	axis[2] = mr_unit(mr_face_cross(m, f));
	axis[1] = mr_cross(axis[2], axis[0]);
}

/* Where base takes the point q. */
static mr_v3
carry(const mr_ground *g, const mr_mesh *now, const mr_closest *c, mr_v3 q)
{
	mr_v3 then[3], axis[3], offset = mr_sub(q, c->point), p = mr_place_point(now, c->at);

	frame_of(&g->then, c->at.face, then);
	frame_of(now, c->at.face, axis);
	for (int k = 0; k < 3; k++)
		p = mr_axpy(mr_dot(offset, then[k]), axis[k], p);
	return p;
}

/* Where parts touch, the face of base nearest to a middle may be of another part. */
static bool
are_joined(const mr_ground *g, const uint32_t *component, uint32_t f, uint32_t v)
{
	return component[g->then.t[f].v[0]] == component[g->then.t[g->at.face[v]].v[0]];
}

void
mr_chords_find(mr_ctx *ctx, const mr_motion *m, const mr_ground *g, double far, mr_chords *found)
{
	mr_chords c = { .vertex = MR_NONE, .enough = INFINITY };
	mr_mesh now = g->then;
	uint32_t *component = NULL;
	double farthest = far;
	bool several;
	mr_bvh *bvh;

	now.p = g->now;
	for (size_t e = 0; e < m->edges->count; e++) {
		uint32_t h = m->edges->he[m->edges->start[e]];
		mr_v3 q = middle(m->then->p, m->then, h);
		mr_closest near;
		double off;
		if (length(m->then, h) <= 4 * far)
			continue;
		if (!component) {
			mr_bvh_build(ctx, &g->then, &bvh);
			mr_components_label(ctx, &g->then, &component, &several);
		}
		near = mr_bvh_closest(bvh, q);
		off = mr_dist(carry(g, &now, &near, q), middle(m->now, m->then, h));
		if (!(off > far) || !are_joined(g, component, near.at.face, mr_he_from(m->then, h)))
			continue;
		c.edges++;
		c.enough = fmin(c.enough, length(m->then, h) * sqrt(far / off));
		if (off > farthest) {
			farthest = off;
			c.vertex = mr_he_from(m->then, h);
		}
	}
	*found = c;
}
