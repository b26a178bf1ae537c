/* Columns go along by places: where vertices and corners of the new surface are on the old one. */
#include "space/carry.h"

#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include "mesh/mend.h"
#include "mesh/repair.h"
#include "space/bvh.h"
#include "space/surface_walk.h"

/* Texture coordinates that differ by less are the same: pictures have up to 16,384 texels a side. */
static const double SAME = 1e-6;

/* ---- seams ---- */

static bool
is_of_corners(const mr_carried *c)
{
	return c->shape.element == 'f' && c->shape.components % 3 == 0 && !strncmp(c->name, "corner_", 7);
}

/* Labels whose borders are seams. */
static bool
is_bordered(const char *name)
{
	return !strcmp(name, "material") || !strcmp(name, "group") || !strcmp(name, "object");
}

static bool
same(const double *a, const double *b, size_t n)
{
	for (size_t i = 0; i < n; i++)
		if (!(fabs(a[i] - b[i]) < SAME) && !(isnan(a[i]) && isnan(b[i])))
			return false;
	return true;
}

/* Whether the values of the corners at the start of h are others across its edge. */
static bool
jumps(const mr_topology *topo, const mr_column *c, uint32_t h)
{
	size_t wide = c->shape.components / 3;
	const double *x = c->data;
	uint32_t g = topo->twin[h];

	return g != MR_NONE && !same(x + wide * h, x + wide * mr_he_next(g), wide);
}

/* At both ends: at the pole of a sphere they jump from face to face. */
static void
mark_jumps(const mr_mesh *m, const mr_topology *topo, const mr_column *c, uint8_t *seam)
{
	for (uint32_t h = 0; h < 3 * m->nf; h++)
		seam[h] |= jumps(topo, c, h) && jumps(topo, c, topo->twin[h]);
}

static void
mark_borders(const mr_mesh *m, const mr_topology *topo, const mr_column *c, uint8_t *seam)
{
	const uint32_t *x = c->data;

	for (uint32_t h = 0; h < 3 * m->nf; h++)
		seam[h] |= topo->twin[h] != MR_NONE && x[h / 3] != x[topo->twin[h] / 3];
}

mr_status
mr_layer_seams(mr_ctx *ctx, mr_frame *f, const mr_mesh *m, uint8_t **seam)
{
	uint8_t *mark = MR_NEW_ZERO(ctx, 3 * m->nf, uint8_t);
	bool any = false;
	mr_topology topo;

	MR_TRY(mr_topology_build(ctx, m, &topo));
	for (size_t i = 0; i < f->count; i++) {
		mr_column *c = &f->columns[i];
		if (strcmp(c->layer, m->name) || c->rows != m->nf)
			continue;
		MR_TRY(mr_column_decode(ctx, c));
		if (!strcmp(c->name, "corner_texcoord"))
			mark_jumps(m, &topo, c, mark);
		else if (c->shape.type == 'u' && is_bordered(c->name))
			mark_borders(m, &topo, c, mark);
	}
	for (size_t h = 0; h < 3 * m->nf; h++)
		any |= mark[h];
	*seam = any ? mark : NULL;
	return MR_OK;
}

mr_status
mr_layer_join_seams(mr_ctx *ctx, mr_frame *f, mr_mesh *m)
{
	uint32_t *map = MR_NEW(ctx, m->nv, uint32_t);
	mr_tri *t = MR_NEW(ctx, m->nf, mr_tri);
	const double eps = 1e-8 * mr_mesh_diagonal(m); /* that sines of pi and the like are off */
	mr_topology topo;
	size_t n = 0, rim = 0;

	if (mr_topology_build(ctx, m, &topo) != MR_OK)
		return MR_OK;
	for (size_t h = 0; h < 3 * m->nf; h++)
		rim += topo.twin[h] == MR_NONE;
	if (!rim)
		return MR_OK;
	mr_weld(ctx, m->p, m->nv, eps, map, &n);
	for (size_t h = 0; h < 3 * m->nf; h++)
		t[h / 3].v[h % 3] = map[m->t[h / 3].v[h % 3]];
	if (n == m->nv || mr_topology_build(ctx, &(mr_mesh){ m->name, m->p, t, n, m->nf }, &topo) != MR_OK)
		return MR_OK;
	MR_TRY(mr_layer_weld(ctx, f, m->name, eps, NULL, &n));
	return mr_layer_mesh(ctx, f, m->name, m);
}

/* ---- faces and corners ---- */

