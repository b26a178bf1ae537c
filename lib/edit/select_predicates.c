/* The predicates of a selection: how each is written, and for which vertices it holds. */
#include "base/text_file.h"
#include "edit/select_parts.h"
#include "mesh/layers.h"
#include "mesh/repair.h"
#include "space/connected.h"
#include "space/geodesic.h"

/* Parsing */

static mr_status
parse_numbers(mr_ctx *ctx, const char *text, mr_select_term *t)
{
	const mr_predicate *p = t->predicate;
	const char *at = text;

	if (!mr_numbers(&at, p->numbers, t->x))
		return p->numbers == 1
		           ? mr_fail(ctx, MR_EUSAGE, "'%s' is not a number", text)
		           : mr_fail(ctx, MR_EUSAGE, "'%s' is not %zu numbers with commas between them", text,
				 p->numbers);
	if (p->length && *at == '%') {
		at++;
		t->relative = true;
		t->x[p->numbers - 1] /= 100;
	}
	if (*at)
		return mr_fail(ctx, MR_EUSAGE, "'%s' follows the numbers", at);
	if (p->length && t->x[p->numbers - 1] < 0)
		return mr_fail(ctx, MR_EUSAGE, "the length is negative");
	return MR_OK;
}

static mr_status
parse_halfspace(mr_ctx *ctx, const char *text, mr_select_term *t)
{
	MR_TRY(parse_numbers(ctx, text, t));
	if (t->x[0] == 0 && t->x[1] == 0 && t->x[2] == 0)
		return mr_fail(ctx, MR_EUSAGE, "'%s' has no direction", text);
	return MR_OK;
}

static mr_status
parse_axis(mr_ctx *ctx, const char *text, mr_select_term *t)
{
	const char *at = text + 1;

	if (*text < 'x' || *text > 'z' || *at++ != ',' || !mr_numbers(&at, 1, t->x) || *at)
		return mr_fail(ctx, MR_EUSAGE, "'%s' is not an axis x, y or z, a comma and a fraction", text);
	if (t->x[0] < 0 || t->x[0] > 1)
		return mr_fail(ctx, MR_EUSAGE, "the fraction %g is not between 0 and 1", t->x[0]);
	t->axis = *text - 'x';
	return MR_OK;
}

/* "VERTEX,RINGS", or of grow "RINGS". */
static mr_status
parse_rings(mr_ctx *ctx, const char *text, mr_select_term *t)
{
	bool vertex = t->predicate->numbers > 1;
	const char *at = text;
	uint64_t v = 0, k;

	if (vertex && (!mr_whole(&at, MR_NONE - 1, &v) || *at++ != ','))
		return mr_fail(ctx, MR_EUSAGE, "'%s' is not a vertex, a comma and a number of rings", text);
	if (!mr_whole(&at, MR_NONE, &k) || *at)
		return mr_fail(ctx, MR_EUSAGE, "'%s' is not %s number of rings", text,
		    vertex ? "a vertex, a comma and a" : "a");
	t->vertex = (uint32_t)v;
	t->count = (size_t)k;
	return MR_OK;
}

static mr_status
parse_name(mr_ctx *ctx, const char *text, mr_select_term *t)
{
	t->name = text;
	return *text ? MR_OK : mr_fail(ctx, MR_EUSAGE, "a name is missing");
}

static mr_status
parse_list(mr_ctx *ctx, const char *text, mr_select_term *t)
{
	char **line;
	size_t n;

	MR_TRY(parse_name(ctx, text, t));
	MR_TRY(mr_lines_read(ctx, text, &line, &n));
	t->list = MR_NEW(ctx, n, uint32_t);
	for (size_t i = 0; i < n; i++) {
		const char *at = line[i];
		uint64_t v;
		if (!*at)
			continue;
		if (!mr_whole(&at, MR_NONE - 1, &v) || *at)
			return mr_fail(
			    ctx, MR_EFORMAT, "%s:%zu: '%.40s' is not a vertex", text, i + 1, line[i]);
		t->list[t->listed++] = (uint32_t)v;
	}
	return MR_OK;
}

/* "N", "N,DISTANCE" or "N,DISTANCE%". */
static mr_status
parse_part(mr_ctx *ctx, const char *text, mr_select_term *t)
{
	const char *at = text;
	uint64_t n;

	if (!mr_whole(&at, MR_NONE, &n) || n == 0)
		return mr_fail(ctx, MR_EUSAGE, "'%s' is not the number of a part, from 1", text);
	t->count = (size_t)n;
	if (!*at)
		return MR_OK;
	if (*at++ != ',' || !mr_numbers(&at, 1, t->x) || !(t->x[0] > 0))
		return mr_fail(ctx, MR_EUSAGE, "'%s' is not a number, or one, a comma and a distance", text);
	t->relative = *at == '%';
	t->x[0] /= t->relative ? 100 : 1;
	return at[t->relative] ? mr_fail(ctx, MR_EUSAGE, "'%s' follows the distance", at) : MR_OK;
}

