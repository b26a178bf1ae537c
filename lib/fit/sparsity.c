/*
 * Lists of the vertices that a face or a star depends on, and the pattern of the normal equations from
 * them.
 */
#include "fit/sparsity.h"

#include "base/sort.h"

size_t
mr_fit_find(const int *list, size_t n, int c)
{
	size_t low = 0;

	while (n > 1) {
		size_t half = n / 2;
		low = list[low + half] <= c ? low + half : low;
		n -= half;
	}
	return low;
}

/* Lists being written one after another. */
typedef struct writer {
	mr_ctx *ctx;
	mr_fit_lists *l;
	size_t used, room;
	int *seen; /* nv: the last list that each vertex is in, by number + 1 */
} writer;

static void
begin_lists(mr_ctx *ctx, writer *w, mr_fit_lists *l, size_t count, size_t nv)
{
	*w = (writer){ ctx, l, 0, 0, NULL };
	*l = (mr_fit_lists){ 0, MR_NEW(ctx, count + 1, size_t), NULL };
	w->room = 14 * count + 64;
	l->member = MR_NEW(ctx, w->room, int);
	w->seen = MR_NEW_ZERO(ctx, nv, int);
}

static void
add_member(writer *w, int v)
{
	int number = (int)w->l->count + 1;

	if (w->seen[v] == number)
		return;
	w->seen[v] = number;
	MR_RESERVE(w->ctx, w->l->member, w->used, 1, &w->room);
	w->l->member[w->used++] = v;
}

static void
begin_list(writer *w)
{
	w->l->start[w->l->count] = w->used;
}

static void
end_list(writer *w)
{
	size_t first = w->l->start[w->l->count];

	w->used = first + mr_sort_unique((uint32_t *)w->l->member + first, w->used - first);
	w->l->start[++w->l->count] = w->used;
}

void
mr_fit_list_patches(mr_ctx *ctx, const mr_fit_surface *s, mr_fit_lists *l)
{
	size_t nf = s->level[0].nf;
	writer w;

	begin_lists(ctx, &w, l, nf, s->level[0].nv);
	for (size_t f = 0; f < nf; f++) {
		uint32_t slot[MR_FIT_SLOTS];
		begin_list(&w);
		mr_fit_slots(s, f, slot);
		for (int i = 0; i < MR_FIT_SLOTS; i++)
			for (int e = s->s.start[slot[i]]; e < s->s.start[slot[i] + 1]; e++)
				add_member(&w, s->s.index[e]);
		end_list(&w);
	}
}

/* The neighbours of v, or those along sharp edges alone. */
static void
add_neighbours(writer *w, const mr_loop *l, const mr_mesh *m, uint32_t v, bool sharp)
{
	uint32_t first = l->topo.out[v], h = first;

	while (h != MR_NONE) {
		uint32_t last = mr_he_prev(h);
		bool is_sharp = l->topo.twin[h] == MR_NONE || (l->crease && l->crease[h]);
		if (!sharp || is_sharp)
			add_member(w, (int)mr_he_to(m, h));
		h = mr_he_ccw(&l->topo, h);
		if (h == MR_NONE)
			add_member(w, (int)mr_he_from(m, last));
		if (h == first)
			break;
	}
}

/* On a boundary or a crease the two along it; a corner has none, the end of a crease all. */
void
mr_fit_list_stars(mr_ctx *ctx, const mr_loop *level, mr_fit_lists *l)
{
	const mr_mesh m = { .t = level->t, .nv = level->nv, .nf = level->nf };
	writer w;

	begin_lists(ctx, &w, l, level->nv, level->nv);
	for (uint32_t v = 0; v < level->nv; v++) {
		size_t own, sharp;
		begin_list(&w);
		add_member(&w, (int)v);
		own = w.used;
		add_neighbours(&w, level, &m, v, true);
		sharp = w.used - own;
		if (sharp != 2)
			w.used = own;
		if (sharp < 2)
			add_neighbours(&w, level, &m, v, false);
		end_list(&w);
	}
}