typedef struct corner_job {
	const mr_successor *s;
	uint32_t *face;        /* of before, of each of after: on the same side of all seams */
	const uint32_t *sides; /* of each vertex of after: how many sides of seams meet there */
	const bool *off;       /* whether no seam does */
	mr_mesh cut, sides_of; /* before and after, their vertices apart along the seams */
	mr_topology topo;
	mr_closest *at; /* of each corner of after, on its own face's side */
} corner_job;

static void
place_corners(void *arg, size_t begin, size_t end)
{
	corner_job *j = arg;
	const mr_mesh *m = j->s->after;

	for (size_t c = begin; c < end; c++)
		j->at[c] = mr_project_walk(&j->cut, &j->topo, j->face[c / 3], m->p[m->t[c / 3].v[c % 3]]);
}

static mr_v3
middle_of(const mr_mesh *m, size_t f)
{
	mr_v3 p[3];

	mr_corners(m, f, p);
	return mr_mul(1.0 / 3, mr_add(p[0], mr_add(p[1], p[2])));
}

static void
place_faces(void *arg, size_t begin, size_t end)
{
	const corner_job *j = arg;

	for (size_t f = begin; f < end; f++)
		j->face[f] =
		    mr_project_walk(&j->cut, &j->topo, j->face[f], middle_of(j->s->after, f)).at.face;
}

/* A face of before on the side of face f: of a corner off the seams, of a seam, or a neighbour's; MR_NONE if
 * it has none yet. */
static uint32_t
side_of(const corner_job *j, const mr_topology *after, uint32_t f)
{
	const mr_successor *s = j->s;
	uint32_t found = MR_NONE;

	for (uint32_t h = 3 * f; h < 3 * f + 3; h++) {
		uint32_t v = mr_he_from(s->after, h), g = after->twin[h];
		if (j->off[v])
			return s->place.face[v];
		if (s->along && s->along[h] != MR_NONE)
			found = s->along[h] / 3;
		else if (found == MR_NONE && g != MR_NONE)
			found = j->face[g / 3];
	}
	return found;
}

static void
find_faces(mr_ctx *ctx, corner_job *j, const mr_topology *after)
{
	size_t n = j->s->after->nf, left = n;

	memset(j->face, 0xff, n * sizeof *j->face);
	for (size_t before = 0; left != before;) {
		before = left;
		left = 0;
		for (uint32_t f = 0; f < n; f++) {
			j->face[f] = j->face[f] == MR_NONE ? side_of(j, after, f) : j->face[f];
			left += j->face[f] == MR_NONE;
		}
	}
	for (uint32_t f = 0; f < n; f++)
		if (j->face[f] == MR_NONE)
			j->face[f] = j->s->place.face[j->s->after->t[f].v[0]];
	mr_parallel(ctx, n, 1024, place_faces, j);
}

/* The mesh with a vertex for each side of the seams there. */
static mr_status
cut_seams(mr_ctx *ctx, const mr_mesh *m, const uint8_t *seam, mr_mesh *cut, mr_topology *topo)
{
	size_t n = 3 * m->nf, nv = 0;
	uint32_t *set = mr_sets_new(ctx, n), *number = MR_NEW(ctx, n, uint32_t);
	mr_tri *t = MR_NEW(ctx, m->nf, mr_tri);
	mr_v3 *p = MR_NEW(ctx, n, mr_v3);

	MR_TRY(mr_topology_build(ctx, m, topo));
	for (uint32_t h = 0; h < n; h++) {
		uint32_t g = topo->twin[h];
		if (g == MR_NONE || (seam && seam[h]))
			continue;
		mr_sets_join(set, h, mr_he_next(g));
		mr_sets_join(set, mr_he_next(h), g);
	}
	for (uint32_t h = 0; h < n; h++)
		if (mr_sets_root(set, h) == h) {
			number[h] = (uint32_t)nv;
			p[nv++] = m->p[mr_he_from(m, h)];
		}
	for (uint32_t h = 0; h < n; h++)
		t[h / 3].v[h % 3] = number[mr_sets_root(set, h)];
	*cut = (mr_mesh){ m->name, p, t, nv, m->nf };
	return mr_topology_build(ctx, cut, topo);
}

/* Whether a place is at the end of its side. */
static bool
is_at_rim(const corner_job *j, mr_place at)
{
	const double bary[3] = { at.bary.x, at.bary.y, at.bary.z };

	for (uint32_t k = 0; k < 3; k++)
		if (bary[k] == 0 && j->topo.twin[3 * at.face + (k + 1) % 3] == MR_NONE)
			return true;
	return false;
}

