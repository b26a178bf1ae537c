/* obj_shim.h -- tinyobj's callback reader, seen from C: it splits lines of faces into corners, one checked
 * line at a time.  Layer rule: formats. */
#ifndef MR_OBJ_SHIM_H
#define MR_OBJ_SHIM_H

#ifdef __cplusplus
extern "C" {
#endif

#include <stdbool.h>

/* Indices as in the file: from 1, negative from the end, 0 where there is none. */
typedef struct mr_obj_corner {
	int v, vn, vt;
} mr_obj_corner;

typedef struct mr_obj_calls {
	/* The next line with its newline; false at the end. */
	bool (*line)(void *user, const char **begin, const char **end);
	void (*face)(void *user, const mr_obj_corner *corner, int n);
	void *user;
} mr_obj_calls;

/* Runs tinyobj over all lines; false where it ran out of memory. */
bool mr_obj_parse(const mr_obj_calls *calls);

#ifdef __cplusplus
}
#endif

#endif
