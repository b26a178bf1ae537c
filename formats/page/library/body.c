/*
 * A base with its detail that handles pose, for the page: one of several parts of it, each a worker's.  A
 * part is a range of the base's vertices, with so many rings around it that it turns as the whole does, and
 * the rows of detail that stand there.
 */
#include "edit/deform.h"
#include "edit/phong.h"
#include "formats/page/library/export.h"
#include "formats/page/library/turning.h"

/* What the page has of all of it, malloc's. */
typedef struct whole {
	const mr_v3 *position, *rest; /* nv: of the base, and where it was encoded */
	const mr_tri *triangles;      /* nf */
	const double *response;       /* nv rows of 4 numbers a handle, to maps about `origin` */
	const uint32_t *face;         /* n: of the detail */
	const double (*bary)[2];
	const double *height;
	const mr_v3 *offset; /* or NULL */
	uint32_t nv, nf, n, handles;
	mr_v3 origin;
} whole;

/* A row of detail: where it stands on the base, and the height, or the vector at rest in its place. */
typedef struct stand {
	uint32_t corner[3];
	float weight[3], height;
} stand;

typedef struct apart {
	size_t row;
	mr_v3 offset;
} apart;

typedef struct body {
	mr_ctx ctx;
	size_t handles;
	mr_v3 origin;
	const mr_v3 *position;
	const double *response;
	mr_mesh base; /* at rest */
	mr_turning turning;
	size_t rows, offsets;
	stand *stand;
	apart *apart;
	mr_v3 *places; /* of the base, as posed */
	d4 *wide;
	float (*out)[3], (*base_out)[3];
	const uint32_t *vertex, *row; /* of the whole */
} body;

enum { RINGS = 3 }; /* a vertex's turn asks for the faces around it, and two rings have theirs smoothed */

/* Marks the vertices of faces with a marked one. */
static void
grow(const whole *w, bool *set, bool *grown)
{
	memcpy(grown, set, w->nv);
	for (size_t f = 0; f < w->nf; f++) {
		const uint32_t *v = w->triangles[f].v;
		if (set[v[0]] || set[v[1]] || set[v[2]])
			grown[v[0]] = grown[v[1]] = grown[v[2]] = true;
	}
	memcpy(set, grown, w->nv);
}

/* The rows whose face's first corner is within [first, end), and in `set` all vertices that the part asks
 * for. */
static mr_status
choose(body *b, const whole *w, size_t first, size_t end, bool *set)
{
	bool *grown = MR_NEW(&b->ctx, w->nv, bool);
	uint32_t *row = MR_NEW(&b->ctx, w->n, uint32_t);

	if (!grown || !row)
		return MR_EMEM;
	memset(set + first, true, end - first);
	for (uint32_t i = 0; i < w->n; i++) {
		const uint32_t *v = w->triangles[w->face[i]].v;
		if (v[0] < first || v[0] >= end)
			continue;
		set[v[1]] = set[v[2]] = true;
		row[b->rows++] = i;
	}
	for (int i = 0; i < RINGS && end - first < w->nv; i++)
		grow(w, set, grown);
	b->row = row;
	return MR_OK;
}

/* The vertices that are set, with what is known of them; place: where each has come. */
static mr_status
take_vertices(body *b, const whole *w, const bool *set, uint32_t *place)
{
	size_t width = 4 * w->handles, nv = 0;
	uint32_t *vertex = MR_NEW(&b->ctx, w->nv, uint32_t);
	mr_v3 *position = MR_NEW(&b->ctx, w->nv, mr_v3), *rest = MR_NEW(&b->ctx, w->nv, mr_v3);
	double *response = mr_alloc(&b->ctx, w->nv, width * sizeof *response);

	if (!vertex || !position || !rest || !response)
		return MR_EMEM;
	for (uint32_t v = 0; v < w->nv; v++) {
		place[v] = set[v] ? (uint32_t)nv : MR_NONE;
		if (!set[v])
			continue;
		vertex[nv] = v;
		position[nv] = w->position[v];
		rest[nv] = w->rest[v];
		memcpy(response + width * nv, w->response + width * v, width * sizeof *response);
		nv++;
	}
	b->vertex = vertex;
	b->position = position;
	b->response = response;
	b->base = (mr_mesh){ "base", rest, NULL, nv, 0 };
	return MR_OK;
}