/* The place of corner c: its own, which is on its side; but a walk may end before the nearest place, and then
 * another corner's of the side, or the vertex's off seams. */
static mr_place
choose(const corner_job *j, uint32_t c, uint32_t best)
{
	uint32_t v = mr_he_from(j->s->after, c);
	mr_place at = mr_places_at(&j->s->place, v);
	const double little = 1.001, rounding = 1e-9;
	double far = mr_dist(mr_place_point(j->s->before, at), j->s->after->p[v]);
	double none = rounding * mr_dist(j->s->after->p[v], j->s->after->p[mr_he_to(j->s->after, c)]);

	if (j->s->face && !j->s->seam_after && is_at_rim(j, j->at[c].at))
		return j->at[c].at;
	if (j->sides[v] > 1 || sqrt(j->at[best].dist2) <= little * far) {
		at = j->at[best].at;
		far = sqrt(j->at[best].dist2);
	}
	return sqrt(j->at[c].dist2) <= little * far + none ? j->at[c].at : at;
}

/* Cuts both along the seams, and finds the faces. */
static mr_status
set_up(mr_ctx *ctx, corner_job *j)
{
	const mr_successor *s = j->s;
	mr_topology after;
	uint32_t *sides = MR_NEW_ZERO(ctx, s->after->nv, uint32_t);
	bool *met, *off = MR_NEW(ctx, s->after->nv, bool);

	MR_TRY(cut_seams(ctx, s->before, s->seam, &j->cut, &j->topo));
	MR_TRY(cut_seams(ctx, s->after, s->seam_after, &j->sides_of, &after));
	met = MR_NEW_ZERO(ctx, j->sides_of.nv, bool);
	for (uint32_t c = 0; c < 3 * s->after->nf; c++) {
		bool *m = &met[mr_he_from(&j->sides_of, c)];
		sides[mr_he_from(s->after, c)] += !*m;
		*m = true;
	}
	memset(off, true, s->after->nv * sizeof *off);
	for (uint32_t h = 0; s->seam_after && h < 3 * s->after->nf; h++)
		if (s->seam_after[h])
			off[mr_he_from(s->after, h)] = off[mr_he_to(s->after, h)] = false;
	j->sides = sides;
	j->off = off;
	j->face = MR_NEW(ctx, s->after->nf, uint32_t);
	if (s->face)
		memcpy(j->face, s->face, s->after->nf * sizeof *j->face);
	else
		find_faces(ctx, j, &after);
	return MR_OK;
}

/* The places of the corners of `after`. */
static mr_rows_from
find_corners(mr_ctx *ctx, corner_job *j)
{
	const mr_successor *s = j->s;
	size_t n = 3 * s->after->nf;
	uint32_t *parent = MR_NEW(ctx, 3 * n, uint32_t), *best = MR_NEW(ctx, n, uint32_t);
	double *weight = MR_NEW(ctx, 3 * n, double);

	j->at = mr_alloc(ctx, n, sizeof *j->at);
	mr_parallel(ctx, n, 1024, place_corners, j);
	memset(best, 0xff, n * sizeof *best);
	for (uint32_t c = 0; c < n; c++) {
		uint32_t *b = &best[mr_he_from(&j->sides_of, c)];
		*b = *b == MR_NONE || j->at[c].dist2 < j->at[*b].dist2 ? c : *b;
	}
	for (uint32_t c = 0; c < n; c++) {
		mr_place at = choose(j, c, best[mr_he_from(&j->sides_of, c)]);
		for (uint32_t k = 0; k < 3; k++)
			parent[3 * c + k] = 3 * at.face + k;
		memcpy(weight + 3 * c, &at.bary, sizeof at.bary);
	}
	return (mr_rows_from){ n, 3, parent, weight };
}

/* ---- columns ---- */

static mr_rows_from
find_vertices(mr_ctx *ctx, const mr_successor *s)
{
	size_t n = s->after->nv;
	uint32_t *parent = MR_NEW(ctx, 3 * n, uint32_t);

	for (size_t v = 0; v < n; v++)
		memcpy(parent + 3 * v, s->before->t[s->place.face[v]].v, 3 * sizeof *parent);
	return (mr_rows_from){ n, 3, parent, (const double *)s->place.bary };
}

