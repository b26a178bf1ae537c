/*
 * mumps.h -- sparse Cholesky over the processes of MPI, in the place of cholesky.c.
 *
 * The process of rank 0 works as on one machine; if it opens, uses or frees a solver of MR_CHOLESKY the
 * others take part.  Each process holds its share of the factor.
 *
 * Contract: rank 0 calls solvers from one thread, the one that has started MPI, and mr_mumps_dismiss last.
 */
#ifndef MR_SOLVE_MUMPS_H
#define MR_SOLVE_MUMPS_H

/* For ranks other than 0: serves rank 0's requests until it dismisses them. */
void mr_mumps_serve(void);

/* For rank 0: ends mr_mumps_serve in the others. */
void mr_mumps_dismiss(void);

#endif
