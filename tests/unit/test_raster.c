/* Pictures: what covers which pixels, what hides what, and that nothing depends on threads. */
#include "render/raster_parts.h"
#include "shape/shape.h"

#include <setjmp.h>

#include <cmocka.h>

static mr_ctx ctx;
static const mr_rgb paper = { 255, 255, 255 };

static int
setup(void **state)
{
	(void)state;
	mr_ctx_init(&ctx, 2);
	return 0;
}

static int
teardown(void **state)
{
	(void)state;
	mr_ctx_free(&ctx);
	return 0;
}

static mr_mesh
made(mr_solid solid, size_t n)
{
	mr_mesh m;

	assert_int_equal(mr_solid_make(&ctx,
			     &(mr_make_opts){ .solid = solid, .vertices = n, .genus = 1, .open = false }, &m),
	    MR_OK);
	return m;
}

/* A camera that fits the points into all of w by h pixels. */
static mr_camera
camera_for(const mr_mesh *m, mr_v3 from, double w, double h)
{
	mr_box box = mr_box_empty(), covered = mr_box_empty();
	mr_camera c;

	assert_int_equal(mr_camera_look(&ctx, from, mr_vec(0, 1, 0), &c), MR_OK);
	mr_camera_box(&c, m, &box);
	mr_camera_aim(&c, box);
	mr_camera_cover(&c, m, &covered);
	mr_camera_fit(&c, covered, 0, 0, w, h);
	return c;
}

static mr_image
drawn(const mr_subject *s, const mr_camera *c, bool wire, size_t w, size_t h)
{
	mr_image image;

	assert_int_equal(mr_image_new(&ctx, w, h, paper, &image), MR_OK);
	mr_raster(&ctx, s, c, wire, &image);
	return image;
}

static bool
same(mr_rgb a, mr_rgb b)
{
	return a.r == b.r && a.g == b.g && a.b == b.b;
}

static size_t
covered_pixels(const mr_image *image)
{
	size_t n = 0;

	for (size_t i = 0; i < image->width * image->height; i++)
		n += !same(image->pixel[i], paper);
	return n;
}

/* Of a sphere, perspective enlarges the outline until it fits, so the area is that of the
 * disc. */
static void
sphere_covers_a_disc(void **state)
{
	mr_mesh m = made(MR_SPHERE, 10000);

	(void)state;
	mr_camera c = camera_for(&m, mr_vec(0.3, 0.2, 1), 300, 300);
	mr_image image = drawn(&(mr_subject){ .mesh = m }, &c, false, 300, 300);
	double n = (double)covered_pixels(&image), disc = MR_PI * 150 * 150;

	assert_true(fabs(n - disc) < 0.015 * disc);
	for (size_t y = 0; y < 300; y++) /* and no gap inside */
		for (size_t x = 0; x < 300; x++)
			if (hypot((double)x - 149.5, (double)y - 149.5) < 147)
				assert_false(same(image.pixel[y * 300 + x], paper));
}

static void
depth_of_the_middle(void **state)
{
	mr_mesh m = made(MR_SPHERE, 10000);

	(void)state;
	mr_camera c = camera_for(&m, mr_vec(0, 0, 1), 300, 300);
	mr_seen s = mr_camera_see(&c, mr_vec(0, 0, 1));

	assert_true(fabs(s.x - 150) < 0.5 && fabs(s.y - 150) < 0.5);
	assert_true(fabs(s.z - 1) < 1e-3);
	for (double z = -1; z <= 1; z += 0.25)
		assert_true(fabs(height_of(&c, near_of(&c, z)) - z) < 1e-12);
	assert_true(near_of(&c, 0.5) > near_of(&c, 0.25));
}

/* Turned with the camera by a quarter about the upward axis, which moves coordinates exactly, a model looks
 * the same. */
static void
turning_all_changes_nothing(void **state)
{
	mr_mesh m = made(MR_BUMPY, 5000), turned = m;
	mr_v3 *p = MR_NEW(&ctx, m.nv, mr_v3);
	size_t different = 0;
	mr_image a, b;
	mr_camera c;

	(void)state;
	for (size_t i = 0; i < m.nv; i++)
		p[i] = mr_vec(m.p[i].z, m.p[i].y, -m.p[i].x);
	turned.p = p;
	c = camera_for(&m, mr_vec(0.5, 0.3, 1), 200, 200);
	a = drawn(&(mr_subject){ .mesh = m }, &c, false, 200, 200);
	c = camera_for(&turned, mr_vec(1, 0.3, -0.5), 200, 200);
	b = drawn(&(mr_subject){ .mesh = turned }, &c, false, 200, 200);
	for (size_t i = 0; i < 200 * 200; i++)
		different += abs(a.pixel[i].g - b.pixel[i].g) > 2;
	assert_true(different < 40); /* a thousandth: samples on the very edge of a face */
}

