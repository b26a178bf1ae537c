/* Sections through what turns: the level sets of a handle's weight, of which each piece is one for itself, as
 * a handle may hold several limbs and limbs may branch. */
#include "base/disjoint_sets.h"
#include "edit/deform_rotations.h"

/* A section as it is summed up. */
typedef struct section {
	mr_v3 weighted, plain; /* centres of its faces, by energy and as they are */
	double energy;
	size_t faces;
} section;

/* The levels that a face meets; first > last: none. */
typedef struct levels {
	uint8_t first, last;
} levels;

typedef struct finder {
	const mr_mesh *m;
	mr_rotations *r;
	size_t j;       /* the handle at hand */
	double *weight; /* its, of each vertex */
	levels *level;  /* of each face */
	uint32_t *face; /* those of each level, one level behind another */
	size_t start[MR_SECTIONS + 2], faces_room;
	uint32_t *set;  /* of vertices, those that faces of a level join */
	uint32_t *made; /* of a set's root, its section */
	section *section;
	size_t count, room;
} finder;

/* The mean weight of a face, in levels. */
static double
level_of(const finder *s, size_t f)
{
	const uint32_t *v = s->m->t[f].v;

	return MR_SECTIONS * (s->weight[v[0]] + s->weight[v[1]] + s->weight[v[2]]) / 3;
}

/* A face meets the levels beside its mean, and those that run through it; none where nothing changes, as in a
 * handle. */
static void
find_levels(finder *s)
{
	for (size_t f = 0; f < s->m->nf; f++) {
		const uint32_t *v = s->m->t[f].v;
		double a = s->weight[v[0]], b = s->weight[v[1]], c = s->weight[v[2]];
		double low = fmin(a, fmin(b, c)), high = fmax(a, fmax(b, c));
		int k = mr_section_below(level_of(s, f));
		s->level[f].first = (uint8_t)(low < high ? fmin(k, ceil(MR_SECTIONS * low)) : 1);
		s->level[f].last = (uint8_t)(low < high ? fmax(k + 1, floor(MR_SECTIONS * high)) : 0);
	}
}

/* Sorts the faces by the levels that they meet. */
static mr_status
sort_faces(mr_ctx *ctx, finder *s)
{
	size_t next[MR_SECTIONS + 1];

	memset(s->start, 0, sizeof s->start);
	for (size_t f = 0; f < s->m->nf; f++)
		for (int k = s->level[f].first; k <= s->level[f].last; k++)
			s->start[k + 1]++;
	for (int k = 0; k <= MR_SECTIONS; k++) {
		next[k] = s->start[k];
		s->start[k + 1] += s->start[k];
	}
	MR_TRY(MR_RESERVE(ctx, s->face, 0, s->start[MR_SECTIONS + 1], &s->faces_room));
	for (size_t f = 0; f < s->m->nf; f++)
		for (int k = s->level[f].first; k <= s->level[f].last; k++)
			s->face[next[k]++] = (uint32_t)f;
	return MR_OK;
}

/* Parts the faces of a level into those that hang together. */
static void
join_faces(finder *s, int k)
{
	for (size_t i = s->start[k]; i < s->start[k + 1]; i++)
		for (int c = 0; c < 3; c++) {
			uint32_t v = s->m->t[s->face[i]].v[c];
			s->set[v] = v;
			s->made[v] = MR_NONE;
		}
	for (size_t i = s->start[k]; i < s->start[k + 1]; i++) {
		const uint32_t *v = s->m->t[s->face[i]].v;
		mr_sets_join(s->set, v[0], v[1]);
		mr_sets_join(s->set, v[0], v[2]);
	}
}

/* Area times the squared gradient of the weight: what does not turn has no say. */
static double
energy_of(const finder *s, size_t f)
{
	const uint32_t *v = s->m->t[f].v;
	double energy = 0;

	for (int i = 0; i < 3; i++) {
		double difference = s->weight[v[(i + 1) % 3]] - s->weight[v[(i + 2) % 3]];
		energy += s->r->cot[f][i] * difference * difference;
	}
	return fmax(energy, 0);
}

static void
add_face(section *own, const mr_mesh *m, const uint32_t v[3], double energy)
{
	mr_v3 center = mr_vec(0, 0, 0);

	for (int i = 0; i < 3; i++)
		center = mr_axpy(1.0 / 3, m->p[v[i]], center);
	own->weighted = mr_axpy(energy, center, own->weighted);
	own->plain = mr_add(own->plain, center);
	own->energy += energy;
	own->faces++;
}

/* Sums up the sections of a level, of the faces whose mean is beside it. */
static mr_status
sum_faces(mr_ctx *ctx, finder *s, int k)
{
	for (size_t n = s->start[k]; n < s->start[k + 1]; n++) {
		const size_t f = s->face[n];
		const uint32_t *v = s->m->t[f].v;
		double at = level_of(s, f), share;
		int below = mr_section_below(at), i = k - below;
		uint32_t *made;
		if (i < 0 || i > 1)
			continue;
		made = &s->made[mr_sets_root(s->set, v[0])];
		if (*made == MR_NONE) {
			MR_TRY(MR_RESERVE(ctx, s->section, s->count, 1, &s->room));
			s->section[s->count] = (section){ .faces = 0 };
			*made = (uint32_t)s->count++;
		}
		share = i ? at - below : 1 - (at - below);
		add_face(&s->section[*made], s->m, v, share * energy_of(s, f));
		s->r->section[s->r->count * f + s->j][i] = *made;
	}
	return MR_OK;
}

mr_status
mr_sections_find(mr_ctx *ctx, const mr_mesh *m, mr_rotations *r)
{
	finder s = { .m = m, .r = r };

	s.weight = MR_NEW(ctx, m->nv, double);
	s.level = MR_NEW(ctx, m->nf, levels);
	s.set = MR_NEW(ctx, m->nv, uint32_t);
	s.made = MR_NEW(ctx, m->nv, uint32_t);
	r->section = mr_alloc(ctx, m->nf * r->count, sizeof *r->section);
	if (!s.weight || !s.level || !s.set || !s.made || !r->section)
		return MR_EMEM;
	for (s.j = 0; s.j < r->count; s.j++) {
		for (size_t v = 0; v < m->nv; v++)
			s.weight[v] = r->weight[r->count * v + s.j];
		find_levels(&s);
		MR_TRY(sort_faces(ctx, &s));
		for (int k = 0; k <= MR_SECTIONS; k++) {
			join_faces(&s, k);
			MR_TRY(sum_faces(ctx, &s, k));
		}
	}
	r->center = MR_NEW(ctx, s.count, mr_v3);
	if (!r->center)
		return MR_EMEM;
	for (size_t i = 0; i < s.count; i++) {
		const section *own = &s.section[i];
		r->center[i] = own->energy > 0 ? mr_mul(1 / own->energy, own->weighted)
		                               : mr_mul(1 / (double)own->faces, own->plain);
	}
	return MR_OK;
}
