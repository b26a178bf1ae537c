/* Each kind of column has its own way to a finer level. */
#include "subdivide/columns.h"

/* The layer's column on level n. */
typedef mr_status (*refiner)(
    mr_ctx *ctx, const mr_loop *level, size_t n, const void *data, const void **out, size_t *rows);

static mr_status
refine_regions(mr_ctx *ctx, const mr_loop *level, size_t n, const void *data, const void **out, size_t *rows)
{
	uint32_t *region = MR_NEW(ctx, level[n].nv, uint32_t);

	if (!region)
		return MR_EMEM;
	memcpy(region, data, level[0].nv * sizeof *region);
	for (size_t i = 1; i <= n; i++)
		for (size_t k = 0; k < level[i].nv - level[i].coarse_nv; k++) {
			uint32_t h = level[i].edge[k];
			const uint32_t *v = level[i - 1].t[h / 3].v;
			uint32_t a = region[v[h % 3]], b = region[v[(h + 1) % 3]];
			region[level[i].coarse_nv + k] = a < b ? a : b;
		}
	*out = region;
	*rows = level[n].nv;
	return MR_OK;
}

static mr_status
refine_groups(mr_ctx *ctx, const mr_loop *level, size_t n, const void *data, const void **out, size_t *rows)
{
	uint32_t *group = MR_NEW(ctx, level[n].nf, uint32_t);
	const uint32_t *coarse = data;

	if (!group)
		return MR_EMEM;
	for (size_t f = 0; f < level[n].nf; f++)
		group[f] = coarse[f >> 2 * n];
	*out = group;
	*rows = level[n].nf;
	return MR_OK;
}

static mr_status
refine_texcoords(
    mr_ctx *ctx, const mr_loop *level, size_t n, const void *data, const void **out, size_t *rows)
{
	double *uv = MR_NEW(ctx, 2 * level[n].nv, double);

	if (!uv)
		return MR_EMEM;
	*out = uv;
	*rows = level[n].nv;
	return mr_loop_values(ctx, level, n, 2, data, uv);
}

static mr_status
refine_colors(mr_ctx *ctx, const mr_loop *level, size_t n, const void *data, const void **out, size_t *rows)
{
	size_t count = 4 * level[n].nv;
	unsigned char *color = MR_NEW(ctx, count, unsigned char);
	mr_mark mark = mr_mark_take(ctx);
	double *coarse = MR_NEW(ctx, 4 * level[0].nv, double), *fine = MR_NEW(ctx, count, double);
	const unsigned char *bytes = data;

	if (!color || !coarse || !fine)
		return MR_EMEM;
	for (size_t i = 0; i < 4 * level[0].nv; i++)
		coarse[i] = bytes[i];
	MR_TRY(mr_loop_values(ctx, level, n, 4, coarse, fine));
	for (size_t i = 0; i < count; i++) /* averages, so from 0 to 255 */
		color[i] = (unsigned char)(fine[i] + 0.5);
	mr_mark_release(ctx, mark);
	*out = color;
	*rows = level[n].nv;
	return MR_OK;
}

mr_status
mr_subdivide_columns(
    mr_ctx *ctx, mr_frame *f, const char *layer, const mr_loop *level, size_t n, mr_carried out[MR_CARRIED])
{
	static const struct {
		const char *name;
		bool of_faces;
		refiner refine;
	} columns[MR_CARRIED] = {
		{ "region", false, refine_regions },
		{ "group", true, refine_groups },
		{ "texcoord", false, refine_texcoords },
		{ "color", false, refine_colors },
	};

	for (size_t i = 0; i < MR_CARRIED; i++) {
		size_t rows = columns[i].of_faces ? level[0].nf : level[0].nv;
		const void *data;
		out[i] = (mr_carried){ .name = columns[i].name };
		if (!mr_layer_has(f, layer, columns[i].name))
			continue;
		MR_TRY(mr_layer_get_rows(ctx, f, layer, columns[i].name, rows, &data));
		MR_TRY(columns[i].refine(ctx, level, n, data, &out[i].data, &out[i].rows));
	}
	return MR_OK;
}
