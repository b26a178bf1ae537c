/* A frame layer by layer: its columns, then the figures of its surface or cloud, then the laws. */
#include "measure/report.h"

#include "measure/report_parts.h"
#include "mesh/validate.h"
#include "space/sampling.h"
#include "subdivide/displaced.h"

typedef struct report {
	mr_ctx *ctx;
	mr_frame *f;
	const mr_report_opts *opts;
	mr_text *t;
	const char *first; /* law broken */
	size_t broken;
} report;

/* ---- columns ---- */

/* Bytes of the column's values. */
static uint64_t
raw_bytes(const mr_column *c)
{
	return c->rows * c->shape.components * mr_type_size(c->shape.type);
}

/* Bytes of its payload in the stream: the last field of its header. */
static uint64_t
stored_bytes(const mr_column *c)
{
	uint64_t n = 0;

	if (!c->header)
		return raw_bytes(c);
	for (int i = 7; i >= 0; i--)
		n = n << 8 | c->header[MR_HEADER - 8 + i];
	return n;
}

static double
packed_ratio(const mr_column *c)
{
	return raw_bytes(c) ? (double)stored_bytes(c) / (double)raw_bytes(c) : 1;
}

static void
column_text(mr_text *t, const mr_column *c)
{
	mr_text_add(t, "    %-14s %c %c%-2u %12llu rows %14llu bytes", c->name, c->shape.element,
	    c->shape.type, c->shape.components, (unsigned long long)c->rows,
	    (unsigned long long)stored_bytes(c));
	if (stored_bytes(c) != raw_bytes(c))
		mr_text_add(t, ", packed to %.3g %%", 100 * packed_ratio(c));
	mr_text_add(t, "\n");
}

static void
column_json(mr_text *t, const mr_column *c)
{
	mr_text_json(t, c->name, strlen(c->name));
	mr_text_add(t, ":{\"element\":\"%c\",\"type\":\"%c\",\"components\":%u,\"rows\":%llu,\"bytes\":%llu",
	    c->shape.element, c->shape.type, c->shape.components, (unsigned long long)c->rows,
	    (unsigned long long)raw_bytes(c));
	mr_text_add(t, ",\"stored\":%llu,\"ratio\":", (unsigned long long)stored_bytes(c));
	mr_text_number(t, packed_ratio(c));
	mr_text_add(t, "}");
}

/* The columns of a layer; "": those of none. */
static void
columns(const report *r, const char *layer)
{
	bool first = true;

	for (size_t i = 0; i < r->f->count; i++) {
		const mr_column *c = &r->f->columns[i];
		if (strcmp(c->layer, layer))
			continue;
		if (!r->opts->json) {
			column_text(r->t, c);
			continue;
		}
		mr_text_add(r->t, first ? "" : ",");
		column_json(r->t, c);
		first = false;
	}
}

/* ---- layers ---- */

/* A layer of columns alone, with a sentence where it should have been more. */
static void
plain_layer(const report *r, const char *layer, const char *sentence)
{
	if (r->opts->json) {
		mr_text_add(r->t, "\"kind\":\"columns\",\"invalid\":");
		if (sentence)
			mr_text_json(r->t, sentence, strlen(sentence));
		else
			mr_text_add(r->t, "null");
		return;
	}
	mr_text_add(r->t, "  %s\n", layer);
	columns(r, layer);
	if (sentence)
		mr_text_add(r->t, "    invalid        %s\n", sentence);
}

static mr_status
report_surface(const report *r, const char *layer)
{
	mr_surface_figures s;
	mr_mesh m;

	MR_TRY(mr_layer_mesh(r->ctx, r->f, layer, &m));
	MR_TRY(mr_measure_surface(r->ctx, &m, !r->opts->skip_intersections, &s));
	if (r->opts->json) {
		mr_text_add(r->t, "\"kind\":\"surface\",\"vertices\":%zu,\"faces\":%zu", m.nv, m.nf);
	} else {
		mr_text_add(r->t, "  %s: %zu vertices, %zu faces\n", layer, m.nv, m.nf);
		columns(r, layer);
	}
	mr_report_surface(r->t, &s, r->opts->json);
	return MR_OK;
}

static mr_status
report_cloud(const report *r, const char *layer)
{
	mr_cloud_figures c;

	MR_TRY(mr_measure_cloud(r->ctx, r->f, layer, &c));
	if (r->opts->json) {
		mr_text_add(r->t, "\"kind\":\"cloud\",\"points\":%zu", c.points);
	} else {
		mr_text_add(r->t, "  %s: %zu points\n", layer, c.points);
		columns(r, layer);
	}
	mr_report_cloud(r->t, &c, r->opts->json);
	return MR_OK;
}

static mr_status
report_layer(const report *r, const char *layer)
{
	bool positions = mr_layer_has(r->f, layer, "position");
	const mr_column *faces = mr_frame_find(r->f, layer, "triangles");
	mr_status status = MR_OK;

	if (r->opts->json) {
		mr_text_json(r->t, layer, strlen(layer));
		mr_text_add(r->t, ":{\"columns\":{");
		columns(r, layer);
		mr_text_add(r->t, "},");
	}
	if (!positions)
		plain_layer(r, layer, NULL);
	else if ((status = faces && faces->rows ? report_surface(r, layer) : report_cloud(r, layer)) < 0)
		plain_layer(r, layer, r->ctx->error);
	if (r->opts->json)
		mr_text_add(r->t, "}");
	return status == MR_EMEM ? status : MR_OK;
}

