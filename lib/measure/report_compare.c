/* A comparison, for people and as JSON. */
#include "measure/fields.h"
#include "measure/report.h"

static const mr_figure distance_figures[] = {
	{ "min", MR_FIGURE_REAL, offsetof(mr_distance, min) },
	{ "max", MR_FIGURE_REAL, offsetof(mr_distance, max) },
	{ "max_bound", MR_FIGURE_REAL, offsetof(mr_distance, max_bound) },
	{ "mean", MR_FIGURE_REAL, offsetof(mr_distance, mean) },
	{ "rms", MR_FIGURE_REAL, offsetof(mr_distance, rms) },
	{ "samples", MR_FIGURE_COUNT, offsetof(mr_distance, samples) },
};

static const mr_figure deviation_figures[] = {
	{ "vertex_max", MR_FIGURE_REAL, offsetof(mr_deviation, max) },
	{ "vertex_mean", MR_FIGURE_REAL, offsetof(mr_deviation, mean) },
	{ "vertex_rms", MR_FIGURE_REAL, offsetof(mr_deviation, rms) },
	{ "vertex_worst", MR_FIGURE_COUNT, offsetof(mr_deviation, vertex) },
	{ "stretch_min", MR_FIGURE_REAL, offsetof(mr_deviation, stretch_min) },
	{ "stretch_mean", MR_FIGURE_REAL, offsetof(mr_deviation, stretch_mean) },
	{ "stretch_max", MR_FIGURE_REAL, offsetof(mr_deviation, stretch_max) },
};

static void
distance_json(mr_text *t, const char *name, const mr_distance *d)
{
	mr_text_add(t, ",\"%s\":{\"hausdorff\":", name);
	mr_text_number(t, d->max);
	mr_figures_json(t, distance_figures, MR_LENGTH(distance_figures), d);
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
		mr_figures_json(t, deviation_figures, MR_LENGTH(deviation_figures), &c->deviation);
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
