/* Texels to places on the target, places to the source, and its values to pixels. */
#include "render/bake.h"

#include "base/parallel.h"
#include "space/bvh.h"
#include "space/near.h"

enum { SUBTEXEL = 256, BAND = 64, NEAR = 8, GRAIN = 512 };

/* ---- which face a texel is on ---- */

/* A face in the texture, y downwards, in whole 256ths of a texel: arithmetic on them is exact. */
typedef struct footprint {
	double x[3], y[3];
} footprint;

/* Twice the area of the corners beside k and a place. */
static double
edge(const footprint *f, int k, double x, double y)
{
	int a = (k + 1) % 3, b = (k + 2) % 3;

	return (f->x[b] - f->x[a]) * (y - f->y[a]) - (f->y[b] - f->y[a]) * (x - f->x[a]);
}

typedef struct cover {
	const footprint *face;
	size_t faces, width, height;
	uint32_t *of;     /* each texel's face */
	uint32_t *second; /* another that it is within; NULL: not asked for */
} cover;

/* The texels from `begin` on, below `end`, that the corners reach, within some of them. */
typedef struct span {
	size_t begin, end;
} span;

static span
span_of(const double x[3], double around, size_t begin, size_t end)
{
	double first = ceil((fmin(fmin(x[0], x[1]), x[2]) - around) / SUBTEXEL);
	double last = floor((fmax(fmax(x[0], x[1]), x[2]) + around) / SUBTEXEL);

	return (span){ (size_t)fmax(first, (double)begin), (size_t)fmax(fmin(last + 1, (double)end), 0) };
}

/* The lowest face has a texel that several have, as on their edge.  around: those, too, that are nobody's
 * within half a texel, which slivers need. */
static void
cover_face(const cover *c, uint32_t i, span rows, bool around)
{
	const footprint *f = &c->face[i];
	double area = edge(f, 0, f->x[0], f->y[0]), reach = around ? SUBTEXEL / 2 : 0, beyond[3];
	span ys = span_of(f->y, reach, rows.begin, rows.end), xs = span_of(f->x, reach, 0, c->width);

	if (ys.begin >= ys.end)
		return;
	for (int k = 0; k < 3; k++)
		beyond[k] = -reach * hypot(f->x[(k + 1) % 3] - f->x[(k + 2) % 3],
					 f->y[(k + 1) % 3] - f->y[(k + 2) % 3]);
	for (size_t y = ys.begin; area != 0 && y < ys.end; y++)
		for (size_t x = xs.begin; x < xs.end; x++) {
			size_t texel = y * c->width + x;
			double w[3];
			for (int k = 0; k < 3; k++)
				w[k] = copysign(1, area) *
				       edge(f, k, (double)x * SUBTEXEL, (double)y * SUBTEXEL);
			if (w[0] < beyond[0] || w[1] < beyond[1] || w[2] < beyond[2])
				continue;
			if (c->of[texel] == MR_NONE)
				c->of[texel] = i;
			else if (c->second && !around && w[0] > 0 && w[1] > 0 && w[2] > 0)
				c->second[texel] = i;
		}
}

static void
cover_bands(void *arg, size_t begin, size_t end)
{
	const cover *c = arg;

	for (size_t band = begin; band < end; band++) {
		span rows = { band * BAND, band * BAND + BAND < c->height ? band * BAND + BAND : c->height };
		for (int around = 0; around < 2; around++)
			for (uint32_t i = 0; i < c->faces; i++)
				cover_face(c, i, rows, around);
	}
}

static double
to_fixed(double share, size_t texels)
{
	return rint((share * (double)texels - 0.5) * SUBTEXEL);
}

