/*
 * Sharp edges: where vertices on either side of one see different planes, the surface is cut between them and
 * the cut goes to where their planes meet: Kobbelt, Botsch, Schwanecke, Seidel 2001 (Feature sensitive
 * surface extraction), Ju, Losasso, Schaefer, Warren 2002 (Dual contouring).
 */
#include "simplify/creases.h"

#include "base/disjoint_sets.h"
#include "mesh/guarded_move.h"
#include "space/local_planes.h"

/* Points within REACH of a place count for it. */
enum { AROUND = 10, NEAREST = 32, ROUNDS = 5, SPREAD = 3 };
static const double REACH = 3;

/* Variation of points in a plane, at most; a neighbour's plane is better where FLATTER times as flat. */
static const double FLAT = 0.002, FLATTER = 4;

/* Least ratio of eigenvalues of the normals' second moment that counts as a second plane: tan^2 of half the
 * angle between two, so 35 degrees. */
static const double OWN = 0.1;

/* How far a vertex of a wrap goes: further on it is one of the next row. */
static const double FARTHEST = 2;

/* Degrees between the planes on both sides. */
static const double ANGLE = 50;

/* Normals within that many degrees are of one side. */
static const double ALIKE = 25;

/* The cosine between a face and its side: less is a fold. */
static const double UPRIGHT = 0.5;

/* Points count across a curve within that many spacings along it, and further than GAP from it. */
static const double ALONG = 1.5, GAP = 0.5;

/* The share of the points' weights across an edge, from which they count as lying on one side. */
static const double ONE_SIDED = 0.95;

/* The share of its angle that a curve jumps by, at least, as if EVEN more edges that cross it did not jump.
 */
static const double JUMP = 0.85, EVEN = 2;

/* More than a share of the seemingly sharp edges are sharp: MOST of all, LIKELY in PATCHES of VOTERS
 * vertices, where curves are short. */
static const double MOST = 0.5, LIKELY = 0.2;
enum { VOTERS = 512, PATCHES = 8 };

/* Planes met from a place: A = sum n n^T, b = sum n (n . to the point). */
typedef struct meeting {
	double a[6];
	mr_v3 b;
	size_t count;
} meeting;

static void
meet(meeting *s, mr_v3 n, double height)
{
	s->a[0] += n.x * n.x;
	s->a[1] += n.x * n.y;
	s->a[2] += n.x * n.z;
	s->a[3] += n.y * n.y;
	s->a[4] += n.y * n.z;
	s->a[5] += n.z * n.z;
	s->b = mr_axpy(height, n, s->b);
	s->count++;
}

/* x = A^+ b, without the eigenvalues that are small: the nearest place on all planes.  Returns the planes. */
static int
solve(const meeting *s, double own, mr_v3 *x)
{
	double value[3];
	mr_v3 vector[3];
	int planes = 0;

	mr_eigen_sym3(s->a, value, vector);
	*x = mr_vec(0, 0, 0);
	for (int k = 0; k < 3; k++)
		if (value[k] > own * value[2]) {
			*x = mr_axpy(mr_dot(vector[k], s->b) / value[k], vector[k], *x);
			planes++;
		}
	return planes;
}

/* The planes of points, and the nearest of places: NEAREST each. */
typedef struct sight {
	const mr_v3 *p;
	mr_planes planes;
	const uint32_t *near;
	double width;
} sight;

/* Whether point i counts at a place; r: from there to it. */
static bool
counts(const sight *s, uint32_t i, mr_v3 at, mr_v3 *r, double *height)
{
	if (i == UINT32_MAX)
		return false;
	*r = mr_sub(s->p[i], at);
	*height = mr_dot(*r, s->planes.normal[i]);
	return mr_norm(*r) < REACH * s->width && fabs(*height) < FARTHEST * s->width;
}

/* The plane that the surface has at a place, on one side of an edge; no normal: none is seen. */
typedef struct side {
	mr_v3 normal;
	double height;
} side;

