/*
 * fuzz_tool.c -- the work of the tool that $FORMAT names, on streams whose columns hold anything (records.h):
 * a result or a sentence.  A result is written and read again, and breaks no law of the layers unless the
 * input broke one.
 */
#include "formats/page.h"
#include "measure/report.h"
#include "mesh/validate.h"
#include "stream/fingerprint.h"
#include "tests/fuzz/records.h"
#include "tool/tool.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n);

typedef struct job {
	mr_ctx *ctx;
	mr_frame *f;
	mr_cache *cache;
	mr_writer *writer;
	unsigned way; /* one of those to run the tool */
	bool lawful;  /* the frame broke no law before */
} job;

/* Laws that a frame breaks: how many, and the last. */
typedef struct broken {
	size_t count;
	char sentence[MR_ERROR_MAX];
} broken;

static void
count_broken(void *user, const char *sentence)
{
	broken *b = user;

	b->count++;
	snprintf(b->sentence, sizeof b->sentence, "the result breaks a law: %s", sentence);
}

/* What a tool makes of a lawful frame is lawful. */
static mr_status
check_result(const job *j, mr_frame *f)
{
	broken after = { 0 };

	MR_TRY(mr_check_made(j->ctx, f));
	mr_check_frame(j->ctx, f, count_broken, &after);
	insist(!j->lawful || !after.count, after.sentence);
	return MR_OK;
}

/* Tools */

static const mr_rule rules[] = { { MR_REGION_FREE, "all" }, { MR_REGION_FIXED, "below:y,0.3" },
	{ MR_REGION_HANDLE, "above:y,0.8" } };

static mr_status
smooth(const job *j)
{
	mr_smooth_opts o = MR_SMOOTH_DEFAULTS;

	o.method = (int)(j->way % 3);
	return mr_smooth_frame(j->ctx, j->f, &o, NULL);
}

static mr_status
remesh(const job *j)
{
	mr_remesh_opts o = MR_REMESH_DEFAULTS;

	o.adaptive = j->way % 3 == 1 ? 0.01 : 0;
	o.adaptive_relative = true;
	o.feature = j->way % 3 == 1 ? 40 : 180;
	return mr_remesh_frame(j->ctx, j->f, &o, NULL);
}

static mr_status
choose(const job *j)
{
	return mr_select_frame(j->ctx, j->f, rules, 3, NULL, NULL);
}

static mr_status
encode(const job *j)
{
	return mr_encode_frame(j->ctx, j->f, NULL);
}

static mr_status
pose(const job *j)
{
	mr_pose p = MR_POSE_REST;

	p.degrees = 30;
	p.translate.y = 0.5;
	return mr_pose_frame(j->ctx, j->f, NULL, 0, &p);
}

static mr_status
solve(const job *j)
{
	static const int solvers[] = { MR_SOLVER_AUTO, MR_SOLVER_CG, MR_SOLVER_MULTIGRID, MR_SOLVER_LU };
	mr_solve_opts o = MR_SOLVE_DEFAULTS;

	o.solver = solvers[j->way % 4];
	o.unsymmetric = o.solver == MR_SOLVER_LU;
	o.order = 1 + j->way % 3;
	o.arap = j->way % 5 == 1;
	o.basis = j->way % 5 == 2;
	o.flatten = j->way % 5 == 3;
	MR_TRY(mr_solve_check(j->ctx, &o));
	return mr_solve_frame(j->ctx, j->f, &o, j->cache, NULL);
}

static mr_status
decode(const job *j)
{
	return mr_decode_frame(j->ctx, j->f, NULL, j->cache);
}

static mr_status
subdivide(const job *j)
{
	mr_subdivide_opts o = MR_SUBDIVIDE_DEFAULTS;

	o.limit = j->way % 3 == 1;
	o.longest = j->way % 3 == 2 ? 0.1 : 0;
	o.longest_relative = true;
	return mr_subdivide_frame(j->ctx, j->f, &o, j->cache, NULL);
}

static mr_status
simplify(const job *j)
{
	mr_simplify_opts o = MR_SIMPLIFY_DEFAULTS;

	o.to = j->way % 2 ? "control" : NULL;
	return mr_simplify_frame(j->ctx, j->f, &o, NULL);
}

