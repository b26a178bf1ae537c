/* Heights and colours as integers of the fields, and back. */
#include "compact/packed.h"

enum { HEIGHT_MOST = 1 << 27 };
/* The finest step of a colour's fields, as a power of two of 255: an eye sees lightness best. */
static const unsigned color_step[MR_PACKED_FIELDS - 1] = { 2, 3, 3, 2 };

mr_status
mr_packed_put_heights(mr_ctx *ctx, mr_packed *p, const double *height)
{
	size_t nv = p->level[p->n].nv;
	int32_t *x = p->field[0].x = MR_NEW(ctx, nv, int32_t);

	for (size_t v = 0; v < nv; v++) {
		double h = rint(ldexp(height[v], (int)p->n - p->unit));
		if (!(fabs(h) <= HEIGHT_MOST))
			return mr_fail(
			    ctx, MR_ERANGE, "a height of %g is too large for that error", height[v]);
		x[v] = (int32_t)h;
	}
	return MR_OK;
}

void
mr_packed_heights(const mr_packed *p, size_t level, double *height)
{
	for (size_t v = 0; v < p->level[level].nv; v++)
		height[v] = ldexp(p->field[0].x[v], p->unit - (int)p->n);
}

void
mr_packed_put_colors(mr_ctx *ctx, mr_packed *p, const uint8_t (*color)[4])
{
	size_t nv = p->level[p->n].nv;

	for (size_t i = 1; i < p->fields; i++)
		p->field[i].x = MR_NEW(ctx, nv, int32_t);
	for (size_t v = 0; v < nv; v++) {
		const uint8_t *c = color[v];
		int32_t from[] = { (c[0] + 2 * c[1] + c[2]) / 4, c[0] - c[2], c[1] - (c[0] + c[2]) / 2,
			c[3] };
		for (size_t i = 1; i < p->fields; i++)
			p->field[i].x[v] = from[i - 1] * (1 << p->n) / (1 << color_step[i - 1]);
	}
}

/* The value of a colour's field, of 255; a damaged file may have more. */
static int32_t
color_at(const mr_packed *p, size_t field, size_t v)
{
	double x = ldexp(p->field[field].x[v], (int)color_step[field - 1] - (int)p->n);

	return (int32_t)lrint(fmin(fmax(x, -1024), 1024));
}

static uint8_t
byte_of(int32_t x)
{
	return (uint8_t)(x < 0 ? 0 : x > 255 ? 255 : x);
}

void
mr_packed_colors(const mr_packed *p, size_t level, uint8_t (*color)[4])
{
	for (size_t v = 0; v < p->level[level].nv; v++) {
		int32_t light = color_at(p, 1, v), orange = color_at(p, 2, v), green = color_at(p, 3, v);
		int32_t rest = light - green / 2; /* the mean of red and blue */
		color[v][0] = byte_of(rest + orange / 2);
		color[v][1] = byte_of(rest + green);
		color[v][2] = byte_of(rest - orange / 2);
		color[v][3] = p->fields > 4 ? byte_of(color_at(p, 4, v)) : 255;
	}
}

const uint32_t *
mr_packed_origin(mr_ctx *ctx, const mr_loop *from, const mr_loop *to, size_t n, const mr_control_order *order)
{
	uint32_t *origin = MR_NEW(ctx, to->nv, uint32_t);
	size_t parts = (size_t)1 << 2 * n;

	memcpy(origin, order->vertex, order->m.nv * sizeof *origin);
	for (size_t f = 0; f < to->nf; f++) {
		uint32_t half = order->half[3 * (f / parts)], turn = half % 3, old = half / 3;
		for (size_t shift = 2 * n; shift > 0; shift -= 2) {
			uint32_t part = (uint32_t)(f >> (shift - 2) & 3);
			old = 4 * old + (part == 3 ? 3 : (part + turn) % 3);
		}
		for (uint32_t i = 0; i < 3; i++)
			origin[to->t[f].v[i]] = from->t[old].v[(i + turn) % 3];
	}
	return origin;
}
