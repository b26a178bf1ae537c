/*
 * Sparse Cholesky by several processes: Amestoy, Duff, L'Excellent, Koster 2001: A fully asynchronous
 * multifrontal solver using distributed dynamic scheduling (MUMPS).  Linked instead of cholesky.c, it is the
 * same type of solver.  The only file that knows MUMPS, and with cmd/mpi.c MPI.
 */
#include "solve/mumps.h"

#include "base/memory.h"
#include "solve/solver_type.h"

#include <dmumps_c.h>
#include <mpi.h>
#include <time.h>

/* MUMPS's parameters by the numbers that its guide has. */
#define ICNTL(i) icntl[(i)-1]
#define INFO(i)  info[(i)-1]
#define INFOG(i) infog[(i)-1]

enum { START = -1, END = -2, ANALYSE = 1, FACTORIZE = 2, SOLVE = 3 }; /* its jobs */
enum { SYMMETRIC_POSITIVE_DEFINITE = 1, WORLD = -987654 };

/* INFOG(1): errors; all but the matrix's are of memory. */
enum {
	SPACE_OF_INTEGERS = -8,
	SPACE_OF_REALS = -9,
	SINGULAR = -10,
	NOT_POSITIVE_DEFINITE = -40,
	NO_ROOM = 1 /* ours: more than `memory` */
};

/* Requests of rank 0 to the others about a solver, one of SOLVERS at a time; 0 is none.  memory: see
 * room_here. */
typedef enum task { OPEN, APPLY, CLOSE, DISMISS } task;
typedef struct order {
	int task, solver;
	double memory;
} order;

enum { SOLVERS = 16, TAG = 1 };

static DMUMPS_STRUC_C *solvers[SOLVERS + 1];

/* ---- what all ranks do together ---- */

static int
count_ranks(MPI_Comm of)
{
	int ranks;

	MPI_Comm_size(of, &ranks);
	return ranks;
}

static void
call(DMUMPS_STRUC_C *m, int job)
{
	m->job = job;
	dmumps_c(m);
}

/* Bytes that this process may take: an equal part of what its machine has, or of `memory` if that is less. */
static double
room_here(double memory)
{
	MPI_Comm machine;
	double room = mr_memory_available();

	MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
	room = (memory > 0 && memory < room ? memory : room) / count_ranks(machine);
	MPI_Comm_free(&machine);
	return room;
}

