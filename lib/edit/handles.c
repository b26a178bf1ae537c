/* Poses as affine maps, the handles of a frame that they move, and motions from scripts. */
#include "edit/handles.h"

#include "base/rotation.h"
#include "base/text.h"
#include "base/text_file.h"
#include "edit/region_transfer.h"
#include "subdivide/displaced.h"

static mr_v3
vector_of(const double x[3])
{
	return mr_vec(x[0], x[1], x[2]);
}

/* n numbers, and nothing after them. */
static bool
numbers(const char *text, size_t n, double *x)
{
	return mr_numbers(&text, n, x) && !*text;
}

enum { TRANSLATE, ROTATE, SCALE, CENTER, WORDS };

/* The words of a pose, and what each takes. */
static const char *const words[WORDS][2] = { { "translate", "x,y,z" }, { "rotate", "ax,ay,az,degrees" },
	{ "scale", "one factor, or three with commas between them" }, { "center", "x,y,z" } };

/* Which of the words it is; WORDS: none. */
static int
word_number(const char *word)
{
	int i = 0;

	while (i < WORDS && strcmp(word, words[i][0]) != 0)
		i++;
	return i;
}

/* Beyond 1e12 degrees rounding takes over 1e-4 of them from an angle. */
static mr_status
set_rotation(mr_ctx *ctx, mr_pose *pose, const double x[4])
{
	const double most = 1e12;

	pose->axis = vector_of(x);
	pose->degrees = x[3];
	if (!(mr_norm(pose->axis) > 0))
		return mr_fail(ctx, MR_EUSAGE, "the axis %g,%g,%g has no direction", x[0], x[1], x[2]);
	if (!(fabs(x[3]) <= most))
		return mr_fail(ctx, MR_EUSAGE, "an angle of %g degrees is not exact: at most %g", x[3], most);
	return MR_OK;
}

mr_status
mr_pose_set(mr_ctx *ctx, mr_pose *pose, const char *what, const char *text)
{
	int word = word_number(what);
	double x[4];

	if (word == WORDS)
		return mr_fail(ctx, MR_EUSAGE, "'%s' is none of translate, rotate, scale, center", what);
	if (word == SCALE && numbers(text, 1, x))
		x[1] = x[2] = x[0];
	else if (!numbers(text, word == ROTATE ? 4 : 3, x))
		return mr_fail(ctx, MR_EUSAGE, "'%s' is not %s", text, words[word][1]);
	if (word == ROTATE)
		return set_rotation(ctx, pose, x);
	*(word == TRANSLATE ? &pose->translate : word == SCALE ? &pose->scale : &pose->center) = vector_of(x);
	pose->centered |= word == CENTER;
	return MR_OK;
}

mr_status
mr_pose_check_shares(mr_ctx *ctx, const mr_pose *pose)
{
	mr_v3 s = pose->scale;

	if (s.x > 0 && s.y > 0 && s.z > 0)
		return MR_OK;
	return mr_fail(ctx, MR_EUSAGE, "there is no way from 1 to the scale %g,%g,%g: it must be positive",
	    s.x, s.y, s.z);
}

/* About which axis a share of the pose turns, by how many radians. */
static mr_v3
turn_of(const mr_pose *pose, double share)
{
	return mr_mul(share * pose->degrees * (MR_PI / 180), mr_unit(pose->axis));
}

mr_affine
mr_pose_map(const mr_pose *pose, mr_v3 center, double share)
{
	mr_v3 f = share == 1 ? pose->scale
	                     : mr_vec(pow(pose->scale.x, share), pow(pose->scale.y, share),
				   pow(pose->scale.z, share));
	mr_mat3 r = mr_rotation_exp(turn_of(pose, share));
	mr_affine t = { { r.m[0] * f.x, r.m[1] * f.y, r.m[2] * f.z, 0, r.m[3] * f.x, r.m[4] * f.y,
	    r.m[5] * f.z, 0, r.m[6] * f.x, r.m[7] * f.y, r.m[8] * f.z, 0 } };
	mr_v3 moved = mr_apply(&t, center); /* T x = L (x - center) + center + translate */
	mr_v3 shift = mr_axpy(share, pose->translate, mr_sub(center, moved));

	t.m[3] = shift.x;
	t.m[7] = shift.y;
	t.m[11] = shift.z;
	return t;
}

