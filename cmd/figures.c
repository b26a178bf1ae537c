/* Figures of --stats by tables. */
#include "cmd.h"

void
cmd_figures(cmd *c, const cmd_field *table, const void *result)
{
	for (; c->stats && table->name; table++) {
		const char *field = (const char *)result + table->offset;
		size_t count = table->count ? *(const size_t *)(const void *)field : 0;
		double value = table->count ? (double)count : *(const double *)(const void *)field;
		if (count != MR_UNKNOWN && !isnan(value))
			cmd_figure(c, table->name, value);
	}
}

void
cmd_gaps(cmd *c, const mr_gaps *gaps)
{
	static const cmd_field figures[] = {
		{ "points_to_surface_mean", false, offsetof(mr_gaps, points.mean) },
		{ "points_to_surface_99", false, offsetof(mr_gaps, points.high) },
		{ "points_to_surface_max", false, offsetof(mr_gaps, points.max) },
		{ "surface_to_points_mean", false, offsetof(mr_gaps, surface.mean) },
		{ "surface_to_points_99", false, offsetof(mr_gaps, surface.high) },
		{ "surface_to_points_max", false, offsetof(mr_gaps, surface.max) },
		{ "bare", false, offsetof(mr_gaps, bare) },
		{ 0 },
	};

	cmd_figures(c, figures, gaps);
}
