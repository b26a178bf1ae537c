/* The page's data are a stream: what a browser shows of the frames, packed, in base64 between two halves of
 * HTML. */
#include "formats/page.h"

#include "base/text.h"
#include "edit/detail.h"
#include "edit/handles.h"
#include "formats/bytes.h"
#include "formats/filename.h"
#include "formats/formats.h"
#include "subdivide/displaced.h"
#include "tool/tool.h"

#include <errno.h>
#include <unistd.h>

/* The most that a page may hold, in bytes of the packed stream: a browser holds it three times, as text, as
 * bytes and unpacked, and gives a page some 2 to 4 GB. */
static const off_t LARGEST_PAGE = 300000000;

/* Columns of vertices that say where they are on another layer, or that only serve to compute.  Of these a
 * page takes those by which it poses what it can. */
static const char *const unseen[] = { "detail_face", "detail_bary", "detail_offset", "source_face",
	"source_bary", "encoded", "before", "rest", "response", "texcoord", "corner_texcoord", "polygon",
	NULL };

static const char *const posing[] = { "mesh.detail_face", "mesh.detail_bary", "mesh.detail_offset",
	"base.encoded", "base.response", "handles.transform", NULL };

/* Texts that name the values of other columns. */
static const char *const texts[] = { "groups", "objects", "materials", NULL };

/* The displaced subdivision surface of a frame; zeroed: there is none. */
typedef struct displaced {
	bool there;
	bool is_mesh; /* mesh is this surface, and need not be stored */
	size_t n;     /* finest level */
	const mr_loop *level;
	const double *height;
	double extent; /* of the control mesh: the largest side of its box */
	bool packed;   /* stored as a packed surface in place of the columns of that name */
} displaced;

static const char *const packed[] = { "control.position", "control.triangles", "displacement.height",
	"displacement.color", NULL };

/* Whether a comma list, or NULL for any, has the name. */
static bool
is_listed(const char *name, const char *list)
{
	size_t n = strlen(name);

	if (!list)
		return true;
	for (const char *s = list; s; s = strchr(s, ',') ? strchr(s, ',') + 1 : NULL)
		if (!strncmp(s, name, n) && (s[n] == ',' || s[n] == '\0'))
			return true;
	return false;
}

/* Whether the page can pose base by its response to handles, and the detail with it, as mr-decode does. */
static bool
is_posable(const mr_frame *f, const char *layers)
{
	return is_listed("mesh", layers) && is_listed("base", layers) && mr_layer_has(f, "mesh", "region") &&
	       mr_layer_has(f, "mesh", "detail_height") && mr_layer_has(f, "base", "response");
}

/* Whether it is that column, "mesh.position". */
static bool
is_column(const mr_column *c, const char *name)
{
	size_t n = strlen(c->layer);

	return !strncmp(name, c->layer, n) && name[n] == '.' && !strcmp(name + n + 1, c->name);
}

/* Places, and up to four numbers that can give colours.  A surface's normals, and the mesh that control and
 * displacement are, the page makes itself. */
static bool
is_shown(const mr_frame *f, const mr_column *c, const char *layers, const displaced *d)
{
	static const char *const of_frame[] = { "history", "latest", "findings", NULL };
	bool surface = mr_layer_has(f, c->layer, "triangles");
	bool control = d->there && !strcmp(c->layer, "control");
	bool made = d->is_mesh && (is_column(c, "mesh.position") || is_column(c, "mesh.triangles"));

	if (!*c->layer)
		return mr_is_one_of(c->name, of_frame);
	for (const char *const *name = packed; *name; name++)
		if (d->packed && is_column(c, *name))
			return false;
	for (const char *const *name = posing; *name; name++)
		if (is_column(c, *name))
			return is_posable(f, layers);
	if (d->there && !strcmp(c->layer, "displacement") && c->shape.element == 'v' &&
	    c->shape.type != 't' && c->shape.components <= 4)
		return true;
	if (made || !(control || is_listed(c->layer, layers)) || !mr_layer_has(f, c->layer, "position"))
		return false;
	if (c->shape.element == '-' || c->shape.type == 't')
		return mr_is_one_of(c->name, texts);
	if (surface && !strcmp(c->name, "normal"))
		return false;
	return c->shape.components <= 4 && !mr_is_one_of(c->name, unseen);
}

