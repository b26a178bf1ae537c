/* The life of a command: its line, its streams, its frames one by one, its end. */
#include "cmd.h"

#include "base/memory.h"
#include "base/text.h"
#include "findings.h"
#include "formats/filename.h"
#include "help.h"
#include "mesh/validate.h"
#include "place.h"
#include "signals.h"
#include "solve/solver.h"
#include "stream/record.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

enum { EXIT_GOOD = 0, EXIT_DATA = 1, EXIT_USAGE = 2 };

struct cmd_state {
	size_t threads;
	cmd_args args;
	const char *input; /* of a sink: -i */
	const char *stats_path;
	bool help, describe, version, no_history;

	char *history; /* the line this command adds */
	mr_writer *writer;
	int out;            /* descriptor of the stream */
	FILE *text, *stats; /* a sink's output; --stats */
	mr_outfile output_file, stats_file;
	mr_side **sides; /* that the tool has opened */
	size_t side_count, side_room;
	place_guard places;
	bool opens_stream; /* the stream's own file is opened */

	mr_text figures;    /* of the frame at work, as they go into the line of --stats */
	findings_book book; /* what was found */

	const char *frame_name;
	bool ending;           /* all frames were read */
	bool lost_key;         /* the key failed: its deltas go with it */
	uint64_t failed, lost; /* frames left out: that failed, that depended on one that failed */
	double started, shown; /* when the frame began; when progress was last shown, 0: never */
};

/* Control characters would break the line, or talk to the terminal: they become '?'. */
static void
make_line(char *text)
{
	for (; *text; text++)
		if ((unsigned char)*text < ' ' || *text == 127)
			*text = '?';
}

static void
say(const cmd *c, const char *format, ...)
{
	char sentence[2 * MR_ERROR_MAX];
	va_list args;

	va_start(args, format);
	vsnprintf(sentence, sizeof sentence, format, args);
	va_end(args);
	make_line(sentence);
	fprintf(stderr, "%s: %s\n", c->name, sentence);
}

static void
clear_progress(cmd *c)
{
	if (c->state->shown > 0)
		fputs("\r\033[K", stderr);
	c->state->shown = 0;
}

/* A sentence, with the frame in front where there is one. */
static void
say_of_frame(void *user, const char *sentence)
{
	cmd *c = user;

	clear_progress(c);
	if (c->state->frame_name)
		say(c, "frame %llu (%s): %s", (unsigned long long)c->frame, c->state->frame_name, sentence);
	else
		say(c, "%s", sentence);
}

static void
say_failure(cmd *c)
{
	const mr_ctx *ctx = *c->ctx.error ? &c->ctx : &c->keep;
	const char *remedy = findings_remedy(ctx->remedy);
	char text[2 * MR_ERROR_MAX];

	snprintf(text, sizeof text, "%s%s%s", ctx->error, remedy ? ": " : "", remedy ? remedy : "");
	say_of_frame(c, text);
}

static _Noreturn void
leave(cmd *c, int code)
{
	mr_outfile_drop(&c->ctx, &c->state->output_file);
	mr_outfile_drop(&c->ctx, &c->held);
	mr_outfile_drop(&c->ctx, &c->state->stats_file);
	exit(code);
}

bool cmd_piped;

/* Whether somebody sits in front of it. */
static bool
is_terminal(int fd)
{
	return isatty(fd) && !(cmd_piped && fd == STDOUT_FILENO);
}

static bool
is_pipe(int fd)
{
	struct stat st;

	return fstat(fd, &st) == 0 && (S_ISFIFO(st.st_mode) || S_ISSOCK(st.st_mode));
}

/* Whether stdout is where the output goes. */
static bool
writes_stdout(const cmd *c)
{
	const char *output = c->tool->names_output ? c->operands[0] : c->output;

	return !output || !strcmp(output, "-");
}

