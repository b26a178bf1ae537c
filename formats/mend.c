/* Models mended: welding and repair, all that vertices, faces and corners have carried along. */
#include "formats/build.h"
#include "formats/model.h"
#include "mesh/polygon.h"
#include "mesh/repair.h"

/* ---- materials ---- */

/* Marks the numbers of these faces. */
static void
mark_numbers(const uint32_t *number, const uint32_t *face, size_t n, bool *marked)
{
	for (size_t i = 0; i < n; i++)
		marked[number[face ? face[i] : i]] = true;
}

/* How many numbers of faces there are no more, and which is the first; those are below `most`. */
static mr_status
count_lost(mr_ctx *ctx, const uint32_t *number, size_t nf, const uint32_t *face_of, size_t kept, size_t most,
    size_t *lost, size_t *first)
{
	bool *before = MR_NEW_ZERO(ctx, most, bool), *after = MR_NEW_ZERO(ctx, most, bool);

	if (!before || !after)
		return MR_EMEM;
	mark_numbers(number, NULL, nf, before);
	mark_numbers(number, face_of, kept, after);
	*lost = 0;
	for (size_t i = most; i-- > 0;)
		if (before[i] && !after[i]) {
			*first = i;
			++*lost;
		}
	return MR_OK;
}

static size_t
highest(const uint32_t *number, size_t n)
{
	uint32_t most = 0;

	for (size_t i = 0; i < n; i++)
		most = number[i] > most ? number[i] : most;
	return most;
}

/* Materials that no face has any more, where only these are kept. */
static mr_status
warn_of_materials(mr_ctx *ctx, const char *step, const mr_model *m, const uint32_t *face_of, size_t kept)
{
	size_t lost, first, names;
	const char **start;
	bool named;

	if (!m->material)
		return MR_OK;
	MR_TRY(count_lost(
	    ctx, m->material, m->nf, face_of, kept, highest(m->material, m->nf) + 1, &lost, &first));
	if (lost == 0)
		return MR_OK;
	MR_TRY(mr_lines_starts(ctx, m->materials, &start, &names));
	named = first < names;
	mr_warn(ctx, "%s: %zu material%s no face any more, the first of them %.*s", step, lost,
	    lost == 1 ? " has" : "s have", named ? (int)(start[first + 1] - start[first]) - 1 : 0,
	    named ? start[first] : "");
	return MR_OK;
}

/* ---- weld ---- */

static bool
proper(mr_tri t)
{
	return t.v[0] != t.v[1] && t.v[1] != t.v[2] && t.v[2] != t.v[0];
}

