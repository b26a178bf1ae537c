/* Packed surfaces for pages that are not ours, as WebAssembly: man/mr-compact.5, by the library's own code.
 */
#include "compact/packed.h"
#include "formats/page/library/export.h"
#include "mesh/mesh.h"
#include "subdivide/displaced.h"

typedef struct surface {
	mr_ctx ctx;
	mr_packed p;
	mr_packed_bytes bits;
	size_t missing;
	mr_mark opened; /* meshes lie above it, one at a time */
	mr_v3 *at, *normal;
	uint8_t (*color)[4];
	mr_status status;
} surface;

/* Opens a file, or its first bytes, which malloc gave and surface_close frees.  NULL: out of memory;
 * surface_error returns any other failure. */
MR_EXPORT(surface_open)
surface *
surface_open(const unsigned char *byte, size_t size)
{
	surface *s = calloc(1, sizeof *s);

	if (!s)
		return NULL;
	mr_ctx_init(&s->ctx, 1);
	s->status = mr_packed_open(&s->ctx, (mr_packed_bytes){ byte, size }, &s->p, &s->bits, &s->missing);
	if (s->status == MR_OK)
		s->status = mr_packed_levels(&s->ctx, &s->p, true);
	s->opened = mr_mark_take(&s->ctx);
	return s;
}

/* The sentence; NULL where all is well. */
MR_EXPORT(surface_error)
const char *
surface_error(const surface *s)
{
	return s->status == MR_OK ? NULL : s->ctx.error;
}

MR_EXPORT(surface_levels)
size_t
surface_levels(const surface *s)
{
	return s->p.n;
}

/* How many bytes of the file are not there. */
MR_EXPORT(surface_missing)
size_t
surface_missing(const surface *s)
{
	return s->missing;
}

MR_EXPORT(surface_vertices)
size_t
surface_vertices(const surface *s, size_t level)
{
	return s->p.level[level].nv;
}

MR_EXPORT(surface_faces)
size_t
surface_faces(const surface *s, size_t level)
{
	return s->p.level[level].nf;
}

MR_EXPORT(surface_triangles)
const mr_tri *
surface_triangles(const surface *s, size_t level)
{
	return s->p.level[level].t;
}

/* Makes the surface of a level and returns its vertices, three numbers each; the two functions below return
 * its normals and colours.  The next call ends all three. */
MR_EXPORT(surface_positions)
const mr_v3 *
surface_positions(surface *s, size_t level)
{
	size_t nv = s->p.level[level].nv;
	mr_mesh m = { "control", NULL, s->p.control.t, s->p.control.nv, s->p.control.nf };
	mr_v3 *control;
	double *height;
	mr_domain domain;

	mr_mark_release(&s->ctx, s->opened);
	control = MR_NEW(&s->ctx, s->p.control.nv, mr_v3);
	height = MR_NEW(&s->ctx, nv, double);
	m.p = control;
	mr_packed_positions(&s->p, control);
	mr_packed_read_fields(&s->ctx, &s->p, s->bits, level);
	mr_packed_heights(&s->p, level, height);
	mr_domain_on(&s->ctx, &m, s->p.level, level, &domain);
	s->at = MR_NEW(&s->ctx, nv, mr_v3);
	mr_domain_displace(&s->ctx, &domain, height, 1, s->at);
	m = domain.m;
	m.p = s->at;
	s->normal = MR_NEW(&s->ctx, nv, mr_v3);
	mr_vertex_normals(&m, s->normal);
	s->color = s->p.fields > 1 ? mr_alloc(&s->ctx, nv, sizeof *s->color) : NULL;
	if (s->color)
		mr_packed_colors(&s->p, level, s->color);
	return s->at;
}

MR_EXPORT(surface_normals)
const mr_v3 *
surface_normals(const surface *s)
{
	return s->normal;
}

/* Red, green, blue and opacity of each vertex; NULL: it has none. */
MR_EXPORT(surface_colors)
const uint8_t (*surface_colors(const surface *s))[4]
{
	return (const uint8_t(*)[4])s->color;
}

MR_EXPORT(surface_close)
void
surface_close(surface *s, unsigned char *byte)
{
	mr_ctx_free(&s->ctx);
	free(s);
	free(byte);
}