static cover
cover_texture(mr_ctx *ctx, size_t nf, const double *uv, size_t width, size_t height, bool twice)
{
	footprint *face = MR_NEW(ctx, nf, footprint);
	cover c = { face, nf, width, height, MR_NEW(ctx, width * height, uint32_t), NULL };

	memset(c.of, 0xff, width * height * sizeof *c.of);
	if (twice) {
		c.second = MR_NEW(ctx, width * height, uint32_t);
		memset(c.second, 0xff, width * height * sizeof *c.second);
	}
	for (size_t i = 0; i < 3 * nf; i++) {
		face[i / 3].x[i % 3] = to_fixed(uv[2 * i], width);
		face[i / 3].y[i % 3] = to_fixed(1 - uv[2 * i + 1], height);
	}
	mr_parallel(ctx, (height + BAND - 1) / BAND, 1, cover_bands, &c);
	return c;
}

double
mr_texture_overlap(mr_ctx *ctx, size_t nf, const double *uv, size_t side,
    void (*meet)(void *arg, uint32_t a, uint32_t b), void *arg)
{
	MR_SCOPE(ctx);
	cover c = cover_texture(ctx, nf, uv, side, side, true);
	size_t twice = 0, all = 0;

	for (size_t i = 0; i < side * side; i++) {
		all += c.of[i] != MR_NONE;
		twice += c.second[i] != MR_NONE;
		if (meet && c.second[i] != MR_NONE)
			meet(arg, c.of[i], c.second[i]);
	}
	return all ? (double)twice / (double)all : 0;
}

/* ---- tangents ---- */

/* The direction of increasing u on a face; *mirrored: v increases to its right, seen from outside. */
static mr_v3
tangent_of(const mr_mesh *m, const double *uv, size_t f, bool *mirrored)
{
	mr_v3 p[3], t;
	const double *c = uv + 6 * f;
	double u1 = c[2] - c[0], u2 = c[4] - c[0], v1 = c[3] - c[1], v2 = c[5] - c[1];

	mr_corners(m, f, p);
	t = mr_sub(mr_mul(v2, mr_sub(p[1], p[0])), mr_mul(v1, mr_sub(p[2], p[0])));
	*mirrored = u1 * v2 - u2 * v1 < 0;
	t = mr_mul(*mirrored ? -1 : 1, t);
	return mr_unit(mr_norm2(t) > 0 ? t : mr_sub(p[1], p[0]));
}

typedef struct tangents {
	const mr_bake_target *t;
	mr_incidence around;
	mr_v3 *face, *corner; /* nf; 3 nf, unit */
	bool *mirrored;       /* nf */
} tangents;

/* Whether corner d of the same vertex is shaded as one with corner c. */
static bool
is_shared(const tangents *g, size_t c, size_t d)
{
	return !memcmp(g->t->uv + 2 * c, g->t->uv + 2 * d, 2 * sizeof(double)) &&
	       !memcmp(&g->t->normal[c], &g->t->normal[d], sizeof(mr_v3)) &&
	       g->mirrored[c / 3] == g->mirrored[d / 3];
}

/* Mikkelsen's: of the faces around, each in the corner's plane, by angle. */
static void
find_tangents(void *arg, size_t begin, size_t end)
{
	tangents *g = arg;
	const mr_mesh *m = &g->t->m;

	for (size_t c = begin; c < end; c++) {
		uint32_t v = m->t[c / 3].v[c % 3];
		mr_v3 n = g->t->normal[c], sum = { 0 }, p[3];
		for (size_t i = g->around.start[v]; i < g->around.start[v + 1]; i++) {
			size_t f = g->around.face[i];
			size_t k = m->t[f].v[0] == v ? 0 : m->t[f].v[1] == v ? 1 : 2;
			mr_v3 t = mr_unit(mr_axpy(-mr_dot(g->face[f], n), n, g->face[f]));
			if (!is_shared(g, c, 3 * f + k))
				continue;
			mr_corners(m, f, p);
			sum = mr_axpy(
			    mr_angle(mr_sub(p[(k + 1) % 3], p[k]), mr_sub(p[(k + 2) % 3], p[k])), t, sum);
		}
		g->corner[c] = mr_unit(sum);
	}
}

