/* Handlers that do what may be done in a handler: unlink, write, end. */
#include "signals.h"

#include <signal.h>
#include <unistd.h>

enum { LEFTOVERS = 8 };

/* The file that a signal must remove; NULL: none. */
static const char *volatile leftover[LEFTOVERS];

static char cut[256]; /* the sentence of a file that is shorter than it was */

static void
remove_leftovers(void)
{
	for (int i = 0; i < LEFTOVERS; i++)
		if (leftover[i])
			unlink(leftover[i]);
}

/* The signal comes again when this returns, and then ends the process as it would have. */
static void
tidy_up(int signal_number)
{
	remove_leftovers();
	raise(signal_number);
}

/* No page of a map could be had: its file has been cut.  Nothing else here is mapped from a file. */
static void
say_cut(int signal_number, siginfo_t *info, void *context)
{
	(void)context;
	remove_leftovers();
	if (info->si_code == BUS_ADRERR) {
		if (write(STDERR_FILENO, cut, strlen(cut)) < 0)
			_exit(1);
		_exit(1);
	}
	raise(signal_number);
}

/* Signals that are ignored, as under nohup, stay ignored. */
static void
tidy_up_on(int signal_number)
{
	struct sigaction old;

	if (!sigaction(signal_number, NULL, &old) && old.sa_handler == SIG_DFL)
		sigaction(signal_number,
		    &(struct sigaction){ .sa_handler = tidy_up, .sa_flags = (int)SA_RESETHAND }, NULL);
}

void
signals_begin(const char *name)
{
	struct sigaction bus = { .sa_sigaction = say_cut, .sa_flags = (int)(SA_SIGINFO | SA_RESETHAND) };

	snprintf(cut, sizeof cut, "%.100s: a file was cut off while it was read\n", name);
	signal(SIGXFSZ, SIG_IGN);
	sigaction(SIGBUS, &bus, NULL);
}

void
signals_unfinished(void *user, const char *file, bool on)
{
	static const int ending[] = { SIGHUP, SIGINT, SIGQUIT, SIGILL, SIGABRT, SIGFPE, SIGSEGV, SIGPIPE,
		SIGALRM, SIGTERM, SIGUSR1, SIGUSR2, SIGTRAP, SIGSYS, SIGVTALRM, SIGXCPU };
	int i = 0;

	(void)user;
	while (i < LEFTOVERS - 1 && leftover[i] != (on ? NULL : file))
		i++;
	leftover[i] = on ? file : NULL;
	for (size_t s = 0; on && s < sizeof ending / sizeof *ending; s++)
		tidy_up_on(ending[s]);
}
