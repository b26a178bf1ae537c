/* The figures of a surface, of a cloud and of a comparison, for people and as JSON. */
#include "measure/report_parts.h"

typedef enum figure_kind {
	COUNT,  /* size_t */
	SIGNED, /* int64_t */
	REAL,   /* double */
	TRUTH   /* bool */
} figure_kind;

typedef struct figure {
	const char *name;
	figure_kind kind;
	size_t offset; /* in the struct */
} figure;

#define LENGTH(array) (sizeof(array) / sizeof *(array))

/* Appends ,"name":value for each of n figures of the struct at `values`. */
static void
figures_json(mr_text *t, const figure *table, size_t n, const void *values)
{
	for (size_t i = 0; i < n; i++) {
		const void *x = (const char *)values + table[i].offset;
		mr_text_add(t, ",\"%s\":", table[i].name);
		switch (table[i].kind) {
		case COUNT:
			mr_text_add(t, "%zu", *(const size_t *)x);
			break;
		case SIGNED:
			mr_text_add(t, "%lld", (long long)*(const int64_t *)x);
			break;
		case REAL:
			mr_text_number(t, *(const double *)x);
			break;
		case TRUTH:
			mr_text_add(t, *(const bool *)x ? "true" : "false");
			break;
		}
	}
}

static const figure surface_figures[] = {
	{ "edges", COUNT, offsetof(mr_surface_figures, census.edges) },
	{ "components", COUNT, offsetof(mr_surface_figures, census.components) },
	{ "euler", SIGNED, offsetof(mr_surface_figures, census.euler) },
	{ "oriented", TRUTH, offsetof(mr_surface_figures, census.oriented) },
	{ "manifold", TRUTH, offsetof(mr_surface_figures, census.manifold) },
	{ "boundary_edges", COUNT, offsetof(mr_surface_figures, census.boundary_edges) },
	{ "boundary_loops", COUNT, offsetof(mr_surface_figures, census.boundary_loops) },
	{ "nonmanifold_edges", COUNT, offsetof(mr_surface_figures, census.nonmanifold_edges) },
	{ "nonmanifold_vertices", COUNT, offsetof(mr_surface_figures, census.nonmanifold_vertices) },
	{ "inconsistent_edges", COUNT, offsetof(mr_surface_figures, census.inconsistent_edges) },
	{ "degenerate_faces", COUNT, offsetof(mr_surface_figures, census.degenerate_faces) },
	{ "duplicate_faces", COUNT, offsetof(mr_surface_figures, census.duplicate_faces) },
	{ "isolated_vertices", COUNT, offsetof(mr_surface_figures, census.isolated_vertices) },
	{ "folded_edges", COUNT, offsetof(mr_surface_figures, census.folded_edges) },
	{ "diagonal", REAL, offsetof(mr_surface_figures, geometry.diagonal) },
	{ "area", REAL, offsetof(mr_surface_figures, geometry.area) },
	{ "volume", REAL, offsetof(mr_surface_figures, geometry.volume) },
	{ "edge_min", REAL, offsetof(mr_surface_figures, geometry.edge.min) },
	{ "edge_mean", REAL, offsetof(mr_surface_figures, geometry.edge.mean) },
	{ "edge_max", REAL, offsetof(mr_surface_figures, geometry.edge.max) },
	{ "edge_deviation", REAL, offsetof(mr_surface_figures, geometry.edge.deviation) },
	{ "angle_min", REAL, offsetof(mr_surface_figures, geometry.angle_min) },
	{ "angle_max", REAL, offsetof(mr_surface_figures, geometry.angle_max) },
	{ "angle_error", REAL, offsetof(mr_surface_figures, geometry.angle_error) },
	{ "valence6", REAL, offsetof(mr_surface_figures, geometry.valence6) },
	{ "interior_vertices", COUNT, offsetof(mr_surface_figures, evenness.vertices) },
	{ "voronoi_mean", REAL, offsetof(mr_surface_figures, evenness.mean) },
	{ "voronoi_error", REAL, offsetof(mr_surface_figures, evenness.error) },
	{ "voronoi_variance", REAL, offsetof(mr_surface_figures, evenness.variance) },
};

