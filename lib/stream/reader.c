/* Records to frames: a delta is merged with the columns it keeps of the frame before (man/mr-stream.5). */
#include "stream/stored.h"

#include <unistd.h>

struct mr_reader {
	mr_input in;
	uint64_t serial, number; /* payloads and frames so far */
	mr_stored **stored;      /* the merged frame, in order */
	size_t count, room;
	size_t sent;     /* columns of the frame at hand so far */
	mr_column *view; /* what the frame handed out shows of it */
	size_t view_room;
	mr_frame frame;
	char name[MR_NAME_MAX + 1];
	bool inside, fresh, ended,
	    failed; /* inside a stream; before its first frame; one has ended; an error came */
	bool told;  /* who failed has said why */
};

/* A record just read: `heap` is to be freed unless somebody keeps it. */
typedef struct piece {
	mr_record head;
	uint64_t offset;
	const unsigned char *record;
	void *heap;
} piece;

mr_status
mr_reader_open(mr_ctx *ctx, int fd, mr_reader **reader)
{
	mr_reader *r = mr_heap(ctx, NULL, sizeof *r);
	mr_status status;

	if (!r)
		return MR_EMEM;
	*r = (mr_reader){ 0 };
	status = mr_input_open(ctx, fd, &r->in);
	if (status != MR_OK)
		mr_memory_free(r);
	else
		*reader = r;
	return status;
}

static void
stored_free(mr_stored *s)
{
	if (!s->heap)
		mr_input_forget(s->payload - MR_HEADER, MR_HEADER + mr_record_padded(s->head.stored));
	mr_memory_free(s->heap);
	mr_memory_free(s->inflated);
	mr_memory_free(s);
}

static void
drop_one(mr_reader *r, size_t i)
{
	mr_stored *s = r->stored[i];

	r->count--;
	memmove(r->stored + i, r->stored + i + 1, (r->count - i) * sizeof *r->stored);
	stored_free(s);
}

static void
drop_all(mr_reader *r)
{
	while (r->count)
		drop_one(r, r->count - 1);
}

void
mr_reader_free(mr_reader *r)
{
	if (!r)
		return;
	drop_all(r);
	mr_input_close(&r->in);
	mr_memory_free(r->stored);
	mr_memory_free(r->view);
	mr_memory_free(r);
}

static mr_status
cut_off(mr_ctx *ctx, const mr_reader *r)
{
	return mr_fail(ctx, MR_EFORMAT, "stream ends without END at byte %llu: the previous tool failed",
	    (unsigned long long)r->in.offset);
}

static mr_status
check_padding(mr_ctx *ctx, const piece *p)
{
	const unsigned char *payload = p->record + MR_HEADER;

	for (uint64_t i = p->head.stored; i < mr_record_padded(p->head.stored); i++)
		if (payload[i])
			return mr_fail(ctx, MR_EFORMAT, "byte %llu: the padding of %s is not zero",
			    (unsigned long long)(p->offset + MR_HEADER + i), p->head.name);
	return MR_OK;
}

static bool
is_gzip(const unsigned char *header, size_t got)
{
	return got > 1 && header[0] == 0x1f && header[1] == 0x8b;
}

/* One record.  MR_END: the input ends where a stream may end. */
static mr_status
read_piece(mr_ctx *ctx, mr_reader *r, piece *p)
{
	unsigned char header[MR_HEADER];
	mr_status status;
	size_t got;

	*p = (piece){ .offset = r->in.offset };
	MR_TRY(mr_input_header(ctx, &r->in, header, &got));
	if (got == 0 && r->ended && !r->inside) {
		mr_input_end(&r->in);
		return MR_END;
	}
	/* however short it is */
	if (!r->inside && memcmp(header, MR_MAGIC, got < MR_MAGIC_BYTES ? got : MR_MAGIC_BYTES) != 0)
		return mr_advise(ctx, r->ended || is_gzip(header, got) ? MR_NO_REMEDY : MR_IMPORT,
		    mr_fail(ctx, MR_EFORMAT, "byte %llu: this is not a stream: no START here%s",
			(unsigned long long)p->offset,
			!r->ended && is_gzip(header, got) ? "; it is gzip, which gunzip unpacks" : ""));
	if (got < MR_HEADER)
		return cut_off(ctx, r);
	MR_TRY(mr_record_parse(ctx, header, p->offset, &p->head));
	status = mr_input_payload(
	    ctx, &r->in, header, mr_record_padded(p->head.stored), &p->record, &p->heap);
	if (status == MR_END)
		return cut_off(ctx, r);
	MR_TRY(status);
	status = check_padding(ctx, p);
	if (status == MR_OK) /* of a column that nobody uses, too: a wrong name would hide it */
		status = mr_record_verify(
		    ctx, p->record, p->record + MR_HEADER, (size_t)p->head.stored, p->offset);
	if (status != MR_OK)
		mr_memory_free(p->heap);
	return status;
}