static mr_status
fit(const job *j)
{
	mr_fit_opts o = MR_FIT_DEFAULTS;

	o.method = j->way % 2 ? MR_FIT_LOCAL : MR_FIT_LEAST_SQUARES;
	o.iterations = 2;
	return mr_fit_frame(j->ctx, j->f, &o, NULL);
}

static mr_status
sample(const job *j)
{
	mr_sample_opts o = MR_SAMPLE_DEFAULTS;

	o.method = (int)(j->way % 3);
	o.level = 1;
	return mr_sample_frame(j->ctx, j->f, &o, NULL);
}

static mr_status
wrap(const job *j)
{
	mr_wrap_opts o = MR_WRAP_DEFAULTS;

	o.method = (int)(j->way % 3);
	o.resolution = o.method == MR_WRAP_CUBE ? 4 : 0;
	return mr_shrinkwrap_frame(j->ctx, j->f, &o, NULL);
}

static mr_status
normals(const job *j)
{
	mr_normals_opts o = { .keep = j->way % 2 };

	return mr_normals_frame(j->ctx, j->f, &o, NULL);
}

static mr_status
transform(const job *j)
{
	const double map[12] = { 0, -2, 0, 1, j->way % 2 ? 3 : 1, 0, 0, 2, 0, 0, 1, 3 };

	return mr_transform_frame(j->ctx, j->f, NULL, map);
}

static mr_status
crop(const job *j)
{
	return mr_crop_frame(j->ctx, j->f, NULL, rules + 2, 1, NULL);
}

static mr_status
split(const job *j)
{
	mr_frame **part;
	mr_split_result r;

	MR_TRY(mr_split_frame(j->ctx, j->f, NULL, &part, &r));
	for (size_t k = 0; k < r.parts; k++)
		MR_TRY(check_result(j, part[k]));
	return MR_OK;
}

static mr_status
fill(const job *j)
{
	mr_fill_opts o = MR_FILL_DEFAULTS;

	o.loops = j->way % 2 ? 3 : 0;
	o.order = 1 + j->way % 3;
	return mr_fill_frame(j->ctx, j->f, &o, NULL);
}

static mr_status
align(const job *j)
{
	mr_align_opts o = MR_ALIGN_DEFAULTS;

	o.scale = j->way % 2;
	o.from = j->way % 3 ? NULL : "points";
	return mr_align_frame(j->ctx, j->f, j->f, &o, NULL);
}

static mr_status
equalize(const job *j)
{
	static const double gain[] = { 1, 0.5 };

	return mr_equalize_frame(j->ctx, j->f, gain, 2, j->cache);
}

static const char *
path_of(char path[64], const char *suffix)
{
	snprintf(path, 64, "/tmp/mr-fuzz-%ld%s", (long)getpid(), suffix);
	return path;
}

/* A model is written that is read again. */
static mr_status export(const job *j)
{
	static const char *const suffixes[] = { ".obj", ".ply", ".glb", ".stl", ".off", ".xyz" };
	char path[64];
	mr_frame *again;

	path_of(path, suffixes[j->way % 6]);
	MR_TRY(mr_export(j->ctx, j->f, NULL, path, NULL));
	insist(mr_import(j->ctx, path, NULL, &again, NULL) == MR_OK, mr_error(j->ctx));
	unlink(path);
	return MR_OK;
}

static mr_status
render(const job *j)
{
	mr_render_opts o = MR_RENDER_DEFAULTS;
	char path[64];

	o.width = 24;
	o.height = 16;
	o.wire = j->way % 2;
	o.color = j->way % 3 ? NULL : "detail_height";
	MR_TRY(mr_render(j->ctx, j->f, &o, path_of(path, ".png")));
	unlink(path);
	return MR_OK;
}

static mr_status
view(const job *j)
{
	mr_page page = { 0 };
	mr_status status = mr_page_add(j->ctx, &page, j->f, NULL);

	mr_page_free(&page);
	return status;
}

static mr_status
info(const job *j)
{
	mr_report_opts o = { .json = j->way % 2, .check = true };
	mr_text text = { .ctx = j->ctx };

	return mr_report_frame(j->ctx, j->f, &o, &text, NULL);
}

static mr_status
compare(const job *j)
{
	mr_compare_opts o = MR_COMPARE_DEFAULTS;
	mr_text text = { .ctx = j->ctx };
	mr_comparison r;
	mr_mesh a, b;

	o.samples = 1000;
	MR_TRY(mr_layer_surface_or_points(j->ctx, j->f, "mesh", &a));
	MR_TRY(mr_layer_surface_or_points(j->ctx, j->f, "base", &b));
	MR_TRY(mr_compare(j->ctx, &a, &b, &o, &r));
	mr_report_comparison(&r, j->f, "mesh", "base", j->way % 2, &text);
	return MR_OK;
}

