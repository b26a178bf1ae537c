/*
 * Height fields: terrain, reliefs, scans from one side.  A flat lattice under the points, cut to their
 * outline and lifted onto them.  What lies over the rest of the points, as a table over a floor, is a field
 * of its own.
 */
#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include "space/local_planes.h"
#include "wrap/parts.h"

/*
 * A cloud is a height field over a plane where hardly any of its own planes is within 12 degrees of upright
 * on it, neighbours in the projection lie on each other's planes, and noise does not hide that.  Of 20 clouds
 * of terrain, reliefs and scans from one side, and of cities seen from the air, 0 to 2.4 % of the planes are
 * upright and 0 to 15 % of the pairs off.  Of 325 clouds of 54 closed models, whole and cut, 11 have less
 * than 3 % upright, and of these 20 % are off for half a body, 32 to 56 % for others, but for a thin plate as
 * noisy as thick.
 */
static const double UPRIGHT = 0.2;       /* cosine to the normal of the plane */
static const double UPRIGHT_MOST = 0.03; /* share of the planes */
static const double OFF = 1, NOISE = 4;  /* spacings and deviations of noise from a plane, that are off it */
static const double OFF_MOST = 0.2;      /* share of the pairs */
static const double NOISE_MOST = 0.5;    /* spacings */

/* Links of a sheet: their height and length, in lengths and spacings.  Of its points so many are over others
 * where it is a layer; of normals' ways from the middle so much is outward of a slab. */
static const double STEEP = 0.7, REACH = 3, OVER = 0.8, APART = 0.5;

enum {
	PROBES = 4096,
	PLACES_LEAST = 100,
	PLANE_MOST = 128,
	AROUND = 16,
	PAIRS = 9,
	HEIGHTS = 5,
	LAYERS_MOST = 64
};

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

/* The share of pairs of neighbours in the projection that are not on one sheet. */
static mr_status
share_off(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_cloud *flat, const probes *q, double *share)
{
	mr_v3 *p = MR_NEW(ctx, q->n, mr_v3);
	uint32_t *nearest = MR_NEW(ctx, q->n * PAIRS, uint32_t);
	size_t off = 0, all = 0;

	for (size_t i = 0; i < q->n; i++)
		p[i] = flat->p[q->at[i]];
	MR_TRY(mr_near_query(ctx, flat->near, p, q->n, PAIRS, nearest, NULL));
	for (size_t i = 0; i < q->n; i++) {
		double most = OFF * cloud->own[q->at[i]] + NOISE * cloud->sampling.noise;
		for (size_t j = 1; j < PAIRS && nearest[i * PAIRS + j] != MR_NONE; j++, all++)
			off += fabs(mr_dot(mr_sub(cloud->p[nearest[i * PAIRS + j]], cloud->p[q->at[i]]),
				   q->normal[i])) > most;
	}
	*share = (double)off / (double)all;
	return MR_OK;
}

