/* Frames to records: of a delta what differs from what was sent before (man/mr-stream.5). */
#include "stream/stored.h"

#include "base/retry.h"
#include "stream/fingerprint.h"

#include <errno.h>
#include <sys/uio.h>
#include <unistd.h>

enum { BUFFER = 1 << 16 };

/* A column as the next tool has it now. */
typedef struct sent {
	char layer[MR_LAYER_MAX + 1], name[MR_COLUMN_MAX + 1];
	mr_shape shape;
	uint64_t rows;
	const mr_reader
	    *owner; /* a column passed on: whose payload, and which; NULL: the print of its bytes */
	uint64_t serial;
	uint64_t print;
} sent;

struct mr_writer {
	int fd;
	mr_packing packing;
	bool started, whole; /* START is written; the next frame is a key */
	bool ended, failed;  /* nothing more can be written */
	sent *sent;          /* the frame that the next tool has, in its order */
	size_t count, room;
	size_t used; /* bytes of the buffer */
	unsigned char buffer[BUFFER];
};

/* The action for one column of a frame. */
typedef struct plan {
	sent now;
	bool send;
	mr_record head; /* where it is sent encoded: stored NULL */
	const void *payload;
	const mr_stored *stored; /* where it is sent as it came */
} plan;

mr_status
mr_writer_open(mr_ctx *ctx, int fd, mr_packing packing, mr_writer **writer)
{
	mr_writer *w = mr_heap(ctx, NULL, sizeof *w);

	if (!w)
		return MR_EMEM;
	w->fd = fd;
	w->packing = packing;
	w->started = w->ended = w->failed = false;
	w->whole = true;
	w->sent = NULL;
	w->count = w->room = w->used = 0;
	*writer = w;
	return MR_OK;
}

void
mr_writer_free(mr_writer *w)
{
	if (!w)
		return;
	mr_memory_free(w->sent);
	mr_memory_free(w);
}

void
mr_writer_skipped(mr_writer *w)
{
	w->whole = true;
}

/* Writes the buffer, then n bytes. */
static mr_status
flush_with(mr_ctx *ctx, mr_writer *w, const void *p, size_t n)
{
	struct iovec v[2] = { { w->buffer, w->used }, { (void *)(uintptr_t)p, n } };

	w->used = 0;
	while (v[0].iov_len || v[1].iov_len) {
		int skip = v[0].iov_len == 0;
		ssize_t r = writev(w->fd, v + skip, 2 - skip);
		if (r < 0 && mr_retry(w->fd, POLLOUT))
			continue;
		if (r < 0) {
			w->failed = true;
			return mr_fail(ctx, MR_EIO, "cannot write: %s",
			    errno == EFAULT ? "the file that is read was cut off" : strerror(errno));
		}
		for (int i = skip; i < 2 && r > 0; i++) {
			size_t step = (size_t)r < v[i].iov_len ? (size_t)r : v[i].iov_len;
			v[i].iov_base = (char *)v[i].iov_base + step;
			v[i].iov_len -= step;
			r -= (ssize_t)step;
		}
	}
	return MR_OK;
}

/* Gathers small pieces, writes large ones from where they are. */
static mr_status
emit(mr_ctx *ctx, mr_writer *w, const void *p, size_t n)
{
	if (n > BUFFER - w->used)
		return flush_with(ctx, w, p, n);
	if (n)
		memcpy(w->buffer + w->used, p, n);
	w->used += n;
	return MR_OK;
}

static mr_status
emit_record(mr_ctx *ctx, mr_writer *w, const mr_record *head, const void *payload)
{
	static const unsigned char zeros[MR_ALIGN];
	unsigned char header[MR_HEADER];

	mr_record_encode(head, payload, header);
	MR_TRY(emit(ctx, w, header, MR_HEADER));
	MR_TRY(emit(ctx, w, payload, (size_t)head->stored));
	return emit(ctx, w, zeros, (size_t)(mr_record_padded(head->stored) - head->stored));
}

