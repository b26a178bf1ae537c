/* finding.h -- findings as text: the column `findings` of a frame, one line each, and their names. mr.h has
 * the kinds; the sentences for users are in cmd/findings.c alone. */
#ifndef MR_BASE_FINDING_H
#define MR_BASE_FINDING_H

#include "base/text.h"

enum { MR_FINDING_WHAT = 120 };

/* A finding with strings of its own, and the tool that made it. */
typedef struct mr_kept_finding {
	mr_finding f; /* layer and what: NULL, or the strings below */
	char tool[24], layer[17], what[MR_FINDING_WHAT + 1];
} mr_kept_finding;

/* Copies a finding with its strings, cut where they are too long. */
void mr_finding_keep(mr_kept_finding *kept, const char *tool, const mr_finding *f);

/* Adds the line of a finding: tool, kind, layer, count, of, value, limit, vertex, x, y, z, what; tabs
 * between. */
void mr_finding_write(mr_text *text, const mr_kept_finding *k);

/* Reads the line at *at and moves to the next; false at `end`, and of a line that is none. */
bool mr_finding_read(const char **at, const char *end, mr_kept_finding *k);

/* Whether both say the same of the same: kind, layer and words. */
bool mr_finding_same(const mr_kept_finding *a, const mr_kept_finding *b);

#endif
