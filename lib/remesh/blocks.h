/*
 * blocks.h -- operations on the edges of a mesh on all threads: each block of neighbours is changed by one,
 * then what lies between blocks by the caller's.
 *
 * Contract: the result is the same for any number of threads.
 */
#ifndef MR_REMESH_BLOCKS_H
#define MR_REMESH_BLOCKS_H

#include "mesh/dynmesh.h"

/* Workspace in the arena, kept from one call to the next; zeros before the first. */
typedef struct mr_edge_queue {
	uint8_t
	    *look; /* of each face, bits: half-edges that wait, and those that wait for the caller's thread */
	uint32_t *next;         /* of each face that waits, the one after it */
	uint32_t *home;         /* of each vertex the block that all its faces lie in; MR_NONE: in several */
	size_t room, home_room; /* for faces, for vertices */
} mr_edge_queue;

/* A part of the mesh, whose edges are changed one after the other. */
typedef struct mr_part {
	_Alignas(64) mr_dyn *d; /* what two threads write to lies in different lines of their caches */
	mr_edge_queue *queue;
	uint32_t block;       /* only edges with both ends at home there are changed; MR_NONE: all may be */
	uint32_t first, last; /* faces that wait */
	size_t waiting;
	bool full; /* it needs room for a split */
	mr_status status;
	size_t done[2]; /* counted by the operation */
	mr_ctx *ctx;    /* NULL: nothing may be allocated */
	mr_dyn own;     /* of a block: the mesh, with holes of its own */
} mr_part;

typedef struct mr_edge_work {
	bool (*is_due)(const void *arg, uint32_t h); /* whether half-edge h is to be looked at */
	/* Looks at it again, and changes the mesh: only what has both ends of an edge that the part owns. */
	void (*serve)(const void *arg, mr_part *part, uint32_t h);
	const void *arg;
	bool splits; /* it may split edges */
	size_t most; /* faces that there may be then */
} mr_edge_work;

/* Puts neighbours close together in memory, and divides them into blocks. */
mr_status mr_blocks_divide(mr_ctx *ctx, mr_dyn *d);

/* The workspace of mr_serve_edges without splits. */
void mr_edge_queue_reserve(mr_ctx *ctx, const mr_dyn *d, mr_edge_queue *queue);

/* Serves the half-edges that are due, and those that are asked for.  done: added to. */
mr_status
mr_serve_edges(mr_ctx *ctx, mr_dyn *d, const mr_edge_work *work, mr_edge_queue *queue, size_t done[2]);

/* Lets h wait, if it does not. */
void mr_part_ask(mr_part *p, uint32_t h);

/* Lets h wait until all blocks are done. */
void mr_part_defer(mr_part *p, uint32_t h);

/* The same for the sides of all faces around v, unless it is at home elsewhere. */
void mr_part_ask_around(mr_part *p, uint32_t v);

static inline bool
mr_part_owns(const mr_part *p, uint32_t h)
{
	const uint32_t *home = p->queue->home;

	return p->block == MR_NONE || (home[p->d->v[h]] == p->block && home[mr_dyn_to(p->d, h)] == p->block);
}

/* Whether there is room for a split, or can be. */
static inline bool
mr_part_has_room(const mr_part *p)
{
	return p->ctx || (p->d->nv < p->d->room_v && p->d->nf + 1 < p->d->room_f);
}

#endif
