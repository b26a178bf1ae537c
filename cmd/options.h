/* options.h -- one table of options yields the parser, the range checks and --help. Layer rule: cmd; includes
 * base only. */
#ifndef OPTIONS_H
#define OPTIONS_H

#include "base/text.h"
#include "base/vec.h"

typedef enum cmd_kind {
	CMD_FLAG,   /* bool: set */
	CMD_OFF,    /* bool: cleared */
	CMD_REAL,   /* double in [min, max] */
	CMD_SHARE,  /* the same; 10% is 0.1 */
	CMD_COUNT,  /* size_t in [min, max] */
	CMD_CHOICE, /* int: the index of the argument in `metavar`, "implicit|explicit|taubin" */
	CMD_TEXT,   /* const char * */
	CMD_LENGTH, /* a double, followed by a bool: a number; or, with %, a share of the diagonal */
	CMD_VECTOR, /* mr_v3: three numbers x,y,z */
	CMD_SIZE,   /* two size_t: WxH, both in [min, max] */
	CMD_RANGE,  /* two doubles: LOW,HIGH, of which the second is greater */
	CMD_CALL    /* given to `call`, in the order of the command line; may come several times; without a
	               `metavar` it takes nothing */
} cmd_kind;

/* --help shows the value that `value` points to before parsing as the default. */
typedef struct cmd_opt {
	char letter;      /* 0: only the long name */
	const char *name; /* NULL ends the table */
	cmd_kind kind;
	void *value;
	double min, max;
	const char *metavar, *help;
	/* CMD_CALL: MR_EUSAGE with a sentence refuses. */
	mr_status (*call)(mr_ctx *ctx, const struct cmd_opt *option, const char *argument);
} cmd_opt;

/* The address of field `name` for a CMD_LENGTH; field `name`_relative must follow it. */
#define CMD_LENGTH_OF(type, object, name)                                                                    \
	(&(object).name +                                                                                    \
	    0 * sizeof(char[offsetof(type, name##_relative) == offsetof(type, name) + sizeof(double) ? 1     \
												     : -1]))

/* The words of a command line: pointers into argv. */
typedef struct cmd_args {
	char **operands;
	size_t operand_count;
	char **typed; /* the operands, the options of the first table and -l with their arguments, as typed */
	size_t typed_count;
	uint64_t given; /* bit i: option i of the first table, of 64 at most */
} cmd_args;

/* Parses argv[1..] by the two tables, of which the first wins.  Options and operands may be mixed; `--` ends
 * the options.  MR_EUSAGE with a sentence.  args: in the arena. */
mr_status cmd_parse(mr_ctx *ctx, int argc, char **argv, const cmd_opt *const tables[2], cmd_args *args);

/* Prints one table for --help, its defaults read from the values. */
void cmd_print_options(FILE *out, const cmd_opt *table);

/* The options of a table as JSON objects with commas between them. */
void cmd_describe_options(mr_text *t, const cmd_opt *table);

/* How many letters of a, which has n, and b are left between what they begin and end with alike; 0 where b
 * begins with a. */
size_t cmd_unlike(const char *a, size_t n, const char *b);

/* Parses the whole of `text` as a count in [min, max]: MR_EUSAGE with a sentence that begins with `what`. */
mr_status
cmd_parse_count(mr_ctx *ctx, const char *what, const char *text, size_t min, size_t max, size_t *value);

/* Whether a list with commas names nothing somewhere: "", "a,", "a,,b". */
bool cmd_list_lacks(const char *list);

/* Parses `count` numbers with commas between them. */
mr_status cmd_parse_reals(mr_ctx *ctx, const char *what, const char *text, size_t count, double *values);

#endif
