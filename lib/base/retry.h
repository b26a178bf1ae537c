/* retry.h -- reading and writing that is begun again. */
#ifndef MR_BASE_RETRY_H
#define MR_BASE_RETRY_H

#include <errno.h>
#include <poll.h>
#include <stdbool.h>

/* Whether a read (POLLIN) or write (POLLOUT) that failed is to be tried again: it was interrupted, or the
 * descriptor, made non-blocking by another process, is ready now. */
static inline bool
mr_retry(int fd, short event)
{
	struct pollfd p = { .fd = fd, .events = event };

	return errno == EINTR || (errno == EAGAIN && (poll(&p, 1, -1) >= 0 || errno == EINTR));
}

#endif