static mr_status
misplaced(mr_ctx *ctx, const piece *p, const char *where)
{
	return mr_fail(
	    ctx, MR_EFORMAT, "byte %llu: %s %s", (unsigned long long)p->offset, p->head.name, where);
}

/* FRAME: its payload is "key NAME" or "delta NAME". */
static mr_status
begin_frame(mr_ctx *ctx, mr_reader *r, const piece *p)
{
	const char *text = (const char *)p->record + MR_HEADER;
	size_t n = (size_t)p->head.stored, skip;
	bool key = n > 4 && !memcmp(text, "key ", 4);

	if (!key && !(n > 6 && !memcmp(text, "delta ", 6)))
		return misplaced(ctx, p, "says neither 'key NAME' nor 'delta NAME'");
	skip = key ? 4 : 6;
	if (!mr_frame_name_valid(text + skip, n - skip))
		return misplaced(
		    ctx, p, "has a bad name: 1 to 255 bytes of UTF-8 without control characters and '/'");
	if (!key && r->fresh)
		return misplaced(ctx, p, "begins a stream with a delta, which follows nothing");
	memcpy(r->name, text + skip, n - skip);
	r->name[n - skip] = 0;
	if (key)
		drop_all(r);
	r->sent = 0;
	r->frame.key = key;
	r->fresh = false;
	r->number++;
	return MR_OK;
}

/* A record that stands between frames and should not: column `failed` is the last of a tool that failed. */
static mr_status
outside(mr_ctx *ctx, mr_reader *r, const piece *p)
{
	char group[24];

	if (p->head.kind != MR_COLUMN || *p->head.layer || strcmp(p->head.name, "failed") != 0)
		return misplaced(ctx, p, "stands outside of a frame");
	snprintf(group, sizeof group, "%ld", (long)getpgrp());
	r->told = p->head.stored == strlen(group) && !memcmp(p->record + MR_HEADER, group, strlen(group));
	return mr_fail(ctx, MR_EFORMAT,
	    "stream ends without END at byte %llu: the previous tool failed, and has said so",
	    (unsigned long long)p->offset);
}

/* The records between frames, up to the next FRAME.  MR_END: all streams have ended. */
static mr_status
next_frame(mr_ctx *ctx, mr_reader *r)
{
	mr_status status;
	piece p;

	for (;;) {
		status = read_piece(ctx, r, &p);
		if (status != MR_OK)
			return status;
		if (!r->inside) { /* read_piece has seen to it that this is START */
			r->inside = r->fresh = true;
		} else if (p.head.kind == MR_STOP) {
			r->inside = false;
			r->ended = true;
		} else {
			break;
		}
		mr_memory_free(p.heap);
	}
	status = p.head.kind == MR_FRAME ? begin_frame(ctx, r, &p) : outside(ctx, r, &p);
	mr_memory_free(p.heap);
	return status;
}

static size_t
position_of(const mr_reader *r, const char *layer, const char *name)
{
	size_t i = 0;

	while (i < r->count &&
	       (strcmp(r->stored[i]->head.name, name) || strcmp(r->stored[i]->head.layer, layer)))
		i++;
	return i;
}

/* A column that a frame sends stays, whatever it drops; a kept one may still be dropped. */
static mr_status
check_count(mr_ctx *ctx, const mr_reader *r, size_t columns)
{
	if (columns > MR_FRAME_COLUMNS)
		return mr_fail(ctx, MR_EFORMAT, "before byte %llu: a frame of more than %d columns",
		    (unsigned long long)r->in.offset, MR_FRAME_COLUMNS);
	return MR_OK;
}

