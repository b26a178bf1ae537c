/* The one place from which a tool starts a program: xdg-open, without a shell, with one word. */
#include "open.h"

#include <errno.h>
#include <fcntl.h>
#include <spawn.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

/* Its standard output is of no use to anyone: the tool's own is closed by now. */
static int
run(char *const argv[], int *state)
{
	posix_spawn_file_actions_t actions;
	pid_t child;
	int failed = posix_spawn_file_actions_init(&actions);

	if (failed)
		return failed;
	failed = posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
	if (!failed)
		failed = posix_spawnp(&child, argv[0], &actions, NULL, argv, environ);
	posix_spawn_file_actions_destroy(&actions);
	while (!failed && waitpid(child, state, 0) < 0)
		failed = errno == EINTR ? 0 : errno;
	return failed;
}

/* From the root on, so that it is neither an option nor an address. */
static char *
whole_path(mr_ctx *ctx, const char *path)
{
	char here[4096] = "";

	if (*path == '/' || !getcwd(here, sizeof here))
		return mr_format(ctx, "%s", path);
	return mr_format(ctx, "%s/%s", here, path);
}

mr_status
open_file(mr_ctx *ctx, const char *path)
{
	char program[] = "xdg-open", *whole = whole_path(ctx, path);
	int state = 0, failed;

	if (!whole)
		return MR_EMEM;
	if (*whole != '/')
		return mr_fail(ctx, MR_EIO, "--open: no path of the folder here; the page is %s", path);
	failed = run((char *[]){ program, whole, NULL }, &state);
	if (failed)
		return mr_fail(
		    ctx, MR_EIO, "--open: %s: %s; the page is %s", program, strerror(failed), path);
	if (!WIFEXITED(state) || WEXITSTATUS(state))
		return mr_fail(ctx, MR_EIO, "--open: %s %s with %d; the page is %s", program,
		    WIFEXITED(state) ? "ends" : "is ended",
		    WIFEXITED(state) ? WEXITSTATUS(state) : WTERMSIG(state), path);
	return MR_OK;
}