static mr_status
emit_structure(mr_ctx *ctx, mr_writer *w, mr_kind kind, const char *layer, const char *text)
{
	mr_record r = mr_record_of(kind, layer, strlen(text));

	return emit_record(ctx, w, &r, text);
}

static mr_status
emit_start(mr_ctx *ctx, mr_writer *w)
{
	if (w->started)
		return MR_OK;
	w->started = true;
	return emit_structure(ctx, w, MR_START, "", "");
}

static uint64_t
size_of(const mr_column *c)
{
	return c->rows * c->shape.components * mr_type_size(c->shape.type);
}

/* By what the writer knows the column again. */
static sent
identify(const mr_column *c)
{
	sent s = { .shape = c->shape };

	memcpy(s.layer, c->layer, sizeof s.layer);
	memcpy(s.name, c->name, sizeof s.name);
	if (c->stored) {
		s.owner = c->stored->owner;
		s.serial = c->serial;
	} else {
		s.print = mr_fingerprint(c->data, (size_t)size_of(c));
	}
	return s;
}

static bool
same_name(const sent *a, const sent *b)
{
	return !strcmp(a->name, b->name) && !strcmp(a->layer, b->layer);
}

/* Chooses the records of a delta.  The reader keeps its order of columns and appends others: as long as the
 * frame's come in that order they are kept or replaced, and later columns are sent after a DROP. */
static void
compare(const mr_writer *w, plan *plans, size_t count, bool *survives)
{
	size_t at = 0;

	for (size_t i = 0; i < count; i++) {
		size_t j = at;
		while (j < w->count && !same_name(&w->sent[j], &plans[i].now))
			j++;
		if (j == w->count)
			return;
		survives[j] = true;
		const sent *then = &w->sent[j], *now = &plans[i].now;
		plans[i].send = !mr_same_shape(then->shape, now->shape) || then->owner != now->owner ||
		                then->serial != now->serial || then->print != now->print;
		at = j + 1;
	}
}

/* The bytes of one column that is sent, raw or packed by the writer's options. */
static mr_status
encode(mr_ctx *ctx, const mr_writer *w, const mr_column *column, plan *p)
{
	mr_column c = *column;
	const mr_record *stored = c.stored ? &c.stored->head : NULL;
	const void *packed;
	size_t size = 0;

	p->head = (mr_record){ .shape = c.shape, .rows = c.rows, .stored = size_of(&c), .size = size_of(&c) };
	memcpy(p->head.layer, c.layer, sizeof c.layer);
	memcpy(p->head.name, c.name, sizeof c.name);
	if (stored && (w->packing == MR_KEEP || (w->packing == MR_PACK) == (stored->codec == MR_PACKED))) {
		p->stored = c.stored;
		return MR_OK;
	}
	MR_TRY(mr_column_decode(ctx, &c));
	p->payload = c.data;
	if (w->packing == MR_PACK)
		MR_TRY(mr_pack(ctx, &p->head, c.data, &packed, &size));
	if (size) {
		p->payload = packed;
		p->head.stored = size;
		p->head.codec = MR_PACKED;
	}
	return MR_OK;
}

/* A DROP for each column that does not survive, or one for its layer where none of it does. */
static mr_status
emit_drops(mr_ctx *ctx, mr_writer *w, const bool *survives)
{
	for (size_t i = 0; i < w->count; i++) {
		const char *layer = w->sent[i].layer;
		bool any = false, before = false;
		for (size_t j = 0; j < w->count; j++) {
			bool same = !strcmp(w->sent[j].layer, layer);
			any |= same && survives[j];
			before |= same && j < i;
		}
		if (!survives[i] && (any || !before))
			MR_TRY(emit_structure(ctx, w, MR_DROP, layer, any ? w->sent[i].name : ""));
	}
	return MR_OK;
}