static tangents
tangents_build(mr_ctx *ctx, const mr_bake_target *t)
{
	size_t nf = t->m.nf;
	tangents g = { .t = t,
		.face = MR_NEW(ctx, nf, mr_v3),
		.corner = MR_NEW(ctx, 3 * nf, mr_v3),
		.mirrored = MR_NEW(ctx, nf, bool) };

	mr_incidence_build(ctx, &t->m, &g.around);
	for (size_t f = 0; f < nf; f++)
		g.face[f] = tangent_of(&t->m, t->uv, f, &g.mirrored[f]);
	mr_parallel(ctx, 3 * nf, 1024, find_tangents, &g);
	return g;
}

/* A unit normal in a tangent frame x T + y B + z N = n; one that looks away is flat. */
static mr_rgb
normal_pixel(const mr_v3 frame[3], mr_v3 n, bool *turned)
{
	double det = mr_dot(frame[0], mr_cross(frame[1], frame[2])), size;
	/* Cramer's rule; along N where the frame is none */
	mr_v3 local = mr_mul(det > 0   ? 1
			     : det < 0 ? -1
				       : 0,
	    mr_vec(mr_dot(n, mr_cross(frame[1], frame[2])), mr_dot(n, mr_cross(frame[2], frame[0])),
		mr_dot(n, mr_cross(frame[0], frame[1]))));

	*turned = local.z < 0;
	local.z = fmax(local.z, 0);
	size = mr_norm(local);
	local = size > 0 ? mr_mul(1 / size, local) : mr_vec(0, 0, 1);
	return (mr_rgb){ (uint8_t)(127.5 * (local.x + 1) + 0.5), (uint8_t)(127.5 * (local.y + 1) + 0.5),
		(uint8_t)(127.5 * (local.z + 1) + 0.5) };
}

/* ---- the source ---- */

typedef struct seen {
	mr_v3 color, normal; /* 0 to 255; not unit, zero where not known */
} seen;

/* Texels at work, in a row, and their samples. */
typedef struct baking {
	const mr_bake_source *s;
	const mr_bake_target *t;
	const mr_v3 *normal; /* of the source's vertices; NULL: none */
	mr_bvh *bvh;
	mr_near *near;
	cover cover;
	tangents tangents;
	double spacing; /* area of the target per texel */
	size_t n;
	const size_t *texel;
	mr_v3 *p, *q; /* place and unit normal of each */
	seen *seen;
	uint32_t *index; /* NEAR of each, and their squared distances */
	double *dist2;
	mr_baked *baked;
	bool *turned; /* whose normal looks away */
} baking;

static mr_v3
of_rgb(mr_rgb c)
{
	return mr_vec(c.r, c.g, c.b);
}

static mr_v3
picture_at(const baking *b, const mr_texture *texture, mr_place at)
{
	const double *c = b->s->look.paint.uv + 6 * at.face;
	const mr_image *image = &texture->level[0];
	double texels = 0.5 * (double)(image->width * image->height) *
	                fabs((c[2] - c[0]) * (c[5] - c[1]) - (c[4] - c[0]) * (c[3] - c[1]));
	double samples = 0.5 * mr_norm(mr_face_cross(&b->s->look.mesh, at.face)) / b->spacing;
	mr_v3 w = at.bary, sum = { 0 };
	mr_texels t = mr_texture_at(texture, mr_texture_level(texture, texels, samples),
	    w.x * c[0] + w.y * c[2] + w.z * c[4], w.x * c[1] + w.y * c[3] + w.z * c[5]);

	for (int k = 0; k < 4; k++)
		sum = mr_axpy(t.weight[k], of_rgb(t.color[k]), sum);
	return sum;
}

static mr_v3
color_at(const baking *b, mr_place at)
{
	const mr_subject *s = &b->s->look;
	const uint32_t *v = s->mesh.t[at.face].v;

	if (s->paint.uv && s->paint.of && s->paint.of[at.face] != MR_NONE &&
	    isfinite(s->paint.uv[6 * at.face] + s->paint.uv[6 * at.face + 2] + s->paint.uv[6 * at.face + 4]))
		return picture_at(b, &s->paint.texture[s->paint.of[at.face]], at);
	if (!s->color || s->per_face)
		return of_rgb(s->color ? s->color[at.face] : MR_PLAIN);
	return mr_bary_point(at.bary, of_rgb(s->color[v[0]]), of_rgb(s->color[v[1]]), of_rgb(s->color[v[2]]));
}

