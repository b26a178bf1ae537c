/* help.h -- what --help and --describe print.  Layer rule: cmd. */
#ifndef HELP_H
#define HELP_H

#include "cmd.h"

/* Usage and options of the tool; standard: those that it shares with others. */
void cmd_help(const cmd *c, const cmd_opt *standard);

/* The same as one JSON object. */
void cmd_describe(cmd *c, const cmd_opt *standard);

#endif