/* The bounds are the last two words: a name may have commas. */
static mr_status
parse_column(mr_ctx *ctx, const char *text, mr_select_term *t)
{
	const char *low = text + strlen(text), *at;

	for (int commas = 0; low > text && commas < 2;)
		commas += *--low == ',';
	at = low + 1;
	if (low == text || !mr_numbers(&at, 2, t->x) || *at)
		return mr_fail(
		    ctx, MR_EUSAGE, "'%s' is not a name and two bounds, with commas between them", text);
	if (t->x[0] > t->x[1])
		return mr_fail(ctx, MR_EUSAGE, "the bound %g is above %g", t->x[0], t->x[1]);
	t->name = mr_format(ctx, "%.*s", (int)(low - text), text);
	return MR_OK;
}

/* Evaluating */

/* The length that ends the term's numbers, in units of the model. */
static double
length_of(const mr_select_scene *s, const mr_select_term *t)
{
	double r = t->x[t->predicate->numbers - 1];

	return t->relative ? r * mr_box_diagonal(s->box) : r;
}

static mr_v3
point_of(const mr_select_term *t)
{
	return mr_vec(t->x[0], t->x[1], t->x[2]);
}

static mr_status
eval_all(mr_ctx *ctx, const mr_select_scene *s, const mr_select_term *t, bool *in)
{
	(void)ctx, (void)t;
	memset(in, true, s->m->nv);
	return MR_OK;
}

static mr_status
eval_sphere(mr_ctx *ctx, const mr_select_scene *s, const mr_select_term *t, bool *in)
{
	double r = length_of(s, t);

	(void)ctx;
	for (size_t v = 0; v < s->m->nv; v++) {
		mr_v3 d = mr_sub(s->m->p[v], point_of(t));
		in[v] = hypot(hypot(d.x, d.y), d.z) <= r; /* whose squares doubles may not hold */
	}
	return MR_OK;
}

static mr_status
eval_box(mr_ctx *ctx, const mr_select_scene *s, const mr_select_term *t, bool *in)
{
	(void)ctx;
	for (size_t v = 0; v < s->m->nv; v++) {
		in[v] = true;
		for (int k = 0; k < 3; k++) {
			double x = mr_coordinate(s->m->p[v], k);
			in[v] = in[v] && x >= t->x[k] && x <= t->x[k + 3];
		}
	}
	return MR_OK;
}

static mr_status
eval_halfspace(mr_ctx *ctx, const mr_select_scene *s, const mr_select_term *t, bool *in)
{
	(void)ctx;
	for (size_t v = 0; v < s->m->nv; v++)
		in[v] = mr_dot(point_of(t), s->m->p[v]) >= t->x[3];
	return MR_OK;
}

/* Where the term's fraction of the bounding box is, along its axis. */
static double
level_of(const mr_select_scene *s, const mr_select_term *t)
{
	double low = mr_coordinate(s->box.min, t->axis), high = mr_coordinate(s->box.max, t->axis);

	return t->x[0] == 1 ? high : low + t->x[0] * (high - low);
}

static mr_status
eval_above(mr_ctx *ctx, const mr_select_scene *s, const mr_select_term *t, bool *in)
{
	double level = level_of(s, t), side = *t->predicate->name == 'a' ? 1 : -1;

	(void)ctx;
	for (size_t v = 0; v < s->m->nv; v++)
		in[v] = side * (mr_coordinate(s->m->p[v], t->axis) - level) >= 0;
	return MR_OK;
}

static mr_status
eval_geodesic(mr_ctx *ctx, const mr_select_scene *s, const mr_select_term *t, bool *in)
{
	mr_mark mark = mr_mark_take(ctx);
	double r = length_of(s, t), *distance = MR_NEW(ctx, s->m->nv, double);

	mr_geodesic_distances(ctx, s->m, point_of(t), r, distance);
	for (size_t v = 0; v < s->m->nv; v++)
		in[v] = distance[v] <= r;
	mr_mark_release(ctx, mark);
	return MR_OK;
}

/* Adds the neighbours of what is in, ring by ring, as far as `rings` and while `may` (or all, if NULL)
 * allows. */
