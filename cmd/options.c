/* The command line by the table, getopt's way. */
#include "options.h"

#include <errno.h>
#include <limits.h>

/* Parses a finite number at the start of `text`; *end is what follows it. */
static bool
number_at(const char *text, char **end, double *value)
{
	*value = strtod(text, end);
	return *end != text && isfinite(*value) && strspn(text, " \t\n") == 0;
}

static mr_status
fail_range(mr_ctx *ctx, const char *what, const char *text, double min, double max)
{
	return mr_fail(ctx, MR_EUSAGE, "%s: %s is not between %.15g and %.15g", what, text, min, max);
}

mr_status
cmd_parse_count(mr_ctx *ctx, const char *what, const char *text, size_t min, size_t max, size_t *value)
{
	unsigned long long n;
	char *end;

	errno = 0;
	n = strtoull(text, &end, 10);
	if (*text < '0' || *text > '9' || *end)
		return mr_fail(ctx, MR_EUSAGE, "%s: '%s' is not a whole number", what, text);
	if (errno || n < min || n > max)
		return fail_range(ctx, what, text, (double)min, (double)max);
	*value = (size_t)n;
	return MR_OK;
}

static mr_status
fail_reals(mr_ctx *ctx, const char *what, const char *text, size_t count)
{
	if (count == 1)
		return mr_fail(ctx, MR_EUSAGE, "%s: '%s' is not a number", what, text);
	return mr_fail(
	    ctx, MR_EUSAGE, "%s: '%s' is not %zu numbers with commas between them", what, text, count);
}

bool
cmd_list_lacks(const char *list)
{
	size_t n = strlen(list);

	return n == 0 || *list == ',' || list[n - 1] == ',' || strstr(list, ",,");
}

mr_status
cmd_parse_reals(mr_ctx *ctx, const char *what, const char *text, size_t count, double *values)
{
	const char *at = text;

	for (size_t i = 0; i < count; i++) {
		char *end;
		if (!number_at(at, &end, &values[i]) || *end != (i + 1 < count ? ',' : '\0'))
			return fail_reals(ctx, what, text, count);
		at = end + 1;
	}
	return MR_OK;
}

/* A number; if `relative` is not NULL also in percent, with a % after it; "auto" is -1 if the metavar offers
 * it. */
static mr_status
parse_real(mr_ctx *ctx, const cmd_opt *o, const char *what, const char *text, bool *relative)
{
	bool percent = false, automatic = !strncmp(o->metavar, "auto|", 5) && !strcmp(text, "auto");
	double x = -1;
	char *end;

	if (!automatic) {
		bool number = number_at(text, &end, &x);
		percent = number && relative && *end == '%';
		if (!number || end[percent])
			return mr_fail(ctx, MR_EUSAGE, "%s: '%s' is %s", what, text,
			    relative ? "neither a number nor a percentage" : "not a number");
		x /= percent ? 100 : 1;
		if (x < o->min || x > o->max)
			return fail_range(ctx, what, text, o->min, o->max);
	}
	/* NOLINTNEXTLINE(clang-analyzer-core.NullDereference) only CMD_CALL has no value */
	*(double *)o->value = x;
	if (relative)
		*relative = percent;
	return MR_OK;
}

static mr_status
parse_size(mr_ctx *ctx, const cmd_opt *o, const char *what, const char *text)
{
	const char *x = strchr(text, 'x');
	size_t *size = o->value;
	char width[16];

	if (!x || x - text >= (int)sizeof width)
		return mr_fail(ctx, MR_EUSAGE, "%s: %s is not of the form WxH", what, text);
	snprintf(width, sizeof width, "%.*s", (int)(x - text), text);
	MR_TRY(cmd_parse_count(ctx, what, width, (size_t)o->min, (size_t)o->max, &size[0]));
	return cmd_parse_count(ctx, what, x + 1, (size_t)o->min, (size_t)o->max, &size[1]);
}

static mr_status
parse_range(mr_ctx *ctx, const cmd_opt *o, const char *what, const char *text)
{
	double *v = o->value;

	MR_TRY(cmd_parse_reals(ctx, what, text, 2, v));
	return v[0] < v[1] ? MR_OK : mr_fail(ctx, MR_EUSAGE, "%s: %g is not below %g", what, v[0], v[1]);
}