/* The mean of the planes at a place that are like one. */
static side
mean_like(const sight *s, const uint32_t *near, mr_v3 at, mr_v3 normal)
{
	side sum = { { 0, 0, 0 }, 0 };
	double height, weights = 0, like = cos(ALIKE * MR_PI / 180);
	mr_v3 r;

	for (int i = 0; i < NEAREST; i++) {
		mr_v3 n;
		double w, t, sign = 1;
		if (!counts(s, near[i], at, &r, &height))
			continue;
		n = s->planes.normal[near[i]];
		if (mr_dot(n, normal) < 0)
			sign = -1;
		if (sign * mr_dot(n, normal) < like)
			continue;
		t = mr_norm(r) / (REACH * s->width);
		w = (1 - t * t) / (FLAT + s->planes.variation[near[i]]);
		w *= w;
		sum.normal = mr_axpy(sign * w, n, sum.normal);
		sum.height += sign * w * height;
		weights += w;
	}
	if (weights > 0)
		sum = (side){ mr_unit(sum.normal), sum.height / weights };
	return sum;
}

/* The neighbour of a point whose plane goes through it and is far flatter than its own. */
static uint32_t
plane_through(const sight *s, size_t i)
{
	uint32_t best = MR_NONE;
	double least = s->planes.variation[i] / FLATTER;

	for (size_t k = 0; k < s->planes.links; k++) {
		uint32_t j = s->planes.neighbor[i * s->planes.links + k];
		double off, far;
		if (j == UINT32_MAX)
			continue;
		off = mr_dot(mr_sub(s->p[j], s->p[i]), s->planes.normal[j]) / s->width;
		far = s->planes.variation[j] + off * off;
		if (far < least) {
			least = far;
			best = j;
		}
	}
	return best;
}

/* Spreads the planes of points to those near an edge, each from its own side. */
static void
spread(mr_ctx *ctx, const sight *s, size_t n)
{
	uint32_t *from = MR_NEW(ctx, n, uint32_t);
	mr_v3 *normal = MR_NEW(ctx, n, mr_v3);
	double *variation = MR_NEW(ctx, n, double);

	for (int round = 0; round < SPREAD; round++) {
		for (size_t i = 0; i < n; i++)
			from[i] = plane_through(s, i);
		memcpy(normal, s->planes.normal, n * sizeof *normal);
		memcpy(variation, s->planes.variation, n * sizeof *variation);
		for (size_t i = 0; i < n; i++)
			if (from[i] != MR_NONE) {
				s->planes.normal[i] = normal[from[i]];
				s->planes.variation[i] = variation[from[i]];
			}
	}
}

/* The plane that a place is nearest to. */
static side
side_of(const sight *s, const uint32_t *near, mr_v3 at, mr_v3 outer)
{
	double least = INFINITY, height;
	mr_v3 best = { 0, 0, 0 }, r;

	for (int i = 0; i < NEAREST; i++) {
		double far;
		if (!counts(s, near[i], at, &r, &height))
			continue;
		far = s->planes.variation[near[i]] +
		      (height * height + 0.04 * mr_norm2(r)) / (s->width * s->width);
		if (far < least) {
			least = far;
			best = s->planes.normal[near[i]];
		}
	}
	if (!(least < INFINITY))
		return (side){ best, 0 };
	return mean_like(s, near, at, mr_dot(best, outer) < 0 ? mr_mul(-1, best) : best);
}

typedef struct finder {
	const mr_mesh *m;
	mr_topology topo;
	const mr_v3 *normal; /* of each vertex */
	const mr_simplify_cloud *cloud;
	sight s;          /* of the points of it that are looked at */
	uint32_t *number; /* of each point of the cloud among those; UINT32_MAX */
	side *side;       /* of each vertex; none of those that are not looked at */
	uint32_t *middle; /* of each half-edge that is cut, the new vertex; MR_NONE */
	size_t cut;       /* edges */
} finder;

/* The points near some places, NEAREST each. */
static mr_status
query(mr_ctx *ctx, const finder *f, const mr_v3 *at, size_t n, uint32_t **near)
{
	*near = mr_alloc(ctx, n, NEAREST * sizeof **near);
	MR_TRY(mr_near_query(ctx, f->cloud->near, at, n, NEAREST, *near, NULL));
	for (size_t i = 0; f->number && i < n * NEAREST; i++)
		if ((*near)[i] != UINT32_MAX)
			(*near)[i] = f->number[(*near)[i]];
	return MR_OK;
}

/* Degrees between the sides of the ends of h. */
static double
bend(const finder *f, uint32_t h)
{
	mr_v3 a = f->side[mr_he_from(f->m, h)].normal, b = f->side[mr_he_to(f->m, h)].normal;

	return mr_norm2(a) > 0 && mr_norm2(b) > 0 ? mr_angle(a, b) * 180 / MR_PI : 0;
}