/* Faces by their new vertices, without those that had three corners and have not now. */
static mr_status
rename_faces(mr_ctx *ctx, const uint32_t *map, mr_model *m)
{
	mr_tri *t = MR_NEW(ctx, m->nf, mr_tri);
	uint32_t *of = MR_NEW(ctx, m->nf, uint32_t);
	size_t kept = 0;

	if (!t || !of)
		return MR_EMEM;
	for (size_t f = 0; f < m->nf; f++) {
		const uint32_t *v = m->t[f].v;
		mr_tri now = { { map[v[0]], map[v[1]], map[v[2]] } };
		if (!proper(now) && proper(m->t[f]))
			continue;
		t[kept] = now;
		of[kept++] = (uint32_t)f;
	}
	m->counts.weld_collapsed = m->nf - kept;
	if (kept < m->nf) {
		mr_warn(ctx, "weld: %zu of %zu faces collapse, and are left out", m->nf - kept, m->nf);
		MR_TRY(warn_of_materials(ctx, "weld", m, of, kept));
	}
	MR_TRY(mr_model_gather(ctx, m, true, of, kept));
	m->t = t;
	m->nf = kept;
	return MR_OK;
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

static void
warn_of_joined(mr_ctx *ctx, const char *what, size_t n)
{
	if (n)
		mr_warn(ctx, "weld: %zu vertices take the %s of those they are joined to", n, what);
}

/* The values of vertices as those of the corners there. */
static mr_status
to_corners(mr_ctx *ctx, const mr_model *m, const void *vertex, size_t bytes, const void **corner)
{
	*corner = mr_gather(ctx, vertex, bytes, m->t->v, 3 * m->nf);
	return *corner ? MR_OK : MR_EMEM;
}

/*
 * What differs between vertices that become one: texture coordinates and normals are those of the corners
 * from now on, else the first vertex's count.
 */
static mr_status
keep_differences(mr_ctx *ctx, const uint32_t *map, const uint32_t *of, mr_model *m)
{
	const void *corner;

	if (m->nf && m->texcoord && count_others(m->texcoord, 2 * sizeof *m->texcoord, map, of, m->nv)) {
		MR_TRY(to_corners(ctx, m, m->texcoord, 2 * sizeof *m->texcoord, &corner));
		m->corner_texcoord = corner;
		m->texcoord = NULL;
	}
	if (m->nf && m->normal && count_others(m->normal, sizeof *m->normal, map, of, m->nv)) {
		MR_TRY(to_corners(ctx, m, m->normal, sizeof *m->normal, &corner));
		m->corner_normal = corner;
		m->normal = NULL;
	}
	if (m->color)
		warn_of_joined(ctx, "color", count_others(m->color, 4, map, of, m->nv));
	for (size_t i = 0; i < m->properties; i++) {
		const mr_property *p = &m->property[i];
		if (p->shape.element == 'v')
			warn_of_joined(
			    ctx, p->name, count_others(p->data, mr_type_size(p->shape.type), map, of, m->nv));
	}
	return MR_OK;
}

mr_status
mr_model_weld(mr_ctx *ctx, double eps, mr_model *m)
{
	mr_model w = *m;
	uint32_t *map = MR_NEW(ctx, m->nv, uint32_t), *of = MR_NEW(ctx, m->nv, uint32_t);
	size_t n = 0, next = 0;

	if (!map || !of)
		return MR_EMEM;
	MR_TRY(mr_weld(ctx, m->p, m->nv, eps, map, &n));
	for (size_t i = 0; i < m->nv; i++)
		if (map[i] == next)
			of[next++] = (uint32_t)i;
	w.counts.weld_joined = m->nv - n;
	mr_note(ctx, "weld: %zu vertices joined to others", m->nv - n);
	MR_TRY(keep_differences(ctx, map, of, &w));
	MR_TRY(mr_model_gather(ctx, &w, false, of, n));
	if (!(w.p = mr_gather(ctx, m->p, sizeof *m->p, of, n)))
		return MR_EMEM;
	w.nv = n;
	if (m->nf)
		MR_TRY(rename_faces(ctx, map, &w));
	if (m->nf && w.nf == 0)
		return mr_fail(ctx, MR_EMESH, "welding within %g leaves no face of %zu", eps, m->nf);
	*m = w;
	return MR_OK;
}

/* ---- repair ---- */

static void
report(mr_ctx *ctx, const mr_repair_report *r, mr_import_result *counts)
{
	const struct {
		size_t *to, count;
		const char *what;
	} lines[] = { { &counts->repair_degenerate, r->degenerate, "degenerate faces dropped" },
		{ &counts->repair_duplicate, r->duplicate, "duplicate faces dropped" },
		{ &counts->repair_isolated, r->isolated, "isolated vertices dropped" },
		{ &counts->repair_split_edges, r->split_edges, "edges of more than two faces split" },
		{ &counts->repair_split_vertices, r->split_vertices,
		    "vertices added where fans were parted" },
		{ &counts->repair_flipped, r->flipped, "faces turned over" },
		{ &counts->repair_cut_edges, r->cut_edges, "edges cut" } };

	for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
		*lines[i].to = lines[i].count;
		if (lines[i].count)
			mr_note(ctx, "repair: %zu %s", lines[i].count, lines[i].what);
	}
}

