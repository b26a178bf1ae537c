#include "alg/report.h"

#include "alg/figures.h"
#include "alg/measure.h"
#include "mesh/laws.h"

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

	if (!c->record)
		return raw_bytes(c);
	for (int i = 7; i >= 0; i--)
		n = n << 8 | c->record[MR_HEADER - 8 + i];
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

/* ---- figures ---- */

static const mr_figure surface_figures[] = {
	{ "edges", MR_FIGURE_COUNT, offsetof(mr_surface, census.edges) },
	{ "components", MR_FIGURE_COUNT, offsetof(mr_surface, census.components) },
	{ "euler", MR_FIGURE_SIGNED, offsetof(mr_surface, census.euler) },
	{ "oriented", MR_FIGURE_TRUTH, offsetof(mr_surface, census.oriented) },
	{ "manifold", MR_FIGURE_TRUTH, offsetof(mr_surface, census.manifold) },
	{ "boundary_edges", MR_FIGURE_COUNT, offsetof(mr_surface, census.boundary_edges) },
	{ "boundary_loops", MR_FIGURE_COUNT, offsetof(mr_surface, census.boundary_loops) },
	{ "nonmanifold_edges", MR_FIGURE_COUNT, offsetof(mr_surface, census.nonmanifold_edges) },
	{ "nonmanifold_vertices", MR_FIGURE_COUNT, offsetof(mr_surface, census.nonmanifold_vertices) },
	{ "inconsistent_edges", MR_FIGURE_COUNT, offsetof(mr_surface, census.inconsistent_edges) },
	{ "degenerate_faces", MR_FIGURE_COUNT, offsetof(mr_surface, census.degenerate_faces) },
	{ "duplicate_faces", MR_FIGURE_COUNT, offsetof(mr_surface, census.duplicate_faces) },
	{ "isolated_vertices", MR_FIGURE_COUNT, offsetof(mr_surface, census.isolated_vertices) },
	{ "folded_edges", MR_FIGURE_COUNT, offsetof(mr_surface, census.folded_edges) },
	{ "diagonal", MR_FIGURE_REAL, offsetof(mr_surface, geometry.diagonal) },
	{ "area", MR_FIGURE_REAL, offsetof(mr_surface, geometry.area) },
	{ "volume", MR_FIGURE_REAL, offsetof(mr_surface, geometry.volume) },
	{ "edge_min", MR_FIGURE_REAL, offsetof(mr_surface, geometry.edge.min) },
	{ "edge_mean", MR_FIGURE_REAL, offsetof(mr_surface, geometry.edge.mean) },
	{ "edge_max", MR_FIGURE_REAL, offsetof(mr_surface, geometry.edge.max) },
	{ "edge_deviation", MR_FIGURE_REAL, offsetof(mr_surface, geometry.edge.deviation) },
	{ "angle_min", MR_FIGURE_REAL, offsetof(mr_surface, geometry.angle_min) },
	{ "angle_max", MR_FIGURE_REAL, offsetof(mr_surface, geometry.angle_max) },
	{ "angle_error", MR_FIGURE_REAL, offsetof(mr_surface, geometry.angle_error) },
	{ "valence6", MR_FIGURE_REAL, offsetof(mr_surface, geometry.valence6) },
	{ "interior_vertices", MR_FIGURE_COUNT, offsetof(mr_surface, evenness.vertices) },
	{ "voronoi_mean", MR_FIGURE_REAL, offsetof(mr_surface, evenness.mean) },
	{ "voronoi_error", MR_FIGURE_REAL, offsetof(mr_surface, evenness.error) },
	{ "voronoi_variance", MR_FIGURE_REAL, offsetof(mr_surface, evenness.variance) },
};

static const mr_figure cloud_figures[] = {
	{ "not_finite", MR_FIGURE_COUNT, offsetof(mr_cloud, not_finite) },
	{ "duplicates", MR_FIGURE_COUNT, offsetof(mr_cloud, duplicates) },
	{ "diagonal", MR_FIGURE_REAL, offsetof(mr_cloud, diagonal) },
	{ "spacing_min", MR_FIGURE_REAL, offsetof(mr_cloud, spacing.min) },
	{ "spacing_mean", MR_FIGURE_REAL, offsetof(mr_cloud, spacing.mean) },
	{ "spacing_max", MR_FIGURE_REAL, offsetof(mr_cloud, spacing.max) },
	{ "spacing_deviation", MR_FIGURE_REAL, offsetof(mr_cloud, spacing.deviation) },
};

/* Nothing has no box. */
static void
box_json(mr_text *t, const mr_box *b)
{
	const double x[6] = { b->min.x, b->min.y, b->min.z, b->max.x, b->max.y, b->max.z };

	for (int i = 0; i < 6; i++) {
		mr_text_add(t, "%s", i == 0 ? ",\"box\":[[" : i == 3 ? "],[" : ",");
		mr_text_number(t, x[i]);
	}
	mr_text_add(t, "]]");
}

