/*
 * mr.h -- libmr: what the tools of mr do, as functions; the one header for programs of your own, in C or C++.
 *
 * A frame is a set of named layers, a layer a set of named, typed columns (man/mr-stream.5).  A tool is a
 * function from frame to frame: mr_X_frame does to a frame what mr-X does to each frame of a stream, with the
 * same defaults and the same bytes; man/mr-X.1 says what.
 *
 *	mr_ctx *ctx = mr_ctx_new(0);
 *	mr_frame *f;
 *
 *	if (mr_import(ctx, "bunny.obj", NULL, &f, NULL) < 0 || mr_smooth_frame(ctx, f, NULL, NULL) < 0 ||
 *	    mr_export(ctx, f, "base", "smooth.obj", NULL) < 0)
 *		fprintf(stderr, "%s\n", mr_error(ctx));
 *	mr_ctx_delete(ctx);
 *
 * Status.  A function that can fail returns an mr_status: negative where it failed, with a sentence in
 * mr_error; its outputs are then unchanged.  The library never prints and never exits.
 * Memory.  All that a function gives is the context's, until the context is deleted or an earlier mark is
 * released.  Callers free nothing, except objects with a _free or _delete of their own, which accepts NULL.
 * A frame borrows its columns.
 * Threads.  One context serves one thread at a time; inside, functions use as many threads as the context
 * has, and give the same bytes for any number.
 * Options.  NULL is the defaults, which are MR_..._DEFAULTS, too; impossible values are MR_EUSAGE.  An
 * mr_..._result may be NULL; in it a figure that was not measured is NaN, or MR_UNKNOWN where it is a count.
 */
#ifndef MR_H
#define MR_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#ifdef __GNUC__
#define MR_API         __attribute__((visibility("default")))
#define MR_WARN_UNUSED __attribute__((warn_unused_result))
#else
#define MR_API
#define MR_WARN_UNUSED
#endif

#define MR_UNKNOWN SIZE_MAX
/* Values of all fields, as a line. */
#define MR_DEFAULTS(...) { __VA_ARGS__ }

/* Contexts */

typedef enum mr_status {
	MR_OK = 0,
	MR_END = 1,       /* a reader has nothing more: not a failure */
	MR_EMEM = -1,     /* memory could not be had */
	MR_EIO = -2,      /* the system could not read or write */
	MR_EFORMAT = -3,  /* bytes break the format they claim */
	MR_ERANGE = -4,   /* a number, an index or a size is outside its range */
	MR_EMESH = -5,    /* a mesh or cloud that the algorithm cannot work on */
	MR_ENUMERIC = -6, /* singular, not positive definite, not converged */
	MR_EMISSING = -7, /* a layer or column is not there, or of another shape */
	MR_EUSAGE = -8    /* a wrong option value: the tools exit 2 */
} mr_status;

typedef struct mr_ctx mr_ctx;

/* "1.0" */
MR_API const char *mr_version(void);

/* A context of so many threads, 0: all cores; NULL where there is no memory for it. */
MR_API mr_ctx *mr_ctx_new(unsigned threads);

/* Frees it and all that it gave. */
MR_API void mr_ctx_delete(mr_ctx *ctx);

/* The sentence of the last failure, until the next; empty before the first. */
MR_API const char *mr_error(const mr_ctx *ctx);

typedef struct mr_v3 { double x, y, z; } mr_v3;

/* Findings: flaws of a result that is given all the same; man/mr-findings.7 explains each.  First findings of
 * a surface compared with its former state; then of data; then of algorithms. */
#define MR_FINDINGS(X) \
	X(FOLDED, "folded") X(CROSSING, "crossing") X(COLLIDED, "collided") X(TORN, "torn") \
	X(COARSE, "coarse") X(APART, "apart") X(MISSED, "missed") X(VOLUME, "volume") X(SHRUNK, "shrunk") \
	X(DISTANT, "distant") X(GONE, "gone") \
	X(LOST, "lost") X(STALE, "stale") X(ROUNDED, "rounded") X(GUESSED, "guessed") X(MISSING, "missing") \
	X(REPAIRED, "repaired") \
	X(UNCERTAIN, "uncertain") X(UNREACHED, "unreached") X(BARE, "bare") \
	X(ROUGH, "rough") X(FILLED, "filled") X(INEXACT, "inexact") X(UNHELD, "unheld") X(UNALIGNED, "unaligned") \
	X(LIMIT, "limit") X(LAYER, "layer")

#define MR_FINDING_KIND(kind, name) MR_##kind,
typedef enum mr_finding_kind { MR_FINDINGS(MR_FINDING_KIND) MR_FINDING_KINDS } mr_finding_kind;
#undef MR_FINDING_KIND

/* Strings belong to who reports it, until the call returns. */
typedef struct mr_finding {
	mr_finding_kind kind;
	const char *layer; /* NULL: of none */
	const char *what;  /* a few words where the kind does not say all, NULL: none */
	size_t count, of;  /* how many, of how many; 0: not counted */
	double value;      /* a share, or a number as the kind has it; 0: none */
	double limit;      /* a length that would do, for the remedy; 0: none */
	bool placed;       /* at the worst place: vertex (MR_NO_VERTEX: none) and where that is */
	uint32_t vertex;
	mr_v3 at;
} mr_finding;

#define MR_NO_VERTEX UINT32_MAX

/* "folded", as streams and --stats have it; NULL beyond the last. */
MR_API const char *mr_finding_name(mr_finding_kind kind);

/* Who wants to hear; NULLs do not. */
typedef struct mr_listener {
	void (*found)(void *user, const mr_finding *finding);         /* flaws of a result */
	void (*note)(void *user, const char *text);                   /* remarks, as of -v */
	void (*progress)(void *user, const char *what, double share); /* share done, 0 to 1 */
	void *user;                                                   /* passed to all */
} mr_listener;

MR_API void mr_listen(mr_ctx *ctx, const mr_listener *listener);

/* A place in the context's memory: releasing it frees what was given since. */
typedef struct mr_mark {
	uint64_t serial;
	size_t used;
} mr_mark;

MR_API mr_mark mr_mark_take(const mr_ctx *ctx);
MR_API void mr_mark_release(mr_ctx *ctx, mr_mark mark);

/* Meshes */

typedef struct mr_tri { uint32_t v[3]; } mr_tri; /* counter-clockwise, seen from outside */