static mr_status
report_layers(const report *r)
{
	const char *only = r->opts->layer;
	bool any = false;

	if (only && !mr_frame_has_layer(r->f, only))
		return mr_layer_missing(r->ctx, r->f, only, only);
	for (size_t i = 0; i < r->f->count; i++) {
		if (!mr_frame_begins_layer(r->f, i) || (only && strcmp(only, r->f->columns[i].layer)))
			continue;
		if (any && r->opts->json)
			mr_text_add(r->t, ",");
		any = true;
		MR_TRY(report_layer(r, r->f->columns[i].layer));
	}
	return MR_OK;
}

/* ---- the frame ---- */

/* The lines of the history; its absence, or damage, is none. */
static void
report_history(const report *r)
{
	const char *s, *end;
	bool first = true;
	size_t n;

	if (mr_frame_lines(r->ctx, r->f, "history", &s, &n) != MR_OK)
		return;
	for (end = s + n; s < end; first = false) {
		const char *stop = memchr(s, '\n', (size_t)(end - s));
		size_t length = (size_t)((stop ? stop : end) - s);
		if (r->opts->json) {
			mr_text_add(r->t, first ? "" : ",");
			mr_text_json(r->t, s, length);
		} else {
			mr_text_add(r->t, "  %-16s ", first ? "history" : "");
			mr_text_line(r->t, s, length);
			mr_text_add(r->t, "\n");
		}
		s += length + (stop != NULL);
	}
}

static mr_status
report_latest(const report *r)
{
	const char *layer;

	MR_TRY(mr_layer_latest(r->ctx, r->f, &layer));
	if (r->opts->json) {
		mr_text_add(r->t, ",\"latest\":");
		if (layer)
			mr_text_json(r->t, layer, strlen(layer));
		else
			mr_text_add(r->t, "null");
	} else if (layer) {
		mr_text_add(r->t, "  latest           %s\n", layer);
	}
	return MR_OK;
}

/* Lists a law that is broken. */
static void
list_broken(void *user, const char *sentence)
{
	report *r = user;

	if (r->opts->json) {
		mr_text_add(r->t, r->broken ? "," : "");
		mr_text_json(r->t, sentence, strlen(sentence));
	} else {
		mr_text_add(r->t, "  broken           %s\n", sentence);
	}
	if (r->broken++ == 0)
		r->first = mr_format(r->ctx, "%s", sentence);
}

/* Lists the sentence of a failure; none stays. */
static mr_status
list_failure(report *r, mr_status status)
{
	if (status == MR_EMEM)
		return status;
	if (status < 0)
		list_broken(r, r->ctx->error);
	*r->ctx->error = '\0';
	return MR_OK;
}

/* The sampling of the layers that have one. */
static mr_status
check_samplings(report *r)
{
	for (size_t i = 0; i < r->f->count; i++) {
		const mr_column *c = &r->f->columns[i];
		mr_sampling sampling;
		bool stored;
		if (!strcmp(c->name, "position"))
			MR_TRY(list_failure(
			    r, mr_sampling_stored(r->ctx, r->f, c->layer, c->rows, &sampling, &stored)));
	}
	return MR_OK;
}

/* The laws of each layer, its sampling, and whether the displacement can be decoded. */
static mr_status
check(report *r)
{
	mr_check_frame(r->ctx, r->f, list_broken, r);
	MR_TRY(check_samplings(r));
	return list_failure(r, mr_displacement_check(r->ctx, r->f));
}

static mr_status
report_text(report *r)
{
	mr_text_add(r->t, "%s: frame %llu, %s\n", r->f->name, (unsigned long long)r->f->number,
	    r->f->key ? "key" : "delta");
	report_history(r);
	MR_TRY(report_latest(r));
	MR_TRY(report_layers(r));
	if (r->opts->check) {
		MR_TRY(check(r));
		if (!r->broken)
			mr_text_add(r->t, "  check            every layer keeps its laws\n");
	}
	return MR_OK;
}

static mr_status
report_json(report *r)
{
	mr_text_add(r->t, "{\"frame\":%llu,\"name\":", (unsigned long long)r->f->number);
	mr_text_json(r->t, r->f->name, strlen(r->f->name));
	mr_text_add(r->t, ",\"key\":%s,\"history\":[", r->f->key ? "true" : "false");
	report_history(r);
	mr_text_add(r->t, "]");
	MR_TRY(report_latest(r));
	mr_text_add(r->t, ",\"columns\":{");
	columns(r, "");
	mr_text_add(r->t, "},\"layers\":{");
	MR_TRY(report_layers(r));
	mr_text_add(r->t, "}");
	if (r->opts->check) {
		mr_text_add(r->t, ",\"broken\":[");
		MR_TRY(check(r));
		mr_text_add(r->t, "]");
	}
	mr_text_add(r->t, "}\n");
	return MR_OK;
}

mr_status
mr_report_frame(mr_ctx *ctx, mr_frame *f, const mr_report_opts *opts, mr_text *text, const char **broken)
{
	report r = { .ctx = ctx, .f = f, .opts = opts, .t = text };

	MR_TRY(opts->json ? report_json(&r) : report_text(&r));
	if (broken)
		*broken = r.first;
	return MR_OK;
}