/* How the page stores a column: origin + step times a whole number; step 0 stores whole numbers.  It keeps
 * `components` of a row; rows of more than three values are stored from 0, and pass their origin on. */
typedef struct whole_steps {
	double step, origin[3];
	uint8_t components;
} whole_steps;

/* The largest step, a power of two, of which the extent is less than 2^24; 1 where there is none to speak of.
 */
static double
step_of(double extent)
{
	const double tiny = 1e-200;
	int exponent;

	if (!(extent > tiny))
		return 1;
	frexp(extent, &exponent);
	return ldexp(1, exponent - 24);
}

/* The whole number of a value: modulo 2^32, as its differences are. */
static uint32_t
whole(const mr_column *c, const whole_steps *s, size_t at, size_t component)
{
	const double *x = c->data;
	const uint32_t *u = c->data;
	double origin = c->shape.components <= 3 ? s->origin[component] : 0;

	return s->step > 0 ? (uint32_t)(int32_t)rint((x[at] - origin) / s->step) : u[at];
}

static void
sum_steps(const mr_column *c, const whole_steps *s, uint32_t *sums)
{
	size_t rows = (size_t)c->rows, width = c->shape.components, kept = s->components;

	for (size_t k = 0; k < kept; k++) {
		uint32_t sum = 0, before = 0;
		for (size_t i = 0; i < rows; i++) {
			uint32_t now = whole(c, s, width * i + k, k), step = now - before;
			/* 0, -1, 1, -2, ... as 0, 1, 2, 3, ... */
			sums[kept * i + k] = sum += step << 1 ^ (step >> 31 ? UINT32_MAX : 0);
			before = now;
		}
	}
}

/* Puts the column as sums over the rows of steps without a sign, small ones with small numbers: packing takes
 * their differences.  Steps are within 31 bits of the origin.  A line in `notes` tells the page. */
static mr_status
put_steps(mr_ctx *ctx, mr_frame *to, const mr_column *c, const whole_steps *s, mr_text *notes)
{
	mr_shape shape = { c->shape.element, 'u', s->components };
	uint32_t *sums = MR_NEW(ctx, (size_t)c->rows * s->components, uint32_t);

	sum_steps(c, s, sums);
	mr_text_add(notes, "steps %s %s", c->layer, c->name);
	if (s->step > 0)
		mr_text_add(notes, " %.17g", s->step);
	for (int k = 0; s->step > 0 && k < 3; k++)
		mr_text_add(notes, " %.17g", s->origin[k]);
	mr_text_add(notes, "\n");
	return mr_frame_put(ctx, to, c->layer, c->name, shape, sums, (size_t)c->rows);
}

/* Positions count from the corner of their box, so that they are whole steps wherever the model is. */
static whole_steps
steps_of_places(mr_box box)
{
	mr_v3 size = box.min.x <= box.max.x ? mr_sub(box.max, box.min) : mr_vec(0, 0, 0);
	double extent = fmax(size.x, fmax(size.y, size.z)), step = step_of(extent);

	if (!(step < extent)) /* one place, or next to it */
		return (whole_steps){ 0 };
	return (whole_steps){ step,
		{ rint(box.min.x / step) * step, rint(box.min.y / step) * step,
		    rint(box.min.z / step) * step },
		3 };
}

/* Puts vertices that no face has, which are not drawn, into the box of the rest, where they make no step
 * larger. */
