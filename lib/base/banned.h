/* banned.h -- calls that lose an error or a bound. Every header of the library includes it through ctx.h. */
#ifndef MR_BASE_BANNED_H
#define MR_BASE_BANNED_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#undef sprintf /* a macro, where its copies are checked for clang */
#pragma GCC poison atoi atol atof sprintf vsprintf strcpy strcat gets strtok

#endif
