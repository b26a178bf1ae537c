/* Queries of the hierarchy: branch and bound, the nearer child first.  bvh_tree.h says why bounds are safe.
 */
#include "base/parallel.h"
#include "base/vectors.h"
#include "space/bvh_tree.h"

/* ---- the nearest point of a triangle ---- */

static double
clamp(double x, double low, double high)
{
	return x < low ? low : x > high ? high : x;
}

static double
min3(double a, double b, double c)
{
	double m = a < b ? a : b;

	return c < m ? c : m;
}

static double
max3(double a, double b, double c)
{
	double m = a > b ? a : b;

	return c > m ? c : m;
}

static mr_v3
clamp_to_box(mr_v3 p, mr_v3 a, mr_v3 b, mr_v3 c)
{
	return mr_vec(clamp(p.x, min3(a.x, b.x, c.x), max3(a.x, b.x, c.x)),
	    clamp(p.y, min3(a.y, b.y, c.y), max3(a.y, b.y, c.y)),
	    clamp(p.z, min3(a.z, b.z, c.z), max3(a.z, b.z, c.z)));
}

static bool
before(mr_v3 a, mr_v3 b)
{
	return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

/* On the segment a b: *t from a to b.  Taken from the lesser end, so both faces of an edge get the same bits.
 */
static mr_v3
closest_on_segment(mr_v3 q, mr_v3 a, mr_v3 b, double *t)
{
	bool turn = before(b, a);
	mr_v3 from = turn ? b : a, d = turn ? mr_sub(a, b) : mr_sub(b, a);
	double length2 = mr_norm2(d);
	double s = length2 > 0 ? clamp(mr_dot(mr_sub(q, from), d) / length2, 0, 1) : 0;
	mr_v3 p = s < 1 ? mr_axpy(s, d, from) : turn ? a : b;

	*t = turn ? 1 - s : s;
	return clamp_to_box(p, a, b, b);
}

static mr_closest
found(mr_v3 q, mr_v3 point, double u, double v, double w)
{
	return (mr_closest){ { 0, { u, v, w } }, point, mr_norm2(mr_sub(q, point)) };
}

static mr_closest
on_edge(int edge, mr_v3 q, mr_v3 a, mr_v3 b)
{
	double t;
	mr_v3 p = closest_on_segment(q, a, b, &t);

	return edge == 0   ? found(q, p, 1 - t, t, 0)
	       : edge == 1 ? found(q, p, 0, 1 - t, t)
	                   : found(q, p, t, 0, 1 - t);
}

static void
keep_nearer(mr_closest *best, mr_closest c)
{
	if (c.dist2 < best->dist2)
		*best = c;
}

/* For a face too thin for the regions below: the best of the edges and the inside. */
static mr_closest
closest_of_sliver(mr_v3 q, mr_v3 a, mr_v3 b, mr_v3 c)
{
	mr_closest best = on_edge(0, q, a, b);
	mr_v3 n = mr_cross(mr_sub(b, a), mr_sub(c, a));
	double n2 = mr_norm2(n), u, v;

	keep_nearer(&best, on_edge(1, q, b, c));
	keep_nearer(&best, on_edge(2, q, c, a));
	if (!(n2 > 0))
		return best;
	u = mr_dot(n, mr_cross(mr_sub(b, q), mr_sub(c, q))) / n2;
	v = mr_dot(n, mr_cross(mr_sub(c, q), mr_sub(a, q))) / n2;
	if (u >= 0 && v >= 0 && u + v <= 1) {
		mr_v3 w = mr_vec(u, v, 1 - u - v);
		keep_nearer(&best, found(q, clamp_to_box(mr_bary_point(w, a, b, c), a, b, c), w.x, w.y, w.z));
	}
	return best;
}

/* Ericson, Real-Time Collision Detection (2005), 5.1.5: which vertex, edge or inside region q projects into.
 */
static inline mr_closest
triangle_closest(mr_v3 q, mr_v3 a, mr_v3 b, mr_v3 c)
{
	static const double thin = 1e-8; /* squared sine of the angle at a */
	mr_v3 ab = mr_sub(b, a), ac = mr_sub(c, a), aq = mr_sub(q, a), bq = mr_sub(q, b), cq = mr_sub(q, c);
	double bb = mr_norm2(ab), cc = mr_norm2(ac), bc = mr_dot(ab, ac);
	double d1 = mr_dot(ab, aq), d2 = mr_dot(ac, aq), d3 = mr_dot(ab, bq), d4 = mr_dot(ac, bq);
	double d5 = mr_dot(ab, cq), d6 = mr_dot(ac, cq), u, v, w, sum;

	if (!(bb * cc - bc * bc > thin * bb * cc))
		return closest_of_sliver(q, a, b, c);
	if (d1 <= 0 && d2 <= 0)
		return found(q, a, 1, 0, 0);
	if (d3 >= 0 && d4 <= d3)
		return found(q, b, 0, 1, 0);
	w = d1 * d4 - d3 * d2;
	if (w <= 0 && d1 >= 0 && d3 <= 0)
		return on_edge(0, q, a, b);
	if (d6 >= 0 && d5 <= d6)
		return found(q, c, 0, 0, 1);
	v = d5 * d2 - d1 * d6;
	if (v <= 0 && d2 >= 0 && d6 <= 0)
		return on_edge(2, q, c, a);
	u = d3 * d6 - d5 * d4;
	if (u <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
		return on_edge(1, q, b, c);
	sum = u + v + w;
	v /= sum;
	w /= sum;
	return found(q, clamp_to_box(mr_axpy(v, ab, mr_axpy(w, ac, a)), a, b, c), 1 - v - w, v, w);
}

mr_closest
mr_triangle_closest(mr_v3 q, mr_v3 a, mr_v3 b, mr_v3 c)
{
	return triangle_closest(q, a, b, c);
}

mr_closest
mr_side_closest(const mr_mesh *m, uint32_t h, mr_v3 q)
{
	mr_closest c = on_edge((int)(h % 3), q, m->p[mr_he_from(m, h)], m->p[mr_he_to(m, h)]);

	c.at.face = h / 3;
	return c;
}

/* ---- queries ---- */

static void
closest_in_leaf(const mr_bvh *bvh, bvh_entry leaf, mr_v3 q, mr_closest *best)
{
	const mr_mesh *m = bvh->mesh;

	for (uint32_t i = 0; i < leaf.count; i++) {
		uint32_t f = bvh->face[leaf.child + i];
		const uint32_t *v = m->t[f].v;
		mr_closest c = triangle_closest(q, m->p[v[0]], m->p[v[1]], m->p[v[2]]);
		if (c.dist2 < best->dist2 || (c.dist2 == best->dist2 && f < best->at.face)) {
			*best = c;
			best->at.face = f;
		}
	}
}

/* From so many sizes of the mesh all its faces are about as near: one of them is found, not the nearest by
 * looking at all. */
static const double FAR = 0x1p36;

/* The nearest point of squared distance at most dist2. */
static mr_closest
closest_at_most(const mr_bvh *bvh, mr_v3 q, double dist2)
{
	mr_closest best = { .at.face = MR_NONE, .dist2 = dist2 };
	mr_v3 u = bvh_unit(bvh, q);
	double unit2 = bvh->scale * bvh->scale, limit = dist2 * unit2, bound[BVH_WIDE];
	double enough = mr_norm2(u) > FAR * FAR ? unit2 * (1 - 0x1p-35) : unit2;
	bvh_entry stack[BVH_STACK], *top = stack;

	if (bvh->mesh->nf)
		*top++ = (bvh_entry){ 0, 0, 0 };
	while (top > stack) {
		bvh_entry e = *--top;
		if (e.bound > limit)
			continue;
		if (e.count) {
			closest_in_leaf(bvh, e, q, &best);
			limit = best.dist2 * enough;
		} else {
			bvh_box_distances(&bvh->nodes[e.child], u, bound);
			top = bvh_push_sorted(top, &bvh->nodes[e.child], bound, limit);
		}
	}
	if (best.at.face == MR_NONE)
		best.dist2 = INFINITY;
	return best;
}

mr_closest
mr_bvh_closest(const mr_bvh *bvh, mr_v3 q)
{
	return closest_at_most(bvh, q, INFINITY);
}

typedef struct distances {
	const mr_bvh *bvh;
	const mr_v3 *q;
	double *distance;
} distances;

static void
find_distances(void *arg, size_t begin, size_t end)
{
	const distances *j = arg;

	for (size_t i = begin; i < end; i++)
		j->distance[i] = sqrt(mr_bvh_closest(j->bvh, j->q[i]).dist2);
}

void
mr_bvh_distances(const mr_ctx *ctx, const mr_bvh *bvh, const mr_v3 *q, size_t n, double *distance)
{
	mr_parallel(ctx, n, 1024, find_distances, &(distances){ bvh, q, distance });
}

mr_closest
mr_bvh_closest_within(const mr_bvh *bvh, mr_v3 q, double dist2)
{
	if (!(dist2 > 0))
		return (mr_closest){ .at.face = MR_NONE, .dist2 = INFINITY };
	return closest_at_most(bvh, q, nextafter(dist2, 0));
}

/*
 * Woop, Benthin, Wald, Watertight Ray/Triangle Intersection (2013): the axes are
 * permuted and sheared so that the ray is the z axis; an edge has the same
 * rounded sign from both of its faces.
 */
typedef struct ray {
	mr_v3 origin;
	int kx, ky, kz;
	double sx, sy, sz;
	double start[3], inverse[3]; /* in units of the mesh, for the boxes */
} ray;

static MR_INLINED ray
ray_make(const mr_bvh *bvh, mr_v3 origin, mr_v3 dir)
{
	double d[3] = { dir.x, dir.y, dir.z };
	mr_v3 u = bvh_unit(bvh, origin);
	ray r = { .origin = origin, .start = { u.x, u.y, u.z } };

	for (int k = 1; k < 3; k++)
		if (fabs(d[k]) > fabs(d[r.kz]))
			r.kz = k;
	r.kx = (r.kz + 1) % 3;
	r.ky = (r.kz + 2) % 3;
	r.sx = d[r.kx] / d[r.kz];
	r.sy = d[r.ky] / d[r.kz];
	r.sz = 1 / d[r.kz];
	for (int k = 0; k < 3; k++)
		r.inverse[k] = 1 / (bvh->scale * d[k]);
	return r;
}

/* (x, y) in the sheared plane of the ray, z along it in units of t. */
static MR_INLINED mr_v3
shear(const ray *r, mr_v3 p)
{
	mr_v3 d = mr_sub(p, r->origin);
	double c[3] = { d.x, d.y, d.z };

	return mr_vec(c[r->kx] - r->sx * c[r->kz], c[r->ky] - r->sy * c[r->kz], r->sz * c[r->kz]);
}

static MR_INLINED bool
hit_triangle(const ray *r, mr_v3 a, mr_v3 b, mr_v3 c, mr_ray_hit *hit)
{
	double u, v, w, sum;

	a = shear(r, a);
	b = shear(r, b);
	c = shear(r, c);
	u = c.x * b.y - c.y * b.x;
	v = a.x * c.y - a.y * c.x;
	w = b.x * a.y - b.y * a.x;
	if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0))
		return false;
	sum = u + v + w;
	if (sum == 0)
		return false;
	hit->at.bary = mr_vec(u / sum, v / sum, w / sum);
	hit->t = hit->at.bary.x * a.z + hit->at.bary.y * b.z + hit->at.bary.z * c.z;
	return true;
}

