/*
 * blas_threads.h -- keeps the libraries below the solvers to one thread.
 *
 * CHOLMOD 3 starts a team of four OpenMP threads in loops too small for them, whatever the
 * environment says (two to three times slower), and threads of the BLAS would change the order of
 * sums.  Both are switched off where the process has them; neither library is required.
 * Private to this room.
 */
#ifndef MR_SOLVE_BLAS_THREADS_H
#define MR_SOLVE_BLAS_THREADS_H

/* Returns what mr_serial_end restores. */
int mr_serial_begin(void);
void mr_serial_end(int before);

#endif
