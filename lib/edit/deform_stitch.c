/* Triangles that join components where they touch. */
#include "edit/deform_stitch.h"

#include "space/contact.h"

/* The least height over an edge of what is as long as the longest edge: 0.87 of an equilateral triangle, 0 of
 * a line. */
static double
shape(mr_v3 a, mr_v3 b, mr_v3 c)
{
	double longest2 = fmax(mr_norm2(mr_sub(a, b)), fmax(mr_norm2(mr_sub(b, c)), mr_norm2(mr_sub(c, a))));

	return longest2 > 0 ? mr_norm(mr_cross(mr_sub(b, a), mr_sub(c, a))) / longest2 : 0;
}

/* From the vertex to the best two corners of the face. */
static mr_tri
stitch_of(const mr_mesh *m, mr_tie joint)
{
	const uint32_t *v = m->t[joint.face].v;
	double most = -1;
	mr_tri best = { { joint.vertex, v[0], v[1] } };

	for (int k = 0; k < 3; k++) {
		uint32_t a = v[k], b = v[(k + 1) % 3];
		double is = shape(m->p[joint.vertex], m->p[a], m->p[b]);
		if (is > most) {
			best = (mr_tri){ { joint.vertex, a, b } };
			most = is;
		}
	}
	return best;
}

/* None where all three corners are constrained. */
static void
add_stitch(mr_tie joint, const mr_mesh *rest, const uint32_t *region, mr_tri *t, size_t *nf)
{
	mr_tri stitch = stitch_of(rest, joint);
	bool free = false;

	for (int k = 0; k < 3; k++)
		free |= region[stitch.v[k]] == MR_REGION_FREE;
	if (free)
		t[(*nf)++] = stitch;
}

mr_mesh
mr_stitch(mr_ctx *ctx, const mr_mesh *rest, const mr_ties *ties, const uint32_t *region)
{
	/* An edge.  Half of it, or one stitch a vertex, lets up to twice as many vertices come apart. */
	double reach = mr_mesh_edge_scale(ctx, rest);
	mr_mesh stitched = *rest;
	mr_contacts contacts;
	mr_tri *t;

	mr_contacts_find(ctx, rest, reach, &contacts);
	if (contacts.start[rest->nv] + ties->n == 0)
		return stitched;
	t = MR_NEW(ctx, rest->nf + contacts.start[rest->nv] + ties->n, mr_tri);
	memcpy(t, rest->t, rest->nf * sizeof *t);
	for (uint32_t v = 0; v < rest->nv; v++)
		for (size_t i = contacts.start[v]; i < contacts.start[v + 1]; i++)
			add_stitch((mr_tie){ v, contacts.at[i].face }, rest, region, t, &stitched.nf);
	for (size_t i = 0; i < ties->n; i++)
		add_stitch(ties->tie[i], rest, region, t, &stitched.nf);
	stitched.t = t;
	mr_note(
	    ctx, "%s: %zu stitches hold parts that touch to each other", rest->name, stitched.nf - rest->nf);
	return stitched;
}
