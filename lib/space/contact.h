/*
 * contact.h -- where the components of a surface touch, and where a component is slit.
 *
 * Components are of faces that share vertices; a slit is where vertices of one are at the same place.
 * Contract: deterministic for any number of threads.
 */
#ifndef MR_SPACE_CONTACT_H
#define MR_SPACE_CONTACT_H

#include "mesh/mesh.h"

/* Vertices, and of each the nearest point of another component, or of the same the other side of a slit. */
typedef struct mr_contacts {
	size_t n;
	uint32_t *vertex; /* ascending */
	mr_place *at;
} mr_contacts;

/* The vertices of m with a point of another component within `reach`, or at a slit.  contacts: in the arena.
 */
mr_status mr_contacts_find(mr_ctx *ctx, const mr_mesh *m, double reach, mr_contacts *contacts);

/*
 * How many contacts are wider than `width` after the vertices of m have gone to `after`, and were not before.
 * *widest: the vertex of the widest of them, MR_NONE without any.
 */
size_t mr_contacts_open(
    const mr_contacts *contacts, const mr_mesh *m, const mr_v3 *after, double width, uint32_t *widest);

#endif