static mr_v3
normal_at(const baking *b, mr_place at)
{
	const uint32_t *v = b->s->look.mesh.t[at.face].v;
	const mr_v3 *c = b->s->corner_normal ? b->s->corner_normal + 3 * at.face : NULL;

	if (c && mr_norm2(c[0]) * mr_norm2(c[1]) * mr_norm2(c[2]) > 0)
		return mr_bary_point(at.bary, c[0], c[1], c[2]);
	return mr_bary_point(at.bary, b->normal[v[0]], b->normal[v[1]], b->normal[v[2]]);
}

/* It is no farther than `most`, but for rounding. */
static mr_closest
nearest_place(const baking *b, mr_v3 p, double most)
{
	mr_closest c = mr_bvh_closest_within(b->bvh, p, most * most * (1 + 1e-9));

	return c.at.face == MR_NONE ? mr_bvh_closest(b->bvh, p) : c;
}

static double
faces(const baking *b, uint32_t face, mr_v3 n)
{
	return mr_dot(mr_face_cross(&b->s->look.mesh, face), n);
}

/* The nearest place along the normal, either way, where the surface faces as the target does. */
static bool
find_along(const baking *b, mr_v3 p, mr_v3 n, double reach, mr_place *at)
{
	mr_ray_hit hit;
	bool found = mr_bvh_ray_both(b->bvh, p, n, reach, &hit);

	if (found && faces(b, hit.at.face, n) <= 0) {
		found = false;
		for (int back = 0; back < 2; back++)
			if (mr_bvh_ray(b->bvh, p, mr_mul(back ? -1 : 1, n), 0, reach, &hit) &&
			    faces(b, hit.at.face, n) > 0) {
				found = true;
				reach = hit.t;
				*at = hit.at;
			}
		return found;
	}
	if (found)
		*at = hit.at;
	return found;
}

/* The nearest place is sought where the last one, of a texel before, says too little of how near it is. */
static void
look_at_surface(void *arg, size_t begin, size_t end)
{
	const baking *b = arg;
	mr_closest c = { 0 };
	mr_v3 from = { 0 };

	for (size_t i = begin; i < end; i++) {
		mr_place at;
		double far = mr_dist(b->p[i], from), near = sqrt(c.dist2);
		if (i == begin || far > near / 2) {
			c = nearest_place(b, b->p[i], i == begin ? INFINITY : mr_dist(b->p[i], c.point));
			from = b->p[i];
			far = 0;
			near = sqrt(c.dist2);
		}
		if (!find_along(b, b->p[i], b->q[i], 2 * (near + far), &at))
			at = far > 0 ? nearest_place(b, b->p[i], near + far).at : c.at;
		b->seen[i] = (seen){ color_at(b, at), normal_at(b, at) };
	}
}

static void
mix(const baking *b, size_t i, uint32_t point, double w)
{
	const mr_subject *s = &b->s->look;
	mr_v3 n = b->normal ? b->normal[point] : mr_vec(0, 0, 0);

	b->seen[i].color = mr_axpy(w, s->color ? of_rgb(s->color[point]) : mr_vec(0, 0, 0), b->seen[i].color);
	b->seen[i].normal = mr_axpy(mr_dot(n, b->q[i]) < 0 ? -w : w, n, b->seen[i].normal);
}

