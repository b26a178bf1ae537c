/* Each face's rotation is applied to the normals at its corners, and what comes of it is added up. */
#include "mesh/normals.h"

/* An orthonormal frame of a triangle, and its corners in it: (0 0), (x1 0), (x2 y2). */
typedef struct flat {
	mr_v3 e1, e2, n;
	double x1, x2, y2, area; /* twice the area */
} flat;

/* What is the same for the corners of a group: vertices, or equal normals at one. */
typedef struct groups {
	const uint32_t *of; /* of each corner; NULL: its vertex */
	mr_v3 *sum;
	bool *moved;
	size_t n;
} groups;

/* False where the triangle has no area. */
static bool
flatten(const mr_v3 *p, const uint32_t *v, flat *f)
{
	mr_v3 a = mr_sub(p[v[1]], p[v[0]]), b = mr_sub(p[v[2]], p[v[0]]), c = mr_cross(a, b);

	f->area = mr_norm(c);
	f->x1 = mr_norm(a);
	if (!(f->area > 0))
		return false;
	f->e1 = mr_mul(1 / f->x1, a);
	f->n = mr_mul(1 / f->area, c);
	f->e2 = mr_cross(f->n, f->e1);
	f->x2 = mr_dot(b, f->e1);
	f->y2 = mr_dot(b, f->e2);
	return true;
}

/*
 * The frame that the rotation nearest to what became of the triangle makes of the old frame.  With F = N O^-1
 * from the old corners to the new ones in their planes, it has the cosine and sine F11 + F22 and F21 - F12,
 * up to one positive factor.
 */
static void
turn_frame(const flat *was, flat *is)
{
	double c = is->x1 * was->y2 + is->y2 * was->x1, s = is->x1 * was->x2 - is->x2 * was->x1;
	double r = 1 / sqrt(c * c + s * s);
	mr_v3 e1 = is->e1;

	is->e1 = mr_axpy(c * r, e1, mr_mul(s * r, is->e2));
	is->e2 = mr_axpy(c * r, is->e2, mr_mul(-s * r, e1));
}

/* The vector that has in the new frame the coordinates that n has in the old one. */
static mr_v3
turn(const flat *was, const flat *is, mr_v3 n)
{
	return mr_axpy(mr_dot(n, was->e1), is->e1,
	    mr_axpy(mr_dot(n, was->e2), is->e2, mr_mul(mr_dot(n, was->n), is->n)));
}

static bool
has_moved(const mr_mesh *m, const mr_v3 *p, size_t f)
{
	for (int k = 0; k < 3; k++)
		if (memcmp(&m->p[m->t[f].v[k]], &p[m->t[f].v[k]], sizeof *p))
			return true;
	return false;
}

static void
start(mr_ctx *ctx, groups *g)
{
	g->sum = MR_NEW_ZERO(ctx, g->n, mr_v3);
	g->moved = MR_NEW_ZERO(ctx, g->n, bool);
}

/* Adds what the face makes of the normals at its corners; normal: by corners where g->of says so. */
static void
add_face(const mr_mesh *m, const mr_v3 *p, size_t f, const mr_v3 *normal, groups *g)
{
	bool moved = has_moved(m, p, f);
	flat was, is;

	if (!flatten(m->p, m->t[f].v, &was) || !flatten(p, m->t[f].v, &is))
		return;
	turn_frame(&was, &is);
	for (size_t k = 0; k < 3; k++) {
		size_t i = 3 * f + k, v = m->t[f].v[k], to = g->of ? g->of[i] : v;
		mr_v3 n = normal[g->of ? i : v];
		g->sum[to] = mr_axpy(was.area, moved ? turn(&was, &is, n) : n, g->sum[to]);
		g->moved[to] |= moved;
	}
}

/* The direction of the sum, the length of the normal. */
static mr_v3
result(const groups *g, size_t i, mr_v3 n)
{
	mr_v3 turned = mr_mul(mr_norm(n) / mr_norm(g->sum[i]), g->sum[i]);

	return g->moved[i] && mr_finite(turned) ? turned : n;
}

static size_t
hash_of(uint32_t v, mr_v3 n)
{
	uint64_t bits[3], h = v;

	memcpy(bits, &n, sizeof bits);
	for (int k = 0; k < 3; k++) {
		h = (h ^ bits[k]) * 0x9e3779b97f4a7c15u;
		h ^= h >> 32;
	}
	return (size_t)h;
}

/* Numbers the normals of each vertex that differ. */
static void
group_corners(mr_ctx *ctx, const mr_mesh *m, const mr_v3 *corner, groups *g)
{
	size_t corners = 3 * m->nf, mask = 64;
	uint32_t *of = MR_NEW(ctx, corners, uint32_t), *first = MR_NEW(ctx, corners, uint32_t), *slot;

	while (mask < corners + corners / 2)
		mask *= 2;
	slot = MR_NEW_ZERO(ctx, mask--, uint32_t);
	for (size_t i = 0; i < corners; i++) {
		uint32_t v = m->t[i / 3].v[i % 3];
		size_t at = hash_of(v, corner[i]) & mask;
		for (; slot[at]; at = (at + 1) & mask) {
			uint32_t j = first[slot[at] - 1];
			if (m->t[j / 3].v[j % 3] == v && !memcmp(&corner[j], &corner[i], sizeof *corner))
				break;
		}
		if (slot[at] == 0) {
			first[g->n] = (uint32_t)i;
			slot[at] = (uint32_t)++g->n;
		}
		of[i] = slot[at] - 1;
	}
	g->of = of;
}

static void
turn_all(mr_ctx *ctx, const mr_mesh *before, const mr_v3 *p, groups *g, mr_v3 *normal, size_t n)
{
	start(ctx, g);
	for (size_t f = 0; f < before->nf; f++)
		add_face(before, p, f, normal, g);
	for (size_t i = 0; i < n; i++)
		normal[i] = result(g, g->of ? g->of[i] : i, normal[i]);
}

void
mr_turn_normals(mr_ctx *ctx, const mr_mesh *before, const mr_v3 *p, mr_v3 *normal, mr_v3 *corner)
{
	mr_mark mark = mr_mark_take(ctx);
	groups vertices = { .n = before->nv }, corners = { 0 };

	if (normal)
		turn_all(ctx, before, p, &vertices, normal, before->nv);
	if (corner) {
		group_corners(ctx, before, corner, &corners);
		turn_all(ctx, before, p, &corners, corner, 3 * before->nf);
	}
	mr_mark_release(ctx, mark);
}
