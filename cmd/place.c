/* Names and descriptors that lead to one file, or to a model. */
#include "place.h"

#include "formats/filename.h"
#include "stream/record.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

static bool
is_device(const struct stat *s)
{
	return S_ISCHR(s->st_mode) || S_ISBLK(s->st_mode);
}

bool
place_is(int fd, const char *name)
{
	struct stat x, y;

	return fstat(fd, &x) == 0 && stat(name, &y) == 0 && x.st_dev == y.st_dev && x.st_ino == y.st_ino &&
	       !is_device(&x);
}

/* Two names of a file: the file itself, and its place, which may not exist yet; empty if there is none. */
typedef struct keys {
	const char *there, *place;
} keys;

static void
find_keys(mr_ctx *ctx, const char *path, keys *k)
{
	const char *name = mr_file_name(path);
	struct stat s;

	if (stat(path, &s) == 0 && !is_device(&s))
		k->there = mr_format(
		    ctx, "%llu:%llu", (unsigned long long)s.st_dev, (unsigned long long)s.st_ino);
	if (stat(name > path ? mr_format(ctx, "%.*s", (int)(name - path), path) : ".", &s) == 0)
		k->place = mr_format(
		    ctx, "%llu:%llu/%s", (unsigned long long)s.st_dev, (unsigned long long)s.st_ino, name);
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

/* The kind of a regular file; NOTHING: empty, not there, or not to be read. */
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
	keys k = { "", "" };

	if (!writes && place_is_dash(path))
		return MR_OK;
	find_keys(ctx, path, &k);
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
