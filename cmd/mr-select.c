/* mr-select -- choose which vertices are fixed, free, or in a handle.  See man/mr-select.1. */
#include "base/text_file.h"
#include "edit/select.h"
#include "cmd.h"
#include "mesh/layers.h"

static bool reset;
static mr_selection selection;

static mr_status
add_free(mr_ctx *ctx, const cmd_opt *o, const char *predicate)
{
	(void)o;
	return mr_selection_add(ctx, &selection, MR_REGION_FREE, "--free ", predicate);
}

static mr_status
add_fixed(mr_ctx *ctx, const cmd_opt *o, const char *predicate)
{
	(void)o;
	return mr_selection_add(ctx, &selection, MR_REGION_FIXED, "--fixed ", predicate);
}

static mr_status
add_handle(mr_ctx *ctx, const cmd_opt *o, const char *text)
{
	const char *at = text;
	uint64_t handle;
	char *option;

	(void)o;
	if (!mr_whole(&at, 65535, &handle) || *at++ != '=')
		return mr_fail(
		    ctx, MR_EUSAGE, "'%s' is not a handle from 0 to 65535, = and a predicate", text);
	option = mr_format(ctx, "--handle %u=", (unsigned)handle);
	if (!option)
		return MR_EMEM;
	return mr_selection_add(ctx, &selection, MR_REGION_HANDLE + (uint32_t)handle, option, at);
}

static const cmd_opt table[] = {
	{ 0, "reset", CMD_FLAG, &reset, 0, 0, NULL,
	    "begin with all vertices fixed (default: with the regions there are)", NULL },
	{ 0, "free", CMD_CALL, NULL, 0, 0, "P", "these vertices are free", add_free },
	{ 0, "fixed", CMD_CALL, NULL, 0, 0, "P", "these vertices are fixed", add_fixed },
	{ 0, "handle", CMD_CALL, NULL, 0, 0, "N=P", "these vertices are handle N", add_handle },
	{ 0 },
};

static mr_status
prepare(cmd *c)
{
	if (selection.n || reset)
		return MR_OK;
	return mr_fail(&c->ctx, MR_EUSAGE, "nothing to select: give --free, --fixed, --handle or --reset");
}

static mr_status
read_groups(mr_ctx *ctx, mr_frame *f, const mr_mesh *m, mr_groups *g)
{
	const void *group, *names;

	*g = (mr_groups){ 0 };
	if (!mr_layer_has(f, m->name, "group") || !mr_layer_has(f, m->name, "groups"))
		return MR_OK;
	MR_TRY(mr_layer_get_rows(ctx, f, m->name, "group", m->nf, &group));
	MR_TRY(mr_layer_get(ctx, f, m->name, "groups", &names, &g->length));
	g->group = group;
	g->names = names;
	return MR_OK;
}

/* The regions to begin with, in the arena. */
static mr_status
first_regions(mr_ctx *ctx, mr_frame *f, const mr_mesh *m, uint32_t **region)
{
	const uint32_t *there;

	*region = MR_NEW_ZERO(ctx, m->nv, uint32_t);
	if (!*region)
		return MR_EMEM;
	if (reset || !mr_layer_has(f, m->name, "region"))
		return MR_OK;
	MR_TRY(mr_layer_region(ctx, f, m->name, m->nv, &there));
	memcpy(*region, there, m->nv * sizeof **region);
	return MR_OK;
}

static mr_status
select_frame(cmd *c, mr_frame *f)
{
	const char *layer;
	uint32_t *region;
	mr_groups groups;
	mr_mesh m;

	MR_TRY(
	    mr_layer_choose(&c->ctx, f, c->layer, (const char *const[]){ "mesh", "control", NULL }, &layer));
	MR_TRY(mr_layer_mesh(&c->ctx, f, layer, &m));
	MR_TRY(read_groups(&c->ctx, f, &m, &groups));
	MR_TRY(first_regions(&c->ctx, f, &m, &region));
	MR_TRY(mr_select(&c->ctx, &m, &groups, &selection, region));
	return mr_layer_put_region(&c->ctx, f, layer, region, m.nv);
}

int
main(int argc, char **argv)
{
	return cmd_main(argc, argv,
	    &(cmd_tool){ .summary = "choose which vertices are fixed, free, or in a handle",
		.options = table,
		.prepare = prepare,
		.frame = select_frame });
}
