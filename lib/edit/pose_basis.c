/* Botsch, Kobbelt 2004: An intuitive framework for freeform modeling, section 5: basis functions. */

#include "base/parallel.h"
#include "edit/detail.h"
#include "edit/handles.h"

typedef struct response_job {
	const mr_v3 *p0;
	const double *response;
	size_t handles;
	const mr_affine *change; /* T_h - I */
	mr_v3 *out;
} response_job;

static void
respond(void *arg, size_t begin, size_t end)
{
	response_job *j = arg;

	for (size_t i = begin; i < end; i++) {
		const double *w = j->response + 4 * j->handles * i;
		mr_v3 z = { 0, 0, 0 };
		for (size_t h = 0; h < j->handles; h++, w += 4) {
			const double *m = j->change[h].m;
			z.x += m[0] * w[0] + m[1] * w[1] + m[2] * w[2] + m[3] * w[3];
			z.y += m[4] * w[0] + m[5] * w[1] + m[6] * w[2] + m[7] * w[3];
			z.z += m[8] * w[0] + m[9] * w[1] + m[10] * w[2] + m[11] * w[3];
		}
		j->out[i] = mr_moved(j->p0[i], z);
	}
}

void
mr_pose_by_response(mr_ctx *ctx, const mr_v3 *p0, size_t n, const double *response, size_t handles,
    const mr_affine *t, mr_v3 *out)
{
	MR_SCOPE(ctx);
	mr_affine *change = MR_NEW(ctx, handles, mr_affine), identity = mr_identity();

	for (size_t h = 0; h < handles; h++)
		for (int i = 0; i < 12; i++)
			change[h].m[i] = t[h].m[i] - identity.m[i];
	mr_parallel(ctx, n, 32768, respond, &(response_job){ p0, response, handles, change, out });
}

mr_status
mr_response_get(mr_ctx *ctx, mr_frame *f, const mr_mesh *m, const double **response, mr_handle_rows *handles)
{
	size_t width = mr_frame_find(f, m->name, "response")->shape.components, odd;
	const void *values;

	MR_TRY(mr_layer_get_rows(ctx, f, m->name, "response", m->nv, &values));
	MR_TRY(mr_handles_rows(ctx, f, width / 4, handles));
	if (width != 4 * handles->n)
		return mr_fail(ctx, MR_ERANGE,
		    "%s: column response has %zu values a vertex, not 4 for each of %zu handles", m->name,
		    width, handles->n);
	*response = values;
	odd = mr_first_infinite(values, m->nv * width) / width;
	return odd == m->nv ? MR_OK : mr_fail(ctx, MR_ERANGE, "%s: response %zu is not finite", m->name, odd);
}

mr_status
mr_response_apply(mr_ctx *ctx, mr_frame *f, mr_mesh *m)
{
	mr_v3 *p = MR_NEW(ctx, m->nv, mr_v3);
	const double *response;
	mr_handle_rows row;
	mr_mesh posed;

	if (!mr_layer_has(f, "handles", "transform"))
		return MR_OK;
	if (!mr_layer_has(f, m->name, "response"))
		return mr_advise(
		    ctx, MR_RESPOND, mr_fail(ctx, MR_EMISSING, "handles, but no %s.response", m->name));
	MR_TRY(mr_response_get(ctx, f, m, &response, &row));
	mr_pose_by_response(ctx, m->p, m->nv, response, row.n, row.map, p);
	mr_handles_drop(f);
	MR_TRY(mr_detail_keep_before(ctx, f, m));
	MR_TRY(mr_layer_move(ctx, f, m->name, MR_POSED, p, m->nv));
	MR_TRY(mr_layer_points(ctx, f, m->name, &posed)); /* what goes beyond all numbers shows here */
	m->p = posed.p;
	return MR_OK;
}