typedef struct pattern {
	mr_ctx *ctx;
	mr_sparse *a;
	int used;
	size_t room;
	int *seen;
} pattern;

/* Adds to row v the members up to v of a list. */
static mr_status
add_pairs(pattern *p, const mr_fit_lists *l, size_t e, int v)
{
	for (size_t i = l->start[e]; i < l->start[e + 1] && l->member[i] <= v; i++) {
		int c = l->member[i];
		if (p->seen[c] == v + 1)
			continue;
		p->seen[c] = v + 1;
		if (p->used == INT32_MAX)
			return mr_fail(
			    p->ctx, MR_ERANGE, "the matrix of %d rows has 2^31 entries or more", p->a->n);
		MR_RESERVE(p->ctx, p->a->index, (size_t)p->used, 1, &p->room);
		p->a->index[p->used++] = c;
	}
	return MR_OK;
}

/* The lists that each vertex is in. */
static void
lists_of_vertices(mr_ctx *ctx, const mr_fit_lists *l, size_t nv, size_t **start, uint32_t **list)
{
	size_t *s = MR_NEW_ZERO(ctx, nv + 2, size_t), total = l->start[l->count];
	uint32_t *in = MR_NEW(ctx, total, uint32_t);

	for (size_t i = 0; i < total; i++)
		s[l->member[i] + 2]++;
	for (size_t v = 0; v < nv; v++)
		s[v + 2] += s[v + 1];
	for (size_t e = 0; e < l->count; e++)
		for (size_t i = l->start[e]; i < l->start[e + 1]; i++)
			in[s[l->member[i] + 1]++] = (uint32_t)e;
	*start = s;
	*list = in;
}

mr_status
mr_fit_pattern(mr_ctx *ctx, const mr_fit_lists *patch, const mr_fit_lists *star, size_t nv, mr_sparse *a)
{
	mr_sparse r = { .n = (int)nv, .start = MR_NEW(ctx, nv + 1, int) };
	pattern p = { ctx, &r, 0, 40 * nv, MR_NEW_ZERO(ctx, nv, int) };
	size_t *patch_start, *star_start;
	uint32_t *patches, *stars;

	r.index = MR_NEW(ctx, p.room, int);
	lists_of_vertices(ctx, patch, nv, &patch_start, &patches);
	lists_of_vertices(ctx, star, nv, &star_start, &stars);
	for (size_t v = 0; v < nv; v++) {
		int first = p.used;
		r.start[v] = first;
		for (size_t i = patch_start[v]; i < patch_start[v + 1]; i++)
			MR_TRY(add_pairs(&p, patch, patches[i], (int)v));
		for (size_t i = star_start[v]; i < star_start[v + 1]; i++)
			MR_TRY(add_pairs(&p, star, stars[i], (int)v));
		p.used = first + (int)mr_sort_unique((uint32_t *)r.index + first, (size_t)(p.used - first));
	}
	r.start[nv] = p.used;
	r.value = MR_NEW(ctx, (size_t)p.used, double);
	*a = r;
	return MR_OK;
}

void
mr_fit_place_pairs(mr_ctx *ctx, const mr_fit_lists *l, const mr_sparse *a, size_t **first, int **at)
{
	size_t *start = MR_NEW(ctx, l->count + 1, size_t), k = 0;
	int *place;

	for (size_t e = 0; e < l->count; e++) {
		start[e] = k;
		k += mr_fit_length(l, e) * (mr_fit_length(l, e) + 1) / 2;
	}
	start[l->count] = k;
	place = MR_NEW(ctx, k, int);
	k = 0;
	for (size_t e = 0; e < l->count; e++)
		for (size_t i = l->start[e]; i < l->start[e + 1]; i++) {
			int row = l->member[i], begin = a->start[row];
			size_t n = (size_t)(a->start[row + 1] - begin);
			for (size_t j = l->start[e]; j <= i; j++)
				place[k++] = begin + (int)mr_fit_find(a->index + begin, n, l->member[j]);
		}
	*first = start;
	*at = place;
}
