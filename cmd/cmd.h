/*
 * cmd.h -- what every command shares: options, frames in and out, sentences, exits.
 *
 * A command is a table of options and a function from frame to frame:
 *
 *	static mr_status
 *	smooth_frame(cmd *c, mr_frame *f)
 *	{
 *		mr_mesh m, base;
 *
 *		MR_TRY(mr_layer_mesh(&c->ctx, f, "mesh", &m));
 *		MR_TRY(mr_smooth(&c->ctx, &m, &opts, &base));
 *		return mr_layer_put_mesh(&c->ctx, f, "base", &base);
 *	}
 *
 *	int
 *	main(int argc, char **argv)
 *	{
 *		return cmd_main(argc, argv, &(cmd_tool){ .summary = "...", .options = table, .frame = smooth_frame });
 *	}
 *
 * Only this file prints and exits: 0 good, 1 data or I/O, 2 usage.
 */
#ifndef CMD_H
#define CMD_H

#include "stream/stream.h"

typedef struct cmd cmd;

typedef enum cmd_kind {
	CMD_GROUP,  /* a heading in --help: `help` alone */
	CMD_FLAG,   /* bool */
	CMD_REAL,   /* double in [min, max] */
	CMD_COUNT,  /* size_t in [min, max] */
	CMD_CHOICE, /* int: the index of the argument in `metavar`, "implicit|explicit|taubin" */
	CMD_TEXT,   /* const char * */
	CMD_LENGTH, /* cmd_length: a number, or a number and % of the diagonal */
	CMD_VECTOR, /* mr_v3: three numbers x,y,z */
	CMD_CALL    /* given to `call`, in the order of the command line; may come several times */
} cmd_kind;

/* A length as given: in units of the model, or relative to the bounding-box diagonal. */
typedef struct cmd_length {
	double value;  /* already divided by 100 where relative */
	bool relative;
} cmd_length;

/* The length in units of the model. */
double cmd_length_of(cmd_length l, double diagonal);

/* --help shows the value that `value` points to before parsing as the default. */
typedef struct cmd_opt {
	char letter;          /* 0: only the long name */
	const char *name;     /* NULL ends the table */
	cmd_kind kind;
	void *value;
	double min, max;
	const char *metavar, *help;
	mr_status (*call)(mr_ctx *ctx, const char *argument); /* CMD_CALL: MR_EUSAGE with a sentence refuses */
} cmd_opt;

typedef struct cmd_tool {
	const char *summary;
	const char *operands;       /* usage of the operands; NULL: [FILE...], streams to read */
	const cmd_opt *options;     /* NULL: none of its own */
	mr_status (*prepare)(cmd *c); /* after parsing, before anything is read: check options; may be NULL */
	mr_status (*frame)(cmd *c, mr_frame *f); /* a filter or sink: once per frame, then the frame is sent */
	mr_status (*source)(cmd *c);  /* a source: makes and sends frames itself, by cmd_send; instead of `frame` */
	mr_status (*finish)(cmd *c);  /* after the last frame; may be NULL */
	bool sink;                  /* writes no stream: operands are its own, input is -i FILE or stdin */
	bool sends;                 /* `frame` sends by cmd_send itself */
} cmd_tool;

struct cmd {
	mr_ctx ctx;
	const cmd_tool *tool;
	const char *name;           /* mr-smooth */
	const char *layer;          /* -l, or NULL */
	const char *output;         /* -o, or NULL */
	char **operands;            /* of a source or a sink */
	size_t operand_count;
	bool verbose, quiet, keep_going;
	mr_packing packing;         /* what the writer does with columns; mr-cat sets it in prepare */
	struct cmd_state *state;
};

int cmd_main(int argc, char **argv, const cmd_tool *tool);

/* Sends a frame now. */
mr_status cmd_send(cmd *c, const mr_frame *f);

/*
 * Text output of a sink or --json printer: to stdout, or the file of -o; an error shows at the end.
 */
void cmd_print(cmd *c, const char *format, ...) MR_PRINTF(2, 3);

/* Parses the whole of `text` as a finite number in [min, max]: MR_EUSAGE with a sentence that begins with `what`. */
mr_status cmd_parse_real(mr_ctx *ctx, const char *what, const char *text, double min, double max, double *value);
mr_status cmd_parse_count(mr_ctx *ctx, const char *what, const char *text, size_t min, size_t max, size_t *value);

/* Parses `count` numbers with commas between them. */
mr_status cmd_parse_reals(mr_ctx *ctx, const char *what, const char *text, size_t count, double *values);

#endif
