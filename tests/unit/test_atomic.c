/* What fails for want of memory, wherever that is, changes neither its frame nor its result, and does as ever
 * behind that. */
#include "base/ctx.h"
#include "stream/frame.h"

#include <math.h>
#include <setjmp.h>

#include <cmocka.h>

enum { RESULT_BYTES = 2048 };

typedef mr_status (*operation)(mr_ctx *ctx, mr_frame *f, void *result);

/* ---- what is done to a frame, one after another ---- */

static mr_status
smooth(mr_ctx *ctx, mr_frame *f, void *result)
{
	return mr_smooth_frame(ctx, f, NULL, result);
}

static mr_status
remesh(mr_ctx *ctx, mr_frame *f, void *result)
{
	return mr_remesh_frame(ctx, f, NULL, result);
}

static mr_status
choose(mr_ctx *ctx, mr_frame *f, void *result)
{
	static const mr_rule rules[] = { { MR_REGION_FREE, "all" }, { MR_REGION_FIXED, "below:y,0.4" },
		{ MR_REGION_HANDLE, "above:y,0.8" } };

	return mr_select_frame(ctx, f, rules, 3, NULL, result);
}

static mr_status
solve_basis(mr_ctx *ctx, mr_frame *f, void *result)
{
	mr_solve_opts o = MR_SOLVE_DEFAULTS;

	o.basis = true;
	return mr_solve_frame(ctx, f, &o, NULL, result);
}

static mr_status
encode(mr_ctx *ctx, mr_frame *f, void *result)
{
	return mr_encode_frame(ctx, f, result);
}

static mr_status
pose(mr_ctx *ctx, mr_frame *f, void *result)
{
	mr_pose turned = MR_POSE_REST;

	(void)result;
	turned.degrees = 30;
	return mr_pose_frame(ctx, f, NULL, 0, &turned);
}

static mr_status
solve(mr_ctx *ctx, mr_frame *f, void *result)
{
	return mr_solve_frame(ctx, f, NULL, NULL, result);
}

static mr_status
decode(mr_ctx *ctx, mr_frame *f, void *result)
{
	(void)result;
	return mr_decode_frame(ctx, f, NULL, NULL);
}

static mr_status
subdivide(mr_ctx *ctx, mr_frame *f, void *result)
{
	return mr_subdivide_frame(ctx, f, NULL, NULL, result);
}

static mr_status
turn(mr_ctx *ctx, mr_frame *f, void *result)
{
	static const double map[12] = { 0, -1, 0, 1, 1, 0, 0, 2, 0, 0, 1, 3 };

	(void)result;
	return mr_transform_frame(ctx, f, NULL, map);
}

static mr_status
normals(mr_ctx *ctx, mr_frame *f, void *result)
{
	return mr_normals_frame(ctx, f, NULL, result);
}

static mr_status
crop(mr_ctx *ctx, mr_frame *f, void *result)
{
	static const mr_rule upper = { MR_REGION_FREE, "above:y,0.3" };

	return mr_crop_frame(ctx, f, "mesh", &upper, 1, result);
}

static mr_status
shrinkwrap(mr_ctx *ctx, mr_frame *f, void *result)
{
	return mr_shrinkwrap_frame(ctx, f, NULL, result);
}

static mr_status
simplify(mr_ctx *ctx, mr_frame *f, void *result)
{
	return mr_simplify_frame(ctx, f, NULL, result);
}

static mr_status
simplify_mesh(mr_ctx *ctx, mr_frame *f, void *result)
{
	mr_simplify_opts o = MR_SIMPLIFY_DEFAULTS;

	o.layer = "mesh";
	return mr_simplify_frame(ctx, f, &o, result);
}

static mr_status
fit(mr_ctx *ctx, mr_frame *f, void *result)
{
	return mr_fit_frame(ctx, f, NULL, result);
}

static mr_status
sample(mr_ctx *ctx, mr_frame *f, void *result)
{
	return mr_sample_frame(ctx, f, NULL, result);
}

static mr_status
equalize(mr_ctx *ctx, mr_frame *f, void *result)
{
	static const double gain[] = { 1, 2 };

	(void)result;
	return mr_equalize_frame(ctx, f, gain, 2, NULL);
}

/* ---- what it is to be ---- */

/* The columns of a frame, as they are listed, and where their values lie. */
typedef struct listing {
	mr_column column[64];
	size_t count;
} listing;