/* The half-edge that an edge is known by. */
static uint32_t
edge_of(const finder *f, uint32_t h)
{
	return f->topo.twin[h] < h ? f->topo.twin[h] : h;
}

/* The place along the edge of h at equal distance from the planes of both ends. */
static mr_v3
place_on(const finder *f, uint32_t h)
{
	uint32_t a = mr_he_from(f->m, h), b = mr_he_to(f->m, h);
	mr_v3 e = mr_sub(f->m->p[b], f->m->p[a]);
	double x = fabs(mr_dot(e, f->side[b].normal) + f->side[b].height);
	double y = fabs(f->side[a].height - mr_dot(e, f->side[a].normal));

	return mr_axpy(x + y > 0 ? fmin(0.9, fmax(0.1, x / (x + y))) : 0.5, e, f->m->p[a]);
}

/* Sums of a fit y = mean + slope x + jump h: of the weights, and of their products with x, h and y. */
enum { W, WX, WXX, WH, WXH, WY, WXY, WHY, SUMS };

/* A crossing of a surface edge with a crease curve. */
typedef struct crossing {
	uint32_t h;
	double sum[SUMS];
} crossing;

/* Sums up how the normals of points turn across the edge of c, in halves of its angle. */
static void
look_across(const finder *f, const uint32_t *near, mr_v3 at, crossing *c)
{
	mr_v3 a = f->side[mr_he_from(f->m, c->h)].normal, b = f->side[mr_he_to(f->m, c->h)].normal;
	mr_v3 e = mr_sub(f->m->p[mr_he_to(f->m, c->h)], f->m->p[mr_he_from(f->m, c->h)]);
	mr_v3 along = mr_unit(mr_cross(a, b)), out = mr_unit(mr_add(a, b)), across = mr_cross(along, out);
	double half = mr_angle(a, b) / 2, sign = mr_dot(e, across) * mr_dot(b, across) > 0 ? 1 : -1;

	if (mr_dot(e, across) < 0)
		across = mr_mul(-1, across);
	for (int i = 0; i < NEAREST; i++) {
		if (near[i] == UINT32_MAX)
			continue;
		mr_v3 r = mr_mul(1 / f->s.width, mr_sub(f->s.p[near[i]], at)),
		      n = f->s.planes.normal[near[i]];
		double d = mr_norm(r) / REACH, x = mr_dot(r, across) / cos(half);
		double u = mr_dot(r, along) / ALONG, h = x > 0 ? 1 : -1, y, w;
		if (mr_dot(n, out) < 0)
			n = mr_mul(-1, n);
		y = sign * atan2(mr_dot(n, across), mr_dot(n, out));
		if (d >= 1 || fabs(u) >= 1 || fabs(x) < GAP || fabs(y) > half + 0.5 ||
		    fabs(mr_dot(n, along)) > 0.5)
			continue;
		w = (1 - u * u) * (1 - d * d) / (FLAT + f->s.planes.variation[near[i]]);
		y /= half;
		c->sum[W] += w;
		c->sum[WX] += w * x;
		c->sum[WXX] += w * x * x;
		c->sum[WH] += w * h;
		c->sum[WXH] += w * h * x;
		c->sum[WY] += w * y;
		c->sum[WXY] += w * x * y;
		c->sum[WHY] += w * h * y;
	}
}

/* The jump that fits best: 1 where the normals turn at the curve only, 0 where evenly across it. */
static double
jump_of(const double *s)
{
	double xx = s[WXX] - s[WX] * s[WX] / s[W], xh = s[WXH] - s[WX] * s[WH] / s[W],
	       hh = s[W] - s[WH] * s[WH] / s[W], xy = s[WXY] - s[WX] * s[WY] / s[W],
	       hy = s[WHY] - s[WH] * s[WY] / s[W];

	return (xx * hy - xh * xy) / (xx * hh - xh * xh);
}

static void
drop(const finder *f, uint32_t h)
{
	uint32_t twin = f->topo.twin[h];

	f->middle[h] = MR_NONE;
	if (twin != MR_NONE)
		f->middle[twin] = MR_NONE;
}

/* Drops the curves, from corner to corner, across which the normals turn evenly, and curves that are too
 * short to judge. */
