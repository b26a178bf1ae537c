/* numbers.h -- numbers as text, exactly.  Layer rule: formats; C++ includes this, too. */
#ifndef MR_NUMBERS_H
#define MR_NUMBERS_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Returns the end of the number that begins at p, or NULL if none does. */
const char *mr_real_read(const char *p, const char *end, double *x);

/* Writes x and returns its end; at most MR_REAL_MAX bytes, no NUL. */
enum { MR_REAL_MAX = 32 };
char *mr_real_write(char *to, double x);

/* The same of a whole number. */
char *mr_count_write(char *to, uint64_t n);

#ifdef __cplusplus
}
#endif

#endif