/* Lets the next tool of the pipe know that this one has reported its failure, so that it stays silent. */
static void
pass_failure(cmd *c)
{
	struct cmd_state *s = c->state;

	if (c->sink || !writes_stdout(c) || !is_pipe(STDOUT_FILENO))
		return;
	signal(SIGPIPE, SIG_IGN); /* whether anyone is left who reads it or not */
	if (s->writer || mr_writer_open(&c->ctx, STDOUT_FILENO, c->packing, &s->writer) == MR_OK)
		mr_writer_fail(&c->ctx, s->writer);
}

/* A wrong command line found at a later frame, after output has begun, is an error like others. */
static _Noreturn void
die(cmd *c, mr_status status)
{
	bool usage = status == MR_EUSAGE && (c->frame < 2 || !writes_stdout(c));

	say_failure(c);
	if (usage)
		fprintf(stderr, "Try '%s --help'.\n", c->name);
	else
		pass_failure(c);
	leave(c, usage ? EXIT_USAGE : EXIT_DATA);
}

static void
try(cmd *c, mr_status status)
{
	if (status < 0)
		die(c, status);
}

static mr_status
fail_system(cmd *c, const char *what)
{
	return mr_fail(&c->ctx, MR_EIO, "%s: %s", what, strerror(errno));
}

/* Remarks and progress */

static void
show_warning(void *user, const char *text)
{
	char sentence[MR_ERROR_MAX + 16];

	snprintf(sentence, sizeof sentence, "warning: %s", text);
	say_of_frame(user, sentence);
}

static void
collect_finding(void *user, const mr_finding *f)
{
	cmd *c = user;

	findings_collect(&c->state->book, c->name, f);
}

/* The streams beside the first must end with it; then runs the last act of a tool, and reports what it found.
 */
static mr_status
finish(cmd *c)
{
	struct cmd_state *s = c->state;

	s->book.found.n = 0;
	for (size_t i = 0; i < s->side_count; i++)
		MR_TRY(mr_side_end(&c->ctx, s->sides[i], c->frame));
	if (c->tool->names_output && c->frame == 0)
		return mr_fail(&c->ctx, MR_EMISSING, "the stream has no frame");
	s->ending = true;
	if (c->tool->finish)
		MR_TRY(c->tool->finish(c));
	if (!c->quiet)
		findings_say(&s->book.found, &s->book.carried, show_warning, c);
	return MR_OK;
}

/* After a second of work, at most ten times a second. */
static void
show_progress(void *user, const char *what, double share)
{
	cmd *c = user;
	struct cmd_state *s = c->state;
	double now = mr_seconds();

	if (now - s->started < 1 || now - s->shown < 0.1)
		return;
	s->shown = now;
	fprintf(stderr, "\r\033[K%s: %s: %s %.0f %%", c->name, s->frame_name ? s->frame_name : "", what,
	    100 * share);
}

/* The command line */

/* Adds a word to the line, in quotes where a shell would need them. */
static void
append_word(mr_text *line, const char *word)
{
	static const char plain[] =
	    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_=+:,./%@";
	bool quote = !*word || word[strspn(word, plain)] != '\0';

	mr_text_add(line, quote ? " '%s'" : " %s", word);
}

/* "mr 1.0: mr-smooth -t 20 -l mesh".  Other options that all tools share stay out of it: they do not change
 * the result.  Every key frame has the line, and there may be as many as names: it is cut to a page. */
static void
compose_history(cmd *c, const cmd_args *args)
{
	enum { MOST = 4096 };
	mr_text line = { .ctx = &c->ctx };
	size_t i = 0;

	mr_text_add(&line, "mr " MR_VERSION ": %s", c->name);
	for (; i < args->typed_count && line.n < MOST; i++)
		append_word(&line, args->typed[i]);
	if (i < args->typed_count)
		mr_text_add(&line, " ...");
	make_line(line.s);
	c->state->history = line.s;
}

/* Whether the tool has this one of the options that tools share. */
static bool
heeds(const cmd_tool *tool, char letter)
{
	switch (letter) {
	case 'o':
		return !tool->names_output;
	case 'l':
		return !tool->fixed_layers;
	case 'i':
		return tool->sink && tool->operands;
	default:
		return true;
	}
}