static mr_status
emit_frame(mr_ctx *ctx, mr_writer *w, const mr_frame *f, bool key, const plan *plans, const bool *survives)
{
	char text[MR_NAME_MAX + 8];

	snprintf(text, sizeof text, "%s %s", key ? "key" : "delta", f->name);
	MR_TRY(emit_start(ctx, w));
	MR_TRY(emit_structure(ctx, w, MR_FRAME, "", text));
	if (!key)
		MR_TRY(emit_drops(ctx, w, survives));
	for (size_t i = 0; i < f->count; i++) {
		const mr_stored *s = plans[i].stored;
		if (plans[i].send && s) {
			MR_TRY(emit(ctx, w, s->header, MR_HEADER));
			MR_TRY(emit(ctx, w, s->payload, (size_t)mr_record_padded(s->head.stored)));
		} else if (plans[i].send) {
			MR_TRY(emit_record(ctx, w, &plans[i].head, plans[i].payload));
		}
	}
	MR_TRY(emit_structure(ctx, w, MR_ENDFRAME, "", ""));
	return flush_with(ctx, w, NULL, 0);
}

static mr_status
check_open(mr_ctx *ctx, const mr_writer *w)
{
	if (w->failed || w->ended)
		return mr_fail(
		    ctx, MR_EIO, "nothing can be written behind %s", w->ended ? "the end" : "an error");
	return MR_OK;
}

/* Everything that can fail but for the writing comes first, so that a frame is sent whole or not at all. */
static mr_status
put(mr_ctx *ctx, mr_writer *w, const mr_frame *f)
{
	plan *plans = MR_NEW_ZERO(ctx, f->count, plan);
	bool *survives = MR_NEW_ZERO(ctx, w->count, bool);
	bool key = f->key || w->whole;

	MR_TRY(mr_heap_room(ctx, &w->sent, sizeof *w->sent, f->count, &w->room));
	for (size_t i = 0; i < f->count; i++) {
		plans[i].now = identify(&f->columns[i]);
		plans[i].send = true;
	}
	if (!key)
		compare(w, plans, f->count, survives);
	for (size_t i = 0; i < f->count; i++)
		if (plans[i].send)
			MR_TRY(encode(ctx, w, &f->columns[i], &plans[i]));
	MR_TRY(emit_frame(ctx, w, f, key, plans, survives));
	for (size_t i = 0; i < f->count; i++)
		w->sent[i] = plans[i].now;
	w->count = f->count;
	w->whole = false;
	return MR_OK;
}

mr_status
mr_writer_put(mr_ctx *ctx, mr_writer *w, const mr_frame *frame)
{
	MR_SCOPE(ctx);

	MR_ENTER(ctx);
	MR_TRY(check_open(ctx, w));
	if (!mr_frame_name_valid(frame->name, strlen(frame->name)))
		return mr_fail(ctx, MR_ERANGE, "a frame cannot be called '%s'", frame->name);
	MR_TRY(mr_frame_check_rows(ctx, frame, MR_ERANGE));
	return put(ctx, w, frame);
}

mr_status
mr_writer_end(mr_ctx *ctx, mr_writer *w)
{
	MR_ENTER(ctx);
	MR_TRY(check_open(ctx, w));
	MR_TRY(emit_start(ctx, w));
	MR_TRY(emit_structure(ctx, w, MR_STOP, "", ""));
	w->ended = true;
	return flush_with(ctx, w, NULL, 0);
}

void
mr_writer_fail(mr_ctx *ctx, mr_writer *w)
{
	mr_record r = { .shape = { '-', 't', 1 }, .name = "failed" };
	char group[24];

	r.rows = r.stored = r.size = (uint64_t)snprintf(group, sizeof group, "%ld", (long)getpgrp());
	if (!w->failed && emit_start(ctx, w) == MR_OK && emit_record(ctx, w, &r, group) == MR_OK)
		w->failed = flush_with(ctx, w, NULL, 0) != MR_OK;
}
