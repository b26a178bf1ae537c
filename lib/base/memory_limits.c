/* The free memory of the machine or of a control group of the process, whichever is less; and the used
 * one. */
#include "base/memory.h"

#include <math.h>
#include <sys/resource.h>

/* The number after `key` in the file (NULL: first), or NaN. */
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

/* The number in a file of a control group of Linux's unified hierarchy (cgroups(7)). */
static double
number_of(const char *group, const char *file, const char *key)
{
	char path[4096];
	int n = snprintf(path, sizeof path, "/sys/fs/cgroup%s/%s", group, file);

	return n < (int)sizeof path ? number_in(path, key) : NAN;
}

/* The memory that a group may still take, with its cached files, which give way; NaN: unknown. */
static double
left_in(const char *group)
{
	return number_of(group, "memory.max", NULL) - number_of(group, "memory.current", NULL) +
	       fmax(0, number_of(group, "memory.stat", "inactive_file ")) +
	       fmax(0, number_of(group, "memory.stat", "active_file "));
}

/* The least of the process's group and its ancestors; a container may show its own as the root. */
static double
group_memory(void)
{
	FILE *file = fopen("/proc/self/cgroup", "r");
	double least = INFINITY;
	char line[4096];

	while (file && fgets(line, sizeof line, file)) {
		char *group = line + 3;
		if (strncmp(line, "0::", 3))
			continue;
		group[strcspn(group, "\n")] = '\0';
		for (char *end = group + strlen(group); end; end = strrchr(group, '/')) {
			*end = '\0';
			least = fmin(least, left_in(group)); /* NaN does not count */
		}
	}
	if (file)
		fclose(file);
	return least;
}

double
mr_memory_available(void)
{
	double least = fmin(1024 * number_in("/proc/meminfo", "MemAvailable:"), group_memory());
	struct rlimit limit;

	if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
		least = fmin(least, (double)limit.rlim_cur);
	return least;
}

double
mr_memory_peak(void)
{
	return fmax(0, 1024 * number_in("/proc/self/status", "VmHWM:"));
}