/* A view of arrays that somebody else keeps; without faces a cloud of points. */
typedef struct mr_mesh {
	const char *name; /* of the layer, for sentences */
	const mr_v3 *p;   /* nv positions */
	const mr_tri *t;  /* nf triangles */
	size_t nv, nf;    /* both below 2^32 - 1; 3 nf below 2^32 - 1 */
} mr_mesh;

/* Frames */

typedef struct mr_frame mr_frame;

/* The type of a column: `element` v (a vertex), f (a face) or - (neither); `type` d (double), u (uint32_t), b
 * (byte) or t (text); components per row. */
typedef struct mr_shape {
	char element, type;
	uint8_t components;
} mr_shape;

/* An empty key frame.  MR_ERANGE for a name that the format forbids. */
MR_API mr_status mr_frame_new(mr_ctx *ctx, const char *name, mr_frame **frame) MR_WARN_UNUSED;

MR_API const char *mr_frame_name(const mr_frame *frame);

/* Column i of all, in their order; false after the last.  Each output may be NULL. */
MR_API bool mr_frame_column(
    const mr_frame *frame, size_t i, const char **layer, const char **name, mr_shape *shape, uint64_t *rows);

/* Whether the frame has any column of the layer; whether it has that column. */
MR_API bool mr_frame_has_layer(const mr_frame *frame, const char *layer);
MR_API bool mr_layer_has(const mr_frame *frame, const char *layer, const char *name);

/* The column's values, decoded.  MR_EMISSING where it is absent or of another
 * shape; MR_EFORMAT where they cannot be unpacked.  data: rows x components values, the frame's. */
MR_API mr_status mr_frame_get(mr_ctx *ctx, mr_frame *frame, const char *layer, const char *name,
    mr_shape shape, const void **data, size_t *rows) MR_WARN_UNUSED;

/* Puts or replaces a column (in its old place).  data: rows x components values, borrowed.  MR_ERANGE for
 * names and shapes that the format forbids. */
MR_API mr_status mr_frame_put(mr_ctx *ctx, mr_frame *frame, const char *layer, const char *name,
    mr_shape shape, const void *data, size_t rows) MR_WARN_UNUSED;

/* Removes a column if it is there.  With layer NULL: from every layer.  With name NULL: the whole layer.  With
 * element not 0: only columns of that element. */
MR_API void mr_frame_drop(mr_frame *frame, const char *layer, const char *name, char element);

/* The layer's surface: positions, of which the largest coordinate is 0 or within 1e-30 and 1e30, and
 * triangles, checked.  MR_EMISSING without them; MR_EMESH of no face; MR_ERANGE. */
MR_API mr_status mr_layer_mesh(mr_ctx *ctx, mr_frame *f, const char *layer, mr_mesh *m) MR_WARN_UNUSED;

/* The layer's positions, checked; faces are not looked at (m->t NULL, nf 0). */
MR_API mr_status mr_layer_points(mr_ctx *ctx, mr_frame *f, const char *layer, mr_mesh *m) MR_WARN_UNUSED;

/* Puts positions, which must be finite, and triangles; replacing others drops stale columns, and warns. */
MR_API mr_status mr_layer_put_mesh(
    mr_ctx *ctx, mr_frame *f, const char *layer, const mr_mesh *m) MR_WARN_UNUSED;

/* The kind of a layer's last change. */
typedef enum mr_change {
	MR_POSED,       /* the same surface, elsewhere */
	MR_RESHAPED,    /* another surface of the same vertices and triangles */
	MR_RECONNECTED, /* other vertices or triangles */
	MR_RESELECTED   /* the same surface with other regions */
} mr_change;

/* Puts positions alone, which must be finite: the layer is posed or reshaped. */
MR_API mr_status mr_layer_move(
    mr_ctx *ctx, mr_frame *f, const char *layer, mr_change change, const mr_v3 *p, size_t nv) MR_WARN_UNUSED;

/* Regions (column `region`): fixed, free, or handle number region - MR_REGION_HANDLE. */
enum { MR_REGION_FIXED = 0, MR_REGION_FREE = 1, MR_REGION_HANDLE = 2 };

/* Puts regions; what followed from others is dropped. */
MR_API mr_status mr_layer_put_region(
    mr_ctx *ctx, mr_frame *f, const char *layer, const uint32_t *region, size_t nv) MR_WARN_UNUSED;

/* Streams */

typedef struct mr_reader mr_reader;
typedef struct mr_writer mr_writer;

/* Reads from a descriptor, which stays the caller's, from where it stands; a regular file is mapped and must
 * not be cut meanwhile. */
MR_API mr_status mr_reader_open(mr_ctx *ctx, int fd, mr_reader **reader) MR_WARN_UNUSED;

/* MR_OK: *frame is the next one, a delta merged with the columns it keeps, valid until the next call; MR_END:
 * all streams have ended well, and the last frame stays valid; else failed, and every further call fails. */
MR_API mr_status mr_reader_next(mr_ctx *ctx, mr_reader *reader, mr_frame **frame) MR_WARN_UNUSED;

MR_API void mr_reader_free(mr_reader *reader);

typedef enum mr_packing { MR_KEEP, MR_PACK, MR_UNPACK } mr_packing;

/* Writes to a descriptor, which stays the caller's. */
MR_API mr_status mr_writer_open(mr_ctx *ctx, int fd, mr_packing packing, mr_writer **writer) MR_WARN_UNUSED;

/* Sends a frame: a key whole, of a delta what differs from the frame before. */
MR_API mr_status mr_writer_put(mr_ctx *ctx, mr_writer *writer, const mr_frame *frame) MR_WARN_UNUSED;

/* Says that a frame was left out: the next one is sent complete. */
MR_API void mr_writer_skipped(mr_writer *writer);

/* Writes END, after which nothing can be written: call it only when all went well. */
MR_API mr_status mr_writer_end(mr_ctx *ctx, mr_writer *writer) MR_WARN_UNUSED;

MR_API void mr_writer_free(mr_writer *writer);

/* Files of other programs: mr-import, mr-export */

typedef struct mr_import_opts {
	const char *format; /* NULL: by the bytes */
	const char *layer;  /* NULL: mesh, without faces points */
	bool points;        /* leave out the faces */
	bool repair;        /* make an oriented manifold of the faces */
	bool outward;       /* turn parts that are inside out */
	bool welds;         /* join vertices no further apart than weld */
	double weld;        /* below 0: found from the boundary, whose vertices alone are joined */
	bool weld_relative; /* weld is a share of the bounding box's diagonal */
} mr_import_opts;

