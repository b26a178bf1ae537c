/* A file without a name by O_TMPFILE, named by linkat(2), or under a random name, renamed. */
#define _GNU_SOURCE /* O_TMPFILE, getentropy */

#include "base/outfile.h"

#include <errno.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

enum { LINKS = 40, TRIES = 100 };

static mr_status
failed(mr_ctx *ctx, const char *path, const char *what)
{
	return mr_fail(ctx, MR_EIO, "%s: %s: %s", path, what, strerror(errno));
}

static mr_status
no_memory(mr_ctx *ctx, const char *path)
{
	return mr_fail(ctx, MR_EMEM, "%s: no memory for its name", path);
}

/* The bytes of the folder's name, with the slash. */
static size_t
folder(const char *path)
{
	const char *slash = strrchr(path, '/');

	return slash ? (size_t)(slash + 1 - path) : 0;
}

/* The folder of `path` and `name`; the caller's to free, NULL where there is no memory. */
static char *
beside(const char *path, const char *name)
{
	size_t n = folder(path), m = strlen(name) + 1;
	char *both = malloc(n + m);

	if (!both)
		return NULL;
	memcpy(both, path, n);
	memcpy(both + n, name, m);
	return both;
}

/* Where the name leads, whether something is there or not: a link keeps pointing to it. */
static mr_status
follow(mr_ctx *ctx, const char *path, char **target)
{
	char *at = strdup(path), to[4096];

	for (int i = 0; at && i < LINKS; i++) {
		ssize_t n = readlink(at, to, sizeof to - 1);
		char *next;
		if (n < 0) {
			*target = at;
			return MR_OK;
		}
		to[n] = '\0';
		next = *to == '/' ? strdup(to) : beside(at, to);
		free(at);
		at = next;
	}
	if (!at)
		return no_memory(ctx, path);
	free(at);
	errno = ELOOP;
	return failed(ctx, path, "cannot create");
}

/* Another name in the target's folder: short, whatever the target's length. */
static mr_status
random_name(mr_ctx *ctx, mr_outfile *f)
{
	unsigned char r[8];
	char name[32];

	if (getentropy(r, sizeof r))
		return failed(ctx, f->path, "cannot create");
	snprintf(name, sizeof name, "mr-%02x%02x%02x%02x%02x%02x%02x%02x~", r[0], r[1], r[2], r[3], r[4],
	    r[5], r[6], r[7]);
	free(f->temporary);
	f->temporary = beside(f->target, name);
	return f->temporary ? MR_OK : no_memory(ctx, f->path);
}

/*
 * Makes the file appear under a random name by `make`, which is 0 where it did.  The name is told before
 * there is such a file: an interrupt between the two finds nothing to remove.
 */
static mr_status
appear(mr_ctx *ctx, mr_outfile *f, int (*make)(mr_outfile *f))
{
	for (int i = 0; i < TRIES; i++) {
		int error;
		MR_TRY(random_name(ctx, f));
		mr_unfinished(ctx, f->temporary, true);
		if (make(f) == 0)
			return MR_OK;
		error = errno;
		mr_unfinished(ctx, f->temporary, false);
		free(f->temporary);
		f->temporary = NULL;
		errno = error;
		if (error != EEXIST)
			break;
	}
	return failed(ctx, f->path, "cannot create");
}

