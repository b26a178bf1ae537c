/* ctx.h -- status codes, and the context that every library function takes first.  The library never prints
 * and never exits: on failure a function puts one sentence into the context, and its outputs are unchanged.
 *
 * All memory is of the context's arena, until that is released: callers free nothing, and a function that
 * needs workspace allocates its outputs before it.  If memory runs out, the public function that was called
 * returns MR_EMEM (MR_ENTER), and nothing in between holds memory unknown to the arena (mr_own). */
#ifndef MR_BASE_CTX_H
#define MR_BASE_CTX_H

#include "base/banned.h"
#include "mr.h"

#ifndef __wasm__
#include <setjmp.h>
#endif
#include <stdarg.h>

_Static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__,
    "mr is for little-endian machines: values are used as they stand in the stream");
#ifndef __wasm__ /* the page reads no streams by the library */
_Static_assert(sizeof(size_t) == 8, "mr is for machines of 64 bits: sizes of columns are sizes in memory");
#endif

#define MR_PRINTF(f, a) __attribute__((format(printf, f, a)))
#define MR_MEMORY       __attribute__((warn_unused_result, returns_nonnull))

/* Returns from the calling function when `expr` fails; MR_OK and MR_END go on. */
#define MR_TRY(expr)                                                                                         \
	do {                                                                                                 \
		mr_status try_status_ = (expr);                                                              \
		if (try_status_ < 0)                                                                         \
			return try_status_;                                                                  \
	} while (0)

enum { MR_ERROR_MAX = 512 };

/* Kinds of remedies for failures.  The sentences, which name tools and options, are the command's. */
typedef enum mr_remedy {
	MR_NO_REMEDY,
	MR_REPAIR,
	MR_RESCALE,
	MR_SELECT,
	MR_SELECT_FREE,
	MR_SELECT_HANDLE,
	MR_ENCODE,
	MR_ENCODE_AGAIN,
	MR_SOLVE_FIRST,
	MR_DECODE_FIRST,
	MR_SOLVE_DECODE_FIRST,
	MR_DECODE_CONTROL_FIRST,
	MR_RESPOND,
	MR_LESS_MEMORY,
	MR_LOWER_ORDER,
	MR_SOLVE_DIRECTLY,
	MR_THIN_OUT,
	MR_IMPORT,
	MR_SCRATCH,
	MR_MAKE_MESH, /* the layers of the table in mesh/layers.c, in its order */
	MR_MAKE_POINTS,
	MR_MAKE_BASE,
	MR_MAKE_CONTROL,
	MR_MAKE_DISPLACEMENT,
	MR_MAKE_HANDLES,
	MR_REMEDIES
} mr_remedy;

typedef struct mr_block mr_block; /* a piece of the arena: ctx.c */
typedef struct mr_owned mr_owned; /* what the arena holds beside memory: ctx.c */
typedef struct mr_entry mr_entry;

struct mr_ctx {
	unsigned threads; /* at least 1 */
	mr_listener listener;
	/* From now on, or no longer, this file is to be removed if the process is ended; NULL: nobody does.
	 */
	void (*unfinished)(void *user, const char *file, bool on);
	/* Before a file is read, or a whole one gets its name: may refuse that.  NULL: nobody minds. */
	mr_status (*permit)(mr_ctx *ctx, const char *path, bool writes);
	bool sync;                /* files are on the disk before they get their names */
	const char *scratch;      /* folder for large arrays, memory.h; NULL: none */
	uint64_t fail_at;         /* tests: the allocation that fails, 1 the next; 0 none */
	char error[MR_ERROR_MAX]; /* the sentence of the last failure */
	mr_remedy remedy;         /* against it */
	mr_block *top;            /* newest block of the arena */
	mr_block *spare;          /* a released block for the next that is wanted; NULL: none */
	uint64_t blocks;          /* how many the arena ever had */
	mr_owned *owned;          /* the newest */
	mr_entry *entry;          /* where running out of memory leads */
	const mr_ctx *parent;     /* or else its entry: mr_keep */
};

#ifdef __wasm__ /* there running out of memory ends the call, as an exception of JavaScript */
#define MR_ENTER(ctx) ((void)(ctx))
enum { MR_BROWSER = 1 }; /* has one solver, linear poses, no nearest points */
#else
enum { MR_BROWSER = 0 };
/* The entry of a public function: private to MR_ENTER. */
struct mr_entry {
	mr_ctx *ctx;
	mr_entry *outer; /* of a caller, to which what runs out of memory outside leads again */
	mr_mark mark;
	jmp_buf at;
};

void mr_entry_begin(mr_ctx *ctx, mr_entry *entry);
void mr_entry_end(mr_entry *entry);

/* The first statement of a public function, or of one whose caller has something to close: If memory runs out
 * below it, it returns MR_EMEM, with the sentence set, its memory released and its outputs unchanged. */
#define MR_ENTER(context)                                                                                    \
	mr_entry entry_ __attribute__((cleanup(mr_entry_end)));                                              \
	mr_entry_begin((context), &entry_);                                                                  \
	if (setjmp(entry_.at))                                                                               \
	return MR_EMEM
