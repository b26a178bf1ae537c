/* The volume of the free part, which rounds lose: pressure restores it. */
#include "edit/deform_energy.h"

#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include "mesh/edges.h"

/* How often the faces of edge e run one way more than the other. */
static int
open_sides(const mr_mesh *m, const mr_edges *edges, size_t e)
{
	uint32_t first = edges->he[edges->start[e]];
	int sides = 0;

	for (size_t i = edges->start[e]; i < edges->start[e + 1]; i++)
		sides += mr_same_direction(m, first, edges->he[i]) ? 1 : -1;
	return sides;
}

/* A face back from each side of an edge where the patch ends, to a vertex of the same loop of them, which has
 * to go as one constraint goes. */
mr_mesh
mr_inside_make(mr_ctx *ctx, const mr_patch *patch, const uint32_t *region)
{
	const uint32_t *vertex = patch->vertex;
	mr_mesh own = patch->mesh, inside = { .name = own.name };
	uint32_t *loop = mr_sets_new(ctx, own.nv);
	mr_edges edges;
	mr_tri *t;

	own.nf = patch->own; /* without the triangles between parts that touch */
	mr_edges_build(ctx, &own, &edges);
	for (size_t e = 0; e < edges.count; e++) {
		uint32_t h = edges.he[edges.start[e]], a = mr_he_from(&own, h), b = mr_he_to(&own, h);
		uint32_t r = region[vertex[a]];
		if (open_sides(&own, &edges, e) == 0)
			continue;
		if (r == MR_REGION_FREE || r != region[vertex[b]])
			return inside;
		mr_sets_join(loop, a, b);
	}
	inside.t = t = MR_NEW(ctx, 4 * own.nf, mr_tri); /* no edge has more open sides than faces */
	for (size_t f = 0; f < own.nf; f++) {
		const uint32_t *c = own.t[f].v;
		t[inside.nf++] = (mr_tri){ { vertex[c[0]], vertex[c[1]], vertex[c[2]] } };
	}
	for (size_t e = 0; e < edges.count; e++) {
		uint32_t h = edges.he[edges.start[e]], a = mr_he_from(&own, h), b = mr_he_to(&own, h);
		for (int side = open_sides(&own, &edges, e); side != 0; side += side > 0 ? -1 : 1)
			t[inside.nf++] = (mr_tri){ { vertex[mr_sets_root(loop, a)], vertex[side > 0 ? b : a],
			    vertex[side > 0 ? a : b] } };
	}
	return inside;
}

/* The derivative of the volume by each vertex of the patch, 3 values each. */
static void
differentiate(const mr_patch *patch, const mr_v3 *p, double *g)
{
	memset(g, 0, 3 * patch->mesh.nv * sizeof *g);
	for (size_t f = 0; f < patch->own; f++) {
		const uint32_t *c = patch->mesh.t[f].v;
		mr_v3 a = p[patch->vertex[c[0]]];
		mr_v3 n = mr_cross(mr_sub(p[patch->vertex[c[1]]], a), mr_sub(p[patch->vertex[c[2]]], a));
		for (int k = 0; k < 3; k++) {
			g[3 * c[k]] += n.x / 6;
			g[3 * c[k] + 1] += n.y / 6;
			g[3 * c[k] + 2] += n.z / 6;
		}
	}
}

/* The volume as a function of how far along u the vertices are is all but straight: by secants. */
mr_status
mr_inside_keep(mr_ctx *ctx, mr_deform_system *s, const mr_mesh *inside, double least, mr_v3 *p)
{
	enum { MOST = 5 };
	static const double enough = 1e-4;
	MR_SCOPE(ctx);
	double *g = MR_NEW(ctx, 3 * s->patch.mesh.nv, double), slope = 0, step;
	double goal, missing;
	mr_mesh now = *inside;
	mr_field f = mr_system_field(s, 3);
	size_t n = s->patch.end[0];

	now.p = p;
	goal = missing = least - mr_mesh_volume(ctx, &now);
	differentiate(&s->patch, p, g);
	f.source = g;
	MR_TRY(mr_system_solve(ctx, s, &f));
	for (size_t i = 0; i < 3 * n; i++)
		slope += f.u[i] * g[i];
	step = missing / slope;
	for (int i = 0; i < MOST && isfinite(step) && fabs(missing) > enough * fabs(goal); i++) {
		double left;
		for (size_t k = 0; k < n; k++) {
			mr_v3 *at = &p[s->patch.vertex[k]];
			*at = mr_axpy(step, mr_vec(f.u[3 * k], f.u[3 * k + 1], f.u[3 * k + 2]), *at);
		}
		left = least - mr_mesh_volume(ctx, &now);
		step *= left / (missing - left);
		missing = left;
	}
	return MR_OK;
}
