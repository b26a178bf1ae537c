/* cmd.h -- what every command shares: options, frames in and out, sentences, exits.  A command is a table of
 * options and a function from frame to frame; only cmd.c prints and exits: 0 good, 1 data or I/O, 2 usage. */
#ifndef CMD_H
#define CMD_H

#include "base/outfile.h"
#include "options.h"
#include "stream/side_stream.h"

typedef struct cmd cmd;

/* A field of a struct that is a figure: its name, and where it is. */
typedef struct cmd_field {
	const char *name; /* NULL ends a table */
	bool count;       /* a size_t; else a double */
	size_t offset;
} cmd_field;

enum { CMD_RESULT = 512 }; /* bytes, for any tool's */

/* A field of a result that is a count or a double, under its own name or another. */
#define CMD_FIGURE_AS(word, type, field)                                                                     \
	{                                                                                                    \
		word,                                                                                        \
		    _Generic(((type *)0)->field, size_t                                                      \
			     : true, double                                                                  \
			     : false),                                                                       \
		    offsetof(type, field) + 0 * sizeof(char[sizeof(type) <= CMD_RESULT ? 1 : -1])            \
	}
#define CMD_FIGURE(type, field) CMD_FIGURE_AS(#field, type, field)

typedef struct cmd_tool {
	const char *summary;
	const char *operands;   /* usage of the operands; NULL: [FILE...], streams to read */
	const cmd_opt *options; /* NULL: none of its own */

	/* After parsing, before anything is read: checks options; may be NULL. */
	mr_status (*prepare)(cmd *c);

	/* A filter or sink: once per frame, then the frame is sent. */
	mr_status (*frame)(cmd *c, mr_frame *f);
	const cmd_field *figures; /* of c->result, which `frame` fills; NULL: it has none */

	/* A source, instead of `frame`: makes frames of an operand, of each in turn ("-" where there are
	 * none), and sends them by cmd_send.  Its arena ends with the call; with -k one that fails is left
	 * out. */
	mr_status (*source)(cmd *c, const char *operand);

	/* After the last frame; may be NULL. */
	mr_status (*finish)(cmd *c);

	bool sink;         /* writes no stream; with operands of its own it reads -i FILE or stdin */
	bool names_output; /* a sink that names its output by an operand, and streams to read by others: it
	                      has no -o */
	bool sends;        /* `frame` sends by cmd_send itself */
	bool fixed_layers; /* the tool chooses its layers itself: it has no -l */
	bool caches;       /* `frame` has c->cache */
	bool judged;       /* what becomes of the surface is looked at: mr_judge */
} cmd_tool;

struct cmd {
	mr_ctx ctx;  /* its arena lasts until the next frame */
	mr_ctx keep; /* its arena lasts over frames: for what a tool caches, which the tool releases */
	const cmd_tool *tool;
	const char *name;   /* mr-smooth */
	const char *layer;  /* -l, or NULL */
	const char *output; /* -o, or NULL */
	char **operands;    /* of a source or a sink */
	const char *file;   /* the operand that is read; NULL: stdin, or -i */
	size_t operand_count;
	mr_cache *cache; /* over the frames of a tool that `caches` */
	uint64_t frame;  /* number of the frame at work, from 1; in finish, how many there were */
	bool verbose, quiet, keep_going;
	bool no_check; /* a judged tool is not judged */
	bool stats;    /* figures are asked for: --stats */
	bool sink;     /* as the tool's, unless prepare has it write a stream */
	bool keeps;    /* `frame` keeps frames, which finish sends by cmd_send_kept; prepare says so */
	void *result;  /* of `frame`, for its figures; NULL: they are not asked for */
	mr_outfile
	    held; /* a file that is whole gets its name at the end, if all goes well; else it is dropped */
	mr_packing packing; /* what the writer does with columns; mr-cat sets it in prepare */
	struct cmd_state *state;
};

/* Each command's own. */
extern const cmd_tool cmd_this;

/* Standard output is a pipe, though the system says that it is a terminal: under MPI. */
extern bool cmd_piped;

/* Whether an option of the tool's own table stood on the command line. */
bool cmd_given(const cmd *c, const char *name);

/* For prepare: where one of these options (blanks between) was given though it is idle, MR_EUSAGE. */
mr_status cmd_idle(cmd *c, const char *names, bool idle, const char *why) MR_WARN_UNUSED;

/* For prepare: MR_EUSAGE where the option gave a name that no layer can have; NULL, where it was not given,
 * passes. */
mr_status cmd_layer_name(cmd *c, const char *option, const char *name) MR_WARN_UNUSED;

/* For the prepare of a sink that names its output, `what`, by the last operand, or by the first if that ends
 * in `suffix`; it becomes the first.  MR_EUSAGE where neither ends so; NULL: any does, and a terminal too. */
mr_status cmd_output_name(cmd *c, const char *what, const char *suffix) MR_WARN_UNUSED;

/* For prepare, of a tool with operands of its own: reads that instead of stdin.  MR_EUSAGE beside -i. */
mr_status cmd_input(cmd *c, const char *path) MR_WARN_UNUSED;

/* Opens a stream, or a model as a stream of one frame, beside the one that is read, with which it must end.
 */
mr_status cmd_side(cmd *c, const char *path, mr_side *side) MR_WARN_UNUSED;

/* Sends a frame now: a source, or a filter that says it `sends`. */
mr_status cmd_send(cmd *c, const mr_frame *f);

/* For finish, of a tool that `keeps`: works on a kept frame and sends it, as if it were read then. */
mr_status cmd_send_kept(cmd *c, mr_frame *f, mr_status (*work)(cmd *c, mr_frame *f));

/* A figure of the frame at work, for --stats. */
void cmd_figure(cmd *c, const char *name, double value);

/* The fields of a result as figures, in the order of the table; those that were not measured are left out. */
void cmd_figures(cmd *c, const cmd_field *table, const void *result);

/* The layers of a surface and of points. */
void cmd_gaps(cmd *c, const mr_gaps *gaps);

/* Text output of a sink or --json printer: to stdout, or the file of -o; an error shows at the end. */
void cmd_print(cmd *c, const char *format, ...) MR_PRINTF(2, 3);

#endif