static void
box_text(mr_text *t, const mr_box *b, double diagonal)
{
	if (!(b->min.x <= b->max.x))
		return;
	mr_text_add(t, "    box            %.6g %.6g %.6g to %.6g %.6g %.6g", b->min.x, b->min.y, b->min.z,
	    b->max.x, b->max.y, b->max.z);
	mr_text_figure(t, ", diagonal ", 6, diagonal);
	mr_text_add(t, "\n");
}

/* What is rounding of a ratio is zero to people. */
static double
tidy(double ratio)
{
	return fabs(ratio) < 1e-12 ? 0 : ratio;
}

static const char *
plural(size_t n)
{
	return n == 1 ? "" : "s";
}

/* "3 folded edges", behind a comma where it is not the first; nothing for none. */
static void
flaw(mr_text *t, size_t n, const char *one, const char *many, bool *any)
{
	if (n)
		mr_text_add(t, "%s%zu %s", *any ? ", " : "", n, n == 1 ? one : many);
	*any |= n > 0;
}

static void
flaws_text(mr_text *t, const mr_surface *s, bool intersections)
{
	const mr_census *c = &s->census;
	bool any = false;

	mr_text_add(t, "    flaws          ");
	flaw(t, c->nonmanifold_edges, "non-manifold edge", "non-manifold edges", &any);
	flaw(t, c->nonmanifold_vertices, "non-manifold vertex", "non-manifold vertices", &any);
	flaw(t, c->inconsistent_edges, "inconsistently oriented edge", "inconsistently oriented edges", &any);
	flaw(t, c->degenerate_faces, "degenerate face", "degenerate faces", &any);
	flaw(t, c->duplicate_faces, "duplicate face", "duplicate faces", &any);
	flaw(t, c->isolated_vertices, "isolated vertex", "isolated vertices", &any);
	flaw(t, c->folded_edges, "folded edge", "folded edges", &any);
	flaw(t, s->intersections, "intersecting pair of faces", "intersecting pairs of faces", &any);
	mr_text_add(t, "%s%s\n", any ? "" : "none", intersections ? "" : " (intersections not looked for)");
}

static void
topology_text(mr_text *t, const mr_census *c)
{
	mr_text_add(t, "    topology       %s, %soriented, %smanifold, %zu component%s, Euler number %lld",
	    c->boundary_edges ? "open" : "closed", c->oriented ? "" : "not ", c->manifold ? "" : "not ",
	    c->components, plural(c->components), (long long)c->euler);
	if (c->oriented && c->manifold)
		mr_text_add(t, ", genus %lld", (long long)c->genus);
	mr_text_add(t, "\n");
	if (c->boundary_edges)
		mr_text_add(t, "    boundary       %zu edge%s in %zu loop%s\n", c->boundary_edges,
		    plural(c->boundary_edges), c->boundary_loops, plural(c->boundary_loops));
}

static void
spread_text(mr_text *t, const char *what, const mr_spread *s)
{
	mr_text_add(t, "    %-14s ", what);
	if (isnan(s->mean)) {
		mr_text_add(t, "-\n");
		return;
	}
	mr_text_figure(t, "min ", 6, s->min);
	mr_text_figure(t, ", mean ", 6, s->mean);
	mr_text_figure(t, ", max ", 6, s->max);
	mr_text_figure(t, ", deviation ", 3, s->deviation);
	mr_text_add(t, "\n");
}

static void
geometry_text(mr_text *t, const mr_geometry *g)
{
	spread_text(t, "edge lengths", &g->edge);
	if (!isnan(g->angle_min)) {
		mr_text_figure(t, "    angles         min ", 4, g->angle_min);
		mr_text_figure(t, ", max ", 4, g->angle_max);
		mr_text_figure(t, ", mean |angle - 60| ", 4, g->angle_error);
		mr_text_add(t, " degrees\n");
	}
	if (!isnan(g->valence6))
		mr_text_add(t, "    valence 6      %.4g %% of the vertices\n", 100 * g->valence6);
}

static void
evenness_text(mr_text *t, const mr_evenness *e)
{
	if (e->vertices == 0)
		return;
	mr_text_figure(t, "    Voronoi areas  mean ", 6, e->mean);
	mr_text_figure(t, ", mean relative deviation ", 4, 100 * tidy(e->error));
	mr_text_figure(t, " %, variance ", 4, tidy(e->variance));
	mr_text_add(t, " of the squared mean\n");
}

static void
surface_text(const report *r, const mr_mesh *m, const mr_surface *s)
{
	const mr_geometry *g = &s->geometry;
	mr_text *t = r->t;

	mr_text_add(t, "  %s: %zu vertices, %zu faces, %zu edges\n", m->name, m->nv, m->nf, s->census.edges);
	columns(r, m->name);
	box_text(t, &g->box, g->diagonal);
	mr_text_figure(t, "    area           ", 6, g->area);
	if (!isnan(g->volume))
		mr_text_figure(t, ", volume ", 6, g->volume);
	mr_text_add(t, "\n");
	topology_text(t, &s->census);
	flaws_text(t, s, !r->opts->skip_intersections);
	geometry_text(t, g);
	evenness_text(t, &s->evenness);
}

