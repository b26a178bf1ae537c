/* Breunig, Kriegel, Ng, Sander 2000: LOF, identifying density-based local outliers. */
#include "space/outlier.h"

#include "base/parallel.h"
#include "base/sort.h"
#include "space/local_planes.h"

enum { AROUND = 8, K = AROUND + 1, ROUNDS = 3, SOME = 4096, CHUNK = 1 << 13, GRAIN = 64 };

/* In deviations; in the reach of neighbours, of these themselves and of all points; of the reach, that the
 * surface is away at least; of a plane. */
static const double LIMIT = 2.5, ALONE = 2, SPARSE = 3, AWAY = 1.0 / 3, UNEVEN = 0.06;

/* Suspects are examined a chunk at a time. */
typedef struct search {
	const mr_v3 *p;
	const double *off;
	double usual; /* median reach of the points: the distance to the last of AROUND neighbours */
	const uint32_t *suspect; /* of the chunk */
	const uint32_t *index;   /* K of each, itself the first */
	const double *dist2;
	const double *beside; /* the reach of each neighbour, squared: AROUND of each suspect */
	bool *outlier;
} search;

/* The median of at most SOME of n values, at equal strides. */
static double
median_of_some(const double *x, size_t n, double some[SOME])
{
	size_t m = n < SOME ? n : SOME;

	for (size_t i = 0; i < m; i++)
		some[i] = x[i * n / m];
	return mr_kth(some, m, m / 2);
}

/* The squared reach of each of m points: infinite where there are too few. */
static mr_status
reaches(mr_ctx *ctx, const mr_near *near, const mr_v3 *q, size_t m, double *reach2)
{
	mr_mark mark = mr_mark_take(ctx);
	uint32_t *index = MR_NEW(ctx, m * K, uint32_t);
	double *dist2 = MR_NEW(ctx, m * K, double);

	if (!index || !dist2)
		return MR_EMEM;
	MR_TRY(mr_near_query(ctx, near, q, m, K, index, dist2));
	for (size_t i = 0; i < m; i++)
		reach2[i] = dist2[i * K + AROUND];
	mr_mark_release(ctx, mark);
	return MR_OK;
}

