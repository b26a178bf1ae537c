/* Surfaces that handles pose, for the page: places by a response, and the detail over a base, as of
 * mr-decode. */
#include "edit/detail.h"
#include "edit/handles.h"
#include "formats/page/library/export.h"

/* What the page has of a detail, and frees: the places of these arrays, and how many there are. */
typedef struct parts {
	const mr_v3 *rest; /* nv: where the base was encoded */
	const mr_tri *triangles;
	const uint32_t *face; /* n: of the detail */
	const double (*bary)[2];
	const double *height;
	const mr_v3 *offset; /* or NULL */
	uint32_t nv, nf, n;
} parts;

typedef struct detail {
	mr_ctx ctx;
	mr_mesh base;
	mr_detail of;
} detail;

/* The third barycentric coordinate is what the two leave of 1. */
static mr_v3 *
whole_bary(mr_ctx *ctx, const double (*bary)[2], size_t n)
{
	mr_v3 *b = MR_NEW(ctx, n, mr_v3);

	for (size_t i = 0; i < n; i++)
		b[i] = mr_vec(bary[i][0], bary[i][1], 1 - bary[i][0] - bary[i][1]);
	return b;
}

/* NULL where there is no memory. */
MR_EXPORT(detail_new)
detail *
detail_new(const parts *p)
{
	detail *d = calloc(1, sizeof *d);
	mr_v3 *normal;

	if (!d)
		return NULL;
	mr_ctx_init(&d->ctx, 1);
	normal = MR_NEW(&d->ctx, p->nv, mr_v3);
	d->base = (mr_mesh){ "base", p->rest, p->triangles, p->nv, p->nf };
	mr_vertex_normals(&d->base, normal);
	d->of = (mr_detail){ p->n, { p->face, whole_bary(&d->ctx, p->bary, p->n) }, p->height, p->offset,
		p->rest, normal };
	return d;
}

MR_EXPORT(detail_free)
void
detail_free(detail *d)
{
	mr_ctx_free(&d->ctx);
	free(d);
}

/* The mesh, where the base is at p. */
MR_EXPORT(detail_decode)
bool
detail_decode(detail *d, const mr_v3 *p, mr_v3 *out)
{
	mr_mesh base = d->base;

	base.p = p;
	return mr_decode(&d->ctx, &base, &d->of, 1, out) == MR_OK;
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