static mr_status
clamp_places(mr_ctx *ctx, mr_frame *f, mr_column *c, whole_steps *steps)
{
	size_t n = (size_t)c->rows;
	const mr_v3 *p = c->data;
	mr_v3 *q = MR_NEW(ctx, n, mr_v3);
	mr_mesh m;
	mr_box box;

	MR_TRY(mr_layer_surface_or_points(ctx, f, c->layer, &m));
	m.p = c->data;
	box = mr_mesh_box(&m);
	for (size_t i = 0; i < n; i++)
		q[i] = mr_vec(fmin(fmax(p[i].x, box.min.x), box.max.x),
		    fmin(fmax(p[i].y, box.min.y), box.max.y), fmin(fmax(p[i].z, box.min.z), box.max.z));
	c->data = q;
	*steps = steps_of_places(box);
	return MR_OK;
}

/* Within 24 bits of the largest, or of `least`; of barycentric coordinates the third is what the two leave
 * of 1. */
static whole_steps
steps_of_column(const mr_column *c, double least)
{
	size_t n = (size_t)c->rows * c->shape.components;
	uint8_t components = !strcmp(c->name, "detail_bary") ? 2 : c->shape.components;
	const double *x = c->data;
	double most = least;

	if (c->shape.type == 'u')
		return (whole_steps){ 0, { 0 }, components };
	for (size_t i = 0; i < n; i++) {
		if (!isfinite(x[i])) /* as of a corner without a place in the picture */
			return (whole_steps){ 0 };
		most = fmax(most, fabs(x[i]));
	}
	return (whole_steps){ step_of(most), { 0 }, components };
}

/* A response to maps about the origin grows with the distance from there; about the middle of what it poses
 * it keeps its digits: w_k - c_k w_3 in place of w_k, with T c - c in place of T's translation. */
static mr_status
centre_response(mr_ctx *ctx, mr_frame *f, mr_column *c, double centre[3])
{
	size_t n = (size_t)c->rows * c->shape.components;
	double *w = MR_NEW(ctx, n, double);
	mr_mesh posed;
	mr_box box;

	MR_TRY(mr_layer_surface_or_points(ctx, f, c->layer, &posed));
	box = mr_mesh_box(&posed);
	for (int k = 0; k < 3; k++)
		centre[k] = (mr_coordinate(box.min, k) + mr_coordinate(box.max, k)) / 2;
	memcpy(w, c->data, n * sizeof *w);
	for (size_t i = 0; i < n; i++)
		if (i % 4 < 3)
			w[i] -= centre[i % 4] * w[i - i % 4 + 3];
	c->data = w;
	return MR_OK;
}

/* A browser draws with floats.  Positions are rounded by the model's extent, other numbers by the largest;
 * the handles' maps, and columns with what is no number, stay as they are. */
static mr_status
take_column(
    mr_ctx *ctx, mr_frame *from, const mr_column *column, const displaced *d, mr_frame *to, mr_text *notes)
{
	mr_column c = *column;
	double centre[3] = { 0 };
	whole_steps steps;

	if ((c.shape.type != 'd' && c.shape.type != 'u') || !strcmp(c.layer, "handles"))
		return mr_frame_pass(ctx, to, column);
	MR_TRY(mr_column_decode(ctx, &c));
	if (!strcmp(c.name, "response"))
		MR_TRY(centre_response(ctx, from, &c, centre));
	if (!strcmp(c.name, "position") || is_column(&c, "base.encoded"))
		MR_TRY(clamp_places(ctx, from, &c, &steps));
	else
		steps = steps_of_column(&c, is_column(&c, "displacement.height") ? d->extent : 0);
	if (!strcmp(c.name, "response"))
		memcpy(steps.origin, centre, sizeof centre);
	return steps.components ? put_steps(ctx, to, &c, &steps, notes) : mr_frame_pass(ctx, to, &c);
}

static mr_status
make_mesh(mr_ctx *ctx, mr_frame *f, const displaced *d, mr_mesh *m)
{
	mr_domain domain;
	mr_mesh control;
	mr_v3 *p;

	MR_TRY(mr_layer_mesh(ctx, f, "control", &control));
	mr_domain_on(ctx, &control, d->level, d->n, &domain);
	p = MR_NEW(ctx, domain.m.nv, mr_v3);
	mr_domain_displace(ctx, &domain, d->height, 1, p);
	*m = domain.m;
	m->p = p;
	return MR_OK;
}

