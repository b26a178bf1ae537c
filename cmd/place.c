/* Files beside their places, which signals remove too. */
#define _XOPEN_SOURCE 700 /* realpath */

#include "place.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

/* Interrupts */

enum { LEFTOVERS = 4 };

/* What an interrupt leaves behind unless it is removed, NULL: nothing.  The first is place_unfinished's. */
static const char *volatile leftover[LEFTOVERS];

/* The signal comes again when this returns, and then ends the process as it would have. */
static void
tidy_up(int signal_number)
{
	for (int i = 0; i < LEFTOVERS; i++)
		if (leftover[i])
			unlink(leftover[i]);
	raise(signal_number);
}

/* What is ignored, as under nohup, stays so. */
static void
tidy_up_on(int signal_number)
{
	struct sigaction old;

	if (!sigaction(signal_number, NULL, &old) && old.sa_handler == SIG_DFL)
		sigaction(signal_number,
		    &(struct sigaction){ .sa_handler = tidy_up, .sa_flags = (int)SA_RESETHAND }, NULL);
}

static void
tidy_up_on_interrupt(void)
{
	tidy_up_on(SIGINT);
	tidy_up_on(SIGTERM);
	tidy_up_on(SIGHUP);
}

void
place_unfinished(void *user, const char *file)
{
	(void)user;
	leftover[0] = file;
	tidy_up_on_interrupt();
}

static void
remember(const char *file)
{
	int i = 1;

	while (i < LEFTOVERS - 1 && leftover[i])
		i++;
	leftover[i] = file;
	tidy_up_on_interrupt();
}

static void
forget(const char *file)
{
	for (int i = 0; i < LEFTOVERS; i++)
		if (leftover[i] == file)
			leftover[i] = NULL;
}

/* Places */

static mr_status
fail_system(mr_ctx *ctx, const char *name)
{
	return mr_fail(ctx, MR_EIO, "%s: %s", name, strerror(errno));
}

/* old: what is there; NULL: nothing.  Its mode is kept, where that can be. */
static mr_status
open_beside(mr_ctx *ctx, const char *name, const struct stat *old, place *p, int *fd)
{
	char *target = realpath(name, NULL);

	p->name = mr_format(ctx, "%s", target ? target : name);
	p->beside = mr_format(ctx, "%s.%ld~", target ? target : name, (long)getpid());
	free(target);
	if (!p->name || !p->beside)
		return MR_EMEM;
	*fd = open(p->beside, O_WRONLY | O_CREAT | O_EXCL, 0666);
	if (*fd < 0) {
		p->beside = NULL;
		return fail_system(ctx, name);
	}
	remember(p->beside);
	if (old && fchmod(*fd, old->st_mode & 07777))
		mr_note(ctx, "%s: cannot keep its mode: %s", name, strerror(errno));
	return MR_OK;
}

mr_status
place_open(mr_ctx *ctx, const char *name, place *p, int *fd)
{
	struct stat st;
	bool there = stat(name, &st) == 0;

	if (!there || S_ISREG(st.st_mode))
		return open_beside(ctx, name, there ? &st : NULL, p, fd);
	*p = (place){ name, NULL };
	*fd = open(name, O_WRONLY);
	return *fd < 0 ? fail_system(ctx, name) : MR_OK;
}

mr_status
place_take(mr_ctx *ctx, const char *file, const char *name, place *p)
{
	*p = (place){ mr_format(ctx, "%s", name), mr_format(ctx, "%s", file) };
	if (p->beside)
		place_unfinished(NULL, p->beside);
	if (p->name && p->beside)
		return MR_OK;
	unlink(file);
	p->beside = NULL;
	return MR_EMEM;
}

mr_status
place_keep(mr_ctx *ctx, place *p)
{
	if (p->beside && rename(p->beside, p->name))
		return fail_system(ctx, p->name);
	forget(p->beside);
	p->beside = NULL;
	return MR_OK;
}

void
place_drop(place *p)
{
	if (p->beside)
		unlink(p->beside);
}

/* Identity */

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
