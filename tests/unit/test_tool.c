/* The functions of mr.h against the tools' own: one frame, without a stream. */
#include "base/vec.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

static mr_frame *
creature(mr_ctx *ctx)
{
	mr_make_opts o = MR_MAKE_DEFAULTS;
	mr_frame *f;

	o.solid = MR_BUMPY;
	o.vertices = 3000;
	assert_int_equal(mr_make(ctx, &o, &f), MR_OK);
	return f;
}

static mr_ctx *
context(void)
{
	mr_ctx *ctx = mr_ctx_new(2);

	assert_non_null(ctx);
	return ctx;
}

/* Regions, base and detail: up to where poses begin. */
static void
prepare(mr_ctx *ctx, mr_frame *f, bool basis)
{
	static const mr_rule rules[] = { { MR_REGION_FREE, "all" }, { MR_REGION_FIXED, "below:y,0.4" },
		{ MR_REGION_HANDLE, "above:y,0.8" } };
	mr_solve_opts solve = MR_SOLVE_DEFAULTS;

	solve.basis = basis;
	assert_int_equal(mr_smooth_frame(ctx, f, NULL, NULL), MR_OK);
	assert_int_equal(mr_remesh_frame(ctx, f, NULL, NULL), MR_OK);
	assert_int_equal(mr_select_frame(ctx, f, rules, 3, NULL, NULL), MR_OK);
	assert_int_equal(mr_solve_frame(ctx, f, &solve, NULL, NULL), MR_OK);
	assert_int_equal(mr_encode_frame(ctx, f, NULL), MR_OK);
}

/* Where the vertices of mesh are, copied. */
static mr_v3 *
positions(mr_ctx *ctx, mr_frame *f, size_t *n)
{
	mr_mesh m;
	mr_v3 *p;

	assert_int_equal(mr_layer_mesh(ctx, f, "mesh", &m), MR_OK);
	p = MR_NEW(ctx, m.nv, mr_v3);
	assert_non_null(p);
	memcpy(p, m.p, m.nv * sizeof *p);
	*n = m.nv;
	return p;
}

/* A pose by the responses is the linear pose by a solve, and the identity returns every vertex. */
static void
test_basis_and_solve_agree(void **state)
{
	mr_ctx *ctx = context();
	mr_frame *a = creature(ctx), *b = creature(ctx);
	mr_pose pose = MR_POSE_REST;
	mr_solve_opts linear = MR_SOLVE_DEFAULTS;
	mr_v3 *p, *q, *rest;
	double most = 0;
	size_t n;

	(void)state;
	rest = positions(ctx, a, &n);
	prepare(ctx, a, false);
	prepare(ctx, b, true);
	assert_int_equal(mr_decode_frame(ctx, a, NULL, NULL), MR_OK);
	p = positions(ctx, a, &n);
	for (size_t i = 0; i < n; i++)
		most = fmax(
		    most, fabs(p[i].x - rest[i].x) + fabs(p[i].y - rest[i].y) + fabs(p[i].z - rest[i].z));
	assert_true(most < 1e-12);

	pose.degrees = 40;
	assert_int_equal(mr_pose_frame(ctx, a, NULL, 0, &pose), MR_OK);
	linear.rotations = MR_ROTATIONS_LINEAR;
	assert_int_equal(mr_solve_frame(ctx, a, &linear, NULL, NULL), MR_OK);
	assert_int_equal(mr_pose_frame(ctx, b, NULL, 0, &pose), MR_OK);
	assert_int_equal(mr_decode_frame(ctx, a, NULL, NULL), MR_OK);
	assert_int_equal(mr_decode_frame(ctx, b, NULL, NULL), MR_OK);
	p = positions(ctx, a, &n);
	q = positions(ctx, b, &n);
	most = 0;
	for (size_t i = 0; i < n; i++)
		most = fmax(most, fabs(p[i].x - q[i].x) + fabs(p[i].y - q[i].y) + fabs(p[i].z - q[i].z));
	assert_true(most < 1e-9);
	mr_ctx_delete(ctx);
}

