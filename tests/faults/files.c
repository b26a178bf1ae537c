/* A preloaded library: $FAULTS may hold "named", a system that has no files without a name, and "sync", a
 * disk that fails when it is asked whether all is there. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

int open(const char *path, int flags, ...);

static int
has(const char *fault)
{
	const char *faults = getenv("FAULTS");

	return faults && strstr(faults, fault);
}

int
fsync(int fd)
{
	int (*next)(int) = (int (*)(int))dlsym(RTLD_NEXT, "fsync");
	struct stat st;

	if (has("sync") && !fstat(fd, &st) && S_ISREG(st.st_mode)) {
		errno = EIO;
		return -1;
	}
	return next(fd);
}

int
open(const char *path, int flags, ...)
{
	int (*next)(const char *, int, ...) = (int (*)(const char *, int, ...))dlsym(RTLD_NEXT, "open");
	mode_t mode = 0;
	va_list args;

	if (flags & O_CREAT) {
		va_start(args, flags);
		mode = va_arg(args, mode_t);
		va_end(args);
	}
	return next(path, flags, mode);
}

/* The same where files are large. */
int open64(const char *path, int flags, ...) __attribute__((alias("open")));
