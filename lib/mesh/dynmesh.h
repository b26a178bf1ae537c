/* dynmesh.h -- an oriented manifold triangle mesh under local change: split, collapse, flip.  Half-edges are
 * 3 f + i; collapses leave holes in the numbering, which splits fill and mr_dyn_compact closes.  Curves
 * (boundary and feature edges) are marked on their half-edges and survive every change. */
#ifndef MR_MESH_DYNMESH_H
#define MR_MESH_DYNMESH_H

#include "mesh/fold.h"

typedef enum mr_kind {
	MR_SMOOTH, /* free on the surface */
	MR_CURVE,  /* on a curve: slides along it */
	MR_CORNER, /* stays */
	MR_DEAD    /* a hole in the numbering */
} mr_kind;

typedef struct mr_dyn {
	mr_v3 *p;
	uint32_t *out; /* as in mr_topology */
	uint32_t
	    *at; /* place on the source surface: a face, or on a curve a half-edge (space/surface_walk.h) */
	uint8_t *kind; /* mr_kind */
	uint32_t
	    *block; /* of each vertex: neighbours that one thread may change (remesh/blocks.h), or NULL */
	size_t nv, room_v;
	uint32_t free_v; /* first hole, chained through out; MR_NONE: none */
	uint32_t *v, *twin;
	uint32_t *curve; /* of each half-edge the one of the source on whose curve it is, or MR_NONE; NULL:
	                    none is */
	size_t nf, room_f;
	uint32_t free_f; /* first hole, chained through twin[3 f] */
} mr_dyn;

static inline bool
mr_dyn_face_dead(const mr_dyn *d, size_t f)
{
	return d->v[3 * f] == MR_NONE;
}

/* True where v is a corner of face f. */
static inline bool
mr_dyn_has(const mr_dyn *d, uint32_t f, uint32_t v)
{
	return v == d->v[3 * f] || v == d->v[3 * f + 1] || v == d->v[3 * f + 2];
}

static inline uint32_t
mr_dyn_to(const mr_dyn *d, uint32_t h)
{
	return d->v[mr_he_next(h)];
}

/* The half-edge of the source that h lies on; MR_NONE where it lies on no curve. */
static inline uint32_t
mr_dyn_curve(const mr_dyn *d, uint32_t h)
{
	return d->curve ? d->curve[h] : MR_NONE;
}

static inline bool
mr_dyn_on_curve(const mr_dyn *d, uint32_t h)
{
	return mr_dyn_curve(d, h) != MR_NONE;
}

/* The face of the source at or near vertex v. */
static inline uint32_t
mr_dyn_place(const mr_dyn *d, uint32_t v)
{
	return d->kind[v] == MR_SMOOTH ? d->at[v] : d->at[v] / 3;
}

/* The third vertex of h's face. */
static inline uint32_t
mr_dyn_apex(const mr_dyn *d, uint32_t h)
{
	return d->v[mr_he_prev(h)];
}

/* The next half-edge leaving the same vertex, counter-clockwise; MR_NONE at the boundary. */
static inline uint32_t
mr_dyn_ccw(const mr_dyn *d, uint32_t h)
{
	return d->twin[mr_he_prev(h)];
}

static inline bool
mr_dyn_on_boundary(const mr_dyn *d, uint32_t v)
{
	return d->twin[d->out[v]] == MR_NONE;
}

/* Twice the area times the unit normal of face f, with the vertices at p. */
static inline mr_v3
mr_dyn_cross(const mr_dyn *d, const mr_v3 *p, size_t f)
{
	mr_v3 a = p[d->v[3 * f]];
	return mr_cross(mr_sub(p[d->v[3 * f + 1]], a), mr_sub(p[d->v[3 * f + 2]], a));
}

/* Whether the faces at h are folded by more than the angle of that cosine; not on the boundary. */
static inline bool
mr_dyn_folds(const mr_dyn *d, uint32_t h, double cosine)
{
	uint32_t g = d->twin[h];

	return g != MR_NONE && mr_folds(mr_dyn_cross(d, d->p, h / 3), mr_dyn_cross(d, d->p, g / 3), cosine);
}

/* Shape of a triangle, height over longest edge: 0.87 of an equilateral one.  Below this its normal says
 * little, and no operation may leave it worse. */