/* Whether mesh is, bit by bit, what mr-decode makes of the frame. */
static mr_status
compare_mesh(mr_ctx *ctx, mr_frame *f, displaced *d)
{
	const mr_loop *finest = &d->level[d->n];
	mr_mesh mesh, made;

	MR_TRY(mr_layer_surface_or_points(ctx, f, "mesh", &mesh));
	if (finest->nv != mesh.nv || finest->nf != mesh.nf ||
	    memcmp(mesh.t, finest->t, mesh.nf * sizeof *mesh.t) != 0)
		return MR_OK;
	MR_SCOPE(ctx);
	MR_TRY(make_mesh(ctx, f, d, &made));
	d->is_mesh = !memcmp(made.p, mesh.p, mesh.nv * sizeof *mesh.p);
	return MR_OK;
}

/* Control mesh and heights, checked as mr-decode does.  MR_EMISSING where they are not there. */
static mr_status
get_displaced(mr_ctx *ctx, mr_frame *f, displaced *d)
{
	displaced r = { .there = true };
	mr_mesh control;
	const uint8_t *mark;
	mr_loop *level;
	mr_box box;

	if (!mr_frame_has_layer(f, "displacement"))
		return mr_layer_missing(ctx, f, "displacement", "displacement");
	MR_TRY(mr_layer_mesh(ctx, f, "control", &control));
	MR_TRY(mr_displacement_get(ctx, f, &control, &r.n, &r.height));
	level = MR_NEW(ctx, r.n + 1, mr_loop);
	MR_TRY(mr_layer_crease(ctx, f, control.name, control.nf, &mark));
	MR_TRY(mr_loop_levels(ctx, &control, 180, mark, r.n, level));
	box = mr_mesh_box(&control);
	r.extent = fmax(box.max.x - box.min.x, fmax(box.max.y - box.min.y, box.max.z - box.min.z));
	r.level = level;
	if (mr_layer_has(f, "mesh", "position"))
		MR_TRY(compare_mesh(ctx, f, &r));
	*d = r;
	return MR_OK;
}

/* The displaced surface that is asked for, or, without a list, the one that is there; mesh is stored where it
 * is to be posed, or wears pictures. */
static mr_status
find_displaced(mr_ctx *ctx, const mr_page *page, mr_frame *f, const char *list, displaced *d)
{
	bool there = mr_layer_has(f, "control", "triangles") && mr_layer_has(f, "displacement", "height");

	*d = (displaced){ 0 };
	if (list ? !is_listed("displacement", list) : !there)
		return MR_OK;
	MR_TRY(get_displaced(ctx, f, d));
	d->packed = page->pack > 0;
	d->is_mesh = d->is_mesh && !is_posable(f, list) && !mr_page_can_wear(&page->pictures, f, "mesh");
	return MR_OK;
}

/* The page checks nothing: it draws surfaces and points that any tool accepts. */
static mr_status
check_layers(mr_ctx *ctx, mr_frame *f, const char *list, const displaced *d)
{
	const char *latest;
	mr_mesh m;

	MR_TRY(mr_layer_latest(ctx, f, &latest));
	if (!list && !(d->there && latest && (!strcmp(latest, "displacement") || !strcmp(latest, "control"))))
		MR_TRY(mr_layer_finished_or_warn(ctx, f));
	for (size_t i = 0; !list && i < f->count; i++)
		if (*f->columns[i].layer && !strcmp(f->columns[i].name, "position"))
			MR_TRY(mr_layer_surface_or_points(ctx, f, f->columns[i].layer, &m));
	while (list) {
		size_t n = strcspn(list, ",");
		char *layer = mr_format(ctx, "%.*s", (int)n, list);
		if (strcmp(layer, "displacement") != 0) /* that was checked when it was found */
			MR_TRY(mr_layer_surface_or_points(ctx, f, layer, &m));
		list = list[n] ? list + n + 1 : NULL;
	}
	return MR_OK;
}

