/* A packed surface (man/mr-compact.5) for the page, its vertices and faces numbered as the stream has them.
 */
#include "compact/packed.h"
#include "formats/page/library/export.h"
#include "subdivide/displaced.h"

typedef struct unpacked {
	/* For the page to read */
	mr_v3 *position; /* of the control mesh */
	mr_tri *triangles;
	double *height;
	uint8_t (*color)[4];
	size_t heights;
	mr_ctx ctx;
	mr_packed p;
} unpacked;

static void
renumber_control(unpacked *u, const mr_control_order *order)
{
	mr_v3 *position = MR_NEW(&u->ctx, order->m.nv, mr_v3);

	mr_packed_positions(&u->p, position);
	for (size_t v = 0; v < order->m.nv; v++)
		u->position[order->vertex[v]] = position[v];
	for (size_t f = 0; f < order->m.nf; f++)
		for (size_t h = 3 * f; h < 3 * f + 3; h++)
			u->triangles[order->half[h] / 3].v[order->half[h] % 3] =
			    order->vertex[order->m.t[f].v[h % 3]];
}

/* Heights and colours, by the levels of both. */
static mr_status
renumber_fields(unpacked *u, const mr_control_order *order, const uint8_t *crease)
{
	size_t n = u->p.n, nv = u->heights = u->p.level[n].nv;
	mr_mesh control = { "control", u->position, u->triangles, order->m.nv, order->m.nf };
	mr_loop *level = MR_NEW(&u->ctx, n + 1, mr_loop);
	double *height = MR_NEW(&u->ctx, nv, double);
	uint8_t(*color)[4] = mr_alloc(&u->ctx, nv, sizeof *color);
	const uint32_t *origin;

	MR_TRY(mr_loop_levels(&u->ctx, &control, 180, crease, n, level));
	origin = mr_packed_origin(&u->ctx, &level[n], &u->p.level[n], n, order);
	mr_packed_heights(&u->p, n, height);
	if (u->p.fields > 1)
		mr_packed_colors(&u->p, n, color);
	for (size_t v = 0; v < nv; v++) {
		u->height[origin[v]] = height[v];
		memcpy(u->color[origin[v]], color[v], sizeof *color);
	}
	return MR_OK;
}

/* Expands the first half-edge of each face to all three. */
static const uint32_t *
all_halves(mr_ctx *ctx, const uint32_t *first, size_t nf)
{
	uint32_t *half = MR_NEW(ctx, 3 * nf, uint32_t);

	for (size_t h = 0; h < 3 * nf; h++)
		half[h] = first[h / 3] / 3 * 3 + (first[h / 3] + (uint32_t)(h % 3)) % 3;
	return half;
}

static mr_status
unpack(unpacked *u, mr_packed_bytes file, mr_control_order *order, const uint8_t *crease)
{
	mr_packed_bytes bits;
	size_t missing, nv;

	MR_TRY(mr_packed_open(&u->ctx, file, &u->p, &bits, &missing));
	MR_TRY(mr_packed_levels(&u->ctx, &u->p, true));
	order->m = u->p.control;
	order->half = all_halves(&u->ctx, order->half, order->m.nf);
	nv = u->p.level[u->p.n].nv;
	u->position = MR_NEW(&u->ctx, order->m.nv, mr_v3);
	u->triangles = MR_NEW(&u->ctx, order->m.nf, mr_tri);
	u->height = MR_NEW(&u->ctx, nv, double);
	u->color = mr_alloc(&u->ctx, nv, sizeof *u->color);
	mr_packed_read_fields(&u->ctx, &u->p, bits, u->p.n);
	renumber_control(u, order);
	return renumber_fields(u, order, crease);
}

/* NULL where there is no memory.  vertex, half: of each vertex, and of each face's
 * first half-edge: which it was; crease: of the stream, or NULL. */
MR_EXPORT(packed_open)
unpacked *
packed_open(const unsigned char *byte, size_t size, const uint32_t *vertex, const uint32_t *half,
    const uint8_t *crease)
{
	unpacked *u = calloc(1, sizeof *u);
	mr_control_order order = { .vertex = vertex, .half = half };

	if (!u)
		return NULL;
	mr_ctx_init(&u->ctx, 1);
	return unpack(u, (mr_packed_bytes){ byte, size }, &order, crease) == MR_OK ? u : NULL;
}

MR_EXPORT(packed_free)
void
packed_free(unpacked *u)
{
	mr_ctx_free(&u->ctx);
	free(u);
}
