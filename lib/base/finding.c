/* Findings as lines of text, and the names of their kinds. */
#include "base/finding.h"

#include <math.h>

#define NAME(kind, name) [MR_##kind] = (name),
static const char *const names[MR_FINDING_KINDS] = { MR_FINDINGS(NAME) };

const char *
mr_finding_name(mr_finding_kind kind)
{
	return (unsigned)kind < MR_FINDING_KINDS ? names[kind] : NULL;
}

static const char *
keep_string(char *room, size_t size, const char *s)
{
	snprintf(room, size, "%s", s ? s : "");
	return *room ? room : NULL;
}

void
mr_finding_keep(mr_kept_finding *kept, const char *tool, const mr_finding *f)
{
	*kept = (mr_kept_finding){ .f = *f };
	keep_string(kept->tool, sizeof kept->tool, tool);
	kept->f.layer = keep_string(kept->layer, sizeof kept->layer, f->layer);
	kept->f.what = keep_string(kept->what, sizeof kept->what, f->what);
}

void
mr_finding_write(mr_text *text, const mr_kept_finding *k)
{
	const mr_finding *f = &k->f;

	mr_text_add(text, "%s\t%s\t%s\t%zu\t%zu\t%.6g\t%.6g\t", k->tool, mr_finding_name(f->kind), k->layer,
	    f->count, f->of, f->value, f->limit);
	if (f->placed && f->vertex != MR_NO_VERTEX)
		mr_text_add(text, "%u", f->vertex);
	if (f->placed)
		mr_text_add(text, "\t%.6g\t%.6g\t%.6g\t", f->at.x, f->at.y, f->at.z);
	else
		mr_text_add(text, "\t\t\t\t");
	mr_text_line(text, k->what, strlen(k->what));
	mr_text_add(text, "\n");
}

/* Copies the next field of a line, and moves past its tab or the line's end. */
static void
next_field(const char **at, const char *end, char *field, size_t size)
{
	size_t n = 0;

	for (; *at < end && **at != '\t' && **at != '\n'; ++*at)
		if (n + 1 < size)
			field[n++] = **at;
	field[n] = '\0';
	if (*at < end && **at == '\t')
		++*at;
}

static double
number(const char *field)
{
	double x = strtod(field, NULL);

	return isfinite(x) ? x : 0;
}

bool
mr_finding_read(const char **at, const char *end, mr_kept_finding *k)
{
	enum { TOOL, KIND, LAYER, COUNT, OF, VALUE, LIMIT, VERTEX, X, Y, Z, WHAT, FIELDS };
	char field[FIELDS][MR_FINDING_WHAT + 1];
	mr_finding f = { 0 };
	int kind = 0;

	if (*at >= end)
		return false;
	for (int i = 0; i < FIELDS; i++)
		next_field(at, end, field[i], sizeof field[i]);
	while (*at < end && *(*at)++ != '\n')
		;
	while (kind < MR_FINDING_KINDS && strcmp(names[kind], field[KIND]))
		kind++;
	if (kind == MR_FINDING_KINDS)
		return false;
	f.kind = (mr_finding_kind)kind;
	f.layer = field[LAYER];
	f.what = field[WHAT];
	f.count = (size_t)strtoull(field[COUNT], NULL, 10);
	f.of = (size_t)strtoull(field[OF], NULL, 10);
	f.value = number(field[VALUE]);
	f.limit = number(field[LIMIT]);
	f.placed = *field[X];
	f.vertex = *field[VERTEX] ? (uint32_t)strtoul(field[VERTEX], NULL, 10) : MR_NO_VERTEX;
	f.at = (mr_v3){ number(field[X]), number(field[Y]), number(field[Z]) };
	mr_finding_keep(k, field[TOOL], &f);
	return true;
}

bool
mr_finding_same(const mr_kept_finding *a, const mr_kept_finding *b)
{
	return a->f.kind == b->f.kind && !strcmp(a->layer, b->layer) && !strcmp(a->what, b->what);
}
