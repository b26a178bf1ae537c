/* Buckets by the leading bits of the float, as lists, and bitmaps of those that hold any. */
#include "simplify/bucket_queue.h"

/* The item before one is a number below the items'; the first of bucket k has FIRST + k; one outside MR_NONE.
 */
static const uint32_t FIRST = MR_NONE - MR_BUCKETS;

static mr_buckets *
queue_of(mr_ctx *ctx, uint32_t *next, uint32_t *prev)
{
	mr_buckets *b = MR_NEW_ZERO(ctx, 1, mr_buckets);

	b->head = MR_NEW(ctx, MR_BUCKETS, uint32_t);
	memset(b->head, 0xff, MR_BUCKETS * sizeof *b->head);
	b->next = next;
	b->prev = prev;
	return b;
}

void
mr_buckets_new(mr_ctx *ctx, size_t n, mr_buckets **out)
{
	uint32_t *next = MR_NEW(ctx, n, uint32_t), *prev = MR_NEW(ctx, n, uint32_t);

	memset(prev, 0xff, n * sizeof *prev);
	*out = queue_of(ctx, next, prev);
}

void
mr_buckets_clear(mr_buckets *b, size_t n)
{
	memset(b->prev, 0xff, n * sizeof *b->prev);
	memset(b->head, 0xff, MR_BUCKETS * sizeof *b->head);
	memset(b->bits, 0, sizeof b->bits);
	memset(b->words, 0, sizeof b->words);
}

mr_buckets *
mr_buckets_beside(mr_ctx *ctx, const mr_buckets *b)
{
	return queue_of(ctx, b->next, b->prev);
}

void
mr_buckets_put(mr_buckets *b, uint32_t item, uint32_t bucket)
{
	uint32_t first = b->head[bucket];

	b->next[item] = first;
	b->prev[item] = FIRST + bucket;
	b->head[bucket] = item;
	if (first != MR_NONE)
		b->prev[first] = item;
	b->bits[bucket / 64] |= (uint64_t)1 << bucket % 64;
	b->words[bucket / 64 / 64] |= (uint64_t)1 << bucket / 64 % 64;
}

/* Says that a bucket is empty. */
static void
clear(mr_buckets *b, uint32_t bucket)
{
	b->bits[bucket / 64] &= ~((uint64_t)1 << bucket % 64);
	if (!b->bits[bucket / 64])
		b->words[bucket / 64 / 64] &= ~((uint64_t)1 << bucket / 64 % 64);
}

void
mr_buckets_remove(mr_buckets *b, uint32_t item)
{
	uint32_t next = b->next[item], prev = b->prev[item];

	if (prev == MR_NONE)
		return;
	b->prev[item] = MR_NONE;
	if (next != MR_NONE)
		b->prev[next] = prev;
	if (prev < FIRST) {
		b->next[prev] = next;
		return;
	}
	b->head[prev - FIRST] = next;
	if (next == MR_NONE)
		clear(b, prev - FIRST);
}

/* The number of the lowest bit of x, which is not 0. */
static uint32_t
lowest(uint64_t x)
{
	return (uint32_t)__builtin_ctzll(x);
}

uint32_t
mr_buckets_lowest(const mr_buckets *b)
{
	for (uint32_t i = 0; i < MR_BUCKETS / 64 / 64; i++)
		if (b->words[i]) {
			uint32_t word = 64 * i + lowest(b->words[i]);
			return 64 * word + lowest(b->bits[word]);
		}
	return MR_BUCKETS;
}

uint32_t
mr_buckets_take(mr_buckets *b, uint32_t *bucket)
{
	uint32_t item;

	*bucket = mr_buckets_lowest(b);
	if (*bucket == MR_BUCKETS)
		return MR_NONE;
	item = b->head[*bucket];
	mr_buckets_remove(b, item);
	return item;
}
