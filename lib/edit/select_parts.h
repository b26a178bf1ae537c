/*
 * select_parts.h -- the predicates of a selection.
 *
 * Private to this room.
 */
#ifndef MR_EDIT_SELECT_PARTS_H
#define MR_EDIT_SELECT_PARTS_H

#include "edit/select.h"

typedef struct term {
	const struct predicate *predicate;
	bool negate;
	double x[6];      /* numbers, in the order written */
	bool relative;    /* the last of them is a share of the diagonal */
	int axis;         /* above, below */
	size_t count;     /* rings, grow */
	uint32_t vertex;  /* rings */
	const char *name; /* group */
	uint32_t *list;   /* vertices */
	size_t listed;
} term;

/* What a predicate is evaluated on. */
typedef struct scene {
	const mr_mesh *m;
	const mr_groups *groups;
	const mr_incidence *inc;
	mr_box box;
	const uint32_t *region; /* as the rules before left it */
	uint32_t target;        /* the region that the rule gives */
} scene;

/* A kind of predicate: reads what stands behind its colon, sets in[v] where it holds (given all false). */
typedef struct predicate {
	const char *name;
	/* NULL: nothing may stand there */
	mr_status (*parse)(mr_ctx *ctx, const char *text, term *t);
	mr_status (*eval)(mr_ctx *ctx, const scene *s, const term *t, bool *in);
	size_t numbers; /* for parse_numbers */
	bool length;    /* the last number is a length */
} predicate;

/* All of them; ends with a name of NULL. */
extern const predicate mr_predicates[];

#endif
