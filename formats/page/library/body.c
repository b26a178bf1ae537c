/*
 * A base with its detail that handles pose, for the page: one of several parts of it, each a worker's.  A
 * part is a range of the base's vertices along the Z curve, with so many rings around it that it turns as the
 * whole does, and the rows of detail that stand there, all in that order: memory far apart is slow.
 */
#include "edit/phong.h"
#include "edit/pose_basis.h"
#include "formats/page/library/export.h"
#include "formats/page/library/turning.h"
#include "mesh/zorder.h"

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
	/* For the page to read: places as floats, of base and of the detail, which of the whole they are, how
	 * many */
	float (*base_out)[3], (*out)[3];
	const uint32_t *vertex, *row;
	size_t vertices, rows;
	mr_ctx ctx;
	size_t handles;
	mr_v3 origin;
	const d4 *position;
	const v4 *response; /* of the vertices to handle 0, of room for `stride`; then to the next */
	size_t stride;
	mr_mesh base; /* at rest */
	mr_turning turning;
	size_t offsets;
	stand *stand;
	apart *apart;
	d4 *places; /* of the base, as posed */
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

/* The order of n things by keys below `keys`, equal ones as they were. */
static mr_status
order_by(mr_ctx *ctx, const uint32_t *key, size_t n, size_t keys, uint32_t **order)
{
	uint32_t *next = MR_NEW_ZERO(ctx, keys + 1, uint32_t);

	*order = MR_NEW(ctx, n, uint32_t);
	if (!next || !*order)
		return MR_EMEM;
	for (size_t i = 0; i < n; i++)
		next[key[i] + 1]++;
	for (size_t k = 0; k < keys; k++)
		next[k + 1] += next[k];
	for (uint32_t i = 0; i < n; i++)
		(*order)[next[key[i]]++] = i;
	return MR_OK;
}

/* The rows by the rank of their face's first corner, of those where that is within [first, end), and in `set`
 * all vertices that the part asks for. */
static mr_status
choose(body *b, const whole *w, const uint32_t *rank, size_t first, size_t end, bool *set)
{
	bool *grown = MR_NEW(&b->ctx, w->nv, bool);
	uint32_t *key = MR_NEW(&b->ctx, w->n, uint32_t), *row;
	size_t before = 0;

	if (!grown || !key)
		return MR_EMEM;
	for (size_t v = 0; v < w->nv; v++)
		set[v] = rank[v] >= first && rank[v] < end;
	for (uint32_t i = 0; i < w->n; i++) {
		const uint32_t *v = w->triangles[w->face[i]].v;
		key[i] = rank[v[0]];
		before += key[i] < first;
		if (key[i] < first || key[i] >= end)
			continue;
		set[v[1]] = set[v[2]] = true;
		b->rows++;
	}
	for (int i = 0; i < RINGS && end - first < w->nv; i++)
		grow(w, set, grown);
	MR_TRY(order_by(&b->ctx, key, w->n, w->nv, &row));
	b->row = row + before;
	return MR_OK;
}

/* The vertices that are set, in that order, with what is known of them; place: where each has come. */
static mr_status
take_vertices(body *b, const whole *w, const uint32_t *order, const bool *set, uint32_t *place)
{
	size_t nv = 0;
	uint32_t *vertex = MR_NEW(&b->ctx, w->nv, uint32_t);
	mr_v3 *rest = MR_NEW(&b->ctx, w->nv, mr_v3);
	d4 *position = MR_NEW(&b->ctx, w->nv, d4);
	v4 *response = mr_alloc(&b->ctx, w->nv * w->handles, sizeof *response);

	if (!vertex || !position || !rest || !response)
		return MR_EMEM;
	for (size_t i = 0; i < w->nv; i++) {
		uint32_t v = order[i];
		place[v] = set[v] ? (uint32_t)nv : MR_NONE;
		if (!set[v])
			continue;
		vertex[nv] = v;
		position[nv] = (d4){ w->position[v].x, w->position[v].y, w->position[v].z, 0 };
		rest[nv] = w->rest[v];
		for (size_t h = 0; h < w->handles; h++) {
			const double *r = w->response + 4 * (w->handles * v + h);
			response[w->nv * h + nv] = (v4){ (float)r[0], (float)r[1], (float)r[2], (float)r[3] };
		}
		nv++;
	}
	b->vertex = vertex;
	b->vertices = nv;
	b->position = position;
	b->response = response;
	b->stride = w->nv;
	b->base = (mr_mesh){ "base", rest, NULL, nv, 0 };
	return MR_OK;
}

