/* repair.h -- joining equal vertices; making a manifold of any set of triangles. */
#ifndef MR_MESH_REPAIR_H
#define MR_MESH_REPAIR_H

#include "mesh/mesh.h"

/* Joins vertices that are equal (eps 0; -0 equals 0) or within eps: a vertex joins the lowest earlier one
 * that stands for itself and is no farther, else stands for itself.  map: n new numbers, in order of first
 * use; *count: how many. */
void mr_weld(mr_ctx *ctx, const mr_v3 *p, size_t n, double eps, uint32_t *map, size_t *count);

/* mr_weld of those that may; NULL: all. */
void mr_weld_some(
    mr_ctx *ctx, const mr_v3 *p, size_t n, double eps, const bool *may, uint32_t *map, size_t *count);

/* The counts of a repair. */
typedef struct mr_repair_report {
	size_t degenerate;     /* faces dropped: a vertex twice, or no area */
	size_t duplicate;      /* faces dropped: the vertices of an earlier one */
	size_t isolated;       /* vertices dropped: in no face */
	size_t split_edges;    /* edges of three faces or more, taken apart */
	size_t split_vertices; /* vertices added where fans were taken apart */
	size_t flipped;        /* faces turned over */
	size_t cut_edges; /* edges cut because the surface is one-sided there, or to keep copies of an edge
	                     apart */
	size_t inward;    /* closed parts whose outside is within: hollows, or inside out */
	size_t open;      /* edges of the boundary that is left */
} mr_repair_report;

/* An oriented manifold with boundary of the triangles of `m`, without degenerate and duplicate faces.  Edges
 * of more than two faces are parted by the wedges of the solid, fans at a vertex, too.  Components are
 * oriented as most of their faces, a closed one where that is less than three quarters outwards.  out: in the
 * arena.  vertex_of, face_of: of each the one of `m`; a face turned over keeps its first vertex.  MR_EMESH
 * where no face is left. */
mr_status mr_repair(mr_ctx *ctx, const mr_mesh *m, mr_mesh *out, const uint32_t **vertex_of,
    const uint32_t **face_of, mr_repair_report *report) MR_WARN_UNUSED;

#endif
