/* mr-simplify: fewer faces, with the surface's columns carried over. */
#include "simplify/simplify.h"

#include "base/options.h"
#include "edit/detail.h"
#include "mesh/mend.h"
#include "mesh/repair.h"
#include "simplify/creases.h"
#include "space/carry.h"
#include "tool/tool.h"

/* By default, but for control meshes. */
enum { FACES_A_FACE = 10 };

/* Spacings of the points that a control mesh may be off by default, beyond their noise: thinner parts would
 * be webbed where they join. */
static const double OFF = 0.3;

/* The share of the diagonal that a control mesh of a mesh may be off by default, with no more than OWN
 * faces. */
static const double NEAR = 5e-4;
enum { OWN = 2000 };

/* The points that a control mesh is for: the frame's, if there are any. */
static mr_status
read_points(mr_ctx *ctx, mr_frame *f, const char *result_layer, mr_simplify_cloud *c)
{
	mr_mesh points;

	*c = (mr_simplify_cloud){ .n = 0 };
	if (strcmp(result_layer, "control") || !mr_frame_has_layer(f, "points"))
		return MR_OK;
	MR_TRY(mr_layer_points(ctx, f, "points", &points));
	if (points.nv == 0)
		return MR_OK;
	MR_TRY(mr_sampling_of(ctx, f, &points, &c->sampling));
	if (c->sampling.places == c->sampling.outliers)
		return MR_OK;
	c->p = points.p;
	c->n = points.nv;
	return (c->sampling.places == c->n ? mr_near_build_distinct : mr_near_build)(
	    ctx, c->p, c->n, &c->near);
}

/* The limits of a control mesh for points: faces enough for so many, or more where it would be off. */
static void
limit_by_points(mr_ctx *ctx, const mr_mesh *m, const mr_simplify_cloud *c, mr_simplify_opts *o)
{
	double *room = MR_NEW(ctx, m->nv, double);
	double mean = sqrt(c->sampling.area / (double)(c->sampling.places - c->sampling.outliers));

	for (size_t v = 0; v < m->nv; v++)
		room[v] = OFF * mean / sqrt(o->weight[v]) + c->sampling.noise;
	o->faces = mr_simplify_faces_for(c->n);
	o->most = mr_simplify_most_faces_for(c->n);
	o->fine = mr_simplify_fine_faces_for(c->n);
	o->room = o->faces < o->most ? room : NULL;
	if (!o->room) /* of few points */
		o->faces = o->fine;
}

/* The limits of a control mesh for a mesh. */
static void
limit_by_mesh(mr_ctx *ctx, const mr_mesh *m, mr_simplify_opts *o)
{
	double *room = MR_NEW(ctx, m->nv, double), error = NEAR * mr_mesh_diagonal(m);

	for (size_t v = 0; v < m->nv; v++)
		room[v] = error;
	o->room = room;
	o->faces = mr_simplify_faces_for(m->nv);
	o->most = o->faces > OWN ? o->faces : OWN;
}

/* The default target: by the points, or by the mesh that a control mesh comes from. */
static void
limit_by_frame(mr_ctx *ctx, const mr_mesh *m, const mr_simplify_cloud *c, mr_simplify_opts *o)
{
	if (c->n > 0)
		limit_by_points(ctx, m, c, o);
	else if (o->to && !strcmp(o->to, "control"))
		limit_by_mesh(ctx, m, o);
	else
		o->faces = m->nf / FACES_A_FACE;
}

static mr_status
weigh(mr_ctx *ctx, const mr_mesh *m, const mr_simplify_cloud *c, mr_simplify_opts *o)
{
	double *weight;

	if (o->weight || c->n == 0)
		return MR_OK;
	weight = MR_NEW(ctx, m->nv, double);
	MR_TRY(mr_simplify_weigh(ctx, m, c, weight));
	o->weight = weight;
	return MR_OK;
}

/* Puts the result in the surface's place, with what this knows; a base goes on knowing where it lies on the
 * mesh. s: all but the places; without faces nothing goes along. */
static mr_status
replace(mr_ctx *ctx, mr_frame *f, const uint32_t *onto, mr_successor s)
{
	const mr_mesh *m = s.before, *out = s.after;
	mr_carried *carried;
	mr_places source;
	bool mapped = false, is_base = !strcmp(m->name, "base");
	size_t n = 0;

	if (s.face || is_base)
		MR_TRY(mr_simplify_map(ctx, m, out, onto, &s.place));
	if (s.face)
		MR_TRY(mr_carry_columns(ctx, f, &s, &carried, &n));
	if (is_base)
		MR_TRY(mr_source_map_follow(ctx, f, m, &s.place, out->nv, &source, &mapped));
	MR_TRY(mr_layer_replace(ctx, f, m->name, out));
	if (n > 0)
		MR_TRY(mr_carried_put(ctx, f, m->name, carried, n));
	return mapped ? mr_source_map_put(ctx, f, &source, out->nv) : MR_OK;
}

