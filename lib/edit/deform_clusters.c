/* Rotations that are fitted in a model of few. */
#include "edit/deform_clusters.h"

#include "solve/solver.h"

/* With 64 clusters instead of 128 the edges of armadillo's bend are off by 1.4 times as much, with 256 by 0.8
 * times, and a round takes four times as long for twice as many.  With 16 of the cactus, instead of 32, its
 * volume grows by a tenth. */
enum { LEAST = 32, MOST = 128, EACH = 24, BATCH = 8, ROUNDS = 10 };

/* What a vertex has of the sources of a cluster, by the columns of its map. */
typedef struct share {
	uint32_t vertex, cluster;
	mr_v3 turned, pressed;
} share;

/* While it is made. */
typedef struct making {
	mr_deform *d;
	mr_clusters *c;
	share *shares;
	size_t share_count, room;
} making;

/* ---- clusters ---- */

typedef struct flood {
	double *far; /* from the nearest seed */
	uint32_t *queue;
	bool *queued;
} flood;

static uint32_t
region_of(const mr_deform *d, size_t i)
{
	return d->region[d->patch.vertex[i]];
}

/* The vertices that are nearer to this seed than to those before, over edges within its region. */
static void
spread(const mr_deform *d, mr_clusters *c, uint32_t seed, flood *w)
{
	const mr_mesh *m = &d->patch.mesh;
	const mr_incidence *around = &d->rotations->around;
	size_t head = 0, waiting = 1;

	w->far[seed] = 0;
	c->of[seed] = (uint32_t)c->count;
	w->queue[0] = seed;
	while (waiting) {
		uint32_t i = w->queue[head];
		/* NOLINTNEXTLINE(clang-analyzer-core.DivideZero) the seed is a vertex */
		head = (head + 1) % m->nv;
		waiting--;
		w->queued[i] = false;
		for (size_t e = 3 * around->start[i]; e < 3 * around->start[i + 1]; e++) {
			uint32_t j = m->t[around->face[e / 3]].v[e % 3];
			double far = w->far[i] + mr_dist(m->p[i], m->p[j]);
			if (region_of(d, j) != region_of(d, seed) || !(far < w->far[j]))
				continue;
			w->far[j] = far;
			c->of[j] = (uint32_t)c->count;
			if (!w->queued[j])
				w->queue[(head + waiting++) % m->nv] = j;
			w->queued[j] = true;
		}
	}
}

/* Each seed is the vertex farthest from those before. */
static mr_status
sow(mr_ctx *ctx, const mr_deform *d, mr_clusters *c, bool *reached)
{
	size_t n = d->patch.mesh.nv, most = d->patch.end[0] / EACH;
	flood w = { MR_NEW(ctx, n, double), MR_NEW(ctx, n, uint32_t), MR_NEW_ZERO(ctx, n, bool) };

	most = most < LEAST ? LEAST : most > MOST ? MOST : most;
	c->of = MR_NEW_ZERO(ctx, n, uint32_t);
	c->region = MR_NEW(ctx, most, uint32_t);
	if (!w.far || !w.queue || !w.queued || !c->of || !c->region)
		return MR_EMEM;
	for (size_t i = 0; i < n; i++)
		w.far[i] = INFINITY;
	for (; c->count < most; c->count++) {
		uint32_t seed = 0;
		for (uint32_t i = 1; i < n; i++)
			if (w.far[i] > w.far[seed])
				seed = i;
		if (w.far[seed] == 0)
			break;
		c->region[c->count] = region_of(d, seed);
		spread(d, c, seed, &w);
	}
	for (size_t i = 0; i < n; i++)
		*reached &= w.far[i] < INFINITY;
	return MR_OK;
}

static mr_status
weigh(mr_ctx *ctx, const mr_deform *d, mr_clusters *c)
{
	const mr_rotations *r = d->rotations;

	c->size = MR_NEW_ZERO(ctx, c->count, uint32_t);
	c->weight = MR_NEW_ZERO(ctx, c->count * r->count, double);
	if (!c->size || !c->weight)
		return MR_EMEM;
	for (size_t i = 0; i < d->patch.mesh.nv; i++)
		c->size[c->of[i]]++;
	for (size_t i = 0; i < d->patch.mesh.nv; i++)
		for (size_t j = 0; j < r->count; j++)
			c->weight[r->count * c->of[i] + j] += r->weight[r->count * i + j] / c->size[c->of[i]];
	return MR_OK;
}

/* ---- sources ---- */