static bool
drop_curves(mr_ctx *ctx, const finder *f, crossing *c, size_t n)
{
	mr_mark here = mr_mark_take(ctx);
	uint32_t *set = mr_sets_new(ctx, n);
	double(*sum)[SUMS] = mr_alloc(ctx, n, sizeof *sum), *edges = MR_NEW_ZERO(ctx, n, double);
	bool any = false;

	memset(sum, 0, n * sizeof *sum);
	for (uint32_t t = 0; t < f->m->nf; t++) {
		uint32_t in[3], k = 0;
		for (uint32_t h = 3 * t; h < 3 * t + 3; h++)
			if (f->middle[h] != MR_NONE)
				in[k++] = f->middle[h];
		if (k == 2)
			mr_sets_join(set, in[0], in[1]);
	}
	for (size_t i = 0; i < n; i++) {
		uint32_t curve = mr_sets_root(set, (uint32_t)i);
		edges[curve]++;
		for (int k = 0; k < SUMS; k++)
			sum[curve][k] += c[i].sum[k];
	}
	for (size_t i = 0; i < n; i++) {
		uint32_t curve = mr_sets_root(set, (uint32_t)i);
		if (f->middle[c[i].h] == MR_NONE ||
		    jump_of(sum[curve]) * edges[curve] >= JUMP * (edges[curve] + EVEN))
			continue;
		any = true;
		drop(f, c[i].h);
	}
	mr_mark_release(ctx, here);
	return any;
}

/* Drops the crossings that have points on one side only: a wrap that spans what nobody saw bends at its rim.
 */
static void
drop_one_sided(const finder *f, const crossing *c, size_t n)
{
	for (size_t i = 0; i < n; i++)
		if (!(fabs(c[i].sum[WH]) < ONE_SIDED * c[i].sum[W]))
			drop(f, c[i].h);
}

/* Numbers the edges that are crossed by curves: none unless more than a share of those that seem to be are.
 */
static mr_status
cut_edges(mr_ctx *ctx, finder *f, double share)
{
	size_t nh = 3 * f->m->nf, n = 0;
	uint32_t *near;
	crossing *c;
	mr_v3 *at;

	for (uint32_t h = 0; h < nh; h++) {
		uint32_t e = edge_of(f, h);
		f->middle[h] = e < h ? f->middle[e] : bend(f, h) > ANGLE ? (uint32_t)n++ : MR_NONE;
	}
	c = MR_NEW_ZERO(ctx, n, crossing);
	at = MR_NEW(ctx, n, mr_v3);
	for (uint32_t h = 0; h < nh; h++)
		if (f->middle[h] != MR_NONE && edge_of(f, h) == h) {
			c[f->middle[h]].h = h;
			at[f->middle[h]] = place_on(f, h);
		}
	MR_TRY(query(ctx, f, at, n, &near));
	for (size_t i = 0; i < n; i++)
		look_across(f, near + NEAREST * i, at[i], &c[i]);
	drop_one_sided(f, c, n);
	for (int round = 0; round < ROUNDS && drop_curves(ctx, f, c, n); round++)
		;
	f->cut = 0;
	for (uint32_t h = 0; h < nh; h++) {
		uint32_t e = edge_of(f, h);
		if (f->middle[h] != MR_NONE)
			f->middle[h] = e < h ? f->middle[e] : (uint32_t)(f->m->nv + f->cut++);
	}
	f->cut = (double)f->cut > share * (double)n ? f->cut : 0;
	return MR_OK;
}

/* The surface cut, and where its vertices are to go. */
typedef struct cutting {
	mr_v3 *p, *to;
	mr_tri *t;
	uint8_t *mark;
	mr_v3 *normal;      /* that each face is to have */
	side (*sides)[3];   /* that meet at each new vertex */
	const side **moved; /* of each old vertex beside it; NULL */
	size_t nv, nf;
} cutting;

static void
put_face(cutting *c, const side *s, uint32_t a, uint32_t b, uint32_t d, bool sharp)
{
	mr_v3 cross = mr_cross(mr_sub(c->p[b], c->p[a]), mr_sub(c->p[d], c->p[a]));

	c->normal[c->nf] = s ? s->normal : mr_unit(cross);
	c->t[c->nf] = (mr_tri){ { a, b, d } };
	c->mark[3 * c->nf] = sharp; /* a to b */
	c->mark[3 * c->nf + 1] = c->mark[3 * c->nf + 2] = 0;
	c->nf++;
}

