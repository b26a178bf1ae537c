/* Botsch, Kobbelt 2004: A remeshing approach to multiresolution modeling: tangential smoothing to the
 * gravity-weighted centroid, and back onto the source by a walk. */
#include "remesh/relax.h"

#include "base/parallel.h"
#include "mesh/guarded_move.h"
#include "op/voronoi_area.h"
#include "space/surface_walk.h"

enum { GRAIN = 2048 };

typedef struct pass {
	mr_dyn *d;
	const mr_remesh_source *s;
	const mr_relax_opts *o;
	bool project;    /* in this pass */
	float *part;     /* in the same memory as p: of each half-edge, as in areas_job */
	double *gravity; /* of each vertex, first its area */
	mr_v3 *p;        /* where the vertices go */
	uint32_t *at;
} pass;

double
mr_remesh_length(const mr_remesh_source *s, const mr_dyn *d, uint32_t v)
{
	return s->length ? s->mean[mr_dyn_place(d, v)] : s->uniform;
}

typedef struct areas_job {
	const mr_dyn *d;
	double unit;  /* of area */
	float *part;  /* of each half-edge: of its face, what belongs to its start */
	double *area; /* of each vertex */
} areas_job;

static void
parts_body(void *arg, size_t begin, size_t end)
{
	const areas_job *w = arg;
	const mr_dyn *d = w->d;

	for (size_t f = begin; f < end; f++) {
		const uint32_t *v = &d->v[3 * f];
		double part[3];
		if (mr_dyn_face_dead(d, f))
			continue;
		mr_voronoi_corners(d->p[v[0]], d->p[v[1]], d->p[v[2]], part);
		for (int k = 0; k < 3; k++)
			w->part[3 * f + (size_t)k] = (float)(part[k] / w->unit);
	}
}

static double
area_of(const areas_job *w, uint32_t v)
{
	uint32_t h = w->d->out[v];
	double area = 0;

	do {
		area += w->part[h];
		h = mr_dyn_ccw(w->d, h);
	} while (h != MR_NONE && h != w->d->out[v]);
	return area;
}

static void
areas_body(void *arg, size_t begin, size_t end)
{
	const areas_job *w = arg;

	for (size_t v = begin; v < end; v++)
		w->area[v] = w->d->kind[v] == MR_DEAD ? 0 : area_of(w, (uint32_t)v);
}

static void
find_areas(mr_ctx *ctx, areas_job w)
{
	mr_parallel(ctx, w.d->nf, GRAIN, parts_body, &w);
	mr_parallel(ctx, w.d->nv, GRAIN, areas_body, &w);
}

void
mr_dyn_areas(mr_ctx *ctx, const mr_dyn *d, double unit, double *area)
{
	MR_SCOPE(ctx);
	float *part = MR_NEW(ctx, 3 * d->nf, float);

	find_areas(ctx, (areas_job){ d, unit * unit, part, area });
}

/* a^e, quick for the exponents that there are by default. */
static double
power(double a, double e)
{
	return e == 1 ? a : e == 1.5 ? a * sqrt(a) : pow(a, e);
}

/* The mass by which a vertex draws its neighbours: its area, in units of the target, to a power. */
static void
gravity_body(void *arg, size_t begin, size_t end)
{
	pass *w = arg;

	for (uint32_t v = (uint32_t)begin; v < end; v++) {
		double l, a;
		if (w->d->kind[v] == MR_DEAD)
			continue;
		l = mr_remesh_length(w->s, w->d, v) / w->s->uniform;
		a = w->gravity[v] / (l * l);
		if (mr_dyn_on_boundary(w->d, v))
			a *= 2; /* it has about half the area of an inner one */
		w->gravity[v] = power(a, w->o->gravity);
	}
}

bool
mr_remesh_against(
    const mr_remesh_source *s, const mr_dyn *d, const uint32_t *at, const uint32_t v[3], mr_v3 cross)
{
	for (int k = 0; k < 3; k++) {
		uint32_t place = d->kind[v[k]] == MR_SMOOTH ? at[v[k]] : at[v[k]] / 3;
		if (mr_dot(cross, mr_face_cross(s->m, place)) >= 0)
			return false;
	}
	return true;
}

/* True where the source at the place points the way of the normal, or nothing is known of either. */
static bool
agrees(const mr_mesh *m, mr_closest place, mr_v3 normal)
{
	return mr_dot(mr_face_cross(m, place.at.face), normal) >= 0;
}

mr_closest
mr_remesh_place(const mr_remesh_source *s, const mr_dyn *d, uint32_t v, mr_v3 q, mr_v3 normal)
{
	mr_closest best = mr_project_walk(s->m, s->topo, mr_dyn_place(d, v), q);
	double far = MR_FAR * mr_remesh_length(s, d, v);
	bool good = agrees(s->m, best, normal);
	uint32_t h = d->out[v];

	if (good && best.dist2 <= far * far)
		return best;
	do {
		mr_closest c = mr_project_walk(s->m, s->topo, mr_dyn_place(d, mr_dyn_to(d, h)), q);
		bool agreed = agrees(s->m, c, normal);
		if (agreed > good || (agreed == good && c.dist2 < best.dist2)) {
			best = c;
			good = agreed;
		}
		h = mr_dyn_ccw(d, h);
	} while (h != MR_NONE && h != d->out[v]);
	return best;
}

