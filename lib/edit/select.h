/* select.h -- regions of vertices, chosen by predicates: terms joined by '+', all of which must hold; "not:"
 * turns one round.  man/mr-select.1 has them all. */
#ifndef MR_EDIT_SELECT_H
#define MR_EDIT_SELECT_H

#include "mesh/mesh.h"
#include "mesh/name_lists.h"
#include "stream/frame.h"

/* Rules in the order of the command line; starts zeroed. */
typedef struct mr_selection {
	struct mr_parsed_rule *rule;
	size_t n, room;
	bool may_miss; /* a rule may select no vertex */
} mr_selection;

/* Faces by what names them, one of groups, objects and materials; `group` NULL: they have none. */
typedef struct mr_groups {
	const uint32_t *group; /* nf: index into the names */
	const char *names;     /* one a line */
	size_t length;
} mr_groups;

/* Appends the rule that vertices for which `predicate` holds are of `region`.  `option`: what sentences call
 * the rule; both texts are kept by pointer.  MR_EUSAGE where it does not parse; MR_EIO, MR_EFORMAT of a file
 * of vertices. */
mr_status
mr_selection_add(mr_ctx *ctx, mr_selection *s, uint32_t region, const char *option, const char *predicate);

/* Appends the rule that vertices have the regions of a file (selection_file.h); others keep theirs. */
mr_status mr_selection_add_file(mr_ctx *ctx, mr_selection *s, const char *option, const char *path);

/* The region that the first rule gives. */
uint32_t mr_selection_begins(const mr_selection *s);

/* Applies the rules in order: later ones win.  region: nv, in and out.  Fails if a rule selects nothing or
 * needs missing data.  f: the frame of layer m; NULL: none.  groups: MR_NAMINGS of them.  result: or NULL; in
 * the arena. */
mr_status mr_select(mr_ctx *ctx, mr_frame *f, const mr_mesh *m, const mr_groups *groups,
    const mr_selection *s, uint32_t *region, mr_select_result *result);

#endif