/* Face t, cut.  Three planes meet in a corner within it. */
static void
cut_face(const finder *f, uint32_t t, cutting *c)
{
	uint32_t cuts = 0, h = 3 * t, a, b, d, x, y;

	for (uint32_t k = 3 * t; k < 3 * t + 3; k++)
		cuts += f->middle[k] != MR_NONE;
	if (cuts == 3) {
		uint32_t o = (uint32_t)c->nv++;
		const uint32_t *v = f->m->t[t].v;
		c->p[o] = mr_mul(1.0 / 3, mr_add(mr_add(c->p[v[0]], c->p[v[1]]), c->p[v[2]]));
		for (uint32_t k = 3 * t; k < 3 * t + 3; k++) {
			c->sides[o - f->m->nv][k % 3] = f->side[v[k % 3]];
			put_face(c, &f->side[mr_he_to(f->m, k)], o, f->middle[k], mr_he_to(f->m, k), true);
			put_face(
			    c, &f->side[mr_he_from(f->m, k)], f->middle[k], o, mr_he_from(f->m, k), true);
		}
		return;
	}
	/* Handles two cut edges, h and the one before it. */
	for (uint32_t k = 0; k < 3 && cuts > 0; k++, h = mr_he_next(h))
		if (f->middle[h] != MR_NONE && (cuts == 1 || f->middle[mr_he_prev(h)] != MR_NONE))
			break;
	h = cuts > 0 ? h : 3 * t;
	a = mr_he_from(f->m, h);
	b = mr_he_to(f->m, h);
	d = mr_he_from(f->m, mr_he_prev(h));
	x = f->middle[h];
	y = f->middle[mr_he_prev(h)];
	if (cuts == 0) {
		put_face(c, NULL, a, b, d, false);
	} else if (cuts == 1) {
		put_face(c, NULL, a, x, d, false);
		put_face(c, NULL, x, b, d, false);
	} else {
		put_face(c, &f->side[a], x, y, a, true);
		put_face(c, &f->side[d], y, x, d, true);
		put_face(c, &f->side[b], x, b, d, false);
	}
}

static void
cut_surface(mr_ctx *ctx, const finder *f, cutting *c)
{
	size_t nv = f->m->nv, most = f->cut + f->m->nf, faces = f->m->nf + 6 * f->cut;

	*c = (cutting){ MR_NEW(ctx, nv + most, mr_v3), MR_NEW(ctx, nv + most, mr_v3),
		MR_NEW(ctx, faces, mr_tri), MR_NEW(ctx, 3 * faces, uint8_t), MR_NEW(ctx, faces, mr_v3),
		mr_alloc(ctx, most, sizeof *c->sides), NULL, nv + f->cut, 0 };
	memset(c->sides, 0, most * sizeof *c->sides);
	memcpy(c->p, f->m->p, nv * sizeof *c->p);
	for (uint32_t h = 0; h < 3 * f->m->nf; h++)
		if (f->middle[h] != MR_NONE && edge_of(f, h) == h) {
			uint32_t a = mr_he_from(f->m, h), b = mr_he_to(f->m, h);
			c->p[f->middle[h]] = place_on(f, h);
			c->sides[f->middle[h] - nv][0] = f->side[a];
			c->sides[f->middle[h] - nv][1] = f->side[b];
		}
	for (uint32_t t = 0; t < f->m->nf; t++)
		cut_face(f, t, c);
}

/* New vertices go to where the sides meet, those that they lie between onto their side. */
static mr_status
snap(mr_ctx *ctx, finder *f, cutting *c)
{
	size_t nv = f->m->nv, nw = c->nv - nv;
	uint32_t *near;

	c->moved = MR_NEW_ZERO(ctx, nv, const side *);
	memcpy(c->to, c->p, c->nv * sizeof *c->p);
	for (uint32_t h = 0; h < 3 * f->m->nf; h++)
		if (f->middle[h] != MR_NONE) {
			uint32_t v = mr_he_from(f->m, h);
			c->moved[v] = &f->side[v];
			c->to[v] = mr_axpy(f->side[v].height, f->side[v].normal, c->p[v]);
		}
	MR_TRY(query(ctx, f, c->p + nv, nw, &near));
	for (size_t w = 0; w < nw; w++) {
		meeting s = { .count = 0 };
		mr_v3 x;
		for (int k = 0; k < 3; k++) {
			side m = mean_like(&f->s, near + NEAREST * w, c->p[nv + w], c->sides[w][k].normal);
			if (mr_norm2(c->sides[w][k].normal) > 0 && mr_norm2(m.normal) > 0)
				meet(&s, m.normal, m.height);
		}
		if (s.count > 1 && solve(&s, OWN / 4, &x) > 1 && mr_norm(x) < REACH * f->s.width)
			c->to[nv + w] = mr_add(c->p[nv + w], x);
	}
	return MR_OK;
}

