/* One thread for OpenMP and OpenBLAS while a solver is set up, by what the process has of them. */
#define _GNU_SOURCE /* RTLD_DEFAULT */
#include "solve/solver_type.h"

#include <dlfcn.h>
#include <pthread.h>
#include <stddef.h>

/* OpenBLAS has one number for all threads of the process: the first to come in changes it, the last to leave
 * puts it back. */
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static size_t inside;
static int blas_before;

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
	function blas_get = find("openblas_get_num_threads"), blas_set = find("openblas_set_num_threads");
	int before = get.symbol ? get.get() : 1;

	if (set.symbol)
		set.set(0);
	pthread_mutex_lock(&lock);
	if (inside++ == 0 && blas_get.symbol && blas_set.symbol) {
		blas_before = blas_get.get();
		blas_set.set(1);
	}
	pthread_mutex_unlock(&lock);
	return before;
}

void
mr_serial_end(int before)
{
	function set = find("omp_set_max_active_levels"), blas_set = find("openblas_set_num_threads");

	pthread_mutex_lock(&lock);
	if (--inside == 0 && blas_before > 0) {
		blas_set.set(blas_before);
		blas_before = 0;
	}
	pthread_mutex_unlock(&lock);
	if (set.symbol)
		set.set(before);
}
