/* Planes by the covariance of the nearest points, whose eigenvectors Jacobi rotations find. */
#include "space/local_planes.h"

#include "base/parallel.h"
#include "space/near.h"

enum { AROUND = 8, MOST = 128, CHUNK = 1 << 13, GRAIN = 1024, SWEEPS = 12 };

/* One Jacobi rotation: makes m[i][j] zero. */
static void
rotate(double m[3][3], double v[3][3], int i, int j)
{
	double theta, t, c, s;

	if (m[i][j] == 0)
		return;
	theta = (m[j][j] - m[i][i]) / (2 * m[i][j]);
	t = (theta < 0 ? -1 : 1) / (fabs(theta) + sqrt(theta * theta + 1));
	c = 1 / sqrt(t * t + 1);
	s = t * c;
	for (int k = 0; k < 3; k++) {
		double a = m[k][i], b = m[k][j];
		m[k][i] = c * a - s * b;
		m[k][j] = s * a + c * b;
	}
	for (int k = 0; k < 3; k++) {
		double a = m[i][k], b = m[j][k];
		m[i][k] = c * a - s * b;
		m[j][k] = s * a + c * b;
		a = v[k][i];
		b = v[k][j];
		v[k][i] = c * a - s * b;
		v[k][j] = s * a + c * b;
	}
}

void
mr_eigen_sym3(const double a[6], double value[3], mr_v3 vector[3])
{
	double m[3][3] = { { a[0], a[1], a[2] }, { a[1], a[3], a[4] }, { a[2], a[4], a[5] } };
	double v[3][3] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
	double tiny = 1e-14 * (fabs(a[0]) + fabs(a[3]) + fabs(a[5]));
	int order[3] = { 0, 1, 2 };

	for (int sweep = 0; sweep < SWEEPS; sweep++) {
		if (fabs(m[0][1]) + fabs(m[0][2]) + fabs(m[1][2]) <= tiny)
			break;
		rotate(m, v, 0, 1);
		rotate(m, v, 0, 2);
		rotate(m, v, 1, 2);
	}
	for (int i = 0; i < 3; i++)
		for (int j = 0; j + 1 < 3; j++)
			if (m[order[j]][order[j]] > m[order[j + 1]][order[j + 1]]) {
				int o = order[j];
				order[j] = order[j + 1];
				order[j + 1] = o;
			}
	for (int i = 0; i < 3; i++) {
		int o = order[i];
		value[i] = m[o][o];
		vector[i] = mr_vec(v[0][o], v[1][o], v[2][o]);
	}
}

/* Relative to the diagonal of the box: a flatter one may be rounding of single precision. */
static const double FLAT = 1e-6;

/* Directions of at most this cosine, 45 degrees, lie apart. */
static const double APART = 0.7;

void
mr_covariance(const mr_v3 *p, size_t k, double scale, double sum[6])
{
	mr_v3 mean = mr_vec(0, 0, 0);
	double a[6] = { 0 };

	for (size_t i = 0; i < k; i++)
		mean = mr_axpy(1 / (double)k, p[i], mean);
	for (size_t i = 0; i < k; i++) {
		mr_v3 d = mr_mul(scale, mr_sub(p[i], mean));
		a[0] += d.x * d.x;
		a[1] += d.x * d.y;
		a[2] += d.x * d.z;
		a[3] += d.y * d.y;
		a[4] += d.y * d.z;
		a[5] += d.z * d.z;
	}
	memcpy(sum, a, sizeof a);
}

mr_v3
mr_plane_fit(const mr_v3 *p, size_t k, double *variation)
{
	double a[6], value[3], sum;
	mr_v3 vector[3];

	mr_covariance(p, k, 1, a);
	mr_eigen_sym3(a, value, vector);
	sum = value[0] + value[1] + value[2];
	*variation = sum > 0 && value[0] > 0 ? value[0] / sum : 0;
	return vector[0];
}

int
mr_cloud_dimensions(const mr_v3 *p, size_t n)
{
	double diagonal = mr_box_diagonal(mr_box_of(p, n)), a[6], value[3];
	mr_v3 vector[3];
	int count = 0;

	if (!(diagonal > 0))
		return 0;
	mr_covariance(p, n, 1 / diagonal, a);
	mr_eigen_sym3(a, value, vector);
	for (int k = 0; k < 3; k++)
		count += value[k] > FLAT * FLAT * (double)n;
	return count;
}

