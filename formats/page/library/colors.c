/* The colours of mr-render for the page: red, green and blue, a byte each from the lowest. */
#include "formats/page/library/export.h"
#include "render/colormap.h"

static uint32_t
packed(mr_rgb c)
{
	return (uint32_t)c.r | (uint32_t)c.g << 8 | (uint32_t)c.b << 16;
}

/* The colour of a number between 0 and 1. */
MR_EXPORT(color_number)
uint32_t
color_number(double t, bool diverging)
{
	return packed(diverging ? mr_color_diverging(2 * t - 1) : mr_color_sequential(t));
}

MR_EXPORT(color_kind)
uint32_t
color_kind(uint32_t kind)
{
	return packed(mr_color_kind(kind));
}

MR_EXPORT(color_region)
uint32_t
color_region(uint32_t region)
{
	return packed(mr_color_region(region));
}