#define MR_IMPORT_DEFAULTS MR_DEFAULTS(NULL, NULL, false, false, false, false, 0, false)

/* The frames of a file; losses are reported as findings. */
typedef struct mr_import_result {
	size_t vertices, triangles;            /* of the frame */
	size_t polygons;                       /* faces of more than three corners */
	size_t seam_vertices, crease_vertices; /* of several texture coordinates; of several normals */
} mr_import_result;

/* Reads a file ("-": stdin) as a key frame that is named by its stem. */
MR_API mr_status mr_import(mr_ctx *ctx, const char *path, const mr_import_opts *opts, mr_frame **frame,
    mr_import_result *result) MR_WARN_UNUSED;

/* Writes a layer (NULL: the one worked on last, else mesh, control, points or base) to a file ("-": stdout),
 * whole or not at all.  format: NULL: by the suffix.  Losses of the format are reported as findings. */
MR_API mr_status mr_export(
    mr_ctx *ctx, mr_frame *f, const char *layer, const char *path, const char *format) MR_WARN_UNUSED;

/* Data that may outlive a frame: a factorization, an index.  A delta that left its sources unchanged finds it
 * again; never does it change a byte, and it may be NULL wherever it is given. */
typedef struct mr_cache mr_cache;

MR_API mr_cache *mr_cache_new(void); /* NULL where there is no memory for it */

/* Frames that were given the cache may borrow from it: not before they are done with. */
MR_API void mr_cache_delete(mr_cache *cache);

/* Editing: Botsch, Kobbelt 2004 */

typedef enum mr_smooth_method {
	MR_SMOOTH_IMPLICIT, /* (M + t L) p' = M p, by conjugate gradients: any time in one pass */
	MR_SMOOTH_TAUBIN    /* a pass forth and one back, so the volume stays: up to 0.15 a pass */
} mr_smooth_method;

typedef struct mr_smooth_opts {
	int method;    /* mr_smooth_method */
	double time;   /* in all, in squared mean edge lengths of the input */
	size_t passes; /* 0: 1 implicit pass; of Taubin's 8 for each unit of time */
	bool plain;    /* the same time everywhere, as in the paper; else no more than fits the thickness */
	const char *layer; /* NULL: base, else mesh */
} mr_smooth_opts;

#define MR_SMOOTH_DEFAULTS MR_DEFAULTS(MR_SMOOTH_IMPLICIT, 10, 0, false, NULL)

typedef struct mr_smooth_result {
	size_t passes;
	size_t bounded;    /* vertices that were smoothed for less time, because the body is thin there */
	size_t iterations; /* of the implicit system, in all passes */
	double mean_edge;
	double area, volume; /* shares of the input's that are left; volume of closed surfaces */
} mr_smooth_result;

MR_API mr_status mr_smooth_frame(
    mr_ctx *ctx, mr_frame *f, const mr_smooth_opts *opts, mr_smooth_result *result) MR_WARN_UNUSED;

typedef struct mr_remesh_opts {
	double length; /* target edge length; 0: ratio times the edge of the triangle of mean area */
	bool length_relative; /* length is a share of the bounding box's diagonal */
	double ratio;
	size_t rounds;          /* of split, collapse, flip, relocate */
	size_t area_passes;     /* of area-based smoothing at most */
	double gravity;         /* exponent of the area in the centroid; 1 is the paper's */
	double feature;         /* dihedral angle in degrees from which an edge is kept; 180: none */
	size_t vertices, faces; /* to come near, whatever the length; 0: by the length */
	double adaptive;        /* distance of an edge to the surface that sets the lengths; 0: uniform */
	bool adaptive_relative;
	bool project; /* keep the vertices on the input surface */
	const char *layer; /* NULL: base, else mesh */
	const double *lengths; /* at each vertex, in units of the model, at most; NULL: by the others */
} mr_remesh_opts;

#define MR_REMESH_DEFAULTS MR_DEFAULTS(0, false, 0.95, 5, 20, 1.5, 180, 0, 0, 0, false, true, NULL, NULL)

typedef struct mr_remesh_result {
	double length; /* target edge length; the mean where it is adaptive */
	size_t splits, collapses, flips;
	size_t vertices, faces; /* of the result */
	double area_variance_before, area_variance_after; /* of the Voronoi areas over their squared mean */
	size_t flipped, folded; /* faces against the input; edges */
} mr_remesh_result;

MR_API mr_status mr_remesh_frame(
    mr_ctx *ctx, mr_frame *f, const mr_remesh_opts *opts, mr_remesh_result *result) MR_WARN_UNUSED;

typedef struct mr_fill_opts {
	double max_length; /* of a loop that is filled; 0: any */
	bool max_length_relative; /* max_length is a share of the bounding box's diagonal */
	size_t loops; /* the shortest, so many; 0: all, but without max_length the rims of open surfaces */
	size_t order; /* k: 1 membrane, 2 thin plate, 3 minimal variation of curvature */
	const char *layer; /* NULL: mesh, else base */
} mr_fill_opts;

#define MR_FILL_DEFAULTS MR_DEFAULTS(0, false, 0, 2, NULL)

typedef struct mr_fill_result {
	size_t loops, filled;   /* boundary loops there were, and those that are filled */
	size_t crossing;        /* loops left open because their patch would cross the surface */
	size_t vertices, faces; /* new ones, after the old ones */
} mr_fill_result;

/* Fills boundary loops by patches that go on smoothly (Liepa 2003; Botsch, Kobbelt 2004): old vertices and
 * faces stay as they are, bit for bit.  Other layers' references to the layer are dropped.  MR_EMESH without
 * a face; MR_ENUMERIC if the system has no solution in doubles. */
MR_API mr_status mr_fill_frame(
    mr_ctx *ctx, mr_frame *f, const mr_fill_opts *opts, mr_fill_result *result) MR_WARN_UNUSED;

/* Vertices for which a predicate of mr-select holds ("all", "above:y,0.8", ...) and their region. */
typedef struct mr_rule {
	uint32_t region;
	const char *predicate;
} mr_rule;

typedef struct mr_select_opts {
	bool reset;        /* begin with all vertices fixed, not with the regions there are */
	const char *layer; /* NULL: mesh, else control, else points */
} mr_select_opts;

#define MR_SELECT_DEFAULTS MR_DEFAULTS(false, NULL)

typedef struct mr_select_result {
	size_t fixed, free, handles; /* vertices */
	size_t handle_count;         /* the highest handle in use, plus one */
	const size_t *handle;        /* handle_count: vertices of each */
} mr_select_result;