/* Values of corners in the order of the corners that the faces have now. */
static mr_status
turn_corners(mr_ctx *ctx, const void **corner, size_t bytes, const bool *flipped, size_t nf)
{
	uint32_t *of = MR_NEW(ctx, 3 * nf, uint32_t);

	if (!*corner)
		return MR_OK;
	if (!of)
		return MR_EMEM;
	for (uint32_t i = 0; i < 3 * nf; i++)
		of[i] = flipped[i / 3] && i % 3 ? i / 3 * 3 + 3 - i % 3 : i;
	*corner = mr_gather(ctx, *corner, bytes, of, 3 * nf);
	return *corner ? MR_OK : MR_EMEM;
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

	if (!surface || !normal || !corner || !touched)
		return MR_EMEM;
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

	MR_TRY(turn_corners(ctx, &texcoord, 2 * sizeof(double), flipped, m->nf));
	MR_TRY(turn_corners(ctx, &normal, sizeof(mr_v3), flipped, m->nf));
	done->corner_texcoord = texcoord;
	done->corner_normal = normal;
	return done->normal || normal ? turn_normals(ctx, m, flipped, done) : MR_OK;
}

/* Faces with an area that go, all of them copies, and materials that no face has any more. */
static mr_status
warn_of_dropped(
    mr_ctx *ctx, const mr_model *m, const uint32_t *face_of, size_t kept, const mr_repair_report *r)
{
	if (r->duplicate)
		mr_warn(ctx, "repair: %zu face%s left out, with the corners of earlier ones", r->duplicate,
		    r->duplicate == 1 ? " is" : "s are");
	return r->duplicate + r->degenerate ? warn_of_materials(ctx, "repair", m, face_of, kept) : MR_OK;
}

/* Polygons that edges are parted in, and those that lose triangles, and so corners. */
static mr_status
warn_of_polygons(mr_ctx *ctx, const mr_model *m, const mr_model *done)
{
	size_t most, *had, *has, cut, less = 0;
	mr_polygons before, after;

	if (!m->polygon)
		return MR_OK;
	most = highest(m->polygon, m->nf) + 1;
	had = MR_NEW_ZERO(ctx, most, size_t);
	has = MR_NEW_ZERO(ctx, most, size_t);
	if (!had || !has)
		return MR_EMEM;
	MR_TRY(mr_polygons_find(ctx, m->t, m->nf, m->polygon, &before));
	MR_TRY(mr_polygons_find(ctx, done->t, done->nf, done->polygon, &after));
	cut = after.broken > before.broken ? after.broken - before.broken : 0;
	for (size_t f = 0; f < m->nf; f++)
		had[m->polygon[f]]++;
	for (size_t f = 0; f < done->nf; f++)
		has[done->polygon[f]]++;
	for (size_t i = 0; i < most; i++)
		less += has[i] && has[i] < had[i];
	if (cut)
		mr_warn(
		    ctx, "repair: %zu polygon%s cut, and will be triangles", cut, cut == 1 ? " is" : "s are");
	if (less)
		mr_warn(ctx, "repair: %zu polygon%s corners, at triangles without area", less,
		    less == 1 ? " loses" : "s lose");
	return MR_OK;
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
	MR_TRY(mr_model_gather(ctx, &done, false, vertex_of, out.nv));
	MR_TRY(mr_model_gather(ctx, &done, true, face_of, out.nf));
	if (!(flipped = MR_NEW(ctx, out.nf, bool)))
		return MR_EMEM;
	for (size_t f = 0; f < out.nf; f++)
		flipped[f] = vertex_of[out.t[f].v[1]] != m->t[face_of[f]].v[1];
	if (r.flipped)
		MR_TRY(follow_flips(ctx, &out, flipped, &done));
	done.p = out.p;
	done.nv = out.nv;
	done.t = out.t;
	done.nf = out.nf;
	report(ctx, &r, &done.counts);
	MR_TRY(warn_of_dropped(ctx, m, face_of, out.nf, &r));
	MR_TRY(warn_of_polygons(ctx, m, &done));
	*m = done;
	return MR_OK;
}
