/* Columns that were there and are not any more. */
#include "judge/judge.h"

/* What a file gave to a surface, by convention or not, or a user selected there. */
static bool
is_given(const mr_column *c)
{
	const mr_column_info *info = mr_column_of(c->layer, c->name);

	if (!*c->layer || c->shape.element == '-' || !strcmp(c->name, "polygon"))
		return false;
	return !info || info->kind == MR_MEAN || info->kind == MR_LABEL || !strcmp(c->name, "region");
}

/* mesh and base have one selection; texture coordinates of vertices that become one are those of corners;
 * colors may have gone into a picture. */
static bool
is_there(const mr_frame *before, const mr_frame *f, const mr_column *c)
{
	if (mr_layer_has(f, c->layer, c->name))
		return true;
	if (!strcmp(c->name, "color"))
		return mr_layer_has(f, c->layer, "mtllib") && !mr_layer_has(before, c->layer, "mtllib");
	if (!strcmp(c->name, "texcoord"))
		return mr_layer_has(f, c->layer, "corner_texcoord");
	return !strcmp(c->name, "region") &&
	       (mr_layer_has(f, "base", "region") || mr_layer_has(f, "mesh", "region"));
}

static void
report_stale(mr_ctx *ctx, const char *layer, const char *what)
{
	mr_found(ctx, &(mr_finding){ .kind = MR_STALE, .layer = layer, .what = what });
}

mr_status
mr_judge_losses(mr_ctx *ctx, mr_frame *before, mr_frame *after)
{
	bool standing;

	MR_ENTER(ctx);
	for (size_t i = 0; after->key && i < before->count; i++) {
		const mr_column *c = &before->columns[i];
		if (is_given(c) && mr_frame_has_layer(after, c->layer) && !is_there(before, after, c))
			mr_found(ctx,
			    &(mr_finding){ .kind = MR_LOST, .layer = c->layer, .what = c->name, .count = 1 });
	}
	if (!after->key)
		return MR_OK;
	MR_TRY(mr_layer_has_standing_detail(ctx, before, &standing));
	if (standing && mr_frame_has_layer(after, "mesh") && !mr_layer_has(after, "mesh", "detail_height"))
		report_stale(ctx, "mesh", "its detail over base");
	if (mr_layer_has(before, "displacement", "height") && mr_frame_has_layer(after, "control") &&
	    !mr_layer_has(after, "displacement", "height"))
		report_stale(ctx, "control", "its displacement");
	return MR_OK;
}
