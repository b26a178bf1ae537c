/* Predicates of a selection: how each is written, and for which vertices it holds; and rules of them, in
 * order: later ones win. */
#include "edit/select.h"

#include "base/text_file.h"
#include "edit/selection_file.h"
#include "measure/measure.h"
#include "mesh/layers.h"
#include "mesh/repair.h"
#include "space/connected.h"
#include "space/geodesic.h"

typedef struct term {
	const struct predicate *predicate;
	bool negate;
	double x[6];       /* numbers and fractions, in the order written */
	uint32_t whole[2]; /* whole numbers */
	double length;
	bool relative; /* that is a share of the diagonal */
	int axis;
	const char *name;
	uint32_t *list; /* vertices */
	size_t listed;
} term;

/* The data that a predicate is evaluated on. */
typedef struct scene {
	mr_frame *f; /* or NULL */
	const mr_mesh *m;
	const mr_groups *groups;
	const mr_incidence *inc;
	mr_box box;
	const uint32_t *region; /* as the rules before left it */
	uint32_t target;        /* the region that the rule gives */
} scene;

/* A kind of predicate.  fields: what stands after its colon: n number, l length or % of the diagonal, f
 * fraction, a axis, i whole number, c one from 1, s name, v file of vertices. */
typedef struct predicate {
	const char *name, *fields, *form;                      /* form: the fields in words */
	bool (*holds)(const scene *s, const term *t, mr_v3 p); /* at a place; or */
	/* sets in[v] where it holds, given all false */
	mr_status (*eval)(mr_ctx *ctx, const scene *s, const term *t, bool *in);
	bool faces; /* there must be faces */
} predicate;

/* Parsing */

/* The vertices that a file lists. */
static mr_status
read_list(mr_ctx *ctx, const char *path, term *t)
{
	char **line;
	size_t n;

	MR_TRY(mr_lines_read(ctx, path, &line, &n));
	t->list = MR_NEW(ctx, n, uint32_t);
	for (size_t i = 0; i < n; i++) {
		const char *at = line[i];
		uint64_t v;
		if (!*at)
			continue;
		if (!mr_whole(&at, MR_NONE - 1, &v) || *at)
			return mr_fail(
			    ctx, MR_EFORMAT, "%s:%zu: '%.40s' is not a vertex", path, i + 1, line[i]);
		t->list[t->listed++] = (uint32_t)v;
	}
	return MR_OK;
}

/* A name ends where so many commas are left as fields follow it. */
static bool
take_name(mr_ctx *ctx, const char **at, size_t fields, term *t)
{
	const char *end = *at + strlen(*at);

	for (; fields > 0 && end > *at; fields--)
		while (end > *at && *--end != ',')
			;
	t->name = mr_format(ctx, "%.*s", (int)(end - *at), *at);
	*at = end;
	return *t->name;
}

static bool
take_length(const char **at, term *t)
{
	if (!mr_numbers(at, 1, &t->length) || t->length < 0)
		return false;
	t->relative = **at == '%';
	t->length /= t->relative ? 100 : 1;
	*at += t->relative;
	return true;
}

static bool
take_axis(const char **at, term *t)
{
	t->axis = **at - 'x';
	return **at >= 'x' && *(*at)++ <= 'z';
}

static bool
take_whole(const char **at, uint32_t *whole)
{
	uint64_t x;

	if (!mr_whole(at, MR_NONE, &x))
		return false;
	*whole = (uint32_t)x;
	return true;
}

/* The current field, with its number among its kind. */
static bool
take_field(mr_ctx *ctx, const char *field, const char **at, size_t *numbers, size_t *wholes, term *t)
{
	double *x = &t->x[*numbers];

	switch (*field) {
	case 'n':
		++*numbers;
		return mr_numbers(at, 1, x);
	case 'f':
		++*numbers;
		if (!mr_numbers(at, 1, x))
			return false;
		*x /= **at == '%' ? 100 : 1;
		*at += **at == '%';
		return *x >= 0 && *x <= 1;
	case 'l':
		return take_length(at, t);
	case 'a':
		return take_axis(at, t);
	case 'i':
		return take_whole(at, &t->whole[(*wholes)++]);
	case 'c':
		return take_whole(at, &t->whole[*wholes]) && t->whole[(*wholes)++] > 0;
	default:
		return take_name(ctx, at, strlen(field + 1), t);
	}
}

