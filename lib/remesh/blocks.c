/* Each block has a queue of faces whose edges wait.  A vertex is at home in a block if all its faces lie
 * there; a thread changes edges only between vertices at home in its block. */
#include "remesh/blocks.h"

#include "base/parallel.h"

enum { BLOCK = 1 << 13, GRAIN = 2048, SIDES = 3, WAITS = (1 << SIDES) - 1 };

/* Fewer edges than that for each block are served by the caller. */
enum { FEW = 16 };

mr_status
mr_blocks_divide(mr_ctx *ctx, mr_dyn *d)
{
	MR_TRY(mr_dyn_compact(ctx, d));
	mr_dyn_order(ctx, d);
	if (!d->block)
		d->block = MR_NEW(ctx, d->room_v, uint32_t);
	for (uint32_t v = 0; v < d->nv; v++)
		d->block[v] = v / BLOCK;
	return MR_OK;
}

static void
append(mr_part *p, uint32_t f)
{
	p->queue->next[f] = MR_NONE;
	if (p->first == MR_NONE)
		p->first = f;
	else
		p->queue->next[p->last] = f;
	p->last = f;
	p->waiting++;
}

/* Room for n faces to wait. */
static void
reserve_faces(mr_ctx *ctx, mr_edge_queue *q, size_t n)
{
	size_t had = q->room;

	if (n <= had)
		return;
	MR_RESERVE(ctx, q->look, had, n - had, &q->room);
	memset(q->look + had, 0, q->room - had);
	q->next = mr_grow(ctx, q->next, had, q->room, sizeof *q->next);
}

void
mr_part_ask(mr_part *p, uint32_t h)
{
	uint32_t f = h / SIDES;

	if (f >= p->queue->room)
		reserve_faces(p->ctx, p->queue, f + 1);
	if (!(p->queue->look[f] & WAITS))
		append(p, f);
	p->queue->look[f] |= (uint8_t)(1 << h % SIDES);
}

void
mr_part_defer(mr_part *p, uint32_t h)
{
	p->queue->look[h / SIDES] |= (uint8_t)(1 << (h % SIDES + SIDES));
}

void
mr_part_ask_around(mr_part *p, uint32_t v)
{
	const mr_dyn *d = p->d;
	uint32_t h = d->out[v];

	if (p->block != MR_NONE && p->queue->home[v] != p->block)
		return;
	do {
		mr_part_ask(p, h);
		mr_part_ask(p, mr_he_next(h));
		if (d->twin[mr_he_prev(h)] == MR_NONE)
			mr_part_ask(p, mr_he_prev(h));
		h = mr_dyn_ccw(d, h);
	} while (h != MR_NONE && h != d->out[v]);
}

void
mr_edge_queue_reserve(mr_ctx *ctx, const mr_dyn *d, mr_edge_queue *queue)
{
	reserve_faces(ctx, queue, d->nf);
	MR_RESERVE(ctx, queue->home, 0, d->nv, &queue->home_room);
}

typedef struct look_job {
	const mr_dyn *d;
	const mr_edge_work *work;
	uint8_t *look;
} look_job;

static void
look_body(void *arg, size_t begin, size_t end)
{
	const look_job *j = arg;

	for (size_t f = begin; f < end; f++) {
		unsigned look = 0;
		for (uint32_t k = 0; k < SIDES && !mr_dyn_face_dead(j->d, f); k++)
			look |= (unsigned)j->work->is_due(j->work->arg, SIDES * (uint32_t)f + k)
			        << (k + SIDES);
		j->look[f] = (uint8_t)look;
	}
}

/* Queues the due edges for the rest, on all threads.  Returns their number of faces. */
static size_t
look_at_all(mr_ctx *ctx, const mr_dyn *d, const mr_edge_work *work, mr_edge_queue *q)
{
	look_job j = { d, work, NULL };
	size_t n = 0;

	mr_edge_queue_reserve(ctx, d, q);
	j.look = q->look;
	mr_parallel(ctx, d->nf, GRAIN, look_body, &j);
	memset(q->look + d->nf, 0, q->room - d->nf);
	for (size_t f = 0; f < d->nf; f++)
		n += q->look[f] != 0;
	return n;
}

/* Serves all that waits. */
static void
serve(const mr_edge_work *work, mr_part *p)
{
	while (p->first != MR_NONE && !p->full && p->status >= 0) {
		uint32_t f = p->first;
		unsigned waits = p->queue->look[f] & WAITS;
		p->first = p->queue->next[f];
		p->waiting--;
		p->queue->look[f] &= (uint8_t)~WAITS;
		for (uint32_t h = SIDES * f; h < SIDES * f + SIDES; h++, waits >>= 1) {
			if (!(waits & 1) || mr_dyn_face_dead(p->d, f))
				continue;
			if (mr_part_owns(p, h))
				work->serve(work->arg, p, h);
			else
				mr_part_defer(p, h);
		}
	}
}

typedef struct blocks {
	const mr_edge_work *work;
	mr_part *part;
	size_t n;
} blocks;

static void
serve_body(void *arg, size_t begin, size_t end)
{
	const blocks *w = arg;

	for (size_t i = begin; i < end; i++)
		serve(w->work, &w->part[i]);
}

