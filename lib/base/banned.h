/*
 * banned.h -- calls that lose an error or a bound.
 *
 * Layer rule: base; every header of the library includes it through ctx.h.
 */
#ifndef MR_BANNED_H
#define MR_BANNED_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#pragma GCC poison atoi atol atof sprintf vsprintf strcpy strcat gets strtok

#endif
