/*
 * mpi.c -- mr-solve in several processes of MPI: rank 0 is mr-solve, the others hold parts of its factors.
 * Linked with mr-solve.c, whose main is mr_solve_main here, and with lib/solve/mumps.c.
 */
#include "solve/mumps.h"
#include "terminal.h"

#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

int mr_solve_main(int argc, char **argv);

/* Whoever starts the ranks gives them a pseudo-terminal for standard output, which passes all bytes on:
 * nobody sits in front of it. */
bool
is_terminal(int fd)
{
	return fd != STDOUT_FILENO && isatty(fd);
}

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
	return mr_solve_main(argc, argv);
}