/* The weight ((R - d) / d)^2 is none where a point leaves the eight, whose last is R away. */
static void
look_at_points(void *arg, size_t begin, size_t end)
{
	const baking *b = arg;

	for (size_t i = begin; i < end; i++) {
		const uint32_t *near = b->index + NEAR * i;
		const double *dist2 = b->dist2 + NEAR * i;
		double total = 0, far = 0;
		b->seen[i] = (seen){ 0 };
		for (int k = 0; k < NEAR && near[k] != MR_NONE; k++)
			far = sqrt(dist2[k]);
		for (int k = 0; k < NEAR && near[k] != MR_NONE && far > 0; k++) {
			double w = (far - sqrt(dist2[k])) / fmax(sqrt(dist2[k]), 1e-6 * far);
			mix(b, i, near[k], w * w);
			total += w * w;
		}
		if (total > 0)
			b->seen[i].color = mr_mul(1 / total, b->seen[i].color);
		else
			mix(b, i, near[0], 1);
	}
}

static mr_status
look(mr_ctx *ctx, const baking *b)
{
	if (b->bvh) {
		mr_parallel(ctx, b->n, GRAIN, look_at_surface, (void *)(uintptr_t)b);
	} else if (b->near) {
		MR_TRY(mr_near_query(ctx, b->near, b->p, b->n, NEAR, b->index, b->dist2));
		mr_parallel(ctx, b->n, GRAIN, look_at_points, (void *)(uintptr_t)b);
	}
	return MR_OK;
}

static mr_status
prepare_source(mr_ctx *ctx, baking *b)
{
	const mr_subject *s = &b->s->look;
	mr_v3 *normal = s->mesh.nf && !s->normal ? MR_NEW(ctx, s->mesh.nv, mr_v3) : NULL;

	if (normal)
		mr_vertex_normals(&s->mesh, normal);
	b->normal = normal ? normal : s->normal;
	if (!s->mesh.nf)
		return s->mesh.nv == 0 ? MR_OK : mr_near_build(ctx, s->mesh.p, s->mesh.nv, &b->near);
	mr_bvh_build(ctx, &s->mesh, &b->bvh);
	return MR_OK;
}

/* ---- the target ---- */

/* The place of a texel on its face: exact, the same on both faces of an edge. */
static mr_place
place_of(const baking *b, size_t texel)
{
	uint32_t face = b->cover.of[texel];
	const footprint *f = &b->cover.face[face];
	double x = (double)(texel % b->cover.width) * SUBTEXEL;
	double y = (double)(texel / b->cover.width) * SUBTEXEL;
	double all = edge(f, 0, f->x[0], f->y[0]), w[3], sum = 0;

	for (int k = 0; k < 3; k++) {
		w[k] = fmax(edge(f, k, x, y) / all, 0); /* beside the face: on its border */
		sum += w[k];
	}
	return (mr_place){ face,
		sum == 1 ? mr_vec(w[0], w[1], w[2]) : mr_vec(w[0] / sum, w[1] / sum, w[2] / sum) };
}

/* The triangle of the fine surface, and where on it. */
static mr_v3
find_fine(const mr_atlas *g, mr_place at, uint32_t v[3])
{
	double s = (double)g->segments, x = at.bary.y * s, y = at.bary.z * s;
	size_t i = (size_t)x, j = (size_t)y;
	bool far;

	x -= (double)i;
	y -= (double)j;
	far = x + y > 1;
	v[0] = far ? mr_atlas_vertex(g, at.face, i + 1, j + 1) : mr_atlas_vertex(g, at.face, i, j);
	v[1] = far ? mr_atlas_vertex(g, at.face, i, j + 1) : mr_atlas_vertex(g, at.face, i + 1, j);
	v[2] = far ? mr_atlas_vertex(g, at.face, i + 1, j) : mr_atlas_vertex(g, at.face, i, j + 1);
	return far ? mr_vec(x + y - 1, 1 - x, 1 - y) : mr_vec(1 - x - y, x, y);
}

static mr_v3
corner_mean(const mr_v3 *of, mr_place at)
{
	const mr_v3 *c = of + 3 * at.face;

	return mr_bary_point(at.bary, c[0], c[1], c[2]);
}

