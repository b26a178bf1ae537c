/* The page's data are a stream: what a browser shows of the frames, packed, in base64 between two halves of
 * HTML. */
#include "formats/page.h"

#include "formats/bytes.h"
#include "mesh/layers.h"

#include <errno.h>
#include <unistd.h>

/*
 * The most that a page may hold, in bytes of the packed stream: a browser holds it three times, as text, as
 * bytes and unpacked, and gives a page some 2 to 4 GB.
 */
static const off_t LARGEST_PAGE = 300000000;

/* Columns of vertices that say where they are on another layer, or that only serve to compute. */
static const char *const unseen[] = { "detail_face", "detail_bary", "detail_offset", "source_face",
	"source_bary", "mesh_face", "mesh_bary", "base_face", "base_bary", "control_face", "control_bary",
	"encoded", "rest", "target", "response", "texcoord", "polygon", NULL };

/* Texts that name the values of other columns. */
static const char *const texts[] = { "groups", "objects", "materials", NULL };

static bool
is_one_of(const char *name, const char *const *list)
{
	while (*list && strcmp(*list, name))
		list++;
	return *list != NULL;
}

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

/* Places, and up to four numbers that can give colours; a surface's normals the page makes from its
 * triangles. */
static bool
is_shown(const mr_frame *f, const mr_column *c, const char *layers)
{
	bool surface = mr_layer_has(f, c->layer, "triangles");

	if (!*c->layer)
		return !strcmp(c->name, "history") || !strcmp(c->name, "latest");
	if (!is_listed(c->layer, layers) || !mr_layer_has(f, c->layer, "position"))
		return false;
	if (c->shape.element == '-' || c->shape.type == 't')
		return is_one_of(c->name, texts);
	if (surface && !strcmp(c->name, "normal"))
		return false;
	return c->shape.components <= 4 && !is_one_of(c->name, unseen);
}

/* The nearest of the numbers that have 24 significant bits, as a float has, whatever the exponent. */
static double
round_number(double x)
{
	uint64_t bits;
	double y;

	memcpy(&bits, &x, sizeof bits);
	bits = (bits + (UINT64_C(1) << 28)) >> 29 << 29;
	memcpy(&y, &bits, sizeof y);
	return isfinite(y) ? y : x;
}

/* The step of a grid of 2^24 steps over the largest extent of the positions; 0 where they have none. */
static double
grid_step(const mr_v3 *p, size_t n)
{
	mr_v3 low = p[0], high = p[0];
	double extent;
	int exponent;

	for (size_t i = 1; i < n; i++) {
		low = mr_vec(fmin(low.x, p[i].x), fmin(low.y, p[i].y), fmin(low.z, p[i].z));
		high = mr_vec(fmax(high.x, p[i].x), fmax(high.y, p[i].y), fmax(high.z, p[i].z));
	}
	extent = fmax(high.x - low.x, fmax(high.y - low.y, high.z - low.z));
	if (!(extent > 0))
		return 0;
	frexp(extent, &exponent);
	return ldexp(1, exponent - 24);
}

/*
 * A browser draws with floats.  The stream has doubles alone, and needs nothing else: the low bits of rounded
 * ones are zero, and packing takes them away.  Positions are rounded by the model's extent, not by their
 * distance from the origin, so that less a common centre they are floats exactly.
 */
static void
round_column(const mr_column *c, double *rounded)
{
	size_t n = (size_t)c->rows * c->shape.components;
	bool places = c->rows > 0 && !strcmp(c->name, "position");
	double step = places ? grid_step(c->data, (size_t)c->rows) : 0;
	const double *x = c->data;

	for (size_t i = 0; i < n; i++)
		rounded[i] = !places ? round_number(x[i]) : step > 0 ? rint(x[i] / step) * step : x[i];
}

static mr_status
take_column(mr_ctx *ctx, mr_frame *to, const mr_column *column)
{
	mr_column c = *column;
	double *rounded;

	if (c.shape.type != 'd')
		return mr_frame_pass(ctx, to, column);
	MR_TRY(mr_column_decode(ctx, &c));
	rounded = MR_NEW(ctx, (size_t)c.rows * c.shape.components, double);
	if (!rounded)
		return MR_EMEM;
	round_column(&c, rounded);
	return mr_frame_put(ctx, to, c.layer, c.name, c.shape, rounded, (size_t)c.rows);
}

/* What is drawn must be a surface or points as any tool takes them: the page checks nothing. */
static mr_status
check_layer(mr_ctx *ctx, mr_frame *f, const char *layer)
{
	mr_mesh m;

	return mr_layer_surface_or_points(ctx, f, layer, &m);
}

static mr_status
check_layers(mr_ctx *ctx, mr_frame *f, const char *list)
{
	if (!list)
		MR_TRY(mr_layer_finished_or_warn(ctx, f));
	for (size_t i = 0; !list && i < f->count; i++)
		if (*f->columns[i].layer && !strcmp(f->columns[i].name, "position"))
			MR_TRY(check_layer(ctx, f, f->columns[i].layer));
	while (list) {
		size_t n = strcspn(list, ",");
		char *layer = mr_format(ctx, "%.*s", (int)n, list);
		if (!layer)
			return MR_EMEM;
		MR_TRY(check_layer(ctx, f, layer));
		list = list[n] ? list + n + 1 : NULL;
	}
	return MR_OK;
}

