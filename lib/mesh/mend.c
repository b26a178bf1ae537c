/* Rows of vertices, faces and corners follow those that are left. */
#include "mesh/mend.h"

#include "mesh/subset.h"

/* ---- weld ---- */

static bool
proper(mr_tri t)
{
	return t.v[0] != t.v[1] && t.v[1] != t.v[2] && t.v[2] != t.v[0];
}

/* How many vertices have another row than the one that stands for them. */
static size_t
count_others(const mr_column *c, const uint32_t *map, const uint32_t *of)
{
	size_t n = 0, bytes = c->shape.components * mr_type_size(c->shape.type);
	const char *row = c->data;

	for (size_t i = 0; i < c->rows; i++)
		n += memcmp(row + bytes * i, row + bytes * of[map[i]], bytes) != 0;
	return n;
}

mr_status
mr_layer_to_corners(mr_ctx *ctx, mr_frame *f, const mr_mesh *m, const char *name)
{
	mr_column vertex = *mr_frame_find(f, m->name, name);
	const char *to = mr_format(ctx, "corner_%s", name);
	size_t bytes = vertex.shape.components * sizeof(double);
	char *corner = mr_alloc(ctx, 3 * m->nf, bytes);

	MR_TRY(mr_column_decode(ctx, &vertex));
	for (size_t c = 0; c < 3 * m->nf; c++)
		memcpy(corner + bytes * c, (const char *)vertex.data + bytes * m->t[c / 3].v[c % 3], bytes);
	mr_frame_drop(f, m->name, name, 0);
	return mr_layer_put(ctx, f, m->name, to, corner, m->nf);
}

/* Values that differ between merged vertices become the corners', or the first vertex's counts. */
static mr_status
keep_differences(mr_ctx *ctx, mr_frame *f, const mr_mesh *m, const uint32_t *map, const uint32_t *of)
{
	for (size_t i = f->count; i-- > 0;) {
		mr_column *c = &f->columns[i];
		bool normal = !strcmp(c->name, "normal"), texcoord = !strcmp(c->name, "texcoord");
		size_t others;
		if (strcmp(c->layer, m->name) || c->shape.element != 'v' || !strcmp(c->name, "position"))
			continue;
		MR_TRY(mr_column_decode(ctx, c));
		others = count_others(c, map, of);
		if (others && m->nf && (normal || texcoord))
			MR_TRY(mr_layer_to_corners(ctx, f, m, normal ? "normal" : "texcoord"));
		else
			mr_lost(ctx, NULL, others, mr_format(ctx, "%s of joined vertices", c->name));
	}
	return MR_OK;
}

/* Faces by their new vertices, without those that had three corners and have not now. */
static mr_status
rename_faces(mr_ctx *ctx, mr_frame *f, const mr_mesh *m, const uint32_t *map, double eps)
{
	mr_tri *t = MR_NEW(ctx, m->nf, mr_tri);
	uint32_t *of = MR_NEW(ctx, m->nf, uint32_t);
	size_t kept = 0;

	for (size_t i = 0; i < m->nf; i++) {
		const uint32_t *v = m->t[i].v;
		t[kept] = (mr_tri){ { map[v[0]], map[v[1]], map[v[2]] } };
		of[kept] = (uint32_t)i;
		kept += proper(t[kept]) || !proper(m->t[i]);
	}
	if (kept == 0)
		return mr_fail(ctx, MR_EMESH, "welding within %g leaves no face of %zu", eps, m->nf);
	mr_lost(ctx, NULL, m->nf - kept, "faces that welding collapses");
	MR_TRY(mr_layer_gather(ctx, f, m->name, 'f', of, kept));
	return mr_layer_put(ctx, f, m->name, "triangles", t, kept);
}

