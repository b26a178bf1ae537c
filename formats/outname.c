/* A pattern is checked first, then filled in. */
#include "formats/outname.h"

#include <strings.h>
#include <sys/stat.h>

/* Reads "%05d" from behind the per cent: its width, and the first byte behind it; NULL where it is none. */
static const char *
number_format(const char *s, int *width)
{
	int w = 0;

	if (*s == '0') {
		s++;
		if (*s < '1' || *s > '9')
			return NULL;
		w = *s++ - '0';
	}
	*width = w;
	return *s == 'd' ? s + 1 : NULL;
}

/* What is left of a name without folders. */
static char *
file_part(mr_ctx *ctx, const char *frame)
{
	char *name = mr_format(ctx, "%s", frame);

	for (char *s = name; s && *s; s++)
		if (*s == '/')
			*s = '_';
	return name;
}

mr_status
mr_outname(mr_ctx *ctx, const char *pattern, const char *frame, uint64_t number, char **name)
{
	char *made = mr_format(ctx, "%s", ""), *file = file_part(ctx, frame);

	if (!file)
		return MR_EMEM;
	for (const char *s = pattern; made && *s;) {
		size_t plain = strcspn(s, "%");
		const char *after;
		int width;

		made = mr_format(ctx, "%s%.*s", made, (int)plain, s);
		s += plain;
		if (!made || !*s)
			break;
		if (s[1] == '%') {
			made = mr_format(ctx, "%s%%", made);
			s += 2;
		} else if (s[1] == 's') {
			made = mr_format(ctx, "%s%s", made, file);
			s += 2;
		} else if ((after = number_format(s + 1, &width))) {
			made = mr_format(ctx, "%s%0*llu", made, width, (unsigned long long)number);
			s = after;
		} else {
			return mr_fail(
			    ctx, MR_EUSAGE, "%s: only %%s, %%d, %%03d and %%%% are known in a name", pattern);
		}
	}
	if (made && !strcmp(made, "-") && strcmp(pattern, "-") != 0)
		made = mr_format(ctx, "./-"); /* a frame of that name is no standard output */
	if (!made)
		return MR_EMEM;
	*name = made;
	return MR_OK;
}

/* Where the name is, or is to be (FNV-1a, open addresses). */
static char **
slot_of(const mr_outnames *n, const char *name)
{
	uint64_t h = 0xcbf29ce484222325u;
	size_t i;

	for (const char *s = name; *s; s++)
		h = (h ^ (unsigned char)*s) * 0x100000001b3u;
	for (i = h & n->mask; n->slot[i] && strcmp(n->slot[i], name) != 0;)
		i = (i + 1) & n->mask;
	return &n->slot[i];
}

static mr_status
make_room(mr_outnames *n)
{
	mr_outnames old = *n;

	if (n->slot && 2 * n->count <= n->mask)
		return MR_OK;
	n->mask = old.slot ? 2 * old.mask + 1 : 63;
	n->slot = MR_NEW_ZERO(&n->keep, n->mask + 1, char *);
	if (!n->slot)
		return MR_EMEM;
	for (size_t i = 0; old.slot && i <= old.mask; i++)
		if (old.slot[i])
			*slot_of(n, old.slot[i]) = old.slot[i];
	return MR_OK;
}

mr_status
mr_outname_once(
    mr_ctx *ctx, mr_outnames *given, const char *pattern, const char *frame, uint64_t number, char **name)
{
	char **slot;

	MR_TRY(mr_outname(ctx, pattern, frame, number, name));
	MR_TRY(make_room(given));
	slot = slot_of(given, *name);
	if (*slot)
		return mr_fail(ctx, MR_EUSAGE,
		    "%s holds an earlier frame: put %%d, the number of the frame, into the name", *name);
	*slot = mr_format(&given->keep, "%s", *name);
	given->count++;
	return *slot ? MR_OK : MR_EMEM;
}

bool
mr_outname_varies(const char *pattern)
{
	for (const char *s = strchr(pattern, '%'); s && s[1]; s = strchr(s + 2, '%'))
		if (s[1] != '%')
			return true;
	return false;
}

bool
mr_outname_suits(const char *path, const char *suffix)
{
	const char *end = strrchr(path, '.');
	struct stat st;

	return !strcmp(path, "-") || (end && !strcasecmp(end, suffix)) ||
	       (stat(path, &st) == 0 && !S_ISREG(st.st_mode));
}