/* What corner k of a face has of the divergence of the rest, and of the volume's derivative. */
static share
share_of(const mr_deform *d, size_t f, int k)
{
	const mr_mesh *m = &d->patch.mesh;
	const double *cot = d->rotations->cot[f];
	int next = (k + 1) % 3, last = (k + 2) % 3;
	mr_v3 p = m->p[m->t[f].v[k]], a = mr_sub(p, m->p[m->t[f].v[next]]),
	      b = mr_sub(p, m->p[m->t[f].v[last]]);

	return (share){ .turned = mr_add(mr_mul(cot[last] / 2, a), mr_mul(cot[next] / 2, b)),
		.pressed = mr_mul(1.0 / 6, mr_cross(a, b)) };
}

/* Adds a third of a face's to each of its corners' clusters, of the shares from `first` on. */
static mr_status
add_shares(mr_ctx *ctx, making *w, uint32_t vertex, size_t f, size_t first)
{
	const uint32_t *v = w->d->patch.mesh.t[f].v;
	share s = share_of(w->d, f, v[0] == vertex ? 0 : v[1] == vertex ? 1 : 2);

	for (int k = 0; k < 3; k++) {
		uint32_t cluster = w->c->of[v[k]];
		size_t at = first;
		while (at < w->share_count && w->shares[at].cluster != cluster)
			at++;
		if (at == w->share_count) {
			MR_TRY(MR_RESERVE(ctx, w->shares, at, 1, &w->room));
			w->shares[w->share_count++] = (share){ .vertex = vertex, .cluster = cluster };
		}
		w->shares[at].turned = mr_axpy(1.0 / 3, s.turned, w->shares[at].turned);
		w->shares[at].pressed = mr_axpy(1.0 / 3, s.pressed, w->shares[at].pressed);
	}
	return MR_OK;
}

static mr_status
share_out(mr_ctx *ctx, making *w)
{
	const mr_incidence *around = &w->d->rotations->around;

	for (uint32_t i = 0; i < w->d->patch.mesh.nv; i++) {
		size_t first = w->share_count;
		for (size_t e = around->start[i]; e < around->start[i + 1]; e++)
			MR_TRY(add_shares(ctx, w, i, around->face[e], first));
	}
	return MR_OK;
}

/* ---- responses ---- */

/* The outs of a field over the first n vertices, whose values are `step` apart; it is 0 on the others. */
static void
project(const making *w, const double *u, size_t step, size_t n, double *out)
{
	const mr_clusters *c = w->c;

	for (size_t s = 0; s < w->share_count; s++) {
		const share *a = &w->shares[s];
		double *to = out + 3 * a->cluster, at = a->vertex < n ? u[step * a->vertex] : 0;
		to[0] += a->turned.x * at;
		to[1] += a->turned.y * at;
		to[2] += a->turned.z * at;
	}
	for (size_t i = 0; i < n; i++)
		out[3 * c->count + c->of[i]] += u[step * i] / c->size[c->of[i]];
}

/* Those to the maps of some clusters, from `first` on. */
static mr_status
respond(mr_ctx *ctx, const making *w, size_t first, double *b)
{
	mr_clusters *c = w->c;
	size_t n = w->d->patch.end[0], count = c->count - first < BATCH ? c->count - first : BATCH;

	memset(b, 0, 6 * count * n * sizeof *b);
	for (size_t s = 0; s < w->share_count; s++) {
		const share *a = &w->shares[s];
		if (a->cluster < first || a->cluster >= first + count || a->vertex >= n)
			continue;
		for (size_t k = 0; k < 3; k++) {
			double *to = b + n * (6 * (a->cluster - first) + 2 * k) + a->vertex;
			to[0] = mr_coordinate(a->turned, (int)k);
			to[n] = mr_coordinate(a->pressed, (int)k);
		}
	}
	MR_TRY(mr_solver_solve(ctx, w->d->rotations->membrane->solver, b, 6 * count));
	for (size_t row = 0; row < 3 * count; row++) {
		project(w, b + 2 * row * n, 1, n, c->turned + c->outs * (3 * first + row));
		project(w, b + (2 * row + 1) * n, 1, n, c->pressed + c->outs * (3 * first + row));
	}
	return MR_OK;
}

static size_t
row_of(const mr_deform *d, uint32_t region)
{
	return region == MR_REGION_FIXED ? d->handles : region - MR_REGION_HANDLE;
}

static mr_status
respond_to_constraint(mr_ctx *ctx, const making *w, size_t h)
{
	const mr_patch *patch = &w->d->patch;
	mr_deform *membrane = w->d->rotations->membrane;
	mr_patch_field f = mr_deform_field(membrane, 4);

	for (size_t i = patch->end[0]; i < patch->mesh.nv; i++) {
		mr_v3 p = patch->mesh.p[i];
		if (row_of(w->d, region_of(w->d, i)) == h)
			memcpy(f.u + 4 * i, (double[]){ p.x, p.y, p.z, 1 }, 4 * sizeof *f.u);
	}
	MR_TRY(mr_deform_solve_field(ctx, membrane, &f));
	for (size_t k = 0; k < 4; k++)
		project(w, f.u + k, 4, patch->mesh.nv, w->c->held + w->c->outs * (4 * h + k));
	return MR_OK;
}

