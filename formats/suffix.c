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
	{ ".coff", "off" },
	{ ".noff", "off" },
	{ ".stoff", "off" },
	{ ".cnoff", "off" },
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

bool
mr_suffix_gz(const char *path)
{
	size_t n = strlen(path);

	return n > 3 && !strcmp(path + n - 3, ".gz");
}

const char *
mr_suffix_format(const char *path)
{
	size_t n = strlen(path) - (mr_suffix_gz(path) ? 3 : 0);

	for (size_t i = 0; i < sizeof suffixes / sizeof *suffixes; i++) {
		size_t k = strlen(suffixes[i].suffix);
		if (n >= k && !strncasecmp(path + n - k, suffixes[i].suffix, k))
			return suffixes[i].format;
	}
	return NULL;
}
