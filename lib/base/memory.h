/* memory.h -- how much memory this process may still take, and has taken. */
#ifndef MR_BASE_MEMORY_H
#define MR_BASE_MEMORY_H

#include "base/ctx.h"

/*
 * Bytes that can be had without swapping, by what the system, the process's group and its limits say;
 * infinite where none of them does.  No result may depend on it but a refusal, or a choice that is told.
 */
double mr_memory_available(void);

/* The most bytes that the process ever held at once; for figures only. */
double mr_memory_peak(void);

#endif
