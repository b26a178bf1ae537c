/*
 * look_yardstick -- how a surface of a cloud looks beside the one that the cloud is of; usage:
 *	look_yardstick judge TRUTH RESULT           one line of JSON
 *	look_yardstick normals TRUTH POINTS XYZ     points, each with the truth's normal at the nearest place
 *	look_yardstick close SURFACE PLACE OUT      a stream for mr-render: what is in a ball around PLACE
 *
 * Normals are smooth: of a vertex the faces' weighted by area, linear between the vertices; which side is
 * outside does not count, as points without normals cannot tell.  JSON: angle between those of places
 * uniform on the result and the truth's at the nearest places (mean and 95 % in degrees, share over 30);
 * shares of edges bent by over 60 degrees, of the result and the truth; mean distances in diagonals; of a
 * displaced surface the heights' standard deviation in diagonals, and the entropy of their wavelet
 * coefficients at steps of 1e-4 diagonals, bits a vertex; PLACE, where most of the error over 30 degrees is:
 * its coordinates, the direction from which to look, and the ball's radius.
 */
#include "base/sort.h"
#include "mesh/clip.h"
#include "mesh/edges.h"
#include "shape/shape.h"
#include "space/bvh.h"
#include "subdivide/displaced.h"
#include "subdivide/wavelet.h"

#include "yardstick.h"

#include <stdlib.h>

enum { SAMPLES = 100000, SAMPLES_BACK = 30000, WORST = 3000 };

static const double OVER = 30, BENT = 60;           /* degrees */
static const double TOGETHER = 0.01, AROUND = 0.05; /* diagonals: errors of one place, its close-up */
static const double STEP = 1e-4;

typedef struct surface {
	mr_mesh m;
	mr_v3 *normal;
	mr_bvh *bvh;
} surface;

static mr_status
read_surface(mr_ctx *ctx, const char *path, surface *s)
{
	MR_TRY(read_mesh(ctx, path, &s->m));
	if (!s->m.nf)
		return mr_fail(ctx, MR_EMESH, "%s: no faces", path);
	s->normal = mr_area_normals(ctx, &s->m);
	for (size_t v = 0; v < s->m.nv; v++)
		s->normal[v] = mr_unit(s->normal[v]);
	mr_bvh_build(ctx, &s->m, &s->bvh);
	return MR_OK;
}

/* The nearest place's normal, and how far it is. */
static mr_v3
nearest_normal(const surface *s, mr_v3 q, double *distance)
{
	mr_closest c = mr_bvh_closest(s->bvh, q);
	const uint32_t *v = s->m.t[c.at.face].v;

	*distance = sqrt(c.dist2);
	return mr_unit(mr_bary_point(c.at.bary, s->normal[v[0]], s->normal[v[1]], s->normal[v[2]]));
}

/* ---- figures ---- */

static double
bent_share(mr_ctx *ctx, const mr_mesh *m)
{
	size_t bent = 0, inner = 0;
	mr_edges edges;

	mr_edges_build(ctx, m, &edges);
	for (size_t e = 0; e < edges.count; e++) {
		const uint32_t *h = edges.he + edges.start[e];
		if (mr_edge_faces(&edges, e) != 2)
			continue;
		inner++;
		bent += mr_angle(mr_face_cross(m, h[0] / 3), mr_face_cross(m, h[1] / 3)) > BENT * MR_PI / 180;
	}
	return (double)bent / fmax(1, (double)inner);
}

static int
compare_reals(const void *a, const void *b)
{
	const double *x = a, *y = b;

	return (*x > *y) - (*x < *y);
}

/* Bits a number, of numbers rounded to whole ones; they are sorted. */
static double
entropy(double *x, size_t n)
{
	double bits = 0;

	qsort(x, n, sizeof *x, compare_reals);
	for (size_t i = 0, end; i < n; i = end) {
		for (end = i; end < n && x[end] == x[i];)
			end++;
		bits -= (double)(end - i) * log2((double)(end - i) / (double)n);
	}
	return bits / (double)n;
}

