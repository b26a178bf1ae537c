/* The repairs of mr-import, in an order in which each needs the last. */
#include "tool/tool.h"

#include "base/text.h"
#include "mesh/mend.h"
#include "space/outward.h"
#include "space/stitch.h"

/* The repairs of a model, in words, and their total count. */
typedef struct deeds {
	mr_text words;
	size_t count;
} deeds;

/* Appends "12 faces turned"; nothing for none. */
static void
add_deed(deeds *d, size_t count, const char *what)
{
	if (count)
		mr_text_add(&d->words, "%s%zu %s", d->count ? ", " : "", count, what);
	d->count += count;
}

/* Finds the parts that are inside out, and turns them where that is asked for. */
static mr_status
turn_outward(mr_ctx *ctx, mr_frame *f, const char *layer, bool turn, size_t *parts)
{
	bool *turned;
	mr_mesh m;

	MR_TRY(mr_layer_mesh_of_any_size(ctx, f, layer, &m));
	turned = MR_NEW(ctx, m.nf, bool);
	mr_inside_out(ctx, &m, turned, parts);
	return *parts && turn ? mr_layer_turn(ctx, f, layer, turned) : MR_OK;
}

mr_status
mr_layer_mend(mr_ctx *ctx, mr_frame *f, const char *layer, const mr_import_opts *o, double unit)
{
	deeds done = { .words.ctx = ctx };
	mr_repair_report r = { 0 };
	size_t joined = 0, stitched = 0, inward = 0;
	double eps = fmax(o->weld, 0) * unit;
	const bool *may = NULL;
	bool faces = mr_layer_has(f, layer, "triangles");
	mr_frame before;
	mr_mesh m;

	if (o->welds && o->weld < 0 && faces) {
		MR_TRY(mr_layer_mesh_of_any_size(ctx, f, layer, &m));
		MR_TRY(mr_weld_distance(ctx, &m, &eps, &may));
	}
	if (o->welds)
		MR_TRY(mr_layer_weld(ctx, f, layer, eps, may, &joined));
	if (o->repair && faces) {
		mr_frame_copy(ctx, f, &before);
		MR_TRY(mr_layer_repair(ctx, f, layer, &r));
		if (r.open)
			MR_TRY(mr_layer_stitch(ctx, &before, layer, &stitched));
		if (stitched) {
			*f = before;
			MR_TRY(mr_layer_repair(ctx, f, layer, &r));
		}
	}
	add_deed(&done, joined,
	    eps > 0 && may ? mr_format(ctx, "vertices joined within %.3g", eps) : "vertices joined");
	add_deed(&done, stitched, "vertices stitched into edges");
	add_deed(&done, r.degenerate, "degenerate faces");
	add_deed(&done, r.duplicate, "duplicate faces");
	add_deed(&done, r.isolated, "isolated vertices");
	add_deed(&done, r.split_edges, "edges split");
	add_deed(&done, r.split_vertices, "vertices split");
	add_deed(&done, r.flipped, "faces turned");
	add_deed(&done, r.cut_edges, "edges cut");
	if (faces && (o->outward || r.inward))
		MR_TRY(turn_outward(ctx, f, layer, o->outward, &inward));
	add_deed(&done, o->outward ? inward : 0, "parts turned outward");
	inward = o->outward ? 0 : inward;
	if (done.count || r.open || inward)
		mr_found(ctx, &(mr_finding){ .kind = MR_REPAIRED,
				  .what = done.count ? done.words.s : "nothing",
				  .count = done.count,
				  .value = (double)inward,
				  .limit = (double)r.open });
	return MR_OK;
}