/* Whether one of the tool's own options has the letter: the shared one has its name alone there. */
static bool
takes(const cmd_tool *tool, char letter)
{
	for (const cmd_opt *o = tool->options; o && o->name; o++)
		if (o->letter == letter)
			return true;
	return false;
}

/* A source reads no stream: one by its last operand's name, of several, is its output. */
static void
take_output(cmd *c, cmd_args *args)
{
	char *last = args->operand_count > 1 ? args->operands[args->operand_count - 1] : "";
	const char *end = strrchr(last, '.');

	if (!c->tool->source || c->output || !end || strcmp(end, ".mrs") != 0)
		return;
	c->output = last;
	args->operand_count--;
}

static void
parse_command_line(cmd *c, int argc, char **argv)
{
	struct cmd_state *s = c->state;
	const cmd_opt standard[] = {
		{ 'o', "output", CMD_TEXT, &c->output, 0, 0, "FILE", "write there instead of stdout", NULL },
		{ 'l', "layer", CMD_TEXT, &c->layer, 0, 0, "NAME", "the layer to work on", NULL },
		{ 'j', "threads", CMD_COUNT, &s->threads, 0, 1024, "N",
		    "threads, 0: all cores; the result is the same for any number", NULL },
		{ 'k', "keep-going", CMD_FLAG, &c->keep_going, 0, 0, "",
		    "skip a frame that fails, and exit 1 at the end", NULL },
		{ 0, "sync", CMD_FLAG, &c->ctx.sync, 0, 0, "",
		    "bring files to the disk before they get their names", NULL },
		{ 0, "scratch", CMD_TEXT, &c->ctx.scratch, 0, 0, "DIR",
		    "keep data of over 64 MB in an unnamed file there, not in memory", NULL },
		{ 0, "stats", CMD_TEXT, &s->stats_path, 0, 0, "FILE",
		    "write one JSON object per frame, with the tool's figures", NULL },
		{ 0, "no-history", CMD_FLAG, &s->no_history, 0, 0, "", "add no line to the frames' history",
		    NULL },
		{ 'v', "verbose", CMD_FLAG, &c->verbose, 0, 0, "", "report each step", NULL },
		{ 'q', "quiet", CMD_FLAG, &c->quiet, 0, 0, "", "look for no findings, show no progress", NULL },
		{ 'h', "help", CMD_FLAG, &s->help, 0, 0, "", "print this and exit", NULL },
		{ 0, "describe", CMD_FLAG, &s->describe, 0, 0, "", "print the options as JSON and exit",
		    NULL },
		{ 'V', "version", CMD_FLAG, &s->version, 0, 0, "", "print the version and exit", NULL },
		{ 'i', "input", CMD_TEXT, &s->input, 0, 0, "FILE", "read that stream (default stdin)", NULL },
		{ 0 },
	};
	cmd_opt heeded[sizeof standard / sizeof *standard] = { { 0 } };
	const cmd_opt *const tables[2] = { c->tool->options, heeded };
	mr_status parsed;
	size_t n = 0;

	for (const cmd_opt *o = standard; o->name; o++)
		if (heeds(c->tool, o->letter)) {
			heeded[n] = *o;
			heeded[n++].letter = takes(c->tool, o->letter) ? 0 : o->letter;
		}
	parsed = cmd_parse(&c->ctx, argc, argv, tables, &s->args);
	if (s->help)
		cmd_help(c, heeded);
	else if (s->describe)
		cmd_describe(c, heeded);
	else if (s->version)
		printf("%s (mr) %s\n", c->name, MR_VERSION);
	if (s->help || s->describe || s->version) {
		if (fflush(stdout) || ferror(stdout))
			die(c, fail_system(c, "stdout"));
		exit(EXIT_GOOD);
	}
	try(c, parsed);
	if (c->layer && cmd_list_lacks(c->layer)) /* what else it may be is the tool's: of one it is a list */
		try(c, cmd_layer_name(c, "--layer", ""));
	take_output(c, &s->args);
	compose_history(c, &s->args);
	c->operands = s->args.operands;
	c->operand_count = s->args.operand_count;
	if (!c->tool->names_output)
		try(c, place_stdin_once(&c->ctx, c->operands, 0, c->operand_count));
}