static mr_status
print_heights(mr_ctx *ctx, mr_frame *frame, double diagonal)
{
	double sum = 0, sum2 = 0, *x;
	const double *height;
	mr_mesh control;
	mr_domain d;
	size_t n;

	MR_TRY(mr_layer_mesh(ctx, frame, "control", &control));
	MR_TRY(mr_displacement_get(ctx, frame, &control, &n, &height));
	MR_TRY(mr_domain_of(ctx, frame, &control, n, &d));
	x = MR_NEW(ctx, d.m.nv, double);
	for (size_t i = 0; i < d.m.nv; i++) {
		x[i] = height[i];
		sum += x[i];
		sum2 += x[i] * x[i];
	}
	sum /= (double)d.m.nv;
	print_real("heights", sqrt(fmax(0, sum2 / (double)d.m.nv - sum * sum)) / diagonal);
	mr_wavelet_analyse(ctx, d.level, n, x);
	for (size_t i = 0; i < d.m.nv; i++)
		x[i] = round(x[i] / (STEP * diagonal));
	print_real("entropy", entropy(x, d.m.nv));
	printf(",\"vertices\":%zu", d.m.nv);
	return MR_OK;
}

/* Around which of the samples most of the error over 30 degrees is; of none the worst one. */
static size_t
worst_place(mr_ctx *ctx, const mr_v3 *p, const double *angle, double together)
{
	size_t *high = MR_NEW(ctx, WORST, size_t), n = 0, worst = 0, over = 0, stride;
	double most = 0;

	for (size_t i = 0; i < SAMPLES; i++) {
		over += angle[i] > OVER;
		worst = angle[i] > angle[worst] ? i : worst;
	}
	stride = over / WORST + 1;
	for (size_t i = 0, k = 0; i < SAMPLES; i++)
		if (angle[i] > OVER && k++ % stride == 0)
			high[n++] = i;
	for (size_t i = 0; i < n; i++) {
		double sum = 0;
		for (size_t k = 0; k < n; k++)
			sum += mr_dist(p[high[i]], p[high[k]]) < together ? angle[high[k]] - OVER : 0;
		if (sum > most) {
			most = sum;
			worst = high[i];
		}
	}
	return worst;
}

static mr_status
judge(mr_ctx *ctx, char **argv)
{
	double *angle = MR_NEW(ctx, 2 * SAMPLES, double), *sorted = angle + SAMPLES, distance;
	double mean = 0, over = 0, to = 0, from = 0, diagonal;
	surface truth, result;
	mr_v3 *p, *normal, *q, eye = { 0 };
	mr_frame *frame;
	size_t worst, inside = 0;

	MR_TRY(read_surface(ctx, argv[0], &truth));
	MR_TRY(read_surface(ctx, argv[1], &result));
	MR_TRY(mr_surface_sample(ctx, &result.m, SAMPLES, 1, &p, &normal));
	MR_TRY(mr_surface_sample(ctx, &truth.m, SAMPLES_BACK, 2, &q, &normal));
	normal = MR_NEW(ctx, SAMPLES, mr_v3);
	diagonal = mr_mesh_diagonal(&truth.m);
	for (size_t i = 0; i < SAMPLES; i++) {
		mr_v3 ours = nearest_normal(&result, p[i], &distance);
		normal[i] = nearest_normal(&truth, p[i], &distance);
		to += distance / SAMPLES;
		angle[i] = mr_angle(ours, normal[i]) * 180 / MR_PI;
		inside += angle[i] > 90;
	}
	for (size_t i = 0; i < SAMPLES; i++) {
		sorted[i] = angle[i] = inside > SAMPLES / 2 ? 180 - angle[i] : angle[i];
		mean += angle[i] / SAMPLES;
		over += angle[i] > OVER ? 1. / SAMPLES : 0;
	}
	for (size_t i = 0; i < SAMPLES_BACK; i++)
		from += sqrt(mr_bvh_closest(result.bvh, q[i]).dist2) / SAMPLES_BACK;
	worst = worst_place(ctx, p, angle, TOGETHER * diagonal);
	for (size_t i = 0; i < SAMPLES; i++)
		if (mr_dist(p[i], p[worst]) < AROUND * diagonal)
			eye = mr_add(eye, normal[i]);
	eye = mr_norm(eye) > 0 ? mr_unit(eye) : normal[worst];
	printf("{\"place\":\"%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\"", p[worst].x, p[worst].y, p[worst].z, eye.x,
	    eye.y, eye.z, AROUND * diagonal);
	print_real("mean", mean);
	print_real("high", mr_kth(sorted, SAMPLES, SAMPLES / 100 * 95));
	print_real("over", over);
	print_real("bent", bent_share(ctx, &result.m));
	print_real("bent_truth", bent_share(ctx, &truth.m));
	print_real("to", to / diagonal);
	print_real("from", from / diagonal);
	MR_TRY(read_frame(ctx, argv[1], &frame));
	if (mr_frame_find(frame, "displacement", "height"))
		MR_TRY(print_heights(ctx, frame, diagonal));
	printf("}\n");
	return MR_OK;
}

