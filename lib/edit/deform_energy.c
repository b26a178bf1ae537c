/* Energies as deform_energy.h has them; spokes and rims of Chao, Pinkall, Sanan, Schroeder 2010. */
#include "edit/deform_energy.h"

#include "base/parallel.h"
#include "base/rotation.h"
#include "base/vectors.h"
#include "op/laplace.h"

enum { GRAIN = 4096, GATHERED = 32768 }; /* what takes no longer than to wake a thread */

/* A matrix by its columns. */
typedef struct columns {
	mr_wide c[3];
} columns;

/* Indices count the patch's vertices and faces. */
struct mr_energies {
	mr_deform_system *s, membrane; /* of order 1, for rounds; no solver where s does */
	const uint32_t *region;        /* of the mesh */
	uint32_t lowest;
	size_t count;        /* handles with weights: all but what moves the whole */
	uint32_t *handle;    /* their regions */
	double *weight;      /* count for each vertex */
	double (*cot)[3];    /* of each face */
	mr_incidence around; /* corners of each vertex: 3 f + k */
	mr_section *section; /* count for each face */
	mr_mesh inside;      /* for rounds */
	/* Workspace, kept from pose to pose. */
	mr_v3 *rest, *q, *before; /* a vertex each */
	columns *map;             /* of each vertex, less the whole's */
	mr_wide *corner;          /* 3 for each face */
	double *source;           /* 3 for each vertex */
};

/* A pose. */
typedef struct turning {
	const mr_energies *e;
	const mr_deform_maps *maps;
	mr_mat3 whole;             /* of what moves the whole: R S */
	mr_mat3 rotation, stretch; /* R, S */
	mr_v3 *log;                /* of each handle's rotation relative to that */
	mr_mat3 *by;               /* its stretch less that */
	double *moves;             /* how much it does of both, squared */
	bool turns;                /* or stretches */
	bool stretches;            /* beyond rounding */
	bool whole_stays;
	const struct energy *energy;
} turning;

/* An energy: the local step gives each vertex a map, and the corners of a face shall be where these have
 * them, less the whole's.  place: of faces, each corner's share of the divergence. */
typedef struct energy {
	mr_mat3 (*local)(const turning *t, size_t i);
	mr_body place;
} energy;

/* Handles' maps */

static mr_v3
turn_of(const mr_deform_maps *maps, uint32_t region)
{
	size_t h = region - MR_REGION_HANDLE;

	return maps->turn && region >= MR_REGION_HANDLE && h < maps->count ? maps->turn[h] : mr_vec(0, 0, 0);
}

static mr_mat3
linear_of(const turning *t, uint32_t region)
{
	mr_affine map = mr_deform_map(t->maps, region);

	return mr_affine_linear(&map);
}

/* The motion of handle j relative to the whole, which has turned by w. */
static void
decompose_handle(turning *t, size_t j, mr_v3 w)
{
	static const double none = 1e-14;
	bool stretches = false;
	uint32_t region = t->e->handle[j];
	mr_mat3 a = linear_of(t, region), r = mr_rotation_nearest(&a), relative = mr_mat3_identity(), stretch;
	mr_v3 turn = mr_rotation_log(&a, turn_of(t->maps, region));

	if (memcmp(&a, &t->whole, sizeof a))
		relative = mr_mat3_multiply_transposed(&t->rotation, &r);
	t->log[j] = mr_rotation_log(&relative, mr_sub(turn, w));
	stretch = mr_mat3_multiply_transposed(&r, &a);
	t->by[j] = mr_mat3_axpy(-1, &t->stretch, &stretch);
	for (int i = 0; i < 9; i++)
		stretches |= fabs(t->by[j].m[i]) > none;
	if (!stretches) /* so that it makes no difference whether another handle does */
		t->by[j] = (mr_mat3){ { 0 } };
	t->stretches |= stretches;
	t->moves[j] = mr_norm2(t->log[j]);
	for (int i = 0; i < 9; i++)
		t->moves[j] += t->by[j].m[i] * t->by[j].m[i];
	t->turns |= memcmp(&a, &t->whole, sizeof a) || mr_norm(t->log[j]) > 0;
}