static mr_status
usual_reach(mr_ctx *ctx, const mr_near *near, const mr_v3 *p, size_t n, double *usual)
{
	mr_mark mark = mr_mark_take(ctx);
	size_t m = n < SOME ? n : SOME;
	mr_v3 *q = MR_NEW(ctx, m, mr_v3);
	double *reach2 = MR_NEW(ctx, m, double), *some = MR_NEW(ctx, SOME, double);

	if (!q || !reach2 || !some)
		return MR_EMEM;
	for (size_t i = 0; i < m; i++)
		q[i] = p[i * n / m];
	MR_TRY(reaches(ctx, near, q, m, reach2));
	*usual = sqrt(median_of_some(reach2, m, some));
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* Of a point's neighbourhood: 0 in a plane. */
static double
variation(const mr_v3 *p, const uint32_t *index)
{
	mr_v3 q[K];
	double v;

	for (int i = 0; i < K; i++)
		q[i] = p[index[i]];
	mr_plane_fit(q, K, &v);
	return v;
}

static bool
is_outlier(const search *s, size_t i)
{
	double reach = sqrt(s->dist2[i * K + AROUND]), beside[AROUND];

	if (s->off[s->suspect[i]] < AWAY * reach)
		return false;
	memcpy(beside, s->beside + i * AROUND, sizeof beside);
	mr_sort_reals(beside, AROUND);
	if (reach > ALONE * sqrt(beside[AROUND / 2]))
		return true;
	return reach > SPARSE * s->usual && variation(s->p, s->index + i * K) > UNEVEN;
}

static void
examine(void *arg, size_t begin, size_t end)
{
	const search *s = arg;

	for (size_t i = begin; i < end; i++)
		s->outlier[s->suspect[i]] = is_outlier(s, i);
}

/* Sets apart the suspects most of whose neighbours are outliers: among these a plane may be chance. */
static mr_status
spread(mr_ctx *ctx, const mr_near *near, const search *s, const uint32_t *suspect, size_t m)
{
	mr_mark mark = mr_mark_take(ctx);
	uint32_t *index = MR_NEW(ctx, m * K, uint32_t);
	mr_v3 *q = MR_NEW(ctx, m, mr_v3);
	bool *lost = MR_NEW_ZERO(ctx, m, bool);

	if (!index || !q || !lost)
		return MR_EMEM;
	for (size_t i = 0; i < m; i++)
		q[i] = s->p[suspect[i]];
	MR_TRY(mr_near_query(ctx, near, q, m, K, index, NULL));
	for (int round = 0; round < ROUNDS; round++) {
		for (size_t i = 0; i < m; i++) {
			int among = 0;
			for (int j = 1; j < K; j++)
				among += s->outlier[index[i * K + (size_t)j]];
			lost[i] = 2 * among > AROUND;
		}
		for (size_t i = 0; i < m; i++)
			s->outlier[suspect[i]] |= lost[i];
	}
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* m <= CHUNK suspects. */
static mr_status
examine_chunk(mr_ctx *ctx, const mr_near *near, search s, size_t m)
{
	mr_mark mark = mr_mark_take(ctx);
	uint32_t *index = MR_NEW(ctx, m * K, uint32_t);
	double *dist2 = MR_NEW(ctx, m * K, double), *beside = MR_NEW(ctx, m * AROUND, double);
	mr_v3 *q = MR_NEW(ctx, m * AROUND, mr_v3);

	if (!index || !dist2 || !beside || !q)
		return MR_EMEM;
	for (size_t i = 0; i < m; i++)
		q[i] = s.p[s.suspect[i]];
	MR_TRY(mr_near_query(ctx, near, q, m, K, index, dist2));
	for (size_t i = 0; i < m * AROUND; i++)
		q[i] = s.p[index[i / AROUND * K + 1 + i % AROUND]];
	MR_TRY(reaches(ctx, near, q, m * AROUND, beside));
	s.index = index;
	s.dist2 = dist2;
	s.beside = beside;
	mr_parallel(ctx, m, GRAIN, examine, &s);
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* The points whose distance is beyond `most`, and large enough for outliers. */
static size_t
find_suspects(const double *off, size_t n, double most, uint32_t *suspect)
{
	size_t count = 0;

	for (size_t i = 0; i < n; i++)
		if (off[i] > most)
			suspect[count++] = (uint32_t)i;
	return count;
}

mr_status
mr_find_outliers(mr_ctx *ctx, const mr_near *near, const mr_v3 *p, size_t n, const double *off, double least,
    bool *outlier, size_t *count)
{
	mr_mark mark = mr_mark_take(ctx);
	uint32_t *suspect = MR_NEW(ctx, n, uint32_t);
	double *some = MR_NEW(ctx, SOME, double), most;
	search s = { .p = p, .off = off, .outlier = outlier };
	size_t suspects;

	memset(outlier, 0, n * sizeof *outlier);
	*count = 0;
	if (mr_near_distinct(near) < K)
		return MR_OK;
	if (!suspect || !some)
		return MR_EMEM;
	most = fmax(LIMIT * 1.4826 * median_of_some(off, n, some), least);
	MR_TRY(usual_reach(ctx, near, p, n, &s.usual));
	suspects = find_suspects(off, n, fmax(most, AWAY * s.usual), suspect);
	for (size_t i = 0; i < suspects; i += CHUNK) {
		s.suspect = suspect + i;
		MR_TRY(examine_chunk(ctx, near, s, suspects - i < CHUNK ? suspects - i : CHUNK));
	}
	MR_TRY(spread(ctx, near, &s, suspect, suspects));
	for (size_t i = 0; i < n; i++)
		*count += outlier[i];
	mr_mark_release(ctx, mark);
	return MR_OK;
}