/* A cache serves frames that are no deltas of one another, one after another, with the bytes of none. */
static void
test_cache_changes_nothing(void **state)
{
	mr_ctx *ctx = context();
	mr_cache *cache = mr_cache_new();
	mr_subdivide_opts o = MR_SUBDIVIDE_DEFAULTS;

	(void)state;
	assert_non_null(cache);
	for (o.level = 1; o.level < 3; o.level++) {
		mr_frame *a = creature(ctx), *b = creature(ctx);
		mr_subdivide_result result;
		mr_v3 *p, *q;
		size_t n, m;
		assert_int_equal(mr_subdivide_frame(ctx, a, &o, cache, &result), MR_OK);
		assert_int_equal(mr_subdivide_frame(ctx, b, &o, NULL, NULL), MR_OK);
		p = positions(ctx, a, &n);
		q = positions(ctx, b, &m);
		assert_int_equal(n, m);
		assert_int_equal(result.vertices, n);
		assert_memory_equal(p, q, n * sizeof *p);
	}
	mr_cache_delete(cache);
	mr_ctx_delete(ctx);
}

static void
count(void *user, const char *text)
{
	assert_true(*text);
	++*(size_t *)user;
}

/* What fails says why and leaves the frame; who listens hears; columns can be listed. */
static void
test_sentences_notes_and_columns(void **state)
{
	mr_ctx *ctx = context();
	mr_frame *f = creature(ctx);
	size_t notes = 0, columns = 0;
	const char *layer, *name;
	mr_shape shape;
	uint64_t rows;

	(void)state;
	assert_string_equal(mr_error(ctx), "");
	assert_int_equal(mr_encode_frame(ctx, f, NULL), MR_EMISSING);
	assert_non_null(strstr(mr_error(ctx), "base"));
	mr_listen(ctx, &(mr_listener){ .note = count, .user = &notes });
	prepare(ctx, f, false);
	assert_true(notes > 0);
	while (mr_frame_column(f, columns, &layer, &name, &shape, &rows)) {
		assert_true(mr_layer_has(f, layer, name));
		columns++;
	}
	assert_true(columns > 8);
	assert_false(mr_frame_column(f, columns, NULL, NULL, NULL, NULL));
	assert_string_equal(mr_frame_name(f), "bumpy");
	mr_ctx_delete(ctx);
	mr_ctx_delete(NULL);
	mr_cache_delete(NULL);
}

/* Options that contradict each other are usage, with or without a cache. */
static void
test_wrong_options(void **state)
{
	mr_ctx *ctx = context();
	mr_frame *f = creature(ctx);
	mr_solve_opts solve = MR_SOLVE_DEFAULTS;
	mr_rule rule = { MR_REGION_FREE, "abov:y,1" };

	(void)state;
	solve.basis = true;
	solve.arap = 2;
	assert_int_equal(mr_solve_frame(ctx, f, &solve, NULL, NULL), MR_EUSAGE);
	assert_int_equal(mr_select_frame(ctx, f, &rule, 1, NULL, NULL), MR_EUSAGE);
	assert_int_equal(mr_export(ctx, f, NULL, "model.unknown", NULL), MR_EUSAGE);
	mr_ctx_delete(ctx);
}

