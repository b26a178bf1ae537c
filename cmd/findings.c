/* The one table of the findings' sentences. */
#include "findings.h"

#include <math.h>

/* In a sentence {n} is the count, {of} " of 12" if that is known, {s} the plural ending, {layer}, {what},
 * {pct} the value in percent, {limit}; {left}: the rest after a repair, from {value} and {limit}; {at} " at
 * vertex 5 (x, y, z)". */
typedef struct entry {
	verdict worst; /* what a frame with it is at most */
	double
	    unusable; /* the share, count over of or the value, from which a poor one is unusable; 0: none */
	const char *sentence, *remedy;
	const char *meaning; /* for mr-findings(7) */
} entry;

static const entry table[MR_FINDING_KINDS] = {
	[MR_FOLDED] = { VERDICT_POOR, 0.02, "{layer}: {n} more folded edge{s}{at}", "",
	    "Faces meet at an edge by more than 170 degrees, and did not before." },
	[MR_CROSSING] = { VERDICT_POOR, 0.02, "{layer}: {n} more intersecting pair{s} of near faces{at}", "",
	    "Faces pass through others near them along the surface, and did not before." },
	[MR_COLLIDED] = { VERDICT_POOR, 0, "{layer}: limbs or sheets meet, {n} pair{s} of far faces{at}", "",
	    "Faces pass through others far from them along the surface, or of another part." },
	[MR_TORN] = { VERDICT_POOR, 0.1, "{layer}: detail is torn at {n}{of} edge{s}{at}", "",
	    "Edges of the mesh have become twice as long, or half as long, where no edge of base has." },
	[MR_COARSE] = { VERDICT_POOR, 0.5, "{layer}: {n}{of} edge{s} are too long to bend with base{at}",
	    "mr-subdivide --longest {limit} splits them first",
	    "The middles of long edges miss base by over 1 % of the diagonal." },
	[MR_APART] = { VERDICT_POOR, 0, "{layer}: {n}{of} vert{ex} where parts touch came apart{at}", "",
	    "Parts, or the sides of a slit, touched and are over 0.5 % of the diagonal apart." },
	[MR_MISSED] = { VERDICT_POOR, 0.5, "{layer}: {n}{of} constrained vert{ex} miss their place{what}", "",
	    "Fixed vertices have moved, or vertices of a handle did not follow it." },
	[MR_VOLUME] = { VERDICT_POOR, 0.5, "{layer}: the volume has changed by {pct} %{what}", "",
	    "Closed parts enclose over a tenth more or less, though handles only turn or faces only merge." },
	[MR_SHRUNK] = { VERDICT_POOR, 0.9, "{layer}: {pct} % of the area is lost{what}", "",
	    "The surface has lost over a tenth of its area." },
	[MR_DISTANT] = { VERDICT_POOR, 0, "{layer}: a place is {pct} % of the diagonal from the input{at}",
	    "{what}", "The result strays from its input somewhere by over 5 % of the diagonal." },
	[MR_GONE] = { VERDICT_POOR, 0.5, "{layer}: {n}{of} part{s} lost over half of their area{at}",
	    "{what}", "Parts of the surface have collapsed." },
	[MR_LOST] = { VERDICT_GOOD, 0, "lost: {what} ({n})", "",
	    "Columns, materials or other data that the result or the file format cannot hold." },
	[MR_STALE] = { VERDICT_POOR, 0, "{layer}: {what} no longer fits and is dropped", "",
	    "Heights, detail or a selection of an earlier tool belong to a surface that is gone." },
	[MR_ROUNDED] = { VERDICT_GOOD, 0, "{n}{of} {what} rounded or clipped", "",
	    "Numbers changed because a format, or doubles so far from the origin, hold no more digits." },
	[MR_GUESSED] = { VERDICT_GOOD, 0, "{what}", "",
	    "A file can be read in two ways, and one was taken." },
	[MR_MISSING] = { VERDICT_GOOD, 0, "{what} is missing", "",
	    "A file that another file names is missing." },
	[MR_REPAIRED] = { VERDICT_GOOD, 0, "repaired: {what}", "{left}",
	    "Faces or vertices were changed to make an oriented manifold, or joined." },
	[MR_UNCERTAIN] = { VERDICT_POOR, 0, "the topology is uncertain{what}{at}", "",
	    "Points are too few or too noisy to show handles and openings." },
	[MR_UNREACHED] = { VERDICT_POOR, 0.5, "{n}{of} point{s} lie off the surface{what}{at}", "",
	    "Outliers, or a part that the surface does not reach." },
	[MR_BARE] = { VERDICT_POOR, 0.5, "{pct} % of the surface is far from all points{what}{at}", "",
	    "The surface closes openings of the points." },
	[MR_ROUGH] = { VERDICT_POOR, 0, "{what}", "", "Heights are rough, or the displaced surface folds." },
	[MR_FILLED] = { VERDICT_GOOD, 0, "{n}{of} {what} not found and filled in smoothly", "",
	    "Nothing was found there, and neighbours give the value." },
	[MR_INEXACT] = { VERDICT_POOR, 0, "{what}", "",
	    "Rounding or a limit of iterations stopped a solver." },
	[MR_UNHELD] = { VERDICT_POOR, 0, "{layer}: {what}", "",
	    "No constraint holds a part, no vertex is free, or a motion of a handle is impossible." },
	[MR_UNALIGNED] = { VERDICT_POOR, 0, "{layer}: {what}", "",
	    "Two surfaces that are compared fit after a motion, or no motion fits them, or several do." },
	[MR_LIMIT] = { VERDICT_GOOD, 0, "{what}{at}", "", "An option has no effect, or could not be met." },
	[MR_LAYER] = { VERDICT_GOOD, 0, "{layer} is used, not {what}, the layer worked on last", "",
	    "The tool works on another layer than the latest." },
};