static const double MR_NEEDLE = 0.1;

static inline double
mr_dyn_longest2(mr_v3 a, mr_v3 b, mr_v3 c)
{
	double ab = mr_norm2(mr_sub(b, a)), bc = mr_norm2(mr_sub(c, b)), ca = mr_norm2(mr_sub(a, c));
	ab = ab > bc ? ab : bc;
	return ab > ca ? ab : ca;
}

static inline double
mr_dyn_shape(mr_v3 a, mr_v3 b, mr_v3 c)
{
	double longest2 = mr_dyn_longest2(a, b, c);
	return longest2 > 0 ? mr_norm(mr_cross(mr_sub(b, a), mr_sub(c, a))) / longest2 : 0;
}

/* Copies m into the arena.  Curves are the boundary, edges whose faces meet at more than `feature` degrees,
 * and what `seam` marks (3 nf; NULL: nothing); corners where other than two meet or one turns by more than 50
 * degrees. */
mr_status mr_dyn_build(
    mr_ctx *ctx, const mr_mesh *m, const mr_topology *topo, const uint8_t *seam, double feature, mr_dyn *d);

/* Number of edges at v, of which at most so many are looked for. */
unsigned mr_dyn_valence(const mr_dyn *d, uint32_t v, unsigned most);

/* The number of curve edges at v, and the ends of the first two. */
unsigned mr_dyn_along(const mr_dyn *d, uint32_t v, uint32_t end[2]);

/* A vertex at which a curve turns by more than the angle of this cosine, 50 degrees, is a corner. */
static const double MR_CORNER_COSINE = 0.6427876096865394;

/* The sum of the faces' normals around v, by area; twice the area long. */
mr_v3 mr_dyn_normal_around(const mr_dyn *d, uint32_t v);

/* The middle of the ends of the half-edges that leave v. */
mr_v3 mr_dyn_middle_around(const mr_dyn *d, uint32_t v);

/* False where both faces have the same vertices: the middle would be joined twice to the third. */
bool mr_dyn_can_split(const mr_dyn *d, uint32_t h);

/* Splits the edge of h at position p; *middle is the new vertex, whose place on the source is h's start's or
 * curve's.  Only if mr_dyn_can_split. */
mr_status mr_dyn_split(mr_ctx *ctx, mr_dyn *d, uint32_t h, mr_v3 p, uint32_t *middle);

/* Room for so many splits without memory. */
mr_status mr_dyn_reserve(mr_ctx *ctx, mr_dyn *d, size_t splits);

/* A part of d for a thread: the same arrays with room of its own for so many splits, which d has reserved. */
void mr_dyn_lend(mr_dyn *d, size_t splits, mr_dyn *part);

/* Holes that part made or did not use are d's again, and part has none. */
void mr_dyn_take_back(mr_dyn *d, mr_dyn *part);

/* Points d at the arrays of part, which may have moved. */
void mr_dyn_share(const mr_dyn *d, mr_dyn *part);

/* True where the start of h can be merged into its end and the mesh stays a manifold of the same topology.
 * mark: nv zeros, which it leaves zero. */
bool mr_dyn_can_collapse(const mr_dyn *d, uint32_t h, uint8_t *mark);

/* Merges the start of h into its end, which moves to p.  Only where mr_dyn_can_collapse. */
void mr_dyn_collapse(mr_dyn *d, uint32_t h, mr_v3 p);

/* True where the edge has two faces, is no curve, and its opposite vertices are not joined yet. */
bool mr_dyn_can_flip(const mr_dyn *d, uint32_t h);

/* Replaces the edge of h by the one across, mr_he_next(h).  Only where mr_dyn_can_flip. */
void mr_dyn_flip(mr_dyn *d, uint32_t h);

/* Closes the holes; the rest keeps its order.  Gives room back if a quarter of it is unused. */
mr_status mr_dyn_compact(mr_ctx *ctx, mr_dyn *d);

/* Renumbers vertices along a Z curve, faces by their lowest vertex.  Only after mr_dyn_compact. */
void mr_dyn_order(mr_ctx *ctx, mr_dyn *d);

/* The mesh, sharing the arrays; its holes, until mr_dyn_compact, are faces that begin with MR_NONE. */
mr_mesh mr_dyn_view(const mr_dyn *d, const char *name);

#endif
