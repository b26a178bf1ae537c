/* FNV-1a, open addresses. */
#include "base/string_set.h"

#include "base/text.h"

/* Where the text is, or is to be. */
static char **
slot_of(const mr_string_set *set, const char *text)
{
	uint64_t h = 0xcbf29ce484222325u;
	size_t i;

	for (const char *s = text; *s; s++)
		h = (h ^ (unsigned char)*s) * 0x100000001b3u;
	for (i = h & set->mask; set->slot[i] && strcmp(set->slot[i], text) != 0;)
		i = (i + 1) & set->mask;
	return &set->slot[i];
}

static void
make_room(mr_string_set *set)
{
	const mr_string_set old = *set;
	size_t mask = old.slot ? 2 * old.mask + 1 : 63;
	char **slot;

	if (old.slot && 2 * old.count <= old.mask)
		return;
	slot = MR_NEW_ZERO(&set->keep, mask + 1, char *);
	set->slot = slot;
	set->mask = mask;
	for (size_t i = 0; old.slot && i <= old.mask; i++)
		if (old.slot[i])
			*slot_of(set, old.slot[i]) = old.slot[i];
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
	return set->slot && *slot_of(set, text);
}

void
mr_string_set_add(mr_ctx *ctx, mr_string_set *set, const char *text)
{
	char **slot;

	mr_keep(ctx, &set->keep);
	make_room(set);
	slot = slot_of(set, text);
	if (*slot)
		return;
	*slot = mr_format(&set->keep, "%s", text);
	set->count++;
}
