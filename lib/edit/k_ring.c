/* Rings by breadth first, and the part that they make numbered anew. */
#include "edit/deform_system.h"

/* Gives level r + 1 to the vertices that share a face with one of level r and have none yet. */
static void
next_ring(const mr_mesh *m, uint8_t r, uint8_t *level)
{
	for (size_t f = 0; f < m->nf; f++) {
		const uint32_t *v = m->t[f].v;
		if (level[v[0]] != r && level[v[1]] != r && level[v[2]] != r)
			continue;
		for (int k = 0; k < 3; k++)
			if (level[v[k]] > r)
				level[v[k]] = (uint8_t)(r + 1);
	}
}

void
mr_patch_levels(const mr_mesh *m, const bool *chosen, uint8_t most, uint8_t *level)
{
	for (size_t v = 0; v < m->nv; v++)
		level[v] = chosen[v] ? 0 : (uint8_t)(most + 1);
	for (uint8_t r = 0; r < most; r++)
		next_ring(m, r, level);
}

/* Numbers the vertices ring by ring; local[v] is the patch's number of v. */
static void
number_vertices(const mr_mesh *m, const uint8_t *level, size_t rings, mr_patch *p, uint32_t *local)
{
	size_t next[MR_PATCH_RINGS + 2] = { 0 };

	for (size_t v = 0; v < m->nv; v++)
		if (level[v] <= rings)
			next[level[v] + 1]++;
	for (size_t r = 0; r <= rings; r++)
		p->end[r] = next[r + 1] += next[r];
	for (uint32_t v = 0; v < m->nv; v++)
		if (level[v] <= rings) {
			local[v] = (uint32_t)next[level[v]]++;
			p->vertex[local[v]] = v;
		}
}

void
mr_patch_build(mr_ctx *ctx, const mr_mesh *m, size_t own, const bool *chosen, size_t rings, mr_patch *patch)
{
	mr_patch r = { .mesh = { .name = m->name }, .vertex = MR_NEW(ctx, m->nv, uint32_t) };
	uint8_t *level = MR_NEW(ctx, m->nv, uint8_t);
	uint32_t *local = MR_NEW(ctx, m->nv, uint32_t);
	mr_v3 *p;
	mr_tri *t;

	mr_patch_levels(m, chosen, (uint8_t)rings, level);
	number_vertices(m, level, rings, &r, local);
	p = MR_NEW(ctx, r.end[rings], mr_v3);
	t = MR_NEW(ctx, m->nf, mr_tri);
	for (size_t i = 0; i < r.end[rings]; i++)
		p[i] = m->p[r.vertex[i]];
	for (size_t f = 0; f < m->nf; f++) {
		const uint32_t *v = m->t[f].v;
		if (level[v[0]] >= rings && level[v[1]] >= rings && level[v[2]] >= rings)
			continue;
		r.own += f < own;
		t[r.mesh.nf++] = (mr_tri){ { local[v[0]], local[v[1]], local[v[2]] } };
	}
	r.mesh.nv = r.end[rings];
	r.mesh.p = p;
	r.mesh.t = t;
	*patch = r;
}
