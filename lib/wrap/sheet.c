/* Height fields: a flat lattice under the points, cut to their outline and lifted onto them.  Points over the
 * others, as a table over a floor, become a field of their own. */
#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include "space/local_planes.h"
#include "wrap/parts.h"

/* A height field: of 20 up to 2.4 % of the planes are within 12 degrees of upright and 15 % of the pairs off;
 * of 325 clouds of closed models 11 have so few upright, and of these 20 % and more are off. */
static const double UPRIGHT = 0.2;       /* cosine to the normal of the plane */
static const double UPRIGHT_MOST = 0.03; /* share of the planes */
static const double OFF = 1, NOISE = 4;  /* spacings and deviations of noise from a plane, that are off it */
static const double OFF_MOST = 0.2;      /* share of the pairs */
/* Pairs of two sheets are so much farther apart, but for a share: 0 to 8 % of two, 18 % and more of terrain.
 */
static const double SECOND = 2.2, BETWEEN_MOST = 0.13;
static const double NOISE_MOST = 0.5; /* spacings */

/* Links of a sheet: their height and length, in lengths and spacings.  A layer has at least that share of its
 * points over others; a slab at least that share of its normals outward from the middle. */
static const double STEEP = 0.7, REACH = 3, OVER = 0.8, APART = 0.5;

enum { PROBES = 4096, PLANE_MOST = 128, AROUND = 16, PAIRS = 9, HEIGHTS = 5, LAYERS_MOST = 64 };

/* Spacings around the points: more than half an opening's width. */
static const double MARGIN = 8;

/* Vertices of the lattice for each point, at most, or a million. */
enum { NODES_PER_POINT = 16, NODES_LEAST = 1000000 };

/* The points at some places, and the planes through their neighbours. */
typedef struct probes {
	uint32_t *at; /* n: of the cloud */
	mr_v3 *normal;
	size_t n;
} probes;

static mr_status
find_planes(mr_ctx *ctx, const mr_wrap_cloud *cloud, probes *q)
{
	size_t k = cloud->n < cloud->sampling.neighbours ? cloud->n : cloud->sampling.neighbours;
	uint32_t *nearest;
	mr_v3 *p;

	k = k < PLANE_MOST ? k : PLANE_MOST;
	q->n = cloud->n < PROBES ? cloud->n : PROBES;
	q->at = MR_NEW(ctx, q->n, uint32_t);
	q->normal = MR_NEW(ctx, q->n, mr_v3);
	p = MR_NEW(ctx, q->n, mr_v3);
	nearest = MR_NEW(ctx, q->n * k, uint32_t);
	for (size_t i = 0; i < q->n; i++) {
		q->at[i] = (uint32_t)(i * cloud->n / q->n);
		p[i] = cloud->p[q->at[i]];
	}
	MR_TRY(mr_near_query(ctx, cloud->near, p, q->n, k, nearest, NULL));
	for (size_t i = 0; i < q->n; i++) {
		mr_v3 around[PLANE_MOST];
		double variation;
		for (size_t j = 0; j < k; j++)
			around[j] = cloud->p[nearest[i * k + j]];
		q->normal[i] = cloud->sampling.neighbours <= AROUND ? mr_plane_around(around, k, &variation)
		                                                    : mr_plane_fit(around, k, &variation);
	}
	return MR_OK;
}

/* axis[2]: the direction that most normals are near; the share of them that are across it. */
static double
find_axes(const probes *q, mr_v3 axis[3])
{
	double sum[6] = { 0 }, value[3];
	mr_v3 vector[3];
	size_t upright = 0;

	for (size_t i = 0; i < q->n; i++) {
		mr_v3 n = q->normal[i];
		const double own[6] = { n.x * n.x, n.x * n.y, n.x * n.z, n.y * n.y, n.y * n.z, n.z * n.z };
		for (int j = 0; j < 6; j++)
			sum[j] += own[j];
	}
	mr_eigen_sym3(sum, value, vector);
	axis[2] = vector[2];
	axis[0] = vector[0];
	axis[1] = mr_cross(axis[2], axis[0]);
	for (size_t i = 0; i < q->n; i++)
		upright += fabs(mr_dot(q->normal[i], axis[2])) < UPRIGHT;
	return (double)upright / (double)q->n;
}

