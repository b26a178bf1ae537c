/* A frame layer by layer: its columns, then the figures of its surface or cloud, then the laws. */
#include "measure/report.h"

#include "mesh/validate.h"
#include "space/sampling.h"
#include "subdivide/displaced.h"

/* ---- figures of a surface and of a cloud: tables that people and JSON get by the same names ---- */

typedef enum figure_kind {
	COUNT, /* size_t; MR_UNKNOWN is none */
	FLAW,  /* the same; people hear of it where it is not 0 */
	WHOLE, /* int64_t */
	REAL,  /* double */
	TRUTH  /* bool */
} figure_kind;

typedef struct figure {
	const char *name;
	figure_kind kind;
	size_t offset;    /* in the struct */
	const char *line; /* for people: what their next line is about; NULL: it goes on */
} figure;

#define LENGTH(array) (sizeof(array) / sizeof *(array))

static void
value(mr_text *t, const figure *f, const void *x, bool json)
{
	const char *none = json ? "null" : "-", *yes = json ? "true" : "yes", *no = json ? "false" : "no";

	if (f->kind == REAL && json)
		mr_text_number(t, *(const double *)x);
	else if (f->kind == REAL)
		mr_text_figure(t, "", 6, *(const double *)x);
	else if (f->kind == WHOLE)
		mr_text_add(t, "%lld", (long long)*(const int64_t *)x);
	else if (f->kind == TRUTH)
		mr_text_add(t, "%s", *(const bool *)x ? yes : no);
	else if (*(const size_t *)x == MR_UNKNOWN)
		mr_text_add(t, "%s", none);
	else
		mr_text_add(t, "%zu", *(const size_t *)x);
}

/* Appends ,"name":value for each of n figures of the struct at `values`. */
static void
figures_json(mr_text *t, const figure *table, size_t n, const void *values)
{
	for (size_t i = 0; i < n; i++) {
		mr_text_add(t, ",\"%s\":", table[i].name);
		value(t, &table[i], (const char *)values + table[i].offset, true);
	}
}

/* A name with blanks. */
static void
name_text(mr_text *t, const char *name)
{
	for (; *name; name++)
		mr_text_add(t, "%c", *name == '_' ? ' ' : *name);
}

/* The same in lines, of which the first figure begins one. */
static void
figures_text(mr_text *t, const figure *table, size_t n, const void *values)
{
	bool any = false;

	for (size_t i = 0; i < n; i++) {
		const void *x = (const char *)values + table[i].offset;
		if (table[i].line) {
			mr_text_add(t, "%s    %-14s", i == 0 ? "" : any ? "\n" : " none\n", table[i].line);
			any = false;
		}
		if (table[i].kind == FLAW && *(const size_t *)x == 0)
			continue;
		mr_text_add(t, any ? ", " : " ");
		name_text(t, table[i].name);
		mr_text_add(t, " ");
		value(t, &table[i], x, false);
		any = true;
	}
	mr_text_add(t, any ? "\n" : " none\n");
}