mr_status
mr_handles_find(mr_ctx *ctx, const mr_mesh *m, const uint32_t *region, mr_handles *h)
{
	mr_regions all = mr_regions_of(ctx, region, m->nv);
	mr_handles r = { all.n - MR_REGION_HANDLE, all.count + MR_REGION_HANDLE, NULL };

	if (r.n == 0)
		return mr_fail(ctx, MR_EMISSING, "no vertex of %s is in a handle", m->name);
	r.centroid = MR_NEW_ZERO(ctx, r.n, mr_v3);
	for (size_t v = 0; v < m->nv; v++)
		if (region[v] >= MR_REGION_HANDLE) {
			size_t i = region[v] - MR_REGION_HANDLE;
			r.centroid[i] = mr_add(r.centroid[i], m->p[v]);
		}
	for (size_t i = 0; i < r.n; i++)
		if (r.count[i])
			r.centroid[i] = mr_mul(1 / (double)r.count[i], r.centroid[i]);
	*h = r;
	return MR_OK;
}

mr_status
mr_handles_of_frame(mr_ctx *ctx, mr_frame *f, const char *layer, mr_handles *h)
{
	const uint32_t *region;
	mr_mesh m;

	if (layer && !mr_layer_has(f, layer, "region"))
		return mr_transfer_missing(ctx, f, layer);
	if (!layer)
		layer = mr_layer_has(f, "mesh", "region") ? "mesh" : "control";
	if (!mr_layer_has(f, layer, "region"))
		return mr_advise(ctx, MR_SELECT, mr_fail(ctx, MR_EMISSING, "no regions"));
	MR_TRY(mr_layer_points(ctx, f, layer, &m));
	MR_TRY(mr_layer_region(ctx, f, layer, m.nv, &region));
	return mr_handles_find(ctx, &m, region, h);
}

/* The rows of a column of doubles, which must be finite. */
static mr_status
read_rows(mr_ctx *ctx, mr_frame *f, const char *column, size_t width, double *row, size_t rows)
{
	const void *data;
	size_t odd;

	MR_TRY(mr_layer_get_rows(ctx, f, "handles", column, rows, &data));
	memcpy(row, data, rows * width * sizeof *row);
	odd = mr_first_infinite(row, rows * width) / width;
	return odd == rows
	           ? MR_OK
	           : mr_fail(ctx, MR_ERANGE, "handles: the %s of handle %zu is not finite", column, odd);
}

mr_status
mr_handles_rows(mr_ctx *ctx, mr_frame *f, size_t n, mr_handle_rows *row)
{
	const mr_column *maps = mr_frame_find(f, "handles", "transform");
	size_t there = maps ? (size_t)maps->rows : 0;
	mr_handle_rows r = { .n = n < there ? there : n };

	r.map = MR_NEW(ctx, r.n, mr_affine);
	r.turn = MR_NEW_ZERO(ctx, r.n, mr_v3);
	if (there)
		MR_TRY(read_rows(ctx, f, "transform", 12, (double *)r.map, there));
	if (there && mr_layer_has(f, "handles", "turn"))
		MR_TRY(read_rows(ctx, f, "turn", 3, (double *)r.turn, there));
	for (size_t i = 0; i < there; i++) {
		mr_mat3 a = mr_affine_linear(&r.map[i]);
		r.turn[i] = mr_rotation_log(&a, r.turn[i]);
	}
	for (size_t i = there; i < r.n; i++)
		r.map[i] = mr_identity();
	*row = r;
	return MR_OK;
}

static mr_status
no_such_handle(mr_ctx *ctx, const mr_handles *h, size_t handle)
{
	mr_text used = { .ctx = ctx };
	char number[24];
	size_t n = 0;

	for (size_t i = 0; i < h->n; i++)
		if (h->count[i]) {
			snprintf(number, sizeof number, "%zu", i);
			mr_text_name(&used, &n, number);
		}
	return mr_fail(
	    ctx, MR_EMISSING, "no vertex is in handle %zu; handles in use: %s", handle, n ? used.s : "none");
}

mr_status
mr_handles_pose(
    mr_ctx *ctx, const mr_handles *h, size_t handle, const mr_pose *pose, double share, mr_handle_rows *row)
{
	mr_v3 center;
	mr_affine t;
	mr_mat3 a;

	if (handle >= h->n || h->count[handle] == 0)
		return no_such_handle(ctx, h, handle);
	center = pose->centered ? pose->center : mr_apply(&row->map[handle], h->centroid[handle]);
	t = mr_pose_map(pose, center, share);
	row->map[handle] = mr_compose(&t, &row->map[handle]);
	a = mr_affine_linear(&row->map[handle]);
	if (mr_mat3_determinant(&a) < 0)
		mr_found(ctx, &(mr_finding){ .kind = MR_UNHELD,
				  .what = "a handle is mirrored: what goes with it comes inside out" });
	row->turn[handle] = mr_rotation_log(&a, mr_add(row->turn[handle], turn_of(pose, share)));
	return MR_OK;
}