mr_status
mr_layer_weld(mr_ctx *ctx, mr_frame *f, const char *layer, double eps, const bool *may, size_t *joined)
{
	uint32_t *map, *of;
	size_t n = 0, next = 0;
	mr_mesh m;

	MR_TRY(mr_layer_surface_or_points_of_any_size(ctx, f, layer, &m));
	map = MR_NEW(ctx, m.nv, uint32_t);
	of = MR_NEW(ctx, m.nv, uint32_t);
	mr_weld_some(ctx, m.p, m.nv, eps, may, map, &n);
	for (size_t i = 0; i < m.nv; i++)
		if (map[i] == next)
			of[next++] = (uint32_t)i;
	*joined = m.nv - n;
	MR_TRY(keep_differences(ctx, f, &m, map, of));
	MR_TRY(mr_layer_gather(ctx, f, layer, 'v', of, n));
	return m.nf ? rename_faces(ctx, f, &m, map, eps) : MR_OK;
}

/* ---- repair ---- */

/* Columns of corners, in the order of the corners that the faces have now; normals of an inconsistently
 * oriented file are ignored. */
static mr_status
turn_corners(mr_ctx *ctx, mr_frame *f, const mr_mesh *m, const bool *flipped)
{
	uint32_t *of = MR_NEW(ctx, 3 * m->nf, uint32_t);

	for (uint32_t i = 0; i < 3 * m->nf; i++)
		of[i] = flipped[i / 3] && i % 3 ? i / 3 * 3 + 3 - i % 3 : i;
	for (size_t i = 0; i < f->count; i++) {
		mr_carried c;
		if (strcmp(f->columns[i].layer, m->name) || strcmp(f->columns[i].name, "corner_texcoord"))
			continue;
		MR_TRY(mr_carried_begin(ctx, f, i, m->nf, m->nf, &c));
		c.kind = MR_LABEL;
		mr_carried_make(ctx, &c, 3, 0, (mr_rows_from){ 3 * m->nf, 1, of, NULL });
		MR_TRY(mr_carried_put(ctx, f, m->name, &c, 1));
	}
	mr_lost(ctx, m->name, mr_layer_has(f, m->name, "normal") || mr_layer_has(f, m->name, "corner_normal"),
	    "normals of a surface whose faces are turned");
	mr_frame_drop(f, m->name, "normal", 0);
	mr_frame_drop(f, m->name, "corner_normal", 0);
	return MR_OK;
}

mr_status
mr_layer_repair(mr_ctx *ctx, mr_frame *f, const char *layer, mr_repair_report *r)
{
	const uint32_t *vertex_of, *face_of;
	mr_mesh in, out;
	bool *flipped;

	MR_TRY(mr_layer_mesh_of_any_size(ctx, f, layer, &in));
	MR_TRY(mr_repair(ctx, &in, &out, &vertex_of, &face_of, r));
	out.name = layer;
	flipped = MR_NEW(ctx, out.nf, bool);
	for (size_t i = 0; i < out.nf; i++)
		flipped[i] = vertex_of[out.t[i].v[1]] != in.t[face_of[i]].v[1];
	MR_TRY(mr_layer_gather(ctx, f, layer, 'v', vertex_of, out.nv));
	MR_TRY(mr_layer_gather(ctx, f, layer, 'f', face_of, out.nf));
	MR_TRY(mr_layer_put(ctx, f, layer, "position", out.p, out.nv));
	MR_TRY(mr_layer_put(ctx, f, layer, "triangles", out.t, out.nf));
	return r->flipped ? turn_corners(ctx, f, &out, flipped) : MR_OK;
}

mr_status
mr_layer_turn(mr_ctx *ctx, mr_frame *f, const char *layer, const bool *turned)
{
	mr_tri *t;
	mr_mesh m;

	MR_TRY(mr_layer_mesh_of_any_size(ctx, f, layer, &m));
	t = MR_NEW(ctx, m.nf, mr_tri);
	for (size_t i = 0; i < m.nf; i++) {
		const uint32_t *v = m.t[i].v;
		t[i] = (mr_tri){ { v[0], v[turned[i] ? 2 : 1], v[turned[i] ? 1 : 2] } };
	}
	MR_TRY(mr_layer_put(ctx, f, layer, "triangles", t, m.nf));
	return turn_corners(ctx, f, &m, turned);
}