static mr_v3
cross_of(const cutting *c, const mr_v3 *p, uint32_t f)
{
	const uint32_t *v = c->t[f].v;

	return mr_cross(mr_sub(p[v[1]], p[v[0]]), mr_sub(p[v[2]], p[v[0]]));
}

/* Whether face f would look away from its side, more than it did. */
static bool
is_bad(const void *arg, uint32_t f)
{
	const cutting *c = arg;
	double to = mr_dot(mr_unit(cross_of(c, c->to, f)), c->normal[f]);

	return to < UPRIGHT && to < mr_dot(mr_unit(cross_of(c, c->p, f)), c->normal[f]);
}

/* The vertices beside the cut whose faces would look away go to the middle of those around them. */
static void
make_way(mr_ctx *ctx, const cutting *c, size_t nv)
{
	mr_v3 *sum = MR_NEW(ctx, nv, mr_v3);
	uint32_t *count = MR_NEW(ctx, nv, uint32_t);
	uint8_t *bad = MR_NEW(ctx, nv, uint8_t);

	for (int round = 0; round < ROUNDS; round++) {
		memset(sum, 0, nv * sizeof *sum);
		memset(count, 0, nv * sizeof *count);
		memset(bad, 0, nv);
		for (uint32_t h = 0; h < 3 * c->nf; h++) {
			const uint32_t *v = c->t[h / 3].v;
			uint32_t at = v[h % 3];
			if (at >= nv)
				continue;
			sum[at] = mr_add(sum[at], mr_add(c->to[v[(h + 1) % 3]], c->to[v[(h + 2) % 3]]));
			count[at] += 2;
			bad[at] |= c->moved[at] && is_bad(c, h / 3);
		}
		for (size_t v = 0; v < nv; v++)
			if (bad[v]) {
				mr_v3 r = mr_sub(mr_mul(1.0 / count[v], sum[v]), c->to[v]),
				      n = c->moved[v]->normal;
				c->to[v] = mr_add(c->to[v], mr_axpy(-mr_dot(r, n), n, r));
			}
	}
}

/* The vertices about edges across which the normals of the surface turn by two thirds of the angle, on which
 * a wrap that rounds an edge turns. */
static size_t
find_turns(mr_ctx *ctx, const finder *f, uint32_t *at)
{
	uint8_t *seen = MR_NEW_ZERO(ctx, f->m->nv, uint8_t);
	double turn = cos(ANGLE / 1.5 * MR_PI / 180);
	size_t n = 0;

	for (uint32_t h = 0; h < 3 * f->m->nf; h++) {
		uint32_t twin = f->topo.twin[h];
		if (twin != MR_NONE && mr_dot(f->normal[mr_he_to(f->m, mr_he_next(h))],
					   f->normal[mr_he_to(f->m, mr_he_next(twin))]) < turn)
			for (int k = 0; k < 3; k++)
				seen[f->m->t[h / 3].v[k]] = 1;
	}
	for (uint32_t v = 0; v < f->m->nv; v++)
		if (seen[v])
			at[n++] = v;
	return n;
}

