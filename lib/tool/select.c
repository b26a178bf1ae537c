/* mr-select and mr-crop: regions by rules, and the part of a layer that they keep. */
#include "tool/tool.h"

#include "base/options.h"
#include "edit/handles.h"
#include "mesh/subset.h"

/* The names of faces: groups, objects and materials. */
static mr_status
read_groups(mr_ctx *ctx, mr_frame *f, const mr_mesh *m, mr_groups g[MR_NAMINGS])
{
	const void *group, *names;

	memset(g, 0, MR_NAMINGS * sizeof *g);
	for (size_t i = 0; i < MR_NAMINGS; i++) {
		mr_naming of = mr_namings[i];
		if (m->nf == 0 || !mr_layer_has(f, m->name, of.column) || !mr_layer_has(f, m->name, of.list))
			continue;
		MR_TRY(mr_layer_get_rows(ctx, f, m->name, of.column, m->nf, &group));
		MR_TRY(mr_layer_get(ctx, f, m->name, of.list, &names, &g[i].length));
		g[i].group = group;
		g[i].names = names;
	}
	return MR_OK;
}

/* The regions to begin with, in the arena. */
static mr_status
first_regions(mr_ctx *ctx, mr_frame *f, const mr_mesh *m, bool reset, uint32_t **region)
{
	const uint32_t *there;

	*region = MR_NEW_ZERO(ctx, m->nv, uint32_t);
	if (reset || !mr_layer_has(f, m->name, "region"))
		return MR_OK;
	MR_TRY(mr_layer_region(ctx, f, m->name, m->nv, &there));
	memcpy(*region, there, m->nv * sizeof **region);
	return MR_OK;
}

/* A handle that free vertices follow and that meets fixed ones too, as a half-selected hand does, tears or
 * folds there: nothing between them can give way. */
static void
look_at_borders(mr_ctx *ctx, const mr_mesh *m, const uint32_t *region)
{
	mr_finding found = { .kind = MR_UNHELD,
		.layer = m->name,
		.what = "a handle meets fixed vertices with nothing free between: free a ring around it, or "
			"select all of the limb" };
	bool *leads = MR_NEW_ZERO(ctx, mr_regions_of(ctx, region, m->nv).n, bool);

	for (uint32_t h = 0; h < 3 * m->nf; h++)
		leads[region[mr_he_from(m, h)]] |= region[mr_he_to(m, h)] == MR_REGION_FREE;
	for (uint32_t h = 0; h < 3 * m->nf; h++) {
		uint32_t a = mr_he_from(m, h);
		if (region[a] < MR_REGION_HANDLE || region[mr_he_to(m, h)] != MR_REGION_FIXED ||
		    !leads[region[a]])
			continue;
		if (found.count++ == 0) {
			found.placed = true;
			found.vertex = a;
			found.at = m->p[a];
		}
	}
	if (found.count)
		mr_found(ctx, &found);
}

static mr_status
select_by(
    mr_ctx *ctx, mr_frame *f, const mr_selection *s, const mr_select_opts *opts, mr_select_result *result)
{
	static const char *const reads[] = { "mesh", "control", "points", NULL };
	const char *layer;
	uint32_t *region;
	mr_groups groups[MR_NAMINGS];
	mr_mesh m;

	MR_TRY(mr_layer_choose(ctx, f, opts->layer, reads, &layer));
	MR_TRY(mr_layer_surface_or_points(ctx, f, layer, &m));
	MR_TRY(read_groups(ctx, f, &m, groups));
	MR_TRY(first_regions(ctx, f, &m, opts->reset, &region));
	MR_TRY(mr_select(ctx, f, &m, groups, s, region, result));
	look_at_borders(ctx, &m, region);
	return mr_layer_put_region(ctx, f, layer, region, m.nv);
}

mr_status
mr_select_by(
    mr_ctx *ctx, mr_frame *f, const mr_selection *s, const mr_select_opts *opts, mr_select_result *result)
{
	mr_select_result r;

	MR_ON_COPY(ctx, f, done, result, r, select_by(ctx, &done, s, opts, &r));
}