static mr_status
parse_fields(mr_ctx *ctx, const char *text, term *t)
{
	const predicate *p = t->predicate;
	size_t numbers = 0, wholes = 0;
	const char *at = text;

	for (const char *field = p->fields; *field; field++) {
		if ((field > p->fields && *at++ != ',') || !take_field(ctx, field, &at, &numbers, &wholes, t))
			return mr_fail(ctx, MR_EUSAGE, "'%s' is not %s", text, p->form);
	}
	if (*at)
		return mr_fail(ctx, MR_EUSAGE, "'%s' is not %s", text, p->form);
	return strchr(p->fields, 'v') ? read_list(ctx, t->name, t) : MR_OK;
}

/* At a place */

/* The term's length in units of the model. */
static double
length_of(const scene *s, const term *t)
{
	return t->relative ? t->length * mr_box_diagonal(s->box) : t->length;
}

static mr_v3
point_of(const term *t)
{
	return mr_vec(t->x[0], t->x[1], t->x[2]);
}

static bool
holds_everywhere(const scene *s, const term *t, mr_v3 p)
{
	(void)s, (void)t, (void)p;
	return true;
}

static bool
in_sphere(const scene *s, const term *t, mr_v3 p)
{
	mr_v3 d = mr_sub(p, point_of(t));

	return hypot(hypot(d.x, d.y), d.z) <= length_of(s, t); /* whose squares doubles may not hold */
}

static bool
in_box(const scene *s, const term *t, mr_v3 p)
{
	bool in = true;

	(void)s;
	for (int k = 0; k < 3; k++)
		in &= mr_coordinate(p, k) >= t->x[k] && mr_coordinate(p, k) <= t->x[k + 3];
	return in;
}

static bool
in_halfspace(const scene *s, const term *t, mr_v3 p)
{
	(void)s;
	return mr_dot(point_of(t), p) >= t->x[3];
}

/* Above or below the term's fraction of the bounding box, along its axis. */
static bool
beyond_level(const scene *s, const term *t, mr_v3 p)
{
	double low = mr_coordinate(s->box.min, t->axis), high = mr_coordinate(s->box.max, t->axis);
	double level = t->x[0] == 1 ? high : low + t->x[0] * (high - low);
	double side = *t->predicate->name == 'a' ? 1 : -1;

	return side * (mr_coordinate(p, t->axis) - level) >= 0;
}

/* Over the surface */

static mr_status
eval_geodesic(mr_ctx *ctx, const scene *s, const term *t, bool *in)
{
	MR_SCOPE(ctx);
	double r = length_of(s, t), *distance = MR_NEW(ctx, s->m->nv, double);

	mr_geodesic_distances(ctx, s->m, point_of(t), r, distance);
	for (size_t v = 0; v < s->m->nv; v++)
		in[v] = distance[v] <= r;
	return MR_OK;
}

/* Adds the neighbours of the set, ring by ring, as far as `rings` and while `may` (or all, if NULL)
 * allows. */
static void
add_rings(mr_ctx *ctx, const scene *s, size_t rings, const uint32_t *region, bool *in)
{
	MR_SCOPE(ctx);
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
}

static mr_status
eval_rings(mr_ctx *ctx, const scene *s, const term *t, bool *in)
{
	uint32_t v = t->whole[0];

	if (v >= s->m->nv)
		return mr_fail(ctx, MR_ERANGE, "vertex %u, %s has %zu", v, s->m->name, s->m->nv);
	in[v] = true;
	add_rings(ctx, s, t->whole[1], NULL, in);
	return MR_OK;
}

