/*
 * bucket_queue.h -- a queue of numbered items by a positive float, served lowest first to within 1/128.
 *
 * Contract: an item is in the queue once at most.  In one bucket the item put last is served first, so the
 * order depends on nothing but the calls.  Every operation takes constant time.
 */
#ifndef MR_SIMPLIFY_BUCKET_QUEUE_H
#define MR_SIMPLIFY_BUCKET_QUEUE_H

#include "mesh/mesh.h"

enum { MR_BUCKETS = 1 << 15 };

typedef struct mr_buckets {
	uint32_t *next, *prev; /* of each item: its neighbours in the bucket, see bucket_queue.c */
	uint32_t *head;        /* MR_BUCKETS: the first item */
	uint64_t bits[MR_BUCKETS / 64],
	    words[MR_BUCKETS / 64 / 64]; /* buckets, and words of bits, that are not empty */
} mr_buckets;

/* An empty queue for items below n, which is at most 2^32 - 1 - MR_BUCKETS, in the arena. */
void mr_buckets_new(mr_ctx *ctx, size_t n, mr_buckets **out);

/* An empty queue for other items of the same numbers, in the arena: none is ever in both. */
mr_buckets *mr_buckets_beside(mr_ctx *ctx, const mr_buckets *b);

/* Forgets the n items of all queues that share their numbers, of which only b is used again: it is empty. */
void mr_buckets_clear(mr_buckets *b, size_t n);

/* The lowest bucket that is not empty; MR_BUCKETS where all are. */
uint32_t mr_buckets_lowest(const mr_buckets *b);

/* The bucket of a key >= 0: a greater key has no lower bucket. */
static inline uint32_t
mr_bucket_of(float key)
{
	uint32_t u;

	memcpy(&u, &key, sizeof u);
	return u >> 16;
}

static inline bool
mr_buckets_has(const mr_buckets *b, uint32_t item)
{
	return b->prev[item] != MR_NONE;
}

/* Puts an item that is not in the queue. */
void mr_buckets_put(mr_buckets *b, uint32_t item, uint32_t bucket);

/* Removes an item that may be in the queue. */
void mr_buckets_remove(mr_buckets *b, uint32_t item);

/* Takes an item of the lowest bucket that is not empty, and says which; MR_NONE where the queue is empty. */
uint32_t mr_buckets_take(mr_buckets *b, uint32_t *bucket);

#endif