static void
threads_do_not_matter(void **state)
{
	mr_mesh m = made(MR_BUMPY, 5000), cloud = m;
	mr_camera c = camera_for(&m, mr_vec(1, 1, 1), 160, 120);

	(void)state;
	cloud.nf = 0;
	for (int k = 0; k < 2; k++) {
		mr_subject s = { .mesh = k ? cloud : m };
		mr_image one, more;
		ctx.threads = 1;
		one = drawn(&s, &c, true, 160, 120);
		for (unsigned threads = 2; threads < 6; threads++) {
			ctx.threads = threads;
			more = drawn(&s, &c, true, 160, 120);
			assert_memory_equal(one.pixel, more.pixel, 160 * 120 * sizeof *one.pixel);
		}
	}
}

/* Squares of [-1, 1]^2, each of two faces, at the given heights. */
static mr_mesh
squares(const double *z, size_t count)
{
	mr_v3 *p = MR_NEW(&ctx, 4 * count, mr_v3);
	mr_tri *t = MR_NEW(&ctx, 2 * count, mr_tri);

	for (size_t i = 0; i < count; i++) {
		uint32_t v = (uint32_t)(4 * i);
		p[v] = mr_vec(-1, -1, z[i]);
		p[v + 1] = mr_vec(1, -1, z[i]);
		p[v + 2] = mr_vec(1, 1, z[i]);
		p[v + 3] = mr_vec(-1, 1, z[i]);
		t[2 * i] = (mr_tri){ { v, v + 1, v + 2 } };
		t[2 * i + 1] = (mr_tri){ { v, v + 2, v + 3 } };
	}
	return (mr_mesh){ "squares", p, t, 4 * count, 2 * count };
}

static const mr_rgb red = { 200, 20, 20 }, green = { 20, 200, 20 };

/* Red before green by position, by index where they coincide, whatever the order of the faces. */
static void
nearer_hides_and_first_wins(void **state)
{
	static const double heights[][2] = { { 0.1, 0 }, { 0, 0.1 }, { 0, 0 } };
	static const bool red_wins[] = { true, false, true };
	const mr_rgb color[] = { red, red, green, green };

	(void)state;
	for (size_t k = 0; k < 3; k++) {
		mr_mesh m = squares(heights[k], 2);
		mr_subject s = { .mesh = m, .color = color, .per_face = true };
		mr_camera c = camera_for(&m, mr_vec(0, 0, 1), 40, 40);
		mr_image image = drawn(&s, &c, false, 40, 40);
		for (size_t i = 0; i < 40 * 40; i++)
			assert_int_equal(image.pixel[i].r > image.pixel[i].g, red_wins[k]);
	}
}

/* In perspective, a tilted square's nearest-vertex colours change where the middle of its side is seen. */
static void
kinds_change_in_the_middle(void **state)
{
	static const double zero = 0;
	mr_mesh m = squares(&zero, 1);
	const mr_rgb color[] = { red, red, green, green };
	mr_subject s = { .mesh = m, .color = color, .nearest = true };
	mr_camera c = camera_for(&m, mr_vec(0, -1.5, 1), 400, 200);
	mr_seen middle, top, bottom;
	mr_image image = drawn(&s, &c, false, 400, 200);
	size_t x, y = 0;

	(void)state;
	middle = mr_camera_see(&c, mr_vec(-1, 0, 0));
	bottom = mr_camera_see(&c, mr_vec(-1, -1, 0));
	top = mr_camera_see(&c, mr_vec(-1, 1, 0));
	assert_true(fabs(middle.y - (top.y + bottom.y) / 2) > 4); /* perspective shows */
	x = (size_t)middle.x + 2;
	while (y < 199 && image.pixel[y * 400 + x].r <= image.pixel[y * 400 + x].g)
		y++;
	while (y < 199 && same(image.pixel[y * 400 + x], paper))
		y++;
	while (y < 199 && image.pixel[y * 400 + x].g > image.pixel[y * 400 + x].r)
		y++;
	assert_true(fabs((double)y - middle.y) < 2.5);
}

static void
inside_is_bluish(void **state)
{
	static const double zero = 0;
	mr_mesh m = squares(&zero, 1);

	(void)state;
	for (int back = 0; back < 2; back++) {
		mr_camera c = camera_for(&m, mr_vec(0, 0, back ? -1 : 1), 40, 40);
		mr_image image = drawn(&(mr_subject){ .mesh = m }, &c, false, 40, 40);
		mr_rgb middle = image.pixel[20 * 40 + 20];
		assert_int_equal(middle.b > middle.r, back);
	}
}

