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
	const double *own; /* their spacings; NULL of some */
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
 * on a line.  Close with mr_near_free(cloud->near), on failure too. */
mr_status mr_wrap_cloud_open(
    mr_ctx *ctx, const mr_v3 *point, size_t n, const mr_sampling *sampling, mr_wrap_cloud *cloud);

/* About `count` of the points, at equal strides, and their index: enough for long edges.  Close likewise. */
mr_status mr_wrap_cloud_thin(mr_ctx *ctx, const mr_wrap_cloud *cloud, size_t count, mr_wrap_cloud *thin);

/* The surface of a box of edges[0] x edges[1] x edges[2] edges, each at least 1, oriented outward; in the
 * arena. */
mr_status mr_wrap_box(mr_ctx *ctx, mr_box box, const size_t edges[3], mr_mesh *out);

/* The same as a mr_dyn without curves. */
mr_status mr_wrap_dyn(mr_ctx *ctx, const mr_mesh *m, mr_dyn *d);

/* v <- v + alpha (q - v), q the point nearest to v. */
mr_status mr_wrap_project(mr_ctx *ctx, const mr_wrap_cloud *cloud, double alpha, mr_dyn *d);

/* v <- v + lambda Lt, Lt the tangential part of the umbrella vector; `guarded`: by mr_wrap_move.  Boundary
 * vertices stay. */
mr_status mr_wrap_smooth(mr_ctx *ctx, double lambda, bool guarded, mr_dyn *d);

/* Moves the vertices to `to`, d->nv, but those that would turn a face by more than 60 degrees or close it;
 * `to` becomes where they are. */
mr_status mr_wrap_move(mr_ctx *ctx, mr_v3 *to, mr_dyn *d);

/*
 * Draws d closer, of edges of about `length`, by so much at most: vertices go to the point nearest to them,
 * but where there is none within `far` to what lies along their normal, as a film of soap.
 */
mr_status
mr_wrap_draw(mr_ctx *ctx, const mr_wrap_cloud *cloud, double alpha, double length, double far, mr_dyn *d);

/* Remeshes m to edges of about `length`, in one round. */
mr_status mr_wrap_remesh(mr_ctx *ctx, const mr_mesh *m, double length, mr_dyn *d);

/*
 * Draws d, already near, onto the points: vertices move along their normals to the level of the nearest
 * points, and are smoothed tangentially; none that would turn a face.
 */
mr_status
mr_wrap_settle(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, size_t iterations, mr_dyn *d);

/*
 * Takes the vertices of faces that intersect, and those around them, back towards where they were, home,
 * d->nv, until no faces do, if none did there.
 */
mr_status mr_wrap_part(mr_ctx *ctx, const mr_v3 *home, mr_dyn *d);

/* Edges at which a wrap has about half as many faces as there are points (or some hundreds where these are
 * few), or as long as asked for. */
double mr_wrap_length(const mr_wrap_cloud *cloud, const mr_wrap_opts *o);

/* A box around the points, drawn onto them with long edges, which are halved until they are that long. */
mr_status mr_wrap_box_to_points(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, mr_dyn *d);

/* How well a wrap covers the points, in units of the model. */
typedef struct mr_wrap_cover {
	mr_gaps gaps;
	double points_most; /* 90 % of the points are within */
	double missed;      /* the share of them that are farther than MR_WRAP_ENOUGH leaves out */
	size_t lost;        /* outliers that are no nearer than points of a part that it lacks */
	size_t crossings;   /* pairs of its faces that intersect */
} mr_wrap_cover;

mr_status
mr_wrap_measure(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_mesh *m, size_t samples, mr_wrap_cover *c);

/* What a good wrap may leave out and have too much, in sampling distances, of which noise takes some. */
extern const mr_gaps MR_WRAP_ENOUGH;

/* Sampling distances from a point to a wrap that lacks its part: of the sound ones of clean clouds 3 are
 * rare. */
static const double MR_WRAP_LACKS = 5;

/* Points and faces at most that coverage is measured by at the end. */
enum { MR_WRAP_SAMPLES = 1 << 14 };

/* What of a closed wrap spans no points. */
typedef struct mr_wrap_lids {
	size_t openings; /* cut out */
	size_t holes;    /* left closed: those wider than gaps of the sampling */
	size_t doubtful; /* holes, and openings hardly wider than these may be */
	double width;    /* of the widest of them, in spacings */
	mr_v3 at;        /* its middle */
	bool flickers;   /* the points hardly support what they do not leave open: none is cut out */
	size_t loops;    /* of the boundary */
} mr_wrap_lids;

/* Spacings: openings that are wider stay open. */
static const double MR_WRAP_OPENING = 10;

/* A wrap, and how well it covers the points. */
typedef struct mr_wrap {
	mr_dyn d;
	mr_wrap_cover cover;
	mr_wrap_lids lids;
	size_t folds;
	bool sided;           /* by sides of the points that were given */
	mr_wrap_result found; /* method, and what it took; the rest at the end */
} mr_wrap;

/* Adds to the seconds for wraps that were not better. */
void mr_wrap_tried(mr_wrap *w, double seconds);

/* Measures w->cover, and says it as that of `what`. */
mr_status
mr_wrap_assess(mr_ctx *ctx, const mr_wrap_cloud *cloud, size_t samples, const char *what, mr_wrap *w);

/* Settles w->d, near the points, on them, unfolds it, parts what passes through itself; assesses it. */
mr_status
mr_wrap_finish(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, const char *what, mr_wrap *w);

/*
 * Cuts out of m, near the points, what spans an opening of them, by MR_LIDS_AUTO or _NONE, and adds to lids
 * what was found, but for the loops.  flickering: not where support flickers.
 */
mr_status mr_wrap_cut(
    mr_ctx *ctx, const mr_wrap_cloud *cloud, int how, bool flickering, mr_mesh *m, mr_wrap_lids *lids);

/* d of m, open, by remeshing it and settling it on the points. */
mr_status mr_wrap_settle_open(
    mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, const mr_mesh *m, mr_dyn *d);

/* Measures w->cover of what may be open, and counts its loops. */
mr_status mr_wrap_assess_open(mr_ctx *ctx, const mr_wrap_cloud *cloud, mr_wrap *w);

/* Cuts what the options say out of w, closed, and settles the rest. */
mr_status mr_wrap_open(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, mr_wrap *w);

/* Whether the points are a height field over a plane. */
mr_status mr_wrap_is_sheet(mr_ctx *ctx, const mr_wrap_cloud *cloud, mr_v3 axis[3], bool *is_sheet);

/* The wrap of a height field over the plane of axis[0] and axis[1]: open. */
mr_status mr_wrap_sheet(
    mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, const mr_v3 axis[3], mr_wrap *w);

/* Whether any component of d, closed and compact, has a handle. */
mr_status mr_wrap_has_handles(mr_ctx *ctx, const mr_dyn *d, bool *handles);

/* The wrap by volume/volume.h, with its grid and points as they are, or where it is poor, otherwise. */
mr_status mr_wrap_volume(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, mr_wrap *w);

#endif
