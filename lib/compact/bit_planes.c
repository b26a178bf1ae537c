/* Coefficients bit by bit, the most significant ones first. */
#include "compact/bit_planes.h"

#include "subdivide/loop_ring.h"

/* Contexts.  Until a coefficient is significant: the sizes of its neighbours, those at the ends of its edge,
 * and the depth of its level below the finest; after that, its own size.  A sign: the signs of its
 * neighbours. */
enum { BESIDE = 9, ENDS = 6, DEPTH = 4, LARGE = 4 };

typedef struct field_odds {
	mr_odds first[DEPTH][ENDS][BESIDE], further[DEPTH][LARGE], sign[2][3];
} field_odds;

/* The sign of a known coefficient; the other bits are its size. */
#define NEGATIVE (1u << 31)

typedef struct coding {
	mr_coder *c;
	const mr_loop *level;
	size_t n;
	mr_bit_planes *f;
	uint32_t *known; /* level[n].nv */
	uint32_t
	    *beside; /* of an odd vertex: the sum of its neighbours' sizes, each below 2^MR_BIT_PLANES_MOST */
	field_odds *odds;
} coding;

static inline uint32_t
size_of(uint32_t known)
{
	return known & ~NEGATIVE;
}

static int
sign_of(uint32_t known)
{
	return known == 0 ? 0 : known & NEGATIVE ? -1 : 1;
}

/* Context of a coefficient: sums of sizes over its neighbours and over the ends of its edge, in halves of the
 * plane's bit. */
typedef struct around {
	uint64_t beside, ends;
} around;

/* The neighbours of the odd vertex on half-edge h of the coarse level: those on the other edges of its faces,
 * which on a boundary count twice. */
static void
find_beside(const mr_loop *fine, uint32_t h, uint32_t half[4])
{
	uint32_t g = fine[-1].topo.twin[h];

	g = g == MR_NONE ? h : g;
	half[0] = mr_he_next(h), half[1] = mr_he_prev(h);
	half[2] = mr_he_next(g), half[3] = mr_he_prev(g);
}

/* Odd vertex v of level j has become larger by `more`. */
static void
tell_beside(const coding *s, size_t j, size_t v, uint32_t more)
{
	const mr_loop *fine = &s->level[j];
	uint32_t h = fine->edge[v - fine->coarse_nv], half[4];
	bool open = fine[-1].topo.twin[h] == MR_NONE;

	find_beside(fine, h, half);
	for (int i = 0; i < (open ? 2 : 4); i++)
		s->beside[mr_loop_odd(fine, half[i])] += fine[-1].topo.twin[half[i]] == MR_NONE ? 2 * more
		                                                                                : more;
}

static int
sign_beside(const coding *s, size_t j, size_t v)
{
	const mr_loop *fine = &s->level[j];
	uint32_t half[4];
	int sign = 0;

	find_beside(fine, fine->edge[v - fine->coarse_nv], half);
	for (int i = 0; i < 4; i++)
		sign += sign_of(s->known[mr_loop_odd(fine, half[i])]);
	return sign;
}

static inline around
around_odd(const coding *s, size_t j, size_t v, unsigned plane)
{
	const mr_loop *fine = &s->level[j], *coarse = fine - 1;
	uint32_t h = fine->edge[v - coarse->nv];
	uint64_t ends = (uint64_t)size_of(s->known[mr_loop_from(coarse, h)]) +
	                size_of(s->known[mr_loop_to(coarse, h)]);

	return (around){ (uint64_t)s->beside[v] << 1 >> plane, ends << 1 >> plane };
}

/* Context of a control vertex: four times the mean of its neighbours, and the sum of their signs. */
static around
around_control(const coding *s, size_t v, unsigned plane, int *sign)
{
	enum { MOST = 64 };
	uint32_t count = 0, sum = 0;

	*sign = 0;
	for (mr_loop_ring r = mr_loop_ring_begin(s->level, (uint32_t)v); r.more;
	     mr_loop_ring_step(&r), count++) {
		uint32_t size = size_of(s->known[r.to]) << 1 >> plane;
		sum += size < MOST ? size : MOST;
		*sign += sign_of(s->known[r.to]);
	}
	return (around){ .beside = count ? 4 * sum / count : 0 };
}

static inline mr_odds *
odds_of_first(const coding *s, size_t j, const around *a)
{
	static const uint8_t beside[] = { 0, 1, 2, 3, 4, 4, 5, 5, 6, 6, 6, 6, 7, 7, 7, 7, 7, 7, 7, 7, 8 };
	static const uint8_t ends[] = { 0, 1, 2, 2, 3, 3, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 5 };
	size_t depth = s->n - j < DEPTH ? s->n - j : DEPTH - 1;

	return &s->odds->first[depth][ends[a->ends < 16 ? a->ends : 16]]
	                      [beside[a->beside < 20 ? a->beside : 20]];
}