/* Applies n rules in order: later ones win. */
MR_API mr_status mr_select_frame(mr_ctx *ctx, mr_frame *f, const mr_rule *rules, size_t n,
    const mr_select_opts *opts, mr_select_result *result) MR_WARN_UNUSED;

/* Maps all layers, or the one that is named, by an affine map of 3 x 4, row-major; a map that mirrors turns
 * their faces over.  MR_EMESH where something in the frame cannot follow it. */
MR_API mr_status mr_transform_frame(
    mr_ctx *ctx, mr_frame *f, const char *layer, const double map[12]) MR_WARN_UNUSED;

typedef struct mr_normals_opts {
	size_t neighbours; /* that show the plane of a point; 0: by the noise */
	bool keep, flip;   /* leave the normals that are there and fit; turn all over at the end */
	const mr_v3 *from; /* normals of points point there; NULL: to column scanner, or outward */
	const char *layer; /* NULL: mesh, else control, else points */
} mr_normals_opts;

typedef struct mr_normals_result {
	size_t kept, estimated, outliers; /* the last have the normals of their nearest points */
	double agree; /* share of the normals there were that are on the side of those there are */
} mr_normals_result;

/* Puts normals.  opts: zeros are the defaults. */
MR_API mr_status mr_normals_frame(
    mr_ctx *ctx, mr_frame *f, const mr_normals_opts *opts, mr_normals_result *result) MR_WARN_UNUSED;

typedef struct mr_crop_result { size_t vertices, faces, vertices_dropped, faces_dropped; } mr_crop_result;

/* Keeps the vertices that n rules, in their order, make free, and drops the fixed ones; if the first rule
 * makes some free the others begin fixed.  layer: NULL: mesh, else control, else points. */
MR_API mr_status mr_crop_frame(mr_ctx *ctx, mr_frame *f, const char *layer, const mr_rule *rules, size_t n,
    mr_crop_result *result) MR_WARN_UNUSED;

typedef struct mr_split_opts {
	double distance;        /* of points, at which they are connected; 0: four times their spacing */
	bool distance_relative; /* distance is a share of the bounding box's diagonal */
	size_t least;           /* vertices of a part; 0: 2 of a mesh, of points a hundredth of the largest part's */
	const char *layer;      /* NULL: mesh, else control, else points */
} mr_split_opts;

typedef struct mr_split_result {
	size_t parts, largest, smallest, dropped, dropped_vertices; /* dropped: parts too small */
} mr_split_result;

/* A key frame of the layer alone for each connected part, the largest first: result->parts of them.  opts:
 * zeros are the defaults. */
MR_API mr_status mr_split_frame(mr_ctx *ctx, mr_frame *f, const mr_split_opts *opts, mr_frame ***parts,
    mr_split_result *result) MR_WARN_UNUSED;

typedef struct mr_encode_result {
	size_t heights, offsets;         /* vertices that have one, the other */
	double residual_max, height_max; /* of the mesh's diagonal */
} mr_encode_result;

MR_API mr_status mr_encode_frame(mr_ctx *ctx, mr_frame *f, mr_encode_result *result) MR_WARN_UNUSED;

/* Translation, rotation and scaling about a centre: T = C translate rotate scale C^-1. */
typedef struct mr_pose {
	mr_v3 translate;
	mr_v3 axis; /* of the rotation, of any length but zero where degrees is not */
	double degrees;
	mr_v3 scale; /* along x, y, z */
	bool centered;
	mr_v3 center; /* where centered; else the centroid of the handle's vertices, as posed so far */
} mr_pose;

#define MR_POSE_REST MR_DEFAULTS({ 0, 0, 0 }, { 0, 0, 1 }, 0, { 1, 1, 1 }, false, { 0, 0, 0 })

/* The motion of a handle, after its motions so far.  layer: with the regions; NULL: mesh, else control. */
MR_API mr_status mr_pose_frame(
    mr_ctx *ctx, mr_frame *f, const char *layer, size_t handle, const mr_pose *pose) MR_WARN_UNUSED;

typedef enum mr_solver_choice {
	MR_SOLVER_AUTO, /* Cholesky, LU of the unsymmetric system, multigrid where the factor is too large */
	MR_SOLVER_CHOLESKY, MR_SOLVER_CHOLMOD, MR_SOLVER_LU, MR_SOLVER_CG, MR_SOLVER_MULTIGRID, MR_SOLVER_VCYCLE
} mr_solver_choice;

typedef enum mr_areas {
	MR_AREAS_VORONOI, /* each vertex its own */
	MR_AREAS_MEAN     /* all the same: Botsch, Kobbelt 2004, section 4.2 */
} mr_areas;

typedef enum mr_rotations_choice {
	MR_ROTATIONS_INTERPOLATED, /* their logarithms: any angle */
	MR_ROTATIONS_LINEAR        /* their matrices, as a response does: up to a third of a turn */
} mr_rotations_choice;

typedef struct mr_solve_opts {
	size_t order;      /* k: 1 membrane, 2 thin plate, 3 minimal variation of curvature */
	int solver;        /* mr_solver_choice */
	int areas;         /* mr_areas */
	bool unsymmetric;  /* the paper's own system; else a row scaling of it, which is symmetric */
	bool basis;        /* also put the response to every handle */
	double tol;        /* relative residual that iterative solvers reach; 0: 1e-10 */
	size_t iterations; /* at most */
	double memory;     /* bytes that a factor may take; 0: what there is */
	int rotations;     /* mr_rotations_choice, of poses by handles */
	size_t arap;       /* rounds of as-rigid-as-possible steps on top of a pose */
	bool apart;        /* parts neither hold to those that they touch, nor follow those near */
	bool flatten;      /* without handles: the undeformed solve of the paper; else nothing moves */
	const char *layer; /* NULL: base, else control */
} mr_solve_opts;

#define MR_SOLVE_DEFAULTS                                                                                    \
	MR_DEFAULTS(2, MR_SOLVER_AUTO, MR_AREAS_VORONOI, false, false, 0, 20000, 0,                \
	    MR_ROTATIONS_INTERPOLATED, 0, false, false, NULL)

typedef struct mr_solve_result {
	size_t free, fixed, handle_vertices, handles;
	size_t isolated_components; /* free, without a constrained vertex */
	double negative_weights; /* share of the edges */
	double nnz_factor;
	double seconds_assemble, seconds_analyse, seconds_factor, seconds_solve;
	size_t iterations;
	double rcond, residual;
} mr_solve_result;

