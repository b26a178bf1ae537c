/* Faces in the order of their sets, by counting; corners that may be one vertex, by what they have. */
#include "formats/gltf_sets.h"

#include "formats/format.h"
#include "mesh/repair.h"

#include <stdlib.h>

/* ---- faces in order ---- */

/* Sorts `order` by key[order[i] / group], stably; keys are below `limit`. */
static mr_status
sort_by(mr_ctx *ctx, const uint32_t *key, size_t limit, size_t group, uint32_t *order, size_t n)
{
	mr_mark mark = mr_mark_take(ctx);
	size_t *start = MR_NEW_ZERO(ctx, limit + 1, size_t);
	uint32_t *to = MR_NEW(ctx, n, uint32_t);

	if (!start || !to)
		return MR_EMEM;
	for (size_t i = 0; i < n; i++)
		start[key[order[i] / group] + 1]++;
	for (size_t k = 0; k < limit; k++)
		start[k + 1] += start[k];
	for (size_t i = 0; i < n; i++)
		to[start[key[order[i] / group]]++] = order[i];
	memcpy(order, to, n * sizeof *to);
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* Which name each face has: `names` for one without. */
static mr_status
number_names(mr_ctx *ctx, const uint32_t *column, mr_lines lines, size_t nf, const char ***name,
    size_t *names, uint32_t **number)
{
	*names = 0;
	*number = MR_NEW_ZERO(ctx, nf, uint32_t);
	if (!*number)
		return MR_EMEM;
	if (!column || !lines.text)
		return MR_OK;
	MR_TRY(mr_lines_starts(ctx, lines, name, names));
	for (size_t f = 0; f < nf; f++)
		(*number)[f] = column[f] < *names && (*name)[column[f] + 1] > (*name)[column[f]] + 1
		                   ? column[f]
		                   : (uint32_t)*names;
	return MR_OK;
}

static const mr_v3 *
corner_normal(const mr_model *m, size_t c)
{
	return m->corner_normal ? m->corner_normal + c : m->normal ? m->normal + m->t[c / 3].v[c % 3] : NULL;
}

/* What all corners of a face have; counts what only some have. */
static uint32_t
face_kind(mr_sets *s, size_t f)
{
	size_t texcoords = 0, normals = 0;

	for (size_t c = 3 * f; c < 3 * f + 3; c++) {
		const double *uv = mr_corner_texcoord(s->m, c);
		const mr_v3 *n = corner_normal(s->m, c);
		texcoords += uv && isfinite(uv[0]) && isfinite(uv[1]);
		normals += n && mr_is_direction(*n);
	}
	s->partial_texcoords += texcoords % 3;
	s->partial_normals += normals % 3;
	return (texcoords == 3 ? MR_SET_TEXCOORDS : 0) | (normals == 3 ? MR_SET_NORMALS : 0);
}

static bool
same_set(const mr_sets *s, uint32_t f, uint32_t g)
{
	return s->object[f] == s->object[g] && s->kind[f] == s->kind[g];
}

/* Faces by object, kind and material, and the set of each. */
static mr_status
sort_faces(mr_ctx *ctx, mr_sets *s)
{
	size_t nf = s->m->nf;
	uint32_t set = 0;

	for (size_t f = 0; f < nf; f++) {
		s->face[f] = (uint32_t)f;
		s->kind[f] = face_kind(s, f);
	}
	MR_TRY(sort_by(ctx, s->material, s->materials + 1, 1, s->face, nf));
	MR_TRY(sort_by(ctx, s->kind, MR_SET_KINDS, 1, s->face, nf));
	MR_TRY(sort_by(ctx, s->object, s->objects + 1, 1, s->face, nf));
	for (size_t i = 0; i < nf; i++) {
		set += i > 0 && !same_set(s, s->face[i - 1], s->face[i]);
		s->set[s->face[i]] = set;
	}
	return MR_OK;
}

/* Corners by set, vertex and index: those of the faces that the set has in the order of faces stand where
 * these do. */
static mr_status
sort_corners(mr_ctx *ctx, mr_sets *s)
{
	size_t n = 3 * s->m->nf;

	for (size_t c = 0; c < n; c++)
		s->corner[c] = (uint32_t)c;
	MR_TRY(sort_by(ctx, s->m->t->v, s->m->nv, 1, s->corner, n));
	return sort_by(ctx, s->set, s->m->nf, 3, s->corner, n);
}

static mr_status
find_isolated(mr_ctx *ctx, mr_sets *s)
{
	size_t count;
	bool *used;

	MR_TRY(mr_vertices_used(ctx, s->m->t, s->m->nf, s->m->nv, &used, &count));
	s->used = count < s->m->nv ? used : NULL;
	return MR_OK;
}

mr_status
mr_sets_begin(mr_ctx *ctx, const mr_model *m, mr_sets *s)
{
	mr_sets made = { .m = m };

	made.face = MR_NEW(ctx, m->nf, uint32_t);
	made.set = MR_NEW(ctx, m->nf, uint32_t);
	made.kind = MR_NEW(ctx, m->nf, uint32_t);
	made.corner = MR_NEW(ctx, 3 * m->nf, uint32_t);
	made.index = MR_NEW(ctx, 3 * m->nf, uint32_t);
	if (!made.face || !made.set || !made.kind || !made.corner || !made.index)
		return MR_EMEM;
	MR_TRY(
	    number_names(ctx, m->object, m->objects, m->nf, &made.object_name, &made.objects, &made.object));
	MR_TRY(number_names(
	    ctx, m->material, m->materials, m->nf, &made.material_name, &made.materials, &made.material));
	MR_TRY(sort_faces(ctx, &made));
	MR_TRY(sort_corners(ctx, &made));
	MR_TRY(find_isolated(ctx, &made));
	*s = made;
	return MR_OK;
}

static mr_status
shares_vertices(mr_ctx *ctx, const mr_sets *s, bool *shared)
{
	uint32_t *object = MR_NEW(ctx, s->m->nv, uint32_t);

	if (!object)
		return MR_EMEM;
	for (size_t i = 0; i < s->m->nv; i++)
		object[i] = MR_NONE;
	for (size_t c = 0; c < 3 * s->m->nf; c++) {
		uint32_t *of = &object[s->m->t[c / 3].v[c % 3]];
		*shared |= *of != MR_NONE && *of != s->object[c / 3];
		*of = s->object[c / 3];
	}
	return MR_OK;
}

mr_status
mr_sets_ambiguous(mr_ctx *ctx, const mr_sets *s, bool *ambiguous)
{
	mr_mark mark = mr_mark_take(ctx);
	size_t nv = s->m->nv, places;
	mr_v3 *p = MR_NEW(ctx, nv, mr_v3);
	uint32_t *map = MR_NEW(ctx, nv, uint32_t);
	bool shared = false;

	if (!p || !map)
		return MR_EMEM;
	for (size_t i = 0; i < nv; i++)
		p[i] = mr_vec(
		    mr_as_float(s->m->p[i].x), mr_as_float(s->m->p[i].y), mr_as_float(s->m->p[i].z));
	MR_TRY(mr_weld(ctx, p, nv, 0, map, &places));
	MR_TRY(shares_vertices(ctx, s, &shared));
	mr_mark_release(ctx, mark);
	*ambiguous = places < nv || shared;
	return MR_OK;
}

size_t
mr_set_end(const mr_sets *s, size_t first)
{
	size_t end = first + 1;

	while (end < s->m->nf && s->set[s->face[end]] == s->set[s->face[first]])
		end++;
	return end;
}

/* ---- sets of vertices ---- */

/* A corner and what distinguishes it from others of its vertex. */
typedef struct mr_distinct {
	double x[5];
	uint32_t corner;
} distinct;

static int
compare_distinct(const void *a, const void *b)
{
	const distinct *p = a, *q = b;
	int order = memcmp(p->x, q->x, sizeof p->x);

	return order ? order : (p->corner > q->corner) - (p->corner < q->corner);
}

static distinct
distinct_corner(const mr_model *m, unsigned kind, uint32_t c)
{
	distinct d = { .corner = c };

	if (kind & MR_SET_TEXCOORDS && m->corner_texcoord)
		memcpy(d.x, m->corner_texcoord + 2 * (size_t)c, 2 * sizeof(double));
	if (kind & MR_SET_NORMALS && m->corner_normal)
		memcpy(d.x + 2, m->corner_normal + c, sizeof(mr_v3));
	return d;
}

static void
add_vertex(mr_vertex_set *v, uint32_t vertex, uint32_t corner)
{
	v->vertex[v->count] = vertex;
	v->corner[v->count++] = corner;
}

/* Gives the n corners of one vertex their numbers: one for each that is distinct. */
static mr_status
number_corners(mr_ctx *ctx, mr_sets *s, mr_vertex_set *v, const uint32_t *corner, size_t n)
{
	distinct *d;

	MR_TRY(MR_RESERVE(ctx, s->group, 0, n, &s->group_room));
	d = s->group;
	for (size_t i = 0; i < n; i++)
		d[i] = distinct_corner(s->m, v->kind, corner[i]);
	if (s->m->corner_texcoord || s->m->corner_normal)
		qsort(d, n, sizeof *d, compare_distinct);
	for (size_t i = 0; i < n; i++) {
		if (i == 0 || memcmp(d[i].x, d[i - 1].x, sizeof d->x))
			add_vertex(v, s->m->t[corner[0] / 3].v[corner[0] % 3], d[i].corner);
		s->index[d[i].corner] = (uint32_t)v->count - 1;
	}
	return MR_OK;
}

static void
add_isolated(mr_vertex_set *v, const bool *used, uint32_t from, uint32_t to)
{
	for (uint32_t i = from; used && i < to; i++)
		if (!used[i])
			add_vertex(v, i, MR_NONE);
}

mr_status
mr_set_make(mr_ctx *ctx, mr_sets *s, size_t first, size_t last, mr_vertex_set *v)
{
	const uint32_t *vertex = s->m->t->v, *corner = s->corner;
	const bool *used = first == 0 ? s->used : NULL;
	size_t most = 3 * (last - first) + (used ? s->m->nv : 0);
	mr_vertex_set made = { .kind = s->kind[s->face[first]],
		.vertex = MR_NEW(ctx, most, uint32_t),
		.corner = MR_NEW(ctx, most, uint32_t) };
	uint32_t next = 0;

	if (!made.vertex || !made.corner)
		return MR_EMEM;
	for (size_t i = 3 * first, end; i < 3 * last; i = end) {
		for (end = i + 1; end < 3 * last && vertex[corner[end]] == vertex[corner[i]];)
			end++;
		add_isolated(&made, used, next, vertex[corner[i]]);
		next = vertex[corner[i]] + 1;
		MR_TRY(number_corners(ctx, s, &made, corner + i, end - i));
	}
	add_isolated(&made, used, next, (uint32_t)s->m->nv);
	*v = made;
	return MR_OK;
}

mr_status
mr_set_cloud(mr_sink *s, const mr_model *m, mr_vertex_set *v)
{
	size_t normals = 0;

	*v = (mr_vertex_set){ .count = m->nv,
		.vertex = MR_NEW(s->ctx, m->nv, uint32_t),
		.corner = MR_NEW(s->ctx, m->nv, uint32_t) };
	if (!v->vertex || !v->corner)
		return MR_EMEM;
	for (size_t i = 0; i < m->nv; i++) {
		v->vertex[i] = (uint32_t)i;
		v->corner[i] = MR_NONE;
		normals += m->normal && mr_is_direction(m->normal[i]);
	}
	if (normals == m->nv)
		v->kind = MR_SET_NORMALS;
	else
		mr_lost(s->ctx, NULL, normals, "normals beside points without");
	return MR_OK;
}
