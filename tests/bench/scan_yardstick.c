/*
 * scan_yardstick -- clouds whose surface is known, and how a reconstruction came out; usage:
 *	scan_yardstick cloud KIND SEED MODEL POINTS TRUTH       writes two streams: the cloud, its surface
 *	scan_yardstick judge TRUTH POINTS RESULT [PICTURE]      one line of JSON
 * MODEL is a closed model of any format, or a stream; the last frame's layer mesh is taken.  KIND:
 *	vertices   those of the model
 *	uniform    50,000 points, uniform by area
 *	noise03    uniform, with normal noise of 0.3 % of the diagonal along the normal
 *	noise02    the same of 0.2 %
 *	noise05    the same of 0.5 %
 *	noise1     30,000 points, noise of 1 %
 *	outliers   noise03, and 5 % of the points anywhere in the box, a tenth larger
 *	holes      uniform, without those within three spacings of 20 places
 *	density    uniform, thinned out along the longest axis to a sixtieth
 *	views      uniform, those seen from six sides; what spans openings by mr_wrap_cut is no surface
 *	cut        uniform on what is before the middle of the second longest axis; it is the surface
 *	terrain    uniform on waves over a rectangle, of the model's proportions
 *	near       uniform, on the model and its copy along its shortest axis, three spacings from it
 * JSON: topology of truth and result (Euler number, components, boundary loops, right: all the same); thin:
 * body or gap are thinner than so many spacings at 1 % of the surface; distances in diagonals of the truth;
 * folded edges and intersecting pairs; of the control mesh (where there is none, of the result) the shares of
 * edges bent by over 90 degrees and of angles below 20; how many are bent in the truth, simplified to as many
 * faces.  PICTURE becomes a stream for mr-render as edit_yardstick's: faces are marked that are farther than
 * 1 % of the diagonal from the truth, or intersect others.
 */
#include "base/random.h"
#include "base/sort.h"
#include "measure/measure.h"
#include "mesh/clip.h"
#include "mesh/fold.h"
#include "shape/shape.h"
#include "simplify/simplify.h"
#include "space/bvh.h"
#include "space/self_intersect.h"
#include "subdivide/longest.h"
#include "wrap/parts.h"

#include "yardstick.h"

#include <stdlib.h>

enum { POINTS = 50000, POINTS_FEWER = 30000, HOLES = 20, PROBES = 20000 };

static const double HOLE = 3, GAP = 3; /* spacings */
static const double THINNING = 60;
static const double FAR = 0.01; /* diagonals */

typedef struct cloud {
	mr_mesh truth;
	mr_v3 *p, *normal; /* normal: NULL of vertices */
	size_t n;
	double spacing, diagonal;
	mr_random random;
} cloud;

static mr_v3
axis_vector(int k)
{
	return mr_vec(k == 0, k == 1, k == 2);
}

/* The axes of the box from its shortest side to its longest. */
static void
sort_axes(mr_box b, int axis[3])
{
	mr_v3 size = mr_sub(b.max, b.min);

	axis[2] = mr_largest(size);
	axis[0] = mr_largest(mr_mul(-1, size));
	if (axis[0] == axis[2])
		axis[0] = (axis[2] + 1) % 3;
	axis[1] = 3 - axis[2] - axis[0];
}

/* ---- clouds ---- */

static mr_status
draw_points(mr_ctx *ctx, size_t n, uint64_t seed, cloud *c)
{
	c->n = n;
	return mr_surface_sample(ctx, &c->truth, n, seed, &c->p, &c->normal);
}

/* Keeps those with a mark. */
static void
keep(cloud *c, const bool *marked)
{
	size_t n = 0;

	for (size_t i = 0; i < c->n; i++)
		if (marked[i])
			c->p[n++] = c->p[i];
	c->n = n;
}

