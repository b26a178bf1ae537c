/* Contacts of the mesh by what its vertices stand on. */
#include "edit/tie_transfer.h"

#include "edit/detail.h"
#include "space/contact.h"

typedef struct candidate {
	uint32_t vertex, component, face;
} candidate;

static int
by_order(const void *a, const void *b)
{
	const candidate *x = a, *y = b;

	if (x->vertex != y->vertex)
		return x->vertex < y->vertex ? -1 : 1;
	if (x->component != y->component)
		return x->component < y->component ? -1 : 1;
	return (x->face > y->face) - (x->face < y->face);
}

static uint32_t
nearest_corner(const mr_mesh *m, mr_place at)
{
	const double w[3] = { at.bary.x, at.bary.y, at.bary.z };
	int best = 0;

	for (int k = 1; k < 3; k++)
		if (w[k] > w[best])
			best = k;
	return m->t[at.face].v[best];
}

/* The ties of all contacts of the mesh, of parts that are parts of the base too. */
static size_t
list_candidates(const mr_mesh *mesh, const mr_contacts *c, const mr_mesh *base, const mr_detail *d,
    const uint32_t *component, candidate *out)
{
	size_t n = 0;

	for (uint32_t v = 0; v < mesh->nv; v++)
		for (size_t i = c->start[v]; i < c->start[v + 1]; i++) {
			uint32_t on = nearest_corner(base, mr_places_at(&d->at, v)),
				 face = d->at.face[nearest_corner(mesh, c->at[i])],
				 other = component[base->t[face].v[0]];
			if (component[on] != other)
				out[n++] = (candidate){ on, other, face };
		}
	return n;
}

static void
find_ties(mr_ctx *ctx, const mr_mesh *mesh, const mr_mesh *base, const mr_detail *d, mr_ties *ties)
{
	const double touch = 0.001; /* of the diagonal */
	candidate *c;
	mr_contacts contacts;
	uint32_t *component;
	size_t n, kept = 0;
	bool several;

	mr_components_label(ctx, base, &component, &several);
	if (!several)
		return;
	mr_contacts_find(ctx, mesh, touch * mr_mesh_diagonal(mesh), &contacts);
	c = MR_NEW(ctx, contacts.start[mesh->nv], candidate);
	n = list_candidates(mesh, &contacts, base, d, component, c);
	qsort(c, n, sizeof *c, by_order);
	ties->tie = MR_NEW(ctx, n, mr_tie);
	for (size_t i = 0; i < n; i++)
		if (i == 0 || c[i].vertex != c[i - 1].vertex || c[i].component != c[i - 1].component)
			ties->tie[kept++] = (mr_tie){ c[i].vertex, c[i].face };
	ties->n = kept;
	ties->known = true;
}

mr_status
mr_transfer_ties(mr_ctx *ctx, mr_frame *f, const mr_mesh *base, mr_ties *ties)
{
	mr_ties found = { 0 };
	mr_detail detail;
	mr_mesh mesh;

	*ties = found;
	if (strcmp(base->name, "base") || !mr_layer_has(f, "mesh", "detail_height") ||
	    !mr_layer_has(f, "mesh", "triangles"))
		return MR_OK;
	MR_TRY(mr_layer_mesh(ctx, f, "mesh", &mesh));
	MR_TRY(mr_detail_get(ctx, f, base, &detail));
	find_ties(ctx, &mesh, base, &detail, &found);
	*ties = found;
	return MR_OK;
}
