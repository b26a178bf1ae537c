/*
 * select_parts.h -- the predicates of a selection.
 *
 * Private to this room.
 */
#ifndef MR_EDIT_SELECT_PARTS_H
#define MR_EDIT_SELECT_PARTS_H

#include "edit/select.h"

typedef struct mr_select_term {
	const struct mr_predicate *predicate;
	bool negate;
	double x[6];      /* numbers, in the order written; of column: the bounds; of part: the distance */
	bool relative;    /* the last of them is a share of the diagonal */
	int axis;         /* above, below */
	size_t count;     /* rings, grow; part: which, from 1 */
	uint32_t vertex;  /* rings */
	const char *name; /* group, column */
	uint32_t *list;   /* vertices */
	size_t listed;
} mr_select_term;

/* What a predicate is evaluated on. */
typedef struct mr_select_scene {
	mr_frame *f; /* or NULL */
	const mr_mesh *m;
	const mr_groups *groups;
	const mr_incidence *inc;
	mr_box box;
	const uint32_t *region; /* as the rules before left it */
	uint32_t target;        /* the region that the rule gives */
} mr_select_scene;

/* A kind of predicate: reads what stands behind its colon, sets in[v] where it holds (given all false). */
typedef struct mr_predicate {
	const char *name;
	/* NULL: nothing may stand there */
	mr_status (*parse)(mr_ctx *ctx, const char *text, mr_select_term *t);
	mr_status (*eval)(mr_ctx *ctx, const mr_select_scene *s, const mr_select_term *t, bool *in);
	size_t numbers; /* for parse_numbers */
	bool length;    /* the last number is a length */
	bool faces;     /* there must be faces */
} mr_predicate;

/* All of them; ends with a name of NULL. */
extern const mr_predicate mr_predicates[];

#endif
