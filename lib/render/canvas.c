/* Pixels set one by one, clipped to the image. */
#include "render/canvas.h"

#include "base/vec.h"

mr_status
mr_image_new(mr_ctx *ctx, size_t width, size_t height, mr_rgb color, mr_image *image)
{
	enum { MOST = 32767 };
	mr_rgb *pixel;

	if (width > MOST || height > MOST)
		return mr_fail(ctx, MR_ERANGE, "a picture of %zux%zu pixels is larger than %dx%d", width,
		    height, MOST, MOST);
	pixel = MR_NEW(ctx, width * height, mr_rgb);
	if (!pixel)
		return MR_EMEM;
	for (size_t i = 0; i < width * height; i++)
		pixel[i] = color;
	*image = (mr_image){ pixel, width, height };
	return MR_OK;
}

void
mr_image_copy(mr_image *to, size_t x, size_t y, const mr_image *from)
{
	size_t w = x < to->width ? to->width - x : 0;

	if (w > from->width)
		w = from->width;
	for (size_t j = 0; j < from->height && y + j < to->height && w; j++)
		memcpy(to->pixel + (y + j) * to->width + x, from->pixel + j * from->width,
		    w * sizeof *to->pixel);
}

/* The whole number nearest to x, brought into 0 to most. */
static size_t
clip(double x, size_t most)
{
	return x > 0 ? x < (double)most ? (size_t)(x + 0.5) : most : 0;
}

void
mr_image_fill(mr_image *image, double x, double y, double w, double h, mr_rgb color)
{
	size_t right = clip(x + w, image->width), bottom = clip(y + h, image->height);

	for (size_t j = clip(y, image->height); j < bottom; j++)
		for (size_t i = clip(x, image->width); i < right; i++)
			image->pixel[j * image->width + i] = color;
}

/*
 * Letters are strokes: the lit cells of a 5 by 9 raster, each joined to its lit
 * neighbours, diagonally only where no straight way leads there.
 */
typedef struct stroke {
	double x0, y0, x1, y1;
} stroke;

enum { STROKES = 5 * MR_GLYPH_ROWS * 4 };

static bool
lit(const uint8_t *rows, int x, int y)
{
	return x >= 0 && x < 5 && y >= 0 && y < MR_GLYPH_ROWS && (rows[y] >> (4 - x) & 1);
}

static size_t
strokes_of(const uint8_t *rows, stroke *s)
{
	static const int dx[] = { 1, 0, 1, -1 }, dy[] = { 0, 1, 1, 1 };
	size_t n = 0;

	for (int y = 0; y < MR_GLYPH_ROWS; y++) {
		for (int x = 0; x < 5; x++) {
			bool alone = true;
			if (!lit(rows, x, y))
				continue;
			for (int k = 0; k < 4; k++) {
				bool diagonal = dx[k] && dy[k];
				alone = alone && !lit(rows, x + dx[k], y + dy[k]) &&
				        !lit(rows, x - dx[k], y - dy[k]);
				if (!lit(rows, x + dx[k], y + dy[k]) ||
				    (diagonal && (lit(rows, x + dx[k], y) || lit(rows, x, y + dy[k]))))
					continue;
				s[n++] = (stroke){ x, y, x + dx[k], y + dy[k] };
			}
			if (alone)
				s[n++] = (stroke){ x, y, x, y };
		}
	}
	return n;
}

static double
distance_to(const stroke *s, double x, double y)
{
	double ux = s->x1 - s->x0, uy = s->y1 - s->y0, length2 = ux * ux + uy * uy;
	double t = length2 > 0 ? ((x - s->x0) * ux + (y - s->y0) * uy) / length2 : 0;

	t = t > 0 ? t < 1 ? t : 1 : 0;
	return hypot(x - s->x0 - t * ux, y - s->y0 - t * uy);
}

static void
blend(mr_rgb *to, mr_rgb color, double share)
{
	to->r = (uint8_t)(to->r + (color.r - to->r) * share + 0.5);
	to->g = (uint8_t)(to->g + (color.g - to->g) * share + 0.5);
	to->b = (uint8_t)(to->b + (color.b - to->b) * share + 0.5);
}

/* As much of each pixel of a box as is within `half` of one of n strokes; a unit of these is `unit` pixels.
 */
static void
draw_strokes(mr_image *image, const stroke *s, size_t n, const mr_box *box, mr_v3 origin, double unit,
    double half, mr_rgb color)
{
	size_t left = clip(box->min.x, image->width), right = clip(box->max.x, image->width);
	size_t bottom = clip(box->max.y, image->height);

	for (size_t j = clip(box->min.y, image->height); j < bottom; j++) {
		for (size_t i = left; i < right; i++) {
			double u = ((double)i + 0.5 - origin.x) / unit,
			       v = ((double)j + 0.5 - origin.y) / unit;
			double d = INFINITY, share;
			for (size_t k = 0; k < n; k++)
				d = fmin(d, distance_to(&s[k], u, v));
			share = (half - d) * unit + 0.5;
			if (share > 0)
				blend(&image->pixel[j * image->width + i], color, fmin(share, 1));
		}
	}
}

static void
draw_letter(mr_image *image, double x, double y, double unit, mr_rgb color, char letter)
{
	stroke s[STROKES];
	size_t n = strokes_of(mr_glyph(letter), s);
	mr_box box = { mr_vec(x - unit, y - unit, 0), mr_vec(x + 6 * unit, y + 10 * unit, 0) };

	draw_strokes(image, s, n, &box, mr_vec(x + unit / 2, y + unit / 2, 0), unit, 0.5, color);
}

void
mr_image_line(mr_image *image, const double from[2], const double to[2], double width, mr_rgb color)
{
	stroke s = { from[0], from[1], to[0], to[1] };
	double more = width / 2 + 1;
	mr_box box = { mr_vec(fmin(s.x0, s.x1) - more, fmin(s.y0, s.y1) - more, 0),
		mr_vec(fmax(s.x0, s.x1) + more, fmax(s.y0, s.y1) + more, 0) };

	draw_strokes(image, &s, 1, &box, mr_vec(0, 0, 0), 1, width / 2, color);
}

void
mr_image_text(mr_image *image, double x, double y, double unit, mr_rgb color, const char *text)
{
	for (; *text; text++, x += MR_TEXT_ADVANCE * unit)
		draw_letter(image, x, y, unit, color, *text);
}