/* How much the worst process would lack, in bytes; negative where there is room everywhere. */
static double
lacking(const DMUMPS_STRUC_C *m, double memory)
{
	double lack = 1e6 * m->INFO(15) - room_here(memory), most;

	MPI_Allreduce(&lack, &most, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
	return most;
}

/*
 * Its estimate of memory may be too low, since pieces move at run time: each time it fails for that, the
 * reserve is doubled.
 */
static void
factorize(DMUMPS_STRUC_C *m)
{
	enum { RESERVE = 30, MOST = 480 }; /* per cent */

	for (m->ICNTL(14) = RESERVE; m->ICNTL(14) <= MOST; m->ICNTL(14) *= 2) {
		call(m, FACTORIZE);
		if (m->INFOG(1) != SPACE_OF_REALS && m->INFOG(1) != SPACE_OF_INTEGERS)
			return;
	}
}

static void
start(DMUMPS_STRUC_C *m)
{
	/* Rank 0 has the mesh, too: of four, with a million vertices, it took 0.48 of what one takes, the
	 * others 0.27; without a part of the factor it takes 0.27, the others 0.36. */
	m->par = count_ranks(MPI_COMM_WORLD) < 4;
	m->sym = SYMMETRIC_POSITIVE_DEFINITE;
	m->comm_fortran = WORLD;
	call(m, START);
	for (int stream = 1; stream <= 4; stream++)
		m->ICNTL(stream) = 0; /* it prints nothing */
}

/* The entries of the matrix as MUMPS has them, counted from 1. */
static void
put_matrix(mr_ctx *ctx, const mr_sparse *a, DMUMPS_STRUC_C *m)
{
	size_t count = (size_t)a->start[a->n];
	int *row = MR_NEW(ctx, count, int), *column = MR_NEW(ctx, count, int);

	for (int i = 0; i < a->n; i++)
		for (int k = a->start[i]; k < a->start[i + 1]; k++) {
			row[k] = i + 1;
			column[k] = a->index[k] + 1;
		}
	m->n = a->n;
	m->nnz = (int64_t)count;
	m->irn = row;
	m->jcn = column;
	m->a = a->value;
}

/* Returns INFOG(1), or NO_ROOM.  a: of rank 0, in whose arena MUMPS has it; when the analysis was done.  A
 * rank without memory for as little as a solver ends the job. */
static int
open_solver(const order *o, mr_ctx *ctx, const mr_sparse *a, double *analysed)
{
	DMUMPS_STRUC_C *m = calloc(1, sizeof *m);

	solvers[o->solver] = m;
	*analysed = 0;
	if (!m)
		return MPI_Abort(MPI_COMM_WORLD, 1);
	start(m);
	if (a)
		put_matrix(ctx, a, m);
	call(m, ANALYSE);
	*analysed = mr_seconds();
	if (m->INFOG(1) >= 0 && lacking(m, o->memory) > 0)
		return NO_ROOM;
	if (m->INFOG(1) >= 0)
		factorize(m);
	return m->INFOG(1);
}

static void
close_solver(int i)
{
	if (!solvers[i])
		return;
	call(solvers[i], END);
	free(solvers[i]);
	solvers[i] = NULL;
}

/* ---- rank 0 ---- */

static order
ask(task what, int solver, double memory)
{
	order o = { (int)what, solver, memory };

	for (int rank = 1; rank < count_ranks(MPI_COMM_WORLD); rank++)
		MPI_Send(&o, sizeof o, MPI_BYTE, rank, TAG, MPI_COMM_WORLD);
	return o;
}

void
mr_mumps_dismiss(void)
{
	ask(DISMISS, 0, 0);
}

typedef struct cholesky {
	int solver;
} cholesky;

/* A failure in words. */
static mr_status
failed(mr_ctx *ctx, const DMUMPS_STRUC_C *m, int code)
{
	int ranks = count_ranks(MPI_COMM_WORLD);

	if (code == SINGULAR || code == NOT_POSITIVE_DEFINITE)
		return mr_fail(ctx, MR_ENUMERIC, "the matrix is not positive definite");
	if (code == NO_ROOM)
		return mr_fail(ctx, MR_ERANGE,
		    "the factor of %d rows takes %.3g MB of one of %d processes, more than it has", m->n,
		    (double)m->INFOG(16), ranks);
	return mr_fail(ctx, MR_ERANGE,
	    "the factor of %d rows is too large for %d process%s: MUMPS says %d, %d", m->n, ranks,
	    ranks == 1 ? "" : "es", code, m->INFOG(2));
}

static double
summed(int megabytes_or_millions)
{
	return megabytes_or_millions < 0 ? -1e6 * megabytes_or_millions : megabytes_or_millions;
}

static mr_status
cholesky_setup(
    mr_ctx *ctx, const mr_solver_opts *opts, const mr_system *system, void *data, mr_solver_report *report)
{
	cholesky *c = data;
	int i = 1, code;
	double started = mr_seconds(), analysed;
	mr_mark mark = mr_mark_take(ctx);
	DMUMPS_STRUC_C *m;
	order o;

	while (i <= SOLVERS && solvers[i])
		i++;
	if (i > SOLVERS)
		return mr_fail(ctx, MR_ERANGE, "more than %d solvers at a time", (int)SOLVERS);
	c->solver = i;
	o = ask(OPEN, i, opts->memory);
	code = open_solver(&o, ctx, system->a, &analysed);
	m = solvers[i];
	m->irn = m->jcn = NULL;
	m->a = NULL;
	mr_mark_release(ctx, mark);
	if (code < 0 || code == NO_ROOM)
		return failed(ctx, m, code);
	*report = (mr_solver_report){ .seconds_analyse = analysed - started,
		.seconds_factor = mr_seconds() - analysed,
		.nnz_factor = summed(m->INFOG(29)) };
	return MR_OK;
}

static mr_status
cholesky_solve(mr_ctx *ctx, void *data, double *b, size_t columns, mr_solver_report *report)
{
	const cholesky *c = data;
	DMUMPS_STRUC_C *m = solvers[c->solver];

	(void)report;
	m->rhs = b;
	m->nrhs = (int)columns;
	m->lrhs = m->n;
	ask(APPLY, c->solver, 0);
	call(m, SOLVE);
	m->rhs = NULL;
	return m->INFOG(1) < 0 ? failed(ctx, m, m->INFOG(1)) : MR_OK;
}

static void
cholesky_drop(void *data)
{
	const cholesky *c = data;

	if (!c->solver)
		return;
	ask(CLOSE, c->solver, 0);
	close_solver(c->solver);
}

const mr_solver_type mr_cholesky_type = { "cholesky", sizeof(cholesky), cholesky_setup, cholesky_solve,
	cholesky_drop };

/* ---- the other ranks ---- */

/* Waits asleep: MPI's own waiting takes a processor, while rank 0 reads, assembles and writes. */
static order
next_order(void)
{
	static const struct timespec nap = { 0, 500000 };
	order o;
	int there;

	for (;;) {
		MPI_Iprobe(0, TAG, MPI_COMM_WORLD, &there, MPI_STATUS_IGNORE);
		if (there)
			break;
		nanosleep(&nap, NULL);
	}
	MPI_Recv(&o, sizeof o, MPI_BYTE, 0, TAG, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
	return o;
}

void
mr_mumps_serve(void)
{
	int threads = mr_serial_begin();
	double analysed;

	for (order o = next_order(); o.task != DISMISS; o = next_order()) {
		if (o.task == OPEN)
			open_solver(&o, NULL, NULL, &analysed);
		else if (o.task == APPLY)
			call(solvers[o.solver], SOLVE);
		else
			close_solver(o.solver);
	}
	mr_serial_end(threads);
}
