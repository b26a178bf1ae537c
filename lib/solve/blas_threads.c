#define _GNU_SOURCE /* RTLD_DEFAULT */
#include "solve/blas_threads.h"

#include <dlfcn.h>
#include <stddef.h>

/* A function of the process, if it has it: ISO C has no cast from void * to a function. */
typedef union function {
	void *symbol;
	void (*set)(int);
	int (*get)(void);
} function;

static function
find(const char *name)
{
	return (function){ dlsym(RTLD_DEFAULT, name) };
}

int
mr_serial_begin(void)
{
	function get = find("omp_get_max_active_levels"), set = find("omp_set_max_active_levels");
	function blas = find("openblas_set_num_threads");
	int before = get.symbol ? get.get() : 1;

	if (set.symbol)
		set.set(0);
	if (blas.symbol)
		blas.set(1);
	return before;
}

void
mr_serial_end(int before)
{
	function set = find("omp_set_max_active_levels");

	if (set.symbol)
		set.set(before);
}