/* What the tools' command lines refuse is refused of a program too, and changes nothing. */
static void
test_options_that_cannot_be(void **state)
{
	static const double flat[12] = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0 };
	static const mr_rule beyond = { MR_REGION_HANDLE + 65536, "all" };
	static const double gain = NAN;
	mr_ctx *ctx = context();
	mr_frame *f = creature(ctx);
	mr_smooth_opts smooth = MR_SMOOTH_DEFAULTS;
	mr_remesh_opts remesh = MR_REMESH_DEFAULTS;
	mr_subdivide_opts subdivide = MR_SUBDIVIDE_DEFAULTS;
	mr_simplify_opts simplify = MR_SIMPLIFY_DEFAULTS;
	mr_solve_opts solve = MR_SOLVE_DEFAULTS;
	mr_decode_opts decode = MR_DECODE_DEFAULTS;
	mr_wrap_opts wrap = MR_WRAP_DEFAULTS;
	mr_render_opts render = MR_RENDER_DEFAULTS;
	mr_make_opts make = MR_MAKE_DEFAULTS;
	mr_pose pose = MR_POSE_REST;
	mr_frame *none = NULL;

	(void)state;
	smooth.method = MR_SMOOTH_TAUBIN + 1;
	assert_int_equal(mr_smooth_frame(ctx, f, &smooth, NULL), MR_EUSAGE);
	assert_string_equal(mr_error(ctx), "method is 2, where 0 to 1 can be");
	smooth = (mr_smooth_opts)MR_SMOOTH_DEFAULTS;
	smooth.time = NAN;
	assert_int_equal(mr_smooth_frame(ctx, f, &smooth, NULL), MR_EUSAGE);
	remesh.length = -1;
	assert_int_equal(mr_remesh_frame(ctx, f, &remesh, NULL), MR_EUSAGE);
	subdivide.level = MR_LEVEL_MAX + 1;
	assert_int_equal(mr_subdivide_frame(ctx, f, &subdivide, NULL, NULL), MR_EUSAGE);
	simplify.ratio = 2;
	assert_int_equal(mr_simplify_frame(ctx, f, &simplify, NULL), MR_EUSAGE);
	assert_int_equal(mr_transform_frame(ctx, f, NULL, flat), MR_EUSAGE);
	assert_int_equal(mr_select_frame(ctx, f, &beyond, 1, NULL, NULL), MR_EUSAGE);
	prepare(ctx, f, false);
	pose.translate.x = INFINITY;
	assert_int_equal(mr_pose_frame(ctx, f, NULL, 0, &pose), MR_EUSAGE);
	pose = (mr_pose)MR_POSE_REST;
	pose.degrees = 30;
	pose.axis.z = 0;
	assert_int_equal(mr_pose_frame(ctx, f, NULL, 0, &pose), MR_EUSAGE);
	assert_false(mr_frame_has_layer(f, "handles"));
	solve.order = 0;
	assert_int_equal(mr_solve_frame(ctx, f, &solve, NULL, NULL), MR_EUSAGE);
	decode.gain = INFINITY;
	assert_int_equal(mr_decode_frame(ctx, f, &decode, NULL), MR_EUSAGE);
	render.width = 0;
	assert_int_equal(mr_render(ctx, f, &render, "no.png"), MR_EUSAGE);
	make.noise = NAN;
	assert_int_equal(mr_make(ctx, &make, &none), MR_EUSAGE);
	assert_null(none);
	make = (mr_make_opts)MR_MAKE_DEFAULTS;
	make.points = 500;
	assert_int_equal(mr_make(ctx, &make, &f), MR_OK);
	wrap.alpha = 2;
	assert_int_equal(mr_shrinkwrap_frame(ctx, f, &wrap, NULL), MR_EUSAGE);
	assert_int_equal(mr_shrinkwrap_frame(ctx, f, NULL, NULL), MR_OK);
	assert_int_equal(mr_simplify_frame(ctx, f, NULL, NULL), MR_OK);
	assert_int_equal(mr_sample_frame(ctx, f, NULL, NULL), MR_OK);
	assert_int_equal(mr_equalize_frame(ctx, f, &gain, 1, NULL), MR_EUSAGE);
	mr_ctx_delete(ctx);
}

/* NULL is the defaults of what compares, too, and a listener that is none; what was not looked for has no
 * number. */
static void
test_defaults_and_nobody(void **state)
{
	mr_ctx *ctx = context();
	mr_frame *f = creature(ctx);
	mr_surface_figures figures;
	mr_comparison c;
	mr_mesh m;

	(void)state;
	mr_listen(ctx, NULL);
	assert_int_equal(mr_layer_mesh(ctx, f, "mesh", &m), MR_OK);
	assert_int_equal(mr_compare(ctx, &m, &m, NULL, &c), MR_OK);
	assert_true(c.corresponds && c.both.max <= 1e-15);
	assert_int_equal(mr_measure_surface(ctx, &m, false, &figures), MR_OK);
	assert_int_equal(figures.intersections, MR_UNKNOWN);
	assert_int_equal(mr_measure_surface(ctx, &m, true, &figures), MR_OK);
	assert_int_equal(figures.intersections, 0);
	mr_ctx_delete(ctx);
}

