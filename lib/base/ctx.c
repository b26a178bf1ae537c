/* The arena, a list of blocks that grow, the sentences of failures, and the way back where memory runs out.
 */
#include "base/ctx.h"

#include "base/memory.h"

#include <errno.h>
#include <time.h>
#include <unistd.h>

/* The arena: a stack of blocks, the newest on top.  Small requests share a block; a large one gets a block of
 * its own, whose memory goes back to the system as soon as it is released.  One shared block is kept when it
 * is released: workspace taken again and again may begin at a block's end. */
enum { ALIGN = 64, SHARED = 1 << 18, LARGE = 1 << 15 };

struct mr_block {
	struct mr_block *below;
	uint64_t serial;   /* from 1, growing towards the top */
	size_t size, used; /* of the bytes after the header */
	char pad[ALIGN - sizeof(struct mr_block *) - sizeof(uint64_t) - 2 * sizeof(size_t)];
};

/* It lies in the arena itself, and is dropped when its own memory is released. */
struct mr_owned {
	mr_owned *below;
	mr_mark at; /* after it */
	void (*drop)(void *object);
	void *object;
};

void
mr_ctx_init(mr_ctx *ctx, unsigned threads)
{
	*ctx = (mr_ctx){ 0 };
	if (threads == 0) {
		long cores = sysconf(_SC_NPROCESSORS_ONLN);
		threads = cores > 0 ? (unsigned)cores : 1;
	}
	ctx->threads = threads;
}

void
mr_ctx_free(mr_ctx *ctx)
{
	mr_mark_release(ctx, (mr_mark){ 0, 0 });
	mr_memory_free(ctx->spare);
	ctx->spare = NULL;
}

const char *
mr_version(void)
{
	return MR_VERSION;
}

mr_ctx *
mr_ctx_new(unsigned threads)
{
	mr_ctx *ctx = malloc(sizeof *ctx);

	if (ctx)
		mr_ctx_init(ctx, threads);
	return ctx;
}

void
mr_ctx_delete(mr_ctx *ctx)
{
	if (!ctx)
		return;
	mr_ctx_free(ctx);
	free(ctx);
}

const char *
mr_error(const mr_ctx *ctx)
{
	return ctx->error;
}

void
mr_listen(mr_ctx *ctx, const mr_listener *listener)
{
	ctx->listener = listener ? *listener : (mr_listener){ 0 };
}

/* In brackets: for make lint there is a macro of this name. */
mr_status(mr_fail)(mr_ctx *ctx, mr_status status, const char *format, ...)
{
	va_list args;

	va_start(args, format);
	vsnprintf(ctx->error, sizeof ctx->error, format, args);
	va_end(args);
	ctx->remedy = MR_NO_REMEDY;
	return status;
}

mr_status
mr_fail_as(mr_ctx *ctx, const mr_ctx *other, mr_status status)
{
	return status < 0 && other != ctx
	           ? mr_advise(ctx, other->remedy, mr_fail(ctx, status, "%s", other->error))
	           : status;
}

mr_status
mr_prefix(mr_ctx *ctx, mr_status status, const char *format, ...)
{
	char sentence[MR_ERROR_MAX];
	va_list args;
	size_t n;

	if (status >= 0)
		return status;
	memcpy(sentence, ctx->error, sizeof sentence);
	va_start(args, format);
	vsnprintf(ctx->error, sizeof ctx->error, format, args);
	va_end(args);
	n = strlen(ctx->error);
	snprintf(ctx->error + n, sizeof ctx->error - n, ": %s", sentence);
	return status;
}

/* Nobody may be listening. */
MR_PRINTF(3, 0)
static void
tell(const mr_ctx *ctx, void (*hear)(void *user, const char *text), const char *format, va_list args)
{
	char text[MR_ERROR_MAX];

	if (!hear)
		return;
	vsnprintf(text, sizeof text, format, args);
	hear(ctx->listener.user, text);
}

void
mr_note(mr_ctx *ctx, const char *format, ...)
{
	va_list args;

	va_start(args, format);
	tell(ctx, ctx->listener.note, format, args);
	va_end(args);
}

void
mr_found(const mr_ctx *ctx, const mr_finding *finding)
{
	if (ctx->listener.found)
		ctx->listener.found(ctx->listener.user, finding);
}

