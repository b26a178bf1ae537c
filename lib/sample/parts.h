/*
 * parts.h -- what the methods of sampling a displacement share.
 *
 * Heights are first found, vertex by vertex, by one of the searches; then those that cannot be true are taken
 * back, the missing ones filled in, and all of them fitted to the points.
 * Private to this room.
 */
#ifndef MR_SAMPLE_PARTS_H
#define MR_SAMPLE_PARTS_H

#include "sample/height_energy.h"
#include "sample/sample.h"
#include "space/near.h"

/* A point as the line through a vertex along its normal sees it. */
typedef struct mr_sight {
	double x, y; /* across the line */
	double t;    /* along it, from the vertex */
	double d2;   /* x x + y y */
	uint32_t index;
} mr_sight;

/*
 * The points as the line through v along the unit vector n sees them, the nearest to the line first, equally
 * near ones by index; those whose index is MR_NONE are left out.  Returns how many.  s: k, the caller's.
 */
size_t mr_sights(const mr_v3 *point, const uint32_t *index, size_t k, mr_v3 v, mr_v3 n, mr_sight *s);

/* The conditions of a valid triangle. */
typedef struct mr_bounds {
	double height; /* |t| of the hit, at most */
	double edge2;  /* squared length of its longest edge, at most */
	double cosine; /* between its normal and the line, at least */
} mr_bounds;

/* The result of the search for a valid triangle. */
typedef struct mr_valid {
	size_t points; /* among how many the first triangle was that the line meets; 0: none */
	bool taken;    /* a triangle within the bounds */
	double height; /* where the line meets it, if taken */
	double area;   /* of it */
} mr_valid;

/*
 * The valid triangle of the line among n sights, the nearest first (Jeong, Kim 2001, section 5): the three
 * nearest, then all that the next completes, and so on; of several the line meets, the smallest.  The search
 * ends at the first triangles met that keep the bounds; NULL: at the first that is met.
 */
mr_valid mr_valid_triangle(const mr_sight *s, size_t n, const mr_bounds *b);

typedef struct mr_v3f {
	float x, y, z;
} mr_v3f;

/* The points and their columns. */
typedef struct mr_sample_cloud {
	const mr_v3 *p;
	const double *spacing;
	double usual; /* of points: what each has to itself, and the median */
	size_t n;
	mr_near *near;       /* alike */
	const mr_mesh *mesh; /* else whose vertices they are */
	double diagonal;
	uint32_t *face; /* of the domain, nearest to each point */
	mr_v3f *side;   /* its unit normal: which way the sheet that the point belongs to looks */
} mr_sample_cloud;

/* Finds the nearest faces of the domain, near enough: c->face and c->side, in the arena. off:
 * the distances from them, c->n, the caller's, or NULL. */
void mr_sample_place(mr_ctx *ctx, const mr_domain *d, mr_sample_cloud *c, double *off);

/* True where the point may belong to the sheet that looks along n. */
static inline bool
mr_same_side(const mr_sample_cloud *c, uint32_t point, mr_v3 n)
{
	mr_v3f s = c->side[point];

	return (double)s.x * n.x + (double)s.y * n.y + (double)s.z * n.z > 0;
}

/* Leaves out the sights of points that belong to sheets that look the other way.  Returns how many stay. */
size_t mr_sights_near_sheet(const mr_sample_cloud *c, mr_v3 n, mr_sight *s, size_t count);

/* Heights found by one search; hit says where.  nearest: the point nearest to each vertex, the caller's.  r:
 * gets the figures of it. */
mr_status mr_sample_triangles(mr_ctx *ctx, const mr_domain *d, const mr_sample_cloud *c, size_t neighbours,
    double *height, bool *hit, uint32_t *nearest, mr_sample_result *r);
/* c: the mesh's vertices, placed. */
void mr_sample_rays(mr_ctx *ctx, const mr_domain *d, const mr_mesh *mesh, const mr_sample_cloud *c,
    double *height, bool *hit, mr_sample_result *r);

/* Weights of the least squares, relative to a point's 1. */
typedef struct mr_fit_weights {
	double fair;  /* of the fairness of the heights */
	double pull;  /* of a height found */
	double scale; /* gaps beyond it count less */
	bool robust;  /* so much less that outliers do not count */
	size_t steps; /* of conjugate gradients in a pass, at most */
} mr_fit_weights;

/* A point's equation for the heights of its face's corners: sum c_i h_i = r. */
typedef struct mr_wish {
	uint32_t face;
	float weight;
	double c[3], r;
	double gap; /* signed distance before the pass */
} mr_wish;

/* Sets the fairness: `factor` where the heights are bent as in the middle, less where more, and more where
 * less. */
void mr_fairness_adapt(mr_ctx *ctx, const mr_heights *e, const double *height, double factor);

/*
 * Multiplies the fairness so that the fit to the others best predicts the points left out.  e: with the data
 * of the n wishes; surface: whose heights they are; height: to begin with; steps: of conjugate gradients, at
 * most.  *factor: the multiplier.
 */
mr_status mr_fairness_validate(mr_ctx *ctx, mr_heights *e, const mr_wish *wish, size_t n,
    const mr_mesh *surface, const double *height, size_t steps, double *factor);

/* Fits the heights to the points; hit vertices are also pulled to their heights, less where they are
 * denser than the points around the `nearest` one (NULL: alike).  e: of the domain. */
mr_status mr_sample_refine(mr_ctx *ctx, const mr_domain *d, const mr_sample_cloud *c,
    const mr_fit_weights *weights, size_t passes, mr_heights *e, const bool *hit, const uint32_t *nearest,
    double *height, mr_sample_result *r);

#endif
