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
	*name = made;
	return MR_OK;
}

mr_status
mr_outname_once(
    mr_ctx *ctx, mr_string_set *given, const char *pattern, const char *frame, uint64_t number, char **name)
{
	MR_TRY(mr_outname(ctx, pattern, frame, number, name));
	if (mr_string_set_has(given, *name) && !strcmp(*name, "-"))
		return mr_fail(ctx, MR_EUSAGE,
		    "stdout takes one frame, not frame %llu too: name a file, with %%d in it",
		    (unsigned long long)number);
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