static mr_status
take_columns(mr_ctx *ctx, mr_frame *from, const char *layers, mr_frame *to, mr_page_result *r)
{
	for (size_t i = 0; i < from->count; i++) {
		const mr_column *c = &from->columns[i];
		bool shown = is_shown(from, c, layers);
		r->layers += shown && *c->layer && !strcmp(c->name, "position");
		r->columns += shown;
		r->left_out += !shown;
		if (shown)
			MR_TRY(take_column(ctx, to, c));
	}
	return MR_OK;
}

static mr_status
failed(mr_ctx *ctx)
{
	return mr_fail(ctx, MR_EIO, "the page's data, in a file for the time being: %s", strerror(errno));
}

static mr_status
begin(mr_ctx *ctx, mr_page *page)
{
	if (page->writer)
		return MR_OK;
	if (!page->file && !(page->file = tmpfile()))
		return failed(ctx);
	return mr_writer_open(ctx, fileno(page->file), MR_PACK, &page->writer);
}

static mr_status
check_size(mr_ctx *ctx, off_t size)
{
	if (size < 0)
		return failed(ctx);
	if (size > LARGEST_PAGE)
		return mr_fail(ctx, MR_ERANGE,
		    "the page comes to %.0f MB, and browsers take some %.0f: pick fewer layers by -l, or "
		    "fewer frames",
		    (double)size / 1e6, (double)LARGEST_PAGE / 1e6);
	return MR_OK;
}

/* Of a frame that fails nothing stays: others may follow. */
static mr_status
send_frame(mr_ctx *ctx, mr_page *page, const mr_frame *shown)
{
	int fd = fileno(page->file);
	off_t before = lseek(fd, 0, SEEK_CUR);
	mr_status status = mr_writer_put(ctx, page->writer, shown);

	if (status == MR_OK)
		status = check_size(ctx, lseek(fd, 0, SEEK_CUR));
	if (status == MR_OK)
		return MR_OK;
	mr_writer_skipped(page->writer);
	return ftruncate(fd, before) || lseek(fd, before, SEEK_SET) < 0 ? failed(ctx) : status;
}

mr_status
mr_page_add(mr_ctx *ctx, mr_page *page, mr_frame *frame, const char *layers, mr_page_result *result)
{
	mr_frame shown = { .name = frame->name, .key = frame->key, .number = frame->number };

	*result = (mr_page_result){ 0 };
	MR_TRY(check_layers(ctx, frame, layers));
	MR_TRY(take_columns(ctx, frame, layers, &shown, result));
	MR_TRY(begin(ctx, page));
	MR_TRY(send_frame(ctx, page, &shown));
	page->frames++;
	return MR_OK;
}

/* n bytes as text; only the last ones of a block may be no multiple of 3. */
static void
put_base64(mr_sink *s, const unsigned char *p, size_t n)
{
	static const char digit[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
	char *out = mr_sink_room(s);

	for (; n > 0; p += 3, n -= n < 3 ? n : 3) {
		uint32_t v = (uint32_t)p[0] << 16 | (n > 1 ? (uint32_t)p[1] << 8 : 0) | (n > 2 ? p[2] : 0u);
		*out++ = digit[v >> 18];
		*out++ = digit[v >> 12 & 63];
		*out++ = n > 1 ? digit[v >> 6 & 63] : '=';
		*out++ = n > 2 ? digit[v & 63] : '=';
	}
	mr_sink_fill(s, out);
}

/*
 * The stream in blocks, each an element of its own, which the page reads and drops one by one: no browser has
 * texts of 400 MB.
 */
static mr_status
put_stream(mr_sink *s, FILE *file)
{
	enum { PIECE = 3000, PIECES = 1000 };
	unsigned char piece[PIECE];
	size_t n, pieces = 0;

	if (fseek(file, 0, SEEK_SET))
		return failed(s->ctx);
	while ((n = fread(piece, 1, PIECE, file)) > 0) {
		if (pieces++ % PIECES == 0)
			mr_print(s, "%s<script type=\"text/plain\" class=\"stream\">",
			    pieces > 1 ? "</script>\n" : "");
		put_base64(s, piece, n);
	}
	mr_print(s, "</script>\n");
	return ferror(file) ? failed(s->ctx) : s->status;
}

static mr_status
put_page(mr_sink *s, const mr_page *page, const char *html)
{
	static const char mark[] = "<!-- stream -->\n";
	const char *at = strstr(html, mark);

	mr_put(s, html, (size_t)(at - html));
	MR_TRY(put_stream(s, page->file));
	mr_put(s, at + strlen(mark), strlen(at + strlen(mark)));
	return s->status;
}

mr_status
mr_page_write(mr_ctx *ctx, mr_page *page, const char *html, const char *path, mr_outfile *held)
{
	mr_sink sink;

	MR_TRY(mr_writer_end(ctx, page->writer));
	MR_TRY(mr_sink_open(ctx, path, false, &sink));
	sink.hold = true;
	MR_TRY(mr_sink_close(&sink, put_page(&sink, page, html)));
	*held = sink.file;
	return MR_OK;
}

void
mr_page_free(mr_page *page)
{
	mr_writer_free(page->writer);
	if (page->file)
		fclose(page->file);
	*page = (mr_page){ 0 };
}
