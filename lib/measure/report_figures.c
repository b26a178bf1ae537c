/* The figures of a surface and of a cloud, for people and as JSON. */
#include "measure/fields.h"
#include "measure/report_parts.h"

static const mr_figure surface_figures[] = {
	{ "edges", MR_FIGURE_COUNT, offsetof(mr_surface_figures, census.edges) },
	{ "components", MR_FIGURE_COUNT, offsetof(mr_surface_figures, census.components) },
	{ "euler", MR_FIGURE_SIGNED, offsetof(mr_surface_figures, census.euler) },
	{ "oriented", MR_FIGURE_TRUTH, offsetof(mr_surface_figures, census.oriented) },
	{ "manifold", MR_FIGURE_TRUTH, offsetof(mr_surface_figures, census.manifold) },
	{ "boundary_edges", MR_FIGURE_COUNT, offsetof(mr_surface_figures, census.boundary_edges) },
	{ "boundary_loops", MR_FIGURE_COUNT, offsetof(mr_surface_figures, census.boundary_loops) },
	{ "nonmanifold_edges", MR_FIGURE_COUNT, offsetof(mr_surface_figures, census.nonmanifold_edges) },
	{ "nonmanifold_vertices", MR_FIGURE_COUNT,
	    offsetof(mr_surface_figures, census.nonmanifold_vertices) },
	{ "inconsistent_edges", MR_FIGURE_COUNT, offsetof(mr_surface_figures, census.inconsistent_edges) },
	{ "degenerate_faces", MR_FIGURE_COUNT, offsetof(mr_surface_figures, census.degenerate_faces) },
	{ "duplicate_faces", MR_FIGURE_COUNT, offsetof(mr_surface_figures, census.duplicate_faces) },
	{ "isolated_vertices", MR_FIGURE_COUNT, offsetof(mr_surface_figures, census.isolated_vertices) },
	{ "folded_edges", MR_FIGURE_COUNT, offsetof(mr_surface_figures, census.folded_edges) },
	{ "diagonal", MR_FIGURE_REAL, offsetof(mr_surface_figures, geometry.diagonal) },
	{ "area", MR_FIGURE_REAL, offsetof(mr_surface_figures, geometry.area) },
	{ "volume", MR_FIGURE_REAL, offsetof(mr_surface_figures, geometry.volume) },
	{ "edge_min", MR_FIGURE_REAL, offsetof(mr_surface_figures, geometry.edge.min) },
	{ "edge_mean", MR_FIGURE_REAL, offsetof(mr_surface_figures, geometry.edge.mean) },
	{ "edge_max", MR_FIGURE_REAL, offsetof(mr_surface_figures, geometry.edge.max) },
	{ "edge_deviation", MR_FIGURE_REAL, offsetof(mr_surface_figures, geometry.edge.deviation) },
	{ "angle_min", MR_FIGURE_REAL, offsetof(mr_surface_figures, geometry.angle_min) },
	{ "angle_max", MR_FIGURE_REAL, offsetof(mr_surface_figures, geometry.angle_max) },
	{ "angle_error", MR_FIGURE_REAL, offsetof(mr_surface_figures, geometry.angle_error) },
	{ "valence6", MR_FIGURE_REAL, offsetof(mr_surface_figures, geometry.valence6) },
	{ "interior_vertices", MR_FIGURE_COUNT, offsetof(mr_surface_figures, evenness.vertices) },
	{ "voronoi_mean", MR_FIGURE_REAL, offsetof(mr_surface_figures, evenness.mean) },
	{ "voronoi_error", MR_FIGURE_REAL, offsetof(mr_surface_figures, evenness.error) },
	{ "voronoi_variance", MR_FIGURE_REAL, offsetof(mr_surface_figures, evenness.variance) },
};

static const mr_figure cloud_figures[] = {
	{ "not_finite", MR_FIGURE_COUNT, offsetof(mr_cloud_figures, not_finite) },
	{ "duplicates", MR_FIGURE_COUNT, offsetof(mr_cloud_figures, duplicates) },
	{ "places", MR_FIGURE_COUNT, offsetof(mr_cloud_figures, places) },
	{ "outliers", MR_FIGURE_COUNT, offsetof(mr_cloud_figures, outliers) },
	{ "diagonal", MR_FIGURE_REAL, offsetof(mr_cloud_figures, diagonal) },
	{ "spacing_min", MR_FIGURE_REAL, offsetof(mr_cloud_figures, spacing.min) },
	{ "spacing_mean", MR_FIGURE_REAL, offsetof(mr_cloud_figures, spacing.mean) },
	{ "spacing_max", MR_FIGURE_REAL, offsetof(mr_cloud_figures, spacing.max) },
	{ "spacing_deviation", MR_FIGURE_REAL, offsetof(mr_cloud_figures, spacing.deviation) },
	{ "spacing_median", MR_FIGURE_REAL, offsetof(mr_cloud_figures, usual) },
	{ "evenness", MR_FIGURE_REAL, offsetof(mr_cloud_figures, evenness) },
	{ "area", MR_FIGURE_REAL, offsetof(mr_cloud_figures, area) },
	{ "noise", MR_FIGURE_REAL, offsetof(mr_cloud_figures, noise) },
	{ "noise_spacing", MR_FIGURE_REAL, offsetof(mr_cloud_figures, noise_spacing) },
	{ "noise_diagonal", MR_FIGURE_REAL, offsetof(mr_cloud_figures, noise_diagonal) },
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
	mr_figures_json(t, surface_figures, MR_LENGTH(surface_figures), s);
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
	mr_figures_json(t, cloud_figures, MR_LENGTH(cloud_figures), c);
	box_json(t, &c->box);
}
