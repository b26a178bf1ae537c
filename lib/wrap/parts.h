/*
 * parts.h -- what the files of the shrink-wrapping share.
 *
 * Private to this room.
 */
#ifndef MR_WRAP_PARTS_H
#define MR_WRAP_PARTS_H

#include "mesh/dynmesh.h"
#include "space/near.h"
#include "wrap/shrinkwrap.h"

/* The points to wrap: each place once, without outliers, along the Z curve. */
typedef struct mr_wrap_cloud {
	const mr_v3 *p;
	const double *own;  /* their spacings; NULL of some */
	const uint32_t *of; /* which of those given each is */
	size_t n;
	mr_near *near;
	mr_box box;
	double diagonal;
	bool flat;            /* in a plane */
	double spacing, area; /* of their sampling: sampling.usual, sampling.area */
	const mr_v3 *outlier; /* the places that are left out: sampling.outliers */
	const mr_v3 *given;
	const mr_outer_sides *sides; /* of those; NULL: not known */
	mr_sampling sampling;        /* of those given */
} mr_wrap_cloud;

/* Takes the n points and their sampling (NULL: found), and indexes those that count; MR_EMESH where they lie
 * on a line. */
mr_status mr_wrap_cloud_open(
    mr_ctx *ctx, const mr_v3 *point, size_t n, const mr_sampling *sampling, mr_wrap_cloud *cloud);

/* A mesh as a mr_dyn without curves. */
mr_status mr_wrap_dyn(mr_ctx *ctx, const mr_mesh *m, mr_dyn *d);

/* v <- v + alpha (q - v), q the point nearest to v; guarded: by mr_move_unfolded. */
mr_status mr_wrap_project(mr_ctx *ctx, const mr_wrap_cloud *cloud, double alpha, bool guarded, mr_dyn *d);

/* v <- v + lambda Lt, Lt the tangential part of the umbrella vector; guarded: so too.  Boundary
 * vertices stay. */
mr_status mr_wrap_smooth(mr_ctx *ctx, double lambda, bool guarded, mr_dyn *d);

/* Remeshes m to edges of mr_wrap_length, shorter where the points are denser, in one round. */
mr_status mr_wrap_remesh(
    mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *opts, const mr_mesh *m, mr_dyn *d);

/* Draws d, already near, onto the points: vertices move along their normals to the level of the nearest
 * points and are smoothed tangentially; none that would turn a face. */
mr_status
mr_wrap_settle(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, size_t iterations, mr_dyn *d);

/* Takes the vertices of faces that intersect, and those around them, back towards home, d->nv, until none
 * do, if none did there. */
mr_status mr_wrap_part(mr_ctx *ctx, const mr_v3 *home, mr_dyn *d);

/* Edges at which a wrap has about half as many faces as there are points (or some hundreds where these are
 * few), or as long as asked for. */
double mr_wrap_length(const mr_wrap_cloud *cloud, const mr_wrap_opts *o);

/* How well a wrap covers the points, in units of the model. */
typedef struct mr_wrap_cover {
	mr_gaps gaps;
	size_t unreached; /* places, outliers too, more than MR_WRAP_LACKS spacings away */
	mr_v3 at;         /* the farthest */
	size_t crossings; /* pairs of its faces that intersect */
} mr_wrap_cover;

/* Spacings: of sound wraps of clean clouds 3 are rare. */
static const double MR_WRAP_LACKS = 5;

enum { MR_WRAP_SAMPLES = 1 << 14 /* points and parts of the area that are measured */ };

mr_status
mr_wrap_measure(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_mesh *m, size_t samples, mr_wrap_cover *c);

/* Parts of a closed wrap that span no points. */
typedef struct mr_wrap_lids {
	size_t openings; /* cut out */
	size_t holes;    /* left closed: those wider than gaps of the sampling */
	size_t doubtful; /* holes, and openings hardly wider than these may be */
	double width;    /* of the widest of them, in spacings */
	mr_v3 at;        /* its middle */
	bool flickers;   /* the points hardly support the closed part: none is cut out */
} mr_wrap_lids;

/* Spacings: openings that are wider stay open. */
static const double MR_WRAP_OPENING = 8;

/* A wrap, and how well it covers the points. */
typedef struct mr_wrap {
	mr_dyn d;
	mr_wrap_cover cover;
	mr_wrap_lids lids;
	size_t folds;
	mr_wrap_result found; /* method, and its cost; the rest at the end */
} mr_wrap;

/* Measures w->cover and w->folds. */
mr_status mr_wrap_assess(mr_ctx *ctx, const mr_wrap_cloud *cloud, mr_wrap *w);

/* Settles w->d, near the points, on them, unfolds it, parts what passes through itself, and assesses it. */
mr_status mr_wrap_finish(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, mr_wrap *w);

/* Cuts out of m, near the points, what spans an opening of them, by MR_LIDS_AUTO or _NONE, and adds to lids
 * what was found.  flickering: not where support flickers. */
mr_status mr_wrap_cut(
    mr_ctx *ctx, const mr_wrap_cloud *cloud, int how, bool flickering, mr_mesh *m, mr_wrap_lids *lids);

/* d of m, open, by remeshing it and settling it on the points. */
mr_status mr_wrap_settle_open(
    mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, const mr_mesh *m, mr_dyn *d);

/* Cuts so out of d what the options say, and settles the rest where there was something. */
mr_status mr_wrap_open(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, bool flickering,
    mr_wrap_lids *lids, mr_dyn *d);

/* A height field over the plane of axis[0] and axis[1]: its points, and where they are in this. */
typedef struct mr_wrap_field {
	mr_wrap_cloud cloud, flat;
	mr_v3 axis[3];
} mr_wrap_field;

/* The points as one height field or several, one over the other; none where they are no such thing. */
enum { MR_WRAP_FIELD_LEAST = 100 }; /* places of one */
mr_status mr_wrap_find_fields(mr_ctx *ctx, const mr_wrap_cloud *cloud, mr_wrap_field **field, size_t *fields);

/* The wrap of the fields of a cloud: open. */
mr_status mr_wrap_fields(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o,
    const mr_wrap_field *field, size_t fields, mr_wrap *w);

#endif
