/* What the machine says is free, or the control group that the process is in, whichever is less; and what is
 * taken. */
#include "base/memory.h"

#include <math.h>
#include <sys/resource.h>

/* The number that stands in the file behind `key` (NULL: first), or NaN. */
static double
number_in(const char *path, const char *key)
{
	FILE *file = fopen(path, "r");
	char line[256];
	double found = NAN;

	if (!file)
		return NAN;
	while (isnan(found) && fgets(line, sizeof line, file)) {
		size_t skip = key ? strlen(key) : 0;
		char *end;
		if (key && strncmp(line, key, skip))
			continue;
		found = strtod(line + skip, &end);
		if (end == line + skip)
			found = NAN;
	}
	fclose(file);
	return found;
}

/* What the process's group may still take: the files that the system keeps for it give way. */
static double
group_memory(void)
{
	static const char stat[] = "/sys/fs/cgroup/memory.stat";

	return number_in("/sys/fs/cgroup/memory.max", NULL) -
	       number_in("/sys/fs/cgroup/memory.current", NULL) + fmax(0, number_in(stat, "inactive_file ")) +
	       fmax(0, number_in(stat, "active_file "));
}

double
mr_memory_available(void)
{
	double system = 1024 * number_in("/proc/meminfo", "MemAvailable:");
	double least = fmin(INFINITY, fmin(system, group_memory())); /* what is not a number does not count */
	struct rlimit limit;

	if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
		least = fmin(least, (double)limit.rlim_cur);
	return least;
}

double
mr_memory_peak(void)
{
	double own = 1024 * number_in("/proc/self/status", "VmHWM:");
	struct rusage usage;

	if (!isnan(own))
		return own;
	getrusage(RUSAGE_SELF, &usage); /* no less than that of the program before exec */
	return 1024 * (double)usage.ru_maxrss;
}