static const figure cloud_figures[] = {
	{ "not_finite", COUNT, offsetof(mr_cloud_figures, not_finite) },
	{ "duplicates", COUNT, offsetof(mr_cloud_figures, duplicates) },
	{ "places", COUNT, offsetof(mr_cloud_figures, places) },
	{ "outliers", COUNT, offsetof(mr_cloud_figures, outliers) },
	{ "diagonal", REAL, offsetof(mr_cloud_figures, diagonal) },
	{ "spacing_min", REAL, offsetof(mr_cloud_figures, spacing.min) },
	{ "spacing_mean", REAL, offsetof(mr_cloud_figures, spacing.mean) },
	{ "spacing_max", REAL, offsetof(mr_cloud_figures, spacing.max) },
	{ "spacing_deviation", REAL, offsetof(mr_cloud_figures, spacing.deviation) },
	{ "spacing_median", REAL, offsetof(mr_cloud_figures, usual) },
	{ "evenness", REAL, offsetof(mr_cloud_figures, evenness) },
	{ "area", REAL, offsetof(mr_cloud_figures, area) },
	{ "noise", REAL, offsetof(mr_cloud_figures, noise) },
	{ "noise_spacing", REAL, offsetof(mr_cloud_figures, noise_spacing) },
	{ "noise_diagonal", REAL, offsetof(mr_cloud_figures, noise_diagonal) },
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

/* "3 folded edges", behind a comma where it is not the first; nothing for none. */
static void
flaw(mr_text *t, size_t n, const char *one, const char *many, bool *any)
{
	if (n)
		mr_text_add(t, "%s%zu %s", *any ? ", " : "", n, n == 1 ? one : many);
	*any |= n > 0;
}

static void
flaws_text(mr_text *t, const mr_surface_figures *s, bool intersections)
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
	flaw(t, intersections ? s->intersections : 0, "intersecting pair of faces",
	    "intersecting pairs of faces", &any);
	mr_text_add(t, "%s%s\n", any ? "" : "none", intersections ? "" : " (intersections not looked for)");
}

