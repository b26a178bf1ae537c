/* text_file.h -- small text files that options name: lists of vertices, scripts of poses. */
#ifndef MR_BASE_TEXT_FILE_H
#define MR_BASE_TEXT_FILE_H

#include "base/ctx.h"

/* Cuts the file into lines without what follows a # and white space at either end: line[i] is line i + 1. In
 * the arena.  MR_EIO where it cannot be read, MR_EFORMAT where it holds a zero byte. */
mr_status mr_lines_read(mr_ctx *ctx, const char *path, char ***line, size_t *count);

/* Reads n finite numbers separated by commas at *at, which moves past them; false if there are none. */
bool mr_numbers(const char **at, size_t n, double *x);

/* Reads a whole number of at most `most` at *at, which moves past it. */
bool mr_whole(const char **at, uint64_t most, uint64_t *x);

#endif