void
mr_lost(const mr_ctx *ctx, const char *layer, size_t count, const char *what)
{
	if (count > 0)
		mr_found(ctx, &(mr_finding){ .kind = MR_LOST, .layer = layer, .what = what, .count = count });
}

mr_status
mr_permit(mr_ctx *ctx, const char *path, bool writes)
{
	return ctx->permit ? ctx->permit(ctx, path, writes) : MR_OK;
}

void
mr_unfinished(mr_ctx *ctx, const char *file, bool on)
{
	if (ctx->unfinished)
		ctx->unfinished(ctx->listener.user, file, on);
}

void
mr_progress(mr_ctx *ctx, const char *what, double share)
{
	if (ctx->listener.progress)
		ctx->listener.progress(ctx->listener.user, what, share);
}

double
mr_seconds(void)
{
	struct timespec t;

	clock_gettime(CLOCK_MONOTONIC, &t);
	return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void *
bytes_of(mr_block *b)
{
	return (char *)b + sizeof *b;
}

/* The size in bytes of count objects, rounded up to whole lines of ALIGN; false when it overflows. */
static bool
product(size_t count, size_t size, size_t *bytes)
{
	if (__builtin_mul_overflow(count, size, bytes) || *bytes > SIZE_MAX / 2)
		return false;
	*bytes = (*bytes + ALIGN - 1) / ALIGN * ALIGN;
	return true;
}

/* As malloc fails, with errno. */
static bool
told_to_fail(mr_ctx *ctx)
{
	errno = ENOMEM;
	return ctx->fail_at && --ctx->fail_at == 0;
}

#ifdef __wasm__
void
mr_unwind(mr_ctx *ctx)
{
	(void)ctx;
	__builtin_trap();
}
#else
void
mr_entry_begin(mr_ctx *ctx, mr_entry *entry)
{
	entry->ctx = ctx;
	entry->outer = ctx->entry;
	entry->mark = mr_mark_take(ctx);
	ctx->entry = entry;
}

void
mr_entry_end(mr_entry *entry)
{
	entry->ctx->entry = entry->outer;
}

void
mr_unwind(mr_ctx *ctx)
{
	mr_entry *entry = ctx->entry;

	for (const mr_ctx *c = ctx; !entry && c->parent; c = c->parent)
		entry = c->parent->entry;
	if (!entry)
		__builtin_trap(); /* a function of ours was called outside of a public one */
	mr_fail_as(entry->ctx, ctx, MR_EMEM);
	mr_mark_release(entry->ctx, entry->mark);
	longjmp(entry->at, 1);
}
#endif

_Noreturn static void
no_memory(mr_ctx *ctx, size_t count, size_t size)
{
	char what[64];

	snprintf(what, sizeof what, "%zu objects of %zu bytes", count, size);
	mr_no_memory(ctx, what, (double)count * (double)size);
	mr_unwind(ctx);
}

static mr_block *
block_new(mr_ctx *ctx, size_t size)
{
	bool kept = size == SHARED && ctx->spare;
	mr_block *b = kept ? ctx->spare : mr_memory(ctx, NULL, sizeof *b + size);

	if (!b)
		return NULL;
	if (kept)
		ctx->spare = NULL;
	*b = (mr_block){ .below = ctx->top, .serial = ++ctx->blocks, .size = size };
	return ctx->top = b;
}

/* NULL where there is none, with errno. */
static void *
take(mr_ctx *ctx, size_t count, size_t size)
{
	mr_block *b = ctx->top;
	size_t bytes;
	void *p;

	if (told_to_fail(ctx) || !product(count, size, &bytes))
		return NULL;
	if (!b || b->size - b->used < bytes)
		b = block_new(ctx, bytes > LARGE ? bytes : SHARED);
	if (!b)
		return NULL;
	p = (char *)bytes_of(b) + b->used;
	b->used += bytes;
	return p;
}

void *
mr_alloc(mr_ctx *ctx, size_t count, size_t size)
{
	void *p = take(ctx, count, size);

	if (!p)
		no_memory(ctx, count, size);
	return p;
}

void *
mr_alloc_zero(mr_ctx *ctx, size_t count, size_t size)
{
	return memset(mr_alloc(ctx, count, size), 0, count * size);
}

/* The link to the block that holds `memory` and nothing else; NULL where there is none. */
static mr_block **
own_block(mr_ctx *ctx, const void *memory)
{
	for (mr_block **b = &ctx->top; memory && *b; b = &(*b)->below)
		if (bytes_of(*b) == memory)
			return (*b)->size > LARGE && (*b)->size != SHARED ? b : NULL;
	return NULL;
}

/* Gives a block another size and puts it on top. */
static void *
resize(mr_ctx *ctx, mr_block **link, size_t bytes)
{
	mr_block *b = *link, *below = b->below, *moved = mr_memory(ctx, b, sizeof *b + bytes);

	if (!moved)
		return NULL;
	*link = below;
	*moved = (mr_block){ .below = ctx->top, .serial = ++ctx->blocks, .size = bytes, .used = bytes };
	ctx->top = moved;
	return bytes_of(moved);
}

void *
mr_grow(mr_ctx *ctx, void *old, size_t used, size_t count, size_t size)
{
	mr_block **own = own_block(ctx, old);
	size_t bytes;
	void *p;

	if (own) {
		if (told_to_fail(ctx) || !product(count, size, &bytes) || !(p = resize(ctx, own, bytes)))
			no_memory(ctx, count, size);
		return p;
	}
	p = mr_alloc(ctx, count, size);
	if (used)
		memcpy(p, old, used * size);
	return p;
}

void
mr_reserve(mr_ctx *ctx, void *array, size_t size, size_t used, size_t more, size_t *room)
{
	const size_t least = 1024 / size; /* objects: small arrays are not copied at every step */
	size_t wanted = 2 * *room;
	void *p;

	if (more <= *room - used)
		return;
	if (wanted < least)
		wanted = least;
	if (wanted - used < more)
		wanted = more > SIZE_MAX - used ? SIZE_MAX : used + more; /* mr_grow refuses that */
	memcpy(&p, array, sizeof p);                                      /* a pointer of any type */
	p = mr_grow(ctx, p, used, wanted, size);
	memcpy(array, &p, sizeof p);
	*room = wanted;
}

mr_ctx *
mr_keep(const mr_ctx *ctx, mr_ctx *keep)
{
	keep->threads = ctx->threads;
	keep->listener = ctx->listener;
	keep->scratch = ctx->scratch;
	keep->parent = ctx;
	return keep;
}

void
mr_own(mr_ctx *ctx, void (*drop)(void *object), void *object)
{
	mr_owned *o = take(ctx, 1, sizeof *o);

	if (!o) {
		drop(object);
		no_memory(ctx, 1, sizeof(mr_owned));
	} else {
		*o = (mr_owned){ ctx->owned, mr_mark_take(ctx), drop, object };
		ctx->owned = o;
	}
}

char *
mr_format(mr_ctx *ctx, const char *format, ...)
{
	va_list args;
	char *text;
	int n;

	va_start(args, format);
	n = vsnprintf(NULL, 0, format, args);
	va_end(args);
	text = mr_alloc(ctx, (size_t)n + 1, 1);
	va_start(args, format);
	vsnprintf(text, (size_t)n + 1, format, args);
	va_end(args);
	return text;
}

mr_mark
mr_mark_take(const mr_ctx *ctx)
{
	return ctx->top ? (mr_mark){ ctx->top->serial, ctx->top->used } : (mr_mark){ 0, 0 };
}

static bool
above(mr_mark a, mr_mark b)
{
	return a.serial > b.serial || (a.serial == b.serial && a.used > b.used);
}

/* The block of the mark may have gone with what grew out of it: then there is nothing of it to release. */
void
mr_mark_release(mr_ctx *ctx, mr_mark mark)
{
	while (ctx->owned && above(ctx->owned->at, mark)) {
		mr_owned *o = ctx->owned;
		ctx->owned = o->below;
		o->drop(o->object);
	}
	while (ctx->top && ctx->top->serial > mark.serial) {
		mr_block *b = ctx->top;
		ctx->top = b->below;
		if (b->size == SHARED && !ctx->spare)
			ctx->spare = b;
		else
			mr_memory_free(b);
	}
	if (ctx->top && ctx->top->serial == mark.serial)
		ctx->top->used = mark.used;
}
