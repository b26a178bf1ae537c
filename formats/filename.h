/* filename.h -- what the end of a path says, and names of output files by a pattern: %s the frame's name, %d
 * its number (%03d with zeros), %% a per cent.  Layer rule: formats. */
#ifndef MR_FILENAME_H
#define MR_FILENAME_H

#include "base/name_table.h"

/* The name for a frame, in the arena; no folder is read out of the frame's name.  MR_EUSAGE where the pattern
 * has another % in it. */
mr_status mr_outname(mr_ctx *ctx, const char *pattern, const char *frame, uint64_t number, char **name);

/* The same, each name but once: MR_EUSAGE where it is among those that were given before. */
mr_status mr_outname_once(
    mr_ctx *ctx, mr_string_set *given, const char *pattern, const char *frame, uint64_t number, char **name);

/* True where names differ from frame to frame. */
bool mr_outname_varies(const char *pattern);

/* True where a file of that kind may be written there: a name that ends so, "-", or something that exists and
 * is no file.  So no model is overwritten. */
bool mr_outname_suits(const char *path, const char *suffix);

/* The last part of a path: empty where that ends in a slash. */
const char *mr_file_name(const char *path);

/* The path without the suffix of its last part, .gz or not. */
char *mr_path_stem(mr_ctx *ctx, const char *path);

/* The name of the format, whatever the case and whether .gz follows or not; NULL: of none. */
const char *mr_suffix_format(const char *path);

/* Whether that is the name of text of any kind: .txt, .csv or .asc. */
bool mr_suffix_is_text(const char *path);

/* Whether the name ends in .gz, and there is something before that. */
bool mr_suffix_gz(const char *path);

#endif