/* Polar decompositions of the maps. */
static void
decompose(mr_ctx *ctx, turning *t)
{
	const mr_mat3 none = mr_mat3_identity();
	size_t n = t->e->count;
	mr_v3 w;

	t->log = MR_NEW(ctx, n, mr_v3);
	t->by = MR_NEW(ctx, n, mr_mat3);
	t->moves = MR_NEW(ctx, n, double);
	t->whole = linear_of(t, t->e->lowest);
	t->rotation = mr_rotation_nearest(&t->whole);
	t->stretch = mr_mat3_multiply_transposed(&t->rotation, &t->whole);
	t->whole_stays = !memcmp(&t->whole, &none, sizeof none);
	w = mr_rotation_log(&t->whole, turn_of(t->maps, t->e->lowest));
	for (size_t j = 0; j < n; j++)
		decompose_handle(t, j, w);
}

/* Energies */

static mr_mat3
stretch_at(const turning *t, size_t i)
{
	mr_mat3 s = t->stretch;

	for (size_t j = 0; t->stretches && j < t->e->count; j++)
		s = mr_mat3_axpy(t->e->weight[t->e->count * i + j], &t->by[j], &s);
	return s;
}

/* The interpolated map. */
static mr_mat3
interpolate(const turning *t, size_t i)
{
	mr_mat3 r, s = stretch_at(t, i);
	mr_v3 w = mr_vec(0, 0, 0);

	for (size_t j = 0; j < t->e->count; j++)
		w = mr_axpy(t->e->weight[t->e->count * i + j], t->log[j], w);
	r = mr_rotation_exp(w);
	if (t->whole_stays && !t->stretches)
		return r;
	r = mr_mat3_multiply(&t->rotation, &r);
	return mr_mat3_multiply(&r, &s);
}

/* a x */
static MR_INLINED void
apply(const columns *a, mr_v3 x, mr_wide *to)
{
	*to = a->c[0] * x.x + a->c[1] * x.y + a->c[2] * x.z;
}

/* Each corner's share of the divergence of the face's gradient. */
static MR_INLINED void
put_sources(const turning *t, size_t f, const mr_wide p[3])
{
	const double *cot = t->e->cot[f];
	mr_wide a = cot[0] / 2 * (p[1] - p[2]), b = cot[1] / 2 * (p[2] - p[0]),
		c = cot[2] / 2 * (p[0] - p[1]);
	mr_wide *corner = t->e->corner + 3 * f;

	corner[0] = c - b;
	corner[1] = a - c;
	corner[2] = b - a;
}

/* The place about which a face turns: the sections of several handles count by how much they turn there. */
static MR_INLINED mr_v3
center_of(const turning *t, size_t f)
{
	const mr_section *s = t->e->section + t->e->count * f;
	mr_v3 sum = mr_vec(0, 0, 0);
	double all = 0;

	for (size_t j = 0; j < t->e->count; j++) {
		double share = s[j].spread2 * t->moves[j];
		sum = mr_axpy(share, s[j].center, sum);
		all += share;
	}
	return all > 0 ? mr_mul(1 / all, sum) : t->e->rest[t->e->s->patch.mesh.t[f].v[0]];
}

MR_VECTORS static void
place_about_sections(void *arg, size_t begin, size_t end)
{
	const turning *t = arg;

	for (size_t f = begin; f < end; f++) {
		const uint32_t *v = t->e->s->patch.mesh.t[f].v;
		mr_v3 center = center_of(t, f);
		mr_wide p[3];
		for (int k = 0; k < 3; k++)
			apply(&t->e->map[v[k]], mr_sub(t->e->rest[v[k]], center), &p[k]);
		put_sources(t, f, p);
	}
}