static mr_status
parse_choice(mr_ctx *ctx, const cmd_opt *o, const char *what, const char *text)
{
	size_t n = strlen(text);
	const char *word = o->metavar;

	for (int i = 0;; i++) {
		size_t length = strcspn(word, "|");
		if (n == length && !memcmp(word, text, n)) {
			*(int *)o->value = i;
			return MR_OK;
		}
		if (!word[length])
			return mr_fail(ctx, MR_EUSAGE, "%s: '%s' is none of %s", what, text, o->metavar);
		word += length + 1;
	}
}

static mr_status
parse_value(mr_ctx *ctx, const cmd_opt *o, const char *text)
{
	bool relative;
	char what[48];

	snprintf(what, sizeof what, "--%s", o->name);
	switch (o->kind) {
	case CMD_FLAG:
	case CMD_OFF:
		*(bool *)o->value = o->kind == CMD_FLAG;
		return MR_OK;
	case CMD_REAL:
		return parse_real(ctx, o, what, text, NULL);
	case CMD_COUNT:
		return cmd_parse_count(ctx, what, text, (size_t)o->min, (size_t)o->max, o->value);
	case CMD_CHOICE:
		return parse_choice(ctx, o, what, text);
	case CMD_TEXT:
		*(const char **)o->value = text;
		return MR_OK;
	case CMD_LENGTH:
		return parse_real(
		    ctx, o, what, text, (bool *)(void *)((double *)o->value + 1)); /* after it */
	case CMD_SHARE:
		return parse_real(ctx, o, what, text, &relative);
	case CMD_VECTOR: {
		double v[3];
		MR_TRY(cmd_parse_reals(ctx, what, text, 3, v));
		*(mr_v3 *)o->value = mr_vec(v[0], v[1], v[2]);
		return MR_OK;
	}
	case CMD_SIZE:
		return parse_size(ctx, o, what, text);
	case CMD_RANGE:
		return parse_range(ctx, o, what, text);
	case CMD_CALL:
		return mr_prefix(ctx, o->call(ctx, o, text), "%s=%s", what, text);
	}
	return MR_OK;
}

/* The option of this name, or where it is NULL of this letter. */
static const cmd_opt *
find(const cmd_opt *const tables[2], char letter, const char *name, size_t length, int *table)
{
	for (*table = 0; *table < 2; ++*table)
		for (const cmd_opt *o = tables[*table]; o && o->name; o++)
			if (name ? strlen(o->name) == length && !memcmp(o->name, name, length)
				 : o->letter == letter)
				return o;
	return NULL;
}

size_t
cmd_unlike(const char *a, size_t n, const char *b)
{
	size_t m = strlen(b), shorter = n < m ? n : m, head = 0, tail = 0;

	while (head < shorter && a[head] == b[head])
		head++;
	while (tail < shorter - head && a[n - 1 - tail] == b[m - 1 - tail])
		tail++;
	return head == n ? 0 : (n > m ? n : m) - head - tail;
}

/* Refuses a word that is no option, and names the one it is like: of which half is wrong at most. */
static mr_status
fail_unknown(mr_ctx *ctx, const cmd_opt *const tables[2], const char *word, size_t n)
{
	const char *like = NULL, *name = word + strspn(word, "-");
	size_t letters = n - (size_t)(name - word), best = letters > 1 ? letters / 2 + 1 : 0;

	for (int k = 0; k < 2; k++)
		for (const cmd_opt *o = tables[k]; o && o->name; o++) {
			size_t d = cmd_unlike(name, letters, o->name);
			if (d < best) {
				best = d;
				like = o->name;
			}
		}
	return mr_fail(ctx, MR_EUSAGE, "unknown option %.*s%s%s%s", (int)n, word,
	    like ? ": did you mean --" : "", like ? like : "", like ? "?" : "");
}

typedef struct parser {
	mr_ctx *ctx;
	int argc, at;
	char **argv;
	const cmd_opt *const *tables;
	cmd_args *args;
} parser;

/* Only the layer changes the result, among the shared options. */
static bool
changes_result(const cmd_opt *o, int table)
{
	return table == 0 || o->letter == 'l';
}