void
mr_handles_drop(mr_frame *f)
{
	mr_frame_drop(f, "handles", "transform", 0);
	mr_frame_drop(f, "handles", "turn", 0);
}

mr_status
mr_handles_frames(mr_ctx *ctx, mr_frame *f, size_t *frames)
{
	const void *announced;

	*frames = 0;
	if (!mr_layer_has(f, "handles", "frames"))
		return MR_OK;
	MR_TRY(mr_layer_get_rows(ctx, f, "handles", "frames", 1, &announced));
	*frames = *(const uint32_t *)announced;
	return MR_OK;
}

/* Scripts */

typedef struct mr_script_line {
	size_t frame, handle;
	mr_pose pose;
} script_line;

/* Cuts the next word off the text; NULL at its end. */
static char *
next_word(char **text)
{
	char *word = *text + strspn(*text, " \t"), *end = word + strcspn(word, " \t");

	if (!*word)
		return NULL;
	*text = *end ? end + 1 : end;
	*end = '\0';
	return word;
}

static mr_status
parse_script_line(mr_ctx *ctx, char *text, script_line *line)
{
	const char *at = next_word(&text), *first = at;
	unsigned said = 0; /* a bit for each word */
	uint64_t handle;
	char *word;

	if (!mr_whole(&at, 65535, &handle) || *at)
		return mr_fail(ctx, MR_EFORMAT, "'%.40s' is neither a handle nor the word frame", first);
	line->handle = (size_t)handle;
	line->pose = (mr_pose)MR_POSE_REST;
	while ((word = next_word(&text))) {
		char *equals = strchr(word, '=');
		if (!equals)
			return mr_fail(ctx, MR_EFORMAT, "'%.40s' is not of the form what=value", word);
		*equals = '\0';
		if (mr_pose_set(ctx, &line->pose, word, equals + 1) < 0)
			return MR_EFORMAT;
		if (said >> word_number(word) & 1)
			return mr_fail(
			    ctx, MR_EFORMAT, "%s twice: poses that add up stand on lines of their own", word);
		said |= 1u << word_number(word);
	}
	return said ? MR_OK : mr_fail(ctx, MR_EFORMAT, "handle %zu has no pose", line->handle);
}

mr_status
mr_script_read(mr_ctx *ctx, const char *path, mr_script *script)
{
	mr_script r = { 0 };
	char **line;
	size_t n;

	MR_TRY(mr_lines_read(ctx, path, &line, &n));
	r.line = MR_NEW(ctx, n, script_line);
	for (size_t i = 0; i < n; i++) {
		if (!strcmp(line[i], "frame")) {
			r.frames++;
		} else if (*line[i]) {
			if (r.frames == 0)
				return mr_fail(ctx, MR_EFORMAT, "%s:%zu: no frame has begun", path, i + 1);
			MR_TRY(mr_prefix(
			    ctx, parse_script_line(ctx, line[i], &r.line[r.n]), "%s:%zu", path, i + 1));
			r.line[r.n++].frame = r.frames;
		}
	}
	if (r.frames == 0)
		return mr_fail(ctx, MR_EFORMAT, "%s: the script has no frame", path);
	*script = r;
	return MR_OK;
}

mr_status
mr_script_pose(mr_ctx *ctx, const mr_handles *h, const mr_script *script, size_t number, mr_handle_rows *row)
{
	if (number > script->frames)
		number = script->frames;
	for (size_t i = 0; i < script->n; i++)
		if (script->line[i].frame == number)
			MR_TRY(
			    mr_handles_pose(ctx, h, script->line[i].handle, &script->line[i].pose, 1, row));
	return MR_OK;
}

size_t
mr_motion_length(const mr_motion *m)
{
	return m->script ? m->script->frames : m->frames;
}

mr_status
mr_motion_put(mr_ctx *ctx, mr_frame *f, const mr_handles *h, const mr_motion *m, size_t number)
{
	double share = m->frames == 0 || number >= m->frames ? 1 : (double)number / (double)m->frames;
	mr_handle_rows row;

	MR_TRY(mr_handles_rows(ctx, f, h->n, &row));
	if (m->script)
		MR_TRY(mr_script_pose(ctx, h, m->script, number, &row));
	else
		MR_TRY(mr_handles_pose(ctx, h, m->handle, &m->pose, share, &row));
	MR_TRY(mr_layer_put(ctx, f, "handles", "transform", row.map, row.n));
	MR_TRY(mr_layer_put(ctx, f, "handles", "turn", row.turn, row.n));
	return mr_layer_worked(ctx, f, "handles");
}