/* Looks at the sides of n vertices, by the points near them. */
static mr_status
look(mr_ctx *ctx, finder *f, const uint32_t *at, size_t n)
{
	size_t np = 0;
	uint32_t *near, *number = MR_NEW(ctx, f->cloud->n, uint32_t);
	mr_v3 *place = MR_NEW(ctx, n, mr_v3), *p;

	f->side = MR_NEW_ZERO(ctx, f->m->nv, side);
	for (size_t i = 0; i < n; i++)
		place[i] = f->m->p[at[i]];
	f->number = NULL;
	MR_TRY(query(ctx, f, place, n, &near));
	memset(number, 0xff, f->cloud->n * sizeof *number);
	p = MR_NEW(ctx, n * NEAREST, mr_v3);
	for (size_t i = 0; i < n * NEAREST; i++) {
		uint32_t k = near[i];
		if (k == UINT32_MAX)
			continue;
		if (number[k] == UINT32_MAX) {
			number[k] = (uint32_t)np;
			p[np++] = f->cloud->p[k];
		}
		near[i] = number[k];
	}
	f->number = number;
	f->s.p = p;
	if (np > 0) {
		MR_TRY(mr_cloud_planes(ctx, p, np, AROUND, AROUND - 1, false, &f->s.planes));
		spread(ctx, &f->s, np);
	}
	for (size_t i = 0; i < n; i++)
		f->side[at[i]] = side_of(&f->s, near + NEAREST * i, place[i], f->normal[at[i]]);
	return MR_OK;
}

/* Some of n vertices with their neighbours, patch by patch; patch: VOTERS.  Returns how many. */
static size_t
take_patches(mr_ctx *ctx, const finder *f, const uint32_t *at, size_t n, uint32_t *patch)
{
	uint8_t *due = MR_NEW_ZERO(ctx, f->m->nv, uint8_t);
	size_t count = 0;

	for (size_t i = 0; i < n; i++)
		due[at[i]] = 1;
	for (size_t i = 0; i < PATCHES; i++) {
		size_t next = count, end = count + VOTERS / PATCHES;
		patch[count] = at[i * n / PATCHES];
		count += due[patch[count]];
		for (due[patch[next]] = 0; next < count; next++) {
			uint32_t first = f->topo.out[patch[next]], h = first;
			do {
				uint32_t to = mr_he_to(f->m, h);
				if (due[to] && count < end) {
					patch[count++] = to;
					due[to] = 0;
				}
				h = mr_he_ccw(&f->topo, h);
			} while (h != MR_NONE && h != first);
		}
	}
	return count;
}

/* Whether there may be sharp edges, by patches of n vertices where the surface turns. */
static mr_status
vote(mr_ctx *ctx, finder *f, const uint32_t *at, size_t n, bool *likely)
{
	MR_SCOPE(ctx);
	uint32_t patch[VOTERS];

	*likely = true;
	if (n <= VOTERS)
		return MR_OK;
	MR_TRY(look(ctx, f, patch, take_patches(ctx, f, at, n, patch)));
	MR_TRY(cut_edges(ctx, f, LIKELY));
	*likely = f->cut > 0;
	return MR_OK;
}

mr_status
mr_find_creases(mr_ctx *ctx, const mr_mesh *m, const mr_simplify_cloud *c, mr_mesh *out, uint8_t **mark)
{
	finder f = { .m = m, .cloud = c, .s = { .width = c->sampling.usual } };
	mr_topology topo;
	cutting cut;
	mr_guard guard;
	mr_mark here = mr_mark_take(ctx);
	uint32_t *at = MR_NEW(ctx, m->nv, uint32_t);
	mr_v3 *normal = MR_NEW(ctx, m->nv, mr_v3);
	bool likely;
	size_t n;

	*out = *m;
	*mark = NULL;
	f.middle = MR_NEW(ctx, 3 * m->nf, uint32_t);
	MR_TRY(mr_topology_build(ctx, m, &f.topo));
	mr_vertex_normals(m, normal);
	f.normal = normal;
	n = find_turns(ctx, &f, at);
	MR_TRY(vote(ctx, &f, at, n, &likely));
	if (likely) {
		MR_TRY(look(ctx, &f, at, n));
		MR_TRY(cut_edges(ctx, &f, MOST));
	}
	if (f.cut == 0) {
		mr_mark_release(ctx, here);
		return MR_OK;
	}
	cut_surface(ctx, &f, &cut);
	MR_TRY(snap(ctx, &f, &cut));
	*out = (mr_mesh){ m->name, cut.p, cut.t, cut.nv, cut.nf };
	MR_TRY(mr_topology_build(ctx, out, &topo));
	make_way(ctx, &cut, m->nv);
	guard = (mr_guard){ .t = cut.t,
		.topo = topo,
		.nv = cut.nv,
		.nf = cut.nf,
		.halves = 3,
		.is_bad = is_bad,
		.arg = &cut };
	MR_TRY(mr_guarded_move(ctx, &guard, cut.p, cut.to));
	out->p = cut.to;
	*mark = cut.mark;
	return MR_OK;
}