static void
note_typed(parser *p, int first)
{
	for (int i = first; i <= p->at; i++)
		p->args->typed[p->args->typed_count++] = p->argv[i];
}

static bool
takes_argument(const cmd_opt *o)
{
	return o->kind != CMD_FLAG && o->kind != CMD_OFF && (o->kind != CMD_CALL || o->metavar);
}

/* Gives the option its argument: the `attached` text where there is one, else the next word. */
static mr_status
take_value(parser *p, const cmd_opt *o, int table, const char *attached)
{
	if (!takes_argument(o) && attached)
		return mr_fail(p->ctx, MR_EUSAGE, "--%s takes no argument", o->name);
	if (takes_argument(o) && !attached) {
		if (++p->at >= p->argc)
			return mr_fail(p->ctx, MR_EUSAGE, "--%s needs an argument: %s", o->name, o->metavar);
		attached = p->argv[p->at];
	}
	MR_TRY(parse_value(p->ctx, o, attached));
	if (table == 0)
		p->args->given |= UINT64_C(1) << (o - p->tables[0]);
	return MR_OK;
}

static mr_status
parse_long(parser *p)
{
	const char *name = p->argv[p->at] + 2, *equals = strchr(name, '=');
	size_t length = equals ? (size_t)(equals - name) : strlen(name);
	int table, first = p->at;
	const cmd_opt *o = find(p->tables, 0, name, length, &table);

	if (!o)
		return fail_unknown(p->ctx, p->tables, name - 2, length + 2);
	MR_TRY(take_value(p, o, table, equals ? equals + 1 : NULL));
	if (changes_result(o, table))
		note_typed(p, first);
	return MR_OK;
}

/* A word of short options: flags may share it, the last may take the rest as its argument. */
static mr_status
parse_short(parser *p)
{
	const char *letters = p->argv[p->at] + 1;
	int table = 1, first = p->at;
	bool noted = false;

	if (letters[1] && find(p->tables, 0, letters, strlen(letters), &table))
		return fail_unknown(p->ctx, p->tables, letters - 1, strlen(letters) + 1);
	while (*letters) {
		const cmd_opt *o = find(p->tables, *letters, NULL, 0, &table);
		if (!o)
			return fail_unknown(p->ctx, p->tables, p->argv[p->at], strlen(p->argv[p->at]));
		letters++;
		noted = noted || changes_result(o, table);
		if (takes_argument(o)) {
			MR_TRY(take_value(p, o, table, *letters ? letters : NULL));
			break;
		}
		MR_TRY(take_value(p, o, table, NULL));
	}
	if (noted)
		note_typed(p, first);
	return MR_OK;
}

mr_status
cmd_parse(mr_ctx *ctx, int argc, char **argv, const cmd_opt *const tables[2], cmd_args *args)
{
	parser p = { ctx, argc, 1, argv, tables, args };
	bool options = true;

	*args = (cmd_args){ .operands = MR_NEW(ctx, (size_t)argc, char *),
		.typed = MR_NEW(ctx, (size_t)argc, char *) };
	for (; p.at < argc; p.at++) {
		char *word = argv[p.at];
		if (options && !strcmp(word, "--")) {
			options = false;
		} else if (options && word[0] == '-' && word[1] == '-') {
			MR_TRY(parse_long(&p));
		} else if (options && word[0] == '-' && word[1]) {
			MR_TRY(parse_short(&p));
		} else {
			args->operands[args->operand_count++] = word;
			note_typed(&p, p.at);
		}
	}
	return MR_OK;
}

static void
print_default(FILE *out, const cmd_opt *o)
{
	const char *word = o->metavar;

	switch (o->kind) {
	case CMD_REAL:
	case CMD_SHARE:
	case CMD_LENGTH: /* none is relative */
		fprintf(out, " (default %.6g)", *(double *)o->value);
		break;
	case CMD_COUNT:
		fprintf(out, " (default %zu)", *(size_t *)o->value);
		break;
	case CMD_CHOICE:
		for (int i = *(int *)o->value; i > 0; i--)
			word += strcspn(word, "|") + 1;
		fprintf(out, " (default %.*s)", (int)strcspn(word, "|"), word);
		break;
	case CMD_TEXT:
		if (*(const char **)o->value)
			fprintf(out, " (default %s)", *(const char **)o->value);
		break;
	case CMD_SIZE:
		fprintf(out, " (default %zux%zu)", ((size_t *)o->value)[0], ((size_t *)o->value)[1]);
		break;
	case CMD_FLAG:
	case CMD_OFF:
	case CMD_VECTOR:
	case CMD_RANGE:
	case CMD_CALL:
		break;
	}
}

