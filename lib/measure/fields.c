/* Tables of figures as JSON. */
#include "measure/fields.h"

void
mr_figures_json(mr_text *t, const mr_figure *table, size_t n, const void *values)
{
	for (size_t i = 0; i < n; i++) {
		const void *x = (const char *)values + table[i].offset;
		mr_text_add(t, ",\"%s\":", table[i].name);
		switch (table[i].kind) {
		case MR_FIGURE_COUNT:
			mr_text_add(t, "%zu", *(const size_t *)x);
			break;
		case MR_FIGURE_SIGNED:
			mr_text_add(t, "%lld", (long long)*(const int64_t *)x);
			break;
		case MR_FIGURE_REAL:
			mr_text_number(t, *(const double *)x);
			break;
		case MR_FIGURE_TRUTH:
			mr_text_add(t, *(const bool *)x ? "true" : "false");
			break;
		}
	}
}