/* A scan of a torus becomes one again: what each step says of itself is what measuring says of it. */
static void
test_results_agree_with_measures(void **state)
{
	enum { POINTS = 4000 };
	mr_ctx *ctx = context();
	mr_make_opts o = MR_MAKE_DEFAULTS;
	mr_surface_figures figures;
	mr_sample_result sampled;
	mr_cloud_figures cloud;
	mr_wrap_result wrapped;
	mr_fit_result fitted;
	mr_frame *f;
	mr_mesh m;

	(void)state;
	o.solid = MR_TORUS;
	o.points = POINTS;
	assert_int_equal(mr_make(ctx, &o, &f), MR_OK);
	assert_int_equal(mr_measure_cloud(ctx, f, "points", &cloud), MR_OK);
	assert_int_equal(cloud.places, POINTS);

	assert_int_equal(mr_shrinkwrap_frame(ctx, f, NULL, &wrapped), MR_OK);
	assert_int_equal(mr_layer_mesh(ctx, f, "control", &m), MR_OK);
	assert_int_equal(mr_measure_surface(ctx, &m, true, &figures), MR_OK);
	assert_int_equal(figures.census.genus, 1);
	assert_int_equal(figures.census.folded_edges, wrapped.folded_edges);
	assert_int_equal(figures.intersections, wrapped.intersecting_pairs);
	assert_int_equal(m.nf, wrapped.faces);
	assert_int_equal(cloud.places, wrapped.places);
	assert_int_equal(cloud.outliers, wrapped.outliers);
	assert_true(cloud.usual == wrapped.sampling);
	assert_true(wrapped.resolution == MR_UNKNOWN);

	assert_int_equal(mr_simplify_frame(ctx, f, NULL, NULL), MR_OK);
	assert_int_equal(mr_fit_frame(ctx, f, NULL, &fitted), MR_OK);
	assert_true(fitted.distance_rms_after < fitted.distance_rms_before);
	assert_int_equal(mr_sample_frame(ctx, f, NULL, &sampled), MR_OK);
	assert_int_equal(mr_decode_frame(ctx, f, NULL, NULL), MR_OK);
	assert_int_equal(mr_layer_mesh(ctx, f, "mesh", &m), MR_OK);
	assert_int_equal(m.nv, sampled.vertices);
	mr_ctx_delete(ctx);
}

/* What is kept is above, and all of it; rules that keep nothing or are none are refused. */
static void
test_crop_keeps_what_is_chosen(void **state)
{
	static const mr_rule upper = { MR_REGION_FREE, "above:y,0.5" }, none = { MR_REGION_FIXED, "all" };
	mr_ctx *ctx = context();
	mr_frame *f = creature(ctx);
	mr_crop_result r;
	double low = INFINITY, high = -INFINITY;
	size_t n, left, above = 0;
	mr_v3 *p = positions(ctx, f, &n), *q;

	(void)state;
	for (size_t v = 0; v < n; v++) {
		low = fmin(low, p[v].y);
		high = fmax(high, p[v].y);
	}
	for (size_t v = 0; v < n; v++)
		above += p[v].y >= (low + high) / 2;
	assert_int_equal(mr_crop_frame(ctx, f, NULL, NULL, 0, &r), MR_EUSAGE);
	assert_int_equal(mr_crop_frame(ctx, f, NULL, &none, 1, &r), MR_EMESH);
	assert_int_equal(mr_crop_frame(ctx, f, NULL, &upper, 1, &r), MR_OK);
	q = positions(ctx, f, &left);
	assert_int_equal(left, r.vertices);
	assert_int_equal(left + r.vertices_dropped, n);
	assert_true(left <= above && left > above * 9 / 10); /* but for those without a face that is left */
	for (size_t v = 0; v < left; v++)
		assert_true(q[v].y >= (low + high) / 2);
	mr_ctx_delete(ctx);
}

int
main(void)
{
	static const struct CMUnitTest tests[] = { cmocka_unit_test(test_basis_and_solve_agree),
		cmocka_unit_test(test_cache_changes_nothing),
		cmocka_unit_test(test_sentences_notes_and_columns), cmocka_unit_test(test_wrong_options),
		cmocka_unit_test(test_options_that_cannot_be), cmocka_unit_test(test_defaults_and_nobody),
		cmocka_unit_test(test_results_agree_with_measures),
		cmocka_unit_test(test_crop_keeps_what_is_chosen) };

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
