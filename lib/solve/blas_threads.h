/*
 * blas_threads.h -- keeps the libraries below the solvers to one thread.
 *
 * CHOLMOD 3 starts a team of four OpenMP threads in loops too small for them, whatever the
 * environment says (two to three times slower), and threads of the BLAS would change the order of
 * sums.  Both are switched off where the process has them; neither library is required.  Solutions need none
 * of it: UMFPACK's call no BLAS, nor do ours.
 *
 * Contract: calls may nest, and any thread may make them; after the last end everything is as it was.  Until
 * then the BLAS of the process's other threads is serial, too: OpenBLAS keeps one number for all.
 * Private to this room.
 */
#ifndef MR_SOLVE_BLAS_THREADS_H
#define MR_SOLVE_BLAS_THREADS_H

/* Returns what mr_serial_end restores, in the same thread. */
int mr_serial_begin(void);
void mr_serial_end(int before);

#endif
