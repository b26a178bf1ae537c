/* guarded_move.h -- moves of vertices that leave no face bad.  Round by round the corners of faces that would
 * be bad go half as far, after some rounds they stay.  If every unmoved face is good, the move is good.
 * Deterministic for any number of threads; linear time. */
#ifndef MR_MESH_GUARDED_MOVE_H
#define MR_MESH_GUARDED_MOVE_H

#include "mesh/mesh.h"

typedef struct mr_guard {
	const mr_tri *t; /* nf faces, some of which may be none: their first corner is MR_NONE */
	mr_topology topo;
	size_t nv, nf;
	unsigned halves; /* rounds in which held vertices go half as far; in later ones they stay */
	/* A face is judged by its own and its neighbours' corners.  If more matters, `look` first looks at
	 * the whole surface, each time; NULL: no need. */
	mr_status (*look)(mr_ctx *ctx, void *arg);
	bool (*is_bad)(const void *arg, uint32_t f);
	void *arg;
} mr_guard;

/* Moves vertices from `from` to `to`, nv each, as far as the guard lets them: `to` becomes where they are,
 * bit by bit `from` where they stay. */
mr_status mr_guarded_move(mr_ctx *ctx, const mr_guard *guard, const mr_v3 *from, mr_v3 *to);

/* Moves the vertices of m to `to`, unless this would turn a face by more than 60 degrees, close it against a
 * neighbour beyond MR_NEAR_FOLD, or worsen its shape (mesh/dynmesh.h) below `needle`. */
mr_status mr_move_unfolded(mr_ctx *ctx, const mr_mesh *m, const mr_topology *topo, double needle, mr_v3 *to);

#endif