static inline mr_odds *
odds_of_further(const coding *s, size_t j, uint32_t above)
{
	size_t depth = s->n - j < DEPTH ? s->n - j : DEPTH - 1;

	return &s->odds->further[depth][above < LARGE ? above - 1 : LARGE - 1];
}

/* Codes a bit of a coefficient that is not significant yet; after a 1, its sign. */
static inline uint32_t
code_first(const coding *s, size_t j, size_t v, unsigned plane)
{
	int sign = 0;
	around a = j ? around_odd(s, j, v, plane) : around_control(s, v, plane, &sign);
	int32_t x = s->f->x[v];
	uint32_t size = (uint32_t)(x < 0 ? -x : x);

	if (!mr_code_bit(s->c, odds_of_first(s, j, &a), size >> plane & 1))
		return 0;
	sign = j ? sign_beside(s, j, v) : sign;
	bool negative = mr_code_bit(s->c, &s->odds->sign[j > 0][sign < 0 ? 0 : sign > 0 ? 2 : 1], x < 0);
	return 1u << plane | (negative ? NEGATIVE : 0);
}

static inline uint32_t
code_further(const coding *s, size_t j, size_t v, unsigned plane)
{
	int32_t x = s->f->x[v];
	uint32_t size = (uint32_t)(x < 0 ? -x : x), known = s->known[v];
	bool bit = mr_code_bit(s->c, odds_of_further(s, j, size_of(known) >> (plane + 1)), size >> plane & 1);

	return known | (uint32_t)bit << plane;
}

/* Codes one bit of each coefficient of level j.  When reading, f->x becomes the middle of its possible
 * values. */
static void
code_plane(const coding *s, size_t j, unsigned plane)
{
	size_t end = s->level[j].nv;

	for (size_t v = j ? s->level[j].coarse_nv : 0; v < end; v++) {
		uint32_t was = s->known[v],
			 known = was ? code_further(s, j, v, plane) : code_first(s, j, v, plane);
		if (s->c->ended)
			return;
		if (!known)
			continue;
		s->known[v] = known;
		if (j && known != was)
			tell_beside(s, j, v, 1u << plane);
		if (s->c->reading) {
			int32_t size = (int32_t)(size_of(known) | 1u << plane >> 1);
			s->f->x[v] = known & NEGATIVE ? -size : size;
		}
	}
}

mr_status
mr_bit_planes_count(mr_ctx *ctx, const mr_loop *level, size_t n, mr_bit_planes *f)
{
	for (size_t j = 0; j <= n; j++) {
		uint32_t all = 0;
		uint8_t planes = 0;
		for (size_t v = j ? level[j].coarse_nv : 0; v < level[j].nv; v++)
			all |= (uint32_t)(f->x[v] < 0 ? -f->x[v] : f->x[v]);
		while (planes < 32 && all >> planes)
			planes++;
		if (planes > MR_BIT_PLANES_MOST)
			return mr_fail(ctx, MR_ERANGE, "the heights are too large for that error");
		f->planes[j] = planes;
	}
	return MR_OK;
}

unsigned
mr_bit_planes_passes(const mr_bit_planes *f, size_t fields, size_t n)
{
	unsigned passes = 0;

	for (size_t i = 0; i < fields; i++)
		for (size_t j = 0; j <= n; j++)
			if (f[i].planes[j] > j + passes)
				passes = f[i].planes[j] - (unsigned)j;
	return passes;
}

void
mr_bit_planes_code(
    mr_ctx *ctx, mr_coder *c, const mr_loop *level, size_t n, mr_bit_planes *f, size_t fields, size_t *end)
{
	coding *s = MR_NEW(ctx, fields, coding);

	for (size_t i = 0; i < fields; i++)
		s[i] = (coding){ c, level, n, &f[i], MR_NEW_ZERO(ctx, level[n].nv, uint32_t),
			MR_NEW_ZERO(ctx, level[n].nv, uint32_t), MR_NEW_ZERO(ctx, 1, field_odds) };
	for (unsigned p = mr_bit_planes_passes(f, fields, n); p-- > 0;) {
		for (size_t j = 0; j <= n; j++)
			for (size_t i = 0; i < fields && !c->ended; i++)
				if (p + j < f[i].planes[j])
					code_plane(&s[i], j, p + (unsigned)j);
		if (end)
			end[p] = c->count + c->waiting + MR_CODER_AHEAD;
	}
}