/* A table may say in `help` itself what stands for the default, as "(default ...)". */
void
cmd_print_options(FILE *out, const cmd_opt *table)
{
	for (const cmd_opt *o = table; o && o->name; o++) {
		char usage[128];
		snprintf(usage, sizeof usage, "%c%c%s --%s%s%s", o->letter ? '-' : ' ',
		    o->letter ? o->letter : ' ', o->letter ? "," : " ", o->name, takes_argument(o) ? " " : "",
		    takes_argument(o) ? o->metavar : "");
		fprintf(out, strlen(usage) < 30 ? "  %-30s%s" : "  %s\n                                %s",
		    usage, o->help);
		if (!strstr(o->help, "(default"))
			print_default(out, o);
		fputc('\n', out);
	}
}

static void
describe_words(mr_text *t, const char *words)
{
	for (const char *between = "\"choices\":["; *words; between = ",") {
		size_t n = strcspn(words, "|");
		mr_text_add(t, "%s", between);
		mr_text_json(t, words, n);
		words += n + (words[n] == '|');
	}
	mr_text_add(t, "],");
}

/* A number by a name, with a comma; none where it is not finite. */
static void
describe_number(mr_text *t, const char *name, double x)
{
	if (!isfinite(x))
		return;
	mr_text_add(t, "\"%s\":", name);
	mr_text_number(t, x);
	mr_text_add(t, ",");
}

static void
describe_string(mr_text *t, const char *name, const char *s)
{
	if (!s || !*s)
		return;
	mr_text_add(t, "\"%s\":", name);
	mr_text_json(t, s, strlen(s));
	mr_text_add(t, ",");
}

/* The default, unless `help` says what stands for it. */
static void
describe_default(mr_text *t, const cmd_opt *o)
{
	const char *word = o->metavar;
	size_t i;

	if (strstr(o->help, "(default"))
		return;
	switch (o->kind) {
	case CMD_REAL:
	case CMD_SHARE:
	case CMD_LENGTH:
		describe_number(t, "default", *(double *)o->value);
		break;
	case CMD_COUNT:
		describe_number(t, "default", (double)*(size_t *)o->value);
		break;
	case CMD_CHOICE:
		for (i = (size_t) * (int *)o->value; i > 0; i--)
			word += strcspn(word, "|") + 1;
		mr_text_add(t, "\"default\":");
		mr_text_json(t, word, strcspn(word, "|"));
		mr_text_add(t, ",");
		break;
	case CMD_TEXT:
		describe_string(t, "default", *(const char **)o->value);
		break;
	default:
		break;
	}
}

static void
describe_option(mr_text *t, const cmd_opt *o)
{
	static const char *const kinds[] = { "flag", "flag", "real", "share", "count", "choice", "text",
		"length", "vector", "size", "range", "text" };
	bool ranged = o->kind == CMD_REAL || o->kind == CMD_SHARE || o->kind == CMD_COUNT ||
	              o->kind == CMD_SIZE;

	mr_text_add(t, "{");
	describe_string(t, "name", o->name);
	describe_string(t, "letter", (char[]){ o->letter, '\0' });
	describe_string(t, "argument", takes_argument(o) ? o->metavar : NULL);
	if (o->kind == CMD_CHOICE)
		describe_words(t, o->metavar);
	if (ranged) {
		describe_number(t, "min", o->min);
		describe_number(t, "max", o->max);
	}
	describe_default(t, o);
	if (o->kind == CMD_CALL)
		mr_text_add(t, "\"repeats\":true,");
	describe_string(t, "help", o->help);
	mr_text_add(t, "\"kind\":\"%s\"}", takes_argument(o) ? kinds[o->kind] : "flag");
}

void
cmd_describe_options(mr_text *t, const cmd_opt *table)
{
	for (const cmd_opt *o = table; o && o->name; o++) {
		mr_text_add(t, o == table ? "\n  " : ",\n  ");
		describe_option(t, o);
	}
}