/* The local step of rounds: the rotation that fits the faces around a vertex best, times its stretch. */
static mr_mat3
fit(const turning *t, size_t i)
{
	const mr_energies *e = t->e;
	mr_mat3 sum = { { 0 } }, s = stretch_at(t, i), r;

	for (size_t n = e->around.start[i]; n < e->around.start[i + 1]; n++) {
		uint32_t f = e->around.face[n] / 3;
		const uint32_t *v = e->s->patch.mesh.t[f].v;
		for (int k = 0; k < 3; k++) {
			uint32_t a = v[k], b = v[(k + 1) % 3];
			double w = e->cot[f][(k + 2) % 3];
			mr_v3 x = mr_mat3_apply(&s, mr_sub(e->rest[a], e->rest[b]));
			mr_v3 y = mr_sub(e->q[a], e->q[b]);
			mr_mat3_add_product(&sum, w, y, x); /* symmetric at rest, to the bit */
		}
	}
	r = mr_rotation_nearest(&sum);
	return mr_mat3_multiply(&r, &s);
}

/* By the mean of the corners' maps. */
MR_VECTORS static void
place_about_faces(void *arg, size_t begin, size_t end)
{
	const turning *t = arg;

	for (size_t f = begin; f < end; f++) {
		const uint32_t *v = t->e->s->patch.mesh.t[f].v;
		const columns *a = &t->e->map[v[0]], *b = &t->e->map[v[1]], *c = &t->e->map[v[2]];
		columns mean;
		mr_wide p[3];
		for (int i = 0; i < 3; i++)
			mean.c[i] = (a->c[i] + b->c[i] + c->c[i]) / 3;
		for (int k = 0; k < 3; k++)
			apply(&mean, mr_sub(t->e->rest[v[k]], t->e->rest[v[0]]), &p[k]);
		put_sources(t, f, p);
	}
}

static const energy interpolated = { interpolate, place_about_sections }, rigid = { fit, place_about_faces };

/* Steps */

/* Constraints have their handles' rotations. */
static void
local_step(void *arg, size_t begin, size_t end)
{
	const turning *t = arg;
	const mr_patch *patch = &t->e->s->patch;

	for (size_t i = begin; i < end; i++) {
		mr_mat3 a = i < patch->end[0] ? t->energy->local(t, i)
		                              : linear_of(t, t->e->region[patch->vertex[i]]);
		a = mr_mat3_axpy(-1, &t->whole, &a);
		for (int k = 0; k < 3; k++)
			t->e->map[i].c[k] = (mr_wide){ a.m[k], a.m[3 + k], a.m[6 + k], 0 };
	}
}

MR_VECTORS static void
gather_sources(void *arg, size_t begin, size_t end)
{
	const turning *t = arg;
	const mr_incidence *around = &t->e->around;

	for (size_t i = begin; i < end; i++) {
		mr_wide sum = { 0, 0, 0, 0 };
		for (size_t n = around->start[i]; n < around->start[i + 1]; n++)
			sum += t->e->corner[around->face[n]];
		memcpy(t->e->source + 3 * i, &sum, 3 * sizeof(double));
	}
}

/* The system's source term. */
static const double *
source_of(mr_ctx *ctx, turning *t, const energy *of)
{
	const mr_deform_system *s = t->e->s;

	t->energy = of;
	mr_parallel(ctx, s->patch.mesh.nv, GRAIN, local_step, t);
	mr_parallel(ctx, s->patch.mesh.nf, GRAIN, of->place, t);
	mr_parallel(ctx, s->patch.end[s->opts.order - 1], GATHERED, gather_sources, t);
	return t->e->source;
}

