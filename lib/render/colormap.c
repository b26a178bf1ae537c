/* Steps of known maps, blended between. */
#include "render/colormap.h"

#include "mesh/layers.h"

/* Colours at even steps of the map called viridis (van der Walt, Smith 2015). */
static const mr_rgb viridis[] = { { 68, 1, 84 }, { 71, 44, 122 }, { 59, 81, 139 }, { 44, 113, 142 },
	{ 33, 144, 141 }, { 39, 173, 129 }, { 92, 200, 99 }, { 170, 220, 50 }, { 253, 231, 37 } };

/* Colours at even steps of the scheme RdBu (Brewer 2002), blue first. */
static const mr_rgb blue_red[] = { { 33, 102, 172 }, { 67, 147, 195 }, { 146, 197, 222 }, { 209, 229, 240 },
	{ 247, 247, 247 }, { 253, 219, 199 }, { 244, 165, 130 }, { 214, 96, 77 }, { 178, 24, 43 } };

static uint8_t
mix(uint8_t a, uint8_t b, double t)
{
	return (uint8_t)(a + (b - a) * t + 0.5);
}

static mr_rgb
between(const mr_rgb *table, size_t count, double t)
{
	double x = (t > 0 ? t < 1 ? t : 1 : 0) * (double)(count - 1); /* nan: the first */
	size_t i = x < (double)(count - 1) ? (size_t)x : count - 2;
	const mr_rgb *a = table + i, *b = a + 1;

	x -= (double)i;
	return (mr_rgb){ mix(a->r, b->r, x), mix(a->g, b->g, x), mix(a->b, b->b, x) };
}

mr_rgb
mr_color_sequential(double t)
{
	return between(viridis, sizeof viridis / sizeof *viridis, t);
}

mr_rgb
mr_color_diverging(double t)
{
	return between(blue_red, sizeof blue_red / sizeof *blue_red, (t + 1) / 2);
}

mr_rgb
mr_color_kind(uint32_t kind)
{
	static const mr_rgb table[] = { { 82, 168, 96 }, { 238, 146, 58 }, { 150, 112, 190 },
		{ 226, 190, 62 }, { 214, 92, 92 }, { 70, 178, 178 }, { 205, 120, 170 }, { 150, 118, 92 },
		{ 110, 140, 60 }, { 92, 112, 200 } };
	enum { KINDS = sizeof table / sizeof *table };
	mr_rgb c = table[kind % KINDS], grey = { 170, 168, 164 };
	uint32_t round = kind / KINDS % 4; /* further kinds are the same, paler */

	if (kind == MR_NONE)
		return grey;
	return (mr_rgb){ mix(c.r, 235, 0.2 * round), mix(c.g, 235, 0.2 * round), mix(c.b, 235, 0.2 * round) };
}

mr_rgb
mr_color_region(uint32_t region)
{
	if (region == MR_REGION_FIXED)
		return (mr_rgb){ 190, 186, 180 };
	if (region == MR_REGION_FREE)
		return (mr_rgb){ 92, 146, 214 };
	return mr_color_kind(region - MR_REGION_HANDLE);
}