/* The faces between them. */
static mr_status
take_faces(body *b, const whole *w, const uint32_t *place)
{
	mr_tri *t = MR_NEW(&b->ctx, w->nf, mr_tri);

	if (!t)
		return MR_EMEM;
	b->base.t = t;
	for (size_t f = 0; f < w->nf; f++) {
		const uint32_t *v = w->triangles[f].v;
		const uint32_t a = place[v[0]], c = place[v[1]], d = place[v[2]];
		if (a != MR_NONE && c != MR_NONE && d != MR_NONE)
			t[b->base.nf++] = (mr_tri){ { a, c, d } };
	}
	return MR_OK;
}

/* An offset, which is in the frame that the base has there, as a vector. */
static mr_v3
vector_at_rest(const whole *w, const mr_v3 *normal, const uint32_t *place, uint32_t row, mr_v3 bary)
{
	mr_mesh m = { "base", w->rest, w->triangles, w->nv, w->nf };
	mr_tri at = w->triangles[w->face[row]];
	mr_v3 o = w->offset[row], corner[3], n[3];
	mr_tangent_frame f;

	for (int k = 0; k < 3; k++) {
		corner[k] = m.p[at.v[k]];
		n[k] = normal[place[at.v[k]]];
	}
	m = (mr_mesh){ "face", corner, &(mr_tri){ { 0, 1, 2 } }, 3, 1 };
	f = mr_phong_frame(&(mr_phong){ &m, n }, (mr_place){ 0, bary });
	return mr_axpy(o.x, f.t1, mr_axpy(o.y, f.t2, mr_mul(o.z, f.n)));
}

static mr_status
take_rows(body *b, const whole *w, const mr_v3 *normal, const uint32_t *place)
{
	b->stand = MR_NEW(&b->ctx, b->rows, stand);
	b->apart = MR_NEW(&b->ctx, w->offset ? b->rows : 0, apart);
	if (!b->stand || !b->apart)
		return MR_EMEM;
	for (size_t i = 0; i < b->rows; i++) {
		uint32_t row = b->row[i];
		const uint32_t *v = w->triangles[w->face[row]].v;
		const double x = w->bary[row][0], y = w->bary[row][1], z = 1 - x - y;
		b->stand[i] = (stand){ { place[v[0]], place[v[1]], place[v[2]] },
			{ (float)x, (float)y, (float)z }, (float)w->height[row] };
		if (w->offset && mr_norm2(w->offset[row]) > 0)
			b->apart[b->offsets++] = (apart){ i,
				vector_at_rest(w, normal, place, row, mr_vec(x, y, z)) };
	}
	return MR_OK;
}

/* The k-th part of so many. */
static mr_status
take_part(body *b, const whole *w, size_t k, size_t parts)
{
	uint32_t *place = MR_NEW(&b->ctx, w->nv, uint32_t);
	bool *set = MR_NEW_ZERO(&b->ctx, w->nv, bool);
	mr_v3 *normal = MR_NEW(&b->ctx, w->nv, mr_v3);

	if (!place || !set || !normal)
		return MR_EMEM;
	MR_TRY(choose(b, w, w->nv * k / parts, w->nv * (k + 1) / parts, set));
	MR_TRY(take_vertices(b, w, set, place));
	MR_TRY(take_faces(b, w, place));
	MR_TRY(mr_vertex_normals(&b->ctx, &b->base, NULL, normal));
	MR_TRY(mr_turning_begin(&b->ctx, &b->base, normal, &b->turning));
	MR_TRY(take_rows(b, w, normal, place));
	b->places = MR_NEW(&b->ctx, b->base.nv, mr_v3);
	b->wide = MR_NEW(&b->ctx, b->base.nv, d4);
	b->out = mr_alloc(&b->ctx, b->rows, sizeof *b->out);
	b->base_out = mr_alloc(&b->ctx, b->base.nv, sizeof *b->base_out);
	return b->places && b->wide && b->out && b->base_out ? MR_OK : MR_EMEM;
}

/* NULL where there is no memory. */
MR_EXPORT(body_new)
body *
body_new(const whole *w, size_t k, size_t parts)
{
	body *b = calloc(1, sizeof *b);

	if (!b)
		return NULL;
	mr_ctx_init(&b->ctx, 1);
	b->handles = w->handles;
	b->origin = w->origin;
	return take_part(b, w, k, parts) == MR_OK ? b : NULL;
}

