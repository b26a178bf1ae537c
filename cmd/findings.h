/*
 * findings.h -- what a command says of findings: one table of sentences and remedies, in findings.c.
 *
 * A finding is said once: not where an earlier tool of the pipe has said it, and in a sequence again only
 * when its count has doubled.  What was found goes along with the frame, in its column `findings`.
 */
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

/* Adds those of the frame's column, if it has one. */
mr_status findings_read(mr_ctx *ctx, mr_frame *f, findings *all);

/* Puts the column, or nothing where there are none. */
mr_status findings_put(mr_ctx *ctx, mr_frame *f, const findings *all);

/* The sentence of a finding: what, how many, where, and what helps. */
void finding_sentence(const mr_kept_finding *k, char *text, size_t size);

/* Says those of `found` that are news against `known`: each by one call, all that is lost by one. */
void findings_say(
    const findings *found, const findings *known, void (*say)(void *user, const char *text), void *user);

/* "good", "poor" or "unusable", and of the worst finding its name ("" of good). */
verdict findings_verdict(const findings *all, const char **why);
const char *verdict_name(verdict v);

#endif
