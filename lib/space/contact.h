/*
 * contact.h -- where the components of a surface touch, and where a component is slit.
 *
 * Components are of faces that share vertices; a slit is where vertices at the boundary of one are at the
 * same place, within a millionth of the diagonal. Contract: deterministic for any number of threads.
 */
#ifndef MR_SPACE_CONTACT_H
#define MR_SPACE_CONTACT_H

#include "mesh/mesh.h"

/* component: of each vertex, the vertex that stands for it, MR_NONE where it has no face; in the arena. */
void mr_components_label(mr_ctx *ctx, const mr_mesh *m, uint32_t **component, bool *several);

/* Whether each vertex is at a boundary, or where faces are not oriented alike; *any: any is.  In the arena.
 */
void mr_boundary_label(mr_ctx *ctx, const mr_mesh *m, bool **boundary, bool *any);

/* Other parts that a vertex may touch: at a place of a grid of boxes there are seven. */
enum { MR_CONTACTS = 8 };

/* The contacts of vertex v, from start[v] to start[v + 1]: the other sides of a slit, and the nearest points
 * of other components, the nearest first. */
typedef struct mr_contacts {
	size_t *start;   /* one more than there are vertices */
	size_t vertices; /* that have any */
	mr_place *at;
	bool closed; /* no vertex is at a boundary */
} mr_contacts;

/* The vertices of m with points of other components within `reach`, or at a slit.  contacts: in the arena. */
void mr_contacts_find(mr_ctx *ctx, const mr_mesh *m, double reach, mr_contacts *contacts);

/* How wide the widest contact of v is after the vertices of m have gone to `after`, of those that were no
 * wider than `width` before; 0 without any. */
double mr_contact_widened(
    const mr_contacts *contacts, const mr_mesh *m, const mr_v3 *after, double width, uint32_t v);

/*
 * How many vertices have a contact wider than `width` after the vertices of m have gone to `after`, that was
 * not before.  *widest: the vertex of the widest of them, MR_NONE without any.
 */
size_t mr_contacts_open(
    const mr_contacts *contacts, const mr_mesh *m, const mr_v3 *after, double width, uint32_t *widest);

#endif
