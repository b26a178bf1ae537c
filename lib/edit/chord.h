/*
 * chord.h -- edges of a posed mesh that cut across what its base does between their ends.
 */
#ifndef MR_EDIT_CHORD_H
#define MR_EDIT_CHORD_H

#include "edit/detail.h"
#include "mesh/edges.h"

typedef struct mr_chords {
	size_t edges;    /* whose middle is farther than `far` from where base takes it */
	double farthest; /* of these middles */
	uint32_t vertex; /* an end of that edge; MR_NONE without any */
	double enough;   /* edges of this length would go within `far`, as arcs do; infinite without any */
} mr_chords;

/*
 * Of mesh, as it was encoded, with its edges, after its vertices have gone to p: base, with the faces around
 * its vertices, is where it is now, d->rest where it was.  Looks at edges that are longer than 4 far alone:
 * across others base would have to turn by over two radians.
 */
mr_status mr_chords_find(mr_ctx *ctx, const mr_mesh *mesh, const mr_edges *edges, const mr_v3 *p,
    const mr_mesh *base, const mr_incidence *inc, const mr_detail *d, double far, mr_chords *found);

#endif
