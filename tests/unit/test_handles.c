/* Affine poses: their algebra, shares of the way, scripts. */
#include "base/rotation.h"
#include "edit/handles.h"

#include <setjmp.h>
#include <stdarg.h>
#include <unistd.h>

#include <cmocka.h>

static const mr_v3 corners[4] = { { 0, 0, 0 }, { 2, 0, 0 }, { 0, 4, 0 }, { 1, 2, 6 } };

static double
apart(mr_affine a, mr_affine b)
{
	double most = 0;

	for (int i = 0; i < 12; i++)
		most = fmax(most, fabs(a.m[i] - b.m[i]));
	return most;
}

static mr_pose
pose_of(const char *translate, const char *rotate, const char *scale, const char *center)
{
	mr_pose p = MR_POSE_REST;
	mr_ctx ctx;

	mr_ctx_init(&ctx, 1);
	assert_int_equal(mr_pose_set(&ctx, &p, "translate", translate ? translate : "0,0,0"), MR_OK);
	assert_int_equal(mr_pose_set(&ctx, &p, "rotate", rotate ? rotate : "0,0,1,0"), MR_OK);
	assert_int_equal(mr_pose_set(&ctx, &p, "scale", scale ? scale : "1"), MR_OK);
	assert_true(!center || mr_pose_set(&ctx, &p, "center", center) == MR_OK);
	mr_ctx_free(&ctx);
	return p;
}

/* Scales, then turns, then moves, about the centre. */
static void
maps_points_as_it_says(void **state)
{
	mr_pose p = pose_of("1,2,3", "0,0,5,90", "2,3,4", NULL);
	mr_affine t = mr_pose_map(&p, mr_vec(10, 0, 0), 1);
	mr_v3 x = mr_apply(
	    &t, mr_vec(11, 1, 1)); /* (1, 1, 1) -> (2, 3, 4) -> (-3, 2, 4) -> + 10 0 0 + 1 2 3 */

	(void)state;
	assert_true(mr_dist(x, mr_vec(8, 4, 7)) < 1e-14);
	x = mr_apply(&t, mr_vec(10, 0, 0));
	assert_true(mr_dist(x, mr_vec(11, 2, 3)) < 1e-14);
}

static void
rest_is_the_identity_exactly(void **state)
{
	mr_pose p = pose_of("0.1,0.2,0.3", "1,2,3,77", "1.1,0.7,2", NULL), rest = MR_POSE_REST;
	mr_affine id = mr_identity(), a = mr_pose_map(&p, mr_vec(0.1, -7e5, 3.3), 0),
		  b = mr_pose_map(&rest, mr_vec(0.1, -7e5, 3.3), 1);

	(void)state;
	assert_true(apart(a, id) == 0);
	assert_true(apart(b, id) == 0);
}

static void
shares_of_the_way_add_up(void **state)
{
	mr_pose p = pose_of("0,0,3", "0,0,1,50", "8", "0,0,0");
	mr_affine third, all = mr_pose_map(&p, p.center, 1), sum;

	(void)state;
	third = mr_pose_map(&p, p.center, 1.0 / 3);
	sum = mr_compose(&third, &third);
	sum = mr_compose(&third, &sum);
	assert_true(fabs(sum.m[0] - all.m[0]) < 1e-14 && fabs(sum.m[1] - all.m[1]) < 1e-14);
	assert_true(fabs(third.m[10] - 2) < 1e-15 && fabs(third.m[11] - 1) < 1e-15);
}

static mr_handles
handles_of(mr_ctx *ctx, const uint32_t *region)
{
	const mr_mesh m = { .name = "mesh", .p = corners, .nv = 4 };
	mr_handles h;

	assert_int_equal(mr_handles_find(ctx, &m, region, &h), MR_OK);
	return h;
}

/* As many handles, at rest; of one test at a time. */
static mr_handle_rows
at_rest(size_t n)
{
	static mr_affine map[3];
	static mr_v3 turn[3];

	for (size_t i = 0; i < 3; i++) {
		map[i] = mr_identity();
		turn[i] = mr_vec(0, 0, 0);
	}
	return (mr_handle_rows){ n, map, turn };
}

