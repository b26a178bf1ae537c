/* meshopt_shim.h -- what of meshoptimizer throws where memory ends, seen from C.  Layer rule: formats. */
#ifndef MR_MESHOPT_SHIM_H
#define MR_MESHOPT_SHIM_H

#ifdef __cplusplus
extern "C" {
#endif

#include <stdbool.h>
#include <stddef.h>

/* Orders triangles by the vertices that a cache still has; false where it ran out of memory. */
bool mr_meshopt_cache(unsigned *corner, size_t count, size_t vertices);

#ifdef __cplusplus
}
#endif

#endif