static void
list(mr_ctx *ctx, mr_frame *f, listing *l)
{
	assert_true(f->count <= 64);
	for (size_t i = 0; i < f->count; i++)
		assert_int_equal(mr_column_decode(ctx, &f->columns[i]), MR_OK);
	l->count = f->count;
	memcpy(l->column, f->columns, f->count * sizeof *l->column);
}

static void
assert_listed(const mr_frame *f, const listing *l)
{
	assert_int_equal(f->count, l->count);
	for (size_t i = 0; i < l->count; i++) {
		assert_string_equal(f->columns[i].layer, l->column[i].layer);
		assert_string_equal(f->columns[i].name, l->column[i].name);
		assert_int_equal(f->columns[i].rows, l->column[i].rows);
		assert_ptr_equal(f->columns[i].data, l->column[i].data);
	}
}

static void
assert_same(mr_ctx *ctx, mr_frame *a, mr_frame *b)
{
	listing l, m;

	list(ctx, a, &l);
	list(ctx, b, &m);
	assert_int_equal(l.count, m.count);
	for (size_t i = 0; i < l.count; i++) {
		const mr_column *c = &l.column[i], *d = &m.column[i];
		assert_string_equal(c->name, d->name);
		assert_int_equal(c->rows, d->rows);
		assert_memory_equal(
		    c->data, d->data, c->rows * c->shape.components * mr_type_size(c->shape.type));
	}
}

/*
 * Each allocation up to the 32nd fails, then fewer and fewer of them.  What does without one makes what is
 * made with it.
 */
static void
starve(mr_ctx *ctx, mr_frame *f, operation run, mr_frame *made)
{
	unsigned char result[RESULT_BYTES], untouched[RESULT_BYTES];
	listing before;
	mr_frame kept;

	memset(untouched, 0xa5, sizeof untouched);
	list(ctx, f, &before);
	mr_frame_copy(ctx, f, &kept);
	for (uint64_t k = 1;; k += 1 + k / 32) {
		mr_mark mark = mr_mark_take(ctx);
		mr_status status;
		memset(result, 0xa5, sizeof result);
		ctx->fail_at = k;
		*ctx->error = '\0';
		status = run(ctx, f, result);
		if (status == MR_OK)
			assert_same(ctx, f, made);
		if (ctx->fail_at > 0)
			break;
		if (status == MR_OK) {
			*f = kept;
		} else {
			assert_int_equal(status, MR_EMEM);
			assert_non_null(strstr(mr_error(ctx), "memory"));
			assert_listed(f, &before);
			assert_memory_equal(result, untouched, sizeof result);
		}
		mr_mark_release(ctx, mark);
	}
	ctx->fail_at = 0;
}

/* n operations, each with failures before it, make the frame that they make without. */
static void
check(const mr_make_opts *o, const operation *run, size_t n)
{
	mr_ctx *ctx = mr_ctx_new(1);
	unsigned char result[RESULT_BYTES];
	mr_frame *starved, *fed;

	assert_non_null(ctx);
	assert_int_equal(mr_make(ctx, o, &starved), MR_OK);
	assert_int_equal(mr_make(ctx, o, &fed), MR_OK);
	for (size_t i = 0; i < n; i++) {
		assert_int_equal(run[i](ctx, fed, result), MR_OK);
		starve(ctx, starved, run[i], fed);
	}
	mr_ctx_delete(ctx);
}

static void
editing(void **state)
{
	static const operation run[] = { smooth, remesh, choose, solve_basis, encode, pose, solve, decode,
		turn, normals, subdivide, simplify_mesh, crop };
	mr_make_opts o = MR_MAKE_DEFAULTS;

	(void)state;
	o.solid = MR_SPHERE;
	o.vertices = 400;
	check(&o, run, sizeof run / sizeof *run);
}

static void
reconstruction(void **state)
{
	static const operation run[] = { normals, shrinkwrap, simplify, fit, sample, equalize, choose, pose,
		solve, decode, subdivide };
	mr_make_opts o = MR_MAKE_DEFAULTS;

	(void)state;
	o.solid = MR_TORUS;
	o.points = 1000;
	check(&o, run, sizeof run / sizeof *run);
}

int
main(void)
{
	static const struct CMUnitTest tests[] = { cmocka_unit_test(editing),
		cmocka_unit_test(reconstruction) };

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