bool
cmd_given(const cmd *c, const char *name)
{
	const cmd_opt *table = c->tool->options, *o = table;

	while (strcmp(o->name, name))
		o++;
	return c->state->args.given >> (o - table) & 1;
}

mr_status
cmd_idle(cmd *c, const char *names, bool idle, const char *why)
{
	for (size_t n = 0; idle && *names; names += n, names += *names == ' ') {
		n = strcspn(names, " ");
		if (cmd_given(c, mr_format(&c->ctx, "%.*s", (int)n, names)))
			return mr_fail(&c->ctx, MR_EUSAGE, "--%.*s has no effect %s", (int)n, names, why);
	}
	return MR_OK;
}

mr_status
cmd_output_name(cmd *c, const char *what, const char *suffix)
{
	size_t n = c->operand_count;
	bool terminal = is_terminal(STDOUT_FILENO) && suffix;
	char *last = n ? c->operands[n - 1] : NULL;

	if (n == 0)
		return mr_fail(&c->ctx, MR_EUSAGE, "%s is not named", what);
	if (!suffix || ((!mr_outname_suits(c->operands[0], suffix) || !strcmp(c->operands[0], "-")) &&
			   mr_outname_suits(last, suffix))) {
		memmove(c->operands + 1, c->operands, (n - 1) * sizeof *c->operands);
		c->operands[0] = last;
	}
	MR_TRY(place_stdin_once(&c->ctx, c->operands, 1, n));
	if (suffix && !mr_outname_suits(c->operands[0], suffix))
		return mr_fail(&c->ctx, MR_EUSAGE, "%s is not named: %s does not end in %s", what,
		    c->operands[0], suffix);
	if (!strcmp(c->operands[0], "-") && terminal)
		return mr_fail(&c->ctx, MR_EUSAGE, "%s is not written to a terminal", what);
	if (n > 1 && c->state->input)
		return mr_fail(&c->ctx, MR_EUSAGE, "%s and -i %s are both the first stream", c->operands[1],
		    c->state->input);
	return MR_OK;
}

mr_status
cmd_layer_name(cmd *c, const char *option, const char *name)
{
	if (name && !mr_name_valid(name, MR_LAYER_MAX))
		return mr_fail(&c->ctx, MR_EUSAGE,
		    "%s: a layer cannot be called '%s': 1 to %d printable characters, no blanks", option,
		    name, (int)MR_LAYER_MAX);
	return MR_OK;
}

/* Opening and closing the outputs */

static mr_status
permit(mr_ctx *ctx, const char *path, bool writes)
{
	struct cmd_state *s = ((cmd *)ctx->listener.user)->state;
	place_use use = !writes ? PLACE_READ : s->opens_stream ? PLACE_STREAM : PLACE_WRITE;

	return place_claim(ctx, &s->places, path, use);
}

/* Whether -o names a file, other than stdout. */
static bool
names_file(const cmd *c)
{
	return c->output && !place_is_dash(c->output) && !place_is(STDOUT_FILENO, c->output);
}

/* The output as a descriptor: stdout, or -o. */
static void
open_output(cmd *c, place_use use)
{
	struct cmd_state *s = c->state;

	s->out = STDOUT_FILENO;
	if (!names_file(c))
		return;
	try(c, place_check_name(&c->ctx, "-o", c->output, use));
	if (!*c->output)
		die(c, mr_fail(&c->ctx, MR_EUSAGE, "--output: a file without a name"));
	s->opens_stream = use == PLACE_STREAM;
	try(c, mr_outfile_open(&c->ctx, c->output, &s->output_file));
	s->opens_stream = false;
	s->out = s->output_file.fd;
}

