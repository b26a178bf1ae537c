/* Suffixes by a table; a pattern is checked, then filled in. */
#include "formats/filename.h"

#include "base/text.h"

#include <strings.h>
#include <sys/stat.h>

static const struct {
	const char *suffix, *format;
} suffixes[] = { { ".glb", "glb" }, { ".gltf", "gltf" }, { ".ply", "ply" }, { ".las", "las" },
	{ ".stl", "stl" }, { ".off", "off" }, { ".pcd", "pcd" }, { ".obj", "obj" }, { ".ptx", "ptx" },
	{ ".xyz", "xyz" }, { ".txt", "xyz" }, { ".csv", "xyz" }, { ".asc", "xyz" }, { ".xyzn", "xyz" },
	{ ".xyzrgb", "xyz" }, { ".pts", "pts" }, { ".pwn", "pwn" } };

const char *
mr_file_name(const char *path)
{
	const char *slash = strrchr(path, '/');

	return slash ? slash + 1 : path;
}

bool
mr_suffix_gz(const char *path)
{
	size_t n = strlen(path);

	return n > 3 && !strcmp(path + n - 3, ".gz");
}

/* Whether a name of n bytes ends so, whatever the case. */
static bool
ends_in(const char *path, size_t n, const char *suffix)
{
	size_t k = strlen(suffix);

	return n >= k && !strncasecmp(path + n - k, suffix, k);
}

const char *
mr_suffix_format(const char *path)
{
	size_t n = strlen(path) - (mr_suffix_gz(path) ? 3 : 0);

	for (size_t i = 0; i < sizeof suffixes / sizeof *suffixes; i++)
		if (ends_in(path, n, suffixes[i].suffix))
			return suffixes[i].format;
	return NULL;
}

bool
mr_suffix_is_text(const char *path)
{
	size_t n = strlen(path);

	return ends_in(path, n, ".txt") || ends_in(path, n, ".csv") || ends_in(path, n, ".asc");
}

/* The character that a per cent and the letters after it stand for; false if they stand for none. */
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

char *
mr_path_stem(mr_ctx *ctx, const char *path)
{
	const char *name = mr_file_name(path);
	size_t n = strlen(name) - (mr_suffix_gz(name) ? 3 : 0), at = n;

	while (at > 1 && name[at - 1] != '.')
		at--;
	return mr_format(ctx, "%.*s", (int)(name - path) + (int)(at > 1 ? at - 1 : n), path);
}