/* The vertices that stay: on boundaries, on seams or in a region. */
static mr_status
lock(mr_ctx *ctx, mr_frame *f, const mr_mesh *m, const uint8_t *seam, const mr_simplify_opts *o,
    mr_simplify_ties *ties)
{
	bool *fixed = MR_NEW_ZERO(ctx, m->nv, bool);
	const uint32_t *region = NULL;
	mr_topology topo;

	MR_TRY(mr_topology_build(ctx, m, &topo));
	if (o->lock == MR_LOCK_REGION)
		MR_TRY(mr_layer_region(ctx, f, m->name, m->nv, &region));
	for (size_t v = 0; region && v < m->nv; v++)
		fixed[v] = region[v] == o->region;
	for (uint32_t h = 0; !region && h < 3 * m->nf; h++)
		if (o->lock == MR_LOCK_BOUNDARY ? topo.twin[h] == MR_NONE : seam && seam[h])
			fixed[mr_he_from(m, h)] = fixed[mr_he_to(m, h)] = true;
	ties->fixed = fixed;
	return MR_OK;
}

/* Whether it makes the control mesh of a mesh, whose faces define its sharp edges. */
static bool
of_mesh(const mr_simplify_opts *o)
{
	return o->to && !strcmp(o->to, "control");
}

/* Whether points show sharp edges that are to be kept.  MR_EMISSING where these are to be but cannot. */
static mr_status
may_be_sharp(
    mr_ctx *ctx, const mr_mesh *m, const mr_simplify_cloud *c, const mr_simplify_opts *o, bool *sharp)
{
	const double noisy = 0.1; /* spacings: clean clouds have up to 0.08 */
	bool can = !o->to && !strcmp(m->name, "control") && c->n > 0, mesh = of_mesh(o),
	     clean = c->sampling.noise < noisy * c->sampling.usual;

	*sharp = can && !o->smooth && clean;
	if (o->creases && !can && !mesh)
		return mr_fail(ctx, MR_EMISSING,
		    "%s: sharp edges are kept of layer control by layer points, and one of them is not there",
		    m->name);
	if (o->creases && !clean && !mesh)
		mr_found(ctx, &(mr_finding){
				  .kind = MR_LIMIT, .what = "the points are too noisy to show sharp edges" });
	return MR_OK;
}

/* The error of white beside black, relative to the diagonal: as if the surface were so far off. */
static const double WHITE = 0.05;

/* The visible attributes of a surface besides its shape: texture coordinates, as lengths on it, and
 * colours. */
static mr_status
find_values(mr_ctx *ctx, mr_frame *f, const mr_mesh *m, double weight, mr_simplify_ties *ties)
{
	bool of_corners = mr_layer_has(f, m->name, "corner_texcoord"),
	     colours = mr_layer_has(f, m->name, "color");
	size_t coordinates = of_corners || mr_layer_has(f, m->name, "texcoord") ? 2 : 0;
	size_t n = coordinates + (colours ? 3 : 0);
	double *value = MR_NEW(ctx, 3 * m->nf * n, double), map = 0, white = WHITE * mr_mesh_diagonal(m);
	const void *at = NULL, *colour = NULL;

	if (coordinates)
		MR_TRY(mr_layer_get_rows(ctx, f, m->name, of_corners ? "corner_texcoord" : "texcoord",
		    of_corners ? m->nf : m->nv, &at));
	if (colours)
		MR_TRY(mr_layer_get_rows(ctx, f, m->name, "color", m->nv, &colour));
	for (size_t c = 0; c < 3 * m->nf; c++) {
		uint32_t v = m->t[c / 3].v[c % 3];
		if (coordinates)
			memcpy(
			    value + n * c, (const double *)at + 2 * (of_corners ? c : v), 2 * sizeof *value);
		for (size_t k = 0; colours && k < 3; k++)
			value[n * c + coordinates + k] = weight * white *
			                                 ((const uint8_t *)colour)[4 * v + k] / 255;
	}
	for (size_t t = 0; coordinates && t < m->nf; t++) {
		const double *a = value + 3 * n * t, *b = a + n, *c = b + n;
		double area = fabs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
		map += isfinite(area) ? area : 0;
	}
	map = map > 0 ? weight * sqrt(mr_mesh_area(ctx, m) / map) : 0;
	for (size_t c = 0; coordinates && c < 3 * m->nf; c++)
		for (size_t k = 0; k < 2; k++)
			value[n * c + k] *= map;
	ties->value = value;
	ties->values = n;
	return MR_OK;
}