static void
add_rings(mr_ctx *ctx, const mr_select_scene *s, size_t rings, const uint32_t *region, bool *in)
{
	mr_mark mark = mr_mark_take(ctx);
	uint32_t *queue = MR_NEW(ctx, s->m->nv, uint32_t);
	uint32_t into = s->target == MR_REGION_FIXED ? MR_REGION_FREE : MR_REGION_FIXED;
	size_t n = 0, next = 0;

	for (uint32_t v = 0; v < s->m->nv; v++)
		if (in[v])
			queue[n++] = v;
	for (; rings > 0 && next < n; rings--)
		for (size_t end = n; next < end; next++)
			for (size_t i = s->inc->start[queue[next]]; i < s->inc->start[queue[next] + 1]; i++)
				for (int k = 0; k < 3; k++) {
					uint32_t w = s->m->t[s->inc->face[i]].v[k];
					if (in[w] || (region && region[w] != into))
						continue;
					in[w] = true;
					queue[n++] = w;
				}
	mr_mark_release(ctx, mark);
}

static mr_status
eval_rings(mr_ctx *ctx, const mr_select_scene *s, const mr_select_term *t, bool *in)
{
	if (t->vertex >= s->m->nv)
		return mr_fail(ctx, MR_ERANGE, "vertex %u, %s has %zu", t->vertex, s->m->name, s->m->nv);
	in[t->vertex] = true;
	add_rings(ctx, s, t->count, NULL, in);
	return MR_OK;
}

/* The part of vertex v. */
static mr_status
take_part(mr_ctx *ctx, const mr_select_scene *s, double distance, size_t v, bool *in)
{
	mr_connected c;

	MR_TRY(mr_connected_of(ctx, s->f, s->m, distance, &c));
	for (size_t i = 0; i < s->m->nv; i++)
		in[i] = c.part[i] == c.part[v];
	return MR_OK;
}

static mr_status
eval_part(mr_ctx *ctx, const mr_select_scene *s, const mr_select_term *t, bool *in)
{
	double distance = t->relative ? t->x[0] * mr_box_diagonal(s->box) : t->x[0];
	mr_connected c;

	if (distance > 0 && s->m->nf)
		return mr_fail(
		    ctx, MR_EMESH, "%s has faces, which connect it: a distance is of points", s->m->name);
	MR_TRY(mr_connected_of(ctx, s->f, s->m, distance, &c));
	if (t->count > c.parts)
		return mr_fail(
		    ctx, MR_EMESH, "there is no part %zu: %s has %zu", t->count, s->m->name, c.parts);
	for (size_t i = 0; i < s->m->nv; i++)
		in[i] = c.part[i] == t->count - 1;
	return MR_OK;
}

/* Every vertex that no earlier one of these is within the distance of. */
static mr_status
eval_spaced(mr_ctx *ctx, const mr_select_scene *s, const mr_select_term *t, bool *in)
{
	double distance = t->relative ? t->x[0] * mr_box_diagonal(s->box) : t->x[0];
	uint32_t *onto = MR_NEW(ctx, s->m->nv, uint32_t), taken = 0;
	size_t count;

	mr_weld(ctx, s->m->p, s->m->nv, distance, onto, &count);
	for (size_t v = 0; v < s->m->nv; v++)
		if (onto[v] == taken) {
			in[v] = true;
			taken++;
		}
	return MR_OK;
}

static double
number_at(const mr_column *c, size_t row)
{
	switch (c->shape.type) {
	case 'd':
		return ((const double *)c->data)[row];
	case 'u':
		return ((const uint32_t *)c->data)[row];
	default:
		return ((const unsigned char *)c->data)[row];
	}
}

static mr_status
eval_column(mr_ctx *ctx, const mr_select_scene *s, const mr_select_term *t, bool *in)
{
	mr_column c = { 0 };
	const mr_column *there = s->f ? mr_frame_find(s->f, s->m->name, t->name) : NULL;
	bool faces;

	if (!there)
		return mr_fail(ctx, MR_EMISSING, "%s has no column %s", s->m->name, t->name);
	c = *there;
	faces = c.shape.element == 'f';
	if (c.shape.components != 1 || c.shape.element == '-' || c.shape.type == 't' ||
	    c.rows != (faces ? s->m->nf : s->m->nv))
		return mr_fail(ctx, MR_EMISSING, "column %s of %s is not a number for each vertex or face",
		    t->name, s->m->name);
	MR_TRY(mr_column_decode(ctx, &c));
	for (size_t i = 0; i < c.rows; i++) {
		double x = number_at(&c, i);
		if (!(x >= t->x[0] && x <= t->x[1]))
			continue;
		for (int k = 0; k < (faces ? 3 : 1); k++)
			in[faces ? s->m->t[i].v[k] : i] = true;
	}
	return MR_OK;
}