static mr_status
crop_by(mr_ctx *ctx, mr_frame *f, const char *layer, const mr_selection *s, mr_crop_result *result)
{
	static const char *const reads[] = { "mesh", "control", "points", NULL };
	mr_groups groups[MR_NAMINGS];
	mr_subset subset;
	uint32_t *region;
	mr_mesh m;
	bool *keep;

	MR_TRY(mr_layer_choose_warned(ctx, f, layer, reads, &layer));
	MR_TRY(mr_layer_surface_or_points(ctx, f, layer, &m));
	MR_TRY(read_groups(ctx, f, &m, groups));
	region = MR_NEW(ctx, m.nv, uint32_t);
	keep = MR_NEW(ctx, m.nv, bool);
	for (size_t v = 0; v < m.nv; v++) /* names the kept part, or the dropped one */
		region[v] = mr_selection_begins(s) == MR_REGION_FREE ? MR_REGION_FIXED : MR_REGION_FREE;
	MR_TRY(mr_select(ctx, f, &m, groups, s, region, NULL));
	for (size_t v = 0; v < m.nv; v++)
		keep[v] = region[v] != MR_REGION_FIXED;
	MR_TRY(mr_subset_find(ctx, f, &m, keep, &subset));
	if (subset.nv == 0 || (m.nf && subset.nf == 0))
		return mr_fail(ctx, MR_EMESH, "nothing would be left of the %zu %s of %s", m.nf ? m.nf : m.nv,
		    m.nf ? "faces" : "points", layer);
	*result = (mr_crop_result){ subset.nv, subset.nf, m.nv - subset.nv, m.nf - subset.nf };
	return mr_layer_keep(ctx, f, layer, &subset);
}

mr_status
mr_crop_by(mr_ctx *ctx, mr_frame *f, const char *layer, const mr_selection *s, mr_crop_result *result)
{
	mr_crop_result r;

	MR_ON_COPY(ctx, f, done, result, r, crop_by(ctx, &done, layer, s, &r));
}

/* The tool's name of a rule for this region. */
static const char *
option_of(mr_ctx *ctx, uint32_t region)
{
	if (region == MR_REGION_FIXED)
		return "--fixed ";
	if (region == MR_REGION_FREE)
		return "--free ";
	return mr_format(ctx, "--handle %u=", (unsigned)(region - MR_REGION_HANDLE));
}

static mr_status
add_rules(mr_ctx *ctx, const mr_rule *rules, size_t n, mr_selection *s)
{
	for (size_t i = 0; i < n; i++) {
		const char *option;
		MR_TRY(mr_check_number(ctx, "region", rules[i].region, 0, MR_REGION_HANDLE + 65535));
		option = option_of(ctx, rules[i].region);
		MR_TRY(mr_selection_add(ctx, s, rules[i].region, option, rules[i].predicate));
	}
	return MR_OK;
}

mr_status
mr_select_frame(mr_ctx *ctx, mr_frame *f, const mr_rule *rules, size_t n, const mr_select_opts *opts,
    mr_select_result *result)
{
	static const mr_select_opts defaults = MR_SELECT_DEFAULTS;
	mr_selection s = { 0 };

	MR_ENTER(ctx);
	MR_TRY(add_rules(ctx, rules, n, &s));
	return mr_select_by(ctx, f, &s, opts ? opts : &defaults, result);
}

mr_status
mr_crop_frame(
    mr_ctx *ctx, mr_frame *f, const char *layer, const mr_rule *rules, size_t n, mr_crop_result *result)
{
	mr_selection s = { .may_miss = true };

	MR_ENTER(ctx);
	if (n == 0)
		return mr_fail(ctx, MR_EUSAGE, "no rule says what is kept or dropped");
	MR_TRY(add_rules(ctx, rules, n, &s));
	return mr_crop_by(ctx, f, layer, &s, result);
}
