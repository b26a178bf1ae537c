/* Corners gathered face by face, then triangulated. */
#include "formats/build.h"

#include "base/utf8.h"
#include "mesh/polygon.h"

static const size_t MOST_TRIANGLES = (MR_NONE - 1) / 3;

mr_status
mr_build_vertices(mr_builder *b, uint64_t nv)
{
	if (nv >= MR_NONE)
		return mr_fail(b->ctx, MR_ERANGE, "%llu vertices are more than indices can name",
		    (unsigned long long)nv);
	b->nv = (size_t)nv;
	b->p = MR_NEW(b->ctx, b->nv, mr_v3);
	return b->p ? MR_OK : MR_EMEM;
}

mr_status
mr_build_reserve(mr_builder *b, size_t faces)
{
	if (faces > MOST_TRIANGLES)
		return mr_fail(b->ctx, MR_ERANGE, "%zu faces are more than indices can name", faces);
	return MR_RESERVE(b->ctx, b->corner, b->corners, 3 * faces, &b->corner_room);
}

/* From now on the faces' sizes are kept. */
static mr_status
keep_sizes(mr_builder *b)
{
	MR_TRY(MR_RESERVE(b->ctx, b->size, 0, b->faces + b->faces / 2 + 1024, &b->face_room));
	for (size_t i = 0; i < b->faces; i++)
		b->size[i] = 3;
	return MR_OK;
}

/* Corners that name the vertex of the one before, or the last the first, say nothing. */
static size_t
without_repeats(uint32_t *c, size_t n)
{
	size_t kept = 0;

	for (size_t i = 0; i < n; i++)
		if (kept == 0 || c[i] != c[kept - 1])
			c[kept++] = c[i];
	while (kept > 1 && c[kept - 1] == c[0])
		kept--;
	return kept;
}

mr_status
mr_build_face(mr_builder *b, const uint32_t *corner, size_t n)
{
	size_t kept = n;

	if (n < 3) {
		b->skipped++;
		return MR_OK;
	}
	MR_TRY(MR_RESERVE(b->ctx, b->corner, b->corners, n, &b->corner_room));
	memcpy(b->corner + b->corners, corner, n * sizeof *corner);
	if (n > 3) {
		kept = without_repeats(b->corner + b->corners, n);
		b->polygons++;
		if (kept < 3) {
			b->skipped++;
			return MR_OK;
		}
		if (kept > 3 && !b->size)
			MR_TRY(keep_sizes(b));
	}
	if (b->size) {
		MR_TRY(MR_RESERVE(b->ctx, b->size, b->faces, 1, &b->face_room));
		b->size[b->faces] = (uint32_t)kept;
	}
	if (b->has_groups) {
		MR_TRY(MR_RESERVE(b->ctx, b->group, b->faces, 1, &b->group_room));
		b->group[b->faces] = b->current;
	}
	b->corners += kept;
	b->faces++;
	return MR_OK;
}

/* ---- names ---- */

static uint64_t
hash_of(const char *s, size_t n)
{
	uint64_t h = 0xcbf29ce484222325u; /* FNV-1a */

	for (size_t i = 0; i < n; i++)
		h = (h ^ (unsigned char)s[i]) * 0x100000001b3u;
	return h ^ h >> 29;
}

static size_t
name_length(const mr_names *n, size_t i)
{
	return (i + 1 < n->count ? n->start[i + 1] : n->bytes) - n->start[i] - 1;
}

/* The slot of the name, or the empty one where it belongs. */
static uint32_t *
find_slot(const mr_names *n, const char *s, size_t bytes)
{
	size_t at = hash_of(s, bytes) & (n->slots - 1);

	for (;; at = (at + 1) & (n->slots - 1)) {
		uint32_t i = n->slot[at];
		if (i == 0 ||
		    (name_length(n, i - 1) == bytes && !memcmp(n->text + n->start[i - 1], s, bytes)))
			return &n->slot[at];
	}
}

static mr_status
widen_slots(mr_ctx *ctx, mr_names *n)
{
	size_t slots = n->slots ? 4 * n->slots : 64;
	uint32_t *slot = MR_NEW_ZERO(ctx, slots, uint32_t);

	if (!slot)
		return MR_EMEM;
	n->slot = slot;
	n->slots = slots;
	for (size_t i = 0; i < n->count; i++)
		*find_slot(n, n->text + n->start[i], name_length(n, i)) = (uint32_t)i + 1;
	return MR_OK;
}

static mr_status
name_number(mr_ctx *ctx, mr_names *n, const char *s, size_t bytes, uint32_t *number)
{
	uint32_t *slot;

	if (2 * n->count >= n->slots)
		MR_TRY(widen_slots(ctx, n));
	slot = find_slot(n, s, bytes);
	if (*slot == 0) {
		MR_TRY(MR_RESERVE(ctx, n->text, n->bytes, bytes + 1, &n->room));
		MR_TRY(MR_RESERVE(ctx, n->start, n->count, 1, &n->start_room));
		memcpy(n->text + n->bytes, s, bytes);
		n->text[n->bytes + bytes] = '\n';
		n->start[n->count] = n->bytes;
		n->bytes += bytes + 1;
		*slot = (uint32_t)++n->count;
	}
	*number = *slot - 1;
	return MR_OK;
}

size_t
mr_clean_name(char *to, const char *from, size_t bytes, bool no_slash)
{
	const unsigned char *s = (const unsigned char *)from;
	size_t n = 0, step;
	uint32_t code;

	for (size_t i = 0; i < bytes; i += step ? step : 1) {
		step = mr_utf8(s + i, bytes - i, &code);
		if (step == 0 || mr_is_control(code) || (no_slash && code == '/')) {
			to[n++] = '_';
		} else {
			memcpy(to + n, from + i, step);
			n += step;
		}
	}
	to[n] = 0;
	return n;
}