/* How far along each of the four boxes the ray begins; infinite where it misses it.  NaN (0 times infinity)
 * bounds nothing. */
static MR_INLINED void
box_entries(const mr_bvh_node *d, const ray *r, double tmin, double tmax, double out[BVH_WIDE])
{
	double enter[BVH_WIDE], leave[BVH_WIDE];

	for (int c = 0; c < BVH_WIDE; c++) {
		enter[c] = tmin;
		leave[c] = tmax;
	}
	for (int k = 0; k < 3; k++) {
		const float *near = r->inverse[k] < 0 ? d->hi[k] : d->lo[k];
		const float *far = r->inverse[k] < 0 ? d->lo[k] : d->hi[k];
		for (int c = 0; c < BVH_WIDE; c++) {
			double t0 = ((double)near[c] - r->start[k]) * r->inverse[k];
			double t1 = ((double)far[c] - r->start[k]) * r->inverse[k];
			t0 *= t0 > 0 ? 1 - 0x1p-40 : 1 + 0x1p-40; /* infinity stays */
			t1 *= t1 > 0 ? 1 + 0x1p-40 : 1 - 0x1p-40;
			enter[c] = t0 > enter[c] ? t0 : enter[c];
			leave[c] = t1 < leave[c] ? t1 : leave[c];
		}
	}
	for (int c = 0; c < BVH_WIDE; c++) {
		double before = enter[c] > 0 ? enter[c] : 0, behind = leave[c] < 0 ? -leave[c] : before;
		out[c] = enter[c] <= leave[c] ? behind : INFINITY;
	}
}