static mr_status
respond_to_all(mr_ctx *ctx, making *w)
{
	double *b = MR_NEW(ctx, 6 * BATCH * w->d->patch.end[0], double);

	if (!b)
		return MR_EMEM;
	for (size_t first = 0; first < w->c->count; first += BATCH)
		MR_TRY(respond(ctx, w, first, b));
	for (size_t h = 0; h <= w->d->handles; h++)
		MR_TRY(respond_to_constraint(ctx, w, h));
	return MR_OK;
}

/* Faces with a corner in each of three clusters, and the rim: a map of complexes takes what is closed to what
 * is. */
static mr_status
coarsen(mr_ctx *ctx, const mr_deform *d, mr_clusters *c)
{
	const mr_volume *fine = &d->rotations->volume;
	mr_tri *t = MR_NEW(ctx, fine->nf, mr_tri);
	mr_rim *rim = MR_NEW(ctx, fine->rims, mr_rim);

	c->volume = *fine;
	c->volume.t = t;
	c->volume.rim = rim;
	c->volume.nf = 0;
	if (!t || !rim)
		return MR_EMEM;
	for (size_t f = 0; f < fine->nf; f++) {
		const uint32_t *v = fine->t[f].v;
		uint32_t x = c->of[v[0]], y = c->of[v[1]], z = c->of[v[2]];
		if (x != y && y != z && z != x)
			t[c->volume.nf++] = (mr_tri){ { x, y, z } };
	}
	for (size_t e = 0; e < fine->rims; e++) {
		rim[e] = fine->rim[e];
		rim[e].from = c->of[rim[e].from];
		rim[e].to = c->of[rim[e].to];
	}
	return MR_OK;
}

static mr_status
make_room(mr_ctx *ctx, const mr_deform *d, mr_clusters *c)
{
	size_t n = c->count;

	c->outs = 4 * n;
	c->turned = MR_NEW_ZERO(ctx, 3 * n * c->outs, double);
	c->pressed = MR_NEW_ZERO(ctx, 3 * n * c->outs, double);
	c->held = MR_NEW_ZERO(ctx, 4 * (d->handles + 1) * c->outs, double);
	c->base = MR_NEW(ctx, 3 * c->outs, double);
	c->by_map = MR_NEW(ctx, 3 * c->outs, double);
	c->by_pressure = MR_NEW(ctx, 3 * c->outs, double);
	c->last = MR_NEW(ctx, 3 * c->outs, double);
	c->place = MR_NEW(ctx, n, mr_v3);
	c->map = MR_NEW(ctx, n, mr_mat3);
	return c->turned && c->pressed && c->held && c->base && c->by_map && c->by_pressure && c->last &&
	               c->place && c->map
	           ? MR_OK
	           : MR_EMEM;
}

mr_status
mr_clusters_make(mr_ctx *ctx, mr_deform *d)
{
	mr_clusters *c = MR_NEW_ZERO(ctx, 1, mr_clusters);
	making w = { .d = d, .c = c };
	bool reached = true;
	mr_mark mark;

	if (!c)
		return MR_EMEM;
	MR_TRY(sow(ctx, d, c, &reached));
	if (!reached) {
		mr_note(ctx,
		    "%s: rotations are interpolated: the surface has more parts than the %d that are fitted",
		    d->patch.mesh.name, MOST);
		return MR_OK;
	}
	MR_TRY(weigh(ctx, d, c));
	MR_TRY(coarsen(ctx, d, c));
	MR_TRY(make_room(ctx, d, c));
	mark = mr_mark_take(ctx);
	MR_TRY(share_out(ctx, &w));
	MR_TRY(respond_to_all(ctx, &w));
	mr_mark_release(ctx, mark);
	d->rotations->clusters = c;
	return MR_OK;
}

/* ---- rounds ---- */

/* Adds the product of a matrix, 3 by `count`, its rows `stride` apart, with as many rows. */
static void
multiply(
    size_t n, const double *m, size_t stride, size_t count, const double *restrict rows, double *restrict out)
{
	for (size_t k = 0; k < 3 * count; k++) {
		const double x = m[stride * (k % 3) + k / 3], *row = rows + n * (k / 3);
		double *to = out + n * (k % 3);
		for (size_t i = 0; i < n; i++)
			to[i] += x * row[i];
	}
}

