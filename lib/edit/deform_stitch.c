/* Triangles that join components where they touch. */
#include "edit/deform_parts.h"

#include "space/contact.h"

/* A component, at the vertex that stands for it. */
typedef struct part {
	mr_box box;
	bool bound; /* has a constrained vertex, or a tie */
	bool small; /* beside one that it is near, and not bound */
} part;

typedef struct seam {
	const mr_mesh *rest;
	const uint32_t *region, *component;
	part *parts;
	mr_tri *t; /* stitches, after the faces */
	size_t nf;
} seam;

/* The least height over the longest edge: 0.87 of an equilateral triangle, 0 of a line. */
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

static void
compare_parts(part *a, const part *b)
{
	static const double small = 0.25;

	a->small |= !a->bound && mr_box_diagonal(a->box) < small * mr_box_diagonal(b->box);
}

static void
measure_parts(mr_ctx *ctx, const mr_contacts *c, const mr_ties *ties, seam *s)
{
	const mr_mesh *m = s->rest;

	s->parts = MR_NEW_ZERO(ctx, m->nv, part);
	for (size_t v = 0; v < m->nv; v++)
		s->parts[v].box = mr_box_empty();
	for (size_t v = 0; v < m->nv; v++)
		if (s->component[v] != MR_NONE) {
			mr_box_add(&s->parts[s->component[v]].box, m->p[v]);
			s->parts[s->component[v]].bound |= s->region[v] != MR_REGION_FREE;
		}
	for (size_t i = 0; i < ties->n; i++) {
		s->parts[s->component[ties->tie[i].vertex]].bound = true;
		s->parts[s->component[m->t[ties->tie[i].face].v[0]]].bound = true;
	}
	for (size_t v = 0; ties->known && v < m->nv; v++)
		for (size_t i = c->start[v]; i < c->start[v + 1]; i++) {
			part *own = &s->parts[s->component[v]],
			     *other = &s->parts[s->component[m->t[c->at[i].face].v[0]]];
			compare_parts(own, other);
			compare_parts(other, own);
		}
}

/* None where all three corners are constrained, or a part follows. */
static void
add_stitch(seam *s, uint32_t vertex, uint32_t face)
{
	mr_tri stitch = stitch_of(s->rest, (mr_tie){ vertex, face });
	bool free = false, follows = false;

	for (int k = 0; k < 3; k++) {
		free |= s->region[stitch.v[k]] == MR_REGION_FREE;
		follows |= s->parts[s->component[stitch.v[k]]].small;
	}
	if (free && !follows)
		s->t[s->nf++] = stitch;
}

mr_mesh
mr_stitch(mr_ctx *ctx, const mr_mesh *rest, const mr_ties *ties, const uint32_t *region, bool *follows)
{
	/* An edge.  Half of it, or one stitch a vertex, lets up to twice as many vertices come apart. */
	double reach = mr_mesh_edge_scale(ctx, rest);
	seam s = { .rest = rest, .region = region, .nf = rest->nf };
	mr_mesh stitched = *rest;
	mr_contacts contacts;
	uint32_t *component;
	bool several;

	mr_contacts_find(ctx, rest, reach, &contacts);
	if (contacts.start[rest->nv] + ties->n == 0)
		return stitched;
	mr_components_label(ctx, rest, &component, &several);
	s.component = component;
	measure_parts(ctx, &contacts, ties, &s);
	s.t = MR_NEW(ctx, rest->nf + contacts.start[rest->nv] + ties->n, mr_tri);
	memcpy(s.t, rest->t, rest->nf * sizeof *s.t);
	for (uint32_t v = 0; v < rest->nv; v++) {
		follows[v] = component[v] != MR_NONE && s.parts[component[v]].small;
		for (size_t i = contacts.start[v]; i < contacts.start[v + 1]; i++)
			add_stitch(&s, v, contacts.at[i].face);
	}
	for (size_t i = 0; i < ties->n; i++)
		add_stitch(&s, ties->tie[i].vertex, ties->tie[i].face);
	stitched.t = s.t;
	stitched.nf = s.nf;
	mr_note(
	    ctx, "%s: %zu stitches hold parts that touch to each other", rest->name, stitched.nf - rest->nf);
	return stitched;
}
