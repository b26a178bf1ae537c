/*
 * flaws.h -- the flipped faces (remesh/orientation.h) of a mesh that is being remeshed, and its folds
 * (mesh/fold.h): where they are, and how many are around a change.
 *
 * Contract: a face that no change was told of since it was found sound is sound: what changes a place tells
 * by mr_flaws_suspect.  A vertex that is moved gets its normal by mr_flaws_moved.
 */
#ifndef MR_REMESH_FLAWS_H
#define MR_REMESH_FLAWS_H

#include "remesh/orientation.h"
#include "remesh/relax.h"

typedef enum mr_flaw_state {
	MR_SOUND,
	MR_SUSPECT, /* it may have a flaw */
	MR_STUCK    /* it has one that nothing mends, before something near changes */
} mr_flaw_state;

typedef struct mr_flaws {
	const mr_dyn *d;
	const mr_remesh_source *s;
	mr_facing facing;
	bool sure; /* every face is compared with the source at its corners; else those that look right are
	              not */
	uint8_t *state; /* mr_flaw_state of each face */
	mr_v3 *normal;  /* of the source at the place of each vertex, as far as it was asked for; else 0 */
} mr_flaws;

/* Looks at all faces; count: how many have a flaw, which become the suspects.  In the arena. */
void
mr_flaws_find(mr_ctx *ctx, const mr_dyn *d, const mr_remesh_source *s, bool sure, mr_flaws *w, size_t *count);

/* True where face f, which may be dead, or one of its edges has a flaw. */
bool mr_is_flawed(const mr_flaws *w, uint32_t f);

/*
 * The folded edges of all faces around v, and the flipped ones of these, without what is counted around `but`
 * (or MR_NONE); `most` where there are as many: whoever wants fewer need not know.
 */
unsigned mr_flaws_around(const mr_flaws *w, uint32_t v, uint32_t but, unsigned most);

/* The flaws of the two faces at h and of their edges. */
unsigned mr_flaws_beside(const mr_flaws *w, uint32_t h);

/* The flaws of the faces around both ends of h; where the two are at one spot, as if they were one vertex.
 * `most` as above. */
unsigned mr_flaws_of_pair(const mr_flaws *w, uint32_t h, unsigned most);

/* The normal of the source at the place of v: kept, since a place belongs to a vertex, not to what is tried
 * around it. */
mr_v3 mr_flaws_normal(const mr_flaws *w, uint32_t v);

/* v lies at a place with that normal now. */
void mr_flaws_moved(const mr_flaws *w, uint32_t v, mr_v3 normal);

/* v has changed: the faces around it and its neighbours, and those beside them, are suspect. */
void mr_flaws_suspect(const mr_flaws *w, uint32_t v);

#endif
