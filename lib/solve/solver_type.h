/*
 * solver_type.h -- a solver's interface to solver.c.
 *
 * Contract: `data` points to `size` zeroed bytes of the solver's own.  `setup` fills them and the report, as
 * `solve` does; `drop` releases their memory outside the arena, also after setup has failed half-way; NULL:
 * nothing. Private to this room.
 */
#ifndef MR_SOLVE_SOLVER_TYPE_H
#define MR_SOLVE_SOLVER_TYPE_H

#include "solve/solver.h"

typedef struct mr_solver_type {
	const char *name;
	size_t size;
	mr_status (*setup)(mr_ctx *ctx, const mr_solver_opts *opts, const mr_system *system, void *data,
	    mr_solver_report *report);
	mr_status (*solve)(mr_ctx *ctx, void *data, double *b, size_t columns, mr_solver_report *report);
	void (*drop)(void *data);
} mr_solver_type;

extern const mr_solver_type mr_cholesky_type, mr_cholmod_type, mr_lu_type, mr_cg_type, mr_multigrid_type,
    mr_vcycle_type;

/*
 * Keeps the libraries below the solvers to one thread.  CHOLMOD 3 starts a team of four OpenMP threads in
 * loops too small for them, whatever the environment says (two to three times slower), and threads of the
 * BLAS would change the order of sums.  Both are switched off where the process has them.  Calls may nest,
 * and any thread may make them; after the last end everything is as it was.  Until then the BLAS of the
 * process's other threads is serial, too: OpenBLAS keeps one number for all.
 *
 * Returns what mr_serial_end restores, in the same thread.
 */
int mr_serial_begin(void);
void mr_serial_end(int before);

#endif
