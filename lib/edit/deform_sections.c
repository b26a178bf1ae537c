/* Pieces of level sets, and the centroids of their faces. */
#include "edit/deform_energy.h"

#include "base/disjoint_sets.h"

#include <math.h>

/* Levels along a weight, less one.  The edges of bends by 120 degrees are off by up to 1 % more with 4 of
 * them, and by nothing that counts with 8 or 64. */
enum { LEVELS = 16 };

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
	const double (*cot)[3];
	uint32_t (*of)[2]; /* of each face, the sections at the levels below and above */
	size_t weights, j; /* the weight at hand */
	double *weight;    /* its, of each vertex */
	levels *level;     /* of each face */
	uint32_t *set;     /* of vertices, those that faces of a level join */
	uint32_t *made;    /* of a set's root, its section */
	section *section;
	size_t count, room;
} finder;

/* The level below a weight in levels, and not the last. */
static int
below(double level)
{
	return level < LEVELS ? (int)level : LEVELS - 1;
}

/* The mean weight of a face, in levels. */
static double
level_of(const finder *s, size_t f)
{
	const uint32_t *v = s->m->t[f].v;

	return LEVELS * (s->weight[v[0]] + s->weight[v[1]] + s->weight[v[2]]) / 3;
}

/* A face meets the levels beside its mean, and those through it; none where nothing changes. */
static void
find_levels(finder *s)
{
	for (size_t f = 0; f < s->m->nf; f++) {
		const uint32_t *v = s->m->t[f].v;
		double a = s->weight[v[0]], b = s->weight[v[1]], c = s->weight[v[2]];
		double low = fmin(a, fmin(b, c)), high = fmax(a, fmax(b, c));
		int k = below(level_of(s, f));
		s->level[f].first = (uint8_t)(low < high ? fmin(k, ceil(LEVELS * low)) : 1);
		s->level[f].last = (uint8_t)(low < high ? fmax(k + 1, floor(LEVELS * high)) : 0);
	}
}

static bool
meets(const finder *s, size_t f, int k)
{
	return s->level[f].first <= k && k <= s->level[f].last;
}

/* Parts the faces of a level into those that hang together. */
static void
join_faces(finder *s, int k)
{
	for (size_t f = 0; f < s->m->nf; f++)
		for (int c = 0; meets(s, f, k) && c < 3; c++) {
			uint32_t v = s->m->t[f].v[c];
			s->set[v] = v;
			s->made[v] = MR_NONE;
		}
	for (size_t f = 0; f < s->m->nf; f++)
		if (meets(s, f, k)) {
			const uint32_t *v = s->m->t[f].v;
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
		energy += s->cot[f][i] * difference * difference;
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
static void
sum_faces(mr_ctx *ctx, finder *s, int k)
{
	for (size_t f = 0; f < s->m->nf; f++) {
		const uint32_t *v = s->m->t[f].v;
		double at = level_of(s, f), share;
		int low = below(at), i = k - low;
		uint32_t *made;
		if (!meets(s, f, k) || i < 0 || i > 1)
			continue;
		made = &s->made[mr_sets_root(s->set, v[0])];
		if (*made == MR_NONE) {
			MR_RESERVE(ctx, s->section, s->count, 1, &s->room);
			s->section[s->count] = (section){ .faces = 0 };
			*made = (uint32_t)s->count++;
		}
		share = i ? at - low : 1 - (at - low);
		add_face(&s->section[*made], s->m, v, share * energy_of(s, f));
		s->of[f][i] = *made;
	}
}

static mr_v3
center_of(const section *s)
{
	return s->energy > 0 ? mr_mul(1 / s->energy, s->weighted) : mr_mul(1 / (double)s->faces, s->plain);
}

/* Between the sections of the levels below and above the face's mean. */
static void
place_sections(const finder *s, mr_section *out)
{
	for (size_t f = 0; f < s->m->nf; f++) {
		const uint32_t *v = s->m->t[f].v, *of = s->of[f];
		double a = s->weight[v[0]], b = s->weight[v[1]], c = s->weight[v[2]], at = level_of(s, f);
		double spread = fmax(a, fmax(b, c)) - fmin(a, fmin(b, c));
		mr_section *own = &out[s->weights * f + s->j];
		own->spread2 = spread * spread;
		if (spread > 0)
			own->center = mr_lerp(
			    at - below(at), center_of(&s->section[of[0]]), center_of(&s->section[of[1]]));
	}
}

mr_section *
mr_sections_find(mr_ctx *ctx, const mr_mesh *m, const double *weight, size_t count, const double (*cot)[3])
{
	mr_section *out = MR_NEW_ZERO(ctx, m->nf * count, mr_section);
	MR_SCOPE(ctx);
	finder s = { .m = m, .cot = cot, .weights = count };

	s.of = mr_alloc(ctx, m->nf, sizeof *s.of);
	s.weight = MR_NEW(ctx, m->nv, double);
	s.level = MR_NEW(ctx, m->nf, levels);
	s.set = MR_NEW(ctx, m->nv, uint32_t);
	s.made = MR_NEW(ctx, m->nv, uint32_t);
	for (s.j = 0; s.j < count; s.j++) {
		for (size_t v = 0; v < m->nv; v++)
			s.weight[v] = weight[count * v + s.j];
		s.count = 0;
		find_levels(&s);
		for (int k = 0; k <= LEVELS; k++) {
			join_faces(&s, k);
			sum_faces(ctx, &s, k);
		}
		place_sections(&s, out);
	}
	return out;
}