static void
add_maps(const mr_clusters *c, const double *rows, double *out)
{
	for (size_t l = 0; l < c->count; l++)
		multiply(c->outs, c->map[l].m, 3, 3, rows + 3 * c->outs * l, out);
}

static void
add_constraints(const mr_deform *d, const mr_clusters *c, const mr_deform_maps *maps, double *out)
{
	for (size_t h = 0; h <= d->handles; h++) {
		mr_affine t = h < d->handles ? mr_deform_map(maps, (uint32_t)(MR_REGION_HANDLE + h))
		                             : mr_identity();
		multiply(c->outs, t.m, 4, 4, c->held + 4 * c->outs * h, out);
	}
}

static double
volume_at(const mr_ctx *ctx, const mr_clusters *c, double pressure)
{
	size_t n = c->outs;

	for (size_t l = 0; l < c->count; l++) {
		const double *a = c->by_map + 3 * c->count + l, *b = c->by_pressure + 3 * c->count + l;
		c->place[l] = mr_vec(
		    a[0] + pressure * b[0], a[n] + pressure * b[n], a[2 * n] + pressure * b[2 * n]);
	}
	return mr_volume_of(ctx, &c->volume, c->place);
}

/* The pressure by which the volume, of the sign of `least`, is at least that: by secants from the one before.
 */
static double
find_pressure(const mr_ctx *ctx, const mr_clusters *c, double least, double before)
{
	enum { STEPS = 6 };
	static const double enough = 1e-3;
	double at = 0, next = before, missing = least - volume_at(ctx, c, 0);

	if (!(missing / least > 0))
		return 0;
	add_maps(c, c->pressed, c->by_pressure);
	for (int i = 0; i < STEPS && fabs(missing) > enough * fabs(least); i++) {
		double now = least - volume_at(ctx, c, next), step = now * (next - at) / (missing - now);
		at = next;
		missing = now;
		if (!isfinite(step))
			break;
		next += step;
	}
	return at;
}

/* The rotations that take the clusters best to where they are, and go on as they went. */
static void
turn(const mr_clusters *c, double pressure, bool first, const mr_mat3 *stretch, mr_mat3 *rotation)
{
	static const double further = 0.7;

	for (size_t i = 0; i < 3 * c->outs; i++) {
		double now = c->by_map[i] + pressure * c->by_pressure[i];
		c->by_map[i] = first ? now : now + further * (now - c->last[i]);
		c->last[i] = now;
	}
	for (size_t l = 0; l < c->count; l++) {
		mr_mat3 a, s;
		if (c->region[l] != MR_REGION_FREE)
			continue;
		for (size_t i = 0; i < 9; i++)
			a.m[i] = c->by_map[c->outs * (i / 3) + 3 * l + i % 3];
		s = mr_mat3_multiply(&a, &stretch[l]);
		rotation[l] = mr_rotation_nearest(&s);
	}
}

double
mr_clusters_fit(const mr_ctx *ctx, const mr_deform *d, const mr_deform_maps *maps, double keep,
    const mr_mat3 *stretch, mr_mat3 *rotation, bool *body)
{
	const mr_clusters *c = d->rotations->clusters;
	size_t size = 3 * c->outs * sizeof *c->base;
	const double pinched = 0.1; /* a hand that is twisted by half a turn starts at 0.32, a dent below 0 */
	double pressure = 0, rest = 0, least = 0, step = 0;

	memset(c->place, 0, c->count * sizeof *c->place);
	for (size_t i = 0; i < d->patch.mesh.nv; i++)
		c->place[c->of[i]] = mr_axpy(1.0 / c->size[c->of[i]], d->patch.mesh.p[i], c->place[c->of[i]]);
	if (c->volume.encloses)
		rest = mr_volume_of(ctx, &c->volume, c->place);
	memset(c->base, 0, size);
	add_constraints(d, c, maps, c->base);
	for (int round = 0; round < ROUNDS; round++) {
		for (size_t l = 0; l < c->count; l++)
			c->map[l] = mr_mat3_multiply(&rotation[l], &stretch[l]);
		memcpy(c->by_map, c->base, size);
		memset(c->by_pressure, 0, size);
		add_maps(c, c->turned, c->by_map);
		if (round == 0 && c->volume.encloses &&
		    mr_volume_is_kept(volume_at(ctx, c, 0), rest, pinched)) {
			least = keep * rest;
			step = 1e-3 / cbrt(fabs(least));
		}
		if (least != 0)
			pressure = find_pressure(ctx, c, least, pressure != 0 ? pressure : step);
		turn(c, pressure, round == 0, stretch, rotation);
	}
	*body = least != 0;
	return pressure;
}