/* Refuses what mr-decode would refuse: the page trusts its numbers. */
static mr_status
check_posing(mr_ctx *ctx, mr_frame *f)
{
	const double *response;
	mr_handle_rows rows;
	mr_detail detail;
	mr_mesh base;

	MR_TRY(mr_layer_mesh(ctx, f, "base", &base));
	MR_TRY(mr_detail_get(ctx, f, &base, &detail));
	return mr_response_get(ctx, f, &base, &response, &rows);
}

/* The surface of displacement goes by the name that mr-decode gives it, unless there is another mesh. */
static const char *
surface_name(const mr_frame *f, const bool *shown)
{
	for (size_t i = 0; i < f->count; i++)
		if (shown[i] && is_column(&f->columns[i], "mesh.position"))
			return "displacement";
	return "mesh";
}

/* A packed surface, which has another order: of each vertex and face of its control mesh, which it was. */
static mr_status
put_packed(mr_ctx *ctx, mr_frame *from, double error, mr_frame *to, mr_text *notes)
{
	const mr_shape bytes = { '-', 'b', 1 }, numbers = { '-', 'u', 1 };
	mr_control_order order;
	mr_packed_bytes file;
	uint32_t *half;

	MR_TRY(mr_pack_in_place(ctx, from, error, &file, &order));
	half = MR_NEW(ctx, order.m.nf, uint32_t);
	for (size_t i = 0; i < order.m.nf; i++)
		half[i] = order.half[3 * i];
	MR_TRY(mr_frame_put(ctx, to, "displacement", "packed", bytes, file.byte, file.size));
	MR_TRY(mr_frame_put(ctx, to, "control", "packed_vertex", numbers, order.vertex, order.m.nv));
	MR_TRY(mr_frame_put(ctx, to, "control", "packed_half", numbers, half, order.m.nf));
	mr_text_add(notes, "packed%s\n", mr_layer_has(from, "displacement", "color") ? " color" : "");
	return MR_OK;
}

static mr_status
take_columns(mr_ctx *ctx, mr_frame *from, const bool *shown, const displaced *d, double pack, mr_frame *to,
    mr_text *notes)
{
	bool same;

	MR_TRY(mr_layer_is_as_encoded(ctx, from, "base", &same)); /* then its places say both */
	for (size_t i = 0; i < from->count; i++)
		if (shown[i] && !(same && !strcmp(from->columns[i].name, "encoded")))
			MR_TRY(take_column(ctx, from, &from->columns[i], d, to, notes));
	if (!d->there)
		return MR_OK;
	mr_text_add(notes, "surface %s", surface_name(from, shown));
	for (size_t i = 0; i <= d->n; i++)
		mr_text_add(notes, " %zu", d->level[i].nv);
	mr_text_add(notes, "\n");
	return d->packed ? put_packed(ctx, from, pack, to, notes) : MR_OK;
}

/* The pictures on the surfaces shown, and the columns that place them. */
static mr_status
wear_pictures(mr_ctx *ctx, mr_frame *f, mr_page_pictures *pictures, bool *shown, mr_text *notes)
{
	for (size_t i = 0; i < f->count; i++) {
		const char *layer = f->columns[i].layer, *coordinates;
		if (!shown[i] || strcmp(f->columns[i].name, "triangles") != 0)
			continue;
		MR_TRY(mr_page_wear(ctx, pictures, f, layer, notes, &coordinates));
		for (size_t k = 0; coordinates && k < f->count; k++)
			shown[k] |= !strcmp(f->columns[k].layer, layer) &&
			            !strcmp(f->columns[k].name, coordinates);
	}
	return MR_OK;
}

static void
note_line(mr_text *notes, const char *what, const char *text)
{
	if (!text)
		return;
	mr_text_add(notes, "%s ", what);
	for (; *text; text++)
		mr_text_add(notes, "%c", (unsigned char)*text < ' ' ? ' ' : *text);
	mr_text_add(notes, "\n");
}