/* Remedies that follow the sentence of a failure. */
static const char *const remedies[MR_REMEDIES] = {
	[MR_REPAIR] = "mr-import --repair mends that",
	[MR_RESCALE] = "mr-transform --unit brings it to 1",
	[MR_SELECT] = "mr-select makes them",
	[MR_SELECT_FREE] = "mr-select --free selects some",
	[MR_SELECT_HANDLE] = "mr-select --handle selects one",
	[MR_ENCODE] = "mr-encode makes detail, and mr-sample a displacement",
	[MR_ENCODE_AGAIN] = "mr-encode comes after the tools that change them",
	[MR_SOLVE_FIRST] = "mr-solve goes before this",
	[MR_DECODE_FIRST] = "mr-decode goes before this, or -l names a layer to take as it is",
	[MR_SOLVE_DECODE_FIRST] =
	    "mr-solve | mr-decode goes before this, or -l names a layer to take as it is",
	[MR_DECODE_CONTROL_FIRST] =
	    "mr-decode --from control goes before this, or -l names a layer to take as it is",
	[MR_RESPOND] = "mr-solve poses it, or stores a response by --basis before mr-pose",
	[MR_LESS_MEMORY] = "-s multigrid takes less memory, and mr-solve-mpi divides it among processes",
	[MR_LOWER_ORDER] = "a lower -k may have a solution in doubles",
	[MR_SOLVE_DIRECTLY] = "-s cholesky may solve it",
	[MR_THIN_OUT] = "mr-split separates several bodies, mr-crop --keep spaced: thins one",
	[MR_IMPORT] = "mr-import makes a stream of a model's file",
	[MR_SCRATCH] = "--scratch keeps large data on a disk",
	[MR_MAKE_MESH] = "mr-import reads mesh of a model with faces",
	[MR_MAKE_POINTS] = "mr-import reads points of a cloud, and by --points of any model",
	[MR_MAKE_BASE] = "mr-smooth or mr-remesh makes base of mesh",
	[MR_MAKE_CONTROL] = "mr-shrinkwrap makes control of points, mr-simplify --to control of mesh",
	[MR_MAKE_DISPLACEMENT] = "mr-sample makes displacement",
	[MR_MAKE_HANDLES] = "mr-pose makes handles",
};

const char *
findings_remedy(mr_remedy remedy)
{
	return remedies[remedy];
}

void
findings_add(findings *all, const mr_kept_finding *k)
{
	size_t i = 0;

	while (i < all->n && !mr_finding_same(&all->k[i], k))
		i++;
	if (i == FINDINGS_MOST)
		i--;
	if (i == all->n)
		all->n++;
	else if (k->f.count < all->k[i].f.count)
		return;
	all->k[i] = *k;
	all->k[i].f.layer = *k->layer ? all->k[i].layer : NULL;
	all->k[i].f.what = *k->what ? all->k[i].what : NULL;
}

static const mr_shape TEXT = { '-', 't', 1 };

mr_status
findings_read(mr_ctx *ctx, mr_frame *f, findings *all)
{
	mr_kept_finding k;
	const char *at;
	size_t n;

	MR_TRY(mr_frame_lines(ctx, f, "findings", &at, &n));
	for (const char *end = at + n; at < end;)
		if (mr_finding_read(&at, end, &k))
			findings_add(all, &k);
	return MR_OK;
}

