/* A patch has numbers of its own; its rim, found again by its vertices, is where it is sewn in. */
#include "mesh/dynmesh_patch.h"

typedef struct cutter {
	mr_ctx *ctx;
	const mr_dyn *d;
	unsigned rings;
	uint8_t *level;  /* of each vertex: one more than its edges to the nearest that was given; 0: far */
	uint32_t *queue; /* of vertices that are not far, the nearest first */
	size_t queued, room;
	uint32_t *local; /* of each face of the mesh: its number in the patch, or MR_NONE */
} cutter;

static void
reach(cutter *c, uint32_t v, unsigned level)
{
	if (c->level[v] > 0)
		return;
	MR_RESERVE(c->ctx, c->queue, c->queued, 1, &c->room);
	c->level[v] = (uint8_t)level;
	c->queue[c->queued++] = v;
}

/* One ring after the other; the last one is that of the outer corners of the rim's faces. */
static void
flood(cutter *c, const uint32_t *vertex, size_t n)
{
	const mr_dyn *d = c->d;

	for (size_t i = 0; i < n; i++)
		reach(c, vertex[i], 1);
	for (size_t i = 0; i < c->queued && c->level[c->queue[i]] <= c->rings + 1; i++) {
		uint32_t v = c->queue[i], h = d->out[v];
		do {
			reach(c, mr_dyn_to(d, h), c->level[v] + 1u);
			reach(c, mr_dyn_apex(d, h), c->level[v] + 1u);
			h = mr_dyn_ccw(d, h);
		} while (h != MR_NONE && h != d->out[v]);
	}
}

/* Numbers the faces that have a vertex within the rings. */
static void
number_faces(cutter *c, mr_patch *p)
{
	const mr_dyn *d = c->d;
	size_t room = 0;

	for (size_t i = 0; i < c->queued && c->level[c->queue[i]] <= c->rings + 1; i++) {
		uint32_t h = d->out[c->queue[i]];
		do {
			if (c->local[h / 3] == MR_NONE) {
				MR_RESERVE(c->ctx, p->face, p->nf, 1, &room);
				c->local[h / 3] = (uint32_t)p->nf;
				p->face[p->nf++] = h / 3;
			}
			h = mr_dyn_ccw(d, h);
		} while (h != MR_NONE && h != d->out[c->queue[i]]);
	}
}

/* The half-edge of the patch for one of the mesh; MR_NONE where it is not in. */
static uint32_t
inside(const cutter *c, uint32_t h)
{
	return h == MR_NONE || c->local[h / 3] == MR_NONE ? MR_NONE : 3 * c->local[h / 3] + h % 3;
}

static mr_status
copy_faces(const cutter *c, mr_patch *p)
{
	for (size_t f = 0; f < p->nf; f++)
		for (uint32_t i = 0; i < 3; i++) {
			uint32_t h = 3 * p->face[f] + i, k = (uint32_t)(3 * f) + i;
			p->d.v[k] = MR_NONE;
			p->d.twin[k] = inside(c, c->d->twin[h]);
			if (mr_dyn_on_curve(c->d, h)) {
				MR_TRY(mr_curves_reserve(c->ctx, &p->d.curves, 1));
				mr_curves_set(&p->d.curves, k, mr_curves_get(&c->d->curves, h));
			}
		}
	p->d.nf = p->nf;
	return MR_OK;
}

static void
copy_vertex(const cutter *c, mr_patch *p, uint32_t from, uint32_t to)
{
	const mr_dyn *d = c->d;

	p->of[to] = from;
	p->d.p[to] = d->p[from];
	p->d.at[to] = d->at[from];
	p->d.kind[to] = d->kind[from];
	if (d->scale)
		p->d.scale[to] = d->scale[from];
	if (c->level[from] > c->rings) {
		p->d.kind[to] = MR_RIM;
		p->d.at[to] = d->kind[from] == MR_SMOOTH ? 3 * d->at[from] : d->at[from];
	}
}

/* Each fan of faces around a vertex gets a vertex of its own: on the rim there may be several. */
static void
copy_vertices(const cutter *c, mr_patch *p)
{
	mr_dyn *d = &p->d;

	for (uint32_t k = 0; k < 3 * d->nf; k++) {
		uint32_t v = (uint32_t)d->nv, h = k;
		if (d->v[k] != MR_NONE)
			continue;
		while (d->twin[h] != MR_NONE && mr_he_next(d->twin[h]) != k)
			h = mr_he_next(d->twin[h]); /* to the first of an open fan */
		if (d->twin[h] != MR_NONE)
			h = k;
		d->out[v] = h;
		copy_vertex(c, p, c->d->v[3 * p->face[k / 3] + k % 3], v);
		do {
			d->v[h] = v;
			h = mr_dyn_ccw(d, h);
		} while (h != MR_NONE && h != d->out[v]);
		d->nv++;
	}
	p->nv = d->nv;
}

