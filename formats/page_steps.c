/* Whole steps between rows, as numbers that pack well. */
#include "formats/page_steps.h"

#include <math.h>

double
mr_step_of(double extent)
{
	const double tiny = 1e-200;
	int exponent;

	if (!(extent > tiny))
		return 1;
	frexp(extent, &exponent);
	return ldexp(1, exponent - 24);
}

/* 0, -1, 1, -2, ... as 0, 1, 2, 3, ... */
static uint32_t
unsign(uint32_t step)
{
	return step << 1 ^ (step >> 31 ? UINT32_MAX : 0);
}

/* The whole number of a value: modulo 2^32, as its differences are. */
static uint32_t
whole(const mr_column *c, const mr_steps *s, size_t at, size_t component)
{
	const double *x = c->data;
	const uint32_t *u = c->data;
	double origin = c->shape.components <= 3 ? s->origin[component] : 0;

	return s->step > 0 ? (uint32_t)(int32_t)rint((x[at] - origin) / s->step) : u[at];
}

static void
sum_steps(const mr_column *c, const mr_steps *s, uint32_t *sums)
{
	size_t rows = (size_t)c->rows, width = c->shape.components, kept = s->components;

	for (size_t k = 0; k < kept; k++) {
		uint32_t sum = 0, before = 0;
		for (size_t i = 0; i < rows; i++) {
			uint32_t now = whole(c, s, width * i + k, k);
			sums[kept * i + k] = sum += unsign(now - before);
			before = now;
		}
	}
}

mr_status
mr_steps_put(mr_ctx *ctx, mr_frame *to, const mr_column *c, const mr_steps *s, mr_text *notes)
{
	mr_shape shape = { c->shape.element, 'u', s->components };
	uint32_t *sums = MR_NEW(ctx, (size_t)c->rows * s->components, uint32_t);

	sum_steps(c, s, sums);
	mr_text_add(notes, "steps %s %s", c->layer, c->name);
	if (s->step > 0)
		mr_text_add(notes, " %.17g", s->step);
	for (int k = 0; s->step > 0 && k < 3; k++)
		mr_text_add(notes, " %.17g", s->origin[k]);
	mr_text_add(notes, "\n");
	return mr_frame_put(ctx, to, c->layer, c->name, shape, sums, (size_t)c->rows);
}
