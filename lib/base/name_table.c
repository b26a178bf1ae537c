/* Names in a hash table, by FNV-1a. */
#include "base/name_table.h"

#include "base/memory.h"

#include <string.h>

static uint64_t
hash_of(const char *s, size_t n)
{
	uint64_t h = 0xcbf29ce484222325u;

	for (size_t i = 0; i < n; i++)
		h = (h ^ (unsigned char)s[i]) * 0x100000001b3u;
	return h ^ h >> 29;
}

/* Bytes of name i. */
static size_t
length_of(const mr_name_table *n, size_t i)
{
	return (i + 1 < n->count ? n->start[i + 1] : n->bytes) - n->start[i] - 1;
}

/* The slot of the name, or the empty one where it belongs. */
static uint32_t *
find_slot(const mr_name_table *n, const char *s, size_t bytes)
{
	size_t at = hash_of(s, bytes) & (n->slots - 1);

	for (;; at = (at + 1) & (n->slots - 1)) {
		uint32_t i = n->slot[at];
		if (i == 0 || (length_of(n, i - 1) == bytes && !memcmp(n->text + n->start[i - 1], s, bytes)))
			return &n->slot[at];
	}
}

/* Unless an earlier one has the slot. */
static void
put_in_slot(mr_name_table *n, size_t i)
{
	uint32_t *slot = find_slot(n, n->text + n->start[i], length_of(n, i));

	if (*slot == 0)
		*slot = (uint32_t)i + 1;
}

static void
widen_slots(mr_ctx *ctx, mr_name_table *n)
{
	size_t slots = n->slots ? 4 * n->slots : 64;
	uint32_t *slot = MR_NEW_ZERO(ctx, slots, uint32_t);

	n->slot = slot;
	n->slots = slots;
	for (size_t i = 0; i < n->count; i++)
		put_in_slot(n, i);
}

uint32_t
mr_name_add(mr_ctx *ctx, mr_name_table *n, const char *name, size_t bytes)
{
	uint32_t number = (uint32_t)n->count;

	if (2 * n->count >= n->slots)
		widen_slots(ctx, n);
	MR_RESERVE(ctx, n->text, n->bytes, bytes + 1, &n->room);
	MR_RESERVE(ctx, n->start, n->count, 1, &n->start_room);
	memcpy(n->text + n->bytes, name, bytes);
	n->text[n->bytes + bytes] = '\n';
	n->start[n->count++] = n->bytes;
	n->bytes += bytes + 1;
	put_in_slot(n, number);
	return number;
}

uint32_t
mr_name_number(mr_ctx *ctx, mr_name_table *n, const char *name, size_t bytes)
{
	uint32_t found = n->count ? *find_slot(n, name, bytes) : 0;

	return found ? found - 1 : mr_name_add(ctx, n, name, bytes);
}

void
mr_string_set_free(mr_string_set *set)
{
	mr_ctx_free(&set->keep);
	*set = (mr_string_set){ 0 };
}

bool
mr_string_set_has(const mr_string_set *set, const char *text)
{
	return set->names.count && *find_slot(&set->names, text, strlen(text));
}

void
mr_string_set_add(mr_ctx *ctx, mr_string_set *set, const char *text)
{
	mr_name_number(mr_keep(ctx, &set->keep), &set->names, text, strlen(text));
}
