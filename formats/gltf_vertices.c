/* Corners that may be one vertex, by what they have; faces in order, by counting. */
#include "formats/gltf_vertices.h"

#include "formats/build.h"

void
mr_sort_by(mr_ctx *ctx, const uint32_t *key, size_t most, uint32_t *order, size_t n)
{
	mr_mark mark = mr_mark_take(ctx);
	size_t *start = MR_NEW_ZERO(ctx, most + 2, size_t);
	uint32_t *to = MR_NEW(ctx, n, uint32_t);

	for (size_t i = 0; i < n; i++)
		start[key[order[i]] + 1]++;
	for (size_t k = 0; k <= most; k++)
		start[k + 1] += start[k];
	for (size_t i = 0; i < n; i++)
		to[start[key[order[i]]]++] = order[i];
	memcpy(order, to, n * sizeof *to);
	mr_mark_release(ctx, mark);
}

void
mr_face_names_find(mr_ctx *ctx, const uint32_t *column, mr_lines lines, size_t nf, mr_face_names *names)
{
	*names = (mr_face_names){ .of = MR_NEW_ZERO(ctx, nf, uint32_t) };
	if (!column || !lines.text)
		return;
	mr_lines_starts(ctx, lines, &names->start, &names->count);
	for (size_t f = 0; f < nf; f++) {
		uint32_t i = column[f];
		bool named = i < names->count && names->start[i + 1] > names->start[i] + 1;
		names->of[f] = named ? i : (uint32_t)names->count;
	}
}

/* Numbers the corners by vertex, texture coordinates and normal: `key` of each three numbers. */
static void
make_keys(mr_ctx *ctx, const mr_model *m, double **key)
{
	size_t corners = 3 * m->nf, count;
	uint32_t *uv = MR_NEW_ZERO(ctx, corners, uint32_t), *vn = MR_NEW_ZERO(ctx, corners, uint32_t),
		 *first = MR_NEW(ctx, corners, uint32_t);

	*key = MR_NEW(ctx, 3 * corners, double);
	if (m->corner_texcoord)
		mr_number_rows(ctx, m->corner_texcoord, 2, corners, uv, first, &count);
	if (m->corner_normal)
		mr_number_rows(ctx, &m->corner_normal->x, 3, corners, vn, first, &count);
	for (size_t c = 0; c < corners; c++) {
		(*key)[3 * c] = m->t[c / 3].v[c % 3];
		(*key)[3 * c + 1] = uv[c];
		(*key)[3 * c + 2] = vn[c] + 1.0; /* never all zero, which is none */
	}
}

/* The first distinct corner of a vertex is that vertex, the others come behind all. */
static void
number_vertices(
    const mr_model *m, const uint32_t *first, size_t distinct, uint32_t *place, mr_gltf_vertices *v)
{
	for (size_t i = 0; i < m->nv; i++) {
		v->vertex[i] = (uint32_t)i;
		v->corner[i] = MR_NONE;
	}
	v->count = m->nv;
	for (size_t k = 0; k < distinct; k++) {
		uint32_t vertex = m->t[first[k] / 3].v[first[k] % 3];
		size_t at = v->corner[vertex] == MR_NONE ? vertex : v->count++;
		v->vertex[at] = vertex;
		v->corner[at] = first[k];
		place[k] = (uint32_t)at;
	}
}

void
mr_gltf_vertices_find(mr_ctx *ctx, const mr_model *m, mr_gltf_vertices *v)
{
	size_t corners = 3 * m->nf, distinct = 0;
	uint32_t *number = MR_NEW(ctx, corners, uint32_t), *first = MR_NEW(ctx, corners, uint32_t), *place;
	double *key;

	make_keys(ctx, m, &key);
	mr_number_rows(ctx, key, 3, corners, number, first, &distinct);
	*v = (mr_gltf_vertices){ .vertex = MR_NEW(ctx, m->nv + distinct, uint32_t),
		.corner = MR_NEW(ctx, m->nv + distinct, uint32_t),
		.index = number };
	place = MR_NEW(ctx, distinct, uint32_t);
	number_vertices(m, first, distinct, place, v);
	for (size_t c = 0; c < corners; c++)
		v->index[c] = place[number[c]];
}
