/* A layer cut down to some of its rows: columns are gathered, triangles get the new numbers. */
#include "mesh/subset.h"

/* The end of the run of triangles from i on that are one polygon: successive ones with one number. */
static size_t
polygon_end(const uint32_t *polygon, size_t nf, size_t i)
{
	size_t end = i + 1;

	while (polygon && end < nf && polygon[end] == polygon[i])
		end++;
	return end;
}

static bool
corners_kept(const mr_mesh *m, const bool *keep, size_t begin, size_t end)
{
	for (size_t f = begin; f < end; f++)
		for (int k = 0; k < 3; k++)
			if (!keep[m->t[f].v[k]])
				return false;
	return true;
}

static size_t
find_faces(const mr_mesh *m, const uint32_t *polygon, const bool *keep, uint32_t *face)
{
	size_t n = 0;

	for (size_t f = 0, end; f < m->nf; f = end) {
		end = polygon_end(polygon, m->nf, f);
		if (corners_kept(m, keep, f, end))
			for (size_t i = f; i < end; i++)
				face[n++] = (uint32_t)i;
	}
	return n;
}

/* Which vertices had faces, and which have some left.  mark: zeros. */
enum { USED = 1, LEFT = 2 };

static void
mark_corners(const mr_mesh *m, const mr_subset *s, uint8_t *mark)
{
	for (size_t f = 0; f < m->nf; f++)
		for (int k = 0; k < 3; k++)
			mark[m->t[f].v[k]] = USED;
	for (size_t i = 0; i < s->nf; i++)
		for (int k = 0; k < 3; k++)
			mark[m->t[s->face[i]].v[k]] = LEFT;
}

mr_status
mr_subset_find(mr_ctx *ctx, mr_frame *f, const mr_mesh *m, const bool *keep, mr_subset *s)
{
	uint32_t *vertex = MR_NEW(ctx, m->nv, uint32_t), *face = MR_NEW(ctx, m->nf, uint32_t);
	uint32_t *number = MR_NEW(ctx, m->nv, uint32_t);
	uint8_t *mark = MR_NEW_ZERO(ctx, m->nv, uint8_t);
	const void *polygon = NULL;
	mr_subset r = { vertex, face, 0, 0, number };

	if (m->nf && mr_layer_has(f, m->name, "polygon"))
		MR_TRY(mr_layer_get_rows(ctx, f, m->name, "polygon", m->nf, &polygon));
	r.nf = find_faces(m, polygon, keep, face);
	mark_corners(m, &r, mark);
	for (size_t v = 0; v < m->nv; v++)
		if (keep[v] && mark[v] != USED) {
			number[v] = (uint32_t)r.nv;
			vertex[r.nv++] = (uint32_t)v;
		}
	*s = r;
	return MR_OK;
}

mr_status
mr_layer_gather(mr_ctx *ctx, mr_frame *f, const char *layer, char element, const uint32_t *of, size_t n)
{
	char name[MR_LAYER_MAX + 1];
	mr_carried c;

	snprintf(name, sizeof name, "%s", layer); /* which may point into a column */
	for (size_t i = 0; i < f->count; i++) {
		if (strcmp(f->columns[i].layer, name) || f->columns[i].shape.element != element)
			continue;
		MR_TRY(mr_carried_begin(ctx, f, i, (size_t)f->columns[i].rows, n, &c));
		c.kind = MR_LABEL;
		mr_carried_make(ctx, &c, 1, 0, (mr_rows_from){ n, 1, of, NULL });
		MR_TRY(mr_carried_put(ctx, f, name, &c, 1));
	}
	return MR_OK;
}

/* The triangles by the numbers that their corners have now. */
static mr_status
renumber_faces(mr_ctx *ctx, mr_frame *f, const char *layer, const mr_subset *s)
{
	mr_tri *own = MR_NEW(ctx, s->nf, mr_tri);
	const void *t;

	MR_TRY(mr_layer_get_rows(ctx, f, layer, "triangles", s->nf, &t));
	memcpy(own, t, s->nf * sizeof *own);
	for (size_t i = 0; i < 3 * s->nf; i++)
		own[i / 3].v[i % 3] = s->number[own[i / 3].v[i % 3]];
	return mr_frame_put(ctx, f, layer, "triangles", (mr_shape){ 'f', 'u', 3 }, own, s->nf);
}

mr_status
mr_layer_keep(mr_ctx *ctx, mr_frame *f, const char *layer, const mr_subset *s)
{
	const mr_column *p = mr_frame_find(f, layer, "position"), *t = mr_frame_find(f, layer, "triangles");
	const mr_column *encoded = mr_frame_find(f, "base", "encoded");
	bool detail = !strcmp(layer, "mesh") && encoded && mr_layer_has(f, layer, "detail_face");
	mr_column on = { 0 };

	if (p->rows == s->nv && (!t || t->rows == s->nf))
		return mr_layer_worked(ctx, f, layer);
	if (detail)
		on = *encoded;
	mr_layer_drop_kind(f, layer, MR_SAMPLED); /* the neighbourhoods of the points are others now */
	MR_TRY(mr_layer_gather(ctx, f, layer, 'v', s->vertex, s->nv));
	MR_TRY(mr_layer_gather(ctx, f, layer, 'f', s->face, s->nf));
	if (t)
		MR_TRY(renumber_faces(ctx, f, layer, s));
	mr_layer_renumbered(f, layer);
	if (detail) /* the rest is still over the base on which it was encoded */
		MR_TRY(mr_frame_pass(ctx, f, &on));
	return mr_layer_worked(ctx, f, layer);
}
