/* Rotations as deform_rotations.h has them; rounds: Sorkine, Alexa 2007: As-rigid-as-possible surface
 * modeling, with the spokes and rims of Chao, Pinkall, Sanan, Schroeder 2010. */
#include "edit/deform_clusters.h"

#include "base/parallel.h"

enum { GRAIN = 1024 };

/* A pose. */
typedef struct turning {
	const mr_deform *d;
	mr_rotations *r;
	const mr_deform_maps *maps; /* NULL: none, and nothing is known of rotations */
	mr_mat3 whole;              /* of what moves the whole: R S */
	mr_mat3 rotation, stretch;  /* R, S */
	mr_v3 *log;                 /* of each handle's rotation relative to that */
	mr_mat3 *by;                /* its stretch less that */
	bool turns;                 /* or stretches */
	bool stretches;             /* beyond rounding */
	double pressure;            /* on what the maps turn */
	bool keeps;                 /* of what is fitted: its volume */
	bool sections;              /* the source is of faces about their sections, else about themselves */
} turning;

/* Maps */

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

/* What handle j does beyond the whole, which has turned by w. */
static void
decompose_handle(turning *t, size_t j, mr_v3 w)
{
	static const double none = 1e-14;
	bool stretches = false;
	uint32_t region = t->r->region[j];
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
	t->turns |= memcmp(&a, &t->whole, sizeof a) || mr_norm(t->log[j]) > 0;
}

/* Polar decompositions of the maps. */
static mr_status
decompose(mr_ctx *ctx, turning *t)
{
	size_t n = t->r->count;
	mr_v3 w;

	t->whole = t->rotation = t->stretch = mr_mat3_identity();
	if (!t->maps)
		return MR_OK;
	t->log = MR_NEW(ctx, n, mr_v3);
	t->by = MR_NEW(ctx, n, mr_mat3);
	if (!t->log || !t->by)
		return MR_EMEM;
	t->whole = linear_of(t, t->d->lowest);
	t->rotation = mr_rotation_nearest(&t->whole);
	t->stretch = mr_mat3_multiply_transposed(&t->rotation, &t->whole);
	w = mr_rotation_log(&t->whole, turn_of(t->maps, t->d->lowest));
	for (size_t j = 0; j < n; j++)
		decompose_handle(t, j, w);
	return MR_OK;
}

/* The interpolated stretch by these weights. */
static mr_mat3
stretch_by(const turning *t, const double *weight)
{
	mr_mat3 s = t->stretch;

	for (size_t j = 0; t->stretches && j < t->r->count; j++)
		s = mr_mat3_axpy(weight[j], &t->by[j], &s);
	return s;
}

static mr_mat3
stretch_at(const turning *t, size_t i)
{
	return stretch_by(t, t->r->weight + t->r->count * i);
}

static mr_mat3
rotation_by(const turning *t, const double *weight)
{
	mr_v3 w = mr_vec(0, 0, 0);
	mr_mat3 r;

	for (size_t j = 0; j < t->r->count; j++)
		w = mr_axpy(weight[j], t->log[j], w);
	r = mr_rotation_exp(w);
	return mr_mat3_multiply(&t->rotation, &r);
}

static bool
constrained(const turning *t, size_t i)
{
	return i >= t->d->patch.end[0];
}

/* Interpolated maps of free vertices, and those of the others. */
static void
interpolate(void *arg, size_t begin, size_t end)
{
	turning *t = arg;

	for (size_t i = begin; i < end; i++) {
		mr_mat3 r, s;
		if (constrained(t, i)) {
			t->r->map[i] = linear_of(t, t->d->region[t->d->patch.vertex[i]]);
			continue;
		}
		r = rotation_by(t, t->r->weight + t->r->count * i);
		s = stretch_at(t, i);
		t->r->map[i] = mr_mat3_multiply(&r, &s);
	}
}

/* Sources */

/* The centroid of the section of handle j through a face, of which `weight` is the mean. */
static mr_v3
section_at(const mr_rotations *r, size_t f, size_t j, double weight)
{
	const uint32_t *section = r->section[r->count * f + j];
	double at = MR_SECTIONS * weight;

	return mr_lerp(at - mr_section_below(at), r->center[section[0]], r->center[section[1]]);
}