/* The faces so far belong to "default". */
static mr_status
start_groups(mr_builder *b)
{
	MR_TRY(MR_RESERVE(b->ctx, b->group, 0, b->corner_room / 3 + 64, &b->group_room));
	if (b->faces) {
		MR_TRY(MR_RESERVE(b->ctx, b->group, 0, b->faces, &b->group_room));
		MR_TRY(name_number(b->ctx, &b->names, "default", 7, &b->current));
		memset(b->group, 0, b->faces * sizeof *b->group);
	}
	b->has_groups = true;
	return MR_OK;
}

mr_status
mr_build_group(mr_builder *b, const char *name, size_t bytes)
{
	enum { LONGEST = 1024 };
	char clean[LONGEST + 1];
	size_t n;

	while (bytes && (unsigned char)*name <= ' ')
		name++, bytes--;
	while (bytes && (unsigned char)name[bytes - 1] <= ' ')
		bytes--;
	if (!b->has_groups)
		MR_TRY(start_groups(b));
	n = mr_clean_name(clean, name, bytes < LONGEST ? bytes : LONGEST, false);
	return n ? name_number(b->ctx, &b->names, clean, n, &b->current)
	         : name_number(b->ctx, &b->names, "default", 7, &b->current);
}

/* ---- attributes ---- */

mr_status
mr_build_texcoord(mr_builder *b, uint32_t vertex, double u, double v)
{
	double *uv;

	if (!b->corner_seen) {
		double *texcoord = MR_NEW_ZERO(b->ctx, 2 * b->nv, double);
		unsigned char *seen = MR_NEW_ZERO(b->ctx, b->nv, unsigned char);
		if (!texcoord || !seen)
			return MR_EMEM;
		b->texcoord = texcoord;
		b->corner_seen = seen;
	}
	uv = b->texcoord + 2 * (size_t)vertex;
	if (b->corner_seen[vertex] == 0) {
		uv[0] = u, uv[1] = v;
		b->corner_seen[vertex] = 1;
	} else if (uv[0] != u || uv[1] != v)
		b->corner_seen[vertex] = 2;
	return MR_OK;
}

void
mr_dropped(mr_ctx *ctx, size_t *count, const char *what, const char *why)
{
	mr_note(ctx, "%s dropped: %s", what, why);
	*count = 1;
}

static void
report_seams(mr_builder *b)
{
	size_t seams = 0;

	if (!b->corner_seen)
		return;
	for (size_t i = 0; i < b->nv; i++)
		seams += b->corner_seen[i] == 2;
	b->counts->seam_vertices = seams;
	if (seams)
		mr_note(b->ctx, "%zu vertices on texture seams keep the first of their coordinates", seams);
}

/* ---- faces to triangles ---- */

/* Triangles of one polygon but those that name a vertex twice; the number of those kept. */
static size_t
keep_proper(mr_tri *t, size_t n)
{
	size_t kept = 0;

	for (size_t i = 0; i < n; i++)
		if (t[i].v[0] != t[i].v[1] && t[i].v[1] != t[i].v[2] && t[i].v[2] != t[i].v[0])
			t[kept++] = t[i];
	return kept;
}

static mr_status
triangulate(mr_builder *b, mr_model *m)
{
	size_t total = b->corners - 2 * b->faces, nf = 0;
	mr_tri *t;
	uint32_t *group = NULL;
	const uint32_t *c = b->corner;

	if (total > MOST_TRIANGLES)
		return mr_fail(b->ctx, MR_ERANGE, "%zu triangles are more than indices can name", total);
	t = MR_NEW(b->ctx, total, mr_tri);
	if (!t || (b->has_groups && !(group = MR_NEW(b->ctx, total, uint32_t))))
		return MR_EMEM;
	for (size_t f = 0; f < b->faces; c += b->size[f++]) {
		size_t made = b->size[f] - 2;
		if (made == 1)
			memcpy(t[nf].v, c, sizeof t[nf].v); /* as the file has it, degenerate or not */
		else {
			MR_TRY(mr_polygon_triangulate(b->ctx, b->p, c, b->size[f], t + nf));
			made = keep_proper(t + nf, made);
		}
		for (size_t i = 0; group && i < made; i++)
			group[nf + i] = b->group[f];
		nf += made;
	}
	m->t = t;
	m->nf = nf;
	m->group = group;
	return MR_OK;
}

mr_status
mr_build_finish(mr_builder *b, mr_model *m)
{
	mr_model made = {
		.p = b->p, .nv = b->nv, .normal = b->normal, .color = b->color, .texcoord = b->texcoord
	};

	if (b->faces == 0 && b->skipped)
		return mr_fail(b->ctx, MR_EMESH, "none of the %zu faces has three corners", b->skipped);
	if (b->size)
		MR_TRY(triangulate(b, &made));
	else {
		made.t = (const mr_tri *)b->corner; /* three indices each */
		made.nf = b->faces;
		made.group = b->has_groups ? b->group : NULL;
	}
	if (made.nf == 0)
		made.group = NULL;
	if (made.group) {
		made.groups = (mr_lines){ b->names.text, b->names.bytes - 1 };
	}
	if (b->skipped)
		mr_note(b->ctx, "%zu faces of fewer than three corners left out", b->skipped);
	b->counts->faces_left_out = b->skipped;
	b->counts->polygons = b->polygons;
	report_seams(b);
	made.counts = *b->counts;
	*m = made;
	return MR_OK;
}
