/* A base with its detail that handles pose, for the page: as mr-decode poses them by the response. */
#include "edit/detail.h"
#include "edit/pose_basis.h"
#include "formats/page/library/export.h"

/* What the page has of it, malloc's: from then on the body's. */
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

typedef struct body {
	float (*base_out)[3], (*out)[3]; /* for the page to read: places of the base and of the mesh */
	mr_ctx ctx;
	whole w;
	mr_incidence inc;
	mr_detail detail;
	mr_v3 *base, *mesh; /* as posed */
} body;

/* The third barycentric coordinate is what the two leave of 1. */
static mr_v3 *
whole_bary(mr_ctx *ctx, const double (*bary)[2], size_t n)
{
	mr_v3 *b = MR_NEW(ctx, n, mr_v3);

	for (size_t i = 0; i < n; i++)
		b[i] = mr_vec(bary[i][0], bary[i][1], 1 - bary[i][0] - bary[i][1]);
	return b;
}

static mr_status
begin(body *b)
{
	const whole *w = &b->w;
	mr_mesh rest = { "base", w->rest, w->triangles, w->nv, w->nf };
	mr_v3 *normal = MR_NEW(&b->ctx, w->nv, mr_v3), *bary = whole_bary(&b->ctx, w->bary, w->n);

	b->base = MR_NEW(&b->ctx, w->nv, mr_v3);
	b->mesh = MR_NEW(&b->ctx, w->n, mr_v3);
	b->base_out = mr_alloc(&b->ctx, w->nv, sizeof *b->base_out);
	b->out = mr_alloc(&b->ctx, w->n, sizeof *b->out);
	MR_TRY(mr_incidence_build(&b->ctx, &rest, &b->inc));
	MR_TRY(mr_vertex_normals(&b->ctx, &rest, &b->inc, normal));
	b->detail = (mr_detail){ w->n, { w->face, bary }, w->height, w->offset, w->rest, normal };
	return MR_OK;
}

/* NULL where there is no memory. */
MR_EXPORT(body_new)
body *
body_new(const whole *w)
{
	body *b = calloc(1, sizeof *b);

	if (!b)
		return NULL;
	mr_ctx_init(&b->ctx, 1);
	b->w = *w;
	return begin(b) == MR_OK ? b : NULL;
}

/* Places of n vertices by their response to maps about `origin`, a map for each handle; map: changed. */
MR_EXPORT(pose_by_response)
void
pose_by_response(const mr_v3 *p, size_t n, const double *response, size_t handles, const mr_v3 *origin,
    mr_affine *map, mr_v3 *out)
{
	mr_ctx ctx;

	for (size_t h = 0; h < handles; h++) {
		mr_v3 moved = mr_sub(mr_apply(&map[h], *origin), *origin);
		map[h].m[3] = moved.x, map[h].m[7] = moved.y, map[h].m[11] = moved.z;
	}
	mr_ctx_init(&ctx, 1);
	mr_pose_by_response(&ctx, p, n, response, handles, map, out);
	mr_ctx_free(&ctx);
}

static void
to_floats(const mr_v3 *p, size_t n, float (*out)[3])
{
	for (size_t i = 0; i < n; i++) {
		out[i][0] = (float)p[i].x;
		out[i][1] = (float)p[i].y;
		out[i][2] = (float)p[i].z;
	}
}

/* Poses it by a map for each handle. */
MR_EXPORT(body_pose)
bool
body_pose(body *b, mr_affine *map)
{
	const whole *w = &b->w;
	mr_mesh base = { "base", b->base, w->triangles, w->nv, w->nf };

	pose_by_response(w->position, w->nv, w->response, w->handles, &w->origin, map, b->base);
	if (mr_decode(&b->ctx, &base, &b->inc, &b->detail, 1, b->mesh) != MR_OK)
		return false;
	to_floats(b->base, w->nv, b->base_out);
	to_floats(b->mesh, w->n, b->out);
	return true;
}