static void
handles_are_found(void **state)
{
	const uint32_t region[4] = { 2, 2, 1, 4 }, none[4] = { 0, 1, 0, 1 };
	const mr_mesh m = { .name = "mesh", .p = corners, .nv = 4 };
	mr_pose p = pose_of("1,0,0", NULL, NULL, NULL);
	mr_handle_rows row = at_rest(3);
	mr_ctx ctx;
	mr_handles h;

	(void)state;
	mr_ctx_init(&ctx, 1);
	h = handles_of(&ctx, region);
	assert_int_equal(h.n, 3);
	assert_int_equal(h.count[0], 2);
	assert_true(mr_dist(h.centroid[0], mr_vec(1, 0, 0)) == 0);
	assert_true(mr_dist(h.centroid[2], corners[3]) == 0);
	assert_int_equal(mr_handles_pose(&ctx, &h, 1, &p, 1, &row), MR_EMISSING);
	assert_string_equal(ctx.error, "no vertex is in handle 1; handles in use: 0, 2");
	assert_int_equal(mr_handles_pose(&ctx, &h, 3, &p, 1, &row), MR_EMISSING);
	assert_int_equal(mr_handles_find(&ctx, &m, none, &h), MR_EMISSING);
	assert_string_equal(ctx.error, "no vertex of mesh is in a handle");
	mr_ctx_free(&ctx);
}

/* Moving, then turning where it has come to: the same as both at once. */
static void
two_poses_compose(void **state)
{
	const uint32_t region[4] = { 2, 2, 2, 2 };
	const mr_pose move = pose_of("3,1,4", NULL, NULL, NULL),
		      turn = pose_of(NULL, "1,1,0,33", "1.5", NULL),
		      both = pose_of("3,1,4", "1,1,0,33", "1.5", NULL),
		      about = pose_of("1,0,0", "0,1,0,20", NULL, "5,5,5");
	mr_handle_rows row = at_rest(1);
	mr_affine a, b, t;
	mr_ctx ctx;
	mr_handles h;

	(void)state;
	mr_ctx_init(&ctx, 1);
	h = handles_of(&ctx, region);
	assert_int_equal(mr_handles_pose(&ctx, &h, 0, &both, 1, &row), MR_OK);
	b = row.map[0];
	row = at_rest(1);
	assert_int_equal(mr_handles_pose(&ctx, &h, 0, &move, 1, &row), MR_OK);
	assert_int_equal(mr_handles_pose(&ctx, &h, 0, &turn, 1, &row), MR_OK);
	a = row.map[0];
	assert_true(apart(a, b) < 1e-14);
	assert_int_equal(mr_handles_pose(&ctx, &h, 0, &about, 1, &row), MR_OK);
	t = mr_pose_map(&about, mr_vec(5, 5, 5), 1);
	assert_true(apart(row.map[0], mr_compose(&t, &a)) == 0);
	mr_ctx_free(&ctx);
}

/* Turns about one axis add up, and a quarter turn about another is on top of that; scales do not turn. */
static void
turns_are_counted(void **state)
{
	const uint32_t region[4] = { 2, 2, 2, 2 };
	const mr_pose turn = pose_of(NULL, "0,0,2,150", "1,2,3", NULL),
		      back = pose_of(NULL, "0,0,1,-600", "0.5", NULL),
		      over = pose_of(NULL, "1,0,0,90", NULL, NULL);
	mr_handle_rows row = at_rest(1);
	mr_mat3 r, sum, map;
	mr_ctx ctx;
	mr_handles h;

	(void)state;
	mr_ctx_init(&ctx, 1);
	h = handles_of(&ctx, region);
	for (int i = 1; i <= 5; i++) {
		const mr_pose plain = pose_of(NULL, "0,0,1,150", NULL, NULL);
		assert_int_equal(mr_handles_pose(&ctx, &h, 0, i == 1 ? &turn : &plain, 1, &row), MR_OK);
		assert_true(mr_dist(row.turn[0], mr_vec(0, 0, i * 150 * MR_PI / 180)) < 1e-12);
	}
	assert_int_equal(mr_handles_pose(&ctx, &h, 0, &back, 0.5, &row), MR_OK);
	assert_true(mr_dist(row.turn[0], mr_vec(0, 0, 450 * MR_PI / 180)) < 1e-12);
	row.map[0] = mr_pose_map(&turn, mr_vec(0, 0, 0), 3);
	row.turn[0] = mr_vec(0, 0, 450 * MR_PI / 180);
	assert_int_equal(mr_handles_pose(&ctx, &h, 0, &over, 1, &row), MR_OK);
	r = mr_rotation_exp(row.turn[0]);
	map = mr_affine_linear(&row.map[0]);
	sum = mr_rotation_nearest(&map);
	sum = mr_mat3_axpy(-1, &r, &sum);
	for (int i = 0; i < 9; i++)
		assert_true(fabs(sum.m[i]) < 1e-12);
	assert_true(mr_norm(row.turn[0]) > 2 * MR_PI);
	mr_ctx_free(&ctx);
}