/* The text of the page about all its frames, and which file (without folder and suffix) they are from. */
static mr_text
begin_notes(mr_ctx *ctx, const mr_page *page)
{
	mr_text notes = { .ctx = ctx };

	note_line(&notes, "title", page->title);
	note_line(&notes, "caption", page->caption);
	note_line(&notes, "file", page->from ? mr_format_stem(ctx, page->from) : NULL);
	return notes;
}

/* A text of no layer, `page`, says how columns are stored. */
static mr_status
take_frame(mr_ctx *ctx, mr_frame *from, mr_page *page, const char *layers, const displaced *d, mr_frame *to)
{
	bool *shown = MR_NEW(ctx, from->count, bool);
	mr_text notes = begin_notes(ctx, page);

	for (size_t i = 0; i < from->count; i++)
		shown[i] = is_shown(from, &from->columns[i], layers, d);
	MR_TRY(wear_pictures(ctx, from, &page->pictures, shown, &notes));
	MR_TRY(take_columns(ctx, from, shown, d, page->pack, to, &notes));
	return notes.n ? mr_frame_put(ctx, to, "", "page", (mr_shape){ '-', 't', 1 }, notes.s, notes.n)
	               : MR_OK;
}

static mr_status
failed(mr_ctx *ctx)
{
	return mr_fail(ctx, MR_EIO, "the page's data, in a file for the time being: %s", strerror(errno));
}

static mr_status
check_size(mr_ctx *ctx, off_t size, const mr_page_pictures *pictures)
{
	off_t all = size + (off_t)pictures->bytes;

	if (size < 0)
		return failed(ctx);
	if (all > LARGEST_PAGE)
		return mr_fail(ctx, MR_ERANGE,
		    "the page comes to %.0f MB, and browsers take some %.0f: pick fewer layers by -l, or "
		    "fewer frames%s",
		    (double)all / 1e6, (double)LARGEST_PAGE / 1e6,
		    pictures->bytes ? ", or smaller pictures" : "");
	return MR_OK;
}

static mr_status
put_frame(mr_ctx *ctx, mr_page_stream *s, const mr_frame *f)
{
	if (!s->file && !(s->file = tmpfile()))
		return failed(ctx);
	if (!s->writer)
		MR_TRY(mr_writer_open(ctx, fileno(s->file), MR_PACK, &s->writer));
	return mr_writer_put(ctx, s->writer, f);
}

static void
free_stream(mr_page_stream *s)
{
	mr_writer_free(s->writer);
	if (s->file)
		fclose(s->file);
	*s = (mr_page_stream){ 0 };
}

/* A stream in blocks, which the page reads and drops one by one: no browser has texts of 400 MB. */
static mr_status
put_stream(mr_sink *s, FILE *file, const char *before, const char *after)
{
	enum { PIECE = 3000, PIECES = 1000 };
	unsigned char piece[PIECE];
	size_t n, pieces = 0;

	if (fseek(file, 0, SEEK_SET))
		return failed(s->ctx);
	while ((n = fread(piece, 1, PIECE, file)) > 0) {
		if (pieces++ % PIECES == 0)
			mr_print(s, "%s%s", pieces > 1 ? after : "", before);
		mr_put_base64(s, piece, n);
	}
	mr_print(s, "%s", after);
	return ferror(file) ? failed(s->ctx) : s->status;
}

/* Model N stands in PAGE.N.js beside PAGE.html. */
static char *
name_beside(mr_ctx *ctx, const mr_page *page)
{
	size_t stem = strlen(page->beside) - strlen(".html");

	return mr_format(ctx, "%.*s.%zu.js", (int)stem, page->beside, page->models);
}

/* Writes the file of the model that is complete, if it goes beside the page. */
static mr_status
write_beside(mr_ctx *ctx, mr_page *page)
{
	mr_page_stream *other = &page->other;
	mr_sink sink;

	if (!other->file)
		return MR_OK;
	MR_TRY(mr_writer_end(ctx, other->writer));
	MR_TRY(check_size(ctx, lseek(fileno(other->file), 0, SEEK_CUR), &page->pictures));
	MR_TRY(mr_sink_open(ctx, name_beside(ctx, page), false, &sink));
	MR_TRY(mr_sink_close(&sink, put_stream(&sink, other->file, "mrPart(\"", "\");\n")));
	free_stream(other);
	return MR_OK;
}

