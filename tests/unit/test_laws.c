/* Each law of the layers, broken once; and texts of reports. */
#include "measure/report.h"
#include "mesh/validate.h"
#include "subdivide/displaced.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

typedef struct list {
	size_t n;
	char first[512];
} list;

static void
note(void *user, const char *sentence)
{
	list *l = user;

	if (l->n++ == 0)
		snprintf(l->first, sizeof l->first, "%s", sentence);
}

static const mr_v3 p[] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 1, 1, 0 } };
static const mr_tri t[] = { { { 0, 1, 2 } }, { { 1, 3, 2 } } };
static const uint32_t zero[4];
static const mr_v3 bary[] = { { 1, 0, 0 }, { 0.5, 0.25, 0.25 }, { 0, 0, 1 }, { 0.25, 0.75, 0 } };
static const mr_shape V3 = { 'v', 'd', 3 }, V1 = { 'v', 'u', 1 }, F3 = { 'f', 'u', 3 }, F1 = { 'f', 'u', 1 },
		      TEXT = { '-', 't', 1 };

static void
put(mr_ctx *ctx, mr_frame *f, const char *layer, const char *name, mr_shape shape, const void *data,
    size_t rows)
{
	assert_int_equal(mr_frame_put(ctx, f, layer, name, shape, data, rows), MR_OK);
}

/* A frame that keeps every law. */
static mr_frame *
lawful(mr_ctx *ctx)
{
	mr_frame *f;

	assert_int_equal(mr_frame_new(ctx, "test", &f), MR_OK);
	for (int i = 0; i < 2; i++) {
		put(ctx, f, i ? "base" : "mesh", "position", V3, p, 4);
		put(ctx, f, i ? "base" : "mesh", "triangles", F3, t, 2);
	}
	put(ctx, f, "mesh", "region", V1, zero, 4);
	put(ctx, f, "mesh", "detail_face", V1, zero, 4);
	put(ctx, f, "mesh", "detail_bary", V3, bary, 4);
	put(ctx, f, "base", "source_face", V1, zero, 4);
	put(ctx, f, "base", "source_bary", V3, bary, 4);
	put(ctx, f, "mesh", "group", F1, zero, 2);
	put(ctx, f, "mesh", "groups", TEXT, "a\nb", 3);
	put(ctx, f, "own", "anything", V1, zero, 3);
	return f;
}

static list
check(mr_ctx *ctx, mr_frame *f)
{
	list l = { 0 };

	mr_check_frame(ctx, f, note, &l);
	return l;
}

static void
each_law(void **state)
{
	static const mr_tri high[] = { { { 0, 1, 2 } }, { { 1, 4, 2 } } };
	static const uint32_t two[] = { 0, 0, 2, 0 }, region[] = { 0, 1, 2, 70000 };
	static const mr_v3 nan_p[] = { { 0, 0, 0 }, { 1, NAN, 0 }, { 0, 1, 0 }, { 1, 1, 0 } };
	static const mr_v3 off[] = { { 1, 0, 0 }, { 0.5, 0.25, 0.26 }, { 0, 0, 1 }, { 2, -1, 0 } };
	static const mr_v3 beyond[] = { { 1, 0, 0 }, { 0.5, 0.25, 0.25 }, { 0, 0, 1 }, { 2, -1, 0 } };
	static const struct {
		const char *layer, *name;
		mr_shape shape;
		const void *data; /* NULL: the column is dropped */
		size_t rows, broken;
		const char *sentence;
	} cases[] = {
		{ "mesh", "triangles", { 'f', 'u', 3 }, high, 2, 1,
		    "mesh: column triangles, row 1 is 4 of 4 vertices" },
		{ "mesh", "position", { 'v', 'd', 3 }, nan_p, 4, 1,
		    "mesh: column position, row 1: component 1 is nan" },
		{ "mesh", "region", { 'v', 'u', 1 }, region, 4, 1,
		    "mesh: vertex 3 has region 70000 of 65538" },
		{ "mesh", "region", { 'v', 'u', 1 }, zero, 3, 1, "mesh: column region has 3 rows, not 4" },
		{ "mesh", "region", { 'f', 'u', 1 }, zero, 2, 1, "mesh: column region is f u1, not v u1" },
		{ "mesh", "detail_face", { 'v', 'u', 1 }, two, 4, 1,
		    "mesh: column detail_face, row 2 is 2 of 2 faces" },
		{ "base", "source_face", { 'v', 'u', 1 }, two, 4, 1,
		    "base: column source_face, row 2 is 2 of 2 faces" },
		{ "mesh", "detail_bary", { 'v', 'd', 3 }, off, 4, 1,
		    "mesh: column detail_bary, row 1: the coordinates have the sum 1.01" },
		{ "base", "source_bary", { 'v', 'd', 3 }, beyond, 4, 1,
		    "base: column source_bary, row 3: (2 -1 0) is no place within a face" },
		{ "base", "triangles", { 0, 0, 0 }, NULL, 0, 1,
		    "mesh: column detail_face refers to faces of base, which is not there" },
		{ "mesh", "group", { 'f', 'u', 1 }, two + 1, 2, 1,
		    "mesh: column group, row 1 is 2 of 2 groups" },
	};
	mr_ctx ctx;

	(void)state;
	mr_ctx_init(&ctx, 1);
	assert_int_equal(check(&ctx, lawful(&ctx)).n, 0);
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		mr_frame *f = lawful(&ctx);
		if (cases[i].data)
			put(&ctx, f, cases[i].layer, cases[i].name, cases[i].shape, cases[i].data,
			    cases[i].rows);
		else
			mr_frame_drop(f, cases[i].layer, cases[i].name, 0);
		list l = check(&ctx, f);
		assert_string_equal(l.first, cases[i].sentence);
		assert_int_equal(l.n, cases[i].broken);
	}
	mr_ctx_free(&ctx);
}

