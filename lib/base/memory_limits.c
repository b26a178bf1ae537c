/* What the machine says is free, or a control group that the process is in, whichever is less; and what is
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

/* The files of a control group, as Linux has them in both hierarchies (cgroups(7)). */
typedef struct hierarchy {
	const char *line; /* behind the number in /proc/self/cgroup */
	const char *root, *limit, *taken, *files[2];
} hierarchy;

static const hierarchy hierarchies[] = {
	{ "::", "/sys/fs/cgroup", "memory.max", "memory.current", { "inactive_file ", "active_file " } },
	{ ":memory:", "/sys/fs/cgroup/memory", "memory.limit_in_bytes", "memory.usage_in_bytes",
	    { "total_inactive_file ", "total_active_file " } },
};

static double
number_of(const hierarchy *h, const char *group, const char *file, const char *key)
{
	char path[4096];
	int n = snprintf(path, sizeof path, "%s%s/%s", h->root, group, file);

	return n < (int)sizeof path ? number_in(path, key) : NAN;
}

/* What a group may still take, NaN: it does not say: the files that the system keeps for it give way. */
static double
left_in(const hierarchy *h, const char *group)
{
	double left = number_of(h, group, h->limit, NULL) - number_of(h, group, h->taken, NULL);

	for (int k = 0; k < 2; k++)
		left += fmax(0, number_of(h, group, "memory.stat", h->files[k]));
	return left;
}

/* Of the group with this path, which is cut, and those around it; a container may show its own as the root.
 */
static double
left_around(const hierarchy *h, char *group)
{
	double least = INFINITY;

	group[strcspn(group, "\n")] = '\0';
	for (char *end = group + strlen(group); end; end = strrchr(group, '/')) {
		*end = '\0';
		least = fmin(least, left_in(h, group)); /* what is not a number does not count */
	}
	return least;
}

static double
group_memory(void)
{
	FILE *file = fopen("/proc/self/cgroup", "r");
	double least = INFINITY;
	char line[4096];

	while (file && fgets(line, sizeof line, file))
		for (size_t k = 0; k < sizeof hierarchies / sizeof *hierarchies; k++) {
			const hierarchy *h = &hierarchies[k];
			char *at = line + strspn(line, "0123456789");
			if (!strncmp(at, h->line, strlen(h->line)))
				least = fmin(least, left_around(h, at + strlen(h->line)));
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
	double own = 1024 * number_in("/proc/self/status", "VmHWM:");
	struct rusage usage;

	if (!isnan(own))
		return own;
	getrusage(RUSAGE_SELF, &usage); /* no less than that of the program before exec */
	return 1024 * (double)usage.ru_maxrss;
}