/* Found anew, or of no use to other triangles. */
static const char *const BUT[] = { "polygon", "normal", "corner_normal", NULL };

bool
mr_layer_carries(const mr_frame *f, const char *layer)
{
	return mr_columns_go_along(f, layer, BUT);
}

typedef struct making {
	corner_job j;
	mr_rows_from vertices, corners;
} making;

static mr_status
make(void *arg, mr_ctx *ctx, mr_carried *c)
{
	making *m = arg;
	const mr_mesh *after = m->j.s->after;

	if (c->shape.element == 'v') {
		m->vertices = m->vertices.n ? m->vertices : find_vertices(ctx, m->j.s);
		mr_carried_make(ctx, c, 1, 0, m->vertices);
		return MR_OK;
	}
	if (!m->j.face)
		MR_TRY(set_up(ctx, &m->j));
	if (is_of_corners(c)) {
		m->corners = m->corners.n ? m->corners : find_corners(ctx, &m->j);
		mr_carried_make(ctx, c, 3, 0, m->corners);
	} else {
		c->kind = MR_LABEL;
		mr_carried_make(ctx, c, 1, 0, (mr_rows_from){ after->nf, 1, m->j.face, NULL });
	}
	return MR_OK;
}

mr_status
mr_carry_columns(mr_ctx *ctx, mr_frame *f, const mr_successor *s, mr_carried **list, size_t *count)
{
	const mr_mesh *m = s->before, *n = s->after;
	making made = { .j.s = s };

	return mr_columns_descend(
	    ctx, f, m->name, &(mr_descent){ m->nv, m->nf, n->nv, n->nf, BUT, make, &made }, list, count);
}

typedef struct nearest_job {
	const mr_bvh *bvh;
	const mr_mesh *before, *after;
	const mr_v3 *normal; /* of each vertex of after */
	uint32_t *vertex_face, *face;
	mr_v3 *bary;
} nearest_job;

/* The place nearest to p; where that faces away from n, as the far side of a thin wall does, one in front of
 * it that does not, if there is one. */
static mr_place
nearest_place(const nearest_job *j, mr_v3 p, mr_v3 n)
{
	mr_closest c = mr_bvh_closest(j->bvh, p), other;
	double length = mr_norm(n);

	if (mr_dot(mr_face_cross(j->before, c.at.face), n) >= 0)
		return c.at;
	other = mr_bvh_closest(j->bvh, mr_axpy(2 * sqrt(c.dist2) / length, n, p));
	if (mr_dot(mr_face_cross(j->before, other.at.face), n) <= 0)
		return c.at;
	return mr_face_closest(j->before, other.at.face, p).at;
}

static void
place_vertices(void *arg, size_t begin, size_t end)
{
	const nearest_job *j = arg;

	for (size_t v = begin; v < end; v++) {
		mr_place at = nearest_place(j, j->after->p[v], j->normal[v]);
		j->vertex_face[v] = at.face;
		j->bary[v] = at.bary;
	}
}

static void
place_middles(void *arg, size_t begin, size_t end)
{
	const nearest_job *j = arg;

	for (size_t f = begin; f < end; f++)
		j->face[f] = nearest_place(j, middle_of(j->after, f), mr_face_cross(j->after, f)).face;
}

mr_status
mr_carry_nearest(
    mr_ctx *ctx, mr_frame *f, const mr_mesh *before, const mr_mesh *after, mr_carried **list, size_t *count)
{
	enum { GRAIN = 256 };
	nearest_job j = { .before = before, .after = after };
	mr_v3 *normal = MR_NEW(ctx, after->nv, mr_v3);
	mr_successor s = { .before = before, .after = after };
	mr_bvh *bvh;
	uint8_t *seam;

	MR_TRY(mr_layer_seams(ctx, f, before, &seam));
	s.seam = seam;

	mr_bvh_build(ctx, before, &bvh);
	j.bvh = bvh;
	mr_vertex_normals(after, normal);
	j.normal = normal;
	j.vertex_face = MR_NEW(ctx, after->nv, uint32_t);
	j.bary = MR_NEW(ctx, after->nv, mr_v3);
	j.face = MR_NEW(ctx, after->nf, uint32_t);
	mr_parallel(ctx, after->nv, GRAIN, place_vertices, &j);
	mr_parallel(ctx, after->nf, GRAIN, place_middles, &j);
	s.face = j.face;
	s.place = (mr_places){ j.vertex_face, j.bary };
	return mr_carry_columns(ctx, f, &s, list, count);
}