static void
open_writer(cmd *c)
{
	struct cmd_state *s = c->state;

	open_output(c, PLACE_STREAM);
	if (is_terminal(s->out))
		die(c, mr_fail(&c->ctx, MR_EUSAGE,
			   "a stream is binary and is not written to a terminal: pipe it on, or name a file "
			   "by -o"));
	try(c, mr_writer_open(&c->ctx, s->out, c->packing, &s->writer));
}

/* To write text to a file, which stays open when that is closed. */
static FILE *
open_copy(cmd *c, int fd, const char *path)
{
	int copy = dup(fd);
	FILE *text = copy < 0 ? NULL : fdopen(copy, "w");

	if (!text)
		die(c, fail_system(c, path));
	return text;
}

static void
open_text(cmd *c)
{
	open_output(c, PLACE_WRITE);
	c->state->text = c->state->out == STDOUT_FILENO ? stdout : open_copy(c, c->state->out, c->output);
}

static void
open_stats(cmd *c)
{
	struct cmd_state *s = c->state;
	const char *path = s->stats_path;

	if (!path)
		return;
	if (writes_stdout(c) && place_is(STDOUT_FILENO, path))
		die(c, mr_fail(&c->ctx, MR_EUSAGE, "--stats: %s is the output as well", path));
	s->stats = place_is_dash(path) || place_is(STDERR_FILENO, path) ? stderr
	           : place_is(STDOUT_FILENO, path)                      ? stdout
	                                                                : NULL;
	if (s->stats)
		return;
	try(c, place_check_name(&c->ctx, "--stats", path, PLACE_WRITE));
	try(c, mr_outfile_open(&c->ctx, path, &s->stats_file));
	s->stats = open_copy(c, s->stats_file.fd, path);
}

/* Closing stdout is part of success. */
static void
close_outputs(cmd *c)
{
	struct cmd_state *s = c->state;

	if (s->stats_file.path && fclose(s->stats))
		die(c, fail_system(c, s->stats_path));
	if (s->writer)
		try(c, mr_writer_end(&c->ctx, s->writer));
	if (s->text && (ferror(s->text) || fflush(s->text)))
		die(c, fail_system(c, c->output ? c->output : "stdout"));
	if (c->ctx.sync && writes_stdout(c))
		try(c, mr_sync(&c->ctx, STDOUT_FILENO, "stdout"));
	if (close(STDOUT_FILENO))
		die(c, fail_system(c, "stdout"));
	try(c, mr_outfile_keep(&c->ctx, &s->output_file));
	try(c, mr_outfile_keep(&c->ctx, &c->held));
	try(c, mr_outfile_keep(&c->ctx, &s->stats_file));
}

void
cmd_print(cmd *c, const char *format, ...)
{
	va_list args;

	va_start(args, format);
	vfprintf(c->state->text, format, args);
	va_end(args);
}

/* Figures */

void
cmd_figure(cmd *c, const char *name, double value)
{
	mr_text *t = &c->state->figures;

	mr_text_add(t, ",");
	mr_text_json(t, name, strlen(name));
	mr_text_add(t, ":");
	mr_text_number(t, value);
}

void
cmd_figures(cmd *c, const cmd_field *table, const void *result)
{
	for (; c->stats && table->name; table++) {
		const char *field = (const char *)result + table->offset;
		size_t count = table->count ? *(const size_t *)(const void *)field : 0;
		double value = table->count ? (double)count : *(const double *)(const void *)field;
		if (count != MR_UNKNOWN && !isnan(value))
			cmd_figure(c, table->name, value);
	}
}

void
cmd_gaps(cmd *c, const mr_gaps *gaps)
{
	static const cmd_field figures[] = {
		{ "points_to_surface_mean", false, offsetof(mr_gaps, points.mean) },
		{ "points_to_surface_99", false, offsetof(mr_gaps, points.high) },
		{ "points_to_surface_max", false, offsetof(mr_gaps, points.max) },
		{ "surface_to_points_mean", false, offsetof(mr_gaps, surface.mean) },
		{ "surface_to_points_99", false, offsetof(mr_gaps, surface.high) },
		{ "surface_to_points_max", false, offsetof(mr_gaps, surface.max) },
		{ "bare", false, offsetof(mr_gaps, bare) },
		{ 0 },
	};

	cmd_figures(c, figures, gaps);
}

