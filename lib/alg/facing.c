#include "alg/facing.h"

static const double FOLD_COSINE = -0.984807753012208; /* of 170 degrees */
static const double SNAP = 1e-9;                      /* of a barycentric coordinate: on an edge or vertex */

mr_status
mr_facing_begin(mr_ctx *ctx, const mr_mesh *source, const mr_topology *topo, mr_facing *out)
{
	mr_v3 *normal = MR_NEW(ctx, source->nv, mr_v3);

	if (!normal)
		return MR_EMEM;
	MR_TRY(mr_vertex_normals(ctx, source, normal));
	*out = (mr_facing){ source, topo, normal };
	return MR_OK;
}

mr_v3
mr_facing_normal(const mr_facing *s, uint32_t face, mr_v3 bary)
{
	const double w[3] = { bary.x, bary.y, bary.z };
	mr_v3 n = mr_unit(mr_face_cross(s->m, face));

	for (uint32_t k = 0; k < 3; k++)
		if (w[k] >= 1 - SNAP)
			return s->normal[s->m->t[face].v[k]];
	for (uint32_t k = 0; k < 3; k++) {
		uint32_t twin = s->topo->twin[3 * face + (k + 1) % 3]; /* opposite corner k */
		if (w[k] <= SNAP && twin != MR_NONE)
			return mr_add(n, mr_unit(mr_face_cross(s->m, twin / 3)));
	}
	return n;
}

size_t
mr_count_flipped(const mr_facing *s, const mr_mesh *m, const mr_source_map *map)
{
	size_t flipped = 0;

	for (size_t f = 0; f < m->nf; f++) {
		mr_v3 cross = mr_face_cross(m, f);
		unsigned against = 0;
		for (int k = 0; k < 3; k++) {
			uint32_t v = m->t[f].v[k];
			against += mr_dot(cross, mr_facing_normal(s, map->face[v], map->bary[v])) < 0;
		}
		flipped += against == 3;
	}
	return flipped;
}

size_t
mr_count_folded(const mr_mesh *m, const uint32_t *twin)
{
	size_t folded = 0;

	for (uint32_t h = 0; h < 3 * m->nf; h++)
		if (twin[h] != MR_NONE && h < twin[h])
			folded += mr_dot(mr_unit(mr_face_cross(m, h / 3)),
				      mr_unit(mr_face_cross(m, twin[h] / 3))) < FOLD_COSINE;
	return folded;
}
