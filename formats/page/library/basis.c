/* A basis of handles that were painted in the page: its base, where there is none, by mr-smooth, the
 * responses by mr-solve --basis, the detail by mr-encode. */
#include "edit/deform.h"
#include "edit/detail.h"
#include "edit/smooth.h"
#include "formats/page/library/export.h"
#include "space/bvh.h"

/* What the page has, and frees: a mesh with its regions, and a base or none. */
typedef struct model {
	const mr_v3 *p, *base_p; /* base_p: or NULL */
	const mr_tri *t, *base_t;
	const uint32_t *region;
	uint32_t nv, nf, base_nv, base_nf;
} model;

/* A base, its response, and the detail over it: for the page to read. */
typedef struct basis {
	const mr_v3 *position;
	const mr_tri *triangles;
	const double *response;
	const uint32_t *face;
	const mr_v3 *bary;
	const double *height;
	const mr_v3 *offset; /* or NULL */
	uint32_t nv, nf, handles;
	mr_ctx ctx;
} basis;

/* The base of mr-smooth, which has the vertices of the mesh. */
static mr_status
smooth_base(basis *b, const mr_mesh *mesh, mr_mesh *base, mr_places *source)
{
	static const mr_smooth_opts opts = MR_SMOOTH_DEFAULTS;
	mr_v3 *p = MR_NEW(&b->ctx, mesh->nv, mr_v3);

	mr_source_map_identity(&b->ctx, mesh, source);
	*base = *mesh;
	base->p = p;
	return mr_smooth(&b->ctx, mesh, &opts, p, NULL);
}

/* Of the closest corner of the mesh. */
static const uint32_t *
regions_of_base(basis *b, const mr_mesh *mesh, const mr_mesh *base, const uint32_t *region)
{
	uint32_t *r = MR_NEW(&b->ctx, base->nv, uint32_t);
	mr_bvh *bvh;

	mr_bvh_build(&b->ctx, mesh, &bvh);
	for (size_t v = 0; v < base->nv; v++) {
		mr_place at = mr_bvh_closest(bvh, base->p[v]).at;
		r[v] = region[mesh->t[at.face].v[mr_largest(at.bary)]];
	}
	return r;
}

static mr_status
solve(basis *b, const mr_mesh *base, const uint32_t *region)
{
	static const mr_deform_opts opts = MR_DEFORM_DEFAULTS;
	double *response;
	mr_deform *d;

	MR_TRY(mr_deform_new(&b->ctx, base, NULL, region, &opts, &d));
	b->handles = (uint32_t)mr_deform_handles(d);
	b->response = response = MR_NEW(&b->ctx, 4 * b->handles * base->nv, double);
	return mr_deform_basis(&b->ctx, d, base->p, response);
}

static mr_status
make(basis *b, const model *m)
{
	mr_mesh mesh = { "mesh", m->p, m->t, m->nv, m->nf },
		base = { "base", m->base_p, m->base_t, m->base_nv, m->base_nf };
	const uint32_t *region = m->region;
	mr_places source;
	mr_detail d;

	if (m->base_p)
		region = regions_of_base(b, &mesh, &base, region);
	else
		MR_TRY(smooth_base(b, &mesh, &base, &source));
	MR_TRY(mr_encode(&b->ctx, &mesh, &base, m->base_p ? NULL : &source, &d, NULL));
	b->position = base.p, b->triangles = base.t;
	b->nv = (uint32_t)base.nv, b->nf = (uint32_t)base.nf;
	b->face = d.at.face, b->bary = d.at.bary, b->height = d.height, b->offset = d.offset;
	return solve(b, &base, region);
}

MR_EXPORT(basis_free)
void
basis_free(basis *b)
{
	mr_ctx_free(&b->ctx);
	free(b);
}

/* NULL where there is none: a part that nothing holds, no memory. */
MR_EXPORT(basis_new)
basis *
basis_new(const model *m)
{
	basis *b = calloc(1, sizeof *b);

	if (!b)
		return NULL;
	mr_ctx_init(&b->ctx, 1);
	if (make(b, m) == MR_OK)
		return b;
	basis_free(b);
	return NULL;
}
