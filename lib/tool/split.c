/* mr-split: a frame for each part of a layer. */

#include "base/options.h"
#include "mesh/subset.h"
#include "space/connected.h"

/* Parts smaller than this share of the largest are, of points, no parts but what lies around them; of a
 * surface a vertex without a face is none. */
static const double LEAST = 0.01;
enum { LEAST_VERTICES = 2 };

/* The rows of all parts, one part after the other. */
typedef struct parts {
	mr_connected of;
	uint32_t *vertex, *face, *number;
	size_t *first_vertex, *first_face; /* parts + 1 */
	size_t given;                      /* so many are large enough */
} parts;

/* Sorts n rows by part, in ascending order within one.  t: rows are of faces; NULL: of vertices. */
static void
sort_rows(mr_ctx *ctx, const mr_connected *c, const mr_tri *t, size_t n, uint32_t **row, size_t **first)
{
	size_t *at = MR_NEW_ZERO(ctx, c->parts + 2, size_t);

	*row = MR_NEW(ctx, n, uint32_t);
	for (size_t i = 0; i < n; i++)
		at[c->part[t ? t[i].v[0] : i] + 2]++;
	for (size_t k = 2; k < c->parts + 2; k++)
		at[k] += at[k - 1];
	for (size_t i = 0; i < n; i++)
		(*row)[at[c->part[t ? t[i].v[0] : i] + 1]++] = (uint32_t)i;
	*first = at;
}

static mr_status
find_parts(mr_ctx *ctx, mr_frame *f, const mr_mesh *m, const mr_split_opts *o, parts *p)
{
	double unit = o->distance_relative ? mr_mesh_diagonal(m) : 1;
	size_t least = o->least;

	MR_TRY(mr_connected_of(ctx, f, m, o->distance * unit, &p->of));
	sort_rows(ctx, &p->of, NULL, m->nv, &p->vertex, &p->first_vertex);
	sort_rows(ctx, &p->of, m->t, m->nf, &p->face, &p->first_face);
	p->number = MR_NEW(ctx, m->nv, uint32_t);
	for (size_t i = 0; i < m->nv; i++)
		p->number[p->vertex[i]] = (uint32_t)(i - p->first_vertex[p->of.part[p->vertex[i]]]);
	if (least == 0)
		least = m->nf ? LEAST_VERTICES : (size_t)ceil(LEAST * (double)p->of.size[0]);
	for (p->given = 0; p->given < p->of.parts && p->of.size[p->given] >= least; p->given++)
		;
	if (p->given == 0)
		return mr_fail(ctx, MR_EMESH, "%s: no part has %zu %s: the largest has %zu", m->name, least,
		    m->nf ? "vertices" : "points", p->of.size[0]);
	return MR_OK;
}

/* A layer of the frame besides the given one; NULL: there is none. */
static const char *
other_layer(const mr_frame *f, const char *layer)
{
	for (size_t i = 0; i < f->count; i++)
		if (*f->columns[i].layer && strcmp(f->columns[i].layer, layer))
			return f->columns[i].layer;
	return NULL;
}

/* Drops the other layers, which are not divided, and what refers to them. */
static void
keep_only(mr_frame *f, const char *layer)
{
	char other[MR_LAYER_MAX + 1];

	for (const char *name; (name = other_layer(f, layer));) {
		snprintf(other, sizeof other, "%s", name);
		mr_layer_changed(f, other, MR_RECONNECTED);
		mr_frame_drop(f, other, NULL, 0);
	}
}

static mr_status
take_part(mr_ctx *ctx, const mr_frame *f, const char *layer, const parts *p, size_t k, mr_frame **out)
{
	mr_frame *part = MR_NEW(ctx, 1, mr_frame);
	const mr_subset s = { p->vertex + p->first_vertex[k], p->face + p->first_face[k],
		p->first_vertex[k + 1] - p->first_vertex[k], p->first_face[k + 1] - p->first_face[k],
		p->number };

	mr_frame_copy(ctx, f, part);
	keep_only(part, layer);
	part->key = true;
	part->name = mr_format(ctx, "%s-%zu", f->name, k + 1);
	*out = part;
	return mr_layer_keep(ctx, part, layer, &s);
}

static void
tell(mr_ctx *ctx, const mr_mesh *m, const parts *p, mr_split_result *r)
{
	*r = (mr_split_result){ .parts = p->given,
		.dropped = p->of.parts - p->given,
		.largest = p->of.size[0],
		.smallest = p->of.size[p->given - 1] };
	r->dropped_vertices = m->nv - p->first_vertex[p->given];
	mr_lost(ctx, m->name, r->dropped, "small parts");
}

static mr_status
split(mr_ctx *ctx, mr_frame *f, const mr_split_opts *o, mr_frame ***out, mr_split_result *result)
{
	static const char *const reads[] = { "mesh", "control", "points", NULL };
	const char *layer, *others;
	mr_split_result r;
	mr_frame **part;
	mr_mesh m;
	parts p;

	MR_TRY(mr_check_number(ctx, "distance", o->distance, 0, 1e300));
	MR_TRY(mr_layer_choose_warned(ctx, f, o->layer, reads, &layer));
	MR_TRY(mr_layer_surface_or_points(ctx, f, layer, &m));
	if (m.nv == 0)
		return mr_fail(ctx, MR_EMESH, "%s: there is no point", layer);
	if (m.nf && o->distance > 0)
		return mr_fail(
		    ctx, MR_EUSAGE, "%s has faces, which connect it: a distance is of points", layer);
	MR_TRY(find_parts(ctx, f, &m, o, &p));
	part = MR_NEW(ctx, p.given, mr_frame *);
	for (size_t k = 0; k < p.given; k++)
		MR_TRY(take_part(ctx, f, layer, &p, k, &part[k]));
	mr_layer_names(ctx, f, layer, &others);
	if (*others)
		mr_lost(ctx, layer, 1, others);
	tell(ctx, &m, &p, &r);
	*out = part;
	if (result)
		*result = r;
	return MR_OK;
}

mr_status
mr_split_frame(mr_ctx *ctx, mr_frame *f, const mr_split_opts *opts, mr_frame ***out, mr_split_result *result)
{
	static const mr_split_opts defaults;

	MR_ENTER(ctx);
	return split(ctx, f, opts ? opts : &defaults, out, result);
}