/* A column takes its old place, or the last. */
static mr_status
keep(mr_ctx *ctx, mr_reader *r, const piece *p)
{
	size_t i = position_of(r, p->head.layer, p->head.name);
	mr_stored *s, *old;

	if (i < r->count && r->stored[i]->frame == r->number)
		return misplaced(ctx, p, "comes twice in a frame");
	if (p->head.size > SIZE_MAX / 2)
		return misplaced(ctx, p, "is too large for this machine");
	MR_TRY(check_count(ctx, r, r->sent + 1));
	MR_TRY(mr_heap_room(ctx, &r->stored, sizeof *r->stored, r->count + 1, &r->room));
	s = mr_heap(ctx, NULL, sizeof *s);
	if (!s)
		return MR_EMEM;
	*s = (mr_stored){ .head = p->head,
		.owner = r,
		.serial = ++r->serial,
		.offset = p->offset,
		.frame = r->number,
		.payload = p->record + MR_HEADER,
		.heap = p->heap };
	memcpy(s->header, p->record, MR_HEADER);
	old = i < r->count ? r->stored[i] : NULL;
	r->count += !old;
	r->sent++;
	r->stored[i] = s;
	if (old)
		stored_free(old);
	return MR_OK;
}

/* DROP: its payload is a column's name, or empty for the whole layer. */
static mr_status
drop(mr_ctx *ctx, mr_reader *r, const piece *p)
{
	char name[MR_COLUMN_MAX + 1] = "";
	size_t before = r->count;

	memcpy(name, p->record + MR_HEADER, (size_t)p->head.stored);
	if (p->head.stored && (strlen(name) < p->head.stored || !mr_name_valid(name, MR_COLUMN_MAX)))
		return misplaced(ctx, p, "has a bad name of a column");
	for (size_t i = r->count; i-- > 0;) {
		const mr_stored *s = r->stored[i];
		bool named = !strcmp(s->head.layer, p->head.layer) &&
		             (!p->head.stored || !strcmp(s->head.name, name));
		if (named && s->frame < r->number)
			drop_one(r, i);
	}
	if (r->count == before)
		return mr_fail(ctx, MR_EFORMAT,
		    "byte %llu: DROP of column '%s' of layer '%s': the frame before has none",
		    (unsigned long long)p->offset, name, p->head.layer);
	return MR_OK;
}

/* The records of a frame after FRAME, with ENDFRAME. */
static mr_status
read_columns(mr_ctx *ctx, mr_reader *r)
{
	mr_status status = MR_OK;
	piece p;

	do {
		status = read_piece(ctx, r, &p);
		if (status != MR_OK)
			return status;
		if (p.head.kind == MR_COLUMN) {
			status = keep(ctx, r, &p);
			if (status == MR_OK)
				continue; /* it keeps the memory */
		} else if (p.head.kind == MR_DROP) {
			status = drop(ctx, r, &p);
		} else if (p.head.kind != MR_ENDFRAME) {
			status = misplaced(ctx, &p, "stands within a frame");
		}
		mr_memory_free(p.heap);
	} while (status == MR_OK && p.head.kind != MR_ENDFRAME);
	return status;
}

/* The frame that shows the stored columns, with room for some more columns. */
static mr_status
show(mr_ctx *ctx, mr_reader *r)
{
	MR_TRY(check_count(ctx, r, r->count));
	MR_TRY(mr_heap_room(ctx, &r->view, sizeof *r->view, r->count + 16, &r->view_room));
	for (size_t i = 0; i < r->count; i++) {
		mr_stored *s = r->stored[i];
		mr_column *c = &r->view[i];
		*c = (mr_column){ .shape = s->head.shape,
			.rows = s->head.rows,
			.serial = s->serial,
			.data = s->data,
			.header = s->header,
			.stored = s };
		memcpy(c->layer, s->head.layer, sizeof c->layer);
		memcpy(c->name, s->head.name, sizeof c->name);
	}
	r->frame = (mr_frame){ .name = r->name,
		.key = r->frame.key,
		.number = r->number,
		.columns = r->view,
		.count = r->count,
		.room = r->view_room };
	return mr_prefix(ctx, mr_frame_check_rows(ctx, &r->frame, MR_EFORMAT), "before byte %llu",
	    (unsigned long long)r->in.offset);
}

static mr_status
read_frame(mr_ctx *ctx, mr_reader *r)
{
	mr_status status = next_frame(ctx, r);

	if (status != MR_OK)
		return status;
	MR_TRY(read_columns(ctx, r));
	return show(ctx, r);
}

mr_status
mr_reader_next(mr_ctx *ctx, mr_reader *r, mr_frame **frame)
{
	mr_status status;

	MR_ENTER(ctx);
	if (r->failed)
		return mr_fail(ctx, MR_EFORMAT, "nothing can be read behind an error");
	status = read_frame(ctx, r);
	r->failed = status < 0;
	if (status == MR_OK)
		*frame = &r->frame;
	return status;
}

bool
mr_reader_told(const mr_reader *r)
{
	return r->told;
}