static mr_status
map(const job *j)
{
	mr_map_opts o = MR_MAP_DEFAULTS;
	mr_bake_opts bake = MR_BAKE_DEFAULTS;
	char name[64], path[64];

	o.side = bake.side = 128;
	MR_TRY(mr_map_write(j->ctx, j->f, path_of(name, ""), &o, NULL));
	unlink(path_of(path, "-height.png"));
	MR_TRY(mr_bake(j->ctx, j->f, j->f, path_of(name, ""), &bake, NULL));
	unlink(path_of(path, "-color.png"));
	unlink(path_of(path, "-normal.png"));
	unlink(path_of(path, ".mtl"));
	return MR_OK;
}

static const struct tool {
	const char *name;
	mr_status (*run)(const job *j);
} tools[] = { { "mr-smooth", smooth }, { "mr-remesh", remesh }, { "mr-select", choose },
	{ "mr-encode", encode }, { "mr-pose", pose }, { "mr-solve", solve }, { "mr-decode", decode },
	{ "mr-subdivide", subdivide }, { "mr-simplify", simplify }, { "mr-fit", fit },
	{ "mr-sample", sample }, { "mr-shrinkwrap", wrap }, { "mr-normals", normals },
	{ "mr-transform", transform }, { "mr-crop", crop }, { "mr-split", split },
	{ "mr-fill", fill }, { "mr-align", align },
	{ "mr-equalize", equalize }, { "mr-export", export }, { "mr-render", render }, { "mr-view", view },
	{ "mr-info", info }, { "mr-compare", compare }, { "mr-map", map } };

static const struct tool *
the_tool(void)
{
	const char *name = getenv("FORMAT");

	for (size_t i = 0; name && i < sizeof tools / sizeof *tools; i++)
		if (!strcmp(tools[i].name, name))
			return &tools[i];
	insist(false, "FORMAT is no tool");
	return NULL;
}

/* Frames */

static mr_status
one_frame(job *j)
{
	broken before = { 0 };

	MR_ENTER(j->ctx);
	mr_check_frame(j->ctx, j->f, count_broken, &before);
	j->lawful = before.count == 0;
	MR_TRY(the_tool()->run(j));
	MR_TRY(check_result(j, j->f));
	return mr_writer_put(j->ctx, j->writer, j->f);
}

/* Each frame of a stream goes through the tool; how it ended. */
static mr_status
work(mr_ctx *ctx, int in, mr_writer *writer, unsigned way, size_t *frames)
{
	mr_reader *reader = NULL;
	mr_status status;
	job j = { ctx, NULL, mr_cache_new(), writer, way, false };

	insist(j.cache != NULL, "no memory");
	status = mr_reader_open(ctx, in, &reader);
	insist(status == MR_OK, "the reader cannot begin");
	for (*frames = 0; (status = mr_reader_next(ctx, reader, &j.f)) == MR_OK; ++*frames) {
		mr_mark mark = mr_mark_take(ctx);
		*ctx->error = '\0';
		status = one_frame(&j);
		if (status != MR_OK)
			break;
		mr_mark_release(ctx, mark);
	}
	insist(status == MR_END || (status < 0 && *ctx->error), "a failure without a sentence");
	mr_cache_delete(j.cache);
	mr_reader_free(reader);
	return status;
}

int
LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n)
{
	static int in = -1, out = -1;
	unsigned way = (unsigned)mr_fingerprint(bytes, n);
	size_t frames;
	mr_writer *writer;
	mr_ctx ctx;

	mr_ctx_init(&ctx, 1);
	insist(mr_writer_open(&ctx, emptied(&out), MR_KEEP, &writer) == MR_OK, "the writer cannot begin");
	if (work(&ctx, file_of(&in, bytes, n), writer, way, &frames) == MR_END) {
		insist(mr_writer_end(&ctx, writer) == MR_OK, mr_error(&ctx));
		insist(!lseek(out, 0, SEEK_SET) && frames_of(out) == frames, "frames are missing");
	}
	mr_writer_free(writer);
	mr_ctx_free(&ctx);
	return 0;
}