static const figure surface_figures[] = {
	{ "components", COUNT, offsetof(mr_surface_figures, census.components), "topology" },
	{ "euler", WHOLE, offsetof(mr_surface_figures, census.euler), NULL },
	{ "genus", COUNT, offsetof(mr_surface_figures, census.genus), NULL },
	{ "boundary_loops", COUNT, offsetof(mr_surface_figures, census.boundary_loops), NULL },
	{ "oriented", TRUTH, offsetof(mr_surface_figures, census.oriented), NULL },
	{ "manifold", TRUTH, offsetof(mr_surface_figures, census.manifold), NULL },
	{ "nonmanifold_edges", FLAW, offsetof(mr_surface_figures, census.nonmanifold_edges), "flaws" },
	{ "nonmanifold_vertices", FLAW, offsetof(mr_surface_figures, census.nonmanifold_vertices), NULL },
	{ "inconsistent_edges", FLAW, offsetof(mr_surface_figures, census.inconsistent_edges), NULL },
	{ "degenerate_faces", FLAW, offsetof(mr_surface_figures, census.degenerate_faces), NULL },
	{ "duplicate_faces", FLAW, offsetof(mr_surface_figures, census.duplicate_faces), NULL },
	{ "isolated_vertices", FLAW, offsetof(mr_surface_figures, census.isolated_vertices), NULL },
	{ "folded_edges", FLAW, offsetof(mr_surface_figures, census.folded_edges), NULL },
	{ "intersecting_pairs", FLAW, offsetof(mr_surface_figures, intersections), NULL },
	{ "diagonal", REAL, offsetof(mr_surface_figures, geometry.diagonal), "size" },
	{ "area", REAL, offsetof(mr_surface_figures, geometry.area), NULL },
	{ "volume", REAL, offsetof(mr_surface_figures, geometry.volume), NULL },
	{ "edges", COUNT, offsetof(mr_surface_figures, census.edges), "edges" },
	{ "boundary_edges", COUNT, offsetof(mr_surface_figures, census.boundary_edges), NULL },
	{ "edge_min", REAL, offsetof(mr_surface_figures, geometry.edge.min), NULL },
	{ "edge_mean", REAL, offsetof(mr_surface_figures, geometry.edge.mean), NULL },
	{ "edge_max", REAL, offsetof(mr_surface_figures, geometry.edge.max), NULL },
	{ "edge_deviation", REAL, offsetof(mr_surface_figures, geometry.edge.deviation), NULL },
	{ "angle_min", REAL, offsetof(mr_surface_figures, geometry.angle_min), "angles" },
	{ "angle_max", REAL, offsetof(mr_surface_figures, geometry.angle_max), NULL },
	{ "angle_error", REAL, offsetof(mr_surface_figures, geometry.angle_error), NULL },
	{ "valence6", REAL, offsetof(mr_surface_figures, geometry.valence6), NULL },
	{ "interior_vertices", COUNT, offsetof(mr_surface_figures, evenness.vertices), "Voronoi areas" },
	{ "voronoi_mean", REAL, offsetof(mr_surface_figures, evenness.mean), NULL },
	{ "voronoi_error", REAL, offsetof(mr_surface_figures, evenness.error), NULL },
	{ "voronoi_variance", REAL, offsetof(mr_surface_figures, evenness.variance), NULL },
};

static const figure cloud_figures[] = {
	{ "not_finite", COUNT, offsetof(mr_cloud_figures, not_finite), "points" },
	{ "duplicates", COUNT, offsetof(mr_cloud_figures, duplicates), NULL },
	{ "places", COUNT, offsetof(mr_cloud_figures, places), NULL },
	{ "outliers", COUNT, offsetof(mr_cloud_figures, outliers), NULL },
	{ "diagonal", REAL, offsetof(mr_cloud_figures, diagonal), "size" },
	{ "area", REAL, offsetof(mr_cloud_figures, area), NULL },
	{ "spacing_min", REAL, offsetof(mr_cloud_figures, spacing.min), "spacing" },
	{ "spacing_mean", REAL, offsetof(mr_cloud_figures, spacing.mean), NULL },
	{ "spacing_max", REAL, offsetof(mr_cloud_figures, spacing.max), NULL },
	{ "spacing_deviation", REAL, offsetof(mr_cloud_figures, spacing.deviation), NULL },
	{ "spacing_median", REAL, offsetof(mr_cloud_figures, usual), NULL },
	{ "evenness", REAL, offsetof(mr_cloud_figures, evenness), NULL },
	{ "noise", REAL, offsetof(mr_cloud_figures, noise), "noise" },
	{ "noise_spacing", REAL, offsetof(mr_cloud_figures, noise_spacing), NULL },
	{ "noise_diagonal", REAL, offsetof(mr_cloud_figures, noise_diagonal), NULL },
};