static void
add_outliers(cloud *c)
{
	mr_box b = mr_box_of(c->truth.p, c->truth.nv);
	mr_v3 size = mr_mul(1.1, mr_sub(b.max, b.min)), low = mr_axpy(-0.05 / 1.1, size, b.min);

	for (size_t i = 0; i < c->n; i += 20) {
		double x = mr_random_real(&c->random), y = mr_random_real(&c->random);
		double z = mr_random_real(&c->random);
		c->p[i] = mr_add(low, mr_vec(x * size.x, y * size.y, z * size.z));
	}
}

static void
mark_holes(cloud *c, bool *marked)
{
	double most = HOLE * c->spacing;

	for (int h = 0; h < HOLES; h++) {
		mr_v3 at = c->p[mr_random_bits(&c->random) % c->n];
		for (size_t i = 0; i < c->n; i++)
			marked[i] &= mr_dist(at, c->p[i]) > most;
	}
}

static void
mark_density(cloud *c, bool *marked)
{
	mr_box b = mr_box_of(c->truth.p, c->truth.nv);
	int axis[3];
	double low, high;

	sort_axes(b, axis);
	low = mr_coordinate(b.min, axis[2]);
	high = mr_coordinate(b.max, axis[2]);
	for (size_t i = 0; i < c->n; i++) {
		double up = (mr_coordinate(c->p[i], axis[2]) - low) / (high - low);
		marked[i] = mr_random_real(&c->random) < pow(THINNING, -up);
	}
}

static mr_status
mark_seen(mr_ctx *ctx, const cloud *c, bool *marked)
{
	mr_bvh *bvh;
	mr_ray_hit hit;

	mr_bvh_build(ctx, &c->truth, &bvh);
	for (size_t i = 0; i < c->n; i++) {
		marked[i] = false;
		for (int side = 0; side < 6 && !marked[i]; side++) {
			mr_v3 eye = mr_mul(side < 3 ? 1 : -1, axis_vector(side % 3));
			marked[i] = mr_dot(eye, c->normal[i]) > 0 &&
			            !mr_bvh_ray(bvh, c->p[i], eye, 1e-6 * c->diagonal, INFINITY, &hit);
		}
	}
	return MR_OK;
}

/* The part of the surface before a plane across the middle of an axis. */
static mr_status
cut(mr_ctx *ctx, cloud *c)
{
	mr_box b = mr_box_of(c->truth.p, c->truth.nv);
	double *value = MR_NEW(ctx, c->truth.nv, double), middle;
	int axis[3];

	if (!value)
		return MR_EMEM;
	sort_axes(b, axis);
	middle = (mr_coordinate(b.min, axis[1]) + mr_coordinate(b.max, axis[1])) / 2;
	for (size_t v = 0; v < c->truth.nv; v++)
		value[v] = mr_coordinate(c->truth.p[v], axis[1]) - middle;
	mr_mesh_clip(ctx, &c->truth, value, &c->truth);
	return MR_OK;
}

/* Without what the points leave open of it. */
static mr_status
open_truth(mr_ctx *ctx, cloud *c)
{
	mr_wrap_lids lids = { 0 };
	mr_wrap_cloud points;
	mr_refined fine;
	mr_status status = mr_wrap_cloud_open(ctx, c->p, c->n, NULL, &points);

	if (status == MR_OK)
		status = mr_divide_longest(ctx, &c->truth, points.spacing, &fine);
	if (status == MR_OK) {
		mr_mesh m = fine.fine;
		status = mr_wrap_cut(ctx, &points, MR_LIDS_AUTO, false, &m, &lids);
		c->truth = lids.openings > 0 ? m : c->truth;
	}
	return status;
}