static mr_status
put(mr_ctx *ctx, mr_frame *f, const findings *all)
{
	mr_text text = { .ctx = ctx };

	if (!all->n)
		return MR_OK;
	for (size_t i = 0; i < all->n; i++)
		mr_finding_write(&text, &all->k[i]);
	return mr_frame_put(ctx, f, "", "findings", TEXT, text.s, text.n);
}

/* Sentences */

static void
add_place(const mr_finding *f, char *text, size_t size)
{
	if (f->placed && f->vertex != MR_NO_VERTEX)
		snprintf(text, size, ", vertex %u (%.3g, %.3g, %.3g)", f->vertex, f->at.x, f->at.y, f->at.z);
	else if (f->placed)
		snprintf(text, size, ", near (%.3g, %.3g, %.3g)", f->at.x, f->at.y, f->at.z);
}

/* The words for the name in braces. */
static void
put_word(const mr_kept_finding *k, const char *name, char *text, size_t size)
{
	const mr_finding *f = &k->f;

	*text = '\0';
	if (!strncmp(name, "{n}", 3))
		snprintf(text, size, "%zu", f->count);
	else if (!strncmp(name, "{of}", 4) && f->of)
		snprintf(text, size, " of %zu", f->of);
	else if (!strncmp(name, "{s}", 3))
		snprintf(text, size, "%s", mr_plural(f->of ? f->of : f->count));
	else if (!strncmp(name, "{ex}", 4))
		snprintf(text, size, "%s", (f->of ? f->of : f->count) == 1 ? "ex" : "ices");
	else if (!strncmp(name, "{layer}", 7))
		snprintf(text, size, "%s", *k->layer ? k->layer : "frame");
	else if (!strncmp(name, "{what}", 6))
		snprintf(text, size, "%s", k->what);
	else if (!strncmp(name, "{pct}", 5))
		snprintf(text, size, "%.3g", 100 * f->value);
	else if (!strncmp(name, "{limit}", 7))
		snprintf(text, size, "%.3g", f->limit);
	else if (!strncmp(name, "{left}", 6))
		snprintf(text, size, "%s%s%s",
		    f->value > 0 ? "--outward turns parts that are inside out" : "",
		    f->value > 0 && f->limit > 0 ? ", " : "",
		    f->limit > 0 ? "mr-fill closes openings, which stay" : "");
	else if (!strncmp(name, "{at}", 4))
		add_place(f, text, size);
}

static void
fill_in(const mr_kept_finding *k, const char *sentence, char *text, size_t size)
{
	size_t n = strlen(text);

	while (*sentence && n + 1 < size) {
		if (*sentence != '{') {
			text[n++] = *sentence++;
			text[n] = '\0';
			continue;
		}
		put_word(k, sentence, text + n, size - n);
		n += strlen(text + n);
		sentence = strchr(sentence, '}') + 1;
	}
}

static void
make_sentence(const mr_kept_finding *k, char *text, size_t size)
{
	const entry *e = &table[k->f.kind];
	size_t n;

	*text = '\0';
	fill_in(k, e->sentence, text, size);
	n = strlen(text);
	if (*e->remedy && n + 2 < size) {
		memcpy(text + n, ": ", 3);
		fill_in(k, e->remedy, text, size);
		if (!text[n + 2])
			text[n] = '\0';
	}
}

static bool
is_news(const findings *known, const mr_kept_finding *k)
{
	for (size_t i = 0; i < known->n; i++) {
		const mr_kept_finding *old = &known->k[i];
		if (mr_finding_same(old, k) && k->f.count < 2 * old->f.count + (old->f.count == 0))
			return false;
	}
	return true;
}

/* All that is lost, as a list in one line. */
static void
say_losses(
    const findings *found, const findings *known, void (*say)(void *user, const char *text), void *user)
{
	char text[MR_ERROR_MAX] = "lost: ";
	size_t n = strlen(text), begun = n;

	for (size_t i = 0; i < found->n && n + 1 < sizeof text; i++) {
		const mr_kept_finding *k = &found->k[i];
		if (k->f.kind != MR_LOST || !is_news(known, k))
			continue;
		n += (size_t)snprintf(text + n, sizeof text - n, "%s%s%s%s", n > begun ? ", " : "", k->what,
		    *k->layer ? " of " : "", k->layer);
		if (k->f.count > 1 && n + 1 < sizeof text)
			n += (size_t)snprintf(text + n, sizeof text - n, " (%zu)", k->f.count);
	}
	if (n == begun)
		return;
	if (n > sizeof text - 8)
		n = sizeof text - 8;
	memcpy(text + n, " [lost]", 8);
	say(user, text);
}

/* Faces that are folded pass through others, and what does so is torn: one of them is said of a layer, and
 * all are counted. */