/* Nothing has no box. */
static void
box(mr_text *t, const mr_box *b, bool json)
{
	const double x[6] = { b->min.x, b->min.y, b->min.z, b->max.x, b->max.y, b->max.z };
	const double far = mr_box_largest(*b) / mr_box_diagonal(*b); /* from the origin, in diagonals */
	const int digits = 6 + (far > 1 && far < 1e11 ? (int)log10(far) : 0);

	for (int i = 0; i < 6; i++) {
		const char *before = i == 0 ? ",\"box\":[[" : i == 3 ? "],[" : ",";
		if (json) {
			mr_text_add(t, "%s", before);
			mr_text_number(t, x[i]);
		} else
			mr_text_figure(t,
			    i == 0   ? "    box            "
			    : i == 3 ? " to "
				     : " ",
			    digits, x[i]);
	}
	mr_text_add(t, json ? "]]" : "\n");
}

/* The figures of the struct at `values`, and its box.  json: members of an object, a comma before each. */
static void
figures(mr_text *t, const figure *table, size_t n, const void *values, const mr_box *b, bool json)
{
	(json ? figures_json : figures_text)(t, table, n, values);
	box(t, b, json);
}

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

/* The columns of a layer; "": columns of no layer. */
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
	figures(r->t, surface_figures, LENGTH(surface_figures), &s, &s.geometry.box, r->opts->json);
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
	figures(r->t, cloud_figures, LENGTH(cloud_figures), &c, &c.box, r->opts->json);
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

static void
report_files(const report *r)
{
	for (const mr_column *c = r->f->columns; c < r->f->columns + r->f->count; c++)
		if (mr_column_is_file(c))
			mr_text_add(r->t, "  file             %s, %llu bytes\n", c->name,
			    (unsigned long long)c->rows);
}