/* The place about which a face turns: the sections of several handles count by how much they turn there. */
static mr_v3
center_of(const turning *t, size_t f)
{
	const uint32_t *v = t->d->patch.mesh.t[f].v;
	mr_v3 sum = mr_vec(0, 0, 0);
	double all = 0;

	for (size_t j = 0; j < t->r->count; j++) {
		const double *w = t->r->weight + j;
		size_t n = t->r->count;
		double a = w[n * v[0]], b = w[n * v[1]], c = w[n * v[2]], moves = mr_norm2(t->log[j]), share;
		for (int i = 0; i < 9; i++)
			moves += t->by[j].m[i] * t->by[j].m[i];
		share = fmax(a, fmax(b, c)) - fmin(a, fmin(b, c));
		share *= share * moves;
		if (!(share > 0))
			continue;
		sum = mr_axpy(share, section_at(t->r, f, j, (a + b + c) / 3), sum);
		all += share;
	}
	return all > 0 ? mr_mul(1 / all, sum) : t->r->rest[v[0]];
}

/* Where the corners of a face go, about their section. */
static void
move_about_section(const turning *t, size_t f, mr_v3 p[3])
{
	const uint32_t *v = t->d->patch.mesh.t[f].v;
	mr_v3 center = center_of(t, f);

	for (int k = 0; k < 3; k++) {
		mr_mat3 a = mr_mat3_axpy(-1, &t->whole, &t->r->map[v[k]]);
		p[k] = mr_mat3_apply(&a, mr_sub(t->r->rest[v[k]], center));
	}
}

/* Where they go by the mean of their maps. */
static void
move_about_face(const turning *t, const uint32_t v[3], mr_v3 p[3])
{
	const mr_mat3 *a = &t->r->map[v[0]], *b = &t->r->map[v[1]], *c = &t->r->map[v[2]];
	mr_mat3 mean;

	for (int i = 0; i < 9; i++)
		mean.m[i] = (a->m[i] + b->m[i] + c->m[i]) / 3 - t->whole.m[i];
	for (int k = 0; k < 3; k++)
		p[k] = mr_mat3_apply(&mean, mr_sub(t->r->rest[v[k]], t->r->rest[v[0]]));
}

/* What the pressure on a face, turned, gives each of its corners. */
static void
add_pressure(const turning *t, const uint32_t v[3], mr_v3 out[3])
{
	const mr_v3 *p = t->r->rest;
	mr_v3 normal = mr_cross(mr_sub(p[v[1]], p[v[0]]), mr_sub(p[v[2]], p[v[0]]));
	mr_mat3 sum = mr_mat3_axpy(1, &t->r->map[v[0]], &t->r->map[v[1]]);

	sum = mr_mat3_axpy(1, &t->r->map[v[2]], &sum);
	for (int k = 0; k < 3; k++)
		out[k] = mr_axpy(t->pressure / 18, mr_mat3_apply(&sum, normal), out[k]);
}

/* What each corner of a face has of the divergence of the gradients, less that of the whole. */
static void
face_sources(void *arg, size_t begin, size_t end)
{
	turning *t = arg;

	for (size_t f = begin; f < end; f++) {
		const uint32_t *v = t->d->patch.mesh.t[f].v;
		mr_v3 *out = (mr_v3 *)t->r->face + 3 * f, p[3];
		if (t->sections)
			move_about_section(t, f, p);
		else
			move_about_face(t, v, p);
		for (int k = 0; k < 3; k++) {
			int next = (k + 1) % 3, last = (k + 2) % 3;
			out[k] = mr_add(mr_mul(t->r->cot[f][last] / 2, mr_sub(p[k], p[next])),
			    mr_mul(t->r->cot[f][next] / 2, mr_sub(p[k], p[last])));
		}
		if (t->pressure != 0)
			add_pressure(t, v, out);
	}
}

static void
gather_sources(void *arg, size_t begin, size_t end)
{
	turning *t = arg;
	const mr_incidence *around = &t->r->around;
	const mr_v3 *corner = (const mr_v3 *)t->r->face;

	for (size_t i = begin; i < end; i++) {
		mr_v3 sum = mr_vec(0, 0, 0);
		for (size_t e = around->start[i]; e < around->start[i + 1]; e++) {
			const uint32_t *v = t->d->patch.mesh.t[around->face[e]].v;
			int k = v[0] == i ? 0 : v[1] == i ? 1 : 2;
			sum = mr_add(sum, corner[3 * (size_t)around->face[e] + (size_t)k]);
		}
		memcpy(t->r->source + 3 * i, &sum, sizeof sum);
	}
}

static const double *
gather(mr_ctx *ctx, turning *t, mr_body faces)
{
	mr_parallel(ctx, t->d->patch.mesh.nf, GRAIN, faces, t);
	mr_parallel(ctx, t->d->patch.end[t->d->opts.order - 1], GRAIN, gather_sources, t);
	return t->r->source;
}