/* Sets in[v] for the part of this number, or where that is MR_NONE, of vertex `of`. */
static mr_status
take_part(mr_ctx *ctx, const scene *s, uint32_t part, size_t of, bool *in)
{
	mr_connected c;

	MR_TRY(mr_connected_of(ctx, s->f, s->m, 0, &c));
	if (part != MR_NONE && part >= c.parts)
		return mr_fail(
		    ctx, MR_EMESH, "there is no part %u: %s has %zu", part + 1, s->m->name, c.parts);
	for (size_t v = 0; v < s->m->nv; v++)
		in[v] = c.part[v] == (part == MR_NONE ? c.part[of] : part);
	return MR_OK;
}

static mr_status
eval_part(mr_ctx *ctx, const scene *s, const term *t, bool *in)
{
	return take_part(ctx, s, t->whole[0] - 1, 0, in);
}

/* Every vertex that no earlier one of these is within the distance of. */
static mr_status
eval_spaced(mr_ctx *ctx, const scene *s, const term *t, bool *in)
{
	uint32_t *onto = MR_NEW(ctx, s->m->nv, uint32_t), taken = 0;
	size_t count;

	mr_weld(ctx, s->m->p, s->m->nv, length_of(s, t), onto, &count);
	for (size_t v = 0; v < s->m->nv; v++)
		if (onto[v] == taken) {
			in[v] = true;
			taken++;
		}
	return MR_OK;
}

static mr_status
eval_column(mr_ctx *ctx, const scene *s, const term *t, bool *in)
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
		double x = mr_column_number(&c, i);
		if (!(x >= t->x[0] && x <= t->x[1]))
			continue;
		for (int k = 0; k < (faces ? 3 : 1); k++)
			in[faces ? s->m->t[i].v[k] : i] = true;
	}
	return MR_OK;
}

static mr_status
eval_component(mr_ctx *ctx, const scene *s, const term *t, bool *in)
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
	return take_part(ctx, s, MR_NONE, nearest, in);
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
eval_group(mr_ctx *ctx, const scene *s, const term *t, bool *in)
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

static mr_status
eval_boundary(mr_ctx *ctx, const scene *s, const term *t, bool *in)
{
	mr_edges edges;

	(void)t;
	mr_edges_build(ctx, s->m, &edges);
	mr_mark_boundary(s->m, &edges, in);
	return MR_OK;
}

static mr_status
eval_grow(mr_ctx *ctx, const scene *s, const term *t, bool *in)
{
	for (size_t v = 0; v < s->m->nv; v++)
		in[v] = s->region[v] == s->target;
	add_rings(ctx, s, t->whole[0], s->region, in);
	return MR_OK;
}

static mr_status
eval_list(mr_ctx *ctx, const scene *s, const term *t, bool *in)
{
	for (size_t i = 0; i < t->listed; i++) {
		if (t->list[i] >= s->m->nv)
			return mr_fail(ctx, MR_ERANGE, "%s has vertex %u, %s has %zu", t->name, t->list[i],
			    s->m->name, s->m->nv);
		in[t->list[i]] = true;
	}
	return MR_OK;
}

/* All of them; ends with a name of NULL. */
static const predicate predicates[] = {
	{ "all", "", "", holds_everywhere, NULL, false },
	{ "sphere", "nnnl", "x,y,z,r", in_sphere, NULL, false },
	{ "box", "nnnnnn", "x0,y0,z0,x1,y1,z1", in_box, NULL, false },
	{ "halfspace", "nnnn", "nx,ny,nz,d", in_halfspace, NULL, false },
	{ "above", "af", "x, y or z, a comma and a fraction from 0 to 1", beyond_level, NULL, false },
	{ "below", "af", "x, y or z, a comma and a fraction from 0 to 1", beyond_level, NULL, false },
	{ "geodesic", "nnnl", "x,y,z,r", NULL, eval_geodesic, true },
	{ "rings", "ii", "a vertex, a comma and a number of rings", NULL, eval_rings, true },
	{ "component", "nnn", "x,y,z", NULL, eval_component, false },
	{ "group", "s", "a name", NULL, eval_group, true },
	{ "boundary", "", "", NULL, eval_boundary, true },
	{ "grow", "i", "a number of rings", NULL, eval_grow, true },
	{ "vertices", "v", "the name of a file", NULL, eval_list, false },
	{ "part", "c", "the number of a part, from 1", NULL, eval_part, false },
	{ "spaced", "l", "a distance", NULL, eval_spaced, false },
	{ "column", "snn", "a name and two bounds, with commas between them", NULL, eval_column, false },
	{ 0 },
};