/* both: hits before the origin count like hits after it. */
static MR_INLINED void
hit_in_leaf(const mr_bvh *bvh, bvh_entry leaf, const ray *r, double tmin, bool both, mr_ray_hit *best)
{
	const mr_mesh *m = bvh->mesh;

	for (uint32_t i = 0; i < leaf.count; i++) {
		mr_ray_hit h = { .at.face = bvh->face[leaf.child + i] };
		const uint32_t *v = m->t[h.at.face].v;
		if (!hit_triangle(r, m->p[v[0]], m->p[v[1]], m->p[v[2]], &h))
			continue;
		h.t = both ? fabs(h.t) : h.t;
		if (h.t >= tmin && (h.t < best->t || (h.t == best->t && h.at.face < best->at.face)))
			*best = h;
	}
}

static MR_INLINED bool
cast(const mr_bvh *bvh, mr_v3 origin, mr_v3 dir, double tmin, double tmax, bool both, mr_ray_hit *hit)
{
	mr_ray_hit best = { .at.face = MR_NONE, .t = tmax };
	ray r = ray_make(bvh, origin, dir);
	bvh_entry stack[BVH_STACK], *top = stack;
	double enter[BVH_WIDE];

	if (bvh->mesh->nf && mr_norm2(dir) > 0)
		*top++ = (bvh_entry){ -INFINITY, 0, 0 };
	while (top > stack) {
		bvh_entry e = *--top;
		if (e.bound > best.t)
			continue;
		if (e.count) {
			hit_in_leaf(bvh, e, &r, tmin, both, &best);
		} else {
			box_entries(&bvh->nodes[e.child], &r, both ? -best.t : tmin, best.t, enter);
			top = bvh_push_sorted(top, &bvh->nodes[e.child], enter,
			    best.t < INFINITY ? best.t : 0x1.fffffffffffffp1023);
		}
	}
	if (best.at.face == MR_NONE)
		return false;
	*hit = best;
	return true;
}

