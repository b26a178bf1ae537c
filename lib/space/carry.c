/* Columns go along by places: where vertices and corners of the new surface are on the old one. */
#include "space/carry.h"

#include "base/disjoint_sets.h"
#include "base/parallel.h"
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
mr_layer_seams(mr_ctx *ctx, mr_frame *f, const mr_mesh *m, const mr_topology *topo, uint8_t **seam)
{
	uint8_t *mark = MR_NEW_ZERO(ctx, 3 * m->nf, uint8_t);
	bool any = false;

	for (size_t i = 0; i < f->count; i++) {
		mr_column *c = &f->columns[i];
		if (strcmp(c->layer, m->name) || c->rows != m->nf)
			continue;
		MR_TRY(mr_column_decode(ctx, c));
		if (!strcmp(c->name, "corner_texcoord"))
			mark_jumps(m, topo, c, mark);
		else if (c->shape.type == 'u' && is_bordered(c->name))
			mark_borders(m, topo, c, mark);
	}
	for (size_t h = 0; h < 3 * m->nf; h++)
		any |= mark[h];
	*seam = any ? mark : NULL;
	return MR_OK;
}

/* ---- corners ---- */

typedef struct corner_job {
	const mr_successor *s;
	mr_mesh cut; /* before, its vertices apart along the seams */
	mr_topology topo;
	mr_closest *at; /* of each corner of after, on its own face's side */
} corner_job;

static void
place_corners(void *arg, size_t begin, size_t end)
{
	corner_job *j = arg;
	const mr_mesh *m = j->s->after;

	for (size_t c = begin; c < end; c++)
		j->at[c] = mr_project_walk(&j->cut, &j->topo, j->s->face[c / 3], m->p[m->t[c / 3].v[c % 3]]);
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

/* The place of corner c: its own, which is on its side; but a walk may end before the nearest place, and then
 * that of another corner of the side, or of the vertex where no seam is. */
static mr_place
choose(const corner_job *j, uint32_t c, uint32_t best, bool on_seam)
{
	uint32_t v = mr_he_from(j->s->after, c);
	mr_place at = mr_places_at(&j->s->place, v);
	double far = mr_dist(mr_place_point(j->s->before, at), j->s->after->p[v]), little = 1.001;

	if (on_seam || sqrt(j->at[best].dist2) <= little * far)
		at = j->at[best].at;
	return sqrt(j->at[c].dist2) <= little * (on_seam ? sqrt(j->at[best].dist2) : far) ? j->at[c].at : at;
}

/* Where the corners of `after` are. */
static mr_status
find_corners(mr_ctx *ctx, const mr_successor *s, mr_rows_from *rows)
{
	size_t n = 3 * s->after->nf;
	uint32_t *parent = MR_NEW(ctx, 3 * n, uint32_t), *best = MR_NEW(ctx, n, uint32_t);
	uint32_t *sides = MR_NEW_ZERO(ctx, s->after->nv, uint32_t);
	double *weight = MR_NEW(ctx, 3 * n, double);
	corner_job j = { .s = s, .at = mr_alloc(ctx, n, sizeof *j.at) };
	mr_topology topo;
	mr_mesh cut;

	MR_TRY(cut_seams(ctx, s->before, s->seam, &j.cut, &j.topo));
	MR_TRY(cut_seams(ctx, s->after, s->seam_after, &cut, &topo));
	mr_parallel(ctx, n, 1024, place_corners, &j);
	memset(best, 0xff, n * sizeof *best);
	for (uint32_t c = 0; c < n; c++) {
		uint32_t *b = &best[cut.t[c / 3].v[c % 3]];
		sides[mr_he_from(s->after, c)] += *b == MR_NONE;
		*b = *b == MR_NONE || j.at[c].dist2 < j.at[*b].dist2 ? c : *b;
	}
	for (uint32_t c = 0; c < n; c++) {
		mr_place at = choose(&j, c, best[cut.t[c / 3].v[c % 3]], sides[mr_he_from(s->after, c)] > 1);
		for (uint32_t k = 0; k < 3; k++)
			parent[3 * c + k] = 3 * at.face + k;
		memcpy(weight + 3 * c, &at.bary, sizeof at.bary);
	}
	*rows = (mr_rows_from){ n, 3, parent, weight };
	return MR_OK;
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
	const mr_successor *s;
	mr_rows_from vertices, corners, faces;
} making;

static mr_status
make(void *arg, mr_ctx *ctx, mr_carried *c)
{
	making *m = arg;

	if (c->shape.element == 'v') {
		m->vertices = m->vertices.n ? m->vertices : find_vertices(ctx, m->s);
		mr_carried_make(ctx, c, 1, 0, m->vertices);
	} else if (is_of_corners(c)) {
		if (!m->corners.n)
			MR_TRY(find_corners(ctx, m->s, &m->corners));
		mr_carried_make(ctx, c, 3, 0, m->corners);
	} else {
		c->kind = MR_LABEL;
		mr_carried_make(ctx, c, 1, 0, m->faces);
	}
	return MR_OK;
}

mr_status
mr_carry_columns(mr_ctx *ctx, mr_frame *f, const mr_successor *s, mr_carried **list, size_t *count)
{
	const mr_mesh *m = s->before, *n = s->after;
	making made = { .s = s, .faces = { n->nf, 1, s->face, NULL } };

	return mr_columns_descend(
	    ctx, f, m->name, &(mr_descent){ m->nv, m->nf, n->nv, n->nf, BUT, make, &made }, list, count);
}