/* The patch extrapolated by its last step: four rounds then replace seven. */
static void
extrapolate(const turning *t, const mr_v3 *p, bool first)
{
	static const double further = 0.7;
	const mr_energies *e = t->e;

	for (size_t i = 0; i < e->s->patch.mesh.nv; i++) {
		mr_v3 at = p[e->s->patch.vertex[i]];
		e->q[i] = first ? at : mr_axpy(further, mr_sub(at, e->before[i]), at);
		e->before[i] = at;
	}
}

static double
volume_of(mr_ctx *ctx, const mr_energies *e, const mr_v3 *p)
{
	mr_mesh inside = e->inside;

	inside.p = p;
	return mr_mesh_volume(ctx, &inside);
}

/* How much of its volume the patch has to have, by the mean stretch; 0 of a sheet or dent, which has lost
 * most before any round.  Rounds leave 42 to 97 % without this. */
static double
volume_to_keep(mr_ctx *ctx, const turning *t, const mr_v3 *p0, const mr_v3 *p)
{
	static const double kept = 0.9, body = 0.4; /* limbs that are bent and twisted have 0.79 to 1.02 */
	const mr_energies *e = t->e;
	size_t n = e->s->patch.end[0];
	double rest, sum = 0;

	if (!e->inside.t)
		return 0;
	rest = volume_of(ctx, e, p0);
	if (!(volume_of(ctx, e, p) / rest >= body))
		return 0;
	for (size_t i = 0; i < n; i++) {
		mr_mat3 s = stretch_at(t, i);
		sum += mr_mat3_determinant(&s);
	}
	return kept * sum / (double)n * rest;
}

/* The last of the global steps is of the system's own order, so that the surface is as smooth as it asks. */
static mr_status
rounds(
    mr_ctx *ctx, mr_energies *e, turning *t, size_t count, const mr_affine *whole, const mr_v3 *p0, mr_v3 *p)
{
	double least = count ? volume_to_keep(ctx, t, p0, p) : 0;

	for (size_t round = 0; round < count; round++) {
		mr_deform_system *s = round + 1 < count && e->membrane.solver ? &e->membrane : e->s;
		extrapolate(t, p, round == 0);
		MR_TRY(mr_system_follow(ctx, s, whole, p0, source_of(ctx, t, &rigid), p));
		if (least != 0 && volume_of(ctx, e, p) / least < 1)
			MR_TRY(mr_inside_keep(ctx, s, &e->inside, least, p));
	}
	return MR_OK;
}

mr_status
mr_energies_follow(mr_ctx *ctx, mr_energies *e, const mr_affine *whole, const mr_v3 *p0,
    const mr_deform_maps *maps, mr_v3 *p)
{
	turning t = { .e = e, .maps = maps };
	bool turns;

	for (size_t i = 0; i < e->s->patch.mesh.nv; i++)
		e->rest[i] = p0[e->s->patch.vertex[i]];
	decompose(ctx, &t);
	turns = t.turns && e->s->opts.rotations == MR_ROTATIONS_INTERPOLATED;
	MR_TRY(mr_system_follow(ctx, e->s, whole, p0, turns ? source_of(ctx, &t, &interpolated) : NULL, p));
	return rounds(ctx, e, &t, e->s->opts.rounds, whole, p0, p);
}

/* Set-up */

/* The regions that have weights, in their order. */
static void
find_handles(mr_ctx *ctx, mr_energies *e)
{
	const mr_patch *patch = &e->s->patch;
	size_t regions = 0;
	bool *present;

	for (size_t i = patch->end[0]; i < patch->mesh.nv; i++)
		regions = e->region[patch->vertex[i]] < regions ? regions
		                                                : e->region[patch->vertex[i]] + (size_t)1;
	present = MR_NEW_ZERO(ctx, regions, bool);
	e->handle = MR_NEW(ctx, regions, uint32_t);
	for (size_t i = patch->end[0]; i < patch->mesh.nv; i++)
		present[e->region[patch->vertex[i]]] = true;
	for (uint32_t r = MR_REGION_HANDLE; r < regions; r++)
		if (present[r] && r != e->lowest)
			e->handle[e->count++] = r;
}