double
mr_own_area(const double *dist2, size_t k)
{
	double sum = 0;

	for (size_t j = 0; j < k; j++)
		sum += dist2[j];
	return k > 0 ? 2 * MR_PI * sum / ((double)k * (double)(k + 1)) : 0;
}

/* Directions from q[0] to the nearest of the others that lie apart.  Returns how many. */
static size_t
directions_apart(const mr_v3 *q, size_t k, mr_v3 direction[AROUND])
{
	size_t n = 0;

	for (size_t j = 1; j < k && n < AROUND; j++) {
		mr_v3 d = mr_sub(q[j], q[0]);
		double least = APART * mr_norm(d);
		size_t i = 0;
		while (i < n && mr_dot(d, direction[i]) < least)
			i++;
		if (i == n)
			direction[n++] = mr_unit(d);
	}
	return n;
}

mr_v3
mr_plane_around(const mr_v3 *q, size_t k, double *variation)
{
	mr_v3 direction[AROUND];
	size_t apart = directions_apart(q, k, direction);

	return apart > 2 ? mr_plane_fit(direction, apart, variation) : mr_plane_fit(q, k, variation);
}

typedef struct work {
	const mr_v3 *p;
	const uint32_t *index; /* k of each of a chunk's points */
	const double *dist2;
	size_t k, first; /* the chunk's first point */
	bool around;
	mr_planes *out;
} work;

static void
fit_at(const work *w, size_t i)
{
	const uint32_t *index = w->index + i * w->k;
	const mr_planes *o = w->out;
	const double *dist2 = w->dist2 + i * w->k;
	size_t at = w->first + i, n = 0;
	mr_v3 q[MOST];

	q[0] = w->p[at];
	for (; n < w->k && index[n] != UINT32_MAX; n++)
		q[n] = w->p[index[n]];
	o->normal[at] = w->around ? mr_plane_around(q, n, &o->variation[at])
	                          : mr_plane_fit(q, n, &o->variation[at]);
	/* in a layer as thick as noise makes it, the farthest give the best density */
	o->area[at] = w->around || n < 2 ? mr_own_area(dist2 + 1, n > AROUND ? AROUND : n - 1)
	                                 : MR_PI * dist2[n - 1] / (double)(n - 1);
	for (size_t j = 0; j < o->links; j++)
		o->neighbor[at * o->links + j] = j + 1 < n ? index[j + 1] : UINT32_MAX;
}

static void
fit_planes(void *arg, size_t begin, size_t end)
{
	for (size_t i = begin; i < end; i++)
		fit_at(arg, i);
}

static mr_status
fit_all(mr_ctx *ctx, const mr_near *near, const mr_v3 *p, size_t n, size_t k, bool around, mr_planes *out)
{
	size_t chunk = n < CHUNK ? n : CHUNK;
	uint32_t *index = MR_NEW(ctx, chunk * k, uint32_t);
	double *dist2 = MR_NEW(ctx, chunk * k, double);

	for (size_t first = 0; first < n; first += chunk) {
		size_t m = n - first < chunk ? n - first : chunk;
		work w = { p, index, dist2, k, first, around, out };
		MR_TRY(mr_near_query(ctx, near, p + first, m, k, index, dist2));
		mr_parallel(ctx, m, GRAIN, fit_planes, &w);
	}
	return MR_OK;
}

mr_status
mr_cloud_planes(mr_ctx *ctx, const mr_v3 *p, size_t n, size_t k, size_t links, bool around, mr_planes *out)
{
	mr_planes r = { .normal = MR_NEW(ctx, n, mr_v3),
		.variation = MR_NEW(ctx, n, double),
		.area = MR_NEW(ctx, n, double),
		.neighbor = MR_NEW(ctx, n * links, uint32_t),
		.links = links };
	MR_SCOPE(ctx);
	mr_near *near = NULL;

	if (k < 3 || k > MOST || links >= k)
		return mr_fail(ctx, MR_ERANGE, "planes of %zu points and %zu links: 3 to %d are allowed", k,
		    links, MOST);
	MR_TRY(mr_near_build_distinct(ctx, p, n, &near));
	MR_TRY(fit_all(ctx, near, p, n, k, around, &r));
	*out = r;
	return MR_OK;
}