MR_API mr_status mr_solve_frame(mr_ctx *ctx, mr_frame *f, const mr_solve_opts *opts, mr_cache *cache,
    mr_solve_result *result) MR_WARN_UNUSED;

typedef struct mr_gap { double mean, high, max; } mr_gap; /* of distances: 99 % are at most high */

/* How far points that count are from a surface, and it from them, in units of the positions. */
typedef struct mr_gaps {
	mr_gap points, surface;
	double bare; /* share of its area that stands far from all points for how densely they lie there */
} mr_gaps;

typedef enum mr_decode_source {
	MR_FROM_ANY, /* detail where it is there, else heights */
	MR_FROM_DETAIL,
	MR_FROM_CONTROL
} mr_decode_source;

/* Frames to mend: key frames, all, none. */
typedef enum mr_mended { MR_MEND_KEYS, MR_MEND_ALL, MR_MEND_NONE } mr_mended;

typedef struct mr_decode_opts {
	double gain;  /* multiplies the detail */
	int from;     /* mr_decode_source */
	size_t level; /* subdivisions of the control mesh; MR_UNKNOWN: as many as have heights */
	int mend;     /* mr_mended */
} mr_decode_opts;

#define MR_DECODE_DEFAULTS MR_DEFAULTS(1, MR_FROM_ANY, MR_UNKNOWN, MR_MEND_KEYS)

MR_API mr_status mr_decode_frame(mr_ctx *ctx, mr_frame *f, const mr_decode_opts *opts, mr_cache *cache) MR_WARN_UNUSED;

/* Reconstruction: Jeong, Kim 2001 */

/* Whichever covers the points; the paper's cube, to the letter: genus 0; an implicit surface, then settled. */
typedef enum mr_wrap_method { MR_WRAP_AUTO, MR_WRAP_CUBE, MR_WRAP_VOLUME } mr_wrap_method;

/* Openings to close: narrow holes of the sampling, all, none. */
typedef enum mr_wrap_lids_closed { MR_LIDS_AUTO, MR_LIDS_ALL, MR_LIDS_NONE } mr_wrap_lids_closed;

typedef struct mr_wrap_opts {
	int method;          /* mr_wrap_method */
	int lids;            /* mr_wrap_lids_closed */
	size_t resolution;   /* edges of the wrap along a side of the bounding cube; 0: by the sampling */
	size_t grid;         /* cells of the volume; 0: from the sampling density */
	double alpha;        /* share of the way to the nearest point */
	double lambda;       /* of tangential smoothing */
	size_t iterations;   /* of projection and smoothing; 0: as many as the method needs by default */
	bool template_mesh;  /* wrap the mesh that is in control */
	bool ignore_normals; /* the points', and where they were seen from */
	const char *layer;   /* NULL: points */
} mr_wrap_opts;

#define MR_WRAP_DEFAULTS MR_DEFAULTS(MR_WRAP_AUTO, MR_LIDS_AUTO, 0, 0, 0.5, 0.2, 0, false, false, NULL)

/* Method of the implicit surface. */
typedef struct mr_volume_result {
	size_t samples, sided; /* points that counted; whose sides were used */
	double spacing, cell;  /* side of the square that a point stands for; of a cell */
	double noise;          /* squares of so many spacings show a surface: at least 1 */
	size_t levels_alike;   /* values of the indicator of the same topology */
	double euler;          /* Euler number */
	bool turned;                /* the sides of the points were inside, and are turned over */
} mr_volume_result;

typedef struct mr_wrap_result {
	size_t method;           /* 1 cube, 2 volume, 3 template, 4 height field */
	size_t places, outliers; /* of the points */
	double sampling;         /* distance of the places */
	size_t resolution, iterations, faces, folded_edges, intersecting_pairs;
	size_t unreached;              /* places beyond five such distances, outliers too */
	size_t openings, holes; /* left open; closed */
	mr_gaps gaps;
	mr_volume_result volume;
} mr_wrap_result;

MR_API mr_status mr_shrinkwrap_frame(
    mr_ctx *ctx, mr_frame *f, const mr_wrap_opts *opts, mr_wrap_result *result) MR_WARN_UNUSED;

/* Vertices of boundaries, of seams of texture coordinates and borders of materials, or of a region. */
typedef enum mr_lock { MR_LOCK_NONE, MR_LOCK_BOUNDARY, MR_LOCK_SEAMS, MR_LOCK_REGION } mr_lock;

typedef struct mr_simplify_opts {
	size_t faces; /* stop at so many, or one less; 0: by ratio */
	double ratio; /* share of the faces to stop at; 0: by error; all 0: by the frame */
	double error; /* root mean square distance from the planes of the faces merged, at most; 0: any */
	bool error_relative;  /* error is a share of the bounding box's diagonal */
	const double *room;   /* error allowed at each vertex, absolute; NULL: any */
	size_t most;          /* faces beyond which room does not count */
	size_t fine;          /* faces to stop at where there are more than that; 0: at `most` */
	double boundary;      /* weight of the planes that hold boundary edges */
	bool creases, smooth; /* sharp edges of a control mesh: or say why not; none; else as points show */
	const double *weight; /* of the surface at each vertex; NULL: by the frame's points, if it has some */
	const char *to;       /* layer that is written; NULL: the one that is simplified */
	const char *layer;    /* NULL: control, else base, else mesh */
	int lock;             /* mr_lock: which vertices stay, to the bit */
	size_t region;        /* of MR_LOCK_REGION */
	double attributes;    /* weight of texture coordinates and colours beside distances; 0: none */
} mr_simplify_opts;

#define MR_SIMPLIFY_DEFAULTS                                                                                         \
	MR_DEFAULTS(0, 0, 0, false, NULL, 0, 0, 10, false, false, NULL, NULL, NULL, MR_LOCK_NONE, 0, 1)

typedef struct mr_simplify_result {
	size_t vertices, faces; /* of the result */
	size_t merges;          /* of edges */
	size_t creases;         /* edges of the result that are marked to be sharp */
	double error;           /* the largest that was made */
} mr_simplify_result;

MR_API mr_status mr_simplify_frame(
    mr_ctx *ctx, mr_frame *f, const mr_simplify_opts *opts, mr_simplify_result *result) MR_WARN_UNUSED;

/* Each vertex by the point nearest its limit point (Suzuki et al. 1999, as the paper has it); or all at once. */
typedef enum mr_fit_method { MR_FIT_LOCAL, MR_FIT_LEAST_SQUARES } mr_fit_method;