static void
wrong_poses_are_refused(void **state)
{
	static const char *const wrong[][2] = { { "translate", "1,2" }, { "translate", "1,2,3,4" },
		{ "translate", "1,2,x" }, { "translate", "" }, { "rotate", "0,0,0,5" }, { "rotate", "1,0,0" },
		{ "scale", "1,2" }, { "scale", "nan" }, { "scale", "" }, { "center", "1" }, { "size", "1" } };
	mr_pose p = MR_POSE_REST, flat = pose_of(NULL, NULL, "1,0,1", NULL);
	mr_ctx ctx;

	(void)state;
	mr_ctx_init(&ctx, 1);
	for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
		if (mr_pose_set(&ctx, &p, wrong[i][0], wrong[i][1]) != MR_EUSAGE)
			fail_msg("%s %s is taken", wrong[i][0], wrong[i][1]);
	assert_int_equal(mr_pose_check_shares(&ctx, &p), MR_OK);
	assert_int_equal(mr_pose_check_shares(&ctx, &flat), MR_EUSAGE);
	mr_ctx_free(&ctx);
}

static mr_status
read_script(mr_ctx *ctx, const char *text, mr_script *script)
{
	char path[] = "/tmp/mr-test-XXXXXX";
	int fd = mkstemp(path);
	mr_status status;

	assert_true(fd >= 0 && write(fd, text, strlen(text)) == (ssize_t)strlen(text));
	close(fd);
	status = mr_script_read(ctx, path, script);
	remove(path);
	return status;
}

static void
scripts_pose_frame_by_frame(void **state)
{
	const uint32_t region[4] = { 2, 3, 3, 3 };
	const char *text = "# two handles\nframe\n0 translate=0,0,1\n\n1\tscale=2,1,1 center=0,0,0 # wide\r\n"
			   "frame # at rest\nframe\n0 translate=0,0,2\n0 translate=5,0,0";
	mr_handle_rows row;
	mr_script s;
	mr_handles h;
	mr_ctx ctx;

	(void)state;
	mr_ctx_init(&ctx, 1);
	h = handles_of(&ctx, region);
	assert_int_equal(read_script(&ctx, text, &s), MR_OK);
	assert_int_equal(s.frames, 3);
	const double expected[5][3] = { { 0, 0, 1 }, { 0, 1, 2 }, { 0, 0, 1 }, { 5, 2, 1 }, { 5, 2, 1 } };
	for (size_t frame = 0; frame < 5; frame++) { /* x and z of handle 0, width of handle 1 */
		row = at_rest(2);
		assert_int_equal(mr_script_pose(&ctx, &h, &s, frame, &row), MR_OK);
		assert_true(row.map[0].m[3] == expected[frame][0] && row.map[0].m[11] == expected[frame][1]);
		assert_true(row.map[1].m[0] == expected[frame][2]);
	}
	mr_ctx_free(&ctx);
}

static void
wrong_scripts_are_refused(void **state)
{
	static const char *const wrong[][2] = { { "", "the script has no frame" },
		{ "0 scale=1\nframe\n", ":1: no frame has begun" },
		{ "frame\nframe 2\n", ":2: 'frame' is neither a handle nor the word frame" },
		{ "frame\n0 scale\n", ":2: 'scale' is not of the form what=value" },
		{ "frame\n\n0 scale=1,2\n", ":3: '1,2' is not one factor" },
		{ "frame\n-1 scale=1\n", ":2: '-1' is neither" },
		{ "frame\n0 size=1\n", ":2: 'size' is none of" } };
	mr_script s;
	mr_ctx ctx;

	(void)state;
	mr_ctx_init(&ctx, 1);
	for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
		assert_int_equal(read_script(&ctx, wrong[i][0], &s), MR_EFORMAT);
		if (!strstr(ctx.error, wrong[i][1]))
			fail_msg("%s does not say %s", ctx.error, wrong[i][1]);
	}
	assert_int_equal(mr_script_read(&ctx, "/no/such/script", &s), MR_EIO);
	assert_int_equal(mr_script_read(&ctx, "/", &s), MR_EIO);
	mr_ctx_free(&ctx);
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(maps_points_as_it_says),
		cmocka_unit_test(rest_is_the_identity_exactly),
		cmocka_unit_test(shares_of_the_way_add_up),
		cmocka_unit_test(handles_are_found),
		cmocka_unit_test(two_poses_compose),
		cmocka_unit_test(turns_are_counted),
		cmocka_unit_test(wrong_poses_are_refused),
		cmocka_unit_test(scripts_pose_frame_by_frame),
		cmocka_unit_test(wrong_scripts_are_refused),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
