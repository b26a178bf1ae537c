/* Names and descriptors that lead to one file, or to a model. */
#include "place.h"

#include "formats/suffix.h"
#include "stream/record.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

static bool
is_device(const struct stat *s)
{
	return S_ISCHR(s->st_mode) || S_ISBLK(s->st_mode);
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

bool
place_is(int fd, const char *name)
{
	struct stat x, y;

	return fstat(fd, &x) == 0 && stat(name, &y) == 0 && x.st_dev == y.st_dev && x.st_ino == y.st_ino &&
	       !is_device(&x);
}

/* Two names of a file: what is there, and its place, in which there may be nothing yet; empty where there is
 * none. */
typedef struct keys {
	char there[64], place[4200];
} keys;

static void
find_keys(const char *path, keys *k)
{
	struct stat s;

	if (stat(path, &s) == 0 && !is_device(&s))
		snprintf(k->there, sizeof k->there, "%llu:%llu", (unsigned long long)s.st_dev,
		    (unsigned long long)s.st_ino);
	if (folder_of(path, &s))
		snprintf(k->place, sizeof k->place, "%llu:%llu/%s", (unsigned long long)s.st_dev,
		    (unsigned long long)s.st_ino, mr_file_name(path));
}

static void
add(mr_ctx *ctx, mr_string_set *set, const char *key)
{
	if (*key)
		mr_string_set_add(ctx, set, key);
}

void
place_guard_free(place_guard *g)
{
	mr_string_set_free(&g->read);
	mr_string_set_free(&g->written);
}

typedef enum content { NOTHING, STREAM, OTHER } content;

/* What a regular file is; NOTHING: empty, not there, or not to be read. */
static content
content_of(const char *path)
{
	char first[MR_MAGIC_BYTES];
	struct stat st;
	bool is_file = stat(path, &st) == 0 && S_ISREG(st.st_mode);
	int fd = is_file ? open(path, O_RDONLY) : -1;
	ssize_t got;

	if (fd < 0)
		return NOTHING;
	got = read(fd, first, sizeof first);
	close(fd);
	if (got <= 0)
		return NOTHING;
	return got == sizeof first && !memcmp(first, MR_MAGIC, sizeof first) ? STREAM : OTHER;
}

bool
place_is_model(const char *path)
{
	return mr_suffix_format(path) && content_of(path) == OTHER;
}

mr_status
place_claim(mr_ctx *ctx, place_guard *g, const char *path, place_use use)
{
	bool writes = use != PLACE_READ;
	content there = writes ? content_of(path) : NOTHING;
	keys k = { 0 };

	if (!writes && place_is_dash(path))
		return MR_OK;
	find_keys(path, &k);
	if (there == STREAM && use == PLACE_WRITE)
		return mr_fail(ctx, MR_EUSAGE, "%s: that file is a stream, and would be lost", path);
	if (there == OTHER && use == PLACE_STREAM)
		return mr_fail(ctx, MR_EUSAGE, "%s: that file is no stream, and would be lost", path);
	if (mr_string_set_has(&g->written, k.there) || mr_string_set_has(&g->written, k.place))
		return mr_fail(ctx, MR_EUSAGE, "%s: this command writes that file%s", path,
		    writes ? " already" : ", and would read it");
	if (writes && mr_string_set_has(&g->read, k.there))
		return mr_fail(ctx, MR_EUSAGE, "%s: this command reads that file, which would be lost", path);
	if (writes)
		add(ctx, &g->written, k.place);
	add(ctx, writes ? &g->written : &g->read, k.there);
	return MR_OK;
}

mr_status
place_stdin_once(mr_ctx *ctx, char *const *name, size_t first, size_t end)
{
	size_t times = 0;

	for (size_t i = first; i < end; i++)
		times += place_is_dash(name[i]);
	return times < 2 ? MR_OK : mr_fail(ctx, MR_EUSAGE, "- is standard input, which can be read once");
}

mr_status
place_check_name(mr_ctx *ctx, const char *option, const char *path, place_use use)
{
	bool is_model = mr_suffix_format(path);

	if (is_model && use == PLACE_STREAM)
		return mr_fail(ctx, MR_EUSAGE,
		    "%s %s: a stream under the name of a model: mr-export writes models, .mrs is for streams",
		    option, path);
	if (is_model && !mr_suffix_is_text(path))
		return mr_fail(ctx, MR_EUSAGE, "%s %s: figures under the name of a model", option, path);
	return MR_OK;
}
