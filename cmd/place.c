/* Names and descriptors that lead to one file. */
#include "place.h"

#include <sys/stat.h>

static bool
is_device(const struct stat *s)
{
	return S_ISCHR(s->st_mode) || S_ISBLK(s->st_mode);
}

static bool
same(const struct stat *a, const struct stat *b)
{
	return a->st_dev == b->st_dev && a->st_ino == b->st_ino && !is_device(a);
}

/* The folder that a name stands in; false where there is none such. */
static bool
folder_of(const char *name, struct stat *s)
{
	const char *slash = strrchr(name, '/');
	char *folder = slash ? strndup(name, (size_t)(slash - name) + 1) : NULL;
	bool good = (folder || !slash) && stat(folder ? folder : ".", s) == 0;

	free(folder);
	return good;
}

static const char *
last_part(const char *name)
{
	const char *slash = strrchr(name, '/');

	return slash ? slash + 1 : name;
}

bool
place_same(const char *a, const char *b)
{
	struct stat x, y;
	bool there = stat(a, &x) == 0;

	if (there != (stat(b, &y) == 0))
		return false;
	if (there)
		return same(&x, &y);
	return !strcmp(last_part(a), last_part(b)) && folder_of(a, &x) && folder_of(b, &y) && same(&x, &y);
}

bool
place_is(int fd, const char *name)
{
	struct stat x, y;

	return fstat(fd, &x) == 0 && stat(name, &y) == 0 && same(&x, &y);
}