/* Waves, as high as a tenth of the diagonal, over the longer sides of the model's box. */
static mr_status
make_terrain(mr_ctx *ctx, cloud *c)
{
	enum { SIDE = 400 };
	mr_make_opts o = MR_MAKE_DEFAULTS;
	mr_box b = mr_box_of(c->truth.p, c->truth.nv);
	mr_v3 size = mr_sub(b.max, b.min), *p;
	double phase[4], along, across;
	int axis[3];

	o.solid = MR_PLANE;
	o.vertices = (size_t)SIDE * SIDE;
	sort_axes(b, axis);
	along = mr_coordinate(size, axis[2]) / c->diagonal;
	across = mr_coordinate(size, axis[1]) / c->diagonal;
	MR_TRY(mr_solid_make(ctx, &o, &c->truth));
	b = mr_box_of(c->truth.p, c->truth.nv);
	p = MR_NEW(ctx, c->truth.nv, mr_v3);
	if (!p)
		return MR_EMEM;
	for (int k = 0; k < 4; k++)
		phase[k] = 2 * MR_PI * mr_random_real(&c->random);
	for (size_t v = 0; v < c->truth.nv; v++) {
		double x = along * (c->truth.p[v].x - b.min.x) / (b.max.x - b.min.x);
		double y = across * (c->truth.p[v].y - b.min.y) / (b.max.y - b.min.y);
		double z = sin(9 * x + phase[0]) * sin(7 * y + phase[1]) +
		           0.3 * sin(23 * x + phase[2]) * sin(19 * y + phase[3]);
		p[v] = mr_mul(c->diagonal, mr_vec(x, y, 0.1 * z));
	}
	c->truth.p = p;
	return MR_OK;
}

static mr_status
copy_beside(mr_ctx *ctx, cloud *c)
{
	mr_box b = mr_box_of(c->truth.p, c->truth.nv);
	mr_mesh *m = &c->truth, twice = *m;
	mr_v3 *p = MR_NEW(ctx, 2 * m->nv, mr_v3), shift;
	mr_tri *t = MR_NEW(ctx, 2 * m->nf, mr_tri);
	int axis[3];

	if (!p || !t)
		return MR_EMEM;
	sort_axes(b, axis);
	shift = mr_mul(
	    mr_coordinate(mr_sub(b.max, b.min), axis[0]) + GAP * sqrt(2) * c->spacing, axis_vector(axis[0]));
	for (size_t v = 0; v < m->nv; v++) {
		p[v] = m->p[v];
		p[m->nv + v] = mr_add(m->p[v], shift);
	}
	for (size_t f = 0; f < m->nf; f++) {
		t[f] = t[m->nf + f] = m->t[f];
		for (int k = 0; k < 3; k++)
			t[m->nf + f].v[k] += (uint32_t)m->nv;
	}
	twice.p = p;
	twice.t = t;
	twice.nv *= 2;
	twice.nf *= 2;
	c->truth = twice;
	return MR_OK;
}

/* In diagonals. */
static double
noise_of(const char *kind)
{
	static const struct {
		const char *kind;
		double noise;
	} of[] = { { "noise02", 0.002 }, { "noise03", 0.003 }, { "outliers", 0.003 }, { "noise05", 0.005 },
		{ "noise1", 0.01 } };

	for (size_t i = 0; i < sizeof of / sizeof *of; i++)
		if (!strcmp(kind, of[i].kind))
			return of[i].noise;
	return 0;
}

