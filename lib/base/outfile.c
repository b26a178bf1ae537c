/* A file under a random name beside its place, renamed at the end. */
#define _DEFAULT_SOURCE /* getentropy, realpath */

#include "base/outfile.h"

#include <errno.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

static mr_status
failed(mr_ctx *ctx, const char *path, const char *what)
{
	return mr_fail(ctx, MR_EIO, "%s: %s: %s", path, what, strerror(errno));
}

/* Another name in the target's folder: short, whatever the target's length. */
static char *
random_name(const char *target)
{
	const char *slash = strrchr(target, '/');
	size_t folder = slash ? (size_t)(slash + 1 - target) : 0, room = folder + 32;
	char *name = malloc(room);
	unsigned long long r;

	if (name && getentropy(&r, sizeof r) == 0) {
		snprintf(name, room, "%.*smr-%016llx~", (int)folder, target, r);
		return name;
	}
	free(name);
	return NULL;
}

static void
forget(mr_ctx *ctx, mr_outfile *f)
{
	if (f->temporary)
		mr_unfinished(ctx, f->temporary, false);
	free(f->temporary);
	f->temporary = NULL;
}

/* Keeps owner and permissions of the old file as far as possible; a set-user bit goes if the owner
 * changes. */
static void
keep_mode(mr_ctx *ctx, const struct stat *old, mr_outfile *f)
{
	bool owned = fchown(f->fd, old->st_uid, old->st_gid) == 0;

	if (fchmod(f->fd, old->st_mode & (owned ? 07777 : 00777)))
		mr_note(ctx, "%s: cannot keep its mode: %s", f->path, strerror(errno));
}

/* old: the present file; NULL: none.  The name is registered before the file exists: an interrupt between the
 * two finds nothing to remove. */
static mr_status
open_file(mr_ctx *ctx, const struct stat *old, bool link, mr_outfile *f)
{
	if (old && access(f->path, W_OK))
		return failed(ctx, f->path, "cannot write");
	f->target = link ? realpath(f->path, NULL) : strdup(f->path);
	if (!f->target)
		return failed(ctx, f->path, "cannot create");
	MR_TRY(mr_permit(ctx, f->target, true));
	f->temporary = random_name(f->target);
	if (!f->temporary)
		return failed(ctx, f->path, "cannot create");
	mr_unfinished(ctx, f->temporary, true);
	f->fd = open(f->temporary, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
	if (f->fd < 0)
		return failed(ctx, f->path, "cannot create");
	if (old)
		keep_mode(ctx, old, f);
	return MR_OK;
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
	struct stat st, own;
	bool there = stat(path, &st) == 0, link = lstat(path, &own) == 0 && S_ISLNK(own.st_mode);
	int through = there ? standard_output(&st) : -1;
	mr_status status = MR_OK;

	if (!new.path)
		return mr_fail(ctx, MR_EMEM, "%s: no memory for its name", path);
	if (through >= 0)
		new.fd = through;
	else if (there ? S_ISREG(st.st_mode) : !link)
		status = open_file(ctx, there ? &st : NULL, link, &new);
	else if ((new.fd = open(path, O_WRONLY | O_CREAT | O_CLOEXEC, 0666)) < 0)
		status = failed(ctx, path,
		    "cannot create"); /* a device, a pipe, or what a link leads to where nothing is */
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

/* Cuts f->target to its folder. */
static mr_status
sync_folder(mr_ctx *ctx, const mr_outfile *f)
{
	char *slash = strrchr(f->target, '/');
	int fd = open(slash ? (slash[1] = '\0', f->target) : ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
	mr_status status = fd < 0 ? failed(ctx, f->path, "cannot bring its folder to the disk")
	                          : mr_sync(ctx, fd, f->path);

	if (fd >= 0)
		close(fd);
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
	if (rename(f->temporary, f->target))
		return failed(ctx, f->path, "cannot rename into place");
	forget(ctx, f);
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
