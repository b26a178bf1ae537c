/* findings.h -- what a command says of findings, by one table.  A finding is said once in a pipe, and in a
 * sequence again when its count has doubled; it travels with the frame in its column `findings`. */
#ifndef CMD_FINDINGS_H
#define CMD_FINDINGS_H

#include "base/finding.h"
#include "stream/frame.h"

enum { FINDINGS_MOST = 64 };

typedef struct findings {
	size_t n;
	mr_kept_finding k[FINDINGS_MOST]; /* of more, the last stands for them */
} findings;

typedef enum verdict { VERDICT_GOOD, VERDICT_POOR, VERDICT_UNUSABLE } verdict;

/* Adds one; of the same kind, layer and words the larger count stays. */
void findings_add(findings *all, const mr_kept_finding *k);

/* Adds the findings of the frame's column, if it has one. */
mr_status findings_read(mr_ctx *ctx, mr_frame *f, findings *all);

/* The state of a command between frames. */
typedef struct findings_book {
	findings found;   /* of the frame at work */
	findings known;   /* that this tool said since the last key */
	findings carried; /* of all frames, for findings after the last one */
	double judged;    /* since then, of mr_judge: what has moved by less is not judged */
	uint64_t key;     /* number of the last key frame */
} findings_book;

/* Reports the findings in `found` that are new against `known`: one call each, one for all losses. */
void findings_say(
    const findings *found, const findings *known, void (*say)(void *user, const char *text), void *user);

void findings_collect(findings_book *book, const char *tool, const mr_finding *f);

/* Judges the frame at work; of a sequence the key, the last, and what has moved twice as far as what was
 * judged. */
mr_status findings_judge(mr_ctx *ctx, findings_book *book, mr_frame *before, mr_frame *after);

/* Says what was found in the frame and is news (say NULL: nobody listens), and lets the frame carry all that
 * is known of it. */
mr_status
findings_settle(mr_ctx *ctx, findings_book *book, mr_frame *f, void (*say)(void *user, const char *text));

/* For --stats: ,"findings":{"folded":12}, counts by kind, where there are any. */
void findings_count(mr_text *line, const findings *found);

/* "good", "poor" or "unusable", and of the worst finding its name ("" of good). */
verdict findings_verdict(const findings *all, const char **why);
const char *verdict_name(verdict v);

/* The remedy that follows the sentence of a failure; NULL: none is known. */
const char *findings_remedy(mr_remedy remedy);

#endif
