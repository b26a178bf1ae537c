/* What the system calls a terminal.  mr-solve-mpi has its own answer: cmd/mpi.c. */
#include "terminal.h"

#include <unistd.h>

bool
is_terminal(int fd)
{
	return isatty(fd);
}
