/* mr-remesh: a base, or a mesh, to an isotropic base; its places on the mesh are composed. */
#include "remesh/remesh.h"

#include "base/options.h"
#include "space/carry.h"

static mr_status
check_options(mr_ctx *ctx, const mr_remesh_opts *o)
{
	MR_TRY(mr_check_number(ctx, "length", o->length, 0, 1e300));
	MR_TRY(mr_check_number(ctx, "ratio", o->ratio, 1e-6, 1e6));
	MR_TRY(mr_check_number(ctx, "gravity", o->gravity, 0, 4));
	MR_TRY(mr_check_number(ctx, "feature", o->feature, 0, 180));
	return mr_check_number(ctx, "adaptive", o->adaptive, 0, 1e300);
}

/* Carries the columns of m to its successor. */
static mr_status
carry(mr_ctx *ctx, mr_frame *f, const mr_mesh *m, const mr_mesh *out, const mr_places *over,
    const mr_kept *kept, mr_carried **carried, size_t *n)
{
	uint8_t *seam = MR_NEW(ctx, 3 * out->nf, uint8_t);

	for (size_t h = 0; h < 3 * out->nf; h++)
		seam[h] = kept->along && kept->along[h] != MR_NONE;
	return mr_carry_columns(
	    ctx, f, &(mr_successor){ m, out, kept->seam, seam, NULL, kept->along, *over }, carried, n);
}

static mr_status
remesh(mr_ctx *ctx, mr_frame *f, const mr_remesh_opts *o, mr_remesh_result *r)
{
	static const char *const reads[] = { "base", "mesh", NULL };
	mr_places over, map;
	const char *layer;
	mr_kept kept = { 0 };
	mr_carried *carried;
	mr_mesh m, out;
	size_t n = 0;
	bool mapped, carries;

	MR_TRY(check_options(ctx, o));
	MR_TRY(mr_layer_choose_warned(ctx, f, o->layer, reads, &layer));
	MR_TRY(mr_layer_mesh(ctx, f, layer, &m));
	if (!strcmp(layer, "mesh"))
		MR_TRY(mr_layer_join_seams(ctx, f, &m));
	carries = mr_layer_carries(f, layer);
	if (carries)
		MR_TRY(mr_layer_seams(ctx, f, &m, &kept.seam));
	MR_TRY(mr_remesh(ctx, &m, o, &kept, &out, &over, r));
	if (carries)
		MR_TRY(carry(ctx, f, &m, &out, &over, &kept, &carried, &n));
	MR_TRY(mr_source_map_follow(ctx, f, &m, &over, out.nv, &map, &mapped));
	MR_TRY(mr_layer_put_mesh(ctx, f, "base", &out));
	if (n > 0)
		MR_TRY(mr_carried_put(ctx, f, "base", carried, n));
	return mapped ? mr_source_map_put(ctx, f, &map, out.nv) : MR_OK;
}

mr_status
mr_remesh_frame(mr_ctx *ctx, mr_frame *f, const mr_remesh_opts *opts, mr_remesh_result *result)
{
	static const mr_remesh_opts defaults = MR_REMESH_DEFAULTS;
	mr_remesh_result r;

	MR_ON_COPY(ctx, f, done, result, r, remesh(ctx, &done, opts ? opts : &defaults, &r));
}