static void
place_texels(void *arg, size_t begin, size_t end)
{
	const baking *b = arg;
	const mr_bake_target *t = b->t;

	for (size_t i = begin; i < end; i++) {
		mr_place at = place_of(b, b->texel[i]);
		uint32_t v[3];
		if (t->fine.nf) {
			mr_v3 w = find_fine(&t->grid, at, v);
			b->p[i] = mr_bary_point(w, t->fine.p[v[0]], t->fine.p[v[1]], t->fine.p[v[2]]);
			b->q[i] = mr_bary_point(
			    w, t->fine_normal[v[0]], t->fine_normal[v[1]], t->fine_normal[v[2]]);
		} else {
			b->p[i] = mr_place_point(&t->m, at);
			b->q[i] = corner_mean(t->normal, at);
		}
		b->q[i] = mr_unit(b->q[i]);
	}
}

static uint8_t
to_byte(double x)
{
	return (uint8_t)(fmin(fmax(x, 0), 255) + 0.5);
}

static void
paint_texels(void *arg, size_t begin, size_t end)
{
	const baking *b = arg;
	const mr_bake_target *t = b->t;

	for (size_t i = begin; i < end; i++) {
		mr_place at = place_of(b, b->texel[i]);
		mr_v3 n = b->seen[i].normal, c = b->seen[i].color, frame[3];
		bool turned;
		if (b->baked->color.pixel)
			b->baked->color.pixel[b->texel[i]] = (mr_rgb){ to_byte(c.x), to_byte(c.y),
				to_byte(c.z) };
		if (!b->baked->normal.pixel)
			continue;
		frame[0] = corner_mean(b->tangents.corner, at);
		frame[2] = corner_mean(t->normal, at);
		frame[1] = mr_mul(b->tangents.mirrored[at.face] ? -1 : 1, mr_cross(frame[2], frame[0]));
		n = mr_norm2(n) > 0 ? mr_unit(n) : b->q[i];
		b->baked->normal.pixel[b->texel[i]] = normal_pixel(frame, n, &turned);
		b->turned[i] = turned;
	}
}

/* ---- around the faces ---- */

typedef struct bleeding {
	const uint8_t *before;
	uint8_t *after; /* 0: no colour yet; else the ring, 1 the faces */
	size_t width, height;
	mr_image *image;
	int ring;
} bleeding;

/* Beside an oblique border what makes a bilinear sample on it linear: a + b - c of a square's others; the
 * mean of those, or farther off of the neighbours. */
static bool
continue_at(const bleeding *b, size_t x, size_t y, mr_rgb *to)
{
	mr_v3 square = { 0 }, beside = { 0 };
	int squares = 0, n = 0;

	for (int k = 0; k < 9; k++) {
		size_t i = x + (size_t)(k % 3) - 1, j = y + (size_t)(k / 3) - 1, at = j * b->width + i;
		if (k == 4 || i >= b->width || j >= b->height || !b->before[at])
			continue;
		beside = mr_add(beside, of_rgb(b->image->pixel[at]));
		n++;
		if (b->ring > 1 || k % 2 || !b->before[y * b->width + i] || !b->before[j * b->width + x])
			continue;
		square = mr_add(square, mr_sub(mr_add(of_rgb(b->image->pixel[y * b->width + i]),
						   of_rgb(b->image->pixel[j * b->width + x])),
					    of_rgb(b->image->pixel[at])));
		squares++;
	}
	square = squares ? mr_mul(1.0 / squares, square) : mr_mul(n ? 1.0 / n : 0, beside);
	*to = (mr_rgb){ to_byte(square.x), to_byte(square.y), to_byte(square.z) };
	return n > 0;
}

static void
bleed_rows(void *arg, size_t begin, size_t end)
{
	const bleeding *b = arg;

	for (size_t i = begin * b->width; i < end * b->width; i++)
		if (!b->before[i] && continue_at(b, i % b->width, i / b->width, &b->image->pixel[i]))
			b->after[i] = 1;
}

