/* Rays link the sides of parts with each other and with infinity; a decided side decides the linked ones. */
#include "space/outward.h"

#include "space/bvh.h"
#include "space/connected.h"

enum { RAYS = 64 }; /* of each side of a part */

/* A ray's result: the part it comes from, the part it hits (MR_NONE: out of the scene), and whether it joins
 * like sides. */
typedef struct link {
	uint32_t from, to;
	bool alike;
} link;

typedef struct scene {
	const mr_mesh *m;
	mr_bvh *tree;
	mr_connected c;
	double nearest;
	link *link;
	size_t links;
} scene;

static void
cast(scene *s, uint32_t f, mr_v3 from, mr_v3 dir, bool front)
{
	uint32_t own = s->c.part[s->m->t[f].v[0]], other;
	mr_ray_hit hit;

	if (!mr_bvh_ray(s->tree, from, dir, s->nearest, (double)INFINITY, &hit)) {
		s->link[s->links++] = (link){ own, MR_NONE, front };
		return;
	}
	other = s->c.part[s->m->t[hit.at.face].v[0]];
	if (other != own)
		s->link[s->links++] = (link){ own, other,
			front == (mr_dot(mr_face_cross(s->m, hit.at.face), dir) < 0) };
}

/* From the middle of the face, to either side, rays number k to `end` of the part, which together go all
 * round as light comes from a surface. */
static void
look_around(scene *s, uint32_t f, size_t k, size_t end)
{
	const double golden = 2 * MR_PI * 0.6180339887498949;
	mr_v3 p[3], n = mr_unit(mr_face_cross(s->m, f)), x, y, from;

	mr_corners(s->m, f, p);
	from = mr_mul(1.0 / 3, mr_add(mr_add(p[0], p[1]), p[2]));
	x = mr_unit(mr_sub(p[1], p[0]));
	y = mr_cross(n, x);
	for (; k < end; k++) {
		double angle = golden * (double)k, up2 = ((double)k + 0.5) / RAYS, flat = sqrt(1 - up2);
		mr_v3 aside = mr_axpy(flat * cos(angle), x, mr_mul(flat * sin(angle), y));
		cast(s, f, from, mr_axpy(sqrt(up2), n, aside), true);
		cast(s, f, from, mr_axpy(-sqrt(up2), n, aside), false);
	}
}

/* From faces of each part, spread over its list. */
static void
look_from_parts(mr_ctx *ctx, scene *s)
{
	size_t *faces = MR_NEW_ZERO(ctx, s->c.parts, size_t), *seen = MR_NEW_ZERO(ctx, s->c.parts, size_t);

	for (size_t f = 0; f < s->m->nf; f++)
		faces[s->c.part[s->m->t[f].v[0]]]++;
	s->link = MR_NEW(ctx, 2 * RAYS * s->c.parts, link);
	for (uint32_t f = 0; f < s->m->nf; f++) {
		uint32_t part = s->c.part[s->m->t[f].v[0]];
		size_t k = seen[part]++, n = faces[part];
		if (mr_norm2(mr_face_cross(s->m, f)) > 0)
			look_around(s, f, RAYS * k / n, RAYS * (k + 1) / n);
	}
}

typedef enum state { OPEN, KEPT, TURNED } state;

/* Settles the parts that are linked to settled ones, until none is.  False where none was. */
static bool
settle(scene *s, state *of, size_t (*votes)[2])
{
	bool any = false;

	memset(votes, 0, s->c.parts * sizeof *votes);
	for (const link *l = s->link; l < s->link + s->links; l++) {
		state to = l->to == MR_NONE ? KEPT : of[l->to], from = of[l->from];
		if (from == OPEN && to != OPEN)
			votes[l->from][l->alike == (to == KEPT)]++;
		else if (from != OPEN && to == OPEN)
			votes[l->to][l->alike == (from == KEPT)]++;
	}
	for (size_t i = 0; i < s->c.parts; i++)
		if (of[i] == OPEN && votes[i][0] + votes[i][1] > 0) {
			of[i] = votes[i][0] > 4 * votes[i][1] ? TURNED : KEPT;
			any = true;
		}
	return any;
}

void
mr_inside_out(mr_ctx *ctx, const mr_mesh *m, bool *turned, size_t *parts)
{
	MR_SCOPE(ctx);
	scene s = { .m = m, .nearest = mr_mesh_tolerance(m, 1e-9) };
	size_t(*votes)[2];
	state *of;

	mr_bvh_build(ctx, m, &s.tree);
	mr_connected_by_faces(ctx, m, &s.c);
	look_from_parts(ctx, &s);
	of = MR_NEW_ZERO(ctx, s.c.parts, state);
	votes = mr_alloc(ctx, s.c.parts, sizeof *votes);
	while (settle(&s, of, votes))
		;
	*parts = 0;
	for (size_t i = 0; i < s.c.parts; i++)
		*parts += of[i] == TURNED;
	for (size_t f = 0; f < m->nf; f++)
		turned[f] = of[s.c.part[m->t[f].v[0]]] == TURNED;
}