/* The faces between them, by their first vertex. */
static mr_status
take_faces(body *b, const whole *w, const uint32_t *place)
{
	mr_tri *t = MR_NEW(&b->ctx, w->nf, mr_tri);
	uint32_t *least = MR_NEW(&b->ctx, w->nf, uint32_t), *order;

	if (!t || !least)
		return MR_EMEM;
	for (size_t f = 0; f < w->nf; f++) {
		const uint32_t *v = w->triangles[f].v;
		uint32_t a = place[v[0]], c = place[v[1]], d = place[v[2]], low = a < c ? a : c;
		bool there = a != MR_NONE && c != MR_NONE && d != MR_NONE;
		least[f] = there ? low < d ? low : d : (uint32_t)b->base.nv;
		b->base.nf += there;
	}
	MR_TRY(order_by(&b->ctx, least, w->nf, b->base.nv + 1, &order));
	for (size_t f = 0; f < b->base.nf; f++) {
		const uint32_t *v = w->triangles[order[f]].v;
		t[f] = (mr_tri){ { place[v[0]], place[v[1]], place[v[2]] } };
	}
	b->base.t = t;
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
	uint32_t *order = MR_NEW(&b->ctx, w->nv, uint32_t), *rank = MR_NEW(&b->ctx, w->nv, uint32_t);
	uint32_t *place = MR_NEW(&b->ctx, w->nv, uint32_t);
	bool *set = MR_NEW(&b->ctx, w->nv, bool);
	mr_v3 *normal = MR_NEW(&b->ctx, w->nv, mr_v3);

	if (!order || !rank || !place || !set || !normal)
		return MR_EMEM;
	MR_TRY(mr_zorder(&b->ctx, w->rest, w->nv, MR_ZORDER_CELLS, order));
	for (uint32_t i = 0; i < w->nv; i++)
		rank[order[i]] = i;
	MR_TRY(choose(b, w, rank, w->nv * k / parts, w->nv * (k + 1) / parts, set));
	MR_TRY(take_vertices(b, w, order, set, place));
	MR_TRY(take_faces(b, w, place));
	MR_TRY(mr_vertex_normals(&b->ctx, &b->base, NULL, normal));
	MR_TRY(mr_turning_begin(&b->ctx, &b->base, normal, &b->turning));
	MR_TRY(take_rows(b, w, normal, place));
	b->places = MR_NEW(&b->ctx, b->base.nv, d4);
	b->out = mr_alloc(&b->ctx, b->rows, sizeof *b->out);
	b->base_out = mr_alloc(&b->ctx, b->base.nv, sizeof *b->base_out);
	return b->places && b->out && b->base_out ? MR_OK : MR_EMEM;
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

/* The map about the origin that does what another does about `origin`. */
static mr_affine
about(const mr_affine *map, mr_v3 origin)
{
	mr_v3 moved = mr_sub(mr_apply(map, origin), origin);
	mr_affine a = *map;

	a.m[3] = moved.x, a.m[7] = moved.y, a.m[11] = moved.z;
	return a;
}

/* As mr_pose_by_response does, handle by handle: those that do not move cost nothing. */
static void
respond(body *b, const mr_affine *map)
{
	const d4 *from = b->position;

	for (size_t h = 0; h < b->handles; h++) {
		const mr_affine a = about(&map[h], b->origin);
		const double *m = a.m;
		const d4 x = { m[0] - 1, m[4], m[8], 0 }, y = { m[1], m[5] - 1, m[9], 0 };
		const d4 z = { m[2], m[6], m[10] - 1, 0 }, one = { m[3], m[7], m[11], 0 };
		if (mr_is_identity(&map[h]))
			continue;
		for (size_t v = 0; v < b->base.nv; v++) {
			const d4 w = __builtin_convertvector(b->response[b->stride * h + v], d4);
			b->places[v] = from[v] + x * w[0] + y * w[1] + z * w[2] + one * w[3];
		}
		from = b->places;
	}
	if (from == b->position)
		memcpy(b->places, from, b->base.nv * sizeof *from);
}

/* Places of n vertices by their response to maps about `origin`, a map for each handle; map: changed. */
MR_EXPORT(pose_by_response)
bool
pose_by_response(const mr_v3 *p, size_t n, const double *response, size_t handles, const mr_v3 *origin,
    mr_affine *map, mr_v3 *out)
{
	mr_ctx ctx;
	mr_status status;

	for (size_t h = 0; h < handles; h++)
		map[h] = about(&map[h], *origin);
	mr_ctx_init(&ctx, 1);
	status = mr_pose_by_response(&ctx, p, n, response, handles, map, out);
	mr_ctx_free(&ctx);
	return status == MR_OK;
}

static void
put_base(body *b)
{
	for (size_t v = 0; v < b->base.nv; v++)
		for (int k = 0; k < 3; k++)
			b->base_out[v][k] = (float)b->places[v][k];
}

/* b + h n.  Where the normals of its corners cancel there is no height that mr-encode calls sound. */
static void
put_row(const body *b, const stand *s, float out[3])
{
	const uint32_t *c = s->corner;
	const v4 *n = b->turning.turned;
	const v4 m = s->weight[0] * n[c[0]] + s->weight[1] * n[c[1]] + s->weight[2] * n[c[2]], m2 = m * m;
	const float size = m2[0] + m2[1] + m2[2];
	const d4 p = s->weight[0] * b->places[c[0]] + s->weight[1] * b->places[c[1]] +
	             s->weight[2] * b->places[c[2]];
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
void
body_pose(body *b, const mr_affine *map)
{
	respond(b, map);
	put_base(b);
	mr_turning_find(&b->turning, b->places);
	for (size_t i = 0; i < b->rows; i++)
		put_row(b, &b->stand[i], b->out[i]);
	for (size_t i = 0; i < b->offsets; i++)
		add_offset(b, &b->apart[i]);
}