MR_VECTORS static bool
cast_first(const mr_bvh *bvh, mr_v3 origin, mr_v3 dir, double tmin, double tmax, mr_ray_hit *hit)
{
	return cast(bvh, origin, dir, tmin, tmax, false, hit);
}

MR_VECTORS static bool
cast_across(const mr_bvh *bvh, mr_v3 origin, mr_v3 dir, double tmin, double tmax, mr_ray_hit *hit)
{
	return cast(bvh, origin, dir, tmin, tmax, true, hit);
}

bool
mr_bvh_ray(const mr_bvh *bvh, mr_v3 origin, mr_v3 dir, double tmin, double tmax, mr_ray_hit *hit)
{
	return cast_first(bvh, origin, dir, tmin, tmax, hit);
}

bool
mr_bvh_ray_both(const mr_bvh *bvh, mr_v3 origin, mr_v3 dir, double tmax, mr_ray_hit *hit)
{
	return cast_across(bvh, origin, dir, 0, tmax, hit);
}

double
mr_bvh_across(const mr_bvh *bvh, mr_v3 origin, mr_v3 dir, double tmin, double tmax)
{
	mr_ray_hit hit;

	return cast_across(bvh, origin, dir, tmin, tmax, &hit) ? hit.t : tmax;
}

const uint32_t *
mr_bvh_order(const mr_bvh *bvh)
{
	return bvh->face;
}

static bool
face_meets(const mr_mesh *m, uint32_t f, mr_box b)
{
	const mr_v3 p = m->p[m->t[f].v[0]], q = m->p[m->t[f].v[1]], r = m->p[m->t[f].v[2]];

	return min3(p.x, q.x, r.x) <= b.max.x && max3(p.x, q.x, r.x) >= b.min.x &&
	       min3(p.y, q.y, r.y) <= b.max.y && max3(p.y, q.y, r.y) >= b.min.y &&
	       min3(p.z, q.z, r.z) <= b.max.z && max3(p.z, q.z, r.z) >= b.min.z;
}

bool
mr_bvh_overlap(const mr_bvh *bvh, mr_box box, bool (*visit)(void *arg, uint32_t face), void *arg)
{
	mr_v3 lo = bvh_unit(bvh, box.min), hi = bvh_unit(bvh, box.max);
	uint32_t stack[BVH_STACK], *top = stack;

	if (bvh->mesh->nf)
		*top++ = 0;
	while (top > stack) {
		const mr_bvh_node *d = &bvh->nodes[*--top];
		for (int c = 0; c < BVH_WIDE; c++) {
			if (d->child[c] == MR_NONE || !bvh_box_meets(d, c, lo, hi))
				continue;
			if (!d->count[c])
				*top++ = d->child[c];
			for (uint32_t i = 0; i < d->count[c]; i++) {
				uint32_t f = bvh->face[d->child[c] + i];
				if (face_meets(bvh->mesh, f, box) && !visit(arg, f))
					return false;
			}
		}
	}
	return true;
}
