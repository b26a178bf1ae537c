/* suffix.h -- what the end of a file's name says of its format.  Layer rule: formats; needs no reader. */
#ifndef MR_SUFFIX_H
#define MR_SUFFIX_H

#include <stdbool.h>

/* The name of the format, whatever the case and whether .gz follows or not; NULL: of none. */
const char *mr_suffix_format(const char *path);

/* Whether that is the name of text of any kind: .txt, .csv or .asc. */
bool mr_suffix_is_text(const char *path);

/* Whether the name ends in .gz, and there is something before that. */
bool mr_suffix_gz(const char *path);

#endif
