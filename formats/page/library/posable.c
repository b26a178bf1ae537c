/* The layers that handles pose in the page: a base by its response to them, and over it the mesh by its
 * detail, as of mr-decode.  A stream has all that, or the page makes it for painted handles: a base, where
 * there is none, by mr-smooth, the response by mr-solve --basis, the detail by mr-encode. */
#include "edit/deform.h"
#include "edit/detail.h"
#include "edit/handles.h"
#include "edit/smooth.h"
#include "formats/page/library/export.h"
#include "space/bvh.h"

/* The arrays of the page, which frees them after its surface; those that are not there NULL, and how many
 * there are.  Without a response that and the detail are made of the mesh and its regions. */
typedef struct parts {
	const mr_v3 *position, *rest; /* nv: of the base; where it was encoded, if elsewhere */
	const mr_tri *triangles;
	const double *response;
	const mr_v3 *origin;  /* of the maps that it responds to */
	const uint32_t *face; /* n: of the detail */
	const double (*bary)[2];
	const double *height;
	const mr_v3 *offset;
	const mr_v3 *mesh; /* n */
	const mr_tri *mesh_triangles;
	const uint32_t *region;
	uint32_t nv, nf, n, mesh_nf, handles;
} parts;

typedef struct posable {
	/* For the page to read: places, as they were posed last */
	mr_v3 *base_p, *mesh_p;
	uint32_t nv, n, handles;
	mr_ctx ctx;
	mr_mesh base;
	mr_v3 origin;
	mr_detail detail;
	const double *response;
} posable;

/* The third barycentric coordinate is what the two leave of 1. */
static mr_v3 *
whole_bary(mr_ctx *ctx, const double (*bary)[2], size_t n)
{
	mr_v3 *b = MR_NEW(ctx, n, mr_v3);

	for (size_t i = 0; i < n; i++)
		b[i] = mr_vec(bary[i][0], bary[i][1], 1 - bary[i][0] - bary[i][1]);
	return b;
}

static void
take(posable *s, const parts *p)
{
	s->handles = p->handles;
	s->response = p->response;
	s->origin = *p->origin;
	s->detail = (mr_detail){ p->n, { p->face, whole_bary(&s->ctx, p->bary, p->n) }, p->height, p->offset,
		p->rest ? p->rest : p->position, NULL };
}

/* The base of mr-smooth, which has the vertices of the mesh. */
static mr_status
smooth_base(posable *s, const mr_mesh *mesh, mr_places *source)
{
	static const mr_smooth_opts opts = MR_SMOOTH_DEFAULTS;
	mr_v3 *p = MR_NEW(&s->ctx, mesh->nv, mr_v3);

	mr_source_map_identity(&s->ctx, mesh, source);
	s->base = *mesh;
	s->base.p = p;
	return mr_smooth(&s->ctx, mesh, &opts, p, NULL);
}

/* The row of the closest corner of the mesh. */
static const uint32_t *
regions_of_base(posable *s, const mr_mesh *mesh, const uint32_t *region)
{
	uint32_t *r = MR_NEW(&s->ctx, s->base.nv, uint32_t);
	mr_bvh *bvh;

	mr_bvh_build(&s->ctx, mesh, &bvh);
	for (size_t v = 0; v < s->base.nv; v++) {
		mr_place at = mr_bvh_closest(bvh, s->base.p[v]).at;
		r[v] = region[mesh->t[at.face].v[mr_largest(at.bary)]];
	}
	return r;
}

static mr_status
make(posable *s, const parts *p)
{
	static const mr_deform_opts opts = MR_DEFORM_DEFAULTS;
	mr_mesh mesh = { "mesh", p->mesh, p->mesh_triangles, p->n, p->mesh_nf };
	const uint32_t *region = p->region;
	mr_places source, *from = NULL;
	double *response;
	mr_deform *d;

	if (p->position)
		region = regions_of_base(s, &mesh, region);
	else
		MR_TRY(smooth_base(s, &mesh, from = &source));
	MR_TRY(mr_encode(&s->ctx, &mesh, &s->base, from, &s->detail, NULL));
	MR_TRY(mr_deform_new(&s->ctx, &s->base, NULL, region, &opts, &d));
	s->handles = (uint32_t)mr_deform_handles(d);
	s->response = response = MR_NEW(&s->ctx, 4 * s->handles * s->base.nv, double);
	return mr_deform_basis(&s->ctx, d, s->base.p, response);
}

MR_EXPORT(posable_free)
void
posable_free(posable *s)
{
	mr_ctx_free(&s->ctx);
	free(s);
}

/* NULL where there is no memory, or a part that nothing holds. */
MR_EXPORT(posable_new)
posable *
posable_new(const parts *p)
{
	posable *s = calloc(1, sizeof *s);
	mr_mesh rest;

	if (!s)
		return NULL;
	mr_ctx_init(&s->ctx, 1);
	s->base = (mr_mesh){ "base", p->position, p->triangles, p->nv, p->nf };
	if (p->response)
		take(s, p);
	else if (make(s, p) != MR_OK) {
		posable_free(s);
		return NULL;
	}
	rest = s->base;
	rest.p = s->detail.rest;
	s->nv = (uint32_t)rest.nv, s->n = (uint32_t)s->detail.n;
	s->detail.prepared = mr_detail_prepare(&s->ctx, &rest);
	s->base_p = MR_NEW(&s->ctx, s->nv, mr_v3);
	s->mesh_p = MR_NEW(&s->ctx, s->n, mr_v3);
	return s;
}

/* By a map for each handle, which are changed. */
MR_EXPORT(posable_pose)
bool
posable_pose(posable *s, mr_affine *map)
{
	mr_mesh base = s->base;

	base.p = s->base_p;
	for (size_t h = 0; h < s->handles; h++) {
		mr_v3 moved = mr_sub(mr_apply(&map[h], s->origin), s->origin);
		map[h].m[3] = moved.x, map[h].m[7] = moved.y, map[h].m[11] = moved.z;
	}
	mr_pose_by_response(&s->ctx, s->base.p, s->nv, s->response, s->handles, map, s->base_p);
	return mr_decode(&s->ctx, &base, &s->detail, 1, s->mesh_p) == MR_OK;
}