typedef struct mr_fit_opts {
	int method;        /* mr_fit_method */
	size_t iterations; /* 0: as many as the method needs by default */
	double step;       /* of local: share of the force taken */
	double fairness;   /* of least-squares: weight of the smoothness term */
	const char *layer; /* NULL: control */
} mr_fit_opts;

#define MR_FIT_DEFAULTS MR_DEFAULTS(MR_FIT_LEAST_SQUARES, 0, 0.8, 0.1, NULL)

typedef struct mr_fit_result {
	size_t iterations, outliers;
	double distance_mean_before, distance_rms_before, distance_max_before; /* of the points */
	double distance_mean_after, distance_rms_after, distance_max_after;
	size_t folded_edges_before, folded_edges_after; /* of two subdivisions, at their limit points */
	size_t crossing_faces; /* of the control mesh */
} mr_fit_result;

MR_API mr_status mr_fit_frame(
    mr_ctx *ctx, mr_frame *f, const mr_fit_opts *opts, mr_fit_result *result) MR_WARN_UNUSED;

typedef enum mr_sample_method {
	MR_SAMPLE_AUTO,     /* robust, where the points are noisy */
	MR_SAMPLE_TRIANGLE, /* the paper's search for the valid triangle among the nearest points */
	MR_SAMPLE_ROBUST    /* those nearest to all points and fair, for noise and outliers */
} mr_sample_method;

typedef struct mr_sample_opts {
	int method;        /* mr_sample_method */
	size_t neighbours; /* nearest points looked at */
	size_t refine;     /* passes that fit the heights to the points by least squares */
	size_t level;      /* subdivisions of the control mesh; MR_UNKNOWN: as many vertices as points */
	const char *layer; /* NULL: points, else mesh */
} mr_sample_opts;

#define MR_SAMPLE_DEFAULTS MR_DEFAULTS(MR_SAMPLE_AUTO, 30, 3, MR_UNKNOWN, NULL)

typedef struct mr_sample_result {
	size_t level, vertices; /* of the domain */
	size_t outliers;
	double tries_1, tries_4, tries_10;  /* shares of the vertices that so many triangles were tried for */
	size_t missed;                      /* vertices without a triangle */
	size_t spikes, filled;              /* heights taken back, and filled in */
	double fairness, gap_mean, gap_max; /* gap: from the points, in shares of the diagonal */
	double area_ratio;                  /* of the surface to its domain */
	size_t folds;                       /* triangles that fold over or pass through others */
	mr_gaps gaps;                       /* of the displaced surface; of points */
} mr_sample_result;

MR_API mr_status mr_sample_frame(
    mr_ctx *ctx, mr_frame *f, const mr_sample_opts *opts, mr_sample_result *result) MR_WARN_UNUSED;

enum { MR_LEVEL_MAX = 15 }; /* of subdivision */

/* Displaced surfaces in few bytes (mr-compact(5)): mr-pack, mr-unpack */

typedef struct mr_pack_opts {
	double error; /* mean distance that it adds up to, as a share of the diagonal; 0: as `bytes` allow */
	size_t bytes; /* at most; 0: as many as the error asks for */
} mr_pack_opts;

#define MR_PACK_DEFAULTS MR_DEFAULTS(1e-4, 0)

typedef struct mr_pack_result {
	size_t bytes, control_bytes; /* of all; of the control mesh */
	size_t level, vertices;
	double error, error_max; /* from the points or mesh that it came from, both ways, in shares of the diagonal */
} mr_pack_result;

/* byte: size, of the context. */
MR_API mr_status mr_pack_frame(mr_ctx *ctx, mr_frame *f, const mr_pack_opts *opts, const void **byte, size_t *size,
    mr_pack_result *result) MR_WARN_UNUSED;

typedef struct mr_unpack_opts {
	size_t bytes; /* read no more; 0: all */
	size_t level; /* of the surface; MR_UNKNOWN: the finest */
} mr_unpack_opts;

#define MR_UNPACK_DEFAULTS MR_DEFAULTS(0, MR_UNKNOWN)

typedef struct mr_unpack_result {
	size_t bytes, level, finest, vertices; /* finest: level that the file has */
} mr_unpack_result;

/* A key frame of control and displacement; of the first bytes alone, if they hold the control mesh, it is coarser. */
MR_API mr_status mr_unpack_frame(mr_ctx *ctx, const void *byte, size_t size, const mr_unpack_opts *opts,
    mr_frame **frame, mr_unpack_result *result) MR_WARN_UNUSED;

typedef struct mr_subdivide_opts {
	size_t level;          /* how many times each triangle becomes four */
	bool limit;            /* move the vertices onto the limit surface */
	double crease;         /* keep edges whose faces meet at more degrees; 180: none */
	double longest;        /* instead, divide edges that are longer, the surface as it is; 0: not */
	bool longest_relative; /* longest is a share of the bounding box's diagonal */
	const char *layer;     /* NULL: control, else mesh */
} mr_subdivide_opts;

#define MR_SUBDIVIDE_DEFAULTS MR_DEFAULTS(1, false, 180, 0, false, NULL)

typedef struct mr_subdivide_result {
	size_t vertices, faces;
	double seconds;
} mr_subdivide_result;

MR_API mr_status mr_subdivide_frame(mr_ctx *ctx, mr_frame *f, const mr_subdivide_opts *opts, mr_cache *cache,
    mr_subdivide_result *result) MR_WARN_UNUSED;

/* gain: `gains` factors, of the control mesh's heights and of each level's, coarse first; further ones are 1. */
MR_API mr_status mr_equalize_frame(
    mr_ctx *ctx, mr_frame *f, const double *gain, size_t gains, mr_cache *cache) MR_WARN_UNUSED;

/* Models from nothing: mr-make */

typedef enum mr_solid {
	MR_SPHERE, MR_TORUS, MR_CUBE, MR_PLANE, MR_CYLINDER, MR_KNOT, MR_BUMPY, MR_BOXES, MR_SOLIDS
} mr_solid;

typedef struct mr_make_opts {
	mr_solid solid;
	size_t vertices;     /* about how many; 0: 10,000, and 30,000 for bumpy */
	size_t genus;        /* of boxes */
	bool open;           /* cylinder: without its caps */
	bool texcoords;      /* with texture coordinates */
	double noise;        /* standard deviation, along the normals */
	bool noise_relative; /* noise is a share of the bounding box's diagonal */
	size_t points;       /* a cloud of so many instead of the mesh, uniform by area; 0: the mesh */
	uint64_t seed;       /* of points and noise */
} mr_make_opts;