static mr_status
eval_component(mr_ctx *ctx, const mr_select_scene *s, const mr_select_term *t, bool *in)
{
	size_t nearest = 0;
	double best = INFINITY;

	for (size_t v = 0; v < s->m->nv; v++) {
		double d = mr_norm2(mr_sub(s->m->p[v], point_of(t)));
		if (d < best) {
			best = d;
			nearest = v;
		}
	}
	return take_part(ctx, s, 0, nearest, in);
}

/* The index of the line of `names` that is `name`; MR_NONE where there is none. */
static uint32_t
line_of(const mr_groups *g, const char *name)
{
	const char *at = g->names, *end = at + g->length;

	for (uint32_t i = 0; at < end; i++) {
		const char *stop = memchr(at, '\n', (size_t)(end - at));
		size_t n = (size_t)((stop ? stop : end) - at);
		if (n == strlen(name) && !memcmp(at, name, n))
			return i;
		at += n + 1;
	}
	return MR_NONE;
}

static mr_status
eval_group(mr_ctx *ctx, const mr_select_scene *s, const mr_select_term *t, bool *in)
{
	bool any = false;

	for (const mr_groups *g = s->groups; g < s->groups + MR_NAMINGS; g++) {
		uint32_t group = g->group ? line_of(g, t->name) : MR_NONE;
		any |= g->group != NULL;
		if (group == MR_NONE)
			continue;
		for (size_t f = 0; f < s->m->nf; f++)
			for (int k = 0; k < 3; k++)
				in[s->m->t[f].v[k]] |= g->group[f] == group;
		return MR_OK;
	}
	return any ? mr_fail(ctx, MR_EMISSING, "no group, object or material of %s is called %s", s->m->name,
			 t->name)
	           : mr_fail(ctx, MR_EMISSING, "%s has no groups, objects or materials", s->m->name);
}

/* How many faces at v have the corner w too. */
static size_t
faces_at_edge(const mr_select_scene *s, uint32_t v, uint32_t w)
{
	size_t n = 0;

	for (size_t i = s->inc->start[v]; i < s->inc->start[v + 1]; i++) {
		const uint32_t *c = s->m->t[s->inc->face[i]].v;
		n += c[0] == w || c[1] == w || c[2] == w;
	}
	return n;
}

static mr_status
eval_boundary(mr_ctx *ctx, const mr_select_scene *s, const mr_select_term *t, bool *in)
{
	(void)ctx, (void)t;
	for (size_t f = 0; f < s->m->nf; f++)
		for (int k = 0; k < 3; k++) {
			uint32_t v = s->m->t[f].v[k], w = s->m->t[f].v[(k + 1) % 3];
			if (v != w && faces_at_edge(s, v, w) == 1)
				in[v] = in[w] = true;
		}
	return MR_OK;
}

static mr_status
eval_grow(mr_ctx *ctx, const mr_select_scene *s, const mr_select_term *t, bool *in)
{
	for (size_t v = 0; v < s->m->nv; v++)
		in[v] = s->region[v] == s->target;
	add_rings(ctx, s, t->count, s->region, in);
	return MR_OK;
}

static mr_status
eval_list(mr_ctx *ctx, const mr_select_scene *s, const mr_select_term *t, bool *in)
{
	for (size_t i = 0; i < t->listed; i++) {
		if (t->list[i] >= s->m->nv)
			return mr_fail(ctx, MR_ERANGE, "%s has vertex %u, %s has %zu", t->name, t->list[i],
			    s->m->name, s->m->nv);
		in[t->list[i]] = true;
	}
	return MR_OK;
}

const mr_predicate mr_predicates[] = {
	{ "all", NULL, eval_all, 0, false, false },
	{ "sphere", parse_numbers, eval_sphere, 4, true, false },
	{ "box", parse_numbers, eval_box, 6, false, false },
	{ "halfspace", parse_halfspace, eval_halfspace, 4, false, false },
	{ "above", parse_axis, eval_above, 0, false, false },
	{ "below", parse_axis, eval_above, 0, false, false },
	{ "geodesic", parse_numbers, eval_geodesic, 4, true, true },
	{ "rings", parse_rings, eval_rings, 2, false, true },
	{ "component", parse_numbers, eval_component, 3, false, false },
	{ "group", parse_name, eval_group, 0, false, true },
	{ "boundary", NULL, eval_boundary, 0, false, true },
	{ "grow", parse_rings, eval_grow, 1, false, true },
	{ "vertices", parse_list, eval_list, 0, false, false },
	{ "part", parse_part, eval_part, 0, false, false },
	{ "spaced", parse_numbers, eval_spaced, 1, true, false },
	{ "column", parse_column, eval_column, 0, false, false },
	{ 0 },
};