/* The coordinates of the points along the first two axes. */
static mr_status
flatten(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_v3 *axis, mr_wrap_cloud *flat)
{
	mr_v3 *p = MR_NEW(ctx, cloud->n, mr_v3);

	*flat = *cloud;
	flat->near = NULL;
	for (size_t i = 0; i < cloud->n; i++)
		p[i] = mr_vec(mr_dot(axis[0], cloud->p[i]), mr_dot(axis[1], cloud->p[i]), 0);
	flat->p = p;
	flat->box = mr_box_of(p, cloud->n);
	return mr_near_build(ctx, p, cloud->n, &flat->near);
}

/* Pairs of neighbours in the projection: the share that is not on one sheet, and of these the
 * share not on two. */
typedef struct pairs {
	double off, between;
} pairs;

static mr_status
look_at_pairs(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_cloud *flat, const probes *q, pairs *of)
{
	mr_v3 *p = MR_NEW(ctx, q->n, mr_v3);
	uint32_t *nearest = MR_NEW(ctx, q->n * PAIRS, uint32_t);
	size_t off = 0, between = 0, all = 0;

	for (size_t i = 0; i < q->n; i++)
		p[i] = flat->p[q->at[i]];
	MR_TRY(mr_near_query(ctx, flat->near, p, q->n, PAIRS, nearest, NULL));
	for (size_t i = 0; i < q->n; i++) {
		double most = OFF * cloud->own[q->at[i]] + NOISE * cloud->sampling.noise;
		for (size_t j = 1; j < PAIRS && nearest[i * PAIRS + j] != MR_NONE; j++, all++) {
			mr_v3 to = mr_sub(cloud->p[nearest[i * PAIRS + j]], cloud->p[q->at[i]]);
			double far = fabs(mr_dot(to, q->normal[i]));
			off += far > most;
			between += far > most && far < SECOND * most;
		}
	}
	*of = (pairs){ (double)off / (double)all, off > 0 ? (double)between / (double)off : 1 };
	return MR_OK;
}