/* One line of --stats: a JSON object. */
static void
print_stats(cmd *c, double seconds)
{
	const struct cmd_state *s = c->state;
	const char *name = s->frame_name ? s->frame_name : "";
	mr_text line = { .ctx = &c->ctx };

	if (!s->stats || (c->keeps && !s->ending))
		return;
	mr_text_add(
	    &line, "{\"tool\":\"%s\",\"frame\":%llu,\"name\":", c->name, (unsigned long long)c->frame);
	mr_text_json(&line, name, strlen(name));
	mr_text_add(&line, ",\"seconds\":%.6f,\"peak_bytes\":%.0f", seconds, mr_memory_peak());
	mr_text_add(&line, "%s", s->figures.s ? s->figures.s : "");
	findings_count(&line, &s->book.found);
	mr_text_add(&line, "}\n");
	if (fputs(line.s, s->stats) < 0 || fflush(s->stats))
		die(c, fail_system(c, s->stats_path));
}

/* Frames */

/* name: of the frame; NULL: a source is to make it. */
static void
begin_frame(cmd *c, const char *name)
{
	c->state->frame_name = name;
	c->state->started = mr_seconds();
	c->state->figures = (mr_text){ .ctx = &c->ctx };
	c->state->book.found.n = 0;
}

mr_status
cmd_send(cmd *c, const mr_frame *f)
{
	mr_frame with_history = *f;

	if (c->tool->source) {
		c->frame++;
		c->state->frame_name = f->name;
		if (!c->state->no_history)
			MR_TRY(mr_frame_add_history(&c->ctx, &with_history, c->state->history));
	}
	MR_TRY(findings_settle(&c->ctx, &c->state->book, &with_history, c->quiet ? NULL : show_warning));
	MR_TRY(mr_check_made(&c->ctx, &with_history));
	MR_TRY(mr_writer_put(&c->ctx, c->state->writer, &with_history));
	if (c->tool->source) {
		print_stats(c, mr_seconds() - c->state->started);
		begin_frame(c, NULL);
	}
	return MR_OK;
}

static mr_status
work_on(cmd *c, mr_frame *f)
{
	const cmd_tool *tool = c->tool;
	mr_frame before = { 0 };

	MR_ENTER(&c->ctx);
	if (!c->sink)
		mr_frame_copy(&c->ctx, f, &before);
	if (!c->sink && !c->state->no_history)
		MR_TRY(mr_frame_add_history(&c->ctx, f, c->state->history));
	c->result = c->stats && tool->figures ? MR_NEW_ZERO(&c->ctx, CMD_RESULT, char) : NULL;
	MR_TRY(tool->frame(c, f));
	if (c->result && tool->figures)
		cmd_figures(c, tool->figures, c->result);
	if (c->sink)
		return findings_settle(&c->ctx, &c->state->book, f, c->quiet ? NULL : show_warning);
	MR_TRY(mr_judge_losses(&c->ctx, &before, f));
	if (tool->judged && !c->no_check)
		MR_TRY(findings_judge(&c->ctx, &c->state->book, &before, f));
	return tool->sends || c->keeps ? MR_OK : cmd_send(c, f);
}

mr_status
cmd_send_kept(cmd *c, mr_frame *f, mr_status (*work)(cmd *c, mr_frame *f))
{
	c->frame = f->number;
	begin_frame(c, f->name);
	MR_TRY(work(c, f));
	MR_TRY(cmd_send(c, f));
	clear_progress(c);
	print_stats(c, mr_seconds() - c->state->started);
	c->state->frame_name = NULL;
	return MR_OK;
}

static void
leave_out(cmd *c)
{
	say_failure(c);
	if (c->state->writer)
		mr_writer_skipped(c->state->writer);
	c->state->failed++;
}