mr_status
mr_patch_cut(mr_ctx *ctx, const mr_dyn *d, const uint32_t *vertex, size_t n, unsigned rings, mr_patch *patch)
{
	cutter c = { ctx, d, rings, MR_NEW_ZERO(ctx, d->nv, uint8_t), NULL, 0, 0,
		MR_NEW(ctx, d->nf, uint32_t) };
	mr_patch p = { .d = { .free_v = MR_NONE, .free_f = MR_NONE } };

	memset(c.local, 0xff, d->nf * sizeof *c.local);
	flood(&c, vertex, n);
	number_faces(&c, &p);
	mr_dyn_room_v(ctx, &p.d, 3 * p.nf + 32); /* what is not used costs no memory */
	MR_TRY(mr_dyn_room_f(ctx, &p.d, 2 * p.nf + 32));
	p.of = MR_NEW(ctx, 3 * p.nf, uint32_t);
	if (d->scale)
		p.d.scale = MR_NEW(ctx, p.d.room_v, float);
	MR_TRY(copy_faces(&c, &p));
	copy_vertices(&c, &p);
	*patch = p;
	return MR_OK;
}

typedef struct sewer {
	mr_ctx *ctx;
	mr_dyn *d;
	const mr_patch *patch;
	uint32_t *vertex, *face; /* of the patch: their numbers in the mesh */
	uint32_t *outer; /* of each half-edge of the patch: the twin that it will have beyond the rim */
} sewer;

/* The half-edge from u to v; there is one. */
static uint32_t
half_edge(const mr_dyn *d, uint32_t u, uint32_t v)
{
	uint32_t h = d->out[u];

	while (mr_dyn_to(d, h) != v)
		h = mr_dyn_ccw(d, h);
	return h;
}

/* True where the mesh may go on beyond k. */
static bool
leads_out(const mr_dyn *d, uint32_t k)
{
	return !mr_dyn_face_dead(d, k / 3) && d->twin[k] == MR_NONE && mr_dyn_on_rim(d, k);
}

static void
find_seam(const sewer *w)
{
	const mr_dyn *p = &w->patch->d;
	const uint32_t *of = w->patch->of;

	for (uint32_t k = 0; k < 3 * p->nf; k++)
		w->outer[k] = leads_out(p, k) ? w->d->twin[half_edge(w->d, of[p->v[k]], of[mr_dyn_to(p, k)])]
		                              : MR_NONE;
}

static void
take_out(const sewer *w)
{
	mr_dyn *d = w->d;

	for (size_t i = 0; i < w->patch->nf; i++)
		mr_dyn_remove_face(d, w->patch->face[i]);
	for (uint32_t v = 0; v < w->patch->nv; v++)
		if (w->patch->d.kind[v] != MR_RIM)
			mr_dyn_remove_vertex(d, w->patch->of[v]);
}

static void
put_vertices(const sewer *w)
{
	const mr_dyn *p = &w->patch->d;
	mr_dyn *d = w->d;

	for (uint32_t v = 0; v < p->nv; v++) {
		if (p->kind[v] == MR_DEAD)
			continue;
		if (p->kind[v] == MR_RIM) {
			w->vertex[v] = w->patch->of[v];
			continue;
		}
		mr_dyn_add_vertex(w->ctx, d, &w->vertex[v]);
		d->p[w->vertex[v]] = p->p[v];
		d->at[w->vertex[v]] = p->at[v];
		d->kind[w->vertex[v]] = p->kind[v];
		if (d->scale)
			d->scale[w->vertex[v]] = p->scale[v];
	}
}

static uint32_t
renumbered(const sewer *w, uint32_t k)
{
	return k == MR_NONE ? MR_NONE : 3 * w->face[k / 3] + k % 3;
}

static mr_status
put_faces(const sewer *w)
{
	const mr_dyn *p = &w->patch->d;
	mr_dyn *d = w->d;

	for (size_t f = 0; f < p->nf; f++)
		if (!mr_dyn_face_dead(p, f))
			MR_TRY(mr_dyn_add_face(w->ctx, d, &w->face[f]));
	for (uint32_t k = 0; k < 3 * p->nf; k++) {
		uint32_t h;
		if (mr_dyn_face_dead(p, k / 3))
			continue;
		h = renumbered(w, k);
		d->v[h] = w->vertex[p->v[k]];
		d->twin[h] = renumbered(w, p->twin[k]);
		if (w->outer[k] != MR_NONE) {
			d->twin[h] = w->outer[k];
			d->twin[w->outer[k]] = h;
		}
		if (mr_dyn_on_curve(p, k))
			MR_TRY(mr_curves_reserve(w->ctx, &d->curves, 1));
		mr_curves_set(&d->curves, h, mr_curves_get(&p->curves, k));
	}
	return MR_OK;
}

mr_status
mr_patch_paste(mr_ctx *ctx, mr_dyn *d, const mr_patch *patch)
{
	const mr_dyn *p = &patch->d;
	sewer w = { ctx, d, patch, MR_NEW(ctx, p->nv, uint32_t), MR_NEW(ctx, p->nf, uint32_t),
		MR_NEW(ctx, 3 * p->nf, uint32_t) };

	find_seam(&w);
	take_out(&w);
	put_vertices(&w);
	MR_TRY(put_faces(&w));
	for (uint32_t v = 0; v < p->nv; v++)
		if (p->kind[v] != MR_DEAD)
			mr_dyn_keep_out(d, w.vertex[v], renumbered(&w, p->out[v]));
	return MR_OK;
}
