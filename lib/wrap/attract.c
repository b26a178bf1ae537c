/*
 * Beyond the nearest point (Jeong, Kim 2001, section 6.4): a vertex over a concavity looks for points along
 * its normal.  A ray goes on by the distance to the nearest point (sphere tracing), so few steps do.
 */
#include "base/parallel.h"
#include "remesh/remesh.h"
#include "wrap/parts.h"

enum { STEPS = 24, GRAIN = 1024 };

mr_status
mr_wrap_remesh(mr_ctx *ctx, const mr_mesh *m, double length, mr_dyn *d)
{
	mr_remesh_opts o = MR_REMESH_DEFAULTS;
	mr_places map;
	mr_mesh out;

	o.length = length;
	o.rounds = 1;
	o.area_passes = 0;
	MR_TRY(mr_remesh(ctx, m, &o, &out, &map, NULL));
	return mr_wrap_dyn(ctx, &out, d);
}

/* Vertices far from all points, and how far along the ray into the body each has come. */
typedef struct search {
	uint32_t *v;
	mr_v3 *at, *way;
	uint32_t *nearest;
	double *dist2;
	size_t n;
} search;

static mr_v3
inward(const mr_dyn *d, uint32_t v)
{
	return mr_mul(-1, mr_unit(mr_dyn_normal_around(d, v)));
}

/* Cosine to the outward normal from which the nearest point is over the vertex: that is inside, no film. */
static const double OVER = 0.3;

static bool
is_film(const mr_dyn *d, uint32_t v, mr_v3 nearest, double far)
{
	mr_v3 way = mr_sub(nearest, d->p[v]);
	double dist = mr_norm(way);

	return dist > far && mr_dot(way, inward(d, v)) >= -OVER * dist;
}

typedef struct marking {
	const mr_dyn *d;
	const mr_v3 *to;
	double far;
	uint8_t *film;
} marking;

static void
mark_body(void *arg, size_t begin, size_t end)
{
	marking *m = arg;

	for (uint32_t v = (uint32_t)begin; v < end; v++)
		m->film[v] = m->d->kind[v] != MR_DEAD && is_film(m->d, v, m->to[v], m->far);
}

static mr_status
search_begin(mr_ctx *ctx, const mr_dyn *d, const double *dist2, const uint8_t *film, search *s)
{
	s->v = MR_NEW(ctx, d->nv, uint32_t);
	if (!s->v)
		return MR_EMEM;
	for (uint32_t v = 0; v < d->nv; v++)
		if (film[v])
			s->v[s->n++] = v;
	s->at = MR_NEW(ctx, s->n, mr_v3);
	s->way = MR_NEW(ctx, s->n, mr_v3);
	s->nearest = MR_NEW(ctx, s->n, uint32_t);
	s->dist2 = MR_NEW(ctx, s->n, double);
	if (!s->at || !s->way || !s->nearest || !s->dist2)
		return MR_EMEM;
	for (size_t i = 0; i < s->n; i++) {
		s->way[i] = inward(d, s->v[i]);
		s->at[i] = d->p[s->v[i]];
		s->dist2[i] = dist2[s->v[i]];
	}
	return MR_OK;
}

static bool
outside(mr_box b, mr_v3 p, mr_v3 way)
{
	return (p.x > b.max.x && way.x >= 0) || (p.y > b.max.y && way.y >= 0) ||
	       (p.z > b.max.z && way.z >= 0) || (p.x < b.min.x && way.x <= 0) ||
	       (p.y < b.min.y && way.y <= 0) || (p.z < b.min.z && way.z <= 0);
}

/* Goes on along each ray by the distance to the nearest point; those that arrive or leave the box are taken
 * out, and the former are sent to where they came to. */
static size_t
search_step(const mr_wrap_cloud *cloud, double reach, search *s, mr_v3 *to)
{
	size_t left = 0;

	for (size_t i = 0; i < s->n; i++) {
		double dist = sqrt(s->dist2[i]);
		mr_v3 at = mr_axpy(dist, s->way[i], s->at[i]);
		if (dist <= reach) {
			to[s->v[i]] = s->at[i];
			continue;
		}
		if (outside(cloud->box, at, s->way[i]))
			continue;
		s->v[left] = s->v[i];
		s->way[left] = s->way[i];
		s->at[left++] = at;
	}
	return left;
}