/* Rules */

typedef struct mr_parsed_rule {
	uint32_t region;
	const char *option, *text;
	term *term;
	size_t terms;
	mr_selection_file *file; /* in place of region and terms; or NULL */
} rule;

/* The predicate whose name begins `text`, followed by a colon, a '+' or nothing. */
static const predicate *
find_predicate(const char *text)
{
	for (const predicate *p = predicates; p->name; p++) {
		size_t n = strlen(p->name);
		if (!strncmp(text, p->name, n) && (!text[n] || text[n] == ':' || text[n] == '+'))
			return p;
	}
	return NULL;
}

/* The end of the term that begins `text`: at a '+' before another term. */
static size_t
term_length(const char *text)
{
	const char *plus = text;

	while ((plus = strchr(plus, '+'))) {
		if (find_predicate(plus + 1) || !strncmp(plus + 1, "not:", 4))
			return (size_t)(plus - text);
		plus++;
	}
	return strlen(text);
}

static mr_status
no_predicate(mr_ctx *ctx, const char *text)
{
	char names[200];
	size_t n = 0;

	for (const predicate *p = predicates; p->name; p++)
		n += (size_t)snprintf(names + n, sizeof names - n, "%s%s", n ? ", " : "", p->name);
	return mr_fail(ctx, MR_EUSAGE, "'%s' is not a predicate: there are %s", text, names);
}

static mr_status
parse_term(mr_ctx *ctx, const char *text, term *t)
{
	const char *colon;

	*t = (term){ 0 };
	for (; !strncmp(text, "not:", 4); text += 4)
		t->negate = !t->negate;
	t->predicate = find_predicate(text);
	if (!t->predicate)
		return no_predicate(ctx, text);
	if (text[strlen(t->predicate->name)] == '+')
		return no_predicate(ctx, text + strlen(t->predicate->name) + 1);
	colon = strchr(text, ':');
	if ((colon != NULL) == (*t->predicate->fields == '\0'))
		return mr_fail(ctx, MR_EUSAGE,
		    colon ? "%s takes nothing: no colon" : "%s takes something: %s:...", t->predicate->name,
		    t->predicate->name);
	if (!colon)
		return MR_OK;
	return mr_prefix(ctx, parse_fields(ctx, colon + 1, t), "%s", t->predicate->name);
}

static mr_status
parse_rule(mr_ctx *ctx, const char *text, rule *r)
{
	size_t terms = 1;

	for (size_t i = 0; text[i]; i++)
		terms += text[i] == '+';
	r->term = MR_NEW(ctx, terms, term);
	for (;;) {
		size_t n = term_length(text);
		char *word = mr_format(ctx, "%.*s", (int)n, text);
		MR_TRY(parse_term(ctx, word, &r->term[r->terms++]));
		if (!text[n])
			return MR_OK;
		text += n + 1;
	}
}

mr_status
mr_selection_add(mr_ctx *ctx, mr_selection *s, uint32_t region, const char *option, const char *text)
{
	rule r = { .region = region, .option = option, .text = text };

	MR_TRY(parse_rule(ctx, text, &r));
	MR_RESERVE(ctx, s->rule, s->n, 1, &s->room);
	s->rule[s->n++] = r;
	return MR_OK;
}

mr_status
mr_selection_add_file(mr_ctx *ctx, mr_selection *s, const char *option, const char *path)
{
	rule r = { .option = option, .text = path, .file = MR_NEW(ctx, 1, mr_selection_file) };

	MR_TRY(mr_selection_file_read(ctx, path, r.file));
	MR_RESERVE(ctx, s->rule, s->n, 1, &s->room);
	s->rule[s->n++] = r;
	return MR_OK;
}

