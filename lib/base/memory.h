/* memory.h -- memory from the system, or from a disk; how much this process may still take, and has taken. */
#ifndef MR_BASE_MEMORY_H
#define MR_BASE_MEMORY_H

#include "base/ctx.h"

/* Memory, 64-byte aligned, with what was in `old` (or NULL), whose place it takes; where it is large, in a
 * nameless file in ctx->scratch, if that is set.  NULL where there is none, errno set, `old` as it was. */
void *mr_memory(const mr_ctx *ctx, void *old, size_t size) MR_WARN_UNUSED;

/* For a process that is ours, at its start: how it keeps memory that it has given back. */
void mr_memory_begin(void);

/* The sentence where mr_memory has given none for `what`, so many bytes: MR_EMEM. */
mr_status mr_no_memory(mr_ctx *ctx, const char *what, double bytes);

/* Gives it back; NULL is nothing. */
void mr_memory_free(void *memory);

/* Bytes that can be had without swapping, by the limits of the system, the process's groups and the process;
 * infinite if there is none.  No result may depend on it, except a refusal or a reported choice. */
double mr_memory_available(void);

/* The most bytes that the process ever held at once, 0 where the system does not say; for figures only. */
double mr_memory_peak(void);

#endif