static bool
comes_of(mr_finding_kind kind, mr_finding_kind cause)
{
	bool passes = kind == MR_COLLIDED || kind == MR_TORN;

	return (cause == MR_FOLDED && (passes || kind == MR_CROSSING)) || (cause == MR_CROSSING && passes);
}

static bool
is_implied(const findings *found, const mr_kept_finding *k)
{
	for (size_t i = 0; i < found->n; i++)
		if (comes_of(k->f.kind, found->k[i].f.kind) && !strcmp(k->layer, found->k[i].layer))
			return true;
	return false;
}

void
findings_say(
    const findings *found, const findings *known, void (*say)(void *user, const char *text), void *user)
{
	char text[MR_ERROR_MAX];

	say_losses(found, known, say, user);
	for (size_t i = 0; i < found->n; i++) {
		const mr_kept_finding *k = &found->k[i];
		size_t n;
		if (k->f.kind == MR_LOST || !is_news(known, k) || is_implied(found, k))
			continue;
		make_sentence(k, text, sizeof text - 20);
		n = strlen(text);
		snprintf(text + n, sizeof text - n, " [%s]", mr_finding_name(k->f.kind));
		say(user, text);
	}
}

/* The book */

void
findings_collect(findings_book *book, const char *tool, const mr_finding *f)
{
	mr_kept_finding k;

	mr_finding_keep(&k, tool, f);
	findings_add(&book->found, &k);
}

/* Whether the frame is the last of a sequence that says how long it is. */
static bool
is_last(mr_ctx *ctx, const findings_book *book, mr_frame *f)
{
	const void *frames;
	size_t rows;

	return mr_layer_has(f, "handles", "frames") &&
	       mr_frame_get(ctx, f, "handles", "frames", (mr_shape){ '-', 'u', 1 }, &frames, &rows) ==
	           MR_OK &&
	       rows == 1 && f->number - book->key == *(const uint32_t *)frames;
}

mr_status
findings_judge(mr_ctx *ctx, findings_book *book, mr_frame *before, mr_frame *after)
{
	if (after->key) {
		book->key = after->number;
		book->judged = 0;
	}
	return mr_judge(ctx, before, after, is_last(ctx, book, before) ? NULL : &book->judged);
}

static void
add_all(findings *all, const findings *more)
{
	for (size_t i = 0; i < more->n; i++)
		findings_add(all, &more->k[i]);
}

mr_status
findings_settle(mr_ctx *ctx, findings_book *book, mr_frame *f, void (*say)(void *user, const char *text))
{
	findings all = { 0 };

	if (f->key)
		book->known.n = 0;
	MR_TRY(findings_read(ctx, f, &all));
	add_all(&book->carried, &all);
	add_all(&book->carried, &book->found);
	if (!book->found.n && !book->known.n)
		return MR_OK;
	add_all(&all, &book->known);
	if (!say)
		return MR_OK;
	findings_say(&book->found, &all, say, ctx->listener.user);
	add_all(&book->known, &book->found);
	add_all(&all, &book->found);
	return put(ctx, f, &all);
}

void
findings_count(mr_text *line, const findings *found)
{
	size_t count[MR_FINDING_KINDS] = { 0 };
	const char *before = ",\"findings\":{";

	for (size_t i = 0; i < found->n; i++)
		count[found->k[i].f.kind] += found->k[i].f.count ? found->k[i].f.count : 1;
	for (int kind = 0; kind < MR_FINDING_KINDS; kind++)
		if (count[kind]) {
			mr_text_add(line, "%s\"%s\":%zu", before, mr_finding_name((mr_finding_kind)kind),
			    count[kind]);
			before = ",";
		}
	if (found->n)
		mr_text_add(line, "}");
}

/* Verdicts */

static verdict
verdict_of(const mr_finding *f)
{
	const entry *e = &table[f->kind];
	double share = f->of ? (double)f->count / (double)f->of : fabs(f->value);

	return e->worst == VERDICT_POOR && e->unusable > 0 && share >= e->unusable ? VERDICT_UNUSABLE
	                                                                           : e->worst;
}

verdict
findings_verdict(const findings *all, const char **why)
{
	verdict worst = VERDICT_GOOD;

	*why = "";
	for (size_t i = 0; i < all->n; i++) {
		verdict v = verdict_of(&all->k[i].f);
		if (v <= worst)
			continue;
		worst = v;
		*why = mr_finding_name(all->k[i].f.kind);
	}
	return worst;
}

const char *
verdict_name(verdict v)
{
	static const char *const names[] = { "good", "poor", "unusable" };

	return names[v];
}