/* Places of n vertices by their response, to maps about `origin`, and a map for each handle. */
static mr_status
respond(mr_ctx *ctx, const mr_v3 *p, size_t n, const double *response, size_t handles, mr_v3 origin,
    const mr_affine *map, mr_v3 *out)
{
	mr_mark mark = mr_mark_take(ctx);
	mr_affine *about = MR_NEW(ctx, handles, mr_affine);
	mr_status status;

	if (!about)
		return MR_EMEM;
	for (size_t h = 0; h < handles; h++) {
		mr_v3 moved = mr_sub(mr_apply(&map[h], origin), origin);
		about[h] = map[h];
		about[h].m[3] = moved.x, about[h].m[7] = moved.y, about[h].m[11] = moved.z;
	}
	status = mr_pose_by_response(ctx, p, n, response, handles, about, out);
	mr_mark_release(ctx, mark);
	return status;
}

/* The same without a body. */
MR_EXPORT(pose_by_response)
bool
pose_by_response(const mr_v3 *p, size_t n, const double *response, size_t handles, const mr_v3 *origin,
    const mr_affine *map, mr_v3 *out)
{
	mr_ctx ctx;
	mr_status status;

	mr_ctx_init(&ctx, 1);
	status = respond(&ctx, p, n, response, handles, *origin, map, out);
	mr_ctx_free(&ctx);
	return status == MR_OK;
}

static void
put_base(body *b)
{
	for (size_t v = 0; v < b->base.nv; v++) {
		mr_v3 p = b->places[v];
		b->wide[v] = (d4){ p.x, p.y, p.z, 0 };
		b->base_out[v][0] = (float)p.x;
		b->base_out[v][1] = (float)p.y;
		b->base_out[v][2] = (float)p.z;
	}
}

/* b + h n.  Where the normals of its corners cancel there is no height that mr-encode calls sound. */
static void
put_row(const body *b, const stand *s, float out[3])
{
	const uint32_t *c = s->corner;
	const v4 *n = b->turning.turned;
	const v4 m = s->weight[0] * n[c[0]] + s->weight[1] * n[c[1]] + s->weight[2] * n[c[2]], m2 = m * m;
	const float size = m2[0] + m2[1] + m2[2];
	const d4 p = s->weight[0] * b->wide[c[0]] + s->weight[1] * b->wide[c[1]] +
	             s->weight[2] * b->wide[c[2]];
	const v4 at = __builtin_convertvector(p, v4) + m * (size > 0 ? s->height / __builtin_sqrtf(size) : 0);

	for (int k = 0; k < 3; k++)
		out[k] = at[k];
}

static void
add_offset(const body *b, const apart *a)
{
	const stand *s = &b->stand[a->row];
	mr_mat3 turn = mr_turning_mean(&b->turning, s->corner, s->weight);
	mr_v3 o = mr_mat3_apply(&turn, a->offset);

	b->out[a->row][0] += (float)o.x;
	b->out[a->row][1] += (float)o.y;
	b->out[a->row][2] += (float)o.z;
}

/* Poses it by a map for each handle. */
MR_EXPORT(body_pose)
bool
body_pose(body *b, const mr_affine *map)
{
	if (respond(&b->ctx, b->position, b->base.nv, b->response, b->handles, b->origin, map, b->places) !=
	    MR_OK)
		return false;
	put_base(b);
	mr_turning_find(&b->turning, b->wide);
	for (size_t i = 0; i < b->rows; i++)
		put_row(b, &b->stand[i], b->out[i]);
	for (size_t i = 0; i < b->offsets; i++)
		add_offset(b, &b->apart[i]);
	return true;
}

/* Of base, or else of the detail: the places as floats, how many there are, and which of the whole. */
MR_EXPORT(body_places)
const void *
body_places(const body *b, bool base)
{
	return base ? b->base_out : b->out;
}

MR_EXPORT(body_count)
size_t
body_count(const body *b, bool base)
{
	return base ? b->base.nv : b->rows;
}

MR_EXPORT(body_rows)
const uint32_t *
body_rows(const body *b, bool base)
{
	return base ? b->vertex : b->row;
}
