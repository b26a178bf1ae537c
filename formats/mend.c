/* Models mended: welding and repair, all that vertices, faces and corners have carried along. */
#include "formats/build.h"
#include "formats/model.h"
#include "mesh/repair.h"

/* ---- weld ---- */

static bool
proper(mr_tri t)
{
	return t.v[0] != t.v[1] && t.v[1] != t.v[2] && t.v[2] != t.v[0];
}

/* Faces by their new vertices, without those that had three corners and have not now. */
static void
rename_faces(mr_ctx *ctx, const uint32_t *map, mr_model *m)
{
	mr_tri *t = MR_NEW(ctx, m->nf, mr_tri);
	uint32_t *of = MR_NEW(ctx, m->nf, uint32_t);
	size_t kept = 0;

	for (size_t f = 0; f < m->nf; f++) {
		const uint32_t *v = m->t[f].v;
		mr_tri now = { { map[v[0]], map[v[1]], map[v[2]] } };
		if (!proper(now) && proper(m->t[f]))
			continue;
		t[kept] = now;
		of[kept++] = (uint32_t)f;
	}
	mr_lost(ctx, NULL, m->nf - kept, "faces that welding collapses");
	mr_model_gather(ctx, m, true, of, kept);
	m->t = t;
	m->nf = kept;
}

/* How many vertices have another row than the one that stands for them. */
static size_t
count_others(const void *column, size_t bytes, const uint32_t *map, const uint32_t *of, size_t nv)
{
	const char *row = column;
	size_t n = 0;

	for (size_t i = 0; i < nv; i++)
		n += memcmp(row + bytes * i, row + bytes * of[map[i]], bytes) != 0;
	return n;
}

/* The values of vertices as those of the corners there. */
static void
to_corners(mr_ctx *ctx, const mr_model *m, const void *vertex, size_t bytes, const void **corner)
{
	*corner = mr_gather(ctx, vertex, bytes, m->t->v, 3 * m->nf);
}

/*
 * What differs between vertices that become one: texture coordinates and normals are those of the corners
 * from now on, else the first vertex's count.
 */
static void
keep_differences(mr_ctx *ctx, const uint32_t *map, const uint32_t *of, mr_model *m)
{
	const void *corner;

	if (m->nf && m->texcoord && count_others(m->texcoord, 2 * sizeof *m->texcoord, map, of, m->nv)) {
		to_corners(ctx, m, m->texcoord, 2 * sizeof *m->texcoord, &corner);
		m->corner_texcoord = corner;
		m->texcoord = NULL;
	}
	if (m->nf && m->normal && count_others(m->normal, sizeof *m->normal, map, of, m->nv)) {
		to_corners(ctx, m, m->normal, sizeof *m->normal, &corner);
		m->corner_normal = corner;
		m->normal = NULL;
	}
	if (m->color)
		mr_lost(ctx, NULL, count_others(m->color, 4, map, of, m->nv), "colors of joined vertices");
	for (size_t i = 0; i < m->properties; i++) {
		const mr_property *p = &m->property[i];
		if (p->shape.element == 'v')
			mr_tell(ctx, MR_LOST,
			    count_others(p->data, mr_type_size(p->shape.type), map, of, m->nv),
			    "%s of joined vertices", p->name);
	}
}

mr_status
mr_model_weld(mr_ctx *ctx, double eps, mr_model *m)
{
	mr_model w = *m;
	uint32_t *map = MR_NEW(ctx, m->nv, uint32_t), *of = MR_NEW(ctx, m->nv, uint32_t);
	size_t n = 0, next = 0;

	mr_weld(ctx, m->p, m->nv, eps, map, &n);
	for (size_t i = 0; i < m->nv; i++)
		if (map[i] == next)
			of[next++] = (uint32_t)i;
	mr_tell(ctx, MR_REPAIRED, m->nv - n, "vertices joined");
	keep_differences(ctx, map, of, &w);
	mr_model_gather(ctx, &w, false, of, n);
	w.p = mr_gather(ctx, m->p, sizeof *m->p, of, n);
	w.nv = n;
	if (m->nf)
		rename_faces(ctx, map, &w);
	if (m->nf && w.nf == 0)
		return mr_fail(ctx, MR_EMESH, "welding within %g leaves no face of %zu", eps, m->nf);
	*m = w;
	return MR_OK;
}

/* ---- repair ---- */

