/* Terms of a selection, in order: later ones win. */
#include "edit/select.h"

#include "edit/handles.h"
#include "edit/select_parts.h"
#include "edit/selection_file.h"
#include "mesh/layers.h"

typedef struct mr_parsed_rule {
	uint32_t region;
	const char *option, *text;
	mr_select_term *term;
	size_t terms;
	mr_selection_file *file; /* in place of region and terms; or NULL */
} rule;

/* The predicate whose name begins `text`, followed by a colon, a '+' or nothing. */
static const mr_predicate *
find_predicate(const char *text)
{
	for (const mr_predicate *p = mr_predicates; p->name; p++) {
		size_t n = strlen(p->name);
		if (!strncmp(text, p->name, n) && (!text[n] || text[n] == ':' || text[n] == '+'))
			return p;
	}
	return NULL;
}

/* Where the term that begins `text` ends: at a '+' before another term (others belong to a number or a name).
 */
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

	for (const mr_predicate *p = mr_predicates; p->name; p++)
		n += (size_t)snprintf(names + n, sizeof names - n, "%s%s", n ? ", " : "", p->name);
	return mr_fail(ctx, MR_EUSAGE, "'%s' is not a predicate: there are %s", text, names);
}

static mr_status
parse_term(mr_ctx *ctx, const char *text, mr_select_term *t)
{
	const char *colon;

	*t = (mr_select_term){ 0 };
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
	return mr_prefix(ctx, mr_select_parse(ctx, colon + 1, t), "%s", t->predicate->name);
}

static mr_status
parse_rule(mr_ctx *ctx, const char *text, rule *r)
{
	size_t terms = 1;

	for (size_t i = 0; text[i]; i++)
		terms += text[i] == '+';
	r->term = MR_NEW(ctx, terms, mr_select_term);
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
eval_rule(mr_ctx *ctx, const mr_select_scene *s, const rule *r, bool *one, bool *in)
{
	memset(in, true, s->m->nv);
	for (size_t i = 0; i < r->terms; i++) {
		const mr_select_term *t = &r->term[i];
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
apply_rule(
    mr_ctx *ctx, mr_select_scene *s, const rule *r, bool may_miss, bool *one, bool *in, uint32_t *region)
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
	mr_select_scene sc = { f, m, groups, &inc, mr_mesh_box(m), selected, 0 };

	memcpy(selected, region, m->nv * sizeof *region);
	mr_incidence_build(ctx, m, &inc);
	for (size_t i = 0; i < s->n; i++)
		MR_TRY(apply_rule(ctx, &sc, &s->rule[i], s->may_miss, one, in, selected));
	memcpy(region, selected, m->nv * sizeof *region);
	report(ctx, region, m->nv, result);
	return MR_OK;
}