static mr_status
make_cloud(mr_ctx *ctx, const char *kind, uint64_t seed, cloud *c)
{
	bool *marked = MR_NEW(ctx, POINTS, bool);
	double noise = noise_of(kind);

	if (!marked)
		return MR_EMEM;
	c->random.state = seed;
	c->diagonal = mr_box_diagonal(mr_box_of(c->truth.p, c->truth.nv));
	c->spacing = sqrt(mr_mesh_area(ctx, &c->truth) / POINTS);
	for (size_t i = 0; i < POINTS; i++)
		marked[i] = true;
	if (!strcmp(kind, "vertices")) {
		c->n = c->truth.nv;
		c->p = MR_NEW(ctx, c->n, mr_v3);
		if (!c->p)
			return MR_EMEM;
		memcpy(c->p, c->truth.p, c->n * sizeof *c->p);
		return MR_OK;
	}
	if (!strcmp(kind, "cut"))
		MR_TRY(cut(ctx, c));
	if (!strcmp(kind, "terrain"))
		MR_TRY(make_terrain(ctx, c));
	if (!strcmp(kind, "near"))
		MR_TRY(copy_beside(ctx, c));
	MR_TRY(draw_points(ctx, strcmp(kind, "noise1") ? POINTS : POINTS_FEWER, seed, c));
	if (noise > 0)
		mr_add_noise(c->p, c->normal, c->n, noise * c->diagonal, seed + 1);
	else if (!strcmp(kind, "holes"))
		mark_holes(c, marked);
	else if (!strcmp(kind, "density"))
		mark_density(c, marked);
	else if (!strcmp(kind, "views"))
		MR_TRY(mark_seen(ctx, c, marked));
	else if (strcmp(kind, "uniform") && strcmp(kind, "cut") && strcmp(kind, "terrain") &&
		 strcmp(kind, "near"))
		return mr_fail(ctx, MR_EUSAGE, "%s: no kind of cloud", kind);
	if (!strcmp(kind, "outliers"))
		add_outliers(c);
	keep(c, marked);
	return strcmp(kind, "views") ? MR_OK : open_truth(ctx, c);
}

static mr_status
write_layer(mr_ctx *ctx, const char *path, const char *layer, const mr_mesh *m)
{
	mr_frame *frame;

	MR_TRY(mr_frame_new(ctx, layer, &frame));
	if (m->nf)
		MR_TRY(mr_layer_put_mesh(ctx, frame, layer, m));
	else
		MR_TRY(mr_layer_put(ctx, frame, layer, "position", m->p, m->nv));
	return write_frame(ctx, path, frame);
}

static mr_status
write_cloud(mr_ctx *ctx, char **argv)
{
	cloud c = { 0 };

	MR_TRY(read_mesh(ctx, argv[2], &c.truth));
	MR_TRY(make_cloud(ctx, argv[0], strtoull(argv[1], NULL, 10), &c));
	MR_TRY(write_layer(ctx, argv[3], "points", &(mr_mesh){ .name = "points", .p = c.p, .nv = c.n }));
	return write_layer(ctx, argv[4], "mesh", &c.truth);
}

/* ---- figures ---- */

typedef struct figures {
	mr_census census;
	size_t pairs;
	double bent, acute; /* shares */
	size_t faces;
} figures;