/* Puts the name of the frame's file, as part of an address, and its history into the page's stream. */
static mr_status
put_reference(mr_ctx *ctx, mr_page *page, const mr_frame *frame)
{
	mr_frame f = { .name = frame->name, .key = frame->key, .number = frame->number };
	const mr_column *history = mr_frame_find(frame, "", "history");
	mr_text notes = begin_notes(ctx, page);

	if (history)
		MR_TRY(mr_frame_pass(ctx, &f, history));
	mr_text_add(&notes, "beside ");
	for (const char *s = mr_file_name(name_beside(ctx, page)); *s; s++) {
		unsigned byte = (unsigned char)*s;
		mr_text_add(&notes, byte <= ' ' || strchr("%?#\\", *s) ? "%%%02X" : "%c", byte);
	}
	mr_text_add(&notes, "\n");
	MR_TRY(mr_frame_put(ctx, &f, "", "page", (mr_shape){ '-', 't', 1 }, notes.s, notes.n));
	return put_frame(ctx, &page->stream, &f);
}

mr_status
mr_page_add(mr_ctx *ctx, mr_page *page, mr_frame *frame, const char *layers)
{
	mr_frame shown = { .name = frame->name, .key = frame->key, .number = frame->number };
	displaced surface;
	bool beside;

	if (frame->key)
		MR_TRY(write_beside(ctx, page));
	page->models += frame->key;
	beside = page->beside && page->models > 1;
	MR_TRY(find_displaced(ctx, page, frame, layers, &surface));
	MR_TRY(check_layers(ctx, frame, layers, &surface));
	if (is_posable(frame, layers))
		MR_TRY(check_posing(ctx, frame));
	MR_TRY(take_frame(ctx, frame, page, layers, &surface, &shown));
	if (beside)
		MR_TRY(put_reference(ctx, page, frame));
	MR_TRY(put_frame(ctx, beside ? &page->other : &page->stream, &shown));
	page->frames++;
	page->packed |= surface.packed;
	return MR_OK;
}

static mr_status
put_page(mr_sink *s, const mr_page *page, const char *html)
{
	static const char mark[] = "<!-- stream -->\n";
	const char *at = strstr(html, mark);

	MR_ENTER(s->ctx);
	mr_put(s, html, (size_t)(at - html));
	MR_TRY(
	    put_stream(s, page->stream.file, "<script type=\"text/plain\" class=\"stream\">", "</script>\n"));
	MR_TRY(mr_page_pictures_put(s, &page->pictures));
	mr_put(s, at + strlen(mark), strlen(at + strlen(mark)));
	return s->status;
}

mr_status
mr_page_write(mr_ctx *ctx, mr_page *page, const char *html, const char *path, mr_outfile *held)
{
	mr_sink sink;

	MR_TRY(mr_page_pictures_check(ctx, &page->pictures));
	if (page->pack > 0 && !page->packed)
		return mr_fail(
		    ctx, MR_EMISSING, "no frame has a displaced surface to pack: mr-sample makes one");
	MR_TRY(write_beside(ctx, page));
	MR_TRY(mr_writer_end(ctx, page->stream.writer));
	MR_TRY(check_size(ctx, lseek(fileno(page->stream.file), 0, SEEK_CUR), &page->pictures));
	MR_TRY(mr_sink_open(ctx, path, false, &sink));
	sink.hold = true;
	MR_TRY(mr_sink_close(&sink, put_page(&sink, page, html)));
	*held = sink.file;
	return MR_OK;
}

void
mr_page_free(mr_page *page)
{
	free_stream(&page->stream);
	free_stream(&page->other);
	*page = (mr_page){ 0 };
}