static mr_status
put_marks(mr_ctx *ctx, mr_frame *f, const mr_mesh *out, const uint8_t *mark, size_t *count)
{
	*count = 0;
	for (size_t h = 0; mark && h < 3 * out->nf; h++)
		*count += mark[h];
	*count /= 2;
	return mark ? mr_layer_put(ctx, f, "control", "crease", mark, out->nf) : MR_OK;
}

static mr_status
simplify(mr_ctx *ctx, mr_frame *f, mr_simplify_opts o, mr_simplify_result *r)
{
	static const char *const reads[] = { "control", "base", "mesh", NULL };
	mr_simplify_cloud points;
	mr_mesh m, surface, out;
	const char *layer;
	uint32_t *onto, *face;
	uint8_t *marks = NULL, *seam = NULL;
	mr_simplify_ties ties = { 0 };
	bool look;

	MR_TRY(mr_check_number(ctx, "ratio", o.ratio, 0, 1));
	MR_TRY(mr_check_number(ctx, "error", o.error, 0, 1e300));
	MR_TRY(mr_check_number(ctx, "attributes", o.attributes, 0, 1e6));
	MR_TRY(mr_check_number(ctx, "boundary", o.boundary, 0, 1e6));
	MR_TRY(mr_layer_choose_warned(ctx, f, o.layer, reads, &layer));
	MR_TRY(mr_layer_mesh(ctx, f, layer, &m));
	if (!strcmp(layer, "mesh"))
		MR_TRY(mr_layer_join_seams(ctx, f, &m));
	if (o.to && !strcmp(o.to, layer))
		return mr_fail(ctx, MR_EUSAGE, "--to: %s is the layer that is simplified", layer);
	MR_TRY(read_points(ctx, f, o.to ? o.to : layer, &points));
	MR_TRY(may_be_sharp(ctx, &m, &points, &o, &look));
	surface = m;
	if (look)
		MR_TRY(mr_find_creases(ctx, &m, &points, &surface, &marks));
	MR_TRY(weigh(ctx, &surface, &points, &o));
	if (!o.faces && !(o.ratio > 0) && !(o.error > 0))
		limit_by_frame(ctx, &surface, &points, &o);
	onto = MR_NEW(ctx, surface.nv, uint32_t);
	ties.needles = !o.to && !strcmp(layer, "mesh");
	if (!o.to && !marks && mr_layer_carries(f, layer)) {
		ties.face = &face;
		MR_TRY(mr_layer_seams(ctx, f, &surface, &seam));
		if (o.attributes > 0)
			MR_TRY(find_values(ctx, f, &surface, o.attributes, &ties));
	}
	if (o.lock)
		MR_TRY(lock(ctx, f, &surface, seam, &o, &ties));
	if (seam)
		marks = seam;
	if (marks || (of_mesh(&o) && !o.smooth))
		ties.sharp = &marks;
	MR_TRY(mr_simplify(ctx, &surface, &o, &ties, &out, onto, r));
	r->creases = look || o.creases ? 0 : MR_UNKNOWN;
	if (points.n > 0)
		MR_TRY(mr_sample_report_move(ctx, f, "points"));
	MR_TRY(o.to ? mr_layer_put_mesh(ctx, f, o.to, &out)
		    : replace(ctx, f, onto,
			  (mr_successor){ &m, &out, seam, seam ? marks : NULL, ties.face ? face : NULL, NULL,
			      { NULL, NULL } }));
	if (ties.sharp && !seam)
		MR_TRY(put_marks(ctx, f, &out, marks, &r->creases));
	return mr_layer_worked(ctx, f, o.to ? o.to : layer);
}

mr_status
mr_simplify_frame(mr_ctx *ctx, mr_frame *f, const mr_simplify_opts *opts, mr_simplify_result *result)
{
	static const mr_simplify_opts defaults = MR_SIMPLIFY_DEFAULTS;
	mr_simplify_result r;

	MR_ON_COPY(ctx, f, done, result, r, simplify(ctx, &done, opts ? *opts : defaults, &r));
}
