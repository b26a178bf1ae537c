/* The volume of what is free, which rounds lose: pressure gives it back. */
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
void
mr_inside_make(mr_ctx *ctx, const mr_patch *patch, const uint32_t *region, mr_inside *v)
{
	mr_mesh own = patch->mesh;
	uint32_t *loop = mr_sets_new(ctx, own.nv);
	mr_edges edges;

	own.nf = patch->own; /* without the triangles between parts that touch */
	mr_edges_build(ctx, &own, &edges);
	v->t = MR_NEW(ctx, 4 * own.nf, mr_tri); /* no edge has more open sides than faces */
	v->nf = own.nf;
	memcpy(v->t, own.t, own.nf * sizeof *v->t);
	for (size_t e = 0; e < edges.count; e++) {
		uint32_t h = edges.he[edges.start[e]], a = mr_he_from(&own, h), b = mr_he_to(&own, h);
		uint32_t r = region[patch->vertex[a]];
		int sides = open_sides(&own, &edges, e);
		if (sides != 0 && (r == MR_REGION_FREE || r != region[patch->vertex[b]])) {
			v->t = NULL;
			return;
		}
		if (sides != 0)
			mr_sets_join(loop, a, b);
	}
	for (size_t e = 0; e < edges.count; e++) {
		uint32_t h = edges.he[edges.start[e]], a = mr_he_from(&own, h), b = mr_he_to(&own, h);
		for (int side = open_sides(&own, &edges, e); side != 0; side += side > 0 ? -1 : 1)
			v->t[v->nf++] = (mr_tri){ { mr_sets_root(loop, a), side > 0 ? b : a,
			    side > 0 ? a : b } };
	}
}

typedef struct solid {
	const mr_inside *v;
	const uint32_t *vertex;
	const mr_v3 *p;
	mr_v3 origin;
} solid;

static double
face_volume(void *arg, size_t f)
{
	const solid *s = arg;
	const uint32_t *v = s->v->t[f].v;
	mr_v3 a = mr_sub(s->p[s->vertex[v[0]]], s->origin), b = mr_sub(s->p[s->vertex[v[1]]], s->origin),
	      c = mr_sub(s->p[s->vertex[v[2]]], s->origin);

	return mr_dot(a, mr_cross(b, c)) / 6;
}

double
mr_inside_volume(const mr_ctx *ctx, const mr_inside *v, const mr_patch *patch, const mr_v3 *p)
{
	solid s = { v, patch->vertex, p, p[patch->vertex[0]] };

	return mr_parallel_sum(ctx, v->nf, face_volume, &s);
}

/* The derivative of the volume by each vertex of the patch, 3 values each. */
static void
differentiate(const mr_inside *v, const mr_patch *patch, const mr_v3 *p, double *g)
{
	memset(g, 0, 3 * patch->mesh.nv * sizeof *g);
	for (size_t f = 0; f < patch->own; f++) {
		const uint32_t *c = v->t[f].v;
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
mr_inside_keep(mr_ctx *ctx, mr_deform_system *s, const mr_inside *v, double least, mr_v3 *p)
{
	enum { MOST = 5 };
	static const double enough = 1e-4;
	mr_mark mark = mr_mark_take(ctx);
	double *g = MR_NEW(ctx, 3 * s->patch.mesh.nv, double), slope = 0, step;
	double goal = least - mr_inside_volume(ctx, v, &s->patch, p), missing = goal;
	mr_field f = mr_system_field(s, 3);
	size_t n = s->patch.end[0];

	differentiate(v, &s->patch, p, g);
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
		left = least - mr_inside_volume(ctx, v, &s->patch, p);
		step *= left / (missing - left);
		missing = left;
	}
	mr_mark_release(ctx, mark);
	return MR_OK;
}