/* Parts of neighbours; the links between sheets, which are upright, join none. */
static mr_status
find_parts(mr_ctx *ctx, const mr_wrap_cloud *cloud, mr_v3 up, uint32_t *set)
{
	mr_mark mark = mr_mark_take(ctx);
	uint32_t *nearest = MR_NEW(ctx, cloud->n * PAIRS, uint32_t);

	MR_TRY(mr_near_query(ctx, cloud->near, cloud->p, cloud->n, PAIRS, nearest, NULL));
	for (uint32_t i = 0; i < cloud->n; i++)
		for (size_t k = 0; k < PAIRS && nearest[i * PAIRS + k] != MR_NONE; k++) {
			uint32_t j = nearest[i * PAIRS + k];
			mr_v3 e = mr_sub(cloud->p[j], cloud->p[i]);
			double length = mr_norm(e);
			if (fabs(mr_dot(e, up)) <= STEEP * length &&
			    length <= REACH * fmax(cloud->own[i], cloud->own[j]))
				mr_sets_join(set, i, j);
		}
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* How many points of the parts, except the largest and the small ones, are over or under other parts. */
static mr_status
count_over(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_cloud *flat, uint32_t *set,
    const uint32_t *size, uint32_t base, uint32_t *over)
{
	mr_mark mark = mr_mark_take(ctx);
	mr_v3 *p = MR_NEW(ctx, cloud->n, mr_v3);
	uint32_t *at = MR_NEW(ctx, cloud->n, uint32_t), *nearest;
	double *dist2;
	size_t n = 0;

	for (uint32_t i = 0; i < cloud->n; i++) {
		uint32_t root = mr_sets_root(set, i);
		if (root != base && size[root] >= MR_WRAP_FIELD_LEAST) {
			p[n] = flat->p[i];
			at[n++] = i;
		}
	}
	nearest = MR_NEW(ctx, n * PAIRS, uint32_t);
	dist2 = MR_NEW(ctx, n * PAIRS, double);
	MR_TRY(mr_near_query(ctx, flat->near, p, n, PAIRS, nearest, dist2));
	for (size_t i = 0; i < n; i++) {
		uint32_t root = mr_sets_root(set, at[i]);
		bool is_over = false;
		for (size_t k = i * PAIRS; k < (i + 1) * PAIRS && nearest[k] != MR_NONE; k++) {
			uint32_t other = mr_sets_root(set, nearest[k]);
			double reach = fmax(cloud->own[at[i]], cloud->own[nearest[k]]);
			is_over |= dist2[k] < reach * reach && other != root &&
			           size[other] >= MR_WRAP_FIELD_LEAST;
		}
		over[root] += is_over;
	}
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* The points of a cloud in one set, as a cloud. */
static mr_status
take_layer(mr_ctx *ctx, const mr_wrap_cloud *cloud, uint32_t *set, uint32_t root, mr_wrap_cloud *layer)
{
	mr_v3 *p = MR_NEW(ctx, cloud->n, mr_v3);
	double *own = MR_NEW(ctx, cloud->n, double);
	uint32_t *of = MR_NEW(ctx, cloud->n, uint32_t);

	*layer = *cloud;
	layer->n = 0;
	layer->area = 0;
	for (uint32_t i = 0; i < cloud->n; i++)
		if (mr_sets_root(set, i) == root) {
			p[layer->n] = cloud->p[i];
			own[layer->n] = cloud->own[i];
			of[layer->n++] = cloud->of[i];
			layer->area += cloud->own[i] * cloud->own[i];
		}
	layer->p = p;
	layer->own = own;
	layer->of = of;
	layer->box = mr_box_of(p, layer->n);
	layer->diagonal = mr_box_diagonal(layer->box);
	return mr_near_build_distinct(ctx, p, layer->n, &layer->near);
}

/* Joins all to the largest part but those that lie over others; how many layers there are. */
static mr_status
join_layers(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_cloud *flat, uint32_t *set, size_t *layers)
{
	mr_mark mark = mr_mark_take(ctx);
	uint32_t *size = MR_NEW_ZERO(ctx, cloud->n, uint32_t), *over = MR_NEW_ZERO(ctx, cloud->n, uint32_t),
		 base = 0;

	for (uint32_t i = 0; i < cloud->n; i++)
		size[mr_sets_root(set, i)]++;
	for (uint32_t i = 1; i < cloud->n; i++)
		base = size[i] > size[base] ? i : base;
	MR_TRY(count_over(ctx, cloud, flat, set, size, base, over));
	*layers = 1;
	for (uint32_t i = 0; i < cloud->n; i++)
		if (size[i] >= MR_WRAP_FIELD_LEAST && over[i] > OVER * size[i])
			++*layers;
		else if (size[i] > 0)
			mr_sets_join(set, i, base);
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* Turns axis[2] to the side on which most directions of the points are. */
static void
face_sides(const mr_wrap_cloud *cloud, mr_v3 axis[3])
{
	double side = 0;

	for (size_t i = 0; cloud->sides && i < cloud->n; i++) {
		double up = mr_dot(cloud->sides->toward[cloud->of[i]], axis[2]);
		side += up > 0 ? 1 : up < 0 ? -1 : 0;
	}
	if (side < 0) {
		axis[1] = mr_mul(-1, axis[1]);
		axis[2] = mr_mul(-1, axis[2]);
	}
}

/* The points as a field over the plane of axis[0] and axis[1], and how pairs are off it. */
static mr_status
open_field(
    mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_v3 *axis, const probes *q, mr_wrap_field *f, pairs *of)
{
	f->cloud = *cloud;
	memcpy(f->axis, axis, sizeof f->axis);
	face_sides(cloud, f->axis);
	MR_TRY(flatten(ctx, cloud, f->axis, &f->flat));
	return look_at_pairs(ctx, cloud, &f->flat, q, of);
}

/* The points of whole as several fields, one over the other; none where they are not. */
static mr_status
find_layers(mr_ctx *ctx, const mr_wrap_field *whole, mr_wrap_field **field, size_t *fields)
{
	const mr_wrap_cloud *cloud = &whole->cloud;
	uint32_t *set = mr_sets_new(ctx, cloud->n);
	size_t layers, found = 0;

	*fields = 0;
	MR_TRY(find_parts(ctx, cloud, whole->axis[2], set));
	MR_TRY(join_layers(ctx, cloud, &whole->flat, set, &layers));
	if (layers == 1 || layers > LAYERS_MOST)
		return MR_OK;
	*field = MR_NEW(ctx, layers, mr_wrap_field);
	for (uint32_t i = 0; i < cloud->n; i++) {
		mr_wrap_cloud layer;
		pairs of;
		probes q;
		if (mr_sets_root(set, i) != i)
			continue;
		MR_TRY(take_layer(ctx, cloud, set, i, &layer));
		MR_TRY(find_planes(ctx, &layer, &q));
		MR_TRY(open_field(ctx, &layer, whole->axis, &q, *field + found++, &of));
		if (of.off > OFF_MOST)
			return MR_OK;
	}
	*fields = found;
	return MR_OK;
}

/* Whether normals of the points face outward on both sides of them, as a slab's. */
static bool
face_apart(const mr_wrap_cloud *cloud)
{
	mr_v3 c = { 0, 0, 0 };
	double sum = 0, all = 0;

	for (size_t i = 0; i < cloud->n; i++)
		c = mr_axpy(1 / (double)cloud->n, cloud->p[i], c);
	for (size_t i = 0; cloud->sides && i < cloud->n; i++) {
		mr_v3 n = cloud->sides->toward[cloud->of[i]];
		double out = mr_finite(n) ? mr_dot(mr_unit(n), mr_sub(cloud->p[i], c)) : 0;
		sum += out;
		all += fabs(out);
	}
	return sum > APART * all;
}

mr_status
mr_wrap_find_fields(mr_ctx *ctx, const mr_wrap_cloud *cloud, mr_wrap_field **field, size_t *fields)
{
	mr_wrap_field *whole = MR_NEW(ctx, 1, mr_wrap_field);
	mr_v3 axis[3];
	pairs of;
	probes q;

	*fields = 0;
	if (cloud->n < MR_WRAP_FIELD_LEAST || cloud->sampling.noise > NOISE_MOST * cloud->spacing)
		return MR_OK;
	MR_TRY(find_planes(ctx, cloud, &q));
	if (find_axes(&q, axis) > UPRIGHT_MOST)
		return MR_OK;
	MR_TRY(open_field(ctx, cloud, axis, &q, whole, &of));
	if (of.between < BETWEEN_MOST && !face_apart(cloud))
		MR_TRY(find_layers(ctx, whole, field, fields));
	if (*fields == 0 && of.off <= OFF_MOST) {
		*field = whole;
		*fields = 1;
	}
	return MR_OK;
}

/* Rows of equilateral triangles over the box and the margin. */
static mr_status
make_lattice(mr_ctx *ctx, const mr_wrap_cloud *flat, double edge, mr_mesh *out)
{
	double high = sqrt(3) / 2 * edge, margin = MARGIN * flat->spacing + edge;
	mr_v3 low = flat->box.min, size = mr_sub(flat->box.max, low);
	double along = ceil((size.x + 2 * margin) / edge) + 1, across = ceil((size.y + 2 * margin) / high);
	size_t most = NODES_PER_POINT * flat->n, w = (size_t)along + 1, h = (size_t)across + 1;
	mr_v3 *p;
	mr_tri *t, *next;

	if (along * across > (double)(most < NODES_LEAST ? NODES_LEAST : most))
		return mr_fail(ctx, MR_EMESH,
		    "the points lie so far apart that they need a lattice of %.0f x %.0f", along, across);
	p = MR_NEW(ctx, w * h, mr_v3);
	next = t = MR_NEW(ctx, 2 * (w - 1) * (h - 1), mr_tri);
	for (size_t y = 0; y < h; y++)
		for (size_t x = 0; x < w; x++)
			p[y * w + x] = mr_vec(low.x - margin + ((double)x - (y % 2 ? 0.5 : 0)) * edge,
			    low.y - margin + (double)y * high, 0);
	for (size_t y = 0; y + 1 < h; y++)
		for (size_t x = 0; x + 1 < w; x++) {
			uint32_t a = (uint32_t)(y * w + x), b = a + 1, c = a + (uint32_t)w, d = c + 1;
			*next++ = y % 2 ? (mr_tri){ { a, b, c } } : (mr_tri){ { a, b, d } };
			*next++ = y % 2 ? (mr_tri){ { b, d, c } } : (mr_tri){ { a, d, c } };
		}
	*out = (mr_mesh){ "control", p, t, w * h, (size_t)(next - t) };
	return MR_OK;
}

/* The flat mesh on the mean level of the nearest points, in space. */
static mr_status
lift(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_cloud *flat, const mr_v3 axis[3], mr_mesh *m)
{
	mr_v3 *p = MR_NEW(ctx, m->nv, mr_v3);
	uint32_t *nearest = MR_NEW(ctx, m->nv * HEIGHTS, uint32_t);
	double *dist2 = MR_NEW(ctx, m->nv * HEIGHTS, double), least = flat->spacing * flat->spacing / 16;

	MR_TRY(mr_near_query(ctx, flat->near, m->p, m->nv, HEIGHTS, nearest, dist2));
	for (size_t v = 0; v < m->nv; v++) {
		double height = 0, weights = 0;
		for (size_t i = v * HEIGHTS; i < (v + 1) * HEIGHTS && nearest[i] != MR_NONE; i++) {
			double w = 1 / (dist2[i] + least);
			height += w * mr_dot(axis[2], cloud->p[nearest[i]]);
			weights += w;
		}
		p[v] = mr_axpy(
		    m->p[v].x, axis[0], mr_axpy(m->p[v].y, axis[1], mr_mul(height / weights, axis[2])));
	}
	m->p = p;
	return MR_OK;
}

/* The flat outline, lifted; lids: its openings. */
static mr_status
make_sheet(mr_ctx *ctx, const mr_wrap_field *f, const mr_wrap_opts *o, mr_wrap_lids *lids, mr_mesh *m)
{
	uint32_t nearest;

	MR_TRY(make_lattice(ctx, &f->flat, mr_wrap_length(&f->cloud, o), m));
	MR_TRY(mr_wrap_cut(ctx, &f->flat, o->lids, false, m, lids));
	MR_TRY(mr_near_query(ctx, f->flat.near, &lids->at, 1, 1, &nearest, NULL));
	lids->at = f->cloud.p[nearest];
	return lift(ctx, &f->cloud, &f->flat, f->axis, m);
}

/* A gap that is narrow only in the projection, as at a hidden wall, is an opening too. */
static mr_status
wrap_field(mr_ctx *ctx, const mr_wrap_field *f, const mr_wrap_opts *o, mr_wrap_lids *lids, mr_dyn *d)
{
	mr_mesh m;

	MR_TRY(make_sheet(ctx, f, o, lids, &m));
	MR_TRY(mr_wrap_settle_open(ctx, &f->cloud, o, &m, d));
	return mr_wrap_open(ctx, &f->cloud, o, false, lids, d);
}

static void
add_lids(const mr_wrap_lids *from, mr_wrap_lids *to)
{
	if (from->width > to->width) {
		to->width = from->width;
		to->at = from->at;
	}
	to->openings += from->openings;
	to->holes += from->holes;
	to->doubtful += from->doubtful;
}

/* All meshes in one. */
static mr_status
join(mr_ctx *ctx, const mr_dyn *d, size_t n, mr_dyn *out)
{
	mr_mesh all = { .name = "control" };
	mr_tri *t;
	mr_v3 *p;

	for (size_t i = 0; i < n; i++) {
		all.nv += d[i].nv;
		all.nf += d[i].nf;
	}
	p = MR_NEW(ctx, all.nv, mr_v3);
	t = MR_NEW(ctx, all.nf, mr_tri);
	all = (mr_mesh){ .name = "control", .p = p, .t = t };
	for (size_t i = 0; i < n; i++) {
		mr_mesh m = mr_dyn_view(&d[i], "control");
		uint32_t first = (uint32_t)all.nv;
		memcpy(p + all.nv, m.p, m.nv * sizeof *p);
		for (size_t f = 0; f < m.nf; f++)
			t[all.nf++] = (mr_tri){ { first + m.t[f].v[0], first + m.t[f].v[1],
			    first + m.t[f].v[2] } };
		all.nv += m.nv;
	}
	return mr_wrap_dyn(ctx, &all, out);
}

mr_status
mr_wrap_fields(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, const mr_wrap_field *field,
    size_t fields, mr_wrap *w)
{
	mr_dyn *d = MR_NEW(ctx, fields, mr_dyn);

	for (size_t i = 0; i < fields; i++) {
		mr_wrap_lids lids = { 0 };
		MR_TRY(wrap_field(ctx, &field[i], o, &lids, &d[i]));
		add_lids(&lids, &w->lids);
	}
	w->d = d[0];
	if (fields > 1)
		MR_TRY(join(ctx, d, fields, &w->d));
	return mr_wrap_assess(ctx, cloud, w);
}