static void
bleed(mr_ctx *ctx, const cover *c, size_t rings, mr_image *image)
{
	size_t n = image->width * image->height;
	uint8_t *before = MR_NEW(ctx, n, uint8_t), *after = MR_NEW(ctx, n, uint8_t);
	uint64_t sum[3] = { 0 }, count = 0;
	mr_rgb mean;

	for (size_t i = 0; i < n; i++) {
		mr_rgb p = image->pixel[i];
		after[i] = c->of[i] != MR_NONE;
		sum[0] += after[i] ? p.r : 0;
		sum[1] += after[i] ? p.g : 0;
		sum[2] += after[i] ? p.b : 0;
		count += after[i];
	}
	for (size_t ring = 1; ring <= rings; ring++) {
		bleeding b = { before, after, image->width, image->height, image, (int)ring };
		memcpy(before, after, n);
		mr_parallel(ctx, image->height, BAND, bleed_rows, &b);
	}
	count += !count;
	mean = (mr_rgb){ (uint8_t)(sum[0] / count), (uint8_t)(sum[1] / count), (uint8_t)(sum[2] / count) };
	for (size_t i = 0; i < n; i++)
		if (!after[i])
			image->pixel[i] = mean;
}

/* ---- all ---- */

static mr_status
draw_band(mr_ctx *ctx, baking *b, size_t top, size_t bottom)
{
	MR_SCOPE(ctx);
	size_t width = b->cover.width, *texel = MR_NEW(ctx, (bottom - top) * width, size_t);

	b->n = 0;
	for (size_t i = top * width; i < bottom * width; i++)
		if (b->cover.of[i] != MR_NONE)
			texel[b->n++] = i;
	b->texel = texel;
	b->p = MR_NEW(ctx, b->n, mr_v3);
	b->q = MR_NEW(ctx, b->n, mr_v3);
	b->seen = MR_NEW_ZERO(ctx, b->n, seen);
	b->index = !b->near ? NULL : MR_NEW(ctx, NEAR * b->n, uint32_t);
	b->dist2 = !b->near ? NULL : MR_NEW(ctx, NEAR * b->n, double);
	b->turned = MR_NEW_ZERO(ctx, b->n, bool);
	mr_parallel(ctx, b->n, GRAIN, place_texels, b);
	MR_TRY(b->n ? look(ctx, b) : MR_OK);
	mr_parallel(ctx, b->n, GRAIN, paint_texels, b);
	for (size_t i = 0; i < b->n; i++)
		b->baked->turned += b->turned[i];
	b->baked->texels += b->n;
	return MR_OK;
}

static mr_status
draw(mr_ctx *ctx, const mr_bake_source *s, const mr_bake_target *t, mr_baked *baked)
{
	baking b = { .s = s, .t = t, .baked = baked };
	size_t texels = 0;
	MR_SCOPE(ctx);

	MR_TRY(prepare_source(ctx, &b));
	b.cover = cover_texture(ctx, t->m.nf, t->uv, t->width, t->height, false);
	b.tangents = tangents_build(ctx, t);
	for (size_t i = 0; i < t->width * t->height; i++)
		texels += b.cover.of[i] != MR_NONE;
	b.spacing = mr_mesh_area(ctx, &t->m) / (double)(texels + !texels);
	for (size_t y = 0; y < t->height; y += BAND)
		MR_TRY(draw_band(ctx, &b, y, y + BAND < t->height ? y + BAND : t->height));
	if (baked->color.pixel)
		bleed(ctx, &b.cover, t->gutter, &baked->color);
	if (baked->normal.pixel)
		bleed(ctx, &b.cover, t->gutter, &baked->normal);
	return MR_OK;
}

mr_status
mr_bake_draw(mr_ctx *ctx, const mr_bake_source *s, const mr_bake_target *t, mr_baked *baked)
{
	const mr_rgb black = { 0, 0, 0 };
	mr_baked made = { 0 };

	MR_ENTER(ctx);
	if (s->colored)
		MR_TRY(mr_image_new(ctx, t->width, t->height, black, &made.color));
	if (s->look.mesh.nf || s->look.normal || t->fine.nf)
		MR_TRY(mr_image_new(ctx, t->width, t->height, black, &made.normal));
	MR_TRY(draw(ctx, s, t, &made));
	*baked = made;
	return MR_OK;
}
