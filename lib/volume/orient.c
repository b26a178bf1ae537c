/* Signs of the planes' normals: they spread along a spanning tree of alike planes (Hoppe et al. 1992), one
 * normal compared with the other's mirrored between the points (Koenig, Gumhold 2009): so around edges too.
 */
#include "volume/parts.h"

#include "base/parallel.h"

enum { BINS = 256, GRAIN = 4096 };

/* A point, or a part, knows its own sign from this share of the mean vote on, or from one side alone.  A
 * tenth, or LOUD alone, gets fewer clouds right. */
static const double LOUD = 0.25, ONE_SIDED = 0.7;

/* Parts joined so far: the sign of a point is its own times those up to the root. */
typedef struct parts {
	uint32_t *parent;
	int8_t *sign; /* against the parent's */
	uint32_t *size;
	double *vote;  /* of a root: for its own sign */
	double *flood; /* of a root: on both sides of its points */
	double loud;   /* a vote that is; infinite: none is */
} parts;

static uint32_t
root_of(parts *q, uint32_t x, int8_t *sign)
{
	uint32_t root = x;
	int8_t s = 1;

	while (q->parent[root] != root) {
		s = (int8_t)(s * q->sign[root]);
		root = q->parent[root];
	}
	*sign = s;
	while (q->parent[x] != root && x != root) { /* the path becomes short */
		uint32_t next = q->parent[x];
		int8_t own = q->sign[x];
		q->parent[x] = root;
		q->sign[x] = s;
		s = (int8_t)(s * own);
		x = next;
	}
	return root;
}

static bool
is_sure(const parts *q, uint32_t root)
{
	return fabs(q->vote[root]) > fmax(q->loud * q->size[root], ONE_SIDED * q->flood[root]);
}

/* Joins the parts of a and b so that their signs' product is `same`, unless both know better. */
static void
join(parts *q, uint32_t a, uint32_t b, int8_t same)
{
	int8_t sa, sb, s;
	uint32_t ra = root_of(q, a, &sa), rb = root_of(q, b, &sb);

	if (ra == rb)
		return;
	s = (int8_t)(sa * sb * same);
	if (is_sure(q, ra) && is_sure(q, rb) && q->vote[ra] * q->vote[rb] * s < 0)
		return;
	if (q->size[ra] < q->size[rb]) {
		uint32_t r = ra;
		ra = rb;
		rb = r;
	}
	q->parent[rb] = ra;
	q->sign[rb] = s;
	q->size[ra] += q->size[rb];
	q->vote[ra] += s * q->vote[rb];
	q->flood[ra] += q->flood[rb];
}

double
mr_volume_likeness(const mr_volume_cloud *s, uint32_t i, uint32_t j)
{
	mr_v3 a = s->plane.normal[i], b = s->plane.normal[j], e = mr_unit(mr_sub(s->p[j], s->p[i]));
	double ae = mr_dot(a, e), be = mr_dot(b, e);
	double steep = fmax(ae * ae, be * be);

	return (mr_dot(a, b) - 2 * ae * be) * (1 - steep);
}

static size_t
bin_of(double likeness)
{
	double w = fabs(likeness);

	return (size_t)((1 - (w < 1 ? w : 1)) * (BINS - 1));
}

/* The links, each pair once or twice, the most alike first; in each bin by number. */
typedef struct order {
	const mr_volume_cloud *s;
	uint16_t *kind; /* of each link: twice the bin, and 1 where the signs differ; NONE */
	uint32_t *sorted;
	size_t count;
} order;

enum { NONE = UINT16_MAX };

static void
find_kinds(void *arg, size_t begin, size_t end)
{
	const order *o = arg;
	const mr_volume_cloud *s = o->s;
	size_t links = s->plane.links;

	for (size_t i = begin; i < end; i++)
		for (size_t l = i * links; l < (i + 1) * links; l++) {
			o->kind[l] = NONE;
			if (s->plane.neighbor[l] != UINT32_MAX) {
				double alike = mr_volume_likeness(s, (uint32_t)i, s->plane.neighbor[l]);
				o->kind[l] = (uint16_t)(2 * bin_of(alike) + (alike < 0));
			}
		}
}

static void
sort_links(mr_ctx *ctx, const mr_volume_cloud *s, order *o)
{
	size_t links = s->n * s->plane.links, first[BINS + 1] = { 0 };

	*o = (order){ s, MR_NEW(ctx, links, uint16_t), MR_NEW(ctx, links, uint32_t), 0 };
	mr_parallel(ctx, s->n, GRAIN, find_kinds, o);
	for (size_t l = 0; l < links; l++)
		if (o->kind[l] != NONE)
			first[o->kind[l] / 2 + 1]++;
	for (size_t i = 0; i < BINS; i++)
		first[i + 1] += first[i];
	o->count = first[BINS];
	for (size_t l = 0; l < links; l++)
		if (o->kind[l] != NONE)
			o->sorted[first[o->kind[l] / 2]++] = (uint32_t)l;
}

double
mr_volume_loud(const double *vote, size_t n)
{
	double all = 0;

	for (size_t i = 0; i < n; i++)
		all += fabs(vote[i]);
	return n > 0 ? LOUD * all / (double)n : 0;
}

static void
begin(mr_ctx *ctx, const mr_volume_cloud *s, const double *vote, const double *flood, parts *q)
{
	q->parent = MR_NEW(ctx, s->n, uint32_t);
	q->sign = MR_NEW(ctx, s->n, int8_t);
	q->size = MR_NEW(ctx, s->n, uint32_t);
	q->vote = MR_NEW(ctx, s->n, double);
	q->flood = MR_NEW(ctx, s->n, double);
	for (size_t i = 0; i < s->n; i++) {
		q->parent[i] = (uint32_t)i;
		q->sign[i] = 1;
		q->size[i] = 1;
		q->vote[i] = vote[i];
		q->flood[i] = flood ? flood[i] : 0;
	}
}

mr_status
mr_volume_orient(
    mr_ctx *ctx, mr_volume_cloud *s, double *vote, const double *flood, bool apart, size_t *untold)
{
	mr_mark mark = mr_mark_take(ctx);
	size_t links = s->plane.links;
	order o;
	parts q;

	if (s->n > UINT32_MAX / links)
		return mr_fail(ctx, MR_ERANGE, "%zu points are too many for a volume", s->n);
	begin(ctx, s, vote, flood, &q);
	q.loud = apart ? mr_volume_loud(vote, s->n) : INFINITY;
	sort_links(ctx, s, &o);
	for (size_t k = 0; k < o.count; k++) {
		uint32_t l = o.sorted[k];
		join(&q, (uint32_t)(l / links), s->plane.neighbor[l], o.kind[l] & 1 ? -1 : 1);
	}
	*untold = 0;
	for (uint32_t i = 0; i < s->n; i++) {
		int8_t sign;
		uint32_t root = root_of(&q, i, &sign);
		*untold += q.vote[root] == 0;
		if (q.vote[root] * sign < 0) {
			s->plane.normal[i] = mr_mul(-1, s->plane.normal[i]);
			vote[i] *= -1;
		}
	}
	mr_mark_release(ctx, mark);
	return MR_OK;
}