/* Where the film goes: to what lies along its normals, within reach. */
static mr_status
search_normals(mr_ctx *ctx, const mr_wrap_cloud *cloud, const mr_dyn *d, const double *dist2,
    const uint8_t *film, mr_v3 *to)
{
	mr_mark mark = mr_mark_take(ctx);
	double reach = 1.5 * cloud->spacing;
	search s = { 0 };

	MR_TRY(search_begin(ctx, d, dist2, film, &s));
	for (int i = 0; i < STEPS && s.n > 0; i++) {
		s.n = search_step(cloud, reach, &s, to);
		MR_TRY(mr_near_query(ctx, cloud->near, s.at, s.n, 1, s.nearest, s.dist2));
	}
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* The mean over v and its ring of x. */
static mr_v3
ring_mean(const mr_dyn *d, const mr_v3 *x, uint32_t v)
{
	uint32_t h = d->out[v];
	mr_v3 sum = x[v];
	double count = 1;

	do {
		sum = mr_add(sum, x[mr_dyn_to(d, h)]);
		count++;
		h = mr_dyn_ccw(d, h);
	} while (h != MR_NONE && h != d->out[v]);
	return mr_mul(1 / count, sum);
}

typedef struct sink {
	const mr_dyn *d;
	const uint8_t *film;
	mr_v3 *way, *to;
} sink;

/*
 * Near the points v + way; over a concavity the surface is a film: it sinks by what the ring does, and its
 * curvature flows.
 */
static void
sink_body(void *arg, size_t begin, size_t end)
{
	sink *s = arg;

	for (uint32_t v = (uint32_t)begin; v < end; v++) {
		mr_v3 p = s->d->p[v];
		if (s->d->kind[v] == MR_DEAD)
			s->to[v] = p;
		else if (!s->film[v])
			s->to[v] = mr_add(p, s->way[v]);
		else
			s->to[v] = mr_add(
			    mr_lerp(0.5, p, ring_mean(s->d, s->d->p, v)), ring_mean(s->d, s->way, v));
	}
}

static mr_v3
at_most(mr_v3 x, double length)
{
	double n = mr_norm(x);

	return n > length ? mr_mul(length / n, x) : x;
}

/* v <- v + alpha (q - v), with the q of the search where there is one, by an edge at most. */
mr_status
mr_wrap_draw(mr_ctx *ctx, const mr_wrap_cloud *cloud, double alpha, double length, double far, mr_dyn *d)
{
	mr_mark mark = mr_mark_take(ctx);
	uint32_t *nearest = MR_NEW(ctx, d->nv, uint32_t);
	double *dist2 = MR_NEW(ctx, d->nv, double);
	mr_v3 *to = MR_NEW(ctx, d->nv, mr_v3), *way = MR_NEW(ctx, d->nv, mr_v3);
	uint8_t *film = MR_NEW(ctx, d->nv, uint8_t);

	if (!nearest || !dist2 || !to || !way || !film)
		return MR_EMEM;
	MR_TRY(mr_near_query(ctx, cloud->near, d->p, d->nv, 1, nearest, dist2));
	for (size_t v = 0; v < d->nv; v++)
		to[v] = cloud->p[nearest[v]];
	mr_parallel(ctx, d->nv, GRAIN, mark_body, &(marking){ d, to, far, film });
	MR_TRY(search_normals(ctx, cloud, d, dist2, film, to));
	for (size_t v = 0; v < d->nv; v++)
		way[v] = at_most(mr_mul(alpha, mr_sub(to[v], d->p[v])), length);
	mr_parallel(ctx, d->nv, GRAIN, sink_body, &(sink){ d, film, way, to });
	MR_TRY(mr_wrap_move(ctx, to, d));
	mr_mark_release(ctx, mark);
	return MR_OK;
}