static mr_status
read_operands(cmd *c)
{
	size_t count = c->operand_count ? c->operand_count : 1;

	for (size_t i = 0; i < count; i++) {
		MR_SCOPE(&c->ctx);
		mr_status status = c->tool->source(c, c->operand_count ? c->operands[i] : "-");
		if (status < 0 && (!c->keep_going || status == MR_EUSAGE))
			return status;
		if (status < 0) {
			c->frame++;
			leave_out(c);
			begin_frame(c, NULL);
		}
	}
	return MR_OK;
}

static void
one_frame(cmd *c, mr_frame *f)
{
	struct cmd_state *s = c->state;
	MR_SCOPE(&c->ctx);
	mr_status status;

	f->number = ++c->frame; /* over all the streams */
	if (s->lost_key && !f->key) {
		s->lost++;
		return;
	}
	begin_frame(c, f->name);
	*c->ctx.error = *c->keep.error = '\0';
	status = work_on(c, f);
	clear_progress(c);
	if (status >= 0)
		print_stats(c, mr_seconds() - s->started);
	else if (c->keep_going && status != MR_EUSAGE)
		leave_out(c);
	else
		die(c, status);
	s->lost_key = status < 0 && f->key;
	s->frame_name = NULL;
}

/* With -k: what cannot be read counts as a frame that failed. */
static void
leave_out_input(cmd *c, mr_status status)
{
	if (!c->keep_going || status == MR_EUSAGE)
		die(c, status);
	c->frame++;
	leave_out(c);
}

/* One frame, as mr-import makes it. */
static void
read_model(cmd *c, const char *path)
{
	MR_SCOPE(&c->ctx);
	mr_frame *frame;
	mr_status status = mr_import(&c->ctx, path, NULL, &frame, NULL);

	if (status >= 0)
		one_frame(c, frame);
	else
		leave_out_input(c, status);
}

static void
read_stream(cmd *c, const char *path)
{
	bool from_stdin = place_is_dash(path);
	const char *name = from_stdin ? "stdin" : path;
	mr_reader *reader;
	mr_frame *frame;
	mr_status status;
	int fd;

	fd = from_stdin ? STDIN_FILENO : open(path, O_RDONLY);
	if (fd < 0) {
		leave_out_input(c, fail_system(c, path));
		return;
	}
	if (isatty(fd))
		die(c, mr_fail(&c->ctx, MR_EUSAGE, "%s is a terminal: pipe a stream in, or name a FILE%s",
			   name, c->tool->operands ? " by -i" : ""));
	try(c, mr_prefix(&c->ctx, mr_reader_open(&c->ctx, fd, &reader), "%s", name));
	while ((status = mr_reader_next(&c->ctx, reader, &frame)) == MR_OK)
		one_frame(c, frame);
	if (status < 0 && is_pipe(fd) && mr_reader_told(reader) && !c->verbose) {
		clear_progress(c);
		pass_failure(c);
		leave(c, EXIT_DATA);
	}
	try(c, mr_prefix(&c->ctx, status, "%s", name));
	mr_reader_free(reader);
	if (!from_stdin)
		close(fd);
}

mr_status
cmd_input(cmd *c, const char *path)
{
	if (c->state->input)
		return mr_fail(
		    &c->ctx, MR_EUSAGE, "%s and -i %s are both the first stream", path, c->state->input);
	c->state->input = path;
	return MR_OK;
}

mr_status
cmd_side(cmd *c, const char *path, mr_side *side)
{
	struct cmd_state *s = c->state;
	mr_frame *frame;

	MR_RESERVE(&c->keep, s->sides, s->side_count, 1, &s->side_room);
	s->sides[s->side_count++] = side;
	if (!place_is_model(path))
		return mr_side_open(&c->ctx, path, side);
	MR_TRY(mr_import(&c->keep, path, NULL, &frame, NULL));
	frame->number = 1;
	*side = (mr_side){ .path = path, .frame = frame, .fd = STDIN_FILENO, .ended = true };
	return MR_OK;
}