uint32_t
mr_selection_begins(const mr_selection *s)
{
	return s->rule[0].region;
}

/* Sets in[v] where all terms of the rule hold.  one: workspace, nv. */
static mr_status
eval_rule(mr_ctx *ctx, const scene *s, const rule *r, bool *one, bool *in)
{
	memset(in, true, s->m->nv);
	for (size_t i = 0; i < r->terms; i++) {
		const term *t = &r->term[i];
		if (t->predicate->faces && s->m->nf == 0)
			return mr_fail(ctx, MR_EMESH, "%s%s: %s has no faces, which %s needs", r->option,
			    r->text, s->m->name, t->predicate->name);
		memset(one, false, s->m->nv);
		for (size_t v = 0; t->predicate->holds && v < s->m->nv; v++)
			one[v] = t->predicate->holds(s, t, s->m->p[v]);
		if (t->predicate->eval)
			MR_TRY(
			    mr_prefix(ctx, t->predicate->eval(ctx, s, t, one), "%s%s", r->option, r->text));
		for (size_t v = 0; v < s->m->nv; v++)
			in[v] = in[v] && one[v] != t->negate;
	}
	return MR_OK;
}

static mr_status
apply_rule(mr_ctx *ctx, scene *s, const rule *r, bool may_miss, bool *one, bool *in, uint32_t *region)
{
	size_t n = 0;

	s->target = r->region;
	if (r->file)
		MR_TRY(mr_selection_file_apply(ctx, r->file, s->m, region, &n));
	else
		MR_TRY(eval_rule(ctx, s, r, one, in));
	for (size_t v = 0; v < s->m->nv && !r->file; v++)
		if (in[v]) {
			region[v] = r->region;
			n++;
		}
	if (n == 0 && !may_miss && s->m->nv == 0)
		return mr_fail(ctx, MR_EMESH, "%s%s selects none of the 0 vertices of %s", r->option, r->text,
		    s->m->name);
	if (n == 0 && !may_miss)
		return mr_fail(ctx, MR_EMESH,
		    "%s%s selects no vertex of %s, whose box is %g %g %g to %g %g %g", r->option, r->text,
		    s->m->name, s->box.min.x, s->box.min.y, s->box.min.z, s->box.max.x, s->box.max.y,
		    s->box.max.z);
	mr_note(ctx, "%s%s selects %zu of %zu vertices", r->option, r->text, n, s->m->nv);
	return MR_OK;
}

/* Counts the regions. */
static void
report(mr_ctx *ctx, const uint32_t *region, size_t nv, mr_select_result *result)
{
	mr_regions all = mr_regions_of(ctx, region, nv);
	mr_select_result r = { .fixed = all.count[MR_REGION_FIXED],
		.free = all.count[MR_REGION_FREE],
		.handle_count = all.n - MR_REGION_HANDLE,
		.handle = all.count + MR_REGION_HANDLE };

	r.handles = nv - r.fixed - r.free;
	mr_note(ctx, "%zu fixed, %zu free, %zu in handles", r.fixed, r.free, r.handles);
	if (result)
		*result = r;
}

mr_status
mr_select(mr_ctx *ctx, mr_frame *f, const mr_mesh *m, const mr_groups *groups, const mr_selection *s,
    uint32_t *region, mr_select_result *result)
{
	bool *one = MR_NEW(ctx, m->nv, bool), *in = MR_NEW(ctx, m->nv, bool);
	uint32_t *selected = MR_NEW(ctx, m->nv, uint32_t);
	mr_incidence inc;
	scene sc = { f, m, groups, &inc, mr_mesh_box(m), selected, 0 };

	memcpy(selected, region, m->nv * sizeof *region);
	mr_incidence_build(ctx, m, &inc);
	for (size_t i = 0; i < s->n; i++)
		MR_TRY(apply_rule(ctx, &sc, &s->rule[i], s->may_miss, one, in, selected));
	memcpy(region, selected, m->nv * sizeof *region);
	report(ctx, region, m->nv, result);
	return MR_OK;
}