static const double *
source_of(mr_ctx *ctx, turning *t, bool sections)
{
	t->sections = sections;
	return gather(ctx, t, face_sources);
}

/* Rounds */

/* The covariance of a face's edges with those at rest, stretched. */
static void
face_covariances(void *arg, size_t begin, size_t end)
{
	turning *t = arg;

	for (size_t f = begin; f < end; f++) {
		const uint32_t *v = t->d->patch.mesh.t[f].v;
		mr_mat3 s = t->stretch, *out = (mr_mat3 *)t->r->face + f;
		for (int k = 0; t->stretches && k < 3; k++) {
			mr_mat3 at = stretch_at(t, v[k]);
			s = k ? mr_mat3_axpy(1, &at, &s) : at;
		}
		for (int i = 0; t->stretches && i < 9; i++)
			s.m[i] /= 3;
		*out = (mr_mat3){ { 0 } };
		for (int k = 0; k < 3; k++) {
			int next = (k + 1) % 3;
			double w = t->r->cot[f][(k + 2) % 3];
			mr_v3 x = mr_sub(t->r->rest[v[k]], t->r->rest[v[next]]);
			mr_v3 y = mr_sub(t->r->q[v[k]], t->r->q[v[next]]);
			mr_mat3 yx;
			x = mr_mat3_apply(&s, x);
			yx = (mr_mat3){ { y.x * x.x, y.x * x.y, y.x * x.z, y.y * x.x, y.y * x.y, y.y * x.z,
			    y.z * x.x, y.z * x.y, y.z * x.z } };
			*out = mr_mat3_axpy(w, &yx, out);
		}
	}
}

/* The local step: the rotation that takes the faces around a vertex best to where they are. */
static void
fit_rotations(void *arg, size_t begin, size_t end)
{
	turning *t = arg;
	const mr_incidence *around = &t->r->around;
	const mr_mat3 *face = (const mr_mat3 *)t->r->face;

	for (size_t i = begin; i < end; i++) {
		mr_mat3 sum = { { 0 } }, s = stretch_at(t, i);
		if (t->maps && constrained(t, i)) {
			t->r->map[i] = linear_of(t, t->d->region[t->d->patch.vertex[i]]);
			continue;
		}
		for (size_t e = around->start[i]; e < around->start[i + 1]; e++)
			sum = mr_mat3_axpy(1, face + around->face[e], &sum);
		sum = mr_rotation_nearest(&sum);
		t->r->map[i] = mr_mat3_multiply(&sum, &s);
	}
}

/* Where the patch is, and how much further it would go: four rounds then do what seven do without. */
static void
extrapolate(const turning *t, const mr_v3 *p, bool first)
{
	static const double further = 0.7;
	mr_rotations *r = t->r;

	for (size_t i = 0; i < t->d->patch.mesh.nv; i++) {
		mr_v3 at = p[t->d->patch.vertex[i]];
		r->q[i] = first ? at : mr_axpy(further, mr_sub(at, r->before[i]), at);
		r->before[i] = at;
	}
}

/* What each corner of a face has of the volume's derivative. */
static void
face_pressures(void *arg, size_t begin, size_t end)
{
	turning *t = arg;
	const mr_v3 *q = t->r->q;

	for (size_t f = begin; f < end; f++) {
		const uint32_t *v = t->d->patch.mesh.t[f].v;
		mr_v3 *out = (mr_v3 *)t->r->face + 3 * f;
		mr_v3 normal = mr_cross(mr_sub(q[v[1]], q[v[0]]), mr_sub(q[v[2]], q[v[0]]));
		for (int k = 0; k < 3; k++)
			out[k] = mr_mul(1.0 / 6, normal);
	}
}

/*
 * How much of its volume the patch has to have, by the mean of what the stretches ask for.  Four rounds leave
 * the models of the bench of motions 42 to 97 % of theirs without it, 92 to 97 with nine tenths of the patch,
 * all with all of it; the edges of the hand's bend are off by 0.092, 0.15 and 0.17 then.
 */
static double
share_to_keep(const turning *t)
{
	static const double kept = 0.9;
	size_t n = t->d->patch.end[0];
	double sum = 0;

	for (size_t i = 0; i < n; i++) {
		mr_mat3 s = stretch_at(t, i);
		sum += mr_mat3_determinant(&s);
	}
	return kept * sum / (double)n;
}

/* The volume at p, by what is kept in q. */
static double
volume_at(mr_ctx *ctx, const turning *t, const mr_v3 *p)
{
	for (size_t i = 0; i < t->d->patch.mesh.nv; i++)
		t->r->q[i] = p[t->d->patch.vertex[i]];
	return mr_volume_of(ctx, &t->r->volume, t->r->q);
}