/* One finding, whose words have the counts. */
static void
report(mr_ctx *ctx, const mr_repair_report *r)
{
	const struct {
		size_t count;
		const char *what;
	} lines[] = { { r->degenerate, "degenerate faces" }, { r->duplicate, "duplicate faces" },
		{ r->isolated, "isolated vertices" }, { r->split_edges, "edges split" },
		{ r->split_vertices, "vertices split" }, { r->flipped, "faces turned" },
		{ r->cut_edges, "edges cut" } };
	char what[256] = "";
	size_t n = 0, all = 0;

	for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
		all += lines[i].count;
		if (lines[i].count)
			n += (size_t)snprintf(what + n, sizeof what - n, "%s%zu %s", n ? ", " : "",
			    lines[i].count, lines[i].what);
	}
	mr_tell(ctx, MR_REPAIRED, all, "%s", what);
}

/* Values of corners in the order of the corners that the faces have now. */
static void
turn_corners(mr_ctx *ctx, const void **corner, size_t bytes, const bool *flipped, size_t nf)
{
	uint32_t *of = MR_NEW(ctx, 3 * nf, uint32_t);

	if (!*corner)
		return;
	for (uint32_t i = 0; i < 3 * nf; i++)
		of[i] = flipped[i / 3] && i % 3 ? i / 3 * 3 + 3 - i % 3 : i;
	*corner = mr_gather(ctx, *corner, bytes, of, 3 * nf);
}

/* n, or where it points against the surface, which was turned over there, the other way. */
static mr_v3
facing(mr_v3 n, bool flipped, mr_v3 surface)
{
	return flipped && mr_dot(n, surface) < 0 ? mr_sub(mr_vec(0, 0, 0), n) : n;
}

static mr_status
turn_normals(mr_ctx *ctx, const mr_mesh *m, const bool *flipped, mr_model *done)
{
	mr_v3 *surface = MR_NEW(ctx, m->nv, mr_v3), *normal = MR_NEW(ctx, m->nv, mr_v3),
	      *corner = MR_NEW(ctx, 3 * m->nf, mr_v3);
	bool *touched = MR_NEW_ZERO(ctx, m->nv, bool);

	MR_TRY(mr_vertex_normals(ctx, m, NULL, surface));
	for (size_t i = 0; i < 3 * m->nf; i++) {
		touched[m->t[i / 3].v[i % 3]] |= flipped[i / 3];
		if (done->corner_normal)
			corner[i] = facing(done->corner_normal[i], flipped[i / 3], mr_face_cross(m, i / 3));
	}
	for (size_t v = 0; done->normal && v < m->nv; v++)
		normal[v] = facing(done->normal[v], touched[v], surface[v]);
	done->normal = done->normal ? normal : NULL;
	done->corner_normal = done->corner_normal ? corner : NULL;
	return MR_OK;
}

/* What corners have, and normals, of the faces that were turned over. */
static mr_status
follow_flips(mr_ctx *ctx, const mr_mesh *m, const bool *flipped, mr_model *done)
{
	const void *texcoord = done->corner_texcoord, *normal = done->corner_normal;

	turn_corners(ctx, &texcoord, 2 * sizeof(double), flipped, m->nf);
	turn_corners(ctx, &normal, sizeof(mr_v3), flipped, m->nf);
	done->corner_texcoord = texcoord;
	done->corner_normal = normal;
	return done->normal || normal ? turn_normals(ctx, m, flipped, done) : MR_OK;
}

mr_status
mr_model_repair(mr_ctx *ctx, mr_model *m)
{
	mr_mesh in = { .name = "mesh", .p = m->p, .t = m->t, .nv = m->nv, .nf = m->nf }, out;
	const uint32_t *vertex_of, *face_of;
	mr_repair_report r;
	mr_model done = *m;
	bool *flipped;

	if (m->nf == 0)
		return MR_OK;
	MR_TRY(mr_repair(ctx, &in, &out, &vertex_of, &face_of, &r));
	mr_model_gather(ctx, &done, false, vertex_of, out.nv);
	mr_model_gather(ctx, &done, true, face_of, out.nf);
	flipped = MR_NEW(ctx, out.nf, bool);
	for (size_t f = 0; f < out.nf; f++)
		flipped[f] = vertex_of[out.t[f].v[1]] != m->t[face_of[f]].v[1];
	if (r.flipped)
		MR_TRY(follow_flips(ctx, &out, flipped, &done));
	done.p = out.p;
	done.nv = out.nv;
	done.t = out.t;
	done.nf = out.nf;
	report(ctx, &r);
	*m = done;
	return MR_OK;
}