static void
read_input(cmd *c, const char *path)
{
	if (place_is_model(path))
		read_model(c, path);
	else
		read_stream(c, path);
}

static void
read_streams(cmd *c)
{
	const cmd_tool *tool = c->tool;
	size_t first = tool->names_output ? 1 : 0,
	       end = tool->operands && !tool->names_output ? 0 : c->operand_count;

	if (first >= end)
		read_input(c, c->state->input ? c->state->input : "-");
	for (size_t i = first; i < end; i++) {
		c->file = place_is_dash(c->operands[i]) ? NULL : c->operands[i];
		read_input(c, c->operands[i]);
	}
}

/* With -k: says what was left out; the exit code.  If nothing is left, the command stops as without -k. */
static int
account(cmd *c)
{
	const struct cmd_state *s = c->state;

	if (!s->failed)
		return EXIT_GOOD;
	say(c, "%llu of %llu frames failed", (unsigned long long)s->failed, (unsigned long long)c->frame);
	if (s->lost)
		say(c, "%llu more were deltas of those and were left out with them",
		    (unsigned long long)s->lost);
	if (s->failed + s->lost == c->frame) {
		pass_failure(c);
		leave(c, EXIT_DATA);
	}
	return EXIT_DATA;
}

/* If stdin, stdout or stderr is closed, the next opened file would take its number and receive messages.  So
 * each gets a file that can be neither read nor written. */
static void
fill_closed(void)
{
	for (int fd = STDIN_FILENO; fd <= STDERR_FILENO; fd++)
		if (fcntl(fd, F_GETFD) < 0 && open("/dev/null", fd == STDIN_FILENO ? O_WRONLY : O_RDONLY) < 0)
			exit(EXIT_DATA);
}

static void
listen_to(cmd *c)
{
	c->ctx.listener = (mr_listener){ .found = c->quiet && !c->state->stats_path ? NULL : collect_finding,
		.note = c->verbose ? say_of_frame : NULL,
		.progress = !c->quiet && isatty(STDERR_FILENO) ? show_progress : NULL,
		.user = c };
	c->ctx.unfinished = signals_unfinished;
	c->stats = c->state->stats_path != NULL;
	mr_keep(&c->ctx, &c->keep);
	c->keep.permit = c->ctx.permit;
	c->keep.unfinished = c->ctx.unfinished;
	c->keep.sync = c->ctx.sync;
}

static mr_status
run(cmd *c, int argc, char **argv, int *code)
{
	const cmd_tool *tool = c->tool;

	MR_ENTER(&c->ctx);
	parse_command_line(c, argc, argv);
	if (c->state->threads)
		c->ctx.threads = (unsigned)c->state->threads;
	listen_to(c);
	if (tool->prepare)
		MR_TRY(tool->prepare(c));
	if (tool->caches && !(c->cache = mr_cache_new()))
		return mr_fail(&c->ctx, MR_EMEM, "no memory for a cache");
	open_stats(c);
	if (c->sink)
		open_text(c);
	else
		open_writer(c);
	begin_frame(c, NULL);
	if (tool->source)
		MR_TRY(read_operands(c));
	else
		read_streams(c);
	*code = account(c);
	MR_TRY(finish(c));
	close_outputs(c);
	return MR_OK;
}

int
main(int argc, char **argv)
{
	struct cmd_state state = { .out = -1 };
	cmd c = { .tool = &cmd_this, .sink = cmd_this.sink, .name = mr_file_name(argv[0]), .state = &state };
	int code = EXIT_DATA;

	fill_closed();
	signals_begin(c.name);
	mr_memory_begin();
	mr_serial_for_good();
	mr_ctx_init(&c.ctx, 0);
	c.ctx.listener.user = &c;
	c.ctx.permit = permit; /* options read files, too */
	try(&c, run(&c, argc, argv, &code));
	mr_cache_delete(c.cache);
	mr_writer_free(state.writer);
	mr_ctx_free(&c.ctx);
	mr_ctx_free(&c.keep);
	place_guard_free(&state.places);
	return code;
}