#define MR_MAKE_DEFAULTS MR_DEFAULTS(MR_SPHERE, 0, 2, false, false, 0, false, 0, 1)

/* A key frame with mesh or points. */
MR_API mr_status mr_make(mr_ctx *ctx, const mr_make_opts *opts, mr_frame **frame) MR_WARN_UNUSED;

/* Measuring: mr-info */

typedef struct mr_box { mr_v3 min, max; } mr_box;

/*
 * Counts.  Faces that have a vertex twice count as degenerate and nowhere else.
 *
 *	euler       vertices that a face uses, less edges, plus faces
 *	genus       summed over components, boundary loops capped; MR_UNKNOWN of other than oriented manifolds
 *	boundary    edges of one face; loops of them, two that touch at a vertex are two
 *	non-manifold edges of three faces or more; vertices whose faces form more than one fan
 *	inconsistent edges of two faces that run along it in the same direction
 *	degenerate  faces with a vertex twice or of zero area (exactly)
 *	duplicate   faces with the corners of an earlier one, in any order
 *	isolated    vertices that no face uses
 *	folded      edges of two faces whose normals, consistently oriented, are more than 170 degrees apart
 */
typedef struct mr_census {
	size_t edges, components;
	int64_t euler;
	size_t genus;
	bool oriented, manifold; /* no inconsistent edge; no non-manifold edge nor vertex */
	size_t boundary_edges, boundary_loops;
	size_t nonmanifold_edges, nonmanifold_vertices, inconsistent_edges;
	size_t degenerate_faces, duplicate_faces, isolated_vertices, folded_edges;
} mr_census;

/* Over some set of numbers; deviation is the standard deviation.  NaN of none. */
typedef struct mr_spread {
	double min, mean, max, deviation;
} mr_spread;

/* Sizes in units of the positions, angles in degrees. */
typedef struct mr_geometry {
	mr_box box;
	double diagonal, area;
	double volume;  /* enclosed, positive where normals point outward; only of a closed, oriented mesh */
	mr_spread edge; /* lengths */
	double angle_min, angle_max;
	double angle_error; /* mean |angle - 60| */
	double valence6;    /* share of the vertices in faces with 6 neighbours, 4 on the boundary */
} mr_geometry;

/* Mixed Voronoi areas A of the vertices of faces that no boundary edge ends at.  NaN without any. */
typedef struct mr_evenness {
	size_t vertices;
	double mean;
	double error;    /* mean |A - mean| / mean */
	double variance; /* variance / mean^2 */
} mr_evenness;

typedef struct mr_surface_figures {
	mr_census census;
	mr_geometry geometry;
	mr_evenness evenness;
	size_t intersections; /* pairs of faces */
} mr_surface_figures;

/* Figures of any mesh with valid indices and finite positions.  intersections: whether to count them. */
MR_API mr_status mr_measure_surface(
    mr_ctx *ctx, const mr_mesh *m, bool intersections, mr_surface_figures *figures) MR_WARN_UNUSED;

/* Figures of points, finite or not; all but these counts are of the finite ones.  NaN: undefined, as of one
 * place. */
typedef struct mr_cloud_figures {
	size_t points, not_finite;
	size_t duplicates; /* points at the place of an earlier one */
	mr_box box;
	double diagonal;
	size_t places, outliers; /* of the places: on no surface; what follows is of the others */
	mr_spread spacing;       /* side of the square of surface that a place has to itself */
	double usual, area;      /* median spacing; the sum of these squares */
	double evenness; /* of the spacings, 10 % of places over 90 % of them: 1 where they are equal */
	double noise;    /* deviation from a smooth surface */
	double noise_spacing, noise_diagonal; /* in median spacings, and in diagonals */
} mr_cloud_figures;

/* The sampling of a layer's points. */
MR_API mr_status mr_measure_cloud(
    mr_ctx *ctx, mr_frame *f, const char *layer, mr_cloud_figures *figures) MR_WARN_UNUSED;

/* Measuring: mr-compare */

typedef struct mr_compare_opts {
	size_t samples; /* pieces of about equal area to integrate over, one a face at least; 0: 100,000 */
	bool vertices_only; /* measure from the vertices alone, each weighing one */
	double tolerance;   /* max_bound is sought within this share of max */
	size_t effort;      /* most pieces looked at for it, besides; 0: 200,000, or two a face if more */
} mr_compare_opts;

#define MR_COMPARE_DEFAULTS MR_DEFAULTS(0, false, 1e-3, 0)

/* From one surface to the other, in units of the positions. */
typedef struct mr_distance {
	double min;       /* least of the measured points */
	double max;       /* greatest of them: a lower bound of the one-sided Hausdorff distance */
	double max_bound; /* an upper bound of it */
	double mean, rms;
	size_t samples; /* points measured for mean, rms and what follows */
	double quantile[4]; /* that 50, 90, 95, 99 % of the surface do not exceed */
	double normal_mean, normal_quantile[4]; /* angles between normals, in degrees; NaN of a cloud */
} mr_distance;

/* Figures of two layers with the same connectivity: vertex by vertex, and |edge of b| / |edge of a|.  NaN:
 * none. */
typedef struct mr_deviation {
	double max, mean, rms; /* distances between a vertex of a and of b */
	size_t vertex;         /* where the greatest is */
	double stretch_min, stretch_mean, stretch_max;
} mr_deviation;

typedef struct mr_comparison {
	mr_distance ab, ba;
	mr_distance both; /* the two surfaces weigh the same */
	bool corresponds; /* same connectivity: deviation is there */
	mr_deviation deviation;
	double diagonal; /* of b's bounding box: what relative figures divide by */
} mr_comparison;

/* Two surfaces or clouds.  MR_EMESH where a or b has no points. */
MR_API mr_status mr_compare(mr_ctx *ctx, const mr_mesh *a, const mr_mesh *b, const mr_compare_opts *opts,
    mr_comparison *comparison) MR_WARN_UNUSED;

/* How far each vertex of a is from b, negative within where b is a closed, oriented manifold, as that column of the
 * layer that a is of. */
MR_API mr_status mr_compare_put(mr_ctx *ctx, mr_frame *f, const char *layer, const char *column, const mr_mesh *a,
    const mr_mesh *b) MR_WARN_UNUSED;

/* One onto another: mr-align */