/* The blocks in which all faces of each vertex lie. */
static void
find_homes(const mr_dyn *d, mr_edge_queue *q)
{
	memcpy(q->home, d->block, d->nv * sizeof *q->home);
	for (size_t f = 0; f < d->nf; f++) {
		const uint32_t *v = &d->v[SIDES * f];
		if (mr_dyn_face_dead(d, f) ||
		    (d->block[v[0]] == d->block[v[1]] && d->block[v[1]] == d->block[v[2]]))
			continue;
		q->home[v[0]] = q->home[v[1]] = q->home[v[2]] = MR_NONE;
	}
}

/* The block of the edges of face f, if any is in one. */
static uint32_t
block_of(const mr_dyn *d, const mr_edge_queue *q, size_t f)
{
	const uint32_t *v = &d->v[SIDES * f];

	for (int k = 0; k < SIDES; k++)
		if (q->home[v[k]] != MR_NONE)
			return q->home[v[k]];
	return MR_NONE;
}

/* Queues the due edges in their block. */
static void
distribute(const mr_dyn *d, mr_edge_queue *q, mr_part *part)
{
	for (uint32_t f = 0; f < d->nf; f++) {
		uint32_t block = q->look[f] ? block_of(d, q, f) : MR_NONE;
		if (block == MR_NONE)
			continue;
		q->look[f] >>= SIDES;
		append(&part[block], f);
	}
}

/* How many splits a block gets room for: all that wait are done in a few steps, and few holes are left. */
static size_t
room_for(const mr_part *p)
{
	return p->full && p->waiting ? p->waiting / 4 + 32 : 0;
}

static size_t
room_for_all(const blocks *w)
{
	size_t sum = 0;

	for (size_t i = 0; i < w->n; i++)
		sum += room_for(&w->part[i]);
	return sum;
}

/* Holes for each block that waits for them. */
static mr_status
lend_holes(mr_ctx *ctx, mr_dyn *d, mr_edge_queue *q, const blocks *w)
{
	size_t first = d->nv;

	MR_TRY(mr_dyn_reserve(ctx, d, room_for_all(w)));
	for (size_t i = 0; i < w->n; i++)
		if (w->part[i].full) {
			mr_dyn_take_back(d, &w->part[i].own);
			mr_dyn_lend(d, room_for(&w->part[i]), &w->part[i].own);
		}
	reserve_faces(ctx, q, d->nf);
	MR_RESERVE(ctx, q->home, first, d->nv - first, &q->home_room);
	for (size_t i = 0; i < w->n; i++) {
		mr_dyn *own = &w->part[i].own;
		mr_dyn_share(d, own);
		for (size_t v = own->nv; w->part[i].full && v < own->room_v; v++)
			q->home[v] = (uint32_t)i;
		w->part[i].full = false;
	}
	return MR_OK;
}

/* True where a block has no room, but there may be more faces. */
static bool
lacks_room(const mr_dyn *d, const blocks *w)
{
	size_t wanted = room_for_all(w);

	return wanted > 0 && d->nf + 2 * wanted < w->work->most;
}

/* Moves the edges of a block without room to the rest. */
static void
give_up(mr_edge_queue *q, const mr_part *p)
{
	for (uint32_t f = p->first; f != MR_NONE; f = q->next[f])
		q->look[f] = (uint8_t)(q->look[f] << SIDES | (q->look[f] & ~WAITS));
}

/* Serves the edges within blocks, on all threads. */
static mr_status
serve_blocks(mr_ctx *ctx, mr_dyn *d, mr_edge_queue *q, blocks *w, mr_part *rest)
{
	find_homes(d, q);
	for (size_t i = 0; i < w->n; i++) {
		mr_part *p = &w->part[i];
		*p = (mr_part){ .d = &p->own, .queue = q, .block = (uint32_t)i, .first = MR_NONE };
		p->full = w->work->splits;
		mr_dyn_lend(d, 0, &p->own);
	}
	distribute(d, q, w->part);
	if (!w->work->splits)
		mr_parallel(ctx, w->n, 1, serve_body, w);
	while (lacks_room(d, w)) {
		MR_TRY(lend_holes(ctx, d, q, w));
		mr_parallel(ctx, w->n, 1, serve_body, w);
	}
	for (size_t i = w->n; i-- > 0;) {
		give_up(q, &w->part[i]);
		mr_dyn_take_back(d, &w->part[i].own);
		for (int k = 0; k < 2; k++)
			rest->done[k] += w->part[i].done[k];
	}
	return MR_OK;
}

/* The edges left for the rest. */
static void
gather(const mr_dyn *d, mr_part *rest)
{
	for (uint32_t f = 0; f < d->nf; f++)
		if (rest->queue->look[f]) {
			rest->queue->look[f] >>= SIDES;
			append(rest, f);
		}
}

mr_status
mr_serve_edges(mr_ctx *ctx, mr_dyn *d, const mr_edge_work *work, mr_edge_queue *queue, size_t done[2])
{
	mr_part rest = { .d = d, .queue = queue, .block = MR_NONE, .first = MR_NONE, .ctx = ctx };
	size_t due = look_at_all(ctx, d, work, queue);
	blocks w = { .work = work };

	for (uint32_t v = 0; d->block && v < d->nv; v++)
		w.n = d->block[v] >= w.n ? d->block[v] + 1 : w.n;
	if (w.n > 1 && due > FEW * w.n) {
		w.part = MR_NEW(ctx, w.n, mr_part);
		MR_TRY(serve_blocks(ctx, d, queue, &w, &rest));
	}
	gather(d, &rest);
	serve(work, &rest);
	for (int k = 0; k < 2; k++)
		done[k] += rest.done[k];
	return rest.status;
}
