/* What the end of a file's name says of its format. */
#include "formats/suffix.h"

#include <stddef.h>
#include <string.h>
#include <strings.h>

static const struct {
	const char *suffix, *format;
} suffixes[] = {
	{ ".glb", "glb" },
	{ ".gltf", "gltf" },
	{ ".ply", "ply" },
	{ ".las", "las" },
	{ ".stl", "stl" },
	{ ".off", "off" },
	{ ".pcd", "pcd" },
	{ ".obj", "obj" },
	{ ".ptx", "ptx" },
	{ ".xyz", "xyz" },
	{ ".txt", "xyz" },
	{ ".csv", "xyz" },
	{ ".asc", "xyz" },
	{ ".xyzn", "xyz" },
	{ ".xyzrgb", "xyz" },
	{ ".pts", "pts" },
	{ ".pwn", "pwn" },
};

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
