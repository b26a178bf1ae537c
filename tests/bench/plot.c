/*
 * plot -- series of points over two logarithmic axes; usage: plot OUT.png TITLE X-AXIS Y-AXIS <POINTS
 * A line of standard input is NAME X Y; the points of a name are joined in the order of the lines.
 */
#include "render/canvas.h"
#include "formats/image.h"

#include <math.h>

enum { WIDTH = 940, HEIGHT = 560, LEFT = 80, RIGHT = 220, TOP = 50, BOTTOM = 60, SERIES = 12, POINTS = 1000 };

typedef struct point {
	int series;
	double x, y; /* decimal logarithms */
} point;

typedef struct plot {
	char name[SERIES][32];
	int names;
	point p[POINTS];
	int n;
	double low[2], high[2]; /* whole decades, x and y */
	mr_image image;
} plot;

static const mr_rgb ink = { 40, 40, 40 }, rule = { 225, 225, 225 };

static int
series_of(plot *q, const char *name)
{
	int i = 0;

	while (i < q->names && strcmp(q->name[i], name))
		i++;
	if (i == q->names && i < SERIES)
		snprintf(q->name[q->names++], sizeof q->name[0], "%s", name);
	return i;
}

static void
read_points(plot *q)
{
	char name[32];
	double x, y;

	while (q->n < POINTS && scanf("%31s %lf %lf", name, &x, &y) == 3) {
		int series = series_of(q, name);
		if (series < SERIES && x > 0 && y > 0)
			q->p[q->n++] = (point){ series, log10(x), log10(y) };
	}
}

static void
find_decades(plot *q)
{
	for (int axis = 0; axis < 2; axis++) {
		q->low[axis] = INFINITY;
		q->high[axis] = -INFINITY;
	}
	for (int i = 0; i < q->n; i++)
		for (int axis = 0; axis < 2; axis++) {
			double v = axis ? q->p[i].y : q->p[i].x;
			q->low[axis] = fmin(q->low[axis], floor(v));
			q->high[axis] = fmax(q->high[axis], floor(v) + 1);
		}
}

static double
place(const plot *q, int axis, double v)
{
	double share = (v - q->low[axis]) / (q->high[axis] - q->low[axis]);

	return axis ? HEIGHT - BOTTOM - share * (HEIGHT - TOP - BOTTOM)
	            : LEFT + share * (WIDTH - LEFT - RIGHT);
}

static void
draw_line(plot *q, double x0, double y0, double x1, double y1, double size, mr_rgb color)
{
	double steps = ceil(2 * fmax(fabs(x1 - x0), fabs(y1 - y0))) + 1;

	for (double s = 0; s <= steps; s++)
		mr_image_fill(&q->image, x0 + (x1 - x0) * s / steps - size / 2,
		    y0 + (y1 - y0) * s / steps - size / 2, size, size, color);
}

static void
draw_decades(plot *q)
{
	char label[32];

	for (int axis = 0; axis < 2; axis++)
		for (double v = q->low[axis]; v <= q->high[axis]; v++) {
			double at = place(q, axis, v);
			if (axis)
				draw_line(q, LEFT, at, WIDTH - RIGHT, at, 1, rule);
			else
				draw_line(q, at, TOP, at, HEIGHT - BOTTOM, 1, rule);
			snprintf(label, sizeof label, "%g", pow(10, v));
			if (axis)
				mr_image_text(
				    &q->image, LEFT - 8 - 9 * (double)strlen(label), at - 5, 1.5, ink, label);
			else
				mr_image_text(&q->image, at - 4.5 * (double)strlen(label),
				    HEIGHT - BOTTOM + 10, 1.5, ink, label);
		}
}

static void
draw_series(plot *q)
{
	for (int i = 0; i < q->n; i++) {
		double x = place(q, 0, q->p[i].x), y = place(q, 1, q->p[i].y);
		mr_rgb color = mr_color_kind((uint32_t)q->p[i].series);
		for (int k = i + 1; k < q->n; k++)
			if (q->p[k].series == q->p[i].series) {
				draw_line(q, x, y, place(q, 0, q->p[k].x), place(q, 1, q->p[k].y), 2, color);
				break;
			}
		mr_image_fill(&q->image, x - 4, y - 4, 8, 8, color);
	}
	for (int s = 0; s < q->names; s++) {
		mr_image_fill(
		    &q->image, WIDTH - RIGHT + 15, TOP + 22 * s, 10, 10, mr_color_kind((uint32_t)s));
		mr_image_text(&q->image, WIDTH - RIGHT + 32, TOP + 22 * s, 1.5, ink, q->name[s]);
	}
}

int
main(int argc, char **argv)
{
	static const mr_rgb white = { 255, 255, 255 };
	static plot q;
	mr_ctx ctx;

	if (argc != 5)
		return 2;
	mr_ctx_init(&ctx, 1);
	read_points(&q);
	if (q.n == 0 || mr_image_new(&ctx, WIDTH, HEIGHT, white, &q.image) < 0)
		return 1;
	find_decades(&q);
	draw_decades(&q);
	draw_series(&q);
	mr_image_text(&q.image, LEFT, 15, 2, ink, argv[2]);
	mr_image_text(&q.image, LEFT, HEIGHT - 22, 1.5, ink, argv[3]);
	mr_image_text(&q.image, 8, TOP - 18, 1.5, ink, argv[4]);
	if (mr_png_write(&ctx, argv[1], &q.image) < 0) {
		fprintf(stderr, "plot: %s\n", ctx.error);
		return 1;
	}
	mr_ctx_free(&ctx);
	return 0;
}
