/* A pattern is checked first, then filled in. */
#include "formats/outname.h"

#include "base/text.h"

#include <strings.h>
#include <sys/stat.h>

/* What a per cent and the letters behind it stand for; false where that is nothing. */
static bool
put_part(mr_text *name, const char **at, const char *frame, uint64_t number)
{
	const char *s = *at + 1;
	int width = *s == '0' && s[1] >= '1' && s[1] <= '9' ? s[1] - '0' : 0;

	s += width ? 2 : 0;
	*at = s + 1;
	if (*s == 'd')
		mr_text_add(name, "%0*llu", width, (unsigned long long)number);
	else if (*s == '%' && !width)
		mr_text_add(name, "%%");
	else if (*s == 's' && !width)
		for (; *frame; frame++)
			mr_text_add(name, "%c", *frame == '/' ? '_' : *frame);
	else
		return false;
	return true;
}

mr_status
mr_outname(mr_ctx *ctx, const char *pattern, const char *frame, uint64_t number, char **name)
{
	mr_text made = { .ctx = ctx };

	mr_text_add(&made, "%s", ""); /* not NULL */
	for (const char *s = pattern; *s;) {
		size_t plain = strcspn(s, "%");
		mr_text_bytes(&made, s, plain);
		s += plain;
		if (*s && !put_part(&made, &s, frame, number))
			return mr_fail(
			    ctx, MR_EUSAGE, "%s: only %%s, %%d, %%03d and %%%% are known in a name", pattern);
	}
	/* a frame called - is no standard output */
	*name = !strcmp(made.s, "-") && strcmp(pattern, "-") != 0 ? mr_format(ctx, "./-") : made.s;
	return MR_OK;
}

mr_status
mr_outname_once(
    mr_ctx *ctx, mr_string_set *given, const char *pattern, const char *frame, uint64_t number, char **name)
{
	MR_TRY(mr_outname(ctx, pattern, frame, number, name));
	if (mr_string_set_has(given, *name))
		return mr_fail(ctx, MR_EUSAGE,
		    "%s holds an earlier frame than frame %llu: put %%d, the number of the frame, into the "
		    "name",
		    *name, (unsigned long long)number);
	mr_string_set_add(ctx, given, *name);
	return MR_OK;
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