typedef struct mr_align_opts {
	bool scale;        /* it may grow or shrink */
	const char *from;  /* layer that is matched, of both; NULL: the one worked on last */
	const char *layer; /* that moves alone; NULL: all of the frame */
} mr_align_opts;

#define MR_ALIGN_DEFAULTS MR_DEFAULTS(false, NULL, NULL)

typedef struct mr_align_result {
	double map[12];  /* 3x4, row by row: what moves the frame */
	double scale;
	double overlap;  /* share of the samples that have a partner on the reference */
	double residual; /* root mean square distance of those from its planes */
	double score;  /* share that lies on the reference, less twice the share that contradicts it */
	double second; /* score of the next best place that is another */
	bool found;    /* else map is the identity, and the frame stays */
	bool sure;     /* no other place fits nearly as well */
} mr_align_result;

/* Moves the frame so that it fits the reference: coarse by features, fine by points to planes.  The motion is
 * the column `transform` of no layer.  If none fits, the frame stays; then, and if another place fits nearly as
 * well, it is found unaligned. */
MR_API mr_status mr_align_frame(mr_ctx *ctx, mr_frame *f, mr_frame *reference, const mr_align_opts *opts,
    mr_align_result *result) MR_WARN_UNUSED;

/* The motions that bring n frames into the coordinates of the first that fits others; mr_align_put moves a
 * frame by its own.  result: of each, by the pair that joins it.  opts: but for the scale. */
MR_API mr_status mr_align_frames(mr_ctx *ctx, mr_frame *const *frames, size_t n, const mr_align_opts *opts,
    mr_align_result *result) MR_WARN_UNUSED;
MR_API mr_status mr_align_put(mr_ctx *ctx, mr_frame *f, const mr_align_opts *opts, const mr_align_result *result)
    MR_WARN_UNUSED;

/* Judging: reports the harm to a frame to the listener for findings; without one it does nothing.  mr_judge
 * compares the surface that a tool made or moved with its former state.  least: NULL, or of a sequence, at
 * first 0: surfaces that moved by less are not judged, and *least becomes twice the largest distance so
 * far. */
MR_API mr_status mr_judge(mr_ctx *ctx, mr_frame *before, mr_frame *after, double *least) MR_WARN_UNUSED;

/* Compares the columns: what a file gave, or an earlier tool made, that is not there any more. */
MR_API mr_status mr_judge_losses(mr_ctx *ctx, mr_frame *before, mr_frame *after) MR_WARN_UNUSED;

/* Pictures: mr-render */

typedef struct mr_render_opts {
	size_t width, height;  /* of a panel, in pixels */
	mr_v3 from, up;        /* direction in which the eye stands, and which is upwards */
	bool labels;           /* name each panel, and show legends */
	const char *layers;    /* comma between them; NULL: all with positions */
	const char *color;     /* column that gives colours; NULL: none */
	const char *texture;   /* picture, PNG or JPEG, on what has texture coordinates; NULL: none */
	const char *materials; /* folder of files of materials, which are drawn; NULL: those in the stream */
	bool ranged;           /* numbers low to high span the colours; else least to greatest of the shot */
	double low, high;
	bool same;         /* a sheet is one shot; else each key frame begins one */
	size_t columns;    /* of a sheet; 0: so that it is about 3 by 2 */
	bool wire;         /* draw edges */
	const double *at;  /* x, y, z of the middle, and the radius that is seen (0: as far as all); NULL: all */
} mr_render_opts;

#define MR_RENDER_DEFAULTS                                                                                   \
	MR_DEFAULTS(800, 600, { 0.5, 0.35, 1 }, { 0, 1, 0 }, true, NULL, NULL, NULL, NULL, false, 0, 0,      \
	    false, 0, false, NULL)

/* The frame's layers side by side, as a PNG file ("-": stdout), whole or not at all. */
MR_API mr_status mr_render(
    mr_ctx *ctx, mr_frame *f, const mr_render_opts *opts, const char *path) MR_WARN_UNUSED;

/* Heights over control as pictures: mr-map */

typedef struct mr_map_opts {
	size_t level;     /* of the heights; MR_UNKNOWN: all there are, or what the picture says */
	size_t side;      /* of a picture written, at most, in texels */
	size_t gutter;    /* texels around each triangle, at least 1 */
	bool ranged;      /* black is low and white is high; else as the heights need, or the picture says */
	double low, high; /* in units of the positions */
} mr_map_opts;

#define MR_MAP_DEFAULTS MR_DEFAULTS(MR_UNKNOWN, 16384, 2, false, 0, 0)

typedef struct mr_map_result {
	size_t level, width, height; /* the last two in texels */
	double low, high;
	size_t clipped, turned; /* written: texels of heights out of the range, of normals away from control */
	size_t between, seams;  /* read: vertices on no texel, and of other heights across a seam */
	size_t texels, charts;  /* baked: on faces; 0 in texture coordinates that were there */
} mr_map_result;

/* Writes NAME-height.png, NAME-normal.png and NAME.mtl, which names them, and gives control a material,
 * normals and texture coordinates for them.  MR_ERANGE where a picture would be too large. */
MR_API mr_status mr_map_write(mr_ctx *ctx, mr_frame *f, const char *name, const mr_map_opts *opts,
    mr_map_result *result) MR_WARN_UNUSED;

/* Makes displacement of a picture of heights, by control's texture coordinates. */
MR_API mr_status mr_map_read(mr_ctx *ctx, mr_frame *f, const char *picture, const mr_map_opts *opts,
    mr_map_result *result) MR_WARN_UNUSED;

/* Pictures of one surface for another: mr-map --bake */

typedef struct mr_bake_opts {
	const char *layer;     /* of the target; NULL: control with a displacement, else as mr-export has it */
	size_t side, gutter;   /* of the pictures, in texels; the latter around each chart */
	const char *texture;   /* the source's picture; NULL: its materials' */
	const char *materials; /* folder of their files, which may be in the stream */
} mr_bake_opts;

#define MR_BAKE_DEFAULTS MR_DEFAULTS(NULL, 2048, 4, NULL, ".")

/* Bakes the surface or cloud of frame `from` into NAME-color.png and NAME-normal.png, and writes NAME.mtl,
 * which names them.  Gives the layer a material, normals and texture coordinates for them. */
MR_API mr_status mr_bake(mr_ctx *ctx, mr_frame *f, mr_frame *from, const char *name, const mr_bake_opts *opts,
    mr_map_result *result) MR_WARN_UNUSED;

#ifdef __cplusplus
}
#endif

#endif