static void
topology_text(mr_text *t, const mr_census *c)
{
	mr_text_add(t, "    topology       %s, %soriented, %smanifold, %zu component%s, Euler number %lld",
	    c->boundary_edges ? "open" : "closed", c->oriented ? "" : "not ", c->manifold ? "" : "not ",
	    c->components, mr_plural(c->components), (long long)c->euler);
	if (c->oriented && c->manifold)
		mr_text_add(t, ", genus %lld", (long long)c->genus);
	mr_text_add(t, "\n");
	if (c->boundary_edges)
		mr_text_add(t, "    boundary       %zu edge%s in %zu loop%s\n", c->boundary_edges,
		    mr_plural(c->boundary_edges), c->boundary_loops, mr_plural(c->boundary_loops));
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

void
mr_report_surface_text(mr_text *t, const mr_surface_figures *s, bool intersections)
{
	const mr_geometry *g = &s->geometry;

	box_text(t, &g->box, g->diagonal);
	mr_text_figure(t, "    area           ", 6, g->area);
	if (!isnan(g->volume))
		mr_text_figure(t, ", volume ", 6, g->volume);
	mr_text_add(t, "\n");
	topology_text(t, &s->census);
	flaws_text(t, s, intersections);
	geometry_text(t, g);
	evenness_text(t, &s->evenness);
}

void
mr_report_surface_json(mr_text *t, const mr_surface_figures *s, bool intersections)
{
	figures_json(t, surface_figures, LENGTH(surface_figures), s);
	mr_text_add(t, ",\"genus\":");
	if (s->census.oriented && s->census.manifold)
		mr_text_add(t, "%lld", (long long)s->census.genus);
	else
		mr_text_add(t, "null");
	mr_text_add(t, ",\"intersecting_pairs\":");
	if (intersections)
		mr_text_add(t, "%zu", s->intersections);
	else
		mr_text_add(t, "null");
	box_json(t, &s->geometry.box);
}

void
mr_report_cloud_text(mr_text *t, const mr_cloud_figures *c)
{
	box_text(t, &c->box, c->diagonal);
	if (c->not_finite)
		mr_text_add(t, "    not finite     %zu\n", c->not_finite);
	mr_text_add(t, "    duplicates     %zu\n", c->duplicates);
	spread_text(t, "spacing", &c->spacing);
	if (!(c->usual > 0))
		return;
	mr_text_figure(t, "    sampling       median spacing ", 6, c->usual);
	mr_text_figure(t, ", evenness ", 3, c->evenness);
	mr_text_figure(t, ", area ", 6, c->area);
	mr_text_figure(t, "\n    noise          ", 3, c->noise_spacing);
	mr_text_figure(t, " spacings, ", 3, 100 * c->noise_diagonal);
	mr_text_add(t, " %% of the diagonal\n");
	mr_text_add(t, "    outliers       %zu\n", c->outliers);
}

void
mr_report_cloud_json(mr_text *t, const mr_cloud_figures *c)
{
	figures_json(t, cloud_figures, LENGTH(cloud_figures), c);
	box_json(t, &c->box);
}

/* ---- a comparison ---- */

static const figure distance_figures[] = {
	{ "min", REAL, offsetof(mr_distance, min) },
	{ "max", REAL, offsetof(mr_distance, max) },
	{ "max_bound", REAL, offsetof(mr_distance, max_bound) },
	{ "mean", REAL, offsetof(mr_distance, mean) },
	{ "rms", REAL, offsetof(mr_distance, rms) },
	{ "samples", COUNT, offsetof(mr_distance, samples) },
};

static const figure deviation_figures[] = {
	{ "vertex_max", REAL, offsetof(mr_deviation, max) },
	{ "vertex_mean", REAL, offsetof(mr_deviation, mean) },
	{ "vertex_rms", REAL, offsetof(mr_deviation, rms) },
	{ "vertex_worst", COUNT, offsetof(mr_deviation, vertex) },
	{ "stretch_min", REAL, offsetof(mr_deviation, stretch_min) },
	{ "stretch_mean", REAL, offsetof(mr_deviation, stretch_mean) },
	{ "stretch_max", REAL, offsetof(mr_deviation, stretch_max) },
};

static void
distance_json(mr_text *t, const char *name, const mr_distance *d)
{
	mr_text_add(t, ",\"%s\":{\"hausdorff\":", name);
	mr_text_number(t, d->max);
	figures_json(t, distance_figures, LENGTH(distance_figures), d);
	mr_text_add(t, "}");
}

static mr_distance
relative(const mr_distance *d, double diagonal)
{
	mr_distance r = { d->min / diagonal, d->max / diagonal, d->max_bound / diagonal, d->mean / diagonal,
		d->rms / diagonal, d->samples };

	return r;
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
		mr_distance x = relative(d[i], c->diagonal);
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
distance_text(mr_text *t, const char *name, const mr_distance *d, double unit)
{
	const double x[5] = { d->min, d->mean, d->rms, d->max, d->max_bound };

	mr_text_add(t, "  %-12s", name);
	for (int i = 0; i < 5; i++)
		if (isfinite(x[i] / unit))
			mr_text_add(t, " %12.6g", x[i] / unit);
		else
			mr_text_add(t, " %12s", "-");
	mr_text_add(t, "\n");
}

static void
deviation_text(mr_text *t, const mr_deviation *d)
{
	mr_text_figure(t, "  vertex       max ", 6, d->max);
	mr_text_add(t, " (vertex %zu)", d->vertex);
	mr_text_figure(t, ", mean ", 6, d->mean);
	mr_text_figure(t, ", rms ", 6, d->rms);
	mr_text_add(t, "\n");
	if (isnan(d->stretch_mean))
		return;
	mr_text_figure(t, "  edge stretch min ", 6, d->stretch_min);
	mr_text_figure(t, ", mean ", 6, d->stretch_mean);
	mr_text_figure(t, ", max ", 6, d->stretch_max);
	mr_text_add(t, "\n");
}

static void
comparison_text(const mr_comparison *c, const mr_frame *f, const char *a, const char *b, mr_text *t)
{
	mr_text_add(t, "%s: frame %llu, a: %s, b: %s", f->name, (unsigned long long)f->number, a, b);
	mr_text_figure(t, ", diagonal of b ", 6, c->diagonal);
	mr_text_add(t, "\n");
	mr_text_add(
	    t, "  %-12s %12s %12s %12s %12s %12s\n", "distance", "min", "mean", "rms", "max", "at most");
	distance_text(t, "a to b", &c->ab, 1);
	distance_text(t, "b to a", &c->ba, 1);
	distance_text(t, "both", &c->both, 1);
	if (c->diagonal > 0)
		distance_text(t, "both, %", &c->both, c->diagonal / 100);
	if (!c->corresponds)
		return;
	deviation_text(t, &c->deviation);
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