static mr_status
report_text(report *r)
{
	mr_text_add(r->t, "%s: frame %llu, %s\n", r->f->name, (unsigned long long)r->f->number,
	    r->f->key ? "key" : "delta");
	report_history(r);
	MR_TRY(report_latest(r));
	report_files(r);
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

/* ---- a comparison ---- */

static const figure distance_figures[] = {
	{ "min", REAL, offsetof(mr_distance, min), NULL },
	{ "max", REAL, offsetof(mr_distance, max), NULL },
	{ "max_bound", REAL, offsetof(mr_distance, max_bound), NULL },
	{ "mean", REAL, offsetof(mr_distance, mean), NULL },
	{ "rms", REAL, offsetof(mr_distance, rms), NULL },
	{ "samples", COUNT, offsetof(mr_distance, samples), NULL },
	{ "q50", REAL, offsetof(mr_distance, quantile[0]), NULL },
	{ "q90", REAL, offsetof(mr_distance, quantile[1]), NULL },
	{ "q95", REAL, offsetof(mr_distance, quantile[2]), NULL },
	{ "q99", REAL, offsetof(mr_distance, quantile[3]), NULL },
	{ "normal_mean", REAL, offsetof(mr_distance, normal_mean), NULL },
	{ "normal_q50", REAL, offsetof(mr_distance, normal_quantile[0]), NULL },
	{ "normal_q90", REAL, offsetof(mr_distance, normal_quantile[1]), NULL },
	{ "normal_q95", REAL, offsetof(mr_distance, normal_quantile[2]), NULL },
	{ "normal_q99", REAL, offsetof(mr_distance, normal_quantile[3]), NULL },
};

static const figure deviation_figures[] = {
	{ "vertex_max", REAL, offsetof(mr_deviation, max), "vertices" },
	{ "vertex_mean", REAL, offsetof(mr_deviation, mean), NULL },
	{ "vertex_rms", REAL, offsetof(mr_deviation, rms), NULL },
	{ "vertex_worst", COUNT, offsetof(mr_deviation, vertex), NULL },
	{ "stretch_min", REAL, offsetof(mr_deviation, stretch_min), "edges" },
	{ "stretch_mean", REAL, offsetof(mr_deviation, stretch_mean), NULL },
	{ "stretch_max", REAL, offsetof(mr_deviation, stretch_max), NULL },
};

static void
distance_json(mr_text *t, const char *name, const mr_distance *d)
{
	mr_text_add(t, ",\"%s\":{\"hausdorff\":", name);
	mr_text_number(t, d->max);
	figures_json(t, distance_figures, LENGTH(distance_figures), d);
	mr_text_add(t, "}");
}

static void
comparison_json(const mr_comparison *c, const mr_frame *f, const char *a, const char *b, mr_text *t)
{
	const mr_distance *d[3] = { &c->ab, &c->ba, &c->both };
	static const char *const names[2][3] = { { "a_to_b", "b_to_a", "both" },
		{ "a_to_b_relative", "b_to_a_relative", "both_relative" } };

	mr_text_add(t, "{\"frame\":%llu,\"name\":", (unsigned long long)f->number);
	mr_text_json(t, f->name, strlen(f->name));
	mr_text_add(t, ",\"a\":");
	mr_text_json(t, a, strlen(a));
	mr_text_add(t, ",\"b\":");
	mr_text_json(t, b, strlen(b));
	mr_text_add(t, ",\"diagonal\":");
	mr_text_number(t, c->diagonal);
	for (int i = 0; i < 3; i++)
		distance_json(t, names[0][i], d[i]);
	for (int i = 0; i < 3; i++) {
		mr_distance x = *d[i];
		for (const figure *g = distance_figures; strcmp(g->name, "normal_mean"); g++)
			if (g->kind == REAL)
				*(double *)(void *)((char *)&x + g->offset) /= c->diagonal;
		distance_json(t, names[1][i], &x);
	}
	mr_text_add(t, ",\"corresponds\":%s", c->corresponds ? "true" : "false");
	if (c->corresponds) {
		figures_json(t, deviation_figures, LENGTH(deviation_figures), &c->deviation);
		mr_text_add(t, ",\"vertex_max_relative\":");
		mr_text_number(t, c->deviation.max / c->diagonal);
	}
	mr_text_add(t, "}\n");
}

static void
row_text(mr_text *t, const char *name, const double *x, size_t n, double unit)
{
	mr_text_add(t, "  %-12s", name);
	for (size_t i = 0; i < n; i++)
		if (isfinite(x[i] / unit))
			mr_text_add(t, " %12.6g", x[i] / unit);
		else
			mr_text_add(t, " %12s", "-");
	mr_text_add(t, "\n");
}

static void
comparison_text(const mr_comparison *c, const mr_frame *f, const char *a, const char *b, mr_text *t)
{
	const mr_distance *d[4] = { &c->ab, &c->ba, &c->both, &c->both };
	static const char *const names[4] = { "a to b", "b to a", "both", "both, %" };
	int rows = c->diagonal > 0 ? 4 : 3;

	mr_text_add(t, "%s: frame %llu, a: %s, b: %s", f->name, (unsigned long long)f->number, a, b);
	mr_text_figure(t, ", diagonal of b ", 6, c->diagonal);
	mr_text_add(t, "\n");
	mr_text_add(
	    t, "  %-12s %12s %12s %12s %12s %12s\n", "distance", "min", "mean", "rms", "max", "at most");
	for (int i = 0; i < rows; i++) {
		const double x[5] = { d[i]->min, d[i]->mean, d[i]->rms, d[i]->max, d[i]->max_bound };
		row_text(t, names[i], x, 5, i < 3 ? 1 : c->diagonal / 100);
	}
	mr_text_add(
	    t, "  %-12s %12s %12s %12s %12s %12s\n", "quantile", "50 %", "90 %", "95 %", "99 %", "mean");
	for (int i = 0; i < (isnan(c->both.normal_mean) ? 1 : 2); i++) {
		const double *q = i ? c->both.normal_quantile : c->both.quantile,
			     x[5] = { q[0], q[1], q[2], q[3], i ? c->both.normal_mean : c->both.mean };
		row_text(t, i ? "of normals" : "of distances", x, 5, 1);
	}
	if (c->corresponds)
		figures_text(t, deviation_figures, LENGTH(deviation_figures), &c->deviation);
}

void
mr_report_comparison(
    const mr_comparison *c, const mr_frame *f, const char *a, const char *b, bool json, mr_text *text)
{
	if (json)
		comparison_json(c, f, a, b, text);
	else
		comparison_text(c, f, a, b, text);
}
