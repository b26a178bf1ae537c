/* The weights by which handles' rotations are interpolated. */
#include "edit/deform_clusters.h"
#include "op/laplace.h"

/* The regions that have weights, in their order. */
static mr_status
find_regions(mr_ctx *ctx, const mr_deform *d, mr_rotations *r)
{
	bool *present = MR_NEW_ZERO(ctx, d->handles, bool);

	r->region = MR_NEW(ctx, d->handles, uint32_t);
	if (!present || !r->region)
		return MR_EMEM;
	for (size_t i = d->patch.end[0]; i < d->patch.mesh.nv; i++) {
		uint32_t region = d->region[d->patch.vertex[i]];
		if (region >= MR_REGION_HANDLE && region != d->lowest)
			present[region - MR_REGION_HANDLE] = true;
	}
	for (size_t h = 0; h < d->handles; h++)
		if (present[h])
			r->region[r->count++] = (uint32_t)(MR_REGION_HANDLE + h);
	return MR_OK;
}

/* Harmonic fields, some at a time. */
static mr_status
solve_weights(mr_ctx *ctx, mr_deform *membrane, mr_rotations *r)
{
	const mr_patch *patch = &membrane->patch;

	for (size_t j = 0; j < r->count; j += WIDTH) {
		size_t width = r->count - j < WIDTH ? r->count - j : WIDTH;
		mr_patch_field f = mr_deform_field(membrane, width);
		for (size_t i = patch->end[0]; i < patch->mesh.nv; i++)
			for (size_t c = 0; c < width; c++)
				f.u[width * i + c] = membrane->region[patch->vertex[i]] == r->region[j + c];
		MR_TRY(mr_deform_solve_field(ctx, membrane, &f));
		for (size_t i = 0; i < patch->mesh.nv; i++)
			memcpy(r->weight + r->count * i + j, f.u + width * i, width * sizeof *f.u);
	}
	return MR_OK;
}

static double
ease(double w)
{
	w = fmin(fmax(w, 0), 1); /* beyond where cotangents are negative */
	return w * w * (3 - 2 * w);
}

/* Eases the n weights of a vertex and what is left of 1, and makes their sum 1 again. */
static void
ease_weights(double *w, size_t n)
{
	double rest = 1, sum = 0;

	for (size_t j = 0; j < n; j++) {
		rest -= fmax(w[j], 0);
		w[j] = ease(w[j]);
		sum += w[j];
	}
	sum += ease(rest);
	for (size_t j = 0; j < n && sum > 0; j++)
		w[j] /= sum;
}

static mr_status
make_room(mr_ctx *ctx, const mr_mesh *m, mr_rotations *r)
{
	r->cot = mr_alloc(ctx, m->nf, sizeof *r->cot);
	r->weight = MR_NEW(ctx, m->nv * r->count, double);
	r->rest = MR_NEW(ctx, m->nv, mr_v3);
	r->q = MR_NEW(ctx, m->nv, mr_v3);
	r->before = MR_NEW(ctx, m->nv, mr_v3);
	r->map = MR_NEW(ctx, m->nv, mr_mat3);
	r->face = MR_NEW(ctx, 9 * m->nf, double);
	r->source = MR_NEW(ctx, 3 * m->nv, double);
	if (!r->cot || !r->weight || !r->rest || !r->q || !r->before || !r->map || !r->face || !r->source)
		return MR_EMEM;
	return mr_incidence_build(ctx, m, &r->around);
}

static mr_status
make(mr_ctx *ctx, mr_deform *d, mr_rotations *r)
{
	const mr_mesh *m = &d->patch.mesh;

	MR_TRY(find_regions(ctx, d, r));
	MR_TRY(make_room(ctx, m, r));
	for (size_t f = 0; f < m->nf; f++)
		mr_cotangents(m->p[m->t[f].v[0]], m->p[m->t[f].v[1]], m->p[m->t[f].v[2]], r->cot[f]);
	if (d->opts.order > 1) {
		r->membrane = MR_NEW_ZERO(ctx, 1, mr_deform);
		if (!r->membrane)
			return MR_EMEM;
		MR_TRY(mr_deform_membrane(ctx, d, r->membrane));
	} else {
		r->membrane = d;
	}
	MR_TRY(solve_weights(ctx, r->membrane, r));
	for (size_t i = 0; i < m->nv; i++)
		ease_weights(r->weight + r->count * i, r->count);
	MR_TRY(mr_sections_find(ctx, m, r));
	return d->opts.rounds || d->opts.fitted ? mr_volume_make(ctx, d, &r->volume) : MR_OK;
}

static void
free_membrane(const mr_deform *d, mr_rotations *r)
{
	if (r->membrane && r->membrane != d)
		mr_solver_free(r->membrane->solver);
	r->membrane = NULL;
}

mr_status
mr_rotations_make(mr_ctx *ctx, mr_deform *d)
{
	mr_rotations *r;
	mr_status status;

	if (d->rotations)
		return MR_OK;
	r = MR_NEW_ZERO(d->keep, 1, mr_rotations);
	status = r ? make(d->keep, d, r) : MR_EMEM;
	d->rotations = status < 0 ? NULL : r;
	if (d->rotations && d->opts.fitted)
		status = mr_clusters_make(d->keep, d);
	if (r && (status < 0 || d->opts.rounds < 2))
		free_membrane(d, r);
	if (status < 0) {
		d->rotations = NULL;
		return mr_fail_as(ctx, d->keep, status);
	}
	return MR_OK;
}

void
mr_rotations_free(mr_deform *d)
{
	if (d->rotations)
		free_membrane(d, d->rotations);
}
