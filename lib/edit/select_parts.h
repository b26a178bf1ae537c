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
	double x[6];       /* numbers and fractions, in the order written */
	uint32_t whole[2]; /* whole numbers */
	double length;
	bool relative; /* that is a share of the diagonal */
	int axis;
	const char *name;
	uint32_t *list; /* vertices */
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

/*
 * A kind of predicate.  fields: what stands after its colon, a letter each, with commas between: n number,
 * l length or share of the diagonal in %, f fraction, a axis, i whole number, c one from 1, s name, v file of
 * vertices; what follows a ? may be left out.
 */
typedef struct mr_predicate {
	const char *name, *fields, *form; /* form: the fields in words */
	bool (*holds)(const mr_select_scene *s, const mr_select_term *t, mr_v3 p); /* at a place; or */
	/* sets in[v] where it holds, given all false */
	mr_status (*eval)(mr_ctx *ctx, const mr_select_scene *s, const mr_select_term *t, bool *in);
	bool faces; /* there must be faces */
} mr_predicate;

/* All of them; ends with a name of NULL. */
extern const mr_predicate mr_predicates[];

/* Reads what stands after the colon of the term's predicate. */
mr_status mr_select_parse(mr_ctx *ctx, const char *text, mr_select_term *t);

#endif
