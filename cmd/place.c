/* Names and descriptors that lead to one file, or to a model. */
#include "place.h"

#include "formats/suffix.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

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

/* The one name of a file, there or not yet; the caller's to free, NULL where its folder is not there. */
static char *
whole_name(const char *path)
{
	const char *last = last_part(path);
	char *name = realpath(path, NULL), *folder, *in;
	size_t n, m = strlen(last) + 1;

	if (name)
		return name;
	folder = last == path ? strdup(".") : strndup(path, (size_t)(last - path));
	in = folder ? realpath(folder, NULL) : NULL;
	free(folder);
	n = in ? strlen(in) : 0;
	name = in ? malloc(n + 1 + m) : NULL;
	if (name) {
		memcpy(name, in, n);
		name[n] = '/';
		memcpy(name + n + 1, last, m);
	}
	free(in);
	return name;
}

static mr_status
claim(mr_ctx *ctx, place_guard *g, const char *path, const char *name, bool writes)
{
	if (mr_string_set_has(&g->written, name))
		return mr_fail(ctx, MR_EUSAGE, "%s: this command writes that file%s", path,
		    writes ? " already" : ", and would read it");
	if (writes && mr_string_set_has(&g->read, name))
		return mr_fail(ctx, MR_EUSAGE, "%s: this command reads that file, which would be lost", path);
	return mr_string_set_add(writes ? &g->written : &g->read, name);
}

void
place_guard_free(place_guard *g)
{
	mr_string_set_free(&g->read);
	mr_string_set_free(&g->written);
}

mr_status
place_claim(mr_ctx *ctx, place_guard *g, const char *path, bool writes)
{
	bool stdio = !writes && !strcmp(path, "-");
	char *name = stdio ? NULL : whole_name(path);
	mr_status status = name ? claim(ctx, g, path, name, writes) : MR_OK;

	free(name);
	return status;
}

bool
place_is_model(const char *path)
{
	static const char magic[] = "mrmesh1\n";
	char first[sizeof magic - 1];
	struct stat st;
	bool file = mr_suffix_format(path) && stat(path, &st) == 0 && S_ISREG(st.st_mode), model;
	int fd = file ? open(path, O_RDONLY) : -1;

	if (fd < 0)
		return false;
	model = read(fd, first, sizeof first) != sizeof first || memcmp(first, magic, sizeof first) != 0;
	close(fd);
	return model;
}
