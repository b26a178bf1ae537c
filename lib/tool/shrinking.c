/* Area and volume that a coarser or rounder surface has lost or gained, and how far it is from the other. */
#include "tool/shrinking.h"

#include "mesh/edges.h"
#include "shape/shape.h"
#include "space/bvh.h"
#include "space/contact.h"
#include "space/enclosed.h"

static mr_status
find_closed(mr_ctx *ctx, const mr_mesh *m, bool *closed)
{
	mr_mark mark = mr_mark_take(ctx);
	mr_edges edges;

	MR_TRY(mr_edges_build(ctx, m, &edges));
	*closed = mr_edges_enclose(m, &edges);
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/*
 * Of 98 models as they were imported, remeshed, 15 lose this share of their area, five of these over half:
 * bodies of a few long faces; of 50 closed ones 9 lose it of their volume, and the next below 9 %.
 */
static const double MUCH = 0.1;

static mr_status
look_for_shrinking(mr_ctx *ctx, const mr_mesh *m, const mr_mesh *out, const char *why, bool *told)
{
	double area = mr_mesh_area(ctx, m), volume, rest, lost = 1 - mr_mesh_area(ctx, out) / area, less = 0;
	bool thin, thick;

	MR_TRY(mr_enclosed_volume(ctx, m, &volume));
	if (volume > 0) {
		MR_TRY(mr_enclosed_volume(ctx, out, &rest));
		less = 1 - rest / volume;
	}
	thin = less > fmax(MUCH, lost);
	thick = -less > fmax(MUCH, lost);
	*told = area > 0 && (thin || thick || lost > MUCH);
	if (*told && thick)
		mr_warn(ctx, "%s: its volume has grown by %.3g %%: %s", m->name, 100 * -less, why);
	else if (*told)
		mr_warn(ctx, "%s: %.3g %% of its %s is lost: %s", m->name, 100 * (thin ? less : lost),
		    thin ? "volume" : "area", why);
	return MR_OK;
}

mr_status
mr_warn_of_shrinking(mr_ctx *ctx, const mr_mesh *m, const mr_mesh *out, const char *why)
{
	bool told;

	return look_for_shrinking(ctx, m, out, why, &told);
}

/* Before and after. */
typedef struct part {
	double area[2], volume[2];
} part;

/* Adds the faces of m to the part of their first vertex; of: the vertex of `whole` that stands for it. */
static void
add_faces(part *parts, const mr_mesh *whole, const mr_mesh *m, const uint32_t *of, int after)
{
	for (size_t f = 0; f < m->nf; f++) {
		const uint32_t *v = m->t[f].v;
		mr_v3 cross = mr_face_cross(m, f);
		parts[of[v[0]]].area[after] += mr_norm(cross);
		parts[of[v[0]]].volume[after] += mr_dot(cross, mr_sub(m->p[v[0]], whole->p[of[v[0]]]));
	}
}

/* Of the area, or of the volume where there is any, what is left of the less. */
static double
rest_of(const part *p, bool closed)
{
	double area = p->area[0] > 0 ? p->area[1] / p->area[0] : 1;

	return closed && p->volume[0] != 0 ? fmin(area, p->volume[1] / p->volume[0]) : area;
}

/* As mr-smooth has it of area. */
static const double LITTLE = 0.5;

/* Parts that the sum does not tell of; from: the vertex of m that each of out stands for. */
static mr_status
look_at_parts(
    mr_ctx *ctx, const mr_mesh *m, const mr_mesh *out, const uint32_t *from, const char *why, bool *told)
{
	mr_mark mark = mr_mark_take(ctx);
	uint32_t *of, *of_out, worst = MR_NONE;
	size_t count = 0, shrunken = 0;
	double least = LITTLE;
	part *parts;
	bool several, closed;

	*told = false;
	MR_TRY(mr_components_label(ctx, m, &of, &several));
	if (!several)
		return MR_OK;
	parts = MR_NEW_ZERO(ctx, m->nv, part);
	of_out = MR_NEW(ctx, out->nv, uint32_t);
	if (!parts || !of_out)
		return MR_EMEM;
	MR_TRY(find_closed(ctx, m, &closed));
	for (size_t v = 0; v < out->nv; v++)
		of_out[v] = of[from[v]];
	add_faces(parts, m, m, of, 0);
	add_faces(parts, m, out, of_out, 1);
	for (uint32_t v = 0; v < m->nv; v++) {
		double rest = rest_of(&parts[v], closed);
		count += parts[v].area[0] > 0;
		shrunken += rest < LITTLE;
		if (rest < least) {
			least = rest;
			worst = v;
		}
	}
	*told = shrunken > 0;
	if (*told)
		mr_warn(ctx,
		    "%s: over half of the area or volume of %zu of %zu parts is lost, of the one at "
		    "(%.4g, %.4g, %.4g) all but %.2g %%: %s",
		    m->name, shrunken, count, m->p[worst].x, m->p[worst].y, m->p[worst].z, 100 * least, why);
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/*
 * Of 95 models that are left with a tenth of their faces 16 are farther off somewhere, seven of which have
 * not lost the share above: ears, blades, small bodies.
 */
static const double FAR = 0.05;

/* Corners of m, at equal strides where there are more, and places drawn by area: n in all. */
static mr_status
places_of(mr_ctx *ctx, const mr_mesh *m, mr_v3 **place, size_t *n)
{
	enum { CORNERS = 1 << 16, DRAWN = 1 << 14 };
	size_t all = 3 * m->nf, corners = all < CORNERS ? all : CORNERS;
	mr_v3 *q = MR_NEW(ctx, corners + DRAWN, mr_v3), *drawn, *normal;

	if (!q)
		return MR_EMEM;
	for (size_t i = 0; i < corners; i++) {
		size_t h = (size_t)((double)i / (double)corners * (double)all);
		q[i] = m->p[m->t[h / 3].v[h % 3]];
	}
	MR_TRY(mr_surface_sample(ctx, m, DRAWN, 1, &drawn, &normal));
	memcpy(q + corners, drawn, DRAWN * sizeof *q);
	*place = q;
	*n = corners + DRAWN;
	return MR_OK;
}

/* The place of m that is farthest from `to`, and how far that is. */
static mr_status
farthest(mr_ctx *ctx, const mr_mesh *m, const mr_mesh *to, mr_v3 *at, double *far)
{
	mr_mark mark = mr_mark_take(ctx);
	double *distance;
	size_t n, widest = 0;
	mr_bvh *bvh;
	mr_v3 *q;

	MR_TRY(places_of(ctx, m, &q, &n));
	MR_TRY(mr_bvh_build(ctx, to, &bvh));
	distance = MR_NEW(ctx, n, double);
	if (!distance)
		return MR_EMEM;
	mr_bvh_distances(ctx, bvh, q, n, distance);
	for (size_t i = 0; i < n; i++)
		widest = distance[i] > distance[widest] ? i : widest;
	*at = q[widest];
	*far = distance[widest];
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* Whether a face may be so far from a surface that its corners are on. */
static bool
has_wide_faces(const mr_mesh *m, double far)
{
	for (size_t h = 0; h < 3 * m->nf; h++) {
		const uint32_t *v = m->t[h / 3].v;
		if (mr_dist(m->p[v[h % 3]], m->p[v[(h + 1) % 3]]) > sqrt(3) * far)
			return true;
	}
	return false;
}

static mr_status
look_at_distance(mr_ctx *ctx, const mr_mesh *m, const mr_mesh *out, const char *why)
{
	double diagonal = mr_mesh_diagonal(m), far = 0;
	mr_v3 at;

	if (!(mr_mesh_area(ctx, m) > 0 && mr_mesh_area(ctx, out) > 0))
		return MR_OK;
	MR_TRY(farthest(ctx, m, out, &at, &far));
	if (far > FAR * diagonal) {
		mr_warn(ctx,
		    "%s: what was near (%.4g, %.4g, %.4g) is %.3g %% of the diagonal from what is left: %s",
		    m->name, at.x, at.y, at.z, 100 * far / diagonal, why);
		return MR_OK;
	}
	if (!has_wide_faces(out, FAR * diagonal))
		return MR_OK;
	MR_TRY(farthest(ctx, out, m, &at, &far));
	if (far > FAR * diagonal)
		mr_warn(ctx,
		    "%s: what is near (%.4g, %.4g, %.4g) now is %.3g %% of the diagonal from what was there: "
		    "%s",
		    m->name, at.x, at.y, at.z, 100 * far / diagonal, why);
	return MR_OK;
}

mr_status
mr_warn_of_coarseness(
    mr_ctx *ctx, const mr_mesh *m, const mr_mesh *out, const uint32_t *from, const char *why)
{
	bool told;

	MR_TRY(look_for_shrinking(ctx, m, out, why, &told));
	if (!told)
		MR_TRY(look_at_parts(ctx, m, out, from, why, &told));
	return told ? MR_OK : look_at_distance(ctx, m, out, why);
}