#endif

/* Private to MR_SCOPE. */
typedef struct mr_scope {
	mr_ctx *ctx;
	mr_mark mark;
} mr_scope;

static inline void
mr_scope_end(mr_scope *s)
{
	mr_mark_release(s->ctx, s->mark);
}

/* Releases at the end of the block, however it is left, all that was allocated after this line. */
#define MR_SCOPE(context)                                                                                    \
	mr_scope scope_ __attribute__((cleanup(mr_scope_end), unused)) = { (context), mr_mark_take(context) }

/* An arena that outlives the call, fetched anew in each: it shares ctx's threads, listener and way back. */
mr_ctx *mr_keep(const mr_ctx *ctx, mr_ctx *keep);

/* Gives up what runs out of memory, whose sentence is set, to the newest MR_ENTER, which there must be. */
_Noreturn void mr_unwind(mr_ctx *ctx);

/* When what the arena holds now is released, or this very call fails, drop(object) is called, once, before
 * the memory goes. */
void mr_own(mr_ctx *ctx, void (*drop)(void *object), void *object);

/* Initialises a context with `threads` threads (0: all cores) and an empty arena. */
void mr_ctx_init(mr_ctx *ctx, unsigned threads);

/* Frees all memory of the context.  Accepts a context that was only zeroed. */
void mr_ctx_free(mr_ctx *ctx);

/* Stores the sentence and returns `status`, for `return mr_fail(...)`. */
mr_status mr_fail(mr_ctx *ctx, mr_status status, const char *format, ...) MR_PRINTF(3, 4);

/* Follows mr_fail: adds the remedy.  Returns `status`. */
static inline mr_status
mr_advise(mr_ctx *ctx, mr_remedy remedy, mr_status status)
{
	ctx->remedy = remedy;
	return status;
}

/* Puts "text: " before the sentence of the last failure and returns `status` unchanged; good ones pass. */
mr_status mr_prefix(mr_ctx *ctx, mr_status status, const char *format, ...) MR_PRINTF(3, 4);

/* Takes over the sentence of a failure in another context, such as one that outlives frames, or this one. */
mr_status mr_fail_as(mr_ctx *ctx, const mr_ctx *other, mr_status status);

/* A remark for the user who asked for them. */
void mr_note(mr_ctx *ctx, const char *format, ...) MR_PRINTF(2, 3);

/* Reports a flaw of a result that is given all the same. */
void mr_found(const mr_ctx *ctx, const mr_finding *finding);

/* Whether anybody listens: else nothing need be looked for. */
static inline bool
mr_listens(const mr_ctx *ctx)
{
	return ctx->listener.found != NULL;
}

/* Reports `count` (0: none, and nothing is reported) of `what` as lost; layer may be NULL. */
void mr_lost(const mr_ctx *ctx, const char *layer, size_t count, const char *what);

/* Asks whether a file may be read, or be written under that name. */
mr_status mr_permit(mr_ctx *ctx, const char *path, bool writes) MR_WARN_UNUSED;

/* From now on, or no longer, this file is not to stay where the process is ended. */
void mr_unfinished(mr_ctx *ctx, const char *file, bool on);

/* Reports that a share (0 to 1) of `what` is done. */
void mr_progress(mr_ctx *ctx, const char *what, double share);

/* All that a result measures, counts and doubles alone, not measured: every bit set is MR_UNKNOWN and NaN. */
static inline void
mr_unmeasured(void *result, size_t size)
{
	memset(result, 0xff, size);
}

/* Seconds of a monotonic clock, for figures only: no result may depend on it. */
double mr_seconds(void);

/* Memory for `count` objects of `size` bytes, 64-byte aligned, not initialised; never NULL. */
void *mr_alloc(mr_ctx *ctx, size_t count, size_t size) MR_MEMORY;

/* The same, zeroed. */
void *mr_alloc_zero(mr_ctx *ctx, size_t count, size_t size) MR_MEMORY;

/* Grows `old` of this arena (or NULL), which holds `used` objects, to `count`.  The old place is not to be
 * used again: where it was large it is freed, else it stays until it is released. */
void *mr_grow(mr_ctx *ctx, void *old, size_t used, size_t count, size_t size) MR_MEMORY;

/* Makes room for `more` objects in an array that is filled step by step, by doubling: `used` of `*room` are
 * in use, and an array of NULL has no room. */
#define MR_RESERVE(ctx, array, used, more, room)                                                             \
	mr_reserve((ctx), &(array), sizeof *(array), (used), (more), (room))
void mr_reserve(mr_ctx *ctx, void *array, size_t size, size_t used, size_t more, size_t *room);

#define MR_NEW(ctx, count, type)      ((type *)mr_alloc((ctx), (count), sizeof(type)))
#define MR_NEW_ZERO(ctx, count, type) ((type *)mr_alloc_zero((ctx), (count), sizeof(type)))

/* A formatted string in the arena. */
char *mr_format(mr_ctx *ctx, const char *format, ...) MR_PRINTF(2, 3) MR_MEMORY;

#endif