static void
surface_json(const report *r, const mr_mesh *m, const mr_surface *s)
{
	mr_text *t = r->t;

	mr_text_add(t, "\"kind\":\"surface\",\"vertices\":%zu,\"faces\":%zu", m->nv, m->nf);
	mr_figures_json(t, surface_figures, MR_LENGTH(surface_figures), s);
	mr_text_add(t, ",\"genus\":");
	if (s->census.oriented && s->census.manifold)
		mr_text_add(t, "%lld", (long long)s->census.genus);
	else
		mr_text_add(t, "null");
	mr_text_add(t, ",\"intersecting_pairs\":");
	if (r->opts->skip_intersections)
		mr_text_add(t, "null");
	else
		mr_text_add(t, "%zu", s->intersections);
	box_json(t, &s->geometry.box);
}

static void
cloud_text(const report *r, const char *layer, const mr_cloud *c)
{
	mr_text_add(r->t, "  %s: %zu points\n", layer, c->points);
	columns(r, layer);
	box_text(r->t, &c->box, c->diagonal);
	if (c->not_finite)
		mr_text_add(r->t, "    not finite     %zu\n", c->not_finite);
	mr_text_add(r->t, "    duplicates     %zu\n", c->duplicates);
	spread_text(r->t, "spacing", &c->spacing);
}

static void
cloud_json(const report *r, const mr_cloud *c)
{
	mr_text_add(r->t, "\"kind\":\"cloud\",\"points\":%zu", c->points);
	mr_figures_json(r->t, cloud_figures, MR_LENGTH(cloud_figures), c);
	box_json(r->t, &c->box);
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
	mr_surface s;
	mr_mesh m;

	MR_TRY(mr_layer_mesh(r->ctx, r->f, layer, &m));
	MR_TRY(mr_measure_surface(r->ctx, &m, !r->opts->skip_intersections, &s));
	if (r->opts->json)
		surface_json(r, &m, &s);
	else
		surface_text(r, &m, &s);
	return MR_OK;
}

static mr_status
report_cloud(const report *r, const char *layer)
{
	const void *p;
	mr_cloud c;
	size_t n;

	MR_TRY(mr_layer_get(r->ctx, r->f, layer, "position", &p, &n));
	MR_TRY(mr_measure_cloud(r->ctx, p, n, &c));
	if (r->opts->json)
		cloud_json(r, &c);
	else
		cloud_text(r, layer, &c);
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

/* Whether column i is the first of its layer. */
static bool
first_of_layer(const mr_frame *f, size_t i)
{
	for (size_t k = 0; k < i; k++)
		if (!strcmp(f->columns[k].layer, f->columns[i].layer))
			return false;
	return *f->columns[i].layer;
}

static mr_status
report_layers(const report *r)
{
	const char *only = r->opts->layer;
	bool any = false;

	if (only && !mr_frame_has_layer(r->f, only))
		return mr_fail(r->ctx, MR_EMISSING, "no layer %s", only);
	for (size_t i = 0; i < r->f->count; i++) {
		if (!first_of_layer(r->f, i) || (only && strcmp(only, r->f->columns[i].layer)))
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
	const mr_shape shape = { '-', 't', 1 };
	const void *data;
	const char *s, *end;
	bool first = true;
	size_t n;

	if (!mr_frame_find(r->f, "", "history") ||
	    mr_frame_get(r->ctx, r->f, "", "history", shape, &data, &n) != MR_OK)
		return;
	for (s = data, end = s + n; s < end; first = false) {
		const char *stop = memchr(s, '\n', (size_t)(end - s));
		size_t length = (size_t)((stop ? stop : end) - s);
		if (r->opts->json) {
			mr_text_add(r->t, first ? "" : ",");
			mr_text_json(r->t, s, length);
		} else {
			mr_text_add(r->t, "  %-16s %.*s\n", first ? "history" : "", (int)length, s);
		}
		s += length + (stop != NULL);
	}
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

static mr_status
report_text(report *r)
{
	mr_text_add(r->t, "%s: frame %llu, %s\n", r->f->name, (unsigned long long)r->f->number,
	    r->f->key ? "key" : "delta");
	report_history(r);
	MR_TRY(report_layers(r));
	if (r->opts->check) {
		MR_TRY(mr_check_frame(r->ctx, r->f, list_broken, r));
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
	mr_text_add(r->t, "],\"columns\":{");
	columns(r, "");
	mr_text_add(r->t, "},\"layers\":{");
	MR_TRY(report_layers(r));
	mr_text_add(r->t, "}");
	if (r->opts->check) {
		mr_text_add(r->t, ",\"broken\":[");
		MR_TRY(mr_check_frame(r->ctx, r->f, list_broken, r));
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
	if (r.broken && !r.first)
		return MR_EMEM;
	if (broken)
		*broken = r.first;
	return mr_text_done(text);
}