/* The share of the pairs that are off where the points are taken for a field over axis[2]. */
static mr_status
measure_field(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_v3 *axis, double *off)
{
	mr_mark mark = mr_mark_take(ctx);
	mr_wrap_cloud flat;
	probes q;

	MR_TRY(find_planes(ctx, cloud, &q));
	MR_TRY(flatten(ctx, cloud, axis, &flat));
	MR_TRY(share_off(ctx, cloud, &flat, &q, off));
	mr_mark_release(ctx, mark);
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

/* Counts each part's points, and those over or under the points of other parts that are not small. */
static mr_status
count_over(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_cloud *flat, uint32_t *set, uint32_t *size,
    uint32_t *over)
{
	mr_mark mark = mr_mark_take(ctx);
	uint32_t *nearest = MR_NEW(ctx, cloud->n * PAIRS, uint32_t);
	double *dist2 = MR_NEW(ctx, cloud->n * PAIRS, double);

	for (uint32_t i = 0; i < cloud->n; i++)
		size[mr_sets_root(set, i)]++;
	MR_TRY(mr_near_query(ctx, flat->near, flat->p, cloud->n, PAIRS, nearest, dist2));
	for (uint32_t i = 0; i < cloud->n; i++) {
		bool is_over = false;
		for (size_t k = i * PAIRS; k < (i + 1) * PAIRS && nearest[k] != MR_NONE; k++)
			is_over |= dist2[k] < cloud->own[i] * cloud->own[i] &&
			           mr_sets_root(set, nearest[k]) != mr_sets_root(set, i) &&
			           size[mr_sets_root(set, nearest[k])] >= PLACES_LEAST;
		over[mr_sets_root(set, i)] += is_over;
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
static size_t
join_layers(const mr_wrap_cloud *cloud, uint32_t *set, const uint32_t *size, const uint32_t *over)
{
	uint32_t base = 0;
	size_t layers = 1;

	for (uint32_t i = 1; i < cloud->n; i++)
		base = size[i] > size[base] ? i : base;
	for (uint32_t i = 0; i < cloud->n; i++)
		if (size[i] > 0 && i != base) {
			if (size[i] >= PLACES_LEAST && over[i] > OVER * size[i])
				layers++;
			else
				mr_sets_join(set, i, base);
		}
	return layers;
}

/* Sets f->layer and f->layers where the points are several fields, one over the other. */
static mr_status
find_layers(mr_ctx *ctx, const mr_wrap_cloud *cloud, mr_wrap_fields *f)
{
	uint32_t *set = mr_sets_new(ctx, cloud->n), *size = MR_NEW_ZERO(ctx, cloud->n, uint32_t),
		 *over = MR_NEW_ZERO(ctx, cloud->n, uint32_t);
	mr_wrap_cloud flat;
	size_t layers, found = 0;

	MR_TRY(flatten(ctx, cloud, f->axis, &flat));
	MR_TRY(find_parts(ctx, cloud, f->axis[2], set));
	MR_TRY(count_over(ctx, cloud, &flat, set, size, over));
	layers = join_layers(cloud, set, size, over);
	if (layers == 1 || layers > LAYERS_MOST)
		return MR_OK;
	f->layer = MR_NEW(ctx, layers, mr_wrap_cloud);
	for (uint32_t i = 0; i < cloud->n; i++) {
		double off;
		if (mr_sets_root(set, i) != i)
			continue;
		MR_TRY(take_layer(ctx, cloud, set, i, &f->layer[found]));
		MR_TRY(measure_field(ctx, &f->layer[found++], f->axis, &off));
		if (off > OFF_MOST)
			return MR_OK;
	}
	f->layers = found;
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
mr_wrap_find_fields(mr_ctx *ctx, mr_wrap_cloud *cloud, mr_wrap_fields *f)
{
	double off;
	probes q;

	*f = (mr_wrap_fields){ 0 };
	if (cloud->n < PLACES_LEAST || cloud->sampling.noise > NOISE_MOST * cloud->spacing)
		return MR_OK;
	MR_TRY(find_planes(ctx, cloud, &q));
	if (find_axes(&q, f->axis) > UPRIGHT_MOST)
		return MR_OK;
	MR_TRY(measure_field(ctx, cloud, f->axis, &off));
	if (off > 0 && !face_apart(cloud))
		MR_TRY(find_layers(ctx, cloud, f));
	if (f->layers == 0 && off <= OFF_MOST) {
		f->layer = cloud;
		f->layers = 1;
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
		    "the points lie so far apart that a lattice of %.0f x %.0f tells them", along, across);
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
make_sheet(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, const mr_v3 axis[3],
    mr_wrap_cloud *flat, mr_wrap_lids *lids, mr_mesh *m)
{
	uint32_t nearest;

	MR_TRY(flatten(ctx, cloud, axis, flat));
	MR_TRY(make_lattice(ctx, flat, mr_wrap_length(cloud, o), m));
	MR_TRY(mr_wrap_cut(ctx, flat, o->lids, false, m, lids));
	MR_TRY(mr_near_query(ctx, flat->near, &lids->at, 1, 1, &nearest, NULL));
	lids->at = cloud->p[nearest];
	return lift(ctx, cloud, flat, axis, m);
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

/* What is wide but in the projection, as the wall behind what hides it, is an opening too. */
static mr_status
wrap_field(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, const mr_v3 axis[3],
    mr_wrap_lids *lids, mr_dyn *d)
{
	mr_v3 own[3] = { axis[0], axis[1], axis[2] };
	size_t openings;
	mr_wrap_cloud flat;
	mr_mesh m;

	face_sides(cloud, own);
	MR_TRY(make_sheet(ctx, cloud, o, own, &flat, lids, &m));
	MR_TRY(mr_wrap_settle_open(ctx, cloud, o, &m, d));
	m = mr_dyn_view(d, "control");
	openings = lids->openings;
	MR_TRY(mr_wrap_cut(ctx, cloud, o->lids, false, &m, lids));
	return lids->openings > openings ? mr_wrap_settle_open(ctx, cloud, o, &m, d) : MR_OK;
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
mr_wrap_sheets(
    mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_wrap_opts *o, const mr_wrap_fields *f, mr_wrap *w)
{
	mr_dyn *d = MR_NEW(ctx, f->layers, mr_dyn);

	for (size_t i = 0; i < f->layers; i++) {
		mr_wrap_lids lids = { 0 };
		MR_TRY(wrap_field(ctx, &f->layer[i], o, f->axis, &lids, &d[i]));
		add_lids(&lids, &w->lids);
	}
	w->d = d[0];
	if (f->layers > 1)
		MR_TRY(join(ctx, d, f->layers, &w->d));
	return mr_wrap_assess(ctx, cloud, w);
}