static mr_status
measure_surface(mr_ctx *ctx, const mr_mesh *m, bool *crosses, figures *figure)
{
	mr_mark mark = mr_mark_take(ctx);
	mr_edges edges;
	size_t bent = 0, acute = 0;

	mr_edges_build(ctx, m, &edges);
	mr_take_census(ctx, m, &edges, &figure->census);
	mr_self_intersections(ctx, NULL, m, crosses, &figure->pairs);
	for (size_t e = 0; e < edges.count; e++) {
		const uint32_t *h = edges.he + edges.start[e];
		bent += mr_edge_faces(&edges, e) == 2 &&
		        mr_dot(mr_face_cross(m, h[0] / 3), mr_face_cross(m, h[1] / 3)) < 0;
	}
	for (size_t h = 0; h < 3 * m->nf; h++) {
		const uint32_t *v = m->t[h / 3].v;
		mr_v3 p = m->p[v[h % 3]], a = mr_sub(m->p[v[(h + 1) % 3]], p),
		      b = mr_sub(m->p[v[(h + 2) % 3]], p);
		acute += atan2(mr_norm(mr_cross(a, b)), mr_dot(a, b)) < 20 * MR_PI / 180;
	}
	figure->bent = (double)bent / (double)edges.count;
	figure->acute = (double)acute / (double)(3 * m->nf);
	figure->faces = m->nf;
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* The share of bent edges that `faces` faces cannot help having. */
static mr_status
measure_simplified(mr_ctx *ctx, const mr_mesh *truth, size_t faces, double *bent)
{
	mr_simplify_opts opts = MR_SIMPLIFY_DEFAULTS;
	uint32_t *onto = MR_NEW(ctx, truth->nv, uint32_t);
	mr_mesh simplified;
	figures figure;

	if (!onto)
		return MR_EMEM;
	opts.faces = faces;
	MR_TRY(mr_simplify(ctx, truth, &opts, NULL, &simplified, onto, NULL));
	MR_TRY(measure_surface(ctx, &simplified, NULL, &figure));
	*bent = figure.bent;
	return MR_OK;
}

/* What the thinnest hundredth of body and gap measures, in spacings of `points` points. */
static mr_status
measure_thin(mr_ctx *ctx, const mr_mesh *m, size_t points, double *thin)
{
	mr_mark mark = mr_mark_take(ctx);
	double diagonal = mr_box_diagonal(mr_box_of(m->p, m->nv));
	double across[PROBES];
	mr_v3 *p, *normal;
	mr_ray_hit hit;
	mr_bvh *bvh;

	MR_TRY(mr_surface_sample(ctx, m, PROBES, 1, &p, &normal));
	mr_bvh_build(ctx, m, &bvh);
	for (size_t i = 0; i < PROBES; i++) {
		across[i] = diagonal;
		for (int side = -1; side <= 1; side += 2)
			if (mr_bvh_ray(bvh, p[i], mr_mul(side, normal[i]), 1e-6 * diagonal, across[i], &hit))
				across[i] = hit.t;
	}
	*thin = mr_kth(across, PROBES, PROBES / 100) / sqrt(mr_mesh_area(ctx, m) / (double)points);
	mr_mark_release(ctx, mark);
	return MR_OK;
}

static bool
same_topology(const mr_census *a, const mr_census *b)
{
	return a->euler == b->euler && a->components == b->components &&
	       a->boundary_loops == b->boundary_loops;
}

static void
print_census(const char *of, const mr_census *c)
{
	printf(",\"euler%s\":%lld,\"components%s\":%zu,\"loops%s\":%zu", of, (long long)c->euler, of,
	    c->components, of, c->boundary_loops);
}

static void
print_flaws(const char *of, const figures *f)
{
	printf(",\"faces%s\":%zu,\"folds%s\":%zu,\"pairs%s\":%zu", of, f->faces, of, f->census.folded_edges,
	    of, f->pairs);
}

/* ---- pictures ---- */

static mr_status
draw(mr_ctx *ctx, const char *path, const mr_mesh *truth, const mr_mesh *m, const bool *crosses, bool right)
{
	mr_rgb *harm = MR_NEW(ctx, m->nf, mr_rgb);
	mr_v3 *p = MR_NEW(ctx, m->nv, mr_v3);
	mr_box b = mr_box_of(truth->p, truth->nv);
	double far = FAR * mr_box_diagonal(b);
	mr_mesh upright = *m;
	mr_bvh *bvh;
	int axis[3];

	if (!harm || !p)
		return MR_EMEM;
	mr_bvh_build(ctx, truth, &bvh);
	for (size_t f = 0; f < m->nf; f++) {
		const uint32_t *v = m->t[f].v;
		mr_v3 middle = mr_mul(1. / 3, mr_add(m->p[v[0]], mr_add(m->p[v[1]], m->p[v[2]])));
		harm[f] = crosses[f] || mr_bvh_closest(bvh, middle).dist2 > far * far ? harmed : sound;
	}
	sort_axes(b, axis);
	for (size_t v = 0; v < m->nv; v++) {
		mr_v3 q = m->p[v], up = axis_vector(axis[2]), eye = axis_vector(axis[1]);
		p[v] = mr_vec(mr_dot(mr_cross(up, eye), q), mr_dot(up, q), mr_dot(eye, q));
	}
	upright.p = p;
	return write_picture(ctx, path, right ? "" : " WRONG", &upright, harm);
}

/* ---- all of it ---- */

static mr_status
judge(mr_ctx *ctx, char **argv)
{
	mr_mesh truth, points, result, control;
	mr_comparison surfaces, gap;
	figures of_truth, of_result, of_control;
	mr_frame *frame;
	bool *crosses;
	double thin, bent_simplified;

	MR_TRY(read_mesh(ctx, argv[0], &truth));
	MR_TRY(read_frame(ctx, argv[1], &frame));
	MR_TRY(mr_layer_surface_or_points(ctx, frame, "points", &points));
	MR_TRY(read_frame(ctx, argv[2], &frame));
	MR_TRY(mr_layer_mesh(ctx, frame, "mesh", &result));
	MR_TRY(mr_layer_mesh(
	    ctx, frame, mr_frame_find(frame, "control", "position") ? "control" : "mesh", &control));
	crosses = MR_NEW_ZERO(ctx, truth.nf + result.nf + control.nf, bool);
	if (!crosses)
		return MR_EMEM;
	MR_TRY(measure_surface(ctx, &truth, NULL, &of_truth));
	MR_TRY(measure_surface(ctx, &result, crosses, &of_result));
	MR_TRY(measure_surface(ctx, &control, NULL, &of_control));
	MR_TRY(measure_simplified(ctx, &truth, control.nf, &bent_simplified));
	MR_TRY(measure_thin(ctx, &truth, points.nv, &thin));
	MR_TRY(mr_compare(ctx, &truth, &result, &(mr_compare_opts)MR_COMPARE_DEFAULTS, &surfaces));
	MR_TRY(mr_compare(ctx, &points, &result, &(mr_compare_opts)MR_COMPARE_DEFAULTS, &gap));
	printf("{\"points\":%zu,\"right\":%d", points.nv, same_topology(&of_truth.census, &of_result.census));
	print_census("_truth", &of_truth.census);
	print_census("", &of_result.census);
	print_real("thin", thin);
	print_real("points_to_result_mean", gap.ab.mean / surfaces.diagonal);
	print_real("points_to_result_max", gap.ab.max / surfaces.diagonal);
	print_real("truth_to_result_mean", surfaces.ab.mean / surfaces.diagonal);
	print_real("truth_to_result_max", surfaces.ab.max / surfaces.diagonal);
	print_real("result_to_truth_mean", surfaces.ba.mean / surfaces.diagonal);
	print_real("result_to_truth_max", surfaces.ba.max / surfaces.diagonal);
	print_flaws("", &of_result);
	print_flaws("_control", &of_control);
	print_real("bent_control", of_control.bent);
	print_real("bent_simplified", bent_simplified);
	print_real("acute_control", of_control.acute);
	printf("}\n");
	return argv[3] ? draw(ctx, argv[3], &truth, &result, crosses,
			     same_topology(&of_truth.census, &of_result.census))
	               : MR_OK;
}

int
main(int argc, char **argv)
{
	bool making = argc == 7 && !strcmp(argv[1], "cloud");
	mr_ctx ctx;
	int failed = 1;

	if (!making && !((argc == 5 || argc == 6) && !strcmp(argv[1], "judge"))) {
		fprintf(stderr, "usage: scan_yardstick cloud KIND SEED MODEL POINTS TRUTH | judge TRUTH "
				"POINTS RESULT [PICTURE]\n");
		return 2;
	}
	mr_ctx_init(&ctx, 0);
	if ((making ? write_cloud(&ctx, argv + 2) : judge(&ctx, argv + 2)) < 0)
		fprintf(stderr, "scan_yardstick: %s\n", ctx.error);
	else
		failed = fflush(stdout) != 0;
	mr_ctx_free(&ctx);
	return failed;
}