/* Dark pixels grow with the length of edges in the picture, not with its square. */
static void
edges_are_of_one_width(void **state)
{
	static const double zero = 0;
	mr_mesh m = squares(&zero, 1);
	double dark[2] = { 0, 0 };

	(void)state;
	for (int k = 0; k < 2; k++) {
		size_t side = k ? 400 : 200;
		mr_camera c = camera_for(&m, mr_vec(0, 0, 1), (double)side, (double)side);
		mr_image image = drawn(&(mr_subject){ .mesh = m }, &c, true, side, side);
		mr_rgb plain = image.pixel[side / 2 * side + side / 4];
		for (size_t i = 0; i < side * side; i++)
			dark[k] += (double)(plain.g - image.pixel[i].g) / plain.g;
	}
	assert_true(dark[0] > 200);
	assert_true(fabs(dark[1] / dark[0] - 2) < 0.1);
}

/* What is partly or wholly outside of the picture, or as thin as a line, does no harm. */
static void
far_outside_is_cut(void **state)
{
	mr_mesh m = made(MR_SPHERE, 1000);
	mr_camera c = camera_for(&m, mr_vec(0, 0, 1), 64, 48);
	mr_image image;

	(void)state;
	c.scale *= 1e9;
	image = drawn(&(mr_subject){ .mesh = m }, &c, false, 64, 48);
	c.scale = 1e-9;
	image = drawn(&(mr_subject){ .mesh = m }, &c, false, 64, 48);
	c.x = 1e12;
	image = drawn(&(mr_subject){ .mesh = m }, &c, false, 64, 48);
	assert_int_equal(covered_pixels(&image), 0);
	m.nf = 0;
	image = drawn(&(mr_subject){ .mesh = m }, &c, false, 64, 48);
	assert_int_equal(covered_pixels(&image), 0);
}

static void
text_stays_in_its_box(void **state)
{
	mr_image image;
	size_t inside = 0, outside = 0;

	(void)state;
	assert_int_equal(mr_image_new(&ctx, 200, 60, paper, &image), MR_OK);
	mr_image_text(&image, 20, 20, 2, (mr_rgb){ 0, 0, 0 }, "Big jaw");
	for (size_t y = 0; y < 60; y++)
		for (size_t x = 0; x < 200; x++) {
			bool in = x >= 18 && x < 20 + 7 * 12 + 2 && y >= 18 && y < 40;
			*(in ? &inside : &outside) += !same(image.pixel[y * 200 + x], paper);
		}
	assert_true(inside > 200);
	assert_int_equal(outside, 0);
	mr_image_text(&image, 190, 55, 3, red, "cut off"); /* clipped */
	for (int c = 33; c < 127; c++)
		for (int d = 33; d < c; d++)
			assert_true(mr_glyph((char)c) != mr_glyph((char)d));
}

static void
colors_at_the_ends(void **state)
{
	mr_rgb low = mr_color_diverging(-1), middle = mr_color_diverging(0), high = mr_color_diverging(1);

	(void)state;
	assert_true(low.b > low.r && high.r > high.b && middle.r == middle.b);
	assert_true(same(mr_color_sequential(-3), mr_color_sequential(0)));
	assert_true(same(mr_color_sequential(7), mr_color_sequential(1)));
	for (int i = 0; i < 40; i++) { /* lightness grows, as luma tells it */
		mr_rgb a = mr_color_sequential(i / 40.0), b = mr_color_sequential((i + 1) / 40.0);
		assert_true(2 * a.r + 7 * a.g + a.b < 2 * b.r + 7 * b.g + b.b + 8);
	}
	for (uint32_t r = 0; r < 10; r++)
		for (uint32_t q = 0; q < r; q++)
			assert_false(same(mr_color_region(r), mr_color_region(q)));
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(sphere_covers_a_disc, setup, teardown),
		cmocka_unit_test_setup_teardown(depth_of_the_middle, setup, teardown),
		cmocka_unit_test_setup_teardown(turning_all_changes_nothing, setup, teardown),
		cmocka_unit_test_setup_teardown(threads_do_not_matter, setup, teardown),
		cmocka_unit_test_setup_teardown(nearer_hides_and_first_wins, setup, teardown),
		cmocka_unit_test_setup_teardown(kinds_change_in_the_middle, setup, teardown),
		cmocka_unit_test_setup_teardown(inside_is_bluish, setup, teardown),
		cmocka_unit_test_setup_teardown(edges_are_of_one_width, setup, teardown),
		cmocka_unit_test_setup_teardown(far_outside_is_cut, setup, teardown),
		cmocka_unit_test_setup_teardown(text_stays_in_its_box, setup, teardown),
		cmocka_unit_test_setup_teardown(colors_at_the_ends, setup, teardown),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