/* Broken layers are reported, not died of. */
static void
broken_layers_are_reported(void **state)
{
	static const mr_tri high[] = { { { 0, 1, 2 } }, { { 1, 9, 2 } } };
	static const mr_v3 nan_p[] = { { 0, 0, 0 }, { 1, NAN, 0 }, { 0, 1, 0 }, { 0, 1, 0 } };
	const mr_report_opts json = { .json = true, .check = true }, human = { .check = true };
	mr_ctx ctx;
	const char *broken = NULL;

	(void)state;
	mr_ctx_init(&ctx, 1);
	mr_frame *f = lawful(&ctx);
	mr_text a = { .ctx = &ctx }, b = { .ctx = &ctx };
	put(&ctx, f, "mesh", "triangles", F3, high, 2);
	put(&ctx, f, "points", "position", V3, nan_p, 4);
	put(&ctx, f, "", "history", TEXT, "one \"line\"\ntwo\n", 15);
	assert_int_equal(mr_report_frame(&ctx, f, &json, &a, &broken), MR_OK);
	assert_string_equal(broken, "mesh: column triangles, row 1 is 9 of 4 vertices");
	assert_non_null(strstr(a.s, "\"invalid\":\"mesh: face 1 has vertex 9 of 4\""));
	assert_non_null(strstr(a.s, "\"history\":[\"one \\\"line\\\"\",\"two\"]"));
	assert_non_null(strstr(a.s, "\"points\":4,\"not_finite\":1,\"duplicates\":1"));
	assert_true(strchr(a.s, '\n') == a.s + a.n - 1);
	assert_int_equal(mr_report_frame(&ctx, f, &human, &b, NULL), MR_OK);
	assert_non_null(strstr(b.s, "    invalid        mesh: face 1 has vertex 9 of 4\n"));
	assert_non_null(strstr(b.s, "  history          one \"line\"\n                   two\n"));
	assert_non_null(strstr(b.s, "    points         not finite 1, duplicates 1,"));
	mr_ctx_free(&ctx);
}

/* What mr-decode would refuse, a check tells. */
static void
displacements_fit_their_control_mesh(void **state)
{
	static const mr_v3 corner[] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
	static const mr_tri face[] = { { { 0, 2, 1 } }, { { 0, 1, 3 } }, { { 0, 3, 2 } }, { { 1, 2, 3 } } };
	static const double height[200];
	static const struct {
		size_t rows;
		uint32_t level; /* 99: there is none */
		bool control;
		const char *sentence;
	} cases[] = {
		{ 34, 2, true, NULL },
		{ 33, 2, true, "displacement: 33 heights, but level 2 of control has 34 vertices" },
		{ 35, 2, true, "displacement: 35 heights, but level 2 of control has 34 vertices" },
		{ 0, 2, true, "displacement: 0 heights, but level 2 of control has 34 vertices" },
		{ 34, 3, true, "displacement: 34 heights, but level 3 of control has 130 vertices" },
		{ 34, 4000000000, true, "displacement: level 4000000000 of at most 15" },
		{ 34, 99, true, "displacement: no column level" },
		{ 34, 2, false,
		    "displacement: no layer control; the frame has mesh, base, own, displacement" },
	};
	const mr_report_opts opts = { .check = true };
	const char *broken;
	mr_ctx ctx;

	(void)state;
	mr_ctx_init(&ctx, 1);
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		mr_frame *f = lawful(&ctx);
		mr_text text = { .ctx = &ctx };
		if (cases[i].control) {
			put(&ctx, f, "control", "position", V3, corner, 4);
			put(&ctx, f, "control", "triangles", F3, face, 4);
		}
		assert_int_equal(
		    mr_layer_put(&ctx, f, "displacement", "height", height, cases[i].rows), MR_OK);
		if (cases[i].level != 99)
			assert_int_equal(
			    mr_layer_put(&ctx, f, "displacement", "level", &cases[i].level, 1), MR_OK);
		assert_int_equal(mr_report_frame(&ctx, f, &opts, &text, &broken), MR_OK);
		if (cases[i].sentence)
			assert_string_equal(broken, cases[i].sentence);
		else
			assert_null(broken);
	}
	mr_ctx_free(&ctx);
}

static void
json_is_escaped(void **state)
{
	static const char odd[] = "a\"b\\c\n\x01 \xc3\xa9 \xff \xc3 \xed\xa0\x80 \xf0\x9f\x98\x80";
	mr_ctx ctx;
	mr_text x = { .ctx = &ctx };

	(void)state;
	mr_ctx_init(&ctx, 1);
	mr_text_json(&x, odd, sizeof odd - 1);
	assert_string_equal(x.s,
	    "\"a\\\"b\\\\c\\u000a\\u0001 \xc3\xa9 \\ufffd \\ufffd \\ufffd\\ufffd\\ufffd \xf0\x9f\x98\x80\"");
	x.n = 0;
	mr_text_number(&x, 0.1);
	mr_text_number(&x, NAN);
	assert_string_equal(x.s, "0.10000000000000001null");
	mr_ctx_free(&ctx);
}

int
main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(each_law),
		cmocka_unit_test(broken_layers_are_reported),
		cmocka_unit_test(displacements_fit_their_control_mesh),
		cmocka_unit_test(json_is_escaped),
	};

	cmocka_set_message_output(CM_OUTPUT_TAP);
	return cmocka_run_group_tests(tests, NULL, NULL);
}
