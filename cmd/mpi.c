/* mpi.c -- mr-solve in several processes of MPI: rank 0 is mr-solve, the others hold parts of its factors.
 * Linked with cmd.c, whose main is mr_solve_main here, and with lib/solve/mumps.c. */
#include "cmd.h"
#include "solve/mumps.h"

#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>

int mr_solve_main(int argc, char **argv);

/* However rank 0 exits. */
static void
leave(void)
{
	mr_mumps_dismiss();
	MPI_Finalize();
}

int
main(int argc, char **argv)
{
	int thread, rank;

	MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &thread);
	MPI_Comm_rank(MPI_COMM_WORLD, &rank);
	if (rank > 0) {
		mr_mumps_serve();
		return MPI_Finalize() == MPI_SUCCESS ? 0 : 1;
	}
	if (atexit(leave)) {
		fputs("mr-solve-mpi: cannot say what is to be done at exit\n", stderr);
		MPI_Abort(MPI_COMM_WORLD, 1);
	}
	cmd_piped = true; /* a pseudo-terminal of who started the ranks, which passes all bytes on */
	return mr_solve_main(argc, argv);
}