/* ---- files ---- */

static mr_status
write_normals(mr_ctx *ctx, char **argv)
{
	surface truth;
	mr_frame *frame;
	mr_mesh points;
	double distance;
	FILE *out;

	MR_TRY(read_surface(ctx, argv[0], &truth));
	MR_TRY(read_frame(ctx, argv[1], &frame));
	MR_TRY(mr_layer_points(ctx, frame, "points", &points));
	out = fopen(argv[2], "w");
	for (size_t i = 0; out && i < points.nv; i++) {
		mr_v3 p = points.p[i], normal = nearest_normal(&truth, p, &distance);
		fprintf(out, "%.9g %.9g %.9g %.6f %.6f %.6f\n", p.x, p.y, p.z, normal.x, normal.y, normal.z);
	}
	return out && !fclose(out) ? MR_OK : mr_fail(ctx, MR_EIO, "%s: cannot be written", argv[2]);
}

/* What is in the ball, which becomes the unit ball, seen from z. */
static mr_status
write_close(mr_ctx *ctx, char **argv)
{
	mr_v3 at, eye, right, up, *p;
	double radius, *value;
	mr_mesh m;

	if (sscanf(argv[1], "%lf,%lf,%lf,%lf,%lf,%lf,%lf", &at.x, &at.y, &at.z, &eye.x, &eye.y, &eye.z,
		&radius) != 7)
		return mr_fail(ctx, MR_EUSAGE, "%s: no place", argv[1]);
	MR_TRY(read_mesh(ctx, argv[0], &m));
	value = MR_NEW(ctx, m.nv, double);
	for (size_t v = 0; v < m.nv; v++)
		value[v] = mr_dist(m.p[v], at) - radius;
	mr_mesh_clip(ctx, &m, value, &m);
	up = fabs(eye.y) < 0.9 ? mr_vec(0, 1, 0) : mr_vec(0, 0, 1);
	right = mr_unit(mr_cross(up, eye));
	up = mr_cross(eye, right);
	p = MR_NEW(ctx, m.nv, mr_v3);
	for (size_t v = 0; v < m.nv; v++) {
		mr_v3 d = mr_mul(1 / radius, mr_sub(m.p[v], at));
		p[v] = mr_vec(mr_dot(right, d), mr_dot(up, d), mr_dot(eye, d));
	}
	m.p = p;
	return write_picture(ctx, argv[2], "", &m, NULL);
}

int
main(int argc, char **argv)
{
	static const struct {
		const char *name;
		int arguments;
		mr_status (*run)(mr_ctx *ctx, char **argv);
	} work[] = { { "judge", 2, judge }, { "normals", 3, write_normals }, { "close", 3, write_close } };
	mr_ctx ctx;
	int failed = 1;

	for (size_t i = 0; i < sizeof work / sizeof *work; i++) {
		if (argc != work[i].arguments + 2 || strcmp(argv[1], work[i].name))
			continue;
		mr_ctx_init(&ctx, 0);
		if (work[i].run(&ctx, argv + 2) < 0)
			fprintf(stderr, "look_yardstick: %s\n", ctx.error);
		else
			failed = fflush(stdout) != 0;
		mr_ctx_free(&ctx);
		return failed;
	}
	fprintf(stderr,
	    "usage: look_yardstick judge TRUTH RESULT | normals TRUTH POINTS OUT.xyz | close SURFACE PLACE "
	    "OUT\n");
	return 2;
}
