/*
 * parts.h -- what the files of volume.h share: points in a grid, and equations on its nodes.
 *
 * Private to this room.
 */
#ifndef MR_VOLUME_PARTS_H
#define MR_VOLUME_PARTS_H

#include "space/local_planes.h"
#include "space/sampling.h"
#include "volume/isosurface.h"

/* The points, each once, ordered by place; the planes' normals get their signs on the way. */
typedef struct mr_volume_cloud {
	mr_v3 *p;
	size_t n;
	mr_planes plane;
	double spacing; /* side of the square that a point stands for; the median */
	double noise;   /* at least 1: a surface is seen in squares of so many spacings */
	uint8_t *depth; /* n: how often the step of the grid is doubled where the points are sparse */
	mr_box box;
} mr_volume_cloud;

enum { DEPTHS = 3 };

/*
 * Takes a share of the n places of a sampling, which become the samples' own, and their planes; no depths
 * yet.
 */
mr_status mr_volume_samples(
    mr_ctx *ctx, mr_v3 *place, size_t n, const mr_sampling *sampling, double share, mr_volume_cloud *s);

/* The planes of the places in s, of as many neighbours as it takes to see a surface through the noise, and
 * how far these are apart. */
mr_status mr_volume_planes(mr_ctx *ctx, const mr_sampling *of, mr_volume_cloud *s);

/* Gives normals the signs by which they point out of what the points enclose.  volume.c */
mr_status mr_volume_orient_outward(mr_ctx *ctx, mr_volume_cloud *s);

/* Gives normals the signs of the directions, 0 or NaN: unknown, there neighbours decide, as everywhere if
 * toward is NULL.  *untold: points of parts without a direction.  orient_toward.c */
mr_status mr_volume_orient_toward(mr_ctx *ctx, mr_volume_cloud *s, const mr_v3 *toward, size_t *untold);

/* Reports MR_UNCERTAIN where neighbours on alike planes have signs that are not.  volume.c */
void mr_volume_report_patches(mr_ctx *ctx, const mr_volume_cloud *s);

/* The quality of directions: how many decide a side; the shares within 60 degrees of their planes' normals,
 * and of neighbours on alike planes with alike signs.  NaN for none. */
typedef struct mr_volume_sides {
	size_t told;
	double near, alike;
	uint32_t unlike; /* the first point that has a neighbour of another sign; UINT32_MAX: none */
} mr_volume_sides;

mr_volume_sides mr_volume_judge(const mr_volume_cloud *s, const mr_v3 *toward);

/* How alike the normals of i and j are, as a sign and a weight below 1.  orient.c */
double mr_volume_likeness(const mr_volume_cloud *s, uint32_t i, uint32_t j);

/* Tries normals' signs that agree with their neighbours' where planes are alike, and with the votes
 * (positive: the sign is right) on the whole; apart: parts whose own votes say otherwise go by these, where
 * votes are not much less than the flood on both sides of the points (NULL: none).  The votes become those
 * for the signs.  *untold: how many points are of parts without a vote.  orient.c */
mr_status mr_volume_orient(
    mr_ctx *ctx, mr_volume_cloud *s, double *vote, const double *flood, bool apart, size_t *untold);

/* From which size on one of n such votes counts: in proportion to them all.  orient.c */
double mr_volume_loud(const double *vote, size_t n);

/* Turns the normals of parts that are inside out over by the indicator u, which rises by so much across most
 * of the surface.  *turned: how many points these have.  orient_parts.c */
void mr_volume_turn_parts(
    mr_ctx *ctx, mr_volume_cloud *s, const mr_grid *g, const float *u, double rise, size_t *turned);

/* ---- grid_multigrid.c: (screen - Laplacian) u = b on the nodes, u = 0 on the faces of the grid ---- */

enum { LEVELS_MOST = 16 };

typedef struct mr_grid_level {
	size_t n[3];
	float *u, *b;
	float *screen; /* NULL: none; of the finest level it is b too */
} mr_grid_level;

typedef struct mr_grid_multigrid {
	size_t levels;
	mr_grid_level level[LEVELS_MOST];
} mr_grid_multigrid;

/* Nodes along an axis for `cells` cells at least, so that coarser grids fit. */
size_t mr_multigrid_nodes(size_t cells, size_t levels);

/* Levels for a grid whose longest side has so many cells. */
size_t mr_multigrid_levels(size_t cells);

/* Arrays for all levels, zero; u: the finest one's, the caller's. */
void mr_multigrid_begin(
    mr_ctx *ctx, const size_t n[3], size_t levels, float *u, bool screened, mr_grid_multigrid *m);

/* The solution from scratch, coarse to fine; the screen of the coarser levels follows the finest's. */
void mr_multigrid_full(mr_ctx *ctx, mr_grid_multigrid *m);

/* to = keep to + scale times the values of the next coarser level, between nodes; on inner nodes. */
void mr_multigrid_prolong(mr_ctx *ctx, const mr_grid_level *fine, const mr_grid_level *coarse,
    const float *from, float *to, float keep, float scale);

/* to = scale times the mean of the finer level's values, or where from is NULL of its residuals, around each
 * inner node. */
void mr_multigrid_restrict(mr_ctx *ctx, const mr_grid_level *fine, const mr_grid_level *coarse,
    const float *from, float *to, float scale);

/* ---- splat.c: points to nodes and back ---- */

/* Some of the points by layer of cells: order[first[z]] to order[first[z + 1]] lie between layers z and z
 * + 1. */
typedef struct mr_grid_points {
	mr_grid grid;
	size_t *first; /* n[2] */
	uint32_t *order;
} mr_grid_points;

/* Samples the points of a depth, or all (DEPTHS); grid is theirs. */
void mr_volume_field(
    mr_ctx *ctx, const mr_volume_cloud *s, const mr_grid *grid, unsigned depth, mr_grid_points *f);

/* to = divergence of the points' normals, weighted by area, in the units of the equation. */
void mr_volume_divergence(mr_ctx *ctx, const mr_volume_cloud *s, const mr_grid_points *f, float *to);

/* to = sum of what points spread over the nodes of their cells: value (NULL: 1) times area per squared step.
 */
void mr_volume_spread(
    mr_ctx *ctx, const mr_volume_cloud *s, const mr_grid_points *f, const double *value, float *to);

/* The value between the nodes at p, which must be inside the grid. */
double mr_volume_at(const mr_grid *g, const float *u, mr_v3 p);

/* ---- level.c ---- */

/* How many points there are around the nodes of a grid of twice the step, and their area in its squared
 * steps. */
typedef struct mr_walls {
	const mr_volume_cloud *s;
	mr_grid grid;
	mr_grid_points of;
	float *points, *area;
} mr_walls;

void mr_walls_begin(mr_ctx *ctx, const mr_volume_cloud *s, const mr_grid *g, mr_walls *w);

/* The isosurface without walls that have few points for their size. */
mr_status mr_volume_surface(
    mr_ctx *ctx, const mr_walls *w, const mr_grid *g, const float *f, float level, mr_mesh *out);

/*
 * The level of f, negative inside, nearest to 0 whose topology lasts.  rise: of the indicator across the
 * surface, the unit of f.  Fills the result's euler and levels_alike.
 */
mr_status mr_volume_level(mr_ctx *ctx, const mr_walls *w, const mr_grid *g, const float *f, double rise,
    float *level, mr_volume_result *result);

#endif
