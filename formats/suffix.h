/* suffix.h -- what the end of a path says: a file's name and its format.  Layer rule: formats; needs no
 * reader. */
#ifndef MR_SUFFIX_H
#define MR_SUFFIX_H

#include <stdbool.h>

/* The last part of a path: empty where that ends in a slash. */
const char *mr_file_name(const char *path);

/* The name of the format, whatever the case and whether .gz follows or not; NULL: of none. */
const char *mr_suffix_format(const char *path);

/* Whether that is the name of text of any kind: .txt, .csv or .asc. */
bool mr_suffix_is_text(const char *path);

/* Whether the name ends in .gz, and there is something before that. */
bool mr_suffix_gz(const char *path);

#endif