/* Before any round.  Places that are given tell no stretches, and so no volume. */
static bool
is_body(mr_ctx *ctx, const turning *t, const mr_v3 *p)
{
	const double share = 0.4; /* limbs that interpolated rotations bend and twist have 0.79 to 1.02 */
	const mr_volume *v = &t->r->volume;

	return t->maps && v->encloses &&
	       mr_volume_is_kept(volume_at(ctx, t, p), mr_volume_of(ctx, v, t->r->rest), share);
}

/* After a round: what pinches and buckles gets its volume back. */
static mr_status
keep_volume(mr_ctx *ctx, mr_deform *system, turning *t, mr_v3 *p)
{
	mr_rotations *r = t->r;
	double rest = mr_volume_of(ctx, &r->volume, r->rest), least = share_to_keep(t) * rest;

	if (volume_at(ctx, t, p) / rest >= least / rest)
		return MR_OK;
	return mr_volume_keep(ctx, system, &r->volume, least, gather(ctx, t, face_pressures), r->q, p);
}

/* The maps of the vertices are those of their clusters, fitted from the interpolated ones on. */
static mr_status
fit_clusters(mr_ctx *ctx, turning *t)
{
	const mr_clusters *c = t->r->clusters;
	mr_mat3 *rotation = MR_NEW(ctx, c->count, mr_mat3), *stretch = MR_NEW(ctx, c->count, mr_mat3);

	if (!rotation || !stretch)
		return MR_EMEM;
	for (size_t l = 0; l < c->count; l++) {
		const double *weight = c->weight + t->r->count * l;
		bool free = c->region[l] == MR_REGION_FREE;
		rotation[l] = free ? rotation_by(t, weight) : linear_of(t, c->region[l]);
		stretch[l] = free ? stretch_by(t, weight) : mr_mat3_identity();
	}
	t->pressure = mr_clusters_fit(ctx, t->d, t->maps, share_to_keep(t), stretch, rotation, &t->keeps);
	for (size_t i = 0; i < t->d->patch.mesh.nv; i++) {
		uint32_t region = t->d->region[t->d->patch.vertex[i]];
		mr_mat3 s = stretch_at(t, i);
		t->r->map[i] = constrained(t, i) ? linear_of(t, region)
		                                 : mr_mat3_multiply(&rotation[c->of[i]], &s);
	}
	return MR_OK;
}

/* The last of the global steps is of the system's own order, so that the surface is as smooth as it asks. */
static mr_status
rounds(mr_ctx *ctx, mr_deform *d, turning *t, const mr_affine *whole, const mr_v3 *p0, mr_v3 *p)
{
	bool body = d->opts.rounds && is_body(ctx, t, p);

	for (size_t round = 0; round < d->opts.rounds; round++) {
		mr_deform *system = round + 1 < d->opts.rounds ? t->r->membrane : d;
		extrapolate(t, p, round == 0);
		mr_parallel(ctx, d->patch.mesh.nf, GRAIN, face_covariances, t);
		mr_parallel(ctx, d->patch.mesh.nv, GRAIN, fit_rotations, t);
		MR_TRY(mr_deform_follow(ctx, system, whole, p0, source_of(ctx, t, false), p));
		if (body)
			MR_TRY(keep_volume(ctx, system, t, p));
	}
	return MR_OK;
}

mr_status
mr_rotations_follow(
    mr_ctx *ctx, mr_deform *d, const mr_affine *whole, const mr_v3 *p0, const mr_deform_maps *maps, mr_v3 *p)
{
	turning t = { .d = d, .r = d->rotations, .maps = maps };
	const double *source = NULL;
	bool fitted;

	for (size_t i = 0; i < d->patch.mesh.nv; i++)
		t.r->rest[i] = p0[d->patch.vertex[i]];
	MR_TRY(decompose(ctx, &t));
	fitted = t.turns && t.r->clusters;
	if (fitted) {
		MR_TRY(fit_clusters(ctx, &t));
		source = source_of(ctx, &t, false);
		t.pressure = 0;
	} else if (t.turns && d->opts.turned) {
		mr_parallel(ctx, d->patch.mesh.nv, GRAIN, interpolate, &t);
		source = source_of(ctx, &t, true);
	}
	MR_TRY(mr_deform_follow(ctx, d, whole, p0, source, p));
	if (fitted && t.keeps)
		MR_TRY(keep_volume(ctx, d, &t, p));
	return rounds(ctx, d, &t, whole, p0, p);
}