/* Clamps the weights and their rest to 0 and 1, and scales their sum to 1. */
static void
clamp_weights(double *w, size_t n)
{
	double rest = 1, sum = 0;

	for (size_t j = 0; j < n; j++) {
		rest -= w[j];
		w[j] = fmin(fmax(w[j], 0), 1);
		sum += w[j];
	}
	sum += fmin(fmax(rest, 0), 1);
	for (size_t j = 0; j < n && sum > 0; j++)
		w[j] /= sum;
}

/* Some at a time. */
static mr_status
solve_weights(mr_ctx *ctx, mr_energies *e)
{
	const mr_patch *patch = &e->s->patch;

	for (size_t j = 0; j < e->count; j += MR_FIELD_WIDTH) {
		size_t width = e->count - j < MR_FIELD_WIDTH ? e->count - j : MR_FIELD_WIDTH;
		mr_field f = mr_system_field(e->s, width);
		for (size_t i = patch->end[0]; i < patch->mesh.nv; i++)
			for (size_t c = 0; c < width; c++)
				f.u[width * i + c] = e->region[patch->vertex[i]] == e->handle[j + c];
		MR_TRY(mr_system_solve(ctx, e->s, &f));
		for (size_t i = 0; i < patch->mesh.nv; i++)
			memcpy(e->weight + e->count * i + j, f.u + width * i, width * sizeof *f.u);
	}
	for (size_t i = 0; i < patch->mesh.nv; i++)
		clamp_weights(e->weight + e->count * i, e->count);
	return MR_OK;
}

static void
make_room(mr_ctx *ctx, mr_energies *e)
{
	const mr_mesh *m = &e->s->patch.mesh;

	e->cot = mr_alloc(ctx, m->nf, sizeof *e->cot);
	e->weight = MR_NEW(ctx, m->nv * e->count, double);
	e->rest = MR_NEW(ctx, m->nv, mr_v3);
	e->q = MR_NEW(ctx, m->nv, mr_v3);
	e->before = MR_NEW(ctx, m->nv, mr_v3);
	e->map = MR_NEW(ctx, m->nv, columns);
	e->corner = MR_NEW(ctx, 3 * m->nf, mr_wide);
	e->source = MR_NEW(ctx, 3 * m->nv, double);
	for (size_t f = 0; f < m->nf; f++)
		mr_cotangents(m->p[m->t[f].v[0]], m->p[m->t[f].v[1]], m->p[m->t[f].v[2]], e->cot[f]);
	mr_incidence_build(ctx, m, &e->around);
	for (uint32_t i = 0; i < m->nv; i++)
		for (size_t n = e->around.start[i]; n < e->around.start[i + 1]; n++) {
			const uint32_t *v = m->t[e->around.face[n]].v;
			e->around.face[n] = 3 * e->around.face[n] + (v[0] == i ? 0 : v[1] == i ? 1 : 2);
		}
}

mr_status
mr_energies_make(
    mr_ctx *ctx, mr_deform_system *s, const uint32_t *region, uint32_t lowest, mr_energies **energies)
{
	size_t most = s->opts.rounds;
	mr_energies *e;

	*energies = NULL;
	if (!s->solver || (s->opts.rotations == MR_ROTATIONS_LINEAR && most == 0))
		return MR_OK;
	e = MR_NEW_ZERO(ctx, 1, mr_energies);
	e->s = s;
	e->region = region;
	e->lowest = lowest;
	find_handles(ctx, e);
	make_room(ctx, e);
	MR_TRY(solve_weights(ctx, e));
	e->section = mr_sections_find(ctx, &s->patch.mesh, e->weight, e->count, (const double(*)[3])e->cot);
	if (most > 0)
		e->inside = mr_inside_make(ctx, &s->patch, region);
	*energies = e;
	return most > 1 && s->opts.order > 1 ? mr_system_membrane(ctx, s, &e->membrane) : MR_OK;
}