static int
create(mr_outfile *f)
{
	f->fd = open(f->temporary, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
	return f->fd < 0;
}

#ifdef O_TMPFILE
/* By what a file without a name is linked. */
static int
link_to(const mr_outfile *f, const char *name)
{
	char from[32];

	snprintf(from, sizeof from, "/proc/self/fd/%d", f->fd);
	return linkat(AT_FDCWD, from, AT_FDCWD, name, AT_SYMLINK_FOLLOW);
}

static int
link_to_temporary(mr_outfile *f)
{
	return link_to(f, f->temporary);
}

static bool
open_nameless(mr_outfile *f)
{
	char *where = beside(f->target, ".");

	f->fd = where && access("/proc/self/fd", X_OK) == 0
	            ? open(where, O_WRONLY | O_TMPFILE | O_CLOEXEC, 0666)
	            : -1;
	free(where);
	return f->fd >= 0;
}

/* What has no name gets the target's where nothing is there, else one by which it can be renamed. */
static mr_status
give_first_name(mr_ctx *ctx, mr_outfile *f)
{
	if (f->temporary || link_to(f, f->target) == 0)
		return MR_OK;
	if (errno != EEXIST)
		return failed(ctx, f->path, "cannot give it its name");
	return appear(ctx, f, link_to_temporary);
}
#else
static bool
open_nameless(mr_outfile *f)
{
	(void)f;
	return false;
}

static mr_status
give_first_name(mr_ctx *ctx, mr_outfile *f)
{
	(void)ctx;
	(void)f;
	return MR_OK;
}
#endif

static void
forget(mr_ctx *ctx, mr_outfile *f)
{
	if (f->temporary)
		mr_unfinished(ctx, f->temporary, false);
	free(f->temporary);
	f->temporary = NULL;
}

static mr_status
give_name(mr_ctx *ctx, mr_outfile *f)
{
	MR_TRY(give_first_name(ctx, f));
	if (f->temporary && rename(f->temporary, f->target))
		return failed(ctx, f->path, "cannot rename into place");
	forget(ctx, f);
	return MR_OK;
}

/* Who owns what is there, and may do what with it, stays so where that can be; what runs as its owner does
 * not as another. */
static void
keep_mode(mr_ctx *ctx, const struct stat *old, mr_outfile *f)
{
	bool owned = fchown(f->fd, old->st_uid, old->st_gid) == 0;

	if (fchmod(f->fd, old->st_mode & (owned ? 07777 : 00777)))
		mr_note(ctx, "%s: cannot keep its mode: %s", f->path, strerror(errno));
}

/* old: what is there; NULL: nothing. */
static mr_status
open_file(mr_ctx *ctx, const struct stat *old, mr_outfile *f)
{
	if (old && access(f->path, W_OK))
		return failed(ctx, f->path, "cannot write");
	MR_TRY(follow(ctx, f->path, &f->target));
	MR_TRY(mr_permit(ctx, f->target, true));
	if (!open_nameless(f))
		MR_TRY(appear(ctx, f, create));
	if (old)
		keep_mode(ctx, old, f);
	return MR_OK;
}

static mr_status
open_directly(mr_ctx *ctx, mr_outfile *f)
{
	f->fd = open(f->path, O_WRONLY | O_CLOEXEC);
	return f->fd < 0 ? failed(ctx, f->path, "cannot open") : MR_OK;
}

/* Another descriptor of standard output, where that is the file: who writes to it goes on there; else -1. */
static int
standard_output(const struct stat *file)
{
	struct stat out;

	return fstat(STDOUT_FILENO, &out) == 0 && out.st_dev == file->st_dev && out.st_ino == file->st_ino
	           ? fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0)
	           : -1;
}

mr_status
mr_outfile_open(mr_ctx *ctx, const char *path, mr_outfile *f)
{
	mr_outfile new = { .fd = -1, .path = strdup(path) };
	struct stat st;
	bool there = stat(path, &st) == 0;
	int through = there ? standard_output(&st) : -1;
	mr_status status = MR_OK;

	if (!new.path)
		return no_memory(ctx, path);
	if (through >= 0)
		new.fd = through;
	else if (there && !S_ISREG(st.st_mode))
		status = open_directly(ctx, &new);
	else
		status = open_file(ctx, there ? &st : NULL, &new);
	if (status < 0)
		mr_outfile_drop(ctx, &new);
	else
		*f = new;
	return status;
}

mr_status
mr_sync(mr_ctx *ctx, int fd, const char *path)
{
	return fsync(fd) && errno != EINVAL && errno != ENOTSUP && errno != EROFS
	           ? failed(ctx, path, "cannot bring it to the disk")
	           : MR_OK;
}

/* Of the name that it has now. */
static mr_status
sync_folder(mr_ctx *ctx, const mr_outfile *f)
{
	char *where = beside(f->target, ".");
	int fd = where ? open(where, O_RDONLY | O_DIRECTORY | O_CLOEXEC) : -1;
	mr_status status = fd < 0 ? failed(ctx, f->path, "cannot bring its folder to the disk")
	                          : mr_sync(ctx, fd, f->path);

	if (fd >= 0)
		close(fd);
	free(where);
	return status;
}

static mr_status
finish(mr_ctx *ctx, mr_outfile *f)
{
	int copy = dup(f->fd);

	if (copy < 0 || close(copy)) /* where errors of writing may come as late as this: NFS */
		return failed(ctx, f->path, "cannot close");
	if (ctx->sync)
		MR_TRY(mr_sync(ctx, f->fd, f->path));
	if (!f->target)
		return MR_OK;
	MR_TRY(give_name(ctx, f));
	return ctx->sync ? sync_folder(ctx, f) : MR_OK;
}

mr_status
mr_outfile_keep(mr_ctx *ctx, mr_outfile *f)
{
	mr_status status = f->path ? finish(ctx, f) : MR_OK;

	mr_outfile_drop(ctx, f);
	return status;
}

void
mr_outfile_drop(mr_ctx *ctx, mr_outfile *f)
{
	if (f->path && f->fd >= 0)
		close(f->fd);
	if (f->temporary)
		unlink(f->temporary);
	forget(ctx, f);
	free(f->target);
	free(f->path);
	*f = (mr_outfile){ 0 };
}