/* p + lambda (I - n n^T) (g - p) */
static mr_v3
tangential_move(const pass *w, uint32_t v, mr_v3 *normal)
{
	const mr_dyn *d = w->d;
	uint32_t h = d->out[v];
	uint32_t b = mr_dyn_to(d, h);
	mr_v3 p = d->p[v], n = { 0, 0, 0 }, g = { 0, 0, 0 }, move, pb = mr_sub(d->p[b], p);
	double mass = 0;

	do { /* b is the end of h, pb the way there */
		uint32_t prev = mr_he_prev(h), c = d->v[prev];
		double gb = w->gravity ? w->gravity[b] : 1;
		mr_v3 pc = mr_sub(d->p[c], p);
		n = mr_add(n, mr_cross(pb, pc));
		g = mr_axpy(gb, pb, g);
		mass += gb;
		b = c;
		pb = pc;
		h = d->twin[prev];
	} while (h != MR_NONE && h != d->out[v]);
	*normal = n;
	if (!(mass > 0))
		return p;
	*normal = n = mr_unit(n);
	move = mr_mul(1 / mass, g);
	return mr_axpy(w->o->damping, mr_axpy(-mr_dot(move, n), n, move), p);
}

/* Along the curve: towards where it divides the way between its two neighbours as the target lengths there
 * do. */
static mr_v3
curve_move(const pass *w, uint32_t v)
{
	const mr_dyn *d = w->d;
	double here = mr_remesh_length(w->s, d, v), length[2];
	uint32_t end[2];

	mr_dyn_along(d, v, end); /* there are two */
	for (int i = 0; i < 2; i++)
		length[i] = fmin(here, mr_remesh_length(w->s, d, end[i]));
	return mr_lerp(
	    w->o->damping, d->p[v], mr_lerp(length[0] / (length[0] + length[1]), d->p[end[0]], d->p[end[1]]));
}

/* True where face `to` of the source points against the normal, and face `from` did not: over a rim. */
static bool
leaves_side(const mr_mesh *m, uint32_t from, uint32_t to, mr_v3 normal)
{
	return to != from && mr_dot(mr_face_cross(m, to), normal) < 0 &&
	       mr_dot(mr_face_cross(m, from), normal) >= 0;
}

static void
move_body(void *arg, size_t begin, size_t end)
{
	pass *w = arg;
	const mr_remesh_source *s = w->s;

	for (uint32_t v = (uint32_t)begin; v < end; v++) {
		mr_v3 p = w->d->p[v], normal;
		uint32_t at = w->d->at[v];
		switch ((mr_kind)w->d->kind[v]) {
		case MR_SMOOTH:
			p = tangential_move(w, v, &normal);
			if (w->project) {
				mr_closest c = mr_remesh_place(s, w->d, v, p, normal);
				if (leaves_side(s->m, at, c.at.face, normal)) {
					p = w->d->p[v];
					break;
				}
				p = c.point;
				at = c.at.face;
			}
			break;
		case MR_CURVE: /* a curve is kept as it is: always on the source */
			p = mr_project_curve(s->m, s->topo, s->curve, at, curve_move(w, v), &at).point;
			break;
		case MR_CORNER:
		case MR_DEAD:
			break;
		}
		w->p[v] = p;
		w->at[v] = at;
	}
}

static void
pass_new(mr_ctx *ctx, pass *w)
{
	size_t nv = w->d->nv, p = nv * sizeof(mr_v3), parts = 3 * w->d->nf * sizeof *w->part;
	char *shared = MR_NEW(ctx, p > parts ? p : parts, char);

	w->gravity = w->o->gravity > 0 ? MR_NEW(ctx, nv, double) : NULL;
	w->at = MR_NEW(ctx, nv, uint32_t);
	w->part = (void *)shared;
	w->p = (void *)shared;
}

/* The masses of the vertices, where they have any. */
static void
find_gravity(mr_ctx *ctx, pass *w)
{
	if (!w->gravity)
		return;
	find_areas(ctx, (areas_job){ w->d, w->s->uniform * w->s->uniform, w->part, w->gravity });
	mr_parallel(ctx, w->d->nv, GRAIN, gravity_body, w);
}

static mr_status
one_pass(mr_ctx *ctx, mr_dyn *d, pass *w)
{
	mr_mesh m = mr_dyn_view(d, w->s->m->name);

	find_gravity(ctx, w);
	mr_parallel(ctx, d->nv, GRAIN, move_body, w);
	return mr_move_unfolded(ctx, &m, &(mr_topology){ d->twin, d->out }, MR_NEEDLE, w->p);
}

static void
keep_body(void *arg, size_t begin, size_t end)
{
	pass *w = arg;
	mr_dyn *d = w->d;

	for (size_t v = begin; v < end; v++) {
		if (memcmp(&w->p[v], &d->p[v], sizeof *d->p) !=
		    0) /* else what was held back is where it was */
			d->at[v] = w->at[v];
		d->p[v] = w->p[v];
	}
}

mr_status
mr_relax(mr_ctx *ctx, mr_dyn *d, const mr_remesh_source *s, const mr_relax_opts *o)
{
	MR_SCOPE(ctx);
	pass w = { .d = d, .s = s, .o = o };

	pass_new(ctx, &w);
	for (size_t i = 1; i <= o->passes; i++) {
		w.project = o->project && i == o->passes;
		MR_TRY(one_pass(ctx, d, &w));
		mr_parallel(ctx, d->nv, GRAIN, keep_body, &w);
	}
	return MR_OK;
}
