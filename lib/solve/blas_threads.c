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
	int (*end)(void);
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
		if (blas_before > 1) /* to set it starts threads */
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
	if (--inside == 0 && blas_before > 1)
		blas_set.set(blas_before);
	pthread_mutex_unlock(&lock);
	if (set.symbol)
		set.set(before);
}

void
mr_serial_for_good(void)
{
	function set = find("openblas_set_num_threads"), end;

	if (!set.symbol)
		return;
	set.set(1);
	end = find("blas_thread_shutdown_");
	if (end.symbol)
		end.end();
}
