/* Sums at vertices over their faces: threads add to blocks of vertices of their own. */
#include "mesh/scatter.h"

#include "base/parallel.h"

enum { BLOCK = 4096 };

static size_t
block_of(const mr_scatter *s, mr_tri t)
{
	uint32_t b = t.v[0] / BLOCK;

	return t.v[1] / BLOCK == b && t.v[2] / BLOCK == b ? b : s->blocks - 1;
}

mr_scatter
mr_scatter_make(mr_ctx *ctx, const mr_mesh *m)
{
	mr_scatter s = { .blocks = m->nv / BLOCK + 2 };

	s.start = MR_NEW_ZERO(ctx, s.blocks + 2, size_t);
	s.t = MR_NEW(ctx, m->nf, mr_tri);
	for (size_t f = 0; f < m->nf; f++)
		s.start[block_of(&s, m->t[f]) + 2]++;
	for (size_t b = 0; b < s.blocks; b++)
		s.start[b + 2] += s.start[b + 1];
	for (size_t f = 0; f < m->nf; f++)
		s.t[s.start[block_of(&s, m->t[f]) + 1]++] = m->t[f];
	return s;
}

typedef struct run {
	const mr_scatter *s;
	mr_giver *give;
	void *arg;
} run;

static void
run_blocks(void *arg, size_t begin, size_t end)
{
	const run *r = arg;

	for (size_t b = begin; b < end; b++)
		r->give(r->arg, r->s->t + r->s->start[b], r->s->start[b + 1] - r->s->start[b]);
}

void
mr_scatter_run(const mr_ctx *ctx, const mr_scatter *s, mr_giver *give, void *arg)
{
	run r = { s, give, arg };

	mr_parallel(ctx, s->blocks - 1, 1, run_blocks, &r);
	run_blocks(&r, s->blocks - 1, s->blocks);
}
